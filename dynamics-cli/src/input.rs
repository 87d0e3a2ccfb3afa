//! The file that a command is about, and how it is to be read.

use std::io::Read;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use dynamics_codegen::diagnostics::{Code, Diagnostics};
use dynamics_codegen::spec::urdf::{SIZE_LIMIT, Urdf, text_of};

use crate::attributes::Attributes;
use crate::failure::{Failure, Problem};

/// The options of all commands that read a robot.
#[derive(clap::Args)]
pub(crate) struct InputArgs {
    /// A URDF; `-` is standard input
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,

    /// How the root of the file is in the world: welded, or moved freely by a joint `root_joint`
    #[arg(long, value_name = "BASE", default_value = "fixed")]
    base: Base,

    /// The acceleration of free fall, in m/s²; without it, `[0, 0, -9.81]`
    #[arg(long, value_name = "[X, Y, Z]")]
    gravity: Option<String>,

    /// What the file does not say of a joint, or a joint of its own, as in `#[joint(…)]`: 'elbow, armature = 0.2'
    #[arg(long = "joint", value_name = "TEXT")]
    joints: Vec<String>,

    /// What the file does not say of a link, or a body of its own, as in `#[body(…)]`: 'load, solid = point(2kg)'
    #[arg(long = "body", value_name = "TEXT")]
    bodies: Vec<String>,

    /// A coordinate without a body, as in `#[coordinate(…)]`: 'sway: length, damping = 2'
    #[arg(long = "coordinate", value_name = "TEXT")]
    coordinates: Vec<String>,

    /// A term of the potential energy, as in `#[potential(…)]`: '50N_per_m / 2 * distance(tool0, world)^2'
    #[arg(long = "potential", value_name = "TERM")]
    potentials: Vec<String>,

    /// A term of Rayleigh's dissipation function, as in `#[dissipation(…)]`: '2Nms / 2 * dot(elbow)^2'
    #[arg(long = "dissipation", value_name = "TERM")]
    dissipations: Vec<String>,

    /// A term of the kinetic energy, as in `#[kinetic(…)]`: '0.1kg_m2 / 2 * (dot(elbow) + dot(wrist))^2'
    #[arg(long = "kinetic", value_name = "TERM")]
    kinetics: Vec<String>,

    /// Accept what is refused otherwise: bodies whose inertia no distribution of mass has
    #[arg(long, value_name = "WHAT", value_parser = ["nonphysical_inertia"])]
    allow: Option<String>,

    /// Whether rotations within 1e-11 of right angles become right angles
    #[arg(long, value_name = "SWITCH", default_value = "on")]
    snap: Switch,

    /// Whether the damping and friction of the file act
    #[arg(long, value_name = "SWITCH", default_value = "on")]
    passive: Switch,
}

/// How the root of a file is in the world.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Base {
    Fixed,
    Free,
}

/// On or off.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Switch {
    On,
    Off,
}

/// A file that was read.
pub(crate) struct Input {
    /// As it was named on the command line.
    pub(crate) name: String,
    /// What is in it.
    pub(crate) text: String,
    /// What the command line says beside it.
    pub(crate) attributes: Attributes,
}

impl InputArgs {
    /// Reads the file.
    pub(crate) fn read(&self) -> Result<Input, Failure> {
        self.read_with(|_| {})
    }

    /// Reads the file for a command that has more attributes than the options of all commands.
    pub(crate) fn read_with(&self, add: impl FnOnce(&mut Attributes)) -> Result<Input, Failure> {
        let bytes = bytes_of(&self.file)?;
        let name = name_of(&self.file);
        if bytes.len() > SIZE_LIMIT {
            let message = format!("{name} has more than {SIZE_LIMIT} bytes");
            return Err(Problem::new(message).help(Code::FileTooLarge.help()).into());
        }
        let mut attributes = self.attributes();
        add(&mut attributes);
        let attributes = attributes.checked()?;
        let mut diags = Diagnostics::new();
        match diags.keep(text_of(&name, &bytes).map(str::to_owned)) {
            Some(text) => Ok(Input { name, text, attributes }),
            None => {
                let text = String::from_utf8_lossy(&bytes).into_owned();
                Err(Failure::mistakes(diags, &Input { name, text, attributes }))
            }
        }
    }

    /// Whether a body of an inertia that no distribution of mass has is refused.
    pub(crate) fn judges_inertias(&self) -> bool {
        self.allow.is_none()
    }

    /// What is said beside the file, and is not the default.
    fn attributes(&self) -> Attributes {
        let mut attributes = Attributes::default();
        if self.base == Base::Free {
            attributes.add("base", "#[dynamics(base = ", "free", ")]");
        }
        if let Some(gravity) = &self.gravity {
            attributes.add("gravity", "#[dynamics(gravity = ", gravity, ")]");
        }
        for joint in &self.joints {
            attributes.add("joint", "#[joint(", joint, ")]");
        }
        for body in &self.bodies {
            attributes.add("body", "#[body(", body, ")]");
        }
        let terms = [
            ("coordinate", "#[coordinate(", &self.coordinates),
            ("potential", "#[potential(", &self.potentials),
            ("dissipation", "#[dissipation(", &self.dissipations),
            ("kinetic", "#[kinetic(", &self.kinetics),
        ];
        for (option, head, values) in terms {
            for value in values {
                attributes.add(option, head, value, ")]");
            }
        }
        if let Some(allow) = &self.allow {
            attributes.add("allow", "#[dynamics(allow(", allow, "))]");
        }
        if self.snap == Switch::Off {
            attributes.add("snap", "#[dynamics(snap = ", "off", ")]");
        }
        if self.passive == Switch::Off {
            attributes.add("passive", "#[dynamics(passive = ", "off", ")]");
        }
        attributes
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
