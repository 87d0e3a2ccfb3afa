//! How long the compiler takes for each robot of the zoo: `cargo bench -p dynamics-tests --bench expansion`.
//!
//! All outputs, from tokens to text, in milliseconds: the minimum of a few runs; and a file of ten thousand joints, which
//! is read and refused. Cargo builds benches optimised;
//! with `--profile dev` the compiler is as slow as in a user's build, where macros are not optimised.
#![allow(clippy::print_stdout, reason = "the table is the product")]

use std::time::{Duration, Instant};

use dynamics_codegen::spec::urdf::Urdf;
use dynamics_tests::{roads, zoo};

const RUNS: usize = 5;

fn main() {
    println!("{:<24} {:>3} {:>10} {:>8}", "robot", "n", "ms", "lines");
    let zoo = zoo::all().into_iter().map(|entry| (entry.name, entry.space.speeds(), entry.source));
    let humanoid = ("Humanoid, floating", 46, include_str!("../robots/humanoid/robot.txt"));
    for (name, n, source) in zoo.chain([humanoid]) {
        let item: syn::DeriveInput = syn::parse_str(source).expect("the robots are Rust");
        let mut best = Duration::MAX;
        let mut lines = 0;
        for _ in 0..RUNS {
            let start = Instant::now();
            let text = dynamics_codegen::generate_with(&item, roads::read).expect("the robots are sound");
            best = best.min(start.elapsed());
            lines = text.lines().count();
        }
        println!("{:<24} {:>3} {:>10.1} {:>8}", name, n, best.as_secs_f64() * 1e3, lines);
    }
    let huge = chain(10_000);
    let start = Instant::now();
    let refused = dynamics_codegen::generate_urdf("Chain", Urdf { file: "chain.urdf", text: &huge }, "");
    let elapsed = start.elapsed().as_secs_f64();
    let code = refused.err().map(|mistakes| mistakes.into_text()).unwrap_or_default();
    let reason = code.lines().next().unwrap_or_default();
    println!("10,000 joints: {reason}, after {:.0} ms", elapsed * 1e3);
}

/// A file of so many joints in a row.
fn chain(joints: usize) -> String {
    let mut text = "<robot name='chain'><link name='link0'/>".to_owned();
    for k in 1..=joints {
        text += &format!(
            "<link name='link{k}'><inertial><origin xyz='0.01 -0.02 0.1' rpy='0 0.3 0'/><mass value='1.5'/>\
             <inertia ixx='0.0123' ixy='1e-5' ixz='0' iyy='0.0234' iyz='0' izz='0.0198'/></inertial></link>\
             <joint name='joint{k}' type='continuous'><origin xyz='0 0.1 0.25' rpy='1.57 0 0'/>\
             <parent link='link{}'/><child link='link{k}'/><axis xyz='0 0 1'/></joint>\n",
            k - 1
        );
    }
    text + "</robot>"
}
