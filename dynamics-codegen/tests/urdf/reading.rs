//! What a sound file becomes.

use super::{ARM, arm_with, mistakes_in, read};
use dynamics_codegen::spec::JointKind;
use dynamics_codegen::spec::urdf::Urdf;
use dynamics_codegen::symbolic::Graph;
use dynamics_codegen::{derive, diagnostics::Diagnostics, generate_urdf, generate_with, model};

/// All that real files have beside links and joints, in an order that nobody would choose.
const FULL: &str = r##"<?xml version="1.0" encoding="utf-8"?>
<!-- ====== exported ====== -->
<robot name="full" version="1.0" xmlns:xacro="http://ros.org/xacro" generator="by hand">
  <material name="grey"><color rgba="0.5 0.5 0.5 1"/></material>
  <joint name="wrist" type="continuous">
    <parent link="fore/arm"/><child link="hand"/>
    <axis xyz="0 3 4"/>
    <limit effort="5" velocity="1" lower="-1" upper="1"/>
    <dynamics damping="0.0" friction="0"/>
    <safety_controller k_velocity="10"/>
    <calibration rising="0.0"/>
  </joint>
  <joint name="weld" type="fixed">
    <parent link="upper_arm"/><child link="fore/arm"/>
    <origin xyz="0 0 0.3" rpy="1.57079632679 0 0"/>
    <axis xyz="0 0 0"/>
    <limit lower="0" upper="0" effort="0" velocity="0"/>
  </joint>
  <link name="hand">
    <inertial>
      <origin xyz="0.01 0.02 0.03" rpy="0.1 0.2 0.3"/>
      <mass value="0.5"/>
      <inertia ixx="0.002" ixy="0.0001" ixz="0" iyy="0.002" iyz="0" izz="0.002"/>
    </inertial>
    <visual><geometry><sphere radius="0.1"/></geometry></visual>
    <collision><geometry><sphere radius="0.1"/></geometry></collision>
  </link>
  <link name="fore/arm"><inertial><mass value="0"/></inertial></link>
  <link name="upper_arm">
    <inertial><mass value="2.5"/><inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/></inertial>
  </link>
  <joint name="slide" type="prismatic">
    <parent link="base_link"/><child link="upper_arm"/>
    <limit lower="0" upper="0"/>
  </joint>
  <link name="base_link"><inertial><mass value="10"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <transmission name="t">
    <type>transmission_interface/SimpleTransmission</type>
    <joint name="wrist"><hardwareInterface>EffortJointInterface</hardwareInterface></joint>
    <actuator name="m"><mechanicalReduction>50</mechanicalReduction></actuator>
  </transmission>
  <gazebo reference="hand"><sensor name="imu"/></gazebo>
</robot>
"##;

#[test]
fn everything_is_used_or_listed() {
    let (spec, report) = read(FULL, "");
    let text = |notes: &[dynamics_codegen::spec::urdf::Note]| {
        let lines = notes.iter().map(|note| match &note.place {
            dynamics_codegen::diagnostics::Place::Text { line, column, .. } => {
                format!("  {line}:{column} {}\n", note.text)
            }
            dynamics_codegen::diagnostics::Place::Tokens { .. } => format!("  {}\n", note.text),
        });
        lines.collect::<String>()
    };
    let bodies: Vec<_> = spec.bodies.iter().map(|body| body.name.text.as_str()).collect();
    let joints: Vec<_> =
        spec.joints.iter().map(|joint| format!("{}: {:?}", joint.name, joint.kind)).collect();
    let text = format!(
        "robot {:?}, root {}, {} links, {} joints, {} kg\nbodies {bodies:?}\njoints {joints:#?}\nignored\n{}merged\n{}snapped\n{}remarks\n{}",
        report.robot,
        report.root,
        report.links,
        report.joints,
        report.mass,
        text(&report.ignored),
        text(&report.merged),
        text(&report.snapped),
        text(&report.remarks)
    );
    insta::assert_snapshot!(text);
}

#[test]
fn coordinates_follow_the_document_as_far_as_the_tree_allows() {
    let (spec, _) = read(FULL, "");
    let graph = Graph::new();
    let mut diags = Diagnostics::new();
    let model = model::build(&spec, &graph, &mut diags);
    assert!(diags.is_empty(), "{}", diags.into_text());
    let model = model.unwrap();
    let names: Vec<_> = model.joints.iter().map(|joint| joint.name.as_str()).collect();
    assert_eq!(names, ["slide", "wrist"]);
    assert_eq!(model.tree.links[1].parent, Some(0));
    let frames: Vec<_> = model.tree.frames.iter().map(|frame| frame.name.as_str()).collect();
    assert_eq!(frames, ["hand", "fore/arm", "upper_arm", "base_link"]);
    assert_eq!(model.tree.base.mass.as_number().map(|mass| mass.to_f64()), Some(10.0));
    assert_eq!(model.joints[1].limits[0].effort, 5.0);
    assert_eq!(model.joints[1].limits[0].upper, f64::INFINITY);
    assert_eq!(model.joints[0].limits[0].upper, 0.0);
}

/// Several branches, each written in a strange order: none waits for what does not carry it.
#[test]
fn only_what_is_written_before_its_carrier_waits() {
    let order = |joints: &[(&str, &str, &str, &str)]| {
        let mut names: Vec<&str> =
            joints.iter().flat_map(|(_, _, parent, child)| [*parent, *child]).collect();
        names.sort_unstable();
        names.dedup();
        let links = names.iter().map(|name| format!("<link name='{name}'/>"));
        let joints = joints.iter().map(|(name, kind, parent, child)| {
            format!(
                "<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/></joint>"
            )
        });
        let (spec, _) = read(&format!("<robot>{}</robot>", links.chain(joints).collect::<String>()), "");
        let moving = spec.joints.iter().filter(|joint| joint.kind != JointKind::Fixed);
        moving.map(|joint| joint.name.text.clone()).collect::<Vec<_>>().join(" ")
    };
    let c = "continuous";
    assert_eq!(order(&[("p", c, "w", "a"), ("q", c, "a", "b"), ("r", c, "w", "c")]), "p q r");
    assert_eq!(order(&[("q", c, "a", "b"), ("r", c, "w", "c"), ("p", c, "w", "a")]), "r p q");
    assert_eq!(order(&[("r", c, "b", "c"), ("q", c, "a", "b"), ("p", c, "w", "a")]), "p q r");
    // The weld comes last, and holds nobody up.
    assert_eq!(
        order(&[("p", c, "w", "a"), ("q", c, "f", "b"), ("r", c, "w", "c"), ("x", "fixed", "a", "f")]),
        "p q r"
    );
}

#[test]
fn the_world_is_the_world() {
    let text = ARM.replace("\"base\"", "\"world\"");
    let (spec, report) = read(&text, "");
    assert_eq!(report.root, "world");
    assert_eq!(spec.joints.len(), 1);
    assert!(mistakes_in(&text, "").is_empty());
}

#[test]
fn passive_forces_are_left_out_when_asked() {
    let text = arm_with("<limit", r#"<dynamics damping="0.5" friction="0.1"/><limit"#);
    let (_, report) = read(&text, "passive = off");
    let ignored: Vec<_> = report.ignored.iter().map(|note| note.text.as_str()).collect();
    assert_eq!(
        ignored,
        [
            "`damping` in `<dynamics>` = 0.5 of the joint `q`",
            "`friction` in `<dynamics>` = 0.1 of the joint `q`"
        ]
    );
}

#[test]
fn what_looks_odd_is_remarked() {
    let text = ARM.replace("rpy=\"0 0 0\"", "rpy=\"0 90 0\"").replace("lower=\"-1\"", "lower=\"-170\"");
    let (_, report) = read(&text, "");
    assert_eq!(report.suspicions.len(), 3, "{:?}", report.suspicions);
    assert!(mistakes_in(&text, "").is_empty());
}

#[test]
fn nonphysical_inertias_can_be_allowed() {
    let text = arm_with("ixx=\"0.5\"", "ixx=\"1.5\"");
    assert_eq!(mistakes_in(&text, "").len(), 1);
    assert!(mistakes_in(&text, "allow(nonphysical_inertia)").is_empty());
    let text = arm_with(r#"ixy="0" ixz="0" iyy="0.5""#, r#"ixy="0.1" ixz="0" iyy="0.1""#);
    assert!(mistakes_in(&text, "allow(nonphysical_inertia)").is_empty());
}

/// One body of text for the derive, the build script and the command line.
#[test]
fn every_door_leads_to_the_same_code() {
    let beside = "#[joint(q, rotor = 1e-4, gear = 50)] #[body(load, solid = point(2kg))]
        #[joint(grip: fixed, a -> load)]";
    let attributes = format!("#[dynamics(urdf = \"robots/arm.urdf\", snap = off, base = free)] {beside}");
    let input: syn::DeriveInput = syn::parse_str(&format!("{attributes} pub struct Arm;")).unwrap();
    let derived = generate_with(&input, |path| {
        assert_eq!(path, "robots/arm.urdf");
        Ok(ARM.as_bytes().to_vec())
    });
    let derived = derived.unwrap_or_else(|wrong| panic!("{}", wrong.into_text()));
    let attributes = format!("#[dynamics(base = free)] {beside} #[dynamics(snap = off)]");
    let generated = generate_urdf("Arm", Urdf { file: "anywhere/else.urdf", text: ARM }, &attributes);
    let generated = generated.unwrap_or_else(|wrong| panic!("{}", wrong.into_text()));
    let tracking = derived.strip_prefix(&generated).expect("the derive only adds to it");
    assert_eq!(
        tracking,
        "const _: &[u8] = ::core::include_bytes!(::core::concat!(::core::env!(\"CARGO_MANIFEST_DIR\"), \"/robots/arm.urdf\"));\n"
    );
    let tokens = derive(quote::quote!(#input), |_| Ok(ARM.as_bytes().to_vec())).to_string();
    assert_eq!(tokens, derived.parse::<proc_macro2::TokenStream>().unwrap().to_string());
}

#[test]
fn attributes_of_a_build_script_are_checked() {
    let deep = format!("#[joint({}{})]", "(".repeat(10_000), ")".repeat(10_000));
    for (name, attributes) in [
        ("Arm", "#[dynamics(snap = maybe)]"),
        ("Arm", "#[dynamics(urdf = \"b.urdf\")]"),
        ("Arm", "#[dynamics()])"),
        ("Arm", "snap = off"),
        ("an arm", ""),
        ("Arm", "#[dynamics(snap = \")]"),
        ("Arm", "#[joint(no_such, damping = 1)]"),
        ("Arm", &deep),
    ] {
        let urdf = Urdf { file: "arm.urdf", text: ARM };
        let found = generate_urdf(name, urdf, attributes).unwrap_err().take();
        assert_eq!(found.len(), 1, "{name} {attributes}");
    }
}

mod beside {
    use super::{ARM, Diagnostics, Graph, derive, generate_with, model};
    use dynamics_codegen::spec::{self, urdf};
    use dynamics_codegen::symbolic::{Evaluator, SymbolId};

    /// Mass, first moment and `∫yy dm` of the last link, for all fields 2.
    fn link_of(lines: &str, fields: &str) -> (usize, [f64; 3]) {
        let input = syn::parse_str(&format!("{lines} struct Arm<T> {{ {fields} }}")).unwrap();
        let (mut diags, graph) = (Diagnostics::new(), Graph::new());
        let mut spec = spec::parse(&input, &mut diags);
        urdf::read(&mut spec, urdf::Urdf { file: "arm.urdf", text: ARM }, &mut diags);
        let model = model::build(&spec, &graph, &mut diags);
        assert!(diags.is_empty(), "{lines}: {}", diags.into_text());
        let model = model.unwrap();
        let link = &model.tree.links[model.tree.links.len() - 1];
        let mut evaluator = Evaluator::new(&graph, |_: SymbolId| 2.0);
        let inertia = link.inertia;
        (
            model.tree.links.len(),
            [inertia.mass, inertia.first.0[2], inertia.second.yy].map(|x| evaluator.value(x)),
        )
    }

    #[test]
    fn each_key_replaces_what_the_file_says() {
        let close = |found: [f64; 3], expected: [f64; 3]| {
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} {expected:?}");
        };
        close(link_of("", "").1, [1.0, 0.1, 0.25]);
        close(link_of("#[body(a, mass = m)]", "m: T").1, [2.0, 0.2, 0.25]);
        close(link_of("#[body(a, mass = m, com = [0, 0, l])]", "m: T, l: T").1, [2.0, 4.0, 0.25]);
        close(link_of("#[body(a, inertia = diag(i, i, i))]", "i: T").1, [1.0, 0.1, 1.0]);
        close(link_of("#[body(a, solid = sphere(m, r))]", "m: T, r: T").1, [2.0, 0.0, 1.6]);
    }

    #[test]
    fn bodies_and_joints_are_added() {
        let payload =
            "#[joint(grip: fixed, a -> payload, at = [0, 0, 1])] #[body(payload, solid = point(m))]";
        let (count, link) = link_of(payload, "m: T");
        assert_eq!((count, link[0], link[1]), (1, 3.0, 2.1));
        let finger =
            "#[joint(finger: prismatic(x), a -> tip)] #[body(tip, mass = 0.5, inertia = diag(0, 0, 0))]";
        assert_eq!(link_of(finger, "").0, 2);
        // The robot itself can be carried: the joint comes first.
        let rail = "#[joint(rail: prismatic(x), world -> base)]";
        assert_eq!(link_of(rail, "").0, 2);
    }

    #[test]
    fn mistakes_beside_the_file_are_found() {
        for (line, message) in [
            ("#[body(b, mass = 1, inertia = diag(1, 1, 1))]", "no joint carries the body `b`"),
            ("#[body(a, mass = 1)] #[body(a, solid = point(1))]", "there are two body lines for `a`"),
            ("#[joint(q: fixed, a -> b)]", "there are two joint lines for `q`"),
            ("#[joint(p: fixed, c -> b)]", "the joint `p` is on `c`, which is no body"),
            ("#[joint(p: fixed, world -> a)]", "`a` is carried by `q` and by `p`"),
        ] {
            let text = format!("#[dynamics(urdf = \"arm.urdf\")] {line} struct Arm;");
            let input = syn::parse_str(&text).unwrap();
            let found = generate_with(&input, |_| Ok(ARM.as_bytes().to_vec())).unwrap_err().take();
            assert_eq!(found[0].message, message);
            let _ = derive(text.parse().unwrap(), |_| Ok(ARM.as_bytes().to_vec()));
        }
    }
}
