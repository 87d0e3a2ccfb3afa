//! Pairs with modes that are known to be out of reach, in turned and in badly scaled coordinates.

use super::*;
use crate::linear::matrix::product_3;
use crate::linear::random::Random;
use crate::product::product;

fn rotation<const N: usize>(random: &mut Random) -> SMatrix<f64, N, N> {
    Schur::new("A", &random.matrix::<N, N>()).expect("it converges").basis
}

/// A pair of which the last `lost` of N states are moved by themselves only.
fn with_lost<const N: usize, const M: usize>(
    random: &mut Random,
    lost: usize,
) -> (SMatrix<f64, N, N>, SMatrix<f64, N, M>) {
    let (mut a, mut b) = (random.matrix::<N, N>(), random.matrix::<N, M>());
    for i in N - lost..N {
        (0..N - lost).for_each(|j| a[(i, j)] = 0.0);
        b.row_mut(i).fill(0.0);
    }
    (a, b)
}

#[test]
fn random_pairs_are_controllable_and_observable() {
    let mut random = Random::new(7);
    for _ in 0..20 {
        let (a, b) = with_lost::<6, 2>(&mut random, 0);
        let reach = controllability(&a, &b).expect("it converges");
        assert!(reach.is_complete() && reach.missing().is_empty() && reach.distance > 1e-6);
        let seen = observability(&a.transpose(), &b.transpose()).expect("it converges");
        assert_eq!(seen, reach);
    }
}

#[test]
fn lost_modes_are_counted_and_named_in_all_coordinates() {
    let mut random = Random::new(8);
    for lost in 1..=5 {
        for _ in 0..10 {
            let (a, b) = with_lost::<6, 2>(&mut random, lost);
            let block = padded(&a, 6 - lost, 0.0);
            let expected = Schur::new("A", &block).expect("it converges").eigenvalues();
            let q = rotation::<6>(&mut random);
            let units = SVector::<f64, 6>::from_fn(|i, _| [1.0, 1e2, 1e-1, 1.0, 1e1, 1e-2][i]);
            let turned = product_3(&q, &a, &q.transpose());
            let turned_b = product(&q, &b);
            let scaled = SMatrix::<f64, 6, 6>::from_fn(|i, j| turned[(i, j)] * units[i] / units[j]);
            let scaled_b = SMatrix::<f64, 6, 2>::from_fn(|i, j| turned_b[(i, j)] * units[i]);
            for (a, b) in [(a, b), (turned, turned_b), (scaled, scaled_b)] {
                let reach = controllability(&a, &b).expect("it converges");
                assert_eq!(reach.dimension, 6 - lost);
                assert!(reach.distance < 1e-13, "{}", reach.distance);
                for pole in reach.missing() {
                    let distance =
                        expected.iter().map(|known| (known - pole).norm()).fold(f64::MAX, f64::min);
                    assert!(distance < 1e-7, "{pole} is not among {expected}"); // in units of 1e4
                }
            }
        }
    }
}

#[test]
fn a_chain_that_loses_its_mode_little_by_little_is_told() {
    // Paige's kind of example: every step is some hundredths, and their product vanishes.
    let mut a = SMatrix::<f64, 12, 12>::zeros();
    for i in 0..12 {
        a[(i, i)] = i as f64 / 12.0;
        if i > 0 {
            a[(i, i - 1)] = 0.02;
        }
    }
    let mut b = SMatrix::<f64, 12, 1>::zeros();
    b[0] = 1.0;
    let reach = controllability(&a, &b).expect("it converges");
    assert!(reach.distance < 1e-12, "{}", reach.distance);
}

#[test]
fn what_rounding_makes_of_a_shared_mode_is_still_lost() {
    // Both states have the pole 0, and the input reaches the first only: turned, the computed poles are ±1e-8.
    let mut random = Random::new(9);
    for _ in 0..20 {
        let q = rotation::<2>(&mut random);
        let a = product_3(&q, &SMatrix::<f64, 2, 2>::from([[0.0, 0.0], [1.0, 0.0]]), &q.transpose());
        let reach = controllability(&a, &product(&q, &SMatrix::from([[1.0, 0.0]]))).expect("it converges");
        assert_eq!(reach.dimension, 1);
        assert_eq!(reach.missing_and_marginal(Time::Continuous), Some(reach.missing()[0]));
    }
}

#[test]
fn lasting_modes_are_those_that_do_not_decay() {
    let a = SMatrix::<f64, 3, 3>::from_diagonal(&[-2.0, 0.5, 0.0].into());
    let reach = |b: [f64; 3]| controllability(&a, &SMatrix::<f64, 3, 1>::from([b])).expect("it converges");
    let pole = |b, time| reach(b).missing_and_lasting(time).map(|pole| (pole.re * 1e12).round() / 1e12);
    assert_eq!(pole([0.0, 1.0, 1.0], Time::Continuous), None);
    assert_eq!(pole([0.0, 1.0, 1.0], Time::Discrete), Some(-2.0));
    assert_eq!(pole([1.0, 0.0, 1.0], Time::Continuous), Some(0.5));
    assert_eq!(pole([1.0, 0.0, 1.0], Time::Discrete), None);
    assert_eq!(pole([1.0, 1.0, 0.0], Time::Continuous), Some(0.0));
    assert_eq!(reach([1.0, 0.0, 1.0]).missing_and_marginal(Time::Continuous), None);
    assert_eq!(reach([0.0; 3]).dimension, 0);
    assert_eq!(controllability(&a, &SMatrix::<f64, 3, 0>::zeros()).map(|reach| reach.dimension), Ok(0));
}
