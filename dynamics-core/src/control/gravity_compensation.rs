//! Proportional and derivative feedback on a robot that holds its own weight.

use nalgebra::SVector;

use super::{Reference, pulled};
use crate::dynamics::Dynamics;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// `τ = G(q) + F(q, v_d) + K_p·e + K_d·ė`, with `F` for the [passive forces](Dynamics::passive_forces) at the desired speed:
/// those of springs at rest, of dampers and friction on the way.
///
/// At rest it needs no inertias but those in `G`, and is stable for all positive gains: the energy
/// `½ vᵀ·M·v + ½ eᵀ·K_p·e` never increases, as `C` has no power. Gains are per joint: `k_p` in N·m/rad or N/m, `k_d` in
/// N·m·s/rad or N·s/m.
///
/// # Source
///
/// M. Takegaki, S. Arimoto, *A new feedback method for dynamic control of manipulators*, ASME J. Dynamic Systems,
/// Measurement and Control 103 (1981); Murray, Li, Sastry, §4.5.3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GravityCompensation<T, const NV: usize> {
    /// `K_p`, in N·m/rad or N/m.
    pub proportional: SVector<T, NV>,
    /// `K_d`, in N·m·s/rad or N·s/m.
    pub derivative: SVector<T, NV>,
}

impl<T: Scalar, const NV: usize> GravityCompensation<T, NV> {
    /// The joint forces, NV. The reference's acceleration is not used.
    ///
    /// # Cost
    ///
    /// One `gravity_forces`, one `passive_forces`.
    #[inline]
    pub fn torque<R, const NQ: usize>(
        &self,
        robot: &R,
        state: &State<T, NQ, NV>,
        reference: &Reference<T, NQ, NV>,
    ) -> SVector<T, NV>
    where
        R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV> + ?Sized,
    {
        robot.gravity_forces(&state.q)
            + robot.passive_forces(&state.q, &reference.v)
            + pulled([&self.proportional, &self.derivative], &reference.errors(robot, state))
    }
}
