//! Poles attained, in the coordinates of the model and beside Ackermann's formula where that can still be used.

use super::*;
use crate::linear::random::Random;

/// Pairs and single poles between −3 and −1.
fn desired<const N: usize>(random: &mut Random) -> [Complex<f64>; N] {
    let mut poles = [real(0.0); N];
    for pair in poles.chunks_mut(2) {
        let pole = Complex::new(random.number() - 2.0, 2.0 * random.number());
        match pair {
            [first, second] => (*first, *second) = (pole, pole.conj()),
            [last] => *last = real(pole.re),
            _ => {}
        }
    }
    poles
}

/// The determinant of the closed loop less each desired pole vanishes beside its factors.
fn places<const N: usize>(random: &mut Random)
where
    nalgebra::Const<N>: nalgebra::DimMin<nalgebra::Const<N>, Output = nalgebra::Const<N>>,
{
    let (a, b, desired) = (random.matrix::<N, N>(), random.matrix::<N, 1>(), desired::<N>(random));
    let placed = place_poles(&a, &b, &desired).expect("it is controllable");
    assert!(placed.residual < 1e-14, "{N}: {}", placed.residual);
    let closed = (a - b * placed.gain).map(real);
    for pole in desired {
        let shifted = closed - SMatrix::identity() * pole;
        let length = |column: usize| closed.column(column).norm() + pole.norm();
        let size = (0..N).map(length).product::<f64>(); // Hadamard's bound
        let determinant = shifted.determinant().norm();
        assert!(determinant < 1e-13 * size, "{N}: {determinant} of {size}");
    }
}

#[test]
fn desired_poles_are_attained() {
    let mut random = Random::new(12);
    for _ in 0..20 {
        places::<1>(&mut random);
        places::<2>(&mut random);
        places::<3>(&mut random);
        places::<6>(&mut random);
        places::<12>(&mut random);
    }
}

#[test]
fn the_gain_is_that_of_ackermann() {
    let mut random = Random::new(13);
    for _ in 0..20 {
        let (a, b) = (random.matrix::<3, 3>(), random.matrix::<3, 1>());
        let desired = desired::<3>(&mut random);
        let (sum, product) = (-2.0 * desired[0].re, desired[0].norm_sqr());
        let one = SMatrix::<f64, 3, 3>::identity();
        let polynomial = (a * a + a * sum + one * product) * (a - one * desired[2].re);
        let powers = SMatrix::<f64, 3, 3>::from_columns(&[b, a * b, a * a * b]);
        let ackermann = (powers.try_inverse().expect("it is controllable") * polynomial).row(2).into_owned();
        let gain = place_poles(&a, &b, &desired).expect("it is controllable").gain;
        assert!((gain - ackermann).norm() < 1e-9 * ackermann.norm());
    }
}

#[test]
fn units_do_not_matter_and_repeated_poles_may_be_desired() {
    // Four masses in a row, in units of 1e6 of each other; all poles in one place.
    let a = SMatrix::<f64, 4, 4>::from_fn(|i, j| if i + 1 == j { 1e6 } else { 0.0 });
    let b = SVector::from([0.0, 0.0, 0.0, 1.0]);
    let desired = [real(-2.0); 4];
    let gain = place_poles(&a, &b, &desired).expect("it is controllable").gain;
    let exact = [16e-18, 32e-12, 24e-6, 8.0]; // (s + 2)⁴
    for (found, exact) in gain.iter().zip(exact) {
        assert!((found / exact - 1.0).abs() < 1e-13, "{found} for {exact}");
    }
}

#[test]
fn what_cannot_be_is_refused() {
    let a = SMatrix::<f64, 2, 2>::from_diagonal(&[1.0, -3.0].into());
    let b = SVector::from([1.0, 0.0]);
    let pair = [Complex::new(-1.0, 1.0), Complex::new(-1.0, -1.0)];
    assert_eq!(place_poles(&a, &b, &pair), Err(LinearError::NotControllable { pole: (-3.0, 0.0) }));
    let half = [Complex::new(-1.0, 1.0), real(-1.0)];
    assert_eq!(place_poles(&a, &b, &half), Err(LinearError::PoleWithoutConjugate { pole: (-1.0, 1.0) }));
    let nan = [real(f64::NAN), real(-1.0)];
    let error = Err(LinearError::NotFinite { matrix: "poles", row: 0, column: 0 });
    assert_eq!(place_poles(&a, &b, &nan), error);
    assert!(place_poles(&SMatrix::<f64, 0, 0>::zeros(), &SVector::zeros(), &[]).is_ok());
}
