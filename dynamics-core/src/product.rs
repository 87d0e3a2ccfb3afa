//! The matrix product, without the panic paths nalgebra's leaves where the compiler saves space.

use nalgebra::{ArrayStorage, SMatrix, SVector};

use crate::scalar::Scalar;

/// So many rows of a product are summed at a time: what is one register, in lanes.
pub(crate) const STRIP: usize = 4;
/// So many columns, which keeps the sums in registers.
pub(crate) const COLUMNS: usize = if WIDE { 8 } else { 4 };
/// So many rows of four columns, for the same reason.
pub(crate) const LONG_STRIP: usize = if WIDE { 8 } else { 4 };
/// Whether 32 doubles, and what they are made of, fit into the registers.
const WIDE: bool = cfg!(any(target_feature = "avx", target_arch = "aarch64"));
/// So many columns at a time where a scalar [has lanes](has_lanes) of its own.
pub(crate) const FEW_COLUMNS: usize = 4;

/// Whether a scalar is more than one number, so that it fills registers by itself: rows are no lanes then.
pub(crate) const fn has_lanes<T>() -> bool {
    size_of::<T>() > size_of::<f64>()
}

/// So many rows of [`FEW_COLUMNS`] as half of the registers hold, for a scalar with lanes.
pub(crate) const fn few_rows<T>() -> usize {
    const REGISTERS: usize =
        if cfg!(any(target_feature = "avx512f", target_arch = "aarch64")) { 32 } else { 16 };
    const BYTES: usize = match () {
        () if cfg!(target_feature = "avx512f") => 64,
        () if cfg!(target_feature = "avx") => 32,
        () => 16,
    };
    match REGISTERS / 2 / FEW_COLUMNS / size_of::<T>().div_ceil(BYTES) {
        0 | 1 => 1,
        2 | 3 => 2,
        _ => 4,
    }
}

/// `by_rows!(T, ROWS = 8, expression)`: the expression with the constant `ROWS`, so many rows as are summed at a time:
/// [few](few_rows) of a scalar with lanes, or else these. Each sum is made in the same order.
macro_rules! by_rows {
    ($scalar:ident, $rows:ident = $most:expr, $expression:expr) => {
        match const {
            if $crate::product::has_lanes::<$scalar>() { $crate::product::few_rows::<$scalar>() } else { 0 }
        } {
            0 => {
                const $rows: usize = $most;
                $expression
            }
            1 => {
                const $rows: usize = 1;
                $expression
            }
            2 => {
                const $rows: usize = 2;
                $expression
            }
            _ => {
                const $rows: usize = 4;
                $expression
            }
        }
    };
}
pub(crate) use by_rows;

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
    macro_rules! multiply_by {
        ($width:ident) => {
            let (blocks, rest) = columns.as_chunks_mut::<$width>();
            let (factors, factors_of_rest) = b.data.0.as_chunks::<$width>();
            for (block, factors) in blocks.iter_mut().zip(factors) {
                by_rows!(
                    T,
                    ROWS = STRIP,
                    multiply::<T, R, $width, ROWS, _>(&a.data.0, |k| row_of(factors, k), |_| 0..K, block)
                );
            }
            for (column, factors) in rest.iter_mut().zip(factors_of_rest) {
                let (column, factors) = (core::array::from_mut(column), core::array::from_ref(factors));
                by_rows!(
                    T,
                    ROWS = STRIP,
                    multiply::<T, R, 1, ROWS, _>(&a.data.0, |k| row_of(factors, k), |_| 0..K, column)
                );
            }
        };
    }
    if const { has_lanes::<T>() } {
        multiply_by!(FEW_COLUMNS);
    } else {
        multiply_by!(COLUMNS);
    }
    SMatrix::from_array_storage(ArrayStorage(columns))
}

/// Where a part of so many begins. The last one begins early enough to be full: a few rows or columns one by one take
/// longer than a full part in lanes. What it makes of rows of the part before is that part's to write again, from the terms
/// that these rows have; so strips are computed from the last to the first.
pub(crate) const fn first_of(part: usize, size: usize, whole: usize) -> usize {
    let (first, last) = (part * size, whole.saturating_sub(size));
    if first < last { first } else { last }
}

/// Where parts of so many begin, which are all full if there are as many at all.
#[inline(always)]
pub(crate) fn parts(size: usize, whole: usize) -> impl Iterator<Item = usize> {
    (0..whole.div_ceil(size)).map(move |part| first_of(part, size, whole))
}

/// Row `k` of a matrix given by columns.
#[inline(always)]
pub(crate) fn row_of<T: Scalar, const K: usize, const W: usize>(columns: &[[T; K]; W], k: usize) -> [T; W] {
    // `map` of arrays is not always inlined.
    let mut row = [T::zero(); W];
    for (entry, column) in row.iter_mut().zip(columns) {
        *entry = column.get(k).copied().unwrap_or_else(T::zero);
    }
    row
}

/// S rows of W columns of a product: the sum of column `k` of `a` times `factors(k)` over all `k` in `terms`.
#[inline(always)]
pub(crate) fn products<T: Scalar, const R: usize, const W: usize, const S: usize>(
    a: &[[T; R]],
    factors: impl Fn(usize) -> [T; W],
    terms: impl Iterator<Item = usize>,
    strip: usize,
) -> [[T; S]; W] {
    let mut sums = [[T::zero(); S]; W];
    add_products(a, factors, terms, strip, &mut sums);
    sums
}

/// Writes W columns of a product: S rows at a time, from `row` on, the sum of column `k` of `a` times `factors(k)` over all `k`
/// in `terms(row)`.
#[inline(always)]
pub(crate) fn multiply<
    T: Scalar,
    const R: usize,
    const W: usize,
    const S: usize,
    I: Iterator<Item = usize>,
>(
    a: &[[T; R]],
    factors: impl Fn(usize) -> [T; W],
    terms: impl Fn(usize) -> I,
    result: &mut [[T; R]; W],
) {
    for part in (0..R.div_ceil(S)).rev() {
        let sums: [[T; S]; W] = products(a, &factors, terms(part * S), part);
        write_strip(result, part, &sums);
    }
}

/// Adds to a strip of S rows of a product column `k` of `a` times `factors(k)`, for all `k` in `terms`. The sums stay in
/// registers.
#[inline(always)]
pub(crate) fn add_products<T: Scalar, const R: usize, const W: usize, const S: usize>(
    a: &[[T; R]],
    factors: impl Fn(usize) -> [T; W],
    terms: impl Iterator<Item = usize>,
    strip: usize,
    sums: &mut [[T; S]; W],
) {
    // Spelt out: in a reference they would be in memory.
    let mut own = *sums;
    let first = first_of(strip, S, R);
    if first + S <= R {
        for k in terms {
            let rows = a.get(k).and_then(|column| column.get(first..first + S));
            if let Some(part) = rows {
                add_multiples(&mut own, part, factors(k));
            }
        }
    } else {
        // Fewer rows than a strip has.
        for k in terms {
            if let Some(column) = a.get(k) {
                add_multiples(&mut own, column, factors(k));
            }
        }
    }
    *sums = own;
}

/// Writes a strip of each column.
#[inline(always)]
pub(crate) fn write_strip<T: Scalar, const R: usize, const W: usize, const S: usize>(
    columns: &mut [[T; R]; W],
    strip: usize,
    sums: &[[T; S]; W],
) {
    for (column, sums) in columns.iter_mut().zip(sums) {
        let rows = column.get_mut(first_of(strip, S, R)..).unwrap_or_default();
        match rows.first_chunk_mut() {
            Some(part) => *part = *sums,
            None => rows.iter_mut().zip(sums).for_each(|(value, sum)| *value = *sum),
        }
    }
}

/// Adds to each sum the part, times its own factor.
#[inline(always)]
fn add_multiples<T: Scalar, const W: usize, const S: usize>(
    sums: &mut [[T; S]; W],
    part: &[T],
    factors: [T; W],
) {
    for (sums, factor) in sums.iter_mut().zip(factors) {
        for (sum, a) in sums.iter_mut().zip(part) {
            *sum = a.mul_add(factor, *sum);
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
