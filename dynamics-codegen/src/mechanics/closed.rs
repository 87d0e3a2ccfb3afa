//! The equations of a robot as people write them: `M`, `C`, `G`, `T`, `V` and `L` in closed form.
//!
//! They are made from the frames and masses as they were given, not from those that the programs run on, so that the
//! robot's own parameters stand in them.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::equations::{Argument, Derivation, Inputs, Method};
use super::plain;
use crate::closed::{
    Canonical, Closed, Form, Limits, Matrix, Name, Notation, Polynomial, Role, Swelling, close,
};
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

/// The largest robot whose equations are written at all.
const LARGEST: usize = 8;

/// The equations of `model` in closed form.
///
/// Of small robots they are multiplied out: `T` and `V` by the plain recursion, the rest from them by Lagrange's equations,
/// all in the normal form of [`Canonical`]. Where a term would have more than [`Limits::READABLE`] allows, they are those
/// that the programs are made of, with names for what they share.
///
/// # Errors
///
/// If the robot has more than eight degrees of freedom, or its equations more names than the limits allow.
pub fn closed_forms<'g>(model: &Model<'g>, graph: &'g Graph) -> Result<ClosedForms, Swelling> {
    match multiplied_out(model, graph) {
        _ if Inputs::of(model).dof > LARGEST => Err(Swelling),
        Err(Swelling) => with_names(model, graph),
        forms => forms,
    }
}

fn with_names<'g>(model: &Model<'g>, graph: &'g Graph) -> Result<ClosedForms, Swelling> {
    let mut notation = notation(model);
    let derivation = Derivation::of(model, graph);
    let n = derivation.inputs.dof;
    let blocks = |method| derivation.blocks(method).into_iter().flat_map(|block| block.entries);
    let mut exprs: Vec<Expr<'g>> = Vec::new();
    let M: Vec<_> = blocks(Method::MassMatrix).collect();
    exprs.extend((0..n).flat_map(|row| M[row * n + row..(row + 1) * n].iter().copied()));
    for method in [
        Method::CoriolisMatrix,
        Method::GravityForces,
        Method::KineticEnergy,
        Method::PotentialEnergy,
        Method::Lagrangian,
    ] {
        exprs.extend(blocks(method));
    }
    let Closed { definitions, forms } = close(graph, &mut notation, &exprs, Limits::READABLE)?;
    Ok(assembled(notation, definitions, forms, n))
}

fn multiplied_out<'g>(model: &Model<'g>, graph: &'g Graph) -> Result<ClosedForms, Swelling> {
    let inputs = Inputs::of(model);
    if inputs.dof > LARGEST {
        return Err(Swelling);
    }
    let notation = notation(model);
    let [q, v] = [Argument::Q, Argument::V].map(|argument| inputs.vector(graph, argument));
    let T = plain::kinetic_energy(&model.tree, &q, &v);
    let V = plain::potential_energy(&model.tree, &q);
    let mut lagrange = Lagrange::new(model, graph, &notation, [T, V])?;
    let n = inputs.dof;
    let M = lagrange.mass_matrix()?;
    let mut all: Vec<Polynomial> = (0..n).flat_map(|i| M[i][i..].iter().cloned()).collect();
    all.extend(lagrange.coriolis_matrix(&M)?.concat());
    all.extend(lagrange.gravity_forces()?);
    all.push(lagrange.T.clone());
    all.push(lagrange.V.clone());
    all.push(lagrange.T.plus(-Number::ONE, &lagrange.V));
    let forms = lagrange.canonical.forms(&notation, &all, Limits::READABLE.terms)?;
    Ok(assembled(notation, vec![], forms, n))
}

/// The forms of M, of which there is the upper half, C, G, T, V and L, in this order.
fn assembled(
    notation: Notation,
    definitions: Vec<(SymbolId, Form)>,
    forms: Vec<Form>,
    n: usize,
) -> ClosedForms {
    let mut forms = forms.into_iter();
    let mut row = |length: usize| forms.by_ref().take(length).collect::<Vec<_>>();
    let mass_matrix = Matrix::symmetric((0..n).map(|k| row(n - k)).collect());
    let coriolis_matrix = Matrix::of_rows((0..n).map(|_| row(n)).collect());
    let gravity_forces = Matrix::vector(row(n));
    let mut next = || row(1).pop().unwrap_or(Form::ZERO);
    let (kinetic_energy, potential_energy, lagrangian) = (next(), next(), next());
    ClosedForms {
        notation,
        definitions,
        mass_matrix,
        coriolis_matrix,
        gravity_forces,
        kinetic_energy,
        potential_energy,
        lagrangian,
    }
}

/// Lagrange's equations in the normal form, as `lagrange.rs` has them for expressions.
struct Lagrange<'g> {
    canonical: Canonical<'g>,
    T: Polynomial,
    V: Polynomial,
    /// The symbols of coordinates and speeds.
    q: Vec<SymbolId>,
    v: Vec<SymbolId>,
    /// The rates of the coordinates at each unit speed.
    directions: Vec<Vec<Polynomial>>,
    /// `[e_i, e_j]` of unit speeds, and `[v, e_j]`.
    brackets: Vec<Vec<Vec<Polynomial>>>,
    brackets_with_v: Vec<Vec<Polynomial>>,
}

impl<'g> Lagrange<'g> {
    fn new(
        model: &Model<'g>,
        graph: &'g Graph,
        notation: &Notation,
        [T, V]: [Expr<'g>; 2],
    ) -> Result<Self, Swelling> {
        let inputs = Inputs::of(model);
        let symbols = |argument| (0..inputs.size(argument)).map(|k| inputs.symbol(argument, k)).collect();
        let [q, v] = [Argument::Q, Argument::V].map(|argument| inputs.vector(graph, argument));
        let unit = |k: usize| -> Vec<Expr<'g>> {
            (0..inputs.dof).map(|i| if i == k { Expr::ONE } else { Expr::ZERO }).collect()
        };
        let units: Vec<_> = (0..inputs.dof).map(unit).collect();
        // The coordinates are among the expressions, so that they are variables in their order.
        let mut exprs = vec![T, V];
        exprs.extend(q.iter().chain(&v));
        let mut canonical = Canonical::new(graph, notation, &exprs, Limits::READABLE.work)?;
        let mut all = |exprs: Vec<Expr<'g>>| -> Result<Vec<Polynomial>, Swelling> {
            exprs.into_iter().map(|expr| canonical.polynomial(expr)).collect()
        };
        let tree = &model.tree;
        let directions = units.iter().map(|unit| all(tree.configuration_rate(&q, unit)));
        let directions = directions.collect::<Result<_, _>>()?;
        let (mut brackets, mut brackets_with_v) = (vec![], vec![]);
        if !tree.is_one_dof() {
            for i in &units {
                let row = units.iter().map(|j| all(plain::bracket(tree, i, j)));
                brackets.push(row.collect::<Result<Vec<_>, _>>()?);
                brackets_with_v.push(all(plain::bracket(tree, &v, i))?);
            }
        }
        let (T, V) = (canonical.polynomial(T)?, canonical.polynomial(V)?);
        let (q, v) = (symbols(Argument::Q), symbols(Argument::V));
        Ok(Self { canonical, T, V, q, v, directions, brackets, brackets_with_v })
    }

    /// The derivatives along the directions of unit speeds.
    fn along(&mut self, a: &Polynomial) -> Result<Vec<Polynomial>, Swelling> {
        let by_q: Vec<_> =
            self.q.iter().map(|&symbol| self.canonical.derivative(a, symbol)).collect::<Result<_, _>>()?;
        self.directions.iter().map(|direction| self.canonical.dot(&by_q, direction)).collect()
    }

    /// `∂T/∂v`
    fn momentum(&mut self) -> Result<Vec<Polynomial>, Swelling> {
        self.v.iter().map(|&symbol| self.canonical.derivative(&self.T, symbol)).collect()
    }

    fn mass_matrix(&mut self) -> Result<Vec<Vec<Polynomial>>, Swelling> {
        let momentum = self.momentum()?;
        let row =
            |p: &Polynomial| self.v.iter().map(|&symbol| self.canonical.derivative(p, symbol)).collect();
        momentum.iter().map(row).collect()
    }

    fn gravity_forces(&mut self) -> Result<Vec<Polynomial>, Swelling> {
        self.along(&self.V.clone())
    }

    /// By Koszul's formula; between joints of one degree of freedom it is Christoffel's.
    fn coriolis_matrix(&mut self, M: &[Vec<Polynomial>]) -> Result<Vec<Vec<Polynomial>>, Swelling> {
        let n = self.v.len();
        let v: Vec<Polynomial> = self.speeds()?;
        // The rates of the upper half: dM[i][j][k] = E_k(M_ij).
        let mut dM = vec![vec![vec![]; n]; n];
        for i in 0..n {
            for j in i..n {
                dM[i][j] = self.along(&M[i][j])?;
                dM[j][i] = dM[i][j].clone();
            }
        }
        let momentum = self.momentum()?;
        let (half, minus) = (Number::ratio(1, 2), -Number::ONE);
        let mut C = vec![vec![Polynomial::zero(); n]; n];
        for i in 0..n {
            for j in 0..n {
                let mut twice = Polynomial::zero();
                for k in 0..n {
                    let symbol = dM[i][j][k].plus(Number::ONE, &dM[i][k][j]).plus(minus, &dM[j][k][i]);
                    if !symbol.is_zero() {
                        twice = twice.plus(Number::ONE, &self.canonical.product(&symbol, &v[k])?);
                    }
                }
                if !self.brackets.is_empty() {
                    let canonical = &mut self.canonical;
                    twice = twice
                        .plus(Number::ONE, &canonical.dot(&M[i], &self.brackets_with_v[j])?)
                        .plus(minus, &canonical.dot(&M[j], &self.brackets_with_v[i])?)
                        .plus(minus, &canonical.dot(&momentum, &self.brackets[j][i])?);
                }
                C[i][j] = twice.scaled(half);
            }
        }
        Ok(C)
    }

    fn speeds(&mut self) -> Result<Vec<Polynomial>, Swelling> {
        let momentum = self.v.clone();
        momentum.into_iter().map(|symbol| self.canonical.symbol(symbol)).collect()
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
        let symbol = notation.add(parameter_name(parameter), Role::Parameter);
        let rank = |unit: &[i64; 3]| Some(unit.map(Number::integer)) == parameter.exponents;
        notation.set_rank(symbol, RANKS.iter().position(rank).map_or(u8::MAX, |rank| rank as u8));
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

/// Quantities that stand before others, by their exponents of kg, m and s: moments of inertia, masses, gravity.
const RANKS: [[i64; 3]; 3] = [[1, 2, 0], [1, 0, 0], [0, 1, -2]];

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
        let mut several = generic.filter(|joint| joint.v.len() != 1);
        let (first, second) = (several.next(), several.next());
        // Two of one kind have parts of one name.
        let is_ambiguous = first.is_some() && second.is_some() && {
            let ball = |joint: &&JointInfo| joint.q.len() != joint.v.len();
            let kinds = [true, false].map(|is_ball| {
                model.joints.iter().filter(|joint| joint.v.len() != 1 && ball(joint) == is_ball).count()
            });
            kinds.iter().any(|count| *count > 1)
        };
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
            let index = if is_ambiguous { others.to_string() } else { String::new() };
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
