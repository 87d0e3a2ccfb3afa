//! Simulation in fixed steps: a robot, a state, a step of time, and an input.

mod euler;
mod integrator;
mod rk4;
mod sample;

pub use euler::SemiImplicitEuler;
pub use integrator::Integrator;
pub use rk4::Rk4;
pub use sample::{Energy, Sample};

use nalgebra::SVector;

use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// The type of the input `τ = 0`, which a [`Simulation`] has until it is given another.
pub type Unforced<T, const NQ: usize, const NV: usize> = fn(T, &State<T, NQ, NV>) -> SVector<T, NV>;

/// A robot moving in time. No heap, no panic; the first state that is not finite is an error.
///
/// The input is a closure of time (s) and state that returns the joint forces `τ`; it is evaluated wherever the
/// integrator asks, within a step too. To hold an input over a step, give it from outside and call
/// [`step`](Self::step).
///
/// # Example
///
/// ```
/// # use dynamics_core::prelude::*;
/// # fn swing<R>(robot: &R, q0: SVector<f64, 2>) -> Result<(), Error>
/// # where R: Dynamics<f64, 2, 2> + Configuration<f64, 2, 2> {
/// let mut simulation = Simulation::new(robot, State::rest(q0), 1e-3)?
///     .with_input(|_time, state| -0.1 * state.v);
/// for sample in simulation.steps(10_000) {
///     let sample = sample?;
///     let joules = sample.energy().total();
///     # let _ = joules;
/// }
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct Simulation<'r, R, T, const NQ: usize, const NV: usize, I = Rk4, U = Unforced<T, NQ, NV>> {
    robot: &'r R,
    integrator: I,
    input: U,
    step: T,
    time: T,
    /// What rounding took from `time` so far (W. Kahan's summation).
    time_error: T,
    state: State<T, NQ, NV>,
}

impl<'r, R, T, const NQ: usize, const NV: usize> Simulation<'r, R, T, NQ, NV>
where
    R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV>, // by which `State::rest(q)` learns NV
    T: Scalar + PartialOrd,
{
    /// A simulation from `state` at time 0 in steps of `step` seconds, by [`Rk4`], without joint forces.
    ///
    /// # Errors
    ///
    /// [`Error::StepNotPositive`]; [`Error::NotFinite`] and [`Error::NotUnitQuaternion`] for the state.
    pub fn new(robot: &'r R, state: State<T, NQ, NV>, step: T) -> Result<Self, Error> {
        let positive = step > T::zero() && step.is_finite();
        if !positive {
            return Err(Error::StepNotPositive);
        }
        state.check()?;
        robot.check_configuration(&state.q)?;
        let input: Unforced<T, NQ, NV> = |_, _| SVector::zeros();
        Ok(Self { robot, integrator: Rk4, input, step, time: T::zero(), time_error: T::zero(), state })
    }
}

impl<'r, R, T: Scalar, const NQ: usize, const NV: usize, I, U> Simulation<'r, R, T, NQ, NV, I, U> {
    /// The same simulation by another integrator.
    #[must_use]
    pub fn with_integrator<J: Integrator>(self, integrator: J) -> Simulation<'r, R, T, NQ, NV, J, U> {
        let Self { robot, input, step, time, time_error, state, .. } = self;
        Simulation { robot, integrator, input, step, time, time_error, state }
    }

    /// The same simulation under the joint forces `τ = input(time, state)`, in N·m or N.
    #[must_use]
    pub fn with_input<W>(self, input: W) -> Simulation<'r, R, T, NQ, NV, I, W>
    where
        W: FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
    {
        let Self { robot, integrator, step, time, time_error, state, .. } = self;
        Simulation { robot, integrator, input, step, time, time_error, state }
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
}

impl<'r, R, T, const NQ: usize, const NV: usize, I, U> Simulation<'r, R, T, NQ, NV, I, U>
where
    R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV>,
    T: Scalar,
    I: Integrator,
    U: FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
{
    /// Goes one step on and returns where that leads.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`] if the new state is not finite; the simulation then stays where it was.
    pub fn step(&mut self) -> Result<Sample<'r, R, T, NQ, NV>, Error> {
        let next = self.integrator.step(self.robot, self.time, &self.state, self.step, &mut self.input);
        next.check()?;
        self.state = next;
        let step = self.step - self.time_error;
        let time = self.time + step;
        self.time_error = (time - self.time) - step;
        self.time = time;
        Ok(self.sample())
    }

    /// The samples after each of the next `count` steps; ends early behind the first error.
    pub fn steps(&mut self, count: usize) -> impl Iterator<Item = Result<Sample<'r, R, T, NQ, NV>, Error>> {
        let mut failed = false;
        (0..count).map_while(move |_| {
            if failed {
                return None;
            }
            let sample = self.step();
            failed = sample.is_err();
            Some(sample)
        })
    }
}
