//! The binary `dynamics`: the compiler of robots from the command line.
//!
//! What it prints goes to standard output, and is the same for the same input; mistakes go to standard error. It exits
//! with 1 if the input is wrong, and with 2 if the command line is.

mod absence;
mod assignment;
mod attributes;
mod check;
mod coordinates;
mod count;
mod digits;
mod entry;
mod eval;
mod explain;
mod failure;
mod fields;
mod generate;
mod input;
mod limits;
mod linear;
mod motion;
mod output;
mod picture;
mod progress;
mod quantity;
mod reading;
mod render;
mod report;
mod robot;
mod rollouts;
mod rust_file;
mod rust_item;
mod simulate;
mod start;
mod state;
mod tree;
mod wording;

use std::process::ExitCode;

use clap::Parser;

/// Reads robots from URDF files, or from structs of Rust, and turns them into their equations of motion.
#[derive(Parser)]
#[command(name = "dynamics", version, after_help = EXAMPLES, arg_required_else_help = true)]
enum Command {
    Check(check::Args),
    Generate(generate::Args),
    Count(count::Args),
    Eval(eval::Args),
    Simulate(simulate::Args),
    Report(report::Args),
    Rollouts(rollouts::Args),
    Explain(explain::Args),
}

const EXAMPLES: &str = "\
Examples:
  dynamics check arm.urdf
  dynamics generate arm.urdf --lang rust --name Arm -o src/arm.rs
  dynamics eval arm.urdf --state '{\"q\": [0.1, 0.2], \"v\": [1, 0]}'
  dynamics simulate arm.urdf --time 10 --step 1e-3 --q 0.1,0.2 -o arm.csv
  dynamics report arm.urdf -o arm.html
  dynamics rollouts arm.urdf --time 5 --step 1e-3 --vary 'q.elbow = uniform(-1, 1)' --count 1000 -o arm.parquet
  dynamics explain MassNegative
  dynamics explain arm.rs

FILE is a URDF, or a file of Rust with `#[derive(Dynamics)]` on a struct. It may be `-`, for standard input.";

fn main() -> ExitCode {
    let done = match Command::parse() {
        Command::Check(args) => check::run(&args),
        Command::Generate(args) => generate::run(&args),
        Command::Count(args) => count::run(&args),
        Command::Eval(args) => eval::run(&args),
        Command::Simulate(args) => simulate::run(&args),
        Command::Report(args) => report::run(&args),
        Command::Rollouts(args) => rollouts::run(&args),
        Command::Explain(args) => explain::run(&args),
    };
    done.map_or_else(failure::Failure::report, |()| ExitCode::SUCCESS)
}
