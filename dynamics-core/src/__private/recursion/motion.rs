//! How the links move: velocities and accelerations from the base to the tips.
//!
//! The linear part of an acceleration is that of the link's origin, less gravity: the base accelerates upwards,
//! so no link needs a weight.
//!
//! J. Luh, M. Walker, R. Paul, *On-line computational scheme for mechanical manipulators*, 1980.

use super::Tree;
use super::place::Body;
use super::screw::Twist;
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

impl<T: Scalar, const N: usize> Tree<T, N> {
    /// Velocities and drifts of all links, for joint speeds `v`.
    pub(super) fn motions(&self, bodies: &[Body<T>; N], v: &[T; N]) -> [Motion<T>; N] {
        let at_rest = Motion { velocity: Twist::zero(), drift: Twist::zero() };
        self.base_to_tip(bodies.iter().zip(v), at_rest, |(body, v), parent| Motion {
            velocity: parent.velocity.carried(body.offset) + body.twist().scaled(*v),
            drift: drift(body, parent.velocity.angular, *v),
        })
    }

    /// Accelerations of all links, less gravity, for joint accelerations `a`.
    pub(super) fn accelerations(
        &self,
        bodies: &[Body<T>; N],
        motions: &[Motion<T>; N],
        a: &[T; N],
    ) -> [Twist<T>; N] {
        let items = bodies.iter().zip(motions).zip(a);
        self.base_to_tip(items, self.base_acceleration(), |((body, motion), a), parent| {
            parent.carried(body.offset) + motion.drift + body.twist().scaled(*a)
        })
    }

    /// Upwards as fast as things fall.
    pub(super) fn base_acceleration(&self) -> Twist<T> {
        Twist { angular: Vector::zero(), linear: -Vector(self.gravity) }
    }
}

/// Centripetal and Coriolis acceleration at a joint whose parent turns with `w`.
fn drift<T: Scalar>(body: &Body<T>, w: Vector<T>, v: T) -> Twist<T> {
    let centripetal = w.cross(w.cross(body.offset));
    let sweep = w.cross(body.axis.scaled(v));
    if body.prismatic {
        Twist { angular: Vector::zero(), linear: centripetal + sweep + sweep }
    } else {
        Twist { angular: sweep, linear: centripetal }
    }
}
