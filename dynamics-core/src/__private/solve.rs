//! Solving with a mass matrix for many right-hand sides at once.
//!
//! By the inverse of the triangular factor: that is the product of two triangular matrices with the right-hand sides,
//! in lanes over their rows, with no step that waits for another. A product with `M⁻¹` leaves a residual that grows with
//! the condition of M; of this one most stays in D, and R takes over that of the joints solved for before it. What the tree
//! leaves zero is skipped, strip by strip of rows.
//!
//! A scalar with lanes of its own leaves none to the rows: so many are summed at a time as fit the registers, and each sum
//! has the terms that a float's strip has, in their order, so that every lane has the bits of one float.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, §6.5; J. Du Croz, N. Higham, *Stability of methods
//! for matrix inversion*, IMA Journal of Numerical Analysis 12, 1992, for the inverse of a triangular matrix.

use nalgebra::SMatrix;

use super::columns;
use super::elimination_tree::{EliminationTree, rows_to_solve};
use super::gauss_jordan::invert;
use super::in_place::{blank, put};
use crate::dynamics::{ForwardDynamicsDerivatives, InverseDynamicsDerivatives};
use crate::product::{
    COLUMNS, FEW_COLUMNS, LONG_STRIP, STRIP, by_rows, has_lanes, multiply, parts, products, row_of,
};
use crate::scalar::Scalar;

/// `M⁻¹ = R D⁻¹ Rᵀ`, where `M = Lᵀ D L` and `R = L⁻¹`; both are unit lower triangular.
pub struct Factors<T, const N: usize> {
    /// Where they have entries.
    pub(super) tree: &'static EliminationTree<N>,
    /// `−R`, by columns; zero above the diagonal.
    pub(super) minus_r: [[T; N]; N],
    /// `−Rᵀ`, by columns; zero below the diagonal.
    pub(super) minus_r_transposed: [[T; N]; N],
    /// `1/D`
    pub(super) inverse_d: [T; N],
}

impl<T: Scalar, const N: usize> Factors<T, N> {
    /// Before there are any.
    #[inline]
    #[must_use]
    pub fn new(tree: &'static EliminationTree<N>) -> Self {
        // Zeros that the compiler knows: what a function returns would be copied into the struct.
        let zeros = || [[T::zero(); N]; N];
        Self { tree, minus_r: zeros(), minus_r_transposed: zeros(), inverse_d: [T::one(); N] }
    }

    /// Those of a symmetric positive definite matrix, which becomes its inverse, both halves. It is given by columns, of which
    /// what is on the diagonal and below it is read. What functions return is copied, so that factors are made first, and
    /// once.
    ///
    /// # Cost
    ///
    /// N³/2 multiplications and additions, fused where the target can; N divisions.
    #[inline]
    pub fn invert(&mut self, m: &mut [[T; N]; N]) {
        invert(m, self.tree, Some(self));
    }

    /// `−M⁻¹·B`, by columns.
    ///
    /// # Cost
    ///
    /// About N² multiplications and additions for each column, fused where the target can.
    #[inline(never)]
    pub fn minus_solved<const M: usize>(&self, b: &[[T; N]; M]) -> [[T; N]; M] {
        let mut solved = blank();
        let minus_inverse_d = self.inverse_d.map(|x| -x);
        macro_rules! solve_by {
            ($width:ident, $rows:ident) => {
                let mut halfway = [[T::zero(); N]; $width];
                for first in parts($width, M) {
                    let Some(columns) = b.get(first..).and_then(<[_]>::first_chunk::<$width>) else { continue };
                    by_rows!(T, ROWS = $rows, {
                        let ways = |row: usize| row / const { rows_to_solve(N) };
                        let beyond = |row: usize| self.tree.beyond_solved(ways(row));
                        let factors = |k| row_of(columns, k);
                        multiply::<T, N, $width, ROWS, _>(&self.minus_r_transposed, factors, beyond, &mut halfway);
                        for column in &mut halfway {
                            scale(column, &minus_inverse_d);
                        }
                        for part in (0..N.div_ceil(ROWS)).rev() {
                            let below = self.tree.below_solved(ways(part * ROWS));
                            let sums: [[T; ROWS]; $width] =
                                products(&self.minus_r, |k| row_of(&halfway, k), below, part);
                            put!(solved: [[_; N]; M], first, part, sums);
                        }
                    });
                }
            };
        }
        const SIX: usize = 6;
        const ONE: usize = 1;
        let by_long_strips = const { LONG_STRIP > STRIP && rows_to_solve(N) == LONG_STRIP };
        // As many columns at a time as leave none for last, where a strip leaves room for many.
        if const { M < COLUMNS } {
            if by_long_strips {
                solve_by!(ONE, LONG_STRIP);
            } else {
                solve_by!(ONE, STRIP);
            }
        } else if by_long_strips || const { has_lanes::<T>() } {
            solve_by!(FEW_COLUMNS, LONG_STRIP);
        } else if const { M.is_multiple_of(SIX) && !M.is_multiple_of(COLUMNS) } {
            solve_by!(SIX, STRIP);
        } else {
            solve_by!(COLUMNS, STRIP);
        }
        solved
    }

    /// The derivatives of forward dynamics, as [`forward_from_inverse`](super::forward_from_inverse) says.
    ///
    /// Here, with what it calls: where LLVM does not see both together, it makes two of the matrices elsewhere and copies
    /// them.
    #[inline(never)]
    pub(super) fn forward_from_inverse(
        &self,
        inverse: &InverseDynamicsDerivatives<T, N>,
    ) -> ForwardDynamicsDerivatives<T, N> {
        ForwardDynamicsDerivatives {
            da_dq: minus_solved(self, &inverse.dtau_dq),
            da_dv: minus_solved(self, &inverse.dtau_dv),
            da_dtau: inverse.dtau_da,
        }
    }
}

// On their own, for the stack of unoptimised builds: there each step between is a matrix.

fn minus_solved<T: Scalar, const N: usize>(
    factors: &Factors<T, N>,
    b: &SMatrix<T, N, N>,
) -> SMatrix<T, N, N> {
    columns(factors.minus_solved(&b.data.0))
}

#[inline(always)]
fn scale<T: Scalar, const N: usize>(column: &mut [T; N], factors: &[T; N]) {
    for (entry, factor) in column.iter_mut().zip(factors) {
        *entry *= *factor;
    }
}
