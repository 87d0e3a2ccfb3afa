//! The equations of one robot: every output as expressions of coordinates, speeds and parameters.

use super::aba;
use super::composite::{self, Square};
use super::energy;
use super::factor::Factor;
use super::frames::{self, Axes};
use super::gauge::regauge;
use super::normal::NormalTree;
use super::regroup::regroup;
use super::rnea::inverse_dynamics;
use super::unit;
use crate::model::Model;
use crate::symbolic::{Differentiator, Expr, Graph, Number, SymbolId};

/// What a generated method computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// `M(q)`
    MassMatrix,
    /// `C(q,v)`
    CoriolisMatrix,
    /// `G(q)`
    GravityForces,
    /// `C·v + G`
    BiasForces,
    /// `τ`
    InverseDynamics,
    /// `a`
    ForwardDynamics,
    /// `T`
    KineticEnergy,
    /// `V`
    PotentialEnergy,
    /// `T − V`
    Lagrangian,
    /// `M`, `C` and `G`
    EquationsOfMotion,
    /// `∂τ/∂q`, `∂τ/∂v`, `∂τ/∂a`
    InverseDynamicsDerivatives,
    /// `∂a/∂q`, `∂a/∂v`, `∂a/∂τ`
    ForwardDynamicsDerivatives,
    /// The pose of a frame.
    Pose(usize),
    /// The body Jacobian of a frame.
    Jacobian(usize),
    /// The Jacobian of a frame in world axes.
    WorldJacobian(usize),
}

impl Method {
    /// The methods that every robot has.
    pub const OF_ROBOT: [Method; 12] = [
        Method::MassMatrix,
        Method::CoriolisMatrix,
        Method::GravityForces,
        Method::BiasForces,
        Method::InverseDynamics,
        Method::ForwardDynamics,
        Method::KineticEnergy,
        Method::PotentialEnergy,
        Method::Lagrangian,
        Method::EquationsOfMotion,
        Method::InverseDynamicsDerivatives,
        Method::ForwardDynamicsDerivatives,
    ];

    /// The methods of the trait of derivatives.
    pub const OF_DERIVATIVES: [Method; 2] =
        [Method::InverseDynamicsDerivatives, Method::ForwardDynamicsDerivatives];

    /// The method's name in the trait.
    pub fn name(self) -> &'static str {
        match self {
            Method::MassMatrix => "mass_matrix",
            Method::CoriolisMatrix => "coriolis_matrix",
            Method::GravityForces => "gravity_forces",
            Method::BiasForces => "bias_forces",
            Method::InverseDynamics => "inverse_dynamics",
            Method::ForwardDynamics => "forward_dynamics",
            Method::KineticEnergy => "kinetic_energy",
            Method::PotentialEnergy => "potential_energy",
            Method::Lagrangian => "lagrangian",
            Method::EquationsOfMotion => "equations_of_motion",
            Method::InverseDynamicsDerivatives => "inverse_dynamics_derivatives",
            Method::ForwardDynamicsDerivatives => "forward_dynamics_derivatives",
            Method::Pose(_) => "pose",
            Method::Jacobian(_) => "jacobian",
            Method::WorldJacobian(_) => "world_jacobian",
        }
    }

    /// The arguments of the method.
    pub fn arguments(self) -> &'static [Argument] {
        use Argument::{A, Q, Tau, V};
        match self {
            Method::MassMatrix
            | Method::GravityForces
            | Method::PotentialEnergy
            | Method::Pose(_)
            | Method::Jacobian(_)
            | Method::WorldJacobian(_) => &[Q],
            Method::CoriolisMatrix
            | Method::BiasForces
            | Method::KineticEnergy
            | Method::Lagrangian
            | Method::EquationsOfMotion => &[Q, V],
            Method::InverseDynamics | Method::InverseDynamicsDerivatives => &[Q, V, A],
            Method::ForwardDynamics | Method::ForwardDynamicsDerivatives => &[Q, V, Tau],
        }
    }
}

/// A vector that a method is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Argument {
    /// Coordinates.
    Q,
    /// Speeds.
    V,
    /// Accelerations.
    A,
    /// Joint forces.
    Tau,
}

impl Argument {
    /// All of them, in order.
    pub const ALL: [Argument; 4] = [Argument::Q, Argument::V, Argument::A, Argument::Tau];

    /// The argument's name.
    pub fn name(self) -> &'static str {
        match self {
            Argument::Q => "q",
            Argument::V => "v",
            Argument::A => "a",
            Argument::Tau => "tau",
        }
    }
}

/// The inputs of the equations: parameters first, then coordinates, speeds, accelerations, forces.
#[derive(Clone, Copy, Debug)]
pub struct Inputs {
    /// How many parameters there are.
    pub parameters: usize,
    /// How many degrees of freedom.
    pub dof: usize,
}

/// What a symbol stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Input {
    /// The field with this index among the model's parameters.
    Parameter(usize),
    /// A component of an argument.
    Argument(Argument, usize),
}

impl Inputs {
    /// The meaning of a symbol.
    pub fn meaning(self, symbol: SymbolId) -> Input {
        let index = symbol.0 as usize;
        match index.checked_sub(self.parameters) {
            None => Input::Parameter(index),
            Some(rest) => Input::Argument(Argument::ALL[rest / self.dof], rest % self.dof),
        }
    }

    /// The symbol of a component of an argument.
    pub fn symbol(self, argument: Argument, k: usize) -> SymbolId {
        let index = self.parameters + argument as usize * self.dof + k;
        SymbolId(u32::try_from(index).expect("fewer than 2^32 inputs"))
    }

    /// The components of an argument.
    pub fn vector<'g>(self, graph: &'g Graph, argument: Argument) -> Vec<Expr<'g>> {
        (0..self.dof).map(|k| graph.variable(self.symbol(argument, k))).collect()
    }
}

/// A block of numbers that a method returns.
#[derive(Clone, Debug)]
pub struct Block<'g> {
    /// A letter for its entries, and the field that takes it where a method returns several.
    pub name: &'static str,
    /// The shape.
    pub shape: Shape,
    /// The entries, by rows.
    pub entries: Vec<Expr<'g>>,
}

/// The shape of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A number.
    Scalar,
    /// A column.
    Vector(usize),
    /// Rows and columns.
    Matrix(usize, usize),
}

/// One method's result.
#[derive(Clone, Debug)]
pub struct Equation<'g> {
    /// Which method.
    pub method: Method,
    /// What it returns.
    pub blocks: Vec<Block<'g>>,
}

/// The largest robot for which the equations by matrices and the chain rule may be cheaper than recursions.
const LARGEST_FOR_MATRICES: usize = 3;

/// The shortest chain for which articulated bodies may be cheaper than factoring the mass matrix.
const SHORTEST_FOR_ARTICULATED_BODIES: usize = 8;

/// The longest chain for which factoring the mass matrix may be cheaper than articulated bodies.
const LONGEST_FOR_FACTORING: usize = 16;

/// A robot about to be derived: its trees and its inputs.
#[derive(Clone)]
pub struct Derivation<'g> {
    /// The meaning of the symbols.
    pub inputs: Inputs,
    /// Where the expressions live.
    pub graph: &'g Graph,
    /// For poses and Jacobians.
    kinematic: NormalTree<Expr<'g>>,
    /// For everything with mass: regrouped, in a unit of length of its own.
    dynamic: NormalTree<Expr<'g>>,
    q: Vec<Expr<'g>>,
    v: Vec<Expr<'g>>,
    a: Vec<Expr<'g>>,
    tau: Vec<Expr<'g>>,
    rest: Vec<Expr<'g>>,
}

impl<'g> Derivation<'g> {
    /// The derivation of `model`.
    pub fn of(model: &Model<'g>, graph: &'g Graph) -> Self {
        let inputs = Inputs { parameters: model.parameters.len(), dof: model.tree.dof() };
        let kinematic = regauge(&model.tree);
        Self {
            inputs,
            graph,
            dynamic: regroup(&kinematic),
            kinematic,
            q: inputs.vector(graph, Argument::Q),
            v: inputs.vector(graph, Argument::V),
            a: inputs.vector(graph, Argument::A),
            tau: inputs.vector(graph, Argument::Tau),
            rest: vec![Expr::ZERO; inputs.dof],
        }
    }

    /// The units of length that are worth a try.
    pub fn units(&self) -> Vec<Number> {
        unit::candidates(&self.dynamic)
    }

    /// The same derivation in another unit of length.
    pub fn in_unit(&self, length: Number) -> Self {
        Self { dynamic: unit::in_unit(&self.dynamic, length), ..self.clone() }
    }

    /// What a method returns, derived in one or more ways of which the cheapest may be taken.
    pub fn alternatives(&self, method: Method) -> Vec<Vec<Block<'g>>> {
        if method == Method::ForwardDynamics {
            return self.forward_dynamics_alternatives();
        }
        let mut alternatives = vec![self.blocks(method)];
        if self.inputs.dof <= LARGEST_FOR_MATRICES {
            alternatives.extend(self.blocks_by_matrices(method));
        }
        alternatives
    }

    /// By factoring the mass matrix, by articulated bodies, or both where either may win.
    fn forward_dynamics_alternatives(&self) -> Vec<Vec<Block<'g>>> {
        let chain = self.longest_chain();
        let mut alternatives = Vec::new();
        if chain <= LONGEST_FOR_FACTORING {
            alternatives.push(self.blocks(Method::ForwardDynamics));
        }
        if self.inputs.dof <= LARGEST_FOR_MATRICES {
            alternatives.extend(self.blocks_by_matrices(Method::ForwardDynamics));
        }
        if chain >= SHORTEST_FOR_ARTICULATED_BODIES {
            let a = aba::forward_dynamics(&self.dynamic, &self.q, &self.v, &self.tau);
            alternatives.push(vec![vector("a", a)]);
        }
        alternatives
    }

    fn longest_chain(&self) -> usize {
        let links = 0..self.inputs.dof;
        links.map(|link| self.dynamic.path_to_base(link).count()).max().unwrap_or(0)
    }

    /// The same by `M`, `C`, `G` and the chain rule, where that is another way.
    fn blocks_by_matrices(&self, method: Method) -> Option<Vec<Block<'g>>> {
        Some(match method {
            Method::BiasForces => vec![vector("h", self.bias_by_matrices())],
            Method::InverseDynamics => {
                let inertial = times(&self.mass_matrix(), &self.a);
                let bias = self.bias_by_matrices();
                vec![vector("tau", inertial.into_iter().zip(bias).map(|(ma, h)| ma + h).collect())]
            }
            Method::ForwardDynamics => vec![vector("a", self.acceleration(self.bias_by_matrices()).0)],
            Method::KineticEnergy => vec![scalar(self.kinetic_energy_by_matrices())],
            Method::Lagrangian => {
                let potential = energy::potential_energy(&self.dynamic, &self.q);
                vec![scalar(self.kinetic_energy_by_matrices() - potential)]
            }
            Method::InverseDynamicsDerivatives => self.inverse_dynamics_derivatives_by_chain_rule(),
            _ => return None,
        })
    }

    fn bias_by_matrices(&self) -> Vec<Expr<'g>> {
        let coriolis = times(&composite::coriolis_matrix(&self.dynamic, &self.q, &self.v), &self.v);
        coriolis.into_iter().zip(self.gravity_forces()).map(|(cv, g)| cv + g).collect()
    }

    fn kinetic_energy_by_matrices(&self) -> Expr<'g> {
        let momenta = times(&self.mass_matrix(), &self.v);
        let twice = momenta.into_iter().zip(&self.v).fold(Expr::ZERO, |sum, (p, &v)| sum + p * v);
        Expr::from(Number::ratio(1, 2)) * twice
    }

    /// What a method returns.
    pub fn blocks(&self, method: Method) -> Vec<Block<'g>> {
        let (tree, q, v, a) = (&self.dynamic, &self.q, &self.v, &self.a);
        match method {
            Method::MassMatrix => vec![square("m", self.mass_matrix())],
            Method::CoriolisMatrix => vec![square("c", composite::coriolis_matrix(tree, q, v))],
            Method::GravityForces => vec![vector("g", self.gravity_forces())],
            Method::BiasForces => vec![vector("h", self.bias_forces())],
            Method::InverseDynamics => vec![vector("tau", inverse_dynamics(tree, q, v, a))],
            Method::ForwardDynamics => vec![vector("a", self.forward_dynamics().0)],
            Method::KineticEnergy => vec![scalar(energy::kinetic_energy(tree, q, v))],
            Method::PotentialEnergy => vec![scalar(energy::potential_energy(tree, q))],
            Method::Lagrangian => {
                vec![scalar(energy::kinetic_energy(tree, q, v) - energy::potential_energy(tree, q))]
            }
            Method::EquationsOfMotion => vec![
                square("mass_matrix", self.mass_matrix()),
                square("coriolis_matrix", composite::coriolis_matrix(tree, q, v)),
                vector("gravity_forces", self.gravity_forces()),
            ],
            Method::InverseDynamicsDerivatives => {
                let derivatives = composite::inverse_dynamics_derivatives(tree, q, v, a);
                self.derivative_blocks(derivatives.dtau_dq, derivatives.dtau_dv)
            }
            Method::ForwardDynamicsDerivatives => self.forward_dynamics_derivatives(),
            Method::Pose(frame) => self.pose(frame),
            Method::Jacobian(frame) => vec![self.jacobian(frame, Axes::Body)],
            Method::WorldJacobian(frame) => vec![self.jacobian(frame, Axes::World)],
        }
    }

    fn derivative_blocks(&self, dtau_dq: Square<Expr<'g>>, dtau_dv: Square<Expr<'g>>) -> Vec<Block<'g>> {
        vec![square("dtau_dq", dtau_dq), square("dtau_dv", dtau_dv), square("dtau_da", self.mass_matrix())]
    }

    fn inverse_dynamics_derivatives_by_chain_rule(&self) -> Vec<Block<'g>> {
        let tau = inverse_dynamics(&self.dynamic, &self.q, &self.v, &self.a);
        let with_respect_to = |argument: Argument| {
            let mut columns: Vec<Differentiator<'g>> = (0..self.inputs.dof)
                .map(|k| Differentiator::new(self.graph, self.inputs.symbol(argument, k)))
                .collect();
            tau.iter().map(|&tau| columns.iter_mut().map(|column| column.derivative(tau)).collect()).collect()
        };
        self.derivative_blocks(with_respect_to(Argument::Q), with_respect_to(Argument::V))
    }

    fn mass_matrix(&self) -> Square<Expr<'g>> {
        composite::mass_matrix(&self.dynamic, &self.q)
    }

    fn gravity_forces(&self) -> Vec<Expr<'g>> {
        inverse_dynamics(&self.dynamic, &self.q, &self.rest, &self.rest)
    }

    fn bias_forces(&self) -> Vec<Expr<'g>> {
        inverse_dynamics(&self.dynamic, &self.q, &self.v, &self.rest)
    }

    fn forward_dynamics(&self) -> (Vec<Expr<'g>>, Factor<Expr<'g>>) {
        self.acceleration(self.bias_forces())
    }

    /// `a = M⁻¹ (τ − h)`, and the factors of M.
    fn acceleration(&self, bias: Vec<Expr<'g>>) -> (Vec<Expr<'g>>, Factor<Expr<'g>>) {
        let parents = self.dynamic.links.iter().map(|link| link.parent).collect();
        let factor = Factor::of(&self.mass_matrix(), parents);
        let driving: Vec<Expr<'g>> = self.tau.iter().zip(bias).map(|(&tau, h)| tau - h).collect();
        (factor.solve(&driving), factor)
    }

    /// `∂a/∂q = −M⁻¹ ∂τ/∂q` and `∂a/∂v = −M⁻¹ ∂τ/∂v` at the acceleration that τ causes.
    fn forward_dynamics_derivatives(&self) -> Vec<Block<'g>> {
        let (a, factor) = self.forward_dynamics();
        let inverse = composite::inverse_dynamics_derivatives(&self.dynamic, &self.q, &self.v, &a);
        let negated =
            |m: Square<Expr<'g>>| m.into_iter().map(|row| row.into_iter().map(|x| -x).collect()).collect();
        vec![
            square("da_dq", factor.solve_matrix(&negated(inverse.dtau_dq))),
            square("da_dv", factor.solve_matrix(&negated(inverse.dtau_dv))),
            square("da_dtau", factor.inverse()),
        ]
    }

    fn pose(&self, frame: usize) -> Vec<Block<'g>> {
        let pose = frames::pose(&self.kinematic, &self.kinematic.frames[frame], &self.q);
        let rotation = pose.rotation.0.iter().map(|row| row.to_vec()).collect();
        vec![square("rotation", rotation), vector("translation", pose.translation.0.to_vec())]
    }

    fn jacobian(&self, frame: usize, axes: Axes) -> Block<'g> {
        let rows = frames::jacobian(&self.kinematic, &self.kinematic.frames[frame], &self.q, axes);
        Block { name: "j", shape: Shape::Matrix(6, self.inputs.dof), entries: rows.concat() }
    }
}

fn times<'g>(m: &Square<Expr<'g>>, x: &[Expr<'g>]) -> Vec<Expr<'g>> {
    m.iter().map(|row| row.iter().zip(x).fold(Expr::ZERO, |sum, (&m, &x)| sum + m * x)).collect()
}

fn scalar(value: Expr<'_>) -> Block<'_> {
    Block { name: "energy", shape: Shape::Scalar, entries: vec![value] }
}

fn vector<'g>(name: &'static str, entries: Vec<Expr<'g>>) -> Block<'g> {
    Block { name, shape: Shape::Vector(entries.len()), entries }
}

fn square<'g>(name: &'static str, rows: Square<Expr<'g>>) -> Block<'g> {
    Block { name, shape: Shape::Matrix(rows.len(), rows.len()), entries: rows.concat() }
}
