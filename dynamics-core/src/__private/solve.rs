//! Factoring a mass matrix along its tree, and solving with many right-hand sides at once.
//!
//! By the inverse of the triangular factor: that is the product of two triangular matrices with the right-hand sides,
//! in lanes over their rows, with no step that waits for another. Unlike `M⁻¹` itself it loses nothing to the condition
//! of M: all that is ill-conditioned stays in D. Factor and inverse are computed four rows or columns at a time, so that
//! what they owe to others are products too, and only the four wait for each other. What the tree leaves zero is skipped,
//! strip by strip of four rows.
//!
//! A scalar with lanes of its own leaves none to the rows: so many are summed at a time as fit the registers, and each sum
//! has the terms that a float's strip has, in their order, so that every lane has the bits of one float.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, §6.5; J. Du Croz, N. Higham, *Stability of methods
//! for matrix inversion*, IMA Journal of Numerical Analysis 12, 1992, for the inverse of a triangular matrix.

use nalgebra::SMatrix;

use super::columns;
use super::in_place::{Tile, blank, mirror, put, transposed};
use crate::dynamics::{ForwardDynamicsDerivatives, InverseDynamicsDerivatives};
use crate::product::{
    COLUMNS, FEW_COLUMNS, LONG_STRIP, STRIP, add_products, by_rows, first_of, has_lanes, multiply, parts,
    products, row_of, strip_of, write_strip,
};
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

/// Where the factors of a matrix have entries: at each joint and those between it and the base.
#[derive(Clone, Copy, Debug)]
pub struct EliminationTree<const N: usize> {
    strips: Ways<N>,
    /// The same of so many rows as are solved for at a time.
    solved: Ways<N>,
}

/// Which joints are on the way from rows of a matrix, some at a time, to the base, or to the tips.
#[derive(Clone, Copy, Debug)]
struct Ways<const N: usize> {
    /// For each part of the rows, the joints that one of them is, or hangs on.
    below: [Joints<N>; N],
    /// The joints that are one of them, or hang on one.
    beyond: [Joints<N>; N],
}

/// Some joints, in order.
#[derive(Clone, Copy, Debug)]
struct Joints<const N: usize> {
    joints: [u16; N],
    count: usize,
}

impl<const N: usize> Joints<N> {
    const NONE: Self = Self { joints: [0; N], count: 0 };

    /// Those that are marked.
    const fn among(marks: &[bool; N]) -> Self {
        let mut found = Self::NONE;
        let mut joint = 0;
        while joint < N {
            if marks[joint] {
                found.joints[found.count] = joint as u16;
                found.count += 1;
            }
            joint += 1;
        }
        found
    }

    #[inline(always)]
    fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.joints.get(..self.count).unwrap_or_default().iter().map(|&k| usize::from(k))
    }

    /// The strips of S that they are in, from the last to the first.
    #[inline(always)]
    fn strips<const S: usize>(&self) -> impl Iterator<Item = usize> + '_ {
        let joints = self.joints.get(..self.count).unwrap_or_default();
        let mut last = None;
        joints.iter().rev().filter_map(move |&k| {
            let strip = usize::from(k) / S;
            (last.replace(strip) != Some(strip)).then_some(strip)
        })
    }
}

impl<const N: usize> EliminationTree<N> {
    /// Each joint hangs on the one before it: nothing need be zero.
    pub const CHAIN: Self = {
        let mut parents = [None; N];
        let mut k = 1;
        while k < N {
            parents[k] = Some(k - 1);
            k += 1;
        }
        Self::of(parents)
    };

    /// By the joint before each on its way to the base.
    #[must_use]
    pub const fn of(parents: [Option<usize>; N]) -> Self {
        Self { strips: Ways::of(&parents, STRIP), solved: Ways::of(&parents, rows_to_solve(N)) }
    }

    #[inline(always)]
    fn below(&self, strip: usize) -> &Joints<N> {
        self.strips.below(strip)
    }

    #[inline(always)]
    fn beyond(&self, strip: usize) -> &Joints<N> {
        self.strips.beyond(strip)
    }
}

impl<const N: usize> Ways<N> {
    /// Of so many rows at a time.
    const fn of(parents: &[Option<usize>; N], rows: usize) -> Self {
        let (mut below, mut beyond) = ([[false; N]; N], [[false; N]; N]);
        let mut tip = 0;
        while tip < N {
            let mut on_the_way = Some(tip);
            while let Some(k) = on_the_way {
                below[tip / rows][k] = true;
                beyond[k / rows][tip] = true;
                on_the_way = parents[k];
            }
            tip += 1;
        }
        let mut ways = Self { below: [Joints::NONE; N], beyond: [Joints::NONE; N] };
        let mut part = 0;
        while part < N.div_ceil(rows) {
            ways.below[part] = Joints::among(&below[part]);
            ways.beyond[part] = Joints::among(&beyond[part]);
            part += 1;
        }
        ways
    }

    #[inline(always)]
    fn below(&self, part: usize) -> &Joints<N> {
        self.below.get(part).unwrap_or(const { &Joints::NONE })
    }

    #[inline(always)]
    fn beyond(&self, part: usize) -> &Joints<N> {
        self.beyond.get(part).unwrap_or(const { &Joints::NONE })
    }
}

/// So many rows are solved for at a time: those of a long strip, unless half of the last one would be in vain. With registers of
/// four doubles four columns of it are eight sums of six loads; eight columns of a strip are as many of nine.
const fn rows_to_solve(n: usize) -> usize {
    let is_filled = n >= LONG_STRIP && n.div_ceil(LONG_STRIP) * LONG_STRIP == n.div_ceil(STRIP) * STRIP;
    if is_filled { LONG_STRIP } else { STRIP }
}

/// `M⁻¹ = R D⁻¹ Rᵀ`, where `M = Lᵀ D L` and `R = L⁻¹`; both are unit lower triangular.
pub struct Factors<T, const N: usize> {
    /// Where they have entries.
    pub tree: &'static EliminationTree<N>,
    /// `R`, by columns; what is above a long strip of the diagonal has no part in any result.
    pub r: [[T; N]; N],
    /// `Rᵀ`, by columns; what is below a long strip of the diagonal has no part in any result.
    pub r_transposed: [[T; N]; N],
    /// `1/D`
    pub inverse_d: [T; N],
}

impl<T: Scalar, const N: usize> Factors<T, N> {
    /// Before there are any.
    #[inline]
    #[must_use]
    pub fn new(tree: &'static EliminationTree<N>) -> Self {
        // Zeros that the compiler knows: what a function returns would be copied into the struct.
        let zeros = || [[T::zero(); N]; N];
        Self { tree, r: zeros(), r_transposed: zeros(), inverse_d: [T::one(); N] }
    }

    /// Those of a symmetric positive definite matrix, of which the rows up to the diagonal are read. What functions
    /// return is copied, so that they are made first. Where the tree has no entries they stay what they were: zeros.
    ///
    /// # Cost
    ///
    /// N³/3 multiplications and additions, fused where the target can; N divisions.
    #[inline]
    pub fn factor(&mut self, m: &[[T; N]; N]) {
        let Self { tree, r, r_transposed, inverse_d } = self;
        factor(m, tree, r_transposed, r, inverse_d);
        invert_triangular(r_transposed, tree, r);
        transpose_triangular(r, tree, r_transposed);
    }

    /// `−M⁻¹·B`, by columns.
    ///
    /// # Cost
    ///
    /// About N² multiplications and additions for each column, fused where the target can.
    #[inline(never)]
    pub fn minus_solved<const M: usize>(&self, b: &[[T; N]; M]) -> [[T; N]; M] {
        let mut solved = blank();
        let minus_inverse_d = self.inverse_d.map(|x| -x);
        macro_rules! solve_by {
            ($width:ident, $rows:ident) => {
                let mut halfway = [[T::zero(); N]; $width];
                for first in parts($width, M) {
                    let Some(columns) = b.get(first..).and_then(<[_]>::first_chunk::<$width>) else { continue };
                    by_rows!(T, ROWS = $rows, {
                        let ways = |row: usize| row / const { rows_to_solve(N) };
                        let beyond = |row: usize| self.tree.solved.beyond(ways(row)).iter();
                        let factors = |k| row_of(columns, k);
                        multiply::<T, N, $width, ROWS, _>(&self.r_transposed, factors, beyond, &mut halfway);
                        for column in &mut halfway {
                            scale(column, &minus_inverse_d);
                        }
                        for part in (0..N.div_ceil(ROWS)).rev() {
                            let below = self.tree.solved.below(ways(part * ROWS)).iter();
                            let sums: [[T; ROWS]; $width] =
                                products(&self.r, |k| row_of(&halfway, k), below, part);
                            put!(solved: [[_; N]; M], first, part, sums);
                        }
                    });
                }
            };
        }
        const SIX: usize = 6;
        const ONE: usize = 1;
        let by_long_strips = const { LONG_STRIP > STRIP && rows_to_solve(N) == LONG_STRIP };
        // As many columns at a time as leave none for last, where a strip leaves room for many.
        if const { M < COLUMNS } {
            if by_long_strips {
                solve_by!(ONE, LONG_STRIP);
            } else {
                solve_by!(ONE, STRIP);
            }
        } else if by_long_strips || const { has_lanes::<T>() } {
            solve_by!(FEW_COLUMNS, LONG_STRIP);
        } else if const { M.is_multiple_of(SIX) && !M.is_multiple_of(COLUMNS) } {
            solve_by!(SIX, STRIP);
        } else {
            solve_by!(COLUMNS, STRIP);
        }
        solved
    }

    /// The derivatives of forward dynamics, as [`forward_from_inverse`](super::forward_from_inverse) says.
    ///
    /// Here, with what it calls: where LLVM does not see both together, it makes two of the matrices elsewhere and copies
    /// them.
    #[inline(never)]
    pub(super) fn forward_from_inverse(
        &self,
        inverse: &InverseDynamicsDerivatives<T, N>,
    ) -> ForwardDynamicsDerivatives<T, N> {
        ForwardDynamicsDerivatives {
            da_dq: minus_solved(self, &inverse.dtau_dq),
            da_dv: minus_solved(self, &inverse.dtau_dv),
            da_dtau: inverse_by(self),
        }
    }

    /// `M⁻¹`, both halves.
    #[inline]
    pub fn inverse(&self) -> [[T; N]; N] {
        inverse(&self.r, &self.inverse_d, self.tree)
    }
}

// On their own, for the stack of unoptimised builds: there each step between is a matrix.

fn minus_solved<T: Scalar, const N: usize>(
    factors: &Factors<T, N>,
    b: &SMatrix<T, N, N>,
) -> SMatrix<T, N, N> {
    columns(factors.minus_solved(&b.data.0))
}

fn inverse_by<T: Scalar, const N: usize>(factors: &Factors<T, N>) -> SMatrix<T, N, N> {
    columns(factors.inverse())
}

/// The inverse of a symmetric positive definite matrix, of which the rows up to the diagonal are read.
///
/// # Cost
///
/// N³/2 multiplications and additions, fused where the target can; N divisions.
#[inline]
pub(super) fn inverted<T: Scalar, const N: usize>(m: &[[T; N]; N], tree: &EliminationTree<N>) -> [[T; N]; N] {
    let mut l = blank();
    let mut r = blank();
    let mut inverse_d = [T::one(); N];
    factor(m, tree, &mut l, &mut r, &mut inverse_d);
    invert_triangular(&l, tree, &mut r);
    inverse(&r, &inverse_d, tree)
}

/// `R D⁻¹ Rᵀ`, both halves.
#[inline(never)]
fn inverse<T: Scalar, const N: usize>(
    r: &[[T; N]; N],
    inverse_d: &[T; N],
    tree: &EliminationTree<N>,
) -> [[T; N]; N] {
    let mut inverse = blank();
    macro_rules! inverse_by {
        ($width:ident, $columns:expr) => {
            let mut rows = [[T::zero(); $width]; N];
            for first in $columns.step_by($width) {
                for k in tree.below(first / STRIP).iter() {
                    if let (Some(row), Some(column)) = (rows.get_mut(k), r.get(k)) {
                        *row = part(column, first);
                        for x in row {
                            *x *= entry(inverse_d, k);
                        }
                    }
                }
                let factors = |k: usize| rows.get(k).copied().unwrap_or([T::zero(); $width]);
                by_rows!(T, ROWS = LONG_STRIP, {
                    for strip in (first / ROWS..N.div_ceil(ROWS)).rev() {
                        let sums: [[T; ROWS]; $width] = products(r, factors, tree.below(first / STRIP).iter(), strip);
                        put!(inverse: [[_; N]; N], first, strip, sums);
                    }
                });
            }
        };
    }
    inverse_by!(STRIP, 0..N / STRIP * STRIP);
    by_rest!(WIDTH = N % STRIP, {
        inverse_by!(WIDTH, N / STRIP * STRIP..N);
    });
    mirror!(inverse, N);
    inverse
}

#[inline(always)]
fn scale<T: Scalar, const N: usize>(column: &mut [T; N], factors: &[T; N]) {
    for (entry, factor) in column.iter_mut().zip(factors) {
        *entry *= *factor;
    }
}

/// Writes the rows of `L` and `−D·L` before the diagonal, with anything on it and beyond; and `1/D`.
#[inline]
fn factor<T: Scalar, const N: usize>(
    m: &[[T; N]; N],
    tree: &EliminationTree<N>,
    l: &mut [[T; N]; N],
    minus_dl: &mut [[T; N]; N],
    inverse_d: &mut [T; N],
) {
    let (blocks, rest) = m.as_chunks::<STRIP>();
    by_rest!(WIDTH = N % STRIP, {
        if let Some(rows) = rest.first_chunk() {
            let first = N / STRIP * STRIP;
            by_rows!(
                T,
                ROWS = LONG_STRIP,
                factor_rows::<T, N, WIDTH, ROWS>(rows, first, tree, l, minus_dl, inverse_d)
            );
        }
    });
    for (block, rows) in blocks.iter().enumerate().rev() {
        let first = block * STRIP;
        by_rows!(
            T,
            ROWS = LONG_STRIP,
            factor_rows::<T, N, STRIP, ROWS>(rows, first, tree, l, minus_dl, inverse_d)
        );
    }
}

/// The same of the rows from `first` on, which are those of M; all beyond them are known.
#[inline(always)]
fn factor_rows<T: Scalar, const N: usize, const W: usize, const S: usize>(
    m: &[[T; N]; W],
    first: usize,
    tree: &EliminationTree<N>,
    l: &mut [[T; N]; N],
    minus_dl: &mut [[T; N]; N],
    inverse_d: &mut [T; N],
) {
    let end = first + W;
    let (Some((l, known)), Some((minus_dl, multiples)), Some(inverse_d)) =
        (l.split_at_mut_checked(end), minus_dl.split_at_mut_checked(end), inverse_d.get_mut(first..end))
    else {
        return;
    };
    let (Some(l), Some(minus_dl)) = (l.last_chunk_mut::<W>(), minus_dl.last_chunk_mut::<W>()) else { return };
    let beyond = || tree.beyond(first / STRIP).iter().filter_map(|k| k.checked_sub(end));
    let factors = |k: usize| multiples.get(k).map_or([T::zero(); W], |row| part(row, first));
    // What is on the diagonal by itself, and first: all that waits is in there.
    let mut own = [[T::zero(); W]; W];
    for (own, row) in own.iter_mut().zip(m) {
        *own = part(row, first);
    }
    for k in beyond() {
        let row: [T; W] = known.get(k).map_or([T::zero(); W], |row| part(row, first));
        for (own, factor) in own.iter_mut().zip(factors(k)) {
            for (x, l) in own.iter_mut().zip(row) {
                *x = factor.mul_add(l, *x);
            }
        }
    }
    let (minus_l, inverses) = factor_block(&own);
    inverse_d.copy_from_slice(&inverses);
    for strip in tree.below(first / STRIP).strips::<S>() {
        let mut rows: [[T; S]; W] = strip_of(m, strip);
        add_products(known, factors, beyond(), strip, &mut rows);
        eliminate(&minus_l, &mut rows);
        let (mut scaled, mut negated) = (rows, rows);
        for ((scaled, negated), inverse) in scaled.iter_mut().zip(&mut negated).zip(inverses) {
            for (x, y) in scaled.iter_mut().zip(negated) {
                (*x, *y) = (*x * inverse, -*y);
            }
        }
        write_strip(l, strip, &scaled);
        write_strip(minus_dl, strip, &negated);
    }
}

/// `−L` below the diagonal, and `1/D`, of a small matrix.
///
/// On its own: LLVM would sum entry by entry what only some entries are needed of.
#[inline(never)]
fn factor_block<T: Scalar, const W: usize>(m: &[[T; W]; W]) -> ([[T; W]; W], [T; W]) {
    let (mut m, mut minus_l, mut inverse_d) = (*m, [[T::zero(); W]; W], [T::one(); W]);
    for w in (0..W).rev() {
        let Some((before, [row, ..])) = m.split_at_mut_checked(w) else { continue };
        let inverse = T::one() / entry(row, w);
        set(&mut inverse_d, w, inverse);
        let Some(minus_l) = minus_l.get_mut(w) else { continue };
        for ((l, other), x) in minus_l.iter_mut().zip(before).zip(&*row) {
            *l = -*x * inverse;
            for (y, x) in other.iter_mut().zip(&*row) {
                *y = l.mul_add(*x, *y);
            }
        }
    }
    (minus_l, inverse_d)
}

/// Takes from each of W rows what it owes to those after it: `minus_l` times these.
///
/// On its own: among the loops that call it its factors would stay in registers, and those of the loops would not.
#[inline(never)]
fn eliminate<T: Scalar, const W: usize, const S: usize>(minus_l: &[[T; W]; W], rows: &mut [[T; S]; W]) {
    let mut own = *rows;
    for (w, minus_l) in minus_l.iter().enumerate().rev() {
        let Some((before, [row, ..])) = own.split_at_mut_checked(w) else { continue };
        let row = *row;
        for (other, factor) in before.iter_mut().zip(minus_l) {
            for (x, value) in other.iter_mut().zip(row) {
                *x = factor.mul_add(value, *x);
            }
        }
    }
    *rows = own;
}

/// Writes the columns of `L⁻¹`: each that of the identity less those after it, `L[i][j]` times.
#[inline]
fn invert_triangular<T: Scalar, const N: usize>(
    l: &[[T; N]; N],
    tree: &EliminationTree<N>,
    inverse: &mut [[T; N]; N],
) {
    by_rest!(WIDTH = N % STRIP, {
        let first = N / STRIP * STRIP;
        by_rows!(T, ROWS = LONG_STRIP, invert_columns::<T, N, WIDTH, ROWS>(l, first, tree, inverse));
    });
    for block in (0..N / STRIP).rev() {
        by_rows!(T, ROWS = LONG_STRIP, invert_columns::<T, N, STRIP, ROWS>(l, block * STRIP, tree, inverse));
    }
}

/// The same of the columns from `first` on; all after them are known.
#[inline(always)]
fn invert_columns<T: Scalar, const N: usize, const W: usize, const S: usize>(
    l: &[[T; N]; N],
    first: usize,
    tree: &EliminationTree<N>,
    inverse: &mut [[T; N]; N],
) {
    let end = first + W;
    let Some((columns, known)) = inverse.split_at_mut_checked(end) else { return };
    let Some(columns) = columns.last_chunk_mut::<W>() else { return };
    let minus = |k: usize| {
        let mut row: [T; W] = l.get(k).map_or([T::zero(); W], |row| part(row, first));
        for x in &mut row {
            *x = -*x;
        }
        row
    };
    let mut own = [[T::zero(); W]; W];
    for (w, own) in own.iter_mut().enumerate() {
        *own = minus(first + w);
    }
    // Whatever the rows at a time, the terms are those of a long strip.
    // Above the diagonal, too, for those are terms of rows in the same long strip.
    let above = first / LONG_STRIP * (LONG_STRIP / S)..first / S;
    for part in tree.beyond(first / STRIP).strips::<S>().chain(above) {
        let mut sums = [[T::zero(); S]; W];
        for (w, sums) in sums.iter_mut().enumerate() {
            set(sums, (first + w).wrapping_sub(first_of(part, S, N)), T::one());
        }
        let end_of_strip = (part * S / LONG_STRIP + 1) * LONG_STRIP;
        let reaching = tree.beyond(first / STRIP).iter().filter_map(|k| k.checked_sub(end));
        let reaching = reaching.take_while(|&k| k + end < end_of_strip);
        add_products(known, |k| minus(k + end), reaching, part, &mut sums);
        eliminate(&own, &mut sums);
        write_strip(columns, part, &sums);
    }
}

/// Writes the transpose of a matrix that is zero above the diagonal and off the tree, both by columns, as far down as the
/// long strip of the diagonal.
#[inline]
fn transpose_triangular<T: Scalar, const N: usize>(
    m: &[[T; N]; N],
    tree: &EliminationTree<N>,
    result: &mut [[T; N]; N],
) {
    // Lanes of a scalar are no rows: one by one.
    let blocks = if has_lanes::<T>() { 0 } else { N / STRIP };
    for (block, columns) in m.as_chunks::<STRIP>().0.iter().enumerate().take(blocks) {
        let above = block * STRIP / LONG_STRIP * (LONG_STRIP / STRIP)..block;
        for strip in tree.beyond(block).strips::<STRIP>().chain(above) {
            if let Some(columns_of_result) = result.as_chunks_mut::<STRIP>().0.get_mut(strip) {
                write_tile(columns_of_result, block, transposed(tile(columns, strip)));
            }
        }
    }
    let rest = blocks * STRIP;
    for (k, column) in result.iter_mut().enumerate() {
        let first = if k < rest { rest } else { 0 };
        let end = (k / LONG_STRIP + 1) * LONG_STRIP;
        for (value, m) in column.iter_mut().zip(m).take(end).skip(first) {
            *value = entry(m, k);
        }
    }
}

#[inline(always)]
fn tile<T: Scalar, const N: usize>(columns: &[[T; N]; STRIP], strip: usize) -> Tile<T> {
    let part = |column: &[T; N]| column.as_chunks().0.get(strip).copied();
    columns.each_ref().map(|column| part(column).unwrap_or_else(|| [T::zero(); STRIP]))
}

#[inline(always)]
fn write_tile<T: Scalar, const N: usize>(columns: &mut [[T; N]; STRIP], strip: usize, tile: Tile<T>) {
    for (column, values) in columns.iter_mut().zip(tile) {
        if let Some(part) = column.as_chunks_mut().0.get_mut(strip) {
            *part = values;
        }
    }
}

/// W entries from `first` on.
#[inline(always)]
fn part<T: Scalar, const N: usize, const W: usize>(x: &[T; N], first: usize) -> [T; W] {
    x.get(first..).and_then(<[T]>::first_chunk).copied().unwrap_or([T::zero(); W])
}

#[inline(always)]
fn entry<T: Scalar>(x: &[T], k: usize) -> T {
    x.get(k).copied().unwrap_or_else(T::zero)
}

#[inline(always)]
fn set<T>(x: &mut [T], k: usize, value: T) {
    if let Some(x) = x.get_mut(k) {
        *x = value;
    }
}
