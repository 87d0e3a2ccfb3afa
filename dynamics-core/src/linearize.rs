//! Linear models of a robot about a state: ẋ ≈ A·δx + B·δu + drift.

use nalgebra::{SMatrix, SVector};

use crate::dynamics::{DynamicsDerivatives, ForwardDynamicsDerivatives};
use crate::product::product;
use crate::scalar::Scalar;
use crate::state::Configuration;

/// A robot with inputs `u`, seen as `ẋ = f(x, u)` with `x = (q ⊖ q₀, v)`.
///
/// `NX = 2·NV`, which stable Rust cannot write in a signature; another `NX` does not compile.
pub trait StateSpaceModel<T: Scalar, const NQ: usize, const NV: usize, const NX: usize, const NU: usize>:
    DynamicsDerivatives<T, NQ, NV> + Configuration<T, NQ, NV>
{
    /// The input map `B_u`, NV×NU: `τ = B_u·u`.
    fn input_map(&self) -> SMatrix<T, NV, NU>;

    /// `∂(δ̇)/∂δ` at δ = 0, NV×NV, where `q = q₀ ⊕ δ` moves with velocity `v`.
    ///
    /// Zero for one-dof joints, and so by default. A ball joint has `−½ v̂`, a free joint `−½ ad(v)`.
    fn tangent_rate(&self, v: &SVector<T, NV>) -> SMatrix<T, NV, NV> {
        let _ = v;
        SMatrix::zeros()
    }

    /// The derivatives of `f` at `(q, v, u)`: `A` NX×NX, `B` NX×NU, and `drift = f(x, u)`, NX.
    ///
    /// At an equilibrium the drift is zero.
    ///
    /// # Cost
    ///
    /// One `forward_dynamics_derivatives`, one `forward_dynamics`, two products of size NV×NV×NU.
    fn linearize(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        u: &SVector<T, NU>,
    ) -> Linearization<T, NX, NU> {
        const { assert!(NX == 2 * NV, "the state x = (q, v) has 2·NV entries") };
        let input_map = self.input_map();
        let tau = product(&input_map, u);
        let ForwardDynamicsDerivatives { da_dq, da_dv, da_dtau } =
            self.forward_dynamics_derivatives(q, v, &tau);
        let acceleration = self.forward_dynamics(q, v, &tau);

        let mut linearization =
            Linearization { a: SMatrix::zeros(), b: SMatrix::zeros(), drift: SVector::zeros() };
        let Linearization { a, b, drift } = &mut linearization;
        put(a, 0, 0, &self.tangent_rate(v));
        put(a, 0, NV, &SMatrix::<T, NV, NV>::identity());
        put(a, NV, 0, &da_dq);
        put(a, NV, NV, &da_dv);
        put(b, NV, 0, &product(&da_dtau, &input_map));
        put(drift, 0, 0, v);
        put(drift, NV, 0, &acceleration);
        linearization
    }
}

/// `ẋ ≈ A·δx + B·δu + drift`, with `x = (q ⊖ q₀, v)`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "T: Scalar + serde::Serialize",
        deserialize = "T: Scalar + serde::Deserialize<'de>"
    ))
)]
pub struct Linearization<T, const NX: usize, const NU: usize> {
    /// `∂f/∂x`, NX×NX: `[0 1; ∂a/∂q ∂a/∂v]`.
    pub a: SMatrix<T, NX, NX>,
    /// `∂f/∂u`, NX×NU: `[0; M⁻¹·B_u]`.
    pub b: SMatrix<T, NX, NU>,
    /// `f(x, u) = (v, v̇)`, NX.
    pub drift: SVector<T, NX>,
}

/// Writes `block` into `matrix` from `row`, `column` on; what does not fit is left out.
pub(crate) fn put<T: Scalar, const R: usize, const C: usize, const P: usize, const Q: usize>(
    matrix: &mut SMatrix<T, R, C>,
    row: usize,
    column: usize,
    block: &SMatrix<T, P, Q>,
) {
    let columns = matrix.data.0.iter_mut().skip(column);
    for (entries, block) in columns.zip(&block.data.0) {
        for (entry, value) in entries.iter_mut().skip(row).zip(block) {
            *entry = *value;
        }
    }
}
