//! The square matrices of long robots, computed in lanes.
//!
//! What the links need one by one stands side by side, number by number, so that loops over links run in vector
//! lanes; what goes from link to link along the tree is carried in registers; and the entries of a matrix, one for each
//! pair of joints of which one hangs on the other, are a product of matrices, some columns at a time. All in world axes,
//! each quantity at the origin of its own link or of one that is near it in the table: only the arms between two links
//! are added, so that no precision is lost far from the base.
//!
//! For trees whose every link has one degree of freedom, with the coordinate and the speed of its own index, and
//! whose links stand in the order of a walk: right after each link comes all that hangs on it. The first link may move
//! freely instead. It counts as six bodies in a row then, one for each of its speeds, at one place and with one velocity;
//! the last of them has its mass. Nothing here depends on where the free base is: all is counted from its own origin.
//!
//! What adds up from the tips is a chain of additions and nothing else: what a link gives its parent is computed in lanes
//! before.
//!
//! At 32 joints this is two to three times as fast as a straight line, whose code is too long for the cache.

mod bodies;
mod derivatives;
mod matrices;
mod motion;
mod pairs;
mod place;

use super::vector::Vector;
use super::{Joint, Tree};
use crate::__private::{entry, set};
use crate::scalar::Scalar;

/// A tree of which link `k` has coordinate `k`, speed `k` and no other, and stands right before its descendants; or of which
/// link 0 moves freely, with the first coordinates and speeds, and the others' follow. Bodies are counted by their speeds.
pub struct InLanes<'t, T, const NL: usize, const NQ: usize, const N: usize> {
    tree: &'t Tree<T, NL, NQ, N>,
    /// Whether each body hangs on the one before it.
    is_chain: bool,
}

impl<T: Scalar, const NL: usize, const NQ: usize, const N: usize> Tree<T, NL, NQ, N> {
    /// The matrices in lanes. The links must be as [`InLanes`] says: the compiler sees to it.
    #[inline(always)]
    pub fn in_lanes(&self) -> InLanes<'_, T, NL, NQ, N> {
        let mut lanes = InLanes { tree: self, is_chain: true };
        lanes.is_chain = (0..N).all(|k| lanes.parent(k) == k.checked_sub(1));
        lanes
    }
}

impl<T: Scalar, const NL: usize, const NQ: usize, const N: usize> InLanes<'_, T, NL, NQ, N> {
    /// So many bodies are a free base.
    const BASE: usize = if N > NL { 6 } else { 0 };
    /// So many come before that of link 0.
    const BEFORE: usize = Self::BASE.saturating_sub(1);

    fn parent(&self, k: usize) -> Option<usize> {
        if k < Self::BASE {
            return k.checked_sub(1);
        }
        self.tree.links.get(k - Self::BEFORE)?.parent.map(|link| link + Self::BEFORE)
    }

    /// For each body where what hangs on it ends; none for a chain, where that is the last one.
    fn ends(&self) -> Option<[usize; N]> {
        if self.is_chain {
            return None;
        }
        let mut ends = [0; N];
        for k in (0..N).rev() {
            let end = ends.get(k).map_or(0, |end| (k + 1).max(*end));
            set(&mut ends, k, end);
            if let Some(parent) = self.parent(k).and_then(|parent| ends.get_mut(parent)) {
                *parent = end.max(*parent);
            }
        }
        Some(ends)
    }

    fn turns(&self, k: usize) -> bool {
        let link = self.tree.links.get(k - Self::BEFORE);
        link.is_some_and(|link| matches!(link.joint, Joint::Revolute(..)))
    }

    /// The coordinate of each body; none of a free base.
    fn coordinates(&self, q: &[T; NQ]) -> [T; N] {
        let mut coordinates = [T::zero(); N];
        for k in Self::BASE..N {
            set(&mut coordinates, k, entry(q, k + NQ.saturating_sub(N)));
        }
        coordinates
    }

    /// What armatures add to the diagonal of M.
    fn armatures(&self) -> [T; N] {
        let mut armatures = [T::zero(); N];
        for (k, armature) in self.tree.armatures() {
            set(&mut armatures, k, armature);
        }
        armatures
    }

    /// What passive forces add to the diagonals of ∂τ/∂q and ∂τ/∂v.
    fn passive_slopes(&self, v: &[T; N]) -> [[T; N]; 2] {
        let [mut by_place, mut by_speed] = [[T::zero(); N]; 2];
        for (k, slopes) in self.tree.passive_slopes(v) {
            set(&mut by_place, k, slopes[0]);
            set(&mut by_speed, k, slopes[1]);
        }
        [by_place, by_speed]
    }
}

/// Three numbers for each of N links. Where N is a power of two, all numbers of a link would lie a power of two apart, of
/// which a cache keeps few; so a line of it is between one vector's numbers and the next one's.
#[derive(Clone, Copy)]
struct Vectors<T, const N: usize>(
    [[T; N]; 3],
    #[allow(dead_code, reason = "it takes place, and nothing else")] [u64; 8],
);

impl<T: Scalar, const N: usize> Vectors<T, N> {
    #[inline(always)]
    fn zero() -> Self {
        Self([[T::zero(); N]; 3], [0; 8])
    }

    #[inline(always)]
    fn at(&self, k: usize) -> Vector<T> {
        let [x, y, z] = &self.0;
        Vector([entry(x, k), entry(y, k), entry(z, k)])
    }

    #[inline(always)]
    fn set(&mut self, k: usize, value: Vector<T>) {
        for (x, value) in self.0.iter_mut().zip(value.0) {
            set(x, k, value);
        }
    }
}

/// Six numbers of one link.
#[inline(always)]
fn six_at<T: Scalar, const N: usize>([a, b, c, d, e, f]: &[[T; N]; 6], k: usize) -> [T; 6] {
    [entry(a, k), entry(b, k), entry(c, k), entry(d, k), entry(e, k), entry(f, k)]
}

/// Adds to an entry that is there.
#[inline(always)]
fn add<T: Scalar>(x: &mut [T], k: usize, value: T) {
    if let Some(x) = x.get_mut(k) {
        *x += value;
    }
}
