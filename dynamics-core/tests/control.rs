//! Control blocks in closed loops, beside what their theorems say.
#![cfg(feature = "derive")]

use crate::common::leaper::{Leaper, NQ, NU, NV, NX, leaper};
use crate::common::{random_numbers, random_vector};
use dynamics_core::control::{
    AllParameters, BaseParameters, ComputedTorque, FilteredDerivative, GravityCompensation, Integral,
    SlotineLi, StateFeedback, saturated, slotine_li_regressor,
};
use dynamics_core::prelude::*;

/// Two links that pitch on a turning column, with dampers, friction, and a payload.
#[derive(Clone, Copy, Debug, Dynamics)]
#[joint(column: revolute(z), world -> turret, damping = 0.4, friction = 0.3, effort = 40)]
#[body(turret, mass = 3, com = [0.01, 0.02, 0.1], inertia = diag(0.03, 0.03, 0.02))]
#[joint(shoulder: revolute(-y), turret -> upper, at = [0, 0, 0.3], damping = 0.2, effort = 60)]
#[body(upper, solid = rod(2, 0.5, x), com = [0.25, 0, 0])]
#[joint(elbow: revolute(-y), upper -> lower, at = [0.5, 0, 0], friction = 0.1, effort = 30)]
#[body(lower, solid = rod(1, 0.5, x), com = [0.25, 0, 0])]
#[joint(grip: fixed, lower -> payload, at = [0.5, 0, 0])]
#[body(payload, solid = point(load))]
struct Arm<T> {
    load: T,
}

const NP: usize = <Arm<f64> as Mechanism>::PARAMETER_NAMES.len();
const NB: usize = <Arm<f64> as Mechanism>::BASE_PARAMETER_NAMES.len();

/// What RK4 leaves in steps of a millisecond, for gains up to a hundred.
const INTEGRATION: f64 = 1e-8;

const STEP: f64 = 1e-3;

/// A motion through all joints.
fn desired(time: f64) -> Reference<f64, 3, 3> {
    let motion = [(0.8, 1.1, 0.2), (0.5, 1.7, 0.9), (0.7, 2.3, -0.4)];
    Reference {
        q: motion.map(|(size, rate, phase)| size * (rate * time + phase).sin()).into(),
        v: motion.map(|(size, rate, phase)| size * rate * (rate * time + phase).cos()).into(),
        a: motion.map(|(size, rate, phase)| -size * rate * rate * (rate * time + phase).sin()).into(),
    }
}

#[test]
fn computed_torque_makes_every_error_linear() {
    let (robot, omega) = (Arm { load: 1.5 }, SVector::from([4.0, 6.0, 9.0]));
    let controller = ComputedTorque::critically_damped(omega);
    let (start, offset) = (desired(0.0), SVector::from([0.4, -0.3, 0.2]));
    let state = State::new(start.q + offset, start.v);
    let mut simulation = Simulation::new(&robot, state, STEP)
        .expect("a good state")
        .with_input(|time, state| controller.torque(&robot, state, &desired(time)));
    for sample in simulation.steps(2000) {
        let sample = sample.expect("it stays finite");
        let time = sample.time;
        for joint in 0..3 {
            let decay = (1.0 + omega[joint] * time) * (-omega[joint] * time).exp();
            let (found, expected) = (sample.state.q[joint] - desired(time).q[joint], offset[joint] * decay);
            assert!((found - expected).abs() < INTEGRATION, "{joint} at {time}: {found} {expected}");
        }
    }
}

/// A payload that nobody told of leaves an error; its integral takes it away, and no further than its bound.
#[test]
fn an_integral_takes_the_rest() {
    let (robot, believed) = (Arm { load: 1.0 }, Arm { load: 0.0 });
    let controller = ComputedTorque::critically_damped(SVector::repeat(10.0));
    let target = Reference::rest(SVector::from([0.2, 0.5, -0.6]));
    let settle = |gain: f64, bound: f64| {
        let mut integral = Integral::new(SVector::repeat(gain), SVector::repeat(bound));
        let mut simulation = Simulation::new(&robot, State::rest(target.q), STEP).expect("a good state");
        for _ in 0..8000 {
            let state = *simulation.state();
            let tau = controller.torque_with_integral(&mut integral, &believed, &state, &target, STEP);
            let mut held = simulation.clone().with_input(|_, _| tau);
            let next = held.step().expect("it stays finite").state;
            simulation = Simulation::new(&robot, next, STEP).expect("a good state");
        }
        ((simulation.state().q - target.q).amax(), integral.sum.amax())
    };
    let (without, _) = settle(0.0, 1.0);
    assert!(without > 0.05, "{without}");
    let (with, _) = settle(150.0, 1.0);
    assert!(with < 1e-4, "{with}");
    let (bounded, sum) = settle(150.0, 0.01);
    assert!(bounded > with && sum == 0.01, "{bounded} {sum}");
}

#[test]
fn gravity_compensation_loses_energy_until_it_is_there() {
    let robot = Arm { load: 1.0 };
    let controller = GravityCompensation {
        proportional: SVector::from([30.0, 50.0, 25.0]),
        derivative: SVector::repeat(6.0),
    };
    let target = Reference::rest(SVector::from([0.9, 0.4, -1.1]));
    let lyapunov = |state: &State<f64, 3, 3>| {
        let error = target.q - state.q;
        robot.kinetic_energy(&state.q, &state.v)
            + 0.5 * error.dot(&controller.proportional.component_mul(&error))
    };
    let state = State::new(SVector::from([-0.6, -0.3, 0.8]), SVector::from([1.0, -2.0, 3.0]));
    let mut last = lyapunov(&state);
    let mut simulation = Simulation::new(&robot, state, STEP)
        .expect("a good state")
        .with_input(|_, state| controller.torque(&robot, state, &target));
    for sample in simulation.steps(20_000) {
        let now = lyapunov(&sample.expect("it stays finite").state);
        assert!(now <= last + INTEGRATION, "{now} after {last}");
        last = now;
    }
    assert!((simulation.state().q - target.q).amax() < 1e-4, "{}", simulation.state().q);
}

/// With the right friction, fed forward at the desired speed, a slow motion is followed.
#[test]
fn friction_is_fed_forward_at_the_desired_speed() {
    let robot = Arm { load: 1.0 };
    let controller =
        GravityCompensation { proportional: SVector::repeat(1.0), derivative: SVector::repeat(1.0) };
    let (q, v) = (SVector::from([0.3, 0.2, 0.1]), SVector::from([0.5, -0.4, 0.3]));
    let tau = controller.torque(&robot, &State::new(q, v), &Reference { q, v, a: SVector::zeros() });
    let expected = robot.gravity_forces(&q) + robot.passive_forces(&q, &v);
    assert!((tau - expected).amax() < 1e-14);
}

/// `Y·π` beside `M·a_r + C·v_r + G`, of robots with other parameters than that of the regressor.
#[test]
fn the_regressor_of_slotine_and_li_is_that_of_the_coriolis_matrix() {
    const NP: usize = <Leaper<f64> as Mechanism>::PARAMETER_NAMES.len();
    const NB: usize = <Leaper<f64> as Mechanism>::BASE_PARAMETER_NAMES.len();
    let robot = leaper::<f64>();
    for seed in 0..8 {
        let mut random = random_numbers(seed);
        let q: SVector<f64, NQ> = robot.integrate(&robot.neutral(), &random_vector(&mut random, 1.5));
        let [v, v_r, a_r] = core::array::from_fn(|_| random_vector::<NV>(&mut random, 3.0));
        let other =
            Leaper { m: 2.0 + random(), c: 0.1 * random(), j: 0.01 * (1.5 + random()), k: 3.0 + random() };
        let (mean, half) = ((v + v_r) * 0.5, (v - v_r) * 0.5);
        let mut expected =
            other.mass_matrix(&q) * a_r + other.coriolis_matrix(&q, &v) * v_r + other.gravity_forces(&q);
        let friction = |v: f64| 0.2 * v / v.hypot(0.5);
        expected[9] += other.k * (q[11] - 0.2) + 0.3 * v_r[9] + friction(mean[9]) - friction(half[9]);
        let y = slotine_li_regressor::<AllParameters, _, f64, NQ, NV, NX, NU, NP>(&robot, &q, &v, &v_r, &a_r);
        let found = y * other.inertial_parameters();
        assert!((found - expected).amax() < 1e-11 * expected.amax(), "{found} is not {expected}");
        let y =
            slotine_li_regressor::<BaseParameters, _, f64, NQ, NV, NX, NU, NB>(&robot, &q, &v, &v_r, &a_r);
        let found = y * other.base_parameters();
        assert!((found - expected).amax() < 1e-11 * expected.amax(), "{found} is not {expected}");
    }
}

/// What is integrated: positions, speeds, and parameters as they are thought to be.
#[derive(Clone, Copy)]
struct Loop<const N: usize> {
    q: SVector<f64, 3>,
    v: SVector<f64, 3>,
    parameters: SVector<f64, N>,
}

impl<const N: usize> Loop<N> {
    fn plus(&self, rate: &Self, step: f64) -> Self {
        Self {
            q: self.q + rate.q * step,
            v: self.v + rate.v * step,
            parameters: self.parameters + rate.parameters * step,
        }
    }
}

/// The loop of a robot whose payload is not known, for ten seconds: `V` after each step, and the error at the end.
fn adapt<P, const N: usize>(
    mut controller: SlotineLi<f64, 3, N, P>,
    truth: &SVector<f64, N>,
) -> (Vec<f64>, f64)
where
    P: dynamics_core::control::Parameters<Arm<f64>, f64, 3, 3, N> + Copy,
{
    let robot = Arm { load: 2.0 };
    let start = desired(0.0);
    let mut now = Loop { q: start.q, v: start.v, parameters: controller.parameters };
    let mut rate = |now: &Loop<N>, time: f64| {
        controller.parameters = now.parameters;
        let tracking = controller.track(&robot, &State::new(now.q, now.v), &desired(time));
        let a = robot.forward_dynamics(&now.q, &now.v, &tracking.tau);
        let missing = now.parameters - truth;
        let weighed: f64 = missing.iter().zip(&controller.adaptation).map(|(x, gain)| x * x / gain).sum();
        let sliding = tracking.sliding;
        let lyapunov = 0.5 * sliding.dot(&(robot.mass_matrix(&now.q) * sliding)) + 0.5 * weighed;
        (Loop { q: now.v, v: a, parameters: tracking.rate }, lyapunov)
    };
    let mut values = vec![];
    for count in 0..10_000 {
        let time = f64::from(count) * STEP;
        let (k1, value) = rate(&now, time);
        values.push(value);
        let (k2, _) = rate(&now.plus(&k1, STEP / 2.0), time + STEP / 2.0);
        let (k3, _) = rate(&now.plus(&k2, STEP / 2.0), time + STEP / 2.0);
        let (k4, _) = rate(&now.plus(&k3, STEP), time + STEP);
        now = now.plus(&k1, STEP / 6.0).plus(&k2, STEP / 3.0).plus(&k3, STEP / 3.0).plus(&k4, STEP / 6.0);
    }
    (values, (now.q - desired(10.0).q).amax())
}

fn assert_never_increases(values: &[f64]) {
    let first = values[0];
    for pair in values.windows(2) {
        assert!(pair[1] <= pair[0] + INTEGRATION * first, "{} after {}", pair[1], pair[0]);
    }
}

#[test]
fn slotine_and_li_track_with_a_payload_that_nobody_told_of() {
    let (believed, truth) = (Arm { load: 0.0 }, Arm { load: 2.0 });
    let all = SlotineLi {
        bandwidth: SVector::repeat(8.0),
        damping: SVector::repeat(15.0),
        adaptation: SVector::<f64, NP>::repeat(0.5),
        parameters: believed.inertial_parameters(),
        family: AllParameters,
    };
    let (values, error) = adapt(all, &truth.inertial_parameters());
    assert_never_increases(&values);
    assert!(error < 2e-3, "{error}");

    let base = SlotineLi {
        bandwidth: SVector::repeat(8.0),
        damping: SVector::repeat(15.0),
        adaptation: SVector::<f64, NB>::repeat(0.5),
        parameters: believed.base_parameters(),
        family: BaseParameters,
    };
    let (values, error) = adapt(base, &truth.base_parameters());
    assert_never_increases(&values);
    assert!(error < 2e-3, "{error}");

    let fixed = SlotineLi { adaptation: SVector::repeat(1e-12), ..base };
    let (_, stubborn) = adapt(fixed, &truth.base_parameters());
    assert!(stubborn > 5.0 * error, "without adaptation the error stays: {stubborn}");
}

/// A body in a driven socket, beside its centre of mass.
#[derive(Dynamics)]
#[joint(socket: ball, world -> bell)]
#[body(bell, mass = 2.3, com = [0.04, -0.03, -0.6], inertia = tensor(0.03, 0.002, -0.001, 0.04, 0.002, 0.02))]
struct Carillon;

/// From two radians away, and spinning. About the fixed axis that it comes to the error is a damped oscillator's again,
/// of 6 rad/s, which after four seconds is 25·exp(−24) of what it was.
#[test]
fn a_ball_joint_finds_its_orientation() {
    let target = Carillon.integrate(&Carillon.neutral(), &SVector::from([0.4, -0.8, 0.3]));
    let start = Carillon.integrate(&target, &SVector::from([-1.2, 1.4, 0.8]));
    let computed = ComputedTorque::critically_damped(SVector::repeat(6.0));
    let state = State::new(start, SVector::from([1.0, -2.0, 3.0]));
    let mut simulation = Simulation::new(&Carillon, state, STEP)
        .expect("a good state")
        .with_input(|_, state| computed.torque(&Carillon, state, &Reference::rest(target)));
    for sample in simulation.steps(4000) {
        sample.expect("it stays finite");
    }
    let State { q, v } = simulation.state();
    let left = Carillon.difference(q, &target);
    assert!(left.amax() < 1e-7 && v.amax() < 1e-6, "{left} {v}");
}

#[test]
fn state_feedback_is_in_the_tangent_space() {
    let robot = leaper::<f64>();
    let mut random = random_numbers(5);
    let q = robot.integrate(&robot.neutral(), &random_vector(&mut random, 1.0));
    let state = State::new(q, random_vector(&mut random, 1.0));
    let u = random_vector(&mut random, 3.0);
    let feedback = StateFeedback::new(state, u, SMatrix::<f64, NU, NX>::from_fn(|_, _| random()));
    let (delta, speed) = (random_vector::<NV>(&mut random, 0.5), random_vector::<NV>(&mut random, 0.5));
    let state = State::new(robot.integrate(&q, &delta), feedback.state.v + speed);
    let x = SVector::<f64, NX>::from_fn(|i, _| if i < NV { delta[i] } else { speed[i - NV] });
    assert!((feedback.deviation(&robot, &state) - x).amax() < 1e-13);
    let u = feedback.u - feedback.gain * x;
    assert!((feedback.input(&robot, &state) - u).amax() < 1e-12);
    // Its motors are those of the last joints.
    let tau = feedback.torque(&robot, &state);
    for (speed, tau) in tau.iter().enumerate() {
        let motor = Leaper::<f64>::ACTUATED.iter().position(|actuated| *actuated == speed);
        let expected = motor.map_or(0.0, |motor| u[motor]);
        assert!((tau - expected).abs() < 1e-12, "{speed}: {tau} is not {expected}");
    }
}

/// A turn is a turn where it is asked for, and an angle where not.
#[test]
fn state_feedback_takes_whole_turns_out_where_it_is_told_to() {
    let robot = Arm { load: 1.0 };
    let gain = SMatrix::<f64, 3, 6>::from_fn(|i, j| if i == j { 1.0 } else { 0.0 });
    let at = State::rest(SVector::from([0.1, 0.2, 0.3]));
    let turned = State::rest(at.q + SVector::from([2.0, -3.0, 1.0]) * core::f64::consts::TAU);
    let counting = StateFeedback::new(at, SVector::zeros(), gain);
    assert_eq!(counting.input(&robot, &turned), at.q - turned.q);
    let left = counting.wrapping([true, false, true]).input(&robot, &turned);
    assert!(left[0].abs() < 1e-14 && left[2].abs() < 1e-14, "{left}");
    assert_eq!(left[1], at.q[1] - turned.q[1]);
}

#[test]
fn forces_stay_within_the_limits_of_the_robot() {
    let robot = Arm { load: 1.0 };
    let (tau, within) = saturated(&robot, &SVector::from([50.0, -70.0, 10.0]));
    assert_eq!((tau, within), (SVector::from([40.0, -60.0, 10.0]), false));
    let (tau, within) = saturated(&robot, &SVector::from([40.0_f32, -1.0, 10.0]));
    assert_eq!((tau, within), (SVector::from([40.0, -1.0, 10.0]), true));
    let (tau, within) = saturated(&robot, &SVector::from([f64::NAN, 0.0, 0.0]));
    assert!(tau[0].is_nan() && !within);
}

#[test]
fn a_filtered_derivative_finds_the_speed() {
    let (robot, rate, cutoff) = (Arm { load: 1.0 }, SVector::from([0.3, -0.5, 1.1]), 50.0);
    let mut filter = FilteredDerivative::<f64, 3, 3>::new(SVector::zeros(), cutoff);
    let shrink = (2.0 - cutoff * STEP) / (2.0 + cutoff * STEP);
    for count in 1..=500 {
        let speed = filter.update(&robot, &(rate * (f64::from(count) * STEP)), STEP);
        let expected = rate * (1.0 - shrink.powi(count));
        assert!((speed - expected).amax() < 1e-12, "{speed} {expected}");
    }
    assert!((filter.speed() - rate).amax() < 1e-9);
}

/// What runs on a microcontroller runs in single precision.
#[test]
fn blocks_run_in_single_precision() {
    let robot = Arm { load: 1.0_f32 };
    let state = State::new(SVector::from([0.1_f32, 0.2, 0.3]), SVector::from([0.5, -0.5, 0.2]));
    let reference = Reference::rest(SVector::from([0.2_f32, 0.1, 0.4]));
    let torque = ComputedTorque::critically_damped(SVector::repeat(5.0)).torque(&robot, &state, &reference);
    let double = ComputedTorque::critically_damped(SVector::repeat(5.0)).torque(
        &Arm { load: 1.0_f64 },
        &State::new(state.q.map(f64::from), state.v.map(f64::from)),
        &Reference::rest(reference.q.map(f64::from)),
    );
    assert!((torque.map(f64::from) - double).amax() < 1e-4, "{torque} {double}");
}
