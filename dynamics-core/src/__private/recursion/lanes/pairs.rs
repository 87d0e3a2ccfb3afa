//! Entries for pairs of joints, one of which hangs on the other: products of matrices with six or nine numbers a joint.
//!
//! For a few columns at a time all wrenches and twists are counted from the origin of the first of their joints.

use core::ops::Range;

use super::bodies::WrenchesInLanes;
use super::motion::TwistsInLanes;
use super::place::Placed;
use super::{InLanes, Vectors, set};
use crate::__private::in_place::{blank, laid_down, mirror, put};
use crate::__private::recursion::vector::Vector;
use crate::product::{COLUMNS, FEW_COLUMNS, STRIP, by_rows, first_of, has_lanes, parts, products};
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
    /// What hangs on body k, and itself, are the bodies from k on to before this; all, without it.
    ends: Option<[usize; N]>,
    placed: &'a Placed<T, N>,
    /// The wrenches of unit motions.
    rows: &'a WrenchesInLanes<T, N>,
}

impl<T: Scalar, const NL: usize, const NQ: usize, const N: usize> InLanes<'_, T, NL, NQ, N> {
    pub(super) fn pairs<'a>(
        &self,
        placed: &'a Placed<T, N>,
        rows: &'a WrenchesInLanes<T, N>,
    ) -> Pairs<'a, T, N> {
        Pairs { ends: self.ends(), placed, rows }
    }
}

impl<T: Scalar, const N: usize> Pairs<'_, T, N> {
    /// `M`, both halves, with these armatures.
    #[inline(never)]
    pub(super) fn mass_matrix(&self, armatures: &[T; N]) -> Square<T, N> {
        let mut m = self.half_mass_matrix(armatures);
        mirror!(m, N);
        m
    }

    /// `M` on the diagonal and below it, with these armatures; anything above.
    #[inline(never)]
    #[allow(clippy::assign_op_pattern, reason = "`+=` borrows")]
    #[allow(clippy::needless_range_loop, reason = "an iterator borrows")]
    pub(super) fn half_mass_matrix(&self, armatures: &[T; N]) -> Square<T, N> {
        let mut m = blank();
        let mut rows = [[T::zero(); N]; 6];
        set_last(&mut rows, self.rows.both().1);
        macro_rules! masses_by {
            ($group:ident, $width:ident) => {
                for first in parts($group, N) {
                    // From their first row on.
                    let (origin, end) = (self.placed.origins.at(first), self.end_of($group, first));
                    self.shift(self.rows.both(), origin, first..end, &mut rows);
                    for part in 0..$group / $width {
                        let first = first + part * $width;
                        let units: [[T; $width]; 6] = self.shifted(self.placed.unit_twists(), first, origin);
                        let units = laid_down::<T, _>(&units); // LLVM would store a register of each
                        by_rows!(T, ROWS = STRIP, {
                            for strip in (first / ROWS..end.div_ceil(ROWS)).rev() {
                                let sums: [[T; ROWS]; $width] = products(&rows, row_in(units), 0..6, strip);
                                put!(m: [[_; N]; N], first, strip, sums);
                            }
                        });
                    }
                }
            };
        }
        if const { N < COLUMNS } {
            masses_by!(ONE, ONE);
        } else if const { has_lanes::<T>() } {
            masses_by!(COLUMNS, FEW_COLUMNS);
        } else {
            masses_by!(COLUMNS, COLUMNS);
        }
        for (j, end) in self.ends.iter().flatten().enumerate() {
            for i in *end..N {
                m[j][i] = T::zero();
            }
        }
        for (k, armature) in armatures.iter().enumerate() {
            m[k][k] = m[k][k] + *armature;
        }
        m
    }

    /// `tr(Ŝ_i (𝕁 t̂_jᵀ + 𝔹 r̂_jᵀ))` for the twists `t` and turns `r` of the changes, `scale` times, and the entries of the
    /// diagonal; `nu` has what their turns are multiplied with.
    #[inline(never)]
    #[allow(clippy::assign_op_pattern, reason = "`+=` borrows")]
    #[allow(clippy::needless_range_loop, reason = "an iterator borrows")]
    #[allow(clippy::modulo_one, reason = "some scalars take one row at a time")]
    pub(super) fn changes(
        &self,
        changes: &Changes<T, N>,
        nu: &Vectors<T, N>,
        scale: T,
        diagonal: &[T],
    ) -> Square<T, N> {
        let mut m = blank();
        let mut below = [[T::zero(); N]; 9];
        set_last(&mut below, nu);
        for (all, force) in below.iter_mut().skip(3).zip(&self.rows.both().1.0) {
            *all = *force;
        }
        let mut above = [[T::zero(); N]; 6];
        set_last(&mut above, self.placed.unit_twists().1);
        macro_rules! changes_by {
            ($group:ident, $width:ident) => {
                for first in parts($group, N) {
                    let (origin, end) = (self.placed.origins.at(first), self.end_of($group, first));
                    self.shift(self.rows.both(), origin, first..end, &mut below);
                    self.shift(self.placed.unit_twists(), origin, 0..first + $group, &mut above);
                    for part in 0..$group / $width {
                        let first = first + part * $width;
                        let moving: [[T; $width]; 9] = self.moving(changes, first, origin, scale);
                        let mut forcing: [[T; $width]; 6] =
                            self.shifted(changes.wrenches.both(), first, origin);
                        scale_all(&mut forcing, scale);
                        let (moving, forcing) = (laid_down::<T, _>(&moving), laid_down::<T, _>(&forcing));
                        by_rows!(T, ROWS = STRIP, {
                            // On the diagonal and below it.
                            for strip in (first / ROWS..end.div_ceil(ROWS)).rev() {
                                let sums: [[T; ROWS]; $width] = products(&below, row_in(moving), 0..9, strip);
                                put!(m: [[_; N]; N], first, strip, sums);
                            }
                            // Above it.
                            for strip in 0..first / ROWS {
                                if !self.carries::<ROWS>(strip, first) {
                                    continue;
                                }
                                let sums: [[T; ROWS]; $width] = products(&above, row_in(forcing), 0..6, strip);
                                put!(m: [[_; N]; N], first, strip, sums);
                            }
                            // And what is there in the same strips as what is not.
                            for strip in first / ROWS..(first + $width).div_ceil(ROWS) {
                                let begin = first_of(strip, ROWS, N);
                                let sums: [[T; ROWS]; $width] = products(&above, row_in(forcing), 0..6, strip);
                                // LLVM would compute one by one what is not all needed.
                                for (j, sums) in laid_down::<T, _>(&sums).iter().enumerate() {
                                    for (i, value) in sums.iter().enumerate() {
                                        let (column, row) = (first + j, begin + i);
                                        if row < column && column < N {
                                            m[column][row] = *value;
                                        }
                                    }
                                }
                            }
                        });
                    }
                }
            };
        }
        if const { N < COLUMNS } {
            changes_by!(ONE, ONE);
        } else if const { has_lanes::<T>() } {
            changes_by!(COLUMNS, FEW_COLUMNS);
        } else {
            changes_by!(COLUMNS, COLUMNS);
        }
        for (j, end) in self.ends.iter().flatten().enumerate() {
            for (i, before) in self.ends.iter().flatten().enumerate().take(j) {
                m[j][i] = if *before > j { m[j][i] } else { T::zero() };
            }
            for i in *end..N {
                m[j][i] = T::zero();
            }
        }
        for (k, entry) in diagonal.iter().enumerate().take(N) {
            m[k][k] = m[k][k] + *entry;
        }
        m
    }

    /// The twists and turns of the changes of W joints, `scale` times.
    #[inline(always)]
    fn moving<const W: usize>(
        &self,
        changes: &Changes<T, N>,
        first: usize,
        origin: Vector<T>,
        scale: T,
    ) -> [[T; W]; 9] {
        let mut moving = self.shifted(changes.twists.both(), first, origin);
        for (all, turns) in moving.iter_mut().skip(6).zip(&changes.turns.0) {
            *all = part(turns, first);
        }
        scale_all(&mut moving, scale);
        moving
    }

    /// Writes the moments of wrenches, or the slides of twists, of some joints about a common origin into the first three
    /// rows: with the forces, or the turns, `own + p × other`.
    #[inline(always)]
    fn shift(
        &self,
        (own, other): (&Vectors<T, N>, &Vectors<T, N>),
        origin: Vector<T>,
        joints: Range<usize>,
        rows: &mut [[T; N]],
    ) {
        let [x, y, z, ..] = rows else { return };
        for k in joints.start..joints.end.min(N) {
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

    /// Where all that hangs on some bodies ends.
    #[inline(always)]
    fn end_of(&self, bodies: usize, first: usize) -> usize {
        let Some(ends) = &self.ends else { return N };
        ends.iter().skip(first).take(bodies).copied().max().unwrap_or(N)
    }

    /// Whether a body at or after `first` hangs on one of a strip before it.
    #[inline(always)]
    fn carries<const ROWS: usize>(&self, strip: usize, first: usize) -> bool {
        self.end_of(ROWS, strip * ROWS) > first
    }
}

/// One column at a time.
const ONE: usize = 1;

/// Row `k` of K rows.
#[inline(always)]
fn row_in<T: Scalar, const W: usize, const K: usize>(rows: &[[T; W]; K]) -> impl Fn(usize) -> [T; W] {
    |k| rows.get(k).copied().unwrap_or([T::zero(); W])
}

#[inline(always)]
fn scale_all<T: Scalar, const W: usize, const K: usize>(rows: &mut [[T; W]; K], scale: T) {
    for x in rows.as_flattened_mut() {
        *x *= scale;
    }
}

/// Writes the last three rows.
#[inline(always)]
fn set_last<T: Scalar, const N: usize>(rows: &mut [[T; N]], last: &Vectors<T, N>) {
    for (row, last) in rows.iter_mut().rev().zip(last.0.iter().rev()) {
        *row = *last;
    }
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
