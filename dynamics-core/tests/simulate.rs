//! Order, energy and errors of the integrators.
#![cfg(feature = "std")]

use crate::common::{DoublePendulum, Pendulum, Spinner};
use dynamics_core::prelude::*;

const Q0: [f64; 2] = [1.2, -0.7];

fn final_state<I: Integrator>(integrator: I, steps: usize) -> State<f64, 2, 2> {
    let start = State::rest(SVector::from(Q0));
    let mut simulation = Simulation::new(&DoublePendulum, start, 1.0 / steps as f64)
        .expect("the step is positive")
        .with_integrator(integrator);
    let last = simulation.steps(steps).last().expect("there is a step").expect("the motion is finite");
    assert!((last.time - 1.0).abs() < 1e-12);
    last.state
}

/// log₂ of the ratio of the errors at h and h/2, against a solution far finer.
fn observed_order<I: Integrator + Copy>(integrator: I, steps: usize) -> f64 {
    let exact = final_state(Rk4, 20_000);
    let error = |steps| {
        let State { q, v } = final_state(integrator, steps);
        (q - exact.q).norm() + (v - exact.v).norm()
    };
    (error(steps) / error(2 * steps)).log2()
}

#[test]
fn runge_kutta_is_of_order_four() {
    let order = observed_order(Rk4, 100);
    assert!((order - 4.0).abs() < 0.2, "observed order {order}");
}

#[test]
fn semi_implicit_euler_is_of_order_one() {
    let order = observed_order(SemiImplicitEuler, 2_000);
    assert!((order - 1.0).abs() < 0.2, "observed order {order}");
}

#[test]
fn the_variational_method_is_of_order_two() {
    let order = observed_order(Variational, 200);
    assert!((order - 2.0).abs() < 0.1, "observed order {order}");
}

#[test]
fn runge_kutta_keeps_its_order_on_quaternions() {
    let run = |steps: usize| {
        let start = State::new(SVector::from([0.0, 0.0, 0.0, 1.0]), SVector::from([0.5, 4.0, 0.7]));
        let mut simulation =
            Simulation::new(&Spinner, start, 1.0 / steps as f64).expect("the step is positive");
        let last = simulation.steps(steps).last().expect("there is a step").expect("the motion is finite");
        assert!((last.state.q.norm() - 1.0).abs() < 1e-12);
        last.state.q
    };
    let exact = run(10_000);
    let order = ((run(50) - exact).norm() / (run(100) - exact).norm()).log2();
    assert!((order - 4.0).abs() < 0.2, "observed order {order}");
}

#[test]
fn runge_kutta_hardly_loses_energy() {
    let mut simulation =
        Simulation::new(&DoublePendulum, State::rest(SVector::from(Q0)), 1e-3).expect("valid");
    let start = simulation.sample().energy().total();
    for sample in simulation.steps(10_000) {
        let energy = sample.expect("finite").energy();
        assert!((energy.total() - start).abs() < 1e-7, "{energy:?}");
    }
}

#[test]
fn energy_of_semi_implicit_euler_stays_bounded() {
    let robot = Pendulum { m: 1.0_f64, l: 1.0, damping: 0.0 };
    let drift = |steps: usize| -> f64 {
        let mut simulation = Simulation::new(&robot, State::rest(SVector::from([1.0])), 1e-2)
            .expect("valid")
            .with_integrator(SemiImplicitEuler);
        let start = simulation.sample().energy().total();
        simulation
            .steps(steps)
            .map(|s| (s.expect("finite").energy().total() - start).abs())
            .fold(0.0, f64::max)
    };
    let (short, long) = (drift(1_000), drift(200_000));
    assert!(long < 1.05 * short && short < 0.2, "{short} after 10 s, {long} after 2000 s");
}

#[test]
fn an_input_holds_the_robot_against_gravity() {
    let start = State::rest(SVector::from(Q0));
    let mut simulation = Simulation::new(&DoublePendulum, start, 1e-2)
        .expect("valid")
        .with_input(|_time, state| DoublePendulum.gravity_forces(&state.q));
    for sample in simulation.steps(100) {
        assert!((sample.expect("finite").state.q - start.q).norm() < 1e-12);
    }
}

#[test]
fn it_runs_in_single_precision() -> Result<(), Error> {
    let robot = Pendulum { m: 1.0_f32, l: 1.0, damping: 0.5 };
    let mut simulation = Simulation::new(&robot, State::rest(SVector::from([0.5_f32])), 1e-3)?;
    let mut time = 0.0_f32;
    for sample in simulation.steps(20_000) {
        time = sample?.time;
    }
    assert!((time - 20.0).abs() < 1e-5, "time is summed with compensation: {time}");
    assert!(simulation.state().q.norm() < 0.01, "damping brings it to rest");
    Ok(())
}

#[test]
fn a_step_must_be_positive() {
    let start = State::rest(SVector::from(Q0));
    for step in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        assert_eq!(Simulation::new(&DoublePendulum, start, step).err(), Some(Error::StepNotPositive));
    }
}

#[test]
fn what_is_not_finite_ends_the_iteration() {
    let broken = State::rest(SVector::from([0.0, f64::INFINITY]));
    let error = Error::NotFinite { vector: "q", index: 1 };
    assert_eq!(Simulation::new(&DoublePendulum, broken, 1e-3).err(), Some(error));

    let mut simulation = Simulation::new(&DoublePendulum, State::rest(SVector::from(Q0)), 1e-2)
        .expect("valid")
        .with_input(|time, _| SVector::from([0.0, if time > 0.095 { f64::NAN } else { 0.0 }]));
    let samples: Vec<_> = simulation.steps(100).collect();
    assert_eq!(samples.iter().filter(|sample| sample.is_ok()).count(), 9);
    assert_eq!(samples.len(), 10);
    let error = samples.last().and_then(|sample| sample.as_ref().err());
    assert_eq!(error, Some(&Error::NotFinite { vector: "tau", index: 1 }), "the input ends within the step");
    assert!(simulation.state().check().is_ok(), "the last good state stays");
}

/// A control loop that computes its own torque, and the same torque as an input that does not change.
#[test]
fn a_torque_from_outside_is_held_over_the_step() {
    let start = State::rest(SVector::from(Q0));
    let mut simulation = Simulation::new(&DoublePendulum, start, 1e-2)
        .expect("valid")
        .with_input(|_, _| SVector::repeat(f64::NAN)); // is not asked
    let mut expected = start;
    for step in 1..=100 {
        let tau = simulation.state().v * -0.5;
        let sample = simulation.step_with(&tau).expect("finite");
        expected = Rk4.step(&DoublePendulum, 0.0, &expected, 1e-2, |_, _| tau).expect("explicit");
        assert_eq!(sample.state, expected);
        assert!((sample.time - 1e-2 * f64::from(step)).abs() < 1e-15);
    }
    let lost = simulation.step_with(&SVector::from([0.0, f64::INFINITY])).err();
    assert_eq!(lost, Some(Error::NotFinite { vector: "tau", index: 1 }));
    assert_eq!(simulation.state(), &expected, "it stays where it was");
}
