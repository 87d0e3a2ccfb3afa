//! A robot that can be asked for numbers: its programs, run by the interpreter.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_codegen::mechanics::equations::{Argument, Input as Symbol, Method};
use dynamics_codegen::mechanics::plain::{Cholesky, Oracle, Rows, total_mass};
use dynamics_codegen::model::{Model, Tree};
use dynamics_codegen::passes::{Compiled, Lack, Plan, RunTime, lacks};
use dynamics_codegen::spec::urdf::Report;
use dynamics_codegen::spec::{Name, RobotSpec};
use dynamics_codegen::symbolic::{Evaluator, Graph};
use dynamics_codegen::{checked, judged};
use proc_macro2::Span;

use crate::absence::{Absence, Absent};
use crate::coordinates::Coordinates;
use crate::failure::Failure;
use crate::fields::unless_known;
use crate::input::Input;
use crate::progress::Progress;

/// The name of a URDF's struct where nobody will see it.
pub(crate) const NAME: &str = "Robot";

/// A robot that was read, judged and compiled.
pub(crate) struct Robot<'g> {
    /// As written.
    pub(crate) spec: RobotSpec,
    /// What became of the file.
    pub(crate) report: Report,
    /// As judged.
    pub(crate) model: Model<'g>,
    /// In doubles, for the plain recursions; not of numbers where it depends on fields.
    pub(crate) tree: Tree<f64>,
    /// What its coordinates and speeds are called.
    pub(crate) coordinates: Coordinates,
    /// The programs.
    pub(crate) compiled: Compiled<'g>,
}

/// What is compiled of a robot.
#[derive(Clone, Copy)]
pub(crate) enum Wanted<'a> {
    /// These methods, as far as it can have them.
    Only(&'a [Method]),
    /// The methods of robots that this one can have, and those that its struct asks for.
    Possible,
    /// All methods, those of its frames too.
    All,
}

/// Where a robot is, how it moves, and what acts on it.
#[derive(Clone, Debug)]
pub(crate) struct State {
    /// Coordinates.
    pub(crate) q: Vec<f64>,
    /// Speeds.
    pub(crate) v: Vec<f64>,
    /// Accelerations.
    pub(crate) a: Vec<f64>,
    /// Joint forces.
    pub(crate) tau: Vec<f64>,
}

impl<'g> Robot<'g> {
    /// Reads, judges and compiles a robot, for what computes: every field has a value.
    pub(crate) fn of(input: &Input, graph: &'g Graph, wanted: Wanted<'_>) -> Result<Self, Failure> {
        let robot = Self::with_fields(input, graph, wanted, &[])?;
        unless_known(&robot.model, |_| false)?;
        Ok(robot)
    }

    /// [`of`](Self::of), where fields need no values; of a file that has none, `fields` are names that options may use.
    pub(crate) fn with_fields(
        input: &Input,
        graph: &'g Graph,
        wanted: Wanted<'_>,
        fields: &[&str],
    ) -> Result<Self, Failure> {
        let _progress = Progress::of(&format!("compiling {}", input.name));
        let wrong = |found| Failure::mistakes(found, input);
        let (mut spec, report) = input.spec(fields)?;
        match wanted {
            Wanted::Only(methods) => spec.options.outputs = Some(names(&had(methods, &spec, input)?)),
            Wanted::Possible => spec.options.outputs = Some(possible(&spec, input)?),
            Wanted::All => {}
        }
        let (model, compiled) = checked(&spec, graph, RunTime::Core).map_err(wrong)?;
        // What depends on fields is asked of programs alone.
        let mut evaluator = Evaluator::new(graph, |_| f64::NAN);
        let tree = model.tree.map(|expr| evaluator.value(expr));
        let coordinates = Coordinates::of(&model);
        Ok(Self { spec, report, model, tree, coordinates, compiled })
    }

    /// Degrees of freedom.
    pub(crate) fn dof(&self) -> usize {
        self.tree.dof()
    }

    /// What a method returns, all entries in order, by rows; finite numbers.
    pub(crate) fn evaluate(&self, method: Method, state: &State) -> Result<Vec<f64>, Absent> {
        if !self.has(method) {
            return Err(Absent { method, why: Absence::of_method(method, self) });
        }
        match self.compute(method, state) {
            // No negative zeros.
            Some(values) if values.iter().all(|value| value.is_finite()) => {
                Ok(values.into_iter().map(|value| value + 0.0).collect())
            }
            _ => Err(Absent { method, why: Absence::of(method, state, self) }),
        }
    }

    /// Fails where the robot has no acceleration, or rounding alone gives it one.
    pub(crate) fn moves(&self, state: &State) -> Result<(), Absence> {
        match Absence::of_inverse(self, &self.tree, state) {
            Some(why) => Err(why),
            None => self.evaluate(Method::ForwardDynamics, state).map(drop).map_err(|absent| absent.why),
        }
    }

    fn compute(&self, method: Method, state: &State) -> Option<Vec<f64>> {
        match self.plan(method)? {
            Plan::StraightLine { program, .. } => Some(program.evaluate(|symbol| state.read(symbol), &[])),
            Plan::Loops { .. } if method == Method::ForwardDynamicsDerivatives => {
                self.derivatives_from_inverse(state)
            }
            Plan::Loops { .. } | Plan::Table { .. } => self.plain(method, state),
        }
    }

    /// Whether there is a program.
    pub(crate) fn has(&self, method: Method) -> bool {
        self.plan(method).is_some()
    }

    fn plan(&self, method: Method) -> Option<&Plan<'g>> {
        self.compiled.methods.iter().find(|compiled| compiled.method == method).map(|found| &found.plan)
    }

    /// `∂a/∂q = −M⁻¹ ∂τ/∂q`, `∂a/∂v = −M⁻¹ ∂τ/∂v`, `∂a/∂τ = M⁻¹`, at the acceleration that `τ` gives.
    fn derivatives_from_inverse(&self, state: &State) -> Option<Vec<f64>> {
        let n = self.dof();
        let a = self.compute(Method::ForwardDynamics, state)?;
        let inverse = self.compute(Method::InverseDynamicsDerivatives, &State { a, ..state.clone() })?;
        let [by_q, by_v, M] = [0, 1, 2].map(|block| rows(&inverse[block * n * n..][..n * n], n));
        let unit: Rows = (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect();
        let factor = Cholesky::of(&M)?;
        let negative =
            |rows: Rows| rows.into_iter().map(|row| row.into_iter().map(|x| -x).collect()).collect();
        let [by_q, by_v]: [Rows; 2] = [by_q, by_v].map(negative);
        Some([by_q, by_v, unit].iter().flat_map(|B| factor.solve_columns(B).concat()).collect())
    }

    /// What is too long for a straight line, by the plain recursion.
    fn plain(&self, method: Method, state: &State) -> Option<Vec<f64>> {
        let (oracle, State { q, v, a, tau }) = (Oracle::new(&self.tree), state);
        Some(match method {
            Method::MassMatrix => oracle.mass_matrix(q).concat(),
            Method::InverseMassMatrix => {
                let identity =
                    (0..v.len()).map(|i| (0..v.len()).map(|j| f64::from(u8::from(i == j))).collect());
                Cholesky::of(&oracle.mass_matrix(q))?.solve_columns(&identity.collect::<Rows>()).concat()
            }
            Method::PassiveForces => oracle.passive_forces(q, v),
            Method::ElasticEnergy => vec![oracle.elastic_energy(q)],
            Method::TotalMass => vec![total_mass(&self.tree)],
            Method::CenterOfMass => oracle.center_of_mass(q),
            Method::CenterOfMassJacobian => oracle.center_of_mass_jacobian(q).concat(),
            Method::CentroidalMomentum => oracle.centroidal_momentum(q, v),
            Method::CentroidalMomentumMatrix => oracle.centroidal_momentum_matrix(q).concat(),
            Method::CoriolisMatrix => oracle.coriolis_matrix(q, v).concat(),
            Method::GravityForces => oracle.gravity_forces(q),
            Method::BiasForces => oracle.bias_forces(q, v),
            Method::InverseDynamics => oracle.inverse_dynamics(q, v, a),
            Method::ForwardDynamics => oracle.forward_dynamics(q, v, tau)?,
            Method::KineticEnergy => vec![oracle.kinetic_energy(q, v)],
            Method::PotentialEnergy => vec![oracle.potential_energy(q)],
            Method::Lagrangian => vec![oracle.lagrangian(q, v)],
            Method::InverseDynamicsDerivatives => {
                let found = oracle.inverse_dynamics_derivatives(q, v, a);
                [found.dtau_dq, found.dtau_dv, found.dtau_da].concat().concat()
            }
            Method::ForwardDynamicsDerivatives => {
                let found = oracle.forward_dynamics_derivatives(q, v, tau)?;
                [found.da_dq, found.da_dv, found.da_dtau].concat().concat()
            }
            Method::Pose(frame) => {
                let pose = oracle.pose(frame, q);
                [pose.rotation.0.concat(), pose.translation.0.to_vec()].concat()
            }
            Method::Jacobian(frame) => oracle.body_jacobian(frame, q).concat(),
            Method::WorldJacobian(frame) => oracle.world_jacobian(frame, q).concat(),
            Method::Velocity(frame) => oracle.velocity(frame, q, v),
            Method::Acceleration(frame) => oracle.acceleration(frame, q, v, a),
            Method::EquationsOfMotion
            | Method::InverseDynamicsWithDerivatives
            | Method::ForwardDynamicsWithDerivatives
            | Method::Regressor
            | Method::InertialParameters
            | Method::BaseRegressor
            | Method::BaseParameters => return None,
        })
    }
}

fn names(methods: &[Method]) -> Vec<Name> {
    let name = |method: &Method| Name { text: method.name().to_owned(), place: Span::call_site().into() };
    methods.iter().map(name).collect()
}

/// Those of these methods that terms leave to a robot: it would be refused for asking for others.
fn had(methods: &[Method], spec: &RobotSpec, input: &Input) -> Result<Vec<Method>, Failure> {
    if spec.terms.is_empty() {
        return Ok(methods.to_vec());
    }
    let graph = Graph::new();
    let model = judged(spec, &graph).map_err(|found| Failure::mistakes(found, input))?;
    let lacks = lacks(&model, RunTime::Core);
    let is_had = |method: &&Method| !lacks.contains(&(**method, Lack::LoopsWithoutTerms));
    Ok(methods.iter().filter(is_had).copied().collect())
}

/// The methods that a robot can have, and those that its struct asks for, so that it is refused where the derive refuses it.
fn possible(spec: &RobotSpec, input: &Input) -> Result<Vec<Name>, Failure> {
    let methods = had(&Method::OF_ROBOT, spec, input)?;
    let is_of_robot = |name: &&Name| Method::OF_ROBOT.iter().any(|method| method.name() == name.text);
    let asked = match (input.item(), &spec.options.outputs) {
        (None, _) => vec![],
        (Some(_), Some(written)) => written.iter().filter(is_of_robot).cloned().collect(),
        (Some(_), None) => names(&Method::OF_ROBOT),
    };
    Ok([names(&methods), asked].concat())
}

impl State {
    /// At rest and free of forces, with all coordinates zero but those of quaternions, which are no rotations.
    pub(crate) fn neutral(robot: &Robot<'_>) -> Self {
        let mut q = vec![0.0; robot.tree.coordinates()];
        robot.tree.normalise(&mut q);
        let zeros = vec![0.0; robot.dof()];
        Self { q, v: zeros.clone(), a: zeros.clone(), tau: zeros }
    }

    fn read(&self, symbol: Symbol) -> f64 {
        match symbol {
            // Who asks for numbers has none.
            Symbol::Parameter(_) => f64::NAN,
            Symbol::Argument(Argument::Q, k) => self.q[k],
            Symbol::Argument(Argument::V, k) => self.v[k],
            Symbol::Argument(Argument::A, k) => self.a[k],
            Symbol::Argument(Argument::Tau, k) => self.tau[k],
        }
    }
}

/// A matrix of `n` columns.
pub(crate) fn rows(entries: &[f64], n: usize) -> Rows {
    entries.chunks(n.max(1)).map(<[f64]>::to_vec).collect()
}
