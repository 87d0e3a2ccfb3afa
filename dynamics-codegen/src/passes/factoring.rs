//! The factors of a mass matrix in a straight line, for the loops that solve with them.
//!
//! In loops each row waits for those before it, and what the tree leaves zero is skipped in strips at best. The straight
//! line of a quadruped's factors had some 700 statements, and took a sixth off its derivatives of forward dynamics, which
//! are a straight line as a whole by now; it is there for robots of that size without branches that are alike.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::Program;
use super::schedule::schedule;
use crate::mechanics::composite::Square;
use crate::mechanics::equations::{Input, Inputs};
use crate::mechanics::factor::Factor;
use crate::symbolic::{Expr, Graph, SymbolId};

/// The most statements of such a program: the loops of the run time take over before rustc takes long.
const LONGEST: usize = 2_500;

/// Whether there is such a program.
pub(super) fn is_short(parents: &[Option<usize>]) -> bool {
    let depth = |k: usize| std::iter::successors(parents[k], |&k| parents[k]).count();
    (0..parents.len()).map(|k| depth(k) * depth(k)).sum::<usize>() <= LONGEST
}

/// From the entries of `M` on and below its diagonal, which are its parameters, to `R = L⁻¹`, all of it by rows, and
/// `1/D`; none where that is too long. `parents` are those by which M is factored.
pub(super) fn factoring(parents: &[Option<usize>]) -> Option<Program> {
    if !is_short(parents) {
        return None;
    }
    let graph = Graph::new();
    let n = parents.len();
    let inputs = Inputs { parameters: n * n, coordinates: 0, dof: 0 };
    let entry = |i: usize, j: usize| {
        let symbol = n * i.max(j) + i.min(j);
        graph.variable(SymbolId(u32::try_from(symbol).expect("fewer than 2^32 entries")))
    };
    let M: Square<Expr<'_>> = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
    let factor = Factor::of(&M, parents.to_vec());
    let results = [factor.inverse_triangle().concat(), factor.inverse_D].concat();
    Some(schedule(&graph, inputs, &results, |_| None))
}

/// `M⁻¹` by such a program, by rows, in numbers.
pub(super) fn inverse_by(program: &Program, M: &[Vec<f64>]) -> Vec<f64> {
    let n = M.len();
    let read = |input: Input| match input {
        Input::Parameter(k) => M[k / n][k % n],
        Input::Argument(..) => f64::NAN,
    };
    let found = program.evaluate(read, &[]);
    let (R, inverse_D) = found.split_at(n * n);
    let entry = |i: usize, j: usize| (0..n).map(|k| R[n * i + k] * inverse_D[k] * R[n * j + k]).sum();
    (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).map(|(i, j)| entry(i, j)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn its_factors_are_those_of_the_inverse() {
        // A fork: the last two are no ancestors of each other.
        let parents = [None, Some(0), Some(1), Some(1)];
        let M = [[5.0, 1.0, 0.5, 0.25], [1.0, 4.0, 0.75, 0.5], [0.5, 0.75, 3.0, 0.0], [0.25, 0.5, 0.0, 2.0]]
            .map(Vec::from);
        let inverse = inverse_by(&factoring(&parents).expect("it is short"), &M);
        for (i, row) in M.iter().enumerate() {
            for j in 0..4 {
                let entry: f64 = (0..4).map(|k| row[k] * inverse[4 * k + j]).sum();
                let expected = if i == j { 1.0 } else { 0.0 };
                assert!((entry - expected).abs() < 1e-15, "{i}, {j}: {entry}"); // a few roundings of numbers below one
            }
        }
    }

    #[test]
    fn long_chains_are_left_to_the_loops() {
        let chain = |n: usize| (0..n).map(|k| k.checked_sub(1)).collect::<Vec<_>>();
        assert!(factoring(&chain(16)).is_some());
        assert!(factoring(&chain(32)).is_none());
    }
}
