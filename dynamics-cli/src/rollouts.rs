//! `dynamics rollouts FILE`: a robot let go a thousand times, each time a little different, as a table.

mod engine;
mod file;
mod row;
mod study;
mod table;
mod tape;
mod variation;

use std::io::{IsTerminal, Write};
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use dynamics_codegen::symbolic::Graph;
use rayon::prelude::*;

use self::engine::{Engine, LANES, Plan, Rollout};
use self::study::{Study, Target};
use self::table::{Format, Rows, Table};
use self::variation::{GRID, Given, VARY};
use crate::attributes::quoted;
use crate::failure::{Failure, Problem};
use crate::fields::unless_known;
use crate::input::{Input, shown};
use crate::motion::FixedStep;
use crate::progress::Progress;
use crate::reading::InputArgs;
use crate::robot::{Robot, State, Wanted};
use crate::simulate::{Clock, METHODS, duration, step};
use crate::start;

/// Simulate a robot many times, with what varies drawn at random or on a grid, as CSV or Parquet
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    #[command(flatten)]
    input: InputArgs,

    /// How long each, in seconds
    #[arg(long, value_name = "SECONDS", value_parser = duration, allow_hyphen_values = true)]
    time: f64,

    /// The step of the integration, in seconds
    #[arg(long, value_name = "SECONDS", value_parser = step, allow_hyphen_values = true)]
    step: f64,

    /// The method of the integration
    #[arg(long, value_name = "METHOD", default_value = "rk4")]
    method: FixedStep,

    /// What varies, and how: 'payload = uniform(0, 2)', 'q.elbow = normal(0, 10deg)', 'c = loguniform(0.01, 1)',
    /// 'v.elbow = -1..1', or a number. What is not `q.` or `v.` is a name that stands in another option for a number
    #[arg(long = "vary", value_name = "TEXT")]
    variations: Vec<String>,

    /// Values to go through, each with each of the others: 'payload = 0, 0.5, 1', 'payload = linspace(0, 1, 11)'
    #[arg(long = "grid", value_name = "TEXT")]
    grids: Vec<String>,

    /// How many rollouts, or how many of each point of the grid
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u64).range(1..))]
    count: u64,

    /// The seed of all random numbers: the same one gives the same table
    #[arg(long, value_name = "N", default_value = "0")]
    seed: u64,

    /// Coordinates at the start: all of them, `0.1,-20deg`, or some by their names, `hinge=0.1`; the others are neutral.
    /// In rad and m, or with their units
    #[arg(long, allow_hyphen_values = true)]
    q: Option<String>,

    /// Speeds at the start: all of them, or some by their names, `hinge=0.1` or `'hinge=30deg / 1s'`; the others are zero
    #[arg(long, allow_hyphen_values = true)]
    v: Option<String>,

    /// Write one of so many steps; the first and the last always, and without this option no other
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    every: Option<u64>,

    /// How many threads; without it, one for each core. It makes no difference to the table
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,

    /// The file to write, a `.csv` or a `.parquet`; without it, CSV to standard output
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,

    /// Say on standard error how many steps were made in a second, as is done on a terminal
    #[arg(long)]
    timing: bool,
}

const EXAMPLES: &str = "\
Columns: rollout, time, what varies, coordinates, speeds, and the energies in J. What varies of the start is `start.q.…`.
A rollout that leaves all finite numbers ends with the last sample before, and is named at the end. The file has its name
when it is whole; until then it is OUT.part.

Examples:
  dynamics rollouts arm.urdf --time 5 --step 1e-3 --body 'load, mass = m' --vary 'm = uniform(0, 2)' --count 1000 -o m.csv
  dynamics rollouts arm.urdf --time 5 --step 1e-3 --joint 'elbow, damping = c' --grid 'c = 0, 0.1, 0.2' --every 100
  dynamics rollouts arm.urdf --time 5 --step 1e-3 --vary 'q.elbow = normal(0, 10deg)' --count 10000 --seed 1 -o q.parquet";

/// Runs the command.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let clock = Clock::of(args.time, args.step)?;
    let format = Format::of(args.output.as_deref())?;
    let given = given(args)?;
    let input = args.input.read()?;
    let graph = Graph::new();
    let fields = fields(&given)?;
    let robot = Robot::with_fields(&input, &graph, Wanted::Only(&METHODS), &fields)?;
    input.warn(&robot.report);
    let study = Study::of(&robot, &given, args.count, args.seed)?;
    unless_known(&robot.model, |k| study.axes.iter().any(|axis| axis.target == Target::Field(k)))?;
    let mut start = State::neutral(&robot);
    start::put(&robot, &mut start, args.q.as_deref(), args.v.as_deref())?;
    let engine = Engine::of(&robot)?;
    let every = args.every.unwrap_or(u64::MAX);
    let plan = Plan {
        engine: &engine,
        study: &study,
        clock: &clock,
        every,
        integrator: args.method,
        start: (&start.q, &start.v),
    };
    let block = bytes_of_block(&plan)?;
    let (of_rollout, of_sample) = names(&robot, &study);
    let mut table = Table::begin(
        format,
        (args.output.as_deref(), &args.input.file),
        &of_rollout,
        &of_sample,
        &story(args, &input, &robot),
    )?;
    let losses = roll_out(args, &plan, block, &mut table)?;
    table.finish()?;
    lost(&losses, study.rollouts)
}

/// What the options say, and all mistakes in them.
fn given(args: &Args) -> Result<Vec<Given>, Failure> {
    let vary = args.variations.iter().map(|text| (&VARY, text));
    let grid = args.grids.iter().map(|text| (&GRID, text));
    let (mut given, mut wrong) = (vec![], vec![]);
    for (kind, text) in vary.chain(grid) {
        match Given::read(kind, text) {
            Ok(read) => given.push(read),
            Err(Failure::Wrong(problems)) => wrong.extend(problems),
            Err(other) => return Err(other),
        }
    }
    if wrong.is_empty() { Ok(given) } else { Err(Failure::Wrong(wrong)) }
}

/// The names that stand for numbers in other options, each once.
fn fields(given: &[Given]) -> Result<Vec<&str>, Failure> {
    let (mut fields, mut wrong) = (vec![], vec![]);
    for given in given.iter().filter(|given| study::start(&given.assignment.name).is_none()) {
        let name = given.assignment.name.as_str();
        if syn::parse_str::<syn::Ident>(name).is_err() || name == "pi" || name == "PI" {
            let title = format!("`{}` cannot stand for a number", shown(name));
            let help = "give it a name of letters, digits and `_`; coordinates and speeds at the start are `q.` and `v.` \
                        and a name";
            wrong.push(given.assignment.wrong_name(title, help.to_owned()));
        } else if !fields.contains(&name) {
            fields.push(name);
        }
    }
    if wrong.is_empty() { Ok(fields) } else { Err(Failure::Wrong(wrong)) }
}

/// The columns of a rollout, and those of a sample.
fn names(robot: &Robot<'_>, study: &Study) -> (Vec<String>, Vec<String>) {
    let of_axis = |axis: &study::Axis| match axis.target {
        Target::Field(_) => axis.name.clone(),
        Target::Coordinate(_) | Target::Speed(_) => format!("start.{}", axis.name),
    };
    let q = robot.coordinates.q.iter().map(|name| format!("q.{name}"));
    let v = robot.coordinates.v.iter().map(|name| format!("v.{name}"));
    let energies = ["kinetic", "potential", "elastic", "total"].map(str::to_owned);
    let of_sample = std::iter::once("time".to_owned()).chain(q).chain(v).chain(energies).collect();
    (study.axes.iter().map(of_axis).collect(), of_sample)
}

/// How the table was made: what makes a difference to it, and nothing else.
fn story(args: &Args, input: &Input, robot: &Robot<'_>) -> Vec<(&'static str, String)> {
    let file = args.input.file.file_name().map_or("-".to_owned(), |file| shown(&file.to_string_lossy()));
    let mut command = format!("dynamics rollouts {}{}", quoted(&file), input.flags());
    let method = if args.method == FixedStep::Rk4 { "rk4" } else { "euler" };
    command += &format!(" --time {:?} --step {:?} --method {method}", args.time, args.step);
    let texts = [("vary", &args.variations), ("grid", &args.grids)];
    let texts = texts.into_iter().flat_map(|(option, texts)| texts.iter().map(move |text| (option, text)));
    for (option, text) in texts.chain(args.q.iter().map(|q| ("q", q))).chain(args.v.iter().map(|v| ("v", v)))
    {
        command += &format!(" --{option} {}", quoted(&shown(text)));
    }
    command += &format!(" --count {} --seed {}", args.count, args.seed);
    if let Some(every) = args.every {
        command += &format!(" --every {every}");
    }
    vec![
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("robot", shown(robot.report.robot.as_deref().unwrap_or_default())),
        ("command", command),
        ("seed", args.seed.to_string()),
    ]
}

/// So many bytes of samples may wait to be written.
const MOST_WAITING: u64 = 1 << 30;
/// So many blocks for each thread are computed before their rows are written, in order.
const BLOCKS_A_THREAD: u64 = 4;

/// How many bytes of samples a block of rollouts has, if it is not too many to keep.
fn bytes_of_block(plan: &Plan<'_>) -> Result<u64, Failure> {
    let samples = plan.clock.steps / plan.every + 2;
    let bytes = samples.saturating_mul(8 * plan.engine.width() as u64 * LANES as u64);
    if bytes <= MOST_WAITING {
        return Ok(bytes);
    }
    let problem = Problem::new(format!("each rollout has {samples} samples, which are too many to keep"));
    Err(problem.help("give a larger `--every`, or run `dynamics simulate` for each rollout").into())
}

/// Computes all rollouts in blocks of so many bytes, writes their rows, and returns which were lost, and when each was finite for the last time.
fn roll_out(args: &Args, plan: &Plan<'_>, block: u64, table: &mut Table) -> Result<Vec<(u64, f64)>, Failure> {
    let threads = args.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|error| {
        Problem::new(format!("threads cannot be started: {error}"))
            .help("give a smaller number to `--threads`")
    })?;
    let (width, steps, rollouts) = (plan.engine.width(), plan.clock.steps, plan.study.rollouts);
    let window = (BLOCKS_A_THREAD * pool.current_num_threads() as u64).min(MOST_WAITING / block);
    let blocks = rollouts.div_ceil(LANES as u64);
    let (all, made, begun) = (steps as f64 * rollouts as f64, AtomicU64::new(0), Instant::now());
    let progress = Progress::of_steps("rolling out", all);
    let tick = |steps: u64| {
        let made = made.fetch_add(steps, Ordering::Relaxed) + steps;
        progress.done(made as f64 / all);
    };
    let (is_text, mut losses) = (table.is_text(), vec![]);
    for first in (0..blocks).step_by(window as usize) {
        let here = first..blocks.min(first + window);
        let rolled = |k: u64| {
            let rollouts = plan.block(k * LANES as u64, &tick);
            let lost = |rollout: &Rollout| rollout.lost.map(|time| (rollout.index, time));
            let losses: Vec<(u64, f64)> = rollouts.iter().filter_map(lost).collect();
            (
                if is_text { Rows::Text(table::text(&rollouts, width)) } else { Rows::Numbers(rollouts) },
                losses,
            )
        };
        let done: Vec<_> = pool.install(|| here.into_par_iter().map(rolled).collect());
        for (rows, of_block) in done {
            table.write(rows)?;
            losses.extend(of_block);
        }
    }
    drop(progress);
    if args.timing || std::io::stderr().is_terminal() {
        let seconds = begun.elapsed().as_secs_f64();
        let rate = all / seconds.max(1e-9);
        let _ = writeln!(
            std::io::stderr(),
            "{rollouts} rollouts, {all} steps in {seconds:.3} s: {rate:.3e} steps/s"
        );
    }
    Ok(losses)
}

/// Says which rollouts were lost.
fn lost(losses: &[(u64, f64)], rollouts: u64) -> Result<(), Failure> {
    const SHOWN: usize = 10;
    if losses.is_empty() {
        return Ok(());
    }
    let one = |(rollout, time): &(u64, f64)| format!("{rollout} after {time:?} s");
    let mut which = losses.iter().take(SHOWN).map(one).collect::<Vec<_>>().join(", ");
    if losses.len() > SHOWN {
        which += &format!(" and {} more", losses.len() - SHOWN);
    }
    let title = format!("{} of {rollouts} rollouts did not stay finite: {which}", losses.len());
    let help = "give a smaller `--step`, or other values; the table has them up to their last finite sample";
    Err(Problem::new(title).help(help).into())
}
