//! Laws that hold for every robot at every state. A bug in any phase breaks one.
//! Each runs over the whole zoo, at 64 seeded random states per robot.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_tests::close::{DIFFERENCES, ROUNDING, largest};
use dynamics_tests::zoo::{self, Entry};
use dynamics_tests::{Dual, Forms, Matrix, Robot, State, Vector, assert_close};

const STATES: usize = 64;

/// Two programs for one quantity, or the same derivative of two: as [`ROUNDING`], for the larger terms within.
const DUAL: f64 = 1e-11;

fn for_each_state(check: impl Fn(&str, &dyn Robot<f64>, &State)) {
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        for state in entry.states(STATES) {
            check(entry.name, &*robot, &state);
        }
    }
}

/// The robots that leave the scalar open, in doubles and over dual numbers.
fn for_each_dual_state(check: impl Fn(&Entry, &dyn Robot<f64>, &dyn Robot<Dual>, &State)) {
    let mut count = 0;
    for mut entry in zoo::all() {
        let (Some(double), Some(dual)) = (entry.double.take(), entry.dual.take()) else { continue };
        count += 1;
        for state in entry.states(STATES) {
            check(&entry, &*double.robot, &*dual.robot, &state);
        }
    }
    assert!(count > 20, "the zoo has {count} generic robots");
}

fn close(what: &str, name: &str, found: &Matrix, expected: &Matrix, tolerance: f64, floor: f64) {
    assert_close!(found.as_slice(), expected.as_slice(), tolerance, floor = floor, "{name}: {what}");
}

/// The central difference of `f` along `rate`.
fn difference(f: impl Fn(&Vector) -> Matrix, x: &Vector, rate: &Vector) -> Matrix {
    let h = 1e-5;
    (f(&(x + rate * h)) - f(&(x - rate * h))) / (2.0 * h)
}

/// The columns `∂f/∂x_j` by central differences.
fn jacobian_by_differences(f: impl Fn(&Vector) -> Vector, x: &Vector) -> Matrix {
    let n = x.len();
    let column = |j: usize| {
        let unit = Vector::from_fn(n, |i, _| f64::from(u8::from(i == j)));
        let column = difference(|x| column_of(&f(x)), x, &unit);
        Vector::from_column_slice(column.as_slice())
    };
    Matrix::from_columns(&(0..n).map(column).collect::<Vec<_>>())
}

fn column_of(x: &Vector) -> Matrix {
    Matrix::from_column_slice(x.len(), 1, x.as_slice())
}

fn tangents(m: &Matrix<Dual>) -> Matrix {
    m.map(|x| x.tangent)
}

#[test]
fn mass_matrix_is_symmetric_and_positive_definite() {
    for_each_state(|name, robot, State { q, .. }| {
        let M = robot.mass_matrix(q);
        assert_eq!(M, M.transpose(), "{name}: both halves are one computation");
        let smallest = M.clone().symmetric_eigenvalues().min();
        assert!(smallest > 0.0, "{name}: the smallest eigenvalue of M is {smallest}");
    });
}

/// `Ṁ − 2C` is skew-symmetric: the Coriolis forces do no work of their own.
#[test]
fn mass_matrix_changes_by_the_coriolis_matrix() {
    for_each_state(|name, robot, State { q, v, .. }| {
        let (M, C) = (robot.mass_matrix(q), robot.coriolis_matrix(q, v));
        let M_dot = difference(|q| robot.mass_matrix(q), q, v);
        let skew = &M_dot - &C * 2.0;
        let size = M.amax() * v.amax();
        close("Ṁ = C + Cᵀ", name, &M_dot, &(&C + C.transpose()), DIFFERENCES, size);
        close("Ṁ − 2C", name, &skew, &-skew.transpose(), DIFFERENCES, size);
    });
}

#[test]
fn mass_matrix_of_a_dual_robot_changes_by_the_coriolis_matrix() {
    for_each_dual_state(|entry, robot, dual, State { q, v, .. }| {
        let C = robot.coriolis_matrix(q, v);
        let M = dual.mass_matrix(&Dual::moving(q, v));
        let size = M.map(|x| x.value).amax();
        close("Ṁ", entry.name, &tangents(&M), &(&C + C.transpose()), ROUNDING, size);
    });
}

/// The forces are quadratic in the speeds, and C is the Christoffel matrix: `∂(C·v)/∂v = 2C`.
#[test]
fn coriolis_matrix_is_the_christoffel_one() {
    for_each_state(|name, robot, State { q, v, a, .. }| {
        let C = robot.coriolis_matrix(q, v);
        let [_, dtau_dv, _] = robot.inverse_dynamics_derivatives(q, v, a);
        close("∂τ/∂v = 2C", name, &dtau_dv, &(&C * 2.0), ROUNDING, robot.mass_matrix(q).amax());
    });
}

#[test]
fn kinetic_energy_is_the_form_of_the_mass_matrix() {
    for_each_state(|name, robot, State { q, v, .. }| {
        let form = v.dot(&(robot.mass_matrix(q) * v)) / 2.0;
        assert_close!([robot.kinetic_energy(q, v)], [form], ROUNDING, "{name}: T = ½vᵀMv");
        assert!(form > 0.0, "{name}: mass in motion has energy");
    });
}

#[test]
fn lagrangian_is_the_difference_of_the_energies() {
    for_each_state(|name, robot, State { q, v, .. }| {
        let (kinetic, potential) = (robot.kinetic_energy(q, v), robot.potential_energy(q));
        let size = kinetic.abs() + potential.abs();
        assert_close!([robot.lagrangian(q, v)], [kinetic - potential], ROUNDING, floor = size, "{name}: L");
    });
}

#[test]
fn gravity_forces_are_the_slope_of_the_potential_energy() {
    for_each_dual_state(|entry, robot, dual, State { q, .. }| {
        let unit = |j: usize| Vector::from_fn(q.len(), |i, _| f64::from(u8::from(i == j)));
        let slope = |j| dual.potential_energy(&Dual::moving(q, &unit(j))).tangent;
        let slopes: Vec<f64> = (0..q.len()).map(slope).collect();
        let size = robot.mass_matrix(q).amax();
        let found = robot.gravity_forces(q);
        assert_close!(found.as_slice(), slopes, ROUNDING, floor = size, "{}: G = ∂V/∂q", entry.name);
    });
}

#[test]
fn gravity_forces_agree_with_differences_of_the_potential_energy() {
    for_each_state(|name, robot, State { q, .. }| {
        let energy = |q: &Vector| Vector::from_element(1, robot.potential_energy(q));
        let slopes = jacobian_by_differences(energy, q);
        let size = robot.potential_energy(q).abs().max(robot.mass_matrix(q).amax());
        close("G", name, &column_of(&robot.gravity_forces(q)), &slopes.transpose(), DIFFERENCES, size);
    });
}

#[test]
fn inverse_dynamics_is_the_sum_of_its_parts() {
    for_each_state(|name, robot, State { q, v, a, .. }| {
        let (M, C, G) = (robot.mass_matrix(q), robot.coriolis_matrix(q, v), robot.gravity_forces(q));
        let terms = M.amax() * a.amax() + C.amax() * v.amax() + G.amax();
        let h = robot.bias_forces(q, v);
        assert_close!(h.as_slice(), (&C * v + &G).as_slice(), ROUNDING, floor = terms, "{name}: h = C·v + G");
        let tau = robot.inverse_dynamics(q, v, a);
        assert_close!(
            tau.as_slice(),
            (&M * a + h).as_slice(),
            ROUNDING,
            floor = terms,
            "{name}: τ = M·a + h"
        );
        let rest = Vector::zeros(q.len());
        let held = robot.inverse_dynamics(q, &rest, &rest);
        assert_close!(
            held.as_slice(),
            G.as_slice(),
            ROUNDING,
            floor = terms,
            "{name}: G holds the robot still"
        );
    });
}

#[test]
fn forward_dynamics_undoes_inverse_dynamics() {
    for_each_state(|name, robot, State { q, v, tau, .. }| {
        let a = robot.forward_dynamics(q, v, tau);
        let again = robot.inverse_dynamics(q, v, &a);
        // What a stable solver guarantees is small against these, however ill-conditioned M is.
        let terms =
            (robot.mass_matrix(q).abs() * a.abs()).amax() + robot.bias_forces(q, v).amax() + tau.amax();
        assert_close!(again.as_slice(), tau.as_slice(), ROUNDING, floor = terms, "{name}: ID(FD(τ)) = τ");
    });
}

/// `vᵀτ = d(T + V)/dt`
#[test]
fn power_in_is_energy_gained() {
    for_each_dual_state(|entry, robot, dual, State { q, v, a, .. }| {
        let (moving, speeding) = (Dual::moving(q, v), Dual::moving(v, a));
        let gained = dual.kinetic_energy(&moving, &speeding) + dual.potential_energy(&moving);
        let tau = robot.inverse_dynamics(q, v, a);
        let terms = v.abs().dot(&tau.abs());
        let name = entry.name;
        assert_close!([v.dot(&tau)], [gained.tangent], ROUNDING, floor = terms, "{name}: power");
    });
}

#[test]
fn power_in_is_energy_gained_by_differences() {
    for_each_state(|name, robot, State { q, v, a, .. }| {
        let h = 1e-5;
        let energy = |t: f64| {
            let (q, v) = (q + v * t + a * (t * t / 2.0), v + a * t);
            robot.kinetic_energy(&q, &v) + robot.potential_energy(&q)
        };
        let gained = (energy(h) - energy(-h)) / (2.0 * h);
        let tau = robot.inverse_dynamics(q, v, a);
        let terms = v.abs().dot(&tau.abs()) + energy(0.0).abs();
        assert_close!([v.dot(&tau)], [gained], DIFFERENCES, floor = terms, "{name}: power");
    });
}

#[test]
fn derivatives_of_inverse_dynamics_agree_with_differences() {
    for_each_state(|name, robot, State { q, v, a, .. }| {
        let [dtau_dq, dtau_dv, dtau_da] = robot.inverse_dynamics_derivatives(q, v, a);
        let size = robot.inverse_dynamics(q, v, a).amax() + robot.mass_matrix(q).amax();
        let by_q = jacobian_by_differences(|q| robot.inverse_dynamics(q, v, a), q);
        close("∂τ/∂q", name, &dtau_dq, &by_q, DIFFERENCES, size);
        let by_v = jacobian_by_differences(|v| robot.inverse_dynamics(q, v, a), v);
        close("∂τ/∂v", name, &dtau_dv, &by_v, DIFFERENCES, size);
        let by_a = jacobian_by_differences(|a| robot.inverse_dynamics(q, v, a), a);
        close("∂τ/∂a", name, &dtau_da, &by_a, DIFFERENCES, size);
        assert_close!(dtau_da.as_slice(), robot.mass_matrix(q).as_slice(), ROUNDING, "{name}: ∂τ/∂a = M");
    });
}

#[test]
fn derivatives_of_inverse_dynamics_are_those_of_dual_numbers() {
    for_each_dual_state(|entry, robot, dual, State { q, v, a, .. }| {
        let [dtau_dq, dtau_dv, _] = robot.inverse_dynamics_derivatives(q, v, a);
        let size = robot.mass_matrix(q).amax();
        for j in 0..q.len() {
            let unit = Vector::from_fn(q.len(), |i, _| f64::from(u8::from(i == j)));
            let (still_q, still_v, still_a) = (Dual::resting(q), Dual::resting(v), Dual::resting(a));
            let by_q = dual.inverse_dynamics(&Dual::moving(q, &unit), &still_v, &still_a);
            let by_v = dual.inverse_dynamics(&still_q, &Dual::moving(v, &unit), &still_a);
            let blocks = [("∂τ/∂q", by_q, &dtau_dq), ("∂τ/∂v", by_v, &dtau_dv)];
            for (what, column, block) in blocks {
                let expected: Vec<f64> = column.iter().map(|tau| tau.tangent).collect();
                let found = block.column(j).iter().copied().collect::<Vec<_>>();
                let size = size.max(block.amax());
                assert_close!(found, expected, DUAL, floor = size, "{}: {what}, column {j}", entry.name);
            }
        }
    });
}

#[test]
fn derivatives_of_forward_dynamics_follow_from_those_of_inverse_dynamics() {
    for_each_state(|name, robot, State { q, v, tau, .. }| {
        let a = robot.forward_dynamics(q, v, tau);
        let [dtau_dq, dtau_dv, M] = robot.inverse_dynamics_derivatives(q, v, &a);
        let [da_dq, da_dv, da_dtau] = robot.forward_dynamics_derivatives(q, v, tau);
        let solves = |what: &str, X: &Matrix, B: &Matrix| {
            let terms = (M.abs() * X.abs()).amax().max(M.amax());
            close(what, name, &(&M * X), B, ROUNDING, terms);
        };
        solves("M·∂a/∂q = −∂τ/∂q", &da_dq, &-dtau_dq);
        solves("M·∂a/∂v = −∂τ/∂v", &da_dv, &-dtau_dv);
        solves("M·∂a/∂τ = 1", &da_dtau, &Matrix::identity(q.len(), q.len()));
        let asymmetry = (&da_dtau - da_dtau.transpose()).amax();
        assert!(asymmetry <= ROUNDING * da_dtau.amax(), "{name}: M⁻¹ is symmetric");
    });
}

#[test]
fn derivatives_of_forward_dynamics_are_those_of_dual_numbers() {
    for_each_dual_state(|entry, robot, dual, State { q, v, a, tau }| {
        let [da_dq, da_dv, da_dtau] = robot.forward_dynamics_derivatives(q, v, tau);
        // All directions at once: q along v, v along a, τ along itself.
        let moving = dual.forward_dynamics(&Dual::moving(q, v), &Dual::moving(v, a), &Dual::moving(tau, tau));
        let found = &da_dq * v + &da_dv * a + &da_dtau * tau;
        let expected: Vec<f64> = moving.iter().map(|a| a.tangent).collect();
        let values = robot.mass_matrix(q).symmetric_eigenvalues();
        let tolerance = DUAL.max(8.0 * f64::EPSILON * values.max() / values.min());
        let terms = (da_dq.abs() * v.abs() + da_dv.abs() * a.abs() + da_dtau.abs() * tau.abs()).amax();
        assert_close!(found.as_slice(), expected, tolerance, floor = terms, "{}: ȧ", entry.name);
    });
}

/// `J·v` is the velocity of the frame: `Rᵀṗ` and the vector of `RᵀṘ` in its own axes, `ṗ` and that of `ṘRᵀ` in the
/// world's.
#[test]
fn jacobians_are_the_velocities_of_poses() {
    for_each_dual_state(|entry, robot, dual, State { q, v, .. }| {
        for (k, frame) in entry.body_names.iter().enumerate() {
            let (rotation, translation) = dual.pose(k, &Dual::moving(q, v));
            let (R, R_dot) = (rotation.map(|x| x.value), tangents(&rotation));
            let p_dot = translation.map(|x| x.tangent);
            let R_T = R.transpose();
            let body = [(&R_T * &p_dot).as_slice(), &axis_of(&(&R_T * &R_dot))].concat();
            let world = [p_dot.as_slice(), &axis_of(&(R_dot * R_T))].concat();
            let name = entry.name;
            let found = robot.jacobian(k, Axes::Own, q) * v;
            assert_close!(found.as_slice(), body, ROUNDING, floor = v.amax(), "{name}: velocity of {frame}");
            let found = robot.jacobian(k, Axes::World, q) * v;
            assert_close!(
                found.as_slice(),
                world,
                ROUNDING,
                floor = v.amax(),
                "{name}: world velocity of {frame}"
            );
        }
    });
}

/// `ω` of `ω̂`.
fn axis_of(skew: &Matrix) -> [f64; 3] {
    [skew[(2, 1)], skew[(0, 2)], skew[(1, 0)]]
}

#[test]
fn poses_are_rigid() {
    for_each_state(|name, robot, State { q, .. }| {
        for (k, frame) in robot.frame_names().iter().enumerate() {
            let (R, _) = robot.pose(k, q);
            let identity = Matrix::identity(3, 3);
            assert_close!(
                (R.transpose() * &R).as_slice(),
                identity.as_slice(),
                ROUNDING,
                "{name}: RᵀR of {frame}"
            );
            assert!((R.determinant() - 1.0).abs() <= ROUNDING, "{name}: {frame} is mirrored");
        }
    });
}

#[test]
fn bundles_equal_their_parts() {
    for_each_state(|name, robot, State { q, v, .. }| {
        let (M, C, G) = robot.equations_of_motion(q, v);
        let size = M.amax();
        close("M", name, &M, &robot.mass_matrix(q), ROUNDING, 0.0);
        close("C", name, &C, &robot.coriolis_matrix(q, v), ROUNDING, size);
        assert_close!(G.as_slice(), robot.gravity_forces(q).as_slice(), ROUNDING, floor = size, "{name}: G");
    });
}

#[test]
fn prepared_companions_compute_the_same_bits() {
    for (entry, Forms { robot, prepared }) in zoo::in_double() {
        for State { q, v, a, tau } in entry.states(4) {
            let name = entry.name;
            assert_eq!(robot.equations_of_motion(&q, &v), prepared.equations_of_motion(&q, &v), "{name}");
            assert_eq!(robot.mass_matrix(&q), prepared.mass_matrix(&q), "{name}");
            assert_eq!(robot.coriolis_matrix(&q, &v), prepared.coriolis_matrix(&q, &v), "{name}");
            assert_eq!(robot.gravity_forces(&q), prepared.gravity_forces(&q), "{name}");
            assert_eq!(robot.bias_forces(&q, &v), prepared.bias_forces(&q, &v), "{name}");
            assert_eq!(robot.inverse_dynamics(&q, &v, &a), prepared.inverse_dynamics(&q, &v, &a), "{name}");
            assert_eq!(
                robot.forward_dynamics(&q, &v, &tau),
                prepared.forward_dynamics(&q, &v, &tau),
                "{name}"
            );
            assert_eq!(robot.lagrangian(&q, &v), prepared.lagrangian(&q, &v), "{name}");
            let derivatives = robot.inverse_dynamics_derivatives(&q, &v, &a);
            assert_eq!(derivatives, prepared.inverse_dynamics_derivatives(&q, &v, &a), "{name}");
            let derivatives = robot.forward_dynamics_derivatives(&q, &v, &tau);
            assert_eq!(derivatives, prepared.forward_dynamics_derivatives(&q, &v, &tau), "{name}");
            assert_eq!(robot.linearize(&q, &v, &tau), prepared.linearize(&q, &v, &tau), "{name}");
            assert_eq!(robot.frame_names(), prepared.frame_names(), "{name}");
            for frame in 0..entry.body_names.len() {
                assert_eq!(robot.pose(frame, &q), prepared.pose(frame, &q), "{name}");
                assert_eq!(robot.jacobian(frame, Axes::Own, &q), prepared.jacobian(frame, Axes::Own, &q), "{name}");
                assert_eq!(robot.jacobian(frame, Axes::World, &q), prepared.jacobian(frame, Axes::World, &q), "{name}");
            }
        }
    }
}

/// `A = [0 1; ∂a/∂q ∂a/∂v]`, `B = [0; M⁻¹]`, and the drift is where the state goes.
#[test]
fn linearisation_is_made_of_the_derivatives() {
    for_each_state(|name, robot, State { q, v, tau, .. }| {
        let n = q.len();
        let [da_dq, da_dv, da_dtau] = robot.forward_dynamics_derivatives(q, v, tau);
        let (A, B, drift) = robot.linearize(q, v, tau);
        let block = |m: &Matrix, i, j| m.view((i * n, j * n), (n, n)).into_owned();
        assert_eq!(block(&A, 0, 0), Matrix::zeros(n, n), "{name}");
        assert_eq!(block(&A, 0, 1), Matrix::identity(n, n), "{name}");
        assert_eq!((block(&A, 1, 0), block(&A, 1, 1)), (da_dq, da_dv), "{name}");
        assert_eq!((block(&B, 0, 0), block(&B, 1, 0)), (Matrix::zeros(n, n), da_dtau), "{name}");
        let expected = [v.as_slice(), robot.forward_dynamics(q, v, tau).as_slice()].concat();
        assert_eq!(drift.as_slice(), expected, "{name}");
    });
}

#[test]
fn what_is_not_finite_comes_out_as_such_and_never_panics() {
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        let State { q, v, tau, .. } = &entry.states(1)[0];
        assert!(robot.try_forward_dynamics(q, v, tau).is_ok(), "{}", entry.name);
        for bad in [f64::NAN, f64::INFINITY] {
            let broken = Vector::from_element(entry.n, bad);
            assert!(robot.try_forward_dynamics(&broken, v, tau).is_err(), "{}", entry.name);
            let a = robot.forward_dynamics(q, v, &broken);
            assert!(!largest(a.as_slice()).is_finite(), "{}: τ is {bad}, a is {a}", entry.name);
            let _ = robot.inverse_dynamics_derivatives(&broken, &broken, &broken);
            let _ = robot.forward_dynamics_derivatives(&broken, &broken, &broken);
        }
    }
}

/// The sine's range is the coordinate's: an axis that stands oblique to its neighbours adds nothing to the angle
/// before it is reduced. Rodrigues' formula for one turn after the other, at a hundred thousand radians.
#[test]
fn oblique_axes_keep_the_accuracy_of_the_sine() {
    use dynamics_core::prelude::*;

    #[derive(Dynamics)]
    #[joint(j: revolute([1, 2, 3]), world -> b)]
    #[body(b, com = [0.3, 0.1, 0.1], solid = cuboid(1kg, [0.2, 0.1, 0.1]))]
    #[joint(k: revolute([3, -1, 2]), b -> c, at = [0.5, 0, 0])]
    #[body(c, com = [0.3, 0.1, 0.1], solid = cuboid(1kg, [0.2, 0.1, 0.1]))]
    struct Oblique;

    /// Some ten roundings of entries no larger than one.
    const TOLERANCE: f64 = 1e-15;
    let turn = |axis: [f64; 3], angle: f64| {
        let k = nalgebra::Vector3::from(axis).normalize();
        let hat = k.cross_matrix();
        nalgebra::Matrix3::identity() + hat * angle.sin() + hat * hat * (1.0 - angle.cos())
    };
    for q in [[0.4, -1.0], [99_999.1, 77_777.7], [-1e6, 1e9]] {
        let expected = turn([1.0, 2.0, 3.0], q[0]) * turn([3.0, -1.0, 2.0], q[1]);
        let pose = Oblique.pose::<oblique_frames::C>(&SVector::from(q));
        let miss = (pose.rotation - expected).amax();
        assert!(miss < TOLERANCE, "{q:?}: {miss:e}");
    }
}
