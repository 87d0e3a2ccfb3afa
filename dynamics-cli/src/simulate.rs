//! `dynamics simulate FILE`: a robot left to itself, as CSV, and in pictures.

use std::io::Write;
use std::path::PathBuf;

use dynamics_codegen::mechanics::equations::Method;
use dynamics_codegen::symbolic::Graph;

use crate::absence::Absent;
use crate::failure::{Failure, Problem};
use crate::limits::Watch;
use crate::motion::{FixedStep, Mover};
use crate::output::{failed, writer};
use crate::picture::{PictureArgs, Recording};
use crate::progress::Progress;
use crate::reading::InputArgs;
use crate::robot::{Robot, State, Wanted};
use crate::start;

/// Simulate a robot that nothing drives, as CSV: time, coordinates, speeds and energies; and draw it
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    #[command(flatten)]
    input: InputArgs,

    /// How long, in seconds
    #[arg(long, value_name = "SECONDS", value_parser = duration, allow_hyphen_values = true)]
    time: f64,

    /// The step of the integration, in seconds; of the adaptive method the time from one row to the next
    #[arg(long, value_name = "SECONDS", value_parser = step, allow_hyphen_values = true)]
    step: f64,

    /// The method of the integration
    #[arg(long, value_name = "METHOD", default_value = "rk4")]
    method: Integrator,

    /// The error that a step of the adaptive method may have, in rad and m, and as a share of the way; without it, 1e-9
    #[arg(long, value_name = "ERROR", value_parser = tolerance, allow_hyphen_values = true)]
    tolerance: Option<f64>,

    /// Coordinates at the start: all of them, `0.1,-20deg`, or some by their names, `hinge=0.1`; the others are neutral.
    /// In rad and m, or with their units
    #[arg(long, allow_hyphen_values = true)]
    q: Option<String>,

    /// Speeds at the start: all of them, or some by their names, `hinge=0.1` or `'hinge=30deg / 1s'`; the others are zero
    #[arg(long, allow_hyphen_values = true)]
    v: Option<String>,

    /// Write one of so many steps; the last one always
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u64).range(1..))]
    every: u64,

    /// The file to write; without it, standard output, unless a picture is asked for
    #[arg(short, long, value_name = "CSV")]
    output: Option<PathBuf>,

    #[command(flatten)]
    picture: PictureArgs,
}

/// How a robot is moved on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Integrator {
    /// The classical method of Runge and Kutta, of order 4
    Rk4,
    /// The semi-implicit method of Euler, of order 1
    Euler,
    /// That of Dormand and Prince, of order 5, in steps of its own size within `--tolerance`; rows are from its polynomials
    Adaptive,
}

const EXAMPLES: &str = "\
Whatever the method, ball and free joints move on their manifold, so that quaternions stay of unit length. Nothing stops
a joint at its limits; which were passed, when, and how far, is said on standard error.

Columns:
  time                       s
  q.NAME                     each coordinate: q.hinge; q.root_joint.x to .z and .qx to .qw of a free joint, .qx to .qw
                             of a ball, .angle and .distance, .angle1 and .angle2, or .x, .y and .angle of others
  v.NAME                     each speed: v.root_joint.vx to .vz and .wx to .wz of a free joint, .wx to .wz of a ball
  kinetic, potential, elastic, total
                             J: of motion, of gravity, of springs, and their sum
  drift                      the total less that at the start: what dampers and friction took, and the method's error

Charts of --plot-of:
  angles, speeds             of all joints; of a free one its position, and roll, pitch and yaw, or a quaternion if it
                             turns over
  energy                     kinetic, potential, elastic, total; and the change of the total
  phase:NAME                 the speed of a coordinate over its value
  poles                      of the linear model at the start

Examples:
  dynamics simulate arm.urdf --time 10 --step 1e-3 --q 0.1,0.2 -o arm.csv
  dynamics simulate arm.urdf --time 1 --step 1e-4 --every 100
  dynamics simulate arm.urdf --time 10 --step 0.01 --method adaptive --tolerance 1e-10 --q 0.1,0.2
  dynamics simulate arm.urdf --time 10 --step 1e-3 --q 0.1,0.2 --plot arm.svg --animate arm.html --trace tool
  dynamics simulate dog.urdf --base free --time 1 --step 1e-3 --q root_joint.z=0.6,knee=-1.2 --v root_joint.wz=1";

/// More steps cannot be counted exactly in doubles, nor waited for.
const MOST_STEPS: f64 = (1_u64 << 53) as f64;

pub(crate) fn duration(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(time) if time.is_finite() && time >= 0.0 => Ok(time),
        _ => Err("give a finite number of seconds that is not negative".to_owned()),
    }
}

pub(crate) fn step(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(step) if step.is_finite() && step > 0.0 => Ok(step),
        _ => Err("give a finite number of seconds above zero".to_owned()),
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(tolerance) if tolerance.is_finite() && tolerance > 0.0 => Ok(tolerance),
        _ => Err("give a finite number above zero".to_owned()),
    }
}

/// The tolerance of the adaptive method.
const TOLERANCE: f64 = 1e-9;

pub(crate) const METHODS: [Method; 4] =
    [Method::ForwardDynamics, Method::KineticEnergy, Method::PotentialEnergy, Method::ElasticEnergy];

/// Runs the command.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let clock = Clock::of(args.time, args.step)?;
    if args.tolerance.is_some() && args.method != Integrator::Adaptive {
        let problem = Problem::new("`--tolerance` is for steps that find their own size");
        return Err(Failure::CommandLine(Box::new(problem.help("add `--method adaptive`"))));
    }
    let input = args.input.read()?;
    let graph = Graph::new();
    let methods = [&METHODS[..], args.picture.methods()].concat();
    let robot = Robot::of(&input, &graph, Wanted::Only(&methods))?;
    input.warn(&robot.report);
    let mut state = State::neutral(&robot);
    start::put(&robot, &mut state, args.q.as_deref(), args.v.as_deref())?;
    if let Err(why) = robot.moves(&state) {
        let problem =
            Problem::new(format!("the robot cannot move at its start, q = {:?}: {}", state.q, why.fact()));
        return Err(problem.help(why.help("--q")).into());
    }
    let mut recording = Recording::of(&args.picture, &args.input.file, &robot, clock.steps)?;
    let mut out: Box<dyn Write> = match (&args.output, args.picture.is_asked_for()) {
        (None, true) => Box::new(std::io::sink()),
        (output, _) => writer(output.as_deref(), &args.input.file)?,
    };
    let mut write =
        |line: &str| out.write_all(line.as_bytes()).map_err(|error| failed(args.output.as_deref(), &error));
    write(&head(&robot))?;
    let start = energies(&robot, &state)?[3];
    let row = |time: f64, state: &State| row(&robot, time, state, start);
    write(&row(0.0, &state)?)?;
    recording.see(0, 0.0, &state)?;
    let mut watch = Watch::of(&robot, &state);
    let mut mover = match args.method {
        Integrator::Rk4 => Mover::fixed(&robot, state, FixedStep::Rk4),
        Integrator::Euler => Mover::fixed(&robot, state, FixedStep::Euler),
        Integrator::Adaptive => Mover::adaptive(&robot, state, args.tolerance.unwrap_or(TOLERANCE))?,
    };
    let progress = Progress::of("simulating");
    let mut advance = |k: u64| {
        let (before, now) = (clock.at(k - 1), clock.at(k));
        let lost_at = |(failure, time)| lost(failure, time, args.method);
        let lost = |failure| lost_at((failure, now));
        mover.advance([before, now], args.time, |time, q, v| watch.see(time, q, v)).map_err(lost_at)?;
        if k.is_multiple_of(args.every) || k == clock.steps {
            write(&row(now, mover.state()).map_err(|absent| lost(absent.into()))?)?;
        }
        recording.see(k, now, mover.state()).map_err(lost)?;
        progress.done(k as f64 / clock.steps as f64);
        Ok(())
    };
    let done = (1..=clock.steps).try_for_each(&mut advance);
    drop(progress);
    // What was computed before anything went wrong is written, and drawn.
    out.flush().map_err(|error| failed(args.output.as_deref(), &error))?;
    if !matches!(done, Err(Failure::PipeClosed)) {
        watch.tell();
    }
    recording.write().and(done)
}

/// The times of the steps.
pub(crate) struct Clock {
    time: f64,
    step: f64,
    pub(crate) steps: u64,
    /// Whether all steps are equal.
    divides: bool,
}

impl Clock {
    pub(crate) fn of(time: f64, step: f64) -> Result<Self, Failure> {
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
    pub(crate) fn at(&self, k: u64) -> f64 {
        let k = k as f64;
        if self.divides { self.time * k / self.steps as f64 } else { (k * self.step).min(self.time) }
    }
}

/// Says when numbers got out of hand.
fn lost(failure: Failure, time: f64, method: Integrator) -> Failure {
    let Failure::Wrong(mut problems) = failure else { return failure };
    let remedy = match method {
        Integrator::Rk4 | Integrator::Euler => "give a smaller `--step`, or another state at the start",
        Integrator::Adaptive => "give a larger `--tolerance`, or another state at the start",
    };
    for problem in &mut problems {
        // The moment stands before the reason.
        let (fact, why) = problem.title.split_once(": ").unwrap_or((&problem.title, ""));
        let colon = if why.is_empty() { "" } else { ": " };
        problem.title = format!("{fact}, {time:?} s after the start{colon}{why}");
        problem.help = Some(remedy.to_owned());
    }
    Failure::Wrong(problems)
}

fn head(robot: &Robot<'_>) -> String {
    let names = |prefix: &'static str, names: &[String]| -> Vec<String> {
        names.iter().map(|name| quoted(&format!("{prefix}.{name}"))).collect()
    };
    let energies = ["kinetic", "potential", "elastic", "total", "drift"].map(str::to_owned).to_vec();
    let time = vec!["time".to_owned()];
    [time, names("q", &robot.coordinates.q), names("v", &robot.coordinates.v), energies].concat().join(",")
        + "\n"
}

/// A cell of CSV, RFC 4180.
pub(crate) fn quoted(text: &str) -> String {
    if text.contains([',', '"']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

/// Kinetic, potential, elastic, and their sum, J.
pub(crate) fn energies(robot: &Robot<'_>, state: &State) -> Result<[f64; 4], Absent> {
    let energy = |method| robot.evaluate(method, state).map(|value| value[0]);
    let (kinetic, potential) = (energy(Method::KineticEnergy)?, energy(Method::PotentialEnergy)?);
    let elastic = energy(Method::ElasticEnergy)?;
    Ok([kinetic, potential, elastic, kinetic + potential + elastic])
}

fn row(robot: &Robot<'_>, time: f64, state: &State, start: f64) -> Result<String, Absent> {
    let energies = energies(robot, state)?;
    let numbers = std::iter::once(&time).chain(&state.q).chain(&state.v).copied();
    let numbers = numbers.chain(energies).chain([energies[3] - start]);
    Ok(numbers.map(|number| format!("{number:?}")).collect::<Vec<_>>().join(",") + "\n")
}
