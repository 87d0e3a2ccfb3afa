//! The centre of mass of all that moves, and its momentum, O(N).
//!
//! D. Orin, A. Goswami, S.-H. Lee, *Centroidal dynamics of a humanoid robot*, Autonomous Robots 2013.

use core::ops::Add;

use nalgebra::{SMatrix, SVector};

use super::place::{Body, first_moment};
use super::screw::Wrench;
use super::vector::Vector;
use super::{Tree, entries};
use crate::__private::{columns, vector};
use crate::scalar::Scalar;

impl<T: Scalar, const NL: usize, const NQ: usize, const NV: usize> Tree<T, NL, NQ, NV> {
    /// The centre of mass of all moving links in the world, m; not finite without any mass.
    pub fn center_of_mass(&self, q: &SVector<T, NQ>) -> SVector<T, 3> {
        let bodies = self.place(entries(q));
        vector((self.centroid(&bodies).position + start(&bodies)).0)
    }

    /// The Jacobian of the centre of mass, 3×NV: `J·v` is its velocity in world axes, m/s.
    pub fn center_of_mass_jacobian(&self, q: &SVector<T, NQ>) -> SMatrix<T, 3, NV> {
        let bodies = self.place(entries(q));
        let Centroid { mass, arms, .. } = self.centroid(&bodies);
        let per_mass = T::one() / mass;
        columns(self.momenta(&bodies, arms).map(|momentum| momentum.force.scaled(per_mass).0))
    }

    /// The momentum of all moving links, 6: linear, then angular about the centre of mass; in world axes, kg·m/s
    /// and kg·m²/s. Armatures have no part in it.
    pub fn centroidal_momentum(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> SVector<T, 6> {
        let bodies = self.place(entries(q));
        let motions = self.motions(&bodies, entries(v));
        let arms = self.centroid(&bodies).arms;
        let momenta = bodies
            .iter()
            .zip(&motions)
            .zip(arms)
            .map(|((body, motion), arm)| body.moments.wrench_of(motion.velocity).shifted(arm));
        vector(momenta.fold(Wrench::zero(), Wrench::add).linear_first())
    }

    /// The matrix `A(q)`, 6×NV, with `A·v` the [momentum](Self::centroidal_momentum).
    pub fn centroidal_momentum_matrix(&self, q: &SVector<T, NQ>) -> SMatrix<T, 6, NV> {
        let bodies = self.place(entries(q));
        let arms = self.centroid(&bodies).arms;
        columns(self.momenta(&bodies, arms).map(Wrench::linear_first))
    }

    /// The momentum at unit speed, for each speed, about the point from which the links' origins are `arms` away.
    fn momenta(&self, bodies: &[Body<T>; NL], arms: [Vector<T>; NL]) -> [Wrench<T>; NV] {
        let mut momenta = [Wrench::zero(); NV];
        let composites = self.composite_moments(bodies);
        let links = bodies.iter().zip(composites).zip(arms);
        for ((body, composite), arm) in links {
            for column in body.columns.iter() {
                if let Some(momentum) = momenta.get_mut(column.v) {
                    *momentum = *momentum + composite.wrench_of(column.twist()).shifted(arm);
                }
            }
        }
        momenta
    }

    /// From the first link's origin, not the world's: far from the latter no digits are lost.
    fn centroid(&self, bodies: &[Body<T>; NL]) -> Centroid<T, NL> {
        let origins = self.origins(bodies, -start(bodies));
        let mass = bodies.iter().fold(T::zero(), |sum, body| sum + body.moments.mass);
        let position = first_moment(bodies, &origins).scaled(T::one() / mass);
        Centroid { mass, position, arms: origins.map(|origin| origin - position) }
    }
}

/// The centre of mass of all moving links.
struct Centroid<T, const NL: usize> {
    mass: T,
    /// Where it is, from the first link's origin.
    position: Vector<T>,
    /// From it to the links' origins.
    arms: [Vector<T>; NL],
}

/// Where the first link is.
fn start<T: Scalar>(bodies: &[Body<T>]) -> Vector<T> {
    bodies.first().map_or_else(Vector::zero, |body| body.offset)
}
