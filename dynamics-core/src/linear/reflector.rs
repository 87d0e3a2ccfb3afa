//! Householder's reflections of a few neighbouring coordinates.

use core::ops::Range;

use nalgebra::{SMatrix, SVector};

use super::real::Real;

/// `I − factor·v·vᵀ`, with a `v` that is zero outside of a range.
pub(crate) struct Reflector<T, const N: usize> {
    v: SVector<T, N>,
    factor: T,
    range: Range<usize>,
}

impl<T: Real, const N: usize> Reflector<T, N> {
    /// The reflection that makes `x` zero in `range`, but for the first entry there.
    pub(crate) fn annihilating(x: &SVector<T, N>, range: Range<usize>) -> Self {
        let (first, rest) = (range.start, range.start + 1..range.end);
        let mut v = SVector::zeros();
        let scale = range.clone().fold(T::zero(), |largest, i| largest.max(x[i].abs()));
        if !rest.clone().any(|i| x[i] != T::zero()) || !scale.is_finite() {
            return Self { v, factor: T::zero(), range };
        }
        let square = range.clone().fold(T::zero(), |sum, i| sum + (x[i] / scale) * (x[i] / scale));
        let length = scale * square.sqrt();
        let image = if x[first] > T::zero() { -length } else { length };
        v[first] = T::one();
        for i in rest {
            v[i] = x[i] / (x[first] - image);
        }
        Self { v, factor: (image - x[first]) / image, range }
    }

    /// `M ← H·M`.
    pub(crate) fn left<const C: usize>(&self, m: &mut SMatrix<T, N, C>) {
        for column in 0..C {
            let sum = self.range.clone().fold(T::zero(), |sum, i| self.v[i].mul_add(m[(i, column)], sum))
                * self.factor;
            for i in self.range.clone() {
                m[(i, column)] -= self.v[i] * sum;
            }
        }
    }

    /// `M ← M·H`.
    pub(crate) fn right<const R: usize>(&self, m: &mut SMatrix<T, R, N>) {
        for row in 0..R {
            let sum = self.range.clone().fold(T::zero(), |sum, i| self.v[i].mul_add(m[(row, i)], sum))
                * self.factor;
            for i in self.range.clone() {
                m[(row, i)] -= self.v[i] * sum;
            }
        }
    }
}
