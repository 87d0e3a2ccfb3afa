//! Events: when they happen by closed forms, in which order, and each once.
#![cfg(feature = "std")]

use crate::common::elliptic::quarter_period;
use crate::common::{Bob, DoublePendulum, G, Pendulum};
use dynamics_core::__private::{columns, vector};
use dynamics_core::prelude::*;
use dynamics_core::simulate::{
    Barrier, CoordinateAt, Direction, Event, JointLimit, PlaneCrossing, TurningPoint, when,
};

const SWING: Pendulum<f64> = Pendulum { m: 1.0, l: 1.0, damping: 0.0 };

fn swing() -> Adaptive<'static, Pendulum<f64>, f64, 1, 1> {
    Adaptive::new(&SWING, State::rest(SVector::from([2.0])), Tolerances::of(1e-13)).expect("valid")
}

/// A quarter of a swing from 2 rad, s.
fn quarter() -> f64 {
    quarter_period(1.0_f64.sin().powi(2)) / G.sqrt()
}

/// The error of a swing of some seconds at these tolerances.
const TIMING: f64 = 1e-10;

#[test]
fn a_pendulum_turns_and_passes_at_quarters_of_its_period() {
    let events: [&dyn Event<_, _, 1, 1>; 2] =
        [&CoordinateAt { index: 0, value: 0.0 }, &TurningPoint { index: 0 }];
    let mut swing = swing();
    for k in 1..=12 {
        let arrival = swing.advance_until(100.0, &events).expect("it swings");
        assert_eq!(arrival.events, [k % 2 == 1, k % 2 == 0], "the {k}th");
        let error = arrival.sample.time - f64::from(k) * quarter();
        assert!(error.abs() < TIMING, "{error:e} in the time of the {k}th");
    }
    let arrival = swing.advance_until(12.5 * quarter(), &events).expect("it swings");
    assert!(!arrival.is_event());
    assert_eq!((arrival.sample.time, swing.time()), (12.5 * quarter(), 12.5 * quarter()));
}

#[test]
fn an_event_has_a_direction() {
    let count = |direction| {
        let (lowest, mut swing) = (when(direction, |_, x: &State<f64, 1, 1>| x.q[0]), swing());
        let mut count = 0;
        while swing.advance_until(20.0 * quarter(), &[lowest]).expect("it swings").is_event() {
            count += 1;
        }
        count
    };
    let found = [Direction::Falling, Direction::Rising, Direction::Both].map(count);
    assert_eq!(found, [5, 5, 10]);
}

#[test]
fn what_happens_together_is_found_together() {
    let low = CoordinateAt { index: 0, value: 0.0 };
    let fast = when(Direction::Both, |_, x: &State<f64, 1, 1>| 3.0 * x.q[0]);
    let later = when(Direction::Falling, |_, x: &State<f64, 1, 1>| x.q[0] + 1e-9);
    let events: [&dyn Event<_, _, 1, 1>; 3] = [&low, &fast, &later];
    let mut swing = swing();
    let first = swing.advance_until(1.0, &events).expect("it swings");
    assert_eq!(first.events, [true, true, false]);
    let second = swing.advance_until(1.0, &events).expect("it swings");
    assert_eq!(second.events, [false, false, true]);
    let apart = second.sample.time - first.sample.time;
    // 1e-9 rad at the speed there.
    assert!((apart * first.sample.state.v[0].abs() - 1e-9).abs() < 1e-13, "{apart:e}");
}

#[test]
fn a_frame_passes_through_a_plane() {
    // Height −0.5 is 60° from hanging.
    let down = PlaneCrossing::<Bob, f64>::down_to(-0.5);
    let mut swing = swing();
    let arrival = swing.advance_until(1.0, &[&down]).expect("it swings");
    assert!(arrival.is_event());
    let state = arrival.sample.state;
    assert!((state.q[0] - 60.0_f64.to_radians()).abs() < 1e-13, "{state:?}");
    let tilted = PlaneCrossing::<Bob, f64>::new(SVector::from([0.0, 1.0, 0.0]), 0.0, Direction::Falling);
    let arrival = swing.advance_until(1.0, &[&tilted]).expect("it swings");
    assert!((arrival.sample.time - quarter()).abs() < TIMING);
}

/// A mass that falls along z, between two stops.
struct Ball;

impl Mechanism for Ball {
    const NQ: usize = 1;
    const NV: usize = 1;
    const NU: usize = 1;
    const NAME: &'static str = "Ball";
    const JOINT_NAMES: &'static [&'static str] = &["fall"];
    const BODY_NAMES: &'static [&'static str] = &["ball"];
    const LIMITS: &'static [JointLimits] = &[JointLimits { lower: 0.0, upper: 3.0, ..JointLimits::NONE }];
    const COST: Costs = Costs::ZERO;
}

type V1 = SVector<f64, 1>;

impl Dynamics<f64, 1, 1> for Ball {
    fn mass_matrix(&self, _q: &V1) -> SMatrix<f64, 1, 1> {
        columns([[2.0]])
    }
    fn coriolis_matrix(&self, _q: &V1, _v: &V1) -> SMatrix<f64, 1, 1> {
        columns([[0.0]])
    }
    fn gravity_forces(&self, _q: &V1) -> V1 {
        vector([2.0 * G])
    }
    fn bias_forces(&self, q: &V1, _v: &V1) -> V1 {
        self.gravity_forces(q)
    }
    fn inverse_dynamics(&self, q: &V1, _v: &V1, a: &V1) -> V1 {
        a * 2.0 + self.gravity_forces(q)
    }
    fn forward_dynamics(&self, q: &V1, _v: &V1, tau: &V1) -> V1 {
        (tau - self.gravity_forces(q)) / 2.0
    }
    fn kinetic_energy(&self, _q: &V1, v: &V1) -> f64 {
        v[0] * v[0]
    }
    fn potential_energy(&self, q: &V1) -> f64 {
        2.0 * G * q[0]
    }
    fn lagrangian(&self, q: &V1, v: &V1) -> f64 {
        self.kinetic_energy(q, v) - self.potential_energy(q)
    }
}

impl Configuration<f64, 1, 1> for Ball {
    fn integrate(&self, q: &V1, delta: &V1) -> V1 {
        q + delta
    }
}

/// Each bounce takes the part e of the speed: the k-th is at `√(2h/g)·(1 + 2(e + … + e^(k−1)))`.
#[test]
fn a_ball_bounces_in_the_times_of_a_geometric_series() {
    const E: f64 = 0.8;
    let mut flight =
        Adaptive::new(&Ball, State::rest(SVector::from([1.0])), Tolerances::of(1e-12)).expect("valid");
    let first = (2.0 / G).sqrt();
    let (mut expected, mut speed) = (first, (2.0 * G).sqrt());
    for k in 0..25 {
        let arrival = flight.advance_until(10.0, &JointLimit::all::<1>()).expect("it falls");
        assert_eq!(arrival.events, [true]);
        let Sample { time, state, .. } = arrival.sample;
        assert!((time - expected).abs() < 1e-11, "{:e} at bounce {k}", time - expected);
        assert!(state.q[0].abs() < 1e-12 && (state.v[0] + speed).abs() < 1e-10, "{state:?}");
        (expected, speed) = (expected + 2.0 * E * speed / G, E * speed);
        flight.set_state(State::new(state.q, -E * state.v)).expect("finite");
    }
}

#[test]
fn both_limits_are_watched_and_others_never_happen() {
    let up = State::new(SVector::from([1.0]), SVector::from([8.0]));
    let mut flight = Adaptive::new(&Ball, up, Tolerances::of(1e-12)).expect("valid");
    let events = [JointLimit::of(0), JointLimit::of(7)];
    let arrival = flight.advance_until(10.0, &events).expect("it flies");
    assert_eq!(arrival.events, [true, false]);
    assert!((arrival.sample.state.q[0] - 3.0).abs() < 1e-12);
    // Beyond the limit it comes back inside, which is no event, and then down to the other one.
    let arrival = flight.advance_until(10.0, &events).expect("it flies");
    assert!(arrival.sample.state.q[0].abs() < 1e-12, "{:?}", arrival.sample);
    let free = JointLimit::all::<1>();
    assert!(!swing().advance_until(5.0, &free).expect("it swings").is_event());
}

/// Of bounces that halve the speed there are more than time can tell apart: they end at `√(2h/g)·(1 + 2(½ + ¼ + …))`.
#[test]
fn no_bounce_is_so_low_that_a_joint_gets_through_its_limit() {
    let mut flight =
        Adaptive::new(&Ball, State::rest(SVector::from([1.0])), Tolerances::of(1e-12)).expect("valid");
    let end = 3.0 * (2.0 / G).sqrt();
    let mut bounces = 0;
    let error = loop {
        match flight.advance_until(10.0, &JointLimit::all::<1>()) {
            Ok(arrival) => assert!(arrival.is_event(), "it fell through to {}", arrival.sample.state.q),
            Err(error) => break error,
        }
        bounces += 1;
        // Behind the zero by what the time's last bit is at the speed.
        assert!(flight.state().q[0] > -1e-15, "{:e} at bounce {bounces}", flight.state().q[0]);
        flight.set_state(State::new(flight.state().q, -0.5 * flight.state().v)).expect("finite");
    };
    let Error::StepTooSmall { time } = error else { panic!("{error}") };
    // Those that rounding sees, and 64.
    assert!(bounces > 64 + 15 && bounces < 64 + 60, "{bounces}");
    assert!((time - end).abs() < 1e-6 && flight.time() == time, "{:e}", time - end);
    // Held, it goes on.
    let mut held = flight.with_input(|_, _| SVector::from([2.0 * G]));
    held.set_state(State::rest(held.state().q)).expect("finite");
    let arrival = held.advance_until(10.0, &JointLimit::all::<1>()).expect("it lies");
    assert!(!arrival.is_event() && arrival.sample.state.v[0].abs() < 1e-12, "{:?}", arrival.sample);
}

#[test]
fn a_state_given_at_a_limit_is_an_event_if_it_goes_on_outwards() {
    let limits = JointLimit::all::<1>();
    let from = |q: f64, v: f64| {
        let start = State::new(SVector::from([q]), SVector::from([v]));
        let mut flight = Adaptive::new(&Ball, start, Tolerances::of(1e-12)).expect("valid");
        let first = flight.advance_until(10.0, &limits).expect("it falls");
        assert!(first.is_event());
        (first.sample.time, flight)
    };
    for (q, v) in [(0.0, 0.0), (0.0, -1.0), (-0.1, -1.0), (-0.1, 0.0), (3.0, 8.0), (3.1, 8.0)] {
        let (time, mut flight) = from(q, v);
        assert_eq!((time, flight.state().q[0], flight.state().v[0]), (0.0, q, v));
        // Whoever knows, and goes on, is not told again: down for ever, or up and back to the lower one.
        let next = flight.advance_until(2.5, &limits).expect("it flies");
        assert_eq!(next.is_event(), q >= 3.0, "{:?}", next.sample);
    }
    // Inwards, or at rest where its weight pulls it inwards, it flies as long as Galilei says.
    for (q, v) in [(0.0_f64, 2.0_f64), (3.0, -1.0), (3.0, 0.0), (3.1, -1.0), (-0.1, 2.0)] {
        let (time, _) = from(q, v);
        let flight = (v + (v * v + 2.0 * G * q).sqrt()) / G;
        assert!((time - flight).abs() < 1e-11, "{time} s and {flight} s from {q} m");
    }
}

#[test]
fn other_events_do_not_begin_on_zero_unless_they_are_barriers() {
    let floor = when(Direction::Falling, |_, x: &State<f64, 1, 1>| x.q[0]);
    let down = || {
        let start = State::new(SVector::from([0.0]), SVector::from([-1.0]));
        Adaptive::new(&Ball, start, Tolerances::of(1e-12)).expect("valid")
    };
    assert!(!down().advance_until(1.0, &[floor]).expect("it falls").is_event());
    let arrival =
        down().advance_until(1.0, &[Barrier(floor)]).map(|arrival| (arrival.sample.time, arrival.events));
    assert_eq!(arrival, Ok((0.0, [true])));
    let both = Barrier(CoordinateAt { index: 0, value: 0.0 });
    assert!(down().advance_until(1.0, &[&both]).expect("it falls").is_event());
    // One way only, which is the other one.
    let rising = Barrier(when(Direction::Rising, |_, x: &State<f64, 1, 1>| x.q[0]));
    assert!(!down().advance_until(1.0, &[rising]).expect("it falls").is_event());
}

/// A limit is the same whichever coordinates there are: the second joint of two.
#[test]
fn a_coordinate_of_a_longer_robot_comes_to_its_value() {
    let start = State::rest(SVector::from([1.2, -0.7]));
    let mut fall =
        Adaptive::<_, f64, 2, 2>::new(&DoublePendulum, start, Tolerances::of(1e-11)).expect("valid");
    let event = CoordinateAt { index: 1, value: 0.1 };
    let arrival = fall.advance_until(5.0, &[event]).expect("it falls");
    assert!(arrival.is_event());
    assert!((arrival.sample.state.q[1] - 0.1).abs() < 1e-14);
    let never = CoordinateAt { index: 9, value: 0.1 };
    assert!(!fall.advance_until(5.0, &[never]).expect("it falls").is_event());
}

#[test]
fn a_function_that_is_no_number_is_an_error() {
    let root = when(Direction::Both, |t: f64, _: &State<f64, 1, 1>| (0.5 - t).sqrt() - 2.0);
    let error = swing().advance_until(1.0, &[root]).err();
    assert_eq!(error, Some(Error::NotFinite { vector: "event", index: 0 }));
    let infinite =
        when(Direction::Both, |t: f64, _: &State<f64, 1, 1>| if t < 0.25 { f64::NEG_INFINITY } else { 1.0 });
    let arrival = swing().advance_until(1.0, &[infinite]).expect("it swings");
    assert!(arrival.is_event() && (arrival.sample.time - 0.25).abs() < 1e-15, "{:?}", arrival.sample.time);
}

/// Steep, flat and broken functions: the time is exact to rounding, in any of them.
#[test]
fn a_zero_is_found_whatever_the_function_looks_like() {
    let shapes: [fn(f64) -> f64; 5] = [
        |x| x * x * x,
        |x| x.cbrt(),
        |x| x.signum(),
        |x| (1e6 * x).tanh() + 1e-3,
        |x| (20.0 * x).exp() - 1.0,
    ];
    for (k, shape) in shapes.into_iter().enumerate() {
        let event = when(Direction::Rising, move |t: f64, _: &State<f64, 1, 1>| shape(t - 0.37));
        let arrival = swing().advance_until(1.0, &[event]).expect("it swings");
        let offset = if k == 3 { -1e-3_f64.atanh() * 1e-6 } else { 0.0 };
        let error = arrival.sample.time - 0.37 - offset;
        // The cube's value underflows its rounding near the zero; the time of others is that of a double or two.
        assert!(arrival.is_event() && error.abs() < 1e-15, "{error:e} of shape {k}");
    }
}
