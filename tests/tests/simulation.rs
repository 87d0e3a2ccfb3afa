//! Motion over time: what is conserved, and what a falling or swinging body is known to do.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_core::prelude::*;
use dynamics_tests::Method::{self, Adaptive, Rk4, SemiImplicitEuler, Variational};
use dynamics_tests::close::ROUNDING;
use dynamics_tests::zoo::files::hyq;
use dynamics_tests::zoo::fixtures::lift;
use dynamics_tests::zoo::joints::{free_box, spherical_pendulum};
use dynamics_tests::zoo::textbook::{any_toss, double_pendulum, pendulum, tossed_box};
use dynamics_tests::zoo::{self, Entry};
use dynamics_tests::{Forms, Robot, Run, State, Vector, assert_close};

/// The energy that comes and goes in a motion: of the first sample's size, or more where V is.
fn drift(robot: &dyn Robot<f64>, q: &Vector, v: &Vector, step: f64, seconds: f64, by: Method) -> f64 {
    let count = (seconds / step).round() as usize;
    let Run { energies, .. } =
        robot.simulate((q, v), step, count, by).expect("an unforced robot stays finite");
    let size = robot.kinetic_energy(q, v).abs() + robot.gravity_forces(q).amax();
    energies.iter().map(|energy| (energy - energies[0]).abs()).fold(0.0, f64::max) / size
}

/// The state from which each robot starts: anywhere, at moderate speed.
fn start(entry: &Entry) -> (Vector, Vector) {
    let State { q, v, .. } = entry.states(1).swap_remove(0);
    (q, v * 0.5)
}

/// RK4 at 0.5 ms over 0.1 s: the fastest time constants of these robots are some hundredths of a second, and the
/// error goes with the fourth power of their ratio.
#[test]
fn every_robot_conserves_its_energy_or_loses_it_to_dampers_and_friction() {
    const DRIFT: f64 = 1e-7;
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        let (q, v) = start(&entry);
        let springs = robot.passive_forces(&q, &Vector::zeros(v.len()));
        if robot.passive_forces(&q, &v) == springs {
            for by in [Rk4, Adaptive] {
                let found = drift(&*robot, &q, &v, 5e-4, 0.1, by);
                assert!(found <= DRIFT, "{}: the energy drifts by {found:.1e}, by {by:?}", entry.name);
            }
            continue;
        }
        let Run { energies, .. } = robot.simulate((&q, &v), 5e-4, 200, Rk4).expect("it stays finite");
        assert!(energies.windows(2).all(|pair| pair[1] < pair[0]), "{} gains energy", entry.name);
    }
}

#[test]
fn halving_the_step_divides_the_error_by_the_order() {
    let Forms { robot, .. } = double_pendulum::entry().double.expect("it is generic");
    let (q, v) = (Vector::from_column_slice(&[0.4, 0.3]), Vector::from_column_slice(&[0.5, 1.5]));
    let end = |step: f64, by| {
        let count = (1.0 / step).round() as usize;
        robot.simulate((&q, &v), step, count, by).expect("it stays finite").q
    };
    let exact = end(1.25e-4, Rk4);
    for (by, step, order) in [(Rk4, 0.01, 4.0), (SemiImplicitEuler, 5e-4, 1.0), (Variational, 2e-3, 2.0)] {
        let error = |step| (end(step, by) - &exact).amax();
        // Over three halvings, from a start where the next order is small: elsewhere it hides this one.
        let found = (error(step) / error(step / 8.0)).log2() / 3.0;
        assert!((found - order).abs() < 0.1, "{by:?} has order {found:.2}");
    }
}

/// With the mass matrix constant the semi-implicit method is symplectic: the error of the energy swings, and does not
/// grow in a hundred times the time.
#[test]
fn semi_implicit_euler_keeps_the_energy_of_the_pendulum_bounded() {
    let Forms { robot, .. } = pendulum::entry().double.expect("it is generic");
    let (q, v) = (Vector::from_element(1, 1.0), Vector::from_element(1, 0.0));
    let short = drift(&*robot, &q, &v, 1e-3, 2.0, SemiImplicitEuler);
    let long = drift(&*robot, &q, &v, 1e-3, 200.0, SemiImplicitEuler);
    assert!(long < 1.01 * short, "{short:.2e} became {long:.2e}");
    assert!(long < 2e-3, "one step's change of the energy: {long:.2e}");
}

#[test]
fn ten_seconds_of_a_double_pendulum_conserve_energy() {
    let Forms { robot, .. } = double_pendulum::entry().double.expect("it is generic");
    let (q, v) = (Vector::from_column_slice(&[2.0, 1.0]), Vector::zeros(2));
    // Chaotic motion, whose angles no method predicts; the energy it must keep nevertheless.
    let found = drift(&*robot, &q, &v, 1e-3, 10.0, Rk4);
    assert!(found < 1e-7, "the energy drifts by {found:.1e}");
}

/// Noether: nothing depends on the first angle if its axis is along gravity, and its momentum `(M·v)₀` stays.
#[test]
fn momentum_about_a_vertical_first_axis_is_conserved() {
    let vertical =
        ["RoboJudge", "SphericalArm", "PlanarScara", "Torso", "Puma560", "Iiwa14", "Scara", "StanfordArm"];
    for (entry, Forms { robot, .. }) in zoo::in_double().filter(|(entry, _)| vertical.contains(&entry.name)) {
        let (q, v) = start(&entry);
        let momentum = |q: &Vector, v: &Vector| (robot.mass_matrix(q) * v)[0];
        let end = robot.simulate((&q, &v), 5e-4, 200, Rk4).expect("it stays finite");
        let size = (robot.mass_matrix(&q).abs() * v.abs())[0];
        let change = (momentum(&end.q, &end.v) - momentum(&q, &v)).abs() / size;
        assert!(change < 1e-7, "{}: momentum changes by {change:.1e}", entry.name);
        assert!((end.q - &q).amax() > 1e-3, "{} has not moved", entry.name);
    }
}

/// The same theorem of the variational method's sum: at a step at which Runge and Kutta lose the fifth digit.
#[test]
fn a_variational_method_conserves_it_to_rounding() {
    let vertical = ["RoboJudge", "SphericalArm", "PlanarScara", "Torso", "Iiwa14", "Scara", "StanfordArm"];
    let mut count = 0;
    for (entry, Forms { robot, .. }) in zoo::in_double().filter(|(entry, _)| vertical.contains(&entry.name)) {
        count += 1;
        let (q, v) = start(&entry);
        let momentum = |q: &Vector, v: &Vector| (robot.mass_matrix(q) * v)[0];
        let end = robot.simulate((&q, &v), 2e-3, 100, Variational).expect("its steps are solved");
        let size = (robot.mass_matrix(&q).abs() * v.abs())[0];
        let change = (momentum(&end.q, &end.v) - momentum(&q, &v)).abs() / size;
        // A hundred steps, each solved to some roundings times what the condition of M makes of them.
        assert!(change < 1e-11, "{}: momentum changes by {change:.1e}", entry.name);
    }
    assert_eq!(count, vertical.len());
}

/// Its equations have Cᵀ, the commutators of ball and free joints, and passive forces: what is wrong in any of them
/// makes the order zero or one.
#[test]
fn a_variational_method_is_of_order_two_for_every_robot() {
    /// Errors of which a sixteenth is still above rounding: of some robots the method has none.
    const ROUNDED: f64 = 1e-9;
    let mut count = 0;
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        let (q, v) = start(&entry);
        let run = |count: usize, by| robot.simulate((&q, &v), 0.02 / count as f64, count, by);
        let exact = run(400, Rk4).expect("it stays finite");
        let error = |count: usize| {
            let end = run(count, Variational).expect("its steps are solved");
            robot.difference(&exact.q, &end.q).norm() + (end.v - &exact.v).norm()
        };
        let (coarse, fine) = (error(50), error(200));
        if coarse > ROUNDED {
            count += 1;
            let order = (coarse / fine).log2() / 2.0;
            assert!((order - 2.0).abs() < 0.2, "{}: order {order:.2}", entry.name);
        }
    }
    assert!(count > 20, "{count} robots have an error to speak of");
}

#[test]
fn a_pendulum_swings_with_the_period_of_the_textbook() {
    let robot = pendulum::robot::<f64>();
    let small = 1e-4;
    let period = std::f64::consts::TAU * (robot.l / robot.g).sqrt();
    let steps = 2000;
    let from = State2::rest(SVector::from([small]));
    let mut simulation =
        Simulation::new(&robot, from, period / f64::from(steps)).expect("the step is positive");
    let last = simulation.steps(2000).last().expect("there are steps").expect("it stays finite");
    // The period of a small swing is longer by θ²/16.
    assert_close!([last.state.q[0]], [small], 1e-8, "angle after one period");
}

type State2<T, const N: usize> = dynamics_core::State<T, N, N>;

#[test]
fn a_falling_lift_falls_as_galileo_says() {
    let robot = lift::robot();
    let along_rail = -9.81 * 0.8; // the rail is [3, 0, 4] / 5
    let from = State2::new(SVector::from([1.0]), SVector::from([0.5]));
    let mut simulation = Simulation::new(&robot, from, 0.01).expect("the step is positive");
    let last = simulation.steps(100).last().expect("there are steps").expect("it stays finite");
    let t = last.time;
    let expected = 1.0 + 0.5 * t + along_rail * t * t / 2.0;
    assert_close!([last.state.q[0]], [expected], ROUNDING, "height of the lift");
}

/// Problem 6 of the lecture, in motion: a parabola, and a spin that stays.
#[test]
fn a_tossed_box_follows_the_parabola_and_keeps_its_spin() {
    let robot = tossed_box::robot::<f64>();
    let from = State2::new(SVector::from([1.2, 0.0]), SVector::from([5.0, 7.0]));
    let mut simulation = Simulation::new(&robot, from, 0.01).expect("the step is positive");
    let last = simulation.steps(100).last().expect("there are steps").expect("it stays finite");
    let t = last.time;
    let expected = [1.2 + 5.0 * t - robot.g * t * t / 2.0, 7.0 * t];
    assert_close!(last.state.q.as_slice(), expected, ROUNDING, "height and turn of the box");
}

/// In free flight the angular momentum stays in space, whatever yaw, pitch and roll make of it.
#[test]
fn a_box_tossed_anyhow_keeps_its_angular_momentum() {
    let robot = any_toss::robot::<f64>();
    let any_toss::AnyToss { m, l, w, h, .. } = robot;
    let moments = SVector::from([w * w + h * h, l * l + h * h, l * l + w * w]) * (m / 12.0);
    let momentum = |state: &State2<f64, 6>| {
        let twist = robot.jacobian::<any_toss::Parcel>(&state.q) * state.v;
        let spin = twist.fixed_rows::<3>(3).component_mul(&moments);
        robot.pose::<any_toss::Parcel>(&state.q).rotation * spin
    };
    let (q, v) = ([0.0, 0.0, 1.0, 0.3, -0.2, 0.4], [1.0, -0.5, 3.0, 2.0, 0.4, 1.0]);
    let from = State2::new(SVector::from(q), SVector::from(v));
    let mut simulation = Simulation::new(&robot, from, 1e-3).expect("the step is positive");
    let before = momentum(&from);
    let last = simulation.steps(400).last().expect("there are steps").expect("it stays finite");
    let after = momentum(&last.state);
    assert_close!(after.as_slice(), before.as_slice(), 1e-9, "angular momentum of the box");
}

/// The order of a method is that of its steps along the manifold, too.
#[test]
fn halving_the_step_divides_the_error_by_the_order_on_a_manifold() {
    let Forms { robot, .. } = spherical_pendulum::entry().double.expect("it is generic");
    let (q, v) = (robot.neutral(), Vector::from_column_slice(&[0.5, 1.5, -2.0]));
    let end = |step: f64, by| {
        let count = (1.0 / step).round() as usize;
        robot.simulate((&q, &v), step, count, by).expect("it stays finite").q
    };
    let exact = end(1.25e-4, Rk4);
    for (by, step, order) in [(Rk4, 0.01, 4.0), (SemiImplicitEuler, 5e-4, 1.0), (Variational, 2e-3, 2.0)] {
        let error = |step| robot.difference(&exact, &end(step, by)).amax();
        let found = (error(step) / error(step / 8.0)).log2() / 3.0;
        assert!((found - order).abs() < 0.1, "{by:?} has order {found:.2}");
    }
}

/// What nothing holds keeps its angular momentum, and its centre of mass falls along a parabola, however it tumbles and
/// whatever swings on it.
#[test]
fn what_flies_keeps_its_angular_momentum_and_falls() {
    for entry in [free_box::entry(), hyq::entry()] {
        let (q, v) = start(&entry);
        let Forms { robot, .. } = entry.double.expect("it is in doubles");
        let end = robot.simulate((&q, &v), 5e-4, 400, Rk4).expect("it stays finite");
        let (before, after) = (robot.centroidal_momentum(&q, &v), robot.centroidal_momentum(&end.q, &end.v));
        let spins = [&after, &before].map(|momentum| momentum.rows(3, 3).into_owned());
        assert_close!(spins[0].as_slice(), spins[1].as_slice(), 1e-7, "angular momentum of {}", entry.name);
        let t = 0.2;
        let mut expected = robot.center_of_mass(&q) + before.rows(0, 3) * (t / robot.total_mass());
        expected[2] -= 9.81 * t * t / 2.0;
        let found = robot.center_of_mass(&end.q);
        assert_close!(found.as_slice(), expected.as_slice(), 1e-7, "the fall of {}", entry.name);
    }
}
