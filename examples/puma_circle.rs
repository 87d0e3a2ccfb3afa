//! The PUMA 560 draws circles with a load that it knows nothing of: first by computed torque, then while it learns.
//!
//! `cargo run --example puma_circle`, and in pictures `cargo run --example puma_circle -- --plot circle.svg --animate circle.html`

use std::f64::consts::TAU;

use dynamics_core::control::{BaseParameters, ComputedTorque, SlotineLi};
use dynamics_core::prelude::*;
use dynamics_examples::draw;
use dynamics_view::Recording;

/// The arm of the example `puma560`, and a load in its hand, 10 cm beyond the flange.
#[derive(Dynamics)]
#[dynamics(allow(nonphysical_inertia))]
#[joint(joint1: revolute, world -> link1, mdh(0, 0, 0, 0))]
#[body(link1, mass = 0, inertia = diag(0, 0, 0.35))]
#[joint(joint2: revolute, link1 -> link2, mdh(0, -90deg, 0.2435, 0))]
#[body(link2, mass = 17.4, com = [0.068, 0.006, -0.016], inertia = diag(0.13, 0.524, 0.539))]
#[joint(joint3: revolute, link2 -> link3, mdh(0.4318, 0, -0.0934, 0))]
#[body(link3, mass = 4.8, com = [0, -0.07, 0.014], inertia = diag(0.066, 0.0125, 0.086))]
#[joint(joint4: revolute, link3 -> link4, mdh(-0.0203, 90deg, 0.4331, 0))]
#[body(link4, mass = 0.82, com = [0, 0, -0.019], inertia = diag(1.8e-3, 1.8e-3, 1.3e-3))]
#[joint(joint5: revolute, link4 -> link5, mdh(0, -90deg, 0, 0))]
#[body(link5, mass = 0.34, inertia = diag(0.3e-3, 0.3e-3, 0.4e-3))]
#[joint(joint6: revolute, link5 -> link6, mdh(0, 90deg, 0, 0))]
#[body(link6, mass = 0.09, com = [0, 0, 0.032], inertia = diag(0.15e-3, 0.15e-3, 0.04e-3))]
#[joint(grip: fixed, link6 -> hand, at = [0, 0, 0.1])]
#[body(hand, solid = sphere(load, 5cm))]
struct Puma560 {
    load: f64,
}

type Failure = Box<dyn std::error::Error>;

/// What the hand carries, in kg; the controllers think that it is empty.
const LOAD: f64 = 2.5;
/// The circle of the wrist, in m and s a lap.
const RADIUS: f64 = 0.15;
const LAP: f64 = 2.0;
const LAPS: usize = 8;
/// How far the last three joints nod, in rad.
const NOD: f64 = 0.4;
/// The controllers run at 1 kHz.
const STEP: f64 = 1e-3;
const STEPS_PER_LAP: usize = 2000;

fn main() -> Result<(), Failure> {
    let real = Puma560 { load: LOAD }.prepare();
    let model = Puma560 { load: 0.0 }.prepare();
    let lap = circle(&model)?;

    // Both with the same feedback of the error: about 14 rad/s, critically damped.
    let computed = ComputedTorque::critically_damped(SVector::repeat(14.0));
    let mut adaptive = SlotineLi {
        bandwidth: SVector::repeat(10.0),
        damping: SVector::from([60.0, 60.0, 20.0, 0.5, 0.5, 0.05]),
        adaptation: learning(),
        parameters: model.base_parameters(),
        family: BaseParameters,
    };
    let mut seen = Recording::of(&real).with_masses();
    let wrong = run(&real, &lap, |state, desired| computed.torque(&model, state, desired), |_, _| ())?;
    let right = run(&real, &lap, |state, desired| computed.torque(&real, state, desired), |_, _| ())?;
    let learn = |state: &_, desired: &_| {
        let tracking = adaptive.track(&model, state, desired);
        adaptive.adapt(&tracking, STEP);
        tracking.tau
    };
    let learned = run(&real, &lap, learn, |sample, tau| seen.see_under(sample, |_, _| tau))?;

    println!("The wrist on a circle of {RADIUS} m, {LAP} s a lap, with {LOAD} kg in the hand.");
    println!("Its greatest distance from where it should be, in mm:");
    println!("          computed torque          Slotine and Li,");
    println!("  lap   load unknown   known    load unknown at first");
    for (lap, ((wrong, right), learned)) in wrong.iter().zip(&right).zip(&learned).enumerate() {
        println!("{:5} {:14.2} {:7.2} {:14.2}", lap + 1, wrong * 1e3, right * 1e3, learned * 1e3);
    }
    println!("Three of its {} base parameters, kg m; it need not find all of them to track:", Puma560::NB);
    let (thought, truth, first) = (adaptive.parameters, real.base_parameters(), model.base_parameters());
    for name in ["joint2.mass_x", "joint3.mass_y", "joint5.mass_y"] {
        let at = Puma560::BASE_PARAMETER_NAMES.iter().position(|known| *known == name);
        let at = at.ok_or_else(|| format!("{name} is no base parameter"))?;
        println!("  {name}: {:8.4} at first, {:8.4} now, {:8.4} in truth", first[at], thought[at], truth[at]);
    }
    if learned[LAPS - 1] > 0.1 * wrong[LAPS - 1] {
        return Err(
            "it has not learnt: the last lap is not ten times better than with the wrong model".into()
        );
    }
    draw(|| seen.figure("A PUMA that learns its load"), || seen.film().tracing("link4"))
}

/// One lap in the joints: the reference at each step.
///
/// The wrist, where the last three axes meet, hangs on the first three joints; these follow from its position `p` by
/// Newton's steps, `J·v = ṗ` and `J·a + J̇·v = p̈`. The last three nod once a lap, so that the load is felt.
fn circle(arm: &Puma560Prepared) -> Result<Vec<Reference<f64, 6, 6>>, Failure> {
    let mut q = SVector::from([0.0, -1.2, 2.7, 0.0, 0.0, 0.0]);
    let center = arm.pose::<Link4>(&q).translation;
    let rate = TAU / LAP;
    let mut lap = Vec::with_capacity(STEPS_PER_LAP);
    for step in 0..STEPS_PER_LAP {
        let (s, c) = (rate * STEP * step as f64).sin_cos();
        let (radial, along) = (SVector::from([0.0, c, s]) * RADIUS, SVector::from([0.0, -s, c]) * RADIUS);
        (q[3], q[4], q[5]) = (NOD * s, NOD * s, NOD * s);
        let mut steps = 0;
        let jacobian = loop {
            let jacobian = arm.world_jacobian::<Link4>(&q).fixed_view::<3, 3>(0, 0).into_owned().lu();
            let miss = center + radial - arm.pose::<Link4>(&q).translation;
            if miss.norm() < 1e-12 {
                break jacobian;
            }
            let turn = jacobian.solve(&miss).filter(|_| steps < 20).ok_or("the circle is out of reach")?;
            q += with_wrist(turn, 0.0);
            steps += 1;
        };
        let solve = |rate| jacobian.solve(&rate).ok_or("the arm is stretched");
        let v = with_wrist(solve(along * rate)?, NOD * rate * c);
        let bias = arm.world_bias_acceleration::<Link4>(&q, &v).fixed_rows::<3>(0).into_owned();
        let a = with_wrist(solve(-radial * rate * rate - bias)?, -NOD * rate * rate * s);
        lap.push(Reference { q, v, a });
    }
    Ok(lap)
}

/// The first three joints as given, the last three all the same.
fn with_wrist(arm: SVector<f64, 3>, wrist: f64) -> SVector<f64, 6> {
    SVector::from([arm[0], arm[1], arm[2], wrist, wrist, wrist])
}

/// How fast each base parameter may change: moments of mass, of inertia, and less at the hand, where inertias are small. The
/// arm is known to have no friction, dampers or rotors.
fn learning() -> SVector<f64, { Puma560::NB }> {
    SVector::from_fn(|k, _| {
        let name = Puma560Prepared::BASE_PARAMETER_NAMES[k];
        let hand = if name.starts_with("joint6") { 1e-2 } else { 1.0 };
        if name.contains("mass") {
            2.0 * hand
        } else if name.contains("moment") {
            0.1 * hand
        } else {
            0.0
        }
    })
}

/// The greatest distance of the wrist from its place in each lap, in m.
fn run(
    real: &Puma560Prepared,
    lap: &[Reference<f64, 6, 6>],
    mut controller: impl FnMut(&State<f64, 6, 6>, &Reference<f64, 6, 6>) -> SVector<f64, 6>,
    mut see: impl FnMut(&Sample<'_, Puma560Prepared, f64, 6, 6>, SVector<f64, 6>),
) -> Result<Vec<f64>, Failure> {
    let mut arm = Simulation::new(real, State::new(lap[0].q, lap[0].v), STEP)?;
    let mut worst = vec![];
    for _ in 0..LAPS {
        let mut most = 0.0_f64;
        for (desired, next) in lap.iter().zip(lap.iter().cycle().skip(1)) {
            let tau = controller(arm.state(), desired);
            let sample = arm.step_with(&tau)?;
            see(&sample, tau);
            let place = |q| real.pose::<Link4>(q).translation;
            most = most.max((place(&sample.state.q) - place(&next.q)).norm());
        }
        worst.push(most);
    }
    Ok(worst)
}
