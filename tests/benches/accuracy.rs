//! How exact every output is, as tables in Markdown: `cargo bench -p dynamics-tests --bench accuracy`.
//!
//! Names of robots as arguments choose among all of the zoo. `ACCURACY.md` says what the tables mean.
#![allow(clippy::print_stdout, reason = "the tables are the product")]

use dynamics_core::prelude::*;
use dynamics_tests::accuracy::{Errors, Row, in_double, in_single};
use dynamics_tests::zoo::{self, Entry};
use dynamics_tests::{Forms, Part, Space, specialised};

/// The robots of the tables, but for chains.
const ROBOTS: [&str; 9] = [
    "CartPole",
    "DoublePendulum",
    "SphericalPendulum",
    "Scara",
    "StanfordArm",
    "Puma560",
    "Iiwa14",
    "BallInChain",
    "Hyq",
];

/// States times degrees of freedom: a hundred states of an arm of seven joints.
const STATES: usize = 700;

/// A robot of `tests/bench/robots` with so many joints; what is in single precision of long ones takes minutes more to
/// compile, and says nothing new.
macro_rules! chain {
    ($module:ident = $name:ident, $n:literal, [$($frame:ident),*], single = $single:expr; $($item:tt)*) => {
        mod $module {
            use super::*;

            #[derive(Dynamics, Clone, Copy)]
            $($item)*

            fn forms<T: Scalar + PartialOrd + Into<f64>>() -> Forms<T> {
                let robot = || Box::new(specialised!([$($frame),*] [$name] T, $name));
                Forms { robot: robot(), prepared: robot() }
            }

            pub(super) fn entry() -> Entry {
                Entry {
                    name: $name::NAME,
                    source: stringify!($($item)*),
                    parameters: &[],
                    space: Space(&[Part::Lines($n)]),
                    costs: $name::COST,
                    joint_names: $name::JOINT_NAMES,
                    body_names: $name::BODY_NAMES,
                    parameter_names: $name::PARAMETER_NAMES,
                    base_parameter_names: $name::BASE_PARAMETER_NAMES,
                    double: Some(forms()),
                    single: $single,
                    dual: None,
                }
            }
        }
    };
}

chain! {
    chain4 = Chain4, 4, [Link1, Link2, Link3, Link4], single = Some(forms());
    #[dynamics(urdf = "bench/robots/chain4.urdf")]
    pub(super) struct Chain4;
}

chain! {
    chain16 = Chain16, 16, [Link1, Link2, Link3, Link4, Link5, Link6, Link7, Link8, Link9, Link10, Link11, Link12,
        Link13, Link14, Link15, Link16], single = None;
    #[dynamics(urdf = "bench/robots/chain16.urdf")]
    pub(super) struct Chain16;
}

chain! {
    chain32 = Chain32, 32, [Link1, Link2, Link3, Link4, Link5, Link6, Link7, Link8, Link9, Link10, Link11, Link12,
        Link13, Link14, Link15, Link16, Link17, Link18, Link19, Link20, Link21, Link22, Link23, Link24, Link25, Link26,
        Link27, Link28, Link29, Link30, Link31, Link32], single = None;
    #[dynamics(urdf = "bench/robots/chain32.urdf")]
    pub(super) struct Chain32;
}

/// The derive leaves regressors out of what a robot of this size has by default, and so do the tables.
mod without_regressors {
    use super::*;
    use dynamics_core::{BaseRegressor, Regressor};

    impl<T: Scalar> Regressor<T, 32, 32, 0> for chain32::Chain32 {
        fn regressor(&self, _: &SVector<T, 32>, _: &SVector<T, 32>, _: &SVector<T, 32>) -> SMatrix<T, 32, 0> {
            SMatrix::zeros()
        }
        fn inertial_parameters(&self) -> SVector<T, 0> {
            SVector::zeros()
        }
    }

    impl<T: Scalar> BaseRegressor<T, 32, 32, 0> for chain32::Chain32 {
        fn base_regressor(
            &self,
            _: &SVector<T, 32>,
            _: &SVector<T, 32>,
            _: &SVector<T, 32>,
        ) -> SMatrix<T, 32, 0> {
            SMatrix::zeros()
        }
        fn base_parameters(&self) -> SVector<T, 0> {
            SVector::zeros()
        }
    }
}

/// What is said of a robot in one precision.
type Of = (&'static str, Vec<Row>);

fn main() {
    let wanted: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let wants = |name: &str| match wanted.is_empty() {
        true => ROBOTS.contains(&name) || name.starts_with("Chain"),
        false => wanted.iter().any(|wanted| wanted == name),
    };
    let mut entries: Vec<Entry> = zoo::all();
    entries.extend([chain4::entry(), chain16::entry(), chain32::entry()]);
    entries.retain(|entry| wants(entry.name));
    entries.sort_by_key(|entry| entry.space.speeds());
    for (precision, unit, rows) in
        [("f64", 1e-16, in_double as fn(&Entry, usize) -> Vec<Row>), ("f32", 1e-8, in_single)]
    {
        let of = |entry: &Entry| (entry.name, rows(entry, STATES / entry.space.speeds()));
        let robots: Vec<Of> = entries.iter().map(of).filter(|(_, rows)| !rows.is_empty()).collect();
        table(&format!("{precision}, typical (median), in {unit:e}"), &robots, |errors| {
            errors.typical / unit
        });
        table(&format!("{precision}, worst, in {unit:e}"), &robots, |errors| errors.worst / unit);
    }
}

/// Outputs by rows, robots by columns; derived Rust / plain recursion.
fn table(title: &str, robots: &[Of], of: impl Fn(Errors) -> f64) {
    let mut outputs: Vec<&str> = Vec::new();
    for row in robots.iter().flat_map(|(_, rows)| rows) {
        if !outputs.contains(&row.output) {
            outputs.push(row.output);
        }
    }
    println!("\n### {title}\n");
    println!("| |{}", robots.iter().map(|(name, _)| format!(" {name} |")).collect::<String>());
    println!("|---|{}", "---:|".repeat(robots.len()));
    for output in outputs {
        let cell = |(_, rows): &Of| match rows.iter().find(|row| row.output == output) {
            Some(row) => format!(" {} / {} |", short(of(row.derived)), short(of(row.plain))),
            None => " |".to_owned(),
        };
        println!("| {output} |{}", robots.iter().map(cell).collect::<String>());
    }
}

/// Two digits.
fn short(x: f64) -> String {
    if x < 9.95 { format!("{x:.1}") } else { format!("{x:.0}") }
}
