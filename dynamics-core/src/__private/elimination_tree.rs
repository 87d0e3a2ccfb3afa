//! Where a mass matrix and its factors have entries.

use core::ops::Range;

use crate::product::{LONG_STRIP, STRIP};

/// Where the factors of a matrix have entries: at each joint and those between it and the base.
#[derive(Clone, Copy, Debug)]
pub struct EliminationTree<const N: usize> {
    /// For each strip of rows, the strips of joints that one of them is, hangs on, or carries.
    related: [Runs<N>; N],
    /// Of so many rows as are solved for at a time.
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

/// Some strips of joints, in order: where each run of them begins and ends.
#[derive(Clone, Copy, Debug)]
struct Runs<const N: usize> {
    runs: [[u16; 2]; N],
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

impl<const N: usize> Runs<N> {
    const NONE: Self = Self { runs: [[0; 2]; N], count: 0 };

    /// The strips that have a marked joint.
    const fn among(marks: [&[bool; N]; 2]) -> Self {
        let mut found = Self::NONE;
        let mut joint = 0;
        while joint < N {
            if marks[0][joint] || marks[1][joint] {
                let begin = joint / STRIP * STRIP;
                let end = if begin + STRIP < N { begin + STRIP } else { N };
                if found.count > 0 && found.runs[found.count - 1][1] as usize == begin {
                    found.runs[found.count - 1][1] = end as u16;
                } else {
                    found.runs[found.count] = [begin as u16, end as u16];
                    found.count += 1;
                }
                joint = end;
            } else {
                joint += 1;
            }
        }
        found
    }

    #[inline(always)]
    fn iter(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        let runs = self.runs.get(..self.count).unwrap_or_default();
        runs.iter().map(|&[begin, end]| usize::from(begin)..usize::from(end))
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
        let (below, beyond) = Ways::marks(&parents, STRIP);
        let (mut related, mut strip) = ([Runs::NONE; N], 0);
        while strip < N.div_ceil(STRIP) {
            related[strip] = Runs::among([&below[strip], &beyond[strip]]);
            strip += 1;
        }
        Self { related, solved: Ways::of(&parents, rows_to_solve(N)) }
    }

    /// The strips of joints that one of a strip is, hangs on, or carries.
    #[inline(always)]
    pub(super) fn related(&self, strip: usize) -> impl Iterator<Item = Range<usize>> + '_ {
        self.related.get(strip).unwrap_or(const { &Runs::NONE }).iter()
    }

    /// The joints that one of so many rows as are [solved for](rows_to_solve) is, or hangs on.
    #[inline(always)]
    pub(super) fn below_solved(&self, part: usize) -> impl Iterator<Item = usize> + '_ {
        self.solved.below.get(part).unwrap_or(const { &Joints::NONE }).iter()
    }

    /// The joints that are one of them, or hang on one.
    #[inline(always)]
    pub(super) fn beyond_solved(&self, part: usize) -> impl Iterator<Item = usize> + '_ {
        self.solved.beyond.get(part).unwrap_or(const { &Joints::NONE }).iter()
    }
}

impl<const N: usize> Ways<N> {
    /// Of so many rows at a time.
    const fn of(parents: &[Option<usize>; N], rows: usize) -> Self {
        let (below, beyond) = Self::marks(parents, rows);
        let mut ways = Self { below: [Joints::NONE; N], beyond: [Joints::NONE; N] };
        let mut part = 0;
        while part < N.div_ceil(rows) {
            ways.below[part] = Joints::among(&below[part]);
            ways.beyond[part] = Joints::among(&beyond[part]);
            part += 1;
        }
        ways
    }

    /// Which joints these are.
    const fn marks(parents: &[Option<usize>; N], rows: usize) -> ([[bool; N]; N], [[bool; N]; N]) {
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
        (below, beyond)
    }
}

/// So many rows are solved for at a time: those of a long strip, unless half of the last one would be in vain. With registers of
/// four doubles four columns of it are eight sums of six loads; eight columns of a strip are as many of nine.
pub(super) const fn rows_to_solve(n: usize) -> usize {
    let is_filled = n >= LONG_STRIP && n.div_ceil(LONG_STRIP) * LONG_STRIP == n.div_ceil(STRIP) * STRIP;
    if is_filled { LONG_STRIP } else { STRIP }
}
