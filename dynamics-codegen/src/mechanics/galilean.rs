//! What a body that nothing holds owes to Galileo: derivatives of its acceleration that need no solving.
//!
//! Gravity accelerates all of the robot alike, so that what turns the base, and all on it, turns `g` in the base's axes
//! and no more: `∂v̇/∂θ = [R_WBᵀ g]×`, and no joint feels it. Nor does any know how fast the whole goes: with the
//! velocity of the base, in axes that turn at ω, changes `v̇ = R_WBᵀ p̈ − ω × v` alone, `∂v̇/∂v = −[ω]×`. Where the base
//! is does not matter at all. Of the twelve columns of `∂a` by a free base only three, by ω, are left to be solved for.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::normal::NormalTree;
use crate::model::Motion;
use crate::spatial::{Scalar, Vector3};

/// The columns of `∂a/∂q` and `∂a/∂v` that are known, by speed; `None` where they must be solved for.
pub(super) struct Known<S> {
    /// Of `∂a/∂q`.
    pub(super) by_q: Vec<Option<Vec<S>>>,
    /// Of `∂a/∂v`.
    pub(super) by_v: Vec<Option<Vec<S>>>,
}

impl<S: Scalar> Known<S> {
    /// None of so many.
    pub(super) fn none(speeds: usize) -> Self {
        Self { by_q: vec![None; speeds], by_v: vec![None; speeds] }
    }

    /// Those of a tree at `q` and the robot's own speeds `v`, in metres; on which nothing else acts that knows of the world.
    pub(super) fn of(tree: &NormalTree<S>, q: &[S], v: &[S]) -> Self {
        let n = v.len();
        let mut known = Self::none(n);
        for (link, joint) in tree.links.iter().zip(tree.place(q)) {
            if link.parent.is_some() || link.motion != Motion::Free {
                continue;
            }
            let first = link.drive.v;
            let g_B = joint.down(tree.gravity);
            let w_B = Vector3([v[first + 3], v[first + 4], v[first + 5]]);
            let column = |change: Vector3<S>| {
                let mut column = vec![S::zero(); n];
                column[first..first + 3].copy_from_slice(&change.0);
                Some(column)
            };
            for k in 0..3 {
                known.by_q[first + k] = column(Vector3::zero());
                known.by_q[first + 3 + k] = column(g_B.cross(Vector3::unit(k)));
                known.by_v[first + k] = column(Vector3::unit(k).cross(w_B));
            }
        }
        known
    }
}
