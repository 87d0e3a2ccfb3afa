//! What acts in joints by themselves: rotors, damping, friction, springs.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, ch. 9.6, for rotors.

use super::terms::dissipation_forces;
use crate::model::{Link, Tree};
use crate::spatial::Scalar;

/// The forces of dampers, friction and springs on the left-hand side, and of terms of D, n.
pub fn forces<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S]) -> Vec<S> {
    let mut forces = dissipation_forces(tree, q, v);
    for (link, k) in one_dof(tree) {
        let (passive, drive) = (link.passive, link.drive);
        let (p, s) = (drive.ratio * q[drive.q] + drive.offset, drive.ratio * v[drive.v]);
        let mut force = passive.damping * s + passive.stiffness * (p - passive.rest);
        if !passive.friction.is_zero() {
            let smoothed = (s * s + passive.friction_speed * passive.friction_speed).sqrt();
            force = force + passive.friction * s / smoothed;
        }
        forces[k] = forces[k] + drive.ratio * force;
    }
    forces
}

/// The forces that accelerate rotors, n.
pub fn rotors<S: Scalar>(tree: &Tree<S>, a: &[S]) -> Vec<S> {
    let mut forces = vec![S::zero(); tree.dof()];
    for (link, k) in one_dof(tree) {
        forces[k] = forces[k] + reflected(link) * a[k];
    }
    forces
}

/// The inertia of a link's rotor as the robot's own speed feels it.
pub fn reflected<S: Scalar>(link: &Link<S>) -> S {
    link.drive.ratio * link.drive.ratio * link.passive.armature
}

/// `½ Σ stiffness·(p − rest)²`, J.
pub fn elastic_energy<S: Scalar>(tree: &Tree<S>, q: &[S]) -> S {
    let twice = one_dof(tree).fold(S::zero(), |sum, (link, _)| {
        let stretch = link.drive.ratio * q[link.drive.q] + link.drive.offset - link.passive.rest;
        sum + link.passive.stiffness * stretch * stretch
    });
    twice / S::from(2)
}

/// The links of joints of one degree of freedom, and their speeds.
pub fn one_dof<S>(tree: &Tree<S>) -> impl Iterator<Item = (&Link<S>, usize)> {
    tree.links.iter().filter(|link| link.motion.speeds() == 1).map(|link| (link, link.drive.v))
}
