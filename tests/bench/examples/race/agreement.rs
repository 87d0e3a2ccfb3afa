//! Whether all contestants compute the same numbers.

use std::fmt;

use dynamics_bench::contest::OUTPUTS;

use crate::contestants::{Contestant, Line, Programs};

/// The largest difference of ours, of the largest entry of a result. HyQ's file has π/2 to eleven places, which ours takes
/// for a right angle and Pinocchio does not: 3e-11. Elsewhere only rounding differs, by 1e-12 at most.
const TOLERANCE: f64 = 1e-10;
/// That of CasADi's C: its generator takes lengths below a nanometre for none, and the double pendulum has one.
const TOLERANCE_OF_CASADI: f64 = 1e-8;

/// How many states contestants print results of.
const COMPARED: usize = 8;

/// The largest difference between a contestant and Pinocchio.
pub(crate) struct Difference {
    pub(crate) robot: String,
    pub(crate) output: String,
    pub(crate) contestant: Contestant,
    /// Of the largest entry of the result, at the worst of the states.
    pub(crate) relative: f64,
}

impl Difference {
    pub(crate) fn is_too_large(&self) -> bool {
        // Not a number is too large as well.
        !matches!(self.relative.partial_cmp(&self.tolerance()), Some(std::cmp::Ordering::Less))
    }

    fn tolerance(&self) -> f64 {
        if self.contestant == Contestant::Casadi { TOLERANCE_OF_CASADI } else { TOLERANCE }
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { robot, output, contestant, relative } = self;
        write!(
            f,
            "{output} of {robot} by {contestant:?} is off by {relative:.1e}, more than {:.0e}",
            self.tolerance()
        )
    }
}

/// Compares all outputs of a robot.
pub(crate) fn of(robot: &str, programs: &Programs) -> Vec<Difference> {
    let states = programs.read_states(robot);
    let lines = programs.values(robot);
    let mut differences = vec![];
    for (output, _) in OUTPUTS {
        let of_output = || lines.iter().filter(move |line| line.output == output);
        let judge = of_output().find(|line| line.contestant == Contestant::Pinocchio);
        let judge = judge.unwrap_or_else(|| panic!("Pinocchio has no {output} of {robot}"));
        for line in of_output().filter(|line| line.contestant != Contestant::Pinocchio) {
            differences.push(Difference {
                robot: robot.to_owned(),
                output: output.to_owned(),
                contestant: line.contestant,
                relative: largest(line, judge, &states),
            });
        }
    }
    differences
}

/// The largest difference over the states, each of its largest entry. CasADi's ∂ID stops before `M`.
fn largest(line: &Line, judge: &Line, states: &[Vec<f64>]) -> f64 {
    let (found, expected) = (line.numbers.len() / COMPARED, judge.numbers.len() / COMPARED);
    let pairs = line.numbers.chunks(found).zip(judge.numbers.chunks(expected)).zip(states);
    let mut largest = 0.0_f64;
    for ((found, expected), state) in pairs {
        let (found, expected) = match line.output.as_str() {
            "C" => (times_speeds(found, state), times_speeds(expected, state)),
            _ => (found.to_vec(), expected.to_vec()),
        };
        let size = expected.iter().fold(f64::MIN_POSITIVE, |size, x| size.max(x.abs()));
        let off = |(found, expected): (&f64, &f64)| (found - expected).abs() / size;
        // Unlike `f64::max`, this keeps what is not a number.
        largest = found.iter().zip(&expected).map(off).fold(largest, |a, b| if b <= a { a } else { b });
    }
    largest
}

/// `C·v` where a base floats: there, many matrices `C` are as good, and each contestant has its own.
fn times_speeds(matrix: &[f64], state: &[f64]) -> Vec<f64> {
    let n = matrix.len().isqrt();
    if state.len() == 3 * n {
        return matrix.to_vec();
    }
    let v = &state[state.len() - 2 * n..][..n];
    matrix.chunks(n).map(|row| row.iter().zip(v).map(|(entry, v)| entry * v).sum()).collect()
}
