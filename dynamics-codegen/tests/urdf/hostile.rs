//! Files that nobody wrote to be read: they are refused quickly, with a word.

use std::fmt::Write;

use super::{ARM, arm_with, mistakes_in, read};
use dynamics_codegen::diagnostics::{Code, Place};
use dynamics_codegen::spec::urdf::{SIZE_LIMIT, text_of};
use dynamics_codegen::{derive, generate_with};

fn refused(text: &str) -> Code {
    // What took long would be noticed by whoever waits for the tests.
    let found = mistakes_in(text, "");
    assert!((1..=100).contains(&found.len()), "{} mistakes", found.len());
    assert!(found.iter().all(|found| found.text().len() < 2000), "mistakes are short");
    found[0].code
}

#[test]
fn what_is_too_large_is_refused() {
    let deep = format!("<robot>{}{}</robot>", "<a>".repeat(50_000), "</a>".repeat(50_000));
    assert_eq!(refused(&deep), Code::FileTooLarge);
    assert_eq!(refused(&"<a>".repeat(50_000)), Code::FileTooLarge);
    let at_limit = arm_with(
        "<link name=\"base\"/>",
        &format!("<link name=\"base\"/>{}{}", "<x>".repeat(63), "</x>".repeat(63)),
    );
    assert!(mistakes_in(&at_limit, "").is_empty());
    assert_eq!(
        refused(&at_limit.replacen("<x>", "<x><x>", 1).replacen("</x>", "</x></x>", 1)),
        Code::FileTooLarge
    );
    assert_eq!(
        refused(&arm_with("</robot>", &format!("{}</robot>", "<a/>".repeat(1_000_001)))),
        Code::FileTooLarge
    );
    assert_eq!(
        refused(&arm_with("</robot>", &format!("{}</robot>", "<a/> ".repeat(600_000)))),
        Code::FileTooLarge
    );
    assert_eq!(refused(&" ".repeat(SIZE_LIMIT + 1)), Code::FileTooLarge);
    let attributes: String = (0..1_000_000).map(|k| format!(" a{k}=''")).collect();
    assert_eq!(refused(&format!("<robot{attributes}/>")), Code::FileTooLarge);
    let spaces: String = (0..2000).map(|k| format!("<a xmlns:n{k}='u{k}'/>")).collect();
    assert_eq!(refused(&format!("<robot>{spaces}</robot>")), Code::FileTooLarge);
}

#[test]
fn what_is_wrong_a_hundred_thousand_times_is_said_a_hundred_times() {
    let lines = |line: &dyn Fn(usize) -> String| {
        let lines: String = (0..100_000).map(line).collect();
        format!("<robot name='many'>{lines}</robot>")
    };
    assert_eq!(refused(&lines(&|_| "<link name=''/>".to_owned())), Code::NameReserved);
    assert_eq!(refused(&lines(&|_| "<link name='a'/>".to_owned())), Code::JointMissing);
    assert_eq!(refused(&lines(&|k| format!("<link name='a{k}'/>"))), Code::JointMissing);
    let joints = lines(&|k| {
        format!(
            "<link name='a{k}'/><joint name='j{k}' type='continuous'><parent link='x{k}'/><child link='y{k}'/></joint>"
        )
    });
    assert_eq!(refused(&joints), Code::ParentUnknown);
    // A line of many megabytes, none of them ASCII.
    let letters = arm_with("value=\"1\"", &format!("value=\"1\" é=\"{}\"", "é".repeat(4_000_000)));
    assert_eq!(refused(&letters.replace("<child link=\"a\"/>", "")), Code::ElementMissing);
    assert_eq!(
        refused(&arm_with("name=\"q\"", &format!("name=\"{}\"", "q".repeat(1_000_000)))),
        Code::NameReserved
    );
    assert_eq!(refused(&arm_with("\"base\"", &format!("\"{}\"", "b".repeat(200)))), Code::ParentUnknown);
}

#[test]
fn what_is_no_text_is_refused_at_its_place() {
    let mut latin = ARM.as_bytes().to_vec();
    latin[13] = 0xe9;
    let wrong = text_of("arm.urdf", &latin).unwrap_err();
    assert_eq!(wrong.message, "the file is not in UTF-8: here is the byte 0xe9");
    assert!(matches!(wrong.place, Place::Text { line: 1, column: 14, .. }), "{:?}", wrong.place);
    let wide: Vec<u8> = [0xfeff].into_iter().chain(ARM.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    assert_eq!(text_of("arm.urdf", &wide).unwrap_err().message, "the file is in UTF-16");
}

#[test]
fn a_byte_order_mark_is_no_mistake() {
    let (spec, _) = read(&format!("\u{feff}{ARM}"), "");
    assert!(matches!(spec.bodies[0].name.place, Place::Text { line: 2, column: 15, .. }));
    let found = mistakes_in(&format!("\u{feff}{}", ARM.replace("<robot", "<robo")), "");
    assert!(found[0].text().starts_with("arm.urdf:"), "{}", found[0].text());
}

/// Columns are those of characters, however long the line is.
#[test]
fn places_are_lines_and_columns_of_characters() {
    for padding in [0, 10, 1023, 1024, 1025, 5000] {
        let comment = format!("<!--{}--><mass", "ü".repeat(padding));
        let text = ARM.replace("<mass", &comment).replace("value=\"1\"", "value=\"x\"");
        let found = mistakes_in(&text, "");
        let expected = 6 + 7 + padding as u32 + 13;
        let Place::Text { line: 6, column, .. } = found[0].place else { panic!("{:?}", found[0].place) };
        assert_eq!(column, expected + 1, "{padding}");
    }
}

/// A name in a file cannot become code.
#[test]
fn names_are_no_code() {
    let text = ARM.replace("\"q\"", "\"&quot;]; fn evil() {} \\\"").replace("\"a\"", "\"*/ } fn evil() {}\"");
    let input: syn::DeriveInput = syn::parse_str("#[dynamics(urdf = \"arm.urdf\")] pub struct Arm;").unwrap();
    let code = generate_with(&input, |_| Ok(text.clone().into_bytes()));
    let code = code.unwrap_or_else(|wrong| panic!("{}", wrong.into_text()));
    let file = syn::parse_file(&code).unwrap();
    let functions = file.items.iter().filter(|item| matches!(item, syn::Item::Fn(_)));
    assert_eq!(functions.count(), 0);
    assert!(code.contains(r#""\"]; fn evil() {} \\""#), "the name is kept");
}

/// As large as a file gets before a robot of its size is refused.
#[test]
fn ten_thousand_joints_are_judged() {
    let mut text = "<robot name='chain'>\n<link name='link0'/>\n".to_owned();
    for k in 1..=10_000 {
        writeln!(
            text,
            "<link name='link{k}'>\n  <inertial>\n    <origin xyz='0.01 -0.02 0.{k}' rpy='0 0.3 0'/>\n    <mass value='1.{k}'/>\n    \
             <inertia ixx='0.0123' ixy='1e-5' ixz='0' iyy='0.0234' iyz='0' izz='0.0198'/>\n  </inertial>\n</link>\n\
             <joint name='joint{k}' type='revolute'>\n  <origin xyz='0 0.1 0.25' rpy='1.5707963267948966 0 0'/>\n  \
             <parent link='link{}'/>\n  <child link='link{k}'/>\n  <axis xyz='0 0 1'/>\n  \
             <limit lower='-2.9670597283903604' upper='2.9670597283903604' effort='320' velocity='1.4'/>\n</joint>",
            k - 1
        )
        .unwrap();
    }
    text.push_str("</robot>\n");
    let found = mistakes_in(&text, "");
    assert_eq!(found.iter().map(|found| found.code).collect::<Vec<_>>(), [Code::JointsTooMany]);
}

/// No file that is cut off, or has a byte doubled or lost, makes the derive panic.
#[test]
fn no_slip_of_one_byte_panics() {
    let input: proc_macro2::TokenStream = "#[dynamics(urdf = \"arm.urdf\")] struct Arm;".parse().unwrap();
    let more = r#"<dynamics damping="0.5" friction="0.1"/><mimic joint="q" multiplier="2"/><limit"#;
    let arm = arm_with("<limit", more);
    for at in 0..arm.len() {
        let (head, tail) = arm.split_at(at);
        let rest = &tail[1..];
        for text in [
            head.to_owned(),
            format!("{head}{rest}"),
            format!("{head}{}{tail}", &tail[..1]),
            format!("{head}<{rest}"),
        ] {
            for found in mistakes_in(&text, "") {
                assert!(!found.message.is_empty() && !found.help_text().is_empty());
            }
        }
    }
    let output = derive(input, |_| Ok(b"<robot".to_vec())).to_string();
    assert!(output.contains("compile_error") && output.contains("arm.urdf:1:"), "{output}");
}
