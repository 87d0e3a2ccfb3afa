//! What became of a file: all that was read, merged, altered and ignored.

use crate::diagnostics::Place;

/// What became of a URDF, for those who want to know.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// The robot's name in the file.
    pub robot: Option<String>,
    /// The link that is welded to the world.
    pub root: String,
    /// How many links there are.
    pub links: usize,
    /// How many joints there are, fixed ones too.
    pub joints: usize,
    /// The mass of all links, kg.
    pub mass: f64,
    /// Elements and attributes that were not used.
    pub ignored: Vec<Note>,
    /// Links that are welded to others.
    pub merged: Vec<Note>,
    /// Angles next to right ones, which become right ones unless `snap = off`.
    pub snapped: Vec<Note>,
    /// What was altered or assumed, and what looks odd.
    pub remarks: Vec<Note>,
    /// What is taken as it is written, and looks like a mistake.
    pub suspicions: Vec<Note>,
}

/// A fact, and where it is from.
#[derive(Clone, Debug)]
pub struct Note {
    /// The fact: lower case, no full stop.
    pub text: String,
    /// Where it was written.
    pub place: Place,
}

impl Note {
    /// A note about a place.
    pub(super) fn new(text: impl Into<String>, place: Place) -> Self {
        Self { text: text.into(), place }
    }
}
