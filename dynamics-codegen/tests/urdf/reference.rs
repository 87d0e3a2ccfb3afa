//! The published robots, from their files through the interpreted programs, agree with Pinocchio.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use std::path::PathBuf;

use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::mechanics::equations::{Argument, Input, Method};
use dynamics_codegen::model::{self, Model};
use dynamics_codegen::passes::{self, Compiled, Plan, Program, RunTime};
use dynamics_codegen::spec::urdf::Urdf;
use dynamics_codegen::spec::{self, RobotSpec};
use dynamics_codegen::symbolic::Graph;
use serde_json::Value;

/// Two roads in doubles.
const ROUNDING: f64 = 1e-12;
/// Derivatives carry larger terms that cancel.
const DERIVATIVES: f64 = 1e-9;

const ROBOTS: &[(&str, &str)] = &[
    ("puma560", "allow(nonphysical_inertia)"),
    ("puma560_armature", "allow(nonphysical_inertia)"),
    ("hyq", "base = free"),
    ("iiwa14", ""),
    ("scara", ""),
    ("cartpole", ""),
    ("double_pendulum", ""),
    ("double_pendulum_continuous", ""),
];

fn file(robot: &str, name: &str) -> String {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tests/robots").join(robot).join(name);
    std::fs::read_to_string(&root).unwrap_or_else(|error| panic!("{}: {error}", root.display()))
}

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        value => vec![value.as_f64().unwrap()],
    }
}

/// A robot's programs at a state whose vectors are in the order of the robot's coordinates.
struct Run<'a> {
    robot: &'a str,
    compiled: &'a Compiled<'a>,
    /// For each coordinate and for each speed, its place in the reference.
    order: &'a [Vec<usize>; 2],
    state: &'a Value,
}

impl Run<'_> {
    fn vector(&self, name: &str) -> Vec<f64> {
        let values = numbers(&self.state[name]);
        self.order[usize::from(name != "q")].iter().map(|&k| values[k]).collect()
    }

    fn matrix(&self, name: &str) -> Vec<f64> {
        let rows = self.state[name].as_array().unwrap();
        let order = &self.order[1];
        order.iter().flat_map(|&i| order.iter().map(move |&j| rows[i][j].as_f64().unwrap())).collect()
    }

    fn program(&self, method: Method) -> Option<&Program> {
        let found = self.compiled.methods.iter().find(|compiled| compiled.method == method);
        match &found.unwrap().plan {
            Plan::StraightLine { program, .. } => Some(program),
            _ => None,
        }
    }

    fn evaluate(&self, method: Method) -> Vec<f64> {
        let [q, v, a, tau] = ["q", "v", if method == Method::ForwardDynamics { "v" } else { "a" }, "tau2"]
            .map(|name| self.vector(name));
        let read = |input| match input {
            Input::Parameter(_) => unreachable!("a file has no parameters"),
            Input::Argument(Argument::Q, k) => q[k],
            Input::Argument(Argument::V, k) => v[k],
            Input::Argument(Argument::A, k) => a[k],
            Input::Argument(Argument::Tau, k) => tau[k],
        };
        let program = self.program(method).unwrap_or_else(|| panic!("{method:?} has no program"));
        program.evaluate(read, &[])
    }

    fn close(&self, found: &[f64], expected: &[f64], tolerance: f64, floor: f64, what: &str) {
        let size = expected.iter().fold(floor, |size: f64, x| size.max(x.abs()));
        assert_eq!(found.len(), expected.len(), "{}: {what}", self.robot);
        for (found, expected) in found.iter().zip(expected) {
            let off = (found - expected).abs();
            assert!(off <= tolerance * size, "{}: {what} is off by {off:e} of {size:e}", self.robot);
        }
    }

    fn check(&self) {
        let (M, Minv) = (self.matrix("M"), self.matrix("Minv"));
        let (mass, inverse) = (largest(&M), largest(&Minv));
        let n = self.order[1].len();
        let blocks = |method: Method| -> [Vec<f64>; 3] {
            let found = self.evaluate(method);
            [0, 1, 2].map(|k| found[k * n * n..][..n * n].to_vec())
        };
        self.close(&self.evaluate(Method::MassMatrix), &M, ROUNDING, 0.0, "M");
        self.close(&self.evaluate(Method::CoriolisMatrix), &self.matrix("C"), ROUNDING, 0.0, "C");
        self.close(&self.evaluate(Method::GravityForces), &self.vector("g"), ROUNDING, 0.0, "G");
        self.close(&self.evaluate(Method::InverseDynamics), &self.vector("tau"), ROUNDING, 0.0, "τ");
        // Solving with M multiplies rounding by its condition.
        let solved = ROUNDING.max(f64::EPSILON * mass * inverse * n as f64);
        self.close(&self.evaluate(Method::ForwardDynamics), &self.vector("a_fd"), solved, 0.0, "a");
        let kinetic = self.state["kinetic_energy"].as_f64().unwrap();
        self.close(&self.evaluate(Method::KineticEnergy), &[kinetic], ROUNDING, 0.0, "T");

        let [dq, dv, da] = blocks(Method::InverseDynamicsDerivatives);
        self.close(&dq, &self.matrix("dtau_dq"), DERIVATIVES, mass, "∂τ/∂q");
        self.close(&dv, &self.matrix("dtau_dv"), DERIVATIVES, mass, "∂τ/∂v");
        self.close(&da, &M, ROUNDING, 0.0, "∂τ/∂a");
        // Where these have no program, the run time makes them from those of the inverse.
        if self.program(Method::ForwardDynamicsDerivatives).is_none() {
            return;
        }
        let [dq, dv, dtau] = blocks(Method::ForwardDynamicsDerivatives);
        self.close(&dq, &self.matrix("da_dq"), DERIVATIVES, inverse * mass, "∂a/∂q");
        self.close(&dv, &self.matrix("da_dv"), DERIVATIVES, inverse * mass, "∂a/∂v");
        self.close(&dtau, &Minv, DERIVATIVES, 0.0, "∂a/∂τ");
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size: f64, x| size.max(x.abs()))
}

/// For each coordinate and for each speed of the model, its place in the reference, which has the joints in another
/// order.
fn order(model: &Model<'_>, reference: &Value) -> [Vec<usize>; 2] {
    let (mut places, mut next) = (vec![], [0, 0]);
    for joint in reference["joints"].as_array().unwrap() {
        let found = model.joints.iter().find(|own| own.name == joint["name"]).unwrap();
        places.push((found, next));
        next = [next[0] + found.q.len(), next[1] + found.v.len()];
    }
    assert_eq!(places.len(), model.joints.len());
    places.sort_by_key(|(joint, _)| joint.v.start);
    let (q, v): (Vec<_>, Vec<_>) =
        places.iter().map(|(joint, [q, v])| (*q..q + joint.q.len(), *v..v + joint.v.len())).unzip();
    [q, v].map(|ranges| ranges.into_iter().flatten().collect())
}

/// The robot of a file, with the rotors that the reference has and a URDF has no word for.
fn read(robot: &str, options: &str, text: &str, reference: &Value) -> RobotSpec {
    let joints = reference["joints"].as_array().unwrap().iter();
    let rotors = numbers(&reference["armature"]);
    let moved =
        joints.map(|joint| (joint["name"].as_str().unwrap(), joint["idx_v"].as_u64().unwrap() as usize));
    let moved = moved.filter(|(_, v)| rotors[*v] != 0.0);
    let lines: String =
        moved.map(|(name, v)| format!("#[joint({name}, armature = {})] ", rotors[v])).collect();
    let input = syn::parse_str(&format!("#[dynamics({options})] {lines} struct Robot;")).unwrap();
    let mut diags = Diagnostics::new();
    let mut spec = spec::parse(&input, &mut diags);
    spec::urdf::read(&mut spec, Urdf { file: robot, text }, &mut diags);
    assert!(diags.is_empty(), "{robot}: {}", diags.into_text());
    spec
}

#[test]
fn files_give_the_numbers_of_pinocchio() {
    for &(robot, options) in ROBOTS {
        let (text, reference) = (file(robot, "model.urdf"), file(robot, "reference.json"));
        let reference: Value = serde_json::from_str(&reference).unwrap();
        let spec = read(robot, options, &text, &reference);
        let (graph, mut diags) = (Graph::new(), Diagnostics::new());
        let model = model::build(&spec, &graph, &mut diags);
        assert!(diags.is_empty(), "{robot}: {}", diags.into_text());
        let model = model.unwrap();
        let compiled =
            passes::compile(&model, &graph, &passes::methods(None, &model, RunTime::Core), RunTime::Core);
        assert!(passes::disagreements(&model, &compiled).is_empty(), "{robot}");
        let order = order(&model, &reference);
        let states = reference["states"].as_array().unwrap();
        let runs: Vec<Run<'_>> =
            states.iter().map(|state| Run { robot, compiled: &compiled, order: &order, state }).collect();
        runs.iter().for_each(Run::check);

        // Energies of position agree up to a constant.
        let offsets = runs.iter().map(|run| {
            run.evaluate(Method::PotentialEnergy)[0] - run.state["potential_energy"].as_f64().unwrap()
        });
        let offsets: Vec<f64> = offsets.collect();
        let size = largest(
            &states.iter().map(|state| state["potential_energy"].as_f64().unwrap()).collect::<Vec<_>>(),
        );
        assert!(
            offsets.iter().all(|offset| (offset - offsets[0]).abs() <= ROUNDING * size.max(1.0)),
            "{robot}: V"
        );
    }
}
