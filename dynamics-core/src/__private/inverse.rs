//! `M⁻¹` of larger robots, and the derivatives of forward dynamics.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, §6.5.

use nalgebra::SMatrix;

use super::elimination_tree::EliminationTree;
use super::gauss_jordan::invert;
use super::solve::Factors;
use crate::dynamics::{ForwardDynamicsDerivatives, InverseDynamicsDerivatives};
use crate::scalar::Scalar;

/// `∂a/∂q = −M⁻¹ ∂τ/∂q`, `∂a/∂v = −M⁻¹ ∂τ/∂v` and `∂a/∂τ = M⁻¹`, from the derivatives of inverse dynamics at the
/// acceleration that τ causes, and the factors of its `∂τ/∂a = M`, in whose place they left [`M⁻¹`](Factors::invert).
///
/// The former two are solved for: a product with `M⁻¹` would take half the time, and leave a residual that grows with
/// the condition of M.
///
/// # Cost
///
/// Four products of a triangular with a square matrix.
#[inline]
pub fn forward_from_inverse<T: Scalar, const N: usize>(
    inverse: &InverseDynamicsDerivatives<T, N>,
    factors: &Factors<T, N>,
) -> ForwardDynamicsDerivatives<T, N> {
    factors.forward_from_inverse(inverse)
}

/// `M⁻¹`, both halves, of a symmetric positive definite matrix, of which what is on the diagonal and below it is read.
///
/// # Cost
///
/// N³/2 multiplications and additions.
#[inline]
pub fn inverse_of<T: Scalar, const N: usize>(
    mut m: SMatrix<T, N, N>,
    tree: &EliminationTree<N>,
) -> SMatrix<T, N, N> {
    invert(&mut m.data.0, tree, None);
    m
}
