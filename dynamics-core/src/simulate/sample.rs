//! One moment of a simulation.

use core::fmt;
use core::ops::Add;

use crate::dynamics::Dynamics;
use crate::scalar::Scalar;
use crate::state::State;

/// A moment of a simulation: when, and in which state; the energy is computed when asked for.
pub struct Sample<'r, R, T, const NQ: usize, const NV: usize> {
    /// The time since the start, in s.
    pub time: T,
    /// The state at that time.
    pub state: State<T, NQ, NV>,
    pub(super) robot: &'r R,
}

impl<R, T: Scalar, const NQ: usize, const NV: usize> Sample<'_, R, T, NQ, NV>
where
    R: Dynamics<T, NQ, NV>,
{
    /// The kinetic, potential and elastic energy, in J.
    #[must_use]
    pub fn energy(&self) -> Energy<T> {
        let State { q, v } = &self.state;
        Energy {
            kinetic: self.robot.kinetic_energy(q, v),
            potential: self.robot.potential_energy(q),
            elastic: self.robot.elastic_energy(q),
        }
    }
}

impl<R, T: Copy, const NQ: usize, const NV: usize> Clone for Sample<'_, R, T, NQ, NV> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<R, T: Copy, const NQ: usize, const NV: usize> Copy for Sample<'_, R, T, NQ, NV> {}

impl<R, T: fmt::Debug, const NQ: usize, const NV: usize> fmt::Debug for Sample<'_, R, T, NQ, NV> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sample").field("time", &self.time).field("state", &self.state).finish_non_exhaustive()
    }
}

/// The mechanical energy of a robot, in J.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Energy<T> {
    /// `½ vᵀ·M·v`.
    pub kinetic: T,
    /// `V(q)`, of gravity and the robot's own potentials.
    pub potential: T,
    /// That of springs in joints.
    pub elastic: T,
}

impl<T: Copy + Add<Output = T>> Energy<T> {
    /// The sum of all, in J.
    #[must_use]
    pub fn total(&self) -> T {
        self.kinetic + self.potential + self.elastic
    }
}
