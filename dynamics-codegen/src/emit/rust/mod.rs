//! Rust: the impls of one robot, as text that a person would sign.

mod check;
mod companion;
mod configuration;
mod context;
mod frames;
mod item;
mod items;
mod mechanism;
mod methods;
mod names;
mod stub;
mod table;

pub use item::{Form, Item};
pub use items::implementation;
pub use stub::stub;

use crate::model::Model;
use crate::passes::Compiled;

/// All that the Rust emitter reads.
pub struct Input<'m, 'g> {
    /// The struct.
    pub item: &'m Item,
    /// The robot.
    pub model: &'m Model<'g>,
    /// Its programs.
    pub compiled: &'m Compiled<'g>,
}
