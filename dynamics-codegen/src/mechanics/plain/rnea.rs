//! Inverse dynamics: the recursive Newton–Euler algorithm with 6×6 matrices, O(n).
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, ch. 5, table 5.1. `V_B`, `A_B`, `F_B` are
//! measured in the world and written in B; `A` is the spatial acceleration, not that of a point.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::kinematics::{joint_motion, link_velocities, motion_subspace, pose_in_parent};
use super::passive;
use super::six::{Matrix6, Six};
use crate::model::Tree;
use crate::spatial::{Scalar, Vector3};

/// The joint forces `τ = M(q)·a + C(q,v)·v + G(q)` and passive forces, N·m and N, positive along the joint's axis.
///
/// The world accelerates by minus gravity, so no link needs a weight.
pub fn inverse_dynamics<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S], a: &[S]) -> Vec<S> {
    let passive = passive::forces(tree, q, v);
    recursion(tree, -tree.gravity, q, v, a)
        .into_iter()
        .zip(passive)
        .map(|(tau, passive)| tau + passive)
        .collect()
}

/// `G(q) = ∂V/∂q`, the forces that hold the tree at rest against gravity.
pub fn gravity_forces<S: Scalar>(tree: &Tree<S>, q: &[S]) -> Vec<S> {
    let rest = vec![S::zero(); tree.dof()];
    recursion(tree, -tree.gravity, q, &rest, &rest)
}

/// `h(q,v) = C(q,v)·v + G(q)` and passive forces.
pub fn bias_forces<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S]) -> Vec<S> {
    inverse_dynamics(tree, q, v, &vec![S::zero(); tree.dof()])
}

/// `M(q)·a + C(q,v)·v`, as if there were no gravity.
pub(super) fn inertial_forces<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S], a: &[S]) -> Vec<S> {
    recursion(tree, Vector3::zero(), q, v, a)
}

/// Velocities and accelerations outward, forces inward, and what rotors need.
fn recursion<S: Scalar>(tree: &Tree<S>, base: Vector3<S>, q: &[S], v: &[S], a: &[S]) -> Vec<S> {
    let A_W = Six::new(base, Vector3::zero());
    let V = link_velocities(tree, q, v);
    // Ad(X_BP) of every link: motions from the parent to the link; transposed, forces back.
    let X: Vec<Matrix6<S>> =
        tree.links.iter().map(|link| Matrix6::adjoint(pose_in_parent(link, q).inverse())).collect();

    let mut A: Vec<Six<S>> = Vec::with_capacity(tree.links.len());
    let mut F: Vec<Six<S>> = Vec::with_capacity(tree.links.len());
    for (k, link) in tree.links.iter().enumerate() {
        let V_cross = Matrix6::cross(V[k]);
        let A_P = link.parent.map_or(A_W, |parent| A[parent]);
        let A_B = X[k] * A_P + joint_motion(link, a) + V_cross * joint_motion(link, v);
        let M_B = Matrix6::inertia(&link.inertia);
        F.push(M_B * A_B + (V_cross.transpose() * (M_B * V[k])).scale(-S::one()));
        A.push(A_B);
    }

    let mut tau = passive::rotors(tree, a);
    for (k, link) in tree.links.iter().enumerate().rev() {
        for (speed, S_B) in motion_subspace(link) {
            tau[speed] = tau[speed] + S_B.dot(F[k]);
        }
        if let Some(parent) = link.parent {
            F[parent] = F[parent] + X[k].transpose() * F[k];
        }
    }
    tau
}
