//! What is written, as the lecture and the textbooks write it.

use dynamics_codegen::closed::{Form, Matrix, Notation, evaluate};
use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::mechanics::closed::{ClosedForms, closed_forms};
use dynamics_codegen::mechanics::equations::Argument;
use dynamics_codegen::mechanics::equations::Inputs;
use dynamics_codegen::mechanics::plain::Oracle;
use dynamics_codegen::model;
use dynamics_codegen::symbolic::{Evaluator, Graph, SymbolId};

use super::proof::spec_of;
use super::{robots, textbook};

/// The struct of a robot, as a user writes it.
fn source(robot: &str) -> &'static str {
    robots::ROBOTS.iter().find(|(name, _)| *name == robot).unwrap().1
}

/// The closed forms of the robot that a struct with its attributes describes.
fn forms(source: &str) -> Option<ClosedForms> {
    let spec = spec_of(source);
    let mut diags = Diagnostics::new();
    let graph = Graph::new();
    let model = model::build(&spec, &graph, &mut diags);
    diags.check().unwrap_or_else(|mistakes| panic!("{source}: {mistakes:?}"));
    closed_forms(&model.unwrap(), &graph).ok()
}

/// All equations, one a line.
fn text(forms: &ClosedForms) -> String {
    let notation = &forms.notation;
    let mut lines: Vec<String> = Vec::new();
    for (symbol, form) in &forms.definitions {
        lines.push(format!("{} = {}", notation.letter(*symbol).name.unicode(), form.unicode(notation)));
    }
    lines.extend(forms.mass_matrix.unicode_entries("M", notation));
    lines.extend(forms.coriolis_matrix.unicode_entries("C", notation));
    lines.extend(forms.gravity_forces.unicode_entries("G", notation));
    lines.extend(forms.passive_forces.iter().flat_map(|forces| forces.unicode_entries("P", notation)));
    lines.push(format!("T = {}", forms.kinetic_energy.unicode(notation)));
    lines.push(format!("V = {}", forms.potential_energy.unicode(notation)));
    lines.push(format!("L = {}", forms.lagrangian.unicode(notation)));
    lines.join("\n") + "\n"
}

fn has_lines(robot: &str, expected: &[&str]) {
    let forms = forms(source(robot)).unwrap();
    let text = text(&forms);
    for line in expected {
        assert!(text.lines().any(|found| found == *line), "{robot}: no `{line}` in\n{text}");
    }
}

/// EECS 106A, discussion 9, problem 5; its print has `r₁` for `r₁²` in M₁₁.
#[test]
fn robojudge() {
    has_lines(
        "robo_judge",
        &[
            "M₁₁ = I_z₁ + I_y₂ sin²θ₂ + I_z₂ cos²θ₂ + m₂ r₁² cos²θ₂",
            "M₂₂ = I_x₂ + m₂ r₁²",
            "V = g (m₁ r₀ + m₂ (l₁ − r₁ sin θ₂))",
        ],
    );
    let forms = forms(source("robo_judge")).unwrap();
    let [t, v, l] = [&forms.kinetic_energy, &forms.potential_energy, &forms.lagrangian]
        .map(|form| form.unicode(&forms.notation));
    assert_eq!(l, format!("{t} − {v}"));
    assert_eq!(
        forms.mass_matrix.latex(&forms.notation),
        "\\begin{bmatrix} I_{z_1} + I_{y_2} \\sin^{2} \\theta_2 + I_{z_2} \\cos^{2} \\theta_2 + m_2 r_1^{2} \\cos^{2} \
         \\theta_2 & 0 \\\\ 0 & I_{x_2} + m_2 r_1^{2} \\end{bmatrix}"
    );
}

/// The same, problem 4: the box that is tossed.
#[test]
fn tossed_box() {
    has_lines(
        "ball_toss",
        &["L = m/24 (ω_x² (w² + h²) + ω_y² (l² + h²) + ω_z² (l² + w²)) + ½ m r\u{307}² − m g r"],
    );
}

#[test]
fn double_pendulum() {
    has_lines(
        "double_pendulum",
        &[
            "M₁₁ = m₁ l₁² + m₂ (l₁² + l₂² + 2 l₁ l₂ cos θ₂)",
            "M₁₂ = M₂₁ = m₂ (l₂² + l₁ l₂ cos θ₂)",
            "M₂₂ = m₂ l₂²",
            "C₁₂ = −m₂ l₁ l₂ sin θ₂ (θ\u{307}₁ + θ\u{307}₂)",
            "V = −(m₁ + m₂) g l₁ cos θ₁ − m₂ g l₂ cos(θ₁ + θ₂)",
        ],
    );
}

#[test]
fn cart_pole() {
    has_lines(
        "cart_pole",
        &[
            "M₁₁ = m_c + m_p",
            "M₁₂ = M₂₁ = m_p l cos θ",
            "M₂₂ = J + m_p l²",
            "C₁₂ = −m_p l sin θ θ\u{307}",
            "G₂ = −m_p g l sin θ",
        ],
    );
}

/// M. Spong, S. Hutchinson, M. Vidyasagar, *Robot Modeling and Control*, the planar elbow; R. Murray, Z. Li, S. Sastry, 4.3.
#[test]
fn two_link_arm() {
    has_lines(
        "two_link_arm",
        &[
            "M₁₁ = I_z₁ + I_z₂ + m₁ r₁² + m₂ (l₁² + r₂² + 2 l₁ r₂ cos θ₂)",
            "M₁₂ = M₂₁ = I_z₂ + m₂ (r₂² + l₁ r₂ cos θ₂)",
            "M₂₂ = I_z₂ + m₂ r₂²",
            "C₁₁ = −m₂ l₁ r₂ sin θ₂ θ\u{307}₂",
            "C₁₂ = −m₂ l₁ r₂ sin θ₂ (θ\u{307}₁ + θ\u{307}₂)",
            "C₂₁ = m₂ l₁ r₂ sin θ₂ θ\u{307}₁",
        ],
    );
}

#[test]
fn snapshots() {
    let mut all = String::new();
    for (name, source) in robots::ROBOTS {
        let Some(forms) = forms(source).filter(|forms| forms.definitions.is_empty()) else { continue };
        all += &format!("{name}\n\n{}\n\n", text(&forms));
    }
    insta::assert_snapshot!("small_robots", all);
    insta::assert_snapshot!("stanford_arm", text(&forms(source("stanford_arm")).unwrap()));
}

/// What a lecturer would write: squares of springs, quotients that end their products, one term for each angle.
#[test]
fn textbooks_write_it_so() {
    let has_lines = |system: &str, expected: &[&str]| {
        let source = textbook::SYSTEMS.iter().find(|(name, _)| *name == system).unwrap().1;
        let text = text(&forms(source).unwrap());
        for line in expected {
            assert!(text.lines().any(|found| found == *line), "{system}: no `{line}` in\n{text}");
        }
    };
    has_lines("elastic_pendulum", &["T = ½ m (r² θ\u{307}² + r\u{307}²)", "V = ½ k (r − l)² − m g r cos θ"]);
    has_lines("chain_of_springs", &["V = ½ k ((x₁ − x₂)² + (x₂ − x₃)²)"]);
    has_lines("spring_to_the_wall", &["V = ½ k (√(l² + a² + 2 l a sin θ) − s)² − m g l cos θ"]);
    has_lines("elbow_out_of_plane", &["M₁₁ = m₁ a₁²/4 + m₂ (a₁ + ½ a₂ cos q₂)²"]);
    has_lines("slider_with_a_quotient", &["M₁ = m l² (1 + 1/(1 + sin²q))"]);
    has_lines("planar_4r", &["M₂₂ = 2 m l² (3 + 2 cos q₃ + cos(q₃ + q₄) + cos q₄)"]);
    let row =
        "G₁ = g ((m₁ c₁ + (m₂ + m₃) l₁) cos q₁ + (m₂ c₂ + m₃ l₂) cos(q₁ + q₂) + m₃ c₃ cos(q₁ + q₂ + q₃))";
    has_lines("planar_3r", &[row]);
}

/// What stands on slides.
#[test]
fn systems_of_textbooks() {
    let mut all = String::new();
    for (name, source) in textbook::SYSTEMS {
        let forms = forms(source).unwrap();
        all += &format!("{name}\n\n{}\n\n", text(&forms));
    }
    insta::assert_snapshot!("systems_of_textbooks", all);
}

/// What is printed of every robot is read back.
#[test]
fn all_of_it_is_read_back() {
    for (name, source) in robots::ROBOTS.iter().chain(textbook::SYSTEMS) {
        let Some(forms) = forms(source) else { continue };
        let notation = &forms.notation;
        for form in all_forms(&forms) {
            let (unicode, latex) = (form.unicode(notation), form.latex(notation));
            assert_eq!(Form::parse_unicode(&unicode, notation).as_ref(), Ok(&form), "{name}: {unicode}");
            assert_eq!(Form::parse_latex(&latex, notation).as_ref(), Ok(&form), "{name}: {latex}");
        }
        for matrix in [&forms.mass_matrix, &forms.coriolis_matrix, &forms.gravity_forces] {
            let (unicode, latex) = (matrix.unicode(notation).join("\n"), matrix.latex(notation));
            assert_eq!(Matrix::parse_unicode(&unicode, notation).as_ref(), Ok(matrix), "{name}:\n{unicode}");
            assert_eq!(Matrix::parse_latex(&latex, notation).as_ref(), Ok(matrix), "{name}: {latex}");
        }
    }
}

/// Sines in angles, and what else is no sum of these.
#[test]
fn sines_in_angles_are_written() {
    let printed = |potential: &str| {
        let text = format!(
            "#[coordinate(t: angle, armature = 1)] #[potential({potential})] struct Nested<T> {{ k: T, l: T }}"
        );
        let forms = forms(&text).unwrap();
        let unicode = forms.potential_energy.unicode(&forms.notation);
        assert_eq!(Form::parse_unicode(&unicode, &forms.notation).as_ref(), Ok(&forms.potential_energy));
        unicode
    };
    assert_eq!(printed("k * sin(sin(t))"), "k sin(sin t)");
    assert_eq!(printed("k * sin(t * sin(t))"), "k sin(t sin t)");
    assert_eq!(printed("k * cos(3 * sin(t))"), "k cos(3 sin t)");
    assert_eq!(printed("k * cos(sqrt(2 + cos(t)))"), "k cos(√(2 + cos t))");
    assert_eq!(printed("k * sin(sin(sin(t)))"), "k sin(sin(sin t))");
}

/// A matrix that cannot be read says where.
#[test]
fn a_matrix_is_read_or_refused_at_its_place() {
    let notation = forms(source("double_pendulum")).unwrap().notation;
    let place = |text: &str| Matrix::parse_unicode(text, &notation).unwrap_err().at;
    assert_eq!(place("[1  2]\n1  2]"), 7);
    assert_eq!(place("[1  2 +]"), 8 - "]".len());
    assert!(Matrix::parse_unicode("[1  2]\n[1]", &notation).is_err());
    assert!(Matrix::parse_latex("\\begin{bmatrix} 1 & 2", &notation).is_err());
}

fn of_matrix(matrix: &Matrix) -> Vec<Form> {
    let entry = |k: usize| matrix.entry(k / matrix.columns(), k % matrix.columns()).clone();
    (0..matrix.rows() * matrix.columns()).map(entry).collect()
}

fn all_forms(forms: &ClosedForms) -> Vec<Form> {
    let mut all: Vec<Form> = forms.definitions.iter().map(|(_, form)| form.clone()).collect();
    for matrix in [&forms.mass_matrix, &forms.coriolis_matrix, &forms.gravity_forces] {
        all.extend(of_matrix(matrix));
    }
    all.extend(forms.passive_forces.iter().flat_map(of_matrix));
    all.extend([&forms.kinetic_energy, &forms.potential_energy, &forms.lagrangian].map(Clone::clone));
    all
}

/// Floats have six digits on paper; each entry is a sum of some dozen.
const SIX_DIGITS: f64 = 2e-5;

/// In doubles, the forms have the values of the plain recursion, also of robots with floats.
#[test]
fn closed_forms_have_the_values_of_the_plain_recursion() {
    let mut written = 0;
    for (name, source) in robots::ROBOTS.iter().chain(textbook::SYSTEMS) {
        let spec = spec_of(source);
        let mut diags = Diagnostics::new();
        let graph = Graph::new();
        let model = model::build(&spec, &graph, &mut diags).unwrap();
        diags.check().unwrap();
        let Ok(forms) = closed_forms(&model, &graph) else { continue };
        written += 1;
        let inputs = Inputs::of(&model);
        let parameters: Vec<f64> = model.parameters.iter().map(|parameter| parameter.sample).collect();
        let mut evaluator = Evaluator::new(&graph, |symbol: SymbolId| parameters[symbol.0 as usize]);
        let tree = model.tree.map(|expr| evaluator.value(expr));
        let mut random = dynamics_codegen::spatial::Random(17);
        let mut vector = |size: usize| (0..size).map(|_| random.next()).collect::<Vec<f64>>();
        let (mut q, v) = (vector(inputs.size(Argument::Q)), vector(inputs.dof));
        tree.normalise(&mut q);
        let mut values = [parameters.clone(), q.clone(), v.clone(), vec![0.0; 2 * inputs.dof]].concat();
        for (_, form) in &forms.definitions {
            let value = evaluate(form, &|symbol: SymbolId| values[symbol.0 as usize]);
            values.push(value);
        }
        let oracle = Oracle::new(&tree);
        let expected = [
            oracle.mass_matrix(&q).concat(),
            oracle.coriolis_matrix(&q, &v).concat(),
            oracle.gravity_forces(&q),
            forms.passive_forces.iter().flat_map(|_| oracle.passive_forces(&q, &v)).collect(),
            vec![oracle.kinetic_energy(&q, &v), oracle.potential_energy(&q), oracle.lagrangian(&q, &v)],
        ];
        if forms.passive_forces.is_none() {
            assert!(oracle.passive_forces(&q, &v).iter().all(|force| *force == 0.0), "{name}");
        }
        let size = expected.concat().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        let found = all_forms(&forms)[forms.definitions.len()..]
            .iter()
            .map(|form| evaluate(form, &|symbol: SymbolId| values[symbol.0 as usize]))
            .collect::<Vec<f64>>();
        for (k, (x, y)) in found.iter().zip(expected.concat()).enumerate() {
            assert!((x - y).abs() <= SIX_DIGITS * size, "{name}, {k}: {x}, not {y}");
        }
    }
    assert!(written > robots::ROBOTS.len() * 3 / 4, "most are written: {written}");
}

/// Names are those of the fields and joints, where these are letters.
#[test]
fn names() {
    let forms = forms(source("cart_pole")).unwrap();
    let notation: &Notation = &forms.notation;
    let names: Vec<String> = (0..9).map(|k| notation.letter(SymbolId(k)).name.unicode()).collect();
    assert_eq!(names, ["m_c", "m_p", "l", "J", "g", "x", "θ", "x\u{307}", "θ\u{307}"]);
}
