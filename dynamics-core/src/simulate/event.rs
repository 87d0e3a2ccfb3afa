//! Events: moments at which something passes through zero.

use core::marker::PhantomData;

use nalgebra::SVector;

use super::Sample;
use crate::kinematics::Frame;
use crate::mechanism::Mechanism;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// A function of time and state; it happens where that passes through zero.
///
/// A function that begins on zero has not passed it, unless it is [a barrier](Self::is_barrier).
/// [`Adaptive::advance_until`](super::Adaptive::advance_until) finds the moment.
pub trait Event<R, T: Scalar, const NQ: usize, const NV: usize> {
    /// The function; infinite where there is nothing to happen.
    fn value(&self, robot: &R, time: T, state: &State<T, NQ, NV>) -> T;

    /// Which way it must pass; both ways as provided.
    fn direction(&self) -> Direction {
        Direction::Both
    }

    /// Whether it is also an event, at once, that a given state is on zero or beyond it and goes on from there.
    ///
    /// So of what a motion must not get through: of a state at rest on it that something pushes, and of one thrown back
    /// so slowly that rounding does not see it leave. No as provided.
    fn is_barrier(&self) -> bool {
        false
    }
}

impl<R, T, V, const NQ: usize, const NV: usize> Event<R, T, NQ, NV> for &V
where
    T: Scalar,
    V: Event<R, T, NQ, NV> + ?Sized,
{
    fn value(&self, robot: &R, time: T, state: &State<T, NQ, NV>) -> T {
        (**self).value(robot, time, state)
    }
    fn direction(&self) -> Direction {
        (**self).direction()
    }
    fn is_barrier(&self) -> bool {
        (**self).is_barrier()
    }
}

/// An event that is [a barrier](Event::is_barrier): a floor that nothing falls through, say.
///
/// ```
/// # use dynamics_core::prelude::*;
/// # use dynamics_core::simulate::{Barrier, PlaneCrossing};
/// # fn floor<F>() {
/// let floor = Barrier(PlaneCrossing::<F, f64>::down_to(0.0));
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Barrier<V>(pub V);

impl<R, T, V, const NQ: usize, const NV: usize> Event<R, T, NQ, NV> for Barrier<V>
where
    T: Scalar,
    V: Event<R, T, NQ, NV>,
{
    fn value(&self, robot: &R, time: T, state: &State<T, NQ, NV>) -> T {
        self.0.value(robot, time, state)
    }
    fn direction(&self) -> Direction {
        self.0.direction()
    }
    fn is_barrier(&self) -> bool {
        true
    }
}

/// Which way an event's function must pass through zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From below.
    Rising,
    /// From above.
    Falling,
    /// Either.
    Both,
}

impl Direction {
    /// Whether it has passed between two values.
    pub(super) fn is_passed<T: Scalar + PartialOrd>(self, from: T, to: T) -> bool {
        let zero = T::zero();
        let rises = from < zero && to >= zero;
        let falls = from > zero && to <= zero;
        match self {
            Self::Rising => rises,
            Self::Falling => falls,
            Self::Both => rises || falls,
        }
    }

    /// Whether it goes on from zero or from beyond, between two values.
    pub(super) fn goes_on<T: Scalar + PartialOrd>(self, from: T, to: T) -> bool {
        let zero = T::zero();
        let up = from >= zero && to > from;
        let down = from <= zero && to < from;
        match self {
            Self::Rising => up,
            Self::Falling => down,
            Self::Both => up || down,
        }
    }
}

/// The event of a closure of time and state.
#[derive(Clone, Copy, Debug)]
pub struct When<F> {
    value: F,
    direction: Direction,
}

/// An event where `value(time, state)` passes through zero, one way, the other, or both.
///
/// # Example
///
/// ```
/// # use dynamics_core::prelude::*;
/// # use dynamics_core::simulate::{Barrier, Direction, when};
/// # fn bounce<R: Dynamics<f64, 1, 1> + Configuration<f64, 1, 1>>(ball: &R) -> Result<(), Error> {
/// let floor = Barrier(when(Direction::Falling, |_time, ball: &State<f64, 1, 1>| ball.q[0]));
/// let mut flight = Adaptive::new(ball, State::rest(SVector::from([1.0])), Tolerances::of(1e-9))?;
/// while flight.advance_until(10.0, &[&floor])?.is_event() {
///     let State { q, v } = *flight.state();
///     if v[0].abs() < 1e-3 {
///         break; // it lies
///     }
///     flight.set_state(State::new(q, -0.8 * v))?;
/// }
/// # Ok(()) }
/// ```
pub fn when<T, F, const NQ: usize, const NV: usize>(direction: Direction, value: F) -> When<F>
where
    F: Fn(T, &State<T, NQ, NV>) -> T,
{
    When { value, direction }
}

impl<R, T, F, const NQ: usize, const NV: usize> Event<R, T, NQ, NV> for When<F>
where
    T: Scalar,
    F: Fn(T, &State<T, NQ, NV>) -> T,
{
    fn value(&self, _robot: &R, time: T, state: &State<T, NQ, NV>) -> T {
        (self.value)(time, state)
    }
    fn direction(&self) -> Direction {
        self.direction
    }
}

/// A joint comes to a limit of its coordinate, from inside; or is given a state at the limit, and goes on outwards.
///
/// It is [a barrier](Event::is_barrier): no bounce is so low that the joint gets through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointLimit {
    speed: usize,
}

impl JointLimit {
    /// The limits of the joint with the speed `v[speed]`; one that has none has no event.
    #[must_use]
    pub const fn of(speed: usize) -> Self {
        Self { speed }
    }

    /// Those of all joints, in the order of `v`.
    #[must_use]
    pub fn all<const NV: usize>() -> [Self; NV] {
        core::array::from_fn(Self::of)
    }
}

impl<R, T, const NQ: usize, const NV: usize> Event<R, T, NQ, NV> for JointLimit
where
    R: Mechanism + Configuration<T, NQ, NV>,
    T: Scalar + PartialOrd,
{
    /// How far it is to the nearer limit, in rad or m.
    fn value(&self, robot: &R, _time: T, state: &State<T, NQ, NV>) -> T {
        // What a joint of one degree of freedom is away from zero, and of others is not asked for.
        let way = robot.difference(&robot.neutral(), &state.q);
        match (R::LIMITS.get(self.speed), way.get(self.speed)) {
            (Some(limits), Some(q)) => {
                let (below, above) = (*q - T::of(limits.lower), T::of(limits.upper) - *q);
                if below < above { below } else { above }
            }
            _ => T::one(),
        }
    }
    fn direction(&self) -> Direction {
        Direction::Falling
    }
    fn is_barrier(&self) -> bool {
        true
    }
}

/// A coordinate comes to a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoordinateAt<T> {
    /// Its index in `q`.
    pub index: usize,
    /// The value, in rad or m.
    pub value: T,
}

impl<R, T: Scalar, const NQ: usize, const NV: usize> Event<R, T, NQ, NV> for CoordinateAt<T> {
    fn value(&self, _robot: &R, _time: T, state: &State<T, NQ, NV>) -> T {
        state.q.get(self.index).map_or(T::one(), |q| *q - self.value)
    }
}

/// A joint turns back: its speed passes through zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TurningPoint {
    /// The index of its speed in `v`.
    pub index: usize,
}

impl<R, T: Scalar, const NQ: usize, const NV: usize> Event<R, T, NQ, NV> for TurningPoint {
    fn value(&self, _robot: &R, _time: T, state: &State<T, NQ, NV>) -> T {
        state.v.get(self.index).map_or(T::one(), |v| *v)
    }
}

/// The origin of a frame passes through a plane.
#[derive(Debug)]
pub struct PlaneCrossing<F, T> {
    normal: SVector<T, 3>,
    distance: T,
    direction: Direction,
    frame: PhantomData<F>,
}

impl<F, T: Scalar> PlaneCrossing<F, T> {
    /// The plane of all points with `normal·p = distance`, in world axes and m; rising is along the normal.
    #[must_use]
    pub const fn new(normal: SVector<T, 3>, distance: T, direction: Direction) -> Self {
        Self { normal, distance, direction, frame: PhantomData }
    }

    /// The frame comes down to the height `z`, in m.
    #[must_use]
    pub fn down_to(z: T) -> Self {
        Self::new(SVector::from([T::zero(), T::zero(), T::one()]), z, Direction::Falling)
    }
}

impl<R, T, F, const NQ: usize, const NV: usize> Event<R, T, NQ, NV> for PlaneCrossing<F, T>
where
    T: Scalar,
    F: Frame<R, T, NQ, NV>,
{
    /// How far the frame is above the plane, in lengths of the normal.
    fn value(&self, robot: &R, _time: T, state: &State<T, NQ, NV>) -> T {
        crate::product::dot(&self.normal, &F::pose(robot, &state.q).translation) - self.distance
    }
    fn direction(&self) -> Direction {
        self.direction
    }
}

/// Where a motion stopped: at events, or at its end.
pub struct Arrival<'r, R, T, const NQ: usize, const NV: usize, const E: usize> {
    /// The time and the state.
    pub sample: Sample<'r, R, T, NQ, NV>,
    /// Which of the events happened there; none at the end.
    pub events: [bool; E],
}

impl<R, T, const NQ: usize, const NV: usize, const E: usize> Arrival<'_, R, T, NQ, NV, E> {
    /// Whether an event stopped it.
    #[must_use]
    pub fn is_event(&self) -> bool {
        self.events.contains(&true)
    }
}
