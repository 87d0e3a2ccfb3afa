//! Where links and frames are, and how they move.
//!
//! R. Murray, Z. Li, S. Sastry, *A Mathematical Introduction to Robotic Manipulation*, CRC 1994, ch. 2–3.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::six::{Matrix6, Six};
use crate::model::{Frame, Link, Motion, Tree};
use crate::spatial::{Matrix3, Pose, Scalar, Vector3};

/// `X_PB(q)`: the pose of a link in its parent.
pub(super) fn pose_in_parent<S: Scalar>(link: &Link<S>, q: S) -> Pose<S> {
    let X_JB = match link.motion {
        Motion::Revolute => Pose::rotation(Matrix3::rotation_z(q.cos(), q.sin())),
        Motion::Prismatic => Pose::translation(Vector3::unit_z().scale(q)),
    };
    link.placement * X_JB
}

/// `S_B`: the motion of a link against its parent at unit speed, in the link's frame.
pub(super) fn motion_subspace<S: Scalar>(motion: Motion) -> Six<S> {
    match motion {
        Motion::Revolute => Six::new(Vector3::zero(), Vector3::unit_z()),
        Motion::Prismatic => Six::new(Vector3::unit_z(), Vector3::zero()),
    }
}

/// `X_WB` of every link.
pub fn link_poses<S: Scalar>(tree: &Tree<S>, q: &[S]) -> Vec<Pose<S>> {
    let mut poses: Vec<Pose<S>> = Vec::with_capacity(tree.dof());
    for (link, &q) in tree.links.iter().zip(q) {
        let X_WP = link.parent.map_or_else(Pose::identity, |parent| poses[parent]);
        poses.push(X_WP * pose_in_parent(link, q));
    }
    poses
}

/// `V_B` of every link, measured in the world and written in the link's frame.
pub fn link_velocities<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S]) -> Vec<Six<S>> {
    let mut velocities: Vec<Six<S>> = Vec::with_capacity(tree.dof());
    for (link, (&q, &v)) in tree.links.iter().zip(q.iter().zip(v)) {
        let V_P = link.parent.map_or_else(Six::zero, |parent| velocities[parent]);
        let X_BP = pose_in_parent(link, q).inverse();
        velocities.push(Matrix6::adjoint(X_BP) * V_P + motion_subspace(link.motion).scale(v));
    }
    velocities
}

/// `X_WF`: the pose of a frame in the world.
pub fn pose<S: Scalar>(tree: &Tree<S>, frame: &Frame<S>, q: &[S]) -> Pose<S> {
    link_pose(&link_poses(tree, q), frame.link) * frame.pose
}

/// The Jacobian of a frame, 6×n, linear rows first: its velocity against the world, in its own axes.
pub fn body_jacobian<S: Scalar>(tree: &Tree<S>, frame: &Frame<S>, q: &[S]) -> Vec<Vec<S>> {
    let poses = link_poses(tree, q);
    let X_FW = (link_pose(&poses, frame.link) * frame.pose).inverse();
    rows_of(&jacobian_columns(tree, &poses, frame.link, X_FW))
}

/// The Jacobian of a frame, 6×n, linear rows first: its velocity against the world, in axes parallel to the
/// world's. The linear part is that of the frame's own origin.
pub fn world_jacobian<S: Scalar>(tree: &Tree<S>, frame: &Frame<S>, q: &[S]) -> Vec<Vec<S>> {
    let poses = link_poses(tree, q);
    let p_WF = (link_pose(&poses, frame.link) * frame.pose).translation;
    rows_of(&jacobian_columns(tree, &poses, frame.link, Pose::translation(-p_WF)))
}

/// The columns `Ad(X_EW X_WB) S_B` of all joints between `carrier` and the world, and zero for the others.
pub(super) fn jacobian_columns<S: Scalar>(
    tree: &Tree<S>,
    poses: &[Pose<S>],
    carrier: Option<usize>,
    X_EW: Pose<S>,
) -> Vec<Six<S>> {
    let mut columns = vec![Six::zero(); tree.dof()];
    let mut link = carrier;
    while let Some(k) = link {
        columns[k] = Matrix6::adjoint(X_EW * poses[k]) * motion_subspace(tree.links[k].motion);
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
