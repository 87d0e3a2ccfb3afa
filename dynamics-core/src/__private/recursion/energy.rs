//! Kinetic and potential energy, O(N).

use nalgebra::SVector;

use super::place::Body;
use super::vector::Vector;
use super::{Tree, entries};
use crate::scalar::Scalar;

impl<T: Scalar, const N: usize> Tree<T, N> {
    /// `T = ½ vᵀ·M(q)·v`, J.
    pub fn kinetic_energy(&self, q: &SVector<T, N>, v: &SVector<T, N>) -> T {
        self.kinetic_energy_of(&self.place(entries(q)), v)
    }

    /// `V = −g·Σ m r`, J, with all mass at rest; zero if all mass were at the world's origin.
    pub fn potential_energy(&self, q: &SVector<T, N>) -> T {
        self.potential_energy_of(&self.place(entries(q)))
    }

    /// `L = T − V`, J.
    pub fn lagrangian(&self, q: &SVector<T, N>, v: &SVector<T, N>) -> T {
        let bodies = self.place(entries(q));
        self.kinetic_energy_of(&bodies, v) - self.potential_energy_of(&bodies)
    }

    /// Half of each link's velocity times its momentum.
    fn kinetic_energy_of(&self, bodies: &[Body<T>; N], v: &SVector<T, N>) -> T {
        let motions = self.motions(bodies, entries(v));
        let twice = bodies.iter().zip(&motions).map(|(body, motion)| {
            let velocity = motion.velocity;
            velocity.dot(body.moments.wrench_of(velocity))
        });
        twice.fold(T::zero(), T::add) * T::of(0.5)
    }

    fn potential_energy_of(&self, bodies: &[Body<T>; N]) -> T {
        let origins = self.base_to_tip(bodies, Vector::zero(), |body, parent| parent + body.offset);
        let moments = bodies.iter().zip(origins);
        let first = moments.fold(Vector(self.base_first), |sum, (body, origin)| {
            sum + body.moments.first + origin.scaled(body.moments.mass)
        });
        -Vector(self.gravity).dot(first)
    }
}
