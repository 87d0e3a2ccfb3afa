//! Robots on structs, in files of Rust: every command reads them as it reads a URDF.

use serde_json::Value;

use super::{dynamics, dynamics_on, folder, robots};

const JUDGE: &str = "../../examples/robojudge.rs";
const OF_JUDGE: [&str; 2] = ["--robot", "RoboJudge"];
const VALUES: [&str; 4] = [
    "--set",
    "m1 = 4kg, m2 = 1500g, l1 = 90cm, r0 = 0.4, r1 = 300mm, g = 9.81m / 1s / 1s, ix1 = 0.3, iy1 = 0.3",
    "--set",
    "iz1 = 0.05, ix2 = 6/100, iy2 = 0.01, iz2 = 0.055",
];

#[test]
fn the_robojudge() {
    insta::assert_snapshot!(dynamics(&[&["check", JUDGE], &OF_JUDGE[..]].concat()).ok());
    let known = dynamics(&[&["check", JUDGE], &OF_JUDGE[..], &VALUES[..]].concat()).ok();
    assert!(known.contains("\n  5.5 kg\n") && known.contains("\n  ix2  0.06\n"), "{known}");
    assert!(known.contains("M(q) is positive definite at q = 0\n"), "{known}");
}

/// The numbers of the lecture's formulas.
#[test]
fn the_robojudge_has_the_lectures_numbers() {
    let state = r#"{"q": [0.4, 0.7]}"#;
    let asked = ["--state", state, "--only", "M,potential_energy"];
    let text = dynamics(&[&["eval", JUDGE], &OF_JUDGE[..], &VALUES[..], &asked[..]].concat()).ok();
    let found: Value = serde_json::from_str(&text).unwrap();
    let (s2, c2) = f64::sin_cos(0.7);
    let (m1, m2, l1, r0, r1, g) = (4.0, 1.5, 0.9, 0.4, 0.3, 9.81);
    let m11 = 0.05 + 0.01 * s2 * s2 + 0.055 * c2 * c2 + m2 * r1 * r1 * c2 * c2;
    let v = g * (m1 * r0 + m2 * (l1 - r1 * s2));
    for (found, expected) in [
        (&found["M"][0][0], m11),
        (&found["M"][0][1], 0.0),
        (&found["M"][1][1], 0.06 + m2 * r1 * r1),
        (&found["potential_energy"], v),
    ] {
        // A few roundings of either.
        assert!((found.as_f64().unwrap() - expected).abs() < 1e-14 * v, "{found} and {expected}");
    }
}

/// Each of the examples, whatever is around its struct.
#[test]
fn every_example_is_read() {
    let mut read = 0;
    for file in std::fs::read_dir(robots().join("../../examples")).unwrap() {
        let path = file.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let names = text.split("#[derive(Dynamics").skip(1).map(|after| {
            let name = after.split("\nstruct ").nth(1).unwrap();
            name.split(|c: char| !c.is_alphanumeric()).next().unwrap()
        });
        for name in names {
            let file = path.to_str().unwrap();
            let found = dynamics(&["check", file, "--robot", name]).ok();
            assert!(found.starts_with(&format!("robot `{name}` in ")), "{found}");
            read += 1;
        }
    }
    assert!(read >= 10, "{read}");
}

/// A file of Rust with two robots, of which the second one has a file; an enum, a macro and a comment that are none.
const FILE: &str = r#"#!/usr/bin/env rustx
//! `#[derive(Dynamics)] struct NoRobot;`
mod deep {
    fn inside() {
        /// A cart.
        #[derive(Clone, dynamics_core::Dynamics, Copy)]
        #[joint(slider: prismatic(x), world -> cart, damping = c)]
        #[body(cart, mass = m, inertia = diag(0, 0, j))]
        #[joint(hinge: revolute(y), cart -> pole)]
        #[body(pole, com = [0, 0, l / 2], solid = rod(100g, l, z))]
        pub(crate) struct Cart<T: Copy> where T: Send {
            /// Of the cart.
            m: T, l: T, c: T, j: T,
            label: &'static str,
        }
    }
}
macro_rules! robot {
    ($name:ident) => { #[derive(Dynamics)] struct $name; };
}
#[derive(Dynamics)]
#[dynamics(urdf = "robots/arm.urdf")]
#[joint(grip: fixed, lower -> load)]
#[body(load, solid = point(payload))]
struct Arm<T> { payload: T }
"#;

/// A crate with the file above; its path.
fn a_crate(test: &str) -> String {
    let here = folder(test);
    std::fs::create_dir_all(here.join("src/bin")).unwrap();
    std::fs::create_dir_all(here.join("robots")).unwrap();
    std::fs::write(here.join("Cargo.toml"), "").unwrap();
    std::fs::write(here.join("src/bin/two.rs"), FILE).unwrap();
    let file = std::fs::read_to_string(robots().join("double_pendulum/model.urdf")).unwrap();
    let link = file.split("<link name=\"").nth(2).unwrap().split('"').next().unwrap().to_owned();
    std::fs::write(here.join("robots/arm.urdf"), file.replace(&format!("\"{link}\""), "\"lower\"")).unwrap();
    here.join("src/bin/two.rs").to_str().unwrap().to_owned()
}

#[test]
fn one_of_several_is_chosen() {
    let file = a_crate("chosen");
    let shown = |text: String| text.replace(&file, "two.rs");
    let complaint = shown(dynamics(&["check", &file]).failed(1));
    assert!(complaint.contains("two.rs has 2 robots: `Cart`, `Arm`") && complaint.contains("--robot Cart"));
    let namesakes = b"#[derive(Dynamics)]\nstruct A;\nmod b {\n    #[derive(Dynamics)]\n    struct A;\n}";
    let complaint = dynamics_on(namesakes, &["check", "-"]).failed(1);
    assert!(complaint.contains("give each a name of its own"), "{complaint}");
    let complaint = shown(dynamics(&["count", &file, "--robot", "Carts"]).failed(1));
    assert!(complaint.contains("did you mean `Cart`?"), "{complaint}");
    let arm = dynamics(&["check", &file, "--robot", "Arm"]).ok();
    assert!(arm.contains("load  payload") && arm.contains("\n  payload  kg\n"), "{arm}");
    assert!(dynamics_on(FILE.as_bytes(), &["check", "-", "--robot", "Cart"]).ok().contains("in <stdin>"));
    // A URDF has one robot.
    assert!(dynamics(&["check", "scara/model.urdf", "--robot", "Arm"]).failed(2).contains("no file of Rust"));
}

/// What stands in options stands on the struct, for this time.
#[test]
fn options_add_to_the_struct() {
    let file = a_crate("added");
    let options = ["--joint", "grip: fixed, pole -> ball", "--body", "ball, solid = point(b)", "--gravity"];
    let options = [&["check", &file, "--robot", "Cart"], &options[..], &["[0, 0, -1.62]"]].concat();
    let complaint = dynamics(&options).failed(1);
    assert!(
        complaint.contains("there is no field `b`") && complaint.contains("--> --body:1:21"),
        "{complaint}"
    );
    let options: Vec<&str> = options
        .iter()
        .map(|option| if *option == "ball, solid = point(b)" { "ball, solid = point(m)" } else { option })
        .collect();
    assert!(dynamics(&options).ok().contains("grip (fixed) ─ ball  m"));
    let damped = ["check", &file, "--robot", "Arm", "--joint", "joint1, damping = 0.125"];
    assert!(dynamics(&damped).ok().contains("0.125 N·m·s/rad"));
}

/// What is written is a file of its own: the struct, public, and the code of the derive.
#[test]
fn code_of_a_struct_is_that_of_the_derive() {
    let file = a_crate("code_of_a_struct");
    let code = dynamics(&["generate", &file, "--robot", "Cart", "--lang", "rust"]).ok();
    let item = "/// A cart.\n#[derive(Clone, Copy)]\npub struct Cart<T: Copy>\nwhere T: Send\n{\n    /// Of the cart.\n    pub m: T,\n    \
                pub l: T,\n    pub c: T,\n    pub j: T,\n    pub label: &'static str,\n}\n\n";
    let (_, derived) = code.split_once(item).unwrap_or_else(|| panic!("{code}"));
    let item = FILE.split("fn inside() {").nth(1).unwrap().split("    }\n}\nmacro").next().unwrap();
    let mut item: syn::DeriveInput = syn::parse_str(item).unwrap();
    item.vis = syn::parse_quote!(pub);
    assert_eq!(derived, dynamics_codegen::generate(&item).unwrap());
    let here = folder("c_of_a_struct");
    let options = ["--robot", "Arm", "--lang", "c", "-o", here.to_str().unwrap()];
    dynamics(&[&["generate", &file], &options[..]].concat()).ok();
    assert!(std::fs::read_to_string(here.join("arm.h")).unwrap().contains("float payload; /* kg */"));
}

/// A number by `--set` is a number in the place of the field.
#[test]
fn a_value_is_as_if_it_was_written() {
    let with_fields = "#[derive(Dynamics)]
#[joint(a: revolute(y), world -> rod, stiffness = k)]
#[body(rod, com = [0, 0, l / 2], solid = rod(m, l, z))]
struct Rod { m: f64, l: f64, k: f64 }";
    let written = with_fields.replace("l / 2", "30cm / 2").replace("rod(m, l, z)", "rod(2kg, 30cm, z)");
    let written = written.replace("= k", "= 3").replace("{ m: f64, l: f64, k: f64 }", ";");
    let code = |text: &str, options: &[&str]| {
        let code =
            dynamics_on(text.as_bytes(), &[&["generate", "-", "--lang", "rust"], options].concat()).ok();
        code.split_once("struct Rod;").unwrap().1.to_owned()
    };
    assert_eq!(code(with_fields, &["--set", "k = 3, m = 2000g", "--set", "l = 0.3"]), code(&written, &[]));
    // It is judged as if it was.
    let mut said = String::new();
    for values in [
        "m = -1, l = 0.3, k = 0",
        "m = 1, l = -0.3",
        "m = 1rad, l = 2kg",
        "n = 1",
        "m = x",
        "m",
        "m = 1, m = 2",
    ] {
        said += &dynamics_on(with_fields.as_bytes(), &["eval", "-", "--set", values]).failed(1);
        said += "\n";
    }
    said += &dynamics_on(
        with_fields.as_bytes(),
        &["simulate", "-", "--set", "m = 1", "--time", "1", "--step", "0.1"],
    )
    .failed(1);
    insta::assert_snapshot!(said);
}

/// A field may be given, another one vary.
#[test]
fn rollouts_vary_the_fields_that_are_left() {
    let file = "../../examples/pendulum.rs";
    let run = ["rollouts", file, "--time", "1", "--step", "0.01", "--q", "0.5"];
    let table = dynamics(&[&run[..], &["--set", "m = 2", "--grid", "l = 0.5, 1"]].concat()).ok();
    let of_one = [
        "simulate",
        file,
        "--time",
        "1",
        "--step",
        "0.01",
        "--q",
        "0.5",
        "--set",
        "m = 2, l = 1",
        "--every",
        "100",
    ];
    let alone = dynamics(&of_one).ok();
    let last = |text: &str, skipped: usize| {
        let row = text.lines().last().unwrap().split(',').skip(skipped).take(3);
        row.map(|number| number.parse::<f64>().unwrap()).collect::<Vec<_>>()
    };
    for (rolled, alone) in last(&table, 2).iter().zip(last(&alone, 0)) {
        // A field in a register and a number in its place round differently.
        assert!((*rolled - alone).abs() < 1e-12, "{table}");
    }
    for (options, expected) in [
        (&["--set", "m = 2"][..], "the field `l` (m) has no value"),
        (&["--set", "m = 2, l = 1", "--vary", "l = 1..2"], "`l` is given values twice, by `--set` as well"),
    ] {
        let complaint = dynamics(&[&run[..], options].concat()).failed(1);
        assert!(complaint.contains(expected), "{complaint}");
    }
}

/// Mistakes are shown at the line of the file that has them, in the words of the derive.
#[test]
fn mistakes_are_shown_in_the_file() {
    let mut said = String::new();
    for text in [
        "fn main() {}",
        "#[derive(Dynamics)] struct A; }",
        "/// Unicode: θ₁ und ein Wägen\r\n#[derive(Dynamics)]\r\n#[joint(θ: revolute(y), world -> rod)]\r\n#[body(rod, mass = -1, inertia = diag(m * r, 1, 1))]\r\n\
         #[body(ün, mäss = 2)]\r\nstruct A<T> { m: T, r: T }\r\n",
        "#[derive(Dynamics)]\n#[joint(a: revolute(y), world -> rod)]\n#[body(rod, mass = 1, inertia = diag(m * r, 1, 1), com = [r, 0, 0])]\n\
         #[body(\n    rod,\n    mass = m,\n)]\nstruct A<T> { m: T, r: T }",
        "#[derive(Dynamics)]\nenum A { B }\n#[derive(Dynamics)]\nfn no_item() {}",
        "#[derive(Dynamics)]\n#[dynamics(urdf = \"no/such.urdf\")]\nstruct A;",
        "#[derive(Dynamics)]\nstruct A;\nmod b {\n    #[derive(Dynamics)]\n    struct A;\n}",
    ] {
        let here = folder("mistakes_in_rust");
        std::fs::write(here.join("Cargo.toml"), "").unwrap();
        let file = here.join("a.rs");
        std::fs::write(&file, text).unwrap();
        let name = ["check", file.to_str().unwrap()];
        let wanted: &[&str] = if text.contains("mod b") { &["--robot", "A"] } else { &[] };
        said +=
            &dynamics(&[&name[..], wanted].concat()).failed(1).replace(&format!("{}/", here.display()), "");
        said += "\n";
    }
    insta::assert_snapshot!(said);
}

/// A mistake in the file that a struct names is shown there.
/// What is wrong with a value that was given for a field names the value, its rule and what to do.
#[test]
fn wrong_values_of_fields_are_told_with_their_names() {
    let file = "#[derive(Dynamics)]\n#[joint(q: revolute(y), world -> a)]\n\
                #[body(a, com = [0, 0, -l], solid = sphere(m, r))]\nstruct P<T> { m: T, l: T, r: T, unused: T }";
    for (value, expected) in [
        ("m = 0", &["moves no mass", "<stdin>:2:9", "change `m = 0` in `--set`, or else give a body"][..]),
        (
            "m = -1kg, l = 0",
            &["the mass of `a` is -1 kg", "change `m = -1kg` in `--set`, or else give a mass"],
        ),
        ("r = -1, m = -2", &["change `m = -2` in", "change `r = -1` in", "2 mistakes"]),
        ("m = 1m, n = 3", &["`1m` has the unit m, and `m` kg", "no field `n`", "2 mistakes"]),
        ("m = 1, m = 2", &["`m` is given values twice", "keep one"]),
        ("m = inf", &["`inf` is no number", "--set:1:5"]),
        ("m = 1e400", &["`1e400` is out of range", "between 1e-300 and 1e300"]),
        ("m = 1/0", &["the divisor `0` is zero", "divide by something other"]),
        ("m = sqrt(-1)", &["`-1` is negative, and has no root", "not negative"]),
        ("m = 4 kg", &["a space is between the number `4` and its unit `kg`", "write `4kg`"]),
        ("m = 2 r", &["found `r`", "write `* r` for a product"]),
        ("m = 4lb", &["there is no unit `lb`", "use one of m, cm"]),
        ("m = 1,5", &["`--set` has no `=`", "a point in a number"]),
        ("m", &["`--set` has no `=`", "--set 'm1 = 4kg'"]),
        ("m =", &["`m` is given no value"]),
    ] {
        let complaint = dynamics_on(file.as_bytes(), &["check", "-", "--set", value]).failed(1);
        assert!(expected.iter().all(|text| complaint.contains(text)), "{value}: {complaint}");
    }
    // A value for what no equation has does no harm.
    dynamics_on(file.as_bytes(), &["check", "-", "--set", "unused = 3"]).ok();
    let complaint = dynamics_on(file.as_bytes(), &["eval", "-"]).failed(1);
    assert!(complaint.contains("as by `--set 'm = 0.5, l = 0.5, r = 0.5'`"), "{complaint}");
    let complaint = dynamics(&["check", "cartpole/model.urdf", "--set", "m = 1"]).failed(1);
    assert!(
        complaint.contains("no option uses `m`") && complaint.contains("--body 'load, mass = m'"),
        "{complaint}"
    );
}

/// What is Rust is read as such, whatever its file is called.
#[test]
fn rust_is_known_by_what_it_has() {
    let file = folder("rust_without_ending").join("robots.txt");
    let robot = "#[derive(Dynamics)]\n#[joint(q: revolute(y), world -> a)]\n#[body(a, solid = sphere(1, 0.1))]\nstruct P;";
    std::fs::write(&file, robot).unwrap();
    assert!(dynamics(&["check", file.to_str().unwrap()]).ok().starts_with("robot `P` in "));
}

/// Where a file stops being Rust is shown, and why.
#[test]
fn what_is_no_rust_is_shown_in_the_file() {
    for (file, place, expected) in [
        ("#[derive(Dynamics)]\nstruct A;\nfn f() { ( ]\n", ":3:12\n", "`]` is no partner of the last one"),
        ("fn f() }", ":1:8\n", "`}` is no partner of the last one"),
        ("// )\nfn f() {\n  let ü = [1, 2;\n", ":3:11\n", "`[` is never closed"),
        ("let a = \"abc\nfoo", ":1:9\n", "with a quote has no end"),
        ("let c = '\\u{110000}';", ":1:9\n", "or is no token"),
        ("let x = 0b9;", ":1:9\n", "is no number"),
        ("let x = \\;", ":1:9\n", "no token begins with `\\`"),
    ] {
        let complaint = dynamics_on(file.as_bytes(), &["check", "-", "--robot", "A"]).failed(1);
        assert!(
            complaint.contains(expected) && complaint.contains(&format!("<stdin>{place}")),
            "{complaint}"
        );
    }
}

#[test]
fn mistakes_in_a_urdf_of_a_struct_are_shown_in_it() {
    let file = a_crate("urdf_of_struct");
    let urdf = file.replace("src/bin/two.rs", "robots/arm.urdf");
    let text = std::fs::read_to_string(&urdf).unwrap();
    std::fs::write(&urdf, text.replacen("<mass value=\"", "<mass value=\"-", 1)).unwrap();
    let complaint = dynamics(&["check", &file, "--robot", "Arm"]).failed(1);
    assert!(complaint.contains("/robots/arm.urdf:") && complaint.contains("MassNegative"), "{complaint}");
    assert!(complaint.contains("<mass value=\"-"), "{complaint}");
}
