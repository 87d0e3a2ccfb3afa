//! The classical Runge–Kutta method of order 4, in a form that also holds on a manifold.

use nalgebra::SVector;

use super::{Explicit, Integrator};
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// The classical Runge–Kutta method: order 4, four evaluations of the dynamics.
///
/// For one-dof joints exactly that. With ball and free joints the textbook form would lose order, for rotations do
/// not commute; here the last stage and the result take two `⊕` each, which restores it and changes nothing else.
///
/// # Source
///
/// E. Celledoni, A. Marthinsen, B. Owren, *Commutator-free Lie group methods*, Future Generation Computer Systems
/// 19 (2003) 341–352, written for velocities in the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rk4;

impl Explicit for Rk4 {}

impl Integrator for Rk4 {
    const ORDER: u32 = 4;

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
        let mut acceleration = |time: T, stage: &State<T, NQ, NV>| {
            let tau = input(time, stage);
            robot.forward_dynamics(&stage.q, &stage.v, &tau)
        };
        let half = step * T::of(0.5);
        let State { q, v: v1 } = *state;

        let a1 = acceleration(time, state);
        let v2 = v1 + a1 * half;
        let q2 = robot.integrate(&q, &(v1 * half));
        let a2 = acceleration(time + half, &State { q: q2, v: v2 });
        let v3 = v1 + a2 * half;
        let q3 = robot.integrate(&q, &(v2 * half));
        let a3 = acceleration(time + half, &State { q: q3, v: v3 });
        let v4 = v1 + a3 * step;
        let q4 = robot.integrate(&q2, &(v3 * step - v1 * half));
        let a4 = acceleration(time + step, &State { q: q4, v: v4 });

        let twelfth = step * T::of(1.0 / 12.0);
        let middle = (v2 + v3) * T::of(2.0);
        let first = (v1 * T::of(3.0) + middle - v4) * twelfth;
        let second = (v4 * T::of(3.0) + middle - v1) * twelfth;
        Ok(State {
            q: robot.integrate(&robot.integrate(&q, &first), &second),
            v: v1 + (a1 + (a2 + a3) * T::of(2.0) + a4) * (step * T::of(1.0 / 6.0)),
        })
    }
}
