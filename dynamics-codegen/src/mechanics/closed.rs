//! The equations of a robot as people write them: `M`, `C`, `G`, `P`, `T`, `V` and `L` in closed form.
//!
//! They are made from the frames and masses as they were given, not from those that the programs run on, so that the
//! robot's own parameters stand in them.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::equations::{Argument, Derivation, Inputs, Method};
pub use super::notation::notation;
use super::plain;
use crate::closed::{Canonical, Closed, Form, Limits, Matrix, Notation, Polynomial, Swelling, close};
use crate::model::Model;
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
    /// `P(q,v)` of `τ = M·a + C·v + G + P`, a column: dampers, friction, springs and terms of dissipation; none where
    /// nothing acts by itself.
    pub passive_forces: Option<Matrix>,
    /// `T(q,v)`
    pub kinetic_energy: Form,
    /// `V(q)`
    pub potential_energy: Form,
    /// `L = T − V`
    pub lagrangian: Form,
}

/// The largest robot whose equations have names for their parts, where they are too long without.
pub const MOST_DOF_WITH_NAMES: usize = 8;

/// The equations of `model` in closed form.
///
/// Of small robots they are multiplied out: `T` and `V` by the plain recursion, the rest from them by Lagrange's equations,
/// all in the normal form of [`Canonical`]. Where a term would have more than [`Limits::READABLE`] allows, they are those
/// that the programs are made of, with names for what they share, up to [`MOST_DOF_WITH_NAMES`]. The work is counted, and
/// so ends.
///
/// # Errors
///
/// If the equations have more terms, or more names, than the limits allow.
pub fn closed_forms<'g>(model: &Model<'g>, graph: &'g Graph) -> Result<ClosedForms, Swelling> {
    multiplied_out(model, graph).or_else(|Swelling| match Inputs::of(model).dof > MOST_DOF_WITH_NAMES {
        true => Err(Swelling),
        false => with_names(model, graph),
    })
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
        Method::PassiveForces,
    ] {
        exprs.extend(blocks(method));
    }
    let Closed { definitions, forms } = close(graph, &mut notation, &exprs, Limits::READABLE)?;
    Ok(assembled(notation, definitions, forms, n))
}

fn multiplied_out<'g>(model: &Model<'g>, graph: &'g Graph) -> Result<ClosedForms, Swelling> {
    let inputs = Inputs::of(model);
    if model.parameters.len() + inputs.size(Argument::Q) + inputs.dof >= Canonical::MOST_SYMBOLS {
        return Err(Swelling);
    }
    let notation = notation(model);
    let [q, v] = [Argument::Q, Argument::V].map(|argument| inputs.vector(graph, argument));
    let T = plain::kinetic_energy(&model.tree, &q, &v);
    let V = plain::potential_energy(&model.tree, &q);
    let P = plain::passive::forces(&model.tree, &q, &v);
    let mut lagrange = Lagrange::new(model, graph, &notation, [T, V], P)?;
    let n = inputs.dof;
    let M = lagrange.mass_matrix()?;
    let mut all: Vec<Polynomial> = (0..n).flat_map(|i| M[i][i..].iter().cloned()).collect();
    all.extend(lagrange.coriolis_matrix(&M)?.concat());
    all.extend(lagrange.gravity_forces()?);
    all.push(lagrange.T.clone());
    all.push(lagrange.V.clone());
    all.push(lagrange.T.plus(-Number::ONE, &lagrange.V));
    all.extend(lagrange.P.iter().cloned());
    let forms = lagrange.canonical.forms(&notation, &all, Limits::READABLE.terms)?;
    Ok(assembled(notation, vec![], forms, n))
}

/// The forms of M, of which there is the upper half, C, G, T, V, L and P, in this order.
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
    let [kinetic_energy, potential_energy, lagrangian] =
        std::array::from_fn(|_| row(1).pop().unwrap_or(Form::ZERO));
    let passive = row(n);
    let passive_forces = passive.iter().any(|force| !force.is_zero()).then(|| Matrix::vector(passive));
    ClosedForms {
        notation,
        definitions,
        mass_matrix,
        coriolis_matrix,
        gravity_forces,
        passive_forces,
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
    P: Vec<Polynomial>,
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
        P: Vec<Expr<'g>>,
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
        exprs.extend(q.iter().chain(&v).chain(&P));
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
        let P = P.into_iter().map(|expr| canonical.polynomial(expr)).collect::<Result<_, _>>()?;
        let (q, v) = (symbols(Argument::Q), symbols(Argument::V));
        Ok(Self { canonical, T, V, P, q, v, directions, brackets, brackets_with_v })
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
