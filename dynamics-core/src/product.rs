//! The matrix product, without the panic paths nalgebra's leaves where the compiler saves space.

use nalgebra::{ArrayStorage, SMatrix, SVector};

use crate::scalar::Scalar;

/// `A·B`, R×C, as sums over the columns of `A`.
#[inline]
pub(crate) fn product<T: Scalar, const R: usize, const K: usize, const C: usize>(
    a: &SMatrix<T, R, K>,
    b: &SMatrix<T, K, C>,
) -> SMatrix<T, R, C> {
    let mut columns = [[T::zero(); R]; C];
    for (sum, b) in columns.iter_mut().zip(&b.data.0) {
        for (a, b) in a.data.0.iter().zip(b) {
            for (sum, a) in sum.iter_mut().zip(a) {
                *sum = a.mul_add(*b, *sum);
            }
        }
    }
    SMatrix::from_array_storage(ArrayStorage(columns))
}

/// `Aᵀ·b`, C.
#[inline]
pub(crate) fn transposed_product<T: Scalar, const R: usize, const C: usize>(
    a: &SMatrix<T, R, C>,
    b: &SVector<T, R>,
) -> SVector<T, C> {
    let [b] = &b.data.0;
    let dot = |a: &[T; R]| a.iter().zip(b).fold(T::zero(), |sum, (a, b)| a.mul_add(*b, sum));
    SMatrix::from_array_storage(ArrayStorage([a.data.0.each_ref().map(dot)]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_nalgebra() {
        let a = SMatrix::<f64, 2, 3>::from([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]);
        let b = SMatrix::<f64, 3, 2>::from([[1.0, -1.0, 2.0], [0.5, 3.0, -2.0]]);
        assert_eq!(product(&a, &b), a * b);
        let c = SVector::from([7.0, -1.0]);
        assert_eq!(transposed_product(&a, &c), a.transpose() * c);
    }
}
