//! Inverse dynamics: the recursive Newton–Euler algorithm with 6×6 matrices, O(n).
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, ch. 5, table 5.1. `V_B`, `A_B`, `F_B` are
//! measured in the world and written in B; `A` is the spatial acceleration, not that of a point.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::kinematics::{joint_motion, motion_subspace, pose_in_parent};
use super::passive;
use super::six::{Matrix6, Six};
use super::terms;
use crate::model::{Link, Tree};
use crate::spatial::{Scalar, Vector3};

/// The joint forces `τ = M(q)·a + C(q,v)·v + G(q)` and passive forces, with those of all terms, N·m and N, positive along the joint's axis.
///
/// The world accelerates by minus gravity, so no link needs a weight.
pub fn inverse_dynamics<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S], a: &[S]) -> Vec<S> {
    let others = [
        passive::forces(tree, q, v),
        terms::potential_forces(tree, q),
        terms::inertial_forces(tree, q, v, a),
    ];
    others.into_iter().fold(recursion(tree, -tree.gravity, q, v, a), sum)
}

fn sum<S: Scalar>(forces: Vec<S>, others: Vec<S>) -> Vec<S> {
    forces.into_iter().zip(others).map(|(force, other)| force + other).collect()
}

/// `G(q) = ∂V/∂q`, the forces that hold the tree at rest against gravity.
pub fn gravity_forces<S: Scalar>(tree: &Tree<S>, q: &[S]) -> Vec<S> {
    let rest = vec![S::zero(); tree.dof()];
    sum(recursion(tree, -tree.gravity, q, &rest, &rest), terms::potential_forces(tree, q))
}

/// `h(q,v) = C(q,v)·v + G(q)` and passive forces.
pub fn bias_forces<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S]) -> Vec<S> {
    inverse_dynamics(tree, q, v, &vec![S::zero(); tree.dof()])
}

/// Velocities and accelerations outward, forces inward, and what rotors need.
fn recursion<S: Scalar>(tree: &Tree<S>, base: Vector3<S>, q: &[S], v: &[S], a: &[S]) -> Vec<S> {
    Placed::at(tree, q).forces(base, v, a)
}

/// What of the recursion depends on the configuration alone, for many speeds.
pub(super) struct Placed<'t, S> {
    tree: &'t Tree<S>,
    q: &'t [S],
    /// `Ad(X_BP)` of every link: motions from the parent to the link; transposed, forces back.
    X: Vec<Matrix6<S>>,
    /// The inertia of every link.
    M: Vec<Matrix6<S>>,
}

impl<'t, S: Scalar> Placed<'t, S> {
    /// The tree at the configuration `q`.
    pub(super) fn at(tree: &'t Tree<S>, q: &'t [S]) -> Self {
        let adjoint = |link: &Link<S>| Matrix6::adjoint(pose_in_parent(link, q).inverse());
        Self {
            tree,
            q,
            X: tree.links.iter().map(adjoint).collect(),
            M: tree.links.iter().map(|link| Matrix6::inertia(&link.inertia)).collect(),
        }
    }

    /// `M(q)·a + C(q,v)·v`, as if there were no gravity.
    pub(super) fn inertial_forces(&self, v: &[S], a: &[S]) -> Vec<S> {
        sum(self.forces(Vector3::zero(), v, a), terms::inertial_forces(self.tree, self.q, v, a))
    }

    /// The forces while the world accelerates by `base`.
    fn forces(&self, base: Vector3<S>, v: &[S], a: &[S]) -> Vec<S> {
        let Self { tree, X, M, .. } = self;
        let A_W = Six::new(base, Vector3::zero());
        let mut V: Vec<Six<S>> = Vec::with_capacity(tree.links.len());
        let mut A: Vec<Six<S>> = Vec::with_capacity(tree.links.len());
        let mut F: Vec<Six<S>> = Vec::with_capacity(tree.links.len());
        for (k, link) in tree.links.iter().enumerate() {
            let (V_P, A_P) = link.parent.map_or((Six::zero(), A_W), |parent| (V[parent], A[parent]));
            let V_J = joint_motion(link, v);
            let V_B = X[k] * V_P + V_J;
            let V_cross = Matrix6::cross(V_B);
            let A_B = X[k] * A_P + joint_motion(link, a) + V_cross * V_J;
            F.push(M[k] * A_B + (V_cross.transpose() * (M[k] * V_B)).scale(-S::one()));
            A.push(A_B);
            V.push(V_B);
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
}
