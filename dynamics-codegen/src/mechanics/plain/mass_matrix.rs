//! The mass matrix by its definition: the inertia of every link, seen through the link's Jacobian.
//!
//! Not the composite-rigid-body algorithm, which the specialised recursions use, and not columns of inverse
//! dynamics, with which it can then be compared.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::kinematics::{jacobian_columns, poses_in_parents};
use super::passive;
use super::six::{Matrix6, Six};
use super::terms;
use crate::model::Tree;
use crate::spatial::{Pose, Scalar};

/// `M(q) = Σ J_Bᵀ M_B J_B` over all links, the rotors, and terms, n×n, both halves.
pub fn mass_matrix<S: Scalar>(tree: &Tree<S>, q: &[S]) -> Vec<Vec<S>> {
    let poses = poses_in_parents(tree, q);
    let mut M = vec![vec![S::zero(); tree.dof()]; tree.dof()];
    for (k, link) in tree.links.iter().enumerate() {
        let M_B = Matrix6::inertia(&link.inertia);
        let columns = jacobian_columns(tree, &poses, Some(k), Pose::identity());
        // Of the other joints the link feels nothing.
        let J_B: Vec<(usize, Six<S>)> =
            columns.into_iter().enumerate().filter(|(_, column)| !column.is_zero()).collect();
        for &(j, column) in &J_B {
            let momentum = M_B * column;
            for &(i, other) in &J_B {
                M[i][j] = M[i][j] + other.dot(momentum);
            }
        }
    }
    for (row, added) in M.iter_mut().zip(terms::mass_matrix(tree, q)) {
        row.iter_mut().zip(added).for_each(|(entry, added)| *entry = *entry + added);
    }
    for (link, k) in passive::one_dof(tree) {
        M[k][k] = M[k][k] + passive::reflected(link);
    }
    M
}
