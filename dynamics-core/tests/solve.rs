//! The hidden solver against nalgebra, on a chain and on a branched tree.
#![cfg(feature = "std")]

use dynamics_core::__private::solve::Factors;
use dynamics_core::__private::{forward_from_inverse, inverse_of};
use dynamics_core::InverseDynamicsDerivatives;
use dynamics_core::nalgebra::SMatrix;

/// A few roundings of numbers of the size of one, times a condition of some hundred.
const TOLERANCE: f64 = 1e-12;

const CHAIN: [&[usize]; 5] = [&[], &[0], &[0, 1], &[0, 1, 2], &[0, 1, 2, 3]];
const TREE: [&[usize]; 7] = [&[], &[0], &[1, 0], &[0], &[3, 0], &[4, 3, 0], &[3, 0]];

/// Longer than a strip of lanes, and than a whole number of them.
const LONG: [&[usize]; 21] = [
    &[],
    &[0],
    &[1, 0],
    &[2, 1, 0],
    &[0],
    &[4, 0],
    &[5, 4, 0],
    &[],
    &[7],
    &[8, 7],
    &[9, 8, 7],
    &[10, 9, 8, 7],
    &[11, 10, 9, 8, 7],
    &[7],
    &[13, 7],
    &[14, 13, 7],
    &[],
    &[16],
    &[17, 16],
    &[18, 17, 16],
    &[19, 18, 17, 16],
];

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
    let forward = forward_from_inverse(&inverse);
    assert!((m * forward.da_dq + inverse.dtau_dq).amax() < TOLERANCE);
    assert!((m * forward.da_dv + inverse.dtau_dv).amax() < TOLERANCE);
    assert!((m * forward.da_dtau - SMatrix::identity()).amax() < TOLERANCE);
    assert_eq!(inverse_of(&m), forward.da_dtau);
}

#[test]
fn solves_what_nalgebra_multiplies() {
    agrees(&CHAIN);
    agrees(&TREE);
    agrees(&[&[]]);
    agrees(&LONG);
}

#[test]
fn what_lies_above_the_diagonal_is_not_read() {
    let clean = mass_matrix(&TREE, &mut random_numbers(3)).transpose().data.0;
    let mut rows = clean;
    for (i, row) in rows.iter_mut().enumerate() {
        row[i + 1..].fill(f64::NAN);
    }
    let solved = |m: &[[f64; 7]; 7]| {
        let (mut x, mut inverse) = ([[0.0; 7]; 2], [[0.0; 7]; 7]);
        Factors::of(m).minus_solve(&[[1.0; 7], [2.0; 7]], &mut x);
        Factors::of(m).inverse(&mut inverse);
        (x, inverse)
    };
    assert_eq!(solved(&rows), solved(&clean));
    assert!(solved(&rows).1.as_flattened().iter().all(|x| x.is_finite()));
}

#[test]
fn nothing_to_solve_is_no_error() {
    let mut no_columns: [[f64; 7]; 0] = [];
    Factors::of(&[[1.0; 7]; 7]).minus_solve(&[], &mut no_columns);
    let mut empty: [[f64; 0]; 3] = [[]; 3];
    Factors::of(&[]).minus_solve(&[[]; 3], &mut empty);
    assert_eq!(empty, [[]; 3]);
}
