//! `M = Lᵀ D L` along the tree, and what is solved with it.
//!
//! The factorisation fills nothing: `L[i][j]` is zero unless `j` is an ancestor of `i`. What a branch takes from those that
//! it hangs on is summed within the branch first, so that it is one number of each branch.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, 2008, ch. 6.5; I. Duff, J. Reid, *The multifrontal solution of
//! indefinite sparse symmetric linear equations*, 1983.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::composite::Square;
use crate::spatial::Scalar;

/// The factors of a mass matrix.
pub struct Factor<'f, S> {
    /// What stands for a value in the row of a column, once all that hangs on the column is in it.
    complete: Box<dyn Fn(usize, S) -> S + 'f>,
    parents: Vec<Option<usize>>,
    /// With which column the branch of each begins.
    roots: Vec<usize>,
    /// The unit lower triangle; the diagonal is not stored.
    pub L: Square<S>,
    /// `1/D`
    pub inverse_D: Vec<S>,
}

impl<'f, S: Scalar> Factor<'f, S> {
    /// Factors `M`, whose sparsity is that of the tree with these parents.
    pub fn of(M: &Square<S>, parents: Vec<Option<usize>>) -> Self {
        Self::completing(M, parents, |_, value| value)
    }

    /// The same, where `complete` may put something else in the place of a value in the row of a column, once all that hangs
    /// on the column is in it.
    pub fn completing(
        M: &Square<S>,
        parents: Vec<Option<usize>>,
        complete: impl Fn(usize, S) -> S + 'f,
    ) -> Self {
        let n = parents.len();
        let roots = roots(&parents);
        let mut H = M.clone();
        let mut inverse_D = vec![S::zero(); n];
        // What each branch takes, by its root.
        let room = |k: usize| if roots[k] == k { vec![vec![S::zero(); n]; n] } else { vec![] };
        let mut taken: Vec<Square<S>> = (0..n).map(room).collect();
        for k in (0..n).rev() {
            let branch = roots[k];
            for i in std::iter::once(k).chain(ancestors(&parents, k)) {
                H[k][i] = complete(k, H[k][i]);
            }
            inverse_D[k] = S::one() / H[k][k];
            for i in ancestors(&parents, k) {
                let l = H[k][i] * inverse_D[k];
                for j in std::iter::once(i).chain(ancestors(&parents, i)) {
                    match roots[i] == branch {
                        true => H[i][j] = H[i][j] - l * H[k][j],
                        false => taken[branch][i][j] = taken[branch][i][j] + l * H[k][j],
                    }
                }
                H[k][i] = l;
            }
            let Some(parent) = parents[k].filter(|_| branch == k) else { continue };
            for i in ancestors(&parents, k) {
                for j in std::iter::once(i).chain(ancestors(&parents, i)) {
                    let of_branch = taken[k][i][j];
                    match roots[i] == roots[parent] {
                        true => H[i][j] = H[i][j] - of_branch,
                        false => taken[roots[parent]][i][j] = taken[roots[parent]][i][j] + of_branch,
                    }
                }
            }
        }
        Self { complete: Box::new(complete), parents, roots, L: H, inverse_D }
    }

    /// `M⁻¹ b`
    pub fn solve(&self, b: &[S]) -> Vec<S> {
        let n = b.len();
        let mut x = b.to_vec();
        let mut taken = vec![vec![S::zero(); n]; n];
        for i in (0..n).rev() {
            let branch = self.roots[i];
            x[i] = (self.complete)(i, x[i]);
            for j in ancestors(&self.parents, i) {
                match self.roots[j] == branch {
                    true => x[j] = x[j] - self.L[i][j] * x[i],
                    false => taken[branch][j] = taken[branch][j] + self.L[i][j] * x[i],
                }
            }
            let Some(parent) = self.parents[i].filter(|_| branch == i) else { continue };
            for j in ancestors(&self.parents, i) {
                let of_branch = taken[i][j];
                match self.roots[j] == self.roots[parent] {
                    true => x[j] = x[j] - of_branch,
                    false => taken[self.roots[parent]][j] = taken[self.roots[parent]][j] + of_branch,
                }
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

    /// `M⁻¹`, each entry and its mirror image computed once: `is_computed` says for each row and column which of the two.
    pub fn inverse(&self, is_computed: impl Fn(usize, usize) -> bool) -> Square<S> {
        let n = self.parents.len();
        let mut inverse = vec![vec![S::zero(); n]; n];
        for k in 0..n {
            let mut unit = vec![S::zero(); n];
            unit[k] = S::one();
            for (i, x) in self.solve(&unit).into_iter().enumerate().filter(|&(i, _)| is_computed(i, k)) {
                (inverse[i][k], inverse[k][i]) = (x, x);
            }
        }
        inverse
    }
}

fn ancestors(parents: &[Option<usize>], k: usize) -> impl Iterator<Item = usize> + '_ {
    std::iter::successors(parents[k], |&i| parents[i])
}

/// For each column the nearest one on its way to the base that has siblings, or none before it.
fn roots(parents: &[Option<usize>]) -> Vec<usize> {
    let mut roots: Vec<usize> = Vec::with_capacity(parents.len());
    for (k, &parent) in parents.iter().enumerate() {
        let only_child = parent.filter(|_| parents.iter().filter(|&&other| other == parent).count() == 1);
        roots.push(only_child.map_or(k, |parent| roots[parent]));
    }
    roots
}
