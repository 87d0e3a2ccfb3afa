//! The mistakes as users see them: each file of `ui/` does not compile, and says exactly what its `.stderr` says.
//!
//! `TRYBUILD=overwrite cargo test -p dynamics-macros --test ui` writes the texts anew.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::path::Path;
use std::process::Command;

use dynamics_codegen::diagnostics::Code;

/// The toolchain whose wording the texts have.
const PINNED: &str = "rustc 1.95.";

/// No robot has it: it would be a mistake of the compiler.
const WITHOUT_A_FILE: Code = Code::SelfCheckFailed;

/// Mistakes in a file that a robot names. rustc points at Rust alone, so these say file, line and column in the
/// text; the texts are snapshots of the compiler's own tests (`dynamics-codegen/tests/urdf.rs`).
const IN_FILES: [Code; 13] = [
    Code::FileUnreadable,
    Code::PathOutside,
    Code::FileTooLarge,
    Code::XmlInvalid,
    Code::RobotMissing,
    Code::XacroLeft,
    Code::ElementMissing,
    Code::NumberInvalid,
    Code::ChildUnknown,
    Code::RootsSeveral,
    Code::LimitsMissing,
    Code::JointUnknown,
    Code::PassiveUnsupported,
];

/// The codes that have a file here.
fn shown() -> impl Iterator<Item = Code> {
    Code::ALL.iter().copied().filter(|code| *code != WITHOUT_A_FILE && !IN_FILES.contains(code))
}

fn ui() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("ui")
}

#[test]
#[allow(clippy::print_stderr, reason = "the reason for a skipped test is told")]
fn mistakes_are_explained_at_their_tokens() {
    let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    let version = Command::new(rustc).arg("--version").output().unwrap();
    let version = String::from_utf8_lossy(&version.stdout).into_owned();
    if !version.starts_with(PINNED) {
        eprintln!("skipped: the texts are those of {PINNED}*, and this is {}", version.trim());
        return;
    }
    trybuild::TestCases::new().compile_fail("ui/*.rs");
}

#[test]
fn every_code_has_a_file_that_shows_it() {
    for code in shown() {
        let text = std::fs::read_to_string(ui().join(code.name()).with_extension("stderr"));
        let text = text.unwrap_or_else(|_| panic!("{code} has no ui/{}.stderr", code.name()));
        assert!(
            text.contains(&format!("= note: {code}\n")),
            "ui/{}.stderr does not show {code}",
            code.name()
        );
    }
}

/// A mistake is one error, also where the robot is used afterwards; and nothing warns beside it.
#[test]
fn one_mistake_is_one_error() {
    for code in shown() {
        let text = std::fs::read_to_string(ui().join(code.name()).with_extension("stderr")).unwrap();
        let errors =
            text.lines().filter(|line| line.starts_with("error") && !line.starts_with("error: aborting"));
        let notes = text.matches("= note: dynamics::").count();
        assert_eq!(errors.count(), notes, "ui/{}.stderr has errors that are not ours", code.name());
        assert!(!text.contains("warning"), "ui/{}.stderr has warnings", code.name());
    }
}
