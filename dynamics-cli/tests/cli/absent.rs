//! States at which the equations have no value, or not all of them.

use serde_json::Value;

use super::{Done, dynamics, dynamics_on, folder, model};

/// A top by Euler's angles, which no number can say of it when it stands upright; one in polar coordinates; and terms that
/// are not smooth where points meet.
const ROBOTS: &str = r#"
    #[derive(Dynamics)]
    #[joint(phi: revolute(z), world -> a)] #[body(a)]
    #[joint(theta: revolute(x), a -> b)] #[body(b)]
    #[joint(psi: revolute(z), b -> c)]
    #[body(c, mass = 1, com = [0, 0, 0.3], inertia = diag(0.1, 0.1, 0.05))]
    struct Top;

    #[derive(Dynamics)]
    #[joint(theta: revolute(z), world -> a)] #[body(a)]
    #[joint(r: prismatic(x), a -> b)] #[body(b, solid = point(2))]
    struct Polar;

    #[derive(Dynamics)]
    #[joint(x: prismatic(x), world -> a, armature = 1e-18kg)] #[body(a)]
    #[joint(y: prismatic(y), a -> b)] #[body(b)]
    #[joint(t: revolute(z), b -> c)]
    #[body(c, solid = point(4), com = [0.25, 0.34, 0.34])]
    struct Light;

    #[derive(Dynamics)]
    #[joint(t: translation, world -> b)] #[body(b, solid = sphere(1, 0.1))]
    #[potential(3N_per_m / 2 * (distance(b, world) - 1)^2)]
    struct Tied;

    #[derive(Dynamics)]
    #[coordinate(x: length)]
    #[kinetic(2kg / 2 * dot(x)^2)]
    #[potential(5N * sqrt(1 - x^2))]
    struct Root;

    #[derive(Dynamics)]
    #[coordinate(x: length)]
    #[kinetic(2kg * 1m / 2 * dot(x)^2 / x)]
    struct Quotient;
"#;

fn on(robot: &str, command: &[&str]) -> Done {
    // Tests run side by side.
    let file = folder(&format!("absent_{robot}_{}", command.concat().len())).join("robots.rs");
    std::fs::write(&file, ROBOTS).unwrap();
    let (name, rest) = command.split_first().unwrap();
    dynamics(&[&[name, file.to_str().unwrap(), "--robot", robot], rest].concat())
}

/// What `eval` prints and complains about where something has no value.
fn partly(done: Done) -> (Value, String) {
    assert_eq!(done.code, 1, "{}", done.stderr);
    (serde_json::from_str(&done.stdout).unwrap(), done.stderr)
}

#[test]
fn what_needs_no_inverse_has_its_value_where_there_is_none() {
    let (values, complaint) = partly(on("Top", &["eval"]));
    assert_eq!(values["M"][0], values["M"][2], "two rows are one");
    assert!(values["Minv"].is_null() && values["a"].is_null(), "{values}");
    assert!(values["C"].is_array() && values["potential_energy"].is_number(), "{values}");
    let expected = "`Minv` and `a` have no value at this state: M(q) is singular, since `phi` and `psi` can move \
                    together without moving any mass";
    assert!(complaint.contains(expected) && complaint.contains("a `ball` joint"), "{complaint}");
    // Elsewhere there is one.
    on("Top", &["eval", "--state", r#"{"q": {"theta": 0.1}}"#]).ok();
    let (values, complaint) = partly(on("Polar", &["eval", "--only", "a,M"]));
    assert!(values["M"][0][0] == 0.0 && values["a"].is_null(), "{values}");
    assert!(
        complaint.contains("`a` has no value") && complaint.contains("`theta` moves no mass"),
        "{complaint}"
    );
}

/// There is no other `q` to choose.
#[test]
fn where_doubles_lose_a_mass_everywhere_the_remedy_is_mass() {
    for q in ["{}", r#"{"q": [1, 2, 3]}"#] {
        let (values, complaint) = partly(on("Light", &["eval", "--only", "a,M", "--state", q]));
        assert!(values["a"].is_null() && values["M"].is_array(), "{values}");
        let expected = "M(q) is singular to the digits of a double, at every `q`, since `x`, `y` and `t` can move together";
        assert!(complaint.contains(expected) && !complaint.contains("choose another"), "{complaint}");
        let remedy = "give a body that is moved by `x`, `y` and `t` more mass or inertia";
        assert!(complaint.contains(remedy), "{complaint}");
    }
}

#[test]
fn a_term_that_is_not_smooth_is_named() {
    let (values, complaint) = partly(on("Tied", &["eval", "--frame", "b"]));
    assert!(values["G"].is_null() && values["M"].is_array() && values["frames"]["b"]["jacobian"].is_array());
    assert!(complaint.contains("`G`, `h`, `tau` and `a` have no value at this state"), "{complaint}");
    let expected = "`3N_per_m / 2 * (distance(b, world) - 1)^2` has the distance of two points that meet";
    assert!(complaint.contains(expected), "{complaint}");
    on("Tied", &["eval", "--state", r#"{"q": [0, 0, 1]}"#]).ok();

    let state = |x: &str| format!("{{\"q\": [{x}]}}");
    for (robot, x, expected) in [
        ("Root", "1", "`5N * sqrt(1 - x^2)` has the root of zero"),
        ("Root", "2", "`5N * sqrt(1 - x^2)` has the root of -3.0, which is no number"),
        ("Quotient", "0", "`Minv`, `C`, `h`, `tau`, `a` and `kinetic_energy` have no value"),
        ("Quotient", "0", "`2kg * 1m / 2 * dot(x)^2 / x` divides by zero"),
    ] {
        let (_, complaint) = partly(on(robot, &["eval", "--state", &state(x)]));
        assert!(complaint.contains(expected), "{complaint}");
    }
}

/// What a robot without bodies has no word for is not missed, unless it is asked for.
#[test]
fn a_robot_without_mass_has_no_centre_of_mass() {
    let values: Value = serde_json::from_str(&on("Root", &["eval"]).ok()).unwrap();
    assert!(values.get("com").is_none() && values["G"].is_array(), "{values}");
    let (values, complaint) = partly(on("Root", &["eval", "--only", "com,M"]));
    assert!(values["com"].is_null() && values["M"][0][0] == 2.0, "{values}");
    assert!(
        complaint.contains("`com` has no value at this state: no body that moves has mass"),
        "{complaint}"
    );
}

#[test]
fn numbers_that_are_too_large_are_what_is_wrong() {
    let state = r#"{"q": [1e200, 1e200], "v": [1e200, 1e200]}"#;
    let (_, complaint) = partly(dynamics(&["eval", &model("cartpole"), "--state", state]));
    assert!(
        complaint.contains("too large for a double") && complaint.contains("smaller numbers"),
        "{complaint}"
    );
}

#[test]
fn a_check_knows_a_singular_place_from_a_sound_one() {
    for (robot, expected) in [
        ("Top", "at q = 0, M(q) is singular, since `phi` and `psi` can move together"),
        (
            "Polar",
            "at q = 0, M(q) is singular, since `theta` moves no mass: forward dynamics has no value there",
        ),
        (
            "Tied",
            "has the distance of two points that meet, and so no derivative: its force has no value there",
        ),
        ("Quotient", "divides by zero: forward dynamics has no value there"),
        ("Root", "M(q) is positive definite at q = 0"),
    ] {
        let text = on(robot, &["check"]).ok();
        assert!(text.contains(expected), "{text}");
        assert_eq!(text.contains("positive definite"), ["Tied", "Root"].contains(&robot), "{text}");
    }
}

#[test]
fn a_motion_does_not_begin_where_there_is_no_acceleration() {
    let simulate = ["simulate", "--time", "0.01", "--step", "0.001"];
    let complaint = on("Top", &simulate).failed(1);
    let expected = "the robot cannot move at its start, q = [0.0, 0.0, 0.0]: M(q) is singular";
    assert!(complaint.contains(expected) && complaint.contains("another `q` by `--q`"), "{complaint}");
    on("Top", &[&simulate[..], &["--q", "theta=0.5"]].concat()).ok();
    let complaint = on("Top", &["report", "--q", "theta=0.5"]).failed(1);
    let expected = "where the robot stands, at q = [0.0, 0.0, 0.0], it cannot move: M(q) is singular";
    assert!(complaint.contains(expected) && complaint.contains("by `--state`"), "{complaint}");
}

/// Its page has all else.
#[test]
fn a_robot_without_bodies_has_a_page_without_a_picture() {
    let html = on("Root", &["report", "--q", "0.5", "--time", "0.5"]).ok();
    for expected in ["There is nothing to draw: it has coordinates and energies", "<math", "A swing", "<svg"]
    {
        assert!(html.contains(expected), "{expected}");
    }
    for picture in ["class=\"bench\"", "Bodies with mass"] {
        assert!(!html.contains(picture), "{picture}");
    }
    let simulate = ["simulate", "--time", "0.1", "--step", "0.01"];
    let complaint = on("Root", &[&simulate[..], &["--animate", "no.html"]].concat()).failed(1);
    assert!(complaint.contains("no body with a place") && complaint.contains("`--plot`"), "{complaint}");
}

/// A motion that leaves what has a root ends there, and what was computed before is written and drawn.
#[test]
fn a_motion_that_is_lost_is_drawn_to_its_end() {
    let pictures = folder("absent_pictures");
    let path = |name: &str| pictures.join(name).to_str().unwrap().to_owned();
    let (svg, csv) = (path("lost.svg"), path("lost.csv"));
    let simulate = ["simulate", "--time", "3", "--step", "0.01", "--q", "0.9", "--plot", &svg, "-o", &csv];
    let complaint = on("Root", &simulate).failed(1);
    let expected = ["the state is not finite, ", "s after the start: `5N * sqrt(1 - x^2)` has the root of -"];
    assert!(expected.iter().all(|text| complaint.contains(text)), "{complaint}");
    assert!(std::fs::read_to_string(&svg).unwrap().contains("<svg"));
    assert!(std::fs::read_to_string(&csv).unwrap().lines().count() > 10);
}

/// A chain of so many links, none like another.
fn chain(links: usize) -> String {
    let link = |k: usize| {
        format!(
            r#"<link name="l{k}"><inertial><origin xyz="0.1 0.2 0.{k}"/><mass value="{k}"/>
            <inertia ixx="9" ixy="0" ixz="0" iyy="9" iyz="0" izz="9"/></inertial></link>
            <joint name="j{k}" type="continuous"><parent link="l{}"/><child link="l{k}"/>
            <origin xyz="0.3 0.1 0" rpy="0.3 0.2 0.{k}"/><axis xyz="0 0 1"/></joint>"#,
            k - 1
        )
    };
    format!(r#"<robot name="chain"><link name="l0"/>{}</robot>"#, (1..=links).map(link).collect::<String>())
}

/// The lines of `check` on what is absent.
fn absent(text: &str) -> Vec<&str> {
    let section = text.split("\nabsent\n").nth(1).unwrap_or_default();
    section.lines().take_while(|line| !line.is_empty()).collect()
}

/// What `check` says that a robot does not get is not in its code, and all else is.
#[test]
fn methods_that_a_robot_does_not_get_are_named_with_the_reason() {
    let massless = ["total_mass", "center_of_mass", "center_of_mass_jacobian", "centroidal_momentum"];
    let regressors = ["regressor", "inertial_parameters", "base_regressor", "base_parameters"];
    let generate = ["generate", "--lang", "rust", "--name", "Chain", "-"];
    let long = chain(30);
    let on_chain = |command: &[&str]| dynamics_on(long.as_bytes(), command).ok();
    for (checked, code, expected) in [
        (on("Root", &["check"]).ok(), on("Root", &["generate", "--lang", "rust"]).ok(), &massless[..]),
        (on_chain(&["check", "-"]), on_chain(&generate), &regressors),
        (on("Top", &["check"]).ok(), on("Top", &["generate", "--lang", "rust"]).ok(), &[]),
    ] {
        let lines = absent(&checked).join("\n");
        for method in [&massless[..], &regressors, &["mass_matrix", "forward_dynamics"]].concat() {
            let is_absent = expected.contains(&method);
            assert_eq!(lines.contains(&format!("`{method}`")), is_absent, "{method}: {lines}");
            assert_eq!(code.contains(&format!("fn {method}(")), !is_absent, "{method}");
        }
    }
    let root = on("Root", &["check"]).ok();
    assert!(
        absent(&root).len() == 1 && absent(&root)[0].ends_with(": no body that moves has mass"),
        "{root}"
    );
    // As `eval` says it.
    let why = absent(&on_chain(&["check", "-"])).concat();
    let (_, why) = why.split_once(": ").unwrap();
    let complaint = dynamics_on(long.as_bytes(), &["eval", "-", "--only", "Y"]).stderr;
    assert!(complaint.contains(why), "{complaint} has no {why:?}");
}

/// Terms have no loops. A file is told which methods that takes from it; a struct must leave these out, as for the derive.
#[test]
fn what_terms_take_from_a_long_robot_is_named() {
    let term = "--potential=3Nm * j1^2";
    let checked = dynamics_on(chain(34).as_bytes(), &["check", "-", term]).ok();
    let line = absent(&checked)[0];
    let (methods, why) = line.split_once(": ").unwrap();
    assert_eq!(why, "the program would be too long: with terms in the energies it is written without loops");
    let names: Vec<&str> = methods.split('`').skip(1).step_by(2).collect();
    assert!(
        names.contains(&"inverse_dynamics_derivatives") && names.contains(&"forward_dynamics_derivatives"),
        "{line}"
    );
    let evaluated = |only: &[&str]| dynamics_on(chain(34).as_bytes(), &[&["eval", "-", term], only].concat());
    let (values, complaint) = partly(evaluated(&["--only", "M,dtau_dq"]));
    assert!(values["M"].is_array() && values["dtau_dq"].is_null() && complaint.contains(why), "{complaint}");
    evaluated(&["--only", "C,tau,a"]).ok();
    // Each of them is refused, and the others are not.
    let generate = |outputs: &str| {
        let options = ["generate", "-", "--lang", "rust", term, "--outputs", outputs];
        dynamics_on(chain(34).as_bytes(), &options)
    };
    for name in names {
        assert!(generate(name).failed(1).contains(&format!("`{name}`")));
    }
    let others = "mass_matrix,inverse_dynamics,forward_dynamics,inverse_mass_matrix";
    generate(others).ok();

    let here = folder("absent_long");
    std::fs::write(here.join("Cargo.toml"), "").unwrap();
    std::fs::write(here.join("chain.urdf"), chain(34)).unwrap();
    let file = here.join("robot.rs");
    let written = |outputs: &str| {
        let text = format!(
            "#[derive(Dynamics)] #[dynamics(urdf = \"chain.urdf\"{outputs})]\n\
             #[potential(3Nm * j1^2)]\nstruct Chain;\n"
        );
        std::fs::write(&file, text).unwrap();
        dynamics(&["check", file.to_str().unwrap()])
    };
    assert_eq!(absent(&written(&format!(", outputs({others})")).ok())[0], line);
    let complaint = written("").failed(1);
    assert!(
        complaint.contains("TermsUnsupported") && complaint.contains("`inverse_dynamics_derivatives`"),
        "{complaint}"
    );
}

/// Two links that differ, but not as types of Rust.
const ALIKE: &str = r#"<robot name="alike"><link name="base"/>
  <link name="arm_1"><inertial><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="Arm1"><inertial><mass value="2"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="one" type="continuous"><parent link="base"/><child link="arm_1"/><axis xyz="1 0 0"/></joint>
  <joint name="two" type="prismatic"><parent link="arm_1"/><child link="Arm1"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"#;

/// Where no Rust is written, nothing keeps a robot from having them.
#[test]
fn links_that_are_one_type_are_refused_in_rust_alone() {
    let on = |command: &[&str]| dynamics_on(ALIKE.as_bytes(), command);
    let why = "the bodies `arm_1` and `Arm1` would both be the type `Arm1`";
    let checked = on(&["check", "-"]).ok();
    assert_eq!(absent(&checked), [format!("  code in Rust: {why}")], "{checked}");
    assert!(on(&["generate", "-", "--lang", "rust"]).failed(1).contains(why));

    let here = folder("alike");
    on(&["generate", "-", "--lang", "c", "--outputs", "pose", "-o", here.to_str().unwrap()]).ok();
    let header = std::fs::read_to_string(here.join("alike.h")).unwrap();
    assert!(header.contains("alike_arm_1_pose") && header.contains("alike_arm1_pose"), "{header}");

    let state = r#"{"q": [0, 0.5]}"#;
    let values = on(&["eval", "-", "--only", "mass", "--frame", "*", "--state", state]).ok();
    let values: Value = serde_json::from_str(&values).unwrap();
    let place = |frame: &str| values["frames"][frame]["translation"][1].as_f64().unwrap();
    assert_eq!((place("arm_1"), place("Arm1"), values["mass"].as_f64()), (0.0, 0.5, Some(3.0)));

    // A struct is Rust.
    std::fs::write(here.join("Cargo.toml"), "").unwrap();
    std::fs::write(here.join("alike.urdf"), ALIKE).unwrap();
    let file = here.join("robot.rs");
    std::fs::write(&file, "#[derive(Dynamics)] #[dynamics(urdf = \"alike.urdf\")]\nstruct Alike;\n").unwrap();
    let complaint = dynamics(&["check", file.to_str().unwrap()]).failed(1);
    assert!(complaint.contains(why) && complaint.contains("alike.urdf:4:"), "{complaint}");
}
