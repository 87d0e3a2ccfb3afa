//! Trees all of whose numbers are known when the robot is compiled: they stand in memory that is never written, instead of
//! being written anew in each call. Of long robots in lanes over links that is a tenth of `M` and a twentieth of the others.

use core::any::Any;

use super::Tree;
use crate::scalar::Scalar;

impl<const NL: usize, const NQ: usize, const NV: usize> Tree<f64, NL, NQ, NV> {
    /// What `read` makes of this tree, whose numbers `single` has rounded: of the one that has numbers of type `T`, or else
    /// of one that `fill` makes.
    ///
    /// Which it is the compiler knows, and nothing is left of the question. Scalars that are wider would be slower with a
    /// copy of this tree than with one that is filled: links are moved then.
    #[inline(always)]
    pub fn read_in<T: Scalar, R>(
        &'static self,
        single: &'static Tree<f32, NL, NQ, NV>,
        fill: impl FnOnce() -> Tree<T, NL, NQ, NV>,
        read: impl FnOnce(&Tree<T, NL, NQ, NV>) -> R,
    ) -> R {
        let trees: [&dyn Any; 2] = [self, single];
        match trees.into_iter().find_map(<dyn Any>::downcast_ref) {
            Some(tree) => read(tree),
            None => read(&fill()),
        }
    }
}

/// A number as it is written, where others are converted by [`Scalar::of`].
pub const fn same<T: Copy>(x: T) -> T {
    x
}
