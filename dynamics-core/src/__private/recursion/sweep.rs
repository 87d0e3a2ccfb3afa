//! The two directions of a recursion, without a way to panic.

use core::iter::successors;
use core::ops::{Add, AddAssign};

use nalgebra::SMatrix;

use super::Tree;
use super::place::Body;
use super::vector::Vector;
use crate::__private::columns;
use crate::scalar::Scalar;

impl<T: Scalar, const NL: usize, const NQ: usize, const NV: usize> Tree<T, NL, NQ, NV> {
    /// One value for each link, from an item of its own and the value of its parent; that of the world is `base`.
    pub(super) fn base_to_tip<I, S: Copy>(
        &self,
        items: impl IntoIterator<Item = I>,
        base: S,
        mut step: impl FnMut(I, S) -> S,
    ) -> [S; NL] {
        let mut values = [base; NL];
        for (k, item) in (0..NL).zip(items) {
            let parent = self.parent(k).and_then(|parent| values.get(parent));
            let value = step(item, parent.copied().unwrap_or(base));
            if let Some(own) = values.get_mut(k) {
                *own = value;
            }
        }
        values
    }

    /// For each link the value of its parent; that of the world is `base`.
    pub(super) fn of_parents<S: Copy>(&self, values: &[S; NL], base: S) -> [S; NL] {
        each(0..NL, base, |k| self.parent(k).and_then(|parent| values.get(parent)).copied().unwrap_or(base))
    }

    /// Adds to each link's value those of all its descendants; `shifted` takes a value to the parent's origin.
    pub(super) fn collect_tip_to_base<S: Copy + Add<Output = S>>(
        &self,
        bodies: &[Body<T>; NL],
        mut values: [S; NL],
        shifted: impl Fn(S, Vector<T>) -> S,
    ) -> [S; NL] {
        for (k, (link, body)) in self.links.iter().zip(bodies).enumerate().rev() {
            let Some((before, [value, ..])) = values.split_at_mut_checked(k) else { continue };
            if let Some(parent) = link.parent.and_then(|parent| before.get_mut(parent)) {
                *parent = *parent + shifted(*value, body.offset);
            }
        }
        values
    }

    /// The links from `link` down to the base, `link` first; none for the world.
    pub(super) fn path_to_base(&self, link: Option<usize>) -> impl Iterator<Item = usize> {
        successors(link, |&k| self.parent(k))
    }

    fn parent(&self, k: usize) -> Option<usize> {
        self.links.get(k)?.parent.filter(|&parent| parent < k)
    }
}

/// `step` of each item; `blank` is only what the array begins with.
pub(super) fn each<I, S: Copy, const N: usize>(
    items: impl IntoIterator<Item = I>,
    blank: S,
    mut step: impl FnMut(I) -> S,
) -> [S; N] {
    let mut values = [blank; N];
    for (value, item) in values.iter_mut().zip(items) {
        *value = step(item);
    }
    values
}

/// `a − b`
pub(super) fn difference<T: Scalar, const N: usize>(a: &[T; N], b: &[T; N]) -> [T; N] {
    each(a.iter().zip(b), T::zero(), |(a, b)| *a - *b)
}

/// The zero matrix.
pub(super) fn zeros<T: Scalar, const N: usize>() -> SMatrix<T, N, N> {
    columns([[T::zero(); N]; N])
}

/// Adds to an entry, if there is one.
#[inline(always)]
pub(super) fn add<T: AddAssign>(values: &mut [T], index: usize, value: T) {
    if let Some(entry) = values.get_mut(index) {
        *entry += value;
    }
}

/// Adds to an entry of a matrix, if there is one.
#[inline(always)]
pub(super) fn add_entry<T: Scalar, const N: usize>(
    m: &mut SMatrix<T, N, N>,
    row: usize,
    column: usize,
    value: T,
) {
    if let Some(column) = m.data.0.get_mut(column) {
        add(column, row, value);
    }
}
