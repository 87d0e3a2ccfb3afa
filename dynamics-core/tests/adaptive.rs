//! The adaptive method: closed forms, orders, tolerances, and everything it refuses.
#![cfg(feature = "std")]

use crate::common::elliptic::{jacobi, quarter_period};
use crate::common::free_box::FreeBox;
use crate::common::{DoublePendulum, G, Pendulum, Spinner};
use dynamics_core::nalgebra::{Vector3, Vector6};
use dynamics_core::prelude::*;

/// A swing from rest at 2 rad, `sin(θ/2) = k·cn(ωt)/dn(ωt)`, and its speed by the energy.
fn pendulum_at(time: f64) -> [f64; 2] {
    let (k, rate) = (1.0_f64.sin(), G.sqrt());
    let [sn, cn, dn] = jacobi(rate * time, k * k);
    let angle = 2.0 * (k * cn / dn).asin();
    // θ̇ by sn' = cn·dn and so on: d(cn/dn) = −(1−k²)·sn/dn².
    let speed = -2.0 * k * (1.0 - k * k) * sn / (dn * dn) * rate / (0.5 * angle).cos();
    [angle, speed]
}

const SWING: Pendulum<f64> = Pendulum { m: 1.0, l: 1.0, damping: 0.0 };

fn swing(tolerance: f64) -> Adaptive<'static, Pendulum<f64>, f64, 1, 1> {
    Adaptive::new(&SWING, State::rest(SVector::from([2.0])), Tolerances::of(tolerance)).expect("valid")
}

#[test]
fn a_pendulum_swings_by_jacobis_functions() {
    for time in [0.3, 1.0, 2.7, 10.0] {
        let state = swing(1e-13).advance_to(time).expect("it swings").state;
        let [angle, speed] = pendulum_at(time);
        // Local errors of 1e-13 in some hundred steps, which a swing sums up.
        assert!((state.q[0] - angle).abs() < 2e-11, "{:e} after {time} s", state.q[0] - angle);
        assert!((state.v[0] - speed).abs() < 1e-10, "{:e} after {time} s", state.v[0] - speed);
    }
    let period = 4.0 * quarter_period(1.0_f64.sin().powi(2)) / G.sqrt();
    let back = swing(1e-13).advance_to(period).expect("it swings").state;
    assert!((back.q[0] - 2.0).abs() < 1e-12 && back.v[0].abs() < 1e-11, "{back:?}");
}

/// Euler's equations of a body without forces, turning about the axis of its middle moment: the tennis racket.
///
/// L. Landau, E. Lifshitz, *Mechanics*, §37, where the square of momentum is above twice the energy times the middle
/// moment.
#[test]
fn a_racket_turns_over_by_jacobis_functions() {
    let [i1, i2, i3] = FreeBox::MOMENTS;
    let start = Vector3::new(0.0, 6.0, 0.06);
    // From where ω₁ is zero: sn = 1, a quarter of a period after Landau's zero.
    let by_moments = |power: i32| -> f64 {
        FreeBox::MOMENTS.iter().zip(&start).map(|(i, omega)| i.powi(power) * omega * omega).sum()
    };
    let (twice_energy, square) = (by_moments(1), by_moments(2));
    let (small, large) = (square - twice_energy * i1, twice_energy * i3 - square);
    let rate = ((i3 - i2) * small / (i1 * i2 * i3)).sqrt();
    let m = (i2 - i1) * large / ((i3 - i2) * small);
    let quarter = quarter_period(m);
    let expected = |time: f64| {
        let [sn, cn, dn] = jacobi(rate * time + quarter, m);
        Vector3::new(
            (large / (i1 * (i3 - i1))).sqrt() * cn,
            (large / (i2 * (i3 - i2))).sqrt() * sn,
            (small / (i3 * (i3 - i1))).sqrt() * dn,
        )
    };
    assert!((expected(0.0) - start).norm() < 1e-12, "{}", expected(0.0));

    let axes = FreeBox::principal_axes();
    let robot = FreeBox::new(Vector3::new(0.1, -0.05, 0.2), Vector3::zeros());
    let mut v = Vector6::new(0.5, 0.3, -1.0, 0.0, 0.0, 0.0);
    v.fixed_rows_mut::<3>(3).copy_from(&(axes * start));
    let state = State::new(SVector::from([0.2, -0.3, 1.0, 0.1, -0.5, 0.7, 0.5]), v);
    let mut flight = Adaptive::new(&robot, state, Tolerances::of(1e-13)).expect("valid");
    let mut turned = 0;
    for sample in flight.every(0.05, 4.0 * quarter / rate) {
        let Sample { time, state, .. } = sample.expect("it flies");
        let found = axes.inverse() * Vector3::from(state.v.fixed_rows::<3>(3));
        // On the way the motion is unstable: what begins as 1e-13 grows by some hundreds.
        assert!((found - expected(time)).norm() < 1e-9, "{:e}", (found - expected(time)).norm());
        assert!((state.q.fixed_rows::<4>(3).norm_squared() - 1.0).abs() <= 4.0 * f64::EPSILON);
        turned += usize::from(found.y < -5.9);
    }
    assert!(turned > 3, "it has turned over");
}

#[test]
fn errors_follow_the_tolerances() {
    let mut last = f64::INFINITY;
    for digits in 4..=12 {
        let tolerance = 10.0_f64.powi(-digits);
        let state = swing(tolerance).advance_to(5.0).expect("it swings").state;
        let error = (state.q[0] - pendulum_at(5.0)[0]).abs();
        assert!(error < 100.0 * tolerance && error < last, "{error:e} at {tolerance:e}");
        last = error;
    }
}

fn forced(time: f64, state: &State<f64, 7, 6>) -> Vector6<f64> {
    state.v * -0.1 + Vector6::from_fn(|i, _| (time * (1.0 + i as f64)).sin())
}

fn tossed() -> State<f64, 7, 6> {
    State::new(
        SVector::from([0.2, -0.3, 1.0, 0.1, -0.5, 0.7, 0.5]),
        SVector::from([1.0, -2.0, 4.0, 2.0, 5.0, -3.0]),
    )
}

/// Tolerances that every step meets, so that all steps are of one size.
const LOOSE: Tolerances<f64> = Tolerances { absolute: 1e9, relative: 0.0 };

/// log₂ of the ratio of the errors at h and h/2 after one second.
fn order_of<R, const NQ: usize, const NV: usize>(
    robot: &R,
    start: State<f64, NQ, NV>,
    input: impl FnMut(f64, &State<f64, NQ, NV>) -> SVector<f64, NV> + Copy,
    steps: f64,
) -> f64
where
    R: Dynamics<f64, NQ, NV> + Configuration<f64, NQ, NV>,
{
    let rk4 = Simulation::new(robot, start, 1.0 / 8192.0).expect("valid").with_input(input);
    let exact = { rk4 }.steps(8192).last().expect("steps").expect("finite").state;
    let error = |steps: f64| {
        let adaptive =
            Adaptive::new(robot, start, LOOSE).and_then(|it| it.with_steps(1.0 / steps, 1.0 / steps));
        let mut adaptive = adaptive.expect("valid").with_input(input);
        let count = adaptive.steps(1.0).inspect(|sample| assert!(sample.is_ok())).count();
        assert_eq!(count as f64, steps);
        let State { q, v } = *adaptive.state();
        robot.difference(&exact.q, &q).norm() + (v - exact.v).norm()
    };
    (error(steps) / error(2.0 * steps)).log2()
}

#[test]
fn it_is_of_order_five_on_a_vector_space_and_on_a_manifold() {
    let start = State::rest(SVector::from([1.2, -0.7]));
    let order = order_of(&DoublePendulum, start, |t, state| -0.3 * state.v * t.cos(), 128.0);
    assert!((order - 5.0).abs() < 0.3, "observed order {order}");
    let order = order_of(&FreeBox::tossed(), tossed(), forced, 64.0);
    assert!((order - 5.0).abs() < 0.3, "observed order {order}");
    let start = State::new(Spinner.neutral(), SVector::from([0.5, 4.0, 0.7]));
    let order = order_of(&Spinner, start, |t, _| SVector::from([t, -t, 1.0]), 32.0);
    assert!((order - 5.0).abs() < 0.3, "observed order {order}");
}

/// Within a step the polynomial is of order 4, so that its error goes with the fifth power, as that of the steps.
#[test]
fn states_between_steps_are_of_the_order_of_the_steps() {
    let (robot, start) = (FreeBox::tossed(), tossed());
    let fine = Adaptive::new(&robot, start, Tolerances::of(1e-14)).expect("valid").with_input(forced);
    let exact = { fine }.record(1.0).expect("finite");
    let error = |steps: f64| {
        let coarse =
            Adaptive::new(&robot, start, LOOSE).and_then(|it| it.with_steps(1.0 / steps, 1.0 / steps));
        let motion = coarse.expect("valid").with_input(forced).record(1.0).expect("finite");
        let off = |time: f64| {
            let [found, exact] = [&motion, &exact].map(|motion| motion.at(time).expect("within"));
            robot.difference(&exact.q, &found.q).norm() + (found.v - exact.v).norm()
        };
        (1..400).map(|k| off(f64::from(k) / 400.0)).fold(0.0, f64::max)
    };
    let order = (error(32.0) / error(64.0)).log2();
    assert!((order - 5.0).abs() < 0.5, "observed order {order}");
}

#[test]
fn samples_do_not_depend_on_where_one_looks() {
    let mut by_steps = swing(1e-9);
    let ends: Vec<f64> = by_steps.steps(3.0).map(|sample| sample.expect("finite").time).collect();
    assert_eq!((by_steps.time(), ends.last()), (3.0, Some(&3.0)));
    let mut by_interval = swing(1e-9);
    let samples: Vec<_> = by_interval.every(0.125, 3.0).map(|sample| sample.expect("finite")).collect();
    assert_eq!(samples.len(), 24);
    assert_eq!(samples[23].time, 3.0);
    assert_eq!(samples[23].state, *by_steps.state());
    for (k, sample) in samples.iter().enumerate() {
        assert_eq!(sample.time, 0.125 * (k as f64 + 1.0));
        assert!((sample.state.q[0] - pendulum_at(sample.time)[0]).abs() < 1e-7);
    }
    // Half of them, and then by steps from the middle of one.
    let mut both = swing(1e-9);
    assert_eq!(both.every(0.125, 3.0).take(10).filter_map(Result::ok).count(), 10);
    assert_eq!(both.time(), 1.25);
    assert_eq!(both.advance_to(1.25).map(|sample| sample.time), Ok(1.25));
    assert!(both.steps(1.5).all(|sample| sample.is_ok_and(|sample| sample.time <= 1.5)));
    assert_eq!(both.time(), 1.5);
    assert!((both.state().q[0] - pendulum_at(1.5)[0]).abs() < 1e-7);
    // An interval that does not divide the time ends before it.
    assert_eq!(swing(1e-6).every(0.7, 3.0).count(), 4);
    assert_eq!(swing(1e-6).every(0.1, 1.0).count(), 10);
}

#[test]
fn the_input_is_not_asked_beyond_the_end() {
    let mut latest = 0.0_f64;
    let mut simulation = swing(1e-6).with_input(|time, _| {
        latest = latest.max(time);
        SVector::zeros()
    });
    for time in [0.001, 0.5, 0.500_000_1, 3.0] {
        assert!(simulation.advance_to(time).is_ok());
    }
    assert_eq!(latest, 3.0);
}

#[test]
fn a_change_of_state_begins_anew() {
    let mut simulation = swing(1e-10);
    assert!(simulation.advance_to(0.4).is_ok() && simulation.segment().is_some());
    let rest = State::rest(SVector::from([2.0]));
    assert_eq!(simulation.set_state(rest), Ok(()));
    assert!(simulation.segment().is_none());
    let state = simulation.advance_to(1.4).expect("it swings").state;
    assert!((state.q[0] - pendulum_at(1.0)[0]).abs() < 1e-8);
    let broken = State::rest(SVector::from([f64::NAN]));
    assert_eq!(simulation.set_state(broken), Err(Error::NotFinite { vector: "q", index: 0 }));
    assert_eq!(*simulation.state(), state);
}

#[test]
fn it_runs_in_single_precision() {
    let robot = Pendulum { m: 1.0_f32, l: 1.0, damping: 0.5 };
    let start = State::rest(SVector::from([0.5_f32]));
    let mut simulation = Adaptive::new(&robot, start, Tolerances::of(1e-5)).expect("valid");
    assert!(simulation.advance_to(20.0).is_ok());
    assert!(simulation.state().q.norm() < 0.01, "damping brings it to rest");
}

#[test]
fn equal_motions_need_few_steps() {
    let rest = FreeBox::drifting();
    let mut still = Adaptive::new(&rest, State::rest(tossed().q), Tolerances::of(1e-12)).expect("valid");
    assert!(still.steps(1e3).count() < 30);
    assert_eq!(still.state().v, Vector6::zeros());
    // A turn about a principal axis, of more than a revolution in a step.
    let start = State::new(Spinner.neutral(), SVector::from([0.0, 0.0, 5.0]));
    let mut top = Adaptive::new(&Spinner, start, Tolerances::of(1e-9)).expect("valid");
    let end = top.advance_to(100.0).expect("it turns").state;
    let (sine, cosine) = 250.0_f64.sin_cos();
    let expected = SVector::from([0.0, 0.0, sine, cosine]);
    assert!((end.q - expected).norm().min((end.q + expected).norm()) < 1e-7, "{end:?}");
}

// What it refuses.

#[test]
fn tolerances_times_and_steps_are_checked() {
    let start = State::rest(SVector::from([2.0]));
    let tolerances = [(0.0, 0.0), (-1e-9, 1e-3), (1e-9, f64::NAN), (f64::INFINITY, 1e-3)];
    for (absolute, relative) in tolerances {
        let refused = Adaptive::new(&SWING, start, Tolerances { absolute, relative }).err();
        assert_eq!(refused, Some(Error::ToleranceNotPositive), "{absolute}, {relative}");
    }
    for time in [-1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(swing(1e-6).advance_to(time).err(), Some(Error::TimeNotAhead), "{time}");
        let mut steps = swing(1e-6);
        let all: Vec<_> = steps.steps(time).map(|sample| sample.err()).collect();
        assert_eq!(all, [Some(Error::TimeNotAhead)], "{time}");
    }
    for interval in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        let mut every = swing(1e-6);
        let all: Vec<_> = every.every(interval, 1.0).map(|sample| sample.err()).collect();
        assert_eq!(all, [Some(Error::StepNotPositive)], "{interval}");
    }
    for (least, greatest) in [(0.0, 1.0), (0.2, 0.1), (-0.1, 1.0), (f64::NAN, 1.0), (0.1, f64::INFINITY)] {
        assert_eq!(swing(1e-6).with_steps(least, greatest).err(), Some(Error::StepNotPositive));
    }
}

#[test]
fn what_is_not_finite_is_an_error_with_its_name() {
    let broken = State::rest(SVector::from([f64::NAN]));
    let error = Error::NotFinite { vector: "q", index: 0 };
    assert_eq!(Adaptive::new(&SWING, broken, Tolerances::of(1e-6)).err(), Some(error));
    let mut at_once = swing(1e-6).with_input(|_, _| SVector::from([f64::NAN]));
    assert_eq!(at_once.advance_to(1.0).err(), Some(Error::NotFinite { vector: "tau", index: 0 }));
    let mut later = swing(1e-6).with_input(|t, _| SVector::from([if t > 0.5 { f64::NAN } else { 0.0 }]));
    assert_eq!(later.advance_to(1.0).err(), Some(Error::NotFinite { vector: "a", index: 0 }));
    assert!((later.time() - 0.5).abs() < 1e-12, "up to where it is: {}", later.time());
    let long = State { q: tossed().q * 1.001, ..tossed() };
    let refused = Adaptive::new(&FreeBox::tossed(), long, Tolerances::of(1e-6)).err();
    assert_eq!(refused, Some(Error::NotUnitQuaternion { index: 3 }));
}

#[test]
fn a_mass_matrix_that_is_singular_is_an_error() {
    let massless = Pendulum { m: 0.0, l: 1.0, damping: 0.0 };
    let start = State::rest(SVector::from([0.5]));
    let push = |_: f64, _: &State<f64, 1, 1>| SVector::from([1.0]);
    let mut adaptive = Adaptive::new(&massless, start, Tolerances::of(1e-6)).expect("valid").with_input(push);
    assert_eq!(adaptive.advance_to(1.0).err(), Some(Error::SingularMassMatrix));
    let mut fixed = Simulation::new(&massless, start, 1e-3).expect("valid").with_input(push);
    assert_eq!(fixed.step().err(), Some(Error::SingularMassMatrix));
    let mut euler = fixed.clone().with_integrator(SemiImplicitEuler);
    assert_eq!(euler.step().err(), Some(Error::SingularMassMatrix));
    let mut variational = fixed.with_integrator(Variational);
    assert_eq!(variational.step().err(), Some(Error::SingularMassMatrix));
}

/// `v̇ = v²` reaches infinity in one second.
#[test]
fn where_a_motion_ends_the_steps_end() {
    let start = State::new(SVector::from([0.0]), SVector::from([1.0]));
    let blow_up = |_: f64, state: &State<f64, 1, 1>| {
        let v = state.v[0];
        SVector::from([v * v]) + SWING.gravity_forces(&state.q)
    };
    let mut simulation =
        Adaptive::new(&SWING, start, Tolerances::of(1e-9)).expect("valid").with_input(blow_up);
    let Err(Error::StepTooSmall { time }) = simulation.advance_to(2.0) else { panic!("it goes on") };
    assert!((time - 1.0).abs() < 1e-6 && time == simulation.time(), "{time}");
}

/// A force that jumps with every ask has no smooth motion.
#[test]
fn a_restless_force_uses_up_the_steps() {
    let mut sign = 1.0;
    let mut restless = swing(1e-9).with_most_steps(50).with_input(|_, _| {
        sign = -sign;
        SVector::from([1e3 * sign])
    });
    let Err(error) = restless.advance_to(10.0) else { panic!("it goes on") };
    assert!(matches!(error, Error::TooManySteps { .. } | Error::StepTooSmall { .. }), "{error:?}");
    let refused = swing(1e-12).with_most_steps(3).advance_to(10.0).err();
    assert!(matches!(refused, Some(Error::TooManySteps { time }) if time < 1.0), "{refused:?}");
}

#[test]
fn more_digits_than_there_are_is_an_error_or_is_done() {
    for tolerance in [1e-16, 1e-18, 1e-30, 1e-300] {
        match swing(tolerance).with_most_steps(20_000).advance_to(1.0) {
            Ok(sample) => assert!((sample.state.q[0] - pendulum_at(1.0)[0]).abs() < 1e-11),
            Err(error) => {
                let known = matches!(error, Error::StepTooSmall { .. } | Error::TooManySteps { .. });
                assert!(known, "{error:?} at {tolerance:e}");
            }
        }
    }
}
