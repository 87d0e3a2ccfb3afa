//! Discretisation by other roads, and all of linear analysis and design on what no model is.
#![cfg(feature = "std")]

use std::f64::consts::PI;

use dynamics_core::linear::{
    Hold, LinearError, Time, Weights, controllability, kalman, lqr, observability, place_poles, poles,
    quadratic_cost, stability, zero_order_hold,
};
use dynamics_core::nalgebra::Complex;
use dynamics_core::prelude::*;

/// A damped chain of two masses with two forces, one output that sees an input at once, and a push.
fn chain() -> StateSpace<f64, 4, 2, 1> {
    let a = SMatrix::from_row_slice(&[
        0.0, 0.0, 1.0, 0.0, //
        0.0, 0.0, 0.0, 1.0, //
        -5.0, 3.0, -0.4, 0.1, //
        2.0, -2.0, 0.2, -0.3,
    ]);
    let b = SMatrix::from_row_slice(&[0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -0.5, 2.0]);
    let c = SMatrix::from_row_slice(&[1.0, -0.5, 0.0, 0.2]);
    let d = SMatrix::from_row_slice(&[0.3, 0.0]);
    let mut chain = StateSpace::from_matrices(a, b, c, d);
    (chain.drift, chain.offset) = (SVector::from([0.0, 0.0, 0.7, -0.2]), SVector::from([0.1]));
    chain
}

const STEP: f64 = 0.2;
const HOLDS: [Hold<f64>; 4] = [Hold::Zero, Hold::First, Hold::Tustin, Hold::Prewarped { frequency: 3.0 }];

/// ẋ integrated over the step by Runge and Kutta, in so many parts that its error is rounding.
fn integrated(
    model: &StateSpace<f64, 4, 2, 1>,
    mut x: SVector<f64, 4>,
    u: impl Fn(f64) -> SVector<f64, 2>,
) -> SVector<f64, 4> {
    const PARTS: usize = 400;
    let h = STEP / PARTS as f64;
    for part in 0..PARTS {
        let s = part as f64 / PARTS as f64;
        let [start, middle, end] = [0.0, 0.5, 1.0].map(|x| u(s + x / PARTS as f64));
        let k1 = model.derivative(&x, &start);
        let k2 = model.derivative(&(x + k1 * (h / 2.0)), &middle);
        let k3 = model.derivative(&(x + k2 * (h / 2.0)), &middle);
        let k4 = model.derivative(&(x + k3 * h), &end);
        x += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
    }
    x
}

#[test]
fn exact_holds_go_where_integration_goes() {
    let model = chain();
    let x = SVector::from([0.3, -0.2, 1.0, 0.5]);
    let inputs = [SVector::from([1.0, -2.0]), SVector::from([-0.5, 0.7]), SVector::from([0.2, 0.1])];
    for hold in [Hold::Zero, Hold::First] {
        let sampled = model.discretize(hold, STEP).expect("the step is good");
        assert_eq!(sampled.sample_time, Some(STEP));
        let state = |x: &_, u: &_| model.discretized_state(hold, STEP, x, u).expect("the step is good");
        let (mut exact, mut discrete) = (x, state(&x, &inputs[0]));
        for pair in inputs.windows(2) {
            let (now, next) = (pair[0], pair[1]);
            let error = sampled.output(&discrete, &now) - model.output(&exact, &now);
            assert!(error.norm() < 1e-12, "{hold:?}");
            exact = match hold {
                Hold::First => integrated(&model, exact, |s| now + (next - now) * s),
                _ => integrated(&model, exact, |_| now),
            };
            discrete = sampled.derivative(&discrete, &now);
            assert!((discrete - state(&exact, &next)).norm() < 1e-12, "{hold:?}");
        }
    }
}

/// `C·(s − A)⁻¹·B + D`.
fn response(model: &StateSpace<f64, 4, 2, 1>, s: Complex<f64>) -> SMatrix<Complex<f64>, 1, 2> {
    let complex = |x: f64| Complex::new(x, 0.0);
    let shifted = SMatrix::<Complex<f64>, 4, 4>::identity() * s - model.a.map(complex);
    let states = shifted.lu().solve(&model.b.map(complex)).expect("s is no pole");
    model.c.map(complex) * states + model.d.map(complex)
}

#[test]
fn tustin_warps_frequencies_and_keeps_one() {
    let model = chain();
    let (tustin, prewarped) = (HOLDS[2], HOLDS[3]);
    for frequency in [0.1, 1.0, 3.0, 10.0] {
        let z = Complex::new(0.0, frequency * STEP).exp();
        let warped = Complex::new(0.0, 2.0 / STEP * (frequency * STEP / 2.0).tan());
        let sampled = model.discretize(tustin, STEP).expect("the step is good");
        assert!((response(&sampled, z) - response(&model, warped)).norm() < 1e-12);
    }
    let sampled = model.discretize(prewarped, STEP).expect("the step is good");
    let (s, z) = (Complex::new(0.0, 3.0), Complex::new(0.0, 3.0 * STEP).exp());
    assert!((response(&sampled, z) - response(&model, s)).norm() < 1e-12);
}

#[test]
fn every_hold_keeps_rest_and_can_be_undone() {
    let model = chain();
    let u = SVector::from([0.4, -1.0]);
    let rest = model.a.lu().solve(&-(model.b * u + model.drift)).expect("it has no integrator");
    for hold in HOLDS {
        let sampled = model.discretize(hold, STEP).expect("the step is good");
        let state = model.discretized_state(hold, STEP, &rest, &u).expect("the step is good");
        assert!((sampled.derivative(&state, &u) - state).norm() < 1e-14, "{hold:?}");
        assert!((sampled.output(&state, &u) - model.output(&rest, &u)).norm() < 1e-14, "{hold:?}");
        assert_eq!(sampled.is_stable(), Ok(true));
        let back = sampled.to_continuous(hold).expect("its poles are near 1");
        for (found, exact) in
            [(back.a, model.a), (SMatrix::from_diagonal(&back.drift), SMatrix::from_diagonal(&model.drift))]
        {
            assert!((found - exact).norm() < 1e-13, "{hold:?}");
        }
        assert!((back.b - model.b).norm() < 1e-13 && (back.c - model.c).norm() < 1e-13, "{hold:?}");
        assert!((back.d - model.d).norm() < 1e-14 && back.sample_time.is_none(), "{hold:?}");
    }
}

#[test]
fn modes_are_the_same_before_and_after() {
    let model = chain();
    let sampled = model.discretize(Hold::Zero, STEP).expect("the step is good");
    let (before, after) = (model.modes().expect("it converges"), sampled.modes().expect("it converges"));
    for mode in before {
        let near = |other: &&dynamics_core::linear::Mode<f64>| {
            (other.frequency - mode.frequency).abs() + (other.damping - mode.damping).abs() < 1e-12
        };
        assert!(after.iter().any(|other| near(&other)), "{mode}");
    }
}

#[test]
fn steps_and_times_that_cannot_be_are_refused() {
    let model = chain();
    for step in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        for hold in HOLDS {
            assert!(matches!(model.discretize(hold, step), Err(LinearError::Step { .. })), "{hold:?} {step}");
        }
    }
    let beyond = Hold::Prewarped { frequency: PI / STEP };
    let error = model.discretize(beyond, STEP).expect_err("it is folded");
    assert_eq!(error, LinearError::Prewarp { frequency: PI / STEP, limit: PI / STEP });
    let growing = StateSpace::<f64, 1, 1, 1>::from_matrices(
        SMatrix::from([[10.0]]),
        SMatrix::from([[1.0]]),
        SMatrix::from([[1.0]]),
        SMatrix::from([[0.0]]),
    );
    assert_eq!(growing.discretize(Hold::Tustin, 0.2), Err(LinearError::PoleAtTwiceRate { step: 0.2 }));
    let sampled = growing.discretize(Hold::Zero, 0.2).expect("the step is good");
    assert!(matches!(sampled.discretize(Hold::Zero, 0.2), Err(LinearError::WrongTime { .. })));
    assert!(matches!(growing.to_continuous(Hold::Zero), Err(LinearError::WrongTime { .. })));
}

/// The numbers of which what follows is made.
const NUMBERS: [f64; 14] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.1,
    1e-30,
    -1e30,
    1e160,
    -1e-160,
    f64::MAX,
    f64::MIN_POSITIVE,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
];

/// Entries by a counter's hash; the first `kinds` numbers only.
fn nasty<const R: usize, const C: usize>(seed: &mut u64, kinds: usize) -> SMatrix<f64, R, C> {
    SMatrix::from_fn(|_, _| {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        NUMBERS[(*seed >> 33) as usize % kinds]
    })
}

#[track_caller]
fn finite(mut found: impl Iterator<Item = f64>) {
    assert!(found.all(f64::is_finite));
}

/// Everything, on one set of matrices: it returns, and what it returns is finite or an error.
fn returns<const N: usize, const M: usize>(seed: &mut u64, kinds: usize) {
    let (a, b) = (nasty::<N, N>(seed, kinds), nasty::<N, M>(seed, kinds));
    let (q, r) = (nasty::<N, N>(seed, kinds), nasty::<M, M>(seed, kinds));
    let column = nasty::<N, 1>(seed, kinds);
    let definite = Weights::diagonal([1.0; N], [0.1; M]);
    let square = Weights::new((q + q.transpose()) * 0.5, (r + r.transpose()) * 0.5);
    if let Ok(found) = poles(&a) {
        finite(found.iter().flat_map(|pole| [pole.re, pole.im]));
        let desired = core::array::from_fn(|k| Complex::new(-1.0 - k as f64, 0.0));
        if let Ok(placed) = place_poles(&a, &column, &desired) {
            finite(placed.gain.iter().copied());
        }
    }
    if let Ok((phi, gamma)) = zero_order_hold(&a, &b, 0.1) {
        finite(phi.iter().chain(gamma.iter()).copied());
    }
    let _ = (controllability(&a, &b), observability(&a, &b.transpose()));
    for time in [Time::Continuous, Time::Discrete] {
        let _ = stability(time, &a);
        for weights in [definite, square] {
            if let Ok(found) = lqr(time, &a, &b, &weights) {
                finite(found.gain.iter().chain(found.cost.iter()).copied());
            }
            if let Ok(found) = kalman(time, &a, &b.transpose(), &weights) {
                finite(found.gain.iter().copied());
            }
            let _ = quadratic_cost(time, &a, &b, &weights, &SMatrix::zeros());
        }
    }
    let model = StateSpace::from_matrices(a, b, b.transpose(), r);
    for hold in HOLDS {
        if let Ok(sampled) = model.discretize(hold, 0.1) {
            finite(sampled.a.iter().chain(sampled.b.iter()).copied());
            let _ = sampled.to_continuous(hold).map(|model| finite(model.a.iter().copied()));
        }
    }
}

#[test]
fn everything_returns_on_what_no_model_is() {
    let mut seed = 20;
    // Ones and zeros; with small and large ones; with what overflows; with what is no number.
    for kinds in [4, 7, 9, 11, 14] {
        for _ in 0..25 {
            returns::<0, 0>(&mut seed, kinds);
            returns::<1, 0>(&mut seed, kinds);
            returns::<1, 1>(&mut seed, kinds);
            returns::<2, 1>(&mut seed, kinds);
            returns::<3, 2>(&mut seed, kinds);
            returns::<4, 4>(&mut seed, kinds);
            returns::<6, 2>(&mut seed, kinds);
        }
    }
}
