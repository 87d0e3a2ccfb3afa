//! The constants of robots: sizes, names, limits.

use dynamics_core::{JointLimits, Mechanism, Motion};
use dynamics_tests::roads::travel;
use dynamics_tests::zoo;
use dynamics_tests::zoo::files::{hyq, loaded_scara};
use dynamics_tests::zoo::fixtures::{lift, torso};
use dynamics_tests::zoo::industrial::{iiwa14, puma560_by_dh};
use dynamics_tests::zoo::joints::{gripper, locked, sleeve, two_free_bodies};

#[test]
fn sizes_and_names_are_those_of_the_specification() {
    for entry in zoo::all() {
        travel(&entry, |roads| {
            let joints: Vec<&str> = roads.model.joints.iter().map(|joint| joint.name.as_str()).collect();
            assert_eq!(entry.joint_names, joints, "{}", entry.name);
            let sizes = (roads.tree.coordinates(), roads.tree.dof());
            assert_eq!((entry.space.coordinates(), entry.space.speeds()), sizes, "{}", entry.name);
        });
        let words: Vec<&str> = entry.source.split(|c: char| !c.is_alphanumeric()).collect();
        assert!(words.windows(2).any(|pair| pair == ["struct", entry.name]), "{}", entry.name);
    }
    assert_eq!((hyq::Hyq::NQ, hyq::Hyq::NV, hyq::Hyq::NU), (19, 18, 12));
    assert_eq!(hyq::Hyq::JOINT_NAMES[..2], ["root_joint", "lf_haa_joint"]);
    assert_eq!((iiwa14::Iiwa14::NQ, iiwa14::Iiwa14::NV, iiwa14::Iiwa14::NU), (7, 7, 7));
    assert_eq!(iiwa14::Iiwa14::JOINT_NAMES[6], "iiwa_joint_7");
    assert_eq!(iiwa14::Iiwa14::BODY_NAMES[8], "iiwa_link_ee");
}

/// Coordinates have the order of the `#[joint]` lines.
#[test]
fn joints_keep_the_order_of_their_lines() {
    let expected = [
        "waist",
        "neck",
        "left_shoulder",
        "left_elbow",
        "left_grip",
        "right_shoulder",
        "right_elbow",
        "right_wrist",
    ];
    assert_eq!(torso::Torso::<f64>::JOINT_NAMES, expected);
}

#[test]
fn limits_are_in_the_units_of_the_specification() {
    let [limits] = lift::Lift::LIMITS else { panic!("one joint has one set of limits") };
    assert_eq!(*limits, JointLimits { lower: -0.1, upper: 3.0, velocity: 1.5, effort: 2000.0 });
    let shoulder = puma560_by_dh::Puma560ByDh::LIMITS[1];
    assert_eq!((shoulder.lower, shoulder.upper), (-110_f64.to_radians(), 110_f64.to_radians()));
    assert_eq!(shoulder.effort, f64::INFINITY);
    assert!(torso::Torso::<f64>::LIMITS.iter().all(|limits| *limits == JointLimits::NONE));
}

/// A joint that follows another, or is locked, has no coordinate; one of several degrees of freedom has one name and a
/// set of limits for each of its speeds.
#[test]
fn names_and_limits_are_those_of_coordinates() {
    type Gripper = gripper::Gripper<f64>;
    assert_eq!(Gripper::JOINT_NAMES, ["roll", "knuckle", "wag"]);
    assert_eq!(locked::Locked::<f64>::JOINT_NAMES, ["hip", "ankle"]);
    type TwoFreeBodies = two_free_bodies::TwoFreeBodies<f64>;
    assert_eq!(TwoFreeBodies::JOINT_NAMES, ["flight", "flap", "fall"]);
    assert_eq!((TwoFreeBodies::NQ, TwoFreeBodies::NV, TwoFreeBodies::NU), (15, 13, 7));
    assert_eq!(TwoFreeBodies::LIMITS.len(), 13);
    type LoadedScara = loaded_scara::LoadedScara<f64>;
    assert_eq!(LoadedScara::JOINT_NAMES, ["joint1", "joint2", "joint3"]);
    assert_eq!((LoadedScara::LIMITS[2].lower, LoadedScara::LIMITS[2].upper), (0.0, 0.21));
}

/// Names of coordinates, of displacements and of speeds: of joints that have several, and of followers that have none.
#[test]
fn coordinates_and_speeds_have_names() {
    type Hyq = hyq::Hyq;
    let of_base = ["x", "y", "z", "qx", "qy", "qz", "qw"].map(|part| format!("root_joint.{part}"));
    assert_eq!(Hyq::COORDINATE_NAMES[..7], of_base);
    let of_base = ["dx", "dy", "dz", "rx", "ry", "rz"].map(|part| format!("root_joint.{part}"));
    assert_eq!(Hyq::DISPLACEMENT_NAMES[..6], of_base);
    let of_base = ["vx", "vy", "vz", "wx", "wy", "wz"].map(|part| format!("root_joint.{part}"));
    assert_eq!(Hyq::SPEED_NAMES[..6], of_base);
    assert_eq!(Hyq::MOTIONS[2..4], [Motion::Translation, Motion::Rotation]);
    for names in [&Hyq::COORDINATE_NAMES[7..], &Hyq::DISPLACEMENT_NAMES[6..], &Hyq::SPEED_NAMES[6..]] {
        assert_eq!(names, &Hyq::JOINT_NAMES[1..]);
    }
    assert_eq!(Hyq::ACTUATED, (6..18).collect::<Vec<_>>());
    type Gripper = gripper::Gripper<f64>;
    assert_eq!(Gripper::SPEED_NAMES, ["roll", "knuckle", "wag"]);
    assert_eq!(sleeve::Sleeve::DISPLACEMENT_NAMES, ["pan", "sleeve.angle", "sleeve.distance", "tilt"]);
    assert_eq!(sleeve::Sleeve::MOTIONS[1..3], [Motion::Rotation, Motion::Translation]);
    type TwoFreeBodies = two_free_bodies::TwoFreeBodies<f64>;
    assert_eq!((TwoFreeBodies::COORDINATE_NAMES.len(), TwoFreeBodies::SPEED_NAMES.len()), (15, 13));
    assert_eq!((TwoFreeBodies::DISPLACEMENT_NAMES.len(), TwoFreeBodies::MOTIONS.len()), (13, 13));
    assert_eq!(TwoFreeBodies::ACTUATED, (0..7).collect::<Vec<_>>());
}

/// What depends on fields alone is done once: a robot without fields has nothing to prepare.
#[test]
fn only_robots_with_fields_prepare() {
    for entry in zoo::all() {
        let prepares = entry.costs.prepare != dynamics_core::Cost::ZERO;
        assert!(!prepares || !entry.parameters.is_empty(), "{}", entry.name);
    }
}
