//! The interface of a fixed-step integrator.

use nalgebra::SVector;

use crate::dynamics::Dynamics;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// One step of a method for `q̇ = v`, `v̇ = M⁻¹·(τ − h)`.
///
/// Configurations move by [`Configuration::integrate`], so that quaternions stay of unit length.
pub trait Integrator {
    /// The order of the global error: halving the step divides it by `2^ORDER`.
    const ORDER: u32;

    /// The state `step` seconds after `time`, under the joint forces `τ = input(time, state)`.
    fn step<R, T, const NQ: usize, const NV: usize>(
        &self,
        robot: &R,
        time: T,
        state: &State<T, NQ, NV>,
        step: T,
        input: impl FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
    ) -> State<T, NQ, NV>
    where
        R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV>,
        T: Scalar;
}
