//! The interface of a fixed-step integrator.

use nalgebra::SVector;

use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// One step of a method for `q̇ = v`, `v̇ = M⁻¹·(τ − h)`.
///
/// Configurations move by [`Configuration::integrate`], so that quaternions stay of unit length.
pub trait Integrator {
    /// The order of the global error: halving the step divides it by `2^ORDER`.
    const ORDER: u32;

    /// The state `step` seconds after `time`, under the joint forces `τ = input(time, state)`.
    ///
    /// A state that is not finite need not be noticed here; [`Simulation`](super::Simulation) does that.
    ///
    /// # Errors
    ///
    /// Of methods that solve equations, [`Error::NotConverged`]. Explicit methods have none.
    fn step<R, T, const NQ: usize, const NV: usize>(
        &self,
        robot: &R,
        time: T,
        state: &State<T, NQ, NV>,
        step: T,
        input: impl FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
    ) -> Result<State<T, NQ, NV>, Error>
    where
        R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV>,
        T: Scalar;
}

/// An integrator whose steps cannot fail, and take the same operations whatever the numbers: in lanes each rollout has
/// the bits that it has alone.
pub trait Explicit: Integrator {}
