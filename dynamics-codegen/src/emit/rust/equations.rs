//! The equations in closed form: in the documentation of the methods, and as constants.

use std::fmt::Write as _;

use super::items::Emitter;
use crate::closed::{Form, Matrix, Notation};
use crate::mechanics::closed::ClosedForms;
use crate::mechanics::equations::Method;
use crate::mechanics::letters::Letters;

/// A documentation has no more lines of equations.
const LINES: usize = 16;
/// Nor longer ones, in letters.
const WIDTH: usize = 110;

/// What a method returns, in closed form.
enum Value<'c> {
    Form(&'c Form),
    Matrix(&'c Matrix),
}

impl Value<'_> {
    fn unicode(&self, notation: &Notation) -> Vec<String> {
        match self {
            Self::Form(form) => vec![form.unicode(notation)],
            Self::Matrix(matrix) => matrix.unicode(notation),
        }
    }

    fn latex(&self, notation: &Notation) -> String {
        match self {
            Self::Form(form) => form.latex(notation),
            Self::Matrix(matrix) => matrix.latex(notation),
        }
    }
}

/// What has a closed form: the method, its letter, and the form.
fn values(closed: &ClosedForms) -> Vec<(Method, &'static str, Value<'_>)> {
    let passive = closed.passive_forces.as_ref();
    let passive = passive.map(|forces| (Method::PassiveForces, "P", Value::Matrix(forces)));
    let always = [
        (Method::MassMatrix, "M", Value::Matrix(&closed.mass_matrix)),
        (Method::CoriolisMatrix, "C", Value::Matrix(&closed.coriolis_matrix)),
        (Method::GravityForces, "G", Value::Matrix(&closed.gravity_forces)),
        (Method::KineticEnergy, "T", Value::Form(&closed.kinetic_energy)),
        (Method::PotentialEnergy, "V", Value::Form(&closed.potential_energy)),
        (Method::Lagrangian, "L", Value::Form(&closed.lagrangian)),
    ];
    always.into_iter().chain(passive).collect()
}

/// The closed form of what a method returns, as lines of its documentation, without the slashes; none if it has none.
pub(super) fn documentation(closed: Option<&ClosedForms>, method: Method) -> Vec<String> {
    let Some(closed) = closed else { return vec![] };
    let Some((_, letter, value)) = values(closed).into_iter().find(|(known, ..)| *known == method) else {
        return vec![];
    };
    let notation = &closed.notation;
    let (plain, letter) = (letter, &*Letters::of(notation).unicode(letter));
    let mut lines = beside(letter, &value.unicode(notation));
    if lines.iter().any(|line| line.chars().count() > WIDTH) {
        lines = match value {
            Value::Form(form) => broken(letter, form, notation),
            Value::Matrix(matrix) => matrix.unicode_entries(letter, notation),
        };
    }
    let definitions = closed.definitions.iter().map(|(symbol, form)| {
        format!("{} = {}", Form::Symbol(*symbol).unicode(notation), form.unicode(notation))
    });
    lines.extend(definitions);
    if lines.is_empty() {
        return vec![];
    }
    if lines.len() > LINES || lines.iter().any(|line| line.chars().count() > 2 * WIDTH) {
        return vec!["Its closed form is in `equations()`: it is too long for this place.".to_owned()];
    }
    let mut told = vec![];
    if letter != plain {
        told.push(format!("The robot has a letter {plain} of its own; here this is {letter}:"));
    }
    [told, vec!["```text".to_owned()], lines, vec!["```".to_owned()]].concat()
}

/// A matrix with a letter before it, on its middle line.
fn beside(letter: &str, rows: &[String]) -> Vec<String> {
    let middle = rows.len().saturating_sub(1) / 2;
    let space = " ".repeat(letter.chars().count() + 3);
    let line = |(k, row): (usize, &String)| {
        if k == middle { format!("{letter} = {row}") } else { format!("{space}{row}") }
    };
    rows.iter().enumerate().map(line).collect()
}

/// A long sum, its terms in lines.
fn broken(letter: &str, form: &Form, notation: &Notation) -> Vec<String> {
    let Form::Sum(terms) = form else { return vec![format!("{letter} = {}", form.unicode(notation))] };
    let mut lines = vec![format!("{letter} = ")];
    for (k, term) in terms.iter().enumerate() {
        let text = term.unicode(notation);
        let text = match (k, text.strip_prefix('−')) {
            (0, _) => text,
            (_, Some(rest)) => format!(" − {rest}"),
            (_, None) => format!(" + {text}"),
        };
        match lines.last_mut() {
            Some(line) if k == 0 || line.chars().count() + text.chars().count() <= WIDTH => {
                line.push_str(&text)
            }
            _ => lines.push(format!("   {text}")),
        }
    }
    lines
}

impl Emitter<'_, '_> {
    /// `equations()`, on the robot itself.
    pub(super) fn equations(&self) -> String {
        let Some(closed) = self.input.closed else { return String::new() };
        let notation = &closed.notation;
        let visibility = &self.item.visibility;
        let mut text = self.open_without_scalar(&self.robot(), "");
        text.push_str(
            "        /// What the equations look like on paper, in Unicode and in LaTeX.\n        \
             ///\n        /// No number is computed, and what is not used is not linked.\n        #[must_use]\n",
        );
        let _ = writeln!(
            text,
            "        {visibility}const fn equations() -> Equations {{\n            Equations {{"
        );
        for (method, _, value) in values(closed) {
            let (unicode, latex) = (value.unicode(notation).join("\n"), value.latex(notation));
            let equation = equation(&unicode, &latex);
            let equation =
                if method == Method::PassiveForces { format!("Some({equation})") } else { equation };
            let _ = writeln!(text, "                {}: {equation},", method.name());
        }
        if closed.passive_forces.is_none() {
            text.push_str("                passive_forces: None,\n");
        }
        let definitions = closed.definitions.iter().map(|(symbol, form)| {
            let name = Form::Symbol(*symbol);
            let (name, value) = (
                equation(&name.unicode(notation), &name.latex(notation)),
                equation(&form.unicode(notation), &form.latex(notation)),
            );
            format!("Definition {{ name: {name}, value: {value} }}")
        });
        let definitions = definitions.collect::<Vec<_>>().join(", ");
        let _ = writeln!(
            text,
            "                definitions: &[{definitions}],\n            }}\n        }}\n    }}\n"
        );
        text
    }
}

/// A form in both notations, as it stands in the list of them.
fn equation(unicode: &str, latex: &str) -> String {
    let (indent, end) = (" ".repeat(20), " ".repeat(16));
    format!("Equation {{\n{indent}unicode: {},\n{indent}latex: {},\n{end}}}", quoted(unicode), quoted(latex))
}

/// A text as a literal of Rust; dots above letters stay where they are.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n"))
}
