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
    assert!(text.contains("V₁ = −4.905 m cos θ") && !text.contains("dampers"), "{text}");
}

/// The numbers of sections, in order.
fn sections(text: &str) -> Vec<usize> {
    let number = |line: &str| line.split_once(". ").and_then(|(number, _)| number.parse().ok());
    let lines: Vec<&str> = text.lines().collect();
    lines.windows(2).filter(|pair| pair[1].starts_with('─')).filter_map(|pair| number(pair[0])).collect()
}

/// Of what a robot has not, nothing is said; what it has is called by its name.
#[test]
fn sentences_fit_the_robot() {
    let of = |text: &str| dynamics_on(text.as_bytes(), &["explain", "-"]).ok();
    let bead = of("#[derive(Dynamics)] #[coordinate(theta: angle)] #[kinetic(m / 2 * r^2 * dot(theta)^2)]
        #[potential(-m * g * r * cos(theta) - m / 2 * r^2 * w^2 * sin(theta)^2)]
        struct Bead { m: f64, r: f64, g: f64, w: f64 }");
    assert_eq!(sections(&bead), (1..=8).collect::<Vec<_>>());
    assert!(bead.contains("`theta`: an angle, θ.") && bead.contains("M⁻¹·(u − G)"), "{bead}");
    for absent in ["falls", "gravity", "bodies", "Jacobian", "twist", "C·q̇", "rounded", "P ="] {
        assert!(!bead.contains(absent), "{absent}: {bead}");
    }
    let planar = of("#[derive(Dynamics)] #[joint(a: planar(z), world -> plate, actuated = off)]
        #[body(plate, mass = m, inertia = diag(J, J, J))] #[dynamics(gravity = [0, 0, 0])] struct Planar { m: f64, J: f64 }");
    let joint =
        "`a`: `plate` slides on the world along (1, 0, 0), by x, then along (0, 1, 0), by y, then turns";
    assert!(planar.replace("\n    ", " ").contains(joint), "{planar}");
    assert!(planar.contains("There is no gravity.") && planar.contains("    d/dt q̇ = 0\n"), "{planar}");
    let sprung = of("#[derive(Dynamics)] #[joint(x: prismatic(x), world -> cart, stiffness = k, rest = 1/3000000)]
        #[body(cart, solid = point(m))] #[coordinate(y: length)] #[kinetic(m / 2 * dot(y)^2)] #[potential(k / 2 * (x - y)^2)]
        #[dynamics(gravity = [0, 0, -g])] struct Sprung { m: f64, k: f64, g: f64 }");
    for present in
        ["Gravity and other potentials", "springs act by", "τ = Υ + P", "`y`: a length, y.", "rounded"]
    {
        assert!(sprung.contains(present), "{present}: {sprung}");
    }
    // One name, one meaning.
    assert_eq!(sprung.matches("Υ₁ = ").count(), 1, "{sprung}");
    let ball = of("#[derive(Dynamics)] #[joint(s: ball, world -> b)]
        #[body(b, mass = m, com = [0, 0, -l], inertia = diag(A, A, C))] struct Ball { m: f64, l: f64, A: f64, C: f64 }");
    for present in ["how fast V grows", "small rotation vector δr", "½ q_w ω_x", "Koszul"] {
        assert!(ball.contains(present), "{present}: {ball}");
    }
    assert!(!ball.contains("∂V/∂q"), "{ball}");
}

/// Why there is no linear model is said of the robot that has none.
#[test]
fn the_reason_without_a_linear_model_is_the_robots() {
    let top = "#[derive(Dynamics)] #[joint(phi: revolute(z), world -> a)] #[body(a)] #[joint(theta: revolute(x), a -> b)] #[body(b)]
        #[joint(psi: revolute(z), b -> c)] #[body(c, mass = 1, com = [0, 0, 0.3], inertia = diag(0.1, 0.1, 0.05))] struct Top;";
    let text = dynamics_on(top.as_bytes(), &["explain", "-"]).ok();
    assert!(text.contains("M is singular there") && !text.contains("no derivative"), "{text}");
    let spring = "#[derive(Dynamics)] #[joint(theta: revolute(y), world -> arm)] #[body(arm)]
        #[joint(r: prismatic(-z), arm -> bob)] #[body(bob, solid = point(m), com = [0, 0.1, 0])]
        #[potential(k / 2 * (sqrt(r * r) - l)^2)] struct OnASpring { m: f64, k: f64, l: f64 }";
    let text = dynamics_on(spring.as_bytes(), &["explain", "-"]).ok();
    assert!(text.contains("no derivative") && !text.contains("is singular"), "{text}");
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
            assert_eq!(
                text.contains("9. The state space"),
                !text.contains("What comes next would"),
                "{file}: {text}"
            );
            if format == "latex" {
                assert!(text.is_ascii() && text.ends_with("\\end{document}\n"), "{file}: {text}");
                assert_eq!(text.matches("\\begin{").count(), text.matches("\\end{").count(), "{file}");
                assert_eq!(text.matches('$').count() % 2, 0, "{file}");
                assert!(!text.contains("$$"), "{file}");
            }
        }
    }
}

/// Where a closed form would swell, the derivation says what would, and goes on by names, to the linear model.
#[test]
fn a_long_derivation_goes_on_by_names() {
    let text = dynamics(&["explain", &model("iiwa14")]).ok();
    for present in ["R₇′ = ", "S₇ = ", "C = Σ J_iᵀ·(ℳ_i·J̇_i + ℬ_i·J_i)"] {
        assert!(text.contains(present), "{present}: {text}");
    }
    assert_eq!(sections(&text), (1..=10).collect::<Vec<_>>());
    let joint = |k: usize| {
        let parent = if k == 0 { "world".to_owned() } else { format!("b{}", k - 1) };
        format!(
            "#[joint(j{k}: revolute(z), {parent} -> b{k}, at = [l, 0, 0])] #[body(b{k}, com = [l, 0, 0], solid = point(m))] "
        )
    };
    let of = |count: usize| {
        let chain = (0..count).map(joint).collect::<String>();
        dynamics_on(
            format!("#[derive(Dynamics)] {chain} struct Chain {{ m: f64, l: f64 }}").as_bytes(),
            &["explain", "-"],
        )
        .ok()
    };
    // On a sheet of paper; entries of wide matrices have lines of their own.
    let four = of(4);
    assert!(four.contains("    M₃₃ = m l² (3 + 2 cos j₃)\n") || four.contains("    M₄₄ = m l²\n"), "{four}");
    assert!(
        four.contains("The other entries of C are zero.") && !four.contains("nobody could read"),
        "{four}"
    );
    let long = of(61).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(long.contains("60 parts that move are the most") && !long.contains(" 2. "), "{long}");
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
    // What a file holds says what it is, whatever it is called.
    assert!(of("./MassNegative").ok().starts_with("The equations of motion of `Pendulum`\n"));
    assert!(of("MassNegatve").failed(1).contains("there is no code `MassNegatve`, and no file"));
    assert!(of("no/such.urdf").failed(1).contains("cannot be read"));
}
