//! The classical Runge–Kutta method of order 4, in a form that also holds on a manifold.

use super::flow::{Flow, Vector};
use super::{Explicit, Method};
use crate::scalar::Scalar;

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

impl Method for Rk4 {
    const ORDER: u32 = 4;
}

impl Explicit for Rk4 {
    #[inline]
    fn follow<F: Flow>(
        &self,
        flow: &mut F,
        time: F::Scalar,
        (q, v1): (&F::Position, &F::Velocity),
        step: F::Scalar,
    ) -> (F::Position, F::Velocity) {
        let part = |of_step: f64| step * F::Scalar::of(of_step);
        let (half, end) = (part(0.5), time + step);

        let a1 = flow.acceleration(time, q, v1);
        let v2 = v1.clone().plus(half, &a1);
        let q2 = flow.integrate(q, &v1.times(half));
        let a2 = flow.acceleration(time + half, &q2, &v2);
        let v3 = v1.clone().plus(half, &a2);
        let q3 = flow.integrate(q, &v2.times(half));
        let a3 = flow.acceleration(time + half, &q3, &v3);
        let v4 = v1.clone().plus(step, &a3);
        let q4 = flow.integrate(&q2, &v3.times(step).plus(-half, v1));
        let a4 = flow.acceleration(end, &q4, &v4);

        let [one, two, three] = [1.0 / 12.0, 1.0 / 6.0, 0.25].map(part);
        let middle = v2.times(two).plus(two, &v3);
        let first = middle.clone().plus(three, v1).plus(-one, &v4);
        let second = middle.plus(three, &v4).plus(-one, v1);
        let (sixth, third) = (part(1.0 / 6.0), part(1.0 / 3.0));
        (
            flow.integrate(&flow.integrate(q, &first), &second),
            v1.clone().plus(sixth, &a1).plus(third, &a2).plus(third, &a3).plus(sixth, &a4),
        )
    }
}
