//! `dynamics eval FILE --state …`: the equations of motion at a state, as JSON.

use clap::builder::PossibleValuesParser;
use dynamics_codegen::diagnostics::did_you_mean;
use dynamics_codegen::mechanics::equations::Method;
use dynamics_codegen::symbolic::Graph;
use serde_json::json;

use crate::absence::{Absence, divides_by_mass};
use crate::failure::{Failure, Problem};
use crate::input::shown;
use crate::output::print;
use crate::progress::Progress;
use crate::reading::InputArgs;
use crate::robot::{Robot, State, Wanted, rows};
use crate::state;

/// Evaluate the equations of motion at a state, as JSON
#[derive(clap::Args)]
#[command(after_help = HELP)]
pub(crate) struct Args {
    #[command(flatten)]
    input: InputArgs,

    /// JSON with `q`, `v`, `a` and `tau`, or `@` and the path of a file; what is not given is zero, and quaternions
    /// are 0, 0, 0, 1
    #[arg(long, value_name = "JSON", default_value = "{}", hide_default_value = true)]
    state: String,

    /// The outputs, with commas between them, or `all`; without it, those marked by *
    #[arg(long, value_name = "KEYS", value_delimiter = ',', value_parser = keys(), hide_possible_values = true)]
    only: Vec<String>,

    /// The kinematics of a frame as well: the name of a link, or `*` for all
    #[arg(long = "frame", value_name = "NAME")]
    frames: Vec<String>,
}

const HELP: &str = "\
Output:
  joints                     those that move, in order
  coordinates, speeds        the order of q, and that of v, a, tau and every row and column
  M *, Minv *                M(q), M⁻¹(q)
  C *                        C(q,v), with Ṁ = C + Cᵀ
  G *                        G(q), of gravity
  passive *                  the forces of dampers, friction and springs
  h *                        C·v + G and the passive forces
  tau *                      M·a + h, at the `a` of the state
  a *                        M⁻¹·(tau − h), at the `tau` of the state
  kinetic_energy *, potential_energy *, elastic_energy *
                             of motion, of gravity, of springs, J
  mass *, com *, momentum *  of all that moves: kg; its centre, m; its momentum about that, linear first
  A                          the momentum is A·v
  com_jacobian               the velocity of the centre is com_jacobian·v
  dtau_dq, dtau_dv           of `tau` above, q along v's directions; ∂tau/∂a is M
  da_dq, da_dv               of `a` above; ∂a/∂tau is Minv
  Y, Y_base                  of tau = Y·pi, at the `a` of the state; with pi, or pi_base
  pi, pi_base                the parameters: all, and those that can be told apart; their names come before them, as
                             parameters and base_parameters
  frames                     of each --frame its pose in the world (rotation, translation), Jacobians in its own axes and
                             in the world's, and its velocity and acceleration in its own axes, linear first

Matrices are lists of rows. In a state, a vector is a list of numbers, or an object of some by their names; a text is a
number with its unit, \"30deg\", \"30deg / 1s\".

What has no value at the state is null: Minv and a where M(q) is singular, as that of a top which stands upright. An error
says why, and the exit status is 1; all else has its value.

Examples:
  dynamics eval arm.urdf --state '{\"q\": [0.1, 0.2], \"v\": [1, 0]}'
  dynamics eval arm.urdf --state @state.json --only M,tau,Y_base
  dynamics eval dog.urdf --base free --state '{\"q\": {\"root_joint.z\": 0.6, \"knee\": -1.2}}' --only com --frame foot";

/// An output of one robot: its key, and where it is found.
struct Output {
    key: &'static str,
    method: Method,
    form: Form,
    /// Whether it is written unless others are asked for.
    is_usual: bool,
}

/// What an output is.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    Number,
    Vector,
    /// All rows, of NV columns.
    Matrix,
    /// That of the method's square blocks which has this index.
    Block(usize),
    /// A matrix with a column for each parameter.
    ByParameter,
    /// The parameters: behind a vector of their names, under this key.
    Parameters(&'static str),
}

const fn usual(key: &'static str, method: Method, form: Form) -> Output {
    Output { key, method, form, is_usual: true }
}

const fn special(key: &'static str, method: Method, form: Form) -> Output {
    Output { key, method, form, is_usual: false }
}

const OUTPUTS: [Output; 24] = [
    usual("M", Method::MassMatrix, Form::Matrix),
    usual("Minv", Method::InverseMassMatrix, Form::Matrix),
    usual("C", Method::CoriolisMatrix, Form::Matrix),
    usual("G", Method::GravityForces, Form::Vector),
    usual("passive", Method::PassiveForces, Form::Vector),
    usual("h", Method::BiasForces, Form::Vector),
    usual("tau", Method::InverseDynamics, Form::Vector),
    usual("a", Method::ForwardDynamics, Form::Vector),
    usual("kinetic_energy", Method::KineticEnergy, Form::Number),
    usual("potential_energy", Method::PotentialEnergy, Form::Number),
    usual("elastic_energy", Method::ElasticEnergy, Form::Number),
    usual("mass", Method::TotalMass, Form::Number),
    usual("com", Method::CenterOfMass, Form::Vector),
    usual("momentum", Method::CentroidalMomentum, Form::Vector),
    special("A", Method::CentroidalMomentumMatrix, Form::Matrix),
    special("com_jacobian", Method::CenterOfMassJacobian, Form::Matrix),
    special("dtau_dq", Method::InverseDynamicsDerivatives, Form::Block(0)),
    special("dtau_dv", Method::InverseDynamicsDerivatives, Form::Block(1)),
    special("da_dq", Method::ForwardDynamicsDerivatives, Form::Block(0)),
    special("da_dv", Method::ForwardDynamicsDerivatives, Form::Block(1)),
    special("Y", Method::Regressor, Form::ByParameter),
    special("pi", Method::InertialParameters, Form::Parameters("parameters")),
    special("Y_base", Method::BaseRegressor, Form::ByParameter),
    special("pi_base", Method::BaseParameters, Form::Parameters("base_parameters")),
];

fn keys() -> PossibleValuesParser {
    PossibleValuesParser::new(OUTPUTS.iter().map(|output| output.key).chain(["all"]))
}

/// Runs the command.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let input = args.input.read()?;
    let graph = Graph::new();
    let mut outputs = selected(&args.only);
    let mut methods: Vec<Method> = outputs.iter().map(|output| output.method).collect();
    if !args.frames.is_empty() {
        methods.extend(Method::of_frame(0));
    }
    let robot = Robot::of(&input, &graph, Wanted::Only(&methods))?;
    input.warn(&robot.report);
    // What nobody has asked for by its name is not missed.
    outputs.retain(|output| {
        robot.has(output.method)
            || Absence::of_method(output.method, &robot) == Absence::TooLong
            || args.only.iter().any(|name| name == output.key)
    });
    let state = state::read(&args.state, &args.input.file, &robot)?;
    let frames = frames(&args.frames, &robot)?;
    let mut values = Values::at(&state, &robot);
    let text = {
        let _progress = Progress::of("evaluating");
        evaluated(&mut values, &outputs, &frames)
    };
    print(&text)?;
    values.all_there()
}

/// The outputs of `--only`; a regressor comes with its parameters.
fn selected(only: &[String]) -> Vec<&'static Output> {
    let has = |key: &str| only.iter().any(|wanted| wanted == key || wanted == "all");
    let is_selected = |output: &&Output| match output.key {
        _ if only.is_empty() => output.is_usual,
        "pi" => has("pi") || has("Y"),
        "pi_base" => has("pi_base") || has("Y_base"),
        key => has(key),
    };
    OUTPUTS.iter().filter(is_selected).collect()
}

/// The indices of the frames that are asked for, each once.
fn frames(names: &[String], robot: &Robot<'_>) -> Result<Vec<usize>, Failure> {
    let known = || robot.tree.frames.iter().map(|frame| frame.name.as_str());
    if names.iter().any(|name| name == "*") {
        return Ok((0..robot.tree.frames.len()).collect());
    }
    let mut found = vec![];
    for name in names {
        match known().position(|known| known == name) {
            Some(frame) if found.contains(&frame) => {}
            Some(frame) => found.push(frame),
            None => {
                let problem = Problem::new(format!("there is no frame `{}`", shown(name)));
                let help = match did_you_mean(name, known()) {
                    Some(meant) => format!("did you mean `{meant}`?"),
                    None => "name a link of the file, as `dynamics check` draws them".to_owned(),
                };
                return Err(problem.help(help).into());
            }
        }
    }
    Ok(found)
}

/// What is asked of a robot at a state, and what it has no value of.
struct Values<'a, 'g> {
    robot: &'a Robot<'g>,
    state: &'a State,
    /// Why M has no inverse there, if it has none.
    of_inverse: Option<Absence>,
    /// The outputs without a value, by reason.
    absent: Vec<(Absence, Vec<String>)>,
    /// What was asked last: two blocks of one method are next to each other.
    last: Option<(Method, Vec<f64>)>,
}

impl<'a, 'g> Values<'a, 'g> {
    fn at(state: &'a State, robot: &'a Robot<'g>) -> Self {
        let of_inverse = Absence::of_inverse(robot, &robot.tree, state);
        Self { robot, state, of_inverse, absent: vec![], last: None }
    }

    /// What a method returns, for an output of this name.
    fn of(&mut self, method: Method, key: &str) -> Option<Vec<f64>> {
        if let Some((_, last)) = self.last.as_ref().filter(|(last, _)| *last == method) {
            return Some(last.clone());
        }
        // Rounding can make a large number of what is none.
        let found = match self.of_inverse.clone().filter(|_| divides_by_mass(method)) {
            Some(why) => Err(why),
            None => self.robot.evaluate(method, self.state).map_err(|absent| absent.why),
        };
        let found = found.map_err(|why| self.is_absent(why, key)).ok()?;
        self.last = Some((method, found.clone()));
        Some(found)
    }

    fn is_absent(&mut self, why: Absence, key: &str) {
        match self.absent.iter_mut().find(|(known, _)| *known == why) {
            Some((_, outputs)) => outputs.push(key.to_owned()),
            None => self.absent.push((why, vec![key.to_owned()])),
        }
    }

    /// Fails if an output had no value, and says why.
    fn all_there(self) -> Result<(), Failure> {
        let problems: Vec<_> = self.absent.iter().map(|(why, outputs)| why.problem(outputs)).collect();
        if problems.is_empty() { Ok(()) } else { Err(Failure::Wrong(problems)) }
    }
}

fn evaluated(values: &mut Values<'_, '_>, outputs: &[&Output], frames: &[usize]) -> String {
    let robot = values.robot;
    let names: Vec<&str> = robot.model.joints.iter().map(|joint| joint.name.as_str()).collect();
    let mut entries = vec![
        ("joints", json!(names).to_string()),
        ("coordinates", json!(robot.coordinates.q).to_string()),
        ("speeds", json!(robot.coordinates.v).to_string()),
    ];
    for output in outputs {
        let found = values.of(output.method, output.key);
        if let Form::Parameters(key) = output.form {
            entries.push((key, json!(parameters(robot, output.method)).to_string()));
        }
        entries.push((output.key, found.map_or(NOTHING.to_owned(), |found| written(robot, output, &found))));
    }
    if !frames.is_empty() {
        let frames: Vec<_> = frames.iter().map(|&frame| of_frame(values, frame)).collect();
        entries.push(("frames", format!("{{\n{}\n  }}", frames.join(",\n"))));
    }
    let lines: Vec<String> = entries.iter().map(|(key, value)| format!("  \"{key}\": {value}")).collect();
    format!("{{\n{}\n}}\n", lines.join(",\n"))
}

/// What stands for an output without a value.
const NOTHING: &str = "null";

fn written(robot: &Robot<'_>, output: &Output, values: &[f64]) -> String {
    let n = robot.dof();
    match output.form {
        Form::Number => values.first().map_or("null".to_owned(), |value| json!(value).to_string()),
        Form::Vector | Form::Parameters(_) => json!(values).to_string(),
        Form::Matrix => matrix(values, n, "    "),
        Form::Block(k) => matrix(&values[k * n * n..][..n * n], n, "    "),
        Form::ByParameter => matrix(values, parameters(robot, output.method).len(), "    "),
    }
}

/// What the parameters of a regressor are called.
fn parameters<'r>(robot: &'r Robot<'_>, method: Method) -> &'r [String] {
    match method {
        Method::Regressor | Method::InertialParameters => &robot.compiled.parameter_names,
        _ => &robot.compiled.base_parameter_names,
    }
}

/// A frame's entry: its name, and its kinematics.
fn of_frame(values: &mut Values<'_, '_>, frame: usize) -> String {
    let (robot, n) = (values.robot, values.robot.dof());
    let name = &robot.tree.frames[frame].name;
    let mut entry = |key: &str, method, text: &dyn Fn(&[f64]) -> String| {
        let found = values.of(method, &format!("{key} of {name}"));
        format!("      \"{key}\": {}", found.map_or(NOTHING.to_owned(), |found| text(&found)))
    };
    let vector = |found: &[f64]| json!(found).to_string();
    let wide = |found: &[f64]| matrix(found, n, "        ");
    let lines = [
        entry("rotation", Method::Pose(frame), &|pose| matrix(&pose[..9], 3, "        ")),
        entry("translation", Method::Pose(frame), &|pose| vector(&pose[9..])),
        entry("jacobian", Method::Jacobian(frame), &wide),
        entry("world_jacobian", Method::WorldJacobian(frame), &wide),
        entry("velocity", Method::Velocity(frame), &vector),
        entry("acceleration", Method::Acceleration(frame), &vector),
    ];
    format!("    {}: {{\n{}\n    }}", json!(name), lines.join(",\n"))
}

/// A matrix of `n` columns, one row a line, behind `left`.
fn matrix(entries: &[f64], n: usize, left: &str) -> String {
    let lines: Vec<String> = rows(entries, n).iter().map(|row| format!("{left}{}", json!(row))).collect();
    let end = left.strip_prefix("  ").unwrap_or_default();
    format!("[\n{}\n{end}]", lines.join(",\n"))
}
