//! A URDF: what is read, what is refused and how, and that the robots are those of Pinocchio.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

#[path = "urdf/hostile.rs"]
mod hostile;
#[path = "urdf/joints.rs"]
mod joints;
#[path = "urdf/mistakes.rs"]
mod mistakes;
#[path = "urdf/reading.rs"]
mod reading;
#[path = "urdf/reference.rs"]
mod reference;

use dynamics_codegen::diagnostics::{Diagnostic, Diagnostics};
use dynamics_codegen::spec::RobotSpec;
use dynamics_codegen::spec::urdf::{Report, Urdf};
use dynamics_codegen::{model, read_urdf, symbolic};

/// A sound robot of one joint.
const ARM: &str = r#"<robot name="arm">
  <link name="base"/>
  <link name="a">
    <inertial>
      <origin xyz="0 0 0.1" rpy="0 0 0"/>
      <mass value="1"/>
      <inertia ixx="0.5" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.5"/>
    </inertial>
  </link>
  <joint name="q" type="revolute">
    <origin xyz="0 0 1" rpy="0 0 0"/>
    <parent link="base"/>
    <child link="a"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="10" velocity="2"/>
  </joint>
</robot>
"#;

/// The arm with one thing replaced.
fn arm_with(old: &str, new: &str) -> String {
    assert!(ARM.contains(old), "{old}");
    ARM.replacen(old, new, 1)
}

/// The specification and the report of a sound file.
fn read(text: &str, options: &str) -> (RobotSpec, Report) {
    read_urdf("Arm", Urdf { file: "arm.urdf", text }, &format!("#[dynamics({options})]"))
        .unwrap_or_else(|wrong| panic!("{}", wrong.into_text()))
}

/// The mistakes that are found by reading and judging.
fn mistakes_in(text: &str, options: &str) -> Vec<Diagnostic> {
    let judged = |spec: &RobotSpec| {
        let mut diags = Diagnostics::new();
        model::names::check_types(spec, &mut diags);
        let _ = model::build(spec, &symbolic::Graph::new(), &mut diags);
        diags
    };
    let found = read_urdf("Arm", Urdf { file: "arm.urdf", text }, &format!("#[dynamics({options})]"));
    found.map_or_else(|wrong| wrong, |(spec, _)| judged(&spec)).take()
}
