//! Forward kinematics: poses and Jacobians of frames.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::normal::{NormalFrame, NormalTree, PlacedJoint};
use crate::model::Motion;
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
    path.into_iter().fold(tree.base, |parent, k| Pose {
        translation: parent.transform_point(joints[k].position),
        // R·R_joint by rows: each row of R is a vector in the parent's axes.
        rotation: Matrix3(parent.rotation.0.map(|row| joints[k].down(Vector3(row)).0)),
    })
}

/// Whose axes a Jacobian is written in; its point is the origin of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// The frame's own: the body Jacobian.
    Body,
    /// The world's.
    World,
}

/// The 6×n Jacobian of a frame, linear rows first, by rows.
pub fn jacobian<S: Scalar>(tree: &NormalTree<S>, frame: &NormalFrame<S>, q: &[S], axes: Axes) -> Vec<Vec<S>> {
    let mut J = vec![vec![S::zero(); tree.dof()]; 6];
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
        let [x, y, _] = origin.0;
        let axis = rotation.row(2);
        let (linear, angular) = match joints[k].motion {
            Motion::Revolute => (rotation.row(1).scale(x) - rotation.row(0).scale(y), axis),
            Motion::Prismatic => (axis, Vector3::zero()),
        };
        for (row, entry) in J.iter_mut().zip(linear.0.into_iter().chain(angular.0)) {
            row[k] = entry;
        }
        if tree.links[k].parent.is_some() {
            origin = joints[k].position + joints[k].up(origin);
            turned = Matrix3(turned.transpose().0.map(|column| joints[k].up(Vector3(column)).0)).transpose();
        }
    }
    J
}
