//! What is measured of a robot: quantities y(q, v, a, τ) with their exact derivatives.
//!
//! Rows of `C` and `D` of a [state-space model](crate::StateSpaceModel::state_space), and constraints of a
//! [trim](crate::trim). Outputs are composed as tuples, and one's own are an implementation of [`Output`].
//!
//! | | rows | |
//! |---|---|---|
//! | [`joint`], [`joint_speed`], [`joint_acceleration`] | 1 | of one joint, by name or index |
//! | [`displacements`], [`speeds`] | NV | of all joints |
//! | [`position`], [`orientation`] | 3 | of a frame in the world |
//! | [`velocity`], [`angular_velocity`] | 3 | of a frame, in the world's axes or its own |
//! | [`center_of_mass`] | 3 | in the world |
//! | [`kinetic_energy`], [`potential_energy`], [`total_energy`] | 1 | in J |
//! | [`power`] | 1 | of the joint forces, in W |
//!
//! Nothing is differenced. Gradients are Jacobians, forces and Coriolis matrices; that of a velocity stands at
//! [`velocity`], that of the kinetic energy at [`kinetic_energy`]. Accelerations of frames and the velocity of the centre of
//! mass are not among them: their gradients would need code that no robot has.

mod energy;
mod frame;
mod joint;
mod tuple;

pub use energy::{
    CenterOfMass, Energy, Power, center_of_mass, kinetic_energy, potential_energy, power, total_energy,
};
pub use frame::{
    Component, Orientation, Position, Triple, Velocity, angular_velocity, orientation, position, velocity,
};
pub use joint::{All, Joint, Which, displacements, joint, joint_acceleration, joint_speed, speeds};

use nalgebra::{SMatrix, SVector};

use crate::error::Error;
use crate::scalar::Scalar;
use crate::state_space::Signal;

/// A quantity of the robot `R`, of [`ROWS`](Self::ROWS) numbers.
pub trait Output<R: ?Sized, T: Scalar, const NQ: usize, const NV: usize> {
    /// How many numbers it is.
    const ROWS: usize;

    /// Writes its rows. There are [`ROWS`](Self::ROWS) of them, [zero](Row::zero) before.
    ///
    /// # Errors
    ///
    /// What is wrong with the output itself, as a joint that does not exist.
    fn write(&self, robot: &R, at: &OperatingPoint<T, NQ, NV>, rows: &mut [Row<T, NV>]) -> Result<(), Error>;
}

/// Where an output is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OperatingPoint<T, const NQ: usize, const NV: usize> {
    /// The configuration.
    pub q: SVector<T, NQ>,
    /// The velocity.
    pub v: SVector<T, NV>,
    /// The acceleration.
    pub a: SVector<T, NV>,
    /// The joint forces.
    pub tau: SVector<T, NV>,
    /// [`tangent_rate`](crate::StateSpaceModel::tangent_rate) of `v`: `−½ ad(v)` of the configuration's group.
    pub tangent_rate: SMatrix<T, NV, NV>,
}

/// One number of an output, and its partial derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<T, const NV: usize> {
    /// What it is called.
    pub signal: Signal,
    /// The number.
    pub value: T,
    /// By `q`, in the tangent space.
    pub by_q: SVector<T, NV>,
    /// By `v`.
    pub by_v: SVector<T, NV>,
    /// By `a`.
    pub by_a: SVector<T, NV>,
    /// By `τ`.
    pub by_tau: SVector<T, NV>,
}

impl<T: Scalar, const NV: usize> Row<T, NV> {
    /// Zero, with no derivatives and no name.
    #[must_use]
    pub fn zero() -> Self {
        let zero = SVector::zeros();
        Self { signal: Signal::UNNAMED, value: T::zero(), by_q: zero, by_v: zero, by_a: zero, by_tau: zero }
    }
}
