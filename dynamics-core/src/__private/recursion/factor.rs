//! The mass matrix factored as `LᵀDL`: for what the articulated bodies do not give.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, §6.5.

use nalgebra::{SMatrix, SVector};

use super::sweep::difference;
use super::{Tree, entries};
use crate::__private::{EliminationTree, Factors, columns, inverse_of};
use crate::scalar::Scalar;

impl<T: Scalar, const NL: usize, const NQ: usize, const NV: usize> Tree<T, NL, NQ, NV> {
    /// `M(q)⁻¹`, both halves.
    pub fn inverse_mass_matrix(&self, q: &SVector<T, NQ>) -> SMatrix<T, NV, NV> {
        inverse_of(self.mass_matrix(q), const { &EliminationTree::CHAIN })
    }

    /// `a = M(q)⁻¹·(τ − h(q,v))`, O(N³).
    pub(super) fn forward_dynamics_by_factoring(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        tau: &SVector<T, NV>,
    ) -> SVector<T, NV> {
        let minus_forces = [difference(entries(&self.bias_forces(q, v)), entries(tau))];
        let mut factors = Factors::new(const { &EliminationTree::CHAIN });
        factors.invert(&mut self.mass_matrix(q).data.0);
        columns(factors.minus_solved(&minus_forces))
    }
}
