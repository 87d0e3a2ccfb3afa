//! `dynamics explain ROBOT`: the equations of a robot, derived step by step.

use super::{ROBOTS, command, dynamics, dynamics_on, folder, model};

const JUDGE: [&str; 4] = ["explain", "../../examples/robojudge.rs", "--robot", "RoboJudge"];

/// What a student reads; its lines are the lecture's.
#[test]
fn the_robojudge() {
    let text = dynamics(&JUDGE).ok();
    for line in [
        "    J₂ᵇ = ⎢    0       −r₁⎥",
        "    M = ⎡I_z₁ + I_y₂ sin²θ₂ + I_z₂ cos²θ₂ + m₂ r₁² cos²θ₂        0      ⎤",
        "        ⎣                       0                          I_x₂ + m₂ r₁²⎦",
        "    V = g (m₁ r₀ + m₂ (l₁ − r₁ sin θ₂))",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
    insta::assert_snapshot!(text);
}

const PENDULUM: &str = "#[derive(Dynamics)]
#[joint(theta: revolute(y), world -> bob, damping = c)]
#[body(bob, com = [0, 0, -l], solid = point(m))]
struct Pendulum { m: f64, l: f64, c: f64 }";

#[test]
fn a_pendulum_in_markdown_and_latex() {
    insta::assert_snapshot!(dynamics_on(PENDULUM.as_bytes(), &["explain", "-", "--format", "markdown"]).ok());
    insta::assert_snapshot!(dynamics_on(PENDULUM.as_bytes(), &["explain", "-", "--format", "latex"]).ok());
}

/// Numbers that are set stand in the equations.
#[test]
fn a_field_may_be_a_number() {
    let text = dynamics_on(PENDULUM.as_bytes(), &["explain", "-", "--set", "l = 50cm, c = 0"]).ok();
    assert!(text.contains("V = −4.905 m cos θ") && !text.contains("Dampers"), "{text}");
}

/// Of every robot there is a text that ends, in every format. LaTeX needs no letters that it has not.
#[test]
fn every_robot_is_explained_as_far_as_it_can_be_read() {
    let urdfs = ROBOTS.iter().map(|(robot, options)| (model(robot), options.to_vec()));
    let examples =
        [("racket", "Thrown"), ("robojudge", "TossedBox"), ("acrobot", "Acrobot"), ("monte_carlo", "Arm")];
    let structs = examples.map(|(file, name)| (format!("../../examples/{file}.rs"), vec!["--robot", name]));
    for (file, options) in urdfs.chain(structs) {
        for format in ["unicode", "markdown", "latex"] {
            let text = dynamics(&[&["explain", &file, "--format", format], &options[..]].concat()).ok();
            assert!(text.contains("1. The robot, where its coordinates are zero"), "{file}: {text}");
            assert!(text.len() < 200_000, "{file}: {} bytes", text.len());
            // A derivation is whole, or says why it is not.
            assert!(text.contains("10. Linear") != text.contains("too long to be read"), "{file}: {text}");
            if format == "latex" {
                assert!(text.is_ascii() && text.ends_with("\\end{document}\n"), "{file}: {text}");
                assert_eq!(text.matches("\\begin{").count(), text.matches("\\end{").count(), "{file}");
                assert_eq!(text.matches('$').count() % 2, 0, "{file}");
                assert!(!text.contains("$$"), "{file}");
            }
        }
    }
}

/// A code is a code, whatever files there are; what looks like a path is one.
#[test]
fn a_code_is_told_from_a_file() {
    let here = folder("explained");
    std::fs::write(here.join("MassNegative"), PENDULUM).unwrap();
    let of = |asked: &str| {
        let output = command(&["explain", asked]).current_dir(&here).output().unwrap();
        super::Done::of(output)
    };
    assert!(of("MassNegative").ok().starts_with("dynamics::MassNegative\n"));
    // It is no file of Rust by its name.
    assert!(of("./MassNegative").failed(1).contains("the file is no XML"));
    assert!(of("MassNegatve").failed(1).contains("there is no code `MassNegatve`, and no file"));
    assert!(of("no/such.urdf").failed(1).contains("cannot be read"));
}
