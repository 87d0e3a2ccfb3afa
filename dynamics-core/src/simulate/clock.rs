//! A sum of steps of time.

use crate::scalar::Scalar;

/// The time since the start, in s, summed with compensation (W. Kahan), so that many steps do not add their roundings.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock<T> {
    pub(super) time: T,
    /// What rounding took from `time` so far.
    lost: T,
}

impl<T: Scalar> Clock<T> {
    /// A clock that shows `time`.
    pub(super) fn at(time: T) -> Self {
        Self { time, lost: T::zero() }
    }

    /// The clock `step` seconds later.
    pub(super) fn after(self, step: T) -> Self {
        let step = step - self.lost;
        let time = self.time + step;
        Self { time, lost: (time - self.time) - step }
    }
}
