//! `A = Z·T·Zᵀ` with a T that is triangular but for pairs on its diagonal: the eigenvalues, soundly.

use nalgebra::{Complex, SMatrix, SVector};

use super::complex::{modulus, real};
use super::error::LinearError;
use super::matrix::{is_finite, norm};
use super::real::Real;
use super::reflector::Reflector;

/// Steps of the QR algorithm for one eigenvalue before it gives up. It takes two or three; thirty is a rare matrix.
const STEPS: usize = 90;

/// Steps in which small entries must be so beside their neighbours; later beside the norm is enough. Where eigenvalues are
/// closer than rounding can tell, or nothing but rounding, the first may never be.
const PATIENCE: usize = 10;

/// Schur's form of a real matrix.
pub(crate) struct Schur<T, const N: usize> {
    /// Quasi-triangular: blocks of 2×2 on the diagonal are pairs of complex eigenvalues.
    pub(crate) triangle: SMatrix<T, N, N>,
    /// Orthogonal.
    pub(crate) basis: SMatrix<T, N, N>,
}

/// Schur's form of a real matrix, in complex numbers.
pub(crate) struct ComplexSchur<T, const N: usize> {
    /// Triangular, with the eigenvalues on the diagonal.
    pub(crate) triangle: SMatrix<Complex<T>, N, N>,
    /// Unitary.
    pub(crate) basis: SMatrix<Complex<T>, N, N>,
}

impl<T: Real, const N: usize> Schur<T, N> {
    /// Schur's form by Hessenberg's, and Francis's steps with double shifts.
    ///
    /// nalgebra's does not return on NaN, leaves scalars without a standard library out, and bounds N by a type.
    ///
    /// # Errors
    ///
    /// [`LinearError::NotFinite`], [`LinearError::NoConvergence`].
    ///
    /// # Source
    ///
    /// G. Golub, C. Van Loan, *Matrix Computations*, 4th ed., algorithms 7.4.2, 7.5.1 and 7.5.2; the test of small
    /// entries of M. Ahues, F. Tisseur, LAPACK Working Note 122.
    pub(crate) fn new(name: &'static str, a: &SMatrix<T, N, N>) -> Result<Self, LinearError> {
        LinearError::unless_finite(name, a)?;
        let scale = norm(a).power_of_two(); // so that squares of entries neither overflow nor vanish
        let mut schur = Self { triangle: a.map(|entry| entry / scale), basis: SMatrix::identity() };
        schur.reduce_to_hessenberg();
        schur.iterate()?;
        schur.triangle *= scale;
        if is_finite(&schur.triangle) { Ok(schur) } else { Err(LinearError::NoConvergence) }
    }

    /// Makes all below the first subdiagonal zero.
    fn reduce_to_hessenberg(&mut self) {
        for k in 1..N.saturating_sub(1) {
            let column = self.triangle.column(k - 1).into_owned();
            self.reflect(&Reflector::annihilating(&column, k..N));
            for i in k + 1..N {
                self.triangle[(i, k - 1)] = T::zero();
            }
        }
    }

    /// `T ← H·T·H`, `Z ← Z·H`.
    fn reflect(&mut self, reflector: &Reflector<T, N>) {
        reflector.left(&mut self.triangle);
        reflector.right(&mut self.triangle);
        reflector.right(&mut self.basis);
    }

    /// Splits eigenvalues off from below, one or two at a time.
    fn iterate(&mut self) -> Result<(), LinearError> {
        let (mut end, mut step) = (N, 0);
        while end > 0 {
            let start = self.start_of_block(end, step > PATIENCE);
            match end - start {
                1 => (end, step) = (start, 0),
                2 => {
                    self.split_pair(start);
                    (end, step) = (start, 0);
                }
                _ if step < STEPS => {
                    step += 1;
                    self.francis_step(start, end, step);
                }
                _ => return Err(LinearError::NoConvergence),
            }
        }
        Ok(())
    }

    /// The first row of the block that ends before `end`; the negligible entry before it is made zero.
    fn start_of_block(&mut self, end: usize, impatient: bool) -> usize {
        let t = &mut self.triangle;
        for k in (1..end).rev() {
            let (below, above) = (t[(k, k - 1)].abs(), t[(k - 1, k)].abs());
            let (first, second) = (t[(k - 1, k - 1)], t[(k, k)]);
            let size = first.abs() + second.abs();
            let size = if size == T::zero() { T::one() } else { size }; // the matrix has norm ½ to 1
            let close = below <= T::EPSILON * size && {
                let (large, little) = if below > above { (below, above) } else { (above, below) };
                let gap = (first - second).abs();
                let diagonal = second.abs().max(gap);
                let sum = diagonal + large;
                large * (little / sum) <= T::EPSILON * (second.abs() * (gap / sum)).max(T::EPSILON * size)
            };
            let small = close || impatient && below <= T::of(N as f64) * T::EPSILON;
            if small || below == T::zero() {
                t[(k, k - 1)] = T::zero();
                return k;
            }
        }
        0
    }

    /// One step on the rows `start..end`, of which there are three at least.
    fn francis_step(&mut self, start: usize, end: usize, step: usize) {
        let t = &self.triangle;
        let last = end - 1;
        // Both shifts from the last entry on: where all eigenvalues are close, their products say nothing.
        let origin = t[(last, last)];
        let (sum, product) = if step.is_multiple_of(10) {
            // Shifts that no matrix reproduces.
            let size = t[(last, last - 1)].abs() + t[(last - 1, last - 2)].abs();
            (T::of(1.5) * size, size * size)
        } else {
            (t[(last - 1, last - 1)] - origin, -t[(last - 1, last)] * t[(last, last - 1)])
        };
        let (x, below) = (t[(start, start)] - origin, t[(start + 1, start)]);
        let mut first = SVector::zeros();
        first[start] = x * (x - sum) + t[(start, start + 1)] * below + product;
        first[start + 1] = below * (x + (t[(start + 1, start + 1)] - origin) - sum);
        first[start + 2] = below * t[(start + 2, start + 1)];
        self.reflect(&Reflector::annihilating(&first, start..start + 3));
        for k in start + 1..last {
            let bulge = k..end.min(k + 3);
            let column = self.triangle.column(k - 1).into_owned();
            self.reflect(&Reflector::annihilating(&column, bulge.clone()));
            for i in bulge.skip(1) {
                self.triangle[(i, k - 1)] = T::zero();
            }
        }
    }

    /// Makes the 2×2 block at `k` triangular, if its eigenvalues are real.
    fn split_pair(&mut self, k: usize) {
        if let Pair::Real(shift, ..) = self.pair(k) {
            let mut eigenvector = SVector::zeros();
            eigenvector[k] = shift;
            eigenvector[k + 1] = self.triangle[(k + 1, k)];
            self.reflect(&Reflector::annihilating(&eigenvector, k..k + 2));
            self.triangle[(k + 1, k)] = T::zero();
        }
    }

    /// The eigenvalues of the 2×2 block at `k`.
    fn pair(&self, k: usize) -> Pair<T> {
        let t = &self.triangle;
        let (first, above, below, second) = (t[(k, k)], t[(k, k + 1)], t[(k + 1, k)], t[(k + 1, k + 1)]);
        let half = (first - second) * T::of(0.5);
        let (x, y) = (above.abs().sqrt(), below.abs().sqrt());
        let product = x * y; // √|above·below| does not overflow
        let scale = half.abs().max(product);
        if scale == T::zero() {
            return Pair::Real(T::zero(), first, second);
        }
        let (half, product) = (half / scale, product / scale);
        let sign = if (above > T::zero()) == (below > T::zero()) { T::one() } else { -T::one() };
        let discriminant = half * half + sign * product * product;
        if discriminant < T::zero() {
            return Pair::Complex(Complex::new(
                (first + second) * T::of(0.5),
                (-discriminant).sqrt() * scale,
            ));
        }
        let root = discriminant.sqrt();
        let shift = scale * if half < T::zero() { half - root } else { half + root };
        let other = if shift == T::zero() { second } else { second - above / shift * below };
        Pair::Real(shift, second + shift, other)
    }

    /// The eigenvalues, in the order of the diagonal; of a pair the one above the real axis first.
    pub(crate) fn eigenvalues(&self) -> SVector<Complex<T>, N> {
        let mut eigenvalues = SVector::from_fn(|i, _| real(self.triangle[(i, i)]));
        for k in 1..N {
            if self.triangle[(k, k - 1)] == T::zero() {
                continue;
            }
            if let Pair::Complex(value) = self.pair(k - 1) {
                (eigenvalues[k - 1], eigenvalues[k]) = (value, value.conj());
            }
        }
        eigenvalues
    }

    /// The form in complex numbers, whose T is a triangle.
    pub(crate) fn to_complex(&self) -> ComplexSchur<T, N> {
        let mut triangle = self.triangle.map(real);
        let mut basis = self.basis.map(real);
        let eigenvalues = self.eigenvalues();
        for k in 1..N {
            if self.triangle[(k, k - 1)] == T::zero() {
                continue;
            }
            // The eigenvector of the block becomes the first of two axes: (λ − t₂₂, t₂₁).
            let x = eigenvalues[k - 1] - real(self.triangle[(k, k)]);
            let y = self.triangle[(k, k - 1)];
            let scale = modulus(x).max(y.abs());
            let (x, y) = (Complex::new(x.re / scale, x.im / scale), real(y / scale));
            let length = (x.norm_sqr() + y.norm_sqr()).sqrt();
            let (x, y) = (Complex::new(x.re / length, x.im / length), real(y.re / length));
            for row in 0..N {
                for m in [&mut triangle, &mut basis] {
                    let (p, q) = (m[(row, k - 1)], m[(row, k)]);
                    m[(row, k - 1)] = p * x + q * y;
                    m[(row, k)] = q * x.conj() - p * y;
                }
            }
            for column in 0..N {
                let (p, q) = (triangle[(k - 1, column)], triangle[(k, column)]);
                triangle[(k - 1, column)] = p * x.conj() + q * y;
                triangle[(k, column)] = q * x - p * y;
            }
            triangle[(k, k - 1)] = real(T::zero());
            triangle[(k - 1, k - 1)] = eigenvalues[k - 1];
            triangle[(k, k)] = eigenvalues[k];
        }
        ComplexSchur { triangle, basis }
    }
}

/// The eigenvalues of a 2×2 block.
enum Pair<T> {
    /// What the first is above the last diagonal entry, the first, the second.
    Real(T, T, T),
    /// The one above the real axis.
    Complex(Complex<T>),
}

#[cfg(test)]
mod tests;
