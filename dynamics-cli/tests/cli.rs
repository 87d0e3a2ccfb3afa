//! The binary, from outside: what it prints, writes and exits with.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

#[path = "cli/absent.rs"]
mod absent;
#[path = "cli/check.rs"]
mod check;
#[path = "cli/eval.rs"]
mod eval;
#[path = "cli/explain.rs"]
mod explain;
#[path = "cli/generate.rs"]
mod generate;
#[path = "cli/letters.rs"]
mod letters;
#[path = "cli/mistakes.rs"]
mod mistakes;
#[path = "cli/pictures.rs"]
mod pictures;
#[path = "cli/readme.rs"]
mod readme;
#[path = "cli/report.rs"]
mod report;
#[path = "cli/rollouts.rs"]
mod rollouts;
#[path = "cli/rust.rs"]
mod rust;
#[path = "cli/simulate.rs"]
mod simulate;
#[path = "cli/terms.rs"]
mod terms;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

/// The published robots, and what they need to be accepted.
const ROBOTS: &[(&str, &[&str])] = &[
    ("cartpole", &[]),
    ("double_pendulum", &[]),
    ("double_pendulum_continuous", &[]),
    ("scara", &[]),
    ("puma560", &["--allow", "nonphysical_inertia"]),
    ("iiwa14", &[]),
    ("hyq", &["--base", "free"]),
    ("puma560_armature", PUMA_ROTORS),
];

/// The PUMA with what a URDF has no word for.
const PUMA_ROTORS: &[&str] = &[
    "--allow",
    "nonphysical_inertia",
    "--joint",
    "joint1, armature = 0.784029968642",
    "--joint",
    "joint2, armature = 2.324814845",
    "--joint",
    "joint3, armature = 0.576873331938",
    "--joint",
    "joint4, armature = 0.19079062612368",
    "--joint",
    "joint5, armature = 0.17070629165700002",
    "--joint",
    "joint6, rotor = 0.04851612641700001, gear = 2",
];

/// What a command did.
struct Done {
    code: i32,
    stdout: String,
    stderr: String,
}

impl Done {
    fn of(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Self { code: output.status.code().unwrap(), stdout: text(output.stdout), stderr: text(output.stderr) }
    }

    /// The output of a command that has nothing to complain about.
    fn ok(self) -> String {
        assert_eq!((self.code, self.stderr.as_str()), (0, ""), "{}", self.stdout);
        self.stdout
    }

    /// The output of a simulation of which there is nothing to say but that joints passed their limits.
    fn unstopped(self) -> String {
        let said = self.stderr.lines().all(|line| line.ends_with(": a simulation has no stops"));
        assert!(self.code == 0 && said, "{}", self.stderr);
        self.stdout
    }

    /// The complaint of a command that printed nothing else, and did not fall over.
    fn failed(self, code: i32) -> String {
        let Self { stdout, stderr, .. } = self;
        assert_eq!((self.code, stdout.as_str()), (code, ""), "{stderr}");
        assert!(stderr.starts_with("error: ") && !stderr.contains("panicked"), "{stderr}");
        stderr
    }
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_dynamics"));
    // From here, the paths in messages are the same on every machine.
    command.args(arguments).current_dir(robots());
    command
}

fn dynamics(arguments: &[&str]) -> Done {
    Done::of(command(arguments).stdin(Stdio::null()).output().unwrap())
}

/// With a file on standard input.
fn dynamics_on(file: &[u8], arguments: &[&str]) -> Done {
    let pipes = [Stdio::piped(), Stdio::piped(), Stdio::piped()];
    let [stdin, stdout, stderr] = pipes;
    let mut child = command(arguments).stdin(stdin).stdout(stdout).stderr(stderr).spawn().unwrap();
    // It need not read all of it.
    let _ = child.stdin.take().unwrap().write_all(file);
    Done::of(child.wait_with_output().unwrap())
}

fn robots() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/robots")
}

fn model(robot: &str) -> String {
    format!("{robot}/model.urdf")
}

/// The numbers of Pinocchio. Its joints are in the order of their names, and are put into the file's here.
fn reference(robot: &str) -> Value {
    let text = std::fs::read_to_string(robots().join(robot).join("reference.json")).unwrap();
    let file = std::fs::read_to_string(robots().join(model(robot))).unwrap();
    let mut reference: Value = serde_json::from_str(&text).unwrap();
    let place = |joint: &Value| file.find(&format!("<joint name={}", joint["name"]));
    reference["joints"].as_array_mut().unwrap().sort_by_key(place);
    let joints = reference["joints"].as_array().unwrap().clone();
    let order = |index: &str, of_free: usize| -> Vec<usize> {
        let entries = joints.iter().flat_map(|joint| {
            let first = joint[index].as_u64().unwrap() as usize;
            first..first + if joint["type"] == "JointModelFreeFlyer" { of_free } else { 1 }
        });
        entries.collect()
    };
    let of_v = order("idx_v", 6);
    // Angles are two numbers there in the index of a continuous joint, and one in a state.
    let is_free = reference["states"][0]["q"].as_array().unwrap().len() > of_v.len();
    let of_q = if is_free { order("idx_q", 7) } else { of_v.clone() };
    let permuted =
        |items: &Value, order: &[usize]| -> Vec<Value> { order.iter().map(|&k| items[k].clone()).collect() };
    for state in reference["states"].as_array_mut().unwrap() {
        state["q"] = permuted(&state["q"], &of_q).into();
        for vector in ["v", "a", "tau", "tau2", "g", "Cv", "a_fd"] {
            state[vector] = permuted(&state[vector], &of_v).into();
        }
        for matrix in ["M", "C", "Minv", "dtau_dq", "dtau_dv", "da_dq", "da_dv"] {
            let rows = permuted(&state[matrix], &of_v);
            state[matrix] = rows.iter().map(|row| permuted(row, &of_v)).collect::<Vec<_>>().into();
        }
        for matrix in ["J_local", "J_lwa"] {
            let rows = state["ee"][matrix].as_array().unwrap().clone();
            state["ee"][matrix] = rows.iter().map(|row| permuted(row, &of_v)).collect::<Vec<_>>().into();
        }
    }
    reference
}

/// An empty folder of a test's own.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn the_version_and_the_help_are_printed() {
    assert_eq!(dynamics(&["--version"]).ok(), format!("dynamics {}\n", env!("CARGO_PKG_VERSION")));
    for command in ["check", "generate", "count", "eval", "simulate", "rollouts", "explain"] {
        let help = dynamics(&[command, "--help"]).ok();
        assert!(help.contains(&format!("dynamics {command} ")) && help.contains("Example"), "{help}");
    }
}

#[test]
fn all_output_is_the_same_each_time() {
    let scara = model("scara");
    let state = r#"{"q": [0.1, 0.2, 0.3, 0.4], "v": [1, 2, 3, 4]}"#;
    for arguments in [
        &["check", &scara][..],
        &["count", &scara],
        &["generate", &scara, "--lang", "rust"],
        &["eval", &scara, "--state", state],
        &["simulate", &scara, "--time", "0.1", "--step", "1e-2"],
    ] {
        assert_eq!(dynamics(arguments).ok(), dynamics(arguments).ok(), "{arguments:?}");
    }
}

#[test]
fn who_stops_reading_is_not_told() {
    let cart = model("cartpole");
    let mut child = command(&["simulate", &cart, "--time", "100", "--step", "1e-2"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let done = Done::of(child.wait_with_output().unwrap());
    assert_eq!((done.code, done.stderr.as_str()), (0, ""));
}

#[test]
fn a_code_is_explained() {
    for asked in ["MassNegative", "dynamics::MassNegative", "massnegative"] {
        let text = dynamics(&["explain", asked]).ok();
        assert!(text.starts_with("dynamics::MassNegative\n\nThe mass is negative.\n\nhelp: "), "{text}");
    }
    assert!(dynamics(&["explain", "MassNegativ"]).failed(1).contains("did you mean `MassNegative`?"));
    let all = dynamics(&["explain"]).ok();
    assert!(all.lines().count() > 50 && all.lines().all(|line| line.contains(": ")), "{all}");
}
