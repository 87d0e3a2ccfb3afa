//! Inverse dynamics: the recursive Newton–Euler algorithm, O(N).
//!
//! J. Luh, M. Walker, R. Paul, *On-line computational scheme for mechanical manipulators*, 1980;
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, ch. 5.

use nalgebra::SVector;

use super::motion::Motion;
use super::place::{Body, Moments};
use super::screw::{Twist, Wrench};
use super::sweep::{add, each};
use super::vector::Vector;
use super::{Tree, entries};
use crate::__private::vector;
use crate::scalar::Scalar;

impl<T: Scalar, const NL: usize, const NQ: usize, const NV: usize> Tree<T, NL, NQ, NV> {
    /// The joint forces `τ = M(q)·a + C(q,v)·v + G(q)` and the passive forces.
    pub fn inverse_dynamics(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        a: &SVector<T, NV>,
    ) -> SVector<T, NV> {
        let bodies = self.place(entries(q));
        let motions = self.motions(&bodies, entries(v));
        let accelerations = self.accelerations(&bodies, &motions, entries(a));
        let wrenches = self.wrenches(&bodies, &motions, &accelerations);
        let [mut tau] = self.passive_forces(q, v).data.0;
        self.add_armature_forces(entries(a), &mut tau);
        add_along_joints(&bodies, wrenches, &mut tau);
        vector(tau)
    }

    /// The bias forces `C(q,v)·v + G(q)` and the passive forces.
    pub fn bias_forces(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> SVector<T, NV> {
        self.inverse_dynamics(q, v, &vector([T::zero(); NV]))
    }

    /// The gravity forces `G(q) = ∂V/∂q`.
    pub fn gravity_forces(&self, q: &SVector<T, NQ>) -> SVector<T, NV> {
        let bodies = self.place(entries(q));
        self.gravity_forces_on(&bodies, &self.composite_moments(&bodies))
    }

    /// Composite bodies that all accelerate upwards.
    pub(super) fn gravity_forces_on(
        &self,
        bodies: &[Body<T>; NL],
        composites: &[Moments<T>; NL],
    ) -> SVector<T, NV> {
        let upwards = -Vector(self.gravity);
        let weights = composites.iter().map(|Moments { mass, first, .. }| Wrench {
            moment: first.cross(upwards),
            force: upwards.scaled(*mass),
        });
        let mut forces = [T::zero(); NV];
        add_along_joints(bodies, weights, &mut forces);
        vector(forces)
    }

    /// The wrench on each link and all its descendants together.
    pub(super) fn wrenches(
        &self,
        bodies: &[Body<T>; NL],
        motions: &[Motion<T>; NL],
        accelerations: &[Twist<T>; NL],
    ) -> [Wrench<T>; NL] {
        let links = bodies.iter().zip(motions).zip(accelerations);
        let own = each(links, Wrench::zero(), |((body, motion), acceleration)| {
            let moving = body.moments.centripetal_wrench(motion.velocity.angular);
            moving + body.moments.wrench_of(*acceleration)
        });
        self.collect_tip_to_base(bodies, own, Wrench::shifted)
    }
}

/// Adds what the joints feel of the wrenches on the links.
fn add_along_joints<T: Scalar>(
    bodies: &[Body<T>],
    wrenches: impl IntoIterator<Item = Wrench<T>>,
    forces: &mut [T],
) {
    for (body, wrench) in bodies.iter().zip(wrenches) {
        for column in body.columns.iter() {
            add(forces, column.v, column.power(wrench));
        }
    }
}
