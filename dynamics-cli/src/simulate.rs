//! `dynamics simulate FILE`: a robot left to itself, as CSV.

use std::io::Write;
use std::path::PathBuf;

use dynamics_codegen::mechanics::equations::Method;
use dynamics_codegen::model::JointInfo;
use dynamics_codegen::spec::JointKind;
use dynamics_codegen::symbolic::Graph;

use crate::failure::{Failure, Problem};
use crate::input::InputArgs;
use crate::output::{failed, writer};
use crate::progress::Progress;
use crate::robot::{Read, Robot, State, Wanted};
use crate::state;

/// Simulate a robot that nothing drives, as CSV: time, q, v and energies
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    #[command(flatten)]
    input: InputArgs,

    /// How long, in seconds
    #[arg(long, value_name = "SECONDS", value_parser = duration, allow_hyphen_values = true)]
    time: f64,

    /// The step of the integration, in seconds
    #[arg(long, value_name = "SECONDS", value_parser = step, allow_hyphen_values = true)]
    step: f64,

    /// Coordinates at the start, with commas between them; without it, zero, and nothing is turned
    #[arg(long, allow_hyphen_values = true)]
    q: Option<String>,

    /// Speeds at the start, with commas between them; without it, zero
    #[arg(long, allow_hyphen_values = true)]
    v: Option<String>,

    /// Write one of so many steps; the last one always
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u64).range(1..))]
    every: u64,

    /// The file to write; without it, standard output
    #[arg(short, long, value_name = "CSV")]
    output: Option<PathBuf>,
}

const EXAMPLES: &str = "\
The method is the classical one of Runge and Kutta, of fourth order, with a fixed step.

Examples:
  dynamics simulate arm.urdf --time 10 --step 1e-3 --q 0.1,0.2 -o arm.csv
  dynamics simulate arm.urdf --time 1 --step 1e-4 --every 100";

/// More steps cannot be counted exactly in doubles, nor waited for.
const MOST_STEPS: f64 = (1_u64 << 53) as f64;

fn duration(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(time) if time.is_finite() && time >= 0.0 => Ok(time),
        _ => Err("give a finite number of seconds that is not negative".to_owned()),
    }
}

fn step(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(step) if step.is_finite() && step > 0.0 => Ok(step),
        _ => Err("give a finite number of seconds above zero".to_owned()),
    }
}

/// Runs the command.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let clock = Clock::of(args.time, args.step)?;
    let input = args.input.read()?;
    let graph = Graph::new();
    let wanted = [Method::ForwardDynamics, Method::KineticEnergy, Method::PotentialEnergy];
    let robot = Robot::of(&input, &graph, Wanted::Only(&wanted))?;
    let model = &robot.read.model;
    let mut state = state::at_rest(model);
    for (name, argument, vector) in [("q", &args.q, &mut state.q), ("v", &args.v, &mut state.v)] {
        if let Some(argument) = argument {
            *vector = state::vector(name, argument, model)?;
        }
    }
    let mut out = writer(args.output.as_deref(), &args.input.file)?;
    let mut write =
        |line: &str| out.write_all(line.as_bytes()).map_err(|error| failed(args.output.as_deref(), &error));
    write(&head(&robot))?;
    write(&row(&robot, 0.0, &state)?)?;
    let progress = Progress::of("simulating");
    for k in 1..=clock.steps {
        let (before, now) = (clock.at(k - 1), clock.at(k));
        state = stepped(&robot, &state, now - before).map_err(|failure| lost(failure, now))?;
        if k % args.every == 0 || k == clock.steps {
            write(&row(&robot, now, &state).map_err(|failure| lost(failure, now))?)?;
        }
        progress.done(k as f64 / clock.steps as f64);
    }
    out.flush().map_err(|error| failed(args.output.as_deref(), &error))
}

/// The times of the steps.
struct Clock {
    time: f64,
    step: f64,
    steps: u64,
    /// Whether all steps are equal.
    divides: bool,
}

impl Clock {
    fn of(time: f64, step: f64) -> Result<Self, Failure> {
        let count = time / step;
        if count > MOST_STEPS {
            let problem = Problem::new(format!("{time:?} s in steps of {step:?} s are too many steps"));
            return Err(problem.help("give a larger `--step`").into());
        }
        let divides = (count - count.round()).abs() <= 1e-9 * count;
        let steps = if divides { count.round() } else { count.ceil() };
        Ok(Self { time, step, steps: steps as u64, divides })
    }

    /// When the step `k` ends: where steps are equal, the double nearest to their part of the time.
    fn at(&self, k: u64) -> f64 {
        let k = k as f64;
        if self.divides { self.time * k / self.steps as f64 } else { (k * self.step).min(self.time) }
    }
}

/// The state after a step `h`, by the classical method of Runge and Kutta. Quaternions are made of unit length again
/// after each step: in between they leave it by no more than the method is off.
fn stepped(robot: &Robot<'_>, state: &State, h: f64) -> Result<State, Failure> {
    let along = |x: &[f64], h: f64, rate: &[f64]| -> Vec<f64> {
        x.iter().zip(rate).map(|(x, rate)| x + h * rate).collect()
    };
    let after = |h: f64, rate: &[f64], a: &[f64]| State {
        q: along(&state.q, h, rate),
        v: along(&state.v, h, a),
        ..state.clone()
    };
    let tree = &robot.read.tree;
    let rates = |state: &State| -> Result<(Vec<f64>, Vec<f64>), Failure> {
        let a = robot.evaluate(Method::ForwardDynamics, state)?;
        Ok((tree.configuration_rate(&state.q, &state.v), a))
    };
    let (v1, a1) = rates(state)?;
    let (v2, a2) = rates(&after(0.5 * h, &v1, &a1))?;
    let (v3, a3) = rates(&after(0.5 * h, &v2, &a2))?;
    let (v4, a4) = rates(&after(h, &v3, &a3))?;
    let mean = |[one, two, three, four]: [&[f64]; 4]| -> Vec<f64> {
        let sum = |k: usize| one[k] + 2.0 * (two[k] + three[k]) + four[k];
        (0..one.len()).map(|k| sum(k) / 6.0).collect()
    };
    let v = mean([&v1, &v2, &v3, &v4]);
    let a = mean([&a1, &a2, &a3, &a4]);
    let mut state = after(h, &v, &a);
    tree.normalise(&mut state.q);
    Ok(state)
}

/// Says when numbers got out of hand.
fn lost(failure: Failure, time: f64) -> Failure {
    let Failure::Wrong { mut problems, text } = failure else { return failure };
    for problem in &mut problems {
        problem.title = format!("{}, {time:?} s after the start", problem.title);
        problem.help = Some("give a smaller `--step`, or another state at the start".to_owned());
    }
    Failure::Wrong { problems, text }
}

fn head(robot: &Robot<'_>) -> String {
    let Read { spec, model, .. } = &robot.read;
    let moving = spec.joints.iter().filter(|joint| joint.has_coordinates());
    let joints: Vec<_> = model.joints.iter().zip(moving).map(|(info, joint)| (info, joint.kind)).collect();
    let names = |prefix: &'static str, parts: fn(JointKind) -> &'static [&'static str]| {
        let of_joint = move |(joint, kind): &(&JointInfo, JointKind)| {
            let part = |part: &&str| quoted(&format!("{prefix}.{}{part}", joint.name));
            parts(*kind).iter().map(part).collect::<Vec<_>>()
        };
        joints.iter().flat_map(of_joint).collect::<Vec<_>>()
    };
    let energies = ["kinetic", "potential", "total"].map(str::to_owned).to_vec();
    let cells = [vec!["time".to_owned()], names("q", coordinates), names("v", speeds), energies].concat();
    cells.join(",") + "\n"
}

/// What the coordinates of a joint are called behind its name.
fn coordinates(kind: JointKind) -> &'static [&'static str] {
    match kind {
        JointKind::Ball => &[".i", ".j", ".k", ".w"],
        JointKind::Free => &[".x", ".y", ".z", ".i", ".j", ".k", ".w"],
        _ => speeds(kind),
    }
}

/// What its speeds are called.
fn speeds(kind: JointKind) -> &'static [&'static str] {
    match kind {
        JointKind::Fixed => &[],
        JointKind::Revolute | JointKind::Continuous | JointKind::Prismatic | JointKind::Helical => &[""],
        JointKind::Cylindrical => &[".angle", ".distance"],
        JointKind::Universal => &[".first", ".second"],
        JointKind::Planar => &[".x", ".y", ".angle"],
        JointKind::Translation => &[".x", ".y", ".z"],
        JointKind::Ball => &[".wx", ".wy", ".wz"],
        JointKind::Free => &[".x", ".y", ".z", ".wx", ".wy", ".wz"],
    }
}

/// A cell of CSV, RFC 4180.
fn quoted(text: &str) -> String {
    if text.contains([',', '"']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

fn row(robot: &Robot<'_>, time: f64, state: &State) -> Result<String, Failure> {
    let kinetic = robot.evaluate(Method::KineticEnergy, state)?[0];
    let potential = robot.evaluate(Method::PotentialEnergy, state)?[0];
    let numbers = std::iter::once(&time).chain(&state.q).chain(&state.v);
    let numbers = numbers.copied().chain([kinetic, potential, kinetic + potential]);
    Ok(numbers.map(|number| format!("{number:?}")).collect::<Vec<_>>().join(",") + "\n")
}
