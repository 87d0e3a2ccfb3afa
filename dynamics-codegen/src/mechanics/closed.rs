//! The equations of a robot as people write them: `M`, `C`, `G`, `T`, `V` and `L` in closed form.
//!
//! They are made from the frames and masses as they were given, not from those that the programs run on, so that the
//! robot's own parameters stand in them.

use super::equations::{Argument, Inputs};
use super::plain;
use crate::closed::{Form, Matrix, Name, Notation, Role, close};
use crate::model::{JointInfo, Model, Parameter};
use crate::symbolic::{Expr, Graph, Number, SymbolId};

/// A robot's equations in closed form, SI units.
#[derive(Clone, Debug)]
pub struct ClosedForms {
    /// What the symbols are called: those of [`Inputs`], and then the intermediates.
    pub notation: Notation,
    /// Names for parts of what follows, each in those before it; none of small robots.
    pub definitions: Vec<(SymbolId, Form)>,
    /// `M(q)`, symmetric.
    pub mass_matrix: Matrix,
    /// `C(q,v)`, with `Ṁ = C + Cᵀ`.
    pub coriolis_matrix: Matrix,
    /// `G(q) = ∂V/∂q`, a column.
    pub gravity_forces: Matrix,
    /// `T(q,v)`
    pub kinetic_energy: Form,
    /// `V(q)`
    pub potential_energy: Form,
    /// `L = T − V`
    pub lagrangian: Form,
}

/// The equations of `model` in closed form.
pub fn closed_forms<'g>(model: &Model<'g>, graph: &'g Graph) -> ClosedForms {
    let inputs = Inputs::of(model);
    let mut notation = notation(model);
    let [q, v] = [Argument::Q, Argument::V].map(|argument| inputs.vector(graph, argument));
    let tree = &model.tree;
    let upper = |rows: Vec<Vec<Expr<'g>>>| {
        rows.into_iter().enumerate().flat_map(|(k, row)| row.into_iter().skip(k)).collect::<Vec<_>>()
    };
    let mut entries = upper(plain::mass_matrix(tree, &q));
    entries.extend(plain::coriolis_matrix(tree, &q, &v).concat());
    entries.extend(plain::gravity_forces(tree, &q));
    entries.push(plain::kinetic_energy(tree, &q, &v));
    entries.push(plain::potential_energy(tree, &q));
    entries.push(plain::lagrangian(tree, &q, &v));
    let closed = close(graph, &mut notation, &entries);
    let mut forms = closed.forms.into_iter();
    let n = inputs.dof;
    let mut row = |length: usize| forms.by_ref().take(length).collect::<Vec<_>>();
    let mass_matrix = Matrix::symmetric((0..n).map(|k| row(n - k)).collect());
    let coriolis_matrix = Matrix::of_rows((0..n).map(|_| row(n)).collect());
    let gravity_forces = Matrix::vector(row(n));
    let mut next = || row(1).pop().unwrap_or(Form::ZERO);
    let (kinetic_energy, potential_energy, lagrangian) = (next(), next(), next());
    ClosedForms {
        notation,
        definitions: closed.definitions,
        mass_matrix,
        coriolis_matrix,
        gravity_forces,
        kinetic_energy,
        potential_energy,
        lagrangian,
    }
}

/// What the symbols of a robot's equations are called, in the order of [`Inputs`].
///
/// Fields have their own names. So have joints that are called by a letter, as `x` or `theta1`; the coordinates of others
/// are θ where they turn, x, y or z where they slide along an axis of the world, and d elsewhere, with an index where there
/// are several. Speeds and accelerations have dots; those of ball and free joints are v and ω.
pub fn notation(model: &Model<'_>) -> Notation {
    let mut notation = Notation::new();
    for parameter in &model.parameters {
        notation.add(parameter_name(parameter), Role::Parameter);
    }
    let names = JointNames::of(model);
    for name in &names.coordinates {
        notation.add(name.clone(), Role::Coordinate);
    }
    for name in &names.speeds {
        notation.add(name.clone(), Role::Speed);
    }
    for name in &names.speeds {
        notation.add(name.dotted(), Role::Acceleration);
    }
    for k in 0..names.speeds.len() {
        notation.add(Name::indexed("tau", &(k + 1).to_string()), Role::Force);
    }
    let inputs = Inputs::of(model);
    for at in model.tree.quaternions() {
        notation.add_quaternion([0, 1, 2, 3].map(|k| inputs.symbol(Argument::Q, at + k)));
    }
    notation
}

/// The letters that quantities begin with, by their exponents of kg, m and s, and what may follow as an index.
const LETTERS: &[([i64; 3], &[(&str, &str)])] = &[
    ([1, 0, 0], &[("m", "m"), ("M", "M")]),
    ([0, 1, 0], &[("l", "l"), ("r", "r"), ("d", "d"), ("h", "h"), ("a", "a"), ("L", "L")]),
    ([1, 2, 0], &[("i", "I"), ("I", "I"), ("j", "J"), ("J", "J")]),
    ([0, 1, -2], &[("g", "g")]),
];

/// The name of a field: of a mass `mc` is m with the index c, of an inertia `ix1` is I with the index x₁.
fn parameter_name(parameter: &Parameter) -> Name {
    let text = parameter.name.as_str();
    let plain = Name::read(text);
    let Some(exponents) = parameter.exponents else { return plain };
    let unit = |unit: &[i64; 3]| unit.map(Number::integer) == exponents;
    let letters = LETTERS.iter().find(|(known, _)| unit(known)).map_or(&[][..], |(_, letters)| letters);
    for (letter, written) in letters {
        let Some(index) = text.strip_prefix(letter) else { continue };
        let index = index.strip_prefix('_').unwrap_or(index);
        let axis = index.trim_end_matches(|c: char| c.is_ascii_digit());
        let is_axes = axis.len() == 2 && axis.chars().all(|c| matches!(c, 'x'..='z'));
        let is_letter = axis.len() < 2 && axis.chars().all(|c| c.is_ascii_alphabetic());
        if is_letter || is_axes {
            return Name::indexed(written, index);
        }
    }
    plain
}

/// The names of coordinates and speeds.
struct JointNames {
    coordinates: Vec<Name>,
    speeds: Vec<Name>,
}

impl JointNames {
    fn of(model: &Model<'_>) -> Self {
        let mut names = Self { coordinates: vec![], speeds: vec![] };
        let generic = model.joints.iter().filter(|joint| own_name(joint).is_none());
        let indexed = generic.clone().filter(|joint| slide_letter(model, joint).is_none()).count();
        let bodies = generic.filter(|joint| joint.v.len() != 1).count();
        let (mut lines, mut others) = (0, 0);
        for joint in &model.joints {
            if joint.q.len() == 1 {
                let name = own_name(joint).unwrap_or_else(|| match slide_letter(model, joint) {
                    Some(letter) => Name::read(letter),
                    None => {
                        lines += 1;
                        let index = if indexed > 1 { lines.to_string() } else { String::new() };
                        Name::indexed(if slides(model, joint) { "d" } else { "theta" }, &index)
                    }
                });
                names.speeds.push(name.dotted());
                names.coordinates.push(name);
                continue;
            }
            others += 1;
            let index = if bodies > 1 { others.to_string() } else { String::new() };
            names.coordinates.extend(parts(&joint.coordinate_names(), joint, &index));
            match joint.v.len() == joint.q.len() {
                true => {
                    let own = names.coordinates[joint.q.clone()].iter().map(Name::dotted);
                    names.speeds.extend(own.collect::<Vec<_>>());
                }
                false => names.speeds.extend(parts(&joint.speed_names(), joint, &index)),
            }
        }
        names
    }
}

/// The name of a joint that is called by a letter.
fn own_name(joint: &JointInfo) -> Option<Name> {
    let name = Name::read(&joint.name);
    (joint.q.len() == 1 && name.is_letter()).then_some(name)
}

fn slides(model: &Model<'_>, joint: &JointInfo) -> bool {
    let link = model.tree.links.iter().find(|link| link.drive.v == joint.v.start);
    link.is_some_and(|link| link.motion == crate::model::Motion::Prismatic)
}

/// The axis of the world that a joint slides along, unless a field has that name.
fn slide_letter(model: &Model<'_>, joint: &JointInfo) -> Option<&'static str> {
    let link = model.tree.links.iter().find(|link| link.drive.v == joint.v.start)?;
    if joint.v.len() != 1 || link.motion != crate::model::Motion::Prismatic || link.parent.is_some() {
        return None;
    }
    let axis = link.placement.rotation.0.map(|row| row[2]);
    let along = axis.iter().position(|&component| component == Expr::ONE)?;
    let letter = ["x", "y", "z"][along];
    let is_taken = model.parameters.iter().any(|parameter| parameter.name == letter)
        || model.joints.iter().any(|joint| joint.name == letter);
    (!is_taken).then_some(letter)
}

/// The names of a joint's several coordinates or speeds: the last parts of what they are called, as `x`, `qw`, `wz`.
fn parts(names: &[String], joint: &JointInfo, index: &str) -> Vec<Name> {
    let part = |name: &String| {
        let part = name.strip_prefix(&joint.name).unwrap_or(name).trim_start_matches('.').to_owned();
        let (letter, axis) = part.split_at(part.chars().next().map_or(0, char::len_utf8));
        let letter = if letter == "w" && !axis.is_empty() { "omega" } else { letter };
        Name::indexed(letter, &format!("{axis}{index}"))
    };
    names.iter().map(part).collect()
}
