//! Linear models in matrices, with names and units: ẋ = A·x + B·u + drift, y = C·x + D·u + offset.

mod signal;
pub(crate) mod table;

pub use signal::Signal;

use nalgebra::{SMatrix, SVector};

use crate::linearize::Linearization;
use crate::product::product;
use crate::scalar::Scalar;

/// `ẋ = A·x + B·u + drift`, `y = C·x + D·u + offset`, with `NX` states, `NU` inputs and `NY` outputs.
///
/// Of a robot at `(q₀, v₀, u₀)`, `x = (q ⊖ q₀, v − v₀)` and `u` are deviations, and `y` is the output itself:
/// `drift` and `offset` are what ẋ and y are at the point. At an equilibrium the drift is zero. With a
/// [sample time](Self::sample_time) the left-hand side is the next `x` instead of ẋ.
///
/// It prints as a table with names and units; `{:.6}` sets the digits.
///
/// # Example
///
/// ```
/// use dynamics_core::prelude::*;
///
/// let mut mass = StateSpace::<f64, 2, 1, 1>::from_matrices(
///     [[0.0, -4.0], [1.0, -0.1]].into(), // by columns
///     [[0.0, 0.5]].into(),
///     [[1.0], [0.0]].into(),
///     [[0.0]].into(),
/// );
/// mass.states = [Signal::new("slider", "m"), Signal::part("slider", "'", "m/s")];
/// mass.inputs = [Signal::new("motor", "N")];
/// println!("{mass}");
/// assert_eq!(mass.derivative(&[1.0, 0.0].into(), &[2.0].into()), SVector::from([0.0, -3.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StateSpace<T, const NX: usize, const NU: usize, const NY: usize> {
    /// `∂ẋ/∂x`, NX×NX.
    pub a: SMatrix<T, NX, NX>,
    /// `∂ẋ/∂u`, NX×NU.
    pub b: SMatrix<T, NX, NU>,
    /// `∂y/∂x`, NY×NX.
    pub c: SMatrix<T, NY, NX>,
    /// `∂y/∂u`, NY×NU.
    pub d: SMatrix<T, NY, NU>,
    /// ẋ at the point, NX.
    pub drift: SVector<T, NX>,
    /// y at the point, NY.
    pub offset: SVector<T, NY>,
    /// The time from one state to the next, in s; `None` of a model in continuous time.
    pub sample_time: Option<T>,
    /// What the states are called.
    pub states: [Signal; NX],
    /// What the inputs are called.
    pub inputs: [Signal; NU],
    /// What the outputs are called.
    pub outputs: [Signal; NY],
}

impl<T: Scalar, const NX: usize, const NU: usize, const NY: usize> StateSpace<T, NX, NU, NY> {
    /// The model in continuous time of four matrices: without drift, offset and names.
    #[must_use]
    pub fn from_matrices(
        a: SMatrix<T, NX, NX>,
        b: SMatrix<T, NX, NU>,
        c: SMatrix<T, NY, NX>,
        d: SMatrix<T, NY, NU>,
    ) -> Self {
        let (drift, offset) = (SVector::zeros(), SVector::zeros());
        let (states, inputs, outputs) = ([Signal::UNNAMED; NX], [Signal::UNNAMED; NU], [Signal::UNNAMED; NY]);
        Self { a, b, c, d, drift, offset, sample_time: None, states, inputs, outputs }
    }

    /// `A·x + B·u + drift`, NX: the rate ẋ, or with a sample time the next `x`.
    #[must_use]
    pub fn derivative(&self, x: &SVector<T, NX>, u: &SVector<T, NU>) -> SVector<T, NX> {
        product(&self.a, x) + product(&self.b, u) + self.drift
    }

    /// The output `y = C·x + D·u + offset`, NY.
    #[must_use]
    pub fn output(&self, x: &SVector<T, NX>, u: &SVector<T, NU>) -> SVector<T, NY> {
        product(&self.c, x) + product(&self.d, u) + self.offset
    }
}

/// The model whose output is its state.
impl<T: Scalar, const NX: usize, const NU: usize> From<Linearization<T, NX, NU>>
    for StateSpace<T, NX, NU, NX>
{
    fn from(linear: Linearization<T, NX, NU>) -> Self {
        let Linearization { a, b, drift } = linear;
        Self { drift, ..Self::from_matrices(a, b, SMatrix::identity(), SMatrix::zeros()) }
    }
}
