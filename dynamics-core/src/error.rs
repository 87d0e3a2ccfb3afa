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
    /// A field of the robot is infinite or NaN.
    ParameterNotFinite {
        /// The field's name.
        field: &'static str,
    },
    /// A field of the robot that is a mass is zero or negative.
    MassNotPositive {
        /// The field's name.
        field: &'static str,
    },
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

impl Error {
    /// `Ok` if the field of a robot is finite. Called by the generated `check`.
    ///
    /// # Errors
    ///
    /// [`Error::ParameterNotFinite`].
    #[inline]
    pub fn unless_finite_parameter<T: Scalar>(field: &'static str, value: T) -> Result<(), Self> {
        if value.is_finite() { Ok(()) } else { Err(Self::ParameterNotFinite { field }) }
    }

    /// `Ok` if the field of a robot, a mass in kg, is finite and greater than zero. Called by the generated
    /// `check`.
    ///
    /// # Errors
    ///
    /// [`Error::ParameterNotFinite`], [`Error::MassNotPositive`].
    #[inline]
    pub fn unless_positive_mass<T: Scalar + PartialOrd>(field: &'static str, value: T) -> Result<(), Self> {
        Self::unless_finite_parameter(field, value)?;
        if value > T::zero() { Ok(()) } else { Err(Self::MassNotPositive { field }) }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { vector, index } => write!(f, "{vector}[{index}] is not finite"),
            Self::SingularMassMatrix => f.write_str("the mass matrix is singular"),
            Self::StepNotPositive => f.write_str("the time step is not positive and finite"),
            Self::ParameterNotFinite { field } => write!(f, "the parameter `{field}` is not finite"),
            Self::MassNotPositive { field } => write!(f, "the mass `{field}` is not positive"),
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
        let negative = Error::unless_positive_mass("m2", -0.5);
        assert_eq!(negative, Err(Error::MassNotPositive { field: "m2" }));
        assert_eq!(Error::MassNotPositive { field: "m2" }.to_string(), "the mass `m2` is not positive");
        let infinite = Error::unless_positive_mass("m2", f64::INFINITY);
        assert_eq!(infinite, Err(Error::ParameterNotFinite { field: "m2" }));
        assert_eq!(Error::ParameterNotFinite { field: "l" }.to_string(), "the parameter `l` is not finite");
        assert_eq!(Error::unless_finite_parameter("l", -1.0_f32), Ok(()));
        assert_eq!(Error::SingularMassMatrix.to_string(), "the mass matrix is singular");
        assert_eq!(Error::StepNotPositive.to_string(), "the time step is not positive and finite");
    }
}
