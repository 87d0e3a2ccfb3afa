//! What is wrong is shown where it is, and a wrong command line is told from a wrong robot.

use super::{dynamics, dynamics_on, folder, model, robots};

/// The cart-pole with one thing replaced.
fn cart_with(old: &str, new: &str) -> String {
    let text = std::fs::read_to_string(robots().join(model("cartpole"))).unwrap();
    assert!(text.contains(old), "{old}");
    text.replacen(old, new, 1)
}

#[test]
fn a_broken_file() {
    let text = cart_with("0.0 0.0 0.5", "0.0 0,5 0.5");
    let text = text.replacen("type=\"fixed\"", "type=\"fixd\"", 1);
    let text = text.replacen("lower=\"-2.0\" upper=\"2.0\"", "lower=\"2.0\" upper=\"-2.0\"", 1);
    insta::assert_snapshot!(dynamics_on(text.as_bytes(), &["check", "-"]).failed(1));
}

#[test]
fn a_robot_that_needs_permission() {
    insta::assert_snapshot!(dynamics(&["check", &model("puma560")]).failed(1));
}

/// Every command that reads a robot refuses what is none, each in its own words.
#[test]
fn every_command_refuses_what_is_no_robot() {
    let commands: [&[&str]; 5] = [
        &["check"],
        &["count"],
        &["eval"],
        &["generate", "--lang", "rust"],
        &["simulate", "--time", "1", "--step", "0.1"],
    ];
    let files: [(&[u8], &str); 7] = [
        (b"", "the file is empty"),
        (b"<robot", "--> <stdin>:1:"),
        (b"<robot name='\xff'/>", "the file is not in UTF-8"),
        (b"\xef\xbb\xbf<sdf/>", "its root is `<sdf>`"),
        (b"<robot/>", "the robot has no link"),
        (b"<!DOCTYPE a><robot/>", "document type"),
        ("<a>".repeat(100_000).leak().as_bytes(), "nested more than 64 deep"),
    ];
    for (file, expected) in files {
        for command in commands {
            let complaint = dynamics_on(file, &[command, &["-"]].concat()).failed(1);
            assert!(complaint.contains(expected), "{command:?}: {complaint}");
        }
    }
    for path in ["no/such.urdf", "."] {
        assert!(dynamics(&["check", path]).failed(1).contains("cannot be read"));
    }
}

/// What the command line says beside a file is read as attributes are, and its mistakes are shown in it.
#[test]
fn mistakes_in_options_are_shown_in_them() {
    let options = ["check", &model("hyq"), "--base", "free"];
    let both = [
        &options[..],
        &["--joint", "lf_kfe_joint, damping = -0.1", "--joint", "rf_kfe_joint, rotor = 2kg"],
        &["--body", "trunk, mass = 3rad", "--gravity", "[0, 0, 9.81N]"],
    ];
    insta::assert_snapshot!(dynamics(&both.concat()).failed(1));
    let mut said = String::new();
    for extra in [
        ["--joint", "knee, damping = 1"],
        ["--joint", "lf_kfe_joint, dampin = 1"],
        ["--joint", "lf_kfe_joint damping = 1"],
        ["--joint", "lf_kfe_joint, damping = (1"],
        ["--joint", "lf_kfe_joint)] #[body(a"],
        ["--joint", "lf_kfe_joint, // a comment\n damping"],
        ["--joint", "root_joint: fixed, world -> trunk"],
        ["--body", ""],
        ["--body", "ünknown, mass = 1"],
        ["--gravity", "9.81"],
    ] {
        said += &dynamics(&[&options[..], &extra].concat()).failed(1);
        said += "\n";
    }
    insta::assert_snapshot!(said);
}

#[test]
fn a_quaternion_that_is_no_rotation_is_refused_with_its_norm() {
    let hyq = model("hyq");
    let eval = ["eval", &hyq, "--base", "free", "--only", "M", "--state"];
    for (state, norm, help) in [
        (r#"{"q": {"root_joint.qx": 1}}"#, "the norm 1.414213562373", "0.7071067811865475"),
        (r#"{"q": {"root_joint.qw": 0}}"#, "the norm 0, and not 1", "no rotation is 0, 0, 0, 1"),
        (r#"{"q": {"root_joint.qw": 1.000001}}"#, "the norm 1.000001", "0.0, 0.0, 0.0, 1.0"),
    ] {
        let complaint = dynamics(&[&eval[..], &[state]].concat()).failed(1);
        assert!(complaint.contains("the quaternion of `root_joint`, q[3] to q[6]"), "{complaint}");
        assert!(complaint.contains(norm) && complaint.contains(help), "{complaint}");
    }
    // What single precision keeps is good enough.
    dynamics(&[&eval[..], &[r#"{"q": {"root_joint.qw": 1.0000004}}"#]].concat()).ok();
    let simulate =
        ["simulate", &hyq, "--base", "free", "--time", "1", "--step", "0.1", "--q", "root_joint.qy=1"];
    assert!(dynamics(&simulate).failed(1).contains("has the norm 1.41"));
}

#[test]
fn all_that_is_wrong_with_a_state_is_said_at_once() {
    let state = r#"{"q": [1], "w": [1], "v": {"hing": 1, "slider": true}, "a": [1, "2"], "q": [0, 0]}"#;
    let complaint = dynamics(&["eval", &model("cartpole"), "--state", state]).failed(1);
    for expected in [
        "`q` has 1 number, and needs 2",
        "unknown key `w`",
        "`v` has no entry `hing`",
        "`v` of `slider` is true, and no number",
        "`a` of `hinge` is \"2\", and no number",
        "the state has `q` twice",
    ] {
        assert!(complaint.contains(expected), "no `{expected}` in {complaint}");
    }
    let q = "slider=fast,hing=1,hinge=inf";
    let simulate = ["simulate", &model("cartpole"), "--time", "1", "--step", "0.1", "--q", q];
    let complaint = dynamics(&simulate).failed(1);
    for expected in ["`fast` in `--q` is no number", "`--q` has no entry `hing`", "`--q` of `hinge` is inf"] {
        assert!(complaint.contains(expected), "no `{expected}` in {complaint}");
    }
}

#[test]
fn a_wrong_state_names_the_joints() {
    for (state, expected) in [
        (r#"{"q": [1]}"#, "`q` has 1 number, and needs 2"),
        (r#"{"v": [1, 2, 3]}"#, "2 finite numbers, of slider, hinge"),
        (r#"{"q": [1, null]}"#, "`q` of `hinge` is null, and no number"),
        (r#"{"q": [1, NaN]}"#, "--> --state:1:11"),
        (r#"{"q": [1, 1e999]}"#, "number out of range"),
        (r#"{"q": [1, 2], "q": [1, 2]}"#, "`q` twice"),
        (r#"{"tua": [1, 2]}"#, "did you mean `tau`?"),
        (r#"{"speed": [1, 2]}"#, "give `q`, `v`, `a` or `tau`"),
        (r#"{"q": {"hinge": "1"}}"#, "`q` of `hinge` is \"1\", and no number"),
        (r#"{"q": {"hinge": "1"}}"#, "leave the quotes out, or write a unit behind the number"),
        (r#"{"q": {"hinge": []}}"#, "give a finite number, or a text with a unit, as in `\"30deg\"`"),
        (r#"{"v": {"hing": 1}}"#, "did you mean `hinge`?"),
        (r#"{"v": 1}"#, "expected a list of numbers, or an object"),
        ("[1, 2]", "an object of vectors"),
        ("@no/such.json", "no/such.json cannot be read"),
    ] {
        let complaint = dynamics(&["eval", &model("cartpole"), "--state", state]).failed(1);
        assert!(complaint.contains(expected), "{state}: {complaint}");
    }
}

/// Each at its place, of both options at once.
#[test]
fn units_of_a_start_are_those_of_its_joints() {
    let simulate = ["simulate", &model("cartpole"), "--time", "1", "--step", "0.1"];
    let of = |options: &[&str]| dynamics(&[&simulate[..], options].concat()).failed(1);
    let wrong = ["--q", "slider=90deg, hinge=3kg", "--v", "[90deg, 2 parsec]"];
    insta::assert_snapshot!(of(&wrong));
    let hyq = ["simulate", &model("hyq"), "--base", "free", "--time", "1", "--step", "0.1"];
    let complaint = dynamics(&[&hyq[..], &["--q", "root_joint.qx=30deg"]].concat()).failed(1);
    assert!(complaint.contains("`root_joint.qx`, a part of a quaternion, has none"), "{complaint}");

    let state = |state: &str| dynamics(&["eval", &model("cartpole"), "--only", "tau,a", "--state", state]);
    let units =
        r#"{"q": {"slider": "-20cm"}, "v": ["1m/2s", "pi / 1s"], "a": ["1m/1s^2", 2], "tau": ["3N", "2Nm"]}"#;
    let plain = r#"{"q": [-0.2, 0], "v": [0.5, 3.141592653589793], "a": [1, 2], "tau": [3, 2]}"#;
    assert_eq!(state(units).ok(), state(plain).ok());
    for (given, expected) in [
        (r#"{"q": ["3deg", 0]}"#, "`3deg` has the unit rad, and `slider` m"),
        (
            r#"{"a": {"hinge": "2deg / 1s"}}"#,
            "give a rate, `2deg / 1s / 1s`, or a number, which is in rad/s^2",
        ),
        (r#"{"tau": {"hinge": "2N"}}"#, "`2N` has the unit kg·m/s^2, and `hinge` kg·m^2/s^2"),
        (r#"{"tau": {"hinge": "2 N"}}"#, "`tau` of `hinge` is \"2 N\", and no number"),
    ] {
        let complaint = state(given).failed(1);
        assert!(complaint.contains(expected), "{given}: {complaint}");
    }
}

#[test]
fn a_wrong_state_of_a_free_base_says_which_part() {
    for (state, expected) in [
        (r#"{"q": [0, 0]}"#, "`q` has 2 numbers, and needs 9"),
        (
            r#"{"v": [0, 0]}"#,
            "8 finite numbers, of root_joint.vx, root_joint.vy, root_joint.vz, root_joint.wx",
        ),
        (r#"{"q": [0, 0, 0, 0, 0, 0, 2, 0, 0]}"#, "q[3] to q[6], has the norm 2, and not 1"),
    ] {
        let complaint =
            dynamics(&["eval", &model("double_pendulum"), "--base", "free", "--state", state]).failed(1);
        assert!(complaint.contains(expected), "{state}: {complaint}");
    }
}

#[test]
fn a_wrong_simulation_does_not_start() {
    let cart = model("cartpole");
    let simulate = ["simulate", cart.as_str()];
    for (step, time) in [("0", "1"), ("-1e-3", "1"), ("NaN", "1"), ("inf", "1"), ("1", "-1"), ("1", "nan")] {
        let complaint = dynamics(&[&simulate[..], &["--step", step, "--time", time]].concat()).failed(2);
        assert!(complaint.contains("give a finite number of seconds"), "{complaint}");
    }
    let usual = [&simulate[..], &["--step", "0.1", "--time", "1"]].concat();
    for (extra, expected) in [
        (["--q", "1"], "`--q` has 1 entry, and needs 2"),
        (["--q", "hinge:1"], "or some by their names, as in `slider=0.1`"),
        (["--q", "hinge=0.1,0.2"], "`0.2` in `--q` has no name"),
        (["--v", "1,x"], "`x` in `--v` is no number"),
        (["--q", "0,nan"], "`--q` of `hinge` is NaN"),
        (["--q", "hing=1"], "did you mean `hinge`?"),
        (["--v", "hinge=x"], "`x` in `--v` is no number"),
        (["--v", "hinge=inf"], "`--v` of `hinge` is inf"),
        (["-o", &cart], "it is the input"),
        (["-o", "no/such/folder.csv"], "cannot be written"),
    ] {
        let complaint = dynamics(&[&usual[..], &extra].concat()).failed(1);
        assert!(complaint.contains(expected), "{complaint}");
    }
    let endless = [&simulate[..], &["--step", "1e-300", "--time", "1"]].concat();
    assert!(dynamics(&endless).failed(1).contains("too many steps"));
    // What was computed before is written.
    let coarse = [&simulate[..], &["--step", "1e4", "--time", "1e6", "--v", "0,1e3"]].concat();
    let done = dynamics(&coarse);
    assert!(done.code == 1 && done.stdout.lines().count() > 1, "{}", done.stderr);
    assert!(done.stderr.contains("the state is not finite, 20000.0 s after the start"), "{}", done.stderr);
    let adaptive = [&usual[..], &["--method", "adaptive"]].concat();
    for tolerance in ["0", "-1e-6", "NaN", "small"] {
        let complaint = dynamics(&[&adaptive[..], &["--tolerance", tolerance]].concat()).failed(2);
        assert!(complaint.contains("give a finite number above zero"), "{complaint}");
    }
    let complaint = dynamics(&[&usual[..], &["--tolerance", "1e-6"]].concat()).failed(2);
    assert!(complaint.contains("add `--method adaptive`"), "{complaint}");
    let exact = [&adaptive[..], &["--tolerance", "1e-200", "--q", "0,1"]].concat();
    let done = dynamics(&exact);
    let expected =
        ["no step is small enough for the tolerance, 0.0 s after the start", "larger `--tolerance`"];
    assert!(done.code == 1 && expected.iter().all(|text| done.stderr.contains(text)), "{}", done.stderr);
}

#[test]
fn a_wrong_command_line_is_a_matter_of_its_own() {
    let cart = model("cartpole");
    for (arguments, expected) in [
        (&["frobnicate"][..], "unrecognized subcommand"),
        (&["check"], "<FILE>"),
        (&["check", &cart, "--allow", "all"], "nonphysical_inertia"),
        (&["check", &cart, "--snap", "maybe"], "on, off"),
        (&["check", &cart, "--base", "loose"], "fixed, free"),
        (&["eval", &cart, "--only", "M,dtau_dp"], "'dtau_dv'"),
        (&["generate", &cart], "--lang"),
        (&["generate", &cart, "--lang", "cobol"], "possible values: rust, c"),
        (&["generate", &cart, "--lang", "rust", "--name", "a b"], "no identifier"),
        (&["generate", &cart, "--lang", "rust", "--check"], "--output"),
        (&["simulate", &cart, "--step", "1", "--time", "1", "--every", "0"], "--every"),
    ] {
        let complaint = dynamics(arguments).failed(2);
        assert!(complaint.contains(expected), "{complaint}");
    }
}

#[test]
fn a_file_that_cannot_be_read_line_by_line_is_named_all_the_same() {
    let file = folder("mistakes").join("long.urdf");
    let text = cart_with("mass value=\"0.1\"", "mass value=\"-0.1\"").replace('\n', &" ".repeat(200));
    std::fs::write(&file, text).unwrap();
    let complaint = dynamics(&["check", file.to_str().unwrap()]).failed(1);
    assert!(complaint.contains("long.urdf:1:") && complaint.len() < 600, "{complaint}");
}

#[test]
fn what_cannot_be_written_says_what_can() {
    let cart = model("cartpole");
    let file = folder("unwritable").join("file");
    std::fs::write(&file, "kept").unwrap();
    let below = file.join("x.csv").to_str().unwrap().to_owned();
    let missing = folder("unwritable_missing").join("no/x.csv").to_str().unwrap().to_owned();
    let commands: [&[&str]; 5] = [
        &["report", &cart, "-o"],
        &["generate", &cart, "--lang", "rust", "-o"],
        &["simulate", &cart, "--time", "1", "--step", "0.1", "-o"],
        &["simulate", &cart, "--time", "1", "--step", "0.1", "--plot"],
        &["rollouts", &cart, "--time", "1", "--step", "0.1", "--count", "1", "-o"],
    ];
    for command in commands {
        for (path, expected) in
            [(missing.as_str(), "make the folder first"), (&below, "give the path of a file in a folder")]
        {
            let complaint = dynamics(&[command, &[path]].concat()).failed(1);
            assert!(complaint.contains(expected) && complaint.contains(path), "{command:?}: {complaint}");
        }
    }
    assert!(dynamics(&["report", &cart, "-o", &cart]).failed(1).contains("give another file to be written"));
    assert!(dynamics(&["report", &cart, "-o", "."]).failed(1).contains("a file in this folder"));
    // Who is refused later has lost nothing: what was there is there, and what was not is not.
    let new = folder("unwritable_new").join("x").to_str().unwrap().to_owned();
    for path in [file.to_str().unwrap(), &new] {
        dynamics(&["report", &cart, "--state", r#"{"q": {"hinge": 1e300}}"#, "--q", "x", "-o", path])
            .failed(1);
    }
    assert!(std::fs::read_to_string(&file).unwrap() == "kept" && !std::fs::exists(&new).unwrap());
}
