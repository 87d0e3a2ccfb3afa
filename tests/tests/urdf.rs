//! Robots from their files: what the derive makes of them, and of what is said beside them.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_core::prelude::*;
use dynamics_tests::assert_close;
use dynamics_tests::close::ROUNDING;
use dynamics_tests::reference::Reference;

/// The KUKA LBR iiwa 14.
#[derive(Dynamics)]
#[dynamics(urdf = "robots/iiwa14/model.urdf")]
struct Iiwa14;

/// Two links in a plane.
#[derive(Dynamics)]
#[dynamics(urdf = "robots/double_pendulum/model.urdf")]
struct DoublePendulum;

/// Every link is a frame, the root and bare ones too.
#[test]
fn links_are_frames() {
    assert_eq!(Iiwa14::BODY_NAMES.len(), 10, "{:?}", Iiwa14::BODY_NAMES);
    let reference = Reference::of("iiwa14");
    let order = reference.order(Iiwa14::JOINT_NAMES);
    for state in &reference.states {
        let q = order.coordinates(&state.vector("q"));
        let pose = Iiwa14.pose::<IiwaLinkEe>(&SVector::from_column_slice(q.as_slice()));
        let (R, p) = state.tool_pose();
        assert_close!(pose.rotation.as_slice(), R.as_slice(), ROUNDING, "rotation");
        assert_close!(pose.translation.as_slice(), p.as_slice(), ROUNDING, "translation");
    }
    let limits = Iiwa14::LIMITS[0];
    assert!(limits.lower < -2.9 && limits.upper > 2.9 && limits.effort > 0.0);
}

mod payload {
    //! What is said of a robot beside its file.
    use dynamics_core::prelude::*;

    /// The arm with something in its hand, and gravity that can be chosen.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/iiwa14/model.urdf", gravity = [0, 0, -g])]
    #[joint(grip: fixed, iiwa_link_ee -> payload, at = [0, 0, reach])]
    #[body(payload, solid = point(mass))]
    struct Loaded<T> {
        mass: T,
        reach: T,
        g: T,
    }

    /// The arm, whose last link is described anew.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/iiwa14/model.urdf")]
    #[body(iiwa_link_ee, mass = mass, com = [0, 0, reach], inertia = diag(0, 0, 0))]
    struct Tooled {
        mass: f64,
        reach: f64,
    }

    #[test]
    fn a_payload_is_a_field() {
        let q = SVector::from([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
        let empty = Loaded { mass: 0.0, reach: 0.3, g: 9.81 }.gravity_forces(&q);
        let bare = super::Iiwa14.gravity_forces(&q);
        assert!((empty - bare).amax() < 1e-12);
        let loaded = Loaded { mass: 2.0, reach: 0.3, g: 9.81 }.gravity_forces(&q);
        let tooled = Tooled { mass: 2.0, reach: 0.3 }.gravity_forces(&q);
        assert!((loaded - tooled).amax() < 1e-12, "{loaded} {tooled}");
        assert!((loaded - bare).amax() > 1.0);
    }
}

mod joints {
    //! What is said of a file's joints: compared with the equations of the robot as the file has it.
    use dynamics_core::prelude::*;

    use super::DoublePendulum;

    /// Two roads in doubles.
    const ROUNDING: f64 = 1e-14;

    /// The second link is held at an angle.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/double_pendulum/model.urdf", outputs(mass_matrix, bias_forces))]
    #[joint(joint2, locked = angle)]
    struct Locked {
        angle: f64,
    }

    /// The second joint follows the first one.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/double_pendulum/model.urdf", outputs(mass_matrix, bias_forces))]
    #[joint(joint2, mimic = joint1, ratio = ratio, offset = 0.1)]
    struct Coupled {
        ratio: f64,
    }

    /// A motor, a damper and a spring.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/double_pendulum/model.urdf", outputs(mass_matrix, bias_forces))]
    #[joint(joint1, rotor = 1e-5, gear = 50, damping = d, actuated = off)]
    #[joint(joint2, stiffness = 3, rest = 0.2, friction = 0.5, friction_speed = 0.1)]
    struct Resisted<T> {
        d: T,
    }

    /// Nothing holds it.
    #[derive(Dynamics)]
    #[dynamics(urdf = "robots/double_pendulum/model.urdf", base = free, outputs(mass_matrix, gravity_forces))]
    struct Floating;

    #[test]
    fn a_lock_takes_a_row_and_a_column() {
        let (locked, q, v) = (Locked { angle: 0.7 }, [0.3, 0.7], [1.1, 0.0]);
        let [M, h] = of_file(q, v);
        let found = locked.mass_matrix(&SVector::from([q[0]]))[(0, 0)];
        assert!((found - M[0]).abs() < ROUNDING, "{found} {M:?}");
        let found = locked.bias_forces(&SVector::from([q[0]]), &SVector::from([v[0]]))[0];
        assert!((found - h[0]).abs() < ROUNDING, "{found} {h:?}");
        assert_eq!((Locked::NV, Locked::JOINT_NAMES), (1, &["joint1"][..]));
    }

    /// `WᵀMW` and `Wᵀh` of the columns that move together: `Ẇ` is zero.
    #[test]
    fn a_follower_adds_to_its_leader() {
        let (ratio, q, v) = (-0.5, 0.3, 1.1);
        let [M, h] = of_file([q, ratio * q + 0.1], [v, ratio * v]);
        let coupled = Coupled { ratio };
        let found = coupled.mass_matrix(&SVector::from([q]))[(0, 0)];
        let expected = M[0] + ratio * (M[1] + M[2]) + ratio * ratio * M[3];
        assert!((found - expected).abs() < ROUNDING, "{found} {expected}");
        let found = coupled.bias_forces(&SVector::from([q]), &SVector::from([v]))[0];
        let expected = h[0] + ratio * h[1];
        assert!((found - expected).abs() < ROUNDING, "{found} {expected}");
    }

    #[test]
    fn what_resists_is_added_to_the_bias() {
        let (q, v) = ([0.3, -0.4], [1.1, 0.2]);
        let [M, h] = of_file(q, v);
        let resisted = Resisted { d: 0.8 };
        let found = resisted.mass_matrix(&SVector::from(q));
        let rotor = 1e-5 * 50.0 * 50.0;
        assert!((found[(0, 0)] - M[0] - rotor).abs() < ROUNDING && (found[(1, 1)] - M[3]).abs() < ROUNDING);
        let found = resisted.bias_forces(&SVector::from(q), &SVector::from(v));
        let friction = 0.5 * v[1] / f64::hypot(v[1], 0.1);
        let passive = [0.8 * v[0], friction + 3.0 * (q[1] - 0.2)];
        for k in 0..2 {
            assert!((found[k] - h[k] - passive[k]).abs() < ROUNDING, "{k}: {found} {h:?}");
        }
        assert_eq!((Resisted::<f64>::NU, Resisted::<f64>::NV), (1, 2));
    }

    #[test]
    fn a_free_base_carries_what_stood_on_the_world() {
        let upright = [1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0, 0.3, -0.4];
        let [M, _] = of_file([0.3, -0.4], [0.0; 2]);
        let found = Floating.mass_matrix(&SVector::from(upright));
        for (k, expected) in M.iter().enumerate() {
            let (row, column) = (6 + k / 2, 6 + k % 2);
            assert!((found[(row, column)] - expected).abs() < ROUNDING, "{row} {column}: {found}");
        }
        let weight = Floating.gravity_forces(&SVector::from(upright))[2];
        assert!((weight - 9.81 * found[(0, 0)]).abs() < 10.0 * ROUNDING, "{weight} {found}");
        assert_eq!((Floating::NQ, Floating::NV, Floating::NU), (9, 8, 2));
        assert_eq!(Floating::JOINT_NAMES, ["root_joint", "joint1", "joint2"]);
    }

    /// M by rows, and `C·v + G`, of the pendulum as the file has it.
    fn of_file(q: [f64; 2], v: [f64; 2]) -> [Vec<f64>; 2] {
        let (q, v) = (SVector::from(q), SVector::from(v));
        let M = DoublePendulum.mass_matrix(&q);
        [
            vec![M[(0, 0)], M[(0, 1)], M[(1, 0)], M[(1, 1)]],
            DoublePendulum.bias_forces(&q, &v).as_slice().to_vec(),
        ]
    }
}

/// What `dynamics generate` writes is what the derive expands to, but for the struct and the tracking of the file:
/// so it has the numbers of Pinocchio that this has in `reference.rs`.
#[test]
fn generated_files_are_expansions_of_the_derive() {
    use dynamics_codegen::spec::urdf::Urdf;

    for (robot, options) in [
        ("cartpole", ""),
        ("double_pendulum", ""),
        ("double_pendulum_continuous", ""),
        ("scara", ""),
        ("puma560", "allow(nonphysical_inertia)"),
        ("iiwa14", "snap = off"),
        ("hyq", "base = free"),
    ] {
        let path = format!("robots/{robot}/model.urdf");
        let text =
            std::fs::read_to_string(format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))).expect("it is there");
        let attribute = format!("#[dynamics({options})]");
        let written = dynamics_codegen::generate_urdf("Robot", Urdf { file: &path, text: &text }, &attribute);
        let written = written.unwrap_or_else(|mistakes| panic!("{robot}: {}", mistakes.into_text()));
        let item = format!("#[dynamics(urdf = \"{path}\", {options})] pub struct Robot;");
        let input = syn::parse_str(&item).expect("it is a struct");
        let expanded = dynamics_codegen::generate_with(&input, |_| Ok(text.clone().into_bytes()));
        let expanded = expanded.unwrap_or_else(|mistakes| panic!("{robot}: {}", mistakes.into_text()));
        let (code, tracking) = expanded.split_at(written.len());
        assert!(code == written, "{robot}: the file differs from the expansion");
        assert!(tracking.starts_with("const _: &[u8] = ::core::include_bytes!"), "{robot}: {tracking}");
    }
}
