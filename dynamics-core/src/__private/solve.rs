//! Factoring a mass matrix along its tree, and solving with many right-hand sides at once.
//!
//! Loops over rows whose inner loops run over columns in lanes: for more than a handful of columns these are
//! shorter and faster than straight-line code.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, §6.5.

use crate::scalar::Scalar;

/// `M = Lᵀ D L` in place: the lower half of `h` leaves as that of L, and `1/D` is returned.
///
/// `M` is symmetric, with the sparsity of the tree: `M[i][j]` is zero unless one of `i`, `j` is the other's
/// ancestor. What stands on and above the diagonal is left undefined.
#[inline]
pub fn factor<T: Scalar, const N: usize>(ancestors: &[&[usize]; N], h: &mut [[T; N]; N]) -> [T; N] {
    let mut inverse = [T::one(); N];
    let rows = ancestors.iter().zip(&mut inverse).enumerate().rev();
    for (k, (ancestors, inverse)) in rows {
        let Some((above, [row_k, ..])) = h.split_at_mut_checked(k) else { continue };
        let Some(&pivot) = row_k.get(k) else { continue };
        *inverse = T::one() / pivot;
        let unscaled = *row_k;
        for &i in *ancestors {
            let (Some(row_i), Some(l)) = (above.get_mut(i), row_k.get_mut(i)) else { continue };
            *l *= *inverse;
            // Whole rows, in lanes: the part above the diagonal is computed along.
            subtract(row_i, *l, &unscaled);
        }
    }
    inverse
}

/// Solves `LᵀDL·X = B` in place; the rows of `x` come as those of `B` and leave as those of `X`.
///
/// `L` is unit lower triangular: row `i` holds `L[i][j]` for the ancestors `j` of joint `i`; nothing else of it
/// is read. `d_inv` holds `1/D`.
///
/// # Cost
///
/// `M·(2·Σ|ancestors| + N)` multiplications and nearly as many additions, fused where the target can.
#[inline]
pub fn solve_columns<T: Scalar, const N: usize, const M: usize>(
    ancestors: &[&[usize]; N],
    l: &[[T; N]; N],
    d_inv: &[T; N],
    x: &mut [[T; M]; N],
) {
    for (i, (row, ancestors)) in l.iter().zip(ancestors).enumerate().rev() {
        let Some((above, [x_i, ..])) = x.split_at_mut_checked(i) else { continue };
        for &j in *ancestors {
            if let (Some(x_j), Some(l_ij)) = (above.get_mut(j), row.get(j)) {
                subtract(x_j, *l_ij, x_i);
            }
        }
    }
    for (x_i, d_inv) in x.iter_mut().zip(d_inv) {
        for entry in x_i {
            *entry *= *d_inv;
        }
    }
    for (i, (row, ancestors)) in l.iter().zip(ancestors).enumerate() {
        let Some((above, [x_i, ..])) = x.split_at_mut_checked(i) else { continue };
        let mut sum = *x_i;
        for &j in *ancestors {
            if let (Some(x_j), Some(l_ij)) = (above.get(j), row.get(j)) {
                subtract(&mut sum, *l_ij, x_j);
            }
        }
        *x_i = sum;
    }
}

/// `x ← x − factor·y`.
#[inline(always)]
pub(super) fn subtract<T: Scalar, const M: usize>(x: &mut [T; M], factor: T, y: &[T; M]) {
    let factor = -factor;
    for (x, y) in x.iter_mut().zip(y) {
        *x = factor.mul_add(*y, *x);
    }
}
