//! Controllers as small blocks: a state and a reference in, joint forces out. No heap, any scalar, any robot.
//!
//! | | |
//! |---|---|
//! | [`ComputedTorque`] | `τ = ID(q, v, a_d + K_d·ė + K_p·e)`: each joint a linear oscillator |
//! | [`GravityCompensation`] | `τ = G + K_p·e + K_d·ė`: regulation without a model of the inertia |
//! | [`StateFeedback`] | `u = u₀ − K·x`, `τ = B_u·u`: gains of a linear model, about its point |
//! | [`SlotineLi`] | `τ = Y·π̂ + K·s`: tracks while it adapts the inertial parameters |
//! | [`within_half_a_turn`] | an angle without its whole turns |
//! | [`saturated`] | joint forces within the limits of the robot |
//! | [`FilteredDerivative`] | speeds from measured positions |
//!
//! The error is `e = q_d ⊖ q`, `ė` is `v_d − v`. For one-dof joints these are differences, and what is said of the blocks
//! holds exactly. Of ball and free joints `e` is a rotation vector or a screw in the body's axes, and `v_d − v` compares
//! velocities in the axes of two bodies: it is right to first order in `e`, so that errors go to zero from nearby.
//!
//! Blocks are called at a fixed rate by what runs the robot. Those that remember something say so and take the step of
//! time.

mod computed_torque;
mod filtered_derivative;
mod gravity_compensation;
mod saturation;
mod slotine_li;
mod state_feedback;
mod turns;

pub use computed_torque::{ComputedTorque, Integral};
pub use filtered_derivative::FilteredDerivative;
pub use gravity_compensation::GravityCompensation;
pub use saturation::saturated;
pub use slotine_li::{AllParameters, BaseParameters, Parameters, SlotineLi, Tracking, slotine_li_regressor};
pub use state_feedback::StateFeedback;
pub use turns::within_half_a_turn;

use nalgebra::SVector;

use crate::error::Error;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// What a robot is to do now: a position, and how it changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference<T, const NQ: usize, const NV: usize> {
    /// The desired configuration `q_d`.
    pub q: SVector<T, NQ>,
    /// The desired velocity `v_d`.
    pub v: SVector<T, NV>,
    /// The desired acceleration `a_d`.
    pub a: SVector<T, NV>,
}

impl<T: Scalar, const NQ: usize, const NV: usize> Reference<T, NQ, NV> {
    /// To stay at `q`.
    #[must_use]
    pub fn rest(q: SVector<T, NQ>) -> Self {
        Self { q, v: SVector::zeros(), a: SVector::zeros() }
    }

    /// `Ok` if every entry is finite.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`] with `q`, `v` or `a` and the index.
    pub fn check(&self) -> Result<(), Error> {
        Error::unless_finite("q", &self.q)?;
        Error::unless_finite("v", &self.v)?;
        Error::unless_finite("a", &self.a)
    }

    /// `e = q_d ⊖ q` and `ė = v_d − v`.
    fn errors<R>(&self, robot: &R, state: &State<T, NQ, NV>) -> (SVector<T, NV>, SVector<T, NV>)
    where
        R: Configuration<T, NQ, NV> + ?Sized,
    {
        (robot.difference(&state.q, &self.q), self.v - state.v)
    }
}

/// `K_p·e + K_d·ė`
fn pulled<T: Scalar, const N: usize>(
    [proportional, derivative]: [&SVector<T, N>; 2],
    (error, rate): &(SVector<T, N>, SVector<T, N>),
) -> SVector<T, N> {
    scaled(derivative, rate) + scaled(proportional, error)
}

/// `x` entry by entry times `gains`.
fn scaled<T: Scalar, const N: usize>(gains: &SVector<T, N>, x: &SVector<T, N>) -> SVector<T, N> {
    let mut scaled = *x;
    for (x, gain) in scaled.iter_mut().zip(gains) {
        *x *= *gain;
    }
    scaled
}
