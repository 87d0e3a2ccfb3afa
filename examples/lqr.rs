//! `u = −K·x`, by which `∫ (xᵀQx + uᵀRu) dt` is least along `ẋ = A·x + B·u`: a cart that balances two rods, one on the
//! other. `K = R⁻¹BᵀP` and `AᵀP + PA − PBR⁻¹BᵀP + Q = 0`, and from `x` on it costs `xᵀPx`.
//!
//! From the robot to A and B, to K, and back to the whole robot, which is not linear: what its motion costs, beside `xᵀPx`.
//!
//! `cargo run --example lqr`

use dynamics_core::control::StateFeedback;
use dynamics_core::linear::{Weights, poles};
use dynamics_core::prelude::*;

/// A cart of 1 kg, pushed along x, and two rods of 0.2 kg and 0.5 m, upright at zero. No motor is at the hinges.
#[derive(Dynamics)]
#[joint(slider: prismatic(x), world -> cart)]
#[body(cart, solid = point(1))]
#[joint(lower: revolute(y), cart -> first, actuated = off)]
#[body(first, solid = rod(0.2, 0.5, z), com = [0, 0, 0.25])]
#[joint(upper: revolute(y), first -> second, at = [0, 0, 0.5], actuated = off)]
#[body(second, solid = rod(0.2, 0.5, z), com = [0, 0, 0.25])]
struct Tower;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (upright, still) = (State::rest(SVector::zeros()), SVector::zeros());
    let plant = StateSpace::from(Tower.linearize(&upright.q, &upright.v, &still));
    let fastest = poles(&plant.a)?.iter().map(|pole| pole.re).fold(0.0, f64::max);
    println!("Left alone it falls as exp({fastest:.2} t).");

    // By Bryson's rule: a metre, 0.2 rad, 1 m/s, 1 rad/s and 10 N are as bad as each other.
    let weights = Weights::diagonal([1.0, 25.0, 25.0, 1.0, 1.0, 1.0], [0.01]);
    let lqr = plant.lqr(&weights)?;
    println!("K = {:.1?}, and the equation remains by {:.0e}.", lqr.gain.as_slice(), lqr.residual);
    println!("With it the poles are at {:.2?} 1/s.\n", lqr.poles.map(|pole| pole.re).as_slice());

    let feedback = StateFeedback::new(upright, still, lqr.gain);
    let rate = |state: &State<f64, 3, 3>| {
        let (x, u) = (feedback.deviation(&Tower, state), feedback.torque(&Tower, state)[0]);
        x.dot(&(weights.q * x)) + weights.r[0] * u * u
    };
    println!("  tilt, rad         cost   xᵀPx, linear   cart went, m   after 10 s");
    for tilt in [0.001, 0.1, 0.2, 0.4, 0.5] {
        let start = State::rest(SVector::from([0.0, tilt, 0.0]));
        let x = feedback.deviation(&Tower, &start);
        let (expected, mut cost, mut furthest) = (x.dot(&(lqr.cost * x)), 0.0, 0.0_f64);
        let mut robot = Simulation::new(&Tower, start, 1e-3)?
            .with_input(|_, state: &State<f64, 3, 3>| feedback.torque(&Tower, state));
        for _ in 0..10_000 {
            let before = rate(robot.state());
            let state = robot.step()?.state;
            (cost, furthest) = (cost + 0.5e-3 * (before + rate(&state)), furthest.max(state.q[0].abs()));
        }
        let left = feedback.deviation(&Tower, robot.state()).norm();
        let end = if left < 1e-3 { "upright" } else { "fallen: so far off the linear model is of no use" };
        println!("{tilt:11} {cost:12.4e} {expected:14.4e} {furthest:14.4}   {end}");
        // Near upright the robot is the linear model, and the trapezoidal sum of the cost is good to four digits.
        if tilt < 0.01 && (left > 1e-3 || (cost / expected - 1.0).abs() > 1e-4) {
            return Err("the closed loop is not the one that was computed".into());
        }
    }
    Ok(())
}
