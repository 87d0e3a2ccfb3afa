//! A thousand arms that are not quite the one that was planned for: how far are they from their path, and what does
//! it cost? Payload and friction are drawn; the rollouts run in lanes and on all cores.
//!
//! `cargo run --release --example monte_carlo`

use std::error::Error;
use std::time::Instant;

use dynamics_core::lanes::Native;
use dynamics_core::prelude::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, Normal, Uniform};

/// Two links in a vertical plane, with something in the hand.
#[derive(Dynamics)]
#[joint(shoulder: revolute(y), world -> upper, damping = friction)]
#[body(upper, solid = rod(4, 0.4, z), com = [0, 0, -0.2])]
#[joint(elbow: revolute(y), upper -> lower, at = [0, 0, -0.4], damping = friction)]
#[body(lower, solid = rod(2.5, 0.35, z), com = [0, 0, -0.175])]
#[joint(grasp: fixed, lower -> load, at = [0, 0, -0.4])]
#[body(load, solid = point(payload))]
struct Arm<T> {
    payload: T,
    friction: T,
}

const COUNT: usize = 1000;
const STEP: f64 = 2e-3;
const STEPS: usize = 1000;

/// Where the arm should be at a time, how fast, and how much faster.
fn path<T: Scalar>(time: T) -> [SVector<T, 2>; 3] {
    let (s, c) = (time * T::of(3.0)).sin_cos();
    let (middle, swing) = (SVector::from([T::of(0.6), T::of(-1.0)]), SVector::from([T::of(0.5), T::of(0.8)]));
    [middle - swing * c, swing * (s * T::of(3.0)), swing * (c * T::of(9.0))]
}

/// Computed torque, by an arm that carries a kilogram.
fn control<T: Scalar>(time: T, state: &State<T, 2, 2>) -> SVector<T, 2> {
    let planned = Arm { payload: T::one(), friction: T::of(0.3) };
    let [q, v, a] = path(time);
    let wanted = a + (v - state.v) * T::of(20.0) + (q - state.q) * T::of(100.0);
    planned.inverse_dynamics(&state.q, &state.v, &wanted)
}

/// Payloads and frictions. Each rollout has a stream of random numbers of its own.
fn drawn(seed: u64) -> Result<(Vec<f64>, Vec<f64>), Box<dyn Error>> {
    let (payload, friction) = (Uniform::new(0.0, 3.0)?, Normal::new(0.3_f64, 0.08)?);
    let draw = |k: u64| {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(k);
        (payload.sample(&mut random), friction.sample(&mut random).max(0.0))
    };
    Ok((0..COUNT as u64).map(draw).unzip())
}

fn main() -> Result<(), Box<dyn Error>> {
    let (payloads, frictions) = drawn(2026)?;
    let [q, v, _] = path(0.0);
    let starts = vec![State::new(q, v); COUNT];

    let rollouts = Rollouts::new(STEP, STEPS)?;
    let mut outcomes = vec![(0.0, 0.0); COUNT]; // the mean deviation in rad, the work of the motors in J
    let mut sound = vec![0.0; COUNT];
    let begun = Instant::now();
    rollouts.par_run(
        (&starts, &payloads, &frictions),
        &mut outcomes,
        &mut sound,
        |(start, payload, friction)| {
            let step = Native::<f64>::from(STEP);
            let (mut squares, mut work) = (Native::<f64>::from(0.0), Native::<f64>::from(0.0));
            let rollout = Rollout::new(Arm { payload, friction }, start).with_input(control);
            rollout.with_observer(move |now| {
                let off = now.state.q - path(now.time)[0];
                let power = control(now.time, &now.state).dot(&now.state.v);
                squares += off.dot(&off) * step;
                work += Scalar::sqrt(power * power) * step; // what is put in and what is braked away
                (Scalar::sqrt(squares / now.time), work)
            })
        },
    )?;
    let seconds = begun.elapsed().as_secs_f64();

    assert!(sound.iter().all(|time| *time == sound[0]), "an arm left all finite numbers");
    let (mut errors, mut works): (Vec<f64>, Vec<f64>) = outcomes.iter().copied().unzip();
    println!("                     5 %    half    95 %");
    for (what, unit, values) in [("off the path by", "rad", &mut errors), ("work", "J", &mut works)] {
        values.sort_by(f64::total_cmp);
        let [low, middle, high] = [0.05, 0.5, 0.95].map(|part| values[(part * COUNT as f64) as usize]);
        println!("{what:16} {low:7.4} {middle:7.4} {high:7.4} {unit}");
    }
    let worst = (0..COUNT).max_by(|a, b| outcomes[*a].0.total_cmp(&outcomes[*b].0)).unwrap_or_default();
    println!("Farthest off was number {worst}: {:.2} kg, {:.2} N·m·s.", payloads[worst], frictions[worst]);
    println!("{COUNT} arms, {:.1e} steps a second.", (COUNT * STEPS) as f64 / seconds);
    Ok(())
}
