//! `dynamics check` and `dynamics count`: what is said of sound robots.

use super::{ROBOTS, dynamics, dynamics_on, folder, model};

#[test]
fn the_cart_pole() {
    insta::assert_snapshot!(dynamics(&["check", &model("cartpole")]).ok());
}

#[test]
fn the_iiwa() {
    insta::assert_snapshot!(dynamics(&["check", &model("iiwa14")]).ok());
}

/// A free base, and what the command line adds to the file: a follower, a locked joint, motors, a load.
#[test]
fn the_hyq_with_options() {
    let file = model("hyq");
    let options = [
        "--base",
        "free",
        "--joint",
        "lf_kfe_joint, rotor = 5e-5, gear = 100, damping = 0.2, stiffness = 3",
        "--joint",
        "rf_kfe_joint, mimic = lf_kfe_joint, ratio = -1, offset = 30deg",
        "--joint",
        "lh_kfe_joint, locked = 30deg",
        "--joint",
        "rh_kfe_joint, actuated = off, friction = 0.1",
        "--joint",
        "swing: universal(x, y), trunk -> load",
        "--body",
        "load, com = [0, 0, -0.2], solid = sphere(8kg, 10mm)",
        "--snap",
        "off",
    ];
    insta::assert_snapshot!(dynamics(&[&["check", &file], &options[..]].concat()).ok());
}

#[test]
fn nothing_is_snapped_if_not_wanted() {
    let text = dynamics(&["check", &model("iiwa14"), "--snap", "off"]).ok();
    assert!(!text.contains("\nsnapped\n"), "{text}");
}

#[test]
fn a_tree_with_branches_and_what_is_not_used_of_it() {
    insta::assert_snapshot!(dynamics_on(TREE.as_bytes(), &["check", "-"]).ok());
}

#[test]
fn every_robot_is_sound_and_counted() {
    for (robot, options) in ROBOTS {
        let file = model(robot);
        let text = dynamics(&[&["check", &file], *options].concat()).ok();
        assert!(text.contains("M(q) is positive definite at "), "{text}");
        let table = dynamics(&[&["count", &file], *options].concat()).ok();
        assert!(table.lines().any(|line| line.starts_with("  forward_dynamics ")), "{table}");
    }
}

#[test]
fn the_operations_of_the_cart_pole() {
    insta::assert_snapshot!(dynamics(&["count", &model("cartpole")]).ok());
}

/// A free base, followers, and joints that resist.
#[test]
fn a_walker_with_a_gripper() {
    insta::assert_snapshot!(dynamics_on(WALKER.as_bytes(), &["check", "-", "--base", "free"]).ok());
}

const WALKER: &str = r#"<robot name="walker">
  <link name="hull"><inertial><mass value="3"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="left"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="right"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="cart"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="right_finger" type="prismatic"><parent link="hull"/><child link="right"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/><mimic joint="left_finger" multiplier="-1"/></joint>
  <joint name="left_finger" type="prismatic"><parent link="hull"/><child link="left"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/><dynamics damping="3" friction="1"/></joint>
  <joint name="floor" type="planar"><parent link="hull"/><child link="cart"/><axis xyz="0 0 1"/></joint>
  <transmission name="t"><joint name="left_finger"/><actuator name="m"><mechanicalReduction>50</mechanicalReduction></actuator></transmission>
</robot>
"#;

/// Two arms on a base; a link without mass, one that is welded, and elements that are of no use here.
const TREE: &str = r#"<robot name="two arms">
  <link name="base"><visual/></link>
  <link name="left"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="right"><inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="hand"><inertial><mass value="0.5"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
  <link name="tool"/>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="left"/></joint>
  <joint name="wrist" type="fixed"><parent link="left"/><child link="hand"/></joint>
  <joint name="tip" type="fixed"><parent link="hand"/><child link="tool"/></joint>
  <joint name="slide" type="prismatic"><parent link="base"/><child link="right"/><limit lower="0" upper="1" effort="5" velocity="2"/></joint>
  <gazebo/>
</robot>
"#;

/// What is taken as radians, and nobody meant, is said by each command: in the file of a struct it would be a mistake.
#[test]
fn degrees_in_a_file_are_suspected_aloud() {
    let file = r#"<robot name="arm"><link name="base"/>
<link name="arm"><inertial><origin xyz="0 0 1"/><mass value="2"/>
<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="hinge" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
<origin rpy="0 0 90"/><limit lower="-170" upper="170" effort="1" velocity="1"/></joint></robot>"#;
    let suspected =
        ["90rad in the joint `hinge` looks like degrees", "<stdin>:5:50: 170rad in the joint `hinge`"];
    let checked = dynamics_on(file.as_bytes(), &["check", "-"]).ok();
    assert!(
        checked.contains("\nsuspicious\n") && suspected.iter().all(|text| checked.contains(text)),
        "{checked}"
    );
    for command in [
        &["eval", "-", "--state", r#"{"q": [1]}"#][..],
        &["count", "-"],
        &["simulate", "-", "--time", "1", "--step", "0.1"],
        &[
            "rollouts",
            "-",
            "--time",
            "1",
            "--step",
            "0.1",
            "--vary",
            "q.hinge = uniform(0, 1)",
            "--count",
            "2",
        ],
        &[
            "generate",
            "-",
            "--lang",
            "c",
            "--name",
            "arm",
            "--outputs",
            "mass_matrix",
            "-o",
            &folder("degrees").display().to_string(),
        ],
        &["explain", "-"],
        &["report", "-", "-o", &folder("degrees").join("arm.html").display().to_string()],
    ] {
        let done = dynamics_on(file.as_bytes(), command);
        assert_eq!(done.code, 0, "{command:?}: {}", done.stderr);
        let lines: Vec<&str> =
            done.stderr.lines().filter(|line| line.starts_with("warning: <stdin>:")).collect();
        assert_eq!(lines.len(), 3, "{command:?}: {}", done.stderr);
        assert!(suspected.iter().all(|text| done.stderr.contains(text)), "{command:?}: {}", done.stderr);
    }
}
