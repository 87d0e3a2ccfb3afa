//! Why there is no trim.

use core::fmt;

use super::Trimmed;
use crate::error::Error;
use crate::scalar::Scalar;

/// Why a search for a [trim](crate::trim) found none, with the best state that it came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TrimFailure<T, const NQ: usize, const NV: usize, const NU: usize> {
    /// There is none near the guess: whatever is free, no small change of it makes the residual smaller. It is no
    /// statement on places far away; another guess may have one.
    NoEquilibrium(Trimmed<T, NQ, NV, NU>),
    /// The residual was still getting smaller when the limit of steps came.
    NotConverged(Trimmed<T, NQ, NV, NU>),
    /// The search did not begin: a guess or a target is not finite, a quaternion is not of unit length, a joint is not
    /// one of the robot's; or the equations are not finite at the guess.
    Invalid(Error),
}

impl<T, const NQ: usize, const NV: usize, const NU: usize> From<TrimFailure<T, NQ, NV, NU>> for Error {
    fn from(failure: TrimFailure<T, NQ, NV, NU>) -> Self {
        match failure {
            TrimFailure::NoEquilibrium(_) => Self::NoEquilibrium,
            TrimFailure::NotConverged(best) => Self::NotConverged { iterations: best.iterations },
            TrimFailure::Invalid(error) => error,
        }
    }
}

impl<T: Scalar, const NQ: usize, const NV: usize, const NU: usize> fmt::Display
    for TrimFailure<T, NQ, NV, NU>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let best = match self {
            Self::NoEquilibrium(best) => {
                f.write_str("there is no equilibrium near the guess; at best")?;
                best
            }
            Self::NotConverged(best) => {
                let steps = best.iterations;
                write!(f, "not converged at step {steps}: allow more, or guess nearer; so far")?;
                best
            }
            Self::Invalid(error) => return error.fmt(f),
        };
        // No negative zeros.
        let [q] = best.state.q.data.0.map(|q| q.map(|q| q + T::zero()));
        let [forces] = best.imbalance.data.0.map(|forces| forces.map(|force| force + T::zero()));
        write!(f, " forces {forces:?} are left at q = {q:?}")?;
        if best.miss.is_zero() { Ok(()) } else { write!(f, ", and the outputs miss by {:?}", best.miss) }
    }
}

impl<T: Scalar, const NQ: usize, const NV: usize, const NU: usize> core::error::Error
    for TrimFailure<T, NQ, NV, NU>
{
}
