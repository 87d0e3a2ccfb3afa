//! The published robots, from their files through the interpreted programs, agree with Pinocchio.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use std::path::PathBuf;

use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::mechanics::equations::{Argument, Input, Method};
use dynamics_codegen::model::{self, Model};
use dynamics_codegen::passes::{self, Compiled, Plan};
use dynamics_codegen::read_urdf;
use dynamics_codegen::spec::urdf::Urdf;
use dynamics_codegen::symbolic::Graph;
use serde_json::Value;

/// Two roads in doubles.
const ROUNDING: f64 = 1e-12;
/// Derivatives carry larger terms that cancel.
const DERIVATIVES: f64 = 1e-9;

const ROBOTS: &[(&str, &str)] = &[
    ("puma560", "allow(nonphysical_inertia)"),
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
    /// For each coordinate, its place in the reference.
    order: &'a [usize],
    state: &'a Value,
}

impl Run<'_> {
    fn vector(&self, name: &str) -> Vec<f64> {
        let values = numbers(&self.state[name]);
        self.order.iter().map(|&k| values[k]).collect()
    }

    fn matrix(&self, name: &str) -> Vec<f64> {
        let rows = self.state[name].as_array().unwrap();
        self.order
            .iter()
            .flat_map(|&i| self.order.iter().map(move |&j| rows[i][j].as_f64().unwrap()))
            .collect()
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
        let found = self.compiled.methods.iter().find(|compiled| compiled.method == method);
        let Plan::StraightLine { program, .. } = &found.unwrap().plan else {
            panic!("{method:?} has no program")
        };
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
        let n = self.order.len();
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
        let [dq, dv, dtau] = blocks(Method::ForwardDynamicsDerivatives);
        self.close(&dq, &self.matrix("da_dq"), DERIVATIVES, inverse * mass, "∂a/∂q");
        self.close(&dv, &self.matrix("da_dv"), DERIVATIVES, inverse * mass, "∂a/∂v");
        self.close(&dtau, &Minv, DERIVATIVES, 0.0, "∂a/∂τ");
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size: f64, x| size.max(x.abs()))
}

/// For each coordinate of the model, the joint of that name in the reference.
fn order(model: &Model<'_>, reference: &Value) -> Vec<usize> {
    let names: Vec<&str> =
        reference["joints"].as_array().unwrap().iter().map(|joint| joint["name"].as_str().unwrap()).collect();
    let found = model.joints.iter().map(|joint| names.iter().position(|name| *name == joint.name));
    let order: Vec<usize> = found.map(Option::unwrap).collect();
    assert_eq!(order.len(), names.len());
    order
}

#[test]
fn files_give_the_numbers_of_pinocchio() {
    for &(robot, options) in ROBOTS {
        let (text, reference) = (file(robot, "model.urdf"), file(robot, "reference.json"));
        let reference: Value = serde_json::from_str(&reference).unwrap();
        let read = read_urdf("Robot", Urdf { file: robot, text: &text }, options);
        let (spec, _) = read.unwrap_or_else(|wrong| panic!("{robot}: {}", wrong.into_text()));
        let (graph, mut diags) = (Graph::new(), Diagnostics::new());
        let model = model::build(&spec, &graph, &mut diags);
        assert!(diags.is_empty(), "{robot}: {}", diags.into_text());
        let model = model.unwrap();
        let compiled = passes::compile(&model, &graph, &passes::methods(None, &model));
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
