//! The equation of motion, its parts, and the energies behind it.

use dynamics_tests::close::{DIFFERENCES, ROUNDING, largest};
use dynamics_tests::{Dual, Forms, Matrix, State, Vector, assert_close, zoo};

use crate::{
    close, difference, flat, for_each_dual_state, for_each_state, forces, jacobian_by_differences, moving,
    tangents, unit,
};

#[test]
fn mass_matrix_is_symmetric_and_positive_definite() {
    for_each_state(|name, robot, State { q, .. }| {
        let M = robot.mass_matrix(q);
        assert_eq!(M, M.transpose(), "{name}: both halves are one computation");
        let smallest = M.clone().symmetric_eigenvalues().min();
        assert!(smallest > 0.0, "{name}: the smallest eigenvalue of M is {smallest}");
    });
}

/// By the residual: the entries of `M⁻¹` may differ by the condition of M.
#[test]
fn inverse_mass_matrix_is_the_inverse() {
    for_each_state(|name, robot, State { q, v, tau, .. }| {
        let (M, inverse) = (robot.mass_matrix(q), robot.inverse_mass_matrix(q));
        let terms = (M.abs() * inverse.abs()).amax();
        close("M·M⁻¹", name, &(&M * &inverse), &Matrix::identity(v.len(), v.len()), ROUNDING, terms);
        let asymmetry = (&inverse - inverse.transpose()).amax();
        assert!(asymmetry <= ROUNDING * inverse.amax(), "{name}: M⁻¹ is symmetric");
        let [_, _, da_dtau] = robot.forward_dynamics_derivatives(q, v, tau);
        let values = M.clone().symmetric_eigenvalues();
        let tolerance = ROUNDING.max(8.0 * f64::EPSILON * values.max() / values.min());
        close("M⁻¹ = ∂a/∂τ", name, &inverse, &da_dtau, tolerance, 0.0);
    });
}

/// `Ṁ − 2C` is skew-symmetric: the Coriolis forces do no work of their own.
#[test]
fn mass_matrix_changes_by_the_coriolis_matrix() {
    for_each_state(|name, robot, State { q, v, .. }| {
        let (M, C) = (robot.mass_matrix(q), robot.coriolis_matrix(q, v));
        let M_dot = difference(|h| flat(&robot.mass_matrix(&robot.integrate(q, &(v * h)))));
        let M_dot = Matrix::from_column_slice(v.len(), v.len(), M_dot.as_slice());
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
        let M = dual.mass_matrix(&moving(entry, q, v));
        let size = M.map(|x| x.value).amax();
        close("Ṁ", entry.name, &tangents(&M), &(&C + C.transpose()), ROUNDING, size);
    });
}

/// With `Ṁ = C + Cᵀ` this makes C the one of Levi-Civita: it has no torsion, `C(v)·w − C(w)·v = M·[v, w]`. Between
/// joints of one degree of freedom the bracket is zero, and C is the matrix of Christoffel symbols.
#[test]
fn coriolis_matrix_has_no_torsion() {
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        for State { q, v, a: w, .. } in entry.states(crate::STATES) {
            let (along_v, along_w) = (robot.coriolis_matrix(&q, &v), robot.coriolis_matrix(&q, &w));
            let M = robot.mass_matrix(&q);
            let torsion = &along_v * &w - &along_w * &v;
            let expected = &M * entry.space.bracket(&v, &w);
            let size = along_v.amax() * w.amax() + along_w.amax() * v.amax() + M.amax();
            assert_close!(
                torsion.as_slice(),
                expected.as_slice(),
                ROUNDING,
                floor = size,
                "{}: torsion",
                entry.name
            );
        }
    }
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

/// `G = ∂V/∂q`, and springs pull by the slope of their own energy.
#[test]
fn gravity_and_springs_pull_down_the_slopes_of_their_energies() {
    for_each_dual_state(|entry, robot, dual, State { q, v, .. }| {
        let (n, name) = (v.len(), entry.name);
        let size = robot.mass_matrix(q).amax();
        let slopes = |energy: &dyn Fn(&Vector<Dual>) -> Dual| {
            (0..n).map(|j| energy(&moving(entry, q, &unit(n, j))).tangent).collect::<Vec<f64>>()
        };
        let found = robot.gravity_forces(q);
        let slope = slopes(&|q| dual.potential_energy(q));
        assert_close!(found.as_slice(), slope, ROUNDING, floor = size, "{name}: G = ∂V/∂q");
        let at_rest = robot.passive_forces(q, &Vector::zeros(n));
        let slope = slopes(&|q| dual.elastic_energy(q));
        assert_close!(at_rest.as_slice(), slope, ROUNDING, floor = size, "{name}: springs");
    });
}

#[test]
fn gravity_and_springs_agree_with_differences_of_their_energies() {
    for_each_state(|name, robot, State { q, v, .. }| {
        let n = v.len();
        let (G, springs) = (robot.gravity_forces(q), robot.passive_forces(q, &Vector::zeros(n)));
        let slopes = jacobian_by_differences(n, |delta| {
            let q = robot.integrate(q, delta);
            Vector::from_column_slice(&[robot.potential_energy(&q), robot.elastic_energy(&q)])
        });
        let energies = robot.potential_energy(q).abs() + robot.elastic_energy(q);
        let size = energies.max(robot.mass_matrix(q).amax());
        let found = Matrix::from_columns(&[G, springs]).transpose();
        close("G and springs", name, &found, &slopes, DIFFERENCES, size);
    });
}

/// Dampers and friction take energy: `vᵀ·(passive forces − springs) ≥ 0`, and it is what the robots are known for.
#[test]
fn passive_forces_take_energy() {
    let mut braked = vec![];
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        for State { q, v, .. } in entry.states(crate::STATES) {
            let springs = robot.passive_forces(&q, &Vector::zeros(v.len()));
            let taken = v.dot(&(robot.passive_forces(&q, &v) - springs));
            assert!(taken >= 0.0, "{}: {taken} W come from nowhere", entry.name);
            if taken > 0.0 && !braked.contains(&entry.name) {
                braked.push(entry.name);
            }
        }
    }
    let of_terms = ["OnASpring", "Tethered", "CoupledArms"];
    let of_joints = ["Gripper", "DrivenArm", "Sprung", "CartWithMotor"];
    assert_eq!(braked, [&of_joints[..], &of_terms, &["LoadedScara"]].concat());
}

#[test]
fn inverse_dynamics_is_the_sum_of_its_parts() {
    for_each_state(|name, robot, state| {
        let State { q, v, a, .. } = state;
        let (M, C, G) = (robot.mass_matrix(q), robot.coriolis_matrix(q, v), robot.gravity_forces(q));
        let terms = forces(robot, state);
        let h = robot.bias_forces(q, v);
        let sum = &C * v + &G + robot.passive_forces(q, v);
        assert_close!(h.as_slice(), sum.as_slice(), ROUNDING, floor = terms, "{name}: h = C·v + G + passive");
        let (tau, sum) = (robot.inverse_dynamics(q, v, a), &M * a + h);
        assert_close!(tau.as_slice(), sum.as_slice(), ROUNDING, floor = terms, "{name}: τ = M·a + h");
        let rest = Vector::zeros(v.len());
        let held = robot.inverse_dynamics(q, &rest, &rest) - robot.passive_forces(q, &rest);
        assert_close!(held.as_slice(), G.as_slice(), ROUNDING, floor = terms, "{name}: G holds it still");
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

/// `vᵀτ = d(T + V + U)/dt` + what dampers and friction take.
#[test]
fn power_in_is_energy_gained() {
    for_each_dual_state(|entry, robot, dual, state| {
        let State { q, v, a, .. } = state;
        let (moving, speeding) = (moving(entry, q, v), Dual::moving(v, a));
        let gained = dual.kinetic_energy(&moving, &speeding)
            + dual.potential_energy(&moving)
            + dual.elastic_energy(&moving);
        let braking = robot.passive_forces(q, v) - robot.passive_forces(q, &Vector::zeros(v.len()));
        let tau = robot.inverse_dynamics(q, v, a);
        let terms = v.abs().sum() * forces(robot, state);
        let found = v.dot(&(tau - braking));
        assert_close!([found], [gained.tangent], ROUNDING, floor = terms, "{}: power", entry.name);
    });
}

#[test]
fn power_in_is_energy_gained_by_differences() {
    for_each_state(|name, robot, state| {
        let State { q, v, a, .. } = state;
        let energy = |t: f64| {
            let (q, v) = (robot.integrate(q, &(v * t + a * (t * t / 2.0))), v + a * t);
            robot.kinetic_energy(&q, &v) + robot.potential_energy(&q) + robot.elastic_energy(&q)
        };
        let gained = difference(|t| Vector::from_element(1, energy(t)));
        let braking = robot.passive_forces(q, v) - robot.passive_forces(q, &Vector::zeros(v.len()));
        let tau = robot.inverse_dynamics(q, v, a);
        let terms = v.abs().sum() * forces(robot, state) + energy(0.0).abs();
        let found = v.dot(&(tau - braking));
        assert_close!([found], gained.as_slice(), DIFFERENCES, floor = terms, "{name}: power");
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

/// What is solved for is compared by the residual: the entries may differ by the condition of M.
#[test]
fn values_with_their_derivatives_equal_their_parts() {
    for_each_state(|name, robot, state| {
        let State { q, v, a, tau } = state;
        let (forces_of_a, derivatives) = robot.inverse_dynamics_with_derivatives([q, v, a]);
        let expected = robot.inverse_dynamics(q, v, a);
        let size = forces(robot, state);
        assert_close!(forces_of_a.as_slice(), expected.as_slice(), ROUNDING, floor = size, "{name}: τ");
        for (block, alone) in derivatives.iter().zip(&robot.inverse_dynamics_derivatives(q, v, a)) {
            close("∂τ", name, block, alone, ROUNDING, size);
        }

        let (a_of_tau, derivatives) = robot.forward_dynamics_with_derivatives([q, v, tau]);
        let (M, h) = (robot.mass_matrix(q), robot.bias_forces(q, v));
        let terms = (M.abs() * a_of_tau.abs()).amax().max(tau.amax()).max(h.amax()).max(size);
        let found = &M * &a_of_tau + h;
        assert_close!(found.as_slice(), tau.as_slice(), ROUNDING, floor = terms, "{name}: M·a + h = τ");
        for (block, alone) in derivatives.iter().zip(&robot.forward_dynamics_derivatives(q, v, tau)) {
            let terms = (M.abs() * block.abs()).amax().max(M.amax());
            close("M·∂a", name, &(&M * block), &(&M * alone), ROUNDING, terms);
        }
    });
}

#[test]
fn prepared_companions_compute_the_same_bits() {
    for (entry, Forms { robot, prepared }) in zoo::in_double() {
        for State { q, v, a, tau } in entry.states(4) {
            let name = entry.name;
            let (q, v, a, tau) = (&q, &v, &a, &tau);
            macro_rules! same {
                ($method:ident($($argument:expr),*)) => {
                    assert_eq!(robot.$method($($argument),*), prepared.$method($($argument),*), "{name}")
                };
            }
            same!(equations_of_motion(q, v));
            same!(mass_matrix(q));
            same!(inverse_mass_matrix(q));
            same!(coriolis_matrix(q, v));
            same!(gravity_forces(q));
            same!(passive_forces(q, v));
            same!(bias_forces(q, v));
            same!(inverse_dynamics(q, v, a));
            same!(forward_dynamics(q, v, tau));
            same!(lagrangian(q, v));
            same!(elastic_energy(q));
            same!(inverse_dynamics_derivatives(q, v, a));
            same!(forward_dynamics_derivatives(q, v, tau));
            same!(inverse_dynamics_with_derivatives([q, v, a]));
            same!(forward_dynamics_with_derivatives([q, v, tau]));
            same!(linearize(q, v, &tau.rows(0, robot.input_map().ncols()).into_owned()));
            same!(total_mass());
            same!(center_of_mass(q));
            same!(center_of_mass_jacobian(q));
            same!(centroidal_momentum(q, v));
            same!(centroidal_momentum_matrix(q));
            same!(regressor(q, v, a));
            same!(inertial_parameters());
            same!(base_regressor(q, v, a));
            same!(base_parameters());
            same!(integrate(q, v));
            same!(difference(q, &robot.neutral()));
            same!(neutral());
            same!(input_map());
            same!(tangent_rate(v));
            same!(frame_names());
            for frame in 0..entry.body_names.len() {
                same!(pose(frame, q));
                for axes in dynamics_tests::Axes::BOTH {
                    same!(jacobian(frame, axes, q));
                    same!(velocity(frame, axes, q, v));
                    same!(acceleration(frame, axes, [q, v, a]));
                    same!(bias_acceleration(frame, axes, q, v));
                }
            }
        }
    }
}

#[test]
fn what_is_not_finite_comes_out_as_such_and_never_panics() {
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        let State { q, v, tau, .. } = &entry.states(1)[0];
        assert!(robot.try_forward_dynamics(q, v, tau).is_ok(), "{}", entry.name);
        for bad in [f64::NAN, f64::INFINITY] {
            let (broken_q, broken) = (Vector::from_element(q.len(), bad), Vector::from_element(v.len(), bad));
            assert!(robot.try_forward_dynamics(&broken_q, v, tau).is_err(), "{}", entry.name);
            let a = robot.forward_dynamics(q, v, &broken);
            assert!(!largest(a.as_slice()).is_finite(), "{}: τ is {bad}, a is {a}", entry.name);
            let _ = robot.inverse_dynamics_derivatives(&broken_q, &broken, &broken);
            let _ = robot.forward_dynamics_derivatives(&broken_q, &broken, &broken);
            let _ = robot.regressor(&broken_q, &broken, &broken);
            let _ = robot.integrate(&broken_q, &broken);
            let _ = robot.difference(&broken_q, &broken_q);
        }
    }
}
