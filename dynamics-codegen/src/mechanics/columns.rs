//! Degrees of freedom one by one: the unit motion of each, in its link's frame, and how they hang on each other.
//!
//! A joint of several degrees of freedom is as many columns in a row. Wherever no product of speeds is meant they
//! behave as if massless links stood between them.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use crate::model::{Drive, Motion};
use crate::spatial::{Scalar, Vector3};

/// The direction of a unit motion: along or about x, y or z (0, 1, 2) of the link's frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// A translation.
    Along(usize),
    /// A rotation.
    About(usize),
}

impl Direction {
    /// The unit motion.
    pub fn twist<S: Scalar>(self) -> Twist<S> {
        match self {
            Self::Along(k) => Twist { linear: Vector3::unit(k), ..Twist::zero() },
            Self::About(k) => Twist { angular: Vector3::unit(k), ..Twist::zero() },
        }
    }
}

/// The directions of a joint's degrees of freedom, in order.
pub fn directions(motion: Motion) -> &'static [Direction] {
    use Direction::{About, Along};
    match motion {
        Motion::Revolute => &[About(2)],
        Motion::Prismatic => &[Along(2)],
        Motion::Ball => &[About(0), About(1), About(2)],
        Motion::Free => &[Along(0), Along(1), Along(2), About(0), About(1), About(2)],
    }
}

/// A motion, or a derivative of one: angular and linear, about the origin of the frame it is written in.
#[derive(Clone, Copy, Debug)]
pub struct Twist<S> {
    /// rad/s
    pub angular: Vector3<S>,
    /// m/s
    pub linear: Vector3<S>,
}

impl<S: Scalar> Twist<S> {
    /// At rest.
    pub fn zero() -> Self {
        Self { angular: Vector3::zero(), linear: Vector3::zero() }
    }

    /// `[self, S]`: how a unit motion changes that is carried along by a body with this motion.
    pub fn carries(self, unit: Self) -> Self {
        let (w, v) = (self.angular, self.linear);
        Self { angular: w.cross(unit.angular), linear: w.cross(unit.linear) + v.cross(unit.angular) }
    }
}

impl<S: Scalar> std::ops::Add for Twist<S> {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        Self { angular: self.angular + rhs.angular, linear: self.linear + rhs.linear }
    }
}

/// One degree of freedom of one link.
#[derive(Clone, Copy, Debug)]
pub struct Column<S> {
    /// The link.
    pub link: usize,
    /// Which way it goes.
    pub direction: Direction,
    /// The column before it: of the same joint, or the last of the parent's; `None` is the base.
    pub parent: Option<usize>,
    /// Which of the robot's speeds drives it.
    pub speed: usize,
    /// Its speed while that one is one.
    pub ratio: S,
}

/// All columns of joints given by their parents, motions and drives, in order.
pub fn columns<S: Scalar>(joints: impl Iterator<Item = (Option<usize>, Motion, Drive<S>)>) -> Vec<Column<S>> {
    let mut columns: Vec<Column<S>> = Vec::new();
    let mut last: Vec<usize> = Vec::new();
    for (link, (parent, motion, drive)) in joints.enumerate() {
        let mut parent = parent.map(|parent| last[parent]);
        for (part, &direction) in directions(motion).iter().enumerate() {
            let (speed, ratio) = (drive.v + part, drive.ratio);
            columns.push(Column { link, direction, parent, speed, ratio });
            parent = Some(columns.len() - 1);
        }
        last.push(columns.len() - 1);
    }
    columns
}
