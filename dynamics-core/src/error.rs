//! What can go wrong at run time.

use core::fmt;

use nalgebra::SVector;

use crate::scalar::Scalar;

/// A run-time failure, reported by the `try_…` methods and by [`Simulation`](crate::simulate::Simulation).
///
/// The plain methods of [`Dynamics`](crate::Dynamics) return no errors: they follow IEEE 754 and never panic.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum Error {
    /// An entry of an argument or of a result is infinite or NaN.
    NotFinite {
        /// The vector it stands in, by the name the methods give it: `q`, `v`, `a`, `tau`; `event` for the values of events.
        vector: &'static str,
        /// Its index there, counted from 0.
        index: usize,
    },
    /// Four coordinates that are a quaternion have another length than 1.
    NotUnitQuaternion {
        /// The index in `q` of the first of them, counted from 0.
        index: usize,
    },
    /// M(q) has no finite inverse, so that no finite acceleration answers the forces.
    SingularMassMatrix,
    /// A step of time is zero, negative, infinite or NaN.
    StepNotPositive,
    /// An iteration came to its limit before it was exact enough: that of an implicit step, which may be solved if it is
    /// smaller, or that of a [trim](crate::trim).
    NotConverged {
        /// How many iterations there were.
        iterations: usize,
    },
    /// The step of time would have to be smaller than its bound, or than what rounding leaves of it, for the error to
    /// meet the tolerances: at a jump of the forces, near a singular configuration, or because the tolerances ask for
    /// more digits than the scalar has. Or events come at once again and again, and time does not go on.
    StepTooSmall {
        /// When, in s.
        time: f64,
    },
    /// So many steps have not reached the end.
    TooManySteps {
        /// Where they got to, in s.
        time: f64,
    },
    /// The time to go to is before now, infinite or NaN.
    TimeNotAhead,
    /// A tolerance is negative, infinite or NaN, or both are zero.
    ToleranceNotPositive,
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
    /// No coordinate, speed or input of the robot has this name.
    NameUnknown {
        /// The name.
        name: &'static str,
    },
    /// The robot has fewer coordinates, speeds or inputs than that.
    IndexTooLarge {
        /// The index, counted from 0.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// There is no equilibrium, nor a motion as asked for, where it was looked for: forces are left that nothing
    /// nearby makes smaller. See [`trim`](crate::trim).
    NoEquilibrium,
    /// The slices of a batch are not of one length.
    BatchLength {
        /// The number of results asked for.
        results: usize,
        /// The number of states in the first slice that has another one.
        states: usize,
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
        Self::unless_all_finite(vector, x.as_slice())
    }

    /// [`unless_finite`](Self::unless_finite), of a length that is not known.
    #[inline]
    pub(crate) fn unless_all_finite<T: Scalar>(vector: &'static str, x: &[T]) -> Result<(), Self> {
        match x.iter().position(|entry| !entry.is_finite()) {
            Some(index) => Err(Self::NotFinite { vector, index }),
            None => Ok(()),
        }
    }

    /// `Ok` if the coordinates `q[index]` to `q[index + 3]` are a unit quaternion: |‖·‖² − 1| ≤ 10⁻⁶. Called by the
    /// generated [`check_configuration`](crate::Dynamics::check_configuration).
    ///
    /// That is eight times what `f32` resolves at 1, so that a quaternion which was rounded to it passes, and so
    /// close that forces are right to 10⁻⁶. One typed with four digits is to be normalised first.
    ///
    /// # Errors
    ///
    /// [`Error::NotUnitQuaternion`].
    #[inline]
    pub fn unless_unit_quaternion<T: Scalar>(index: usize, quaternion: [T; 4]) -> Result<(), Self> {
        const TOLERANCE: f64 = 1e-6;
        let square = quaternion.iter().fold(T::zero(), |sum, x| x.mul_add(*x, sum));
        let excess = square - T::one();
        // Scalars do not compare; below zero there is no root.
        let inside = (T::of(TOLERANCE * TOLERANCE) - excess * excess).sqrt();
        if inside.is_finite() { Ok(()) } else { Err(Self::NotUnitQuaternion { index }) }
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
            Self::NotUnitQuaternion { index } => {
                write!(f, "the quaternion that begins at q[{index}] is not of unit length")
            }
            Self::SingularMassMatrix => f.write_str("the mass matrix is singular"),
            Self::StepNotPositive => f.write_str("the time step is not positive and finite"),
            Self::NotConverged { iterations } => {
                write!(
                    f,
                    "{iterations} iterations have not converged: the step is too large, or the guess too far"
                )
            }
            Self::StepTooSmall { time } => {
                write!(f, "no step is small enough for the tolerances at {time} s")
            }
            Self::TooManySteps { time } => write!(f, "the steps are used up at {time} s"),
            Self::TimeNotAhead => f.write_str("the time to go to is not ahead"),
            Self::ToleranceNotPositive => f.write_str("the tolerances are not positive and finite"),
            Self::ParameterNotFinite { field } => write!(f, "the parameter `{field}` is not finite"),
            Self::MassNotPositive { field } => write!(f, "the mass `{field}` is not positive"),
            Self::NameUnknown { name } => {
                write!(
                    f,
                    "the robot has no coordinate, speed or input `{name}`; its `Mechanism` lists the names"
                )
            }
            Self::IndexTooLarge { index, count } => {
                write!(f, "there is no {index} among {count}, counted from 0")
            }
            Self::NoEquilibrium => {
                f.write_str("there is no equilibrium under these constraints near the guess")
            }
            Self::BatchLength { results, states } => {
                write!(f, "a batch has room for {results} results and {states} states")
            }
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
        let message = "the quaternion that begins at q[3] is not of unit length";
        assert_eq!(Error::NotUnitQuaternion { index: 3 }.to_string(), message);
        assert_eq!(Error::SingularMassMatrix.to_string(), "the mass matrix is singular");
        let message = "a batch has room for 5 results and 4 states";
        assert_eq!(Error::BatchLength { results: 5, states: 4 }.to_string(), message);
        for (error, message) in [
            (
                Error::NotConverged { iterations: 50 },
                "50 iterations have not converged: the step is too large, or the guess too far",
            ),
            (Error::StepTooSmall { time: 0.5 }, "no step is small enough for the tolerances at 0.5 s"),
            (Error::TooManySteps { time: 2.0 }, "the steps are used up at 2 s"),
            (Error::TimeNotAhead, "the time to go to is not ahead"),
            (Error::ToleranceNotPositive, "the tolerances are not positive and finite"),
        ] {
            assert_eq!(error.to_string(), message);
        }
        assert_eq!(Error::StepNotPositive.to_string(), "the time step is not positive and finite");
        let message = "the robot has no coordinate, speed or input `elbow`; its `Mechanism` lists the names";
        assert_eq!(Error::NameUnknown { name: "elbow" }.to_string(), message);
        let message = "there is no 7 among 7, counted from 0";
        assert_eq!(Error::IndexTooLarge { index: 7, count: 7 }.to_string(), message);
        let message = "there is no equilibrium under these constraints near the guess";
        assert_eq!(Error::NoEquilibrium.to_string(), message);
    }

    #[test]
    fn a_quaternion_may_be_rounded_and_no_worse() {
        let long =
            |excess: f64| Error::unless_unit_quaternion(3, [0.0, 0.6 * (1.0 + excess / 2.0), 0.0, 0.8]);
        let error = Err(Error::NotUnitQuaternion { index: 3 });
        // The square of the length grows by 0.36·excess.
        for excess in [0.0, 2.7e-6, -2.7e-6] {
            assert_eq!(long(excess), Ok(()), "{excess}");
        }
        for excess in [2.8e-6, -2.8e-6, 1e200, f64::NAN, f64::INFINITY] {
            assert_eq!(long(excess), error, "{excess}");
        }
        assert_eq!(Error::unless_unit_quaternion(3, [0.0; 4]), error);
        let rounded = [0.1_f64, 0.7, -0.5, 0.5].map(|x| x as f32);
        assert_eq!(Error::unless_unit_quaternion(0, rounded), Ok(()));
    }
}
