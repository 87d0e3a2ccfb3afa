//! The Coriolis matrix by polarisation of the bias forces.
//!
//! Between joints of one degree of freedom the bias without gravity is a quadratic form of the speeds,
//! `h_i(v) = Σ Γ_ijk v_j v_k`, with the Christoffel symbols of the first kind, symmetric in j and k. The bilinear
//! form B that belongs to it is `B(v,w) = ½(h(v + w) − h(v) − h(w))`, exactly and not as a difference quotient;
//! and `C_ij = Σ Γ_ijk v_k = B(v, e_j)_i`. So C is Christoffel's, and no formula for C is assumed.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::rnea::inertial_forces;
use crate::model::Tree;
use crate::spatial::Scalar;

/// `C(q,v)`, n×n, of Christoffel symbols: `Ṁ = C + Cᵀ`.
pub fn coriolis_matrix<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S]) -> Vec<Vec<S>> {
    let n = tree.dof();
    let half = S::one() / S::from(2);
    let rest = vec![S::zero(); n];
    let h = |v: &[S]| inertial_forces(tree, q, v, &rest);

    let h_v = h(v);
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
    }
    C
}
