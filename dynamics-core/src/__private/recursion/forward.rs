//! Derivatives of forward dynamics: those of inverse dynamics, solved with the mass matrix, O(N²·depth).
//!
//! J. Carpentier, N. Mansard, *Analytical derivatives of rigid body dynamics algorithms*, RSS 2018.

use nalgebra::SVector;

use super::Tree;
use crate::__private::{EliminationTree, Factors, forward_from_inverse};
use crate::dynamics::ForwardDynamicsDerivatives;
use crate::scalar::Scalar;

impl<T: Scalar, const NL: usize, const NQ: usize, const NV: usize> Tree<T, NL, NQ, NV> {
    /// `∂a/∂q = −M⁻¹ ∂τ/∂q`, `∂a/∂v = −M⁻¹ ∂τ/∂v` and `∂a/∂τ = M⁻¹`, where `τ` causes `a`.
    ///
    /// At N = 100 an N×N matrix of `f64` is 80 kB of stack; there are some ten.
    pub fn forward_dynamics_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        tau: &SVector<T, NV>,
    ) -> ForwardDynamicsDerivatives<T, NV> {
        let a = self.forward_dynamics(q, v, tau);
        let mut inverse = self.inverse_dynamics_derivatives(q, v, &a);
        let mut factors = Factors::new(const { &EliminationTree::CHAIN });
        factors.invert(&mut inverse.dtau_da.data.0);
        forward_from_inverse(&inverse, &factors)
    }
}
