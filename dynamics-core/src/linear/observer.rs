//! A filter that runs: the estimate of the state from inputs and measurements, sample by sample.

use nalgebra::{SMatrix, SVector};

use super::error::LinearError;
use super::kalman::Kalman;
use crate::product::product;
use crate::scalar::Scalar;
use crate::state_space::StateSpace;

/// The state of a model in discrete time, as far as measurements tell.
///
/// In each sample, first [`correct`](Self::correct) by what was measured, then [`predict`](Self::predict) with the input
/// that acts until the next one. Plain arithmetic without a decision: it runs on any [`Scalar`] and any target.
///
/// # Cost
///
/// `correct` takes 2·NX·NY multiplications, `predict` NX·(NX + NU + NY).
///
/// # Example
///
/// ```
/// use dynamics_core::linear::{Hold, Observer, Weights};
/// use dynamics_core::prelude::*;
///
/// // A mass of which the position is measured; the force is known.
/// let mass = StateSpace::<f64, 2, 1, 1>::from_matrices(
///     [[0.0, 0.0], [1.0, 0.0]].into(), // by columns
///     [[0.0, 1.0]].into(),
///     [[1.0], [0.0]].into(),
///     [[0.0]].into(),
/// );
/// let sampled = mass.discretize(Hold::Zero, 0.01)?;
/// let filter = sampled.kalman(&Weights::diagonal([1e-8, 1e-4], [1e-4]))?;
/// let mut observer = Observer::new(&sampled, &filter, SVector::zeros())?;
/// let mut x = SVector::from([0.3, 1.0]); // what the observer does not know
/// for _ in 0..500 {
///     let u = SVector::from([-0.5]);
///     observer.correct(&u, &sampled.output(&x, &u));
///     observer.predict(&u);
///     x = sampled.derivative(&x, &u);
/// }
/// assert!((observer.estimate() - x).amax() < 1e-6);
/// # Ok::<(), dynamics_core::linear::LinearError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observer<T, const NX: usize, const NU: usize, const NY: usize> {
    model: StateSpace<T, NX, NU, NY>,
    correction: SMatrix<T, NX, NY>,
    /// What the innovation adds to the prediction beyond A times the correction: of noises with a cross term.
    carried: SMatrix<T, NX, NY>,
    estimate: SVector<T, NX>,
    innovation: SVector<T, NY>,
}

impl<T: Scalar, const NX: usize, const NU: usize, const NY: usize> Observer<T, NX, NU, NY> {
    /// The filter of a model in discrete time, from a first guess of the state.
    ///
    /// # Errors
    ///
    /// [`LinearError::WrongTime`] of a model in continuous time.
    pub fn new(
        model: &StateSpace<T, NX, NU, NY>,
        filter: &Kalman<T, NX, NY>,
        guess: SVector<T, NX>,
    ) -> Result<Self, LinearError> {
        const CONTINUOUS: &str =
            "an observer goes from sample to sample; discretise the model, and its filter from it";
        if model.sample_time.is_none() {
            return Err(LinearError::WrongTime { expected: CONTINUOUS });
        }
        Ok(Self {
            model: *model,
            correction: filter.correction,
            carried: filter.gain - product(&model.a, &filter.correction),
            estimate: guess,
            innovation: SVector::zeros(),
        })
    }

    /// The estimate: after [`correct`](Self::correct) of the present state, after [`predict`](Self::predict) of the next.
    #[must_use]
    pub fn estimate(&self) -> SVector<T, NX> {
        self.estimate
    }

    /// What the last measurement differed by from what was expected, `y − ŷ`: white noise if the model is right.
    #[must_use]
    pub fn innovation(&self) -> SVector<T, NY> {
        self.innovation
    }

    /// Takes a measurement into the estimate, and gives it. `u` is the input while it was taken; it matters only to a model
    /// with a D.
    pub fn correct(&mut self, u: &SVector<T, NU>, y: &SVector<T, NY>) -> SVector<T, NX> {
        self.innovation = y - self.model.output(&self.estimate, u);
        self.estimate += product(&self.correction, &self.innovation);
        self.estimate
    }

    /// Goes on to the next sample with the input that acts until then.
    pub fn predict(&mut self, u: &SVector<T, NU>) {
        self.estimate = self.model.derivative(&self.estimate, u) + product(&self.carried, &self.innovation);
        self.innovation = SVector::zeros();
    }
}
