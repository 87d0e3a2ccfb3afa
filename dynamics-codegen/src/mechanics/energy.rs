//! Kinetic and potential energy.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::motion::velocities;
use super::normal::NormalTree;
use super::passive::armatures;
use crate::spatial::{PseudoInertia, Scalar};

/// `T = ½ Σ (wᵀJw + 2 vᵀ(w × h) + m vᵀv)`, with the rotors' own energy, J.
pub fn kinetic_energy<S: Scalar>(tree: &NormalTree<S>, q: &[S], qd: &[S]) -> S {
    let joints = tree.place(q);
    let velocity = velocities(tree, &joints, qd);
    let mut twice = S::zero();
    for (link, motion) in tree.links.iter().zip(&velocity) {
        let PseudoInertia { mass, first: h, .. } = link.inertia;
        let (w, v) = (motion.w, motion.v);
        let angular = link.inertia.rotational().times(w);
        let coupling = w.cross(h).dot(v);
        twice = twice + w.dot(angular) + coupling.twice() + v.dot(v) * mass;
    }
    for (armature, &speed) in armatures(tree).into_iter().zip(qd) {
        twice = twice + armature * (speed * speed);
    }
    twice * (S::one() / S::from(2))
}

/// `V = −g·Σ m r`, J, zero if all mass were at the world's origin.
pub fn potential_energy<S: Scalar>(tree: &NormalTree<S>, q: &[S]) -> S {
    let joints = tree.place(q);
    let mut masses: Vec<(S, _)> =
        tree.links.iter().map(|link| (link.inertia.mass, link.inertia.first)).collect();
    let (mut mass, mut first) = (tree.at_rest.mass, tree.at_rest.first);
    for k in (0..tree.links.len()).rev() {
        let (m, h) = masses[k];
        let h = joints[k].up(h) + joints[k].position.scale(m);
        match tree.links[k].parent {
            Some(parent) => masses[parent] = (masses[parent].0 + m, masses[parent].1 + h),
            None => (mass, first) = (mass + m, first + h),
        }
    }
    // The base frame's own place in the world, in its axes.
    let origin = tree.base.rotation.transpose() * tree.base.translation;
    -(tree.gravity.dot(first) + tree.gravity.dot(origin) * mass)
}
