//! The mass matrix factored as `LᵀDL`: for what the articulated bodies do not give.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, §6.5.

use nalgebra::{SMatrix, SVector};

use super::sweep::{difference, identity};
use super::{Tree, entries};
use crate::__private::solve::{factor, solve_columns};
use crate::__private::vector;
use crate::scalar::Scalar;

impl<T: Scalar, const NL: usize, const NQ: usize, const NV: usize> Tree<T, NL, NQ, NV> {
    /// `M(q)⁻¹`, both halves.
    pub fn inverse_mass_matrix(&self, q: &SVector<T, NQ>) -> SMatrix<T, NV, NV> {
        let mut inverse = identity(); // its rows are its columns
        self.solve(q, &mut inverse.data.0);
        inverse
    }

    /// `a = M(q)⁻¹·(τ − h(q,v))`, O(N³).
    pub(super) fn forward_dynamics_by_factoring(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        tau: &SVector<T, NV>,
    ) -> SVector<T, NV> {
        let mut rows = difference(entries(tau), entries(&self.bias_forces(q, v))).map(|x| [x]);
        self.solve(q, &mut rows);
        vector(rows.map(|[x]| x))
    }

    /// Replaces `X`, by rows, with `M(q)⁻¹·X`.
    fn solve<const M: usize>(&self, q: &SVector<T, NQ>, rows: &mut [[T; M]; NV]) {
        let mut mass_matrix = self.mass_matrix(q);
        let l = &mut mass_matrix.data.0;
        let mut buffer = [[0; NV]; NV];
        let pattern = self.pattern(&mut buffer);
        let d_inv = factor(&pattern, l);
        solve_columns(&pattern, l, &d_inv, rows);
    }

    /// The entries of `L` that are not zero: for each row its columns, ascending.
    ///
    /// Those of `M` are between the speeds of links on one way to the base; each row adds its own to the rows that
    /// it is subtracted from. Where speeds are in the order of the links and not shared, none are added.
    pub(super) fn pattern<'b>(&self, buffer: &'b mut [[usize; NV]; NV]) -> [&'b [usize]; NV] {
        let mut related = self.related();
        for k in (0..NV).rev() {
            let Some((before, [row, ..])) = related.split_at_mut_checked(k) else { continue };
            for (other, _) in before.iter_mut().zip(&*row).filter(|(_, related)| **related) {
                other.iter_mut().zip(&*row).for_each(|(other, own)| *other |= own);
            }
        }
        let mut pattern: [&[usize]; NV] = [&[]; NV];
        for (i, ((row, room), list)) in related.iter().zip(buffer).zip(&mut pattern).enumerate() {
            let columns = row.iter().take(i).enumerate().filter(|(_, related)| **related);
            let mut length = 0;
            for (place, (column, _)) in room.iter_mut().zip(columns) {
                *place = column;
                length += 1;
            }
            *list = room.get(..length).unwrap_or_default();
        }
        pattern
    }

    /// Which entries of `M` are not zero.
    fn related(&self) -> [[bool; NV]; NV] {
        let mut related = [[false; NV]; NV];
        let speeds = |k: usize| self.links.get(k).into_iter().flat_map(|link| link.joint.speeds());
        for k in 0..NL {
            for outer in speeds(k) {
                for inner in self.path_to_base(Some(k)).flat_map(speeds) {
                    for (row, column) in [(outer, inner), (inner, outer)] {
                        if let Some(entry) = related.get_mut(row).and_then(|row| row.get_mut(column)) {
                            *entry = true;
                        }
                    }
                }
            }
        }
        related
    }
}
