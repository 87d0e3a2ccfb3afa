//! Derivatives of forward dynamics: those of inverse dynamics, solved with the mass matrix, O(N²·depth).
//!
//! J. Carpentier, N. Mansard, *Analytical derivatives of rigid body dynamics algorithms*, RSS 2018.

use nalgebra::SVector;

use super::Tree;
use super::sweep::{set, zeros};
use crate::__private::solve::{factor, solve_columns};
use crate::dynamics::ForwardDynamicsDerivatives;
use crate::scalar::Scalar;

impl<T: Scalar, const N: usize> Tree<T, N> {
    /// `∂a/∂q = −M⁻¹ ∂τ/∂q`, `∂a/∂v = −M⁻¹ ∂τ/∂v` and `∂a/∂τ = M⁻¹`, where `τ` causes `a`.
    ///
    /// All N×N matrices are solved in place: at N = 100 one of `f64` is 80 kB of stack.
    pub fn forward_dynamics_derivatives(
        &self,
        q: &SVector<T, N>,
        v: &SVector<T, N>,
        tau: &SVector<T, N>,
    ) -> ForwardDynamicsDerivatives<T, N> {
        let mut result = ForwardDynamicsDerivatives { da_dq: zeros(), da_dv: zeros(), da_dtau: zeros() };
        let ForwardDynamicsDerivatives { da_dq, da_dv, da_dtau } = &mut result;
        let mut mass_matrix = zeros();
        let a = self.forward_dynamics(q, v, tau);
        self.write_inverse_dynamics_derivatives(q, v, &a, [da_dq, da_dv, &mut mass_matrix]);

        let mut buffer = [[0; N]; N];
        let ancestors = self.ancestors(&mut buffer);
        let l = &mut mass_matrix.data.0;
        let d_inv = factor(&ancestors, l);
        let minus_d_inv = d_inv.map(|x| -x);
        for derivative in [da_dq, da_dv] {
            let rows = &mut derivative.data.0;
            transpose(rows);
            solve_columns(&ancestors, l, &minus_d_inv, rows);
            transpose(rows);
        }

        // Symmetric: its rows are its columns.
        (0..N).for_each(|k| set(da_dtau, k, k, T::one()));
        solve_columns(&ancestors, l, &d_inv, &mut da_dtau.data.0);
        result
    }

    /// For each link the links between it and the base.
    fn ancestors<'b>(&self, buffer: &'b mut [[usize; N]; N]) -> [&'b [usize]; N] {
        let mut lists: [&[usize]; N] = [&[]; N];
        for ((link, room), list) in self.links.iter().zip(buffer).zip(&mut lists) {
            let mut length = 0;
            for (place, k) in room.iter_mut().zip(self.path_to_base(link.parent)) {
                *place = k;
                length += 1;
            }
            *list = room.get(..length).unwrap_or_default();
        }
        lists
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
