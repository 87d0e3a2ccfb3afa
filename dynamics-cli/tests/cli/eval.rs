//! `dynamics eval`: the numbers of Pinocchio.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use serde_json::{Value, json};

use super::{ROBOTS, dynamics, dynamics_on, folder, model, reference, robots};

/// Two roads in doubles.
const ROUNDING: f64 = 1e-12;
/// Derivatives carry larger terms that cancel.
const DERIVATIVES: f64 = 1e-9;

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        value => vec![value.as_f64().unwrap()],
    }
}

fn largest(value: &Value) -> f64 {
    numbers(value).iter().fold(0.0, |size, x| size.max(x.abs()))
}

fn close(robot: &str, what: &str, found: &Value, expected: &Value, tolerance: f64, floor: f64) {
    let (found, size) = (numbers(found), largest(expected).max(floor));
    let expected = numbers(expected);
    assert_eq!(found.len(), expected.len(), "{robot}: {what}");
    for (found, expected) in found.iter().zip(expected) {
        let off = (found - expected).abs();
        assert!(off <= tolerance * size, "{robot}: {what} is off by {off:e} of {size:e}");
    }
}

#[test]
fn every_robot_has_the_numbers_of_pinocchio() {
    for (robot, options) in ROBOTS {
        let reference = reference(robot);
        let names: Vec<&Value> =
            reference["joints"].as_array().unwrap().iter().map(|joint| &joint["name"]).collect();
        let mut offsets = vec![];
        for state in reference["states"].as_array().unwrap() {
            let given =
                json!({"q": state["q"], "v": state["v"], "a": state["a"], "tau": state["tau2"]}).to_string();
            let text =
                dynamics(&[&["eval", &model(robot), "--state", &given, "--only", "all"], *options].concat())
                    .ok();
            let found: Value = serde_json::from_str(&text).unwrap();
            assert_eq!(found["joints"].as_array().unwrap().iter().collect::<Vec<_>>(), names);
            compare(robot, &found, state);
            let [ours, theirs] = [&found, state].map(|value| value["potential_energy"].as_f64().unwrap());
            offsets.push((ours - theirs, theirs.abs().max(1.0)));
        }
        // Energies of position agree up to a constant.
        for (offset, size) in &offsets {
            assert!((offset - offsets[0].0).abs() <= ROUNDING * size.max(offsets[0].1), "{robot}: V");
        }
    }
}

fn compare(robot: &str, found: &Value, state: &Value) {
    let (mass, inverse) = (largest(&state["M"]), largest(&state["Minv"]));
    let n = found["speeds"].as_array().unwrap().len() as f64;
    // Solving with M multiplies rounding by its condition.
    let solved = ROUNDING.max(f64::EPSILON * mass * inverse * n);
    for (ours, theirs, tolerance, floor) in [
        ("M", "M", ROUNDING, 0.0),
        ("C", "C", ROUNDING, 0.0),
        ("G", "g", ROUNDING, 0.0),
        ("tau", "tau", ROUNDING, 0.0),
        ("a", "a_fd", solved, 0.0),
        ("kinetic_energy", "kinetic_energy", ROUNDING, 0.0),
        ("dtau_dq", "dtau_dq", DERIVATIVES, mass),
        ("dtau_dv", "dtau_dv", DERIVATIVES, mass),
        ("da_dq", "da_dq", DERIVATIVES, inverse * mass),
        ("da_dv", "da_dv", DERIVATIVES, inverse * mass),
        ("Minv", "Minv", DERIVATIVES, 0.0),
    ] {
        close(robot, ours, &found[ours], &state[theirs], tolerance, floor);
    }
    let h: Vec<f64> = numbers(&state["Cv"]).iter().zip(numbers(&state["g"])).map(|(Cv, g)| Cv + g).collect();
    close(robot, "h", &found["h"], &json!(h), ROUNDING, largest(&state["Cv"]));
}

/// Rows of a matrix times a vector.
fn times(matrix: &Value, x: &[f64]) -> Vec<f64> {
    let rows = matrix.as_array().unwrap().iter().map(numbers);
    rows.map(|row| row.iter().zip(x).map(|(m, x)| m * x).sum()).collect()
}

#[test]
fn frames_have_the_kinematics_of_pinocchio() {
    for (robot, options) in ROBOTS {
        let reference = reference(robot);
        let link = reference["ee"]["link"].as_str().unwrap();
        for state in reference["states"].as_array().unwrap().iter().take(4) {
            let given = json!({"q": state["q"], "v": state["v"], "a": state["a"]}).to_string();
            // Pinocchio does not turn angles of twelve digits into right ones.
            let arguments =
                ["eval", &model(robot), "--state", &given, "--only", "M", "--frame", link, "--snap", "off"];
            let found: Value =
                serde_json::from_str(&dynamics(&[&arguments[..], options].concat()).ok()).unwrap();
            let (frame, ee) = (&found["frames"][link], &state["ee"]);
            for (ours, theirs) in [
                ("rotation", "R"),
                ("translation", "p"),
                ("jacobian", "J_local"),
                ("world_jacobian", "J_lwa"),
            ] {
                close(robot, ours, &frame[ours], &ee[theirs], ROUNDING, 1.0);
            }
            let velocity = times(&frame["jacobian"], &numbers(&state["v"]));
            close(robot, "velocity", &frame["velocity"], &json!(velocity), ROUNDING, 1.0);
        }
    }
}

/// Forces are the regressors times their parameters, and momentum is its matrix times the speeds, whatever acts.
#[test]
fn regressors_and_momentum_are_linear() {
    let hyq = model("hyq");
    let options = [
        "--base",
        "free",
        "--joint",
        "lf_kfe_joint, armature = 0.5, damping = 0.2, friction = 0.3, stiffness = 3, rest = 10deg",
        "--joint",
        "rf_kfe_joint, mimic = lf_kfe_joint, ratio = -2, offset = 30deg, damping = 1",
        "--only",
        "tau,Y,Y_base,momentum,A,mass,com_jacobian,h,passive,G,C",
        "--state",
        r#"{"q": {"root_joint.qx": 0.6, "root_joint.qw": 0.8, "lf_kfe_joint": -1, "root_joint.z": 2},
            "v": {"root_joint.vy": 1, "root_joint.wx": -0.5, "lf_kfe_joint": 2, "rh_haa_joint": -1},
            "a": {"root_joint.vz": 3, "lf_kfe_joint": 1}}"#,
    ];
    let found = dynamics(&[&["eval", &hyq], &options[..]].concat()).ok();
    let found: Value = serde_json::from_str(&found).unwrap();
    let names: Vec<&str> =
        found["speeds"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    let speed = |name: &str| match name {
        "root_joint.vy" => 1.0,
        "root_joint.wx" => -0.5,
        "lf_kfe_joint" => 2.0,
        "rh_haa_joint" => -1.0,
        _ => 0.0,
    };
    let v: Vec<f64> = names.iter().map(|name| speed(name)).collect();
    assert_eq!((names.len(), names.contains(&"rf_kfe_joint")), (17, false));
    for [matrix, parameters] in [["Y", "pi"], ["Y_base", "pi_base"]] {
        let tau = json!(times(&found[matrix], &numbers(&found[parameters])));
        close("hyq", matrix, &found["tau"], &tau, 1e-11, 0.0);
    }
    let (names_of, pi) = (found["parameters"].as_array().unwrap(), numbers(&found["pi"]));
    let damping = names_of.iter().position(|name| *name == "rf_kfe_joint.damping").unwrap();
    assert_eq!((pi.len(), pi[damping]), (names_of.len(), 1.0));
    assert_eq!(found["base_parameters"].as_array().unwrap().len(), numbers(&found["pi_base"]).len());
    close("hyq", "A·v", &found["momentum"], &json!(times(&found["A"], &v)), ROUNDING, 0.0);
    let mass = found["mass"].as_f64().unwrap();
    let linear: Vec<f64> = times(&found["com_jacobian"], &v).iter().map(|v| mass * v).collect();
    close("hyq", "m·ċ", &json!(&numbers(&found["momentum"])[..3]), &json!(linear), ROUNDING, 1.0);
    let parts = [times(&found["C"], &v), numbers(&found["G"]), numbers(&found["passive"])];
    let h: Vec<f64> = (0..17).map(|k| parts.iter().map(|part| part[k]).sum()).collect();
    close("hyq", "h", &found["h"], &json!(h), ROUNDING, 0.0);
    // What acts in the leader: its own damper, friction and spring, and twice over those of the follower, which
    // moves at −2 times its speed.
    let own = 0.2 * 2.0 + 0.3 * 2.0 / 2.0_f64.hypot(0.01) + 3.0 * (-1.0 - 10.0_f64.to_radians());
    let leader = names.iter().position(|name| *name == "lf_kfe_joint").unwrap();
    assert!((parts[2][leader] - (own + 4.0 * 2.0)).abs() < 1e-13);
}

#[test]
fn only_what_is_asked_for_is_written() {
    let keys = |options: &[&str]| -> Vec<String> {
        let text = dynamics(&[&["eval", &model("cartpole")], options].concat()).ok();
        let top = text.lines().filter_map(|line| line.strip_prefix("  \"")?.split_once('"'));
        top.map(|(key, _)| key.to_owned()).skip(3).collect()
    };
    assert_eq!(keys(&["--only", "tau,M"]), ["M", "tau"]);
    assert_eq!(keys(&["--only", "Y_base"]), ["Y_base", "base_parameters", "pi_base"]);
    assert_eq!(keys(&["--only", "M", "--frame", "tip", "--frame", "tip"]), ["M", "frames"]);
    assert_eq!((keys(&[]).len(), keys(&["--only", "all", "--frame", "*"]).len()), (14, 27));
    let help = dynamics(&["eval", "--help"]).ok();
    for key in keys(&["--only", "all"]) {
        assert!(help.contains(&key), "{key}");
    }
}

#[test]
fn a_state_may_be_in_a_file_and_the_robot_on_standard_input() {
    let file = folder("eval").join("state.json");
    std::fs::write(&file, r#"{"v": [1, 2]}"#).unwrap();
    let at_file = format!("@{}", file.display());
    let cart = model("cartpole");
    let text = dynamics(&["eval", &cart, "--state", &at_file]).ok();
    assert_eq!(text, dynamics(&["eval", &cart, "--state", r#"{"q": [0, 0.0], "v": [1, 2]}"#]).ok());
    let urdf = std::fs::read(robots().join(&cart)).unwrap();
    assert_eq!(text, dynamics_on(&urdf, &["eval", "-", "--state", &at_file]).ok());
}

/// Above seven joints derivatives are solved for by loops; this is a chain of nine.
#[test]
fn loops_compute_what_the_inverse_is() {
    let mut urdf = "<robot name=\"chain\"><link name=\"l0\"/>".to_owned();
    for k in 1..=9 {
        urdf += &format!(
            "<link name=\"l{k}\"><inertial><origin xyz=\"0.1 0.02 0.3\" rpy=\"0.1 0.2 0.3\"/><mass value=\"1.5\"/>\
             <inertia ixx=\"0.03\" ixy=\"0.001\" ixz=\"0.002\" iyy=\"0.04\" iyz=\"0.003\" izz=\"0.05\"/></inertial>\
             </link><joint name=\"j{k}\" type=\"continuous\"><origin xyz=\"0.1 0.2 0.3\" rpy=\"0.3 0.2 0.1\"/>\
             <parent link=\"l{}\"/><child link=\"l{k}\"/><axis xyz=\"0.1 0.7 0.3\"/></joint>",
            k - 1
        );
    }
    urdf += "</robot>";
    let at = |q0: f64| -> Value {
        let mut q = [0.1; 9];
        q[0] = q0;
        let state = json!({"q": q, "v": vec![0.2; 9], "tau": vec![1; 9]}).to_string();
        serde_json::from_str(
            &dynamics_on(urdf.as_bytes(), &["eval", "-", "--state", &state, "--only", "a,M,Minv,da_dq"]).ok(),
        )
        .unwrap()
    };
    let (here, before, after) = (at(0.3), at(0.3 - 1e-5), at(0.3 + 1e-5));
    let (M, Minv) = (numbers(&here["M"]), numbers(&here["Minv"]));
    let scale = largest(&here["a"]);
    for i in 0..9 {
        for j in 0..9 {
            let product: f64 = (0..9).map(|k| M[9 * i + k] * Minv[9 * k + j]).sum();
            assert!((product - f64::from(u8::from(i == j))).abs() < 1e-9);
        }
        let [before, after] = [&before, &after].map(|at| numbers(&at["a"])[i]);
        let slope = (after - before) / 2e-5;
        assert!((slope - numbers(&here["da_dq"])[9 * i]).abs() < 1e-5 * scale);
    }
}
