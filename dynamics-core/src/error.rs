//! What can go wrong at run time.

use core::fmt;

use nalgebra::SVector;

use crate::scalar::Scalar;

/// A run-time failure, reported by the `try_…` methods and by [`Simulation`](crate::simulate::Simulation).
///
/// The plain methods of [`Dynamics`](crate::Dynamics) return no errors: they follow IEEE 754 and never panic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Error {
    /// An entry of an argument or of a result is infinite or NaN.
    NotFinite {
        /// The vector it stands in, by the name the methods give it: `q`, `v`, `a`, `tau`.
        vector: &'static str,
        /// Its index there, counted from 0.
        index: usize,
    },
    /// M(q) has no finite inverse, so that no finite acceleration answers the forces.
    SingularMassMatrix,
    /// A step of time is zero, negative, infinite or NaN.
    StepNotPositive,
}

impl Error {
    /// `Ok` if every entry of `x` is finite, else the first that is not, under the name `vector`.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`].
    #[inline]
    pub fn unless_finite<T: Scalar, const N: usize>(
        vector: &'static str,
        x: &SVector<T, N>,
    ) -> Result<(), Self> {
        match x.iter().position(|entry| !entry.is_finite()) {
            Some(index) => Err(Self::NotFinite { vector, index }),
            None => Ok(()),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { vector, index } => write!(f, "{vector}[{index}] is not finite"),
            Self::SingularMassMatrix => f.write_str("the mass matrix is singular"),
            Self::StepNotPositive => f.write_str("the time step is not positive and finite"),
        }
    }
}

impl core::error::Error for Error {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_state_the_fact() {
        use std::string::ToString;
        assert_eq!(Error::NotFinite { vector: "q", index: 3 }.to_string(), "q[3] is not finite");
        assert_eq!(Error::SingularMassMatrix.to_string(), "the mass matrix is singular");
        assert_eq!(Error::StepNotPositive.to_string(), "the time step is not positive and finite");
    }
}
