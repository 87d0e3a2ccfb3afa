//! A cart-pole that hangs, swung up by energy and caught by LQR: one force on the cart, nothing at the hinge.
//!
//! `cargo run --example swing_up`, and in pictures `cargo run --example swing_up -- --plot swing_up.svg --animate swing_up.html`

use std::f64::consts::PI;

use dynamics_core::control::StateFeedback;
use dynamics_core::linear::{Lqr, Weights, poles};
use dynamics_core::nalgebra::Complex;
use dynamics_core::prelude::*;
use dynamics_examples::draw;
use dynamics_view::{Chart, Plane, Recording};

/// A cart of 1 kg that slides along x, and on it a rod of 0.1 kg and 1 m, upright at zero. No motor is at the hinge.
#[derive(Dynamics)]
#[joint(slider: prismatic(x), world -> cart, limits = [-2, 2], effort = 20)]
#[body(cart, solid = cuboid(1, [300mm, 200mm, 100mm]))]
#[joint(hinge: revolute(y), cart -> pole, actuated = off)]
#[body(pole, com = [0, 0, 0.5], solid = cylinder(0.1, 5mm, 1))]
struct CartPole;

/// The feedback that balances, and what a state costs under it: `xᵀ·P·x`, which only falls where it may take over.
struct Catch {
    feedback: StateFeedback<f64, 2, 2, 4, 1>,
    cost: SMatrix<f64, 4, 4>,
}

/// Where the feedback takes over, in the units of the cost.
const REGION: f64 = 10.0;
/// How fast energy goes in, in s/kg; and what holds the cart near the middle meanwhile, in 1/s² and 1/s.
const PUMP: f64 = 2.0;
const SPRING: f64 = 2.0;
const DAMPER: f64 = 2.0;
const SECONDS: usize = 10;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let upright = State::rest(SVector::zeros());
    let still = SVector::zeros();
    let measured = (output::joint("slider"), output::joint("hinge"));
    let plant: StateSpace<f64, 4, 1, 2> = CartPole.state_space(&upright.q, &upright.v, &still, &measured)?;
    println!("About the upright pose:\n{plant:.3}");

    // Half a metre, 0.2 rad, 1 m/s, 1 rad/s and 10 N are as bad as each other.
    let weights = Weights::diagonal([4.0, 25.0, 1.0, 1.0], [0.01]);
    let Lqr { gain, cost, poles: closed, .. } = plant.lqr(&weights)?;
    println!(
        "LQR: u = -{:.2?} x, with poles at {:.2?} 1/s.",
        gain.as_slice(),
        closed.map(|pole| pole.re).as_slice()
    );
    let catch = Catch { feedback: StateFeedback::new(upright, still, gain).wrapping([false, true]), cost };

    // It hangs, and has got a nudge.
    let start = State::new(SVector::from([0.0, PI]), SVector::from([0.0, 0.1]));
    let force = |_, state: &State<f64, 2, 2>| {
        let tau = if catch.cost(state) < REGION {
            catch.feedback.torque(&CartPole, state)
        } else {
            SVector::from([swing(state), 0.0])
        };
        control::saturated(&CartPole, &tau).0
    };
    let mut simulation = Simulation::new(&CartPole, start, 1e-3)?.with_input(force);
    let mut seen = Recording::of(&CartPole).with_masses();
    seen.see(&simulation.sample());
    let (mut caught, mut furthest) = (None, 0.0_f64);
    let rail = CartPole::LIMITS[0].upper;
    println!("\n  time, s    cart, m   pole, rad   energy above upright, J");
    for step in 1..=SECONDS * 1000 {
        let sample = simulation.step()?;
        seen.see_under(&sample, force);
        furthest = furthest.max(sample.state.q[0].abs());
        match (caught, catch.cost(&sample.state) < REGION) {
            (None, true) => caught = Some(sample.time),
            (Some(_), false) => return Err(format!("lost again at {:.3} s", sample.time).into()),
            _ => {}
        }
        if step % 1000 == 0 {
            let State { q, .. } = sample.state;
            println!("{:9.1} {:10.4} {:11.5} {:12.4}", sample.time, q[0], q[1], surplus(&sample.state));
        }
    }
    let time = caught.ok_or("not caught: the swing never came into the region of the feedback")?;
    let left = catch.feedback.deviation(&CartPole, simulation.state()).norm();
    println!(
        "Caught at {time:.3} s; {:.1} s later the state is {left:.1e} from the upright one.",
        SECONDS as f64 - time
    );
    println!("The cart went {furthest:.2} m out, on a rail of {rail} m.");
    if furthest > rail {
        return Err("the cart left its rail".into());
    }
    if left > 1e-2 {
        return Err("caught, and not brought to rest".into());
    }

    let set = |poles: SVector<Complex<f64>, 4>| poles.data.0[0].map(|pole| [pole.re, pole.im]);
    let planes =
        Chart::poles(Plane::Continuous).set("alone", set(poles(&plant.a)?)).set("with LQR", set(closed));
    draw(
        || seen.figure("A cart-pole, swung up and caught").with_all(seen.phase("hinge")).with(planes.clone()),
        || seen.film().tracing("pole"),
    )
}

impl Catch {
    fn cost(&self, state: &State<f64, 2, 2>) -> f64 {
        let x: SVector<f64, 4> = self.feedback.deviation(&CartPole, state);
        x.dot(&(self.cost * x))
    }
}

/// The energy of the pole alone, as if the cart stood, less what it has upright at rest.
fn surplus(State { q, v }: &State<f64, 2, 2>) -> f64 {
    let pole = SVector::from([0.0, v[1]]);
    let upright: f64 = CartPole.potential_energy(&SVector::zeros());
    CartPole.total_energy(q, &pole) - upright
}

/// The force that swings.
///
/// The cart is given its acceleration and takes the pole along: `M₂₂·a₂ = −M₂₁·a₁ − h₂`. The pole's energy then changes
/// by `−M₂₁·v₂·a₁`, so `a₁` along `M₂₁·v₂` times the energy that is too much takes that out, and puts in what is missing.
/// The rest of `a₁` keeps the cart near the middle.
///
/// K. Åström, K. Furuta, *Swinging up a pendulum by energy control*, Automatica 36 (2000) 287–295.
fn swing(state: &State<f64, 2, 2>) -> f64 {
    let State { q, v } = state;
    let (m, h) = (CartPole.mass_matrix(q), CartPole.bias_forces(q, v));
    let pump = PUMP * surplus(state) * m[(1, 0)] * v[1] / m[(1, 1)];
    let cart = pump - SPRING * q[0] - DAMPER * v[0];
    let pole = -(m[(1, 0)] * cart + h[1]) / m[(1, 1)];
    CartPole.inverse_dynamics(q, v, &SVector::from([cart, pole]))[0]
}
