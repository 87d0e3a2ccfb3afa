//! The robot as a whole: its centre of mass, and its momentum about it.
//!
//! Of all that moves; mass at rest in the world does not count. On masses as they are: what is regrouped towards the
//! base moves otherwise.
//!
//! D. Orin, A. Goswami, S.-H. Lee, *Centroidal dynamics of a humanoid robot*, 2013.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::composite::{Square, composite_inertias, wrench_of};
use super::frames::link_poses;
use super::motion::velocities;
use super::normal::NormalTree;
use super::rnea::{Wrench, collect_tip_to_base};
use crate::spatial::{Pose, Scalar, Vector3};

/// The mass of all that moves, kg.
pub fn total_mass<S: Scalar>(tree: &NormalTree<S>) -> S {
    tree.links.iter().fold(S::zero(), |sum, link| sum + link.inertia.mass)
}

/// The centre of mass in the world, m; the world's origin if there is no mass.
pub fn center_of_mass<S: Scalar>(tree: &NormalTree<S>, q: &[S]) -> Vector3<S> {
    center(tree, &link_poses(tree, &tree.place(q)))
}

fn center<S: Scalar>(tree: &NormalTree<S>, poses: &[Pose<S>]) -> Vector3<S> {
    let moments =
        tree.links.iter().zip(poses).map(|(link, pose)| {
            pose.rotation * link.inertia.first + pose.translation.scale(link.inertia.mass)
        });
    let first = moments.fold(Vector3::zero(), |sum, moment| sum + moment);
    per_mass(tree, first)
}

fn per_mass<S: Scalar>(tree: &NormalTree<S>, moment: Vector3<S>) -> Vector3<S> {
    let mass = total_mass(tree);
    if mass.is_zero() { Vector3::zero() } else { moment.scale(S::one() / mass) }
}

/// The Jacobian of the centre of mass for the columns, 3×n, by rows.
pub fn center_of_mass_jacobian<S: Scalar>(tree: &NormalTree<S>, q: &[S]) -> Square<S> {
    let momenta = column_momenta(tree, q).into_iter().map(|momentum| per_mass(tree, momentum.F));
    rows(momenta.map(|linear| linear.0.to_vec()).collect(), 3)
}

/// The momentum at the speeds `qd` of the columns: linear, then angular about the centre of mass, in world axes.
pub fn centroidal_momentum<S: Scalar>(tree: &NormalTree<S>, q: &[S], qd: &[S]) -> [S; 6] {
    let joints = tree.place(q);
    let velocity = velocities(tree, &joints, qd);
    let momenta = tree.links.iter().zip(velocity).map(|(link, v)| wrench_of(&link.inertia, v.twist()));
    let collected = collect_tip_to_base(tree, &joints, momenta.collect());
    let poses = poses_by_first(tree, q);
    let center = center(tree, &poses);
    let roots = tree.links.iter().enumerate().filter(|(_, link)| link.parent.is_none());
    let total = roots.fold(Wrench::zero(), |sum, (k, _)| sum + about(collected[k], poses[k], center));
    six(total)
}

/// The matrix that takes the speeds of the columns to that momentum, 6×n, by rows.
pub fn centroidal_momentum_matrix<S: Scalar>(tree: &NormalTree<S>, q: &[S]) -> Square<S> {
    rows(column_momenta(tree, q).into_iter().map(|momentum| six(momentum).to_vec()).collect(), 6)
}

/// The momentum of all that moves at each column's unit speed, about the centre of mass.
fn column_momenta<S: Scalar>(tree: &NormalTree<S>, q: &[S]) -> Vec<Wrench<S>> {
    let joints = tree.place(q);
    let (composites, poses) = (composite_inertias(tree, &joints), poses_by_first(tree, q));
    let center = center(tree, &poses);
    let momentum = |link: usize, twist| about(wrench_of(&composites[link], twist), poses[link], center);
    tree.columns.iter().map(|column| momentum(column.link, column.direction.twist())).collect()
}

/// The poses of all links at `q` in axes parallel to the world's whose origin is that of the first link. Where the robot as a
/// whole is takes no digits from where its links are against each other.
fn poses_by_first<S: Scalar>(tree: &NormalTree<S>, q: &[S]) -> Vec<Pose<S>> {
    let mut tree = NormalTree { base: Pose::rotation(tree.base.rotation), ..tree.clone() };
    let start = tree.links.first().map_or(Vector3::zero(), |link| link.position);
    for link in tree.links.iter_mut().filter(|link| link.parent.is_none()) {
        link.position = link.position - start;
    }
    let mut joints = tree.place(q);
    let moved = joints.first().map_or(Vector3::zero(), |joint| joint.position);
    for (_, joint) in tree.links.iter().zip(&mut joints).filter(|(link, _)| link.parent.is_none()) {
        joint.position = joint.position - moved;
    }
    link_poses(&tree, &joints)
}

/// A wrench, or a momentum, of a link about a point, in world axes.
fn about<S: Scalar>(wrench: Wrench<S>, pose: Pose<S>, point: Vector3<S>) -> Wrench<S> {
    let F = pose.rotation * wrench.F;
    Wrench { F, N: pose.rotation * wrench.N + (pose.translation - point).cross(F) }
}

fn six<S: Scalar>(momentum: Wrench<S>) -> [S; 6] {
    let ([x, y, z], [i, j, k]) = (momentum.F.0, momentum.N.0);
    [x, y, z, i, j, k]
}

fn rows<S: Scalar>(columns: Vec<Vec<S>>, height: usize) -> Square<S> {
    (0..height).map(|row| columns.iter().map(|column| column[row]).collect()).collect()
}
