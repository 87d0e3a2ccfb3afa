//! Four roads lead to the numbers of one robot, and meet: the compiled Rust, the interpreter on the same programs,
//! the plain recursion in doubles, and Lagrange's equations by differentiating the energies.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_codegen::mechanics::equations::Method;
use dynamics_codegen::mechanics::plain::{ForwardDynamicsDerivatives, Rows};
use dynamics_tests::close::{ROUNDING, distance};
use dynamics_tests::roads::{Roads, travel};
use dynamics_tests::zoo::{self, Entry};
use dynamics_tests::{Axes, Forms, Matrix, Part, Robot, Space, State, Vector, assert_close};

/// How many states each robot is compared at.
const STATES: usize = 8;

/// The interpreter takes the compiled Rust's operations in its order; only sines may differ, by an ulp, and forms
/// that cancel (solving, differences of products) make more of that.
const SAME_PROGRAM: f64 = 1e-13;

/// Lagrange's expressions grow as n⁴ before they cancel: one digit more than [`ROUNDING`] for nine joints.
const LAGRANGE: f64 = 1e-11;

fn for_each_robot(check: impl Fn(&Entry, &dyn Robot<f64>, &Roads<'_>, &[State])) {
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        let states = entry.states(STATES);
        travel(&entry, |roads| check(&entry, &*robot, roads, &states));
    }
}

/// The forces that a unit of acceleration takes: the size below which a force counts as zero.
fn unit_force(robot: &dyn Robot<f64>, q: &Vector) -> f64 {
    robot.mass_matrix(q).amax()
}

/// The entries of a matrix by rows.
fn rows(m: &Matrix) -> Vec<f64> {
    m.transpose().as_slice().to_vec()
}

fn to_rows(m: &Matrix) -> Rows {
    m.row_iter().map(|row| row.iter().copied().collect()).collect()
}

#[test]
fn compiled_rust_computes_what_the_interpreted_programs_compute() {
    for_each_robot(|entry, robot, roads, states| {
        let interpreter = roads.interpreter();
        for state in states {
            let compare = |method: Method, found: &[f64], tolerance: f64, floor: f64| {
                let Some(expected) = interpreter.run(method, state) else {
                    let loops = [
                        Method::ForwardDynamicsDerivatives,
                        Method::InverseDynamicsWithDerivatives,
                        Method::ForwardDynamicsWithDerivatives,
                        Method::InverseMassMatrix,
                    ];
                    let is_nothing = method.is_provided() && found.iter().all(|x| *x == 0.0);
                    let name = method.name();
                    assert!(loops.contains(&method) || is_nothing, "{}: {name} has no program", entry.name);
                    return;
                };
                assert_close!(found, expected, tolerance, floor = floor, "{}: {}", entry.name, method.name());
            };
            equations(robot, state, &compare);
            derivatives(robot, state, &compare);
            whole(robot, state, &compare);
            frames(robot, state, &compare);
        }
    });
}

/// What is told the results of a method, the tolerance, and the size below which they are zero.
type Compare<'a> = &'a dyn Fn(Method, &[f64], f64, f64);

fn equations(robot: &dyn Robot<f64>, State { q, v, a, tau }: &State, close: Compare<'_>) {
    let force = unit_force(robot, q);
    close(Method::MassMatrix, &rows(&robot.mass_matrix(q)), SAME_PROGRAM, 0.0);
    close(Method::CoriolisMatrix, &rows(&robot.coriolis_matrix(q, v)), SAME_PROGRAM, force);
    close(Method::GravityForces, robot.gravity_forces(q).as_slice(), SAME_PROGRAM, force);
    close(Method::PassiveForces, robot.passive_forces(q, v).as_slice(), SAME_PROGRAM, force);
    close(Method::BiasForces, robot.bias_forces(q, v).as_slice(), SAME_PROGRAM, force);
    close(Method::InverseDynamics, robot.inverse_dynamics(q, v, a).as_slice(), SAME_PROGRAM, force);
    let energies = [robot.kinetic_energy(q, v), robot.potential_energy(q), robot.lagrangian(q, v)];
    let size = energies[0].abs() + energies[1].abs();
    close(Method::KineticEnergy, &energies[..1], SAME_PROGRAM, 0.0);
    close(Method::PotentialEnergy, &energies[1..2], SAME_PROGRAM, force);
    close(Method::Lagrangian, &energies[2..], SAME_PROGRAM, size);
    close(Method::ElasticEnergy, &[robot.elastic_energy(q)], SAME_PROGRAM, force);
    let solving = solving_tolerance(robot, q, SAME_PROGRAM);
    close(Method::ForwardDynamics, robot.forward_dynamics(q, v, tau).as_slice(), solving, 0.0);
    close(Method::InverseMassMatrix, &rows(&robot.inverse_mass_matrix(q)), solving, 0.0);
}

fn derivatives(robot: &dyn Robot<f64>, State { q, v, a, tau }: &State, close: Compare<'_>) {
    let (M, C, G) = robot.equations_of_motion(q, v);
    let bundle = [rows(&M), rows(&C), G.as_slice().to_vec()].concat();
    close(Method::EquationsOfMotion, &bundle, SAME_PROGRAM, 0.0);
    let bundle = robot.inverse_dynamics_derivatives(q, v, a).each_ref().map(rows).concat();
    close(Method::InverseDynamicsDerivatives, &bundle, SAME_PROGRAM, 0.0);
    let bundle = robot.forward_dynamics_derivatives(q, v, tau).each_ref().map(rows).concat();
    let solving = solving_tolerance(robot, q, SAME_PROGRAM);
    close(Method::ForwardDynamicsDerivatives, &bundle, solving, 0.0);
    let (tau_of_a, derivatives) = robot.inverse_dynamics_with_derivatives([q, v, a]);
    let bundle = [tau_of_a.as_slice().to_vec(), derivatives.each_ref().map(rows).concat()].concat();
    close(Method::InverseDynamicsWithDerivatives, &bundle, SAME_PROGRAM, unit_force(robot, q));
    let (a_of_tau, derivatives) = robot.forward_dynamics_with_derivatives([q, v, tau]);
    let bundle = [a_of_tau.as_slice().to_vec(), derivatives.each_ref().map(rows).concat()].concat();
    close(Method::ForwardDynamicsWithDerivatives, &bundle, solving, 0.0);
}

fn whole(robot: &dyn Robot<f64>, State { q, v, a, .. }: &State, close: Compare<'_>) {
    close(Method::TotalMass, &[robot.total_mass()], SAME_PROGRAM, 0.0);
    close(Method::CenterOfMass, robot.center_of_mass(q).as_slice(), SAME_PROGRAM, 1.0);
    close(Method::CenterOfMassJacobian, &rows(&robot.center_of_mass_jacobian(q)), SAME_PROGRAM, 1.0);
    let A = robot.centroidal_momentum_matrix(q);
    close(Method::CentroidalMomentumMatrix, &rows(&A), SAME_PROGRAM, 0.0);
    close(Method::CentroidalMomentum, robot.centroidal_momentum(q, v).as_slice(), SAME_PROGRAM, A.amax());
    close(Method::Regressor, &rows(&robot.regressor(q, v, a)), SAME_PROGRAM, 1.0);
    close(Method::InertialParameters, robot.inertial_parameters().as_slice(), SAME_PROGRAM, 0.0);
    close(Method::BaseRegressor, &rows(&robot.base_regressor(q, v, a)), SAME_PROGRAM, 1.0);
    close(Method::BaseParameters, robot.base_parameters().as_slice(), SAME_PROGRAM, 0.0);
}

fn frames(robot: &dyn Robot<f64>, State { q, v, a, .. }: &State, close: Compare<'_>) {
    for frame in 0..robot.frame_names().len() {
        let (R, p) = robot.pose(frame, q);
        close(Method::Pose(frame), &[rows(&R), p.as_slice().to_vec()].concat(), SAME_PROGRAM, 0.0);
        let [own, world] = Axes::BOTH.map(|axes| robot.jacobian(frame, axes, q));
        close(Method::Jacobian(frame), &rows(&own), SAME_PROGRAM, 1.0);
        close(Method::WorldJacobian(frame), &rows(&world), SAME_PROGRAM, 1.0);
        let velocity = robot.velocity(frame, Axes::Own, q, v);
        close(Method::Velocity(frame), velocity.as_slice(), SAME_PROGRAM, 1.0);
        let acceleration = robot.acceleration(frame, Axes::Own, [q, v, a]);
        close(Method::Acceleration(frame), acceleration.as_slice(), SAME_PROGRAM, 1.0);
    }
}

/// Solving with M multiplies errors by its condition.
fn solving_tolerance(robot: &dyn Robot<f64>, q: &Vector, tolerance: f64) -> f64 {
    let values = robot.mass_matrix(q).symmetric_eigenvalues();
    tolerance.max(8.0 * f64::EPSILON * values.max() / values.min())
}

#[test]
fn compiled_rust_agrees_with_the_plain_recursion() {
    for_each_robot(|entry, robot, roads, states| {
        let oracle = roads.oracle();
        for State { q, v, a, .. } in states {
            let force = unit_force(robot, q);
            let [qs, vs, accelerations] = [q, v, a].map(Vector::as_slice);
            let close = |what: &str, found: &[f64], expected: Vec<f64>, floor: f64| {
                assert_close!(found, expected, ROUNDING, floor = floor, "{}: {what}", entry.name);
            };
            close("M", &rows(&robot.mass_matrix(q)), oracle.mass_matrix(qs).concat(), 0.0);
            close("C", &rows(&robot.coriolis_matrix(q, v)), oracle.coriolis_matrix(qs, vs).concat(), force);
            close("G", robot.gravity_forces(q).as_slice(), oracle.gravity_forces(qs), force);
            let passive = oracle.passive_forces(qs, vs);
            close("passive forces", robot.passive_forces(q, v).as_slice(), passive, force);
            close("U", &[robot.elastic_energy(q)], vec![oracle.elastic_energy(qs)], force);
            close("h", robot.bias_forces(q, v).as_slice(), oracle.bias_forces(qs, vs), force);
            let tau = oracle.inverse_dynamics(qs, vs, accelerations);
            close("τ", robot.inverse_dynamics(q, v, a).as_slice(), tau, force);
            let (kinetic, potential) = (oracle.kinetic_energy(qs, vs), oracle.potential_energy(qs));
            close("T", &[robot.kinetic_energy(q, v)], vec![kinetic], 0.0);
            close("V", &[robot.potential_energy(q)], vec![potential], force);
            let size = kinetic.abs() + potential.abs();
            close("L", &[robot.lagrangian(q, v)], vec![oracle.lagrangian(qs, vs)], size);

            let [dtau_dq, dtau_dv, dtau_da] = robot.inverse_dynamics_derivatives(q, v, a);
            let exact = oracle.inverse_dynamics_derivatives(qs, vs, accelerations);
            close("∂τ/∂q", &rows(&dtau_dq), exact.dtau_dq.concat(), force);
            close("∂τ/∂v", &rows(&dtau_dv), exact.dtau_dv.concat(), force);
            close("∂τ/∂a", &rows(&dtau_da), exact.dtau_da.concat(), 0.0);
        }
    });
}

/// Forward dynamics is judged by its residual: the accelerations themselves may differ by the condition of M.
#[test]
fn forward_dynamics_satisfies_the_plain_recursion() {
    for_each_robot(|entry, robot, roads, states| {
        let oracle = roads.oracle();
        for State { q, v, tau, .. } in states {
            let [qs, vs, forces] = [q, v, tau].map(Vector::as_slice);
            let claimed = to_rows(&robot.inverse_mass_matrix(q));
            let residual = oracle.inverse_mass_matrix_residual(qs, &claimed);
            assert!(residual <= ROUNDING, "{}: M·M⁻¹ misses 1 by {residual:.1e}", entry.name);
            let a = robot.forward_dynamics(q, v, tau);
            let residual = oracle.forward_dynamics_residual(qs, vs, forces, a.as_slice());
            assert!(residual <= ROUNDING, "{}: a misses τ by {residual:.1e}", entry.name);

            let [da_dq, da_dv, da_dtau] = robot.forward_dynamics_derivatives(q, v, tau);
            // By M·∂a/∂x = −∂τ/∂x at the acceleration that τ causes, and M·∂a/∂τ = 1.
            let exact = oracle.inverse_dynamics_derivatives(qs, vs, a.as_slice());
            let M = robot.mass_matrix(q);
            let solves = |what: &str, X: &Matrix, B: Vec<f64>| {
                let terms = (M.abs() * X.abs()).amax().max(M.amax());
                assert_close!(rows(&(&M * X)), B, ROUNDING, floor = terms, "{}: M·{what}", entry.name);
            };
            let negative = |block: Rows| block.concat().iter().map(|x| -x).collect::<Vec<f64>>();
            solves("∂a/∂q", &da_dq, negative(exact.dtau_dq));
            solves("∂a/∂v", &da_dv, negative(exact.dtau_dv));
            solves("∂a/∂τ", &da_dtau, rows(&Matrix::identity(v.len(), v.len())));
        }
    });
}

#[test]
fn the_oracle_itself_tells_right_accelerations_from_wrong_ones() {
    for_each_robot(|entry, robot, roads, states| {
        let State { q, v, tau, .. } = &states[0];
        let a = robot.forward_dynamics(q, v, tau);
        let [mut da_dq, da_dv, da_dtau] = robot.forward_dynamics_derivatives(q, v, tau);
        da_dq[0] += 0.01 * (1.0 + da_dtau.amax());
        let [da_dq, da_dv, da_dtau] = [da_dq, da_dv, da_dtau].each_ref().map(to_rows);
        let wrong = ForwardDynamicsDerivatives { da_dq, da_dv, da_dtau };
        let oracle = roads.oracle();
        let (qs, vs) = (q.as_slice(), v.as_slice());
        let residual = oracle.forward_dynamics_derivatives_residual(qs, vs, a.as_slice(), &wrong);
        assert!(residual > 1e-8, "{}: an error is not seen, {residual:.1e}", entry.name);
    });
}

#[test]
fn frames_of_compiled_rust_are_those_of_the_plain_recursion() {
    for_each_robot(|entry, robot, roads, states| {
        let oracle = roads.oracle();
        let names: Vec<&str> = roads.tree.frames.iter().map(|frame| frame.name.as_str()).collect();
        assert_eq!(robot.frame_names(), names, "{}", entry.name);
        assert_eq!(entry.body_names, names, "{}", entry.name);
        for State { q, v, a, .. } in states {
            let [qs, vs, accelerations] = [q, v, a].map(Vector::as_slice);
            for (k, frame) in names.iter().enumerate() {
                let close = |what: &str, found: &[f64], expected: Vec<f64>, size: f64| {
                    let name = entry.name;
                    assert_close!(found, expected, ROUNDING, floor = size, "{name}: {what} of {frame}");
                };
                // Rotations are of the size of one, and so are the lengths of these robots.
                let (R, p) = robot.pose(k, q);
                let pose = oracle.pose(k, qs);
                close("rotation", &rows(&R), pose.rotation.0.concat(), 1.0);
                close("translation", p.as_slice(), pose.translation.0.to_vec(), 1.0);
                let [own, world] = Axes::BOTH.map(|axes| robot.jacobian(k, axes, q));
                close("J", &rows(&own), oracle.body_jacobian(k, qs).concat(), 1.0);
                close("J in world axes", &rows(&world), oracle.world_jacobian(k, qs).concat(), 1.0);
                let velocity = robot.velocity(k, Axes::Own, q, v);
                close("V", velocity.as_slice(), oracle.velocity(k, qs, vs), v.amax());
                let acceleration = robot.acceleration(k, Axes::Own, [q, v, a]);
                let expected = oracle.acceleration(k, qs, vs, accelerations);
                close("V̇", acceleration.as_slice(), expected, a.amax() + v.norm_squared());
            }
        }
    });
}

#[test]
fn the_whole_of_compiled_rust_is_that_of_the_plain_recursion() {
    for_each_robot(|entry, robot, roads, states| {
        let oracle = roads.oracle();
        for State { q, v, .. } in states {
            let (qs, vs) = (q.as_slice(), v.as_slice());
            let A = robot.centroidal_momentum_matrix(q);
            let close = |what: &str, found: &[f64], expected: Vec<f64>, floor: f64| {
                assert_close!(found, expected, ROUNDING, floor = floor, "{}: {what}", entry.name);
            };
            close("c", robot.center_of_mass(q).as_slice(), oracle.center_of_mass(qs), 1.0);
            let jacobian = robot.center_of_mass_jacobian(q);
            close("J of c", &rows(&jacobian), oracle.center_of_mass_jacobian(qs).concat(), 1.0);
            close("A", &rows(&A), oracle.centroidal_momentum_matrix(qs).concat(), 0.0);
            let momentum = robot.centroidal_momentum(q, v);
            close("A·v", momentum.as_slice(), oracle.centroidal_momentum(qs, vs), A.amax() * v.amax());
        }
    });
}

#[test]
fn compiled_rust_agrees_with_lagrange() {
    for_each_robot(|entry, robot, roads, states| {
        if entry.name == "Hyq" {
            return; // of 18 degrees of freedom the expressions, of which there are some n⁴, take minutes
        }
        let motions = roads.lagrangian().at(&states[..2]);
        for (State { q, v, a, .. }, motion) in states.iter().zip(&motions) {
            let force = unit_force(robot, q);
            let close = |what: &str, found: &[f64], expected: &[f64], floor: f64| {
                assert_close!(found, expected, LAGRANGE, floor = floor, "{}: {what}", entry.name);
            };
            close("T", &[robot.kinetic_energy(q, v)], &[motion.kinetic_energy], 0.0);
            close("V", &[robot.potential_energy(q)], &[motion.potential_energy], force);
            close("M", &rows(&robot.mass_matrix(q)), &motion.mass_matrix, 0.0);
            close("C", &rows(&robot.coriolis_matrix(q, v)), &motion.coriolis_matrix, force);
            close("G", robot.gravity_forces(q).as_slice(), &motion.gravity_forces, force);
            close("τ", robot.inverse_dynamics(q, v, a).as_slice(), &motion.inverse_dynamics, force);
        }
    });
}

/// The same robot written twice: the roads from both to the numbers meet, too.
#[test]
fn puma_by_urdf_numbers_is_puma_by_denavit_and_hartenberg() {
    let find = |name: &str| {
        zoo::in_double().find(|(entry, _)| entry.name == name).expect("it is in the zoo").1.robot
    };
    let (urdf, dh) = (find("Puma560"), find("Puma560ByDh"));
    for State { q, v, a, .. } in State::many("both PUMAs", Space(&[Part::Lines(6)]), STATES) {
        let (M, N) = (urdf.mass_matrix(&q), dh.mass_matrix(&q));
        assert!(distance(M.as_slice(), N.as_slice(), 0.0) <= ROUNDING);
        let (tau, again) = (urdf.inverse_dynamics(&q, &v, &a), dh.inverse_dynamics(&q, &v, &a));
        assert_close!(tau.as_slice(), again.as_slice(), ROUNDING, "τ of PUMA");
        assert_close!([urdf.potential_energy(&q)], [dh.potential_energy(&q)], ROUNDING, "V of PUMA");
    }
}
