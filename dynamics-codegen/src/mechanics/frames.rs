//! Forward kinematics: poses, Jacobians and motions of frames.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::columns::Direction;
use super::motion::{LinkAcceleration, LinkVelocity, accelerations, velocities};
use super::normal::{NormalFrame, NormalTree, PlacedJoint};
use crate::spatial::{Matrix3, Pose, Scalar, Vector3};

/// The pose of a frame in the world.
pub fn pose<S: Scalar>(tree: &NormalTree<S>, frame: &NormalFrame<S>, q: &[S]) -> Pose<S> {
    match frame.link {
        None => frame.pose,
        Some(link) => link_pose(tree, &tree.place(q), link) * frame.pose,
    }
}

fn link_pose<S: Scalar>(tree: &NormalTree<S>, joints: &[PlacedJoint<S>], link: usize) -> Pose<S> {
    let mut path: Vec<usize> = tree.path_to_base(link).collect();
    path.reverse();
    path.into_iter().fold(tree.base, |parent, k| beyond(parent, &joints[k]))
}

/// The poses of all links in the world.
pub fn link_poses<S: Scalar>(tree: &NormalTree<S>, joints: &[PlacedJoint<S>]) -> Vec<Pose<S>> {
    let mut poses: Vec<Pose<S>> = Vec::with_capacity(joints.len());
    for (link, joint) in tree.links.iter().zip(joints) {
        poses.push(beyond(link.parent.map_or(tree.base, |parent| poses[parent]), joint));
    }
    poses
}

fn beyond<S: Scalar>(parent: Pose<S>, joint: &PlacedJoint<S>) -> Pose<S> {
    Pose {
        translation: parent.transform_point(joint.position),
        // R·R_joint by rows: each row of R is a vector in the parent's axes.
        rotation: Matrix3(parent.rotation.0.map(|row| joint.down(Vector3(row)).0)),
    }
}

/// Whose axes a Jacobian is written in; its point is the origin of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// The frame's own: the body Jacobian.
    Body,
    /// The world's.
    World,
}

/// The 6×n Jacobian of a frame for the columns, linear rows first, by rows.
pub fn jacobian<S: Scalar>(tree: &NormalTree<S>, frame: &NormalFrame<S>, q: &[S], axes: Axes) -> Vec<Vec<S>> {
    let mut J = vec![vec![S::zero(); tree.columns.len()]; 6];
    let Some(link) = frame.link else { return J };
    let joints = tree.place(q);
    // `R_kE`, from the axes of the answer to link k's, and the frame's origin in link k.
    let mut turned = frame.pose.rotation;
    let mut origin = frame.pose.translation;
    for k in tree.path_to_base(link) {
        let rotation = match axes {
            Axes::Body => turned,
            Axes::World => link_pose(tree, &joints, k).rotation.transpose(),
        };
        for c in tree.columns_of(k) {
            let (linear, angular) = seen_from(tree.columns[c].direction, rotation, origin);
            for (row, entry) in J.iter_mut().zip(linear.0.into_iter().chain(angular.0)) {
                row[c] = entry;
            }
        }
        if tree.links[k].parent.is_some() {
            origin = joints[k].position + joints[k].up(origin);
            turned = Matrix3(turned.transpose().0.map(|column| joints[k].up(Vector3(column)).0)).transpose();
        }
    }
    J
}

/// The linear and the angular velocity at `origin` of a unit motion, in the axes that `rotation` takes to the link's.
fn seen_from<S: Scalar>(
    direction: Direction,
    rotation: Matrix3<S>,
    origin: Vector3<S>,
) -> (Vector3<S>, Vector3<S>) {
    match direction {
        Direction::Along(k) => (rotation.row(k), Vector3::zero()),
        Direction::About(k) => {
            let (next, last) = ((k + 1) % 3, (k + 2) % 3);
            let linear = rotation.row(last).scale(origin.0[next]) - rotation.row(next).scale(origin.0[last]);
            (linear, rotation.row(k))
        }
    }
}

/// How all links move, as if there were no gravity.
#[derive(Clone)]
pub struct LinkMotions<S> {
    velocity: Vec<LinkVelocity<S>>,
    acceleration: Vec<LinkAcceleration<S>>,
}

impl<S: Scalar> LinkMotions<S> {
    /// At speeds `qd` and accelerations `qdd` of the columns.
    pub fn of(tree: &NormalTree<S>, q: &[S], qd: &[S], qdd: &[S]) -> Self {
        let weightless = NormalTree { gravity: Vector3::zero(), ..tree.clone() };
        let joints = weightless.place(q);
        Self {
            velocity: velocities(&weightless, &joints, qd),
            acceleration: accelerations(&weightless, &joints, qd, qdd),
        }
    }

    /// The twist `J·v` of a frame in its own axes, linear first.
    pub fn twist(&self, frame: &NormalFrame<S>) -> [S; 6] {
        let Some(link) = frame.link else { return [S::zero(); 6] };
        let LinkVelocity { w, v } = self.velocity[link];
        in_frame(frame, v + w.cross(frame.pose.translation), w)
    }

    /// The rate `J·a + J̇·v` of that twist.
    pub fn twist_rate(&self, frame: &NormalFrame<S>) -> [S; 6] {
        let Some(link) = frame.link else { return [S::zero(); 6] };
        let (LinkVelocity { w, v }, p) = (self.velocity[link], frame.pose.translation);
        let LinkAcceleration { U, wd, a, .. } = self.acceleration[link];
        // The origin's acceleration, less what comes of the turning axes.
        in_frame(frame, a + U * p - w.cross(v + w.cross(p)), wd)
    }
}

/// A pair of vectors of a link in the axes of a frame on it.
fn in_frame<S: Scalar>(frame: &NormalFrame<S>, linear: Vector3<S>, angular: Vector3<S>) -> [S; 6] {
    let R = frame.pose.rotation.transpose();
    let ([x, y, z], [i, j, k]) = ((R * linear).0, (R * angular).0);
    [x, y, z, i, j, k]
}
