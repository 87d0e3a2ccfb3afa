//! The published robots agree with Pinocchio 4.1, whose numbers were cross-checked against three other tools: as
//! attributes and from their files, compiled and interpreted.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_codegen::mechanics::equations::Method;
use dynamics_core::prelude::*;
use dynamics_tests::close::{DERIVATIVES, ROUNDING};
use dynamics_tests::reference::{Order, Reference, ReferenceState};
use dynamics_tests::roads::travel;
use dynamics_tests::{Axes, Matrix, Robot, Vector, assert_close, zoo};

/// Of the quadruped, whose file has right angles with eleven digits, 5e-12 from right: three of them are behind each other.
const SNAPPED: f64 = 3e-11;

/// A robot, and what it has to agree with.
struct Subject {
    name: &'static str,
    /// The folder of the reference.
    folder: &'static str,
    /// The frame that the reference calls its tool.
    tool: &'static str,
    joint_names: &'static [&'static str],
    robot: Box<dyn Robot<f64>>,
}

/// What two roads to the numbers of a robot may differ by.
fn rounding(name: &str) -> f64 {
    if name == "Hyq" { SNAPPED } else { ROUNDING }
}

/// The robots of the zoo that a reference is about: folder, name, and tool.
const PAIRS: &[(&str, &str, &str)] = &[
    ("puma560", "Puma560", "tool"),
    ("puma560", "Puma560ByDh", "link6"),
    ("puma560_armature", "Puma560WithRotors", "tool"),
    ("iiwa14", "Iiwa14", "iiwa_link_ee"),
    ("scara", "Scara", "tool"),
    ("cartpole", "ReferenceCartPole", "tip"),
    ("double_pendulum", "Planar2Dof", "link2"),
    ("double_pendulum_continuous", "Planar2DofContinuous", "link2"),
    ("hyq", "Hyq", "rh_foot"),
];

fn subjects() -> Vec<Subject> {
    let of_zoo = PAIRS.iter().map(|&(folder, name, tool)| {
        let (entry, forms) =
            zoo::in_double().find(|(entry, _)| entry.name == name).expect("it is in the zoo");
        Subject { name, folder, tool, joint_names: entry.joint_names, robot: forms.robot }
    });
    of_zoo.chain(files::all()).collect()
}

/// The robots that are in the zoo by their attributes, from their files.
mod files {
    use super::*;

    macro_rules! robots {
        ($($(#[$options:meta])* $robot:ident = $folder:literal, $tool:path, $tool_name:literal;)+) => {
            $(
                /// A robot as its file has it.
                #[derive(Dynamics, Clone, Copy)]
                $(#[$options])*
                struct $robot;
            )+

            pub(super) fn all() -> Vec<Subject> {
                vec![$(Subject {
                    name: stringify!($robot),
                    folder: $folder,
                    tool: $tool_name,
                    joint_names: $robot::JOINT_NAMES,
                    robot: Box::new(dynamics_tests::specialised!([$tool] [$robot] f64, $robot)),
                }),+]
            }
        };
    }

    robots! {
        #[dynamics(urdf = "robots/puma560/model.urdf", allow(nonphysical_inertia))]
        PumaOfFile = "puma560", puma_of_file_frames::Tool, "tool";
        #[dynamics(urdf = "robots/iiwa14/model.urdf")]
        IiwaOfFile = "iiwa14", iiwa_of_file_frames::IiwaLinkEe, "iiwa_link_ee";
        #[dynamics(urdf = "robots/scara/model.urdf")]
        ScaraOfFile = "scara", scara_of_file_frames::Tool, "tool";
        #[dynamics(urdf = "robots/cartpole/model.urdf")]
        CartPoleOfFile = "cartpole", cart_pole_of_file_frames::Tip, "tip";
        #[dynamics(urdf = "robots/double_pendulum/model.urdf")]
        PendulumOfFile = "double_pendulum", pendulum_of_file_frames::Link2, "link2";
        #[dynamics(urdf = "robots/hyq/model.urdf", base = free, snap = off)]
        HyqAsWritten = "hyq", hyq_as_written_frames::RhFoot, "rh_foot";
        #[dynamics(urdf = "robots/double_pendulum_continuous/model.urdf")]
        EndlessOfFile = "double_pendulum_continuous", endless_of_file_frames::Link2, "link2";
    }
}

/// Runs `check` on each robot at each state of its reference.
fn for_each_state(check: impl Fn(&Subject, &Reference, &Order, &ReferenceState)) {
    for subject in subjects() {
        let reference = Reference::of(subject.folder);
        let order = reference.order(subject.joint_names);
        assert_eq!(reference.states.len(), 10, "{}", subject.folder);
        for state in &reference.states {
            check(&subject, &reference, &order, state);
        }
    }
}

#[test]
fn forces_and_energies_agree() {
    for_each_state(|Subject { name, robot, .. }, _, order, state| {
        let q = order.coordinates(&state.vector("q"));
        let speeds = |name: &str| order.speeds(&state.vector(name));
        let [v, a] = ["v", "a"].map(speeds);
        let close = |what: &str, found: &[f64], expected: &[f64], floor: f64| {
            assert_close!(found, expected, rounding(name), floor = floor, "{name}: {what}");
        };
        let (M, C) = (order.matrix(&state.matrix("M")), order.matrix(&state.matrix("C")));
        close("M", robot.mass_matrix(&q).as_slice(), M.as_slice(), 0.0);
        let found = robot.coriolis_matrix(&q, &v);
        close("C", found.as_slice(), C.as_slice(), 0.0);
        // The rounding of C·v is that of its terms.
        let (terms, Cv) = (C.amax() * v.amax(), speeds("Cv"));
        close("C·v", (found * &v).as_slice(), Cv.as_slice(), terms);
        close("G", robot.gravity_forces(&q).as_slice(), speeds("g").as_slice(), 0.0);
        let h = Cv + speeds("g");
        close("h", robot.bias_forces(&q, &v).as_slice(), h.as_slice(), terms);
        close("τ", robot.inverse_dynamics(&q, &v, &a).as_slice(), speeds("tau").as_slice(), 0.0);
        close("T", &[robot.kinetic_energy(&q, &v)], &[state.number("kinetic_energy")], 0.0);
    });
}

/// Solving with M multiplies the rounding of both roads by the condition of M.
fn solving_tolerance(state: &ReferenceState, tolerance: f64) -> f64 {
    let values = state.matrix("M").symmetric_eigenvalues();
    tolerance.max(values.max() / values.min() * f64::EPSILON)
}

#[test]
fn accelerations_and_the_inverse_agree() {
    for_each_state(|Subject { name, robot, .. }, _, order, state| {
        let q = order.coordinates(&state.vector("q"));
        let [v, tau, a] = ["v", "tau2", "a_fd"].map(|name| order.speeds(&state.vector(name)));
        let tolerance = solving_tolerance(state, rounding(name));
        let found = robot.forward_dynamics(&q, &v, &tau);
        assert_close!(found.as_slice(), a.as_slice(), tolerance, "{name}: a");
        let inverse = order.matrix(&state.matrix("Minv"));
        let found = robot.inverse_mass_matrix(&q);
        assert_close!(found.as_slice(), inverse.as_slice(), tolerance, "{name}: M⁻¹");
    });
}

#[test]
fn potential_energies_agree_up_to_a_constant() {
    for Subject { name, folder, robot, joint_names, .. } in subjects() {
        let reference = Reference::of(folder);
        let order = reference.order(joint_names);
        let energy = |state: &ReferenceState| robot.potential_energy(&order.coordinates(&state.vector("q")));
        let found: Vec<f64> = reference.states.iter().map(energy).collect();
        let expected: Vec<f64> =
            reference.states.iter().map(|state| state.number("potential_energy")).collect();
        let constant = found[0] - expected[0];
        let expected: Vec<f64> = expected.iter().map(|energy| energy + constant).collect();
        assert_close!(found, expected, rounding(name), "{name}: V");
    }
}

#[test]
fn derivatives_agree() {
    for_each_state(|Subject { name, robot, .. }, _, order, state| {
        let q = order.coordinates(&state.vector("q"));
        let [v, a, tau] = ["v", "a", "tau2"].map(|name| order.speeds(&state.vector(name)));
        let (M, inverse) = (state.matrix("M"), state.matrix("Minv"));
        // At rest some blocks are zero. What counts as such: less than the forces for a unit of acceleration, and the
        // accelerations by these.
        let (force, acceleration) = (M.amax(), inverse.amax() * M.amax());
        let close = |found: &Matrix, expected: &str, tolerance, floor| {
            let matrix = order.matrix(&state.matrix(expected));
            assert_close!(
                found.as_slice(),
                matrix.as_slice(),
                tolerance,
                floor = floor,
                "{name}: {expected}"
            );
        };
        let [dtau_dq, dtau_dv, dtau_da] = robot.inverse_dynamics_derivatives(&q, &v, &a);
        close(&dtau_dq, "dtau_dq", DERIVATIVES, force);
        close(&dtau_dv, "dtau_dv", DERIVATIVES, force);
        close(&dtau_da, "M", rounding(name), 0.0);

        let [da_dq, da_dv, da_dtau] = robot.forward_dynamics_derivatives(&q, &v, &tau);
        close(&da_dq, "da_dq", DERIVATIVES, acceleration);
        close(&da_dv, "da_dv", DERIVATIVES, acceleration);
        close(&da_dtau, "Minv", DERIVATIVES, 0.0);
    });
}

#[test]
fn the_tool_is_where_it_should_be_and_moves_so() {
    for_each_state(|Subject { name, tool, robot, .. }, _, order, state| {
        let frame = robot.frame_names().iter().position(|frame| frame == tool).expect("the tool is a frame");
        let (q, v) = (order.coordinates(&state.vector("q")), order.speeds(&state.vector("v")));
        let ((rotation, translation), (R, p)) = (robot.pose(frame, &q), state.tool_pose());
        assert_close!(rotation.as_slice(), R.as_slice(), rounding(name), "{name}: rotation");
        assert_close!(translation.as_slice(), p.as_slice(), rounding(name), "{name}: translation");
        for (axes, named) in Axes::BOTH.into_iter().zip(["J_local", "J_lwa"]) {
            let J = order.columns(&state.tool_jacobian(named));
            let found = robot.jacobian(frame, axes, &q);
            assert_close!(found.as_slice(), J.as_slice(), rounding(name), "{name}: {named}");
            let (found, expected) = (robot.velocity(frame, axes, &q, &v), &J * &v);
            let size = J.amax() * v.amax();
            let (found, expected) = (found.as_slice(), expected.as_slice());
            assert_close!(found, expected, rounding(name), floor = size, "{name}: {named}·v");
        }
    });
}

/// The columns of bodies; behind them are those of joints, of which Pinocchio's regressor has none. The frames of Denavit
/// and Hartenberg's distal convention are not those of the joints, to which its parameters refer.
#[test]
fn regressors_and_parameters_agree() {
    for_each_state(|Subject { name, robot, .. }, reference, order, state| {
        if *name == "Puma560ByDh" {
            return;
        }
        let q = order.coordinates(&state.vector("q"));
        let [v, a] = ["v", "a"].map(|name| order.speeds(&state.vector(name)));
        let expected = order.regressor(&state.matrix("regressor"));
        let found = robot.regressor(&q, &v, &a).columns(0, expected.ncols()).into_owned();
        assert_close!(found.as_slice(), expected.as_slice(), rounding(name), "{name}: Y");
        let expected: Vec<f64> =
            order.joints.iter().flat_map(|&joint| reference.joints[joint].parameters).collect();
        let found = robot.inertial_parameters().rows(0, expected.len()).into_owned();
        assert_close!(found.as_slice(), expected, rounding(name), "{name}: π");
    });
}

/// The road of the command line: the same programs, without a compiler behind them.
#[test]
fn interpreted_programs_agree() {
    for &(folder, name, _) in PAIRS {
        let entry = zoo::all().into_iter().find(|entry| entry.name == name).expect("it is in the zoo");
        let reference = Reference::of(folder);
        let order = reference.order(entry.joint_names);
        travel(&entry, |roads| {
            let interpreter = roads.interpreter();
            for state in &reference.states {
                let q = order.coordinates(&state.vector("q"));
                let [v, a, tau] = ["v", "a", "tau2"].map(|name| order.speeds(&state.vector(name)));
                let at = dynamics_tests::State { q, v, a, tau };
                let agrees = |method: Method, expected: &Vector, tolerance: f64| {
                    let found = interpreter.run(method, &at).expect("it has a program");
                    let expected = expected.as_slice();
                    assert_close!(found, expected, tolerance, "{name}: {} interpreted", method.name());
                };
                let by_rows = |name: &str| {
                    let matrix = order.matrix(&state.matrix(name)).transpose();
                    Vector::from_column_slice(matrix.as_slice())
                };
                agrees(Method::MassMatrix, &by_rows("M"), rounding(name));
                agrees(Method::CoriolisMatrix, &by_rows("C"), rounding(name));
                agrees(Method::GravityForces, &order.speeds(&state.vector("g")), rounding(name));
                agrees(Method::InverseDynamics, &order.speeds(&state.vector("tau")), rounding(name));
                let solved = solving_tolerance(state, rounding(name));
                agrees(Method::ForwardDynamics, &order.speeds(&state.vector("a_fd")), solved);
            }
        });
    }
}
