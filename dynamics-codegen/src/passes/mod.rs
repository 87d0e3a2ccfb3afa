//! From equations to programs: what runs once, what runs in each call, and in which order.

mod compile;
mod hoist;
mod lanes;
mod latency;
mod order;
mod parameters;
mod plan;
mod program;
mod regression;
mod right_sides;
mod schedule;
mod share;
mod signs;
mod stages;
mod table;
mod verify;

pub use compile::{Compiled, CompiledMethod, Sizes, compile, entries};
pub use hoist::Companion;
pub use plan::{Lack, Plan, RunTime, lacks, methods, without_terms};
pub use program::{Cost, Operand, Operation, Program, Source, Step};
pub use schedule::schedule;
pub use share::share;
pub use stages::{Branches, BySource, Stage};
pub use table::NUMBERS_PER_LINK;
pub use verify::{Disagreement, disagreements};
