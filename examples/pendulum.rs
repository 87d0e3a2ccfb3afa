//! A five-minute introduction: a pendulum, its equations against the textbook's, and ten seconds of motion.
//!
//! `cargo run --example pendulum`, and in pictures `cargo run --example pendulum -- --plot pendulum.svg --animate pendulum.html`

use dynamics_core::prelude::*;
use dynamics_examples::draw;
use dynamics_view::Recording;

/// A bob of mass `m` on a massless rod of length `l`, turning about the world's y axis.
///
/// Literals are folded into the code; fields, as `m` and `l`, are given at run time.
#[derive(Dynamics)]
#[joint(theta: revolute(y), world -> bob)]
#[body(bob, com = [0, 0, -l], solid = point(m))]
struct Pendulum {
    m: f64,
    l: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pendulum = Pendulum { m: 2.0, l: 0.5 };
    let Pendulum { m, l } = pendulum;
    let (theta, omega, g) = (0.8_f64, 1.5, 9.81);
    let (q, v) = (SVector::from([theta]), SVector::from([omega]));

    // Each term of M·a + C·v + G = τ is a method.
    println!("The equation of motion at theta = {theta} rad, beside the textbook:");
    row("M = m l^2", pendulum.mass_matrix(&q)[0], m * l * l);
    row("G = m g l sin(theta)", pendulum.gravity_forces(&q)[0], m * g * l * theta.sin());
    row("T = m l^2 omega^2 / 2", pendulum.kinetic_energy(&q, &v), m * l * l * omega * omega / 2.0);
    row("V = -m g l cos(theta)", pendulum.potential_energy(&q), -m * g * l * theta.cos());

    // Inverse dynamics: the torque for an acceleration. Forward dynamics: the way back.
    let a = SVector::from([3.0]);
    let tau = pendulum.inverse_dynamics(&q, &v, &a);
    row("tau = M a + C v + G", tau[0], m * l * l * a[0] + m * g * l * theta.sin());
    row("a from that tau", pendulum.forward_dynamics(&q, &v, &tau)[0], a[0]);

    // Every body is a frame, and a type: a misspelt name does not compile.
    let bob = pendulum.pose::<Bob>(&q).transform_point(&SVector::from([0.0, 0.0, -l]));
    println!("The bob is at x = {:.4} m, z = {:.4} m.", bob[0], bob[2]);

    // Released at rest, then in steps of a millisecond by the method of Runge and Kutta.
    let mut simulation = Simulation::new(&pendulum, State::rest(q), 1e-3)?;
    let mut seen = Recording::of(&pendulum).with_masses();
    seen.see(&simulation.sample());
    let before = simulation.sample().energy().total();
    println!("\nReleased at {theta} rad:\n  time, s   theta, rad   energy, J");
    for _ in 0..10 {
        let sample = seen.watch(simulation.steps(1000)).last().expect("a thousand steps have a last")?;
        println!("{:9.1} {:12.6} {:11.6}", sample.time, sample.state.q[0], sample.energy().total());
    }
    let after = simulation.sample().energy().total();
    println!("The energy has changed by {:.1e} J.", after - before);
    draw(|| seen.figure("A pendulum").with_all(seen.phase("theta")), || seen.film())
}

fn row(what: &str, derived: f64, textbook: f64) {
    println!("  {what:24} {derived:10.6}   {textbook:10.6}");
}
