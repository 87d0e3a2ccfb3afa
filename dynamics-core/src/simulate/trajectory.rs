//! A motion that was recorded: states at times, and between them.
//!
//! It is kept on the heap, and so is behind the feature `std`.

use std::vec::Vec;

use nalgebra::SVector;

use super::numbers::magnitude;
use super::{Adaptive, Integrator, Sample, Segment, Simulation};
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// A recorded motion of a robot: times, states and joint forces, in the order of time.
///
/// [`Simulation::record`] and [`Adaptive::record`] make one; [`new`](Self::new) and [`push`](Self::push) make it from
/// samples of any origin.
///
/// # Example
///
/// ```
/// # use dynamics_core::prelude::*;
/// # fn swing<R>(robot: &R, q0: SVector<f64, 2>) -> Result<(), Error>
/// # where R: Dynamics<f64, 2, 2> + Configuration<f64, 2, 2> {
/// let motion = Adaptive::new(robot, State::rest(q0), Tolerances::of(1e-9))?.record(10.0)?;
/// assert_eq!(motion.times().len(), motion.states().len());
/// if let Some(state) = motion.at(3.21) {
///     let _ = state.q;
/// }
/// for sample in motion.every(0.01) {
///     let joules = sample.energy().total();
///     # let _ = joules;
/// }
/// # Ok(()) }
/// ```
#[derive(Debug)]
pub struct Trajectory<'r, R, T, const NQ: usize, const NV: usize> {
    robot: &'r R,
    times: Vec<T>,
    states: Vec<State<T, NQ, NV>>,
    inputs: Vec<SVector<T, NV>>,
    /// One before each time but the first.
    segments: Vec<Segment<T, NQ, NV>>,
}

impl<'r, R, T, const NQ: usize, const NV: usize> Trajectory<'r, R, T, NQ, NV>
where
    R: Configuration<T, NQ, NV>,
    T: Scalar + PartialOrd,
{
    /// A motion that begins with `start`, under the joint forces `tau`.
    #[must_use]
    pub fn new(start: Sample<'r, R, T, NQ, NV>, tau: SVector<T, NV>) -> Self {
        let Sample { time, state, robot } = start;
        let (times, states, inputs) = ([time].into(), [state].into(), [tau].into());
        Self { robot, times, states, inputs, segments: Vec::new() }
    }

    /// Adds a sample, and between the last one and this [what two states say](Segment::between).
    ///
    /// # Errors
    ///
    /// [`Error::TimeNotAhead`] if it is not later than the last one.
    pub fn push(&mut self, sample: Sample<'r, R, T, NQ, NV>, tau: SVector<T, NV>) -> Result<(), Error> {
        let times = [self.end(), sample.time];
        let segment = Segment::between(self.robot, times, [&self.last(), &sample.state]);
        self.push_with(segment, sample, tau)
    }

    fn push_with(
        &mut self,
        segment: Segment<T, NQ, NV>,
        Sample { time, state, .. }: Sample<'r, R, T, NQ, NV>,
        tau: SVector<T, NV>,
    ) -> Result<(), Error> {
        let ahead = time > self.end() && time.is_finite();
        if !ahead {
            return Err(Error::TimeNotAhead);
        }
        self.segments.push(segment);
        self.times.push(time);
        self.states.push(state);
        self.inputs.push(tau);
        Ok(())
    }

    /// The times, in s, each later than the one before; there is at least one.
    #[must_use]
    pub fn times(&self) -> &[T] {
        &self.times
    }

    /// The states at these.
    #[must_use]
    pub fn states(&self) -> &[State<T, NQ, NV>] {
        &self.states
    }

    /// The joint forces at these, in N·m or N.
    #[must_use]
    pub fn inputs(&self) -> &[SVector<T, NV>] {
        &self.inputs
    }

    /// When it begins, in s.
    #[must_use]
    pub fn start(&self) -> T {
        self.times.first().copied().unwrap_or(T::zero())
    }

    /// When it ends, in s.
    #[must_use]
    pub fn end(&self) -> T {
        self.times.last().copied().unwrap_or(T::zero())
    }

    /// The state at the end.
    fn last(&self) -> State<T, NQ, NV> {
        self.states.last().copied().unwrap_or_else(|| State::rest(self.robot.neutral()))
    }

    /// The state at `time`, in s, on the step's polynomial; none before the start and after the end.
    #[must_use]
    pub fn at(&self, time: T) -> Option<State<T, NQ, NV>> {
        let after = self.times.partition_point(|known| *known < time);
        let known = self.times.get(after)?;
        if *known == time {
            return self.states.get(after).copied();
        }
        let segment = self.segments.get(after.checked_sub(1)?)?;
        Some(segment.at(self.robot, time))
    }

    /// The index of the recorded time nearest to `time`, of two the earlier.
    #[must_use]
    pub fn nearest(&self, time: T) -> usize {
        let after = self.times.partition_point(|known| *known < time);
        let distance = |index: usize| self.times.get(index).map(|known| magnitude(*known - time));
        match (after.checked_sub(1), distance(after)) {
            (None, _) => 0,
            (Some(before), None) => before,
            (Some(before), Some(beyond)) if distance(before).is_some_and(|short| short <= beyond) => before,
            _ => after,
        }
    }

    /// The samples at the recorded times, which know their energies, powers and momenta.
    pub fn samples(&self) -> impl Iterator<Item = Sample<'r, R, T, NQ, NV>> {
        let robot = self.robot;
        self.times.iter().zip(&self.states).map(move |(&time, &state)| Sample { time, state, robot })
    }

    /// The samples at the start and at every `interval` after it, in s, up to the end; only the start of an interval that
    /// is not positive.
    pub fn every(&self, interval: T) -> impl Iterator<Item = Sample<'r, R, T, NQ, NV>> {
        let (start, robot) = (self.start(), self.robot);
        let sound = interval > T::zero();
        let last = if sound { u32::MAX } else { 0 };
        (0..=last).map_while(move |k| {
            let time = interval.mul_add(T::of(f64::from(k)), start);
            let time = if sound { time } else { start };
            self.at(time).map(|state| Sample { time, state, robot })
        })
    }
}

impl<R, T: Scalar, const NQ: usize, const NV: usize> Clone for Trajectory<'_, R, T, NQ, NV> {
    fn clone(&self) -> Self {
        let Self { robot, times, states, inputs, segments } = self;
        let (times, states) = (times.clone(), states.clone());
        Self { robot, times, states, inputs: inputs.clone(), segments: segments.clone() }
    }
}

impl<'r, R, T, const NQ: usize, const NV: usize, I, U> Simulation<'r, R, T, NQ, NV, I, U>
where
    R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV>,
    T: Scalar + PartialOrd,
    I: Integrator,
    U: FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
{
    /// The motion of the next `count` steps, with where it begins.
    ///
    /// # Errors
    ///
    /// Those of [`step`](Self::step).
    pub fn record(&mut self, count: usize) -> Result<Trajectory<'r, R, T, NQ, NV>, Error> {
        let start = self.sample();
        let mut trajectory = Trajectory::new(start, (self.input)(start.time, &start.state));
        for _ in 0..count {
            let sample = self.step()?;
            trajectory.push(sample, (self.input)(sample.time, &sample.state))?;
        }
        Ok(trajectory)
    }
}

impl<'r, R, T, const NQ: usize, const NV: usize, U> Adaptive<'r, R, T, NQ, NV, U>
where
    R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV>,
    T: Scalar + PartialOrd + Into<f64>,
    U: FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
{
    /// The motion up to `until`, in s: the method's own steps, with their polynomials, and where it begins.
    ///
    /// # Errors
    ///
    /// Those of [`advance_to`](Self::advance_to).
    pub fn record(&mut self, until: T) -> Result<Trajectory<'r, R, T, NQ, NV>, Error> {
        let mut left = self.check_ahead(until)?;
        let mut trajectory = Trajectory::new(self.sample(), self.tau());
        while self.time() < until {
            self.step(until, &mut left)?;
            let (sample, tau) = (self.sample(), self.tau());
            match self.segment() {
                Some(segment) => trajectory.push_with(*segment, sample, tau)?,
                None => trajectory.push(sample, tau)?,
            }
        }
        Ok(trajectory)
    }
}
