//! A cart-pole, linearised at the upright pose: A and B, and a feedback that balances it.
//!
//! `cargo run --example cart_pole`, and in pictures `cargo run --example cart_pole -- --plot cart_pole.svg --animate cart_pole.html`

use dynamics_core::linear::place_poles;
use dynamics_core::nalgebra::Complex;
use dynamics_core::prelude::*;
use dynamics_examples::draw;
use dynamics_view::{Chart, Figure, Plane, Recording};

/// A cart of 1 kg that slides along x, and on it a rod of 0.1 kg and 1 m, upright at zero.
///
/// A unit struct: every number is in the description, and is folded into the code.
#[derive(Dynamics)]
#[joint(slider: prismatic(x), world -> cart, limits = [-2, 2])]
#[body(cart, solid = cuboid(1, [300mm, 200mm, 100mm]))]
#[joint(hinge: revolute(y), cart -> pole)]
#[body(pole, com = [0, 0, 0.5], solid = cylinder(0.1, 5mm, 1))]
struct CartPole;

/// The force on the cart `u = -K x` that puts all poles of the linear model between -2 and -3.5 1/s.
const POLES: [f64; 4] = [-2.0, -2.5, -3.0, -3.5];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // x = (slider, hinge, their speeds); the two inputs are the force on the cart and the torque at the hinge.
    let (upright, rest) = (SVector::from([0.0, 0.0]), SVector::zeros());
    let Linearization { a, b, drift } = CartPole.linearize(&upright, &rest, &SVector::zeros());
    println!("About the upright pose, x' = A x + B u, with\nA ={:.4}B ={b:.4}", a.map(|entry| entry + 0.0));
    println!("The drift there is {:.1e}: an equilibrium.", f64::max(drift.max(), -drift.min()));
    let slope = a[(3, 1)];
    println!("Left alone it falls as exp({:.3} t).\n", slope.sqrt());

    let desired = POLES.map(|pole| Complex::new(pole, 0.0));
    let gain = place_poles(&a, &b.column(0).into_owned(), &desired)?.gain;
    println!("Gains for poles at {POLES:?} 1/s: {:.3?}", gain.as_slice());

    // The whole nonlinear robot under that feedback, from 0.3 rad.
    let start = State::rest(SVector::from([0.0, 0.3]));
    let force = |_, state: &State<f64, 2, 2>| {
        let x = SVector::from([state.q[0], state.q[1], state.v[0], state.v[1]]);
        SVector::from([-(gain * x).x, 0.0])
    };
    let mut simulation = Simulation::new(&CartPole, start, 1e-3)?.with_input(force);
    let mut seen = Recording::of(&CartPole).with_masses();
    seen.see(&simulation.sample());
    println!("  time, s    cart, m   pole, rad");
    for _ in 0..8 {
        let sample =
            seen.watch_under(simulation.steps(1000), force).last().expect("a thousand steps have a last")?;
        println!("{:9.1} {:10.5} {:11.6}", sample.time, sample.state.q[0], sample.state.q[1]);
    }

    let poles = |a: SMatrix<f64, 4, 4>| a.complex_eigenvalues().data.0[0].map(|pole| [pole.re, pole.im]);
    let closed = a - b.column(0) * gain;
    let planes = Chart::poles(Plane::Continuous).set("alone", poles(a)).set("with feedback", poles(closed));
    draw(
        || Figure::new("A cart-pole that balances").with_all(seen.charts()).with(planes.clone()),
        || seen.film().tracing("pole"),
    )
}
