//! A bob on a spring that bounces, then swings, then bounces again: a spring is a term of `V`, and no joint.
//!
//! `cargo run --example elastic_pendulum`, and in pictures `cargo run --example elastic_pendulum -- --plot elastic_pendulum.svg --animate elastic_pendulum.html`

use dynamics_core::prelude::*;
use dynamics_examples::draw;
use dynamics_view::Recording;

/// A bob that turns about the world's origin, and slides away from it; a spring and a damper lead from there to the bob.
#[derive(Dynamics)]
#[joint(theta: revolute(y), world -> arm)]
#[body(arm)]
#[joint(r: prismatic(-z), arm -> bob)]
#[body(bob, solid = point(m))]
#[potential(k / 2 * (distance(world, bob) - l)^2)]
#[dissipation(c / 2 * dot(distance(world, bob))^2)]
struct OnASpring {
    m: f64,
    k: f64,
    l: f64,
    c: f64,
}

/// The same without a tree, as a textbook has it.
#[derive(Dynamics)]
#[coordinate(theta: angle)]
#[coordinate(r: length)]
#[kinetic(m / 2 * (dot(r)^2 + r^2 * dot(theta)^2))]
#[potential(k / 2 * (r - l)^2 - m * g * r * cos(theta))]
#[dissipation(c / 2 * dot(r)^2)]
struct OfTheTextbook {
    m: f64,
    k: f64,
    l: f64,
    c: f64,
    g: f64,
}

const G: f64 = 9.81;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Where it hangs at rest, it would swing at √(g/r₀); the spring is such that it bounces at twice of this.
    let (m, hanging) = (0.5, 0.5);
    let k = 4.0 * m * G / hanging;
    let (l, c) = (hanging - m * G / k, 0.0);
    let pendulum = OnASpring { m, k, l, c };

    let (q, v) = (SVector::from([0.4, 0.6]), SVector::from([1.0, -0.5]));
    let textbook = OfTheTextbook { m, k, l, c, g: G };
    let (found, expected) = (pendulum.bias_forces(&q, &v), textbook.bias_forces(&q, &v));
    println!("C v + G is {:.6}, {:.6}, by a tree and a spring,", found[0], found[1]);
    println!("and        {:.6}, {:.6}, by the textbook's Lagrangian.", expected[0], expected[1]);
    assert!((found - expected).norm() < 1e-12, "both are one robot");

    // Pulled down by seven centimetres, and a fifth of a degree aside: each bounce makes a swing a little wider.
    let start = State::rest(SVector::from([0.2_f64.to_radians(), hanging + 0.07]));
    let mut simulation = Simulation::new(&pendulum, start, 1e-3)?;
    let mut seen = Recording::of(&pendulum).with_masses();
    let at_rest = pendulum.potential_energy(&SVector::from([0.0, hanging]));
    let energy = |sample: &Sample<'_, _, f64, 2, 2>| sample.energy().total() - at_rest;
    let before = energy(&simulation.sample());
    println!("\n  time, s   bounce, J    swing, J");
    let (mut widest, mut last) = (0.0_f64, before);
    for _ in 0..30 {
        let sample = seen.watch(simulation.steps(1000)).last().expect("a thousand steps have a last")?;
        let (q, v) = (sample.state.q, sample.state.v);
        let swing = m * q[1] * (q[1] * v[0] * v[0] / 2.0 + G * (1.0 - q[0].cos()));
        last = energy(&sample);
        widest = widest.max(swing / last);
        println!("{:9.1} {:11.4} {:11.4}", sample.time, last - swing, swing);
    }
    println!(
        "At its widest the swing had {:.0} % of the energy, which changed by {:.0e} J.",
        100.0 * widest,
        last - before
    );
    assert!(
        widest > 0.8 && (last - before).abs() < 1e-6,
        "the energy goes from the spring to the swing, and stays"
    );

    draw(|| seen.figure("A pendulum on a spring").with_all(seen.phase("r")), || seen.film())
}
