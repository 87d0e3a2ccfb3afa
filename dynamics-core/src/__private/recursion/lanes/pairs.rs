//! Entries for pairs of joints, one of which hangs on the other: products of matrices with six or nine numbers a joint.
//!
//! For a few columns at a time all wrenches and twists are counted from the origin of the first of their joints.

use super::bodies::WrenchesInLanes;
use super::motion::TwistsInLanes;
use super::place::Placed;
use super::{InLanes, Vectors, set};
use crate::__private::recursion::vector::Vector;
use crate::__private::solve::mirror;
use crate::product::{COLUMNS, STRIP, multiply, strips};
use crate::scalar::Scalar;

/// A matrix, by columns.
pub(super) type Square<T, const N: usize> = [[T; N]; N];

/// How each joint changes: what is asked of the pairs.
pub(super) struct Changes<T, const N: usize> {
    /// What 𝕁 is applied to.
    pub(super) twists: TwistsInLanes<T, N>,
    /// What 𝔹 is applied to.
    pub(super) turns: Vectors<T, N>,
    /// The wrenches that come of it on the joint's composite body.
    pub(super) wrenches: WrenchesInLanes<T, N>,
}

impl<T: Scalar, const N: usize> Changes<T, N> {
    pub(super) fn zero() -> Self {
        let (twists, turns) = (TwistsInLanes::zero(), Vectors::zero());
        Self { twists, turns, wrenches: WrenchesInLanes::zero() }
    }
}

/// The pairs of a robot at a configuration.
pub(super) struct Pairs<'a, T, const N: usize> {
    robot: &'a InLanes<'a, T, N>,
    placed: &'a Placed<T, N>,
    /// The wrenches of unit motions.
    rows: &'a WrenchesInLanes<T, N>,
}

impl<'r, T: Scalar, const N: usize> InLanes<'r, T, N> {
    pub(super) fn pairs<'a>(
        &'a self,
        placed: &'a Placed<T, N>,
        rows: &'a WrenchesInLanes<T, N>,
    ) -> Pairs<'a, T, N>
    where
        'r: 'a,
    {
        Pairs { robot: self, placed, rows }
    }
}

impl<T: Scalar, const N: usize> Pairs<'_, T, N> {
    /// Writes `M`, both halves.
    pub(super) fn write_mass_matrix(&self, m: &mut Square<T, N>) {
        let mut rows = with_last([[T::zero(); N]; 6], self.rows.both().1);
        let (blocks, rest) = m.as_chunks_mut::<COLUMNS>();
        for (block, columns) in blocks.iter_mut().enumerate() {
            self.write_masses(&mut rows, block * COLUMNS, columns);
        }
        for (k, column) in rest.iter_mut().enumerate() {
            self.write_masses(&mut rows, N / COLUMNS * COLUMNS + k, core::array::from_mut(column));
        }
        mirror(m);
        self.clear_between_branches(m);
    }

    /// The same of the columns from `first` on, from their first row on.
    #[inline(always)]
    fn write_masses<const W: usize>(&self, rows: &mut [[T; N]; 6], first: usize, columns: &mut [[T; N]; W]) {
        let origin = self.placed.origins.at(first);
        self.shift(self.rows.both(), origin, rows);
        let units: [_; 6] = self.shifted(self.placed.unit_twists(), first, origin);
        let factors = |k: usize| units.get(k).copied().unwrap_or([T::zero(); W]);
        multiply(&*rows, factors, |_| 0..6, first / STRIP..strips(N), columns);
    }

    /// Writes `tr(Ŝ_i (𝕁 t̂_jᵀ + 𝔹 r̂_jᵀ))` for the twists `t` and turns `r` of the changes; `nu` has what their turns
    /// are multiplied with.
    pub(super) fn write_changes(&self, changes: &Changes<T, N>, nu: &Vectors<T, N>, m: &mut Square<T, N>) {
        let mut below = with_last([[T::zero(); N]; 9], nu);
        for (all, force) in below.iter_mut().skip(3).zip(&self.rows.both().1.0) {
            *all = *force;
        }
        let mut above = with_last([[T::zero(); N]; 6], self.placed.unit_twists().1);
        let (blocks, rest) = m.as_chunks_mut::<COLUMNS>();
        for (block, columns) in blocks.iter_mut().enumerate() {
            self.write_columns(changes, [&mut below, &mut above], block * COLUMNS, columns);
        }
        for (k, column) in rest.iter_mut().enumerate() {
            let column = core::array::from_mut(column);
            self.write_columns(changes, [&mut below, &mut above], N / COLUMNS * COLUMNS + k, column);
        }
        self.clear_between_branches(m);
    }

    /// The same of the columns from `first` on.
    #[inline(always)]
    fn write_columns<const W: usize>(
        &self,
        changes: &Changes<T, N>,
        [below, above]: [&mut [[T; N]]; 2],
        first: usize,
        columns: &mut [[T; N]; W],
    ) {
        let origin = self.placed.origins.at(first);
        let start = first / STRIP;
        // On the diagonal and below it.
        self.shift(self.rows.both(), origin, below);
        let mut moving: [[T; W]; 9] = self.shifted(changes.twists.both(), first, origin);
        for (all, turns) in moving.iter_mut().skip(6).zip(&changes.turns.0) {
            *all = part(turns, first);
        }
        let factors = |k: usize| moving.get(k).copied().unwrap_or([T::zero(); W]);
        multiply(&*below, factors, |_| 0..9, start..strips(N), columns);
        // Above it; what is in the same strips as what is not is computed apart.
        self.shift(self.placed.unit_twists(), origin, above);
        let forcing: [_; 6] = self.shifted(changes.wrenches.both(), first, origin);
        let factors = |k: usize| forcing.get(k).copied().unwrap_or([T::zero(); W]);
        multiply(&*above, factors, |_| 0..6, 0..start, columns);
        let mut near = [[T::zero(); COLUMNS]; W];
        let mut of_near = [[T::zero(); COLUMNS]; 6];
        for (of_near, row) in of_near.iter_mut().zip(&*above) {
            *of_near = part(row, start * STRIP);
        }
        multiply(&of_near, factors, |_| 0..6, 0..strips(COLUMNS), &mut near);
        for (j, (column, near)) in columns.iter_mut().zip(&near).enumerate() {
            for (entry, value) in column.iter_mut().skip(start * STRIP).zip(near).take(first % STRIP + j) {
                *entry = *value;
            }
        }
    }

    /// Writes the moments of wrenches, or the slides of twists, about a common origin into the first three rows: with
    /// the forces, or the turns, `own + p × other`.
    #[inline(always)]
    fn shift(&self, (own, other): (&Vectors<T, N>, &Vectors<T, N>), origin: Vector<T>, rows: &mut [[T; N]]) {
        let [x, y, z, ..] = rows else { return };
        for k in 0..N {
            let arm = self.placed.origins.at(k) - origin;
            let Vector(moved) = own.at(k) + arm.cross(other.at(k));
            for (all, value) in [&mut *x, y, z].into_iter().zip(moved) {
                set(all, k, value);
            }
        }
    }

    /// The same of the W joints from `first` on; those that do not change come first.
    #[inline(always)]
    fn shifted<const W: usize, const K: usize>(
        &self,
        (own, other): (&Vectors<T, N>, &Vectors<T, N>),
        first: usize,
        origin: Vector<T>,
    ) -> [[T; W]; K] {
        let mut columns = [[T::zero(); W]; K];
        for j in 0..W {
            let (k, Vector(same)) = (first + j, other.at(first + j));
            let arm = self.placed.origins.at(k) - origin;
            let Vector(moved) = own.at(k) + arm.cross(other.at(k));
            for (all, value) in columns.iter_mut().zip(same.into_iter().chain(moved)) {
                set(all, j, value);
            }
        }
        columns
    }

    /// Writes zeros for joints of which neither hangs on the other.
    fn clear_between_branches(&self, m: &mut Square<T, N>) {
        if (0..N).all(|k| self.robot.parent(k) == k.checked_sub(1)) {
            return;
        }
        for k in 0..N {
            let mut on_the_way = self.robot.parent(k);
            for i in (0..k).rev() {
                if on_the_way == Some(i) {
                    on_the_way = self.robot.parent(i);
                    continue;
                }
                for (column, row) in [(i, k), (k, i)] {
                    if let Some(entry) = m.get_mut(column).and_then(|column| column.get_mut(row)) {
                        *entry = T::zero();
                    }
                }
            }
        }
    }
}

/// The rows, the last three being these.
#[inline(always)]
fn with_last<T: Scalar, const N: usize, const K: usize>(
    mut rows: [[T; N]; K],
    last: &Vectors<T, N>,
) -> [[T; N]; K] {
    for (row, last) in rows.iter_mut().rev().zip(last.0.iter().rev()) {
        *row = *last;
    }
    rows
}

/// K numbers from `first` on; zeros where there are fewer.
#[inline(always)]
fn part<T: Scalar, const N: usize, const K: usize>(x: &[T; N], first: usize) -> [T; K] {
    let rest = x.get(first..).unwrap_or_default();
    rest.first_chunk().copied().unwrap_or_else(|| {
        let mut part = [T::zero(); K];
        part.iter_mut().zip(rest).for_each(|(part, x)| *part = *x);
        part
    })
}
