//! Motions and forces of a rigid body: pairs of vectors, about the origin of a link's frame.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, ch. 2.

use core::ops::Add;

use super::vector::Vector;
use crate::scalar::Scalar;

/// A velocity, an acceleration, or a joint's direction of motion.
#[derive(Clone, Copy)]
pub(super) struct Twist<T> {
    /// Of the body, rad/s (rad/s²).
    pub(super) angular: Vector<T>,
    /// Of the origin, m/s (m/s²).
    pub(super) linear: Vector<T>,
}

impl<T: Scalar> Twist<T> {
    /// No motion.
    #[inline(always)]
    pub(super) fn zero() -> Self {
        Self { angular: Vector::zero(), linear: Vector::zero() }
    }

    /// `k·self`
    #[inline(always)]
    pub(super) fn scaled(self, k: T) -> Self {
        Self { angular: self.angular.scaled(k), linear: self.linear.scaled(k) }
    }

    /// The same motion, at the point `offset` further on.
    #[inline(always)]
    pub(super) fn carried(self, offset: Vector<T>) -> Self {
        Self { angular: self.angular, linear: self.linear + self.angular.cross(offset) }
    }

    /// `V × S`: how the motion `S` changes when it is carried along by the velocity `self`.
    #[inline(always)]
    pub(super) fn cross(self, s: Self) -> Self {
        Self {
            angular: self.angular.cross(s.angular),
            linear: self.angular.cross(s.linear) + self.linear.cross(s.angular),
        }
    }

    /// `V ×* F`: how a wrench changes when it is carried along.
    #[inline(always)]
    pub(super) fn cross_wrench(self, f: Wrench<T>) -> Wrench<T> {
        Wrench {
            moment: self.angular.cross(f.moment) + self.linear.cross(f.force),
            force: self.angular.cross(f.force),
        }
    }

    /// The spatial acceleration, of a body with the velocity `v` whose origin has the acceleration `self`.
    #[inline(always)]
    pub(super) fn without_turning(self, v: Self) -> Self {
        Self { angular: self.angular, linear: self.linear - v.angular.cross(v.linear) }
    }

    /// As at the public face.
    pub(super) fn linear_first(self) -> [T; 6] {
        let ([a, b, c], [d, e, f]) = (self.linear.0, self.angular.0);
        [a, b, c, d, e, f]
    }

    /// The power of a wrench.
    #[inline(always)]
    pub(super) fn dot(self, f: Wrench<T>) -> T {
        self.angular.dot(f.moment) + self.linear.dot(f.force)
    }
}

impl<T: Scalar> Add for Twist<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, rhs: Self) -> Self {
        Self { angular: self.angular + rhs.angular, linear: self.linear + rhs.linear }
    }
}

/// A force and its moment.
#[derive(Clone, Copy)]
pub(super) struct Wrench<T> {
    /// Moment about the origin, N·m.
    pub(super) moment: Vector<T>,
    /// Force, N.
    pub(super) force: Vector<T>,
}

impl<T: Scalar> Wrench<T> {
    /// No force.
    #[inline(always)]
    pub(super) fn zero() -> Self {
        Self { moment: Vector::zero(), force: Vector::zero() }
    }

    /// `k·self`
    #[inline(always)]
    pub(super) fn scaled(self, k: T) -> Self {
        Self { moment: self.moment.scaled(k), force: self.force.scaled(k) }
    }

    /// As at the public face.
    pub(super) fn linear_first(self) -> [T; 6] {
        let ([a, b, c], [d, e, f]) = (self.force.0, self.moment.0);
        [a, b, c, d, e, f]
    }

    /// The same wrench about the parent's origin, from which this origin has the given offset.
    #[inline(always)]
    pub(super) fn shifted(self, offset: Vector<T>) -> Self {
        Self { moment: self.moment + offset.cross(self.force), force: self.force }
    }
}

impl<T: Scalar> Add for Wrench<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, rhs: Self) -> Self {
        Self { moment: self.moment + rhs.moment, force: self.force + rhs.force }
    }
}
