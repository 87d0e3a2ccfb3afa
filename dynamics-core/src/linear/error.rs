//! What can be wrong with a linear model or with what is asked of it, and what to do.

use core::fmt;

use nalgebra::{Complex, SMatrix};

use super::real::Real;
use crate::state_space::table::Short;

/// A reason why a linear model has no such discretisation, property, gain or estimate.
///
/// Numbers are in the user's units; complex ones as real and imaginary part.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum LinearError {
    /// An entry of a matrix is infinite or NaN.
    NotFinite {
        /// The matrix, by its letter.
        matrix: &'static str,
        /// Its row, counted from 0.
        row: usize,
        /// Its column, counted from 0.
        column: usize,
    },
    /// A weight or a covariance differs from its transpose.
    NotSymmetric {
        /// The matrix, by its letter.
        matrix: &'static str,
        /// The row of the entry that differs most, counted from 0.
        row: usize,
        /// Its column, counted from 0.
        column: usize,
    },
    /// A weight or a covariance that has to be positive definite is not.
    NotPositiveDefinite {
        /// The matrix, by its letter.
        matrix: &'static str,
        /// Its smallest eigenvalue.
        eigenvalue: f64,
    },
    /// A weight or a covariance has a negative eigenvalue.
    NotPositiveSemidefinite {
        /// The matrix, by its letter.
        matrix: &'static str,
        /// Its smallest eigenvalue.
        eigenvalue: f64,
    },
    /// A mode that does not decay is not reached by the inputs.
    NotStabilizable {
        /// The mode's pole: real and imaginary part.
        pole: (f64, f64),
    },
    /// A mode that does not decay is not seen in the outputs.
    NotDetectable {
        /// The mode's pole: real and imaginary part.
        pole: (f64, f64),
    },
    /// A mode on the boundary of stability costs nothing, so that no gain with least cost damps it.
    FreeMode {
        /// The mode's pole: real and imaginary part.
        pole: (f64, f64),
    },
    /// A mode on the boundary of stability is excited by no noise, so that no filter with least variance forgets it.
    QuietMode {
        /// The mode's pole: real and imaginary part.
        pole: (f64, f64),
    },
    /// A mode is not reached by the input, so that its pole cannot be moved.
    NotControllable {
        /// The mode's pole: real and imaginary part.
        pole: (f64, f64),
    },
    /// The closed loop is not stable, so that its cost has no end.
    NotStable {
        /// A pole that does not decay: real and imaginary part.
        pole: (f64, f64),
    },
    /// A desired pole is complex and its conjugate is not desired.
    PoleWithoutConjugate {
        /// The desired pole: real and imaginary part.
        pole: (f64, f64),
    },
    /// A desired pole is not attained to the digits that the arithmetic has.
    PoleNotAttained {
        /// The desired pole: real and imaginary part.
        pole: (f64, f64),
        /// How much the closed loop has to change, relative to its size, for the pole to be its own.
        residual: f64,
    },
    /// The Riccati equation is not solved to the digits that the arithmetic has.
    RiccatiResidual {
        /// The norm of what remains of the equation, relative to its largest term.
        residual: f64,
    },
    /// A step of time is not positive and finite, or too long for the model.
    Step {
        /// The step, in s.
        step: f64,
    },
    /// The frequency at which Tustin's rule is to be exact is not between 0 and half the sampling rate.
    Prewarp {
        /// The frequency, in rad/s.
        frequency: f64,
        /// π/h, in rad/s: it must be below.
        limit: f64,
    },
    /// The model is of one kind of time and must be of the other.
    WrongTime {
        /// What it is and what it must be.
        expected: &'static str,
    },
    /// `1 − A·h/2` has no inverse: a pole is at 2/h.
    PoleAtTwiceRate {
        /// The step, in s.
        step: f64,
    },
    /// A pole in discrete time is zero or negative, as no model in continuous time has it between holds.
    NoRate {
        /// The pole: real and imaginary part.
        pole: (f64, f64),
    },
    /// An iteration that converges for every matrix known did not.
    NoConvergence,
}

/// A pole as numbers for a message.
pub(crate) fn parts<T: Real>(pole: Complex<T>) -> (f64, f64) {
    (pole.re.to_f64(), pole.im.to_f64())
}

impl LinearError {
    /// `Ok` if every entry of a matrix is finite, else the first that is not.
    pub(crate) fn unless_finite<T: Real, const R: usize, const C: usize>(
        matrix: &'static str,
        a: &SMatrix<T, R, C>,
    ) -> Result<(), Self> {
        match a.iter().position(|entry| !entry.is_finite()) {
            Some(index) => Err(Self::NotFinite { matrix, row: index % R.max(1), column: index / R.max(1) }),
            None => Ok(()),
        }
    }
}

fn short(value: f64) -> Short<f64> {
    Short { value, digits: 4 }
}

/// A pole as it is written: `-1.5000 + 2.0000i`.
struct Pole((f64, f64));

impl fmt::Display for Pole {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (re, im) = (short(self.0.0), short(self.0.1.abs()));
        match self.0.1 {
            0.0 => re.fmt(f),
            below if below < 0.0 => write!(f, "{re} - {im}i"),
            _ => write!(f, "{re} + {im}i"),
        }
    }
}

/// What is wrong with a mode.
fn mode(f: &mut fmt::Formatter<'_>, pole: (f64, f64), wrong: &str) -> fmt::Result {
    write!(f, "the mode of the pole {} {wrong}", Pole(pole))
}

impl fmt::Display for LinearError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotFinite { matrix, row, column } => write!(f, "{matrix}[({row}, {column})] is not finite"),
            Self::NotSymmetric { matrix, row, column } => write!(
                f,
                "{matrix}[({row}, {column})] and {matrix}[({column}, {row})] differ; take ({matrix} + {matrix}ᵀ)/2"
            ),
            Self::NotPositiveDefinite { matrix, eigenvalue } => write!(
                f,
                "{matrix} has the eigenvalue {}, and all must be positive; give each of its inputs or outputs a weight \
                 or a noise",
                short(eigenvalue)
            ),
            Self::NotPositiveSemidefinite { matrix, eigenvalue } => write!(
                f,
                "{matrix} has the eigenvalue {}, and none may be negative; make it Lᵀ·L, or the cross term smaller",
                short(eigenvalue)
            ),
            Self::NotStabilizable { pole } => mode(
                f,
                pole,
                "does not decay, and no input reaches it; add an input, or leave the mode out of the model",
            ),
            Self::NotDetectable { pole } => mode(
                f,
                pole,
                "does not decay, and no output shows it; measure more, or leave the mode out of the model",
            ),
            Self::FreeMode { pole } => {
                mode(f, pole, "neither grows nor decays, and costs nothing; give it a weight in Q")
            }
            Self::QuietMode { pole } => {
                mode(f, pole, "neither grows nor decays, and no noise excites it; give it some in W")
            }
            Self::NotControllable { pole } => mode(
                f,
                pole,
                "is not reached by the input, and its pole cannot be moved; choose another input, or leave the mode \
                 out of the model",
            ),
            Self::NotStable { pole } => write!(
                f,
                "the closed loop has the pole {}, which does not decay; take a gain that stabilises",
                Pole(pole)
            ),
            Self::PoleWithoutConjugate { pole } => write!(
                f,
                "the pole {} is desired without {}; give complex poles in conjugate pairs",
                Pole(pole),
                Pole((pole.0, -pole.1))
            ),
            Self::PoleNotAttained { pole, residual } => write!(
                f,
                "the pole {} is attained to {residual:.1e} of the closed loop only; desire poles nearer to those of \
                 the model, or further from each other",
                Pole(pole)
            ),
            Self::RiccatiResidual { residual } => write!(
                f,
                "the Riccati equation is solved to {residual:.1e} of its largest term only; bring the weights nearer \
                 to each other, or the units of the states"
            ),
            Self::Step { step } => {
                write!(f, "the step of {step} s is not positive, not finite, or too long for the model")
            }
            Self::Prewarp { frequency, limit } => write!(
                f,
                "the rule cannot be exact at {frequency} rad/s: the frequency must be positive and below π/h = \
                 {limit:.4} rad/s"
            ),
            Self::WrongTime { expected } => f.write_str(expected),
            Self::PoleAtTwiceRate { step } => {
                write!(f, "a pole is at 2/h of the step h = {step} s; choose a shorter step")
            }
            Self::NoRate { pole } => write!(
                f,
                "no model in continuous time has the pole {} when it is sampled; take Tustin's rule",
                Pole(pole)
            ),
            Self::NoConvergence => f.write_str(
                "the eigenvalues were not found, or have no finite number; bring the units of the states nearer to \
                 each other",
            ),
        }
    }
}

impl core::error::Error for LinearError {}

#[cfg(test)]
mod tests {
    use std::string::ToString;

    use super::*;

    #[test]
    fn messages_state_the_fact_and_the_remedy() {
        let message = |error: LinearError| error.to_string();
        let not_finite = LinearError::NotFinite { matrix: "A", row: 2, column: 0 };
        assert_eq!(message(not_finite), "A[(2, 0)] is not finite");
        assert_eq!(
            message(LinearError::FreeMode { pole: (0.0, -2.0) }),
            "the mode of the pole 0 - 2.0000i neither grows nor decays, and costs nothing; give it a weight in Q"
        );
        assert_eq!(
            message(LinearError::PoleWithoutConjugate { pole: (-1.0, 2.0) }),
            "the pole -1.0000 + 2.0000i is desired without -1.0000 - 2.0000i; give complex poles in conjugate \
             pairs"
        );
        assert_eq!(
            message(LinearError::NotPositiveDefinite { matrix: "R", eigenvalue: -3.0 }),
            "R has the eigenvalue -3.0000, and all must be positive; give each of its inputs or outputs a weight or a \
             noise"
        );
        assert_eq!(
            message(LinearError::PoleAtTwiceRate { step: 0.5 }),
            "a pole is at 2/h of the step h = 0.5 s; choose a shorter step"
        );
    }
}
