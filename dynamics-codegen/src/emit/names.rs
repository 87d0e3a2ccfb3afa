//! The names in generated code: inputs by their letters, fields by the user's names, no two alike.

use rustc_hash::FxHashSet;

use crate::mechanics::equations::{Argument, Input};

/// Hands out names, each once.
#[derive(Clone, Debug, Default)]
pub(super) struct Names {
    taken: FxHashSet<String>,
}

impl Names {
    /// All names that the user's fields take.
    pub(super) fn with_taken<'a>(taken: impl Iterator<Item = &'a str>) -> Self {
        Self { taken: taken.map(str::to_owned).collect() }
    }

    /// `wanted`, or `wanted_`, `wanted__`, … if it is taken.
    pub(super) fn fresh(&mut self, wanted: &str) -> String {
        let mut name = wanted.to_owned();
        while !self.taken.insert(name.clone()) {
            name.push('_');
        }
        name
    }
}

/// The name of the `k`-th component of an argument.
pub(super) fn component(argument: Argument, k: usize) -> String {
    format!("{}{k}", argument.name())
}

/// The name of an entry of a result with this letter.
pub(super) fn entry(letter: &str, row: usize, column: Option<usize>, dof: usize) -> String {
    match column {
        None => format!("{letter}{row}"),
        Some(column) if dof <= 10 => format!("{letter}{row}{column}"),
        Some(column) => format!("{letter}_{row}_{column}"),
    }
}

/// A hint for the names of the sine and cosine of an angle that is made of one coordinate.
pub(super) fn angle_suffix(inputs: &[Input], parameter: impl Fn(usize) -> String) -> Option<String> {
    match inputs {
        [Input::Argument(Argument::Q, k)] => Some(k.to_string()),
        [Input::Parameter(k)] => Some(format!("_{}", parameter(*k))),
        _ => None,
    }
}
