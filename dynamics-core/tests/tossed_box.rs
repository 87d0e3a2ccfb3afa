//! A box tossed into the air, by Newton's and Euler's laws: a free joint under simulation.
#![cfg(feature = "std")]

use crate::common::Spinner;
use crate::common::elliptic::quarter_period;
use crate::common::free_box::FreeBox;
use dynamics_core::nalgebra::{Vector3, Vector6};
use dynamics_core::prelude::*;

fn start() -> State<f64, 7, 6> {
    State::new(
        SVector::from([0.2, -0.3, 1.0, 0.1, -0.5, 0.7, 0.5]),
        SVector::from([1.0, -2.0, 4.0, 2.0, 5.0, -3.0]),
    )
}

fn end<I: Integrator>(integrator: I, steps: usize) -> State<f64, 7, 6> {
    let robot = FreeBox::tossed();
    let mut simulation = Simulation::new(&robot, start(), 1.0 / steps as f64)
        .expect("the state is one of a box")
        .with_integrator(integrator)
        .with_input(|time, state| state.v * -0.1 + Vector6::from_fn(|i, _| (time * (1.0 + i as f64)).sin()));
    simulation.steps(steps).last().expect("there is a step").expect("the motion is finite").state
}

/// The momentum in world axes, linear and about the centre of mass.
fn momentum(robot: &FreeBox, State { q, v }: &State<f64, 7, 6>) -> [Vector3<f64>; 2] {
    let [linear, angular]: [Vector3<f64>; 2] = [v.fixed_rows::<3>(0).into(), v.fixed_rows::<3>(3).into()];
    let rotation = FreeBox::rotation(q);
    [rotation * (linear + angular.cross(&robot.com)) * robot.mass, rotation * (robot.inertia * angular)]
}

#[test]
fn levi_civita_and_newton_agree() {
    let (robot, State { q, v }) = (FreeBox::tossed(), start());
    let coriolis_matrix = robot.coriolis_matrix(&q, &v);
    let forces = coriolis_matrix * v + robot.gravity_forces(&q);
    assert!((forces - robot.bias_forces(&q, &v)).amax() < 1e-14);
    // The mass matrix is constant: Ṁ = C + Cᵀ = 0.
    assert!((coriolis_matrix + coriolis_matrix.transpose()).amax() < 1e-15);
}

#[test]
fn the_centre_of_mass_flies_a_parabola() {
    let (robot, start) = (FreeBox::tossed(), start());
    let [p, l] = momentum(&robot, &start);
    let from = robot.center_of_mass(&start.q);
    let mut simulation = Simulation::new(&robot, start, 1e-3).expect("valid");
    let joules = simulation.sample().energy().total();
    for sample in simulation.steps(1_000) {
        let Sample { time, state, .. } = sample.expect("finite");
        let expected = from + p / robot.mass * time + robot.gravity * (0.5 * time * time);
        // The error of Runge and Kutta at this step; it shrinks with its fourth power.
        assert!((robot.center_of_mass(&state.q) - expected).norm() < 1e-9, "after {time} s");
        let [linear, angular] = momentum(&robot, &state);
        assert!((linear - p - robot.mass * robot.gravity * time).norm() < 1e-8, "after {time} s");
        assert!((angular - l).norm() < 1e-9, "after {time} s");
        let energy = sample.expect("finite").energy();
        assert!((energy.total() - joules).abs() < 1e-8, "{energy:?} after {time} s");
        assert_eq!(energy.total(), robot.total_energy(&state.q, &state.v));
    }
}

#[test]
fn a_hundred_thousand_steps_leave_a_unit_quaternion() {
    let (robot, start) = (FreeBox::drifting(), start());
    let mut simulation = Simulation::new(&robot, start, 1e-3).expect("valid");
    let (joules, [p, l]) = (simulation.sample().energy().total(), momentum(&robot, &start));
    let last = simulation.steps(100_000).last().expect("there are steps").expect("finite");
    let excess = last.state.q.fixed_rows::<4>(3).norm_squared() - 1.0;
    assert!(excess.abs() <= 4.0 * f64::EPSILON, "{excess:e}");
    let [linear, angular] = momentum(&robot, &last.state);
    // What a hundred thousand steps lose of what the method conserves to its order only.
    assert!((last.energy().total() - joules).abs() < 5e-9);
    assert!((linear - p).norm() < 1e-7 && (angular - l).norm() < 1e-11);
}

/// Thrown about its middle axis a box turns over and over: Euler's equations, solved by Jacobi's elliptic functions.
///
/// L. Landau, E. Lifshitz, *Mechanics*, §37: `Ω₂` has the period `4K/λ`.
#[test]
fn a_tennis_racket_turns_over_in_the_time_of_jacobi() {
    let [i1, i2, i3] = FreeBox::MOMENTS;
    let principal = Vector3::new(0.01, 6.0, 0.06);
    let by_moments = |power: i32| -> f64 {
        FreeBox::MOMENTS.iter().zip(&principal).map(|(i, omega)| i.powi(power) * omega * omega).sum()
    };
    let (twice_energy, square) = (by_moments(1), by_moments(2));
    // Of the two cases, the one that turns about the axis of the largest moment.
    let (small, large) = (square - twice_energy * i1, twice_energy * i3 - square);
    assert!(square > twice_energy * i2);
    let rate = ((i3 - i2) * small / (i1 * i2 * i3)).sqrt();
    let modulus_squared = (i2 - i1) * large / ((i3 - i2) * small);
    let period = 4.0 * quarter_period(modulus_squared) / rate;

    let axes = FreeBox::principal_axes();
    let robot = FreeBox::new(Vector3::zeros(), Vector3::zeros());
    let State { q, mut v } = start();
    v.fixed_rows_mut::<3>(3).copy_from(&(axes * principal));
    let steps = 4_000;
    let mut simulation = Simulation::new(&robot, State::new(q, v), period / f64::from(steps)).expect("valid");
    let about_middle = |state: &State<f64, 7, 6>| {
        let angular: Vector3<f64> = state.v.fixed_rows::<3>(3).into();
        (axes.inverse() * angular).y
    };
    let mut steps_to = |count: usize| simulation.steps(count).last().expect("steps").expect("finite").state;
    let half = about_middle(&steps_to(2_000));
    assert!((half + 6.0).abs() < 1e-6, "turned over after half a period: {half}");
    let whole = steps_to(2_000);
    let back = axes.inverse() * Vector3::from(whole.v.fixed_rows::<3>(3));
    assert!((back - principal).norm() < 1e-6, "as it began after a period: {back}");
}

/// log₂ of the ratio of the errors at h and h/2, against a solution far finer.
fn observed_order<I: Integrator + Copy>(integrator: I, steps: usize) -> f64 {
    let exact = end(Rk4, 4_000);
    let error = |steps| {
        let State { q, v } = end(integrator, steps);
        FreeBox::tossed().difference(&exact.q, &q).norm() + (v - exact.v).norm()
    };
    (error(steps) / error(2 * steps)).log2()
}

#[test]
fn runge_kutta_is_of_order_four_on_free_joints() {
    let order = observed_order(Rk4, 100);
    assert!((order - 4.0).abs() < 0.2, "observed order {order}");
}

/// Under forces of time and speed, and weight, with the frame away from the centre of mass.
#[test]
fn the_variational_method_is_of_order_two_on_free_joints() {
    let order = observed_order(Variational, 200);
    assert!((order - 2.0).abs() < 0.1, "observed order {order}");
}

#[test]
fn semi_implicit_euler_is_of_order_one_on_free_joints() {
    let order = observed_order(SemiImplicitEuler, 1_000);
    assert!((order - 1.0).abs() < 0.2, "observed order {order}");
}

#[test]
fn a_configuration_is_checked_before_it_is_used() {
    let (robot, good) = (FreeBox::tossed(), start());
    let long = State { q: good.q * 1.001, ..good };
    let error = Error::NotUnitQuaternion { index: 3 };
    let o = SVector::zeros();
    assert_eq!(Simulation::new(&robot, long, 1e-3).err(), Some(error));
    assert_eq!(robot.try_inverse_dynamics(&long.q, &o, &o), Err(error));
    assert_eq!(robot.try_forward_dynamics(&long.q, &o, &o), Err(error));
    assert!(robot.try_forward_dynamics(&good.q, &good.v, &o).is_ok());
    let broken = State { q: good.q * f64::NAN, ..good };
    assert_eq!(Simulation::new(&robot, broken, 1e-3).err(), Some(Error::NotFinite { vector: "q", index: 0 }));
    assert_eq!(robot.check_configuration(&robot.neutral()), Ok(()));
    assert_eq!(Spinner.check_configuration(&[0.0, 0.0, 0.6, 0.8].into()), Ok(()));
    assert_eq!(
        Spinner.check_configuration(&[0.0, 0.0, 0.6, 0.9].into()),
        Err(Error::NotUnitQuaternion { index: 0 })
    );
}
