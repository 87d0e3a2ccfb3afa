//! The matrix product, without the panic paths nalgebra's leaves where the compiler saves space.

use core::ops::Range;

use nalgebra::{ArrayStorage, SMatrix, SVector};

use crate::scalar::Scalar;

/// So many rows of a product are summed at a time: what fits into registers, in lanes.
const STRIP: usize = 8;
/// So many columns.
const COLUMNS: usize = 4;

/// `A·B`, R×C.
///
/// # Cost
///
/// R·K·C multiplications and additions, fused where the target can.
#[inline]
pub(crate) fn product<T: Scalar, const R: usize, const K: usize, const C: usize>(
    a: &SMatrix<T, R, K>,
    b: &SMatrix<T, K, C>,
) -> SMatrix<T, R, C> {
    let mut columns = [[T::zero(); R]; C];
    product_of_nonzero(&a.data.0, &b.data.0, |_| 0..K, &mut columns);
    SMatrix::from_array_storage(ArrayStorage(columns))
}

/// Writes `A·B`, by columns, where in a strip of rows A is zero but for the columns `nonzero(rows)`.
#[inline]
pub(crate) fn product_of_nonzero<T: Scalar, const R: usize, const K: usize, const C: usize>(
    a: &[[T; R]; K],
    b: &[[T; K]; C],
    nonzero: impl Fn(Range<usize>) -> Range<usize> + Copy,
    columns: &mut [[T; R]; C],
) {
    let (blocks, rest) = columns.as_chunks_mut::<COLUMNS>();
    let (factors, factors_of_rest) = b.as_chunks::<COLUMNS>();
    for (block, factors) in blocks.iter_mut().zip(factors) {
        multiply(a, factors, block, nonzero);
    }
    for (column, factors) in rest.iter_mut().zip(factors_of_rest) {
        multiply(a, core::array::from_ref(factors), core::array::from_mut(column), nonzero);
    }
}

/// W columns of the product: strip by strip of their rows, each summed over the columns of `a` in registers.
#[inline(always)]
fn multiply<T: Scalar, const R: usize, const K: usize, const W: usize>(
    a: &[[T; R]; K],
    factors: &[[T; K]; W],
    result: &mut [[T; R]; W],
    nonzero: impl Fn(Range<usize>) -> Range<usize>,
) {
    let terms = |rows: Range<usize>| {
        let range = nonzero(rows);
        a.iter().enumerate().take(range.end).skip(range.start)
    };
    for strip in 0..R / STRIP {
        let mut sums = [[T::zero(); STRIP]; W];
        for (k, column) in terms(strip * STRIP..(strip + 1) * STRIP) {
            if let Some(part) = column.as_chunks::<STRIP>().0.get(strip) {
                add_multiples(&mut sums, part, factors, k);
            }
        }
        for (result, sums) in result.iter_mut().zip(sums) {
            if let Some(part) = result.as_chunks_mut::<STRIP>().0.get_mut(strip) {
                *part = sums;
            }
        }
    }
    let mut sums = [[T::zero(); STRIP]; W];
    for (k, column) in terms(R / STRIP * STRIP..R) {
        add_multiples(&mut sums, column.as_chunks::<STRIP>().1, factors, k);
    }
    for (result, sums) in result.iter_mut().zip(sums) {
        for (entry, sum) in result.as_chunks_mut::<STRIP>().1.iter_mut().zip(sums) {
            *entry = sum;
        }
    }
}

/// Adds to each sum the part, times the column's `k`-th factor.
#[inline(always)]
fn add_multiples<T: Scalar, const K: usize, const W: usize>(
    sums: &mut [[T; STRIP]; W],
    part: &[T],
    factors: &[[T; K]; W],
    k: usize,
) {
    for (sums, factors) in sums.iter_mut().zip(factors) {
        let Some(factor) = factors.get(k) else { continue };
        for (sum, a) in sums.iter_mut().zip(part) {
            *sum = a.mul_add(*factor, *sum);
        }
    }
}

/// `Aᵀ·b`, C.
#[inline]
pub(crate) fn transposed_product<T: Scalar, const R: usize, const C: usize>(
    a: &SMatrix<T, R, C>,
    b: &SVector<T, R>,
) -> SVector<T, C> {
    let [b] = &b.data.0;
    SMatrix::from_array_storage(ArrayStorage([a.data.0.each_ref().map(|a| sum_of_products(a, b))]))
}

/// `aᵀ·b`
#[inline]
pub(crate) fn dot<T: Scalar, const N: usize>(a: &SVector<T, N>, b: &SVector<T, N>) -> T {
    let ([a], [b]) = (&a.data.0, &b.data.0);
    sum_of_products(a, b)
}

#[inline(always)]
fn sum_of_products<T: Scalar, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    a.iter().zip(b).fold(T::zero(), |sum, (a, b)| a.mul_add(*b, sum))
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
