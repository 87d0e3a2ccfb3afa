//! `dynamics check` and `dynamics count`: what is said of sound robots.

use super::{ROBOTS, dynamics, dynamics_on, model};

#[test]
fn the_cart_pole() {
    insta::assert_snapshot!(dynamics(&["check", &model("cartpole")]).ok());
}

#[test]
fn the_iiwa() {
    insta::assert_snapshot!(dynamics(&["check", &model("iiwa14")]).ok());
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
        assert!(text.contains("is positive definite at q = 0"), "{text}");
        let table = dynamics(&[&["count", &file], *options].concat()).ok();
        assert!(table.lines().any(|line| line.starts_with("  forward_dynamics ")), "{table}");
    }
}

#[test]
fn the_operations_of_the_cart_pole() {
    insta::assert_snapshot!(dynamics(&["count", &model("cartpole")]).ok());
}

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
