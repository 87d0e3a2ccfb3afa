//! Outputs are as exact as their precision allows, and no less exact than by the textbook's way to them.
//!
//! Asked of the whole zoo at once: of one robot at a few states, luck is as large as what is promised. The errors
//! themselves are printed by `cargo bench -p dynamics-tests --bench accuracy`, and explained in `ACCURACY.md`.

use dynamics_tests::accuracy::{Row, in_double, in_single};
use dynamics_tests::zoo::{self, Entry};

/// How many states each robot is tried at.
const STATES: usize = 16;
/// The robots for which the marks are set: of up to so many degrees of freedom.
const SMALL: usize = 7;

/// The mark in `f64`: not quite three times the largest error of one rounding, 1.1e-16.
const DOUBLE: f64 = 3e-16;
/// The mark in `f32`: two and a half times 6e-8.
const SINGLE: f64 = 1.5e-7;

/// What is solved for with the mass matrix, whose condition multiplies what goes in, and energies that can be near zero:
/// at a few states of one robot these are not held against the mark.
const AMPLIFIED: [&str; 7] = ["a", "M⁻¹", "∂a/∂τ", "∂a/∂q", "∂a/∂v", "V", "T − V"];
/// What goes in here is rounded already: these are held against the plain recursion alone, in the middle too.
const SOLVED_TWICE: [&str; 2] = ["∂a/∂q", "∂a/∂v"];

/// How much larger than the plain recursion's the errors may be, in the mean over the zoo: at so few states means that are
/// equal differ by some hundredths.
const LUCK: f64 = 1.1;
/// How much larger than the mark the error of one robot may be: joints in oblique axes, ball joints and constants that
/// are rounded unluckily take two thirds more.
const ONE_ROBOT: f64 = 2.0;

#[test]
fn in_double_precision() {
    check(in_double, DOUBLE, f64::EPSILON);
}

#[test]
fn in_single_precision() {
    check(in_single, SINGLE, f32::EPSILON.into());
}

/// Holds the typical errors of each output against `mark` and against the plain recursion's; both roads are as good
/// where they err by one unit in the last place, `ulp`, or less.
fn check(measure: fn(&Entry, usize) -> Vec<Row>, mark: f64, ulp: f64) {
    let of_robots = zoo::on_all_cores(|entry| {
        let is_small = entry.space.speeds() <= SMALL;
        (entry.name, if is_small { measure(&entry, STATES) } else { vec![] })
    });
    let mut of_outputs: Vec<(&str, Vec<(&str, Row)>)> = Vec::new();
    for (name, rows) in of_robots {
        for row in rows {
            match of_outputs.iter_mut().find(|(output, _)| *output == row.output) {
                Some((_, rows)) => rows.push((name, row)),
                None => of_outputs.push((row.output, vec![(name, row)])),
            }
        }
    }
    assert!(of_outputs.len() >= 33, "there are {} outputs", of_outputs.len());
    let mut missed = Vec::new();
    for (output, rows) in of_outputs {
        let ratio = |(_, row): &(&str, Row)| (row.derived.typical.max(ulp) / row.plain.typical.max(ulp)).ln();
        let mean = (rows.iter().map(ratio).sum::<f64>() / rows.len() as f64).exp();
        if mean > LUCK {
            missed.push(format!("{output}: {mean:.2} times the error of the plain recursion"));
        }
        let middle = middle(rows.iter().map(|(_, row)| row.derived.typical).collect());
        if middle > mark && !SOLVED_TWICE.contains(&output) {
            missed.push(format!("{output}: {middle:.1e} in the middle of the zoo"));
        }
        for (name, Row { derived, .. }) in rows {
            if derived.typical > ONE_ROBOT * mark && !AMPLIFIED.contains(&output) {
                missed.push(format!("{output} of {name}: {:.1e}", derived.typical));
            }
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
