//! Rust: the impls of one robot, as text that a person would sign.

mod check;
mod companion;
mod configuration;
mod context;
mod equations;
mod frames;
mod item;
mod items;
mod loops;
mod mechanism;
mod methods;
mod names;
mod stub;
mod table;

pub use item::{Form, Item};
pub use items::implementation;
pub use stub::stub;

use crate::mechanics::closed::ClosedForms;
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
    /// Its equations as people write them, where these are short.
    pub closed: Option<&'m ClosedForms>,
}
