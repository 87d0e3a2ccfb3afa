//! The robot as a whole: centre of mass and momentum, summed link by link in the world's frame.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::kinematics::{link_poses, link_poses_by_first, link_velocities};
use super::six::{Matrix6, Six};
use crate::model::Tree;
use crate::spatial::{Pose, Scalar, Vector3};

/// The mass of all links, kg.
pub fn total_mass<S: Scalar>(tree: &Tree<S>) -> S {
    tree.links.iter().fold(S::zero(), |sum, link| sum + link.inertia.mass)
}

/// Where the mass of all links is, m.
pub fn center_of_mass<S: Scalar>(tree: &Tree<S>, q: &[S]) -> Vector3<S> {
    center(tree, &link_poses(tree, q))
}

/// Where it is in the axes in which the links have the poses `X_AB`.
fn center<S: Scalar>(tree: &Tree<S>, X_AB: &[Pose<S>]) -> Vector3<S> {
    let moments = tree.links.iter().zip(X_AB).map(|(link, &X_AB)| link.inertia.transformed(X_AB));
    let first = moments.fold(Vector3::zero(), |sum, moments| sum + moments.first);
    first.scale(S::one() / total_mass(tree))
}

/// The momentum of all links about their centre of mass, in world axes.
pub fn centroidal_momentum<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S]) -> Six<S> {
    let X_AB = link_poses_by_first(tree, q);
    let center = Pose::translation(center(tree, &X_AB));
    let links = tree.links.iter().zip(X_AB).zip(link_velocities(tree, q, v));
    links.fold(Six::zero(), |sum, ((link, X_AB), V_B)| {
        // Ad(X_BG)ᵀ takes momenta written in B to the axes of G.
        let to_center = Matrix6::adjoint(X_AB.inverse() * center).transpose();
        sum + to_center * (Matrix6::inertia(&link.inertia) * V_B)
    })
}
