//! `P·A = L·U` by elimination with scaled partial pivoting.

use nalgebra::SMatrix;

use super::real::Real;

/// The factors of a square matrix, in one.
///
/// nalgebra's ask for a scalar with a standard library, and choose the pivot without a look at the scale of its row.
pub(crate) struct Lu<T, const N: usize> {
    factors: SMatrix<T, N, N>,
    rows: [usize; N],
}

impl<T: Real, const N: usize> Lu<T, N> {
    /// Factors `a`; `None` if a pivot is zero or not finite.
    pub(crate) fn new(a: &SMatrix<T, N, N>) -> Option<Self> {
        let (mut factors, mut rows) = (*a, core::array::from_fn(|i| i));
        let largest = |i: usize| (0..N).fold(T::zero(), |largest, j| largest.max(a[(i, j)].abs()));
        let mut scales: [T; N] = core::array::from_fn(largest);
        for k in 0..N {
            let size = |i: usize| factors[(i, k)].abs() / scales[i];
            let pivot = (k + 1..N).fold(k, |best, i| if size(i) > size(best) { i } else { best });
            factors.swap_rows(k, pivot);
            rows.swap(k, pivot);
            scales.swap(k, pivot);
            let divisor = factors[(k, k)];
            if divisor == T::zero() || !divisor.is_finite() {
                return None;
            }
            for i in k + 1..N {
                factors[(i, k)] /= divisor;
            }
            for j in k + 1..N {
                let above = factors[(k, j)];
                for i in k + 1..N {
                    factors[(i, j)] = (-factors[(i, k)]).mul_add(above, factors[(i, j)]);
                }
            }
        }
        Some(Self { factors, rows })
    }

    /// `A⁻¹·B`, N×C.
    pub(crate) fn solve<const C: usize>(&self, b: &SMatrix<T, N, C>) -> SMatrix<T, N, C> {
        let mut x = SMatrix::from_fn(|i, j| b[(self.rows[i], j)]);
        for column in 0..C {
            for k in 0..N {
                for i in k + 1..N {
                    x[(i, column)] = (-self.factors[(i, k)]).mul_add(x[(k, column)], x[(i, column)]);
                }
            }
            for k in (0..N).rev() {
                x[(k, column)] /= self.factors[(k, k)];
                for i in 0..k {
                    x[(i, column)] = (-self.factors[(i, k)]).mul_add(x[(k, column)], x[(i, column)]);
                }
            }
        }
        x
    }

    /// `A⁻ᵀ·B`, N×C.
    pub(crate) fn solve_transposed<const C: usize>(&self, b: &SMatrix<T, N, C>) -> SMatrix<T, N, C> {
        let mut x = *b;
        for column in 0..C {
            for k in 0..N {
                for i in 0..k {
                    x[(k, column)] = (-self.factors[(i, k)]).mul_add(x[(i, column)], x[(k, column)]);
                }
                x[(k, column)] /= self.factors[(k, k)];
            }
            for k in (0..N).rev() {
                for i in k + 1..N {
                    x[(k, column)] = (-self.factors[(i, k)]).mul_add(x[(i, column)], x[(k, column)]);
                }
            }
        }
        let mut unordered = x;
        for (i, &row) in self.rows.iter().enumerate() {
            for column in 0..C {
                unordered[(row, column)] = x[(i, column)];
            }
        }
        unordered
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: [[f64; 3]; 3] = [[0.0, 2e9, 3.0], [1.0, -1e9, 0.5], [4.0, 0.0, 1.0]];

    #[test]
    fn solves_what_it_was_made_of() {
        let a = SMatrix::<f64, 3, 3>::from(A);
        let x = SMatrix::<f64, 3, 2>::from([[1.0, -2.0, 0.5], [0.0, 3.0, 7.0]]);
        let lu = Lu::new(&a).expect("it is regular");
        assert!((lu.solve(&(a * x)) - x).amax() < 1e-13);
        assert!((lu.solve_transposed(&(a.transpose() * x)) - x).amax() < 1e-13);
    }

    #[test]
    fn singular_and_not_finite_matrices_have_no_factors() {
        assert!(Lu::new(&SMatrix::<f64, 2, 2>::from([[1.0, 2.0], [2.0, 4.0]])).is_none());
        assert!(Lu::new(&SMatrix::<f64, 2, 2>::from([[f64::NAN, 2.0], [2.0, 4.0]])).is_none());
        assert!(Lu::new(&SMatrix::<f64, 0, 0>::zeros()).is_some());
    }
}
