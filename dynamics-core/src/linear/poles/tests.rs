//! Poles that are known, and stability where rounding would decide.

use super::*;
use crate::linear::matrix::product_3;
use crate::linear::random::Random;

/// An orthogonal matrix.
fn rotation<const N: usize>(random: &mut Random) -> SMatrix<f64, N, N> {
    Schur::new("A", &random.matrix::<N, N>()).expect("it converges").basis
}

#[test]
fn poles_are_sorted_with_pairs_together() {
    let blocks = SMatrix::<f64, 5, 5>::from_row_slice(&[
        -3.0, 0.0, 0.0, 0.0, 0.0, //
        0.0, -1.0, 2.0, 0.0, 0.0, //
        0.0, -2.0, -1.0, 0.0, 0.0, //
        0.0, 0.0, 0.0, 0.5, 0.0, //
        0.0, 0.0, 0.0, 0.0, -1.5,
    ]);
    let q = rotation(&mut Random::new(5));
    let found = poles(&product_3(&q, &blocks, &q.transpose())).expect("it converges");
    let expected = [(0.5, 0.0), (-1.0, 2.0), (-1.0, -2.0), (-1.5, 0.0), (-3.0, 0.0)];
    for (found, (re, im)) in found.iter().zip(expected) {
        assert!((found - Complex::new(re, im)).norm() < 1e-13, "{found}");
    }
    assert_eq!(found[1].conj(), found[2]);
    let discrete = sorted_poles(Time::Discrete, &blocks).expect("it converges");
    assert_eq!((discrete[0].re, discrete[4].re), (-3.0, 0.5));
}

#[test]
fn integrators_are_marginal_in_all_coordinates() {
    let mut random = Random::new(6);
    for _ in 0..20 {
        // Two double integrators and a stable mode. Computed poles are ±1e-8, right of the axis and left of it.
        let mut a = SMatrix::<f64, 5, 5>::zeros();
        (a[(0, 2)], a[(1, 3)], a[(4, 4)]) = (1.0, 1.0, -1.0);
        let q = rotation(&mut random);
        let turned = product_3(&q, &a, &q.transpose());
        let found = stability(Time::Continuous, &turned).expect("it converges");
        assert_eq!(found.verdict, Verdict::Marginal, "{found:?}");
        let sampled = turned.exp();
        assert_eq!(stability(Time::Discrete, &sampled).expect("it converges").verdict, Verdict::Marginal);
    }
}

#[test]
fn what_rounding_can_tell_is_told() {
    let judged =
        |a: [[f64; 2]; 2]| stability(Time::Continuous, &SMatrix::<f64, 2, 2>::from(a)).expect("it converges");
    assert_eq!(judged([[-1e-10, 0.0], [1.0, -1.0]]).verdict, Verdict::Stable);
    assert_eq!(judged([[1e-10, 0.0], [1.0, -1.0]]).verdict, Verdict::Unstable);
    // A double pole of −1e-10, in axes turned by 45°.
    assert_eq!(judged([[-0.5 - 1e-10, -0.5], [0.5, 0.5 - 1e-10]]).verdict, Verdict::Marginal);
    assert_eq!(judged([[-1e-17, 0.0], [1.0, -1.0]]).verdict, Verdict::Marginal);
    assert_eq!(judged([[0.0, -4.0], [1.0, 0.0]]).verdict, Verdict::Marginal);
    assert_eq!(judged([[0.0; 2]; 2]).verdict, Verdict::Marginal);
    // What cancelled beside a five is no spring.
    let cancelled = SMatrix::<f64, 3, 3>::from([[0.0, 1e-16, 0.0], [1.0, 0.0, 0.0], [0.0, -5.0, -1.0]]);
    assert_eq!(stability(Time::Continuous, &cancelled).expect("it converges").verdict, Verdict::Marginal);
    assert_eq!(judged([[-0.1, -1.0], [1.0, 0.0]]).verdict, Verdict::Stable);
    assert_eq!(judged([[-0.1, -1e-5], [1e5, 0.0]]).verdict, Verdict::Stable);
    // An integrator is no way out for a pole that grows.
    let found = judged([[0.0, 0.0], [0.0, 4.0]]);
    assert_eq!((found.verdict, found.pole.re), (Verdict::Unstable, 4.0));
    let circle = |a: [[f64; 2]; 2]| {
        stability(Time::Discrete, &SMatrix::<f64, 2, 2>::from(a)).expect("it converges").verdict
    };
    assert_eq!(circle([[0.6, 0.8], [-0.8, 0.6]]), Verdict::Marginal);
    assert_eq!(circle([[0.6, 0.8], [-0.79, 0.6]]), Verdict::Stable);
    assert_eq!(circle([[0.6, 0.8], [-0.81, 0.6]]), Verdict::Unstable);
    assert_eq!(circle([[0.0; 2]; 2]), Verdict::Stable);
}

#[test]
fn the_margin_is_a_distance() {
    // A normal matrix: the distance is the smallest real part.
    let a = SMatrix::<f64, 2, 2>::from([[-0.3, 2.0], [-2.0, -0.3]]);
    let found = stability(Time::Continuous, &a).expect("it converges");
    assert!((found.margin * a.norm() - 0.3).abs() < 1e-15);
    assert!((found.pole - Complex::new(-0.3, 2.0)).norm() < 1e-15);
}

#[test]
fn modes_are_those_of_the_oscillator() {
    let (frequency, damping, step) = (3.0_f64, 0.2_f64, 0.05);
    let s = Complex::new(-frequency * damping, frequency * (1.0 - damping * damping).sqrt());
    let z = (s * step).exp();
    for mode in [Mode::continuous(s), Mode::discrete(z, step)] {
        assert!((mode.frequency - frequency).abs() < 1e-14 && (mode.damping - damping).abs() < 1e-14);
    }
    assert_eq!(Mode::continuous(Complex::new(0.0, 0.0)).damping, 0.0);
}

#[test]
fn nothing_and_not_a_number_come_back() {
    assert!(stability(Time::Continuous, &SMatrix::<f64, 0, 0>::zeros()).is_ok());
    let nan = SMatrix::<f64, 2, 2>::repeat(f64::NAN);
    assert!(matches!(poles(&nan), Err(LinearError::NotFinite { matrix: "A", row: 0, column: 0 })));
    assert!(stability(Time::Discrete, &nan).is_err());
}
