//! Schur's form put back together, and its eigenvalues beside nalgebra's.

use super::*;
use crate::linear::random::Random;

/// `Z·T·Zᵀ = A`, both in reals and in complex numbers, and Z is orthogonal.
fn puts_together<const N: usize>(a: &SMatrix<f64, N, N>) {
    let schur = Schur::new("a", a).expect("it converges");
    let tolerance = 20.0 * N as f64 * f64::EPSILON;
    let Schur { triangle, basis } = &schur;
    assert!((basis * basis.transpose() - SMatrix::identity()).norm() <= tolerance);
    assert!(norm(&(basis * triangle * basis.transpose() - a)) <= tolerance * norm(a));
    for i in 0..N {
        assert!((0..i).all(|j| triangle[(i, j)] == 0.0 || j + 1 == i));
        assert!(i < 2 || triangle[(i, i - 1)] == 0.0 || triangle[(i - 1, i - 2)] == 0.0);
    }
    let ComplexSchur { triangle, basis } = schur.to_complex();
    let error = basis * triangle * basis.adjoint() - a.map(real);
    let error = norm(&error.map(|entry| entry.re)) + norm(&error.map(|entry| entry.im));
    assert!(error <= tolerance * norm(a), "{N}: {error}");
    for i in 0..N {
        assert!((0..i).all(|j| triangle[(i, j)].norm() == 0.0));
    }
    let sum: Complex<f64> = schur.eigenvalues().iter().sum();
    assert!((sum.re - a.trace()).abs() <= tolerance * norm(a) && sum.im == 0.0);
}

#[test]
fn random_matrices_are_put_together() {
    let mut random = Random::new(1);
    for _ in 0..50 {
        puts_together::<1>(&random.matrix());
        puts_together::<2>(&random.matrix());
        puts_together::<3>(&random.matrix());
        puts_together::<5>(&random.matrix());
        puts_together::<8>(&random.matrix());
        puts_together::<12>(&random.matrix());
    }
}

#[test]
fn matrices_that_are_hard_for_the_algorithm_are_put_together() {
    let shift = SMatrix::<f64, 7, 7>::from_fn(|i, j| f64::from(u8::from((j + 1) % 7 == i))); // fixed by plain shifts
    puts_together(&shift);
    puts_together(&SMatrix::<f64, 6, 6>::from_fn(|i, j| f64::from(u8::from(i + 1 == j)))); // one Jordan block
    puts_together(&SMatrix::<f64, 6, 6>::from_fn(|i, j| f64::from(u8::from(i == j + 1))));
    puts_together(&SMatrix::<f64, 5, 5>::zeros());
    puts_together(&SMatrix::<f64, 4, 4>::repeat(1.0));
    puts_together(&SMatrix::<f64, 8, 8>::from_fn(|i, j| 1.0 / (i + j + 1) as f64));
    puts_together(&SMatrix::<f64, 8, 8>::from_fn(|i, j| 10f64.powi(i as i32 - 2 * j as i32)));
    let scale = 1e200;
    puts_together(&(shift * scale));
    puts_together(&(shift / scale));
}

#[test]
fn eigenvalues_are_those_of_nalgebra() {
    let mut random = Random::new(2);
    for _ in 0..50 {
        let a: SMatrix<f64, 6, 6> = random.matrix();
        let ours = Schur::new("a", &a).expect("it converges").eigenvalues();
        for theirs in &a.complex_eigenvalues() {
            let distance = ours.iter().map(|ours| (ours - theirs).norm()).fold(f64::INFINITY, f64::min);
            assert!(distance < 1e-10 * norm(&a)); // none of these matrices is within 1e-5 of a defective one
        }
    }
}

#[test]
fn what_is_not_finite_is_refused() {
    for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY] {
        let mut a = SMatrix::<f64, 4, 4>::identity();
        a[(1, 2)] = bad;
        let error = Schur::new("A", &a).err();
        assert_eq!(error, Some(LinearError::NotFinite { matrix: "A", row: 1, column: 2 }));
    }
    assert!(Schur::new("A", &SMatrix::<f64, 0, 0>::zeros()).is_ok());
    assert!(Schur::new("A", &SMatrix::<f64, 3, 3>::repeat(f64::MAX)).is_err()); // 3·MAX has no number
}
