//! The table of costs, and the marks that it must not miss.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::measure::Cost;

/// The robots, in the order of the table: modules of the program `methods`.
const ROBOTS: [&str; 7] =
    ["scalar", "robojudge", "robojudge_prepared", "cart_pole", "leg", "puma560", "iiwa14"];

/// The methods and the laws, in the order of the table.
pub(crate) const METHODS: [&str; 13] = [
    "sin_cos",
    "mass_matrix",
    "coriolis_matrix",
    "gravity_forces",
    "bias_forces",
    "equations_of_motion",
    "inverse_dynamics",
    "forward_dynamics",
    "inverse_dynamics_derivatives",
    "forward_dynamics_derivatives",
    "computed_torque",
    "state_feedback",
    "state_update",
];

/// What was measured of one program.
#[derive(Debug)]
pub(crate) struct Column {
    pub(crate) title: String,
    /// Whether the manual of the core has cycles.
    pub(crate) has_cycles: bool,
    pub(crate) costs: BTreeMap<String, Cost>,
}

/// The most that a method may take on a Cortex-M4F, compiled for speed.
struct Mark {
    method: &'static str,
    instructions: usize,
    flash: usize,
    stack: u32,
}

const MARKS: [Mark; 3] = [
    Mark { method: "puma560::inverse_dynamics", instructions: 1200, flash: 6 * 1024, stack: 512 },
    Mark { method: "iiwa14::inverse_dynamics", instructions: 1600, flash: 8 * 1024, stack: 640 },
    Mark { method: "robojudge::equations_of_motion", instructions: 250, flash: usize::MAX, stack: u32::MAX },
];

/// The table as text.
pub(crate) fn table(compilers: &str, columns: &[Column]) -> String {
    let mut text = format!(
        "{compilers}\n\nOne call: executed instructions, the most cycles by the manual, bytes of flash, bytes of stack.\n\
         An equals sign: no other number of instructions is possible, the code has one way through.\n\n"
    );
    let mut line = format!("{:50}", "");
    for Column { title, has_cycles, .. } in columns {
        let width = if *has_cycles { 40 } else { 32 };
        let _ = write!(line, "{title:>width$}");
    }
    line += &format!("\n{:20}{:30}", "robot", "method");
    for Column { has_cycles, .. } in columns {
        let cycles = if *has_cycles { "cycles" } else { "" };
        let width = if *has_cycles { 8 } else { 0 };
        let _ = write!(line, "{:>18}{cycles:>width$}{:>7}{:>7}", "instructions", "flash", "stack");
    }
    text += &line;
    text.push('\n');
    for (robot, method) in ROBOTS.iter().flat_map(|robot| METHODS.iter().map(move |method| (robot, method))) {
        let name = format!("{robot}::{method}");
        let cells: Vec<_> =
            columns.iter().map(|column| (column.costs.get(&name), column.has_cycles)).collect();
        if cells.iter().all(|(cost, _)| cost.is_none()) {
            continue;
        }
        let _ = write!(text, "{robot:20}{method:30}");
        for (cost, has_cycles) in cells {
            text += &cell(cost, has_cycles);
        }
        text.truncate(text.trim_end().len());
        text.push('\n');
    }
    text
}

fn cell(cost: Option<&Cost>, has_cycles: bool) -> String {
    let width = if has_cycles { 8 } else { 0 };
    let Some(Cost { least, most, straight, cycles, stack, flash }) = cost else {
        return format!("{:>18}{:>width$}{:>7}{:>7}", "-", if has_cycles { "-" } else { "" }, "-", "-");
    };
    let instructions = match straight {
        true => format!("= {most}"),
        false if least == most => format!("{most}"),
        false => format!("{least} to {most}"),
    };
    let cycles = match cycles {
        Some(cycles) => format!("{cycles}"),
        None if has_cycles => "-".to_owned(),
        None => String::new(),
    };
    format!("{instructions:>18}{cycles:>width$}{flash:>7}{stack:>7}")
}

/// The marks that were missed.
pub(crate) fn missed(column: &Column) -> Vec<String> {
    let mut missed = vec![];
    let title = &column.title;
    for Mark { method, instructions, flash, stack } in MARKS {
        let Some(cost) = column.costs.get(method) else { continue };
        let mut check = |what: &str, found: usize, most: usize| {
            if found > most {
                missed.push(format!("{title}: `{method}` takes {found} {what}, {most} are allowed"));
            }
        };
        check("instructions", cost.most, instructions);
        check("bytes of flash", cost.flash, flash);
        check("bytes of stack", cost.stack as usize, usize::try_from(stack).unwrap_or(usize::MAX));
        if !cost.straight {
            missed.push(format!("{title}: `{method}` is not one straight line"));
        }
    }
    missed
}

/// What of `found` is not as `expected`: other words or numbers, if the compiler is the same; by another one numbers may
/// differ by a tenth.
pub(crate) fn differences(expected: &str, found: &str) -> Vec<String> {
    let same_compiler = expected.lines().next() == found.lines().next();
    let close = |expected: &str, found: &str| match (expected.parse::<f64>(), found.parse::<f64>()) {
        (Ok(expected), Ok(found)) => (found - expected).abs() <= 0.1 * expected + 8.0,
        _ => expected == found,
    };
    let as_expected = |expected: &str, found: &str| {
        let words = || expected.split_whitespace().zip(found.split_whitespace());
        let as_long = expected.split_whitespace().count() == found.split_whitespace().count();
        expected == found
            || !same_compiler && as_long && words().all(|(expected, found)| close(expected, found))
    };
    let skip = usize::from(!same_compiler);
    let (mut expected, mut found) = (expected.lines().skip(skip), found.lines().skip(skip));
    let mut differences = vec![];
    loop {
        match (expected.next(), found.next()) {
            (None, None) => return differences,
            (Some(expected), Some(found)) if as_expected(expected, found) => {}
            (expected, found) => {
                differences.push(format!(
                    "- {}\n+ {}",
                    expected.unwrap_or_default(),
                    found.unwrap_or_default()
                ));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_compiler_must_give_the_same_numbers() {
        assert!(differences("rustc 1\na = 100", "rustc 1\na = 100").is_empty());
        assert_eq!(differences("rustc 1\na = 100\nb", "rustc 1\na = 101\nb"), ["- a = 100\n+ a = 101"]);
    }

    #[test]
    fn another_compiler_may_give_a_tenth_more() {
        assert!(differences("rustc 1\na = 100", "rustc 2\na  = 118").is_empty());
        assert_eq!(differences("rustc 1\na = 100", "rustc 2\na = 119").len(), 1);
        assert_eq!(differences("rustc 1\na = 100", "rustc 2\na 100").len(), 1);
        assert_eq!(differences("rustc 1\na", "rustc 2\na\nb").len(), 1);
    }
}
