//! Kinetic and potential energy, O(N).

use nalgebra::SVector;

use super::place::{Body, first_moment};
use super::vector::Vector;
use super::{Tree, entries};
use crate::scalar::Scalar;

impl<T: Scalar, const NL: usize, const NQ: usize, const NV: usize> Tree<T, NL, NQ, NV> {
    /// `T = ½ vᵀ·M(q)·v`, J, with the armatures'.
    pub fn kinetic_energy(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> T {
        self.kinetic_energy_of(&self.place(entries(q)), entries(v))
    }

    /// `V = −g·Σ m r`, J, with all mass at rest; zero if all mass were at the world's origin.
    pub fn potential_energy(&self, q: &SVector<T, NQ>) -> T {
        self.potential_energy_of(&self.place(entries(q)))
    }

    /// `L = T − V`, J.
    pub fn lagrangian(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> T {
        let bodies = self.place(entries(q));
        self.kinetic_energy_of(&bodies, entries(v)) - self.potential_energy_of(&bodies)
    }

    /// Half of each link's velocity times its momentum, and of the armatures'.
    fn kinetic_energy_of(&self, bodies: &[Body<T>; NL], v: &[T; NV]) -> T {
        let motions = self.motions(bodies, v);
        let twice = bodies.iter().zip(&motions).map(|(body, motion)| {
            let velocity = motion.velocity;
            velocity.dot(body.moments.wrench_of(velocity))
        });
        (twice.fold(T::zero(), T::add) + self.twice_energy_of_armatures(v)) * T::of(0.5)
    }

    fn potential_energy_of(&self, bodies: &[Body<T>; NL]) -> T {
        let first = Vector(self.base_first) + first_moment(bodies, &self.origins(bodies, Vector::zero()));
        -Vector(self.gravity).dot(first)
    }
}
