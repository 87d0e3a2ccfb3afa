//! A variational integrator: Störmer's and Verlet's method, for mass matrices that vary and on manifolds.

use nalgebra::SVector;

use super::numbers::{is_at_most, rounding};
use super::turns::{Turns, Way};
use super::{Integrator, Method};
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::product::{dot, product, transposed_product};
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// The variational method of the trapezoidal rule: order 2, symplectic, reversible in time.
///
/// It makes stationary not the action but a sum, `Σ h/2·(L(q₀, v₀) + L(q₁, v₁))`, and is exact for that. There `v₀` is the
/// mean velocity of the step: `q₁ = q₀ ⊕ h·λ ⊕ h·ω`, of the slides λ and then the turns ω in it, so that the origin of a
/// free body's frame goes straight; and `v₁` is the same one in the axes at the end. So the energy of an unforced
/// robot swings about its value and does not drift, as long as steps are solved and small against the periods of the
/// motion. Passive forces and inputs enter as the virtual work that they do at both ends of the step; the input is asked
/// there, with `v₀` and `v₁` in the state.
///
/// A step solves `p₀ = π₀ − h/2·e(q₀, v₀)` for `v₀`, and then `p₁ = π₁ + h/2·e(q₁, v₁)`, where `p = M·v`,
/// `e(q, v) = Cᵀ(q, v)·v − G + τ − passive forces`, and π is `½·(M(q₀)·v₀ + M(q₁)·v₁)`, but for what quaternions bring. Where M
/// is constant on a vector space that is Störmer's and Verlet's explicit method.
///
/// # Momentum
///
/// What a symmetry of L conserves stays to rounding, at any step (E. Noether's theorem, of the sum):
///
/// - of a robot on a free base without gravity, the linear momentum and the angular one about the world's origin, and so
///   about any fixed point; under gravity the linear one changes by the weight times the time, and the angular one about
///   vertical axes of the world stays;
/// - that of a first joint about a vertical axis;
/// - of a single free body whose frame is at its centre of mass, the angular one about the centre of mass too, under
///   gravity too: the centre flies its parabola to rounding, at any speed.
///
/// The angular momentum about the centre of mass of any other robot is kept to the order of the method only, and by what
/// the free base flies at, less well: the theorem holds of what translations and turns conserve, and the centre of
/// mass then does not go exactly where the momentum says.
///
/// # Errors
///
/// [`Error::NotConverged`] if a step is so large that its equations are not solved: about where the mass matrix, the
/// forces of dampers or gyroscopic torques change their size within it, as the mass matrix of a universal joint does near
/// where its axes fold together; and where a free base flies so fast that `h²·|v|·|ω|·r` comes to the square of its radius
/// of gyration, for the distance r of its frame from the centre of mass of the robot. For a single body with the frame
/// there, no speed is too large.
///
/// # Cost
///
/// Two inverses of M; and, some 3 to 8 times, `mass_matrix`, `coriolis_matrix` and `passive_forces`. Once per step,
/// `2·NV` times `rate`, by which it finds out which speeds turn quaternions.
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

        let turns = Turns::of(robot);
        let mut v = state.v; // ξ/h
        let mut last = None;
        for iterations in 1..=MOST_ITERATIONS {
            let way = turns.way(robot, &state.q, &v, step);
            let ours = product(&mass_matrix, &v);
            let theirs = product(&robot.mass_matrix(&way.q), &way.v);
            let inertial = transposed_product(&robot.coriolis_matrix(&state.q, &v), &v);
            let kick = (inertial - weight + force(time, &state.q, &v)) * half;
            let residual = momentum + kick - turns.mean_momentum(robot, &way, [&ours, &theirs]);
            let correction = product(&inverse, &residual);
            v += correction;
            let finite = Error::unless_finite("v", &v);
            // What was finite at first has run away.
            finite
                .map_err(|error| if iterations > 1 { Error::NotConverged { iterations } } else { error })?;
            let error = dot(&residual, &correction);
            let size = floor + dot(&momentum, &state.v) + dot(&v, &product(&mass_matrix, &v));
            if is_solved(error, last, size) {
                let way @ Way { q, v, .. } = turns.way(robot, &state.q, &v, step);
                let inertial = transposed_product(&robot.coriolis_matrix(&q, &v), &v);
                let carried = turns.carried_momentum(robot, &way, &(momentum + kick), [&ours, &theirs]);
                let last_kick = (inertial - robot.gravity_forces(&q) + force(time + step, &q, &v)) * half;
                return Ok(State { q, v: velocity(robot, &q, &(carried + last_kick)) });
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
