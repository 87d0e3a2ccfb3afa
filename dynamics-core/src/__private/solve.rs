//! Solves with many right-hand sides, as loops over rows whose inner loops run over columns in lanes.

use crate::scalar::Scalar;

/// Solves `LᵀDL·X = B` in place; the rows of `x` come as those of `B` and leave as those of `X`.
///
/// `L` is unit lower triangular: row `i` holds `L[i][j]`, `j < i`, zero where joint `j` is no ancestor of joint `i`;
/// what stands on and above the diagonal is not read. `d_inv` holds `1/D`.
///
/// # Cost
///
/// N²·M multiplications and additions, fused where the target can.
///
/// # Source
///
/// Featherstone 2008, §6.5.
#[inline]
pub fn solve_columns<T: Scalar, const N: usize, const M: usize>(
    l: &[[T; N]; N],
    d_inv: &[T; N],
    x: &mut [[T; M]; N],
) {
    for (i, row) in l.iter().enumerate().rev() {
        let Some((above, [x_i, ..])) = x.split_at_mut_checked(i) else { continue };
        for (x_j, l_ij) in above.iter_mut().zip(row) {
            subtract(x_j, *l_ij, x_i);
        }
    }
    for (x_i, d_inv) in x.iter_mut().zip(d_inv) {
        for entry in x_i {
            *entry *= *d_inv;
        }
    }
    for (i, row) in l.iter().enumerate() {
        let Some((above, [x_i, ..])) = x.split_at_mut_checked(i) else { continue };
        let mut sum = *x_i;
        for (x_j, l_ij) in above.iter().zip(row) {
            subtract(&mut sum, *l_ij, x_j);
        }
        *x_i = sum;
    }
}

/// `x ← x − factor·y`.
#[inline(always)]
fn subtract<T: Scalar, const M: usize>(x: &mut [T; M], factor: T, y: &[T; M]) {
    let factor = -factor;
    for (x, y) in x.iter_mut().zip(y) {
        *x = factor.mul_add(*y, *x);
    }
}
