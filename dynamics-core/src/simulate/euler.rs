//! The semi-implicit Euler method.

use nalgebra::SVector;

use super::{Explicit, Integrator};
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// `v₁ = v + h·a(q, v)`, `q₁ = q ⊕ h·v₁`: order 1, one evaluation of the dynamics.
///
/// The method of most simulators. Where M is constant and forces depend on `q` alone it is symplectic, and the energy
/// error stays bounded; otherwise that holds approximately.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SemiImplicitEuler;

impl Explicit for SemiImplicitEuler {}

impl Integrator for SemiImplicitEuler {
    const ORDER: u32 = 1;

    #[inline]
    fn step<R, T, const NQ: usize, const NV: usize>(
        &self,
        robot: &R,
        time: T,
        state: &State<T, NQ, NV>,
        step: T,
        mut input: impl FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
    ) -> Result<State<T, NQ, NV>, Error>
    where
        R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV>,
        T: Scalar,
    {
        let tau = input(time, state);
        let v = state.v + robot.forward_dynamics(&state.q, &state.v, &tau) * step;
        Ok(State { q: robot.integrate(&state.q, &(v * step)), v })
    }
}
