//! Feedback of the whole state about a point.

use nalgebra::{SMatrix, SVector};

use crate::product::product;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// `u = u₀ − K·(q ⊖ q₀, v − v₀)`: the gains of a linear model about `(q₀, v₀, u₀)`, in its tangent space.
///
/// `x` is that of [`StateSpace`](crate::StateSpace) and [`linearize`](crate::StateSpaceModel::linearize), so gains that
/// were found for their `A` and `B` are right here, of ball and free joints too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StateFeedback<T, const NQ: usize, const NV: usize, const NX: usize, const NU: usize> {
    /// `(q₀, v₀)`.
    pub state: State<T, NQ, NV>,
    /// `u₀`, in N·m or N.
    pub u: SVector<T, NU>,
    /// `K`, NU×NX.
    pub gain: SMatrix<T, NU, NX>,
}

impl<T: Scalar, const NQ: usize, const NV: usize, const NX: usize, const NU: usize>
    StateFeedback<T, NQ, NV, NX, NU>
{
    /// The deviation `x = (q ⊖ q₀, v − v₀)`, NX.
    #[inline]
    pub fn deviation<R>(&self, robot: &R, state: &State<T, NQ, NV>) -> SVector<T, NX>
    where
        R: Configuration<T, NQ, NV> + ?Sized,
    {
        const { assert!(NX == 2 * NV, "the state x = (q, v) has 2·NV entries") };
        let displacement = robot.difference(&self.state.q, &state.q);
        let speed = state.v - self.state.v;
        let mut deviation = SVector::<T, NX>::zeros();
        for (entry, x) in deviation.iter_mut().zip(displacement.iter().chain(&speed)) {
            *entry = *x;
        }
        deviation
    }

    /// The input `u`, NU.
    #[inline]
    pub fn input<R>(&self, robot: &R, state: &State<T, NQ, NV>) -> SVector<T, NU>
    where
        R: Configuration<T, NQ, NV> + ?Sized,
    {
        self.u - product(&self.gain, &self.deviation(robot, state))
    }
}
