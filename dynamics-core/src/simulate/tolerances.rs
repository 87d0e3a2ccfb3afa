//! How exact an adaptive step must be.

use super::numbers::{larger, magnitude};
use crate::error::Error;
use crate::scalar::Scalar;

/// The error that a step may have: in each coordinate `absolute + relative·size`.
///
/// The error is that of a tangent vector `(δ, v)`, in rad and m, rad/s and m/s, and so has a meaning for quaternions. The
/// size of δ is the way of the step, that of v the speed: neither depends on where zero is.
///
/// `f64` serves about 1e-14, `f32` about 1e-6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances<T> {
    /// The error of what stands still, in rad and m, rad/s and m/s.
    pub absolute: T,
    /// The share of what moves.
    pub relative: T,
}

impl<T: Scalar + PartialOrd> Tolerances<T> {
    /// `absolute` and `relative` both.
    #[must_use]
    pub const fn of(both: T) -> Self {
        Self { absolute: both, relative: both }
    }

    /// `Ok` if neither is negative, and one is positive.
    pub(super) fn check(&self) -> Result<(), Error> {
        let Self { absolute, relative } = *self;
        let zero = T::zero();
        let sound = absolute >= zero && relative >= zero && absolute + relative > zero;
        let finite = absolute.is_finite() && relative.is_finite();
        if sound && finite { Ok(()) } else { Err(Error::ToleranceNotPositive) }
    }

    /// The root of the mean square of `x` in units of what the sizes allow; infinite where that is zero and `x` not.
    pub(super) fn norm<const K: usize>(&self, parts: [Part<'_, T>; K]) -> T {
        let (mut sum, mut count) = (T::zero(), T::zero());
        for Part { x, sizes: [from, to] } in parts {
            for ((x, from), to) in x.iter().zip(from).zip(to) {
                count += T::one();
                if !x.is_zero() {
                    let size = larger(magnitude(*from), magnitude(*to));
                    let share = *x / size.mul_add(self.relative, self.absolute);
                    sum = share.mul_add(share, sum);
                }
            }
        }
        (sum / count).sqrt()
    }
}

/// Some coordinates, and their values before and after the step.
pub(super) struct Part<'a, T> {
    pub(super) x: &'a [T],
    pub(super) sizes: [&'a [T]; 2],
}
