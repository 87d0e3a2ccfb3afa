//! How many instructions a call takes, counted by valgrind: `cargo bench -p dynamics-bench --bench instructions`.
//!
//! The steady measure: no clock, the same in each run. It is of the generic build, without fused multiply-add or
//! vectors beyond SSE2, so that it does not depend on the machine. `-- --check` compares with `instructions.txt` and
//! fails if a count is off by more than [`TOLERANCE`] of it and [`MOVES`]; `-- --write` writes that file.
#![allow(clippy::print_stdout, reason = "the table is the product")]
#![allow(clippy::duplicated_attributes, reason = "joints are locked alike")]

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::hint::black_box;
use std::path::Path;
use std::process::{Command, ExitCode};

use dynamics_bench::contest::{Entries, Stage, State, Visitor, enter_all, states};
use dynamics_bench::{industrial, models};
use dynamics_core::prelude::*;

/// What other versions of rustc may add or save, of a count.
const TOLERANCE: f64 = 0.05;
/// And whatever the count: how many registers are saved, and how the result is copied.
const MOVES: f64 = 5.0;
const EXPECTED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/instructions.txt");

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let has = |word: &str| words.iter().any(|given| given == word);
    if has("--counted") {
        call_each();
        return ExitCode::SUCCESS;
    }
    if cfg!(target_feature = "fma") {
        println!("Nothing is counted: the counts are of the generic build, without `-C target-cpu`.");
        return ExitCode::SUCCESS;
    }
    if !Command::new("valgrind").arg("--version").output().is_ok_and(|output| output.status.success()) {
        println!("Nothing is counted: there is no valgrind.");
        return ExitCode::SUCCESS;
    }
    let table = counts();
    if has("--write") {
        std::fs::write(EXPECTED, &table).expect("the file of expected counts is written");
    }
    print!("{table}");
    if has("--check") { check(&table) } else { ExitCode::SUCCESS }
}

/// A chain in lanes over links, of which strips of four leave one.
#[derive(Dynamics)]
#[dynamics(
    urdf = "robots/chain32.urdf",
    outputs(
        mass_matrix,
        coriolis_matrix,
        inverse_mass_matrix,
        inverse_dynamics_derivatives,
        forward_dynamics_derivatives
    )
)]
#[joint(joint30, locked = 0)]
#[joint(joint31, locked = 0)]
#[joint(joint32, locked = 0)]
struct Chain29;

/// Runs each method once, for valgrind to count. A long chain's straight lines compile for minutes and show nothing else.
fn call_each() {
    OneCallEach.visit("double_pendulum", &industrial::planar_2dof::Planar2Dof);
    OneCallEach.visit("cartpole", &industrial::reference_cart_pole::ReferenceCartPole);
    OneCallEach.visit("puma560", &industrial::puma560::Puma560);
    OneCallEach.visit("iiwa14", &industrial::iiwa14::Iiwa14);
    OneCallEach.visit("hyq", &models::hyq::Hyq);
    OneCallEach.visit("chain4", &models::chain4::Chain4);
    let [q, v, a] = [0.3, 0.5, -0.2].map(SVector::<f64, 29>::repeat);
    let mut chain = OneCall { name: "chain29", state: State { q, v, a } };
    chain.enter("M", |s| Chain29.mass_matrix(&s.q));
    chain.enter("C", |s| Chain29.coriolis_matrix(&s.q, &s.v));
    chain.enter("1/M", |s| Chain29.inverse_mass_matrix(&s.q));
    chain.enter("dID", |s| Chain29.inverse_dynamics_derivatives(&s.q, &s.v, &s.a));
    chain.enter("dFD", |s| Chain29.forward_dynamics_derivatives(&s.q, &s.v, &s.a));
}

struct OneCallEach;

impl Visitor for OneCallEach {
    fn visit<R, const NQ: usize, const NV: usize>(&mut self, name: &str, robot: &R)
    where
        R: DynamicsDerivatives<f64, NQ, NV> + Configuration<f64, NQ, NV>,
    {
        enter_all(robot, &mut OneCall { name, state: states(robot)[0] });
    }
}

struct OneCall<'a, const NQ: usize, const NV: usize> {
    name: &'a str,
    state: State<NQ, NV>,
}

impl<const NQ: usize, const NV: usize> Stage<NQ, NV> for OneCall<'_, NQ, NV> {
    fn enter<O: Entries>(&mut self, output: &str, call: impl Fn(&State<NQ, NV>) -> O) {
        println!("{}\t{output}", self.name);
        black_box(&counted_call(&call, black_box(&self.state)));
    }
}

/// Valgrind counts in this function only, and writes a file whenever it returns.
#[inline(never)]
fn counted_call<S, O>(call: impl Fn(&S) -> O, state: &S) -> O {
    let result = call(state);
    // Or else it would jump into the method, and never return itself.
    black_box(state);
    result
}

/// A line a robot and output, with its count.
fn counts() -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("instructions");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for valgrind's files");
    let file = folder.join("counts");
    let output = Command::new("valgrind")
        .args([
            "--tool=callgrind",
            "--toggle-collect=*counted_call*",
            "--dump-after=instructions::counted_call",
        ])
        .arg(format!("--callgrind-out-file={}", file.display()))
        .arg(std::env::current_exe().expect("this program has a path"))
        .arg("--counted")
        .output()
        .expect("valgrind runs");
    let calls = String::from_utf8(output.stdout).expect("names are text");
    let mut table = String::new();
    for (k, call) in calls.lines().enumerate() {
        let path = format!("{}.{}", file.display(), k + 1);
        let counted = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        let total = counted.lines().find_map(|line| line.strip_prefix("summary: "));
        let (robot, output) = call.split_once('\t').expect("a robot and its output");
        let total = total.unwrap_or_else(|| panic!("{path} has no sum"));
        let _ = writeln!(table, "{robot:<16} {output:<6} {:>6}", total.trim());
    }
    table
}

/// Compares with the expected counts.
fn check(table: &str) -> ExitCode {
    let expected = std::fs::read_to_string(EXPECTED).expect("the file of expected counts is there");
    let (found, expected) = (parsed(table), parsed(&expected));
    let mut failures = 0;
    for (call, expected) in &expected {
        let found = found.get(call).copied().unwrap_or(0.0);
        if (found - expected).abs() > TOLERANCE * expected + MOVES {
            println!("{call}: {found} instructions, expected {expected}");
            failures += 1;
        }
    }
    if failures > 0 || found.len() != expected.len() {
        println!(
            "Counts changed. If they should: `cargo bench -p dynamics-bench --bench instructions -- --write`."
        );
        return ExitCode::FAILURE;
    }
    println!("All as expected, within {:.0} % and {MOVES} instructions.", 100.0 * TOLERANCE);
    ExitCode::SUCCESS
}

fn parsed(table: &str) -> BTreeMap<String, f64> {
    let row = |line: &str| {
        let (call, count) = line.rsplit_once(' ')?;
        Some((call.trim().to_owned(), count.parse().ok()?))
    };
    table.lines().filter_map(row).collect()
}
