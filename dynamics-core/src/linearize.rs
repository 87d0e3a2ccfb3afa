//! Linear models of a robot about a state: ẋ ≈ A·δx + B·δu + drift.

use nalgebra::{SMatrix, SVector};

use crate::dynamics::{DynamicsDerivatives, ForwardDynamicsDerivatives};
use crate::error::Error;
use crate::mechanism::Mechanism;
use crate::output::{OperatingPoint, Output, Row};
use crate::product::{product, transposed_product};
use crate::scalar::Scalar;
use crate::state::Configuration;
use crate::state_space::{Signal, StateSpace};

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
    /// One `forward_dynamics_with_derivatives`, two products of size NV×NV×NU.
    fn linearize(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        u: &SVector<T, NU>,
    ) -> Linearization<T, NX, NU> {
        const { assert!(NX == 2 * NV, "the state x = (q, v) has 2·NV entries") };
        let input_map = self.input_map();
        let tau = product(&input_map, u);
        let (acceleration, derivatives) = self.forward_dynamics_with_derivatives(q, v, &tau);
        assembled(v, &acceleration, &derivatives, &self.tangent_rate(v), &input_map)
    }

    /// The linear model at `(q, v, u)` with the outputs that are asked for: `A`, `B`, `C`, `D`, the drift and the offset,
    /// with names and units. It is exact at any state and input, at rest or not.
    ///
    /// `NY` is the number of rows of `outputs`; another one does not compile. What an output depends on the
    /// acceleration goes into `C` and `D` through `∂a/∂q`, `∂a/∂v` and `∂a/∂u`.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`] names the argument or the result (`a`, `A`, `C` or `y`) that is not;
    /// [`Error::NotUnitQuaternion`]; [`Error::SingularMassMatrix`]; [`Error::NameUnknown`] and
    /// [`Error::IndexTooLarge`] for an output.
    ///
    /// # Cost
    ///
    /// That of [`linearize`](Self::linearize), and of the outputs.
    ///
    /// # Example
    ///
    /// ```
    /// # use dynamics_core::prelude::*;
    /// # fn print<R, Tool0>(robot: &R) -> Result<(), Error>
    /// # where R: StateSpaceModel<f64, 2, 2, 4, 1> + Mechanism, Tool0: Frame<R, f64, 2, 2> {
    /// let (q, v, u) = (SVector::from([0.4, 0.7]), SVector::from([1.0, -2.0]), SVector::from([3.0]));
    /// let measured = (output::joint("elbow"), output::position::<Tool0>());
    /// let plant: StateSpace<f64, 4, 1, 4> = robot.state_space(&q, &v, &u, &measured)?;
    /// println!("{plant}");
    /// # Ok(()) }
    /// ```
    fn state_space<O, const NY: usize>(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        u: &SVector<T, NU>,
        outputs: &O,
    ) -> Result<StateSpace<T, NX, NU, NY>, Error>
    where
        Self: Mechanism,
        O: Output<Self, T, NQ, NV> + ?Sized,
    {
        const { assert!(NX == 2 * NV, "the state x = (q, v) has 2·NV entries") };
        const { assert!(NY == O::ROWS, "NY is the number of rows of the outputs") };
        Error::unless_finite("u", u)?;
        let input_map = self.input_map();
        let tau = product(&input_map, u);
        let (acceleration, derivatives) = self.try_forward_dynamics_with_derivatives(q, v, &tau)?;
        let tangent_rate = self.tangent_rate(v);

        let mut rows = [Row::zero(); NY];
        let at = OperatingPoint { q: *q, v: *v, a: acceleration, tau, tangent_rate };
        outputs.write(self, &at, &mut rows)?;

        let Linearization { a, b, drift } =
            assembled(v, &acceleration, &derivatives, &tangent_rate, &input_map);
        let (mut c, mut d) = (SMatrix::zeros(), SMatrix::zeros());
        let mut offset = SVector::zeros();
        let mut names = [Signal::UNNAMED; NY];
        let ForwardDynamicsDerivatives { da_dq, da_dv, da_dtau } = &derivatives;
        for (index, (row, name)) in rows.iter().zip(&mut names).enumerate() {
            let Row { signal, value, by_q, by_v, by_a, by_tau } = row;
            let by_q = by_q + transposed_product(da_dq, by_a);
            let by_v = by_v + transposed_product(da_dv, by_a);
            let by_tau = by_tau + transposed_product(da_dtau, by_a);
            put(&mut c, index, 0, &by_q.transpose());
            put(&mut c, index, NV, &by_v.transpose());
            put(&mut d, index, 0, &transposed_product(&input_map, &by_tau).transpose());
            put(&mut offset, index, 0, &SVector::from([*value]));
            *name = *signal;
        }
        for entries in &a.data.0 {
            Error::unless_finite("A", &SVector::from(*entries))?;
        }
        Error::unless_finite("y", &offset)?;
        for entries in &c.data.0 {
            Error::unless_finite("C", &SVector::from(*entries))?;
        }
        let state = |index: usize| match index.checked_sub(NV) {
            None => Signal::displacement::<Self>(index),
            Some(index) => Signal::speed::<Self>(index),
        };
        Ok(StateSpace {
            a,
            b,
            c,
            d,
            drift,
            offset,
            sample_time: None,
            states: core::array::from_fn(state),
            inputs: core::array::from_fn(Signal::input::<Self>),
            outputs: names,
        })
    }
}

/// The linear model of its blocks.
fn assembled<T: Scalar, const NV: usize, const NX: usize, const NU: usize>(
    v: &SVector<T, NV>,
    acceleration: &SVector<T, NV>,
    derivatives: &ForwardDynamicsDerivatives<T, NV>,
    tangent_rate: &SMatrix<T, NV, NV>,
    input_map: &SMatrix<T, NV, NU>,
) -> Linearization<T, NX, NU> {
    let mut linearization =
        Linearization { a: SMatrix::zeros(), b: SMatrix::zeros(), drift: SVector::zeros() };
    let Linearization { a, b, drift } = &mut linearization;
    put(a, 0, 0, tangent_rate);
    put(a, 0, NV, &SMatrix::<T, NV, NV>::identity());
    put(a, NV, 0, &derivatives.da_dq);
    put(a, NV, NV, &derivatives.da_dv);
    put(b, NV, 0, &product(&derivatives.da_dtau, input_map));
    put(drift, 0, 0, v);
    put(drift, NV, 0, acceleration);
    linearization
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
