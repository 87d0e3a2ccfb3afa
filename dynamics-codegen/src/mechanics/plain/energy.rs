//! Kinetic and potential energy, link by link.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::kinematics::{link_poses, link_velocities};
use super::passive;
use super::six::Matrix6;
use super::terms;
use crate::model::Tree;
use crate::spatial::{Pose, PseudoInertia, Scalar};

/// `T = Σ ½ V_Bᵀ M_B V_B` over all links, the rotors' own, and terms, J.
pub fn kinetic_energy<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S]) -> S {
    let twice = (tree.links.iter().zip(link_velocities(tree, q, v)))
        .map(|(link, V_B)| V_B.dot(Matrix6::inertia(&link.inertia) * V_B))
        .fold(S::zero(), |sum, energy| sum + energy);
    let rotors =
        passive::one_dof(tree).fold(S::zero(), |sum, (link, k)| sum + passive::reflected(link) * v[k] * v[k]);
    (twice + rotors) / S::from(2) + terms::kinetic_energy(tree, q, v)
}

/// `V = −Σ g·(R_WB h + m p_WB)` over all links and the mass at rest, and terms, J; of mass at the world's origin zero.
pub fn potential_energy<S: Scalar>(tree: &Tree<S>, q: &[S]) -> S {
    let moment = |X_WB: Pose<S>, body: &PseudoInertia<S>| {
        X_WB.rotation * body.first + X_WB.translation.scale(body.mass)
    };
    (tree.links.iter().zip(link_poses(tree, q)))
        .map(|(link, X_WB)| moment(X_WB, &link.inertia))
        .chain([moment(Pose::identity(), &tree.base)])
        .fold(terms::potential_energy(tree, q), |sum, first| sum - tree.gravity.dot(first))
}

/// `L = T − V`, J.
pub fn lagrangian<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S]) -> S {
    kinetic_energy(tree, q, v) - potential_energy(tree, q)
}
