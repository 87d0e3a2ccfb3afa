//! C99: a header and a source, for firmware that is written in C.
//!
//! No heap, no globals, no variable-length arrays, no library but a square root where a robot needs one; matrices by
//! rows; no identifier longer than the 31 characters that C99 promises to tell apart.

mod configuration;
mod context;
mod functions;
mod header;
mod loops;
mod names;
mod source;
mod words;

pub use functions::LeftOut;
pub use names::{PREFIX_LIMIT, check_prefix};

use functions::Function;
use names::Robot;

use crate::model::Model;
use crate::passes::Compiled;

/// The type of all numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Real {
    /// `float`: nothing is ever computed in `double`.
    Float,
    /// `double`
    Double,
}

impl Real {
    /// The type's name in C.
    pub fn name(self) -> &'static str {
        match self {
            Self::Float => "float",
            Self::Double => "double",
        }
    }

    /// A number as C writes it, the nearest of the type; `None` if that is infinite.
    fn literal(self, value: f64) -> Option<String> {
        match self {
            Self::Float => {
                Some(value as f32).filter(|value| value.is_finite()).map(|value| format!("{value:?}f"))
            }
            Self::Double => Some(value).filter(|value| value.is_finite()).map(|value| format!("{value:?}")),
        }
    }
}

/// All that the C emitter reads.
pub struct Input<'m, 'g> {
    /// What every name begins with: a name of C in small letters, of at most [`PREFIX_LIMIT`] characters.
    pub prefix: &'m str,
    /// The type of all numbers.
    pub real: Real,
    /// Where the robot comes from and how to write it again, a line each.
    pub origin: &'m [String],
    /// The robot.
    pub model: &'m Model<'g>,
    /// Its programs, compiled without a run time.
    pub compiled: &'m Compiled<'g>,
}

/// What is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Files {
    /// `prefix.h`
    pub header: String,
    /// `prefix.c`
    pub source: String,
    /// The methods that are not in them, and why.
    pub left_out: Vec<LeftOut>,
}

/// Writes a robot.
pub fn files(input: &Input<'_, '_>) -> Files {
    let robot = Robot::of(input);
    let (functions, left_out) = Function::all(input, &robot);
    let header = header::write(input, &robot, &functions, &left_out);
    let source = source::write(input, &robot, &functions);
    Files { header, source, left_out }
}

/// Whether a constant of the programs is too large for the type.
pub fn overflows(compiled: &Compiled<'_>, real: Real) -> bool {
    compiled.programs().any(|program| program.constants().any(|constant| real.literal(constant).is_none()))
}
