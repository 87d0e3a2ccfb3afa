//! The constants of robots: sizes, names, limits.

use dynamics_core::{JointLimits, Mechanism};
use dynamics_tests::zoo;
use dynamics_tests::zoo::fixtures::{lift, torso};
use dynamics_tests::zoo::industrial::{iiwa14, puma560_by_dh};

#[test]
fn sizes_and_names_are_those_of_the_specification() {
    for entry in zoo::all() {
        assert_eq!(entry.joint_names.len(), entry.n, "{}", entry.name);
        let words: Vec<&str> = entry.source.split(|c: char| !c.is_alphanumeric()).collect();
        assert!(words.windows(2).any(|pair| pair == ["struct", entry.name]), "{}", entry.name);
    }
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

/// What depends on fields alone is done once: a robot without fields has nothing to prepare.
#[test]
fn only_robots_with_fields_prepare() {
    for entry in zoo::all() {
        let prepares = entry.costs.prepare != dynamics_core::Cost::ZERO;
        assert!(!prepares || !entry.parameters.is_empty(), "{}", entry.name);
    }
}
