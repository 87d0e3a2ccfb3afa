//! The interface of a fixed-step integrator.

use nalgebra::SVector;

use super::flow::{Driven, Flow};
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// A method that goes on by steps of a given size.
pub trait Method {
    /// The order of the global error: halving the step divides it by `2^ORDER`.
    const ORDER: u32;
}

/// One step of a method for `q̇ = v`, `v̇ = M⁻¹·(τ − h)`.
///
/// Configurations move by [`Configuration::integrate`], so that quaternions stay of unit length. Each [`Explicit`] method
/// is one of these.
pub trait Integrator: Method {
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

/// A method whose steps cannot fail, and take the same operations whatever the numbers: in lanes each rollout has the bits
/// that it has alone.
pub trait Explicit: Method {
    /// Positions and velocities `step` seconds after `time`, along a flow.
    fn follow<F: Flow>(
        &self,
        flow: &mut F,
        time: F::Scalar,
        from: (&F::Position, &F::Velocity),
        step: F::Scalar,
    ) -> (F::Position, F::Velocity);

    /// The state `step` seconds after `time`, under the joint forces `τ = input(time, state)`.
    ///
    /// What is not finite comes out as not finite.
    #[inline]
    fn next<R, T, const NQ: usize, const NV: usize>(
        &self,
        robot: &R,
        time: T,
        state: &State<T, NQ, NV>,
        step: T,
        input: impl FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
    ) -> State<T, NQ, NV>
    where
        R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV>,
        T: Scalar,
    {
        let (q, v) = self.follow(&mut Driven::new(robot, input), time, (&state.q, &state.v), step);
        State { q, v }
    }
}

impl<M: Explicit> Integrator for M {
    #[inline]
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
        T: Scalar,
    {
        Ok(self.next(robot, time, state, step, input))
    }
}
