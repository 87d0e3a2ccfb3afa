//! The robot as a whole: centre of mass and momentum, summed link by link in the world's frame.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::kinematics::{link_poses, link_velocities};
use super::six::{Matrix6, Six};
use crate::model::Tree;
use crate::spatial::{Pose, Scalar, Vector3};

/// The mass of all links, kg.
pub fn total_mass<S: Scalar>(tree: &Tree<S>) -> S {
    tree.links.iter().fold(S::zero(), |sum, link| sum + link.inertia.mass)
}

/// Where the mass of all links is, m.
pub fn center_of_mass<S: Scalar>(tree: &Tree<S>, q: &[S]) -> Vector3<S> {
    let moments =
        tree.links.iter().zip(link_poses(tree, q)).map(|(link, X_WB)| link.inertia.transformed(X_WB));
    let first = moments.fold(Vector3::zero(), |sum, moments| sum + moments.first);
    first.scale(S::one() / total_mass(tree))
}

/// The momentum of all links about their centre of mass, in world axes.
pub fn centroidal_momentum<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S]) -> Six<S> {
    let center = Pose::translation(center_of_mass(tree, q));
    let links = tree.links.iter().zip(link_poses(tree, q)).zip(link_velocities(tree, q, v));
    links.fold(Six::zero(), |sum, ((link, X_WB), V_B)| {
        // Ad(X_BG)ᵀ takes momenta written in B to the axes of G.
        let to_center = Matrix6::adjoint(X_WB.inverse() * center).transpose();
        sum + to_center * (Matrix6::inertia(&link.inertia) * V_B)
    })
}
