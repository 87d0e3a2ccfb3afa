//! The two directions of a recursion, without a way to panic.

use core::iter::successors;
use core::ops::Add;

use nalgebra::SMatrix;

use super::Tree;
use super::place::Body;
use super::vector::Vector;
use crate::__private::columns;
use crate::scalar::Scalar;

impl<T: Scalar, const N: usize> Tree<T, N> {
    /// One value for each link, from an item of its own and the value of its parent; that of the world is `base`.
    pub(super) fn base_to_tip<I, S: Copy>(
        &self,
        items: impl IntoIterator<Item = I>,
        base: S,
        mut step: impl FnMut(I, S) -> S,
    ) -> [S; N] {
        let mut values = [base; N];
        for (k, (link, item)) in self.links.iter().zip(items).enumerate() {
            let parent = link.parent.filter(|&parent| parent < k).and_then(|parent| values.get(parent));
            let value = step(item, parent.copied().unwrap_or(base));
            if let Some(own) = values.get_mut(k) {
                *own = value;
            }
        }
        values
    }

    /// Adds to each link's value those of all its descendants; `shifted` takes a value to the parent's origin.
    pub(super) fn collect_tip_to_base<S: Copy + Add<Output = S>>(
        &self,
        bodies: &[Body<T>; N],
        mut values: [S; N],
        shifted: impl Fn(S, Vector<T>) -> S,
    ) -> [S; N] {
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
        successors(link, |&k| self.links.get(k)?.parent.filter(|&parent| parent < k))
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

/// The zero matrix.
pub(super) fn zeros<T: Scalar, const N: usize>() -> SMatrix<T, N, N> {
    columns([[T::zero(); N]; N])
}

/// Writes an entry, if there is one.
#[inline(always)]
pub(super) fn set<T, const N: usize>(m: &mut SMatrix<T, N, N>, row: usize, column: usize, value: T) {
    if let Some(entry) = m.data.0.get_mut(column).and_then(|column| column.get_mut(row)) {
        *entry = value;
    }
}
