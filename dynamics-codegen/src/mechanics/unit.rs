//! A unit of length in which a robot's commonest distance is one: multiplications with it vanish.
//!
//! With `P → P/L`, `g → g/L`, `h → hL`, `m → mL²`, and `Σ` as it is, torques, energies and the mass matrix of
//! a robot that only turns are what they were.

use super::normal::NormalTree;
use crate::model::Motion;
use crate::spatial::PseudoInertia;
use crate::symbolic::{Expr, Number};

/// The distances that could be the unit, without repetition, in the order of the links; one comes first.
/// Joints that slide and distances that are parameters leave no choice.
pub fn candidates(tree: &NormalTree<Expr<'_>>) -> Vec<Number> {
    let mut found = vec![Number::ONE];
    for link in &tree.links {
        for component in link.position.0 {
            match component.as_number() {
                Some(value) if matches!(link.motion, Motion::Revolute | Motion::Ball) => {
                    let length = value.abs();
                    if !length.is_zero() && !found.contains(&length) {
                        found.push(length);
                    }
                }
                _ => return vec![Number::ONE],
            }
        }
    }
    found
}

/// The tree in the unit `length`.
pub fn in_unit<'g>(tree: &NormalTree<Expr<'g>>, length: Number) -> NormalTree<Expr<'g>> {
    if length.is_one() {
        return tree.clone();
    }
    let unit = Expr::from(length);
    let inverse = Expr::ONE / unit;
    let inertia = |inertia: PseudoInertia<Expr<'g>>| PseudoInertia {
        mass: inertia.mass * unit * unit,
        first: inertia.first.scale(unit),
        second: inertia.second,
    };
    let mut tree = tree.clone();
    for link in &mut tree.links {
        link.position = link.position.scale(inverse);
        link.inertia = inertia(link.inertia);
    }
    tree.base.translation = tree.base.translation.scale(inverse);
    tree.at_rest = inertia(tree.at_rest);
    tree.gravity = tree.gravity.scale(inverse);
    tree
}
