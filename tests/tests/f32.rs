//! Robots over `f32` compute what the plain recursion computes in doubles, to single precision.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_codegen::mechanics::plain::Oracle;
use dynamics_tests::close::SINGLE;
use dynamics_tests::roads::travel;
use dynamics_tests::zoo::{self, Entry};
use dynamics_tests::{Axes, Forms, Matrix, Robot, State, Vector, assert_close};

const STATES: usize = 16;

/// Runs `check` on each robot over `f32`, at states that single precision holds exactly.
fn for_each_state(check: impl Fn(&str, &dyn Robot<f32>, Oracle<'_>, &State)) {
    let mut count = 0;
    for mut entry in zoo::all() {
        let Some(Forms { robot, .. }) = entry.single.take() else { continue };
        count += 1;
        travel(&entry, |roads| {
            for state in states(&entry) {
                check(entry.name, &*robot, roads.oracle(), &state);
            }
        });
    }
    assert!(count > 20, "the zoo has {count} robots over f32");
}

fn states(entry: &Entry) -> Vec<State> {
    entry.states(STATES).iter().map(State::in_single).collect()
}

fn single(x: &Vector) -> Vector<f32> {
    x.map(|x| x as f32)
}

fn double(x: &[f32]) -> Vec<f64> {
    x.iter().map(|&x| f64::from(x)).collect()
}

fn rows(m: &Matrix<f32>) -> Vec<f64> {
    double(m.transpose().as_slice())
}

#[test]
fn the_equations_agree() {
    for_each_state(|name, robot, oracle, State { q, v, a, .. }| {
        let [q32, v32, a32] = [q, v, a].map(single);
        let [q, v, a] = [q, v, a].map(Vector::as_slice);
        let M = oracle.mass_matrix(q).concat();
        let force = dynamics_tests::close::largest(&M);
        let close = |what: &str, found: &[f64], expected: Vec<f64>, floor: f64| {
            assert_close!(found, expected, SINGLE, floor = floor, "{name} in f32: {what}");
        };
        close("M", &rows(&robot.mass_matrix(&q32)), M, 0.0);
        close("C", &rows(&robot.coriolis_matrix(&q32, &v32)), oracle.coriolis_matrix(q, v).concat(), force);
        close("G", &double(robot.gravity_forces(&q32).as_slice()), oracle.gravity_forces(q), force);
        close("h", &double(robot.bias_forces(&q32, &v32).as_slice()), oracle.bias_forces(q, v), force);
        let tau = robot.inverse_dynamics(&q32, &v32, &a32);
        close("τ", &double(tau.as_slice()), oracle.inverse_dynamics(q, v, a), force);
        let passive = robot.passive_forces(&q32, &v32);
        close("passive forces", &double(passive.as_slice()), oracle.passive_forces(q, v), force);
        close("U", &[f64::from(robot.elastic_energy(&q32))], vec![oracle.elastic_energy(q)], force);
        let (kinetic, potential) = (oracle.kinetic_energy(q, v), oracle.potential_energy(q));
        let size = kinetic.abs() + potential.abs();
        close("T", &[f64::from(robot.kinetic_energy(&q32, &v32))], vec![kinetic], 0.0);
        close("V", &[f64::from(robot.potential_energy(&q32))], vec![potential], force);
        close("L", &[f64::from(robot.lagrangian(&q32, &v32))], vec![kinetic - potential], size);
        let exact = oracle.inverse_dynamics_derivatives(q, v, a);
        let [dtau_dq, dtau_dv, dtau_da] = robot.inverse_dynamics_derivatives(&q32, &v32, &a32);
        close("∂τ/∂q", &rows(&dtau_dq), exact.dtau_dq.concat(), force);
        close("∂τ/∂v", &rows(&dtau_dv), exact.dtau_dv.concat(), force);
        close("∂τ/∂a", &rows(&dtau_da), exact.dtau_da.concat(), 0.0);
        let (Y, parameters) = (robot.regressor(&q32, &v32, &a32), robot.inertial_parameters());
        let terms = f64::from((Y.abs() * parameters.abs()).amax());
        let product = double((Y * parameters).as_slice());
        close("Y·π", &product, oracle.inverse_dynamics(q, v, a), terms);
        let (Y, parameters) = (robot.base_regressor(&q32, &v32, &a32), robot.base_parameters());
        let terms = f64::from((Y.abs() * parameters.abs()).amax());
        let product = double((Y * parameters).as_slice());
        close("Y_b·π_b", &product, oracle.inverse_dynamics(q, v, a), terms);
    });
}

#[test]
fn the_whole_agrees() {
    for_each_state(|name, robot, oracle, State { q, v, .. }| {
        let [q32, v32] = [q, v].map(single);
        let (q, v) = (q.as_slice(), v.as_slice());
        let A = oracle.centroidal_momentum_matrix(q).concat();
        let size = dynamics_tests::close::largest(&A);
        let close = |what: &str, found: &[f64], expected: Vec<f64>, floor: f64| {
            assert_close!(found, expected, SINGLE, floor = floor, "{name} in f32: {what}");
        };
        close("A", &rows(&robot.centroidal_momentum_matrix(&q32)), A, 0.0);
        let momentum = robot.centroidal_momentum(&q32, &v32);
        close("A·v", &double(momentum.as_slice()), oracle.centroidal_momentum(q, v), size);
        close("c", &double(robot.center_of_mass(&q32).as_slice()), oracle.center_of_mass(q), 1.0);
        let jacobian = robot.center_of_mass_jacobian(&q32);
        close("J of c", &rows(&jacobian), oracle.center_of_mass_jacobian(q).concat(), 1.0);
    });
}

/// By the residual: M of PUMA has a condition of 10⁵, which single precision cannot invert to five digits, and need
/// not: the accelerations still answer the forces.
#[test]
fn forward_dynamics_answers_the_forces() {
    for_each_state(|name, robot, oracle, State { q, v, tau, .. }| {
        let [q32, v32, tau32] = [q, v, tau].map(single);
        let a = double(robot.forward_dynamics(&q32, &v32, &tau32).as_slice());
        let residual = oracle.forward_dynamics_residual(q.as_slice(), v.as_slice(), tau.as_slice(), &a);
        assert!(residual <= SINGLE, "{name} in f32: a misses τ by {residual:.1e}");
        let inverse = robot.inverse_mass_matrix(&q32);
        let inverse = inverse.row_iter().map(|row| row.iter().map(|&x| f64::from(x)).collect()).collect();
        let residual = oracle.inverse_mass_matrix_residual(q.as_slice(), &inverse);
        assert!(residual <= SINGLE, "{name} in f32: M·M⁻¹ misses 1 by {residual:.1e}");
    });
}

#[test]
fn frames_agree() {
    for_each_state(|name, robot, oracle, State { q, v, a, .. }| {
        let [q32, v32, a32] = [q, v, a].map(single);
        for (k, frame) in robot.frame_names().iter().enumerate() {
            let close = |what: &str, found: &[f64], expected: Vec<f64>| {
                assert_close!(found, expected, SINGLE, floor = 1.0, "{name} in f32: {what} of {frame}");
            };
            let (R, p) = robot.pose(k, &q32);
            let pose = oracle.pose(k, q.as_slice());
            close("rotation", &rows(&R), pose.rotation.0.concat());
            close("translation", &double(p.as_slice()), pose.translation.0.to_vec());
            let [own, world] = Axes::BOTH.map(|axes| robot.jacobian(k, axes, &q32));
            close("J", &rows(&own), oracle.body_jacobian(k, q.as_slice()).concat());
            close("J in world axes", &rows(&world), oracle.world_jacobian(k, q.as_slice()).concat());
            let velocity = robot.velocity(k, Axes::Own, &q32, &v32);
            close("V", &double(velocity.as_slice()), oracle.velocity(k, q.as_slice(), v.as_slice()));
            let acceleration = robot.acceleration(k, Axes::Own, [&q32, &v32, &a32]);
            let expected = oracle.acceleration(k, q.as_slice(), v.as_slice(), a.as_slice());
            close("V̇", &double(acceleration.as_slice()), expected);
        }
    });
}

#[test]
fn prepared_companions_compute_the_same_bits() {
    for mut entry in zoo::all() {
        let Some(Forms { robot, prepared }) = entry.single.take() else { continue };
        for State { q, v, a, tau } in states(&entry) {
            let [q, v, a, tau] = [q, v, a, tau].each_ref().map(single);
            let name = entry.name;
            assert_eq!(robot.inverse_dynamics(&q, &v, &a), prepared.inverse_dynamics(&q, &v, &a), "{name}");
            assert_eq!(
                robot.forward_dynamics(&q, &v, &tau),
                prepared.forward_dynamics(&q, &v, &tau),
                "{name}"
            );
            assert_eq!(robot.equations_of_motion(&q, &v), prepared.equations_of_motion(&q, &v), "{name}");
        }
    }
}
