//! The file that a command is about, and how it is to be read.

use std::io::Read;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use dynamics_codegen::diagnostics::{Code, Diagnostics};
use dynamics_codegen::spec::urdf::{SIZE_LIMIT, Urdf, text_of};

use crate::failure::{Failure, Problem};

/// The options of all commands that read a robot.
#[derive(clap::Args)]
pub(crate) struct InputArgs {
    /// A URDF; `-` is standard input
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,

    /// Accept what is refused otherwise: bodies whose inertia no distribution of mass has
    #[arg(long, value_name = "WHAT", value_parser = ["nonphysical_inertia"])]
    allow: Option<String>,

    /// Whether rotations within 1e-11 of right angles become right angles
    #[arg(long, value_name = "SWITCH", default_value = "on")]
    snap: Switch,

    /// How the robot's root is in the world: welded, or free to move, with the coordinates x, y, z, i, j, k, w
    #[arg(long, value_name = "KIND", default_value = "fixed")]
    base: Base,

    /// Whether the damping and friction of the file act
    #[arg(long, value_name = "SWITCH", default_value = "on")]
    passive: Switch,
}

/// On or off.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Switch {
    On,
    Off,
}

/// How a root is in the world.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Base {
    Fixed,
    Free,
}

/// A file that was read.
pub(crate) struct Input {
    /// As it was named on the command line.
    pub(crate) name: String,
    /// What is in it.
    pub(crate) text: String,
    /// The options, as in `#[dynamics(…)]`.
    pub(crate) options: String,
}

impl InputArgs {
    /// Reads the file.
    pub(crate) fn read(&self) -> Result<Input, Failure> {
        let bytes = bytes_of(&self.file)?;
        let name = name_of(&self.file);
        if bytes.len() > SIZE_LIMIT {
            let message = format!("{name} has more than {SIZE_LIMIT} bytes");
            return Err(Problem::new(message).help(Code::FileTooLarge.help()).into());
        }
        let options = self.options();
        let mut diags = Diagnostics::new();
        match diags.keep(text_of(&name, &bytes).map(str::to_owned)) {
            Some(text) => Ok(Input { name, text, options }),
            None => {
                let text = String::from_utf8_lossy(&bytes).into_owned();
                Err(Failure::mistakes(diags, &Input { name, text, options }))
            }
        }
    }

    /// As in `#[dynamics(…)]`.
    fn options(&self) -> String {
        let allow = self.allow.iter().map(|what| format!("allow({what})"));
        let others = self.others().map(|(name, value)| format!("{name} = {value}"));
        allow.chain(others).collect::<Vec<_>>().join(", ")
    }

    /// As on the command line, with a space before each.
    pub(crate) fn flags(&self) -> String {
        let allow = self.allow.iter().map(|what| format!(" --allow {what}"));
        allow.chain(self.others().map(|(name, value)| format!(" --{name} {value}"))).collect()
    }

    /// What is not as it is by default.
    fn others(&self) -> impl Iterator<Item = (&'static str, &'static str)> {
        let base = (self.base == Base::Free).then_some(("base", "free"));
        let switches = [("snap", self.snap), ("passive", self.passive)];
        let off = switches.into_iter().filter(|(_, switch)| *switch == Switch::Off);
        base.into_iter().chain(off.map(|(name, _)| (name, "off")))
    }
}

impl Input {
    /// For the compiler.
    pub(crate) fn urdf(&self) -> Urdf<'_> {
        Urdf { file: &self.name, text: &self.text }
    }
}

/// The name of a file, for messages.
pub(crate) fn name_of(path: &Path) -> String {
    if path == Path::new("-") { "<stdin>".to_owned() } else { shown(&path.to_string_lossy()) }
}

/// A text from outside, for a terminal or a comment: without what is a command there, or turns its direction.
pub(crate) fn shown(text: &str) -> String {
    let is_bad = |c: char| c.is_control() || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    text.chars().map(|c| if is_bad(c) { '\u{fffd}' } else { c }).collect()
}

/// All bytes of a file, but not many more than a robot may have.
pub(crate) fn bytes_of(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = vec![];
    let limit = SIZE_LIMIT as u64 + 1;
    let read = if path == Path::new("-") {
        std::io::stdin().lock().take(limit).read_to_end(&mut bytes)
    } else {
        std::fs::File::open(path).and_then(|file| file.take(limit).read_to_end(&mut bytes))
    };
    match read {
        Ok(_) => Ok(bytes),
        Err(error) => {
            let problem = Problem::new(format!("{} cannot be read: {error}", name_of(path)));
            Err(problem.help("give the path of a file, or `-` for standard input").into())
        }
    }
}
