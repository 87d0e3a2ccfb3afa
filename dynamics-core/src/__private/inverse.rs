//! `M⁻¹` of larger robots, and the derivatives of forward dynamics from it.
//!
//! Loops over whole rows, in lanes: what is zero above a row's diagonal or beside the tree is computed along, which
//! costs less than to look.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, §6.5.

use nalgebra::{ArrayStorage, SMatrix};

use super::solve::{factor, solve_columns, subtract};
use crate::dynamics::{ForwardDynamicsDerivatives, InverseDynamicsDerivatives};
use crate::scalar::Scalar;

/// `∂a/∂q = −M⁻¹ ∂τ/∂q`, `∂a/∂v = −M⁻¹ ∂τ/∂v` and `∂a/∂τ = M⁻¹`, from `M⁻¹` and the derivatives of inverse dynamics
/// at the acceleration that τ causes. `ancestors` are as those of [`inverse_of`].
///
/// The former two are solved for: a product with `M⁻¹` would take half the time, and leave a residual that grows with
/// the condition of M.
///
/// # Cost
///
/// One factorisation, and 2·N columns solved: see [`solve_columns`].
#[inline]
pub fn forward_from_inverse<T: Scalar, const N: usize>(
    ancestors: &[&[usize]; N],
    mass_inverse: SMatrix<T, N, N>,
    inverse: &InverseDynamicsDerivatives<T, N>,
) -> ForwardDynamicsDerivatives<T, N> {
    let mut l = inverse.dtau_da.data.0;
    let d_inv = factor(ancestors, &mut l);
    let solved = |m: &SMatrix<T, N, N>| {
        let mut rows = transposed(m.data.0.map(|column| column.map(|x| -x)));
        solve_columns(ancestors, &l, &d_inv, &mut rows);
        SMatrix::from_array_storage(ArrayStorage(transposed(rows)))
    };
    ForwardDynamicsDerivatives {
        da_dq: solved(&inverse.dtau_dq),
        da_dv: solved(&inverse.dtau_dv),
        da_dtau: mass_inverse,
    }
}

/// `M⁻¹ = L⁻¹ D⁻¹ L⁻ᵀ`, of a matrix with the sparsity of a tree: `M[i][j]` is zero unless one of `i`, `j` is the
/// other's ancestor. `ancestors[i]` lists the ones of `i`, in any order; all are smaller than `i`.
///
/// # Cost
///
/// `N·(3·Σ|ancestors| + N)` multiplications and additions, fused where the target can.
#[inline]
pub fn inverse_of<T: Scalar, const N: usize>(
    ancestors: &[&[usize]; N],
    m: &SMatrix<T, N, N>,
) -> SMatrix<T, N, N> {
    let mut l = m.data.0;
    let inverse_d = factor(ancestors, &mut l);
    let columns = inverse_of_factor(ancestors, &l);
    let mut inverse = [[T::zero(); N]; N];
    for (i, (row, before)) in inverse.iter_mut().zip(ancestors).enumerate() {
        for &k in before.iter().chain([&i]) {
            let (Some(column), Some(inverse_d)) = (columns.get(k), inverse_d.get(k)) else { continue };
            if let Some(entry) = column.get(i) {
                subtract(row, -(*entry * *inverse_d), column);
            }
        }
    }
    SMatrix::from_array_storage(ArrayStorage(inverse))
}

/// The columns of `L⁻¹`: each is that of the identity less those of the rows beyond it, `L[i][j]` times.
#[inline]
fn inverse_of_factor<T: Scalar, const N: usize>(ancestors: &[&[usize]; N], l: &[[T; N]; N]) -> [[T; N]; N] {
    let mut columns = [[T::zero(); N]; N];
    for (i, column) in columns.iter_mut().enumerate() {
        if let Some(diagonal) = column.get_mut(i) {
            *diagonal = T::one();
        }
    }
    for (i, (ancestors, l)) in ancestors.iter().zip(l).enumerate().rev() {
        let Some((before, [column, ..])) = columns.split_at_mut_checked(i) else { continue };
        for &j in *ancestors {
            if let (Some(ancestor), Some(l)) = (before.get_mut(j), l.get(j)) {
                subtract(ancestor, *l, column);
            }
        }
    }
    columns
}

fn transposed<T: Scalar, const N: usize>(m: [[T; N]; N]) -> [[T; N]; N] {
    let mut result = [[T::zero(); N]; N];
    for (i, row) in result.iter_mut().enumerate() {
        for (entry, column) in row.iter_mut().zip(&m) {
            if let Some(value) = column.get(i) {
                *entry = *value;
            }
        }
    }
    result
}
