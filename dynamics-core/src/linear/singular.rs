//! The smallest singular value of complex matrices, to its own last digits.

use nalgebra::{Complex, SMatrix};

use super::complex::{modulus, real};
use super::real::Real;
use super::symmetric::jacobi_tangent;

/// Sweeps of Jacobi's method before it gives up; it needs six to ten.
const SWEEPS: usize = 40;

/// `min σ([A − λ·1, B])`: how far the nearest `(A, B)` is of which λ is a mode that the inputs do not reach.
///
/// The rows are turned against each other until they are orthogonal; their lengths then are the singular values. No
/// product `M·Mᴴ` is formed, which would leave half of the digits. Pass a B of no columns for `min σ(A − λ·1)`.
///
/// # Source
///
/// M. Hestenes, *Inversion of matrices by biorthogonalization*, J. SIAM 6 (1958) 51–90; J. Demmel, K. Veselić,
/// *Jacobi's method is more accurate than QR*, SIAM J. Matrix Anal. Appl. 13 (1992) 1204–1245.
pub(crate) fn smallest_singular_value<T: Real, const N: usize, const M: usize>(
    a: &SMatrix<T, N, N>,
    b: &SMatrix<T, N, M>,
    shift: Complex<T>,
) -> T {
    let entries = a.iter().chain(b.iter()).map(|entry| entry.abs());
    let scale = entries.fold(modulus(shift), Real::max).power_of_two();
    let shift = Complex::new(shift.re / scale, shift.im / scale);
    let mut left = a.map(|entry| real(entry / scale));
    for i in 0..N {
        left[(i, i)] -= shift;
    }
    let mut rows = Rows { left, right: b.map(|entry| real(entry / scale)) };
    for _ in 0..SWEEPS {
        let mut turned = false;
        for p in 0..N {
            for q in p + 1..N {
                turned |= rows.orthogonalise(p, q);
            }
        }
        if !turned {
            break;
        }
    }
    (1..N).map(|i| rows.square(i)).fold(if N == 0 { T::zero() } else { rows.square(0) }, minimum).sqrt()
        * scale
}

fn minimum<T: Real>(x: T, y: T) -> T {
    if y < x { y } else { x }
}

/// `[left, right]`, by rows: the sum of two widths is no width that stable Rust can write.
struct Rows<T, const N: usize, const M: usize> {
    left: SMatrix<Complex<T>, N, N>,
    right: SMatrix<Complex<T>, N, M>,
}

impl<T: Real, const N: usize, const M: usize> Rows<T, N, M> {
    /// `‖row‖²`.
    fn square(&self, row: usize) -> T {
        let left = (0..N).map(|k| self.left[(row, k)].norm_sqr());
        left.chain((0..M).map(|k| self.right[(row, k)].norm_sqr())).fold(T::zero(), |sum, term| sum + term)
    }

    /// Turns two rows in their plane until they are orthogonal; false if they were.
    fn orthogonalise(&mut self, p: usize, q: usize) -> bool {
        let left = (0..N).map(|k| self.left[(p, k)] * self.left[(q, k)].conj());
        let right = (0..M).map(|k| self.right[(p, k)] * self.right[(q, k)].conj());
        let inner = left.chain(right).fold(real(T::zero()), |sum, term| sum + term);
        let (first, second, size) = (self.square(p), self.square(q), modulus(inner));
        let negligible = T::of((N + M) as f64) * T::EPSILON * first.sqrt() * second.sqrt();
        if size <= negligible || !size.is_finite() {
            return false;
        }
        let phase = Complex::new(inner.re / size, inner.im / size);
        let tangent = jacobi_tangent(first, second, size);
        let cosine = T::one() / tangent.mul_add(tangent, T::one()).sqrt();
        let sine = tangent * cosine;
        let (cosine, sine) = (real(cosine), real(sine));
        let turn = |x: &mut Complex<T>, y: &mut Complex<T>| {
            let turned = *y * phase;
            (*x, *y) = (*x * cosine - turned * sine, *x * sine + turned * cosine);
        };
        for k in 0..N {
            let (mut x, mut y) = (self.left[(p, k)], self.left[(q, k)]);
            turn(&mut x, &mut y);
            (self.left[(p, k)], self.left[(q, k)]) = (x, y);
        }
        for k in 0..M {
            let (mut x, mut y) = (self.right[(p, k)], self.right[(q, k)]);
            turn(&mut x, &mut y);
            (self.right[(p, k)], self.right[(q, k)]) = (x, y);
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::random::Random;

    #[test]
    fn it_is_that_of_nalgebra() {
        let mut random = Random::new(3);
        for _ in 0..20 {
            let (a, b) = (random.matrix::<5, 5>(), random.matrix::<5, 2>());
            let shift = Complex::new(random.number(), random.number());
            let whole = SMatrix::<Complex<f64>, 5, 7>::from_fn(|i, j| match j {
                0..5 => real(a[(i, j)]) - if i == j { shift } else { real(0.0) },
                _ => real(b[(i, j - 5)]),
            });
            let theirs = whole.singular_values().min();
            let ours = smallest_singular_value(&a, &b, shift);
            assert!((ours - theirs).abs() < 1e-14, "{ours} for {theirs}");
        }
    }

    #[test]
    fn small_values_keep_their_digits() {
        // Rows of very different lengths: the Gram matrix would round the small one off.
        let a = SMatrix::<f64, 2, 2>::from([[1e12, 0.0], [1e12, 1e-12]]);
        let ours = smallest_singular_value(&a, &SMatrix::<f64, 2, 0>::zeros(), real(0.0));
        let exact = 1e-12 / 2f64.sqrt(); // |det| / σ_max
        assert!((ours / exact - 1.0).abs() < 1e-14, "{ours:e}");
        assert_eq!(smallest_singular_value(&a, &SMatrix::<f64, 2, 1>::zeros(), real(1e12)), 0.0);
    }
}
