//! How long the compiler takes for each robot of the zoo: `cargo bench -p dynamics-tests --bench expansion`.
//!
//! All outputs, from tokens to text, in milliseconds: the minimum of a few runs. Cargo builds benches optimised;
//! with `--profile dev` the compiler is as slow as in a user's build, where macros are not optimised.
#![allow(clippy::print_stdout, reason = "the table is the product")]

use std::time::{Duration, Instant};

use dynamics_tests::zoo;

const RUNS: usize = 5;

fn main() {
    println!("{:<24} {:>3} {:>10} {:>8}", "robot", "n", "ms", "lines");
    let zoo = zoo::all().into_iter().map(|entry| (entry.name, entry.n, entry.source));
    let humanoid = ("Humanoid, floating", 46, include_str!("../robots/humanoid/robot.txt"));
    for (name, n, source) in zoo.chain([humanoid]) {
        let item: syn::DeriveInput = syn::parse_str(source).expect("the robots are Rust");
        let mut best = Duration::MAX;
        let mut lines = 0;
        for _ in 0..RUNS {
            let start = Instant::now();
            let text = dynamics_codegen::generate(&item).expect("the robots are sound");
            best = best.min(start.elapsed());
            lines = text.lines().count();
        }
        println!("{:<24} {:>3} {:>10.1} {:>8}", name, n, best.as_secs_f64() * 1e3, lines);
    }
}
