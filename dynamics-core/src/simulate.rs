//! Simulation: a robot, a state, an input, and steps of time, fixed or adaptive.

mod adaptive;
mod clock;
mod controller;
mod dopri5;
mod euler;
mod event;
mod flow;
#[cfg(feature = "std")]
mod heap;
mod integrator;
mod locate;
mod march;
mod monitor;
pub(crate) mod numbers;
mod rk4;
mod sample;
mod segment;
mod tolerances;
#[cfg(feature = "std")]
mod trajectory;
mod turns;
mod variational;

pub use adaptive::Adaptive;
pub use euler::SemiImplicitEuler;
pub use event::{
    Arrival, Barrier, CoordinateAt, Direction, Event, JointLimit, PlaneCrossing, TurningPoint, When, when,
};
pub use flow::{Flow, Vector};
pub use integrator::{Explicit, Integrator, Method};
pub use march::March;
pub use monitor::{EnergyMonitor, Momentum, MomentumMonitor};
pub use rk4::Rk4;
pub use sample::{Energy, Sample};
pub use segment::{Piece, Segment};
pub use tolerances::Tolerances;
#[cfg(feature = "std")]
pub use trajectory::Trajectory;
pub use variational::Variational;

use nalgebra::SVector;

use clock::Clock;

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
#[derive(Debug)]
pub struct Simulation<'r, R, T, const NQ: usize, const NV: usize, I = Rk4, U = Unforced<T, NQ, NV>> {
    robot: &'r R,
    integrator: I,
    input: U,
    step: T,
    clock: Clock<T>,
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
        Ok(Self { robot, integrator: Rk4, input, step, clock: Clock::at(T::zero()), state })
    }
}

impl<'r, R, T: Scalar, const NQ: usize, const NV: usize, I, U> Simulation<'r, R, T, NQ, NV, I, U> {
    /// The same simulation by another integrator.
    #[must_use]
    pub fn with_integrator<J: Integrator>(self, integrator: J) -> Simulation<'r, R, T, NQ, NV, J, U> {
        let Self { robot, input, step, clock, state, .. } = self;
        Simulation { robot, integrator, input, step, clock, state }
    }

    /// The same simulation under the joint forces `τ = input(time, state)`, in N·m or N.
    #[must_use]
    pub fn with_input<W>(self, input: W) -> Simulation<'r, R, T, NQ, NV, I, W>
    where
        W: FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
    {
        let Self { robot, integrator, step, clock, state, .. } = self;
        Simulation { robot, integrator, input, step, clock, state }
    }

    /// The time since the start, in s.
    #[must_use]
    pub fn time(&self) -> T {
        self.clock.time
    }

    /// The state now.
    #[must_use]
    pub fn state(&self) -> &State<T, NQ, NV> {
        &self.state
    }

    /// Time, state and robot now; the first sample, if taken before the first step.
    #[must_use]
    pub fn sample(&self) -> Sample<'r, R, T, NQ, NV> {
        Sample { time: self.clock.time, state: self.state, robot: self.robot }
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
    /// If the new state is not finite: [`Error::SingularMassMatrix`] or [`Error::NotFinite`] of `tau` or `a`, where the
    /// state before the step already has it, of `tau` also where the end of the step has it; else [`Error::NotFinite`] of the
    /// new state. Those of the integrator. The simulation then stays where it was.
    pub fn step(&mut self) -> Result<Sample<'r, R, T, NQ, NV>, Error> {
        let Self { robot, integrator, input, step, clock, state } = self;
        let next = stepped(*robot, integrator, clock.time, state, *step, input)?;
        Ok(self.arrive(next))
    }

    /// The samples after each of the next `count` steps; ends early behind the first error.
    pub fn steps(&mut self, count: usize) -> impl Iterator<Item = Result<Sample<'r, R, T, NQ, NV>, Error>> {
        let mut left = count;
        until_error(move || {
            left = left.checked_sub(1)?;
            Some(self.step())
        })
    }
}

impl<'r, R, T, const NQ: usize, const NV: usize, I, U> Simulation<'r, R, T, NQ, NV, I, U>
where
    R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV>,
    T: Scalar,
    I: Integrator,
{
    /// Goes one step on under the joint forces `tau`, in N·m or N, which stay as they are until its end, and returns where
    /// that leads: the robot under a control loop that runs once in each step.
    ///
    /// The simulation's own input is not asked.
    ///
    /// # Errors
    ///
    /// Those of [`step`](Self::step).
    ///
    /// # Example
    ///
    /// ```
    /// # use dynamics_core::prelude::*;
    /// # fn reach<R>(robot: &R, goal: SVector<f64, 2>) -> Result<(), Error>
    /// # where R: Dynamics<f64, 2, 2> + Configuration<f64, 2, 2> {
    /// let controller = control::ComputedTorque::critically_damped(SVector::repeat(8.0));
    /// let mut simulation = Simulation::new(robot, State::rest(SVector::zeros()), 1e-3)?;
    /// for _ in 0..2000 {
    ///     let tau = controller.torque(robot, simulation.state(), &Reference::rest(goal));
    ///     simulation.step_with(&tau)?;
    /// }
    /// # Ok(()) }
    /// ```
    pub fn step_with(&mut self, tau: &SVector<T, NV>) -> Result<Sample<'r, R, T, NQ, NV>, Error> {
        let Self { robot, integrator, step, clock, state, .. } = self;
        let next = stepped(*robot, integrator, clock.time, state, *step, |_, _| *tau)?;
        Ok(self.arrive(next))
    }

    /// Is in the next state, one step later.
    fn arrive(&mut self, next: State<T, NQ, NV>) -> Sample<'r, R, T, NQ, NV> {
        (self.state, self.clock) = (next, self.clock.after(self.step));
        self.sample()
    }
}

/// The next state if it is finite; else what is wrong, with the state before the step if that has it already.
fn stepped<R, T, I, const NQ: usize, const NV: usize>(
    robot: &R,
    integrator: &I,
    time: T,
    state: &State<T, NQ, NV>,
    step: T,
    mut input: impl FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
) -> Result<State<T, NQ, NV>, Error>
where
    R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV>,
    T: Scalar,
    I: Integrator,
{
    let next =
        integrator.step(robot, time, state, step, &mut input).and_then(|next| next.check().map(|()| next));
    next.map_err(|error| {
        let tau = input(time, state);
        let cause = robot.try_forward_dynamics(&state.q, &state.v, &tau).map(|_| ());
        // An input that ends within the step.
        let cause = cause.and_then(|()| Error::unless_finite("tau", &input(time + step, state)));
        cause.err().unwrap_or(error)
    })
}

impl<R, T: Scalar, I: Clone, U: Clone, const NQ: usize, const NV: usize> Clone
    for Simulation<'_, R, T, NQ, NV, I, U>
{
    fn clone(&self) -> Self {
        Self { integrator: self.integrator.clone(), input: self.input.clone(), ..*self }
    }
}

/// What `next` gives, up to its end or its first error.
fn until_error<S>(
    mut next: impl FnMut() -> Option<Result<S, Error>>,
) -> impl Iterator<Item = Result<S, Error>> {
    let mut failed = false;
    core::iter::from_fn(move || {
        let item = if failed { None } else { next() };
        failed |= matches!(item, Some(Err(_)));
        item
    })
}
