//! Why a command did not do what it was asked for.

use std::process::ExitCode;

use dynamics_codegen::diagnostics::{Diagnostic, Diagnostics, Place};

use crate::input::Input;
use crate::render;

/// What ends a command.
pub(crate) enum Failure {
    /// What is wrong, in order, and what it is wrong in.
    Wrong {
        /// At least one.
        problems: Vec<Problem>,
        /// The text that their places are in.
        text: String,
    },
    /// Who read the output has gone: there is nobody to tell.
    PipeClosed,
}

/// One thing that is wrong.
#[derive(Default)]
pub(crate) struct Problem {
    /// The fact: lower case, no full stop.
    pub(crate) title: String,
    /// Where it was written.
    pub(crate) spot: Option<Spot>,
    /// What to do now.
    pub(crate) help: Option<String>,
    /// The name in the catalogue.
    pub(crate) code: Option<String>,
}

/// A place in a text.
pub(crate) struct Spot {
    /// The name of the text.
    pub(crate) file: String,
    /// From 1.
    pub(crate) line: usize,
    /// In characters, from 1.
    pub(crate) column: usize,
}

impl Problem {
    /// A fact that has no place in a text.
    pub(crate) fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// With what to do now.
    pub(crate) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }
}

impl From<&Diagnostic> for Problem {
    fn from(found: &Diagnostic) -> Self {
        let spot = match &found.place {
            Place::Tokens { .. } => None,
            Place::Text { file, line, column } => {
                Some(Spot { file: file.to_string(), line: *line as usize, column: *column as usize })
            }
        };
        Self {
            title: found.message.clone(),
            spot,
            help: Some(for_the_command_line(found.help_text())),
            code: Some(found.code.to_string()),
        }
    }
}

/// What is written in attributes of Rust, written as options.
fn for_the_command_line(help: &str) -> String {
    help.replace("#[dynamics(allow(nonphysical_inertia))]", "--allow nonphysical_inertia")
        .replace("#[dynamics(passive = off)]", "--passive off")
        .replace("#[dynamics(snap = off)]", "--snap off")
}

impl From<Problem> for Failure {
    fn from(problem: Problem) -> Self {
        Self::Wrong { problems: vec![problem], text: String::new() }
    }
}

impl Failure {
    /// Mistakes that the compiler found in a file.
    pub(crate) fn mistakes(mut found: Diagnostics, input: &Input) -> Self {
        let problems = found.take().iter().map(Problem::from).collect();
        Self::Wrong { problems, text: input.text.clone() }
    }

    /// Tells the user.
    pub(crate) fn report(self) -> ExitCode {
        match self {
            Self::Wrong { problems, text } => {
                render::to_stderr(&problems, &text);
                ExitCode::FAILURE
            }
            Self::PipeClosed => ExitCode::SUCCESS,
        }
    }
}
