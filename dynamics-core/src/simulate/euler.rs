//! The semi-implicit Euler method.

use super::flow::{Flow, Vector};
use super::{Explicit, Method};

/// `v₁ = v + h·a(q, v)`, `q₁ = q ⊕ h·v₁`: order 1, one evaluation of the dynamics.
///
/// The method of most simulators. Where M is constant and forces depend on `q` alone it is symplectic, and the energy
/// error stays bounded; otherwise that holds approximately.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SemiImplicitEuler;

impl Method for SemiImplicitEuler {
    const ORDER: u32 = 1;
}

impl Explicit for SemiImplicitEuler {
    #[inline]
    fn follow<F: Flow>(
        &self,
        flow: &mut F,
        time: F::Scalar,
        (q, v): (&F::Position, &F::Velocity),
        step: F::Scalar,
    ) -> (F::Position, F::Velocity) {
        let a = flow.acceleration(time, q, v);
        let v = v.clone().plus(step, &a);
        (flow.integrate(q, &v.times(step)), v)
    }
}
