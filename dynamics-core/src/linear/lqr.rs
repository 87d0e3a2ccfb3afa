//! State feedback of least cost.

use nalgebra::{Complex, SMatrix, SVector};

use super::error::{LinearError, parts};
use super::matrix::{norm, product_3, rounding, symmetric_part};
use super::poles::{Time, sorted_poles};
use super::reach::reach;
use super::real::Real;
use super::riccati::Riccati;
use super::symmetric::{Cholesky, symmetric_eigenvalues};
use crate::product::product;

/// What states and inputs cost: `xᵀ·Q·x + uᵀ·R·u + 2·xᵀ·N·u`, per second or per step.
///
/// Of a filter, the covariances of its noises: Q that of the states, R that of the outputs, N between both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights<T, const NX: usize, const NU: usize> {
    /// Q, NX×NX: symmetric.
    pub q: SMatrix<T, NX, NX>,
    /// R, NU×NU: symmetric and positive definite.
    pub r: SMatrix<T, NU, NU>,
    /// N, NX×NU. `Q − N·R⁻¹·Nᵀ` must be positive semidefinite.
    pub n: SMatrix<T, NX, NU>,
}

impl<T: Real, const NX: usize, const NU: usize> Weights<T, NX, NU> {
    /// Weights of states and of inputs without a cross term.
    #[must_use]
    pub fn new(q: SMatrix<T, NX, NX>, r: SMatrix<T, NU, NU>) -> Self {
        Self { q, r, n: SMatrix::zeros() }
    }

    /// Diagonal weights. Bryson's rule: `1/x²` of the largest deviation, `1/u²` of the largest input that is welcome.
    #[must_use]
    pub fn diagonal(q: [T; NX], r: [T; NU]) -> Self {
        let diagonal = |i: usize, j: usize, entry: T| if i == j { entry } else { T::zero() };
        Self::new(
            SMatrix::from_fn(|i, j| diagonal(i, j, q[i])),
            SMatrix::from_fn(|i, j| diagonal(i, j, r[i])),
        )
    }

    /// The same with a cross term N.
    #[must_use]
    pub fn with_cross(self, n: SMatrix<T, NX, NU>) -> Self {
        Self { n, ..self }
    }
}

/// The feedback `u = −K·x` of least cost, and what it costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lqr<T, const NX: usize, const NU: usize> {
    /// K, NU×NX.
    pub gain: SMatrix<T, NU, NX>,
    /// P, NX×NX, symmetric: from `x` on the motion costs `xᵀ·P·x`.
    pub cost: SMatrix<T, NX, NX>,
    /// The poles of `A − B·K`, NX: the slowest first.
    pub poles: SVector<Complex<T>, NX>,
    /// What remains of the Riccati equation when P is put in, relative to its largest term, with the states in balanced
    /// units. Rounding leaves some ε.
    pub residual: T,
}

/// The K for which `u = −K·x` makes `∫(xᵀQx + uᵀRu + 2xᵀNu) dt`, or the sum of it, least, and the closed loop stable.
///
/// P solves `AᵀP + PA − (PB + N)R⁻¹(BᵀP + Nᵀ) + Q = 0`, in discrete time
/// `P = AᵀPA − (AᵀPB + N)(R + BᵀPB)⁻¹(BᵀPA + Nᵀ) + Q`; it is put in before it is handed out.
///
/// # Errors
///
/// [`NotFinite`](LinearError::NotFinite), [`NotSymmetric`](LinearError::NotSymmetric),
/// [`NotPositiveDefinite`](LinearError::NotPositiveDefinite) of R,
/// [`NotPositiveSemidefinite`](LinearError::NotPositiveSemidefinite) of `Q − N·R⁻¹·Nᵀ`;
/// [`NotStabilizable`](LinearError::NotStabilizable) and [`FreeMode`](LinearError::FreeMode), with the pole;
/// [`RiccatiResidual`](LinearError::RiccatiResidual) if P is not found to `1000·N·ε`.
///
/// # Cost
///
/// Some thousand N³ multiplications; most are the tests of stabilisability.
///
/// # Source
///
/// B. Anderson, J. Moore, *Optimal Control: Linear Quadratic Methods* (1990).
///
/// # Example
///
/// ```
/// use dynamics_core::linear::{Time, Weights, lqr};
/// use dynamics_core::prelude::*;
///
/// let (a, b) = (SMatrix::from([[0.0, 0.0], [1.0, 0.0]]), SMatrix::from([[0.0, 1.0]])); // a mass, pushed
/// let lqr = lqr(Time::Continuous, &a, &b, &Weights::diagonal([1.0, 0.0], [1.0]))?;
/// assert!((lqr.gain[0] - 1.0_f64).abs() < 1e-14 && (lqr.gain[1] - 2.0_f64.sqrt()).abs() < 1e-14);
/// # Ok::<(), dynamics_core::linear::LinearError>(())
/// ```
pub fn lqr<T: Real, const NX: usize, const NU: usize>(
    time: Time,
    a: &SMatrix<T, NX, NX>,
    b: &SMatrix<T, NX, NU>,
    weights: &Weights<T, NX, NU>,
) -> Result<Lqr<T, NX, NU>, LinearError> {
    const NAMES: Names = Names { a: "A", b: "B", q: "Q", r: "R", n: "N" };
    solve(time, a, b, weights, NAMES).map_err(|problem| match problem {
        Problem::Error(error) => error,
        Problem::Unreached(pole) => LinearError::NotStabilizable { pole: parts(pole) },
        Problem::Free(pole) => LinearError::FreeMode { pole: parts(pole) },
    })
}

/// What the matrices of a problem are called by the user.
#[derive(Clone, Copy)]
pub(crate) struct Names {
    pub(crate) a: &'static str,
    pub(crate) b: &'static str,
    pub(crate) q: &'static str,
    pub(crate) r: &'static str,
    pub(crate) n: &'static str,
}

/// Why there is no solution; a filter words the last two in its own way.
pub(crate) enum Problem<T> {
    Error(LinearError),
    /// A mode that does not decay, and is out of reach.
    Unreached(Complex<T>),
    /// A mode on the boundary that costs nothing.
    Free(Complex<T>),
}

impl<T> From<LinearError> for Problem<T> {
    fn from(error: LinearError) -> Self {
        Self::Error(error)
    }
}

/// [`lqr`], with names for its matrices.
pub(crate) fn solve<T: Real, const NX: usize, const NU: usize>(
    time: Time,
    a: &SMatrix<T, NX, NX>,
    b: &SMatrix<T, NX, NU>,
    weights: &Weights<T, NX, NU>,
    names: Names,
) -> Result<Lqr<T, NX, NU>, Problem<T>> {
    let Weights { q, r, n } = weights;
    LinearError::unless_finite(names.a, a)?;
    LinearError::unless_finite(names.b, b)?;
    LinearError::unless_finite(names.n, n)?;
    let (q, r) = (symmetric(names.q, q)?, symmetric(names.r, r)?);
    let Some(factor) = Cholesky::new(&r) else {
        let eigenvalue = smallest_eigenvalue(&r).to_f64();
        return Err(LinearError::NotPositiveDefinite { matrix: names.r, eigenvalue }.into());
    };
    // The input that the cross term asks for is taken first: u = −R⁻¹·Nᵀ·x + w.
    let first = factor.solve(&n.transpose());
    let drift = a - product(b, &first);
    let q = symmetric_part(&(q - product(n, &first)));
    semidefinite(names.q, &q)?;
    let half = factor.solve_lower(&b.transpose());
    let g = product(&half.transpose(), &half);
    let riccati = Riccati { time, a: drift, g, q };
    // In units of the states in which neither weights nor reach are large without need, and time is as it was.
    let (balanced, scales) = riccati.balanced();
    let inputs = SMatrix::<T, NX, NU>::from_fn(|i, j| half[(j, i)] / scales[i]);
    if let Some(pole) = reach(&balanced.a, &inputs)?.missing_and_lasting(time) {
        return Err(Problem::Unreached(pole));
    }
    if let Some(pole) = reach(&balanced.a.transpose(), &root_like(&balanced.q))?.missing_and_marginal(time) {
        return Err(Problem::Free(pole));
    }
    let solution = riccati.solve()?;
    let (p, carried) = (solution.p, product(&b.transpose(), &solution.p));
    let gain = match time {
        Time::Continuous => factor.solve(&(carried + n.transpose())),
        Time::Discrete => {
            let weight = symmetric_part(&(r + product(&carried, b)));
            let Some(factor) = Cholesky::new(&weight) else { return Err(LinearError::NoConvergence.into()) };
            factor.solve(&(product(&carried, a) + n.transpose()))
        }
    };
    LinearError::unless_finite("K", &gain)?;
    let poles = sorted_poles(time, &(a - product(b, &gain)))?;
    Ok(Lqr { gain, cost: p, poles, residual: solution.residual })
}

/// A matrix that is symmetric but for rounding, made so.
fn symmetric<T: Real, const N: usize>(
    name: &'static str,
    a: &SMatrix<T, N, N>,
) -> Result<SMatrix<T, N, N>, LinearError> {
    LinearError::unless_finite(name, a)?;
    let (mut worst, mut place) = (T::zero(), (0, 0));
    for (row, column) in (0..N).flat_map(|row| (0..row).map(move |column| (row, column))) {
        let (x, y) = (a[(row, column)], a[(column, row)]);
        let size = x.abs().max(y.abs()).max(a[(row, row)].abs().sqrt() * a[(column, column)].abs().sqrt());
        let difference = if size > T::zero() { (x - y).abs() / size } else { T::zero() };
        if difference > worst {
            (worst, place) = (difference, (row, column));
        }
    }
    if worst > rounding::<T, N>() {
        return Err(LinearError::NotSymmetric { matrix: name, row: place.0, column: place.1 });
    }
    Ok(symmetric_part(a))
}

/// The smallest eigenvalue of a symmetric matrix.
fn smallest_eigenvalue<T: Real, const N: usize>(a: &SMatrix<T, N, N>) -> T {
    symmetric_eigenvalues(a).iter().copied().reduce(|x, y| if y < x { y } else { x }).unwrap_or(T::one())
}

/// `Ok` unless a symmetric matrix has a negative eigenvalue beyond rounding, in the units that make its diagonal 1.
fn semidefinite<T: Real, const N: usize>(
    name: &'static str,
    q: &SMatrix<T, N, N>,
) -> Result<(), LinearError> {
    let unit = |i: usize| {
        let size = q[(i, i)].abs();
        if size > T::zero() { size.sqrt() } else { T::one() }
    };
    let scaled = SMatrix::<T, N, N>::from_fn(|i, j| q[(i, j)] / unit(i) / unit(j));
    let smallest = smallest_eigenvalue(&scaled);
    if smallest >= -rounding::<T, N>() * norm(&scaled).max(T::one()) {
        return Ok(());
    }
    let eigenvalue = smallest_eigenvalue(q);
    let eigenvalue = if eigenvalue < T::zero() { eigenvalue } else { smallest };
    Err(LinearError::NotPositiveSemidefinite { matrix: name, eigenvalue: eigenvalue.to_f64() })
}

/// A matrix with the null space of Q whose entries are of the size of its root's, so that small weights count.
fn root_like<T: Real, const N: usize>(q: &SMatrix<T, N, N>) -> SMatrix<T, N, N> {
    SMatrix::from_fn(|i, j| {
        let size = q[(j, j)].abs().sqrt();
        if size > T::zero() { q[(i, j)] / size } else { T::zero() }
    })
}

/// `∫(xᵀQx + uᵀRu + 2xᵀNu) dt`, or the sum, of `u = −K·x` as a quadratic form of the state at the beginning: NX×NX.
///
/// That of any gain that stabilises, not of the best one alone: what a detuned or rounded K costs.
///
/// # Errors
///
/// [`NotFinite`](LinearError::NotFinite), [`NoConvergence`](LinearError::NoConvergence);
/// [`NotStable`](LinearError::NotStable) with the pole, if the closed loop is not stable.
pub fn quadratic_cost<T: Real, const NX: usize, const NU: usize>(
    time: Time,
    a: &SMatrix<T, NX, NX>,
    b: &SMatrix<T, NX, NU>,
    weights: &Weights<T, NX, NU>,
    gain: &SMatrix<T, NU, NX>,
) -> Result<SMatrix<T, NX, NX>, LinearError> {
    let Weights { q, r, n } = weights;
    LinearError::unless_finite("B", b)?;
    LinearError::unless_finite("K", gain)?;
    LinearError::unless_finite("Q", q)?;
    LinearError::unless_finite("R", r)?;
    LinearError::unless_finite("N", n)?;
    let closed = a - product(b, gain);
    let cross = product(n, gain);
    let running = symmetric_part(&(q - cross - cross.transpose() + product_3(&gain.transpose(), r, gain)));
    let (cost, slowest) = super::lyapunov::lyapunov(time, &closed, &running)?;
    let boundary = if time == Time::Continuous { T::zero() } else { T::one() };
    if slowest < boundary {
        return Ok(cost);
    }
    let pole = sorted_poles(time, &closed)?.iter().next().map_or((0.0, 0.0), |pole| parts(*pole));
    Err(LinearError::NotStable { pole })
}

#[cfg(test)]
mod tests;
