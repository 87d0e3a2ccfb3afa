//! Factoring a mass matrix along its tree, and solving with many right-hand sides at once.
//!
//! By the inverse of the triangular factor: that is the product of two triangular matrices with the right-hand sides,
//! in lanes, with no step that waits for another. Unlike `M⁻¹` itself it loses nothing to the condition of M: all that
//! is ill-conditioned stays in D.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, §6.5; J. Du Croz, N. Higham, *Stability of methods
//! for matrix inversion*, IMA Journal of Numerical Analysis 12, 1992, for the inverse of a triangular matrix.

use crate::product::product_of_nonzero;
use crate::scalar::Scalar;

/// So many columns are summed at a time.
const STRIP: usize = 16;

/// `M⁻¹ = R D⁻¹ Rᵀ`, where `M = Lᵀ D L` and `R = L⁻¹`; both are unit lower triangular.
pub struct Factors<T, const N: usize> {
    /// `R`, by columns.
    r: [[T; N]; N],
    /// `Rᵀ`, by columns.
    r_transposed: [[T; N]; N],
    inverse_d: [T; N],
}

impl<T: Scalar, const N: usize> Factors<T, N> {
    /// Of a symmetric positive definite matrix, of which the rows up to the diagonal are read.
    ///
    /// # Cost
    ///
    /// N³/3 multiplications and additions, fused where the target can; N divisions.
    #[inline]
    pub fn of(m: &[[T; N]; N]) -> Self {
        let mut factors = Self { r: *m, r_transposed: [[T::zero(); N]; N], inverse_d: [T::one(); N] };
        let Self { r, r_transposed, inverse_d } = &mut factors;
        factor(r, inverse_d);
        invert_triangular(r, r_transposed);
        transpose_triangular(r_transposed, r);
        factors
    }

    /// Writes `−M⁻¹·B`, both by columns.
    ///
    /// # Cost
    ///
    /// About N² multiplications and additions for each column, fused where the target can.
    #[inline]
    pub fn minus_solve<const M: usize>(&self, b: &[[T; N]; M], result: &mut [[T; N]; M]) {
        let mut x = [[T::zero(); N]; M];
        product_of_nonzero(&self.r_transposed, b, |rows| rows.start..N, &mut x);
        let minus_inverse_d = self.inverse_d.map(|x| -x);
        x.iter_mut().for_each(|column| scale(column, &minus_inverse_d));
        product_of_nonzero(&self.r, &x, |rows| 0..rows.end, result);
    }

    /// Writes `M⁻¹`, both halves.
    #[inline]
    pub fn inverse(&self, result: &mut [[T; N]; N]) {
        let mut x = self.r_transposed;
        x.iter_mut().for_each(|column| scale(column, &self.inverse_d));
        product_of_nonzero(&self.r, &x, |rows| 0..rows.end, result);
    }
}

#[inline(always)]
fn scale<T: Scalar, const N: usize>(column: &mut [T; N], factors: &[T; N]) {
    for (entry, factor) in column.iter_mut().zip(factors) {
        *entry *= *factor;
    }
}

/// `M` in place by the rows of `L` before the diagonal, with anything on it and beyond; and `1/D`.
#[inline]
fn factor<T: Scalar, const N: usize>(l: &mut [[T; N]; N], inverse_d: &mut [T; N]) {
    let mut d = [T::one(); N];
    for k in (0..N).rev() {
        let Some((_, [row, beyond @ ..])) = l.split_at_mut_checked(k) else { continue };
        let beyond_d = d.get(k + 1..).unwrap_or_default();
        for (strip, part) in row.chunks_mut(STRIP).enumerate().take(k / STRIP + 1) {
            let others = beyond
                .iter()
                .zip(beyond_d)
                .map(|(other, d)| (entry(other, k) * *d, other.get(strip * STRIP..).unwrap_or_default()));
            subtract_all(part, others);
        }
        let pivot = entry(row, k);
        let inverse = T::one() / pivot;
        for entry in row.iter_mut().take(k) {
            *entry *= inverse;
        }
        if let (Some(d), Some(inverse_d)) = (d.get_mut(k), inverse_d.get_mut(k)) {
            (*d, *inverse_d) = (pivot, inverse);
        }
    }
}

/// Writes the rows of `L⁻¹`: each that of the identity less those before it, `L[i][j]` times.
#[inline]
fn invert_triangular<T: Scalar, const N: usize>(l: &[[T; N]; N], inverse: &mut [[T; N]; N]) {
    for (i, l) in l.iter().enumerate() {
        let Some((before, [row, ..])) = inverse.split_at_mut_checked(i) else { continue };
        if let Some(diagonal) = row.get_mut(i) {
            *diagonal = T::one();
        }
        for (strip, part) in row.chunks_mut(STRIP).enumerate().take(i / STRIP + 1) {
            let first = strip * STRIP;
            let others = l.iter().zip(&*before).skip(first);
            subtract_all(part, others.map(|(l, row)| (*l, row.get(first..).unwrap_or_default())));
        }
    }
}

/// Writes the transpose of a lower triangular matrix, all of it.
#[inline]
fn transpose_triangular<T: Scalar, const N: usize>(m: &[[T; N]; N], result: &mut [[T; N]; N]) {
    for (j, column) in result.iter_mut().enumerate() {
        for (i, (value, row)) in column.iter_mut().zip(m).enumerate() {
            *value = if j <= i { entry(row, j) } else { T::zero() };
        }
    }
}

/// Subtracts multiples of rows: the even and the odd ones in two sums, whose chains run side by side.
#[inline(always)]
fn subtract_all<'r, T: Scalar + 'r>(row: &mut [T], mut others: impl Iterator<Item = (T, &'r [T])>) {
    let (mut sums, mut odd) = ([T::zero(); STRIP], [T::zero(); STRIP]);
    for (sum, value) in sums.iter_mut().zip(&*row) {
        *sum = *value;
    }
    while let Some((factor, other)) = others.next() {
        subtract(&mut sums, factor, other);
        if let Some((factor, other)) = others.next() {
            subtract(&mut odd, factor, other);
        }
    }
    for (value, (sum, odd)) in row.iter_mut().zip(sums.into_iter().zip(odd)) {
        *value = sum + odd;
    }
}

/// `sums − factor·other`
#[inline(always)]
fn subtract<T: Scalar>(sums: &mut [T; STRIP], factor: T, other: &[T]) {
    let factor = -factor;
    match other.first_chunk::<STRIP>() {
        Some(other) => {
            for (sum, value) in sums.iter_mut().zip(other) {
                *sum = factor.mul_add(*value, *sum);
            }
        }
        None => {
            for (sum, value) in sums.iter_mut().zip(other) {
                *sum = factor.mul_add(*value, *sum);
            }
        }
    }
}

#[inline(always)]
fn entry<T: Scalar>(x: &[T], k: usize) -> T {
    x.get(k).copied().unwrap_or_else(T::zero)
}
