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
            let text = dynamics(&[&["eval", &model(robot), "--state", &given], *options].concat()).ok();
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
    let n = found["joints"].as_array().unwrap().len() as f64;
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
        ("da_dtau", "Minv", DERIVATIVES, 0.0),
    ] {
        close(robot, ours, &found[ours], &state[theirs], tolerance, floor);
    }
    let h: Vec<f64> = numbers(&state["Cv"]).iter().zip(numbers(&state["g"])).map(|(Cv, g)| Cv + g).collect();
    close(robot, "h", &found["h"], &json!(h), ROUNDING, largest(&state["Cv"]));
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
        serde_json::from_str(&dynamics_on(urdf.as_bytes(), &["eval", "-", "--state", &state]).ok()).unwrap()
    };
    let (here, before, after) = (at(0.3), at(0.3 - 1e-5), at(0.3 + 1e-5));
    let (M, Minv) = (numbers(&here["M"]), numbers(&here["da_dtau"]));
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
