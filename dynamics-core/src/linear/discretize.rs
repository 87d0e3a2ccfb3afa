//! From continuous to discrete time, and back.

use nalgebra::{SMatrix, SVector};

use super::error::LinearError;
use super::exponential::Exponential;
use super::logarithm::logarithm;
use super::lu::Lu;
use super::real::Real;
use crate::product::product;
use crate::state_space::StateSpace;

/// What the input does from one sample to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hold<T> {
    /// It stays as it is, as behind a digital-to-analogue converter. Exact; the states are the same.
    Zero,
    /// It goes straight to the next sample: the triangle hold. Exact; the state is `x − h·φ₂·B·u`, without an input of the
    /// future.
    First,
    /// Tustin's rule, of trapezoids: poles left of the imaginary axis come into the unit circle, and frequencies up to
    /// π/h are warped but not folded. The state is `(1 − A·h/2)·x − B·u·h/2`.
    Tustin,
    /// Tustin's rule with the step `2·tan(ω·h/2)/ω`, which is exact at one frequency ω.
    Prewarped {
        /// ω, in rad/s: below π/h.
        frequency: T,
    },
}

impl<T: Real> Hold<T> {
    /// The step that Tustin's rule takes.
    fn rule(self, step: T) -> Result<T, LinearError> {
        let Self::Prewarped { frequency } = self else { return Ok(step) };
        let limit = T::of(core::f64::consts::PI) / step;
        if !(frequency > T::zero() && frequency < limit) {
            return Err(LinearError::Prewarp { frequency: frequency.to_f64(), limit: limit.to_f64() });
        }
        let (sine, cosine) = (frequency * step * T::of(0.5)).sin_cos();
        Ok(T::of(2.0) * sine / (cosine * frequency))
    }
}

/// `Φ = e^{A·h}`, NX×NX, and `Γ = ∫₀ʰ e^{A·s} ds·B`, NX×NU: `x⁺ = Φ·x + Γ·u` is exact for a `u` that is held.
///
/// # Errors
///
/// [`LinearError::NotFinite`], of Γ if it overflows; [`LinearError::Step`] if `h` is not positive, or too long for numbers.
///
/// # Cost
///
/// About 20 products of N×N matrices, and three for each doubling of `h·‖A‖` beyond ½.
///
/// # Source
///
/// C. Van Loan, *Computing integrals involving the matrix exponential*, IEEE Trans. Automat. Control 23 (1978) 395–404,
/// whose block matrix is not formed; N. Higham (2005) and A. Al-Mohy, N. Higham (2009) for the scaling.
///
/// # Example
///
/// ```
/// use dynamics_core::linear::zero_order_hold;
/// use dynamics_core::prelude::*;
///
/// let (a, b) = (SMatrix::from([[0.0, 0.0], [1.0, 0.0]]), SMatrix::from([[0.0, 1.0]])); // a mass, pushed
/// let (phi, gamma) = zero_order_hold(&a, &b, 0.5)?;
/// assert_eq!((phi[(0, 1)], gamma[0], gamma[1]), (0.5, 0.125, 0.5));
/// # Ok::<(), dynamics_core::linear::LinearError>(())
/// ```
pub fn zero_order_hold<T: Real, const NX: usize, const NU: usize>(
    a: &SMatrix<T, NX, NX>,
    b: &SMatrix<T, NX, NU>,
    step: T,
) -> Result<(SMatrix<T, NX, NX>, SMatrix<T, NX, NU>), LinearError> {
    LinearError::unless_finite("B", b)?;
    let Exponential { phi_0, phi_1, .. } = exponential(a, step)?;
    let gamma = product(&phi_1, b) * step;
    LinearError::unless_finite("Γ", &gamma)?;
    Ok((phi_0, gamma))
}

/// The exponential of a finite matrix over a positive step.
fn exponential<T: Real, const N: usize>(
    a: &SMatrix<T, N, N>,
    step: T,
) -> Result<Exponential<T, N>, LinearError> {
    LinearError::unless_finite("A", a)?;
    if !(step > T::zero() && step.is_finite()) {
        return Err(LinearError::Step { step: step.to_f64() });
    }
    Exponential::new(a, step)
}

/// `1 − A·h/2`, factored.
fn implicit<T: Real, const N: usize>(a: &SMatrix<T, N, N>, step: T) -> Result<Lu<T, N>, LinearError> {
    LinearError::unless_finite("A", a)?;
    if !(step > T::zero() && step.is_finite()) {
        return Err(LinearError::Step { step: step.to_f64() });
    }
    let matrix = SMatrix::identity() - a * (step * T::of(0.5));
    Lu::new(&matrix).ok_or(LinearError::PoleAtTwiceRate { step: step.to_f64() })
}

impl<T: Real, const NX: usize, const NU: usize, const NY: usize> StateSpace<T, NX, NU, NY> {
    /// The model from one sample to the next, `step` s later: with the same inputs and outputs, and the states that the
    /// [hold](Hold) names. Its drift is held, too.
    ///
    /// # Errors
    ///
    /// [`LinearError::WrongTime`] of a model in discrete time, [`LinearError::NotFinite`], [`LinearError::Step`],
    /// [`LinearError::Prewarp`]; [`LinearError::PoleAtTwiceRate`] of Tustin's rule.
    ///
    /// # Source
    ///
    /// G. Franklin, J. Powell, M. Workman, *Digital Control of Dynamic Systems*, 3rd ed., sections 4.3 and 6.
    pub fn discretize(&self, hold: Hold<T>, step: T) -> Result<Self, LinearError> {
        const HOLDS: &str = "the model is in discrete time already; discretise the one in continuous time";
        if self.sample_time.is_some() {
            return Err(LinearError::WrongTime { expected: HOLDS });
        }
        let mut discrete = Self { sample_time: Some(step), ..*self };
        match hold {
            Hold::Zero | Hold::First => {
                let Exponential { phi_0, phi_1, phi_2 } = exponential(&self.a, step)?;
                discrete.a = phi_0;
                discrete.b = product(&phi_1, &self.b) * step;
                discrete.drift = product(&phi_1, &self.drift) * step;
                if hold == Hold::First {
                    // Φ·φ₂ + φ₁ − φ₂ = φ₁², without the difference
                    discrete.b = product(&phi_1, &discrete.b);
                    discrete.d += product(&self.c, &(product(&phi_2, &self.b) * step));
                }
            }
            Hold::Tustin | Hold::Prewarped { .. } => {
                let half = T::of(0.5);
                let lu = implicit(&self.a, step)?;
                let rule = hold.rule(step)?;
                let lu = if rule == step { lu } else { implicit(&self.a, rule)? };
                discrete.a = lu.solve(&(SMatrix::identity() + self.a * (rule * half)));
                discrete.b = lu.solve(&self.b) * rule;
                discrete.c = lu.solve_transposed(&self.c.transpose()).transpose();
                discrete.d += product(&self.c, &discrete.b) * half;
                discrete.drift = self.drift * rule;
            }
        }
        discrete.finite()
    }

    /// The state with which the discretised model stands for the state `x` and the input `u` of this one: see [`Hold`].
    ///
    /// # Errors
    ///
    /// Those of [`discretize`](Self::discretize).
    pub fn discretized_state(
        &self,
        hold: Hold<T>,
        step: T,
        x: &SVector<T, NX>,
        u: &SVector<T, NU>,
    ) -> Result<SVector<T, NX>, LinearError> {
        let input = product(&self.b, u);
        match hold {
            Hold::Zero => Ok(*x),
            Hold::First => Ok(x - product(&exponential(&self.a, step)?.phi_2, &input) * step),
            Hold::Tustin | Hold::Prewarped { .. } => {
                let half = hold.rule(step)? * T::of(0.5);
                Ok(x - (product(&self.a, x) + input) * half)
            }
        }
    }

    /// The model in continuous time of which [`discretize`](Self::discretize) with the same hold gives this one.
    ///
    /// Of an exact hold there are many; this one's modes are the slowest, with frequencies below π/h.
    ///
    /// # Errors
    ///
    /// [`LinearError::WrongTime`] of a model in continuous time, [`LinearError::NotFinite`], [`LinearError::Step`],
    /// [`LinearError::Prewarp`]; [`LinearError::NoRate`] of an exact hold if a pole is zero or negative, of Tustin's rule
    /// if it is −1.
    pub fn to_continuous(&self, hold: Hold<T>) -> Result<Self, LinearError> {
        const SAMPLED: &str = "the model is in continuous time already";
        let Some(step) = self.sample_time else { return Err(LinearError::WrongTime { expected: SAMPLED }) };
        LinearError::unless_finite("A", &self.a)?;
        if !(step > T::zero() && step.is_finite()) {
            return Err(LinearError::Step { step: step.to_f64() });
        }
        let mut continuous = Self { sample_time: None, ..*self };
        let inverse = |matrix: &SMatrix<T, NX, NX>, pole: f64| {
            Lu::new(matrix).ok_or(LinearError::NoRate { pole: (pole, 0.0) })
        };
        match hold {
            Hold::Zero | Hold::First => {
                continuous.a = logarithm(&self.a)? / step;
                let Exponential { phi_1, phi_2, .. } = exponential(&continuous.a, step)?;
                let lu = inverse(&phi_1, 0.0)?;
                continuous.b = lu.solve(&self.b) / step;
                continuous.drift = lu.solve(&self.drift) / step;
                if hold == Hold::First {
                    continuous.b = lu.solve(&continuous.b);
                    continuous.d -= product(&self.c, &(product(&phi_2, &continuous.b) * step));
                }
            }
            Hold::Tustin | Hold::Prewarped { .. } => {
                let rule = hold.rule(step)?;
                let (one, two) = (SMatrix::<T, NX, NX>::identity(), T::of(2.0));
                let lu = inverse(&(self.a + one), -1.0)?;
                continuous.a = lu.solve(&(self.a - one)) * (two / rule);
                continuous.b = lu.solve(&self.b) * (two / rule);
                continuous.c = lu.solve_transposed(&self.c.transpose()).transpose() * two;
                continuous.d -= product(&continuous.c, &self.b) * T::of(0.5);
                continuous.drift = self.drift / rule;
            }
        }
        continuous.finite()
    }

    /// The model, if its matrices are finite.
    fn finite(self) -> Result<Self, LinearError> {
        LinearError::unless_finite("A", &self.a)?;
        LinearError::unless_finite("B", &self.b)?;
        LinearError::unless_finite("C", &self.c)?;
        LinearError::unless_finite("D", &self.d)?;
        LinearError::unless_finite("drift", &self.drift)?;
        LinearError::unless_finite("offset", &self.offset)?;
        Ok(self)
    }
}
