//! The robot as a whole: its mass, its centre of mass, and the momentum about it.

use dynamics_tests::close::{DIFFERENCES, ROUNDING};
use dynamics_tests::roads::travel;
use dynamics_tests::{Forms, Matrix, State, Vector, assert_close, zoo};

use crate::{
    STATES, close, difference, for_each_dual_state, for_each_state, jacobian_by_differences, moving,
};

/// Some thousand operations, and a mass matrix with a condition of some hundreds.
const FLIGHT: f64 = 1e-10;

#[test]
fn the_jacobian_of_the_center_of_mass_is_its_derivative() {
    for_each_state(|name, robot, State { q, v, .. }| {
        let found = robot.center_of_mass_jacobian(q);
        let n = v.len();
        let expected = jacobian_by_differences(n, |delta| robot.center_of_mass(&robot.integrate(q, delta)));
        close("J of the centre of mass", name, &found, &expected, DIFFERENCES, 1.0);
    });
    for_each_dual_state(|entry, robot, dual, State { q, v, .. }| {
        let found = robot.center_of_mass_jacobian(q) * v;
        let moving = dual.center_of_mass(&moving(entry, q, v));
        let expected: Vec<f64> = moving.iter().map(|x| x.tangent).collect();
        assert_close!(found.as_slice(), expected, ROUNDING, floor = v.amax(), "{}: ċ", entry.name);
    });
}

#[test]
fn momentum_is_linear_in_the_speeds_and_its_linear_half_is_that_of_the_center_of_mass() {
    for_each_state(|name, robot, State { q, v, .. }| {
        let (A, mass) = (robot.centroidal_momentum_matrix(q), robot.total_mass());
        let (momentum, product) = (robot.centroidal_momentum(q, v), &A * v);
        let size = A.amax() * v.amax();
        assert_close!(momentum.as_slice(), product.as_slice(), ROUNDING, floor = size, "{name}: h = A·v");
        let linear = robot.center_of_mass_jacobian(q) * mass;
        close("m·J", name, &A.rows(0, 3).into_owned(), &linear, ROUNDING, A.amax());
    });
}

/// `V = −m·gᵀc` up to a constant, and `G = −m·Jᵀg`: weight acts at the centre of mass. Potentials of their own act elsewhere.
#[test]
fn weight_acts_at_the_center_of_mass() {
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        if entry.source.contains("#[potential(") {
            continue;
        }
        let gravity = travel(&entry, |roads| Vector::from_column_slice(&roads.tree.gravity.0));
        let weight = gravity * robot.total_mass();
        let states = entry.states(STATES);
        let energy = |q: &Vector| robot.potential_energy(q) + weight.dot(&robot.center_of_mass(q));
        let constant = energy(&states[0].q);
        for State { q, .. } in &states {
            let (name, size) = (entry.name, weight.amax().max(constant.abs()));
            assert_close!([energy(q)], [constant], ROUNDING, floor = size, "{name}: V + m·gᵀc");
            let (found, G) = (robot.center_of_mass_jacobian(q).tr_mul(&-&weight), robot.gravity_forces(q));
            assert_close!(found.as_slice(), G.as_slice(), ROUNDING, floor = size, "{name}: −m·Jᵀg");
        }
    }
}

/// The kinetic energy is that of the centre of mass and one about it: `vᵀMv ≥ m|ċ|²`.
#[test]
fn no_energy_is_less_than_that_of_the_center_of_mass() {
    for_each_state(|name, robot, State { q, v, .. }| {
        let linear = robot.centroidal_momentum(q, v).rows(0, 3).into_owned();
        let least = linear.norm_squared() / (2.0 * robot.total_mass());
        let energy = robot.kinetic_energy(q, v);
        assert!(least <= energy * (1.0 + ROUNDING), "{name}: {energy} J are less than {least} J");
    });
}

/// The momentum of what nothing holds changes by weight alone, whatever its joints do: `ḣ = (m·g, 0)`.
#[test]
fn what_flies_changes_its_momentum_by_weight_alone() {
    let flies = ["FreeBox", "Hyq"];
    for (entry, Forms { robot, .. }) in zoo::in_double().filter(|(entry, _)| flies.contains(&entry.name)) {
        for State { q, v, tau, .. } in entry.states(STATES) {
            // Motors push the joints behind the first six speeds, and no one the body.
            let inner = Vector::from_fn(tau.len(), |k, _| if k < 6 { 0.0 } else { tau[k] });
            let a = robot.forward_dynamics(&q, &v, &inner);
            let found = difference(|t| {
                let q = robot.integrate(&q, &(&v * t + &a * (t * t / 2.0)));
                robot.centroidal_momentum(&q, &(&v + &a * t))
            });
            let weight = [0.0, 0.0, -9.81 * robot.total_mass(), 0.0, 0.0, 0.0];
            let A = robot.centroidal_momentum_matrix(&q);
            let size = (A.abs() * (a.abs() + v.abs() * v.amax())).amax();
            assert_close!(found.as_slice(), weight, DIFFERENCES, floor = size, "{}: ḣ", entry.name);
        }
    }
}

/// The same with a wrench on it: the rate of momentum is the external force, about the centre of mass.
#[test]
fn a_wrench_on_a_body_is_the_rate_of_momentum() {
    let (entry, Forms { robot, .. }) =
        zoo::in_double().find(|(entry, _)| entry.name == "Hyq").expect("it is in the zoo");
    let foot = entry.body_names.iter().position(|name| *name == "lf_foot").expect("it has four");
    for State { q, v, tau, .. } in entry.states(8) {
        let force = tau.rows(0, 3) * 2.0;
        let wrench = Vector::from_fn(6, |k, _| if k < 3 { force[k] } else { 0.0 });
        let external = robot.external_forces(foot, dynamics_tests::Axes::World, &q, &wrench);
        let a = robot.forward_dynamics(&q, &v, &external);
        let found = difference(|t| {
            let q = robot.integrate(&q, &(&v * t + &a * (t * t / 2.0)));
            robot.centroidal_momentum(&q, &(&v + &a * t))
        });
        let arm = robot.pose(foot, &q).1 - robot.center_of_mass(&q);
        let mut expected = wrench.clone();
        expected[2] -= 9.81 * robot.total_mass();
        expected.rows_mut(3, 3).copy_from(&arm.cross(&force));
        let A = robot.centroidal_momentum_matrix(&q);
        let size = (A.abs() * (a.abs() + v.abs() * v.amax())).amax();
        assert_close!(found.as_slice(), expected.as_slice(), DIFFERENCES, floor = size, "{}: ḣ", entry.name);
    }
}

/// Galileo: neither where a robot is that nothing holds, nor which way up, nor how fast the whole goes, is felt in a joint;
/// and of what the derivatives say of it nothing is rounded.
#[test]
fn no_joint_feels_how_the_whole_moves() {
    let flies = ["FreeBox", "Hyq"];
    for (entry, Forms { robot, .. }) in zoo::in_double().filter(|(entry, _)| flies.contains(&entry.name)) {
        for State { q, v, tau, .. } in entry.states(STATES) {
            let a = robot.forward_dynamics(&q, &v, &tau);
            let (within, n) = (3..v.len(), v.len() - 3);
            let moved = Vector::from_fn(v.len(), |k, _| if k < 6 { tau[k] } else { 0.0 });
            let elsewhere = robot.forward_dynamics(&robot.integrate(&q, &moved), &v, &tau);
            let boost = Vector::from_fn(v.len(), |k, _| if k < 3 { tau[k] } else { 0.0 });
            let faster = robot.forward_dynamics(&q, &(&v + &boost), &tau);
            let size = a.amax() + v.amax() * (v.amax() + boost.amax());
            for found in [elsewhere, faster] {
                let (found, a) = (found.rows(3, n), a.rows(3, n));
                assert_close!(found.as_slice(), a.as_slice(), FLIGHT, floor = size, "{}: a", entry.name);
            }
            let [da_dq, da_dv, _] = robot.forward_dynamics_derivatives(&q, &v, &tau);
            for k in 0..3 {
                assert_eq!(da_dq.column(k).amax(), 0.0, "{}: by the place", entry.name);
                for (what, column) in [("attitude", da_dq.column(3 + k)), ("velocity", da_dv.column(k))] {
                    let felt = within.clone().any(|row| column[row] != 0.0);
                    assert!(!felt, "{}: by the {what}", entry.name);
                }
            }
        }
    }
}

/// Momentum puts in what energy takes out: `½ vᵀMv` of a free body whose joints are still is that of `h` and the
/// inertia in A.
#[test]
fn rigid_motion_has_the_energy_of_its_momentum() {
    for (entry, Forms { robot, .. }) in
        zoo::in_double().filter(|(entry, _)| ["FreeBox", "Hyq"].contains(&entry.name))
    {
        for State { q, v, .. } in entry.states(STATES) {
            let v = Vector::from_fn(v.len(), |k, _| if k < 6 { v[k] } else { 0.0 });
            let momentum = robot.centroidal_momentum(&q, &v);
            let inertia = rigid_inertia(&robot.centroidal_momentum_matrix(&q), &robot.pose(0, &q).0);
            let spin = robot.pose(0, &q).0 * v.rows(3, 3);
            let velocity = momentum.rows(0, 3) / robot.total_mass();
            let energy = (momentum.rows(0, 3).dot(&velocity) + spin.dot(&(&inertia * &spin))) / 2.0;
            assert_close!([energy], [robot.kinetic_energy(&q, &v)], ROUNDING, "{}: T", entry.name);
        }
    }
}

/// The inertia about the centre of mass in world axes: what the momentum answers to a body's angular velocity.
fn rigid_inertia(A: &Matrix, R: &Matrix) -> Matrix {
    A.view((3, 3), (3, 3)) * R.transpose()
}
