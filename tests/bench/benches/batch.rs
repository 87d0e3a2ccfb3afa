//! Many states: in lanes, in batches, on all cores.
//!
//! `RUSTFLAGS="-C target-cpu=native" cargo bench -p dynamics-bench --bench batch` writes the table of all cores: how
//! many states `batch::par_map` takes through a method in a second, on one thread and on as many as the machine has cores.
//!
//! In the race it is a contestant, the counterpart of `examples/ours.rs`. `batch time ROBOT` prints robot, how, output,
//! variant, least nanoseconds a state: of states that are in lanes already (`f64x4`, `f64x8`, `f32x8`), and by
//! `batch::map` from slices of states to a slice of results (`batch`). `batch values ROBOT` prints what `batch::map` makes
//! of the first states.
#![allow(clippy::print_stdout, reason = "the table is the product")]

use std::cell::RefCell;
use std::hint::black_box;
use std::thread::available_parallelism;

use dynamics_bench::contest::{Entries, InLanes, State, Visitor, least, states, visit};
use dynamics_core::batch::{self, Pack};
use dynamics_core::lanes::Lanes;
use dynamics_core::prelude::*;
use rayon::ThreadPoolBuilder;

/// States whose results are printed, as many as the peers print.
const COMPARED: usize = 8;
/// States of a batch that all cores share; more than the caches of one hold.
const MANY: usize = 16_384;
/// The robots of the table of all cores, and their outputs.
const ON_CORES: [&str; 2] = ["iiwa14", "hyq"];
const OUTPUTS_ON_CORES: [&str; 3] = ["ID", "FD", "dFD"];

enum Task {
    Time,
    Values,
    Cores,
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["time", name] => visit(name, &mut Task::Time),
        ["values", name] => visit(name, &mut Task::Values),
        [] => {
            println!("Million states a second, in batches of {MANY}:\n");
            println!("| robot | output | one thread | {} threads | × |\n|---|---|--:|--:|--:|", cores());
            ON_CORES.into_iter().for_each(|name| visit(name, &mut Task::Cores));
        }
        _ => panic!("usage: batch [time|values ROBOT]"),
    }
}

fn cores() -> usize {
    available_parallelism().map_or(1, Into::into)
}

/// Coordinates, speeds, and accelerations or forces; or many of each.
type Parts<Q, V> = (Q, V, V);

/// [`least`] a state, of states in lanes.
fn in_lanes<L: Lanes, const NQ: usize, const NV: usize, O>(
    states: &[State<NQ, NV>],
    element: impl Fn(f64) -> L::Element,
    call: impl Fn(&Parts<SVector<L, NQ>, SVector<L, NV>>) -> O,
) -> f64
where
    SVector<L::Element, NQ>: Pack<Element = L::Element, Packed<L> = SVector<L, NQ>>,
    SVector<L::Element, NV>: Pack<Element = L::Element, Packed<L> = SVector<L, NV>>,
{
    let of_elements = |s: &State<NQ, NV>| (s.q.map(&element), s.v.map(&element), s.a.map(&element));
    let states: Vec<_> = states.iter().map(of_elements).collect();
    let blocks = states.chunks_exact(L::COUNT);
    let packed: Vec<_> = blocks
        .map(|block| {
            let q = Pack::pack::<L, _>(block, |state| &state.0);
            (q, Pack::pack::<L, _>(block, |state| &state.1), Pack::pack::<L, _>(block, |state| &state.2))
        })
        .collect();
    least(&packed, call) / L::COUNT as f64
}

/// Columns of states: coordinates, speeds, and accelerations or forces.
fn columns<const NQ: usize, const NV: usize>(
    states: &[State<NQ, NV>],
    count: usize,
) -> Parts<Vec<SVector<f64, NQ>>, Vec<SVector<f64, NV>>> {
    let states = || states.iter().cycle().take(count);
    (states().map(|s| s.q).collect(), states().map(|s| s.v).collect(), states().map(|s| s.a).collect())
}

/// [`least`] a state, of a batch.
fn in_batches<O>(results: &mut [O], batch: impl Fn(&mut [O]) -> Result<(), Error>) -> f64 {
    let count = results.len();
    let results = RefCell::new(results);
    let whole = |(): &()| {
        let results: &mut [O] = &mut results.borrow_mut();
        batch(results).expect("there are as many results as states");
        _ = black_box(results);
    };
    least(&[()], whole) / count as f64
}

/// Does the task with an output.
macro_rules! enter {
    ($task:ident, $name:ident, $states:ident, $output:literal, |$q:ident, $v:ident, $a:ident| $call:expr) => {{
        let (q, v, a) = columns(&$states, if matches!($task, Task::Cores) { MANY } else { $states.len() });
        let ($q, $v, $a) = (&q[0], &v[0], &a[0]);
        let mut results = vec![$call; q.len()];
        let map = |results: &mut [_]| {
            batch::map((&q, &v, &a), results, |($q, $v, $a)| {
                let ($q, $v, $a) = (&$q, &$v, &$a);
                $call
            })
        };
        let par_map = |results: &mut [_]| {
            batch::par_map((&q, &v, &a), results, |($q, $v, $a)| {
                let ($q, $v, $a) = (&$q, &$v, &$a);
                $call
            })
        };
        match $task {
            Task::Time => {
                let f64x4 = in_lanes::<f64x4, _, _, _>(&$states, |x| x, |($q, $v, $a)| $call);
                let f64x8 = in_lanes::<f64x8, _, _, _>(&$states, |x| x, |($q, $v, $a)| $call);
                let f32x8 = in_lanes::<f32x8, _, _, _>(&$states, |x| x as f32, |($q, $v, $a)| $call);
                let batch = in_batches(&mut results, map);
                for (how, time) in [("f64x4", f64x4), ("f64x8", f64x8), ("f32x8", f32x8), ("batch", batch)] {
                    println!("{}\t{how}\t{}\t\t{time:.2}", $name, $output);
                }
            }
            Task::Values => {
                map(&mut results).expect("there are as many results as states");
                let values = results[..COMPARED].iter().flat_map(Entries::entries);
                let values: Vec<String> = values.map(|value| format!("{value:e}")).collect();
                println!("{}\tbatch\t{}\t\t{}", $name, $output, values.join("\t"));
            }
            Task::Cores if OUTPUTS_ON_CORES.contains(&$output) => {
                let [one, all] = [1, cores()].map(|threads| {
                    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
                    let pool = pool.expect("the machine starts as many threads as it has cores");
                    pool.install(|| in_batches(&mut results, par_map))
                });
                let [slow, fast] = [one, all].map(|nanoseconds| 1e3 / nanoseconds);
                println!("| {} | {} | {slow:.2} | {fast:.2} | {:.2} |", $name, $output, fast / slow);
            }
            Task::Cores => {}
        }
    }};
}

impl Visitor for Task {
    fn visit<R: InLanes<NQ, NV>, const NQ: usize, const NV: usize>(&mut self, name: &str, robot: &R) {
        let states = states(robot);
        enter!(self, name, states, "G", |q, _v, _a| robot.gravity_forces(q));
        enter!(self, name, states, "ID", |q, v, a| robot.inverse_dynamics(q, v, a));
        enter!(self, name, states, "M", |q, _v, _a| robot.mass_matrix(q));
        enter!(self, name, states, "C", |q, v, _a| robot.coriolis_matrix(q, v));
        enter!(self, name, states, "FD", |q, v, tau| robot.forward_dynamics(q, v, tau));
        enter!(self, name, states, "1/M", |q, _v, _a| robot.inverse_mass_matrix(q));
        enter!(self, name, states, "dID", |q, v, a| robot.inverse_dynamics_derivatives(q, v, a));
        enter!(self, name, states, "dFD", |q, v, tau| robot.forward_dynamics_derivatives(q, v, tau));
    }
}
