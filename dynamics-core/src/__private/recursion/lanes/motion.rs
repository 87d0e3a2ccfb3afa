//! How the links move.

use super::place::Placed;
use super::{InLanes, Vectors, entry};
use crate::__private::recursion::screw::Twist;
use crate::__private::recursion::vector::Vector;
use crate::scalar::Scalar;

/// A twist for each link, about its origin.
pub(super) struct TwistsInLanes<T, const N: usize> {
    pub(super) angular: Vectors<T, N>,
    pub(super) linear: Vectors<T, N>,
}

impl<T: Scalar, const N: usize> TwistsInLanes<T, N> {
    /// The linear, then the angular.
    #[inline(always)]
    pub(super) fn both(&self) -> (&Vectors<T, N>, &Vectors<T, N>) {
        (&self.linear, &self.angular)
    }

    pub(super) fn zero() -> Self {
        Self { angular: Vectors::zero(), linear: Vectors::zero() }
    }

    #[inline(always)]
    pub(super) fn at(&self, k: usize) -> Twist<T> {
        Twist { angular: self.angular.at(k), linear: self.linear.at(k) }
    }

    #[inline(always)]
    pub(super) fn set(&mut self, k: usize, twist: Twist<T>) {
        self.angular.set(k, twist.angular);
        self.linear.set(k, twist.linear);
    }
}

impl<T: Scalar, const N: usize> Placed<T, N> {
    /// The unit motions of all joints: their slides, then their turns.
    #[inline(always)]
    pub(super) fn unit_twists(&self) -> (&Vectors<T, N>, &Vectors<T, N>) {
        (&self.slides, &self.turns)
    }

    /// The unit motion of joint `k`.
    #[inline(always)]
    pub(super) fn twist(&self, k: usize) -> Twist<T> {
        Twist { angular: self.turns.at(k), linear: self.slides.at(k) }
    }
}

impl<T: Scalar, const NL: usize, const NQ: usize, const N: usize> InLanes<'_, T, NL, NQ, N> {
    /// Upwards as fast as things fall.
    pub(super) fn upwards(&self) -> Twist<T> {
        Twist { angular: Vector::zero(), linear: -Vector(self.tree.gravity) }
    }

    /// What a free base does at these speeds, or its part of accelerations that these are.
    fn of_base(&self, placed: &Placed<T, N>, speeds: &[T; N]) -> Twist<T> {
        (0..Self::BASE).fold(Twist::zero(), |sum, k| sum + placed.twist(k).scaled(entry(speeds, k)))
    }

    /// Writes the velocities for joint speeds `v`.
    pub(super) fn velocities(&self, placed: &Placed<T, N>, v: &[T; N], velocities: &mut TwistsInLanes<T, N>) {
        let base = self.of_base(placed, v);
        for k in 0..Self::BASE {
            velocities.set(k, base);
        }
        let mut last = (Self::BASE.wrapping_sub(1), base);
        for k in Self::BASE..N {
            let offset = placed.offsets.at(k);
            let parent = match self.parent(k) {
                None => Twist::zero(),
                Some(parent) if parent == last.0 => last.1,
                Some(parent) => velocities.at(parent),
            };
            let velocity = parent.carried(offset) + placed.twist(k).scaled(entry(v, k));
            velocities.set(k, velocity);
            last = (k, velocity);
        }
    }

    /// Writes the velocities, and the accelerations of the links' origins, less gravity, for joint accelerations `a`.
    pub(super) fn motions(
        &self,
        placed: &Placed<T, N>,
        v: &[T; N],
        a: &[T; N],
        [velocities, accelerations]: [&mut TwistsInLanes<T, N>; 2],
    ) {
        let world = (Twist::zero(), self.upwards());
        let (velocity, rate) = (self.of_base(placed, v), self.of_base(placed, a));
        let drift = Twist { angular: Vector::zero(), linear: velocity.angular.cross(velocity.linear) };
        let base = (velocity, self.upwards() + drift + rate);
        for k in 0..Self::BASE {
            velocities.set(k, base.0);
            accelerations.set(k, base.1);
        }
        let mut last = (Self::BASE.wrapping_sub(1), base);
        for k in Self::BASE..N {
            let offset = placed.offsets.at(k);
            let (velocity, acceleration) = match self.parent(k) {
                None => world,
                Some(parent) if parent == last.0 => last.1,
                Some(parent) => (velocities.at(parent), accelerations.at(parent)),
            };
            let (unit, w) = (placed.twist(k), velocity.angular);
            let joint = unit.scaled(entry(v, k));
            let drift = Twist {
                angular: w.cross(joint.angular),
                linear: w.cross(w.cross(offset) + joint.linear + joint.linear),
            };
            let velocity = velocity.carried(offset) + joint;
            let acceleration = acceleration.carried(offset) + drift + unit.scaled(entry(a, k));
            velocities.set(k, velocity);
            accelerations.set(k, acceleration);
            last = (k, (velocity, acceleration));
        }
    }
}
