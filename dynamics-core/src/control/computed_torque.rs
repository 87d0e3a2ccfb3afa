//! Feedback linearisation by inverse dynamics.

use nalgebra::SVector;

use super::{Reference, pulled, scaled};
use crate::dynamics::Dynamics;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// `τ = M·(a_d + K_d·ė + K_p·e + K_i·∫e) + C·v + G +` passive forces.
///
/// If the model is right the error of each joint is that of a linear system of its own: `ë + k_d·ė + k_p·e + k_i·∫e = 0`.
/// Gains are per joint: `k_p` in 1/s², `k_d` in 1/s, `k_i` in 1/s³; `k_d = 2·√k_p` is critical damping without an integral,
/// and with one `k_i < k_p·k_d` is stable.
///
/// # Source
///
/// R. Murray, Z. Li, S. Sastry, *A Mathematical Introduction to Robotic Manipulation*, CRC Press 1994, §4.5.2.
///
/// # Example
///
/// ```
/// use dynamics_core::control::{ComputedTorque, Reference};
/// # use dynamics_core::prelude::*;
/// # fn cycle<R>(robot: &R, measured: &State<f64, 2, 2>) -> SVector<f64, 2>
/// # where R: Dynamics<f64, 2, 2> + Configuration<f64, 2, 2> {
/// let controller = ComputedTorque::critically_damped(SVector::from([10.0, 20.0]));
/// controller.torque(robot, measured, &Reference::rest(SVector::from([0.3, -0.5])))
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComputedTorque<T, const NV: usize> {
    /// `K_p`, in 1/s².
    pub proportional: SVector<T, NV>,
    /// `K_d`, in 1/s.
    pub derivative: SVector<T, NV>,
}

impl<T: Scalar, const NV: usize> ComputedTorque<T, NV> {
    /// `k_p = ω²` and `k_d = 2ω`, for `ω` in rad/s of each joint.
    #[must_use]
    pub fn critically_damped(frequencies: SVector<T, NV>) -> Self {
        Self { proportional: scaled(&frequencies, &frequencies), derivative: frequencies + frequencies }
    }

    /// The joint forces, NV.
    ///
    /// # Cost
    ///
    /// One `inverse_dynamics`.
    #[inline]
    pub fn torque<R, const NQ: usize>(
        &self,
        robot: &R,
        state: &State<T, NQ, NV>,
        reference: &Reference<T, NQ, NV>,
    ) -> SVector<T, NV>
    where
        R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV> + ?Sized,
    {
        let a = self.acceleration(robot, state, reference);
        robot.inverse_dynamics(&state.q, &state.v, &a)
    }

    /// The joint forces, with those of an integral of the error, which goes on by `step` seconds.
    ///
    /// # Cost
    ///
    /// One `inverse_dynamics`.
    #[inline]
    pub fn torque_with_integral<R, const NQ: usize>(
        &self,
        integral: &mut Integral<T, NV>,
        robot: &R,
        state: &State<T, NQ, NV>,
        reference: &Reference<T, NQ, NV>,
        step: T,
    ) -> SVector<T, NV>
    where
        R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV> + ?Sized,
        T: PartialOrd,
    {
        let errors = reference.errors(robot, state);
        integral.add(&errors.0, step);
        let a = reference.a + pulled(self.gains(), &errors) + scaled(&integral.gain, &integral.sum);
        robot.inverse_dynamics(&state.q, &state.v, &a)
    }

    /// The acceleration that is asked for: `a_d + K_d·ė + K_p·e`, NV.
    #[inline]
    pub fn acceleration<R, const NQ: usize>(
        &self,
        robot: &R,
        state: &State<T, NQ, NV>,
        reference: &Reference<T, NQ, NV>,
    ) -> SVector<T, NV>
    where
        R: Configuration<T, NQ, NV> + ?Sized,
    {
        reference.a + pulled(self.gains(), &reference.errors(robot, state))
    }

    fn gains(&self) -> [&SVector<T, NV>; 2] {
        [&self.proportional, &self.derivative]
    }
}

/// The integral of the error, within bounds, so that it does not wind up while the robot is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integral<T, const NV: usize> {
    /// `K_i`, in 1/s³.
    pub gain: SVector<T, NV>,
    /// The largest magnitude of each sum, in rad·s or m·s.
    pub bound: SVector<T, NV>,
    /// `∫e`, in rad·s or m·s.
    pub sum: SVector<T, NV>,
}

impl<T: Scalar, const NV: usize> Integral<T, NV> {
    /// An integral that is zero.
    #[must_use]
    pub fn new(gain: SVector<T, NV>, bound: SVector<T, NV>) -> Self {
        Self { gain, bound, sum: SVector::zeros() }
    }

    fn add(&mut self, error: &SVector<T, NV>, step: T)
    where
        T: PartialOrd,
    {
        for ((sum, error), bound) in self.sum.iter_mut().zip(error).zip(&self.bound) {
            let next = error.mul_add(step, *sum);
            *sum = super::saturation::clamped(next, -*bound, *bound);
        }
    }
}
