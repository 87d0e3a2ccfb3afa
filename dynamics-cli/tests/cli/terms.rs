//! Terms of the energies by options: a spring that no file has a word for.

use serde_json::Value;

use super::{dynamics, model};

const SPRING: &str = "12N_per_m / 2 * (distance(pole, world) - 0.2)^2";

#[test]
fn they_are_listed() {
    let options = [
        "--coordinate",
        "sway: length, stiffness = 40",
        "--potential",
        SPRING,
        "--dissipation",
        "0.2Ns_per_m / 2 * (dot(slider) - dot(sway))^2",
        "--kinetic",
        "0.5kg / 2 * (dot(slider) + dot(sway))^2",
    ];
    let file = model("cartpole");
    insta::assert_snapshot!(dynamics(&[&["check", &file], &options[..]].concat()).ok());
    // And they are in the first lines of what is generated.
    let text =
        dynamics(&[&["generate", &file, "--lang", "rust", "--name", "Cart"], &options[..]].concat()).ok();
    assert!(text.contains("--coordinate 'sway: length, stiffness = 40'"), "{text}");
}

#[test]
fn they_act() {
    let file = model("cartpole");
    let of = |options: &[&str]| -> Value {
        let state = r#"{"q": [0.3, 0.2], "v": [1, 2]}"#;
        let arguments =
            [&["eval", &file, "--state", state, "--only", "G,potential_energy,h"], options].concat();
        serde_json::from_str(&dynamics(&arguments).ok()).unwrap()
    };
    let (bare, sprung) = (of(&[]), of(&["--potential", "12N_per_m / 2 * slider^2"]));
    let damped = of(&["--dissipation", "0.5Ns_per_m / 2 * dot(slider)^2"]);
    let change = |now: &Value, what: &str| {
        let number = |robot: &Value| robot[what].get(0).unwrap_or(&robot[what]).as_f64().unwrap();
        number(now) - number(&bare)
    };
    for (now, what, expected) in [
        (&sprung, "G", 3.6),
        (&sprung, "potential_energy", 0.54),
        (&sprung, "h", 3.6),
        (&damped, "G", 0.0),
        (&damped, "h", 0.5),
    ] {
        assert!((change(now, what) - expected).abs() < 1e-12, "{what}: {now}");
    }
}

#[test]
fn energy_stays_with_a_spring_and_goes_with_a_damper() {
    let arguments =
        ["simulate", &model("cartpole"), "--time", "1", "--step", "1e-3", "--q", "0.2,1", "--every", "1000"];
    let drift = |options: &[&str]| -> f64 {
        let csv = dynamics(&[&arguments[..], options].concat()).unstopped();
        csv.trim_end().rsplit(',').next().unwrap().parse().unwrap()
    };
    assert!(drift(&["--potential", SPRING]).abs() < 1e-9);
    assert!(drift(&["--potential", SPRING, "--dissipation", "2Ns_per_m / 2 * dot(slider)^2"]) < -1e-3);
}

#[test]
fn mistakes_are_shown_in_them() {
    let of = |option: &str, text: &str| dynamics(&["check", &model("cartpole"), option, text]).failed(1);
    insta::assert_snapshot!(
        [
            of("--kinetic", "0.5kg * dot(slider)"),
            of("--potential", "12N_per_m * slidr^2"),
            of("--potential", "12 * slider^2"),
            of("--coordinate", "sway: metre"),
        ]
        .join("\n")
    );
}
