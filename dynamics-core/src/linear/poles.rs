//! Poles, and what they say: stability with its margin, natural frequencies and damping.

use core::fmt;

use nalgebra::{Complex, SMatrix, SVector};

use super::balance::balanced;
use super::complex::{logarithm, modulus, real};
use super::error::LinearError;
use super::matrix::{norm, rounding};
use super::real::Real;
use super::schur::Schur;
use super::singular::smallest_singular_value;

/// The kind of time in which a linear model goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Time {
    /// `ẋ = A·x + B·u`: stable where poles are left of the imaginary axis.
    Continuous,
    /// `x⁺ = A·x + B·u`: stable where poles are within the unit circle.
    Discrete,
}

/// Whether motions end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// All decay, and would for every matrix that rounding cannot tell from this one.
    Stable,
    /// A pole is on the boundary, or no further from it than rounding can tell. The motion stays, or grows with a power
    /// of time.
    Marginal,
    /// A pole is beyond the boundary for certain.
    Unstable,
}

/// Stability, with the pole that decides it and the margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stability<T> {
    /// Whether motions end.
    pub verdict: Verdict,
    /// The pole furthest to the right, or from the origin of discrete time.
    pub pole: Complex<T>,
    /// How much A has to change, relative to its norm, for a pole to be on the boundary: at most. It was looked for on the
    /// straight ways from the poles to the boundary.
    pub margin: T,
}

/// The eigenvalues of `A`, N: the slowest first, which are those furthest to the right.
///
/// Pairs are exact conjugates, with the one above the real axis first. States are balanced before, so that their units
/// do not matter.
///
/// # Errors
///
/// [`LinearError::NotFinite`], [`LinearError::NoConvergence`]. Each is the eigenvalue of a matrix within rounding errors
/// of the balanced A: simple ones come with all digits, m-fold ones with one m-th of them.
///
/// # Cost
///
/// About 10·N³ multiplications.
///
/// # Example
///
/// ```
/// use dynamics_core::linear::poles;
/// use dynamics_core::prelude::*;
///
/// let spring = SMatrix::from([[0.0, -4.0], [1.0, 0.0]]); // by columns
/// let [first, second] = poles(&spring)?.data.0[0];
/// assert!(first.re == 0.0 && (first.im - 2.0_f64).abs() < 1e-15 && second == first.conj());
/// # Ok::<(), dynamics_core::linear::LinearError>(())
/// ```
pub fn poles<T: Real, const N: usize>(a: &SMatrix<T, N, N>) -> Result<SVector<Complex<T>, N>, LinearError> {
    sorted_poles(Time::Continuous, a)
}

/// The eigenvalues, those that decay most slowly first.
pub(crate) fn sorted_poles<T: Real, const N: usize>(
    time: Time,
    a: &SMatrix<T, N, N>,
) -> Result<SVector<Complex<T>, N>, LinearError> {
    LinearError::unless_finite("A", a)?;
    let mut poles = Schur::new("A", &balanced(a).0)?.eigenvalues();
    if !poles.iter().all(|pole| pole.re.is_finite() && pole.im.is_finite()) {
        return Err(LinearError::NoConvergence);
    }
    // Insertion: stable, so that pairs stay together.
    for end in 1..N {
        for k in (1..=end).rev() {
            if growth(time, poles[k]) > growth(time, poles[k - 1]) {
                poles.swap_rows(k, k - 1);
            } else {
                break;
            }
        }
    }
    Ok(poles)
}

/// What is larger for a pole whose motion ends later.
fn growth<T: Real>(time: Time, pole: Complex<T>) -> T {
    match time {
        Time::Continuous => pole.re,
        Time::Discrete => modulus(pole),
    }
}

/// Whether `ẋ = A·x`, or `x⁺ = A·x`, comes to rest.
///
/// A sign of a real part would be decided by rounding: two integrators one after another have computed poles of ±10⁻⁸
/// in other coordinates. So the question is asked of the matrix: does one within `10·N·ε` of its norm have this pole on the
/// boundary? A pole of −10⁻¹⁰ is stable beside entries of 1 if it is alone; a double one is marginal. The units of the states
/// are taken as they are: what cancelled in a model leaves some ε of its large entries, and in other units that would pass
/// for a spring.
///
/// # Errors
///
/// [`LinearError::NotFinite`], [`LinearError::NoConvergence`].
///
/// # Cost
///
/// The poles, and for each some 200·N³ multiplications.
///
/// # Source
///
/// C. Van Loan, *How near is a stable matrix to an unstable matrix?*, Contemporary Mathematics 47 (1985) 465–477.
pub fn stability<T: Real, const N: usize>(
    time: Time,
    a: &SMatrix<T, N, N>,
) -> Result<Stability<T>, LinearError> {
    let poles = sorted_poles(time, a)?;
    let mut stability =
        Stability { verdict: Verdict::Stable, pole: Complex::new(T::zero(), T::zero()), margin: T::one() };
    if N == 0 {
        return Ok(stability);
    }
    stability.pole = poles[0];
    let equal = T::EPSILON * norm(a);
    for (k, pole) in poles.iter().enumerate() {
        if is_known(*pole, poles.iter().take(k), equal) {
            continue;
        }
        let (verdict, margin) = judge(time, a, *pole);
        match (verdict, stability.verdict) {
            (Verdict::Unstable, _) | (Verdict::Marginal, Verdict::Stable) => stability.verdict = verdict,
            _ => {}
        }
        if margin < stability.margin {
            stability.margin = margin;
        }
    }
    Ok(stability)
}

/// Whether a question of a pole has been answered already: for one that is as good as equal, or for its conjugate.
pub(crate) fn is_known<'a, T: Real>(
    pole: Complex<T>,
    mut answered: impl Iterator<Item = &'a Complex<T>>,
    equal: T,
) -> bool {
    pole.im < T::zero() || answered.any(|other| modulus(*other - pole) <= equal)
}

/// Whether the mode of a pole decays, and how much of its norm the matrix has to change for the pole to be on the boundary:
/// the largest of the distances to a singular `A − z·1` on the straight way there. At its end alone another pole may be.
pub(crate) fn judge<T: Real, const N: usize>(
    time: Time,
    a: &SMatrix<T, N, N>,
    pole: Complex<T>,
) -> (Verdict, T) {
    let (boundary, stable, size) = match time {
        Time::Continuous => (Complex::new(T::zero(), pole.im), pole.re < T::zero(), norm(a)),
        Time::Discrete => {
            let radius = modulus(pole);
            let nearest = if radius > T::zero() {
                Complex::new(pole.re / radius, pole.im / radius)
            } else {
                Complex::new(T::one(), T::zero())
            };
            (nearest, radius < T::one(), norm(a).max(T::one()))
        }
    };
    if size == T::zero() {
        return (Verdict::Marginal, T::zero());
    }
    let mut margin = T::zero();
    for part in [1.0, 0.75, 0.5, 0.25] {
        let part = real(T::of(part));
        let on_the_way = pole + (boundary - pole) * part;
        margin = margin.max(smallest_singular_value(a, &SMatrix::<T, N, 0>::zeros(), on_the_way) / size);
    }
    let verdict = match (margin <= rounding::<T, N>(), stable) {
        (true, _) => Verdict::Marginal,
        (false, true) => Verdict::Stable,
        (false, false) => Verdict::Unstable,
    };
    (verdict, margin)
}

/// A pole as an engineer reads it: `s² + 2·ζ·ω·s + ω²`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode<T> {
    /// The pole in continuous time, `s`, in 1/s.
    pub pole: Complex<T>,
    /// `ω = |s|`, in rad/s: the natural frequency without damping.
    pub frequency: T,
    /// `ζ = −Re s/|s|`: 1 and more without oscillation, 0 of a lasting one, negative of a growing one. 0 of `s = 0`.
    pub damping: T,
}

impl<T: Real> Mode<T> {
    /// The mode of a pole in continuous time.
    #[must_use]
    pub fn continuous(pole: Complex<T>) -> Self {
        let frequency = modulus(pole);
        let damping = if frequency > T::zero() { -pole.re / frequency } else { T::zero() };
        Self { pole, frequency, damping }
    }

    /// The mode of a pole `z` in discrete time with steps of `step` s: that of `s = ln(z)/step`, the slowest of all that
    /// look so when sampled.
    #[must_use]
    pub fn discrete(pole: Complex<T>, step: T) -> Self {
        let logarithm = logarithm(pole);
        Self::continuous(Complex::new(logarithm.re / step, logarithm.im / step))
    }
}

impl<T: Real> fmt::Display for Mode<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (pole, frequency, damping) = (self.pole, self.frequency.to_f64(), self.damping.to_f64());
        let (re, im) = (pole.re.to_f64(), pole.im.to_f64());
        write!(f, "{re:>11.4e} {im:>+11.4e}i  {frequency:>10.4e} rad/s, damping {damping:.4}")
    }
}

#[cfg(test)]
mod tests;
