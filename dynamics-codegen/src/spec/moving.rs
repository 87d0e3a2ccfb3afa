//! What moves, in terms of energies: parts of joints, rates, distances, places of bodies.

use super::cursor::{Cursor, Result};
use super::formula::Words;
use super::values::{count_wrong, name};
use super::{Formula, FormulaKind, Name};
use crate::diagnostics::Place;

/// What only a term has.
#[derive(Clone, Debug)]
pub enum Moving {
    /// `joint.part`: a coordinate or a speed of a joint that has several.
    Part(Name, Name),
    /// `dot(x)`: how fast it changes.
    Rate(Box<Formula>),
    /// `distance(a, b)`: between the origins of two bodies' frames.
    Distance(Box<[Name; 2]>),
    /// `x(a)`, `y(a)`, `z(a)`: the origin of a body's frame in the world, along an axis (0, 1, 2).
    Place(usize, Name),
}

/// The names of functions that only terms have.
pub(super) const FUNCTIONS: [&str; 5] = ["dot", "distance", "x", "y", "z"];

/// Whether a function is one of those.
pub(super) fn is_known(name: &Name) -> bool {
    FUNCTIONS.contains(&&*name.text)
}

/// A name, or `joint.part`.
pub(super) fn named(name: Name, input: &mut Cursor) -> Result<Formula> {
    if !input.punct('.') {
        return Ok(Formula { place: name.place.clone(), kind: FormulaKind::Name(name) });
    }
    let Some(part) = input.ident() else { return Err(input.expected("a part of the joint, as in `base.x`")) };
    let part = Name::new(&part);
    Ok(Formula { place: name.place.to(&part.place), kind: FormulaKind::Moving(Moving::Part(name, part)) })
}

impl Moving {
    /// Reads the arguments of one of the [`FUNCTIONS`].
    pub(super) fn parse(function: &Name, arguments: Cursor, place: &Place) -> Result<Self> {
        if function.text == "dot" {
            return Ok(Self::Rate(Box::new(Formula::parse_in(arguments, Words::OfTerms)?)));
        }
        const BODY: &str = "the name of a body";
        let items = arguments.items();
        let count = items.len();
        if function.text == "distance" {
            let Ok([a, b]) = <[Cursor; 2]>::try_from(items) else {
                return Err(count_wrong(count, place, "distance", &["a body", "another one"]));
            };
            return Ok(Self::Distance(Box::new([name(a, BODY)?, name(b, BODY)?])));
        }
        let axis = ["x", "y", "z"].iter().position(|axis| function.text == *axis).unwrap_or(0);
        match <[Cursor; 1]>::try_from(items) {
            Ok([body]) => Ok(Self::Place(axis, name(body, BODY)?)),
            Err(_) => Err(count_wrong(count, place, &function.text, &["a body"])),
        }
    }
}
