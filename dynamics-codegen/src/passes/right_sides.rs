//! Derivatives of forward dynamics solved for side by side: a number for each column.
//!
//! All columns of `∂a/∂q` and `∂a/∂v` are solved for with the same factors, by the same operations. So these stand in the
//! program once, for as many numbers as there are columns. It is a triangular system with rows of numbers: what is zero in
//! the factors is left out, what is zero in a single column is not. A column without any entry is zero.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::program::{Operand, Operation, Program, Source, Step};
use crate::mechanics::equations::{Block, Derivation, Method};

/// The fewest joints for which it is worth it: of fewer a column is a few operations.
const FEWEST: usize = 5;

/// What a method is solved from by each derivation, where it is worth it to solve for all columns at once.
pub(super) fn before_solving<'d, 'g: 'd>(
    derivations: impl Iterator<Item = &'d Derivation<'g>>,
    method: Method,
) -> Option<Vec<Vec<Block<'g>>>> {
    derivations
        .map(|derivation| {
            let n = derivation.inputs.dof;
            let blocks = (n >= FEWEST).then(|| derivation.before_solving(method)).flatten()?;
            are_full(&blocks, n).then_some(blocks)
        })
        .collect()
}

/// Whether the columns that have entries have three quarters of them: what is zero is computed with as well.
fn are_full(blocks: &[Block<'_>], n: usize) -> bool {
    let right = blocks.iter().filter(|block| matches!(block.name, "da_dq" | "da_dv"));
    let columns = right.flat_map(|block| (0..n).map(|k| block.entries.iter().skip(k).step_by(n)));
    let (mut all, mut there) = (0, 0);
    for column in columns {
        let count = column.filter(|entry| !entry.is_zero()).count();
        if count > 0 {
            (all, there) = (all + n, there + count);
        }
    }
    there > 0 && 4 * there >= 3 * all
}

/// From the program of what [`Derivation::before_solving`] has to that of the result: `M⁻¹` and what comes before the
/// right-hand sides stay as they are.
pub(super) fn solved<'g>(
    blocks: Vec<Block<'g>>,
    mut program: Program,
    n: usize,
) -> (Vec<Block<'g>>, Program) {
    let results = std::mem::take(&mut program.results);
    let square = n * n;
    let first = results.len() - 4 * square;
    let (before, [right, inverse, factors]) = (
        &results[..first],
        [
            first..first + 2 * square,
            first + 2 * square..first + 3 * square,
            first + 3 * square..results.len(),
        ]
        .map(|range| &results[range]),
    );
    let b = |column: usize, row: usize| right[column / n * square + row * n + column % n];
    let columns: Vec<usize> =
        (0..2 * n).filter(|&column| (0..n).any(|row| !is_zero(b(column, row)))).collect();
    let mut solver = Solver { program, factors, n, lanes: columns.len() };
    let rows = (0..n).map(|row| columns.iter().map(|&column| b(column, row)).collect()).collect();
    let x = solver.minus_solved(rows);
    let mut entries = vec![Operand { source: Source::Constant(0.0), negative: false }; 2 * square];
    for (lane, &column) in columns.iter().enumerate() {
        for (row, &x) in x.iter().enumerate() {
            entries[column / n * square + row * n + column % n] = solver.push(Operation::Lane(x, lane), 1);
        }
    }
    let mut program = solver.program;
    program.results = [before, &entries, inverse].concat();
    program.count_uses();
    (blocks.into_iter().take_while(|block| block.name != "factors").collect(), program)
}

fn is_zero(operand: Operand) -> bool {
    operand.source == Source::Constant(0.0)
}

/// What is appended to a program.
struct Solver<'a> {
    program: Program,
    /// L below the diagonal, and `1/D` on it, by rows.
    factors: &'a [Operand],
    n: usize,
    lanes: usize,
}

impl Solver<'_> {
    /// The rows of `−M⁻¹·B` of those of B, with `M = Lᵀ D L`.
    fn minus_solved(&mut self, rows: Vec<Vec<Operand>>) -> Vec<Operand> {
        let mut x: Vec<Operand> = rows.into_iter().map(|row| self.side_by_side(row)).collect();
        for i in (0..self.n).rev() {
            for j in 0..i {
                self.subtract(i, j, x[i], &mut x[j]);
            }
        }
        for (i, x) in x.iter_mut().enumerate() {
            let inverse = self.factors[i * self.n + i];
            *x = self.push(Operation::Mul(negated(inverse), *x), self.lanes);
        }
        for i in 0..self.n {
            for j in 0..i {
                let other = x[j];
                self.subtract(i, j, other, &mut x[i]);
            }
        }
        x
    }

    /// Takes `L[i][j]` times one row from another.
    fn subtract(&mut self, i: usize, j: usize, one: Operand, from: &mut Operand) {
        let l = self.factors[i * self.n + j];
        if !is_zero(l) {
            *from = self.push(Operation::MulAdd(negated(l), one, *from), self.lanes);
        }
    }

    fn side_by_side(&mut self, row: Vec<Operand>) -> Operand {
        self.program.rows.push(row);
        self.push(Operation::Each(self.program.rows.len() - 1), self.lanes)
    }

    fn push(&mut self, operation: Operation, lanes: usize) -> Operand {
        self.program.steps.push(Step { operation, uses: 0, lanes });
        Operand { source: Source::Step(self.program.steps.len() - 1), negative: false }
    }
}

fn negated(operand: Operand) -> Operand {
    Operand { negative: !operand.negative, ..operand }
}
