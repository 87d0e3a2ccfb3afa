//! Joint forces within limits.

use nalgebra::SVector;

use crate::mechanism::Mechanism;
use crate::scalar::Scalar;

/// `τ` within ±[`effort`](crate::JointLimits::effort) of each joint, and whether all of it was, NV.
///
/// A force that is NaN stays so. An integral should wait while the answer is `false`.
#[inline]
pub fn saturated<R, T, const NV: usize>(robot: &R, tau: &SVector<T, NV>) -> (SVector<T, NV>, bool)
where
    R: Mechanism + ?Sized,
    T: Scalar + PartialOrd,
{
    let _ = robot;
    let mut within = *tau;
    for (tau, limits) in within.iter_mut().zip(R::LIMITS) {
        *tau = clamped(*tau, T::of(-limits.effort), T::of(limits.effort));
    }
    (within, within == *tau)
}

/// The nearest number to `x` between two.
pub(super) fn clamped<T: PartialOrd>(x: T, least: T, most: T) -> T {
    if x < least {
        least
    } else if x > most {
        most
    } else {
        x
    }
}
