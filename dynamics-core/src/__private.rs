//! What generated code needs, under names no user can shadow. Not part of the public interface.

pub mod each;
pub mod elimination_tree;
mod gauss_jordan;
mod in_place;
pub mod inverse;
pub mod manifold;
pub mod recursion;
pub mod solve;

pub use core::option::Option::{None, Some};

pub use nalgebra::{ArrayStorage, SMatrix, SVector};

pub use crate::centroidal::CentroidalDynamics;
pub use crate::dynamics::{
    Dynamics, DynamicsDerivatives, EquationsOfMotion, ForwardDynamicsDerivatives, InverseDynamicsDerivatives,
};
pub use crate::equations::{Definition, Equation, Equations};
pub use crate::error::Error;
pub use crate::kinematics::{EachFrame, Frame, FrameVisitor, Kinematics, Pose};
pub use crate::linearize::{Linearization, StateSpaceModel};
pub use crate::mechanism::{Cost, Costs, FrameCosts, JointLimits, Mechanism, Motion};
pub use crate::regressor::{BaseRegressor, Regressor};
pub use crate::scalar::{One, Scalar, Zero};
pub use crate::state::{Configuration, State};
pub use each::{Branches, Elementwise, of_each};
pub use elimination_tree::EliminationTree;
pub use inverse::{forward_from_inverse, inverse_of};
pub use manifold::{
    ball_rate, ball_rate_transposed, ball_tangent_rate, difference_ball, difference_free, free_rate,
    free_rate_transposed, free_tangent_rate, integrate_ball, integrate_free,
};
pub use solve::Factors;

/// `(sin x, cos x)`.
#[inline(always)]
pub fn sin_cos<T: Scalar>(x: T) -> (T, T) {
    x.sin_cos()
}

/// The sines and the cosines of several angles.
#[inline(always)]
pub fn sin_cos_each<T: Scalar, const N: usize>(x: [T; N]) -> [[T; N]; 2] {
    T::sin_cos_each(x)
}

/// `a·b + c`, fused where the target can.
#[inline(always)]
pub fn madd<T: Scalar>(a: T, b: T, c: T) -> T {
    a.mul_add(b, c)
}

/// `√x`.
#[inline(always)]
pub fn sqrt<T: Scalar>(x: T) -> T {
    x.sqrt()
}

/// The constant `value`.
#[inline(always)]
pub fn of<T: Scalar>(value: f64) -> T {
    T::of(value)
}

/// The R×C matrix with the given columns.
#[inline(always)]
pub const fn columns<T, const R: usize, const C: usize>(columns: [[T; R]; C]) -> SMatrix<T, R, C> {
    SMatrix::from_array_storage(ArrayStorage(columns))
}

/// Writes the square block with the given columns onto the diagonal of `matrix`, from row and column `first` on;
/// what does not fit is left out.
#[inline]
pub fn put_on_diagonal<T: Scalar, const N: usize, const K: usize>(
    matrix: &mut SMatrix<T, N, N>,
    first: usize,
    block: [[T; K]; K],
) {
    crate::linearize::put(matrix, first, first, &columns(block));
}

/// The vector with the given entries.
#[inline(always)]
pub const fn vector<T, const N: usize>(entries: [T; N]) -> SVector<T, N> {
    SVector::from_array_storage(ArrayStorage([entries]))
}

/// An entry that is there; zero if there is none.
#[inline(always)]
fn entry<T: Scalar>(x: &[T], index: usize) -> T {
    x.get(index).copied().unwrap_or_else(T::zero)
}

/// Writes an entry that is there.
#[inline(always)]
fn set<T>(x: &mut [T], index: usize, value: T) {
    if let Some(x) = x.get_mut(index) {
        *x = value;
    }
}
