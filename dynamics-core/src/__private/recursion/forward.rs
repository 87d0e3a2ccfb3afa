//! Derivatives of forward dynamics: those of inverse dynamics, solved with the mass matrix, O(N²·depth).
//!
//! J. Carpentier, N. Mansard, *Analytical derivatives of rigid body dynamics algorithms*, RSS 2018.

use nalgebra::SVector;

use super::Tree;
use super::sweep::{identity, zeros};
use crate::__private::solve::{factor, solve_columns};
use crate::dynamics::ForwardDynamicsDerivatives;
use crate::scalar::Scalar;

impl<T: Scalar, const NL: usize, const NQ: usize, const NV: usize> Tree<T, NL, NQ, NV> {
    /// `∂a/∂q = −M⁻¹ ∂τ/∂q`, `∂a/∂v = −M⁻¹ ∂τ/∂v` and `∂a/∂τ = M⁻¹`, where `τ` causes `a`.
    ///
    /// All N×N matrices are solved in place: at N = 100 one of `f64` is 80 kB of stack.
    pub fn forward_dynamics_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        tau: &SVector<T, NV>,
    ) -> ForwardDynamicsDerivatives<T, NV> {
        let mut result = ForwardDynamicsDerivatives { da_dq: zeros(), da_dv: zeros(), da_dtau: identity() };
        let ForwardDynamicsDerivatives { da_dq, da_dv, da_dtau } = &mut result;
        let mut mass_matrix = zeros();
        let a = self.forward_dynamics(q, v, tau);
        self.add_inverse_dynamics_derivatives(q, v, &a, [da_dq, da_dv, &mut mass_matrix]);

        let l = &mut mass_matrix.data.0;
        let mut buffer = [[0; NV]; NV];
        let pattern = self.pattern(&mut buffer);
        let d_inv = factor(&pattern, l);
        let minus_d_inv = d_inv.map(|x| -x);
        for derivative in [da_dq, da_dv] {
            let rows = &mut derivative.data.0;
            transpose(rows);
            solve_columns(&pattern, l, &minus_d_inv, rows);
            transpose(rows);
        }
        solve_columns(&pattern, l, &d_inv, &mut da_dtau.data.0); // symmetric: its rows are its columns
        result
    }
}

/// In place.
fn transpose<T, const N: usize>(m: &mut [[T; N]; N]) {
    for i in 0..N {
        let Some((above, [row, ..])) = m.split_at_mut_checked(i) else { continue };
        for (other, entry) in above.iter_mut().zip(row) {
            if let Some(mirrored) = other.get_mut(i) {
                core::mem::swap(mirrored, entry);
            }
        }
    }
}
