//! The equations, in closed form, as far as a page has room for them.

use std::collections::BTreeMap;

use dynamics_codegen::closed::{Form, Limits, Matrix, Notation};
use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::mechanics::closed::{self, ClosedForms, MOST_DOF_WITH_NAMES, closed_forms};
use dynamics_codegen::mechanics::equations::Argument;
use dynamics_codegen::mechanics::letters::{self, Letters};
use dynamics_codegen::model::{self, Model, Parameter, Passive};
use dynamics_codegen::spec::RobotSpec;
use dynamics_codegen::symbolic::{Graph, SymbolId};
use dynamics_view::page::{Equation, Section, Table};

use super::Subject;
use crate::digits::{DIGITS, short};
use crate::failure::{Failure, Problem};
use crate::input::Input;
use crate::robot::Robot;

/// Equations of more bytes are left out of the page.
const LONGEST: usize = 400_000;
/// Matrices of more letters in a row are written entry by entry.
const WIDEST: usize = 100;

pub(super) fn section(subject: &Subject<'_, '_>) -> Result<Section, Failure> {
    let letters = Letters::of(&subject.notation);
    let told = told(subject);
    let section = Section::new("equations", "Equations of motion").text(&letters.unicode(&told));
    let given_way = letters.given_way(&format!("{told} T V L"));
    let section = match &given_way[..] {
        [] => section,
        given_way => section.text(&letters::told(given_way, |letter| letter.unicode.to_owned())),
    };
    let section = section.table(symbols(subject));
    let Some(forms) = forms(subject)? else { return Ok(section.text(&too_large(subject))) };
    let is_flat = subject.robot.tree.is_one_dof();
    let equations = written(&rounded(forms), is_flat);
    if equations.iter().map(|equation| equation.mathml.len()).sum::<usize>() > LONGEST {
        return Ok(section.text(&too_large(subject)));
    }
    let fields = match subject.robot.spec.known.is_empty() {
        true => "",
        false => " Fields are letters, whatever their values are.",
    };
    let remark = format!(
        "Numbers are rounded to {DIGITS} digits; the code that is generated has all of them.{fields}"
    );
    Ok(equations.into_iter().fold(section, Section::equation).remark(&remark))
}

/// The closed forms, with letters for fields that have values; nothing where they swell.
fn forms(subject: &Subject<'_, '_>) -> Result<Option<ClosedForms>, Failure> {
    let robot = subject.robot;
    if robot.spec.known.is_empty() {
        return Ok(closed_forms(&robot.model, subject.graph).ok());
    }
    let graph = Graph::new();
    Ok(closed_forms(&with_letters(robot, &graph, subject.input)?, &graph).ok())
}

/// What the symbols of a robot are called, fields with values among them; and these fields.
pub(super) fn notation(robot: &Robot<'_>, input: &Input) -> Result<(Notation, Vec<Parameter>), Failure> {
    let graph = Graph::new();
    let model = with_letters(robot, &graph, input)?;
    Ok((closed::notation(&model), model.parameters))
}

/// The robot whose fields have no values.
fn with_letters<'g>(robot: &Robot<'_>, graph: &'g Graph, input: &Input) -> Result<Model<'g>, Failure> {
    let spec = RobotSpec { known: vec![], ..robot.spec.clone() };
    let mut diags = Diagnostics::new();
    let model = model::build(&spec, graph, &mut diags);
    diags.check().map_err(|found| Failure::mistakes(found, input))?;
    model.ok_or_else(|| Problem::new("the robot's equations have no letters").into())
}

/// The equation of which these are the parts. Its words have no article that could be taken for a letter.
fn told(subject: &Subject<'_, '_>) -> String {
    let tree = &subject.robot.tree;
    let passive = passive(subject.robot);
    let (term, forces) = match &passive[..] {
        [] => ("", String::new()),
        names => (" + P(q,v)", format!(", and P are the forces of {}", listed(names))),
    };
    let rates = match tree.quaternions().next() {
        Some(_) => "v = q̇, but for ball and free joints, whose v is the twist of the body in its own axes,",
        None => "v = q̇",
    };
    let springs = match passive.contains(&"springs") {
        true => " Energy of springs in joints is counted apart, and is no part of V.",
        false => "",
    };
    format!(
        "The joints move by M(q)·a + C(q,v)·v + G(q){term} = τ, where {rates} and a = v̇{forces}.{springs}"
    )
}

/// What acts in the robot by itself, beside its potentials.
pub(super) fn passive(robot: &Robot<'_>) -> Vec<&'static str> {
    let has = |of: fn(&Passive<f64>) -> f64| {
        robot
            .tree
            .links
            .iter()
            .zip(&robot.model.links)
            .any(|(link, info)| info.acts && of(&link.passive) != 0.0)
    };
    let kinds = [
        (has(|passive| passive.damping), "dampers"),
        (has(|passive| passive.friction), "friction"),
        (has(|passive| passive.stiffness), "springs"),
        (!robot.tree.terms.dissipation.is_empty(), "terms of dissipation"),
    ];
    kinds.into_iter().filter(|(acts, _)| *acts).map(|(_, name)| name).collect()
}

/// `dampers, friction and springs`
pub(super) fn listed(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [name] => (*name).to_owned(),
        [names @ .., last] => format!("{} and {last}", names.join(", ")),
    }
}

/// With numbers that people can read.
fn rounded(forms: ClosedForms) -> ClosedForms {
    let of = |matrix: &Matrix| matrix.map(short);
    ClosedForms {
        definitions: forms.definitions.iter().map(|(symbol, form)| (*symbol, short(form))).collect(),
        mass_matrix: of(&forms.mass_matrix),
        coriolis_matrix: of(&forms.coriolis_matrix),
        gravity_forces: of(&forms.gravity_forces),
        passive_forces: forms.passive_forces.as_ref().map(of),
        kinetic_energy: short(&forms.kinetic_energy),
        potential_energy: short(&forms.potential_energy),
        lagrangian: short(&forms.lagrangian),
        notation: forms.notation,
    }
}

fn too_large(subject: &Subject<'_, '_>) -> String {
    format!(
        "In closed form the equations of these {} degrees of freedom have more terms than anybody could read. They are \
         written out where no entry has more than {} terms, and for robots of up to {MOST_DOF_WITH_NAMES} with up to {} names \
         for their parts, as long as all of it takes less than {} kB. What M is made of is drawn below, `dynamics explain` \
         derives the equations body by body, and `dynamics generate` writes all of it as code.",
        subject.robot.dof(),
        Limits::READABLE.terms,
        Limits::READABLE.names,
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
            let of_speed =
                if is_plain || of_speed.is_empty() { String::new() } else { format!("`{of_speed}`") };
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
    let head =
        if has_twists { head } else { ["coordinate", "symbol", "its rate"].map(str::to_owned).to_vec() };
    Table::new("Symbols", "llll").head(head).rows(rows.into_values().map(drop))
}

/// All of them, the shortest definitions first.
fn written(forms: &ClosedForms, is_flat: bool) -> Vec<Equation> {
    let ClosedForms { notation, definitions, .. } = forms;
    let potential = match is_flat {
        true => "Potential forces, G = ∂V/∂q",
        false => {
            "Potential forces: G_i is how fast V grows while the speed v_i is one and every other is zero"
        }
    };
    let mut equations = vec![];
    if !definitions.is_empty() {
        equations.push(of_definitions(definitions, notation));
    }
    equations.extend([
        of_matrix("Mass matrix", "M(q)", &forms.mass_matrix, notation),
        of_matrix("Coriolis matrix, with Ṁ = C + Cᵀ", "C(q,v)", &forms.coriolis_matrix, notation),
        of_matrix(potential, "G(q)", &forms.gravity_forces, notation),
    ]);
    let passive = forms.passive_forces.iter();
    equations.extend(passive.map(|forces| of_matrix("Passive forces", "P(q,v)", forces, notation)));
    equations.extend([
        of_form("Kinetic energy", "T", &forms.kinetic_energy, notation),
        of_form("Potential energy", "V", &forms.potential_energy, notation),
        of_form("Lagrangian, L = T − V", "L", &forms.lagrangian, notation),
    ]);
    equations
}

fn math(rows: &str) -> String {
    format!(r#"<math display="block">{rows}</math>"#)
}

/// The left-hand side: a letter, perhaps of arguments, whose brackets do not grow with what is on the right.
fn left(name: &str) -> String {
    let (letter, arguments) = name.split_once('(').unwrap_or((name, ""));
    let mut text = format!("<mi>{letter}</mi>");
    if let Some(arguments) = arguments.strip_suffix(')') {
        let names: Vec<String> = arguments.split(',').map(|name| format!("<mi>{name}</mi>")).collect();
        let names = names.join("<mo>,</mo>");
        text += &format!(r#"<mo stretchy="false">(</mo>{names}<mo stretchy="false">)</mo>"#);
    }
    text + "<mo>=</mo>"
}

/// The title and the left-hand side with letters that the robot leaves, and this in LaTeX.
fn lettered(title: &str, name: &str, notation: &Notation) -> [String; 3] {
    let letters = Letters::of(notation);
    [letters.unicode(title), letters.unicode(name), letters.latex(name)]
}

/// In brackets, or where that is wider than a page, an equation for each entry that is not zero.
fn of_matrix(title: &str, name: &str, matrix: &Matrix, notation: &Notation) -> Equation {
    let width = matrix.unicode(notation).iter().map(|line| line.chars().count()).max().unwrap_or(0);
    if width > WIDEST {
        return of_entries(title, name, matrix, notation);
    }
    let [title, name, latex] = lettered(title, name, notation);
    Equation {
        title,
        mathml: math(&format!("<mrow>{}{}</mrow>", left(&name), matrix.mathml(notation))),
        latex: format!("{latex} = {}", matrix.latex(notation)),
    }
}

fn of_entries(title: &str, name: &str, matrix: &Matrix, notation: &Notation) -> Equation {
    let [title, letter, latex] = lettered(title, name.split('(').next().unwrap_or(name), notation);
    let lines = matrix.entries().filter(|(.., form)| !form.is_zero()).map(|(row, column, form)| {
        let place = |i: usize, j: usize| match matrix.columns() {
            1 => (i + 1).to_string(),
            _ => format!("{}{}{}", i + 1, if i.max(j) > 8 { "," } else { "" }, j + 1),
        };
        let mut names = vec![place(row, column)];
        if matrix.is_symmetric() && row != column {
            names.push(place(column, row));
        }
        let drawn = names.iter().map(|at| format!("<msub><mi>{letter}</mi><mn>{at}</mn></msub>"));
        let set = names.iter().map(|at| format!("{latex}_{{{at}}}"));
        Line {
            name: drawn.collect::<Vec<_>>().join("<mo>=</mo>"),
            mathml: form.mathml(notation),
            latex: format!("{} &= {}", set.collect::<Vec<_>>().join(" = "), form.latex(notation)),
        }
    });
    let lines: Vec<Line> = lines.collect();
    let all = matrix.rows() * matrix.columns();
    let given = lines.len() < matrix.entries().count();
    let title = if given && all > 1 { format!("{title}; the other entries are zero") } else { title };
    of_lines(title, &lines)
}

/// An equation among several.
struct Line {
    /// The left-hand side, MathML.
    name: String,
    /// The right-hand side.
    mathml: String,
    /// Both, with `&` before the sign.
    latex: String,
}

/// Equations one below the other.
fn of_lines(title: String, lines: &[Line]) -> Equation {
    let row = |Line { name, mathml, .. }: &Line| {
        format!("<mtr><mtd><mrow>{name}</mrow></mtd><mtd><mrow><mo>=</mo>{mathml}</mrow></mtd></mtr>")
    };
    let rows: String = lines.iter().map(row).collect();
    let latex: Vec<&str> = lines.iter().map(|line| &*line.latex).collect();
    Equation {
        title,
        mathml: format!(r#"<math display="block" class="lines"><mtable>{rows}</mtable></math>"#),
        latex: format!("\\begin{{aligned}}\n{}\n\\end{{aligned}}", latex.join(" \\\\\n")),
    }
}

fn of_form(title: &str, name: &str, form: &Form, notation: &Notation) -> Equation {
    let [title, name, latex] = lettered(title, name, notation);
    Equation {
        title,
        mathml: math(&format!("<mrow>{}{}</mrow>", left(&name), form.mathml(notation))),
        latex: format!("{latex} = {}", form.latex(notation)),
    }
}

/// Names for parts of the others.
fn of_definitions(definitions: &[(SymbolId, Form)], notation: &Notation) -> Equation {
    let line = |(symbol, form): &(SymbolId, Form)| {
        let name = &notation.letter(*symbol).name;
        Line {
            name: name.mathml(),
            mathml: form.mathml(notation),
            latex: format!("{} &= {}", name.latex(), form.latex(notation)),
        }
    };
    of_lines("Names for parts of what follows".to_owned(), &definitions.iter().map(line).collect::<Vec<_>>())
}
