//! Controllability and observability: which modes the inputs move, and which the outputs show.

use core::ops::Range;

use nalgebra::{Complex, SMatrix, SVector};

use super::complex::{modulus, real};
use super::error::LinearError;
use super::matrix::{norm, rounding};
use super::poles::{Time, Verdict, is_known, judge};
use super::real::Real;
use super::reflector::Reflector;
use super::schur::Schur;
use super::singular::smallest_singular_value;

/// What inputs reach, or outputs show, of a model with N states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach<T, const N: usize> {
    /// The dimension of the subspace that is reached (controllability), or that is seen (observability).
    pub dimension: usize,
    /// How far the nearest model is that lacks a mode, relative to the norms of A and B (or C): at most. It was looked
    /// for at the poles, with the states in the units that they have.
    pub distance: T,
    /// The pole of the mode that is reached or seen least.
    pub weakest: Complex<T>,
    poles: SVector<Complex<T>, N>,
    /// Whether each of the missing modes decays, in both kinds of time.
    verdicts: [[Verdict; 2]; N],
}

impl<T: Real, const N: usize> Reach<T, N> {
    /// Whether all modes are reached, or seen, beyond what rounding can tell.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.dimension == N
    }

    /// The poles of the modes that are not reached, or not seen: `N − dimension` of them.
    #[must_use]
    pub fn missing(&self) -> &[Complex<T>] {
        self.poles.as_slice().get(self.dimension..).unwrap_or_default()
    }

    /// The first missing mode with one of these verdicts.
    fn first_missing(&self, time: Time, wanted: &[Verdict]) -> Option<Complex<T>> {
        let column = usize::from(time == Time::Discrete);
        let missing = self.poles.iter().zip(&self.verdicts).skip(self.dimension);
        missing.into_iter().find(|(_, verdicts)| wanted.contains(&verdicts[column])).map(|(pole, _)| *pole)
    }

    /// The pole of a missing mode that does not decay: what makes a model not stabilisable, or not detectable.
    #[must_use]
    pub fn missing_and_lasting(&self, time: Time) -> Option<Complex<T>> {
        self.first_missing(time, &[Verdict::Unstable, Verdict::Marginal])
    }

    /// The pole of a missing mode that neither grows nor decays.
    pub(crate) fn missing_and_marginal(&self, time: Time) -> Option<Complex<T>> {
        self.first_missing(time, &[Verdict::Marginal])
    }
}

/// Which modes of `ẋ = A·x + B·u`, or of `x⁺ = …`, the inputs reach.
///
/// The rank of `[B AB A²B …]` would be asked of powers, which lose all but the fastest mode. Instead orthogonal
/// transformations bring `(A, B)` into staircase form, whose steps are compared with rounding; and the distance of
/// `[A − λ·1, B]` from losing rank is found at each pole. A model that either calls incomplete is so.
///
/// Rounding is `10·N·ε` of the norms of A and of B in the units of the states as they are: choose some in which states are
/// of about one size. In others, what cancelled in a model would pass for a coupling.
///
/// The answer is that of the linear model. Where a robot does not stay in its state, the model holds for a short while
/// only: of a robot that falls, motors reach the horizontal momentum too, in the axes of its base, as these tilt.
///
/// # Errors
///
/// [`LinearError::NotFinite`], [`LinearError::NoConvergence`].
///
/// # Cost
///
/// For each pole some 50·N²·(N + M) multiplications.
///
/// # Source
///
/// P. Van Dooren, *The generalized eigenstructure problem in linear system theory*, IEEE Trans. Automat. Control 26
/// (1981) 111–129; C. Paige, *Properties of numerical algorithms related to computing controllability*, same volume,
/// 130–138; R. Eising, *Between controllable and uncontrollable*, Systems & Control Letters 4 (1984) 263–264.
///
/// # Example
///
/// ```
/// use dynamics_core::linear::controllability;
/// use dynamics_core::prelude::*;
///
/// // Two equal masses, pushed by the same force: their difference stays.
/// let mut a = SMatrix::<f64, 4, 4>::zeros();
/// (a[(0, 2)], a[(1, 3)]) = (1.0, 1.0);
/// let reach = controllability(&a, &SMatrix::from([[0.0, 0.0, 1.0, 1.0]]))?;
/// assert_eq!((reach.dimension, reach.missing().len()), (2, 2));
/// # Ok::<(), dynamics_core::linear::LinearError>(())
/// ```
pub fn controllability<T: Real, const N: usize, const M: usize>(
    a: &SMatrix<T, N, N>,
    b: &SMatrix<T, N, M>,
) -> Result<Reach<T, N>, LinearError> {
    LinearError::unless_finite("A", a)?;
    LinearError::unless_finite("B", b)?;
    reach(a, b)
}

/// Which modes of a model with outputs `y = C·x` show in these: the controllability of `(Aᵀ, Cᵀ)`.
///
/// # Errors
///
/// [`LinearError::NotFinite`], [`LinearError::NoConvergence`].
pub fn observability<T: Real, const N: usize, const P: usize>(
    a: &SMatrix<T, N, N>,
    c: &SMatrix<T, P, N>,
) -> Result<Reach<T, N>, LinearError> {
    LinearError::unless_finite("A", a)?;
    LinearError::unless_finite("C", c)?;
    reach(&a.transpose(), &c.transpose())
}

/// [`controllability`] of finite matrices.
pub(crate) fn reach<T: Real, const N: usize, const M: usize>(
    a: &SMatrix<T, N, N>,
    b: &SMatrix<T, N, M>,
) -> Result<Reach<T, N>, LinearError> {
    // Inputs and time have units of their own: with A and B of norm 1 the distance does not depend on them.
    let (a, size) = normalised(a);
    let (b, _) = normalised(b);
    let staircase = Staircase::new(&a, &b);
    let cut = staircase.trailing(staircase.narrowest, T::zero());
    let of_cut = Schur::new("A", &cut)?.eigenvalues();
    let eigenvalues = Schur::new("A", &a)?.eigenvalues();

    let (mut distance, mut weakest) = (T::one(), real(T::zero()));
    let candidates = || eigenvalues.iter().chain(of_cut.iter().skip(staircase.narrowest));
    for (k, pole) in candidates().enumerate() {
        if is_known(*pole, candidates().take(k), T::EPSILON) {
            continue;
        }
        let found = smallest_singular_value(&a, &b, *pole);
        if found < distance {
            (distance, weakest) = (found, *pole);
        }
    }
    let mut reach = Reach {
        dimension: staircase.dimension,
        distance,
        weakest: weakest * real(size),
        poles: of_cut,
        verdicts: [[Verdict::Stable; 2]; N],
    };
    let mut lost = cut;
    if staircase.dimension == N && distance <= rounding::<T, N>() {
        // No single step is small, and still a mode is lost: the weakest.
        lost = a;
        let width = if weakest.im == T::zero() { 1 } else { 2 };
        reach.dimension = N.saturating_sub(width);
        for (k, pole) in reach.poles.iter_mut().rev().take(width).enumerate() {
            *pole = if k == 0 { weakest.conj() } else { weakest };
        }
    }
    let continuous = padded(&lost, staircase.dimension, -T::one());
    let discrete = padded(&lost, staircase.dimension, T::zero()) * size;
    for k in reach.dimension..N {
        let pole = reach.poles[k];
        let equal = |other: &usize| {
            modulus(reach.poles[*other] - pole) <= T::EPSILON || reach.poles[*other] == pole.conj()
        };
        reach.verdicts[k] = match (reach.dimension..k).find(equal) {
            Some(other) => reach.verdicts[other],
            None => [
                judge(Time::Continuous, &continuous, pole).0,
                judge(Time::Discrete, &discrete, pole * real(size)).0,
            ],
        };
    }
    reach.poles.iter_mut().for_each(|pole| *pole *= real(size));
    Ok(reach)
}

/// A matrix divided by its norm, and the norm; zero stays, with 1.
fn normalised<T: Real, const R: usize, const C: usize>(a: &SMatrix<T, R, C>) -> (SMatrix<T, R, C>, T) {
    let size = norm(a);
    if size > T::zero() { (a / size, size) } else { (*a, T::one()) }
}

/// The block from row and column `start` on, with `filler` on the diagonal before it; all of `a` where that is empty.
fn padded<T: Real, const N: usize>(a: &SMatrix<T, N, N>, start: usize, filler: T) -> SMatrix<T, N, N> {
    if start >= N {
        return *a;
    }
    SMatrix::from_fn(|i, j| match (i.min(j) >= start, i == j) {
        (true, _) => a[(i, j)],
        (false, true) => filler,
        (false, false) => T::zero(),
    })
}

/// `(A, B)` in orthogonal coordinates in which the inputs move the first states only, these the next, and so on.
pub(crate) struct Staircase<T, const N: usize, const M: usize> {
    /// A in these coordinates.
    pub(crate) a: SMatrix<T, N, N>,
    /// B in these coordinates.
    pub(crate) b: SMatrix<T, N, M>,
    /// The axes, by columns: `A = Q·a·Qᵀ`.
    pub(crate) basis: SMatrix<T, N, N>,
    /// How many states are reached.
    pub(crate) dimension: usize,
    /// The first state behind the smallest step; `dimension` where that is less than N.
    narrowest: usize,
}

impl<T: Real, const N: usize, const M: usize> Staircase<T, N, M> {
    /// The staircase of a pair; steps below rounding, relative to the norm of B and of A, are zero.
    pub(crate) fn new(a: &SMatrix<T, N, N>, b: &SMatrix<T, N, M>) -> Self {
        let mut staircase = Self { a: *a, b: *b, basis: SMatrix::identity(), dimension: 0, narrowest: 0 };
        staircase.widen(0..M, |staircase, j| staircase.b.column(j).into_owned(), norm(b));
        let (mut before, mut smallest) = (0, T::one() / T::zero());
        while before < staircase.dimension && staircase.dimension < N {
            let (columns, start) = (before..staircase.dimension, staircase.dimension);
            let step = staircase.widen(columns, |staircase, j| staircase.a.column(j).into_owned(), norm(a));
            if step < smallest {
                (smallest, staircase.narrowest) = (step, start);
            }
            before = start;
        }
        if staircase.dimension < N {
            staircase.narrowest = staircase.dimension;
        }
        staircase
    }

    /// Turns the states beyond `dimension` until as few of them as can be are reached from these columns, and counts
    /// those. Gives the largest entry there was, which is the height of the step.
    fn widen(&mut self, columns: Range<usize>, column: fn(&Self, usize) -> SVector<T, N>, size: T) -> T {
        let mut height = T::zero();
        for count in 0..columns.len() {
            let start = self.dimension;
            let (mut largest, mut chosen) = (T::zero(), SVector::zeros());
            for j in columns.clone() {
                let candidate = column(self, j);
                let square = (start..N).fold(T::zero(), |sum, i| candidate[i].mul_add(candidate[i], sum));
                if square > largest {
                    (largest, chosen) = (square, candidate);
                }
            }
            let length = largest.sqrt();
            if count == 0 {
                height = length;
            }
            if length <= rounding::<T, N>() * size || start >= N {
                break;
            }
            let reflector = Reflector::annihilating(&chosen, start..N);
            reflector.left(&mut self.a);
            reflector.left(&mut self.b);
            reflector.right(&mut self.a);
            reflector.right(&mut self.basis);
            self.dimension += 1;
        }
        height
    }

    /// The states from `start` on among themselves; `filler` on the diagonal before.
    fn trailing(&self, start: usize, filler: T) -> SMatrix<T, N, N> {
        padded(&self.a, start, filler)
    }
}

#[cfg(test)]
mod tests;
