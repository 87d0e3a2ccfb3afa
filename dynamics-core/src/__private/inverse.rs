//! `M⁻¹` of larger robots, and the derivatives of forward dynamics.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, §6.5.

use nalgebra::SMatrix;

use super::columns;
use super::solve::{EliminationTree, Factors, inverted};
use crate::dynamics::{ForwardDynamicsDerivatives, InverseDynamicsDerivatives};
use crate::scalar::Scalar;

/// `∂a/∂q = −M⁻¹ ∂τ/∂q`, `∂a/∂v = −M⁻¹ ∂τ/∂v` and `∂a/∂τ = M⁻¹`, from the derivatives of inverse dynamics at the
/// acceleration that τ causes, and the factors of its `∂τ/∂a = M`.
///
/// The former two are solved for: a product with `M⁻¹` would take half the time, and leave a residual that grows with
/// the condition of M.
///
/// # Cost
///
/// Five products of a triangular with a square matrix.
#[inline]
pub fn forward_from_inverse<T: Scalar, const N: usize>(
    inverse: &InverseDynamicsDerivatives<T, N>,
    factors: &Factors<T, N>,
) -> ForwardDynamicsDerivatives<T, N> {
    factors.forward_from_inverse(inverse)
}

/// `M⁻¹`, of a symmetric positive definite matrix.
///
/// # Cost
///
/// One factorisation, and a product of a triangular with a square matrix.
#[inline]
pub fn inverse_of<T: Scalar, const N: usize>(
    m: &SMatrix<T, N, N>,
    tree: &'static EliminationTree<N>,
) -> SMatrix<T, N, N> {
    columns(inverted(&m.data.0, tree))
}
