//! The logarithm of a matrix: from a model in discrete time back to its rates.

use nalgebra::{Complex, SMatrix};

use super::balance::balanced;
use super::complex::{modulus, quotient, real, square_root};
use super::error::{LinearError, parts};
use super::lyapunov::multiplied;
use super::real::Real;
use super::schur::{ComplexSchur, Schur};

/// Square roots before they are given up: the exponent of a double halves to nothing in eleven.
const ROOTS: usize = 24;
/// Terms of the series; with ‖W‖ ≤ 1/7 what is left out is below 10⁻¹⁸.
const TERMS: usize = 10;

/// The X of `e^X = A` with eigenvalues between −π and π from the real axis, N×N.
///
/// By Schur's form, square roots of the triangle until it is near 1, and `2·artanh((T − 1)·(T + 1)⁻¹)`.
///
/// # Errors
///
/// [`LinearError::NoRate`] for an eigenvalue that is zero or on the negative real axis, which no real X has.
///
/// # Source
///
/// N. Higham, *Functions of Matrices* (2008), chapter 11; Å. Björck, S. Hammarling, *A Schur method for the square root
/// of a matrix*, Linear Algebra Appl. 52 (1983) 127–140.
pub(crate) fn logarithm<T: Real, const N: usize>(
    a: &SMatrix<T, N, N>,
) -> Result<SMatrix<T, N, N>, LinearError> {
    let (balanced, scales) = balanced(a);
    let ComplexSchur { triangle: mut t, basis } = Schur::new("A", &balanced)?.to_complex();
    for i in 0..N {
        let pole = t[(i, i)];
        if pole.re <= T::zero() && pole.im.abs() <= T::EPSILON * pole.re.abs() {
            return Err(LinearError::NoRate { pole: parts(pole) });
        }
    }
    let mut factor = T::of(2.0);
    for _ in 0..ROOTS {
        if distance_from_one(&t) <= T::of(0.25) {
            break;
        }
        t = root(&t);
        factor *= T::of(2.0);
    }
    let ratio = ratio(&t);
    let square = multiplied(&ratio, &ratio);
    let mut series = SMatrix::<Complex<T>, N, N>::zeros();
    for k in (0..TERMS).rev() {
        series = multiplied(&series, &square);
        let term = real(T::of(1.0 / (2 * k + 1) as f64));
        for i in 0..N {
            series[(i, i)] += term;
        }
    }
    let triangle = multiplied(&ratio, &series);
    let back = multiplied(&basis, &multiplied(&triangle, &basis.map(|entry| entry.conj()).transpose()));
    Ok(SMatrix::from_fn(|i, j| back[(i, j)].re * factor * (scales[i] / scales[j])))
}

/// The largest sum of magnitudes of a column of `T − 1`.
fn distance_from_one<T: Real, const N: usize>(t: &SMatrix<Complex<T>, N, N>) -> T {
    let entry = |i: usize, j: usize| modulus(if i == j { t[(i, j)] - real(T::one()) } else { t[(i, j)] });
    let column = |j: usize| (0..N).fold(T::zero(), |sum, i| sum + entry(i, j));
    (0..N).map(column).fold(T::zero(), Real::max)
}

/// The triangle whose square is a triangle, with eigenvalues in the right half plane.
fn root<T: Real, const N: usize>(t: &SMatrix<Complex<T>, N, N>) -> SMatrix<Complex<T>, N, N> {
    let mut r = SMatrix::<Complex<T>, N, N>::zeros();
    for j in 0..N {
        r[(j, j)] = square_root(t[(j, j)]);
        for i in (0..j).rev() {
            let known = (i + 1..j).fold(real(T::zero()), |sum, k| sum + r[(i, k)] * r[(k, j)]);
            r[(i, j)] = quotient(t[(i, j)] - known, r[(i, i)] + r[(j, j)]);
        }
    }
    r
}

/// `(T − 1)·(T + 1)⁻¹` of a triangle.
fn ratio<T: Real, const N: usize>(t: &SMatrix<Complex<T>, N, N>) -> SMatrix<Complex<T>, N, N> {
    let one = real(T::one());
    let mut x = SMatrix::<Complex<T>, N, N>::zeros();
    for j in 0..N {
        for i in 0..=j {
            let right = if i == j { t[(i, j)] - one } else { t[(i, j)] };
            let known = (i..j).fold(real(T::zero()), |sum, k| sum + x[(i, k)] * t[(k, j)]);
            x[(i, j)] = quotient(right - known, t[(j, j)] + one);
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::exponential::Exponential;
    use crate::linear::random::Random;

    #[test]
    fn it_undoes_the_exponential() {
        let mut random = Random::new(18);
        for scale in [1e-8, 0.01, 0.3, 1.0] {
            for _ in 0..10 {
                let a = random.matrix::<5, 5>() * scale;
                let exponential = Exponential::new(&a, 1.0).expect("it is finite").phi_0;
                let back = logarithm(&exponential).expect("its poles are right of the negative axis");
                // Rounding of e^A is absolute beside 1, so that small rates lose digits.
                assert!((back - a).norm() < 1e-13 * (1.0 + a.norm()), "{scale}: {}", (back - a).norm());
            }
        }
    }

    #[test]
    fn what_no_rate_makes_is_refused() {
        let flip = SMatrix::<f64, 2, 2>::from_diagonal(&[0.5, -0.5].into());
        assert_eq!(logarithm(&flip), Err(LinearError::NoRate { pole: (-0.5, 0.0) }));
        assert!(logarithm(&SMatrix::<f64, 2, 2>::zeros()).is_err());
    }
}
