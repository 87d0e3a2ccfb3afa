//! Factoring a mass matrix along its tree, and solving with many right-hand sides at once.
//!
//! By the inverse of the triangular factor: that is the product of two triangular matrices with the right-hand sides,
//! in lanes over their rows, with no step that waits for another. Unlike `M⁻¹` itself it loses nothing to the condition
//! of M: all that is ill-conditioned stays in D. Factor and inverse are computed four rows at a time, so that what they
//! owe to other rows are products too, and only the four wait for each other. What the tree leaves zero is skipped,
//! strip by strip of four rows.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, §6.5; J. Du Croz, N. Higham, *Stability of methods
//! for matrix inversion*, IMA Journal of Numerical Analysis 12, 1992, for the inverse of a triangular matrix.

use crate::product::{COLUMNS, STRIP, multiply, row_of, strips};
use crate::scalar::Scalar;

/// Where the factors of a matrix have entries: at each joint and those between it and the base.
#[derive(Clone, Copy, Debug)]
pub struct EliminationTree<const N: usize> {
    /// For each strip of rows, the joints that one of them is, or hangs on.
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
        let (mut below, mut beyond) = ([[false; N]; N], [[false; N]; N]);
        let mut tip = 0;
        while tip < N {
            let mut on_the_way = Some(tip);
            while let Some(k) = on_the_way {
                below[tip / STRIP][k] = true;
                beyond[k / STRIP][tip] = true;
                on_the_way = parents[k];
            }
            tip += 1;
        }
        let mut tree = Self { below: [Joints::NONE; N], beyond: [Joints::NONE; N] };
        let mut strip = 0;
        while strip < strips(N) {
            tree.below[strip] = Joints::among(&below[strip]);
            tree.beyond[strip] = Joints::among(&beyond[strip]);
            strip += 1;
        }
        tree
    }

    #[inline(always)]
    fn below(&self, strip: usize) -> impl Iterator<Item = usize> + '_ {
        self.below.get(strip).unwrap_or(const { &Joints::NONE }).iter()
    }

    #[inline(always)]
    fn beyond(&self, strip: usize) -> impl Iterator<Item = usize> + '_ {
        self.beyond.get(strip).unwrap_or(const { &Joints::NONE }).iter()
    }
}

/// `M⁻¹ = R D⁻¹ Rᵀ`, where `M = Lᵀ D L` and `R = L⁻¹`; both are unit lower triangular.
pub struct Factors<T, const N: usize> {
    /// Where they have entries.
    pub tree: &'static EliminationTree<N>,
    /// `R`, by columns.
    pub r: [[T; N]; N],
    /// `Rᵀ`, by columns.
    pub r_transposed: [[T; N]; N],
    /// `1/D`
    pub inverse_d: [T; N],
}

impl<T: Scalar, const N: usize> Factors<T, N> {
    /// Of a symmetric positive definite matrix, of which the rows up to the diagonal are read.
    ///
    /// # Cost
    ///
    /// N³/3 multiplications and additions, fused where the target can; N divisions.
    #[inline]
    pub fn of(m: &[[T; N]; N], tree: &'static EliminationTree<N>) -> Self {
        let zeros = [[T::zero(); N]; N];
        let mut factors = Self { tree, r: zeros, r_transposed: zeros, inverse_d: [T::one(); N] };
        let Self { r, r_transposed, inverse_d, .. } = &mut factors;
        factor(m, tree, r, inverse_d);
        invert_triangular(r, tree, r_transposed);
        transpose_triangular(r_transposed, r);
        factors
    }

    /// Writes `−M⁻¹·B`, both by columns.
    ///
    /// # Cost
    ///
    /// About N² multiplications and additions for each column, fused where the target can.
    #[inline]
    pub fn minus_solve<const M: usize>(&self, b: &[[T; N]; M], result: &mut [[T; N]; M]) {
        // As many columns at a time as leave none for last.
        if M.is_multiple_of(6) && !M.is_multiple_of(COLUMNS) {
            self.minus_solve_by::<6>(b, result);
        } else {
            self.minus_solve_by::<COLUMNS>(b, result);
        }
    }

    /// So many columns at a time.
    #[inline(always)]
    fn minus_solve_by<const W: usize>(&self, b: &[[T; N]], result: &mut [[T; N]]) {
        let minus_inverse_d = self.inverse_d.map(|x| -x);
        let (blocks, rest) = result.as_chunks_mut::<W>();
        let (of_blocks, of_rest) = b.as_chunks::<W>();
        for (result, b) in blocks.iter_mut().zip(of_blocks) {
            self.solve_columns(b, &minus_inverse_d, result);
        }
        for (result, b) in rest.iter_mut().zip(of_rest) {
            self.solve_columns(core::array::from_ref(b), &minus_inverse_d, core::array::from_mut(result));
        }
    }

    #[inline(always)]
    fn solve_columns<const W: usize>(&self, b: &[[T; N]; W], inverse_d: &[T; N], result: &mut [[T; N]; W]) {
        let tree = self.tree;
        let mut y = [[T::zero(); N]; W];
        let beyond = |strip: usize| tree.beyond(strip);
        multiply::<T, false, _, _, _>(&self.r_transposed, |k| row_of(b, k), beyond, 0..strips(N), &mut y);
        for column in &mut y {
            scale(column, inverse_d);
        }
        let below = |strip: usize| tree.below(strip);
        multiply::<T, false, _, _, _>(&self.r, |k| row_of(&y, k), below, 0..strips(N), result);
    }

    /// Writes `M⁻¹`, both halves.
    #[inline]
    pub fn inverse(&self, result: &mut [[T; N]; N]) {
        let (blocks, rest) = result.as_chunks_mut::<STRIP>();
        let (of_blocks, of_rest) = self.r_transposed.as_chunks::<STRIP>();
        for (block, (result, rows)) in blocks.iter_mut().zip(of_blocks).enumerate() {
            self.inverse_columns(rows, block, result);
        }
        for (result, row) in rest.iter_mut().zip(of_rest) {
            self.inverse_columns(core::array::from_ref(row), N / STRIP, core::array::from_mut(result));
        }
        mirror(result);
    }

    /// Writes columns of the given block from its first row on.
    #[inline(always)]
    fn inverse_columns<const W: usize>(&self, rows: &[[T; N]; W], block: usize, result: &mut [[T; N]; W]) {
        let mut y = [[T::zero(); N]; W];
        for (y, row) in y.iter_mut().zip(rows) {
            for ((y, x), inverse) in y.iter_mut().zip(row).zip(&self.inverse_d) {
                *y = *x * *inverse;
            }
        }
        let below = |_: usize| self.tree.below(block);
        multiply::<T, false, _, _, _>(&self.r, |k| row_of(&y, k), below, block..strips(N), result);
    }
}

#[inline(always)]
fn scale<T: Scalar, const N: usize>(column: &mut [T; N], factors: &[T; N]) {
    for (entry, factor) in column.iter_mut().zip(factors) {
        *entry *= *factor;
    }
}

/// Writes the rows of `L` before the diagonal, with anything on it and beyond; and `1/D`.
#[inline]
fn factor<T: Scalar, const N: usize>(
    m: &[[T; N]; N],
    tree: &EliminationTree<N>,
    l: &mut [[T; N]; N],
    inverse_d: &mut [T; N],
) {
    // The rows of `−D·L`.
    let mut minus_dl = [[T::zero(); N]; N];
    let (blocks, rest) = m.as_chunks::<STRIP>();
    for (k, row) in rest.iter().enumerate().rev() {
        let first = N / STRIP * STRIP + k;
        factor_rows(core::array::from_ref(row), first, tree, l, &mut minus_dl, inverse_d);
    }
    for (block, rows) in blocks.iter().enumerate().rev() {
        factor_rows(rows, block * STRIP, tree, l, &mut minus_dl, inverse_d);
    }
}

/// The same of the rows from `first` on, which are those of M; all beyond them are known.
#[inline(always)]
fn factor_rows<T: Scalar, const N: usize, const W: usize>(
    m: &[[T; N]; W],
    first: usize,
    tree: &EliminationTree<N>,
    l: &mut [[T; N]; N],
    minus_dl: &mut [[T; N]; N],
    inverse_d: &mut [T; N],
) {
    let mut rows = *m;
    let strip = first / STRIP;
    let beyond = |_: usize| tree.beyond(strip).filter(|&k| k >= first + W);
    let factors = |k: usize| minus_dl.get(k).map_or([T::zero(); W], |row| part(row, first));
    multiply::<T, true, _, _, _>(l, factors, beyond, 0..strip + 1, &mut rows);
    for w in (0..W).rev() {
        let k = first + w;
        let Some((before, [row, ..])) = rows.split_at_mut_checked(w) else { continue };
        let (Some(l), Some(minus_dl), Some(d)) = (l.get_mut(k), minus_dl.get_mut(k), inverse_d.get_mut(k))
        else {
            continue;
        };
        *d = T::one() / entry(row, k);
        for ((l, minus_dl), x) in l.iter_mut().zip(&mut *minus_dl).zip(&*row) {
            (*l, *minus_dl) = (*x * *d, -*x);
        }
        for (v, other) in before.iter_mut().enumerate() {
            let factor = entry(minus_dl, first + v);
            for (x, l) in other.iter_mut().zip(&*l) {
                *x = factor.mul_add(*l, *x);
            }
        }
    }
}

/// Writes the rows of `L⁻¹`: each that of the identity less those before it, `L[i][j]` times.
#[inline]
fn invert_triangular<T: Scalar, const N: usize>(
    l: &[[T; N]; N],
    tree: &EliminationTree<N>,
    inverse: &mut [[T; N]; N],
) {
    let (blocks, rest) = l.as_chunks::<STRIP>();
    for (block, rows) in blocks.iter().enumerate() {
        invert_rows(rows, block * STRIP, tree, inverse);
    }
    for (k, row) in rest.iter().enumerate() {
        invert_rows(core::array::from_ref(row), N / STRIP * STRIP + k, tree, inverse);
    }
}

/// The same of the rows from `first` on; all before them are known.
#[inline(always)]
fn invert_rows<T: Scalar, const N: usize, const W: usize>(
    l: &[[T; N]; W],
    first: usize,
    tree: &EliminationTree<N>,
    inverse: &mut [[T; N]; N],
) {
    let mut rows = [[T::zero(); N]; W];
    for (w, row) in rows.iter_mut().enumerate() {
        if let Some(diagonal) = row.get_mut(first + w) {
            *diagonal = T::one();
        }
    }
    let block = first / STRIP;
    let below = |_: usize| tree.below(block).take_while(|&k| k < first);
    multiply::<T, true, _, _, _>(inverse, |k| row_of(l, k).map(|x| -x), below, 0..block + 1, &mut rows);
    for (w, l) in l.iter().enumerate() {
        let Some((before, [row, ..])) = rows.split_at_mut_checked(w) else { continue };
        for (v, other) in before.iter().enumerate() {
            let factor = -entry(l, first + v);
            for (x, value) in row.iter_mut().zip(other) {
                *x = factor.mul_add(*value, *x);
            }
        }
    }
    for (row, known) in rows.iter().zip(inverse.iter_mut().skip(first)) {
        *known = *row;
    }
}

/// Writes the transpose of a matrix that is zero above the diagonal.
#[inline]
fn transpose_triangular<T: Scalar, const N: usize>(m: &[[T; N]; N], result: &mut [[T; N]; N]) {
    *result = [[T::zero(); N]; N];
    let (blocks, rest) = m.as_chunks::<STRIP>();
    for (block, rows) in blocks.iter().enumerate() {
        for (strip, columns) in result.as_chunks_mut::<STRIP>().0.iter_mut().enumerate().take(block + 1) {
            write_tile(columns, block, transposed(tile(rows, strip)));
        }
    }
    for (k, row) in rest.iter().enumerate() {
        for (column, value) in result.iter_mut().zip(row) {
            set(column, N / STRIP * STRIP + k, *value);
        }
    }
}

/// Copies what is below the diagonal to above it.
#[inline]
pub(crate) fn mirror<T: Scalar, const N: usize>(m: &mut [[T; N]; N]) {
    for block in 0..N / STRIP {
        let Some((_, blocks)) = m.split_at_mut_checked(block * STRIP) else { continue };
        let Some((columns, beyond)) = blocks.split_first_chunk_mut::<STRIP>() else { continue };
        let own = tile(columns, block);
        write_tile(columns, block, symmetric(own));
        let (others, rest) = beyond.as_chunks_mut::<STRIP>();
        for (k, others) in others.iter_mut().enumerate() {
            write_tile(others, block, transposed(tile(columns, block + 1 + k)));
        }
        for (k, other) in rest.iter_mut().enumerate() {
            for (j, column) in columns.iter().enumerate() {
                set(other, block * STRIP + j, entry(column, N / STRIP * STRIP + k));
            }
        }
    }
    for k in N / STRIP * STRIP..N {
        let Some((before, [column, ..])) = m.split_at_mut_checked(k) else { continue };
        for (j, other) in before.iter().enumerate().skip(N / STRIP * STRIP) {
            set(column, j, entry(other, k));
        }
    }
}

/// Four columns of four rows.
pub(crate) type Tile<T> = [[T; STRIP]; STRIP];

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

/// Entry by entry: loops would become gathers.
#[inline(always)]
pub(crate) fn transposed<T: Scalar>(
    [[a, b, c, d], [e, f, g, h], [i, j, k, l], [m, n, o, p]]: Tile<T>,
) -> Tile<T> {
    [[a, e, i, m], [b, f, j, n], [c, g, k, o], [d, h, l, p]]
}

/// With what is below the diagonal above it too.
#[inline(always)]
fn symmetric<T: Scalar>([[a, b, c, d], [_, f, g, h], [_, _, k, l], [_, _, _, p]]: Tile<T>) -> Tile<T> {
    [[a, b, c, d], [b, f, g, h], [c, g, k, l], [d, h, l, p]]
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
