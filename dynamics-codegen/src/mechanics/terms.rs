//! Terms of one's own in the energies: what they add to the equations, by differentiating them.
//!
//! The recursions know masses; what else is in `T` and `V`, and in Rayleigh's `D`, is added to what they give, in the
//! robot's own speeds. Of a kinetic term that is `M = ∂²T/∂v²`, the Coriolis matrix of Levi-Civita by J.-L. Koszul's formula,
//! and Lagrange's equations in the form of G. Hamel, whose brackets vanish between joints of one degree of freedom.
//! Distances are taken in the frame of the last link that carries both bodies, so that they depend on nothing else.
//!
//! G. Hamel, *Die Lagrange-Eulerschen Gleichungen der Mechanik*, 1904.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::along::{Along, By, dot, unit};
use super::composite::Square;
use super::method::{Argument, Inputs};
use super::normal::{NormalTree, PlacedJoint};
use super::plain::{Cholesky, Flaw, Oracle, bracket, flaw, flaw_of_dissipation};
use crate::model::{Model, Term, Terms, Tree};
use crate::spatial::{Pose, Random, Vector3};
use crate::spec::Function;
use crate::symbolic::{Evaluator, Expr, Graph, Number, SymbolId};

/// What terms add to the equations of a robot.
#[derive(Clone)]
pub struct Added<'g> {
    /// Each term by itself.
    pub terms: Vec<(String, Energy<'g>)>,
    /// To `T`.
    pub kinetic: Expr<'g>,
    /// To `V`.
    pub potential: Expr<'g>,
    /// To `M`.
    pub mass: Square<Expr<'g>>,
    /// To `C`.
    pub coriolis: Square<Expr<'g>>,
    /// To `G`.
    pub gravity: Vec<Expr<'g>>,
    /// To the passive forces.
    pub passive: Vec<Expr<'g>>,
    /// To `C·v`.
    centripetal: Vec<Expr<'g>>,
    /// The derivatives of M along each direction, and those of the bias along these and by the speeds.
    dM: Vec<Square<Expr<'g>>>,
    dh_dq: Square<Expr<'g>>,
    dh_dv: Square<Expr<'g>>,
    chart: Chart<'g>,
}

/// A term as an expression.
#[derive(Clone, Copy)]
pub enum Energy<'g> {
    /// Of `V`.
    Potential(Expr<'g>),
    /// Of `D`.
    Dissipation(Expr<'g>),
    /// Of `T`.
    Kinetic(Expr<'g>),
}

/// The coordinates and speeds by which terms are differentiated.
#[derive(Clone)]
struct Chart<'g> {
    graph: &'g Graph,
    inputs: Inputs,
    tree: Tree<Expr<'g>>,
    q: Vec<Expr<'g>>,
    v: Vec<Expr<'g>>,
}

impl<'g> Chart<'g> {
    fn symbols(&self, argument: Argument) -> Vec<SymbolId> {
        (0..self.inputs.size(argument)).map(|k| self.inputs.symbol(argument, k)).collect()
    }

    fn along(&self) -> Along<'g> {
        Along::new(self.graph, &self.symbols(Argument::Q), &self.tree, &self.q)
    }

    fn by_v(&self) -> By<'g> {
        By::new(self.graph, &self.symbols(Argument::V))
    }

    /// `[e_i, v]` for each i.
    fn turned(&self) -> Square<Expr<'g>> {
        let n = self.v.len();
        (0..n).map(|i| bracket(&self.tree, &unit(i, n), &self.v)).collect()
    }
}

impl<'g> Added<'g> {
    /// What the terms of `tree` add, whose frames are where `kinematic` says; nothing if there are none.
    pub fn of(
        tree: &Tree<Expr<'g>>,
        kinematic: &NormalTree<Expr<'g>>,
        inputs: Inputs,
        graph: &'g Graph,
    ) -> Option<Self> {
        if tree.terms.is_empty() {
            return None;
        }
        let (q, v) = (inputs.vector(graph, Argument::Q), inputs.vector(graph, Argument::V));
        let chart = Chart { graph, inputs, tree: tree.clone(), q, v };
        let (mut along, mut by_v) = (chart.along(), chart.by_v());
        let places = OfNormal { tree: kinematic, joints: kinematic.place(&chart.q) };
        let terms = energies(&tree.terms, &chart.v, &mut along, &places);

        let sum = |part: fn(Energy<'g>) -> Option<Expr<'g>>| {
            terms.iter().filter_map(|(_, energy)| part(*energy)).fold(Expr::ZERO, |sum, term| sum + term)
        };
        let V = sum(|energy| if let Energy::Potential(V) = energy { Some(V) } else { None });
        let D = sum(|energy| if let Energy::Dissipation(D) = energy { Some(D) } else { None });
        let T = sum(|energy| if let Energy::Kinetic(T) = energy { Some(T) } else { None });

        let momentum = by_v.gradient(T);
        let M: Square<_> = momentum.iter().map(|&p| by_v.gradient(p)).collect();
        let dM: Vec<Square<_>> =
            M.iter().map(|row| row.iter().map(|&entry| along.gradient(entry)).collect()).collect();
        let centripetal = centripetal(&chart, T, &momentum, &mut along);
        let (gravity, passive) = (along.gradient(V), by_v.gradient(D));
        let bias: Vec<_> =
            centripetal.iter().zip(&gravity).zip(&passive).map(|((&c, &g), &d)| c + g + d).collect();
        Some(Self {
            kinetic: T,
            potential: V,
            coriolis: connection(&chart, &M, &dM, &momentum),
            mass: M,
            dh_dq: bias.iter().map(|&force| along.gradient(force)).collect(),
            dh_dv: bias.iter().map(|&force| by_v.gradient(force)).collect(),
            dM,
            gravity,
            passive,
            centripetal,
            terms,
            chart,
        })
    }

    /// Whether `M` is another one by them.
    pub fn has_kinetic(&self) -> bool {
        !self.kinetic.is_zero()
    }

    /// To the forces at the accelerations `a`: inertial, potential and passive ones.
    pub fn forces(&self, a: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let parts = self.mass.iter().zip(&self.centripetal).zip(self.gravity.iter().zip(&self.passive));
        parts.map(|((row, &c), (&g, &d))| dot(row, a) + c + g + d).collect()
    }

    /// To `∂τ/∂q`, in the tangent space, and `∂τ/∂v` at the accelerations `a`.
    pub fn derivatives(&self, a: &[Expr<'g>]) -> (Square<Expr<'g>>, Square<Expr<'g>>) {
        let row = |(dM, dh): (&Square<Expr<'g>>, &Vec<Expr<'g>>)| -> Vec<Expr<'g>> {
            let along = |k: usize| dM.iter().zip(a).fold(dh[k], |sum, (entry, &a)| sum + entry[k] * a);
            (0..dh.len()).map(along).collect()
        };
        (self.dM.iter().zip(&self.dh_dq).map(row).collect(), self.dh_dv.clone())
    }

    /// Of each term its name, and the forces that it alone adds at the accelerations `a`.
    pub fn forces_of_terms(&self, a: &[Expr<'g>]) -> Vec<(String, Vec<Expr<'g>>)> {
        let (mut along, mut by_v) = (self.chart.along(), self.chart.by_v());
        let mut forces = |energy: Energy<'g>| match energy {
            Energy::Potential(V) => along.gradient(V),
            Energy::Dissipation(D) => by_v.gradient(D),
            Energy::Kinetic(T) => {
                let momentum = by_v.gradient(T);
                let rates = centripetal(&self.chart, T, &momentum, &mut along);
                momentum.iter().zip(rates).map(|(&p, rate)| dot(&by_v.gradient(p), a) + rate).collect()
            }
        };
        self.terms.iter().map(|(name, energy)| (name.clone(), forces(*energy))).collect()
    }
}

/// What finds a flaw of a term of a robot at coordinates and speeds.
type Judge = fn(&Term<f64>, &Tree<f64>, &[f64], &[f64]) -> Option<Flaw>;

/// For each term, those of V, of D, of T, what is wrong with it in every configuration.
pub fn flaws(model: &Model<'_>, graph: &Graph) -> Vec<Option<Flaw>> {
    let mut evaluator = Evaluator::new(graph, |symbol| model.parameters[symbol.0 as usize].sample);
    let tree = model.tree.map(|expr| evaluator.value(expr));
    let states = states(&tree);
    let always = |judge: Judge, term: &Term<f64>| {
        let mut found = states.iter().map(|(q, v)| judge(term, &tree, q, v));
        let first = found.next()??;
        found.all(|other| other == Some(first)).then_some(first)
    };
    let of_any = |term: &Term<f64>| always(flaw, term);
    // Whether what depends on fields drives is theirs to say.
    let is_judged = |flaw: &Flaw| *flaw != Flaw::Drives || model.parameters.is_empty();
    let of_dissipation =
        |term: &Term<f64>| of_any(term).or_else(|| always(flaw_of_dissipation, term).filter(is_judged));
    let Terms { potential, dissipation, kinetic } = &tree.terms;
    let judged = potential.iter().map(of_any).chain(dissipation.iter().map(of_dissipation));
    judged.chain(kinetic.iter().map(of_any)).collect()
}

/// Whether kinetic terms leave some motion without energy, or with less, in every configuration that is tried; what depends
/// on fields is not judged.
pub fn is_indefinite(model: &Model<'_>, graph: &Graph) -> bool {
    if !model.parameters.is_empty() {
        return false;
    }
    let mut evaluator = Evaluator::new(graph, |symbol| model.parameters[symbol.0 as usize].sample);
    let tree = model.tree.map(|expr| evaluator.value(expr));
    let is_indefinite =
        |M: Vec<Vec<f64>>| M.iter().flatten().all(|x| x.is_finite()) && Cholesky::of(&M).is_none();
    states(&tree).iter().all(|(q, _)| is_indefinite(Oracle::new(&tree).mass_matrix(q)))
}

/// A few configurations, and speeds.
fn states(tree: &Tree<f64>) -> Vec<(Vec<f64>, Vec<f64>)> {
    let state = |seed: u64| {
        let mut random = Random(seed);
        let mut q: Vec<f64> = (0..tree.coordinates()).map(|_| random.next()).collect();
        tree.normalise(&mut q);
        (q, (0..tree.dof()).map(|_| random.next()).collect())
    };
    (1..4).map(state).collect()
}

/// `ṗ_i + p·[e_i, v] − E_i(T)` at no acceleration.
fn centripetal<'g>(
    chart: &Chart<'g>,
    T: Expr<'g>,
    momentum: &[Expr<'g>],
    along: &mut Along<'g>,
) -> Vec<Expr<'g>> {
    let (slopes, turned) = (along.gradient(T), chart.turned());
    let parts = momentum.iter().zip(slopes).zip(turned);
    parts
        .map(|((&p, slope), turned)| dot(&along.gradient(p), &chart.v) + dot(momentum, &turned) - slope)
        .collect()
}

/// `C_ij = ⟨∇_v E_j, E_i⟩` by Koszul's formula.
fn connection<'g>(
    chart: &Chart<'g>,
    M: &Square<Expr<'g>>,
    dM: &[Square<Expr<'g>>],
    momentum: &[Expr<'g>],
) -> Square<Expr<'g>> {
    let (n, turned) = (chart.v.len(), chart.turned());
    let half = Expr::from(Number::ratio(1, 2));
    let entry = |i: usize, j: usize| {
        // `[e_j, e_i]` is none if either is zero, as between joints of one degree of freedom.
        let between = bracket(&chart.tree, &unit(j, n), &unit(i, n));
        let brackets = dot(&M[j], &turned[i]) - dot(&M[i], &turned[j]) - dot(momentum, &between);
        let symbol = |k: usize| dM[i][j][k] + dM[i][k][j] - dM[j][k][i];
        (0..n).fold(brackets, |sum, k| sum + symbol(k) * chart.v[k]) * half
    };
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

/// Where the origins of frames are.
pub(super) trait Places<'g> {
    /// In the world.
    fn origin(&self, frame: usize) -> Vector3<Expr<'g>>;

    /// From one to another, in any axes; `None` is the world.
    fn between(&self, frames: [Option<usize>; 2]) -> Vector3<Expr<'g>>;
}

/// Those of a tree in normal form.
struct OfNormal<'t, 'g> {
    tree: &'t NormalTree<Expr<'g>>,
    joints: Vec<PlacedJoint<Expr<'g>>>,
}

impl<'g> OfNormal<'_, 'g> {
    /// The origin of a frame on a link, in the frame of a link nearer to the base, or in the base's.
    fn below(&self, frame: usize, end: Option<usize>) -> Vector3<Expr<'g>> {
        let frame = &self.tree.frames[frame];
        let links = frame.link.map(|link| self.tree.path_to_base(link)).into_iter().flatten();
        links.take_while(|link| Some(*link) != end).fold(frame.pose.translation, |point, link| {
            self.joints[link].position + self.joints[link].up(point)
        })
    }
}

impl<'g> Places<'g> for OfNormal<'_, 'g> {
    fn origin(&self, frame: usize) -> Vector3<Expr<'g>> {
        let point = self.below(frame, None);
        match self.tree.frames[frame].link {
            Some(_) => self.tree.base.transform_point(point),
            None => point,
        }
    }

    fn between(&self, frames: [Option<usize>; 2]) -> Vector3<Expr<'g>> {
        let links = frames.map(|frame| frame.and_then(|frame| self.tree.frames[frame].link));
        if let ([Some(a), Some(b)], [Some(one), Some(other)]) = (frames, links) {
            let path: Vec<usize> = self.tree.path_to_base(other).collect();
            let common = self.tree.path_to_base(one).find(|link| path.contains(link));
            return self.below(a, common) - self.below(b, common);
        }
        let [a, b] = frames.map(|frame| frame.map_or(Vector3::zero(), |frame| self.origin(frame)));
        a - b
    }
}

/// Those of a tree as given, all in the world.
pub(super) struct InWorld<'t, 'g> {
    pub(super) tree: &'t Tree<Expr<'g>>,
    pub(super) links: &'t [Pose<Expr<'g>>],
}

impl<'g> Places<'g> for InWorld<'_, 'g> {
    fn origin(&self, frame: usize) -> Vector3<Expr<'g>> {
        let frame = &self.tree.frames[frame];
        let link = frame.link.map_or(Pose::identity(), |link| self.links[link]);
        link.transform_point(frame.pose.translation)
    }

    fn between(&self, frames: [Option<usize>; 2]) -> Vector3<Expr<'g>> {
        let [a, b] = frames.map(|frame| frame.map_or(Vector3::zero(), |frame| self.origin(frame)));
        a - b
    }
}

/// The terms as expressions, each with its name: those of `V`, of `D`, of `T`, numbered from 1.
pub(super) fn energies<'g>(
    terms: &Terms<Expr<'g>>,
    v: &[Expr<'g>],
    along: &mut Along<'g>,
    places: &dyn Places<'g>,
) -> Vec<(String, Energy<'g>)> {
    let mut evaluation = Evaluation { v, along, places };
    let mut energies = vec![];
    for (k, term) in terms.potential.iter().enumerate() {
        energies.push((format!("potential.{}", k + 1), Energy::Potential(evaluation.value(term))));
    }
    for (k, term) in terms.dissipation.iter().enumerate() {
        energies.push((format!("dissipation.{}", k + 1), Energy::Dissipation(evaluation.value(term))));
    }
    for (k, term) in terms.kinetic.iter().enumerate() {
        energies.push((format!("kinetic.{}", k + 1), Energy::Kinetic(evaluation.value(term))));
    }
    energies
}

/// What terms are expressions of.
struct Evaluation<'a, 'g> {
    v: &'a [Expr<'g>],
    along: &'a mut Along<'g>,
    places: &'a dyn Places<'g>,
}

impl<'g> Evaluation<'_, 'g> {
    /// The value of a term. What divides by a constant zero is no number, which is found where all constants are.
    fn value(&mut self, term: &Term<Expr<'g>>) -> Expr<'g> {
        match term {
            Term::Still(value) => *value,
            Term::Coordinate { q, ratio, offset, .. } => *ratio * self.along.coordinate(*q) + *offset,
            Term::Speed(k) => self.v[*k],
            Term::Place(axis, frame) => self.places.origin(*frame).0[*axis],
            Term::Distance(frames) => self.squared_distance(*frames).sqrt().unwrap_or(UNDEFINED),
            Term::Rate(inner) => {
                let value = self.value(inner);
                dot(&self.along.gradient(value), self.v)
            }
            Term::Negative(inner) => -self.value(inner),
            Term::Sum(terms) => terms.iter().fold(Expr::ZERO, |sum, term| sum + self.value(term)),
            Term::Product(factors) => {
                factors.iter().fold(Expr::ONE, |product, factor| product * self.value(factor))
            }
            Term::Quotient(parts) => {
                let [above, below] = &**parts;
                let (above, below) = (self.value(above), self.value(below));
                above.checked_div(below).unwrap_or(UNDEFINED)
            }
            // Where two points meet, the square of their distance is smooth and the distance is not.
            Term::Power(base, exponent) => match (&**base, exponent % 2) {
                (Term::Distance(frames), 0) => power(self.squared_distance(*frames), exponent / 2),
                _ => power(self.value(base), *exponent),
            },
            Term::Call(Function::Sin, inner) => self.value(inner).sin(),
            Term::Call(Function::Cos, inner) => self.value(inner).cos(),
            Term::Call(Function::Sqrt, inner) => self.value(inner).sqrt().unwrap_or(UNDEFINED),
        }
    }

    fn squared_distance(&self, frames: [Option<usize>; 2]) -> Expr<'g> {
        let between = self.places.between(frames);
        between.dot(between)
    }
}

/// The value of what has none.
const UNDEFINED: Expr<'static> = Expr::Constant(Number::NAN);

/// `xⁿ` by squares.
fn power(base: Expr<'_>, exponent: u32) -> Expr<'_> {
    match exponent {
        0 => Expr::ONE,
        1 => base,
        _ => {
            let root = power(base, exponent / 2);
            let even = root * root;
            if exponent.is_multiple_of(2) { even } else { even * base }
        }
    }
}
