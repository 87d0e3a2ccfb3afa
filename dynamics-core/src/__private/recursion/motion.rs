//! How the links move: velocities and accelerations from the base to the tips.
//!
//! The linear part of an acceleration is that of the link's origin, less gravity: the base accelerates upwards,
//! so no link needs a weight.
//!
//! J. Luh, M. Walker, R. Paul, *On-line computational scheme for mechanical manipulators*, 1980.

use super::Tree;
use super::place::Body;
use super::screw::Twist;
use super::sweep::each;
use super::vector::Vector;
use crate::scalar::Scalar;

/// What a link's motion owes to the speeds of the joints.
#[derive(Clone, Copy)]
pub(super) struct Motion<T> {
    /// The velocity.
    pub(super) velocity: Twist<T>,
    /// The acceleration beyond the parent's that comes of speeds alone.
    pub(super) drift: Twist<T>,
}

/// How a link would move if its joint stood still: with its parent.
#[derive(Clone, Copy)]
pub(super) struct Carried<T> {
    /// The velocity.
    pub(super) velocity: Twist<T>,
    /// The spatial acceleration, less gravity: the rate of the velocity of whatever of the body is at a place.
    pub(super) acceleration: Twist<T>,
}

impl<T: Scalar, const NL: usize, const NQ: usize, const NV: usize> Tree<T, NL, NQ, NV> {
    /// Velocities and drifts of all links, for joint speeds `v`.
    pub(super) fn motions(&self, bodies: &[Body<T>; NL], v: &[T; NV]) -> [Motion<T>; NL] {
        let base = Motion { velocity: Twist::zero(), drift: Twist::zero() };
        self.base_to_tip(bodies, base, |body, Motion { velocity: parent, .. }| {
            let joint = body.columns.at(v);
            Motion {
                velocity: parent.carried(body.offset) + joint,
                drift: drift(parent.angular, body.offset, joint),
            }
        })
    }

    /// Accelerations of all links, less gravity, for joint accelerations `a`.
    pub(super) fn accelerations(
        &self,
        bodies: &[Body<T>; NL],
        motions: &[Motion<T>; NL],
        a: &[T; NV],
    ) -> [Twist<T>; NL] {
        self.base_to_tip(bodies.iter().zip(motions), self.base_acceleration(), |(body, motion), parent| {
            parent.carried(body.offset) + motion.drift + body.columns.at(a)
        })
    }

    /// The motions that the parents impart.
    pub(super) fn carried(
        &self,
        bodies: &[Body<T>; NL],
        motions: &[Motion<T>; NL],
        accelerations: &[Twist<T>; NL],
    ) -> [Carried<T>; NL] {
        let base = Carried { velocity: Twist::zero(), acceleration: self.base_acceleration() };
        let own = each(motions.iter().zip(accelerations), base, |(Motion { velocity, .. }, acceleration)| {
            Carried { velocity: *velocity, acceleration: acceleration.without_turning(*velocity) }
        });
        let parents = self.of_parents(&own, base);
        each(bodies.iter().zip(parents), base, |(body, parent)| Carried {
            velocity: parent.velocity.carried(body.offset),
            acceleration: parent.acceleration.carried(body.offset),
        })
    }

    /// Upwards as fast as things fall.
    pub(super) fn base_acceleration(&self) -> Twist<T> {
        Twist { angular: Vector::zero(), linear: -Vector(self.gravity) }
    }
}

/// Centripetal and Coriolis acceleration of a link at `offset` from a parent that turns with `w`, and which its
/// joint moves with the twist `joint`, constant in the link's own axes.
fn drift<T: Scalar>(w: Vector<T>, offset: Vector<T>, joint: Twist<T>) -> Twist<T> {
    let centripetal = w.cross(w.cross(offset) + joint.linear);
    Twist { angular: w.cross(joint.angular), linear: centripetal + (w + joint.angular).cross(joint.linear) }
}
