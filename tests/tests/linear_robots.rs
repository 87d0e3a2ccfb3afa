//! Linear models of robots: what is known of their poles and of what their inputs reach.

use std::f64::consts::PI;

use dynamics_core::linear::{
    Lqr, Time, Verdict, Weights, controllability, lqr, poles, stability, zero_order_hold,
};
use dynamics_core::nalgebra::{Complex, Quaternion, UnitQuaternion, Vector3};
use dynamics_core::prelude::*;
use dynamics_tests::random::Random;
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

/// HyQ where something pulls, or nothing.
#[derive(Dynamics)]
#[dynamics(urdf = "robots/hyq/model.urdf", base = free, gravity = [0, 0, -g])]
struct Quadruped {
    g: f64,
}

/// What is beside sums of size 1 no more than rounding; everything else here is more than 1e-3.
const ROUNDING: f64 = 1e-13;

/// What motors in the joints do not change of a floating robot at rest: six rows or four, each for the velocities, and for
/// the positions that follow.
///
/// Where nothing pulls this is the momentum. A fall's momentum grows along the vertical, which turns in the axes of the
/// trunk as the legs tilt it, and a free joint's velocity is in these. So both horizontal parts are reached. The vertical
/// part is not, nor is the angular momentum about the centre of mass.
fn conserved(robot: &Quadruped, q: &SVector<f64, 19>) -> Vec<SMatrix<f64, 1, 18>> {
    let mass = robot.mass_matrix(q);
    let momentum = |axis: usize| mass.row(axis).into_owned();
    if robot.g == 0.0 {
        return (0..6).map(momentum).collect();
    }
    let up =
        UnitQuaternion::from_quaternion(Quaternion::new(q[6], q[3], q[4], q[5])).inverse() * Vector3::z();
    let c = Vector3::new(mass[(5, 1)], mass[(3, 2)], mass[(4, 0)]) / mass[(0, 0)];
    vec![
        momentum(0) * up.x + momentum(1) * up.y + momentum(2) * up.z,
        momentum(3) - (momentum(2) * c.y - momentum(1) * c.z),
        momentum(4) - (momentum(0) * c.z - momentum(2) * c.x),
        momentum(5) - (momentum(1) * c.x - momentum(0) * c.y),
    ]
}

/// In flight nothing brings a quadruped back, and its own motors do not move all of its 36 modes.
#[test]
fn a_floating_base_is_marginal_and_keeps_its_momentum() {
    let mut random = Random::of("a quadruped in flight");
    for (g, kept) in [(0.0, 6), (9.81, 4)] {
        let robot = Quadruped { g };
        let turn = SVector::<f64, 18>::from_fn(|_, _| 0.5 * random.number());
        let q = robot.integrate(&robot.neutral(), &turn);
        let Linearization { a, b, .. } = robot.linearize(&q, &SVector::zeros(), &SVector::zeros());

        // From the mass matrix: so much is not reached …
        let rows = conserved(&robot, &q);
        assert_eq!(rows.len(), kept);
        for row in &rows {
            let input = row * b.fixed_rows::<18>(18);
            assert!(input.norm() < ROUNDING * row.norm() * b.norm(), "{g}: {input}");
            let state = row * a.fixed_rows::<18>(18);
            assert!(state.norm() < ROUNDING * row.norm() * a.norm(), "{g}: {state}");
        }
        // … and from powers of A, of which the fourth is zero: the rest is.
        let mut powers = SMatrix::<f64, 36, 48>::zeros();
        let mut power = b;
        for k in 0..4 {
            powers.fixed_columns_mut::<12>(12 * k).copy_from(&(power / power.norm().max(1.0)));
            power = a * power;
        }
        assert_eq!(powers.rank(1e-9), 36 - 2 * kept);

        // The verdict says so, whatever the last bits are.
        let mut last_bits = |entry: f64| entry * (1.0 + 4.0 * f64::EPSILON * random.number());
        for (a, b) in [(a, b), (a.map(&mut last_bits), b.map(&mut last_bits))] {
            let reach = controllability(&a, &b).expect("it converges");
            assert_eq!((reach.dimension, reach.missing().len()), (36 - 2 * kept, 2 * kept));
            assert!(reach.distance < ROUNDING, "{}", reach.distance);
            assert!(reach.missing_and_lasting(Time::Continuous).is_some());
        }
        let found = stability(Time::Continuous, &a).expect("it converges");
        assert_eq!(found.verdict, Verdict::Marginal, "{found:?}");
    }
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
