//! Least cost: by the equation, by the cost of other gains, and by adding up a motion.

use super::*;
use crate::linear::LinearError as Error;
use crate::linear::random::Random;

fn definite<const N: usize>(random: &mut Random) -> SMatrix<f64, N, N> {
    let root = random.matrix::<N, N>();
    root * root.transpose() + SMatrix::identity() * 0.1
}

/// A random problem with a cross term.
fn problem(random: &mut Random) -> (SMatrix<f64, 5, 5>, SMatrix<f64, 5, 2>, Weights<f64, 5, 2>) {
    let (a, b) = (random.matrix::<5, 5>(), random.matrix::<5, 2>());
    let whole = definite::<7>(random);
    let part = |i: usize, j: usize| whole[(i, j)];
    let weights = Weights {
        q: SMatrix::from_fn(part),
        r: SMatrix::from_fn(|i, j| part(i + 5, j + 5)),
        n: SMatrix::from_fn(|i, j| part(i, j + 5)),
    };
    (a, b, weights)
}

#[test]
fn the_equation_holds_with_its_cross_term() {
    let mut random = Random::new(14);
    for _ in 0..30 {
        let (a, b, weights) = problem(&mut random);
        let Weights { q, r, n } = weights;
        let Lqr { gain: k, cost: p, poles, residual } =
            lqr(Time::Continuous, &a, &b, &weights).expect("it is stabilisable");
        let left = a.transpose() * p + p * a - k.transpose() * r * k + q;
        assert!(left.norm() < 1e-13 * p.norm() * a.norm(), "{}", left.norm());
        assert!((r * k - (b.transpose() * p + n.transpose())).norm() < 1e-13 * p.norm());
        assert!(residual < 1e-13 && poles.iter().all(|pole| pole.re < 0.0));
        assert_eq!(p, p.transpose());

        let Lqr { gain: k, cost: p, poles, residual } =
            lqr(Time::Discrete, &a, &b, &weights).expect("it is stabilisable");
        let sum = r + b.transpose() * p * b;
        assert!((sum * k - (b.transpose() * p * a + n.transpose())).norm() < 1e-13 * p.norm());
        let left = a.transpose() * p * a - p - k.transpose() * sum * k + q;
        assert!(left.norm() < 1e-13 * p.norm() * (1.0 + a.norm_squared()), "{}", left.norm());
        assert!(residual < 1e-13, "{residual}");
        assert!(poles.iter().all(|pole| pole.norm() < 1.0));
    }
}

#[test]
fn p_is_what_the_gain_costs_and_others_cost_more() {
    let mut random = Random::new(15);
    for time in [Time::Continuous, Time::Discrete] {
        for _ in 0..10 {
            let (a, b, weights) = problem(&mut random);
            let best = lqr(time, &a, &b, &weights).expect("it is stabilisable");
            let cost = quadratic_cost(time, &a, &b, &weights, &best.gain).expect("it is stable");
            assert!((cost - best.cost).norm() < 1e-12 * cost.norm());
            let other = best.gain + random.matrix::<2, 5>() * 1e-3;
            let more =
                quadratic_cost(time, &a, &b, &weights, &other).expect("it is stable still") - best.cost;
            // To first order nothing changes: what is left is positive semidefinite, and of second order.
            assert!(symmetric_eigenvalues(&more).min() > -1e-12 * cost.norm());
            assert!(more.trace() > 0.0 && more.norm() < 1e-4 * cost.norm());
        }
    }
}

#[test]
fn the_cost_is_the_sum_along_the_motion() {
    let mut random = Random::new(16);
    let (a, b, weights) = problem(&mut random);
    let Lqr { gain, cost, .. } = lqr(Time::Discrete, &a, &b, &weights).expect("it is stabilisable");
    let start = random.matrix::<5, 1>();
    let (mut x, mut sum) = (start, 0.0);
    for _ in 0..2000 {
        let u = -gain * x;
        sum += x.dot(&(weights.q * x)) + u.dot(&(weights.r * u)) + 2.0 * x.dot(&(weights.n * u));
        x = a * x + b * u;
    }
    assert!((sum / start.dot(&(cost * start)) - 1.0).abs() < 1e-12);
}

#[test]
fn a_filter_is_the_dual_of_a_regulator() {
    let mut random = Random::new(17);
    let (a, b, weights) = problem(&mut random);
    let (at, c) = (a.transpose(), b.transpose());
    for time in [Time::Continuous, Time::Discrete] {
        let filter = crate::linear::kalman(time, &at, &c, &weights).expect("it is detectable");
        let dual = lqr(time, &a, &b, &weights).expect("it is stabilisable");
        assert_eq!((filter.gain, filter.covariance), (dual.gain.transpose(), dual.cost));
    }
    let independent = Weights::new(weights.q, weights.r);
    let filter = crate::linear::kalman(Time::Discrete, &at, &c, &independent).expect("it is detectable");
    assert!((at * filter.correction - filter.gain).norm() < 1e-13 * filter.gain.norm());
}

#[test]
fn mistakes_are_told_with_their_place() {
    let (a, b) = (SMatrix::<f64, 2, 2>::from_diagonal(&[1.0, -2.0].into()), SMatrix::from([[0.0, 1.0]]));
    let weights = Weights::diagonal([1.0, 1.0], [1.0]);
    let solve = |a: &_, b: &_, weights: &_| lqr(Time::Continuous, a, b, weights).map(|lqr| lqr.gain);
    assert_eq!(solve(&a, &b, &weights), Err(Error::NotStabilizable { pole: (1.0, 0.0) }));
    let spring = SMatrix::<f64, 2, 2>::from([[0.0, -4.0], [1.0, 0.0]]);
    let free = Weights::diagonal([0.0, 0.0], [1.0]);
    assert_eq!(solve(&spring, &b, &free), Err(Error::FreeMode { pole: (0.0, 2.0) }));
    let negative = Weights::diagonal([1.0, 1.0], [-3.0]);
    let error = Error::NotPositiveDefinite { matrix: "R", eigenvalue: -3.0 };
    assert_eq!(solve(&spring, &b, &negative), Err(error));
    let negative = Weights::diagonal([1e12, -1e-9], [1.0]);
    let error = Error::NotPositiveSemidefinite { matrix: "Q", eigenvalue: -1e-9 };
    assert_eq!(solve(&spring, &b, &negative), Err(error));
    let mut skew = weights;
    skew.q[(1, 0)] = 0.1;
    assert_eq!(solve(&spring, &b, &skew), Err(Error::NotSymmetric { matrix: "Q", row: 1, column: 0 }));
    let crossed = weights.with_cross(SMatrix::from([[1.5, 0.0]]));
    let error = Error::NotPositiveSemidefinite { matrix: "Q", eigenvalue: -1.25 };
    assert_eq!(solve(&spring, &b, &crossed), Err(error));
    let mut nan = weights;
    nan.r[0] = f64::NAN;
    assert_eq!(solve(&spring, &b, &nan), Err(Error::NotFinite { matrix: "R", row: 0, column: 0 }));
    let unstable = quadratic_cost(Time::Continuous, &a, &b, &weights, &SMatrix::zeros());
    assert_eq!(unstable, Err(Error::NotStable { pole: (1.0, 0.0) }));
    let filter = |c, noise| {
        crate::linear::kalman(Time::Continuous, &spring, &SMatrix::from(c), &noise).map(|k| k.gain)
    };
    assert_eq!(filter([[0.0], [0.0]], weights), Err(Error::NotDetectable { pole: (0.0, 2.0) }));
    assert_eq!(filter([[1.0], [0.0]], free), Err(Error::QuietMode { pole: (0.0, 2.0) }));
}

#[test]
fn nothing_is_a_problem_too() {
    let none = SMatrix::<f64, 0, 0>::zeros();
    assert!(lqr(Time::Continuous, &none, &none, &Weights::diagonal([], [])).is_ok());
    let decaying = -SMatrix::<f64, 2, 2>::identity();
    let lqr =
        lqr(Time::Continuous, &decaying, &SMatrix::<f64, 2, 0>::zeros(), &Weights::diagonal([1.0, 3.0], []));
    let cost = lqr.expect("it decays").cost;
    assert!((cost[(0, 0)] - 0.5).abs() < 1e-15 && (cost[(1, 1)] - 1.5).abs() < 1e-15);
}
