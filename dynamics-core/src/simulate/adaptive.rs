//! Simulation in steps of their own size, within tolerances.

use nalgebra::SVector;

use super::event::{Arrival, Event};
use super::flow::Driven;
use super::locate::{self, Beginning, Moment};
use super::march::March;
use super::numbers::smaller;
use super::{Sample, Segment, Tolerances, Unforced, until_error};
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// A robot moving in time, by the method of Dormand and Prince: order 5, with steps whose errors keep to
/// [`Tolerances`], states between them, and [events](Self::advance_until). No heap, no panic; forwards only.
///
/// The method works in the chart `q₀ ⊕ δ` of each step (H. Munthe-Kaas), so that quaternions are of unit length, between
/// the steps too. The input is a closure of time (s) and state that returns the joint forces `τ`; it is asked within
/// the steps, and never beyond the time to go to. Where it jumps at known times, go to these.
///
/// Energy is kept as well as the tolerances ask for, and no better; [`Variational`](super::Variational) keeps it
/// from drifting.
///
/// # Example
///
/// ```
/// # use dynamics_core::prelude::*;
/// # fn swing<R>(robot: &R, q0: SVector<f64, 2>) -> Result<(), Error>
/// # where R: Dynamics<f64, 2, 2> + Configuration<f64, 2, 2> {
/// let mut simulation = Adaptive::new(robot, State::rest(q0), Tolerances::of(1e-9))?
///     .with_input(|_time, state| -0.1 * state.v);
/// for sample in simulation.every(0.01, 2.0) { // from the steps' own polynomials
///     let Sample { time, state, .. } = sample?;
///     # let _ = (time, state);
/// }
/// let end = simulation.advance_to(10.0)?;
/// # assert_eq!(end.time, 10.0);
/// # Ok(()) }
/// ```
///
/// # Cost
///
/// Six `forward_dynamics` for each step that is accepted or not, and one at the start.
///
/// # Source
///
/// J. Dormand, P. Prince, *A family of embedded Runge–Kutta formulae*, J. Comput. Appl. Math. 6 (1980) 19–26.
#[derive(Debug)]
pub struct Adaptive<'r, R, T, const NQ: usize, const NV: usize, U = Unforced<T, NQ, NV>> {
    robot: &'r R,
    input: U,
    march: March<T, SVector<T, NQ>, SVector<T, NV>>,
    /// Where the simulation is: at the end of the last step, or on it.
    time: T,
    state: State<T, NQ, NV>,
    beginning: Beginning,
    /// So many events in a row have come at once.
    at_once: u32,
}

/// So many events in a row may come at once, at states that are given for it; then they stand in the way of time.
const MOST_AT_ONCE: u32 = 64;

impl<'r, R, T, const NQ: usize, const NV: usize> Adaptive<'r, R, T, NQ, NV>
where
    R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV>,
    T: Scalar + PartialOrd + Into<f64>,
{
    /// A simulation from `state` at time 0, without joint forces. The first step finds its own size.
    ///
    /// # Errors
    ///
    /// [`Error::ToleranceNotPositive`]; [`Error::NotFinite`] and [`Error::NotUnitQuaternion`] for the state.
    pub fn new(robot: &'r R, state: State<T, NQ, NV>, tolerances: Tolerances<T>) -> Result<Self, Error> {
        let march = March::new((state.q, state.v), tolerances)?;
        robot.check_configuration(&state.q)?;
        let input: Unforced<T, NQ, NV> = |_, _| SVector::zeros();
        Ok(Self { robot, input, march, time: T::zero(), state, beginning: Beginning::Given, at_once: 0 })
    }
}

impl<'r, R, T, const NQ: usize, const NV: usize, U> Adaptive<'r, R, T, NQ, NV, U>
where
    T: Scalar + PartialOrd,
{
    /// The same simulation under the joint forces `τ = input(time, state)`, in N·m or N.
    #[must_use]
    pub fn with_input<W>(self, input: W) -> Adaptive<'r, R, T, NQ, NV, W>
    where
        W: FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
    {
        let Self { robot, mut march, time, state, beginning, at_once, .. } = self;
        march.restart(time, (state.q, state.v));
        Adaptive { robot, input, march, time, state, beginning, at_once }
    }

    /// The same simulation in steps from `least` to `greatest`, in s; the last one before a given time may be shorter.
    ///
    /// Without it no step is too large, and one too small that time would not grow by.
    ///
    /// # Errors
    ///
    /// [`Error::StepNotPositive`] if one is not positive and finite, or `least` is above `greatest`.
    pub fn with_steps(self, least: T, greatest: T) -> Result<Self, Error> {
        Ok(Self { march: self.march.with_steps(least, greatest)?, ..self })
    }

    /// The same simulation with at most so many steps in each call, tried ones too; a million without it.
    #[must_use]
    pub fn with_most_steps(self, most: usize) -> Self {
        Self { march: self.march.with_most_steps(most), ..self }
    }

    /// The time since the start, in s.
    #[must_use]
    pub fn time(&self) -> T {
        self.time
    }

    /// The state now.
    #[must_use]
    pub fn state(&self) -> &State<T, NQ, NV> {
        &self.state
    }

    /// Time, state and robot now; the first sample, if taken before the first step.
    #[must_use]
    pub fn sample(&self) -> Sample<'r, R, T, NQ, NV> {
        Sample { time: self.time, state: self.state, robot: self.robot }
    }

    /// The last step, in which or at whose end the simulation is; none before the first, and after a change of state.
    #[must_use]
    pub fn segment(&self) -> Option<&Segment<T, NQ, NV>> {
        self.march.piece()
    }
}

impl<'r, R, T, const NQ: usize, const NV: usize, U> Adaptive<'r, R, T, NQ, NV, U>
where
    R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV>,
    T: Scalar + PartialOrd + Into<f64>,
    U: FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
{
    /// Goes on from another state now: after an impact, say.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`] and [`Error::NotUnitQuaternion`]; the simulation then stays where it was.
    pub fn set_state(&mut self, state: State<T, NQ, NV>) -> Result<(), Error> {
        state.check()?;
        self.robot.check_configuration(&state.q)?;
        (self.state, self.beginning) = (state, Beginning::Given);
        self.march.restart(self.time, (state.q, state.v));
        Ok(())
    }

    /// Goes to `time`, in s, and returns the state there; where it is already is no error.
    ///
    /// # Errors
    ///
    /// [`Error::TimeNotAhead`] if that is before now or not finite. [`Error::NotFinite`] of `tau`, `a` or a state, and
    /// [`Error::SingularMassMatrix`]. [`Error::StepTooSmall`] and [`Error::TooManySteps`]. The simulation then is at the
    /// end of the last good step.
    pub fn advance_to(&mut self, time: T) -> Result<Sample<'r, R, T, NQ, NV>, Error> {
        let none: [&dyn Event<R, T, NQ, NV>; 0] = [];
        self.advance_until(time, &none).map(|arrival| arrival.sample)
    }

    /// Goes to the next of the events, or to `time`, in s, if there is none until then.
    ///
    /// Several that happen together are returned together; one that was returned is not found again. After any, the
    /// simulation can go on as it was, or from [another state](Self::set_state). An event is found by the sign of its
    /// function at eight moments of each step, and by which way it turns there: twice within an eighth is seen, and
    /// not more. The time is exact to rounding, on the step's polynomial.
    ///
    /// Where a state is given at [a barrier](Event::is_barrier), such as a [`JointLimit`](super::JointLimit), and goes on
    /// from there, that is an event at once, and time does not go on. A bounce that halves the speed each time thus ends
    /// after a few dozen of them: whoever bounces should hold what has become slow, and after 64 events at one time there
    /// is an error.
    ///
    /// Events of several kinds are an array of references: `&[&limit as &dyn Event<_, _, 2, 2>, &floor]`, with `NQ` and
    /// `NV` of the robot.
    ///
    /// # Errors
    ///
    /// As [`advance_to`](Self::advance_to), with [`Error::StepTooSmall`] of events at one time too; [`Error::NotFinite`] of
    /// `event` if a function is no number.
    pub fn advance_until<V, const E: usize>(
        &mut self,
        time: T,
        events: &[V; E],
    ) -> Result<Arrival<'r, R, T, NQ, NV, E>, Error>
    where
        V: Event<R, T, NQ, NV>,
    {
        let mut left = self.check_ahead(time)?;
        while self.time < time {
            if self.time == self.march.time() {
                self.take_step(time, &mut left)?;
            }
            let end = smaller(self.march.time(), time);
            if let Some(segment) = self.march.piece() {
                let from = Moment { time: self.time, state: self.state };
                let found = locate::first(self.robot, segment, from, end, self.beginning, events)?;
                if let Some((moment, events)) = found {
                    self.at_once = if moment.time > self.time { 0 } else { self.at_once.saturating_add(1) };
                    if self.at_once > MOST_AT_ONCE {
                        return Err(Error::StepTooSmall { time: self.time.into() });
                    }
                    (self.time, self.state) = (moment.time, moment.state);
                    self.beginning = Beginning::Reached;
                    return Ok(Arrival { sample: self.sample(), events });
                }
            }
            self.go_to(end);
        }
        Ok(Arrival { sample: self.sample(), events: [false; E] })
    }

    /// How many steps there are for going to `time`, if that is not before now.
    pub(super) fn check_ahead(&self, time: T) -> Result<usize, Error> {
        let ahead = time >= self.time && time.is_finite();
        if ahead { Ok(self.march.most_steps()) } else { Err(Error::TimeNotAhead) }
    }

    /// The joint forces now.
    #[cfg(feature = "std")]
    pub(super) fn tau(&mut self) -> SVector<T, NV> {
        (self.input)(self.time, &self.state)
    }

    /// The samples at the ends of the method's own steps, up to `until`, in s; ends early behind the first error.
    ///
    /// # Errors
    ///
    /// Those of [`advance_to`](Self::advance_to).
    pub fn steps(&mut self, until: T) -> impl Iterator<Item = Result<Sample<'r, R, T, NQ, NV>, Error>> {
        let ahead = self.check_ahead(until);
        let mut left = ahead.unwrap_or(0);
        until_error(move || match ahead {
            Ok(_) if self.time >= until => None,
            Ok(_) => Some(self.step(until, &mut left).map(|()| self.sample())),
            Err(error) => Some(Err(error)),
        })
    }

    /// The samples at every `interval` from now, up to `until`, in s; ends early behind the first error.
    ///
    /// The steps do not depend on it: between them there are their polynomials.
    ///
    /// # Errors
    ///
    /// [`Error::StepNotPositive`] for the interval; those of [`advance_to`](Self::advance_to).
    pub fn every(
        &mut self,
        interval: T,
        until: T,
    ) -> impl Iterator<Item = Result<Sample<'r, R, T, NQ, NV>, Error>> {
        let (start, mut count) = (self.time, Some(0_u32));
        let positive = interval > T::zero() && interval.is_finite();
        let sound = if positive { self.check_ahead(until).map(|_| ()) } else { Err(Error::StepNotPositive) };
        // The last one may be late by rounding.
        let latest = interval.mul_add(T::of(1e-3), until);
        until_error(move || {
            count = count.and_then(|count| count.checked_add(1));
            let time = count.map(|count| interval.mul_add(T::of(f64::from(count)), start));
            match (sound, time) {
                (Ok(()), Some(time)) if time > latest => None,
                (Ok(()), Some(time)) => Some(self.sample_on_the_way(smaller(time, until), until)),
                (Ok(()), None) => Some(Err(Error::TooManySteps { time: self.time.into() })),
                (Err(error), _) => Some(Err(error)),
            }
        })
    }

    /// Goes to `time` by steps that may lead beyond it, up to `until`.
    fn sample_on_the_way(&mut self, time: T, until: T) -> Result<Sample<'r, R, T, NQ, NV>, Error> {
        let mut left = self.march.most_steps();
        while self.march.time() < time {
            self.take_step(until, &mut left)?;
        }
        self.go_to(time);
        Ok(self.sample())
    }

    /// Goes to the end of the step, or of the next one if it is there, or to `until` if that is on it.
    pub(super) fn step(&mut self, until: T, left: &mut usize) -> Result<(), Error> {
        if self.time == self.march.time() {
            self.take_step(until, left)?;
        }
        self.go_to(smaller(self.march.time(), until));
        Ok(())
    }

    /// Goes to a time on the last step.
    fn go_to(&mut self, time: T) {
        let (q, v) = self.march.at(time, |q, delta| self.robot.integrate(q, delta));
        (self.time, self.state) = (time, State { q, v });
        (self.beginning, self.at_once) = (Beginning::Reached, 0);
    }

    /// Goes one step on from the end of the last one, and not beyond `until`.
    fn take_step(&mut self, until: T, left: &mut usize) -> Result<(), Error> {
        self.march.step(&mut Driven::new(self.robot, &mut self.input), until, left)
    }
}

impl<R, T: Scalar, U: Clone, const NQ: usize, const NV: usize> Clone for Adaptive<'_, R, T, NQ, NV, U> {
    fn clone(&self) -> Self {
        Self { input: self.input.clone(), ..*self }
    }
}
