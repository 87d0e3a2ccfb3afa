//! Linear models of robots: what is known of their poles and of what their inputs reach.

use std::f64::consts::PI;

use dynamics_core::linear::{
    Lqr, Time, Verdict, Weights, controllability, lqr, poles, stability, zero_order_hold,
};
use dynamics_core::nalgebra::Complex;
use dynamics_core::prelude::*;
use dynamics_tests::zoo::files::hyq;
use dynamics_tests::zoo::industrial::iiwa14;
use dynamics_tests::zoo::textbook::planar_scara;

/// A cart and a pole, with a force on the cart alone.
#[derive(Dynamics)]
#[joint(slider: prismatic(x), world -> cart)]
#[body(cart, mass = 1, inertia = diag(0.01, 0.01, 0.01))]
#[joint(hinge: continuous(y), cart -> pole, actuated = off)]
#[body(pole, solid = rod(0.1, 1, z), com = [0, 0, 0.5])]
struct CartPole;

/// Two links that hang at zero, with a motor in the elbow alone.
#[derive(Dynamics)]
#[joint(shoulder: continuous(y), world -> upper, actuated = off)]
#[body(upper, solid = rod(1, 1, z), com = [0, 0, -0.5])]
#[joint(elbow: continuous(y), upper -> lower, at = [0, 0, -1])]
#[body(lower, solid = rod(1, 2, z), com = [0, 0, -1])]
struct Acrobot;

/// The feedback of the linear model brings the robot itself upright, in continuous time and held for 20 ms.
#[test]
fn a_cart_pole_is_balanced() {
    let zero = SVector::<f64, 2>::zeros();
    let Linearization { a, b, drift } = CartPole.linearize(&zero, &zero, &SVector::zeros());
    assert_eq!(drift, SVector::<f64, 4>::zeros());
    let found = stability(Time::Continuous, &a).expect("it converges");
    assert_eq!(found.verdict, Verdict::Unstable);
    assert!(controllability(&a, &b).expect("it converges").is_complete());
    let weights = Weights::diagonal([1.0, 10.0, 0.1, 0.1], [0.1]);
    let step = 0.02;
    let (phi, gamma) = zero_order_hold(&a, &b, step).expect("the step is good");
    for (time, a, b) in [(Time::Continuous, a, b), (Time::Discrete, phi, gamma)] {
        let Lqr { gain, poles, residual, .. } = lqr(time, &a, &b, &weights).expect("it is stabilisable");
        assert!(residual < 1e-13, "{residual}");
        let closed = a - b * gain;
        assert_eq!(stability(time, &closed).map(|found| found.verdict), Ok(Verdict::Stable));
        assert_eq!(poles.len(), 4);
        let held = if time == Time::Discrete { 20 } else { 1 };
        let input_map: SMatrix<f64, 2, 1> = CartPole.input_map();
        let mut u = SVector::<f64, 1>::zeros();
        let mut state = State { q: SVector::from([0.2, 0.4]), v: SVector::zeros() };
        for k in 0..10_000 {
            if k % held == 0 {
                u = -gain * SVector::from([state.q[0], state.q[1], state.v[0], state.v[1]]);
            }
            state = Rk4
                .step(&CartPole, 0.0, &state, 1e-3, |_, _| input_map * u)
                .expect("explicit steps have no error");
        }
        assert!(state.q.norm() < 1e-3 && state.v.norm() < 1e-3, "{time:?}: {state:?}");
    }
}

#[test]
fn an_acrobot_is_controllable_where_it_cannot_stay() {
    let upright = SVector::from([PI, 0.0]);
    let Linearization { a, b, .. } = Acrobot.linearize(&upright, &SVector::zeros(), &SVector::zeros());
    assert!(controllability(&a, &b).expect("it converges").is_complete());
    assert_eq!(stability(Time::Continuous, &a).map(|found| found.verdict), Ok(Verdict::Unstable));
    let balanced = lqr(Time::Continuous, &a, &b, &Weights::diagonal([10.0, 10.0, 1.0, 1.0], [1.0]));
    assert!(balanced.expect("it is stabilisable").poles.iter().all(|pole| pole.re < 0.0));
    // Hanging, nothing brakes it.
    let hanging = SVector::<f64, 2>::zeros();
    let Linearization { a, .. } = Acrobot.linearize(&hanging, &hanging, &SVector::zeros());
    assert_eq!(stability(Time::Continuous, &a).map(|found| found.verdict), Ok(Verdict::Marginal));
}

/// A pole λ of the model is e^{λh} of the one from sample to sample.
#[test]
fn poles_of_an_arm_are_exponentials_when_sampled() {
    let robot = iiwa14::robot();
    let q = SVector::from([0.3, 0.7, -0.4, -1.2, 0.5, 0.9, 0.1]);
    let holding = robot.gravity_forces(&q);
    let Linearization { a, b, drift } = robot.linearize(&q, &SVector::zeros(), &holding);
    assert!(drift.amax() < 1e-10);
    let step = 1e-3;
    let (phi, _) = zero_order_hold(&a, &b, step).expect("the step is good");
    let sampled = poles(&phi).expect("it converges");
    for pole in poles(&a).expect("it converges").iter() {
        let image: Complex<f64> = (pole * step).exp();
        let distance = sampled.iter().map(|found| (found - image).norm()).fold(f64::MAX, f64::min);
        // The first joint turns about the vertical: a double pole at zero, of which half of the digits are known.
        let tolerance = if pole.norm() < 1e-3 { 1e-7 } else { 1e-12 };
        assert!(distance < tolerance, "{pole}: {distance:e}");
    }
    assert!(controllability(&a, &b).expect("it converges").is_complete());
    let held =
        lqr(Time::Continuous, &a, &b, &Weights::diagonal([1.0; 14], [0.01; 7])).expect("it is stabilisable");
    assert!(held.residual < 1e-12 && held.poles.iter().all(|pole| pole.re < 0.0));
}

/// In free fall nothing brings a quadruped back; and its own motors move neither its momentum nor, with that, twelve of
/// its 36 modes.
#[test]
fn a_floating_base_is_marginal_and_keeps_its_momentum() {
    let robot = hyq::robot();
    let mut q: SVector<f64, 19> = robot.neutral();
    q.iter_mut().skip(7).enumerate().for_each(|(k, angle)| *angle = 0.1 * (k as f64).sin());
    let Linearization { a, b, .. } = robot.linearize(&q, &SVector::zeros(), &SVector::zeros());
    let reach = controllability(&a, &b).expect("it converges");
    assert_eq!((reach.dimension, reach.missing().len()), (24, 12));
    let found = stability(Time::Continuous, &a).expect("it converges");
    assert_eq!(found.verdict, Verdict::Marginal, "{found:?}");
}

/// Joints that turn about the vertical feel no gravity: integrators, two for each.
#[test]
fn a_scara_is_a_row_of_integrators() {
    let robot = planar_scara::robot();
    let q = SVector::from([0.4, -0.9, 0.2, 0.1]);
    let Linearization { a, b, .. } = robot.linearize(&q, &SVector::zeros(), &SVector::zeros());
    assert!(poles(&a).expect("it converges").iter().all(|pole| pole.norm() < 1e-7));
    assert_eq!(stability(Time::Continuous, &a).map(|found| found.verdict), Ok(Verdict::Marginal));
    assert!(controllability(&a, &b).expect("it converges").is_complete());
}
