//! Where links and frames are, and how they move.
//!
//! R. Murray, Z. Li, S. Sastry, *A Mathematical Introduction to Robotic Manipulation*, CRC 1994, ch. 2–3.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::six::{Matrix6, Six};
use crate::model::{Frame, Link, Motion, Tree};
use crate::spatial::{Matrix3, Pose, Scalar, Vector3};

/// `X_PB(q)`: the pose of a link in its parent.
pub(in crate::mechanics) fn pose_in_parent<S: Scalar>(link: &Link<S>, q: &[S]) -> Pose<S> {
    let at = link.drive.q;
    let coordinate = || link.drive.ratio * q[at] + link.drive.offset;
    let turned = |at: usize| Pose::rotation(Matrix3::of_quaternion([q[at], q[at + 1], q[at + 2], q[at + 3]]));
    let X_JB = match link.motion {
        Motion::Revolute => Pose::rotation(Matrix3::rotation_z(coordinate().cos(), coordinate().sin())),
        Motion::Prismatic => Pose::translation(Vector3::unit_z().scale(coordinate())),
        Motion::Ball => turned(at),
        Motion::Free => Pose::translation(Vector3([q[at], q[at + 1], q[at + 2]])) * turned(at + 3),
    };
    link.placement * X_JB
}

/// `S_B` by columns: for each speed of the joint, which of the robot's it is, and the motion of the link against its
/// parent, in the link's frame, while that one is one.
pub(in crate::mechanics) fn motion_subspace<S: Scalar>(link: &Link<S>) -> Vec<(usize, Six<S>)> {
    let unit = |k: usize| {
        let mut unit = Six::zero();
        unit.0[k] = link.drive.ratio;
        unit
    };
    let components = match link.motion {
        Motion::Revolute => 5..6,
        Motion::Prismatic => 2..3,
        Motion::Ball => 3..6,
        Motion::Free => 0..6,
    };
    components.enumerate().map(|(k, component)| (link.drive.v + k, unit(component))).collect()
}

/// `S_B v`: the motion of a link against its parent at the speeds `v`; of accelerations, what they add.
pub(super) fn joint_motion<S: Scalar>(link: &Link<S>, v: &[S]) -> Six<S> {
    motion_subspace(link).into_iter().fold(Six::zero(), |sum, (k, S_B)| sum + S_B.scale(v[k]))
}

/// `X_PB(q)` of every link.
pub(super) fn poses_in_parents<S: Scalar>(tree: &Tree<S>, q: &[S]) -> Vec<Pose<S>> {
    tree.links.iter().map(|link| pose_in_parent(link, q)).collect()
}

/// `X_WB` of every link.
pub fn link_poses<S: Scalar>(tree: &Tree<S>, q: &[S]) -> Vec<Pose<S>> {
    poses_from(Pose::identity(), &tree.links, q)
}

/// `X_AB` of every link, in axes A parallel to the world's whose origin is that of the first link. Where the robot as a whole is
/// takes no digits from where its links are against each other.
pub(super) fn link_poses_by_first<S: Scalar>(tree: &Tree<S>, q: &[S]) -> Vec<Pose<S>> {
    let Some(first) = tree.links.first() else { return Vec::new() };
    let mut links = tree.links.clone();
    for link in links.iter_mut().filter(|link| link.parent.is_none()) {
        link.placement.translation = link.placement.translation - first.placement.translation;
    }
    let moved = pose_in_parent(&links[0], q).translation;
    poses_from(Pose::translation(-moved), &links, q)
}

/// `X_AB` of every link, with the world at `X_AW`.
fn poses_from<S: Scalar>(X_AW: Pose<S>, links: &[Link<S>], q: &[S]) -> Vec<Pose<S>> {
    let mut poses: Vec<Pose<S>> = Vec::with_capacity(links.len());
    for link in links {
        let X_AP = link.parent.map_or(X_AW, |parent| poses[parent]);
        poses.push(X_AP * pose_in_parent(link, q));
    }
    poses
}

/// `V_B` of every link, measured in the world and written in the link's frame.
pub fn link_velocities<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S]) -> Vec<Six<S>> {
    let mut velocities: Vec<Six<S>> = Vec::with_capacity(tree.links.len());
    for link in &tree.links {
        let V_P = link.parent.map_or_else(Six::zero, |parent| velocities[parent]);
        let X_BP = pose_in_parent(link, q).inverse();
        velocities.push(Matrix6::adjoint(X_BP) * V_P + joint_motion(link, v));
    }
    velocities
}

/// `X_WF`: the pose of a frame in the world.
pub fn pose<S: Scalar>(tree: &Tree<S>, frame: &Frame<S>, q: &[S]) -> Pose<S> {
    link_pose(&link_poses(tree, q), frame.link) * frame.pose
}

/// The Jacobian of a frame, 6×n, linear rows first: its velocity against the world, in its own axes.
pub fn body_jacobian<S: Scalar>(tree: &Tree<S>, frame: &Frame<S>, q: &[S]) -> Vec<Vec<S>> {
    rows_of(&jacobian_columns(tree, &poses_in_parents(tree, q), frame.link, frame.pose.inverse()))
}

/// The Jacobian of a frame, 6×n, linear rows first: its velocity against the world, in axes parallel to the
/// world's. The linear part is that of the frame's own origin.
pub fn world_jacobian<S: Scalar>(tree: &Tree<S>, frame: &Frame<S>, q: &[S]) -> Vec<Vec<S>> {
    // From the link to the frame's origin, in its axes, and into those of the world.
    let R_WB = Pose::rotation(link_pose(&link_poses(tree, q), frame.link).rotation);
    let X_EB = R_WB * Pose::translation(-frame.pose.translation);
    rows_of(&jacobian_columns(tree, &poses_in_parents(tree, q), frame.link, X_EB))
}

/// The columns `Ad(X_EB) S_B` of all joints between `carrier` and the world, added where joints share a speed, and zero
/// for the others. The way is from link to link, by their `poses` in their parents, and not by the world, where digits are
/// lost that grow with the distance from it.
pub(super) fn jacobian_columns<S: Scalar>(
    tree: &Tree<S>,
    poses: &[Pose<S>],
    carrier: Option<usize>,
    mut X_EB: Pose<S>,
) -> Vec<Six<S>> {
    let mut columns = vec![Six::zero(); tree.dof()];
    let mut link = carrier;
    while let Some(k) = link {
        for (speed, S_B) in motion_subspace(&tree.links[k]) {
            columns[speed] = columns[speed] + Matrix6::adjoint(X_EB) * S_B;
        }
        X_EB = X_EB * poses[k].inverse();
        link = tree.links[k].parent;
    }
    columns
}

fn link_pose<S: Scalar>(poses: &[Pose<S>], link: Option<usize>) -> Pose<S> {
    link.map_or_else(Pose::identity, |k| poses[k])
}

fn rows_of<S: Scalar>(columns: &[Six<S>]) -> Vec<Vec<S>> {
    (0..6).map(|row| columns.iter().map(|column| column.0[row]).collect()).collect()
}
