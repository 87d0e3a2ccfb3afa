//! Analysis and design as methods of a model.

use nalgebra::{Complex, SVector};

use super::error::LinearError;
use super::kalman::{Kalman, kalman};
use super::lqr::{Lqr, Weights, lqr};
use super::place::{Placement, place_poles};
use super::poles::{Mode, Stability, Time, Verdict, sorted_poles, stability};
use super::reach::{Reach, controllability, observability};
use super::real::Real;
use crate::state_space::StateSpace;

impl<T: Real, const NX: usize, const NU: usize, const NY: usize> StateSpace<T, NX, NU, NY> {
    /// The kind of time in which the model goes on: discrete if it has a sample time.
    #[must_use]
    pub fn time(&self) -> Time {
        if self.sample_time.is_some() { Time::Discrete } else { Time::Continuous }
    }

    /// The poles, NX: the slowest first. See [`poles`](fn@super::poles).
    ///
    /// # Errors
    ///
    /// [`LinearError::NotFinite`], [`LinearError::NoConvergence`].
    pub fn poles(&self) -> Result<SVector<Complex<T>, NX>, LinearError> {
        sorted_poles(self.time(), &self.a)
    }

    /// The poles with their natural frequencies and damping, NX: the slowest first.
    ///
    /// # Errors
    ///
    /// Those of [`poles`](Self::poles).
    pub fn modes(&self) -> Result<[Mode<T>; NX], LinearError> {
        let poles = self.poles()?;
        Ok(core::array::from_fn(|k| match self.sample_time {
            Some(step) => Mode::discrete(poles[k], step),
            None => Mode::continuous(poles[k]),
        }))
    }

    /// Whether motions end, with the pole that decides it and the margin. See [`stability`].
    ///
    /// # Errors
    ///
    /// Those of [`poles`](Self::poles).
    pub fn stability(&self) -> Result<Stability<T>, LinearError> {
        stability(self.time(), &self.a)
    }

    /// Whether all motions end, for this A and all that rounding cannot tell from it.
    ///
    /// # Errors
    ///
    /// Those of [`poles`](Self::poles).
    pub fn is_stable(&self) -> Result<bool, LinearError> {
        Ok(self.stability()?.verdict == Verdict::Stable)
    }

    /// Which modes the inputs reach. See [`controllability`].
    ///
    /// # Errors
    ///
    /// Those of [`poles`](Self::poles).
    pub fn controllability(&self) -> Result<Reach<T, NX>, LinearError> {
        controllability(&self.a, &self.b)
    }

    /// Which modes the outputs show. See [`observability`].
    ///
    /// # Errors
    ///
    /// Those of [`poles`](Self::poles).
    pub fn observability(&self) -> Result<Reach<T, NX>, LinearError> {
        observability(&self.a, &self.c)
    }

    /// The feedback `u = −K·x` of least cost, per second or per step. See [`lqr`](fn@super::lqr).
    ///
    /// # Errors
    ///
    /// Those of [`lqr`](fn@super::lqr).
    pub fn lqr(&self, weights: &Weights<T, NX, NU>) -> Result<Lqr<T, NX, NU>, LinearError> {
        lqr(self.time(), &self.a, &self.b, weights)
    }

    /// The gains of the steady Kalman filter for noises of the states and of the outputs. See
    /// [`kalman`](fn@super::kalman); [`Observer`](super::Observer) runs it.
    ///
    /// # Errors
    ///
    /// Those of [`kalman`](fn@super::kalman).
    pub fn kalman(&self, noise: &Weights<T, NX, NY>) -> Result<Kalman<T, NX, NY>, LinearError> {
        kalman(self.time(), &self.a, &self.c, noise)
    }
}

impl<T: Real, const NX: usize, const NY: usize> StateSpace<T, NX, 1, NY> {
    /// The feedback `u = −k·x` with desired poles. See [`place_poles`].
    ///
    /// # Errors
    ///
    /// Those of [`place_poles`].
    pub fn place_poles(&self, desired: &[Complex<T>; NX]) -> Result<Placement<T, NX>, LinearError> {
        place_poles(&self.a, &self.b, desired)
    }
}
