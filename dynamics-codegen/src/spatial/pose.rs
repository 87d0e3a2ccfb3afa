//! Placements of one frame in another.

use std::ops::Mul;

use super::{Matrix3, Scalar, Vector3};

/// `X_AB`: the pose of frame B in frame A. `rotation` takes coordinates in B to A; `translation` is B's
/// origin in A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<S> {
    /// `R_AB`
    pub rotation: Matrix3<S>,
    /// `p_AB`, in A.
    pub translation: Vector3<S>,
}

impl<S: Scalar> Pose<S> {
    /// The pose of a frame in itself.
    pub fn identity() -> Self {
        Self { rotation: Matrix3::identity(), translation: Vector3::zero() }
    }

    /// A pose without rotation.
    pub fn translation(translation: Vector3<S>) -> Self {
        Self { rotation: Matrix3::identity(), translation }
    }

    /// A pose without translation.
    pub fn rotation(rotation: Matrix3<S>) -> Self {
        Self { rotation, translation: Vector3::zero() }
    }

    /// `X_BA`
    pub fn inverse(self) -> Self {
        let rotation = self.rotation.transpose();
        Self { rotation, translation: -(rotation * self.translation) }
    }

    /// Where the point with coordinates `p` in B lies in A.
    pub fn transform_point(self, p: Vector3<S>) -> Vector3<S> {
        self.translation + self.rotation * p
    }

    /// The pose with `f` applied to each entry.
    pub fn map<R>(self, mut f: impl FnMut(S) -> R) -> Pose<R> {
        Pose { rotation: self.rotation.map(&mut f), translation: self.translation.map(f) }
    }
}

impl<S: Scalar> Mul for Pose<S> {
    type Output = Self;
    /// `X_AC = X_AB · X_BC`
    fn mul(self, rhs: Self) -> Self {
        Self { rotation: self.rotation * rhs.rotation, translation: self.transform_point(rhs.translation) }
    }
}
