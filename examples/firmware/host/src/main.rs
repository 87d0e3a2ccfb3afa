//! Builds the firmware, runs it under QEMU, and holds what it does against its promises.
//!
//! `cargo run` in this workspace does all of it. `cargo run -- --bless` writes the gains and the expected files instead
//! of comparing with them.
#![allow(clippy::print_stdout, reason = "the report is the product")]

mod agreement;
mod cargo;
mod clang;
mod cycles;
mod elf;
mod gains;
mod measure;
mod qemu;
mod table;
mod thumb;

use std::env;
use std::fs;
use std::path::Path;
use std::process::ExitCode;

use firmware_control::report::Printer;
use firmware_control::trial;

use crate::agreement::{Agreement, TOLERANCE, agreement_of_c, agreements};
use crate::cargo::{Profile, Target, build, refuses_panics, root, rustc};
use crate::elf::{Forbidden, Program};
use crate::measure::measure;
use crate::qemu::Machine;
use crate::table::{Column, differences, missed, table};

/// What was wrong, as a sentence.
pub(crate) type Result<T> = std::result::Result<T, String>;

/// Where the results are looked up, or written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mode {
    Compare,
    Bless,
}

fn main() -> ExitCode {
    let mode = match env::args().nth(1).as_deref() {
        None => Mode::Compare,
        Some("--bless") => Mode::Bless,
        Some(other) => {
            println!("error: `{other}` is no option; there is `--bless`");
            return ExitCode::FAILURE;
        }
    };
    match check(mode) {
        Ok(mistakes) if mistakes.is_empty() => {
            println!("\nThe firmware keeps its promises.");
            ExitCode::SUCCESS
        }
        Ok(mistakes) => {
            for mistake in &mistakes {
                println!("\nerror: {mistake}");
            }
            ExitCode::FAILURE
        }
        Err(error) => {
            println!("\nerror: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Everything; what is wrong of it.
fn check(mode: Mode) -> Result<Vec<String>> {
    for machine in [Machine::CortexM4, Machine::RiscV] {
        if !machine.is_there() {
            return Err(format!(
                "`{}` is not installed: `apt-get install qemu-system-arm qemu-system-misc`",
                machine.program()
            ));
        }
    }
    if !clang::is_there() {
        return Err("`clang` is not installed: `apt-get install clang`".to_owned());
    }
    let mut mistakes = vec![];
    let gains = gains::source()?;
    let gains_path = Path::new("control/src/gains.rs");
    compare(Mode::Compare, gains_path, &gains, &mut mistakes)?;
    if !mistakes.is_empty() {
        if mode == Mode::Bless {
            compare(mode, gains_path, &gains, &mut mistakes)?;
            mistakes
                .push("the gains were written: run once more, to have them in this program too".to_owned());
        }
        return Ok(mistakes);
    }

    let torques = torques();
    compare(mode, Path::new("expected/torques.txt"), &torques, &mut mistakes)?;
    println!("{torques}");
    println!("Largest error of a torque in single precision, over the largest torque:");
    agreements().iter().for_each(|agreement| judge(agreement, &mut mistakes));
    let c = clang::build()?;
    judge(&agreement_of_c(&qemu::run(Machine::CortexM4, &c.join("control"))?)?, &mut mistakes);

    println!("\nEach program: what it prints is what the host computes, and what is not in it.");
    for target in [Target::Arm, Target::RiscV] {
        for profile in Profile::ALL {
            promises(target, profile, &torques, &mut mistakes)?;
        }
    }

    for program in ["control", "methods"] {
        absent(&c, program, "C", true, &mut mistakes)?;
    }

    let fast = column(Machine::CortexM4, Profile::Release)?;
    let in_c = Column {
        title: "Cortex-M4F, in C".to_owned(),
        has_cycles: true,
        costs: measure(Machine::CortexM4, &c.join("methods"))?,
    };
    mistakes.extend([&fast, &in_c].into_iter().flat_map(missed));
    let small = column(Machine::CortexM4, Profile::Small)?;
    let soft = column(Machine::RiscV, Profile::Release)?;
    let costs = table(&format!("{}, {}", rustc()?, clang::version()?), &[fast, small, in_c, soft]);
    println!("\n{costs}");
    compare(mode, Path::new("expected/costs.txt"), &costs, &mut mistakes)?;
    Ok(mistakes)
}

/// Prints an agreement; a mistake if it is none.
fn judge(Agreement { robot, law, error }: &Agreement, mistakes: &mut Vec<String>) {
    println!("  {robot:12}{law:22}{error:8.1e}");
    if error.is_nan() || *error > TOLERANCE {
        mistakes.push(format!(
            "{robot}, {law}: single precision is {error:.1e} off, {TOLERANCE:.0e} are allowed"
        ));
    }
}

/// What the control loop prints, as the host computes it in the firmware's precision.
fn torques() -> String {
    let mut text = vec![];
    trial::all::<f32>(&mut Printer::new(|bytes: &[u8]| text.extend_from_slice(bytes)));
    String::from_utf8_lossy(&text).into_owned()
}

/// Builds for a target, runs on its machines, and looks at what was linked.
fn promises(target: Target, profile: Profile, torques: &str, mistakes: &mut Vec<String>) -> Result<()> {
    let folder = build(target, profile)?;
    for machine in [Machine::CortexM4, Machine::CortexM7, Machine::RiscV] {
        if machine.target() != target {
            continue;
        }
        let found = qemu::run(machine, &folder.join("control"))?;
        println!(
            "  {:8} runs on {} and prints the host's torques to the last bit",
            profile.name(),
            machine.name()
        );
        let (triple, profile) = (target.triple(), profile.name());
        for difference in differences(torques, &found) {
            mistakes.push(format!("torques of {triple}, {profile}, on {}:\n{difference}", machine.name()));
        }
    }
    if profile != Profile::Dev && !refuses_panics(target, profile)? {
        let (triple, profile) = (target.triple(), profile.name());
        mistakes.push(format!(
            "a program that can panic links for {triple}, {profile}: that others link proves nothing"
        ));
    }
    for program in ["control", "methods"] {
        // A debug build checks the arithmetic of loops and prints; it may panic, and nothing else of these.
        let what = format!("{}, {}", target.triple(), profile.name());
        absent(&folder, program, &what, profile != Profile::Dev, mistakes)?;
    }
    Ok(())
}

/// Looks at what was linked, for what must not be there.
fn absent(
    folder: &Path,
    program: &str,
    what: &str,
    no_panics: bool,
    mistakes: &mut Vec<String>,
) -> Result<()> {
    let elf = Program::read(&folder.join(program))?;
    let forbidden = elf.forbidden();
    let found = forbidden.iter().filter(|(what, _)| no_panics || *what != Forbidden::Panic);
    let found: Vec<_> = found.map(|(what, name)| format!("{what:?}: {name}")).collect();
    if found.is_empty() {
        let panics = if no_panics { "panic path, " } else { "" };
        println!("  {:8} {program}: no {panics}heap, f64 or libm", if what == "C" { what } else { "" });
    } else {
        let found = found.join("\n  ");
        mistakes.push(format!("{program} of {what} has what it must not have:\n  {found}"));
    }
    Ok(())
}

fn column(machine: Machine, profile: Profile) -> Result<Column> {
    let folder = build(machine.target(), profile)?;
    let costs = measure(machine, &folder.join("methods"))?;
    let cpu = match machine {
        Machine::CortexM4 => "Cortex-M4F",
        Machine::CortexM7 => "Cortex-M7",
        Machine::RiscV => "RV32IMAC",
    };
    let has_cycles = machine == Machine::CortexM4;
    Ok(Column { title: format!("{cpu}, {}", profile.name()), has_cycles, costs })
}

/// The file as it should be, or written so.
fn compare(mode: Mode, path: &Path, found: &str, mistakes: &mut Vec<String>) -> Result<()> {
    let full = root().join(path);
    if mode == Mode::Bless {
        return fs::write(&full, found).map_err(|error| format!("{}: {error}", path.display()));
    }
    let expected = fs::read_to_string(&full).map_err(|error| format!("{}: {error}", path.display()))?;
    for difference in differences(&expected, found) {
        mistakes.push(format!("{} is not as expected:\n{difference}", path.display()));
    }
    Ok(())
}
