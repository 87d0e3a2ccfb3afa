//! The Coriolis matrix by polarisation of the bias forces.
//!
//! The bias without gravity is a quadratic form of the speeds, `h(v) = Σ v_j v_k ∇_k E_j`, in the fields `E_j` of
//! unit speeds. The bilinear form B that belongs to it is `B(v,w) = ½(h(v + w) − h(v) − h(w))`, exactly and not as a
//! difference quotient; it is the symmetric part of the connection. That of Levi-Civita has no torsion,
//! `∇_v E_j − ∇_j v = [v, E_j]`, so `C e_j = B(v, e_j) + ½ M [v, e_j]`: between joints of one degree of freedom the
//! bracket vanishes, and C is Christoffel's; in a ball or a free joint it is that of the joint's group. No formula
//! for C is assumed.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::mass_matrix;
use super::rnea::Placed;
use super::six::{Matrix6, Six};
use crate::model::{Motion, Tree};
use crate::spatial::{Scalar, Vector3};

/// `C(q,v)`, n×n, of Levi-Civita: `Ṁ = C + Cᵀ`.
pub fn coriolis_matrix<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S]) -> Vec<Vec<S>> {
    let n = tree.dof();
    let half = S::one() / S::from(2);
    let rest = vec![S::zero(); n];
    let placed = Placed::at(tree, q);
    let h = |v: &[S]| placed.inertial_forces(v, &rest);

    let h_v = h(v);
    let M = if tree.is_one_dof() { vec![] } else { mass_matrix(tree, q) };
    let mut C = vec![vec![S::zero(); n]; n];
    for j in 0..n {
        let mut unit = rest.clone();
        unit[j] = S::one();
        let mut moved = v.to_vec();
        moved[j] = moved[j] + S::one();
        let (h_unit, h_moved) = (h(&unit), h(&moved));
        for i in 0..n {
            C[i][j] = (h_moved[i] - h_v[i] - h_unit[i]) * half;
        }
        for (row, M_row) in C.iter_mut().zip(&M) {
            let torsion =
                M_row.iter().zip(bracket(tree, v, &unit)).fold(S::zero(), |sum, (&m, b)| sum + m * b);
            row[j] = row[j] + torsion * half;
        }
    }
    C
}

/// `[v, w]` of speeds: that of the rotations of a ball joint, of the motions of a free one, and zero otherwise.
pub fn bracket<S: Scalar>(tree: &Tree<S>, v: &[S], w: &[S]) -> Vec<S> {
    let mut bracket = vec![S::zero(); tree.dof()];
    let three = |x: &[S], at: usize| Vector3([x[at], x[at + 1], x[at + 2]]);
    for link in &tree.links {
        let at = link.drive.v;
        match link.motion {
            Motion::Revolute | Motion::Prismatic => {}
            Motion::Ball => {
                bracket[at..at + 3].copy_from_slice(&three(v, at).cross(three(w, at)).0);
            }
            Motion::Free => {
                let [v, w] = [v, w].map(|x| Six::new(three(x, at), three(x, at + 3)));
                bracket[at..at + 6].copy_from_slice(&(Matrix6::cross(v) * w).0);
            }
        }
    }
    bracket
}
