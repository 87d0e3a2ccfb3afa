//! Joints that float, slide in a plane, follow others and resist, from a file and beside it.

use super::{ARM, mistakes_in, read};
use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::model::{self, Model};
use dynamics_codegen::spec::urdf::{Note, Report, Urdf};
use dynamics_codegen::spec::{self, JointKind, JointSpec, RobotSpec};
use dynamics_codegen::symbolic::{Evaluator, Graph};
use dynamics_codegen::{generate, generate_urdf};

const BODY: &str = r#"<inertial><origin xyz="0 0 0.1"/><mass value="2"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.04"/></inertial>"#;

/// A file of bodies of 2 kg and these joints.
fn file(links: &[&str], joints: &str) -> String {
    let links: String = links.iter().map(|link| format!("<link name=\"{link}\">{BODY}</link>\n")).collect();
    format!("<robot name=\"r\"><link name=\"world\"/>\n{links}{joints}</robot>")
}

fn joint(name: &str, kind: &str, parent: &str, child: &str, more: &str) -> String {
    format!(
        "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>{more}</joint>\n"
    )
}

const X: &str = r#"<axis xyz="1 0 0"/>"#;
const LIMIT: &str = r#"<limit lower="-1" upper="1" effort="10" velocity="2"/>"#;

/// A robot that has all of it.
fn everything() -> String {
    let follower = r#"<mimic joint="hip" multiplier="-0.5" offset="0.1"/>"#;
    let resisted = r#"<dynamics damping="0.5" friction="0.2"/>"#;
    let joints = [
        joint("float", "floating", "world", "body", ""),
        joint("hip", "revolute", "body", "leg", &format!("{X}{LIMIT}{resisted}")),
        joint("knee", "revolute", "leg", "shank", &format!("{X}{LIMIT}{follower}")),
        joint("slip", "planar", "shank", "foot", r#"<axis xyz="0 1 0"/>"#),
    ];
    file(&["body", "leg", "shank", "foot"], &joints.concat())
}

fn model<'g>(spec: &RobotSpec, graph: &'g Graph) -> Model<'g> {
    let mut diags = Diagnostics::new();
    let model = model::build(spec, graph, &mut diags);
    let errors = diags.into_text();
    model.unwrap_or_else(|| panic!("{errors}"))
}

/// The joint of a name.
fn find<'s>(spec: &'s RobotSpec, name: &str) -> &'s JointSpec {
    spec.joints.iter().find(|joint| joint.name.text == name).unwrap()
}

fn texts(notes: &[Note]) -> Vec<&str> {
    notes.iter().map(|note| note.text.as_str()).collect()
}

/// What a file says by elements, attributes say by keys: the code is the same.
#[test]
fn a_file_and_attributes_mean_the_same_robot() {
    let body = "mass = 2, com = [0, 0, 0.1], inertia = diag(0.02, 0.03, 0.04)";
    let lines = format!(
        "#[joint(float: free, world -> body)] #[body(body, {body})]
         #[joint(hip: revolute(x), body -> leg, limits = [-1, 1], effort = 10, velocity = 2, damping = 0.5, friction = 0.2)]
         #[body(leg, {body})]
         #[joint(knee: revolute(x), leg -> shank, mimic = hip, ratio = -0.5, offset = 0.1)] #[body(shank, {body})]
         #[joint(slip: planar(y), shank -> foot)] #[body(foot, {body})]
         pub struct Hopper;"
    );
    let written =
        generate(&syn::parse_str(&lines).unwrap()).unwrap_or_else(|wrong| panic!("{}", wrong.into_text()));
    let read = generate_urdf("Hopper", Urdf { file: "hopper.urdf", text: &everything() }, "");
    assert_eq!(read.unwrap_or_else(|wrong| panic!("{}", wrong.into_text())), written);
}

#[test]
fn every_kind_of_a_file_is_read_and_the_rest_is_listed() {
    let (spec, report) = read(&everything(), "");
    let kinds: Vec<_> = spec.joints.iter().map(|joint| (joint.name.text.as_str(), joint.kind)).collect();
    let expected = [
        ("float", JointKind::Free),
        ("hip", JointKind::Revolute),
        ("knee", JointKind::Revolute),
        ("slip", JointKind::Planar),
    ];
    assert_eq!(kinds, expected);
    assert_eq!(texts(&report.ignored), ["`<limit>` of the joint `knee`"]);
    let remark = "the friction of the joint `hip` is smooth below some 0.01 rad/s: `friction_speed` on the struct sets another speed";
    assert_eq!(texts(&report.remarks), [remark]);
    let joints = [
        joint("f", "floating", "world", "a", &format!("{X}{LIMIT}<dynamics damping=\"0\"/>")),
        joint("w", "fixed", "a", "b", r#"<mimic joint="f"/><dynamics damping="1"/>"#),
    ];
    let (_, report) = read(&file(&["a", "b"], &joints.concat()), "");
    let of_fixed = ["`<mimic>` of the joint `w`", "`<dynamics>` of the joint `w`"];
    let expected = [&["`<axis>` of the joint `f`", "`<limit>` of the joint `f`"][..], &of_fixed].concat();
    assert_eq!(texts(&report.ignored), expected);
}

#[test]
fn followers_may_stand_before_their_leaders_and_need_no_limits() {
    let joints = [
        joint("thumb", "revolute", "palm", "b", &format!("{X}<mimic joint=\"finger\"/>")),
        joint("finger", "prismatic", "palm", "a", &format!("{X}{LIMIT}")),
        joint("wrist", "continuous", "world", "palm", X),
    ];
    let text = file(&["palm", "a", "b"], &joints.concat());
    assert!(mistakes_in(&text, "").is_empty());
    let (spec, report) = read(&text, "");
    let graph = Graph::new();
    let model = model(&spec, &graph);
    let names: Vec<_> = model.joints.iter().map(|joint| joint.name.as_str()).collect();
    assert_eq!(names, ["wrist", "finger"]);
    let drives: Vec<_> = model.tree.links.iter().map(|link| link.drive.q).collect();
    assert_eq!(drives, [0, 1, 1]);
    assert_eq!(
        texts(&report.remarks),
        ["the joint `finger` has a later coordinate than `wrist`, which carries it"]
    );
}

#[test]
fn a_free_base_comes_first() {
    let (spec, report) = read(ARM, "base = free");
    assert_eq!((report.root.as_str(), report.joints), ("base", 1));
    let graph = Graph::new();
    let found = model(&spec, &graph);
    let joints: Vec<_> = found.joints.iter().map(|joint| (joint.name.as_str(), joint.q.clone())).collect();
    assert_eq!(joints, [("root_joint", 0..7), ("q", 7..8)]);
    assert_eq!(found.actuated, [6]);
    let (fixed, default) = (read(ARM, "base = fixed").0, read(ARM, "").0);
    assert_eq!(fixed.joints.len(), default.joints.len());
    // One body, and nothing else: it flies.
    let alone = format!("<robot name=\"drone\"><link name=\"hull\">{BODY}</link></robot>");
    assert!(mistakes_in(&alone, "base = free").is_empty());
    assert!(!mistakes_in(&alone, "").is_empty());
}

/// The specification of a struct beside a file.
fn beside(lines: &str, text: &str) -> (RobotSpec, Report) {
    let input = syn::parse_str(&format!("{lines} struct Arm<T> {{ l: T, d: T }}")).unwrap();
    let mut diags = Diagnostics::new();
    let mut spec = spec::parse(&input, &mut diags);
    let report = spec::urdf::read(&mut spec, Urdf { file: "arm.urdf", text }, &mut diags);
    assert!(diags.is_empty(), "{lines}: {}", diags.into_text());
    (spec, report)
}

#[test]
fn keys_on_the_struct_replace_those_of_the_file() {
    let lines =
        "#[joint(hip, damping = d, armature = 0.02, limits = [-2, 2], actuated = off, at = [0, l, 0])]
        #[joint(knee, stiffness = 3)]";
    let (spec, report) = beside(lines, &everything());
    let described = |name: &str| format!("`{name}` is described on the struct as well");
    assert_eq!(texts(&report.remarks)[..2], [described("hip"), described("knee")]);
    let graph = Graph::new();
    let model = model(&spec, &graph);
    let mut evaluator = Evaluator::new(&graph, |_| 2.0);
    let [_, hip, knee, ..] = &model.tree.links[..] else { panic!("six links") };
    let numbers = [hip.passive.damping, hip.passive.friction, hip.passive.armature, knee.passive.stiffness];
    assert_eq!(numbers.map(|x| evaluator.value(x)), [2.0, 0.2, 0.02, 3.0]);
    assert_eq!(hip.placement.translation.0.map(|x| evaluator.value(x)), [0.0, 2.0, 0.0]);
    let limits = model.joints[1].limits[0];
    assert_eq!([limits.lower, limits.upper, limits.effort], [-2.0, 2.0, 10.0]);
    // The planar one is left.
    assert_eq!(model.actuated, [7, 8, 9]);
}

#[test]
fn joints_of_a_file_can_be_locked_and_their_followers_stand_still() {
    let (spec, report) = beside("#[joint(hip, locked = 30deg)]", &everything());
    let merged = [
        "`leg` is welded to `body`: the joint `hip` is locked at 30deg",
        "`shank` is welded to `body`: the joint `knee` follows `hip`, which is locked",
    ];
    assert_eq!(texts(&report.merged), merged);
    let graph = Graph::new();
    assert_eq!(model(&spec, &graph).tree.links.len(), 4);
    // A follower is let loose by its own lock, and its leader moves.
    let (spec, _) = beside("#[joint(knee, locked = 0.2)]", &everything());
    assert!(find(&spec, "knee").keys.mimic.is_none());
    assert_eq!(model(&spec, &Graph::new()).tree.links.len(), 5);
}

/// What is called otherwise than Rust's names stands in quotes.
#[test]
fn names_of_a_file_may_be_in_quotes() {
    let text = everything().replace("\"hip\"", "\"hip-1\"").replace("\"leg\"", "\"left leg\"");
    let lines = r#"#[joint("hip-1", damping = 0.5)] #[body("left leg", com = [0, 0, l])]
        #[joint("strap 1": fixed, "left leg" -> "a/b")] #[joint(["knee"], stiffness = 2)]"#;
    let (spec, _) = beside(lines, &text);
    assert_eq!(find(&spec, "strap 1").parent.text, "left leg");
    let graph = Graph::new();
    let model = model(&spec, &graph);
    let damping = model.tree.links[1].passive.damping;
    assert_eq!(damping.as_number().map(|x| x.to_f64()), Some(0.5));
}

/// Legs have the same motors.
#[test]
fn a_line_may_be_of_several_joints() {
    let lines = "#[joint([hip, knee], rotor = 1e-4, gear = 100)] #[joint([slip], actuated = off)]";
    let (spec, report) = beside(lines, &everything());
    let graph = Graph::new();
    let model = model(&spec, &graph);
    let armatures = model.tree.links.iter().map(|link| link.passive.armature.as_number().map(|a| a.to_f64()));
    assert_eq!(armatures.collect::<Vec<_>>()[..3], [Some(0.0), Some(1.0), Some(1.0)]);
    assert_eq!(model.actuated, [6]);
    let lines = texts(&report.remarks).iter().filter(|text| text.contains("on the struct as well")).count();
    assert_eq!(lines, 3);
}

#[test]
fn a_joint_of_a_file_can_follow_another_one() {
    let joints = [
        joint("left", "prismatic", "world", "a", &format!("{X}{LIMIT}")),
        joint("right", "prismatic", "world", "b", &format!("{X}{LIMIT}")),
    ];
    let text = file(&["a", "b"], &joints.concat());
    let (spec, report) = beside("#[joint(right, mimic = left, ratio = -1)]", &text);
    assert_eq!(texts(&report.ignored), ["`<limit>` of the joint `right`, which follows another one"]);
    let graph = Graph::new();
    let model = model(&spec, &graph);
    assert_eq!((model.tree.dof(), model.tree.links.len()), (1, 2));
}

#[test]
fn a_rotor_on_the_struct_replaces_the_armature_of_a_file() {
    let text = ARM.replace("<limit", "<dynamics armature=\"0.5\"/><limit");
    let armature = |lines: &str| {
        let (spec, _) = beside(lines, &text);
        let graph = Graph::new();
        let model = model(&spec, &graph);
        model.tree.links[0].passive.armature.as_number().map(|armature| armature.to_f64())
    };
    assert_eq!(armature(""), Some(0.5));
    assert_eq!(armature("#[joint(q, rotor = 1e-4, gear = 100)]"), Some(1.0));
    assert_eq!(armature("#[dynamics(passive = off)]"), Some(0.0));
    assert_eq!(armature("#[dynamics(passive = off)] #[joint(q, armature = 2)]"), Some(2.0));
}
