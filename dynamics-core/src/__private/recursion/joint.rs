//! What a joint is to the recursions: a pose at its coordinates, and a column for each of its speeds.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, §4.4.

use core::array::from_fn;
use core::ops::Range;

use super::screw::{Twist, Wrench};
use super::vector::{Matrix, Vector};
use super::{Drive, Joint, Link, Passive, entry};
use crate::scalar::Scalar;

impl<T: Scalar> Joint<T> {
    /// The drive and the passive forces of a joint of one degree of freedom.
    pub(super) fn driven(&self) -> Option<(&Drive<T>, &Passive<T>)> {
        match self {
            Self::Revolute(drive, passive) | Self::Prismatic(drive, passive) => Some((drive, passive)),
            Self::Ball { .. } | Self::Free { .. } => None,
        }
    }

    /// The armature as the drive feels it.
    pub(super) fn armature(&self) -> T {
        self.driven().map_or_else(T::zero, |(drive, passive)| drive.reflected(passive.armature))
    }

    /// The indices of the speeds.
    pub(super) fn speeds(&self) -> Range<usize> {
        let (v, [first, end]) = self.freedom();
        v..v.saturating_add(end - first)
    }

    /// The columns for a link with the given axes.
    pub(super) fn columns(&self, [x, y, z]: [Vector<T>; 3]) -> Columns<T> {
        let ratio = self.driven().map_or_else(T::one, |(drive, _)| drive.ratio);
        let (v, motions) = self.freedom();
        Columns { v, motions, axes: [x, y, z.scaled(ratio)] }
    }

    /// The first speed, and to which of the six motions, along x, y, z and about them, the speeds belong: from
    /// which, and before which.
    fn freedom(&self) -> (usize, [usize; 2]) {
        match *self {
            Self::Revolute(Drive { v, .. }, _) => (v, [5, 6]),
            Self::Prismatic(Drive { v, .. }, _) => (v, [2, 3]),
            Self::Ball { v, .. } => (v, [3, 6]),
            Self::Free { v, .. } => (v, [0, 6]),
        }
    }
}

impl<T: Scalar> Link<T> {
    /// The pose of the link in its parent's frame.
    pub(super) fn pose_in_parent(&self, q: &[T]) -> (Matrix<T>, Vector<T>) {
        let (rotation, position) = (Matrix(self.rotation), Vector(self.position));
        match self.joint {
            Joint::Revolute(drive, _) => {
                let (sine, cosine) = drive.position(q).sin_cos();
                (rotation.about_z(sine, cosine), position)
            }
            Joint::Prismatic(drive, _) => {
                (rotation, position + rotation.third_column().scaled(drive.position(q)))
            }
            Joint::Ball { q: at, .. } => {
                let quaternion = from_fn(|i| entry(q, at.saturating_add(i)));
                (rotation.product(Matrix::of_quaternion(quaternion)), position)
            }
            Joint::Free { q: at, .. } => {
                let [x, y, z, quaternion @ ..]: [T; 7] = from_fn(|i| entry(q, at.saturating_add(i)));
                let moved = position + rotation.times(Vector([x, y, z]));
                (rotation.product(Matrix::of_quaternion(quaternion)), moved)
            }
        }
    }
}

impl<T: Scalar> Drive<T> {
    /// Where the joint is.
    pub(super) fn position(&self, q: &[T]) -> T {
        self.ratio.mul_add(entry(q, self.q), self.offset)
    }

    /// How fast the joint is.
    pub(super) fn speed(&self, v: &[T]) -> T {
        self.ratio * entry(v, self.v)
    }
}

/// The columns of a joint.
#[derive(Clone, Copy)]
pub(super) struct Columns<T> {
    /// The first speed.
    v: usize,
    /// The first of the motions, and the end.
    motions: [usize; 2],
    /// The axes of the link; if one of them is driven, at unit speed of the drive.
    axes: [Vector<T>; 3],
}

impl<T: Scalar> Columns<T> {
    /// Of a link that cannot move.
    pub(super) fn none() -> Self {
        Self { v: 0, motions: [0, 0], axes: [Vector::zero(); 3] }
    }

    /// One after another, with ascending speeds.
    #[inline(always)]
    pub(super) fn iter(self) -> impl DoubleEndedIterator<Item = Column<T>> {
        let [first, end] = self.motions;
        (first..end).map(move |motion| {
            let axis = self.axes.get(motion % 3).copied().unwrap_or_else(Vector::zero);
            Column { v: self.v.saturating_add(motion - first), slides: motion < 3, axis }
        })
    }

    /// What the joint does at the given speeds: the sum of its columns, each times its speed.
    #[inline(always)]
    pub(super) fn at(self, speeds: &[T]) -> Twist<T> {
        self.iter().fold(Twist::zero(), |sum, column| sum + column.twist().scaled(entry(speeds, column.v)))
    }
}

/// How a link moves at unit speed, everything else at rest.
#[derive(Clone, Copy)]
pub(super) struct Column<T> {
    /// The index of the speed.
    pub(super) v: usize,
    slides: bool,
    axis: Vector<T>,
}

impl<T: Scalar> Column<T> {
    /// The twist, about the link's origin.
    #[inline(always)]
    pub(super) fn twist(&self) -> Twist<T> {
        if self.slides {
            Twist { angular: Vector::zero(), linear: self.axis }
        } else {
            Twist { angular: self.axis, linear: Vector::zero() }
        }
    }

    /// The power of a wrench about the link's origin: the joint force that holds it.
    #[inline(always)]
    pub(super) fn power(&self, wrench: Wrench<T>) -> T {
        if self.slides { self.axis.dot(wrench.force) } else { self.axis.dot(wrench.moment) }
    }
}
