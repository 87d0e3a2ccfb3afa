//! The published robots agree with Pinocchio 4.1, whose numbers were cross-checked against three other tools.

#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_tests::close::{DERIVATIVES, ROUNDING};
use dynamics_tests::reference::{Reference, ReferenceState};
use dynamics_tests::zoo::{self, industrial};
use dynamics_tests::{Matrix, Robot, assert_close};

/// The robots of the zoo that a reference file is about, and the frame that it calls its tool.
const PAIRS: &[(&str, &str, &str)] = &[
    ("puma560", "Puma560", "tool"),
    ("puma560", "Puma560ByDh", "link6"),
    ("iiwa14", "Iiwa14", "iiwa_link_ee"),
    ("scara", "Scara", "tool"),
    ("cartpole", "ReferenceCartPole", "tip"),
    ("double_pendulum", "Planar2Dof", "link2"),
    ("double_pendulum_continuous", "Planar2DofContinuous", "link2"),
];

/// Runs `check` on each robot at each state of its reference.
fn for_each_state(check: impl Fn(&str, &dyn Robot<f64>, &ReferenceState)) {
    for &(file, name, _) in PAIRS {
        let reference = Reference::of(file);
        let (_, forms) = zoo::in_double().find(|(entry, _)| entry.name == name).expect("it is in the zoo");
        for state in &reference.states {
            check(name, &*forms.robot, state);
        }
    }
}

#[test]
fn joints_have_the_names_and_the_order_of_the_reference() {
    for &(file, name, tool) in PAIRS {
        let reference = Reference::of(file);
        let entry = industrial::all().into_iter().find(|entry| entry.name == name).expect("it is in the zoo");
        assert_eq!(entry.joint_names, reference.joint_names, "{name}");
        assert_eq!(reference.states.len(), 10, "{file}");
        assert!(entry.body_names.contains(&tool), "{name} has {:?}", entry.body_names);
    }
}

#[test]
fn mass_matrices_agree() {
    for_each_state(|name, robot, state| {
        let found = robot.mass_matrix(&state.vector("q"));
        assert_close!(found.as_slice(), state.matrix("M").as_slice(), ROUNDING, "{name}: M");
    });
}

#[test]
fn coriolis_matrices_agree() {
    for_each_state(|name, robot, state| {
        let (q, v) = (state.vector("q"), state.vector("v"));
        let found = robot.coriolis_matrix(&q, &v);
        assert_close!(found.as_slice(), state.matrix("C").as_slice(), ROUNDING, "{name}: C");
        // The rounding of C·v is that of its terms.
        let terms = state.matrix("C").amax() * v.amax();
        assert_close!(
            (found * &v).as_slice(),
            state.vector("Cv").as_slice(),
            ROUNDING,
            floor = terms,
            "{name}: C·v"
        );
    });
}

#[test]
fn gravity_forces_agree() {
    for_each_state(|name, robot, state| {
        let found = robot.gravity_forces(&state.vector("q"));
        assert_close!(found.as_slice(), state.vector("g").as_slice(), ROUNDING, "{name}: G");
    });
}

#[test]
fn inverse_dynamics_agrees() {
    for_each_state(|name, robot, state| {
        let found = robot.inverse_dynamics(&state.vector("q"), &state.vector("v"), &state.vector("a"));
        assert_close!(found.as_slice(), state.vector("tau").as_slice(), ROUNDING, "{name}: τ");
    });
}

/// Solving with M multiplies the rounding of both roads by the condition of M.
fn condition(state: &ReferenceState) -> f64 {
    let mass_matrix = state.matrix("M");
    let values = mass_matrix.symmetric_eigenvalues();
    values.max() / values.min()
}

#[test]
fn forward_dynamics_agrees() {
    for_each_state(|name, robot, state| {
        let found = robot.forward_dynamics(&state.vector("q"), &state.vector("v"), &state.vector("tau2"));
        let tolerance = ROUNDING.max(condition(state) * f64::EPSILON);
        assert_close!(found.as_slice(), state.vector("a_fd").as_slice(), tolerance, "{name}: a");
    });
}

#[test]
fn energies_agree_and_potential_ones_up_to_a_constant() {
    for &(file, name, _) in PAIRS {
        let reference = Reference::of(file);
        let (_, forms) = zoo::in_double().find(|(entry, _)| entry.name == name).expect("it is in the zoo");
        let (mut found, mut expected) = (vec![], vec![]);
        for state in &reference.states {
            let (q, v) = (state.vector("q"), state.vector("v"));
            let kinetic = forms.robot.kinetic_energy(&q, &v);
            assert_close!([kinetic], [state.number("kinetic_energy")], ROUNDING, "{name}: T");
            found.push(forms.robot.potential_energy(&q));
            expected.push(state.number("potential_energy"));
        }
        let constant = found[0] - expected[0];
        let expected: Vec<f64> = expected.iter().map(|energy| energy + constant).collect();
        assert_close!(found, expected, ROUNDING, "{name}: V");
    }
}

#[test]
fn derivatives_agree() {
    for_each_state(|name, robot, state| {
        let [q, v, a, tau] = ["q", "v", "a", "tau2"].map(|name| state.vector(name));
        let (M, inverse) = (state.matrix("M"), state.matrix("Minv"));
        // At rest some blocks are zero. What counts as such: less than the forces for a unit of acceleration, and the
        // accelerations by these.
        let (force, acceleration) = (M.amax(), inverse.amax() * M.amax());
        let close = |found: &Matrix, expected: Matrix, tolerance, floor, what: &str| {
            assert_close!(found.as_slice(), expected.as_slice(), tolerance, floor = floor, "{name}: {what}");
        };
        let [dtau_dq, dtau_dv, dtau_da] = robot.inverse_dynamics_derivatives(&q, &v, &a);
        close(&dtau_dq, state.matrix("dtau_dq"), DERIVATIVES, force, "∂τ/∂q");
        close(&dtau_dv, state.matrix("dtau_dv"), DERIVATIVES, force, "∂τ/∂v");
        close(&dtau_da, M, ROUNDING, 0.0, "∂τ/∂a");

        let [da_dq, da_dv, da_dtau] = robot.forward_dynamics_derivatives(&q, &v, &tau);
        close(&da_dq, state.matrix("da_dq"), DERIVATIVES, acceleration, "∂a/∂q");
        close(&da_dv, state.matrix("da_dv"), DERIVATIVES, acceleration, "∂a/∂v");
        close(&da_dtau, inverse, DERIVATIVES, 0.0, "∂a/∂τ");
    });
}

#[test]
fn poses_and_jacobians_of_the_tool_agree() {
    for &(file, name, tool) in PAIRS {
        let reference = Reference::of(file);
        let (_, forms) = zoo::in_double().find(|(entry, _)| entry.name == name).expect("it is in the zoo");
        let robot = &*forms.robot;
        let frame = robot.frame_names().iter().position(|name| *name == tool).expect("the tool is a frame");
        for state in &reference.states {
            let q = state.vector("q");
            let ((rotation, translation), (R, p)) = (robot.pose(frame, &q), state.tool_pose());
            assert_close!(rotation.as_slice(), R.as_slice(), ROUNDING, "{name}: rotation");
            assert_close!(translation.as_slice(), p.as_slice(), ROUNDING, "{name}: translation");
            let (local, aligned) = (state.tool_jacobian("J_local"), state.tool_jacobian("J_lwa"));
            assert_close!(
                robot.jacobian(frame, Axes::Own, &q).as_slice(),
                local.as_slice(),
                ROUNDING,
                "{name}: J"
            );
            let world = robot.jacobian(frame, Axes::World, &q);
            assert_close!(world.as_slice(), aligned.as_slice(), ROUNDING, "{name}: J in world axes");
        }
    }
}
