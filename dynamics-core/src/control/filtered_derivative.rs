//! Speeds from measured positions.

use nalgebra::SVector;

use crate::scalar::Scalar;
use crate::state::Configuration;

/// The derivative of measured positions through a low pass of first order, `s/(1 + s/ω)`, by Tustin's rule.
///
/// It remembers the last position and speed. On ball and free joints the difference is taken by `⊖`, so that what comes
/// out is a velocity in the body, as `v` is. A constant speed is given exactly, once the filter has settled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilteredDerivative<T, const NQ: usize, const NV: usize> {
    /// The cut-off `ω` in rad/s.
    cutoff: T,
    last: SVector<T, NQ>,
    speed: SVector<T, NV>,
}

impl<T: Scalar, const NQ: usize, const NV: usize> FilteredDerivative<T, NQ, NV> {
    /// A filter at rest at `q`, with the cut-off `ω` in rad/s.
    #[must_use]
    pub fn new(q: SVector<T, NQ>, cutoff: T) -> Self {
        Self { cutoff, last: q, speed: SVector::zeros() }
    }

    /// The speed now, NV.
    #[must_use]
    pub const fn speed(&self) -> &SVector<T, NV> {
        &self.speed
    }

    /// Takes the position `q`, measured `step` seconds after the last one, and gives the speed, NV.
    ///
    /// `v ← ((2 − ωh)·v + 2ω·(q ⊖ q_last))/(2 + ωh)`, stable for each step `h`.
    #[inline]
    pub fn update<R>(&mut self, robot: &R, q: &SVector<T, NQ>, step: T) -> SVector<T, NV>
    where
        R: Configuration<T, NQ, NV> + ?Sized,
    {
        let moved = robot.difference(&self.last, q);
        let (two, advance) = (T::of(2.0), self.cutoff * step);
        for (speed, moved) in self.speed.iter_mut().zip(&moved) {
            *speed = ((two - advance) * *speed + two * self.cutoff * *moved) / (two + advance);
        }
        self.last = *q;
        self.speed
    }
}
