//! From equations to programs: what runs once, what runs in each call, and in which order.

mod compile;
mod hoist;
mod parameters;
mod program;
mod share;
mod signs;
mod verify;

pub use compile::{Compiled, compile, entries, methods};
pub use hoist::Companion;
pub use program::{Cost, Operand, Operation, Program, Source, Step};
pub use verify::{Disagreement, disagreements};
