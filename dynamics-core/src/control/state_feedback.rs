//! Feedback of the whole state about a point.

use nalgebra::{SMatrix, SVector};

use super::within_half_a_turn;
use crate::linearize::StateSpaceModel;
use crate::product::product;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// `u = u₀ − K·(q ⊖ q₀, v − v₀)`: the gains of a linear model about `(q₀, v₀, u₀)`, in its tangent space.
///
/// `x` is that of [`StateSpace`](crate::StateSpace) and [`linearize`](crate::StateSpaceModel::linearize), so gains that
/// were found for their `A` and `B` are right here, of ball and free joints too. What the joints are given is
/// [`torque`](Self::torque), `τ = B_u·u`.
///
/// # Example
///
#[cfg_attr(feature = "derive", doc = "```")]
#[cfg_attr(not(feature = "derive"), doc = "```ignore")]
/// use core::f64::consts::TAU;
/// use dynamics_core::control::StateFeedback;
/// use dynamics_core::linear::Weights;
/// use dynamics_core::prelude::*;
///
/// #[derive(Dynamics)]
/// #[joint(slider: prismatic(x), world -> cart)]
/// #[body(cart, solid = cuboid(1, [300mm, 200mm, 100mm]))]
/// #[joint(hinge: continuous(y), cart -> pole, actuated = off)]
/// #[body(pole, com = [0, 0, 0.5], solid = cylinder(100g, 5mm, 1))]
/// struct CartPole;
///
/// let (upright, still) = (State::rest(SVector::zeros()), SVector::zeros());
/// let plant = StateSpace::from(CartPole.linearize(&upright.q, &upright.v, &still));
/// let gain = plant.lqr(&Weights::diagonal([1.0, 10.0, 0.1, 0.1], [0.1]))?.gain;
/// let feedback = StateFeedback::new(upright, still, gain).wrapping([false, true]);
///
/// // A turn and a little: it is caught where it is, and not wound back.
/// let mut simulation = Simulation::new(&CartPole, State::rest(SVector::from([0.0, TAU + 0.2])), 1e-2)?;
/// for _ in 0..1000 {
///     let tau = feedback.torque(&CartPole, simulation.state());
///     simulation.step_with(&tau)?;
/// }
/// assert!((simulation.state().q[1] - TAU).abs() < 1e-2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StateFeedback<T, const NQ: usize, const NV: usize, const NX: usize, const NU: usize> {
    /// `(q₀, v₀)`.
    pub state: State<T, NQ, NV>,
    /// `u₀`, in N·m or N.
    pub u: SVector<T, NU>,
    /// `K`, NU×NX.
    pub gain: SMatrix<T, NU, NX>,
    /// Of which joints whole turns are taken out of the deviation, by their places in `v`.
    pub wraps: [bool; NV],
}

impl<T: Scalar, const NQ: usize, const NV: usize, const NX: usize, const NU: usize>
    StateFeedback<T, NQ, NV, NX, NU>
{
    /// The feedback `K` about `(q₀, v₀, u₀)`. Whole turns count, as they do for `⊖`.
    #[must_use]
    pub const fn new(state: State<T, NQ, NV>, u: SVector<T, NU>, gain: SMatrix<T, NU, NX>) -> Self {
        Self { state, u, gain, wraps: [false; NV] }
    }

    /// The same, with the deviation of these joints within half a turn, by their places in `v`.
    ///
    /// For a joint that is where it was after a whole turn. One with limits, a spring, a screw or a cable is not; one that
    /// slides has no turns.
    #[must_use]
    pub const fn wrapping(self, wraps: [bool; NV]) -> Self {
        Self { wraps, ..self }
    }

    /// The deviation `x = (q ⊖ q₀, v − v₀)`, NX.
    #[inline]
    pub fn deviation<R>(&self, robot: &R, state: &State<T, NQ, NV>) -> SVector<T, NX>
    where
        R: Configuration<T, NQ, NV> + ?Sized,
    {
        const { assert!(NX == 2 * NV, "the state x = (q, v) has 2·NV entries") };
        let mut displacement = robot.difference(&self.state.q, &state.q);
        for (angle, wraps) in displacement.iter_mut().zip(self.wraps) {
            if wraps {
                *angle = within_half_a_turn(*angle);
            }
        }
        let speed = state.v - self.state.v;
        let mut deviation = SVector::<T, NX>::zeros();
        for (entry, x) in deviation.iter_mut().zip(displacement.iter().chain(&speed)) {
            *entry = *x;
        }
        deviation
    }

    /// The input `u`, NU: one for each motor.
    #[inline]
    pub fn input<R>(&self, robot: &R, state: &State<T, NQ, NV>) -> SVector<T, NU>
    where
        R: Configuration<T, NQ, NV> + ?Sized,
    {
        self.u - product(&self.gain, &self.deviation(robot, state))
    }

    /// The joint forces `τ = B_u·u`, NV: zero where there is no motor.
    #[inline]
    pub fn torque<R>(&self, robot: &R, state: &State<T, NQ, NV>) -> SVector<T, NV>
    where
        R: StateSpaceModel<T, NQ, NV, NX, NU> + ?Sized,
    {
        product(&robot.input_map(), &self.input(robot, state))
    }
}
