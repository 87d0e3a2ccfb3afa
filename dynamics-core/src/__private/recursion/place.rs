//! The robot at a configuration: every link's axes, its place beside its parent, and its mass, in world axes.
//!
//! P. Wensing, S. Kim, J.-J. Slotine, *Linear matrix inequalities for physically consistent inertial parameter
//! identification*, RA-L 2018, for mass by its moments of order 0, 1 and 2.

use core::ops::Add;

use super::screw::{Twist, Wrench};
use super::vector::{Matrix, Vector};
use super::{Link, Tree};
use crate::scalar::Scalar;

/// A link at a configuration.
#[derive(Clone, Copy)]
pub(super) struct Body<T> {
    /// Whether the joint slides.
    pub(super) prismatic: bool,
    /// From the link's axes to the world's.
    pub(super) rotation: Matrix<T>,
    /// The joint's axis.
    pub(super) axis: Vector<T>,
    /// From the parent's origin to the link's.
    pub(super) offset: Vector<T>,
    /// The link's own mass.
    pub(super) moments: Moments<T>,
}

impl<T: Scalar> Body<T> {
    /// The world, as a parent.
    pub(super) fn world() -> Self {
        Self {
            prismatic: false,
            rotation: Matrix::identity(),
            axis: Vector::zero(),
            offset: Vector::zero(),
            moments: Moments::zero(),
        }
    }

    /// The joint's twist at unit speed.
    #[inline(always)]
    pub(super) fn twist(&self) -> Twist<T> {
        if self.prismatic {
            Twist { angular: Vector::zero(), linear: self.axis }
        } else {
            Twist { angular: self.axis, linear: Vector::zero() }
        }
    }

    /// What the joint feels of a wrench about the link's origin.
    #[inline(always)]
    pub(super) fn along_joint(&self, wrench: Wrench<T>) -> T {
        if self.prismatic { self.axis.dot(wrench.force) } else { self.axis.dot(wrench.moment) }
    }
}

impl<T: Scalar> Link<T> {
    /// The pose of the link in its parent's frame.
    pub(super) fn pose_in_parent(&self, q: T) -> (Matrix<T>, Vector<T>) {
        let (rotation, position) = (Matrix(self.rotation), Vector(self.position));
        if self.prismatic {
            return (rotation, position + rotation.third_column().scaled(q));
        }
        let (s, c) = q.sin_cos();
        let about_z = |[x, y, z]: [T; 3]| [x.mul_add(c, y * s), y.mul_add(c, -(x * s)), z];
        (Matrix(self.rotation.map(about_z)), position)
    }

    fn moments(&self) -> Moments<T> {
        Moments { mass: self.mass, first: Vector(self.first), second: Matrix::symmetric(self.second) }
    }
}

impl<T: Scalar, const N: usize> Tree<T, N> {
    /// The links at the configuration `q`.
    pub(super) fn place(&self, q: &[T; N]) -> [Body<T>; N] {
        self.base_to_tip(self.links.iter().zip(q), Body::world(), |(link, q), parent| {
            let (rotation, position) = link.pose_in_parent(*q);
            let rotation = parent.rotation.product(rotation);
            Body {
                prismatic: link.prismatic,
                rotation,
                axis: rotation.third_column(),
                offset: parent.rotation.times(position),
                moments: link.moments().turned(rotation),
            }
        })
    }
}

/// Mass by its moments about an origin: `m`, `h = ∫r dm`, `Σ = ∫r rᵀ dm`.
#[derive(Clone, Copy)]
pub(super) struct Moments<T> {
    /// kg
    pub(super) mass: T,
    /// kg·m
    pub(super) first: Vector<T>,
    /// kg·m²
    pub(super) second: Matrix<T>,
}

impl<T: Scalar> Moments<T> {
    /// No mass.
    pub(super) fn zero() -> Self {
        Self { mass: T::zero(), first: Vector::zero(), second: Matrix::zero() }
    }

    fn turned(self, rotation: Matrix<T>) -> Self {
        Self {
            mass: self.mass,
            first: rotation.times(self.first),
            second: rotation.product(self.second).product(rotation.transpose()),
        }
    }

    /// The same mass about the parent's origin, from which this origin has the given offset.
    pub(super) fn shifted(self, offset: Vector<T>) -> Self {
        let first = self.first + offset.scaled(self.mass);
        Self {
            mass: self.mass,
            first,
            second: self.second + Matrix::outer(first, offset) + Matrix::outer(offset, self.first),
        }
    }

    /// `J·w`, with the rotational inertia `J = tr(Σ)·1 − Σ`.
    #[inline(always)]
    pub(super) fn rotational_times(&self, w: Vector<T>) -> Vector<T> {
        self.second.trace_minus_times(w)
    }

    /// The wrench that gives a body at rest the acceleration `a`; of a velocity, the momentum.
    #[inline(always)]
    pub(super) fn wrench_of(&self, a: Twist<T>) -> Wrench<T> {
        Wrench {
            moment: self.rotational_times(a.angular) + self.first.cross(a.linear),
            force: a.angular.cross(self.first) + a.linear.scaled(self.mass),
        }
    }

    /// The wrench that a body needs for its speed alone: `w × Jw` and `w × (w × h)`.
    #[inline(always)]
    pub(super) fn centripetal_wrench(&self, w: Vector<T>) -> Wrench<T> {
        Wrench { moment: w.cross(self.rotational_times(w)), force: w.cross(w.cross(self.first)) }
    }
}

impl<T: Scalar> Add for Moments<T> {
    type Output = Self;

    fn add(self, rhs: Self) -> Self {
        Self { mass: self.mass + rhs.mass, first: self.first + rhs.first, second: self.second + rhs.second }
    }
}
