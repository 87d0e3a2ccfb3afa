//! How long each method takes: `cargo bench -p dynamics-bench --bench runtime [-- ROBOT…]`.
//!
//! Least nanoseconds a call: ours; the double pendulum's closed form, written by hand; and `M⁻¹·(τ − h)` by nalgebra's
//! factorisation of Cholesky, with our M and h. Set `RUSTFLAGS="-C target-cpu=native"` for what the machine can do;
//! `peers/race.sh` runs ours beside Pinocchio and CasADi.
#![allow(clippy::print_stdout, reason = "the table is the product")]

use dynamics_bench::contest::{Entries, ROBOTS, Stage, State, Visitor, enter_all, least, states, visit};
use dynamics_bench::industrial::planar_2dof::Planar2Dof;
use dynamics_bench::textbook::DoublePendulum;
use dynamics_core::prelude::*;

fn main() {
    let wanted: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    println!("| robot | output | ours, ns | by hand, ns | nalgebra's Cholesky, ns |\n|---|---|--:|--:|--:|");
    for (name, _) in ROBOTS {
        if wanted.is_empty() || wanted.iter().any(|wanted| wanted == name) {
            visit(name, &mut Table);
        }
    }
}

struct Table;

impl Visitor for Table {
    fn visit<R, const NQ: usize, const NV: usize>(&mut self, name: &str, robot: &R)
    where
        R: DynamicsDerivatives<f64, NQ, NV> + Configuration<f64, NQ, NV>,
    {
        let states = states(robot);
        let factored = least(&states, |s| {
            let cholesky = robot.mass_matrix(&s.q).cholesky();
            cholesky.map(|factor| factor.solve(&(s.a - robot.bias_forces(&s.q, &s.v))))
        });
        let mut beside = vec![("FD", None, Some(factored))];
        if name == "double_pendulum" {
            beside = by_hand(factored);
        }
        enter_all(robot, &mut Rows { name, states: &states, beside });
    }
}

/// An output, its time by hand, and by Cholesky's factorisation.
type Beside = (&'static str, Option<f64>, Option<f64>);

fn by_hand(factored: f64) -> Vec<Beside> {
    let (robot, states) = (DoublePendulum::PLANAR_2DOF, states(&Planar2Dof));
    let all = |s: &State<2, 2>| {
        (robot.mass_matrix(&s.q), robot.coriolis_matrix(&s.q, &s.v), robot.gravity_forces(&s.q))
    };
    let forward = least(&states, |s| robot.forward_dynamics(&s.q, &s.v, &s.a));
    vec![
        ("M", Some(least(&states, |s| robot.mass_matrix(&s.q))), None),
        ("C", Some(least(&states, |s| robot.coriolis_matrix(&s.q, &s.v))), None),
        ("G", Some(least(&states, |s| robot.gravity_forces(&s.q))), None),
        ("M,C,G", Some(least(&states, all)), None),
        ("FD", Some(forward), Some(factored)),
    ]
}

struct Rows<'a, const NQ: usize, const NV: usize> {
    name: &'a str,
    states: &'a [State<NQ, NV>],
    beside: Vec<Beside>,
}

impl<const NQ: usize, const NV: usize> Stage<NQ, NV> for Rows<'_, NQ, NV> {
    fn enter<O: Entries>(&mut self, output: &str, call: impl Fn(&State<NQ, NV>) -> O) {
        let beside = self.beside.iter().find(|(known, ..)| *known == output);
        let cell = |time: Option<f64>| time.map_or(String::new(), |time| format!("{time:.1}"));
        let (by_hand, factored) = beside.map_or((None, None), |&(_, by_hand, factored)| (by_hand, factored));
        let ours = least(self.states, call);
        println!("| {} | {output} | {ours:.1} | {} | {} |", self.name, cell(by_hand), cell(factored));
    }
}
