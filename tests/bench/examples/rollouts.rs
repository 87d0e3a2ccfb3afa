//! Steps a second of rollouts, ours in all forms and MuJoCo's, and whether all end in the same states:
//! `rollouts URDF FOLDER DYNAMICS DYNAMICS_NATIVE PYTHON SCRIPT`, which `peers/rollouts.sh` calls.
//!
//! The command line draws the starts, and says where they end; the others begin at the same ones.
#![allow(clippy::print_stdout, reason = "the table is the product")]

use std::collections::BTreeMap;
use std::process::Command;
use std::time::Instant;

use dynamics_bench::industrial::iiwa14::Iiwa14;
use dynamics_core::prelude::*;
use dynamics_core::simulate::Explicit;
use rayon::ThreadPoolBuilder;

type Moving = State<f64, 7, 7>;

const ROLLOUTS: usize = 256;
const STEPS: usize = 500;
const STEP: f64 = 1e-3;
/// The best of so many turns counts.
const TURNS: usize = 5;
/// Where two ends may differ, in rad and rad/s. Accelerations agree to some 1e-13 of themselves; in half a second of free
/// swinging a difference grows by some thousands. Another method, step or robot would be seen at 1e-4 and more.
const TOLERANCE: f64 = 1e-8;

/// A contestant's steps a second, and where its rollouts end.
struct Result {
    name: &'static str,
    threads: usize,
    rate: f64,
    ends: Option<Vec<Moving>>,
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [urdf, folder, generic, native, python, script] = &words[..] else {
        panic!("usage: rollouts URDF FOLDER DYNAMICS DYNAMICS_NATIVE PYTHON SCRIPT")
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut results: BTreeMap<&str, Vec<Result>> = BTreeMap::new();
    for (method, flag) in [("RK4", "rk4"), ("Euler", "euler")] {
        let file = format!("{folder}/{flag}.csv");
        let here = results.entry(method).or_default();
        for (name, binary) in [("`dynamics rollouts`, any x86-64", generic), ("`dynamics rollouts`", native)]
        {
            for threads in [1, threads] {
                let rate =
                    (0..TURNS).map(|_| interpreted(binary, urdf, flag, threads, &file)).fold(0.0, f64::max);
                here.push(Result { name, threads, rate, ends: Some(read(&file).1) });
            }
        }
        let starts = read(&file).0;
        match method {
            "RK4" => generated(Rk4, &starts, threads, here),
            _ => generated(SemiImplicitEuler, &starts, threads, here),
        }
    }
    let threads_text = threads.to_string();
    let arguments =
        [script, urdf, &format!("{folder}/rk4.csv"), &STEPS.to_string(), &STEP.to_string(), &threads_text];
    mujoco(python, &arguments, &mut results);
    let worst = disagreement(&results);
    print_table(&results, worst, threads);
    assert!(worst < TOLERANCE, "the ends differ by {worst:e}");
}

/// The command line's own figure, of what it does after it has compiled the robot.
fn interpreted(binary: &str, urdf: &str, method: &str, threads: usize, out: &str) -> f64 {
    let mut command = Command::new(binary);
    command.args(["rollouts", urdf, "--method", method, "--seed", "1", "--timing", "-o", out]);
    command.args(["--count", &ROLLOUTS.to_string(), "--time", &(STEP * STEPS as f64).to_string()]);
    command.args(["--step", &STEP.to_string(), "--threads", &threads.to_string()]);
    for joint in Iiwa14::JOINT_NAMES {
        command.args(["--vary", &format!("q.{joint} = -1..1"), "--vary", &format!("v.{joint} = -1..1")]);
    }
    let done = command.output().expect("the binary runs");
    let said = String::from_utf8_lossy(&done.stderr).into_owned();
    assert!(done.status.success(), "{said}");
    let rate =
        said.rsplit_once(": ").and_then(|(_, rate)| rate.trim().strip_suffix(" steps/s")?.parse().ok());
    rate.unwrap_or_else(|| panic!("no rate in {said}"))
}

/// The first and the last states of a table.
fn read(file: &str) -> (Vec<Moving>, Vec<Moving>) {
    let text = std::fs::read_to_string(file).expect("the table was written");
    let mut lines = text.lines();
    let head: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let column = |prefix: &str, joint: &str| {
        head.iter().position(|name| *name == format!("{prefix}.{joint}")).expect("a column for each joint")
    };
    let [q, v] = ["q", "v"]
        .map(|prefix| Iiwa14::JOINT_NAMES.iter().map(|joint| column(prefix, joint)).collect::<Vec<_>>());
    let state = |line: &str| {
        let row: Vec<f64> = line.split(',').map(|cell| cell.parse().expect("a number")).collect();
        State::new(SVector::from_fn(|k, _| row[q[k]]), SVector::from_fn(|k, _| row[v[k]]))
    };
    let states: Vec<Moving> = lines.map(state).collect();
    (states.iter().step_by(2).copied().collect(), states.iter().skip(1).step_by(2).copied().collect())
}

/// The best steps a second of some turns.
fn best(mut turn: impl FnMut()) -> f64 {
    let time = |_| {
        let begun = Instant::now();
        turn();
        begun.elapsed().as_secs_f64()
    };
    (ROLLOUTS * STEPS) as f64 / (0..TURNS).map(time).fold(f64::INFINITY, f64::min)
}

/// The derived robot: one simulation after another, in lanes, and on all cores.
fn generated(
    integrator: impl Explicit + Copy + Sync,
    starts: &[Moving],
    threads: usize,
    results: &mut Vec<Result>,
) {
    let mut ends = starts.to_vec();
    let rate = best(|| {
        for (end, start) in ends.iter_mut().zip(starts) {
            let simulation = Simulation::new(&Iiwa14, *start, STEP).expect("a state and a step");
            let mut simulation = simulation.with_integrator(integrator);
            for sample in simulation.steps(STEPS) {
                *end = sample.expect("it stays finite").state;
            }
        }
    });
    results.push(Result { name: "derived, one by one", threads: 1, rate, ends: Some(ends.clone()) });
    let rollouts = Rollouts::new(STEP, STEPS).expect("a step").with_integrator(integrator);
    let mut sound = vec![0.0; starts.len()];
    for threads in [1, threads] {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        let rate = best(|| {
            let run = || rollouts.par_run(starts, &mut ends, &mut sound, |start| Rollout::new(Iiwa14, start));
            pool.install(run).expect("the starts are states");
        });
        results.push(Result { name: "derived, in lanes", threads, rate, ends: Some(ends.clone()) });
    }
}

/// What the script says.
fn mujoco(python: &str, arguments: &[&String], results: &mut BTreeMap<&str, Vec<Result>>) {
    let done = Command::new(python).args(arguments).output().expect("python runs");
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let text = String::from_utf8_lossy(&done.stdout).into_owned();
    let lines = || text.lines().map(|line| line.split('\t').collect::<Vec<_>>());
    for (method, results) in results.iter_mut() {
        let numbers =
            |words: &[&str]| words.iter().map(|word| word.parse().expect("a number")).collect::<Vec<f64>>();
        let ends: Vec<Moving> = lines()
            .filter(|words| words[..2] == ["end", *method])
            .map(|words| {
                let row = numbers(&words[3..]);
                State::new(SVector::from_fn(|k, _| row[k]), SVector::from_fn(|k, _| row[7 + k]))
            })
            .collect();
        assert_eq!(ends.len(), ROLLOUTS, "{text}");
        for words in lines().filter(|words| words[..2] == ["rate", *method]) {
            let row = numbers(&words[2..]);
            let threads = row[0] as usize;
            let ends = (threads == 1).then(|| ends.clone());
            results.push(Result { name: "MuJoCo", threads, rate: row[1], ends });
        }
    }
}

/// The largest difference of any two ends of a rollout.
fn disagreement(results: &BTreeMap<&str, Vec<Result>>) -> f64 {
    let mut worst = 0.0_f64;
    for results in results.values() {
        let ends: Vec<&Vec<Moving>> = results.iter().filter_map(|result| result.ends.as_ref()).collect();
        for ends in ends.windows(2) {
            for (a, b) in ends[0].iter().zip(ends[1]) {
                worst = worst.max((a.q - b.q).amax()).max((a.v - b.v).amax());
            }
        }
    }
    worst
}

fn print_table(results: &BTreeMap<&str, Vec<Result>>, worst: f64, threads: usize) {
    let (rk4, euler) = (&results["RK4"], &results["Euler"]);
    let rate = |results: &[Result], name: &str, threads: usize| {
        let found = results.iter().find(|result| result.name == name && result.threads == threads);
        found.map_or(f64::NAN, |result| result.rate)
    };
    println!("Million steps a second; × is of MuJoCo's on as many threads.\n");
    println!("| | threads | RK4 | × | semi-implicit Euler | × |");
    println!("|---|--:|--:|--:|--:|--:|");
    let names = [
        "MuJoCo",
        "derived, one by one",
        "derived, in lanes",
        "`dynamics rollouts`",
        "`dynamics rollouts`, any x86-64",
    ];
    for name in names {
        for threads in if threads == 1 { vec![1] } else { vec![1, threads] } {
            let [a, b] = [rk4, euler].map(|results| rate(results, name, threads));
            if a.is_nan() {
                continue;
            }
            let [of_a, of_b] = [rk4, euler].map(|results| rate(results, "MuJoCo", threads));
            println!(
                "| {name} | {threads} | {:.3} | {:.1} | {:.3} | {:.1} |",
                a / 1e6,
                a / of_a,
                b / 1e6,
                b / of_b
            );
        }
    }
    println!(
        "\n{ROLLOUTS} rollouts of {STEPS} steps of {STEP} s; all ends agree to {worst:.0e} rad and rad/s."
    );
}
