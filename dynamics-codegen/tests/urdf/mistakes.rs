//! Every mistake that a file can have, with the text that users see.

use std::fmt::Write;

use super::{ARM, arm_with, mistakes_in};
use dynamics_codegen::diagnostics::Code;
use dynamics_codegen::{generate_with, no_files};

/// The arm with one thing replaced by another one, which is a mistake.
const REPLACED: &[(Code, &str, &str)] = &[
    // Numbers
    (Code::NumberInvalid, r#"value="1""#, r#"value="0,1""#),
    (Code::NumberInvalid, r#"value="1""#, r#"value="1 kg""#),
    (Code::NumberInvalid, r#"value="1""#, r#"value="nan""#),
    (Code::NumberInvalid, r#"value="1""#, r#"value="inf""#),
    (Code::NumberInvalid, r#"value="1""#, r#"value="1_000""#),
    (Code::NumberInvalid, r#"value="1""#, r#"value="0x10""#),
    (Code::NumberInvalid, r#"xyz="0 0 1""#, r#"xyz="0,0,1""#),
    (Code::NumberInvalid, r#"xyz="0 0 1""#, "xyz=\"0 0\n 1m\""),
    (Code::NumberInvalid, r#"<axis xyz="0 0 1"/>"#, r#"<axis xyz="0 NaN 1"/>"#),
    (Code::NumberOutOfRange, r#"value="1""#, r#"value="1e400""#),
    (Code::NumberOutOfRange, r#"value="1""#, r#"value="1e-400""#),
    (Code::CountWrong, r#"xyz="0 0 1""#, r#"xyz="0 1""#),
    (Code::CountWrong, r#"xyz="0 0 1""#, r#"xyz="0 0 0 1""#),
    (Code::CountWrong, r#"value="1""#, r#"value="""#),
    (Code::CountWrong, r#"<axis xyz="0 0 1"/>"#, r#"<axis xyz="1"/>"#),
    (Code::XacroLeft, r#"value="1""#, r#"value="${mass}""#),
    (Code::XacroLeft, r#"link name="a""#, r#"link name="$(arg prefix)a""#),
    (Code::XacroLeft, r#"link name="base"/>"#, r#"link name="base"/><xacro:arm name="b"/>"#),
    (
        Code::XacroLeft,
        r#"<link name="base"/>"#,
        r#"<link name="base"/><xacro:arm xmlns:xacro="http://www.ros.org/wiki/xacro" name="b"/>"#,
    ),
    // Masses
    (Code::MassNegative, r#"value="1""#, r#"value="-1""#),
    (Code::ElementMissing, r#"<mass value="1"/>"#, ""),
    (Code::ElementMissing, r#"<mass value="1"/>"#, "<mass>1</mass>"),
    (Code::ElementMissing, r#" iyz="0""#, ""),
    (Code::InertiaMissing, r#"<inertia ixx="0.5" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.5"/>"#, ""),
    (Code::InertiaNonphysical, r#"ixx="0.5""#, r#"ixx="1.5""#),
    (Code::InertiaNonphysical, r#"ixx="0.5""#, r#"ixx="-0.5""#),
    (Code::InertiaNonphysical, r#"<mass value="1"/>"#, r#"<mass value="0"/>"#),
    (Code::InertiaOrder, r#"ixy="0" ixz="0" iyy="0.5""#, r#"ixy="0.1" ixz="0" iyy="0.1""#),
    // Joints
    (Code::JointKindUnknown, r#"type="revolute""#, r#"type="revolut""#),
    (Code::JointKindUnknown, r#"type="revolute""#, r#"type="ball""#),
    (Code::MimicCycle, "<limit", r#"<mimic joint="q"/><limit"#),
    (Code::MimicUnknown, "<limit", r#"<mimic joint="qq" multiplier="2"/><limit"#),
    (Code::ElementMissing, "<limit", r#"<mimic multiplier="2"/><limit"#),
    (Code::KeyDuplicate, "<limit", r#"<mimic joint="p"/><mimic joint="r"/><limit"#),
    (Code::KeyUnknown, "<limit", r#"<mimic joint="q" multiplyer="2"/><limit"#),
    (Code::NumberOutOfRange, "<limit", r#"<mimic joint="q" offset="1e400"/><limit"#),
    (Code::NumberInvalid, "<limit", r#"<mimic joint="q" multiplier="2x"/><limit"#),
    (Code::NameReserved, "<limit", r#"<mimic joint="q&#x202E;"/><limit"#),
    (Code::AxisZero, r#"<axis xyz="0 0 1"/>"#, r#"<axis xyz="0 -0 0"/>"#),
    (Code::ElementMissing, r#"<axis xyz="0 0 1"/>"#, "<axis/>"),
    (Code::LimitsMissing, r#"<limit lower="-1" upper="1" effort="10" velocity="2"/>"#, ""),
    (Code::LimitsInverted, r#"lower="-1" upper="1""#, r#"lower="1" upper="-1""#),
    (Code::LimitNegative, r#"velocity="2""#, r#"velocity="-2""#),
    (Code::ElementMissing, r#" type="revolute""#, ""),
    (Code::ElementMissing, r#"<parent link="base"/>"#, ""),
    (Code::ElementMissing, r#"<child link="a"/>"#, "<child/>"),
    (Code::PassiveNegative, "<limit", r#"<dynamics damping="-0.5"/><limit"#),
    (Code::PassiveNegative, "<limit", r#"<dynamics friction="-0.5"/><limit"#),
    (Code::PassiveUnsupported, "<limit", r#"<dynamics dampng="0.5"/><limit"#),
    (Code::PassiveUnsupported, "<limit", r#"<dynamics spring_stiffness="0.5"/><limit"#),
    (Code::NumberInvalid, "<limit", r#"<dynamics damping="0.5 N"/><limit"#),
    (Code::NumberInvalid, "<limit", r#"<dynamics damping="nan"/><limit"#),
    (Code::CountWrong, "<limit", r#"<dynamics friction=""/><limit"#),
    // Names
    (Code::ElementMissing, r#"link name="base""#, "link"),
    (Code::ElementMissing, r#"joint name="q""#, "joint"),
    (Code::NameReserved, r#"link name="base""#, r#"link name="""#),
    (Code::NameReserved, r#"joint name="q""#, r#"joint name=" ""#),
    (Code::NameReserved, r#"joint name="q""#, r#"joint name="a&#10;b""#),
    (Code::NameReserved, r#"joint name="q""#, r#"joint name="a&#x202E;b""#),
    (Code::NameReserved, r#"link name="base""#, r#"link name="&#x2067;base""#),
    (Code::NameDuplicate, r#"<link name="base"/>"#, r#"<link name="base"/><link name="base"/>"#),
    // Elements and attributes
    (Code::KeyUnknown, "<limit", "<limits"),
    (Code::KeyUnknown, r#"<link name="base"/>"#, r#"<link name="base"/><Link name="b"/>"#),
    (Code::KeyUnknown, r#"rpy="0 0 0""#, r#"rp="0 0 0""#),
    (Code::KeyDuplicate, r#"<mass value="1"/>"#, r#"<mass value="1"/><mass value="2"/>"#),
    (Code::KeyDuplicate, r#"value="1""#, r#"value="1" value="2""#),
    // The tree
    (Code::ParentUnknown, r#"parent link="base""#, r#"parent link="bas""#),
    (Code::ChildUnknown, r#"child link="a""#, r#"child link="hand""#),
    (Code::RootsSeveral, r#"<link name="base"/>"#, r#"<link name="base"/><link name="b"/><link name="c"/>"#),
    (Code::DegreesOfFreedomMissing, r#"type="revolute""#, r#"type="fixed""#),
    // The file
    (Code::RobotMissing, ARM, r#"<sdf version="1.6"><model name="arm"/></sdf>"#),
    (Code::XmlInvalid, ARM, ""),
    (Code::XmlInvalid, ARM, " \n"),
    (Code::XmlInvalid, ARM, "robot: arm"),
    (Code::XmlInvalid, "</robot>", ""),
    (Code::XmlInvalid, "</link>", "</lnik>"),
    (Code::XmlInvalid, "</robot>", "</robot><robot/>"),
    (Code::XmlInvalid, r#"value="1""#, "value=1"),
    (Code::XmlInvalid, r#"value="1""#, r#"value="&mass;""#),
    (Code::XmlInvalid, r#"<link name="base"/>"#, r#"<link name="base"/><gazebo:light/>"#),
    (Code::XmlInvalid, "<robot", "<!DOCTYPE robot>\n<robot"),
    (Code::XmlInvalid, "<robot", "<!DOCTYPE r [<!ENTITY a \"b\"><!ENTITY c \"&a;&a;\">]>\n<robot"),
    (Code::ElementMissing, ARM, r#"<robot name="arm"/>"#),
    (Code::JointMissing, ARM, r#"<robot name="arm"><link name="base"/></robot>"#),
];

const BODY: &str =
    r#"<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>"#;

/// Two joints, one on the other: the first of a kind, and each with more in it.
fn two_joints(kind: &str, first: &str, second: &str) -> String {
    format!(
        r#"<robot name="two"><link name="base"/><link name="a">{BODY}</link><link name="b">{BODY}</link>
<joint name="p" type="{kind}"><parent link="base"/><child link="a"/>{first}</joint>
<joint name="q" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>{second}</joint>
</robot>"#
    )
}

/// Links and joints that hang together in a way that they must not.
fn trees() -> Vec<(Code, String)> {
    let joint = |name: &str, parent: &str, child: &str| {
        format!(
            r#"<joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{child}"/></joint>"#
        )
    };
    let tree = |links: &[&str], joints: &[[&str; 3]]| {
        let links = links.iter().map(|link| format!(r#"<link name="{link}"/>"#));
        let joints = joints.iter().map(|[name, parent, child]| joint(name, parent, child));
        let lines: Vec<String> = links.chain(joints).collect();
        format!("<robot name=\"tree\">\n{}\n</robot>", lines.join("\n"))
    };
    // All else is right with robots whose bodies cannot be types.
    let heavy = |text: String| text.replace("\"/>\n", &format!("\">{BODY}</link>\n"));
    vec![
        (Code::ParentTwice, tree(&["a", "b", "c"], &[["p", "a", "c"], ["q", "b", "c"], ["r", "a", "b"]])),
        (Code::Cycle, tree(&["a", "b"], &[["p", "a", "b"], ["q", "b", "a"]])),
        (Code::Cycle, tree(&["base", "a", "b"], &[["p", "a", "b"], ["q", "b", "a"]])),
        (Code::Cycle, tree(&["a", "b"], &[["p", "a", "a"], ["q", "a", "b"]])),
        (Code::MovesNoMass, tree(&["a", "b"], &[["p", "a", "b"]])),
        (Code::NameReserved, heavy(tree(&["a", "+-"], &[["p", "a", "+-"]]))),
        (
            Code::MimicCycle,
            two_joints("continuous", r#"<axis xyz="1 0 0"/><mimic joint="q"/>"#, r#"<mimic joint="p"/>"#),
        ),
        (Code::KeyNotOfKind, two_joints("floating", r#"<dynamics damping="1"/>"#, "")),
        (Code::KeyNotOfKind, two_joints("planar", r#"<mimic joint="q"/>"#, "")),
        (Code::MimicUnfit, two_joints("planar", "", r#"<mimic joint="p"/>"#)),
        (Code::MimicUnfit, two_joints("fixed", "", r#"<mimic joint="p"/>"#)),
        (Code::WorldIsChild, tree(&["a", "world"], &[["p", "a", "world"]])),
        (Code::NameDuplicate, tree(&["a", "b", "c"], &[["q", "a", "b"], ["q", "b", "c"]])),
        (
            Code::NamesCollide,
            heavy(tree(&["a", "tool/0", "tool_0"], &[["p", "a", "tool/0"], ["q", "a", "tool_0"]])),
        ),
    ]
}

/// Mistakes on the struct.
const STRUCTS: &[(Code, &str)] = &[
    (Code::PathOutside, r#"#[dynamics(urdf = "../arm.urdf")]"#),
    (Code::PathOutside, r#"#[dynamics(urdf = "robots/../../arm.urdf")]"#),
    (Code::PathOutside, r#"#[dynamics(urdf = "/etc/passwd")]"#),
    (Code::PathOutside, r#"#[dynamics(urdf = "C:/arm.urdf")]"#),
    (Code::PathOutside, r#"#[dynamics(urdf = "robots\\arm.urdf")]"#),
    (Code::PathOutside, r#"#[dynamics(urdf = "package://arm/arm.urdf")]"#),
    (Code::PathOutside, r#"#[dynamics(urdf = "")]"#),
    (Code::FileUnreadable, r#"#[dynamics(urdf = "robots/arm.urdf")]"#),
    (Code::Syntax, "#[dynamics(urdf = 3)]"),
    (Code::KeyDuplicate, r#"#[dynamics(urdf = "a.urdf", urdf = "b.urdf")]"#),
];

#[test]
fn every_mistake_in_a_file_is_found_once_and_explained() {
    let replaced = REPLACED.iter().map(|(code, old, new)| (*code, (*new).to_owned(), arm_with(old, new)));
    let trees = trees().into_iter().map(|(code, text)| (code, text.clone(), text));
    let (mut table, mut wrong) = (String::new(), String::new());
    for (code, shown, text) in replaced.chain(trees) {
        let found = mistakes_in(&text, "");
        writeln!(table, "{code} in {shown}").unwrap();
        for found in &found {
            writeln!(table, "    {}", found.text().replace("\n\n", "\n").replace('\n', "\n    ")).unwrap();
        }
        if found.iter().map(|found| found.code).collect::<Vec<_>>() != [code] {
            writeln!(wrong, "{code} in {shown}: {found:#?}").unwrap();
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    insta::assert_snapshot!(table);
}

#[test]
fn every_mistake_about_a_file_is_explained() {
    let mut table = String::new();
    for (code, line) in STRUCTS {
        let input = syn::parse_str(&format!("{line} struct Arm;")).unwrap();
        let found = generate_with(&input, no_files).unwrap_err().take();
        assert_eq!(found.iter().map(|found| found.code).collect::<Vec<_>>(), [*code], "{line}: {found:#?}");
        writeln!(table, "{code} in {line}\n    {}\n    help: {}", found[0].message, found[0].help_text())
            .unwrap();
    }
    insta::assert_snapshot!(table);
}

/// Mistakes beside the arm's file, in which the root is `base` and the one joint is `q`, which carries `a`.
const BESIDE: &[(Code, &str)] = &[
    (Code::JointUnknown, "#[joint(qq, damping = 0.1)]"),
    (Code::JointUnknown, "#[joint(elbow, damping = 0.1)]"),
    (Code::NameDuplicate, "#[joint(q, damping = 0.1)] #[joint(q, friction = 0.1)]"),
    (Code::NameDuplicate, "#[joint(r: fixed, a -> b)] #[joint(r, at = [0, 0, 1])]"),
    (Code::JointUnknown, "#[joint([q, p], damping = 0.1)]"),
    (Code::Syntax, "#[joint([q p], damping = 0.1)]"),
    (Code::Syntax, "#[joint([q] p, damping = 0.1)]"),
    (Code::Syntax, "#[joint([], damping = 0.1)]"),
    (Code::KeysConflict, "#[joint(q, screw(z, [0, 0, 0]))]"),
    (Code::KeyUnknown, "#[joint(q, dampng = 0.1)]"),
    (Code::PassiveNegative, "#[joint(q, damping = -0.1)]"),
    (Code::UnitMismatch, "#[joint(q, stiffness = 3kg)]"),
    (Code::DegreesOfFreedomMissing, "#[joint(q, locked = 30deg)]"),
    (Code::LimitsInverted, "#[joint(q, limits = [1, 0])]"),
    (Code::MimicCycle, "#[joint(q, mimic = q)]"),
    (Code::ParentTwice, "#[dynamics(base = free)] #[joint(rail: prismatic(x), world -> base)]"),
    (Code::NameDuplicate, "#[dynamics(base = free)] #[joint(root_joint: fixed, a -> b)]"),
];

#[test]
fn every_mistake_beside_a_file_is_explained() {
    let mut table = String::new();
    for (code, lines) in BESIDE {
        let text = format!("#[dynamics(urdf = \"arm.urdf\")] {lines} struct Arm;");
        let found = generate_with(&syn::parse_str(&text).unwrap(), |_| Ok(ARM.as_bytes().to_vec()));
        let found = found.unwrap_err().take();
        assert_eq!(found.iter().map(|found| found.code).collect::<Vec<_>>(), [*code], "{lines}: {found:#?}");
        writeln!(table, "{code} in {lines}\n    {}\n    help: {}", found[0].message, found[0].help_text())
            .unwrap();
    }
    insta::assert_snapshot!(table);
}

#[test]
fn the_world_cannot_be_free() {
    let found = mistakes_in(&ARM.replace("\"base\"", "\"world\""), "base = free");
    let message = "the root of the file is the link `world`, which cannot move";
    assert_eq!((found[0].code, found[0].message.as_str(), found.len()), (Code::WorldIsChild, message, 1));
}

/// A file that is wrong in many places says so in one go.
#[test]
fn all_mistakes_are_reported_at_once() {
    let text = ARM.replace("\"0.5\"", "\"0,5\"").replace("<mass value=\"1\"/>", "");
    let found = mistakes_in(&text, "");
    let codes: Vec<_> = found.iter().map(|found| found.code).collect();
    assert_eq!(codes, [Code::ElementMissing, Code::NumberInvalid, Code::NumberInvalid, Code::NumberInvalid]);
}
