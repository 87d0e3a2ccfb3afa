//! How the links move: velocities and accelerations from the base to the tips.
//!
//! For each link, in its own frame with its origin on the joint: angular velocity `w`, velocity of the origin
//! `v`, acceleration of the origin `a` (minus gravity: the base accelerates upwards, so no link needs a
//! weight), and `U = ŵ̇ + ŵŵ`, which carries the acceleration of any point, `a + U r`.
//!
//! W. Khalil, J.-F. Kleinfinger, *Minimum operations and minimum parameters of the dynamic models of tree
//! structure robots*, 1987, for sharing U; its columns along a parent's axis are one vector turned downwards.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use std::ops::Add;

use super::columns::Twist;
use super::normal::{NormalTree, PlacedJoint};
use crate::model::Motion;
use crate::spatial::{Matrix3, Pose, Scalar, Vector3};

/// The acceleration of a link.
#[derive(Clone, Copy, Debug)]
pub struct LinkAcceleration<S> {
    /// Angular velocity, rad/s.
    pub w: Vector3<S>,
    /// Angular acceleration, rad/s².
    pub wd: Vector3<S>,
    /// `U = ŵ̇ + ŵŵ`, 1/s².
    pub U: Matrix3<S>,
    /// Acceleration of the origin less gravity, m/s².
    pub a: Vector3<S>,
}

impl<S: Scalar> LinkAcceleration<S> {
    fn of_base(gravity: Vector3<S>) -> Self {
        Self { w: Vector3::zero(), wd: Vector3::zero(), U: Matrix3::zero(), a: -gravity }
    }

    /// That of a frame at rest in the link.
    pub fn at(&self, frame: Pose<S>) -> Self {
        let (R, origin) = (frame.rotation.transpose(), self.a + self.U * frame.translation);
        Self::from_rates(R * self.w, R * self.wd, R * origin)
    }

    /// Fills U from the velocity and the acceleration.
    fn from_rates(w: Vector3<S>, wd: Vector3<S>, a: Vector3<S>) -> Self {
        let ([x, y, z], [dx, dy, dz]) = (w.0, wd.0);
        let (xx, yy, zz, xy, xz, yz) = (x * x, y * y, z * z, x * y, x * z, y * z);
        let U = Matrix3([
            [-(yy + zz), xy - dz, xz + dy],
            [xy + dz, -(xx + zz), yz - dx],
            [xz - dy, yz + dx, -(xx + yy)],
        ]);
        Self { w, wd, U, a }
    }
}

/// Accelerations of all links, for speeds `qd` and accelerations `qdd` of the columns.
pub fn accelerations<S: Scalar>(
    tree: &NormalTree<S>,
    joints: &[PlacedJoint<S>],
    qd: &[S],
    qdd: &[S],
) -> Vec<LinkAcceleration<S>> {
    let base = LinkAcceleration::of_base(tree.gravity);
    let (speeds, rates) = (tree.joint_motions(qd), tree.joint_motions(qdd));
    let mut links: Vec<LinkAcceleration<S>> = Vec::with_capacity(tree.links.len());
    for (k, (link, joint)) in tree.links.iter().zip(joints).enumerate() {
        let parent = link.parent.map_or(&base, |p| &links[p]);
        let a = joint.down(parent.a + parent.U * joint.position);
        let (speed, rate) = (speeds[k], rates[k]);
        let next = match joint.motion {
            Motion::Revolute => revolute(parent, joint, speed.angular.0[2], rate.angular.0[2], a),
            Motion::Prismatic => prismatic(parent, joint, speed.linear.0[2], rate.linear.0[2], a),
            Motion::Ball | Motion::Free => free(parent, joint, speed, rate, a),
        };
        links.push(next);
    }
    links
}

/// The motion of each link's parent in the link's own frame, at its origin: what carries the joint along. Of one
/// degree of freedom the link's own serves as well, for its joint's part commutes with itself.
pub fn carriers<S: Scalar>(
    tree: &NormalTree<S>,
    joints: &[PlacedJoint<S>],
    links: &[LinkAcceleration<S>],
) -> Vec<LinkAcceleration<S>> {
    let base = LinkAcceleration::of_base(tree.gravity);
    let carrier = |(k, joint): (usize, &PlacedJoint<S>)| {
        if matches!(joint.motion, Motion::Revolute | Motion::Prismatic) {
            return links[k];
        }
        let parent = tree.links[k].parent.map_or(&base, |p| &links[p]);
        let a = joint.down(parent.a + parent.U * joint.position);
        LinkAcceleration::from_rates(joint.down(parent.w), joint.down(parent.wd), a)
    };
    joints.iter().enumerate().map(carrier).collect()
}

/// A ball joint, or one that does not hold: `speed` and `rate` are of the link against its parent, in its own axes.
fn free<S: Scalar>(
    parent: &LinkAcceleration<S>,
    joint: &PlacedJoint<S>,
    speed: Twist<S>,
    rate: Twist<S>,
    a: Vector3<S>,
) -> LinkAcceleration<S> {
    let carried = joint.down(parent.w);
    let w = carried + speed.angular;
    let wd = joint.down(parent.wd) + carried.cross(speed.angular) + rate.angular;
    // Half of Coriolis' term comes of the turning axes in which the speed is written.
    let a = a + (carried + w).cross(speed.linear) + rate.linear;
    LinkAcceleration::from_rates(w, wd, a)
}

fn revolute<S: Scalar>(
    parent: &LinkAcceleration<S>,
    joint: &PlacedJoint<S>,
    qd: S,
    qdd: S,
    a: Vector3<S>,
) -> LinkAcceleration<S> {
    let [wx, wy, wz] = joint.down(parent.w).0;
    let w = Vector3::new(wx, wy, wz + qd);
    if joint.axis_is_a_parent_axis() && !parent.U.row(0).is_zero() {
        return with_column_from_parent(parent, joint, w, qdd, a);
    }
    let wd = joint.down(parent.wd) + Vector3::new(wy * qd, -(wx * qd), qdd);
    LinkAcceleration::from_rates(w, wd, a)
}

/// `U e_z` of the link is `U z` of the parent turned downwards, since the axis is fixed in both.
fn with_column_from_parent<S: Scalar>(
    parent: &LinkAcceleration<S>,
    joint: &PlacedJoint<S>,
    w: Vector3<S>,
    qdd: S,
    a: Vector3<S>,
) -> LinkAcceleration<S> {
    let [x, y, z] = w.0;
    let [u02, u12, u22] = joint.down(parent.U * joint.axis).0;
    let (xx, zz, xy, xz, yz) = (x * x, z * z, x * y, x * z, y * z);
    let dz = joint.axis.dot(parent.wd) + qdd;
    let U = Matrix3([
        [u22 - zz + xx, xy - dz, u02],
        [xy + dz, -(xx + zz), u12],
        [xz.twice() - u02, yz.twice() - u12, u22],
    ]);
    LinkAcceleration { w, wd: Vector3::new(yz - u12, u02 - xz, dz), U, a }
}

fn prismatic<S: Scalar>(
    parent: &LinkAcceleration<S>,
    joint: &PlacedJoint<S>,
    qd: S,
    qdd: S,
    a: Vector3<S>,
) -> LinkAcceleration<S> {
    let w = joint.down(parent.w);
    let wd = joint.down(parent.wd);
    let sliding = w.cross(Vector3::unit_z().scale(qd)).scale(S::from(2)) + Vector3::unit_z().scale(qdd);
    let a = a + sliding;
    if joint.permutes_axes() {
        let R = joint.rotation();
        return LinkAcceleration { w, wd, U: R.transpose() * parent.U * R, a };
    }
    LinkAcceleration::from_rates(w, wd, a)
}

/// The velocity of a link.
#[derive(Clone, Copy, Debug)]
pub struct LinkVelocity<S> {
    /// Angular velocity, rad/s.
    pub w: Vector3<S>,
    /// Velocity of the origin, m/s.
    pub v: Vector3<S>,
}

impl<S: Scalar> LinkVelocity<S> {
    /// At rest.
    fn zero() -> Self {
        Self { w: Vector3::zero(), v: Vector3::zero() }
    }

    /// As a twist.
    pub fn twist(self) -> Twist<S> {
        Twist { angular: self.w, linear: self.v }
    }

    /// In the frame of the link beyond the joint, without the joint's own.
    fn down(self, joint: &PlacedJoint<S>) -> Self {
        Self { w: joint.down(self.w), v: joint.down(self.v + self.w.cross(joint.position)) }
    }
}

impl<S: Scalar> Add for LinkVelocity<S> {
    type Output = Self;

    fn add(self, rhs: Self) -> Self {
        Self { w: self.w + rhs.w, v: self.v + rhs.v }
    }
}

/// Velocities of all links, for speeds `qd` of the columns.
pub fn velocities<S: Scalar>(
    tree: &NormalTree<S>,
    joints: &[PlacedJoint<S>],
    qd: &[S],
) -> Vec<LinkVelocity<S>> {
    let speeds = tree.joint_motions(qd);
    let mut links: Vec<LinkVelocity<S>> = Vec::with_capacity(tree.links.len());
    for (k, (link, joint)) in tree.links.iter().zip(joints).enumerate() {
        let carried = link.parent.map_or(LinkVelocity::zero(), |p| links[p]).down(joint);
        let Twist { angular, linear } = speeds[k];
        links.push(LinkVelocity { w: carried.w + angular, v: carried.v + linear });
    }
    links
}

/// The velocity of each link's parent in the link's own frame, at its origin; of one degree of freedom the link's
/// own, as of [`carriers`].
pub fn carrier_velocities<S: Scalar>(
    tree: &NormalTree<S>,
    joints: &[PlacedJoint<S>],
    links: &[LinkVelocity<S>],
) -> Vec<LinkVelocity<S>> {
    let carrier = |(k, joint): (usize, &PlacedJoint<S>)| match joint.motion {
        Motion::Revolute | Motion::Prismatic => links[k],
        Motion::Ball | Motion::Free => {
            tree.links[k].parent.map_or(LinkVelocity::zero(), |p| links[p]).down(joint)
        }
    };
    joints.iter().enumerate().map(carrier).collect()
}
