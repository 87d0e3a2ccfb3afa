//! The inverse of a mass matrix in its own place, and what the matrix is solved with on the way.
//!
//! `τ = M·a` is solved for the accelerations, four at a time, from the tips to the base. With those that it was solved for
//! called S and the others U, the matrix holds
//!
//! ```text
//! U, U   M_UU − M_US M_SS⁻¹ M_SU
//! U, S   M_US M_SS⁻¹
//! S, S   M_SS⁻¹
//! ```
//!
//! and M⁻¹ in the end. Four joints' own entries are `Lᵀ D L` with a small triangular L, and their rows `Lᵀ Y`; all other
//! entries change by `±Yᵀ D⁻¹ Y`, a product of which each term is there at once. The part of Y that is in S are rows of
//! `−Rᵀ`, where R is the inverse of the whole matrix's triangular factor.
//!
//! One half of the matrix is kept, in each row what is on the diagonal and after it: there the rows of the four are their own,
//! and before it they take what lies in the columns of others. Off the tree all stays zero, and is skipped strip by strip.
//!
//! F. Bauer, C. Reinsch, *Inversion of positive definite matrices by the Gauss-Jordan method*, in: Handbook for Automatic
//! Computation II, Springer 1971.

use core::ops::Range;

use super::elimination_tree::EliminationTree;
use super::in_place::mirror;
use super::solve::Factors;
use super::{entry, set};
use crate::product::{LONG_STRIP, STRIP, by_rows, has_lanes};
use crate::scalar::Scalar;

/// `by_rest!(WIDTH = N % STRIP, expression)`: the expression with the constant `WIDTH`, so many as strips leave; none if
/// they leave none.
macro_rules! by_rest {
    ($width:ident = $rest:expr, $expression:expr) => {
        if const { $rest == 1 } {
            const $width: usize = 1;
            $expression
        } else if const { $rest == 2 } {
            const $width: usize = 2;
            $expression
        } else if const { $rest == 3 } {
            const $width: usize = 3;
            $expression
        }
    };
}

/// `by_parts!(T, SIZE, start in range of N, expression)`: the expression for parts of so many columns of N, `SIZE`, from
/// `start` on: as many as are summed at a time, and fewer where these end.
macro_rules! by_parts {
    ($scalar:ident, $size:ident, $start:ident in $range:ident of $n:ident, $expression:expr) => {{
        let Range { start: mut $start, end } = $range;
        macro_rules! part {
            () => {
                // Or else LLVM asks at each entry.
                if has_room($start, $size, $n) {
                    $expression;
                }
                $start += $size;
            };
        }
        macro_rules! part_if_there_is {
            ($columns:expr) => {
                if $start + $columns <= end {
                    const $size: usize = $columns;
                    part!();
                }
            };
        }
        by_rows!(
            $scalar,
            $size = LONG_STRIP,
            while $start + $size <= end {
                part!();
            }
        );
        if const { !has_lanes::<$scalar>() } {
            part_if_there_is!(STRIP);
            part_if_there_is!(2);
        }
        while $start < end {
            const $size: usize = 1;
            part!();
        }
    }};
}

/// The inverse of a symmetric positive definite matrix, both halves, in its place. What is on the diagonal and after it in
/// each row is read. The factors are written, if they are wanted.
///
/// # Cost
///
/// N³/2 multiplications and additions, fused where the target can; N divisions.
#[inline(never)]
pub(super) fn invert<T: Scalar, const N: usize>(
    m: &mut [[T; N]; N],
    tree: &EliminationTree<N>,
    mut factors: Option<&mut Factors<T, N>>,
) {
    let mut multiples = [[T::zero(); N]; STRIP];
    let rest = N / STRIP * STRIP;
    let mut block = Block::at(m, rest.saturating_sub(STRIP));
    by_rest!(WIDTH = N % STRIP, {
        let own = Block::<T, WIDTH>::at(m, rest);
        block = step(m, tree, rest, &own, &mut multiples, factors.as_deref_mut());
    });
    for strip in (0..N / STRIP).rev() {
        block = step(m, tree, strip * STRIP, &block, &mut multiples, factors.as_deref_mut());
    }
    mirror!(m, N);
}

/// Solves for the accelerations of the W joints from `first` on; returns the factors of the four before them.
#[inline(always)]
fn step<T: Scalar, const N: usize, const W: usize>(
    m: &mut [[T; N]; N],
    tree: &EliminationTree<N>,
    first: usize,
    block: &Block<T, W>,
    multiples: &mut [[T; N]; STRIP],
    factors: Option<&mut Factors<T, N>>,
) -> Block<T, STRIP> {
    let mut next = Block::one();
    let (strip, end) = (first / STRIP, first + W);
    let (Some(multiples), Some((before, others))) =
        (multiples.first_chunk_mut(), m.split_at_mut_checked(first))
    else {
        return next;
    };
    let Some((own, after)) = others.split_first_chunk_mut::<W>() else { return next };
    write(own, first, &minus_one());
    for run in tree.related(strip) {
        if let Some(rows) = before.get(run.start..run.end.min(first)) {
            read_transposed(rows, first, own, run.start);
        }
    }
    let minus_inverse_d = block.inverse_d.map(|x| -x);
    for run in tree.related(strip) {
        block.eliminate(&minus_inverse_d, own, multiples, run.start..run.end.min(first));
        block.eliminate(&block.inverse_d, own, multiples, run.start.max(first)..run.end);
    }
    if let Some(factors) = factors {
        factors.keep(own, first, &block.inverse_d);
    }

    // The four that are next come first: all that waits is in there.
    for (other, rows) in before.as_chunks_mut::<STRIP>().0.iter_mut().enumerate().rev() {
        let row = other * STRIP;
        if tree.related(strip).any(|run| run.contains(&row)) {
            for run in tree.related(strip) {
                add(rows, multiples, row, own, run.start.max(row)..run.end);
            }
        }
        if row + STRIP == first {
            next = Block::of(&read(rows, row));
        }
    }
    for run in tree.related(strip) {
        let columns = run.start..run.end.min(first);
        block.substitute(multiples, columns.clone());
        if let Some(rows) = before.get_mut(columns) {
            write_transposed(rows, first, multiples, run.start);
        }
    }
    for run in tree.related(strip) {
        for row in (run.start.max(end)..run.end).step_by(STRIP) {
            let Some(rows) = after.get_mut(row - end..) else { continue };
            for run in tree.related(strip) {
                let columns = run.start.max(row)..run.end;
                if let Some(rows) = rows.first_chunk_mut::<STRIP>() {
                    add(rows, multiples, row, own, columns);
                } else {
                    by_rest!(WIDTH = N % STRIP, {
                        if let Some(rows) = rows.first_chunk_mut::<WIDTH>() {
                            add(rows, multiples, row, own, columns);
                        }
                    });
                }
            }
        }
    }
    for run in tree.related(strip) {
        let columns = run.start.max(first)..run.end;
        block.substitute(multiples, columns.clone());
        copy(multiples, own, columns);
    }
    next
}

impl<T: Scalar, const N: usize> Factors<T, N> {
    /// Writes W columns of `−R` from the rows of its transpose, from `first` on.
    #[inline(never)]
    fn keep<const W: usize>(&mut self, rows: &[[T; N]; W], first: usize, inverse_d: &[T; W]) {
        if let Some(own) = self.inverse_d.get_mut(first..).and_then(<[T]>::first_chunk_mut) {
            *own = *inverse_d;
        }
        for run in self.tree.related(first / STRIP) {
            let run = run.start.max(first)..run.end;
            if let Some(columns) = self.minus_r_transposed.get_mut(run.clone()) {
                write_transposed(columns, first, rows, run.start);
            }
            if let Some(columns) = self.minus_r.get_mut(first..).and_then(<[_]>::first_chunk_mut) {
                copy(rows, columns, run);
            }
        }
    }
}

/// The factors of what is on the diagonal of W rows, `Lᵀ D L`.
struct Block<T, const W: usize> {
    /// `−L` below the diagonal.
    minus_l: [[T; W]; W],
    inverse_d: [T; W],
}

impl<T: Scalar, const W: usize> Block<T, W> {
    #[inline(always)]
    fn one() -> Self {
        Self { minus_l: [[T::zero(); W]; W], inverse_d: [T::one(); W] }
    }

    /// Of the rows of a matrix from `first` on.
    #[inline(always)]
    fn at<const N: usize>(m: &[[T; N]; N], first: usize) -> Self {
        let rows = m.get(first..).and_then(<[_]>::first_chunk::<W>);
        rows.map_or_else(Self::one, |rows| Self::of(&read(rows, first)))
    }

    /// Of what is on the diagonal and after it.
    ///
    /// On its own: LLVM would sum entry by entry what only some entries are needed of.
    #[inline(never)]
    fn of(m: &[[T; W]; W]) -> Self {
        let Self { mut minus_l, mut inverse_d } = Self::one();
        let mut rows = [[T::zero(); W]; W];
        for (w, row) in rows.iter_mut().enumerate() {
            for (x, column) in row.iter_mut().zip(m) {
                *x = entry(column, w);
            }
        }
        for w in (0..W).rev() {
            let Some((before, [row, ..])) = rows.split_at_mut_checked(w) else { continue };
            let inverse = T::one() / entry(row, w);
            let (Some(minus_l), Some(inverse_d)) = (minus_l.get_mut(w), inverse_d.get_mut(w)) else {
                continue;
            };
            *inverse_d = inverse;
            for ((l, other), x) in minus_l.iter_mut().zip(before).zip(&*row) {
                *l = -*x * inverse;
                add_multiple(other, *l, row);
            }
        }
        Self { minus_l, inverse_d }
    }

    /// Some columns of the rows without `Lᵀ`, in their place, and `scales` times each.
    #[inline(never)]
    fn eliminate<const N: usize>(
        &self,
        scales: &[T; W],
        rows: &mut [[T; N]; W],
        multiples: &mut [[T; N]; W],
        columns: Range<usize>,
    ) {
        by_parts!(T, COLUMNS, first in columns of N, {
            let mut part: [[T; COLUMNS]; W] = read(rows, first);
            for (w, minus_l) in self.minus_l.iter().enumerate().rev() {
                let Some((before, [row, ..])) = part.split_at_mut_checked(w) else { continue };
                let row = *row;
                for (other, factor) in before.iter_mut().zip(minus_l) {
                    add_multiple(other, *factor, &row);
                }
            }
            write(rows, first, &part);
            for (row, scale) in part.iter_mut().zip(scales) {
                for x in row {
                    *x *= *scale;
                }
            }
            write(multiples, first, &part);
        });
    }

    /// Some columns of the multiples without L, negated.
    #[inline(never)]
    fn substitute<const N: usize>(&self, multiples: &mut [[T; N]; W], columns: Range<usize>) {
        by_parts!(T, COLUMNS, first in columns of N, {
            let mut part: [[T; COLUMNS]; W] = read(multiples, first);
            for (w, minus_l) in self.minus_l.iter().enumerate() {
                let Some((before, [row, ..])) = part.split_at_mut_checked(w) else { continue };
                for (other, factor) in before.iter().zip(minus_l) {
                    add_multiple(row, *factor, other);
                }
            }
            for x in part.as_flattened_mut() {
                *x = -*x;
            }
            write(multiples, first, &part);
        });
    }
}

/// Adds to some columns of R rows, of which the first is `row` of the matrix, what W others give: each its multiples.
#[inline(never)]
fn add<T: Scalar, const N: usize, const R: usize, const W: usize>(
    rows: &mut [[T; N]; R],
    multiples: &[[T; N]; W],
    row: usize,
    others: &[[T; N]; W],
    columns: Range<usize>,
) {
    if !has_room(row, R, N) {
        return;
    }
    by_parts!(T, COLUMNS, first in columns of N, {
        let mut sums: [[T; COLUMNS]; R] = read(rows, first);
        for (multiples, other) in multiples.iter().zip(others) {
            let (multiples, other): ([T; R], [T; COLUMNS]) = (part(multiples, row), part(other, first));
            for (sum, multiple) in sums.iter_mut().zip(multiples) {
                add_multiple(sum, multiple, &other);
            }
        }
        write(rows, first, &sums);
    });
}

#[inline(never)]
fn copy<T: Scalar, const N: usize, const W: usize>(
    from: &[[T; N]; W],
    to: &mut [[T; N]; W],
    columns: Range<usize>,
) {
    for (from, to) in from.iter().zip(to) {
        if let (Some(from), Some(to)) = (from.get(columns.clone()), to.get_mut(columns.clone())) {
            to.copy_from_slice(from);
        }
    }
}

/// Writes W columns of some rows, from column `first` on, as columns of W rows, from `start` on.
#[inline(never)]
fn read_transposed<T: Scalar, const N: usize, const W: usize>(
    rows: &[[T; N]],
    first: usize,
    others: &mut [[T; N]; W],
    start: usize,
) {
    for (rows, start) in rows.chunks(STRIP).zip((start..).step_by(STRIP)) {
        if const { W == STRIP && !has_lanes::<T>() }
            && let (Some(rows), Some(others)) =
                (rows.first_chunk::<STRIP>(), others.first_chunk_mut::<STRIP>())
        {
            write(others, start, &T::transposed(read(rows, first)));
            continue;
        }
        for (row, column) in rows.iter().zip(start..) {
            for (other, x) in others.iter_mut().zip(row.iter().skip(first)) {
                set(other, column, *x);
            }
        }
    }
}

/// The inverse: writes columns of W rows, from `start` on, as W columns of some rows, from `first` on.
#[inline(never)]
fn write_transposed<T: Scalar, const N: usize, const W: usize>(
    rows: &mut [[T; N]],
    first: usize,
    others: &[[T; N]; W],
    start: usize,
) {
    for (rows, start) in rows.chunks_mut(STRIP).zip((start..).step_by(STRIP)) {
        if const { W == STRIP && !has_lanes::<T>() }
            && let (Some(rows), Some(others)) =
                (rows.first_chunk_mut::<STRIP>(), others.first_chunk::<STRIP>())
        {
            write(rows, first, &T::transposed(read(others, start)));
            continue;
        }
        for (row, column) in rows.iter_mut().zip(start..) {
            for (x, other) in row.iter_mut().skip(first).zip(others) {
                *x = entry(other, column);
            }
        }
    }
}

/// W entries from `first` on.
#[inline(always)]
fn part<T: Scalar, const N: usize, const W: usize>(x: &[T; N], first: usize) -> [T; W] {
    x.get(first..).and_then(<[T]>::first_chunk).copied().unwrap_or([T::zero(); W])
}

/// Whether there are so many entries from `first` on among N.
#[inline(always)]
const fn has_room(first: usize, entries: usize, n: usize) -> bool {
    entries <= n && first <= n - entries
}

#[inline(always)]
fn add_multiple<T: Scalar, const S: usize>(sums: &mut [T; S], factor: T, others: &[T; S]) {
    for (sum, other) in sums.iter_mut().zip(others) {
        *sum = factor.mul_add(*other, *sum);
    }
}

/// W rows and columns of −1.
#[inline(always)]
fn minus_one<T: Scalar, const W: usize>() -> [[T; W]; W] {
    let mut one = [[T::zero(); W]; W];
    for (i, row) in one.iter_mut().enumerate() {
        if let Some(x) = row.get_mut(i) {
            *x = -T::one();
        }
    }
    one
}

/// S columns of each row, from `first` on.
#[inline(always)]
fn read<T: Scalar, const N: usize, const R: usize, const S: usize>(
    rows: &[[T; N]; R],
    first: usize,
) -> [[T; S]; R] {
    let mut parts = [[T::zero(); S]; R];
    for (own, row) in parts.iter_mut().zip(rows) {
        *own = part(row, first);
    }
    parts
}

#[inline(always)]
fn write<T: Scalar, const N: usize, const R: usize, const S: usize>(
    rows: &mut [[T; N]; R],
    first: usize,
    parts: &[[T; S]; R],
) {
    for (row, part) in rows.iter_mut().zip(parts) {
        if let Some(row) = row.get_mut(first..).and_then(<[T]>::first_chunk_mut) {
            *row = *part;
        }
    }
}
