//! The hidden solver against nalgebra, on a chain and on a branched tree.
#![cfg(feature = "std")]

use dynamics_core::__private::solve::{factor, solve_columns};
use dynamics_core::__private::{forward_from_inverse, inverse_of};
use dynamics_core::InverseDynamicsDerivatives;
use dynamics_core::nalgebra::SMatrix;

/// A few roundings of numbers of the size of one, times a condition of some hundred.
const TOLERANCE: f64 = 1e-12;

const CHAIN: [&[usize]; 5] = [&[], &[0], &[0, 1], &[0, 1, 2], &[0, 1, 2, 3]];
const TREE: [&[usize]; 7] = [&[], &[0], &[1, 0], &[0], &[3, 0], &[4, 3, 0], &[3, 0]];

fn random_numbers(mut seed: u64) -> impl FnMut() -> f64 {
    move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
    }
}

/// A positive definite matrix with the sparsity of a tree: `Lᵀ D L`.
fn mass_matrix<const N: usize>(
    ancestors: &[&[usize]; N],
    random: &mut impl FnMut() -> f64,
) -> SMatrix<f64, N, N> {
    let mut l = SMatrix::<f64, N, N>::identity();
    let mut d = SMatrix::<f64, N, N>::zeros();
    for (i, ancestors) in ancestors.iter().enumerate() {
        d[(i, i)] = random() + 1.0;
        for &j in *ancestors {
            l[(i, j)] = random();
        }
    }
    l.transpose() * d * l
}

fn agrees<const N: usize>(ancestors: &[&[usize]; N]) {
    let mut random = random_numbers(N as u64);
    let m = mass_matrix(ancestors, &mut random);
    let mut matrix = || SMatrix::<f64, N, N>::from_fn(|_, _| random());
    let inverse = InverseDynamicsDerivatives { dtau_dq: matrix(), dtau_dv: matrix(), dtau_da: m };
    let forward = forward_from_inverse(ancestors, inverse_of(ancestors, &m), &inverse);
    assert!((m * forward.da_dq + inverse.dtau_dq).amax() < TOLERANCE);
    assert!((m * forward.da_dv + inverse.dtau_dv).amax() < TOLERANCE);
    assert!((m * forward.da_dtau - SMatrix::identity()).amax() < TOLERANCE);
}

#[test]
fn solves_what_nalgebra_multiplies() {
    agrees(&CHAIN);
    agrees(&TREE);
    agrees(&[&[]]);
}

#[test]
fn what_lies_above_the_diagonal_is_not_read() {
    let mut h = mass_matrix(&TREE, &mut random_numbers(3)).data.0;
    let mut clean = h;
    let d_inv = factor(&TREE, &mut clean);
    for (i, row) in h.iter_mut().enumerate() {
        row[i + 1..].fill(f64::NAN);
    }
    assert_eq!(factor(&TREE, &mut h), d_inv);
    let (mut x, mut y) = ([[1.0, 2.0]; 7], [[1.0, 2.0]; 7]);
    solve_columns(&TREE, &h, &d_inv, &mut x);
    solve_columns(&TREE, &clean, &d_inv, &mut y);
    assert_eq!(x, y);
}

#[test]
fn nothing_to_solve_is_no_error() {
    let mut x: [[f64; 3]; 0] = [];
    solve_columns(&[], &[], &[], &mut x);
}
