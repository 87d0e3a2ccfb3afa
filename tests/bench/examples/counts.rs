//! How many operations the outputs take, beside what others take: `cargo run -p dynamics-bench --example counts`.
#![allow(clippy::print_stdout, reason = "the table is the product")]

use dynamics_bench::industrial::{iiwa14::Iiwa14, puma560_by_dh::Puma560ByDh};
use dynamics_bench::models::hyq::Hyq;
use dynamics_core::prelude::*;

/// Two point masses on two rods.
#[derive(Dynamics)]
#[dynamics(gravity = [0, 0, -g])]
#[joint(upper: revolute(x), world -> first)]
#[body(first, solid = point(m1), com = [0, 0, -l1])]
#[joint(lower: revolute(x), first -> second, at = [0, 0, -l1])]
#[body(second, solid = point(m2), com = [0, 0, -l2])]
struct DoublePendulum<T> {
    m1: T,
    m2: T,
    l1: T,
    l2: T,
    g: T,
}

/// Multiplications, additions, divisions.
type Count = [u32; 3];

struct Output {
    name: &'static str,
    cost: fn(&Costs) -> Cost,
    /// Of the best general algorithm, one by one, of so many revolute joints in a row.
    general: fn(u32) -> Option<Count>,
}

const OUTPUTS: [Output; 6] = [
    // W. Khalil, J.-F. Kleinfinger 1987.
    Output {
        name: "ID",
        cost: |costs| costs.inverse_dynamics,
        general: |n| Some([92 * n - 127, 81 * n - 117, 0]),
    },
    // Composite bodies, and articulated ones: R. Featherstone 2008.
    Output {
        name: "M",
        cost: |costs| costs.mass_matrix,
        general: |n| Some([10 * n * n + 22 * n - 32, 6 * n * n + 37 * n - 43, 0]),
    },
    Output { name: "C", cost: |costs| costs.coriolis_matrix, general: |_| None },
    Output { name: "M, C, G", cost: |costs| costs.equations_of_motion, general: |_| None },
    Output {
        name: "FD",
        cost: |costs| costs.forward_dynamics,
        general: |n| Some([224 * n - 259, 205 * n - 248, 0]),
    },
    Output { name: "ID, ∂ID", cost: |costs| costs.inverse_dynamics_with_derivatives, general: |_| None },
];

struct Robot {
    name: &'static str,
    costs: Costs,
    /// How many joints are in a row; none of a tree.
    joints: Option<u32>,
    /// What the prototype of this compiler took of each output.
    marks: [Option<Count>; OUTPUTS.len()],
}

const ROBOTS: [Robot; 4] = [
    Robot {
        name: "double pendulum",
        costs: DoublePendulum::<f64>::COST,
        joints: None, // in a plane a general algorithm would be no match
        marks: [
            Some([13, 10, 0]),
            Some([2, 2, 0]),
            Some([3, 2, 0]),
            Some([9, 6, 0]),
            Some([18, 12, 1]),
            Some([30, 16, 0]),
        ],
    },
    Robot {
        name: "PUMA 560",
        costs: Puma560ByDh::COST,
        joints: Some(6),
        marks: [
            Some([159, 145, 0]),
            Some([79, 72, 0]),
            Some([340, 283, 0]),
            Some([391, 315, 0]),
            Some([294, 252, 4]),
            Some([762, 733, 0]),
        ],
    },
    Robot {
        name: "iiwa14",
        costs: Iiwa14::COST,
        joints: Some(7),
        marks: [
            Some([193, 183, 0]),
            Some([97, 91, 0]),
            Some([432, 372, 0]),
            Some([497, 410, 0]),
            Some([405, 361, 5]),
            Some([1013, 988, 0]),
        ],
    },
    Robot {
        name: "HyQ",
        costs: Hyq::COST,
        joints: None,
        marks: [Some([637, 638, 0]), Some([284, 284, 0]), None, None, Some([1628, 1517, 14]), None],
    },
];

fn main() {
    println!("Multiplications, additions, divisions; and sines with their cosines:\n");
    println!(
        "| robot | output | ours | sines | mark | ours / mark | any arm |\n|---|---|--:|--:|--:|--:|--:|"
    );
    for Robot { name: robot, costs, joints, marks } in &ROBOTS {
        for (Output { name, cost, general }, mark) in OUTPUTS.iter().zip(marks) {
            let cost = cost(costs);
            let ours = [cost.multiplications, cost.additions, cost.divisions];
            let general = joints.and_then(general);
            println!(
                "| {robot} | {name} | {} | {} | {} | {} | {} |",
                text(Some(ours)),
                cost.sines_and_cosines,
                text(*mark),
                mark.map_or("–".to_owned(), |mark| verdict(ours, mark)),
                text(general),
            );
        }
    }
}

/// `193, 183` and divisions where there are some.
fn text(count: Option<Count>) -> String {
    match count {
        None => "–".to_owned(),
        Some([multiplications, additions, 0]) => format!("{multiplications}, {additions}"),
        Some([multiplications, additions, divisions]) => {
            format!("{multiplications}, {additions}, {divisions}")
        }
    }
}

/// Of all operations; bold where there are no more.
fn verdict(ours: Count, mark: Count) -> String {
    let [ours, mark] = [ours, mark].map(|count| f64::from(count.into_iter().sum::<u32>()));
    let ratio = ours / mark;
    if ours <= mark { format!("**{ratio:.2}**") } else { format!("{ratio:.2}") }
}
