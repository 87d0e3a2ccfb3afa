//! The robot's own speeds and those of the columns: `v_columns = W·v`, with a row of W for each column.
//!
//! Where joints follow others several columns share a speed, each at its own ratio; forces are collected by `Wᵀ`, and
//! `Wᵀ M W` is the mass matrix. W is constant, so the same holds of C and of all derivatives. Without followers W
//! is the identity, and nothing is done.

use super::columns::Column;
use super::composite::Square;
use super::normal::NormalTree;
use crate::spatial::Scalar;

/// `W`
#[derive(Clone, Debug)]
pub struct Coupling<S> {
    /// For each column its speed, and the ratio to it.
    rows: Vec<(usize, S)>,
    dof: usize,
}

impl<S: Scalar> Coupling<S> {
    /// That of a tree.
    pub fn of(tree: &NormalTree<S>, dof: usize) -> Self {
        Self { rows: tree.columns.iter().map(|column| (column.speed, column.ratio)).collect(), dof }
    }

    /// Whether no column shares its speed.
    pub fn is_identity(&self) -> bool {
        self.is_one_to_one() && self.rows.iter().all(|(_, ratio)| ratio.as_sign() == Some(1))
    }

    /// Whether each column has a speed of its own.
    pub fn is_one_to_one(&self) -> bool {
        self.rows.len() == self.dof
    }

    /// `W·v`
    pub fn spread(&self, v: &[S]) -> Vec<S> {
        self.rows.iter().map(|&(speed, ratio)| ratio * v[speed]).collect()
    }

    /// `Wᵀ·f`
    pub fn gather(&self, forces: Vec<S>) -> Vec<S> {
        if self.is_identity() {
            return forces;
        }
        let mut gathered = vec![S::zero(); self.dof];
        for (&(speed, ratio), force) in self.rows.iter().zip(forces) {
            gathered[speed] = gathered[speed] + ratio * force;
        }
        gathered
    }

    /// `J·W` of a matrix by rows.
    pub fn gather_columns(&self, rows: Square<S>) -> Square<S> {
        rows.into_iter().map(|row| self.gather(row)).collect()
    }

    /// `Wᵀ·M·W`
    pub fn gather_both(&self, matrix: Square<S>) -> Square<S> {
        if self.is_identity() {
            return matrix;
        }
        let mut gathered = vec![vec![S::zero(); self.dof]; self.dof];
        for (&(i, ratio), row) in self.rows.iter().zip(self.gather_columns(matrix)) {
            for (sum, entry) in gathered[i].iter_mut().zip(row) {
                *sum = *sum + ratio * entry;
            }
        }
        gathered
    }
}

/// For each speed the largest one before it that its elimination from the mass matrix touches: the parents by which
/// the matrix is factored. Without followers, the column before it on the way to the base. `added` are the pairs of speeds
/// that kinetic terms couple.
///
/// J. Liu, *The role of elimination trees in sparse factorization*, 1990.
pub fn elimination_parents<S: Scalar>(
    columns: &[Column<S>],
    dof: usize,
    added: &[(usize, usize)],
) -> Vec<Option<usize>> {
    let mut touched = vec![vec![false; dof]; dof];
    for &(one, other) in added {
        touched[one.max(other)][one.min(other)] = true;
    }
    for column in columns {
        for k in std::iter::successors(column.parent, |&k| columns[k].parent) {
            let (one, other) = (column.speed, columns[k].speed);
            touched[one.max(other)][one.min(other)] = true;
        }
    }
    let mut parents = vec![None; dof];
    for k in (0..dof).rev() {
        parents[k] = (0..k).rev().find(|&i| touched[k][i]);
        if let Some(parent) = parents[k] {
            let filled = touched[k].clone();
            for (entry, filled) in touched[parent].iter_mut().zip(&filled).take(parent) {
                *entry |= filled;
            }
        }
    }
    parents
}
