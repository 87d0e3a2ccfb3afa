//! Why a command did not do what it was asked for.

use std::ops::Range;
use std::process::ExitCode;

use dynamics_codegen::diagnostics::{Diagnostic, Diagnostics};

use crate::input::Input;
use crate::render::{self, line_of, span_at};

/// What ends a command.
pub(crate) enum Failure {
    /// What is wrong, in order; at least one problem.
    Wrong(Vec<Problem>),
    /// Options that do not go together, as the parser of the command line complains of them.
    CommandLine(Box<Problem>),
    /// Who read the output has gone: there is nobody to tell.
    PipeClosed,
}

/// One thing that is wrong.
#[derive(Default)]
pub(crate) struct Problem {
    /// The fact: lower case, no full stop.
    pub(crate) title: String,
    /// Where it was written.
    pub(crate) spot: Option<Box<Spot>>,
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
    /// The line, if it can be shown, and what of it is meant, in bytes.
    pub(crate) source: Option<(String, Range<usize>)>,
}

impl Spot {
    /// The place of what begins at a line and a column of a text.
    pub(crate) fn in_text(file: impl Into<String>, text: &str, line: usize, column: usize) -> Self {
        let source = line_of(text, line).map(|line| (line.to_owned(), span_at(line, column)));
        Self { file: file.into(), line, column, source }
    }

    /// The place of some characters, from 0, of a text that is one line.
    pub(crate) fn in_line(file: String, line: &str, characters: Range<usize>) -> Self {
        let byte = |k: usize| line.char_indices().nth(k).map_or(line.len(), |(byte, _)| byte);
        let column = characters.start + 1;
        let span = byte(characters.start)..byte(characters.end.max(characters.start));
        Self { file, line: 1, column, source: line_of(line, 1).map(|line| (line.to_owned(), span)) }
    }
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

impl Problem {
    /// A mistake that the compiler found in what was given.
    fn of(found: &Diagnostic, input: &Input) -> Self {
        let spot = input.spot(&found.place);
        Self {
            title: input.worded(&found.message, spot.as_ref()),
            help: Some(input.worded(found.help_text(), spot.as_ref())),
            spot: spot.map(Box::new),
            code: Some(found.code.to_string()),
        }
    }
}

impl From<Problem> for Failure {
    fn from(problem: Problem) -> Self {
        Self::Wrong(vec![problem])
    }
}

impl Failure {
    /// Mistakes that the compiler found in a file, or in what the command line says beside it.
    pub(crate) fn mistakes(mut found: Diagnostics, input: &Input) -> Self {
        Self::Wrong(found.take().iter().map(|found| Problem::of(found, input)).collect())
    }

    /// Tells the user.
    pub(crate) fn report(self) -> ExitCode {
        match self {
            Self::Wrong(problems) => {
                render::to_stderr(&problems);
                ExitCode::FAILURE
            }
            Self::CommandLine(problem) => {
                render::to_stderr(&[*problem]);
                ExitCode::from(2)
            }
            Self::PipeClosed => ExitCode::SUCCESS,
        }
    }
}
