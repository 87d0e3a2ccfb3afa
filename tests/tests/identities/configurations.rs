//! Configurations on their manifold: where motion leads, and what is between two of them.

use dynamics_core::Error;
use dynamics_tests::close::{DIFFERENCES, ROUNDING};
use dynamics_tests::{Forms, Matrix, Method, State, Vector, assert_close, zoo};

use crate::{STATES, close, difference, for_each_state, jacobian_by_differences, unit};

#[test]
fn the_zoo_knows_its_spaces() {
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        let neutral = robot.neutral();
        assert_eq!(neutral.len(), entry.space.coordinates(), "{}", entry.name);
        let mut expected = Vector::zeros(neutral.len());
        for at in entry.space.quaternions() {
            expected[at + 3] = 1.0;
        }
        assert_eq!(neutral, expected, "{}", entry.name);
        assert_eq!(robot.gravity_forces(&neutral).len(), entry.space.speeds(), "{}", entry.name);
    }
}

/// `d(q ⊕ t·v)/dt = q̇`
#[test]
fn integration_starts_along_the_velocity() {
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        for State { q, v, .. } in entry.states(STATES) {
            let found = difference(|t| robot.integrate(&q, &(&v * t)));
            let expected = entry.space.rate(&q, &v);
            let (found, expected) = (found.as_slice(), expected.as_slice());
            assert_close!(found, expected, DIFFERENCES, floor = 1.0, "{}: q̇", entry.name);
        }
    }
}

/// `(q ⊕ s·δ) ⊕ t·δ = q ⊕ (s + t)·δ`: what starts along δ and has this is the exponential.
#[test]
fn integration_goes_on_as_it_starts() {
    for_each_state(|name, robot, State { q, v, .. }| {
        let halfway = robot.integrate(&robot.integrate(q, &(v * 0.3)), &(v * 0.9));
        let (found, at_once) = (halfway.as_slice(), robot.integrate(q, &(v * 1.2)));
        assert_close!(found, at_once.as_slice(), ROUNDING, floor = 1.0, "{name}: q ⊕ δ");
        let stay = robot.integrate(q, &Vector::zeros(v.len()));
        assert_close!(stay.as_slice(), q.as_slice(), ROUNDING, floor = 1.0, "{name}: q ⊕ 0");
    });
}

/// `(q ⊕ δ) ⊖ q = δ`, as long as no body turns by more than half a turn: speeds are below 2, by √3.
#[test]
fn differences_undo_integration() {
    for_each_state(|name, robot, State { q, v, .. }| {
        let delta = v * 0.9;
        let found = robot.difference(q, &robot.integrate(q, &delta));
        // Rounding of q, which the logarithm of an angle close to π takes three times.
        assert_close!(found.as_slice(), delta.as_slice(), ROUNDING, floor = 1.0, "{name}: ⊖ undoes ⊕");
    });
}

/// Between any two configurations, over which both signs of a quaternion are one.
#[test]
fn integration_undoes_differences() {
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        let states = entry.states(STATES);
        for (from, to) in states.iter().zip(&states[1..]) {
            let mut found = robot.integrate(&from.q, &robot.difference(&from.q, &to.q));
            for at in entry.space.quaternions() {
                let same = found.rows(at, 4).dot(&to.q.rows(at, 4)).signum();
                found.rows_mut(at, 4).scale_mut(same);
            }
            let expected = to.q.as_slice();
            assert_close!(found.as_slice(), expected, ROUNDING, floor = 1.0, "{}: ⊕ undoes ⊖", entry.name);
        }
    }
}

/// `∂δ̇/∂δ` where `q = q₀ ⊕ δ` moves with the velocity v: one difference for the rate, and one of such rates.
#[test]
fn tangent_rates_agree_with_differences() {
    /// Two steps of a thousandth, whose squares times third derivatives are the error, and 1e-16/1e-6 of rounding.
    const TWICE: f64 = 1e-5;
    const STEP: f64 = 1e-3;
    for_each_state(|name, robot, State { q, v, .. }| {
        let n = v.len();
        let rate = |delta: &Vector| {
            let beside = robot.integrate(q, delta);
            let after = |t: f64| robot.difference(q, &robot.integrate(&beside, &(v * t)));
            (after(STEP) - after(-STEP)) / (2.0 * STEP)
        };
        let column = |j| (rate(&(unit(n, j) * STEP)) - rate(&(unit(n, j) * -STEP))) / (2.0 * STEP);
        let found = Matrix::from_columns(&(0..n).map(column).collect::<Vec<_>>());
        close("∂δ̇/∂δ", name, &robot.tangent_rate(v), &found, TWICE, 1.0);
    });
}

/// `δ̇` where `q ⊕ δ` moves with the velocity v, far from δ = 0; and forces that do the same work.
#[test]
fn rates_agree_with_differences() {
    /// A step of a thousandth, whose square times a third derivative is the error.
    const ONCE: f64 = 2e-5;
    const STEP: f64 = 1e-3;
    for_each_state(|name, robot, State { q, v, a, .. }| {
        let delta = a * (1.0 / a.amax().max(1.0));
        let beside = robot.integrate(q, &delta);
        let after = |t: f64| robot.difference(q, &robot.integrate(&beside, &(v * t)));
        let found = (after(STEP) - after(-STEP)) / (2.0 * STEP);
        let rate = robot.rate(&delta, v);
        assert_close!(rate.as_slice(), found.as_slice(), ONCE, floor = 1.0, "{name}: rate");
        let (work, same) = (rate.dot(a), v.dot(&robot.rate_transposed(&delta, a)));
        assert_close!([work], [same], ROUNDING, floor = a.norm() * v.norm(), "{name}: work of δ");
    });
}

#[test]
fn quaternions_of_another_length_are_reported_by_their_place() {
    let mut count = 0;
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        let State { q, v, tau, .. } = &entry.states(1)[0];
        assert_eq!(robot.check_configuration(q), Ok(()), "{}", entry.name);
        for index in entry.space.quaternions() {
            count += 1;
            let scaled = |factor: f64| {
                let mut q = q.clone();
                q.rows_mut(index, 4).scale_mut(factor);
                q
            };
            let error = Err(Error::NotUnitQuaternion { index });
            for factor in [0.0, 0.99, 1.01, -2.0, 1e200] {
                let q = scaled(factor);
                assert_eq!(robot.check_configuration(&q), error, "{}", entry.name);
                assert_eq!(
                    robot.try_forward_dynamics(&q, v, tau),
                    error.map(|()| v.clone()),
                    "{}",
                    entry.name
                );
                let run = robot.simulate((&q, v), 1e-3, 1, Method::Rk4).map(|_| ());
                assert_eq!(run, error, "{}", entry.name);
            }
            for factor in [-1.0, 1.0 - 1e-8, 1.0 + 1e-8] {
                assert_eq!(robot.check_configuration(&scaled(factor)), Ok(()), "{}", entry.name);
            }
        }
    }
    assert_eq!(count, 9, "free boxes, balls, hulls and quadrupeds of the zoo");
}

/// Both signs of a quaternion are one orientation: nothing that is asked of the robot tells them apart.
#[test]
fn the_sign_of_a_quaternion_does_not_matter() {
    for (entry, Forms { robot, .. }) in zoo::in_double().filter(|(entry, _)| !entry.space.is_flat()) {
        for State { q, v, a, .. } in entry.states(4) {
            let mut other = q.clone();
            for at in entry.space.quaternions() {
                other.rows_mut(at, 4).neg_mut();
            }
            assert_eq!(robot.mass_matrix(&q), robot.mass_matrix(&other), "{}", entry.name);
            let (tau, again) = (robot.inverse_dynamics(&q, &v, &a), robot.inverse_dynamics(&other, &v, &a));
            assert_eq!(tau, again, "{}", entry.name);
        }
    }
}

/// `B_u` has a column for each speed with a motor, and nothing else.
#[test]
fn inputs_are_the_speeds_with_motors() {
    let without = |name: &str| -> Vec<usize> {
        match name {
            "FreeBox" | "Hyq" | "Tethered" => (0..6).collect(),
            "TwoFreeBodies" => (7..13).collect(),
            "CartWithMotor" | "LoadedScara" => vec![1],
            _ => vec![],
        }
    };
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        let (n, without) = (entry.space.speeds(), without(entry.name));
        let columns: Vec<Vector> = (0..n).filter(|k| !without.contains(k)).map(|k| unit(n, k)).collect();
        let found = robot.input_map();
        assert_eq!(found.shape(), (n, columns.len()), "{}", entry.name);
        assert!(found.column_iter().zip(&columns).all(|(found, column)| found == *column), "{}", entry.name);
    }
}

/// A step of the integrators is one along the manifold: where the robot is, has unit quaternions after a thousand.
#[test]
fn simulations_stay_on_the_manifold() {
    for (entry, Forms { robot, .. }) in zoo::in_double().filter(|(entry, _)| !entry.space.is_flat()) {
        let State { q, v, .. } = &entry.states(1)[0];
        for by in [Method::Rk4, Method::SemiImplicitEuler] {
            let end = robot.simulate((q, v), 1e-3, 1000, by).expect("an unforced robot stays finite");
            for at in entry.space.quaternions() {
                let length = end.q.rows(at, 4).norm();
                assert!((length - 1.0).abs() < 1e-15 * 4.0, "{}: a length of {length}", entry.name);
            }
        }
    }
}

/// The Jacobian of `⊖` by its second argument at equal ones is the identity: δ are coordinates about `q`.
#[test]
fn differences_are_coordinates_about_a_configuration() {
    for_each_state(|name, robot, State { q, v, .. }| {
        let n = v.len();
        let found = jacobian_by_differences(n, |delta| robot.difference(q, &robot.integrate(q, delta)));
        close("∂(q ⊕ δ ⊖ q)/∂δ", name, &found, &Matrix::identity(n, n), DIFFERENCES, 1.0);
    });
}
