//! `M = Lᵀ D L` along the tree, and what is solved with it.
//!
//! The factorisation fills nothing: `L[i][j]` is zero unless `j` is an ancestor of `i`.
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, 2008, ch. 6.5.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::composite::Square;
use crate::spatial::Scalar;

/// The factors of a mass matrix.
pub struct Factor<S> {
    parents: Vec<Option<usize>>,
    /// The unit lower triangle; the diagonal is not stored.
    pub L: Square<S>,
    /// `1/D`
    pub inverse_D: Vec<S>,
}

impl<S: Scalar> Factor<S> {
    /// Factors `M`, whose sparsity is that of the tree with these parents.
    pub fn of(M: &Square<S>, parents: Vec<Option<usize>>) -> Self {
        let n = parents.len();
        let mut H = M.clone();
        let mut inverse_D = vec![S::zero(); n];
        for k in (0..n).rev() {
            inverse_D[k] = S::one() / H[k][k];
            for i in ancestors(&parents, k) {
                let l = H[k][i] * inverse_D[k];
                for j in std::iter::once(i).chain(ancestors(&parents, i)) {
                    H[i][j] = H[i][j] - l * H[k][j];
                }
                H[k][i] = l;
            }
        }
        Self { parents, L: H, inverse_D }
    }

    /// `M⁻¹ b`
    pub fn solve(&self, b: &[S]) -> Vec<S> {
        let n = b.len();
        let mut x = b.to_vec();
        for i in (0..n).rev() {
            for j in ancestors(&self.parents, i) {
                x[j] = x[j] - self.L[i][j] * x[i];
            }
        }
        for (x, inverse) in x.iter_mut().zip(&self.inverse_D) {
            *x = *x * *inverse;
        }
        for i in 0..n {
            for j in ancestors(&self.parents, i) {
                x[i] = x[i] - self.L[i][j] * x[j];
            }
        }
        x
    }

    /// `M⁻¹`, each half computed once: column `k` is solved only down to row `k`.
    pub fn inverse(&self) -> Square<S> {
        let n = self.parents.len();
        let mut inverse = vec![vec![S::zero(); n]; n];
        for k in 0..n {
            let mut unit = vec![S::zero(); n];
            unit[k] = S::one();
            for (i, x) in self.solve(&unit).into_iter().enumerate().take(k + 1) {
                (inverse[i][k], inverse[k][i]) = (x, x);
            }
        }
        inverse
    }

    /// `L⁻¹`, all of it.
    pub fn inverse_triangle(&self) -> Square<S> {
        let n = self.parents.len();
        let mut R = vec![vec![S::zero(); n]; n];
        for i in 0..n {
            R[i][i] = S::one();
            // A row of the identity less those before it.
            for j in ancestors(&self.parents, i) {
                let between = ancestors(&self.parents, i).take_while(|&k| k != j);
                R[i][j] = between.fold(-self.L[i][j], |sum, k| sum - self.L[i][k] * R[k][j]);
            }
        }
        R
    }

    /// `M⁻¹ B`
    pub fn solve_matrix(&self, B: &Square<S>) -> Square<S> {
        let n = self.parents.len();
        let mut X = vec![vec![S::zero(); n]; n];
        for k in 0..n {
            let column: Vec<S> = B.iter().map(|row| row[k]).collect();
            for (row, x) in X.iter_mut().zip(self.solve(&column)) {
                row[k] = x;
            }
        }
        X
    }
}

fn ancestors(parents: &[Option<usize>], k: usize) -> impl Iterator<Item = usize> + '_ {
    std::iter::successors(parents[k], |&i| parents[i])
}
