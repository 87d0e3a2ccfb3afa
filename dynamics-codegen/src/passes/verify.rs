//! The last pass: the finished programs are run against the plain recursion, and must agree.
//!
//! At seeded states and the parameters' sample values, every result of every program is compared with the
//! [`Oracle`], which works on the frames and masses as they were given. Forward dynamics and its derivatives
//! are compared by their residual: their forward error explodes for a mass matrix that is ill-conditioned and
//! valid all the same.

use std::cell::OnceCell;

use super::{Compiled, CompiledMethod, Plan, Program, regression};
use crate::mechanics::equations::{Argument, Input, Method};
use crate::mechanics::plain::{ForwardDynamicsDerivatives, Oracle, Rows, total_mass};
use crate::model::Model;
use crate::spatial::Random;
use crate::symbolic::Evaluator;

/// How far a program may be off, relative to the size of what it computes: both roads round, each operation
/// by 1.1e-16; a formula that is wrong is off by the size of the robot's numbers.
const TOLERANCE: f64 = 1e-9;
/// How many states are tried.
const STATES: u64 = 2;

/// A method whose program does not compute what it should.
#[derive(Clone, Debug, PartialEq)]
pub struct Disagreement {
    /// The method.
    pub method: Method,
    /// The largest error, relative to the size of the result.
    pub error: f64,
}

/// The methods whose programs disagree with the plain recursion. Where the sample values of the parameters
/// make the robot itself undefined, as in `1/(a − b)` at `a = b`, there is nothing to compare.
pub fn disagreements(model: &Model<'_>, compiled: &Compiled<'_>) -> Vec<Disagreement> {
    let mut found: Vec<Disagreement> = Vec::new();
    for state in 0..STATES {
        let sample = Sample::of(model, compiled, state);
        if !sample.is_defined() {
            continue;
        }
        for CompiledMethod { method, plan, .. } in &compiled.methods {
            let error = match plan {
                Plan::StraightLine { program, .. } => sample.error(*method, program, model, compiled),
                // What the run time makes of other methods is right if they are.
                Plan::Loops { .. } | Plan::Table { .. } => continue,
            };
            let known = found.iter().any(|known| known.method == *method);
            if !(error <= TOLERANCE || known) {
                found.push(Disagreement { method: *method, error });
            }
        }
    }
    found
}

/// A robot in numbers at a state.
struct Sample {
    tree: crate::model::Tree<f64>,
    parameters: Vec<f64>,
    fields: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    a: Vec<f64>,
    tau: Vec<f64>,
    mass_matrix: Rows,
    /// The largest entry of the mass matrix: the size of what acts at speeds of one.
    inertia: f64,
    /// Computed when first asked for.
    coriolis_matrix: OnceCell<Rows>,
    acceleration: OnceCell<Option<Vec<f64>>>,
}

impl Sample {
    fn of(model: &Model<'_>, compiled: &Compiled<'_>, seed: u64) -> Self {
        let parameters: Vec<f64> = model.parameters.iter().map(|parameter| parameter.sample).collect();
        let value = |symbol: crate::symbolic::SymbolId| parameters[symbol.0 as usize];
        let mut evaluator = Evaluator::new(compiled.graph, value);
        let tree = model.tree.map(|expr| evaluator.value(expr));
        let mut random = Random(seed + 1);
        let mut vector = |size: usize| (0..size).map(|_| random.next()).collect::<Vec<f64>>();
        let n = model.tree.dof();
        let (mut q, v, a, tau) = (vector(model.tree.coordinates()), vector(n), vector(n), vector(n));
        tree.normalise(&mut q);
        let fields = compiled
            .companion
            .preparation
            .evaluate(|input| read(input, &parameters, [&[], &[], &[], &[]]), &[]);
        let mass_matrix = Oracle::new(&tree).mass_matrix(&q);
        let inertia = largest(&mass_matrix.concat());
        let (coriolis_matrix, acceleration) = (OnceCell::new(), OnceCell::new());
        Self { tree, parameters, fields, q, v, a, tau, mass_matrix, inertia, coriolis_matrix, acceleration }
    }

    fn is_defined(&self) -> bool {
        let oracle = Oracle::new(&self.tree);
        let torque = oracle.inverse_dynamics(&self.q, &self.v, &self.a);
        torque.iter().all(|x| x.is_finite()) && self.inertia.is_finite()
    }

    fn run(&self, program: &Program) -> Vec<f64> {
        let vectors = [self.q.as_slice(), &self.v, &self.a, &self.tau];
        program.evaluate(|input| read(input, &self.parameters, vectors), &self.fields)
    }

    fn coriolis_matrix(&self) -> &Rows {
        self.coriolis_matrix.get_or_init(|| Oracle::new(&self.tree).coriolis_matrix(&self.q, &self.v))
    }

    /// Forward dynamics, if the mass matrix is positive definite in doubles.
    fn acceleration(&self) -> Option<&Vec<f64>> {
        let Self { q, v, tau, .. } = self;
        self.acceleration.get_or_init(|| Oracle::new(&self.tree).forward_dynamics(q, v, tau)).as_ref()
    }

    /// How far the program is off.
    fn error(&self, method: Method, program: &Program, model: &Model<'_>, compiled: &Compiled<'_>) -> f64 {
        let Self { q, v, a, tau, tree, .. } = self;
        let oracle = Oracle::new(tree);
        let found = self.run(program);
        let inertia = self.inertia;
        let off = |expected: Vec<f64>| distance(&found, &expected, inertia);
        match method {
            Method::MassMatrix => off(self.mass_matrix.concat()),
            Method::CoriolisMatrix => off(self.coriolis_matrix().concat()),
            Method::GravityForces => off(oracle.gravity_forces(q)),
            Method::BiasForces => off(oracle.bias_forces(q, v)),
            Method::InverseDynamics => off(oracle.inverse_dynamics(q, v, a)),
            Method::PassiveForces => off(oracle.passive_forces(q, v)),
            Method::InverseMassMatrix => self.inverse_off(&found),
            Method::KineticEnergy => off(vec![oracle.kinetic_energy(q, v)]),
            Method::ElasticEnergy => off(vec![oracle.elastic_energy(q)]),
            Method::PotentialEnergy => off(vec![oracle.potential_energy(q)]),
            Method::Lagrangian => {
                let size = oracle.kinetic_energy(q, v).abs() + oracle.potential_energy(q).abs();
                distance(&found, &[oracle.lagrangian(q, v)], size)
            }
            Method::EquationsOfMotion => self.blocks_off(
                &found,
                inertia,
                &[self.mass_matrix.concat(), self.coriolis_matrix().concat(), oracle.gravity_forces(q)],
            ),
            Method::InverseDynamicsDerivatives => {
                let expected = oracle.inverse_dynamics_derivatives(q, v, a);
                self.blocks_off(
                    &found,
                    inertia,
                    &[expected.dtau_dq.concat(), expected.dtau_dv.concat(), expected.dtau_da.concat()],
                )
            }
            Method::InverseDynamicsWithDerivatives => {
                let expected = oracle.inverse_dynamics_derivatives(q, v, a);
                let derivatives = [expected.dtau_dq, expected.dtau_dv, expected.dtau_da];
                let [by_q, by_v, by_a] = derivatives.map(|block| block.concat());
                self.blocks_off(&found, inertia, &[oracle.inverse_dynamics(q, v, a), by_q, by_v, by_a])
            }
            Method::ForwardDynamics => match self.acceleration() {
                Some(_) => oracle.forward_dynamics_residual(q, v, tau, &found),
                None => 0.0,
            },
            Method::ForwardDynamicsWithDerivatives => match self.acceleration() {
                Some(_) => {
                    let (value, found) = found.split_at(v.len());
                    larger(
                        oracle.forward_dynamics_residual(q, v, tau, value),
                        self.derivatives_off(value, found),
                    )
                }
                None => 0.0,
            },
            Method::ForwardDynamicsDerivatives => match self.acceleration() {
                Some(a) => match self.derivatives_off(a, &found) {
                    off if off <= TOLERANCE => off,
                    off => self.own_acceleration(compiled).map_or(off, |a| self.derivatives_off(&a, &found)),
                },
                None => 0.0,
            },
            Method::CenterOfMass => off(oracle.center_of_mass(q)),
            Method::CenterOfMassJacobian => {
                distance(&found, &oracle.center_of_mass_jacobian(q).concat(), 1.0)
            }
            Method::CentroidalMomentum => off(oracle.centroidal_momentum(q, v)),
            Method::CentroidalMomentumMatrix => off(oracle.centroidal_momentum_matrix(q).concat()),
            Method::TotalMass => off(vec![total_mass(tree)]),
            Method::Regressor => regression::regressor_off(&found, model, tree, [q, v, a]),
            Method::InertialParameters => off(regression::parameters(model, tree)),
            Method::BaseRegressor => match compiled.program(Method::BaseParameters) {
                Some(parameters) => {
                    let forces = regression::product(&found, &self.run(parameters));
                    distance(&forces, &oracle.inverse_dynamics(q, v, a), inertia)
                }
                None => 0.0,
            },
            // Those that the regressor is checked with.
            Method::BaseParameters => 0.0,
            Method::Pose(frame) => {
                let pose = oracle.pose(frame, q);
                off([pose.rotation.0.concat(), pose.translation.0.to_vec()].concat())
            }
            Method::Jacobian(frame) => distance(&found, &oracle.body_jacobian(frame, q).concat(), 1.0),
            Method::WorldJacobian(frame) => distance(&found, &oracle.world_jacobian(frame, q).concat(), 1.0),
            Method::Velocity(frame) => distance(&found, &oracle.velocity(frame, q, v), 1.0),
            Method::Acceleration(frame) => distance(&found, &oracle.acceleration(frame, q, v, a), 1.0),
        }
    }

    /// How far a claimed `M⁻¹` misses `M·M⁻¹ = 1`, over `‖|M||M⁻¹|‖`.
    fn inverse_off(&self, found: &[f64]) -> f64 {
        let n = self.v.len();
        let inverse: Rows = found.chunks(n).map(<[f64]>::to_vec).collect();
        Oracle::new(&self.tree).inverse_mass_matrix_residual(&self.q, &inverse)
    }

    fn blocks_off(&self, found: &[f64], size: f64, expected: &[Vec<f64>]) -> f64 {
        let mut rest = found;
        let mut worst = 0.0_f64;
        for block in expected {
            let (head, tail) = rest.split_at(block.len());
            worst = larger(worst, distance(head, block, size));
            rest = tail;
        }
        worst
    }

    /// The acceleration that the robot's own programs have, if it is one. Derivatives are those at the acceleration that the
    /// program went through: of a mass matrix that is ill-conditioned no two roads come to the same one.
    fn own_acceleration(&self, compiled: &Compiled<'_>) -> Option<Vec<f64>> {
        let Self { tree, q, v, tau, .. } = self;
        let methods = [Method::ForwardDynamicsWithDerivatives, Method::ForwardDynamics];
        let program = methods.into_iter().find_map(|method| compiled.program(method))?;
        let mut a = self.run(program);
        a.truncate(v.len());
        (Oracle::new(tree).forward_dynamics_residual(q, v, tau, &a) <= TOLERANCE).then_some(a)
    }

    /// How far claimed derivatives of forward dynamics are off at the acceleration `a`.
    fn derivatives_off(&self, a: &[f64], found: &[f64]) -> f64 {
        let n = self.v.len();
        let rows = |block: usize| -> Rows {
            found[block * n * n..][..n * n].chunks(n).map(<[f64]>::to_vec).collect()
        };
        let claimed = ForwardDynamicsDerivatives { da_dq: rows(0), da_dv: rows(1), da_dtau: rows(2) };
        Oracle::new(&self.tree).forward_dynamics_derivatives_residual(&self.q, &self.v, a, &claimed)
    }
}

fn read(input: Input, parameters: &[f64], vectors: [&[f64]; 4]) -> f64 {
    match input {
        Input::Parameter(k) => parameters[k],
        Input::Argument(argument, k) => {
            vectors[Argument::ALL.iter().position(|&x| x == argument).unwrap_or(0)][k]
        }
    }
}

/// The largest difference, over the size of the expected numbers and `size`.
pub(super) fn distance(found: &[f64], expected: &[f64], size: f64) -> f64 {
    let differences: Vec<f64> = found.iter().zip(expected).map(|(x, y)| x - y).collect();
    let missed = largest(&differences);
    if missed == 0.0 { 0.0 } else { missed / (largest(expected) + size) }
}

/// The largest magnitude; NaN if there is one.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |worst, value| larger(worst, value.abs()))
}

fn larger(a: f64, b: f64) -> f64 {
    if b.is_nan() || b > a { b } else { a }
}
