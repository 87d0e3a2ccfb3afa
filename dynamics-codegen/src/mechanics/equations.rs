//! The equations of one robot: every output as expressions of coordinates, speeds and parameters.

use std::cell::OnceCell;

use super::aba;
use super::base_regressor::{Symbols, base_columns};
use super::branches::{self, Branches};
use super::centroidal;
use super::composite::{self, Square};
use super::coupling::{Coupling, elimination_parents};
use super::energy;
use super::factor::Factor;
use super::frames::{self, Axes};
use super::galilean::Known;
use super::gauge::regauge;
pub use super::method::{Argument, Block, Equation, Input, Inputs, Method, Shape, Trait};
use super::normal::NormalTree;
use super::passive;
use super::regressor::{Regressed, RegressorColumn};
use super::regroup::regroup;
use super::rest::rest;
use super::rnea;
use super::terms::Added;
use super::unit;
use crate::model::Model;
use crate::symbolic::{Differentiator, Expr, Graph, Number};

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
    /// From the robot's speeds to those of the columns, on which the recursions run.
    coupling: Coupling<Expr<'g>>,
    q: Vec<Expr<'g>>,
    /// The speeds of the columns, their accelerations at no acceleration of the robot's, and so on.
    v: Vec<Expr<'g>>,
    a: Vec<Expr<'g>>,
    rest: Vec<Expr<'g>>,
    tau: Vec<Expr<'g>>,
    /// For each link the name of its joint, and the frame of its body.
    joints: Vec<String>,
    bodies: Vec<Option<usize>>,
    /// Whether the joint's own parameters are those of this link.
    acts: Vec<bool>,
    /// The branches that are alike, where the numbers in which they differ have names.
    pub branches: Branches<'g>,
    /// The coordinates that begin unit quaternions.
    quaternions: Vec<usize>,
    /// The speeds that kinetic terms couple.
    coupled: Vec<(usize, usize)>,
    /// What terms of the energies add, in the robot's own speeds.
    added: Option<Added<'g>>,
    /// Derived when first asked for.
    motions: OnceCell<frames::LinkMotions<Expr<'g>>>,
    regressor: OnceCell<Vec<RegressorColumn<Expr<'g>>>>,
    base_regressor: OnceCell<Vec<RegressorColumn<Expr<'g>>>>,
}

impl<'g> Derivation<'g> {
    /// The derivation of `model`.
    pub fn of(model: &Model<'g>, graph: &'g Graph) -> Self {
        let inputs = Inputs::of(model);
        let kinematic = regauge(&model.tree);
        let coupling = Coupling::of(&kinematic, inputs.dof);
        let added = Added::of(&model.tree, &kinematic, inputs, graph);
        Self {
            inputs,
            graph,
            dynamic: regroup(&kinematic),
            q: inputs.vector(graph, Argument::Q),
            v: coupling.spread(&inputs.vector(graph, Argument::V)),
            a: coupling.spread(&inputs.vector(graph, Argument::A)),
            rest: vec![Expr::ZERO; kinematic.columns.len()],
            tau: inputs.vector(graph, Argument::Tau),
            coupling,
            kinematic,
            joints: model.links.iter().map(|link| link.joint.clone()).collect(),
            bodies: model.links.iter().map(|link| link.body).collect(),
            acts: model.links.iter().map(|link| link.acts).collect(),
            branches: Branches::default(),
            quaternions: model.tree.quaternions().collect(),
            coupled: model.tree.coupled_by_terms(),
            added,
            motions: OnceCell::new(),
            regressor: OnceCell::new(),
            base_regressor: OnceCell::new(),
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

    /// The derivation of forces in the unit `length` with branches that are alike derived alike, if there are such.
    pub fn alike(&self, model: &Model<'g>, length: Number) -> Option<Self> {
        let (turned, sets) = branches::of(&model.tree).filter(|_| self.added.is_none())?;
        let tree = unit::in_unit(&regroup(&regauge(&turned)), length);
        let (dynamic, branches) = branches::named(&tree, &sets, self.graph, self.inputs);
        let coupling = Coupling::of(&dynamic, self.inputs.dof);
        let v = coupling.spread(&self.inputs.vector(self.graph, Argument::V));
        Some(Self { dynamic, branches, v, coupling, ..self.clone() })
    }

    /// The same derivation in frames that stay behind some links, if that can be less for anything.
    pub fn at_rest(&self) -> Option<Self> {
        Some(Self { dynamic: rest(&self.dynamic, &self.q)?, ..self.clone() })
    }

    /// What a method returns, derived in one or more ways of which the cheapest may be taken.
    pub fn alternatives(&self, method: Method) -> Vec<Vec<Block<'g>>> {
        if method == Method::ForwardDynamics {
            return self.forward_dynamics_alternatives();
        }
        let mut alternatives = vec![self.blocks(method)];
        if self.is_small() {
            alternatives.extend(self.blocks_by_matrices(method));
        }
        alternatives
    }

    /// By factoring the mass matrix, by articulated bodies, or both where either may win.
    fn forward_dynamics_alternatives(&self) -> Vec<Vec<Block<'g>>> {
        let chain = self.longest_chain();
        let has_kinetic = self.added.as_ref().is_some_and(Added::has_kinetic);
        let mut alternatives = Vec::new();
        if chain <= LONGEST_FOR_FACTORING || has_kinetic {
            alternatives.push(self.blocks(Method::ForwardDynamics));
        }
        if self.is_small() {
            alternatives.extend(self.blocks_by_matrices(Method::ForwardDynamics));
        }
        if chain >= SHORTEST_FOR_ARTICULATED_BODIES && !has_kinetic {
            let mut passive = passive::forces(&self.dynamic, &self.q, &self.v);
            if let Some(added) = &self.added {
                passive = sum(passive, added.forces(&self.at_no_acceleration()));
            }
            let driving: Vec<Expr<'g>> = difference(&self.coupling.spread(&self.tau), passive);
            let a = aba::forward_dynamics(&self.dynamic, &self.q, &self.v, &driving);
            alternatives.push(vec![vector("a", self.coupling.gather(a))]);
        }
        alternatives
    }

    /// Whether matrices and the chain rule by coordinates may be cheaper than recursions.
    fn is_small(&self) -> bool {
        self.inputs.dof <= LARGEST_FOR_MATRICES && self.inputs.coordinates == self.inputs.dof
    }

    /// The most degrees of freedom from a tip to the base; none that articulated bodies could fold where joints
    /// follow others.
    fn longest_chain(&self) -> usize {
        if !self.coupling.is_one_to_one() {
            return 0;
        }
        let columns = &self.dynamic.columns;
        let path = |column| std::iter::successors(Some(column), |&k: &usize| columns[k].parent).count();
        (0..columns.len()).map(path).max().unwrap_or(0)
    }

    /// The same by `M`, `C`, `G` and the chain rule, where that is another way.
    fn blocks_by_matrices(&self, method: Method) -> Option<Vec<Block<'g>>> {
        Some(match method {
            Method::BiasForces => vec![vector("h", self.bias_by_matrices())],
            Method::InverseDynamics => {
                let inertial = times(&self.mass_matrix(), &self.inputs.vector(self.graph, Argument::A));
                vec![vector("tau", sum(inertial, self.bias_by_matrices()))]
            }
            Method::ForwardDynamics => vec![vector("a", self.acceleration(self.bias_by_matrices()).0)],
            Method::KineticEnergy => vec![scalar(self.kinetic_energy_by_matrices())],
            Method::Lagrangian => {
                vec![scalar(self.kinetic_energy_by_matrices() - self.potential_energy())]
            }
            Method::InverseDynamicsDerivatives => {
                self.by_chain_rule(&self.inverse_dynamics(&self.accelerations()))
            }
            Method::InverseDynamicsWithDerivatives => {
                let tau = self.inverse_dynamics(&self.accelerations());
                let derivatives = self.by_chain_rule(&tau);
                with_derivatives(vector("tau", tau), derivatives)
            }
            _ => return None,
        })
    }

    fn bias_by_matrices(&self) -> Vec<Expr<'g>> {
        let coriolis = times(&self.coriolis_matrix(), &self.speeds());
        sum(sum(coriolis, self.gravity_forces()), self.passive_forces())
    }

    fn kinetic_energy_by_matrices(&self) -> Expr<'g> {
        let speeds = self.speeds();
        let momenta = times(&self.mass_matrix(), &speeds);
        let twice = momenta.into_iter().zip(&speeds).fold(Expr::ZERO, |sum, (p, &v)| sum + p * v);
        Expr::from(Number::ratio(1, 2)) * twice
    }

    /// The robot's own speeds.
    fn speeds(&self) -> Vec<Expr<'g>> {
        self.inputs.vector(self.graph, Argument::V)
    }

    /// What a method returns.
    pub fn blocks(&self, method: Method) -> Vec<Block<'g>> {
        let (tree, q, v) = (&self.dynamic, &self.q, &self.v);
        match method {
            Method::MassMatrix => vec![square("m", self.mass_matrix())],
            Method::CoriolisMatrix => vec![square("c", self.coriolis_matrix())],
            Method::GravityForces => vec![vector("g", self.gravity_forces())],
            Method::BiasForces => vec![vector("h", self.bias_forces())],
            Method::PassiveForces => vec![vector("f", self.passive_forces())],
            Method::InverseDynamics => vec![vector("tau", self.inverse_dynamics(&self.accelerations()))],
            Method::ForwardDynamics => vec![vector("a", self.forward_dynamics().0)],
            Method::InverseMassMatrix => vec![square("inverse", self.inverse(&self.factor()))],
            Method::KineticEnergy => vec![scalar(self.kinetic_energy())],
            Method::PotentialEnergy => vec![scalar(self.potential_energy())],
            Method::ElasticEnergy => vec![scalar(passive::elastic_energy(tree, q))],
            Method::Lagrangian => vec![scalar(self.kinetic_energy() - self.potential_energy())],
            Method::EquationsOfMotion => vec![
                square("mass_matrix", self.mass_matrix()),
                square("coriolis_matrix", self.coriolis_matrix()),
                vector("gravity_forces", self.gravity_forces()),
            ],
            Method::InverseDynamicsDerivatives => self.derivatives_of_inverse_dynamics(),
            Method::InverseDynamicsWithDerivatives => {
                let tau = vector("tau", self.inverse_dynamics(&self.accelerations()));
                with_derivatives(tau, self.derivatives_of_inverse_dynamics())
            }
            Method::ForwardDynamicsDerivatives => self.forward_dynamics_derivatives().1,
            Method::ForwardDynamicsWithDerivatives => {
                let (a, derivatives) = self.forward_dynamics_derivatives();
                with_derivatives(vector("a", a), derivatives)
            }
            Method::CenterOfMass => {
                vec![vector("p", centroidal::center_of_mass(&self.kinematic, q).0.to_vec())]
            }
            Method::CenterOfMassJacobian => {
                vec![self.wide("j", centroidal::center_of_mass_jacobian(&self.kinematic, q))]
            }
            Method::CentroidalMomentum => {
                vec![vector("h", centroidal::centroidal_momentum(&self.kinematic, q, v).to_vec())]
            }
            Method::CentroidalMomentumMatrix => {
                vec![self.wide("a", centroidal::centroidal_momentum_matrix(&self.kinematic, q))]
            }
            Method::TotalMass => vec![scalar(centroidal::total_mass(&self.kinematic))],
            Method::Regressor => vec![beside("y", self.regressor())],
            Method::InertialParameters => vec![values(self.regressor())],
            Method::BaseRegressor => vec![beside("y", self.base_regressor())],
            Method::BaseParameters => vec![values(self.base_regressor())],
            Method::Pose(frame) => self.pose(frame),
            Method::Jacobian(frame) => vec![self.jacobian(frame, Axes::Body)],
            Method::WorldJacobian(frame) => vec![self.jacobian(frame, Axes::World)],
            Method::Velocity(frame) => {
                vec![vector("twist", self.motions().twist(&self.kinematic.frames[frame]).to_vec())]
            }
            Method::Acceleration(frame) => {
                vec![vector("rate", self.motions().twist_rate(&self.kinematic.frames[frame]).to_vec())]
            }
        }
    }

    fn derivative_blocks(&self, dtau_dq: Square<Expr<'g>>, dtau_dv: Square<Expr<'g>>) -> Vec<Block<'g>> {
        vec![square("dtau_dq", dtau_dq), square("dtau_dv", dtau_dv), square("dtau_da", self.mass_matrix())]
    }

    fn derivatives_of_inverse_dynamics(&self) -> Vec<Block<'g>> {
        let (dtau_dq, dtau_dv) = self.inverse_dynamics_derivatives(&self.accelerations());
        self.derivative_blocks(dtau_dq, dtau_dv)
    }

    /// The derivatives of the forces `tau` by each coordinate and speed.
    fn by_chain_rule(&self, tau: &[Expr<'g>]) -> Vec<Block<'g>> {
        let with_respect_to = |argument: Argument| {
            let mut columns: Vec<Differentiator<'g>> = (0..self.inputs.dof)
                .map(|k| Differentiator::new(self.graph, self.inputs.symbol(argument, k)))
                .collect();
            tau.iter().map(|&tau| columns.iter_mut().map(|column| column.derivative(tau)).collect()).collect()
        };
        self.derivative_blocks(with_respect_to(Argument::Q), with_respect_to(Argument::V))
    }

    fn kinetic_energy(&self) -> Expr<'g> {
        let of_bodies = energy::kinetic_energy(&self.dynamic, &self.q, &self.v);
        self.added.as_ref().map_or(of_bodies, |added| of_bodies + added.kinetic)
    }

    fn potential_energy(&self) -> Expr<'g> {
        let of_bodies = energy::potential_energy(&self.dynamic, &self.q);
        self.added.as_ref().map_or(of_bodies, |added| of_bodies + added.potential)
    }

    fn mass_matrix(&self) -> Square<Expr<'g>> {
        let mut m = composite::mass_matrix(&self.dynamic, &self.q);
        add_to_diagonal(&mut m, passive::armatures(&self.dynamic));
        let m = self.coupling.gather_both(m);
        self.added.iter().fold(m, |m, added| sums(m, &added.mass))
    }

    fn coriolis_matrix(&self) -> Square<Expr<'g>> {
        let c = self.coupling.gather_both(composite::coriolis_matrix(&self.dynamic, &self.q, &self.v));
        self.added.iter().fold(c, |c, added| sums(c, &added.coriolis))
    }

    fn gravity_forces(&self) -> Vec<Expr<'g>> {
        let g = self.coupling.gather(rnea::inverse_dynamics(&self.dynamic, &self.q, &self.rest, &self.rest));
        self.added.iter().fold(g, |g, added| sum(g, added.gravity.clone()))
    }

    fn passive_forces(&self) -> Vec<Expr<'g>> {
        let f = self.coupling.gather(passive::forces(&self.dynamic, &self.q, &self.v));
        self.added.iter().fold(f, |f, added| sum(f, added.passive.clone()))
    }

    fn bias_forces(&self) -> Vec<Expr<'g>> {
        self.inverse_dynamics(&self.at_no_acceleration())
    }

    /// The robot's own accelerations.
    fn accelerations(&self) -> Vec<Expr<'g>> {
        self.inputs.vector(self.graph, Argument::A)
    }

    fn at_no_acceleration(&self) -> Vec<Expr<'g>> {
        vec![Expr::ZERO; self.inputs.dof]
    }

    /// τ at the robot's accelerations `a`.
    fn inverse_dynamics(&self, a: &[Expr<'g>]) -> Vec<Expr<'g>> {
        let (tree, q, v, of_columns) = (&self.dynamic, &self.q, &self.v, self.coupling.spread(a));
        let rotors = passive::armatures(tree).into_iter().zip(&of_columns).map(|(armature, &a)| armature * a);
        let bodies = rnea::inverse_dynamics(tree, q, v, &of_columns);
        let tau = self.coupling.gather(sum(sum(bodies, rotors.collect()), passive::forces(tree, q, v)));
        self.added.iter().fold(tau, |tau, added| sum(tau, added.forces(a)))
    }

    /// `∂τ/∂q` and `∂τ/∂v` at the robot's accelerations `a`.
    fn inverse_dynamics_derivatives(&self, a: &[Expr<'g>]) -> (Square<Expr<'g>>, Square<Expr<'g>>) {
        let (tree, q, v) = (&self.dynamic, &self.q, &self.v);
        let mut derivatives = composite::inverse_dynamics_derivatives(tree, q, v, &self.coupling.spread(a));
        add_to_diagonal(&mut derivatives.dtau_dq, passive::stiffnesses(tree));
        add_to_diagonal(&mut derivatives.dtau_dv, passive::dampings(tree, q, v));
        let gathered = [derivatives.dtau_dq, derivatives.dtau_dv].map(|m| self.coupling.gather_both(m));
        let [dtau_dq, dtau_dv] = gathered;
        match &self.added {
            None => (dtau_dq, dtau_dv),
            Some(added) => {
                let (by_q, by_v) = added.derivatives(a);
                (sums(dtau_dq, &by_q), sums(dtau_dv, &by_v))
            }
        }
    }

    fn factor(&self) -> Factor<'_, Expr<'g>> {
        let parents = elimination_parents(&self.dynamic.columns, self.inputs.dof, &self.coupled);
        Factor::completing(&self.mass_matrix(), parents, |speed, value| self.branches.together(speed, value))
    }

    /// `M⁻¹`
    fn inverse(&self, factor: &Factor<'_, Expr<'g>>) -> Square<Expr<'g>> {
        factor.inverse(|i, k| self.branches.is_computed(i, k))
    }

    fn forward_dynamics(&self) -> (Vec<Expr<'g>>, Factor<'_, Expr<'g>>) {
        self.acceleration(self.bias_forces())
    }

    /// `a = M⁻¹ (τ − h)`, and the factors of M.
    fn acceleration(&self, bias: Vec<Expr<'g>>) -> (Vec<Expr<'g>>, Factor<'_, Expr<'g>>) {
        let factor = self.factor();
        (factor.solve(&difference(&self.tau, bias)), factor)
    }

    /// The acceleration that τ causes, and there `∂a/∂q = −M⁻¹ ∂τ/∂q` and `∂a/∂v = −M⁻¹ ∂τ/∂v`.
    fn forward_dynamics_derivatives(&self) -> (Vec<Expr<'g>>, Vec<Block<'g>>) {
        let (a, factor) = self.forward_dynamics();
        let (dtau_dq, dtau_dv) = self.inverse_dynamics_derivatives(&a);
        let Known { by_q, by_v } = self.known_derivatives();
        let derivatives = vec![
            square("da_dq", solved(&factor, &dtau_dq, by_q)),
            square("da_dv", solved(&factor, &dtau_dv, by_v)),
            square("da_dtau", self.inverse(&factor)),
        ];
        (a, derivatives)
    }

    /// What the derivatives of forward dynamics are solved for with, for those who solve for all columns at once: `∂τ/∂q` and
    /// `∂τ/∂v` at the acceleration that τ causes, `M⁻¹`, and the factors of M, L below the diagonal and `1/D` on it; before them
    /// that acceleration, where the method gives it. None of another method, and where columns are known.
    pub fn before_solving(&self, method: Method) -> Option<Vec<Block<'g>>> {
        let gives_a = match method {
            Method::ForwardDynamicsDerivatives => false,
            Method::ForwardDynamicsWithDerivatives => true,
            _ => return None,
        };
        let Known { by_q, by_v } = self.known_derivatives();
        if by_q.iter().chain(&by_v).any(Option::is_some) {
            return None;
        }
        let (a, factor) = self.forward_dynamics();
        let (dtau_dq, dtau_dv) = self.inverse_dynamics_derivatives(&a);
        let entry = |i: usize, j: usize| match j.cmp(&i) {
            std::cmp::Ordering::Less => factor.L[i][j],
            std::cmp::Ordering::Equal => factor.inverse_D[i],
            std::cmp::Ordering::Greater => Expr::ZERO,
        };
        let n = self.inputs.dof;
        let factors = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
        let blocks = vec![
            square("da_dq", dtau_dq),
            square("da_dv", dtau_dv),
            square("da_dtau", self.inverse(&factor)),
            square("factors", factors),
        ];
        Some(if gives_a { with_derivatives(vector("a", a), blocks) } else { blocks })
    }

    /// The columns of `∂a/∂q` and `∂a/∂v` that are known without solving. Terms of the energies may know where a body is.
    fn known_derivatives(&self) -> Known<Expr<'g>> {
        match self.added {
            None => Known::of(&self.dynamic, &self.q, &self.speeds()),
            Some(_) => Known::none(self.inputs.dof),
        }
    }

    fn pose(&self, frame: usize) -> Vec<Block<'g>> {
        let pose = frames::pose(&self.kinematic, &self.kinematic.frames[frame], &self.q);
        let rotation = pose.rotation.0.iter().map(|row| row.to_vec()).collect();
        vec![square("rotation", rotation), vector("translation", pose.translation.0.to_vec())]
    }

    fn jacobian(&self, frame: usize, axes: Axes) -> Block<'g> {
        let rows = frames::jacobian(&self.kinematic, &self.kinematic.frames[frame], &self.q, axes);
        self.wide("j", rows)
    }

    /// A matrix of the columns as one of the robot's speeds.
    fn wide(&self, name: &'static str, rows: Square<Expr<'g>>) -> Block<'g> {
        let shape = Shape::Matrix(rows.len(), self.inputs.dof);
        Block { name, shape, entries: self.coupling.gather_columns(rows).concat() }
    }

    /// The columns of the regressor.
    pub fn regressor(&self) -> &[RegressorColumn<Expr<'g>>] {
        self.regressor.get_or_init(|| {
            let mut columns = self.regressed().columns();
            columns.extend(self.columns_of_terms());
            columns
        })
    }

    /// The columns of the regressor of base parameters.
    pub fn base_regressor(&self) -> &[RegressorColumn<Expr<'g>>] {
        self.base_regressor.get_or_init(|| {
            let is_body: Vec<bool> = self.bodies.iter().map(Option::is_some).collect();
            let symbols = Symbols { graph: self.graph, inputs: self.inputs, quaternions: &self.quaternions };
            let mut columns = base_columns(&self.regressed(), &is_body, &symbols);
            columns.extend(self.columns_of_terms());
            columns
        })
    }

    /// Of terms of the energies a column each: what it adds, for a parameter of one.
    fn columns_of_terms(&self) -> Vec<RegressorColumn<Expr<'g>>> {
        let forces = self.added.iter().flat_map(|added| added.forces_of_terms(&self.accelerations()));
        forces.map(|(name, forces)| RegressorColumn { name, value: Expr::ONE, forces }).collect()
    }

    fn regressed(&self) -> Regressed<'_, Expr<'g>> {
        Regressed {
            tree: &self.kinematic,
            bodies: &self.bodies,
            joints: &self.joints,
            acts: &self.acts,
            coupling: &self.coupling,
            state: [&self.q, &self.v, &self.a],
        }
    }

    /// How the links move, once for all frames.
    fn motions(&self) -> &frames::LinkMotions<Expr<'g>> {
        self.motions.get_or_init(|| frames::LinkMotions::of(&self.kinematic, &self.q, &self.v, &self.a))
    }
}

/// `−M⁻¹` times the right-hand sides, but for the columns that are known.
fn solved<'g>(
    factor: &Factor<'_, Expr<'g>>,
    right: &Square<Expr<'g>>,
    known: Vec<Option<Vec<Expr<'g>>>>,
) -> Square<Expr<'g>> {
    let solve = |k: usize| factor.solve(&right.iter().map(|row| -row[k]).collect::<Vec<_>>());
    let columns = known.into_iter().enumerate().map(|(k, known)| known.unwrap_or_else(|| solve(k)));
    transposed(columns.collect())
}

fn transposed<'g>(columns: Square<Expr<'g>>) -> Square<Expr<'g>> {
    (0..columns.len()).map(|i| columns.iter().map(|column| column[i]).collect()).collect()
}

fn times<'g>(m: &Square<Expr<'g>>, x: &[Expr<'g>]) -> Vec<Expr<'g>> {
    m.iter().map(|row| row.iter().zip(x).fold(Expr::ZERO, |sum, (&m, &x)| sum + m * x)).collect()
}

fn sum<'g>(a: Vec<Expr<'g>>, b: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
    a.into_iter().zip(b).map(|(a, b)| a + b).collect()
}

fn sums<'g>(a: Square<Expr<'g>>, b: &Square<Expr<'g>>) -> Square<Expr<'g>> {
    a.into_iter().zip(b).map(|(a, b)| sum(a, b.clone())).collect()
}

fn difference<'g>(a: &[Expr<'g>], b: Vec<Expr<'g>>) -> Vec<Expr<'g>> {
    a.iter().zip(b).map(|(&a, b)| a - b).collect()
}

fn add_to_diagonal<'g>(m: &mut Square<Expr<'g>>, diagonal: Vec<Expr<'g>>) {
    for (k, value) in diagonal.into_iter().enumerate() {
        m[k][k] = m[k][k] + value;
    }
}

/// The matrix whose columns are the forces.
fn beside<'g>(name: &'static str, columns: &[RegressorColumn<Expr<'g>>]) -> Block<'g> {
    let height = columns.first().map_or(0, |column| column.forces.len());
    let row = |k: usize| columns.iter().map(move |column| column.forces[k]);
    Block { name, shape: Shape::Matrix(height, columns.len()), entries: (0..height).flat_map(row).collect() }
}

fn values<'g>(columns: &[RegressorColumn<Expr<'g>>]) -> Block<'g> {
    vector("pi", columns.iter().map(|column| column.value).collect())
}

fn with_derivatives<'g>(value: Block<'g>, derivatives: Vec<Block<'g>>) -> Vec<Block<'g>> {
    std::iter::once(value).chain(derivatives).collect()
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
