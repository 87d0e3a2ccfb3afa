//! `dynamics generate`: a file that stays as it is, compiles without a warning, and has the numbers of Pinocchio.

use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

use dynamics_codegen::generate_with;
use serde_json::Value;

use super::{ROBOTS, dynamics, folder, model, reference};

#[test]
fn a_file_is_checked_for_being_as_it_would_be_written() {
    let folder = folder("generate");
    let out = folder.join("cart.rs");
    let out = out.to_str().unwrap();
    let cart = model("cartpole");
    let write = ["generate", &cart, "--lang", "rust", "--name", "Cart", "-o", out];
    let check = [&write[..], &["--check"]].concat();
    assert!(dynamics(&check).failed(1).contains("cannot be read"));
    assert_eq!(dynamics(&write).ok(), "");
    assert_eq!(dynamics(&check).ok(), "");
    let text = std::fs::read_to_string(out).unwrap();
    assert_eq!(text, dynamics(&write[..6]).ok());
    std::fs::write(out, text.replace('\n', "\r\n")).unwrap();
    assert_eq!(dynamics(&check).ok(), "");
    let stale = text.replacen("pub struct", "struct", 1);
    std::fs::write(out, &stale).unwrap();
    let complaint = dynamics(&check).failed(1);
    let again = format!("run `dynamics generate {cart} --lang rust --name Cart -o {out}`");
    assert!(complaint.contains("is stale: it differs from line 7 on"), "{complaint}");
    assert!(complaint.contains(&again), "{complaint}");
    assert_eq!(std::fs::read_to_string(out).unwrap(), stale);
    let onto_itself = ["generate", &cart, "--lang", "rust", "-o", &cart];
    assert!(dynamics(&onto_itself).failed(1).contains("it is the input"));
}

/// What options say is what attributes of the derive say, byte for byte.
#[test]
fn options_are_attributes() {
    let options = [
        "--base",
        "free",
        "--gravity",
        "[0, 0, -1.62]",
        "--joint",
        "lf_kfe_joint, rotor = 5e-5, gear = 100,\n damping = 0.2",
        "--joint",
        "rf_kfe_joint, mimic = lf_kfe_joint, ratio = -1 // mirrored",
        "--joint",
        "rh_kfe_joint, locked = 30deg",
        "--joint",
        "strap: fixed, trunk -> load, at = [0, 0, 0.1]",
        "--body",
        "load, solid = point(8kg)",
        "--passive",
        "off",
        "--snap",
        "off",
    ];
    let file = model("hyq");
    let arguments = ["generate", &file, "--lang", "rust", "--name", "Hyq"];
    let written = dynamics(&[&arguments[..], &options].concat()).ok();
    let input = syn::parse_quote! {
        #[dynamics(urdf = "hyq.urdf", base = free, gravity = [0, 0, -1.62], passive = off, snap = off)]
        #[joint(lf_kfe_joint, rotor = 5e-5, gear = 100, damping = 0.2)]
        #[joint(rf_kfe_joint, mimic = lf_kfe_joint, ratio = -1)]
        #[joint(rh_kfe_joint, locked = 30deg)]
        #[joint(strap: fixed, trunk -> load, at = [0, 0, 0.1])]
        #[body(load, solid = point(8kg))]
        pub struct Hyq;
    };
    let read = |_: &str| Ok(std::fs::read(super::robots().join(&file)).unwrap());
    let derived = generate_with(&input, read).unwrap_or_else(|wrong| panic!("{}", wrong.into_text()));
    let (head, impls) = written.split_once("pub struct Hyq;\n\n").unwrap();
    let same = derived.lines().zip(impls.lines()).take_while(|(one, other)| one == other).count();
    let tracking = derived.strip_prefix(impls).unwrap_or_else(|| {
        panic!("{:?} is not {:?}", derived.lines().nth(same), impls.lines().nth(same));
    });
    assert!(tracking.starts_with("const _: &[u8] = ::core::include_bytes!") && tracking.lines().count() == 1);
    // The head has a command that a shell takes as it is.
    let again = "--name Hyq --base free --gravity '[0, 0, -1.62]' --joint 'lf_kfe_joint, rotor = 5e-5, gear = 100,  \
                 damping = 0.2' --joint";
    assert!(head.contains(again), "{head}");
}

/// What is asked for is there with what it calls, and nothing else.
#[test]
fn only_some_outputs_are_written() {
    let folder = folder("outputs");
    let out = folder.to_str().unwrap();
    let outputs = "inverse_dynamics,forward_dynamics_derivatives";
    let file = model("hyq");
    let c = [
        "generate",
        &file,
        "--base",
        "free",
        "--lang",
        "c",
        "--name",
        "dog",
        "--outputs",
        outputs,
        "-o",
        out,
    ];
    assert_eq!(dynamics(&c).ok(), "");
    let header = std::fs::read_to_string(folder.join("dog.h")).unwrap();
    assert!(header.contains(&format!(" --outputs '{outputs}'\n")), "{header}");
    let declared = header.lines().filter_map(|line| line.strip_prefix("void dog_")?.split('(').next());
    let declared: Vec<&str> = declared.collect();
    let called = ["forward_dynamics", "inverse_derivatives"]; // by the loops of a robot of this size
    let mut expected = vec!["neutral", "integrate", "difference", "inverse_dynamics", "forward_derivatives"];
    expected.extend(called);
    expected.sort_unstable();
    let mut sorted = declared.clone();
    sorted.sort_unstable();
    assert_eq!(sorted, expected);
    let compiled = Command::new("cc")
        .current_dir(&folder)
        .args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-c", "dog.c"])
        .output();
    let compiled = compiled.unwrap();
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));

    let rust = dynamics(&["generate", &file, "--lang", "rust", "--outputs", "gravity_forces"]).ok();
    assert!(rust.contains("fn gravity_forces<") && !rust.contains("fn bias_forces<"));
    let complaint = dynamics(&["generate", &file, "--lang", "c", "--outputs", "inverse_dynamic"]).failed(1);
    assert!(complaint.contains("did you mean `inverse_dynamics`?"), "{complaint}");
}

#[test]
fn a_file_says_where_it_is_from() {
    let text = dynamics(&["generate", &model("cartpole"), "--lang", "rust", "--snap", "off"]).ok();
    let head = format!(
        "// @generated by dynamics {} from model.urdf. Do not edit.\n\
         // Again: dynamics generate model.urdf --lang rust --name Cartpole --snap off -o …\n",
        env!("CARGO_PKG_VERSION")
    );
    assert!(text.starts_with(&head), "{}", &text[..400]);
    assert!(text.contains("\npub struct Cartpole;\n"));
}

/// A crate of the generated files compiles, with warnings denied, and computes what the references say.
#[test]
fn generated_files_compile_and_have_the_numbers_of_pinocchio() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("generated");
    std::fs::create_dir_all(folder.join("src")).unwrap();
    let mut main = MAIN.to_owned();
    for (robot, options) in ROBOTS {
        let file = folder.join("src").join(format!("{robot}.rs"));
        let arguments = ["generate", &model(robot), "--lang", "rust", "--name", "Arm", "-o"];
        dynamics(&[&arguments[..], &[file.to_str().unwrap()], options].concat()).ok();
        let _ = write!(main, "{}", checks(robot, &reference(robot)));
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let manifest = format!(
        "[package]\nname = \"generated\"\nedition = \"2024\"\n[workspace]\n\
         [dependencies]\ndynamics-core = {{ path = {:?} }}\n",
        root.join("dynamics-core")
    );
    std::fs::write(folder.join("Cargo.toml"), manifest).unwrap();
    std::fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    std::fs::write(folder.join("src/main.rs"), main + "}\n").unwrap();
    let cargo = Command::new(env!("CARGO"))
        .args(["run", "--quiet", "--offline"])
        .current_dir(&folder)
        .env("CARGO_TARGET_DIR", folder.join("target"))
        .output()
        .unwrap();
    assert!(cargo.status.success(), "{}", String::from_utf8_lossy(&cargo.stderr));
}

/// What stands before the checks of the robots.
const MAIN: &str = "//! Generated robots, and the numbers they should have.
#![deny(warnings, missing_docs, unreachable_pub)]

use dynamics_core::prelude::*;

mod cartpole;
mod double_pendulum;
mod double_pendulum_continuous;
mod hyq;
mod iiwa14;
mod puma560;
mod puma560_armature;
mod scara;

fn close<const R: usize, const C: usize>(found: SMatrix<f64, R, C>, by_rows: &[f64], tolerance: f64) {
    let expected = SMatrix::<f64, R, C>::from_row_slice(by_rows);
    let size = expected.amax().max(f64::MIN_POSITIVE);
    assert!((found - expected).amax() <= tolerance * size, \"{found} is not {expected}\");
}

fn main() {
";

/// The checks of a robot at its first states.
fn checks(robot: &str, reference: &Value) -> String {
    let mut text = String::new();
    for state in reference["states"].as_array().unwrap().iter().take(3) {
        let vector = |name: &str| format!("SVector::from({})", floats(&state[name]));
        let rows = |name: &str| {
            let rows: Vec<String> = state[name].as_array().unwrap().iter().map(floats).collect();
            format!("&[{}].concat()", rows.join(", "))
        };
        let _ = write!(
            text,
            "    let (q, v, a, tau) = ({}, {}, {}, {});\n    let arm = {robot}::Arm;\n",
            vector("q"),
            vector("v"),
            vector("a"),
            vector("tau2")
        );
        let [mass, inertia] = ["M", "Minv"].map(|name| largest(&state[name]));
        let n = state["v"].as_array().unwrap().len() as f64;
        let solved = 1e-12_f64.max(f64::EPSILON * mass * inertia * n);
        for (call, expected, tolerance) in [
            ("mass_matrix(&q)", rows("M"), 1e-12),
            ("coriolis_matrix(&q, &v)", rows("C"), 1e-12),
            ("gravity_forces(&q)", format!("&{}", floats(&state["g"])), 1e-12),
            ("inverse_dynamics(&q, &v, &a)", format!("&{}", floats(&state["tau"])), 1e-12),
            ("forward_dynamics(&q, &v, &tau)", format!("&{}", floats(&state["a_fd"])), solved),
            ("forward_dynamics_derivatives(&q, &v, &tau).da_dtau", rows("Minv"), 1e-9),
        ] {
            let _ = writeln!(text, "    close(arm.{call}, {expected}, {tolerance:e});");
        }
    }
    text
}

fn floats(value: &Value) -> String {
    let numbers: Vec<f64> = value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    format!("{numbers:?}")
}

fn largest(value: &Value) -> f64 {
    let rows = value.as_array().unwrap().iter().flat_map(|row| row.as_array().unwrap());
    rows.map(|x| x.as_f64().unwrap().abs()).fold(0.0, f64::max)
}

/// A header and a source, which the C compiler that links Rust takes without a remark.
#[test]
fn c_is_two_files_that_compile() {
    let folder = folder("generate_c");
    let out = folder.to_str().unwrap();
    let iiwa = model("iiwa14");
    let write = ["generate", &iiwa, "--lang", "c", "--scalar", "float", "--name", "iiwa14", "-o", out];
    let check = [&write[..], &["--check"]].concat();
    assert!(dynamics(&check).failed(1).contains("cannot be read"));
    assert_eq!(dynamics(&write).ok(), "");
    assert_eq!(dynamics(&check).ok(), "");
    let header = std::fs::read_to_string(folder.join("iiwa14.h")).unwrap();
    assert!(
        header.contains("void iiwa14_mass_matrix(const float q[IIWA14_NQ], float M[IIWA14_NV][IIWA14_NV]);")
    );
    let source = folder.join("iiwa14.c");
    let warnings =
        ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Wdouble-promotion", "-Werror"];
    let compiled = Command::new("cc")
        .args(warnings)
        .args(["-c", "-o"])
        .arg(folder.join("iiwa14.o"))
        .arg(&source)
        .output();
    let compiled = compiled.unwrap();
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let text = std::fs::read_to_string(&source).unwrap();
    std::fs::write(&source, text.replacen("const float", "float", 1)).unwrap();
    let complaint = dynamics(&check).failed(1);
    assert!(complaint.contains("iiwa14.c is stale"), "{complaint}");
    assert!(complaint.contains(&format!("--lang c --scalar float --name iiwa14 -o {out}`")), "{complaint}");
}

#[test]
fn a_name_that_c_cannot_have_is_refused() {
    let iiwa = model("iiwa14");
    let named = |name: &str| dynamics(&["generate", &iiwa, "--lang", "c", "--name", name]).failed(2);
    assert!(named("Iiwa").contains("a prefix is of small letters"));
    assert!(named("a_long_prefix").contains("at most 11 characters"));
}
