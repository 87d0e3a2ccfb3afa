//! Inverse dynamics: the recursive Newton–Euler algorithm, O(N).
//!
//! J. Luh, M. Walker, R. Paul, *On-line computational scheme for mechanical manipulators*, 1980;
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, ch. 5.

use nalgebra::SVector;

use super::motion::Motion;
use super::place::{Body, Moments};
use super::screw::{Twist, Wrench};
use super::sweep::each;
use super::vector::Vector;
use super::{Tree, entries};
use crate::__private::vector;
use crate::scalar::Scalar;

impl<T: Scalar, const N: usize> Tree<T, N> {
    /// The joint forces `τ = M(q)·a + C(q,v)·v + G(q)`.
    pub fn inverse_dynamics(&self, q: &SVector<T, N>, v: &SVector<T, N>, a: &SVector<T, N>) -> SVector<T, N> {
        let bodies = self.place(entries(q));
        let motions = self.motions(&bodies, entries(v));
        let accelerations = self.accelerations(&bodies, &motions, entries(a));
        along_joints(&bodies, &self.wrenches(&bodies, &motions, &accelerations))
    }

    /// The bias forces `C(q,v)·v + G(q)`.
    pub fn bias_forces(&self, q: &SVector<T, N>, v: &SVector<T, N>) -> SVector<T, N> {
        self.inverse_dynamics(q, v, &vector([T::zero(); N]))
    }

    /// The gravity forces `G(q) = ∂V/∂q`.
    pub fn gravity_forces(&self, q: &SVector<T, N>) -> SVector<T, N> {
        let bodies = self.place(entries(q));
        self.gravity_forces_on(&bodies, &self.composite_moments(&bodies))
    }

    /// Composite bodies that all accelerate upwards.
    pub(super) fn gravity_forces_on(
        &self,
        bodies: &[Body<T>; N],
        composites: &[Moments<T>; N],
    ) -> SVector<T, N> {
        let upwards = -Vector(self.gravity);
        let joints = bodies.iter().zip(composites);
        vector(each(joints, T::zero(), |(body, Moments { mass, first, .. })| {
            let (moment, force) = (first.cross(upwards), upwards.scaled(*mass));
            body.along_joint(Wrench { moment, force })
        }))
    }

    /// The wrench on each link and all its descendants together.
    pub(super) fn wrenches(
        &self,
        bodies: &[Body<T>; N],
        motions: &[Motion<T>; N],
        accelerations: &[Twist<T>; N],
    ) -> [Wrench<T>; N] {
        let links = bodies.iter().zip(motions).zip(accelerations);
        let own = each(links, Wrench::zero(), |((body, motion), acceleration)| {
            let moving = body.moments.centripetal_wrench(motion.velocity.angular);
            moving + body.moments.wrench_of(*acceleration)
        });
        self.collect_tip_to_base(bodies, own, Wrench::shifted)
    }
}

fn along_joints<T: Scalar, const N: usize>(
    bodies: &[Body<T>; N],
    wrenches: &[Wrench<T>; N],
) -> SVector<T, N> {
    vector(each(bodies.iter().zip(wrenches), T::zero(), |(body, wrench)| body.along_joint(*wrench)))
}
