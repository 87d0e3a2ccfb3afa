//! No letter has two meanings on one page: those of the equations give way to the robot's own.

use super::{dynamics, dynamics_on, folder};

/// A robot that has nearly all letters that a lecture would like to have.
const GREEDY: &str = "#[derive(Dynamics)]
#[dynamics(gravity = [0, 0, -G])]
#[joint(alpha: revolute(y), world -> b1, damping = E + v)]
#[body(b1, mass = M + A + B + C + D, com = [L, 0, 0], inertia = diag(J + K + P + R, J + K + P + R, J + K + P + R))]
#[joint(beta: prismatic(x), b1 -> b2, stiffness = u)]
#[body(b2, mass = m + a + e + f + h, com = [p, 0, 0], inertia = diag(T + V + q + t, T + V + q + t, T + V + q + t))]
#[potential(x * cos(alpha))]
struct Greedy<F> {
    G: F, E: F, v: F, M: F, A: F, B: F, C: F, D: F, L: F, J: F, K: F, P: F, R: F, u: F, m: F, a: F, e: F, f: F, h: F, p: F, T: F,
    V: F, q: F, t: F, x: F,
}";

/// The cart and the pole of the books, whose letters are M, L, J and x.
const CART: &str = "#[derive(Dynamics)]
#[joint(x: prismatic(x), world -> cart)]
#[body(cart, solid = point(M))]
#[joint(theta: revolute(y), cart -> pole)]
#[body(pole, mass = m, com = [0, 0, L], inertia = diag(J, J, 0))]
struct Cart<F> { M: F, m: F, L: F, J: F }";

/// The letters by themselves on the left of an equation, without those that stand lowered and the d of differentials.
fn letters_on_the_left(line: &str) -> Vec<char> {
    let Some((left, _)) = line.split_once(" = ").filter(|_| line.starts_with("    ")) else { return vec![] };
    let mut letters = vec![];
    let mut before = ' ';
    for letter in left.chars() {
        if letter.is_ascii_alphabetic() && before != '_' && !before.is_ascii_alphabetic() && letter != 'd' {
            letters.push(letter);
        }
        before = if letter.is_ascii_alphabetic() && before == '_' { '_' } else { letter };
    }
    letters
}

#[test]
fn a_derivation_leaves_the_robot_its_letters() {
    let text = dynamics_on(GREEDY.as_bytes(), &["explain", "-"]).ok();
    let equations = text.lines().filter(|line| line.starts_with("    ") && line.contains(" = "));
    assert!(equations.count() > 30, "{text}");
    for line in text.lines() {
        assert!(letters_on_the_left(line).is_empty(), "{line}");
    }
    assert!(text.contains("𝐌 = 𝒯") || text.contains("ℒ = 𝒯 − 𝒱"), "{text}");
    assert!(!text.contains(['\u{e000}', '\u{e001}']), "{text}");
}

#[test]
fn a_page_says_which_letters_gave_way() {
    let text = dynamics_on(CART.as_bytes(), &["explain", "-"]).ok();
    let told = text.split("\n\n").find(|part| part.contains("give way")).unwrap().replace('\n', " ");
    for part in ["ℒ the Lagrangian", "𝐌 the mass matrix", "𝐱 the state", "𝐉 is a Jacobian"] {
        assert!(told.contains(part), "{told}");
    }
    for line in
        ["    ℒ = ½ (M + m) x\u{307}²", "    𝐌 = ⎡  M + m ", "    ∂ℒ/∂x\u{307} = ", "    V = 9.81 m L cos θ"]
    {
        assert!(text.contains(line), "{line}\n{text}");
    }
    let latex = dynamics_on(CART.as_bytes(), &["explain", "-", "--format", "latex"]).ok();
    assert!(latex.is_ascii() && latex.contains("{\\mathbf M} = \\begin{bmatrix} M + m"), "{latex}");
    assert!(latex.contains("\\frac{\\partial {\\mathcal L}}{\\partial \\dot{x}}"), "{latex}");
}

#[test]
fn a_report_leaves_the_robot_its_letters() {
    let file = folder("letters").join("cart.rs");
    std::fs::write(&file, CART).unwrap();
    let values = ["--set", "M = 2, m = 1, L = 0.5, J = 0.1"];
    let page = dynamics(&[&["report", file.to_str().unwrap()], &values[..]].concat()).ok();
    for part in
        ["𝐌(q)·a + C(q,v)·v + G(q)", "<mi>𝐌</mi><mo stretchy", "<mi>ℒ</mi><mo>=", "{\\mathbf M}(q) = \\begin"]
    {
        assert!(page.contains(part), "{part}");
    }
    assert!(page.contains("give way: 𝐌 is the mass matrix and ℒ the Lagrangian."));
}
