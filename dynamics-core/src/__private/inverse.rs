//! `M⁻¹` of larger robots, and the derivatives of forward dynamics.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, §6.5.

use nalgebra::SMatrix;

use super::columns;
use super::solve::{EliminationTree, Factors, invert};
use crate::dynamics::{ForwardDynamicsDerivatives, InverseDynamicsDerivatives};
use crate::scalar::Scalar;

/// `∂a/∂q = −M⁻¹ ∂τ/∂q`, `∂a/∂v = −M⁻¹ ∂τ/∂v` and `∂a/∂τ = M⁻¹`, from the derivatives of inverse dynamics at the
/// acceleration that τ causes, and the factors of its `∂τ/∂a = M`. The former are overwritten.
///
/// The former two are solved for: a product with `M⁻¹` would take half the time, and leave a residual that grows with
/// the condition of M.
///
/// # Cost
///
/// Five products of a triangular with a square matrix.
#[inline(never)] // or else the result is copied once more
pub fn forward_from_inverse<T: Scalar, const N: usize>(
    inverse: &mut InverseDynamicsDerivatives<T, N>,
    factors: &Factors<T, N>,
) -> ForwardDynamicsDerivatives<T, N> {
    // In their places: the first cache has no room for three matrices more.
    factors.minus_solve(&mut inverse.dtau_dq.data.0);
    factors.minus_solve(&mut inverse.dtau_dv.data.0);
    factors.inverse(&mut inverse.dtau_da.data.0);
    ForwardDynamicsDerivatives { da_dq: inverse.dtau_dq, da_dv: inverse.dtau_dv, da_dtau: inverse.dtau_da }
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
    let mut inverse = zeros();
    invert(&m.data.0, tree, &mut inverse.data.0);
    inverse
}

fn zeros<T: Scalar, const N: usize>() -> SMatrix<T, N, N> {
    columns([[T::zero(); N]; N])
}
