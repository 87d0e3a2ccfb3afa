//! The hidden solver against nalgebra.
#![cfg(feature = "std")]

use dynamics_core::__private::solve_columns;
use dynamics_core::nalgebra::SMatrix;

fn agrees<const N: usize, const M: usize>() {
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as f64 / (1_u64 << 31) as f64
    };
    // Above the diagonal stands NaN: it must not be read.
    let l: [[f64; N]; N] =
        core::array::from_fn(|i| core::array::from_fn(|j| if j < i { random() - 0.5 } else { f64::NAN }));
    let d: [f64; N] = core::array::from_fn(|_| random() + 0.5);
    let b: [[f64; M]; N] = core::array::from_fn(|_| core::array::from_fn(|_| random() - 0.5));

    let unit_lower = SMatrix::<f64, N, N>::from_fn(|i, j| match i.cmp(&j) {
        core::cmp::Ordering::Greater => l[i][j],
        core::cmp::Ordering::Equal => 1.0,
        core::cmp::Ordering::Less => 0.0,
    });
    let m = unit_lower.transpose() * SMatrix::<f64, N, N>::from_diagonal(&d.into()) * unit_lower;

    let mut x = b;
    solve_columns(&l, &d.map(f64::recip), &mut x);
    let rows = |x: [[f64; M]; N]| SMatrix::<f64, N, M>::from_fn(|i, j| x[i][j]);
    assert!((m * rows(x) - rows(b)).amax() < 1e-12);
}

#[test]
fn solves_what_nalgebra_multiplies() {
    agrees::<1, 1>();
    agrees::<2, 5>();
    agrees::<7, 14>();
    agrees::<18, 36>();
}

#[test]
fn nothing_to_solve_is_no_error() {
    let mut x: [[f64; 3]; 0] = [];
    solve_columns(&[], &[], &mut x);
    let mut x = [[0.0; 0]; 2];
    solve_columns(&[[0.0; 2]; 2], &[1.0; 2], &mut x);
}
