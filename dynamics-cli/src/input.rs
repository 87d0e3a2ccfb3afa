//! The robot that a command is about: a URDF, or a struct in a file of Rust, with what the command line says of it.

use std::cell::RefCell;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use dynamics_codegen::diagnostics::{Diagnostics, Place};
use dynamics_codegen::model;
use dynamics_codegen::spec::RobotSpec;
use dynamics_codegen::spec::urdf::{Note, Report, SIZE_LIMIT, Urdf};
use dynamics_codegen::symbolic::Graph;
use dynamics_codegen::{read_struct, read_urdf_with};

use crate::attributes::Attributes;
use crate::failure::{Failure, Spot};
use crate::fields::{self, Setting};
use crate::robot::NAME;
use crate::rust_file::{self, crate_of};
use crate::wording::for_the_command_line;

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
    pub(crate) choice: String,
    /// How it is written.
    pub(crate) robot: Written,
}

/// How a robot is written.
pub(crate) enum Written {
    Urdf,
    /// On a struct of a file of Rust.
    Struct(Box<Struct>),
}

/// A struct, and the attributes of the command line with it.
pub(crate) struct Struct {
    pub(crate) item: syn::DeriveInput,
    /// Where the file is, for what is found from there.
    pub(crate) path: PathBuf,
    /// The URDF that it names, and its text, once that was read.
    pub(crate) file: RefCell<Option<(String, String)>>,
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
            spec.known = fields::known(&self.settings, &spec, &parameters, self)?;
            fields::judge(&self.settings, &spec, self)?;
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

    /// Warns of what looks like a mistake in the file, and is taken as it is written.
    pub(crate) fn warn(&self, report: &Report) {
        for line in self.placed(&report.suspicions) {
            let _ = writeln!(std::io::stderr(), "warning: {line}");
        }
    }

    /// Notes with their places, in the order of the file.
    pub(crate) fn placed(&self, notes: &[Note]) -> Vec<String> {
        let mut notes: Vec<&Note> = notes.iter().collect();
        notes.sort_by_key(|note| match note.place {
            Place::Text { line, column, .. } => (line, column),
            Place::Tokens { .. } => (0, 0),
        });
        let line = |note: &&Note| {
            let spot = self.spot(&note.place);
            let place = match (&note.place, &spot) {
                (Place::Text { .. }, Some(spot)) => format!("{}:{}:{}: ", spot.file, spot.line, spot.column),
                (_, Some(spot)) if spot.file.starts_with("--") => format!("{}: ", spot.file),
                (_, Some(spot)) => format!("{}:{}: ", spot.file, spot.line),
                (_, None) => String::new(),
            };
            format!("{place}{}", self.worded(&note.text, spot.as_ref()))
        };
        notes.iter().map(line).collect()
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
pub(crate) fn lines_of(text: &str) -> usize {
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
