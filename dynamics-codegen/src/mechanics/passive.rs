//! What acts in joints by themselves: rotors, damping, smooth friction, springs. All of it is diagonal.
//!
//! In each column, at its own coordinate p and speed s: `damping·s + friction·s/√(s² + s₀²) + stiffness·(p − rest)`
//! on the left-hand side, and the armature as an inertia that turns with no link.

use super::columns::Column;
use super::normal::{NormalLink, NormalTree};
use crate::spatial::Scalar;

/// A column at its own coordinate and speed.
struct Acting<'t, S> {
    link: &'t NormalLink<S>,
    stretch: S,
    speed: S,
}

fn acting<'t, S: Scalar>(
    tree: &'t NormalTree<S>,
    q: &[S],
    speeds: &[S],
) -> impl Iterator<Item = Acting<'t, S>> {
    tree.columns.iter().zip(speeds).map(move |(column, &speed)| {
        let link = &tree.links[column.link];
        let stretch = if link.passive.stiffness.is_zero() { S::zero() } else { stretch(link, q) };
        Acting { link, stretch, speed }
    })
}

/// How far a spring is from its rest.
pub fn stretch<S: Scalar>(link: &NormalLink<S>, q: &[S]) -> S {
    link.drive.ratio * q[link.drive.q] + link.drive.offset - link.passive.rest
}

/// `√(s² + s₀²)`
fn smoothed<S: Scalar>(link: &NormalLink<S>, speed: S) -> S {
    let least = link.passive.friction_speed;
    (speed * speed + least * least).sqrt()
}

/// The forces of dampers, friction and springs on the columns.
pub fn forces<S: Scalar>(tree: &NormalTree<S>, q: &[S], speeds: &[S]) -> Vec<S> {
    let force = |Acting { link, stretch, speed }: Acting<'_, S>| {
        let force = link.passive.damping * speed + link.passive.stiffness * stretch;
        if link.passive.friction.is_zero() {
            return force;
        }
        force + link.passive.friction * friction_per_coefficient(link, speed)
    };
    acting(tree, q, speeds).map(force).collect()
}

/// `s/√(s² + s₀²)`: what friction is per unit of its coefficient.
pub fn friction_per_coefficient<S: Scalar>(link: &NormalLink<S>, speed: S) -> S {
    if speed.is_zero() { S::zero() } else { speed / smoothed(link, speed) }
}

/// The derivative of each column's force by its own coordinate.
pub fn stiffnesses<S: Scalar>(tree: &NormalTree<S>) -> Vec<S> {
    tree.columns.iter().map(|column| tree.links[column.link].passive.stiffness).collect()
}

/// The derivative of each column's force by its own speed: `damping + friction·s₀²/(s² + s₀²)^{3/2}`.
pub fn dampings<S: Scalar>(tree: &NormalTree<S>, q: &[S], speeds: &[S]) -> Vec<S> {
    let damping = |Acting { link, speed, .. }: Acting<'_, S>| {
        let passive = link.passive;
        if passive.friction.is_zero() {
            return passive.damping;
        }
        let least = passive.friction_speed / smoothed(link, speed);
        passive.damping + passive.friction * (least * least) / smoothed(link, speed)
    };
    acting(tree, q, speeds).map(damping).collect()
}

/// The armature of each column.
pub fn armatures<S: Scalar>(tree: &NormalTree<S>) -> Vec<S> {
    let armature = |column: &Column<S>| tree.links[column.link].passive.armature;
    tree.columns.iter().map(armature).collect()
}

/// `½ Σ stiffness·(p − rest)²`, J.
pub fn elastic_energy<S: Scalar>(tree: &NormalTree<S>, q: &[S]) -> S {
    let still = vec![S::zero(); tree.columns.len()];
    let twice = acting(tree, q, &still).fold(S::zero(), |sum, Acting { link, stretch, .. }| {
        sum + link.passive.stiffness * (stretch * stretch)
    });
    twice * (S::one() / S::from(2))
}
