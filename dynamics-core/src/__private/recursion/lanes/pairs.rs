//! Entries for pairs of joints, one of which hangs on the other: four outer joints at a time.
//!
//! All wrenches on the four are counted from the origin of the first of them; what the joints nearer to the base do
//! there is worked out once for all four. Rows of inner joints run in lanes over these, rows of outer joints in lanes
//! over the four. The last group is moved back until it ends where the matrix does.

use core::array::from_fn;

use super::bodies::WrenchesInLanes;
use super::motion::TwistsInLanes;
use super::place::Placed;
use super::{InLanes, Vectors, at, set};
use crate::__private::recursion::screw::{Twist, Wrench};
use crate::__private::recursion::vector::Vector;
use crate::scalar::Scalar;

/// How many joints make a group.
const GROUP: usize = 4;

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
    placed: &'a Placed<T, N>,
    /// The wrenches of unit motions.
    rows: &'a WrenchesInLanes<T, N>,
    /// The last of all that hangs on each joint, or the joint itself.
    ends: [usize; N],
    /// Whether some joint does not hang on the one before it.
    has_branches: bool,
}

impl<T: Scalar, const N: usize> InLanes<'_, T, N> {
    pub(super) fn pairs<'a>(
        &self,
        placed: &'a Placed<T, N>,
        rows: &'a WrenchesInLanes<T, N>,
    ) -> Pairs<'a, T, N> {
        let mut ends = from_fn(|k| k);
        let mut has_branches = false;
        for k in (0..N).rev() {
            let end = ends.get(k).copied().unwrap_or(k);
            has_branches |= self.parent(k) != k.checked_sub(1);
            if let Some(parent) = self.parent(k).and_then(|parent| ends.get_mut(parent)) {
                *parent = end.max(*parent);
            }
        }
        Pairs { placed, rows, ends, has_branches }
    }
}

/// Four joints, and what is asked of them at the origin of the first.
struct Group<T> {
    first: usize,
    origin: Vector<T>,
}

/// Values for the four joints of a group, each for four joints nearer to the base in lanes.
type Tile<T> = [[T; GROUP]; GROUP];

impl<T: Scalar, const N: usize> Pairs<'_, T, N> {
    /// Writes `M`, both halves.
    pub(super) fn write_mass_matrix(&self, m: &mut Square<T, N>) {
        for block in 0..N.div_ceil(GROUP) {
            let group = self.group(block);
            let rows = self.about(&group, self.rows);
            for inner in 0..=block {
                let first = start::<N>(inner);
                let mut tile = [[T::zero(); GROUP]; GROUP];
                for lane in 0..GROUP {
                    let twist = self.carried(self.placed.twist(first + lane), first + lane, &group);
                    for (lanes, row) in tile.iter_mut().zip(&rows) {
                        set(lanes, lane, twist.dot(*row));
                    }
                }
                self.write(m, &group, first, &tile, &tile);
            }
        }
    }

    /// Writes `tr(Ŝ_i (𝕁 t̂_jᵀ + 𝔹 r̂_jᵀ))` for the twists `t` and turns `r` of the changes; `nu` has what their turns
    /// are multiplied with.
    pub(super) fn write_changes(&self, changes: &Changes<T, N>, nu: &Vectors<T, N>, m: &mut Square<T, N>) {
        for block in 0..N.div_ceil(GROUP) {
            let group = self.group(block);
            let (rows, columns) = (self.about(&group, self.rows), self.about(&group, &changes.wrenches));
            let mut nus = [Vector::zero(); GROUP];
            for (j, own) in nus.iter_mut().enumerate() {
                *own = nu.at(group.first + j);
            }
            for inner in 0..=block {
                let first = start::<N>(inner);
                let (mut above, mut below) = ([[T::zero(); GROUP]; GROUP], [[T::zero(); GROUP]; GROUP]);
                for lane in 0..GROUP {
                    let twist = self.carried(self.placed.twist(first + lane), first + lane, &group);
                    for (lanes, column) in above.iter_mut().zip(&columns) {
                        set(lanes, lane, twist.dot(*column));
                    }
                }
                for lane in 0..GROUP {
                    let change = self.carried(changes.twists.at(first + lane), first + lane, &group);
                    let turn = changes.turns.at(first + lane);
                    for (lanes, (row, nu)) in below.iter_mut().zip(rows.iter().zip(&nus)) {
                        set(lanes, lane, turn.dot(*nu) + change.dot(*row));
                    }
                }
                self.write(m, &group, first, &above, &below);
            }
        }
    }

    /// Four joints; the last four are moved back until they end where the matrix does.
    #[inline(always)]
    fn group(&self, block: usize) -> Group<T> {
        let first = start::<N>(block);
        Group { first, origin: self.placed.origins.at(first) }
    }

    /// The wrenches on the group's joints, about its origin.
    #[inline(always)]
    fn about(&self, group: &Group<T>, wrenches: &WrenchesInLanes<T, N>) -> [Wrench<T>; GROUP] {
        let mut about = [Wrench::zero(); GROUP];
        for (j, wrench) in about.iter_mut().enumerate() {
            let k = group.first + j;
            *wrench = wrenches.at(k).shifted(self.placed.origins.at(k) - group.origin);
        }
        about
    }

    /// A twist about the origin of joint `k`, about the group's.
    #[inline(always)]
    fn carried(&self, twist: Twist<T>, k: usize, group: &Group<T>) -> Twist<T> {
        twist.carried(group.origin - self.placed.origins.at(k))
    }

    /// Writes the rows of four inner joints into the group's columns, and the group's rows into those of the inner
    /// joints: all at once if all pairs are pairs, else what is above the diagonal, and what is not.
    #[inline(always)]
    fn write(&self, m: &mut Square<T, N>, group: &Group<T>, first: usize, above: &Tile<T>, below: &Tile<T>) {
        let last = group.first + GROUP - 1;
        let hangs = |k: usize, i: usize| i <= k && self.ends.get(i).is_some_and(|&end| end >= k);
        if first + GROUP <= group.first
            && (!self.has_branches || (first..first + GROUP).all(|i| hangs(last, i)))
        {
            for (j, lanes) in above.iter().enumerate() {
                if let Some(part) = m.get_mut(group.first + j).and_then(|c| c.get_mut(first..first + GROUP)) {
                    part.copy_from_slice(lanes);
                }
            }
            let [a, b, c, d] = below;
            for lane in 0..GROUP {
                let values = [at(a, lane), at(b, lane), at(c, lane), at(d, lane)];
                let part = m.get_mut(first + lane).and_then(|c| c.get_mut(group.first..group.first + GROUP));
                if let Some(part) = part {
                    part.copy_from_slice(&values);
                }
            }
            return;
        }
        for (j, (above, below)) in above.iter().zip(below).enumerate() {
            let k = group.first + j;
            for (lane, (above, below)) in above.iter().zip(below).enumerate() {
                let i = first + lane;
                if !hangs(k, i) {
                    continue;
                }
                if let Some(entry) = m.get_mut(i).and_then(|column| column.get_mut(k)) {
                    *entry = *below;
                }
                if i < k
                    && let Some(entry) = m.get_mut(k).and_then(|column| column.get_mut(i))
                {
                    *entry = *above;
                }
            }
        }
    }
}

/// Where the block of joints begins.
#[inline(always)]
fn start<const N: usize>(block: usize) -> usize {
    (block * GROUP).min(N.saturating_sub(GROUP))
}
