//! From equations to programs: what runs once, what runs in each call, and in which order.

mod compile;
mod hoist;
mod parameters;
mod program;
mod share;
mod signs;
mod verify;

pub use compile::{Compiled, CompiledMethod, Plan, compile, entries, methods};
pub use hoist::Companion;
pub use program::{Cost, Operand, Operation, Program, Source, Step};
pub use share::share;
pub use verify::{Disagreement, disagreements};
