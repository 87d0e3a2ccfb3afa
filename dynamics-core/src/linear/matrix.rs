//! What is asked of matrices here and nalgebra has only for scalars with a standard library.

use nalgebra::SMatrix;

use super::real::Real;
use crate::product::product;

/// `√Σ aᵢⱼ²`, without overflow between.
pub(crate) fn norm<T: Real, const R: usize, const C: usize>(a: &SMatrix<T, R, C>) -> T {
    let scale = a.iter().fold(T::zero(), |largest, entry| largest.max(entry.abs()));
    if !(scale > T::zero() && scale.is_finite()) {
        return scale;
    }
    let square = |entry: &T| (*entry / scale) * (*entry / scale);
    scale * a.iter().map(square).fold(T::zero(), |sum, term| sum + term).sqrt()
}

/// The largest sum of magnitudes of a column.
pub(crate) fn norm_1<T: Real, const R: usize, const C: usize>(a: &SMatrix<T, R, C>) -> T {
    let sum = |column: &[T; R]| column.iter().fold(T::zero(), |sum, entry| sum + entry.abs());
    a.data.0.iter().map(sum).fold(T::zero(), Real::max)
}

/// `(A + Aᵀ)/2`.
pub(crate) fn symmetric_part<T: Real, const N: usize>(a: &SMatrix<T, N, N>) -> SMatrix<T, N, N> {
    (a + a.transpose()) * T::of(0.5)
}

/// `A·B·C`.
pub(crate) fn product_3<T: Real, const I: usize, const J: usize, const K: usize, const L: usize>(
    a: &SMatrix<T, I, J>,
    b: &SMatrix<T, J, K>,
    c: &SMatrix<T, K, L>,
) -> SMatrix<T, I, L> {
    product(a, &product(b, c))
}

/// Whether every entry is finite.
pub(crate) fn is_finite<T: Real, const R: usize, const C: usize>(a: &SMatrix<T, R, C>) -> bool {
    a.iter().all(|entry| entry.is_finite())
}

/// The rounding errors to allow for in a matrix of this size: `10·N·ε`.
///
/// Orthogonal transformations of an N×N matrix err by a modest multiple of `N·ε` of its norm (Higham 2002, §19.3);
/// ten covers the multiple, and the errors with which the data came.
pub(crate) fn rounding<T: Real, const N: usize>() -> T {
    T::of(10.0) * T::of(N.max(1) as f64) * T::EPSILON
}
