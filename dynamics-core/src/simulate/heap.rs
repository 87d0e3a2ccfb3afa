//! Vectors on the heap, for [flows](super::Flow) whose sizes are known at run time only.

use std::vec::Vec;

use super::Vector;
use crate::scalar::Scalar;

impl<T: Scalar> Vector<T> for Vec<T> {
    #[inline]
    fn entries(&self) -> &[T] {
        self
    }
    #[inline]
    fn entries_mut(&mut self) -> &mut [T] {
        self
    }
}
