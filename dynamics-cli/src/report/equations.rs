//! The equations, in closed form, as far as a page has room for them.

use std::collections::BTreeMap;

use dynamics_codegen::closed::{Form, Matrix, Notation};
use dynamics_codegen::mechanics::closed::{ClosedForms, closed_forms};
use dynamics_codegen::mechanics::equations::Argument;
use dynamics_view::page::{Equation, Section, Table};

use super::Subject;

/// Robots of more degrees of freedom are asked for no closed forms: nobody could read them.
const LARGEST: usize = 9;
/// Equations of more bytes are left out of the page.
const LONGEST: usize = 400_000;

pub(super) fn section(subject: &Subject<'_, '_>) -> Section {
    let section = Section::new("equations", "Equations of motion").text(
        "The joints move by M(q)·a + C(q,v)·v + G(q) + passive = τ, where v = q̇ and a = v̇ (of ball and free joints v is \
         the twist of the body in its own axes), and passive are the forces of dampers, friction and springs.",
    );
    let section = section.table(symbols(subject));
    if subject.robot.dof() > LARGEST {
        return section.text(&too_large(subject));
    }
    let forms = closed_forms(&subject.robot.model, subject.graph);
    let equations = written(&forms);
    if equations.iter().map(|equation| equation.mathml.len()).sum::<usize>() > LONGEST {
        return section.text(&too_large(subject));
    }
    equations.into_iter().fold(section, Section::equation)
}

fn too_large(subject: &Subject<'_, '_>) -> String {
    format!(
        "In closed form the equations of {} degrees of freedom have more terms than a page can carry: they are printed \
         for robots of up to {LARGEST}, and as long as they have fewer than {} kB. What M is made of is drawn below, and \
         `dynamics generate` writes all of it as code.",
        subject.robot.dof(),
        LONGEST / 1000
    )
}

/// What each coordinate and speed is called in the equations.
fn symbols(subject: &Subject<'_, '_>) -> Table {
    let robot = subject.robot;
    let [q, v] = [Argument::Q, Argument::V].map(|argument| subject.letters(argument));
    let mut rows: BTreeMap<(usize, usize), Vec<String>> = BTreeMap::new();
    for (k, joint) in robot.model.joints.iter().enumerate() {
        let is_plain = joint.q.len() == joint.v.len();
        let count = joint.q.len().max(joint.v.len());
        for part in 0..count {
            let name = |names: &[String], range: &std::ops::Range<usize>| {
                range.clone().nth(part).and_then(|at| names.get(at)).cloned().unwrap_or_default()
            };
            let of_speed = name(&robot.coordinates.v, &joint.v);
            let of_speed = if is_plain || of_speed.is_empty() { String::new() } else { format!("`{of_speed}`") };
            let coordinate = format!("`{}`", name(&robot.coordinates.q, &joint.q));
            let coordinate = if part < joint.q.len() { coordinate } else { String::new() };
            rows.insert((k, part), vec![coordinate, name(&q, &joint.q), of_speed, name(&v, &joint.v)]);
        }
    }
    let has_twists = robot.tree.coordinates() != robot.dof();
    let drop = |mut row: Vec<String>| {
        if !has_twists {
            row.remove(2);
        }
        row
    };
    let head = ["coordinate", "symbol", "speed", "its symbol"].map(str::to_owned).to_vec();
    let head = if has_twists { head } else { ["coordinate", "symbol", "its rate"].map(str::to_owned).to_vec() };
    Table::new("Symbols", "llll").head(head).rows(rows.into_values().map(drop))
}

/// All of them, the shortest definitions first.
fn written(forms: &ClosedForms) -> Vec<Equation> {
    let ClosedForms { notation, definitions, .. } = forms;
    let mut equations = vec![];
    if !definitions.is_empty() {
        equations.push(of_definitions(definitions, notation));
    }
    equations.extend([
        of_matrix("Mass matrix", "M(q)", &forms.mass_matrix, notation),
        of_matrix("Coriolis matrix, with Ṁ = C + Cᵀ", "C(q,v)", &forms.coriolis_matrix, notation),
        of_matrix("Gravity forces, G = ∂V/∂q", "G(q)", &forms.gravity_forces, notation),
        of_form("Kinetic energy", "T", &forms.kinetic_energy, notation),
        of_form("Potential energy", "V", &forms.potential_energy, notation),
        of_form("Lagrangian, L = T − V", "L", &forms.lagrangian, notation),
    ]);
    equations
}

fn math(rows: &str) -> String {
    format!(r#"<math display="block">{rows}</math>"#)
}

/// The left-hand side: a letter, perhaps of arguments.
fn left(name: &str) -> String {
    let (letter, arguments) = name.split_once('(').unwrap_or((name, ""));
    let mut text = format!("<mi>{letter}</mi>");
    if let Some(arguments) = arguments.strip_suffix(')') {
        let names: Vec<String> = arguments.split(',').map(|name| format!("<mi>{name}</mi>")).collect();
        text += &format!("<mo>(</mo>{}<mo>)</mo>", names.join("<mo>,</mo>"));
    }
    text + "<mo>=</mo>"
}

fn of_matrix(title: &str, name: &str, matrix: &Matrix, notation: &Notation) -> Equation {
    Equation {
        title: title.to_owned(),
        mathml: math(&format!("<mrow>{}{}</mrow>", left(name), matrix.mathml(notation))),
        latex: format!("{name} = {}", matrix.latex(notation)),
    }
}

fn of_form(title: &str, name: &str, form: &Form, notation: &Notation) -> Equation {
    Equation {
        title: title.to_owned(),
        mathml: math(&format!("<mrow>{}{}</mrow>", left(name), form.mathml(notation))),
        latex: format!("{name} = {}", form.latex(notation)),
    }
}

/// Names for parts of the others, one below the other.
fn of_definitions(definitions: &[(dynamics_codegen::symbolic::SymbolId, Form)], notation: &Notation) -> Equation {
    let mut rows = String::new();
    let mut latex = vec![];
    for (symbol, form) in definitions {
        let name = &notation.letter(*symbol).name;
        rows += &format!(
            "<mtr><mtd>{}</mtd><mtd><mrow><mo>=</mo>{}</mrow></mtd></mtr>",
            name.mathml(),
            form.mathml(notation)
        );
        latex.push(format!("{} &= {}", name.latex(), form.latex(notation)));
    }
    Equation {
        title: "Names for parts of what follows".to_owned(),
        mathml: math(&format!("<mtable>{rows}</mtable>")),
        latex: format!("\\begin{{aligned}}\n{}\n\\end{{aligned}}", latex.join(" \\\\\n")),
    }
}
