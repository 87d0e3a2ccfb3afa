//! Inverse dynamics: recursive Newton–Euler in pseudo-inertia form, O(n).
//!
//! `F = m a + U h`, `N = vee(U Σ − Σ Uᵀ) + h × a`, about the origin of each link's frame. With no speeds and
//! no accelerations it is the gravity vector, without accelerations the bias.
//!
//! J. Luh, M. Walker, R. Paul, *On-line computational scheme for mechanical manipulators*, 1980; the form is
//! W. Khalil's, W. Khalil, E. Dombre 2002, ch. 9.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::columns::Direction;
use super::motion::{LinkAcceleration, accelerations};
use super::normal::{NormalTree, PlacedJoint};
use crate::spatial::{PseudoInertia, Scalar, Symmetric3, Vector3};

/// A force and its moment about the origin of the frame it is written in.
#[derive(Clone, Copy, Debug)]
pub struct Wrench<S> {
    /// Force, N.
    pub F: Vector3<S>,
    /// Moment, N·m.
    pub N: Vector3<S>,
}

impl<S: Scalar> Wrench<S> {
    /// The wrench in the parent's frame.
    pub fn up(self, joint: &PlacedJoint<S>) -> Self {
        let F = joint.up(self.F);
        Self { F, N: joint.up(self.N) + joint.position.cross(F) }
    }

    /// No force.
    pub fn zero() -> Self {
        Self { F: Vector3::zero(), N: Vector3::zero() }
    }

    /// What a degree of freedom feels of it.
    pub fn along(self, direction: Direction) -> S {
        match direction {
            Direction::Along(k) => self.F.0[k],
            Direction::About(k) => self.N.0[k],
        }
    }
}

impl<S: Scalar> std::ops::Add for Wrench<S> {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        Self { F: self.F + rhs.F, N: self.N + rhs.N }
    }
}

/// The forces `τ = M(q)·a + C(q,v)·v + G(q)` of the columns, without rotors and passive forces.
pub fn inverse_dynamics<S: Scalar>(tree: &NormalTree<S>, q: &[S], qd: &[S], qdd: &[S]) -> Vec<S> {
    let joints = tree.place(q);
    let motion = accelerations(tree, &joints, qd, qdd);
    let wrenches = tree.links.iter().zip(&motion).map(|(link, motion)| link_wrench(&link.inertia, motion));
    let wrenches = collect_tip_to_base(tree, &joints, wrenches.collect());
    tree.columns.iter().map(|column| wrenches[column.link].along(column.direction)).collect()
}

/// Adds to each link's wrench those of all its descendants.
pub fn collect_tip_to_base<S: Scalar>(
    tree: &NormalTree<S>,
    joints: &[PlacedJoint<S>],
    mut wrenches: Vec<Wrench<S>>,
) -> Vec<Wrench<S>> {
    for k in (0..tree.links.len()).rev() {
        if let Some(parent) = tree.links[k].parent {
            wrenches[parent] = wrenches[parent] + wrenches[k].up(&joints[k]);
        }
    }
    wrenches
}

/// The wrench that a link's own mass needs to accelerate so.
pub fn link_wrench<S: Scalar>(inertia: &PseudoInertia<S>, motion: &LinkAcceleration<S>) -> Wrench<S> {
    let (h, a, U) = (inertia.first, motion.a, motion.U);
    let [[u00, u01, u02], [u10, u11, u12], [u20, u21, u22]] = U.0;
    let Symmetric3 { xx, yy, zz, xy, xz, yz } = inertia.second;
    let turning = Vector3::new(
        u21 * yy - u12 * zz + (yz * (u22 - u11) + u20 * xy) - u10 * xz,
        u02 * zz - u20 * xx + (xz * (u00 - u22) + u01 * yz) - u21 * xy,
        u10 * xx - u01 * yy + (xy * (u11 - u00) + u12 * xz) - u02 * yz,
    );
    Wrench { F: a.scale(inertia.mass) + U * h, N: turning + h.cross(a) }
}
