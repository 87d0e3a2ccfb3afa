//! The acrobot: two rods, one motor between them, swung up and balanced with nothing at the shoulder.
//!
//! `cargo run --example acrobot`, and in pictures `cargo run --example acrobot -- --plot acrobot.svg --animate acrobot.html`

use std::f64::consts::PI;

use dynamics_core::control::StateFeedback;
use dynamics_core::linear::{Lqr, Weights};
use dynamics_core::prelude::*;
use dynamics_examples::draw;
use dynamics_view::Recording;

/// Two rods of 1 kg, of 1 m and 2 m, that turn about the world's y axis. Upright at zero; the shoulder is passive.
#[derive(Dynamics)]
#[joint(shoulder: revolute(y), world -> arm, actuated = off)]
#[body(arm, com = [0, 0, 0.5], solid = rod(1, 1))]
#[joint(elbow: revolute(y), arm -> leg, at = [0, 0, 1], effort = 60)]
#[body(leg, com = [0, 0, 1], solid = rod(1, 2))]
struct Acrobot;

type Feedback = StateFeedback<f64, 2, 2, 4, 1>;

/// The swing: of the elbow's acceleration, so much for each J that is missing and rad/s of the shoulder, 1/(J·s); a spring,
/// 1/s², and a damper, 1/s, that bring the elbow back.
const PUMP: f64 = 0.2;
const SPRING: f64 = 5.0;
const DAMPER: f64 = 1.0;
const STEP: f64 = 1e-3;
const SECONDS: usize = 12;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (upright, still) = (State::rest(SVector::zeros()), SVector::zeros());
    let measured = (output::joint("shoulder"), output::joint("elbow"));
    let plant: StateSpace<f64, 4, 1, 2> = Acrobot.state_space(&upright.q, &upright.v, &still, &measured)?;
    println!("Upright it falls with a pole at {:.3} 1/s,", plant.poles()?[0].re);
    println!(
        "which the elbow reaches: {:.4} of A and B away from not doing so.",
        plant.controllability()?.distance
    );
    let Lqr { gain, poles, .. } = plant.lqr(&Weights::diagonal([10.0, 10.0, 1.0, 1.0], [1e-2]))?;
    println!(
        "LQR: u = -{:.1?} x, with poles at {:.2?} 1/s.",
        gain.as_slice(),
        poles.map(|pole| pole.re).as_slice()
    );
    let feedback = StateFeedback::new(upright, still, gain).wrapping([true, true]);
    let lean = basin(&feedback)?;
    println!("Stretched and at rest, it is caught from up to {lean:.3} rad beside the upright pose.");

    // It hangs, and has got a nudge. A controller of 1 kHz holds its torque over a step.
    let start = State::new(SVector::from([PI, 0.0]), SVector::from([0.1, 0.0]));
    let mut simulation = Simulation::new(&Acrobot, start, STEP)?;
    let mut seen = Recording::of(&Acrobot).with_masses();
    seen.see(&simulation.sample());
    let mut caught = None;
    println!("\n  time, s   shoulder, rad   elbow, rad   energy above upright, J");
    for step in 1..=SECONDS * 1000 {
        let state = *simulation.state();
        // The swing ends where a look ahead says that the feedback will bring it to rest.
        if caught.is_none() && lean_of(&feedback, &state) < 0.6 && comes_to_rest(&feedback, state)? {
            caught = Some(simulation.time());
        }
        let tau = if caught.is_some() { balance(&feedback, &state) } else { swing(&state) };
        let sample = simulation.step_with(&tau)?;
        seen.see_under(&sample, |_, _| tau);
        if step % 1000 == 0 {
            let State { q, .. } = sample.state;
            println!("{:9.1} {:15.4} {:12.5} {:12.4}", sample.time, q[0], q[1], -missing(&sample.state));
        }
    }
    let time = caught.ok_or("not caught: no swing came near enough")?;
    let left: SVector<f64, 4> = feedback.deviation(&Acrobot, simulation.state());
    let after = SECONDS as f64 - time;
    println!(
        "Caught at {time:.3} s; {after:.1} s later the state is {:.1e} from the upright one.",
        left.norm()
    );
    if left.norm() > 1e-3 {
        return Err("caught, and not brought to rest".into());
    }
    draw(
        || seen.figure("An acrobot, swung up and caught").with_all(seen.phase("shoulder")),
        || seen.film().tracing("leg"),
    )
}

/// How far it leans from the upright pose, in rad of both joints.
fn lean_of(feedback: &Feedback, state: &State<f64, 2, 2>) -> f64 {
    feedback.deviation(&Acrobot, state).fixed_rows::<2>(0).norm()
}

/// The joint forces that balance, as far as the motor can.
fn balance(feedback: &Feedback, state: &State<f64, 2, 2>) -> SVector<f64, 2> {
    control::saturated(&Acrobot, &feedback.torque(&Acrobot, state)).0
}

/// Whether the feedback brings the real robot, with its limit of torque, to rest: simulated, for four seconds.
fn comes_to_rest(feedback: &Feedback, from: State<f64, 2, 2>) -> Result<bool, Error> {
    let mut ahead = Simulation::new(&Acrobot, from, 2.0 * STEP)?.with_input(|_, now| balance(feedback, now));
    for sample in ahead.steps(2000) {
        if lean_of(feedback, &sample?.state) > 2.0 {
            return Ok(false);
        }
    }
    let left: SVector<f64, 4> = feedback.deviation(&Acrobot, ahead.state());
    Ok(left.norm() < 1e-2)
}

/// The furthest lean, stretched and at rest, from which the feedback balances: halved down to a milliradian.
fn basin(feedback: &Feedback) -> Result<f64, Error> {
    let (mut caught, mut lost) = (0.0, 1.0);
    while lost - caught > 1e-3 {
        let lean = (caught + lost) / 2.0;
        match comes_to_rest(feedback, State::rest(SVector::from([lean, 0.0])))? {
            true => caught = lean,
            false => lost = lean,
        }
    }
    Ok(caught)
}

/// The energy that it has upright at rest, less what it has now, in J.
fn missing(State { q, v }: &State<f64, 2, 2>) -> f64 {
    let upright: f64 = Acrobot.potential_energy(&SVector::zeros());
    upright - Acrobot.total_energy(q, v)
}

/// The joint forces that swing.
///
/// The elbow is given its acceleration, and the shoulder follows: `M₁₁·a₁ = −M₁₂·a₂ − h₁`. What the elbow does with the
/// shoulder's speed puts energy in while some is missing, and a spring and a damper bring it back.
///
/// M. Spong, *The swing up control problem for the acrobot*, IEEE Control Systems 15 (1995) 49–55, for giving the
/// elbow its motion; the energy in place of his arctangent as in R. Tedrake, *Underactuated Robotics*, MIT 2023, ch. 3.
fn swing(state: &State<f64, 2, 2>) -> SVector<f64, 2> {
    let State { q, v } = state;
    let bent = control::within_half_a_turn(q[1]);
    let elbow = -PUMP * missing(state) * v[0] - SPRING * bent - DAMPER * v[1];
    let (m, h) = (Acrobot.mass_matrix(q), Acrobot.bias_forces(q, v));
    let shoulder = -(m[(0, 1)] * elbow + h[0]) / m[(0, 0)];
    let tau = Acrobot.inverse_dynamics(q, v, &SVector::from([shoulder, elbow]));
    control::saturated(&Acrobot, &SVector::from([0.0, tau[1]])).0
}
