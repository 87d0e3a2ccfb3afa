//! Ours in the race, the counterpart of `peers/bench.cpp`.
//!
//! `ours states ROBOT` prints the states, one a line: q, v, a. `ours time ROBOT` prints robot, `ours`, output, variant,
//! least nanoseconds a call; `ours values ROBOT` what each output is at the first states.
#![allow(clippy::print_stdout, reason = "the table is the product")]

use dynamics_bench::contest::{Entries, Stage, State, Visitor, enter_all, least, states, visit};
use dynamics_core::prelude::*;

/// States whose results are printed, as many as the peers print.
const COMPARED: usize = 8;

enum Task {
    States,
    Time,
    Values,
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let (mut task, name) = match words[..] {
        ["states", name] => (Task::States, name),
        ["time", name] => (Task::Time, name),
        ["values", name] => (Task::Values, name),
        _ => panic!("usage: ours states|time|values ROBOT"),
    };
    visit(name, &mut task);
}

impl Visitor for Task {
    fn visit<R, const NQ: usize, const NV: usize>(&mut self, robot_name: &str, robot: &R)
    where
        R: DynamicsDerivatives<f64, NQ, NV> + Configuration<f64, NQ, NV>,
    {
        let states = states(robot);
        match self {
            Self::States => {
                for s in &states {
                    println!("{}", joined(&[s.q.entries(), s.v.entries(), s.a.entries()].concat(), " "));
                }
            }
            Self::Time => enter_all(robot, &mut Timed { robot_name, states: &states }),
            Self::Values => enter_all(robot, &mut Printed { robot_name, states: &states[..COMPARED] }),
        }
    }
}

struct Timed<'a, const NQ: usize, const NV: usize> {
    robot_name: &'a str,
    states: &'a [State<NQ, NV>],
}

impl<const NQ: usize, const NV: usize> Stage<NQ, NV> for Timed<'_, NQ, NV> {
    fn enter<O: Entries>(&mut self, output: &str, call: impl Fn(&State<NQ, NV>) -> O) {
        println!("{}\tours\t{output}\t\t{:.2}", self.robot_name, least(self.states, call));
    }
}

struct Printed<'a, const NQ: usize, const NV: usize> {
    robot_name: &'a str,
    states: &'a [State<NQ, NV>],
}

impl<const NQ: usize, const NV: usize> Stage<NQ, NV> for Printed<'_, NQ, NV> {
    fn enter<O: Entries>(&mut self, output: &str, call: impl Fn(&State<NQ, NV>) -> O) {
        let values: Vec<f64> = self.states.iter().flat_map(|state| call(state).entries()).collect();
        println!("{}\tours\t{output}\t\t{}", self.robot_name, joined(&values, "\t"));
    }
}

fn joined(values: &[f64], separator: &str) -> String {
    let digits: Vec<String> = values.iter().map(|value| format!("{value:e}")).collect();
    digits.join(separator)
}
