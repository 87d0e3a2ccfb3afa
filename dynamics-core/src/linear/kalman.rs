//! Estimates of least variance.

use nalgebra::{Complex, SMatrix, SVector};

use super::error::{LinearError, parts};
use super::lqr::{Names, Problem, Weights, solve};
use super::matrix::symmetric_part;
use super::poles::Time;
use super::real::Real;
use super::symmetric::Cholesky;
use crate::product::product;

/// The gains of the steady Kalman filter, and the variance of its errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kalman<T, const NX: usize, const NY: usize> {
    /// L, NX×NY: `x̂˙ = A·x̂ + B·u + L·(y − ŷ)`. In discrete time the predictor's gain, `x̂⁺ = A·x̂ + B·u + L·(y − ŷ)`, where x̂
    /// is what was known before `y`: with noises that are independent `A` times the correction.
    pub gain: SMatrix<T, NX, NY>,
    /// The filter's gain of discrete time, NX×NY: `x̂ + correction·(y − ŷ)` is what is known after `y`. Zero in continuous
    /// time, where one measurement corrects nothing.
    pub correction: SMatrix<T, NX, NY>,
    /// The covariance of `x − x̂`, NX×NX; in discrete time before `y` is known.
    pub covariance: SMatrix<T, NX, NX>,
    /// The poles of `A − L·C`, NX: the slowest first.
    pub poles: SVector<Complex<T>, NX>,
    /// What remains of the Riccati equation, as in [`Lqr`](super::Lqr).
    pub residual: T,
}

/// The L for which x̂ follows x with the least variance: `ẋ = A·x + B·u + w`, `y = C·x + D·u + v`, or with `x⁺` for ẋ.
///
/// W is the covariance of `w` and V that of `v`; of white noise in continuous time these are intensities, per second.
/// `noise` has W as Q, V as R, and what both have in common as N. The covariance solves the Riccati equation of
/// [`lqr`](fn@super::lqr) with `(Aᵀ, Cᵀ, W, V)`.
///
/// # Errors
///
/// As those of `lqr`, in the words of filters: [`NotDetectable`](LinearError::NotDetectable),
/// [`QuietMode`](LinearError::QuietMode).
///
/// # Source
///
/// B. Anderson, J. Moore, *Optimal Filtering* (1979), chapter 4.
///
/// # Example
///
/// ```
/// use dynamics_core::linear::{Time, Weights, kalman};
/// use dynamics_core::prelude::*;
///
/// // A drifting number, measured with noise of variance 1 while it walks by 1 per step: the golden ratio.
/// let one = SMatrix::<f64, 1, 1>::new(1.0);
/// let filter = kalman(Time::Discrete, &one, &one, &Weights::new(one, one))?;
/// assert!((filter.covariance[0] - 0.5 * (1.0 + 5.0_f64.sqrt())).abs() < 1e-14);
/// # Ok::<(), dynamics_core::linear::LinearError>(())
/// ```
pub fn kalman<T: Real, const NX: usize, const NY: usize>(
    time: Time,
    a: &SMatrix<T, NX, NX>,
    c: &SMatrix<T, NY, NX>,
    noise: &Weights<T, NX, NY>,
) -> Result<Kalman<T, NX, NY>, LinearError> {
    const NAMES: Names = Names { a: "A", b: "C", q: "W", r: "V", n: "the noises' cross term" };
    let dual =
        solve(time, &a.transpose(), &c.transpose(), noise, NAMES).map_err(|problem| match problem {
            Problem::Error(error) => error,
            Problem::Unreached(pole) => LinearError::NotDetectable { pole: parts(pole) },
            Problem::Free(pole) => LinearError::QuietMode { pole: parts(pole) },
        })?;
    let correction = match time {
        Time::Continuous => SMatrix::zeros(),
        Time::Discrete => {
            let seen = product(c, &dual.cost);
            let variance = symmetric_part(&(product(&seen, &c.transpose()) + noise.r));
            let Some(factor) = Cholesky::new(&variance) else { return Err(LinearError::NoConvergence) };
            factor.solve(&seen).transpose()
        }
    };
    LinearError::unless_finite("the correction", &correction)?;
    Ok(Kalman {
        gain: dual.gain.transpose(),
        correction,
        covariance: dual.cost,
        poles: dual.poles,
        residual: dual.residual,
    })
}
