//! A variational integrator: Störmer's and Verlet's method, for mass matrices that vary and on manifolds.

use nalgebra::SVector;

use super::numbers::{is_at_most, rounding};
use super::{Integrator, Method};
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::product::{dot, product, transposed_product};
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// The variational method of the trapezoidal rule: order 2, symplectic, reversible in time.
///
/// It makes stationary not the action but a sum, `Σ h/2·(L(q₀, ξ/h) + L(q₁, ξ/h))` with `q₁ = q₀ ⊕ ξ`, and is exact for
/// that. So the energy of an unforced robot swings about its value and does not drift, over any number of steps; and a
/// momentum that a symmetry conserves (that of a body in free flight, that about a vertical first axis) stays to
/// rounding. Passive forces and inputs enter as the virtual work that they do at both ends of the step; the input is
/// asked there, with the mean velocity `ξ/h` of the step in the state.
///
/// A step solves `p₀ = π − h/2·e(q₀)` for ξ, and then `p₁ = π + h/2·e(q₁)`, where `p = M·v`,
/// `π = ½·(Dᵀ(ξ)·M(q₀) + Dᵀ(−ξ)·M(q₁))·ξ/h`, `D` is the map of [`Configuration::rate`], and
/// `e(q) = Cᵀ(q, ξ/h)·ξ/h − G + τ − passive forces`. Where M is constant on a vector space that is Störmer's and
/// Verlet's explicit method.
///
/// # Errors
///
/// [`Error::NotConverged`] if a step is so large that its equations are not solved: about where the mass matrix
/// or the forces of dampers change their size within it.
///
/// # Cost
///
/// Two inverses of M; and, some 3 to 8 times, `mass_matrix`, `coriolis_matrix` and `passive_forces`.
///
/// # Source
///
/// J. Marsden, M. West, *Discrete mechanics and variational integrators*, Acta Numerica 10 (2001) 357–514;
/// N. Bou-Rabee, J. Marsden, *Hamilton–Pontryagin integrators on Lie groups*, Found. Comput. Math. 9 (2009) 197–219.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Variational;

/// Each iteration must shorten the error to half its length, which leaves the last bit of an `f64`.
const MOST_ITERATIONS: usize = 50;

impl Method for Variational {
    const ORDER: u32 = 2;
}

impl Integrator for Variational {
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
        let half = step * T::of(0.5);
        let mut force = |time: T, q: &SVector<T, NQ>, v: &SVector<T, NV>| {
            input(time, &State { q: *q, v: *v }) - robot.passive_forces(q, v)
        };
        let mass_matrix = robot.mass_matrix(&state.q);
        let inverse = robot.inverse_mass_matrix(&state.q);
        let weight = robot.gravity_forces(&state.q);
        let momentum = product(&mass_matrix, &state.v);
        // What rounding the forces may be felt by, as twice an energy.
        let pushed = force(time, &state.q, &state.v);
        let floor = (dot(&weight, &product(&inverse, &weight)) + dot(&pushed, &product(&inverse, &pushed)))
            * (step * step);

        let mut v = state.v; // ξ/h
        let mut last = None;
        for iterations in 1..=MOST_ITERATIONS {
            let xi = v * step;
            let ours = product(&mass_matrix, &v);
            let theirs = product(&robot.mass_matrix(&robot.integrate(&state.q, &xi)), &v);
            let mean =
                (robot.rate_transposed(&xi, &ours) + robot.rate_transposed(&-xi, &theirs)) * T::of(0.5);
            let inertial = transposed_product(&robot.coriolis_matrix(&state.q, &v), &v);
            let kick = (inertial - weight + force(time, &state.q, &v)) * half;
            let residual = momentum + kick - mean;
            let correction = product(&inverse, &residual);
            v += correction;
            let finite = Error::unless_finite("v", &v);
            // What was finite at first has run away.
            finite
                .map_err(|error| if iterations > 1 { Error::NotConverged { iterations } } else { error })?;
            let error = dot(&residual, &correction);
            let size = floor + dot(&momentum, &state.v) + dot(&v, &product(&mass_matrix, &v));
            if is_solved(error, last, size) {
                let q = robot.integrate(&state.q, &(v * step));
                let inertial = transposed_product(&robot.coriolis_matrix(&q, &v), &v);
                let kicks = kick + (inertial - robot.gravity_forces(&q) + force(time + step, &q, &v)) * half;
                return Ok(State { q, v: velocity(robot, &q, &(momentum + kicks)) });
            }
            last = Some(error);
        }
        Err(Error::NotConverged { iterations: MOST_ITERATIONS })
    }
}

/// `M⁻¹·p`, with one correction, so that `M·v` is `p` to rounding whatever the condition of M.
fn velocity<R, T, const NQ: usize, const NV: usize>(
    robot: &R,
    q: &SVector<T, NQ>,
    momentum: &SVector<T, NV>,
) -> SVector<T, NV>
where
    R: Dynamics<T, NQ, NV>,
    T: Scalar,
{
    let inverse = robot.inverse_mass_matrix(q);
    let v = product(&inverse, momentum);
    v + product(&inverse, &(momentum - product(&robot.mass_matrix(q), &v)))
}

/// Whether the correction, whose size in the metric of M has the square `error`, is one of the last bits of motions of
/// the square `size`; or as near to them as the condition of M lets it come, and not shrinking any more.
fn is_solved<T: Scalar>(error: T, last: Option<T>, size: T) -> bool {
    let of_bits = |bits: f64| {
        let bits = T::of(bits) * rounding::<T>();
        size * (bits * bits)
    };
    let stands = last.is_some_and(|last| is_at_most(last, error * T::of(4.0)));
    is_at_most(error, of_bits(4.0)) || stands && is_at_most(error, of_bits(16384.0))
}
