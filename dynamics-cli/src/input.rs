//! The file that a command is about, and how it is to be read: a URDF, or Rust with a robot on a struct.

use std::cell::RefCell;
use std::io::Read;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use dynamics_codegen::diagnostics::{Code, Diagnostics, Place};
use dynamics_codegen::model;
use dynamics_codegen::spec::RobotSpec;
use dynamics_codegen::spec::urdf::{Report, SIZE_LIMIT, Urdf, text_of};
use dynamics_codegen::symbolic::Graph;
use dynamics_codegen::{read_attributes, read_struct, read_urdf_with};

use crate::attributes::{Attributes, quoted};
use crate::failure::{Failure, Problem, Spot};
use crate::fields::{self, Setting, settings};
use crate::robot::NAME;
use crate::rust_file::{self, crate_of};
use crate::wording::for_the_command_line;

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

/// A file that was read.
pub(crate) struct Input {
    /// As it was named on the command line.
    pub(crate) name: String,
    /// What is in it.
    pub(crate) text: String,
    /// What the command line says beside it.
    pub(crate) attributes: Attributes,
    /// What the command line says of fields.
    pub(crate) settings: Vec<Setting>,
    /// The options that chose the robot and its values.
    choice: String,
    robot: Written,
}

/// How a robot is written.
enum Written {
    Urdf,
    /// On a struct of a file of Rust.
    Struct(Box<Struct>),
}

/// A struct, and the attributes of the command line with it.
struct Struct {
    item: syn::DeriveInput,
    /// Where the file is, for what is found from there.
    path: PathBuf,
    /// The URDF that it names, and its text, once that was read.
    file: RefCell<Option<(String, String)>>,
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

    /// Whether a text is Rust: by the name of its file, or by what it has if it has no name.
    fn is_rust(&self, file: &Path, text: &str) -> bool {
        match file == Path::new("-") {
            true => self.robot.is_some() || text.contains("#[derive("),
            false => file.extension().is_some_and(|ending| ending == "rs"),
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

impl Input {
    /// The robot as written, and what became of the file that has it. `fields` are names that may stand in options where
    /// a file has none, besides those that have values.
    pub(crate) fn spec(&self, fields: &[&str]) -> Result<(RobotSpec, Report), Failure> {
        let found = match &self.robot {
            Written::Urdf => {
                let mut names: Vec<&str> = self.settings.iter().map(Setting::name).collect();
                names.extend(
                    fields.iter().filter(|field| !self.settings.iter().any(|set| set.name() == **field)),
                );
                let urdf = Urdf { file: &self.name, text: &self.text };
                read_urdf_with(NAME, &names, urdf, &self.attributes.text())
            }
            Written::Struct(robot) => {
                let read = |path: &str| robot.read(path);
                read_struct(&robot.item, read).map(|(spec, report)| {
                    let report = report.unwrap_or_else(|| Report {
                        links: spec.bodies.len(),
                        joints: spec.joints.len(),
                        ..Report::default()
                    });
                    let report = Report { robot: Some(spec.ident.to_string()), ..report };
                    (spec, report)
                })
            }
        };
        let (mut spec, report) = found.map_err(|found| Failure::mistakes(found, self))?;
        if !self.settings.is_empty() {
            // The robot tells the units in which values are given.
            let (graph, mut diags) = (Graph::new(), Diagnostics::new());
            let model = model::build(&spec, &graph, &mut diags);
            diags.check().map_err(|found| Failure::mistakes(found, self))?;
            let parameters = model.map_or(vec![], |model| model.parameters);
            spec.known = fields::known(&self.settings, &spec, &parameters)?;
        }
        Ok((spec, report))
    }

    /// Whether a URDF has the robot, by itself or for a struct.
    pub(crate) fn is_of_file(&self) -> bool {
        match &self.robot {
            Written::Urdf => true,
            Written::Struct(robot) => robot.file.borrow().is_some(),
        }
    }

    /// The struct, if the robot is on one.
    pub(crate) fn item(&self) -> Option<&syn::DeriveInput> {
        match &self.robot {
            Written::Urdf => None,
            Written::Struct(robot) => Some(&robot.item),
        }
    }

    /// All options that make a difference to the robot, with a space before each.
    pub(crate) fn flags(&self) -> String {
        self.choice.clone() + &self.attributes.flags()
    }

    /// Where tokens were written: in the file, or in an option. Nowhere if they are of neither.
    pub(crate) fn spot(&self, place: &Place) -> Option<Spot> {
        match (place, &self.robot) {
            (Place::Tokens { .. }, Written::Urdf) => self.attributes.spot(place, 0),
            (Place::Tokens { start, end }, Written::Struct(_)) => {
                let lines = lines_of(&self.text);
                match start.start().line > lines {
                    true => self.attributes.spot(place, lines),
                    false => rust_file::spot_of(&self.name, &self.text, *start, *end),
                }
            }
            (Place::Text { file, line, column }, Written::Urdf) => {
                Some(Spot::in_text(&**file, &self.text, *line as usize, *column as usize))
            }
            (Place::Text { file, line, column }, Written::Struct(robot)) => {
                let named = robot.file.borrow();
                let (name, text) = named.as_ref().map_or((&**file, ""), |(name, text)| (name, text));
                Some(Spot::in_text(name, text, *line as usize, *column as usize))
            }
        }
    }

    /// A text of the compiler, in the words of where the robot was written.
    pub(crate) fn worded(&self, text: &str, spot: Option<&Spot>) -> String {
        let is_of_option = spot.is_some_and(|spot| spot.file.starts_with("--"));
        match self.robot {
            Written::Struct(_) if !is_of_option => text.to_owned(),
            _ => for_the_command_line(text),
        }
    }
}

impl Struct {
    /// Reads the file that the robot names, by its path from the crate's root.
    fn read(&self, path: &str) -> Result<Vec<u8>, String> {
        let path = crate_of(&self.path)?.join(path);
        let limit = SIZE_LIMIT as u64 + 1;
        let mut bytes = vec![];
        std::fs::File::open(&path)
            .and_then(|file| file.take(limit).read_to_end(&mut bytes))
            .map_err(|error| format!("{}: {error}", name_of(&path)))?;
        *self.file.borrow_mut() = Some((name_of(&path), String::from_utf8_lossy(&bytes).into_owned()));
        Ok(bytes)
    }
}

/// How many lines a text has, the last one whole or not.
fn lines_of(text: &str) -> usize {
    text.split('\n').count()
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
