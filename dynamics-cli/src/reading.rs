//! The options by which a robot is read, of all commands.

use std::cell::RefCell;
use std::io::Read;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use dynamics_codegen::diagnostics::{Code, Diagnostics};
use dynamics_codegen::read_attributes;
use dynamics_codegen::spec::urdf::{SIZE_LIMIT, text_of};

use crate::attributes::{Attributes, quoted};
use crate::failure::{Failure, Problem};
use crate::fields::settings;
use crate::input::{Input, Struct, Written, lines_of, name_of, shown};
use crate::rust_file;

/// The options of all commands that read a robot.
#[derive(clap::Args)]
pub(crate) struct InputArgs {
    /// A URDF, or a file of Rust with `#[derive(Dynamics)]` on a struct; `-` is standard input
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,

    #[command(flatten)]
    reading: ReadingArgs,
}

/// How a file is to be read.
#[derive(clap::Args)]
pub(crate) struct ReadingArgs {
    /// Of a file of Rust with several robots, the struct that is meant
    #[arg(long, value_name = "NAME")]
    robot: Option<String>,

    /// A number for a field, with its unit or in SI units: 'm1 = 4kg'; several with commas between. The equations have it
    /// wherever they had the field
    #[arg(long = "set", value_name = "NAME = VALUE", value_delimiter = ',', allow_hyphen_values = true)]
    set: Vec<String>,

    /// How the root of a URDF is in the world: welded, or moved freely by a joint `root_joint`
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

impl InputArgs {
    /// Reads the file.
    pub(crate) fn read(&self) -> Result<Input, Failure> {
        self.reading.read(&self.file, |_| {})
    }

    /// Reads the file for a command that has more attributes than the options of all commands.
    pub(crate) fn read_with(&self, add: impl FnOnce(&mut Attributes)) -> Result<Input, Failure> {
        self.reading.read(&self.file, add)
    }

    /// Whether a body of an inertia that no distribution of mass has is refused.
    pub(crate) fn judges_inertias(&self) -> bool {
        self.reading.allow.is_none()
    }
}

impl ReadingArgs {
    /// Reads a file, with attributes beside those of the options.
    pub(crate) fn read(&self, file: &Path, add: impl FnOnce(&mut Attributes)) -> Result<Input, Failure> {
        let bytes = bytes_of(file)?;
        let name = name_of(file);
        if bytes.len() > SIZE_LIMIT {
            let message = format!("{name} has more than {SIZE_LIMIT} bytes");
            return Err(Problem::new(message).help(Code::FileTooLarge.help()).into());
        }
        let mut attributes = self.attributes();
        add(&mut attributes);
        let attributes = attributes.checked()?;
        let settings = settings(&self.set)?;
        let mut input = Input {
            name,
            text: String::from_utf8_lossy(&bytes).into_owned(),
            attributes,
            settings,
            choice: self.choice(),
            robot: Written::Urdf,
        };
        let mut diags = Diagnostics::new();
        match diags.keep(text_of(&input.name, &bytes).map(str::to_owned)) {
            Some(text) => input.text = text,
            None => return Err(Failure::mistakes(diags, &input)),
        }
        if self.is_rust(file, &input.text) {
            input.robot = Written::Struct(Box::new(self.written(file, &mut input)?));
        } else if let Some(robot) = &self.robot {
            let problem = Problem::new(format!(
                "`--robot {}` chooses a struct, and {} is no file of Rust",
                shown(robot),
                input.name
            ));
            return Err(Failure::CommandLine(problem.help("leave it out: a URDF has one robot").into()));
        }
        Ok(input)
    }

    /// Whether a text is Rust: by the ending of its file, or by what it has if that tells nothing.
    fn is_rust(&self, file: &Path, text: &str) -> bool {
        let is_derived = text.contains("#[derive(") && !text.trim_start().starts_with('<');
        match file.extension() {
            Some(ending) if ending == "rs" => true,
            None if file == Path::new("-") => self.robot.is_some() || is_derived,
            _ => is_derived,
        }
    }

    /// The robot of a file of Rust.
    fn written(&self, file: &Path, input: &mut Input) -> Result<Struct, Failure> {
        // The places of tokens do not count the mark.
        if let Some(text) = input.text.strip_prefix('\u{feff}') {
            input.text = text.to_owned();
        }
        let mut item = rust_file::robot(&input.name, &input.text, self.robot.as_deref())?;
        // The options stand behind the file, and are known by their lines.
        let behind = "\n".repeat(lines_of(&input.text)) + &input.attributes.text();
        let mut diags = Diagnostics::new();
        let path = file.to_owned();
        match diags.keep(read_attributes(&behind)) {
            Some(attributes) => {
                item.attrs.extend(attributes);
                Ok(Struct { item, path, file: RefCell::default() })
            }
            None => {
                input.robot = Written::Struct(Box::new(Struct { item, path, file: RefCell::default() }));
                Err(Failure::mistakes(diags, input))
            }
        }
    }

    /// The options that choose the robot and its values, with a space before each.
    fn choice(&self) -> String {
        let robot = self.robot.iter().map(|robot| ("robot", robot));
        let options = robot.chain(self.set.iter().map(|value| ("set", value)));
        options.map(|(option, value)| format!(" --{option} {}", quoted(&shown(value.trim())))).collect()
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
