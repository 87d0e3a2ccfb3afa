//! `dynamics eval FILE --state …`: the equations of motion at a state, as JSON.

use dynamics_codegen::mechanics::equations::Method;
use dynamics_codegen::symbolic::Graph;
use serde_json::json;

use crate::failure::Failure;
use crate::input::InputArgs;
use crate::output::print;
use crate::robot::{Robot, State, Wanted, rows};
use crate::state;

/// Evaluate the equations of motion at a state, as JSON
#[derive(clap::Args)]
#[command(after_help = HELP)]
pub(crate) struct Args {
    #[command(flatten)]
    input: InputArgs,

    /// JSON with `q`, `v`, `a` and `tau`, or `@` and the path of a file; what is not given is zero
    #[arg(long, value_name = "JSON", default_value = "{}", hide_default_value = true)]
    state: String,
}

const HELP: &str = "\
Output:
  joints                     the order of all vectors; in q a free joint has x, y, z, i, j, k, w, and in v
                             six entries, linear first
  M, C, G, h                 M(q), C(q,v), G(q), h = C·v + G + passive joint forces
  tau                        M·a + h, at the `a` of the state
  a                          M⁻¹·(tau − h), at the `tau` of the state
  kinetic_energy, potential_energy
  dtau_dq, dtau_dv           of `tau` above; ∂tau/∂a is M
  da_dq, da_dv, da_dtau      of `a` above

Examples:
  dynamics eval arm.urdf --state '{\"q\": [0.1, 0.2], \"v\": [1, 0]}'
  dynamics eval arm.urdf --state @state.json";

const METHODS: [Method; 10] = [
    Method::MassMatrix,
    Method::CoriolisMatrix,
    Method::GravityForces,
    Method::BiasForces,
    Method::InverseDynamics,
    Method::ForwardDynamics,
    Method::KineticEnergy,
    Method::PotentialEnergy,
    Method::InverseDynamicsDerivatives,
    Method::ForwardDynamicsDerivatives,
];

/// Runs the command.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let input = args.input.read()?;
    let graph = Graph::new();
    let robot = Robot::of(&input, &graph, Wanted::Only(&METHODS))?;
    let state = state::read(&args.state, &args.input.file, &robot.read.model)?;
    print(&evaluated(&robot, &state)?)
}

fn evaluated(robot: &Robot<'_>, state: &State) -> Result<String, Failure> {
    let n = robot.dof();
    let value = |method| robot.evaluate(method, state);
    let inverse = value(Method::InverseDynamicsDerivatives)?;
    let forward = value(Method::ForwardDynamicsDerivatives)?;
    let names: Vec<&str> = robot.read.model.joints.iter().map(|joint| joint.name.as_str()).collect();
    let block = |all: &[f64], k: usize| matrix(&all[k * n * n..][..n * n], n);
    let entries = [
        ("joints", json!(names).to_string()),
        ("M", matrix(&value(Method::MassMatrix)?, n)),
        ("C", matrix(&value(Method::CoriolisMatrix)?, n)),
        ("G", json!(value(Method::GravityForces)?).to_string()),
        ("h", json!(value(Method::BiasForces)?).to_string()),
        ("tau", json!(value(Method::InverseDynamics)?).to_string()),
        ("a", json!(value(Method::ForwardDynamics)?).to_string()),
        ("kinetic_energy", json!(value(Method::KineticEnergy)?[0]).to_string()),
        ("potential_energy", json!(value(Method::PotentialEnergy)?[0]).to_string()),
        ("dtau_dq", block(&inverse, 0)),
        ("dtau_dv", block(&inverse, 1)),
        ("da_dq", block(&forward, 0)),
        ("da_dv", block(&forward, 1)),
        ("da_dtau", block(&forward, 2)),
    ];
    let lines: Vec<String> = entries.iter().map(|(key, value)| format!("  \"{key}\": {value}")).collect();
    Ok(format!("{{\n{}\n}}\n", lines.join(",\n")))
}

/// A matrix, one row a line.
fn matrix(entries: &[f64], n: usize) -> String {
    let lines: Vec<String> = rows(entries, n).iter().map(|row| format!("    {}", json!(row))).collect();
    format!("[\n{}\n  ]", lines.join(",\n"))
}
