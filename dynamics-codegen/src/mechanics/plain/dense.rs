//! Dense linear algebra: Cholesky, and the products that residuals need.
//!
//! G. Golub, C. Van Loan, *Matrix Computations*, Johns Hopkins 2013, ch. 4.2.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use crate::symbolic::Real;

/// A matrix, by rows.
pub type Rows<S = f64> = Vec<Vec<S>>;

/// The factor `L` of a symmetric positive definite `M = L Lᵀ`.
#[derive(Clone, Debug)]
pub struct Cholesky<S = f64> {
    L: Rows<S>,
}

impl<S: Real> Cholesky<S> {
    /// Factors `M`, of which it reads the lower half. `None` unless every pivot is positive.
    pub fn of(M: &[Vec<S>]) -> Option<Self> {
        let mut L: Rows<S> = Vec::with_capacity(M.len());
        for (i, given) in M.iter().enumerate() {
            let mut row = vec![S::from(0); M.len()];
            for j in 0..i {
                row[j] = (given[j] - dot(&row[..j], &L[j][..j])) / L[j][j];
            }
            let pivot = given[i] - dot(&row[..i], &row[..i]);
            if !pivot.is_positive() {
                return None;
            }
            row[i] = pivot.sqrt();
            L.push(row);
        }
        Some(Self { L })
    }

    /// `M⁻¹ b`
    pub fn solve(&self, b: &[S]) -> Vec<S> {
        let (L, n) = (&self.L, self.L.len());
        let mut x = b.to_vec();
        for i in 0..n {
            x[i] = (x[i] - dot(&L[i][..i], &x[..i])) / L[i][i];
        }
        for i in (0..n).rev() {
            let known = sum((i + 1..n).map(|k| L[k][i] * x[k]));
            x[i] = (x[i] - known) / L[i][i];
        }
        x
    }

    /// `M⁻¹ B`
    pub fn solve_columns(&self, B: &[Vec<S>]) -> Rows<S> {
        let columns: Rows<S> = transpose(B).iter().map(|column| self.solve(column)).collect();
        transpose(&columns)
    }
}

/// `aᵀb`
pub(super) fn dot<S: Real>(a: &[S], b: &[S]) -> S {
    sum(a.iter().zip(b).map(|(&x, &y)| x * y))
}

fn sum<S: Real>(terms: impl Iterator<Item = S>) -> S {
    terms.fold(S::from(0), |sum, term| sum + term)
}

/// `A b`
pub(super) fn times<S: Real>(A: &[Vec<S>], b: &[S]) -> Vec<S> {
    A.iter().map(|row| dot(row, b)).collect()
}

/// `A B`
pub(super) fn product(A: &[Vec<f64>], B: &[Vec<f64>]) -> Rows {
    let columns = transpose(B);
    A.iter().map(|row| columns.iter().map(|column| dot(row, column)).collect()).collect()
}

/// `Aᵀ`
pub(super) fn transpose<S: Real>(A: &[Vec<S>]) -> Rows<S> {
    let width = A.first().map_or(0, Vec::len);
    (0..width).map(|j| A.iter().map(|row| row[j]).collect()).collect()
}

/// `|A|`, entry by entry.
pub(super) fn magnitudes(A: &[Vec<f64>]) -> Rows {
    A.iter().map(|row| row.iter().map(|x| x.abs()).collect()).collect()
}

/// The identity.
pub(super) fn identity<S: Real>(n: usize) -> Rows<S> {
    (0..n).map(|i| (0..n).map(|j| S::from(i32::from(i == j))).collect()).collect()
}

/// The largest magnitude; not a number if one is not a number.
pub(super) fn largest<'x>(values: impl IntoIterator<Item = &'x f64>) -> f64 {
    values.into_iter().fold(0.0, |largest, x| if x.is_nan() || x.abs() > largest { x.abs() } else { largest })
}
