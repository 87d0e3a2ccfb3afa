//! A quadruped on no ground: thrown, with its knees let go, it falls as a whole, and turns as its momentum says.
//!
//! `cargo run --example hyq`, and in pictures `cargo run --example hyq -- --plot hyq.svg --animate hyq.html`

use dynamics_core::prelude::*;
use dynamics_examples::draw;
use dynamics_view::Recording;

/// HyQ from its file, with what the file does not say: the rotors of its knees, and a load on its trunk.
#[derive(Dynamics)]
#[dynamics(urdf = "robots/hyq.urdf", base = free)]
#[joint([lf_kfe_joint, rh_kfe_joint], rotor = 5e-5, gear = 100, damping = 0.2)]
#[joint(strap: fixed, trunk -> load, at = [0, 0, 0.1])]
#[body(load, solid = cuboid(load, [0.3, 0.2, 0.1]))]
struct Hyq<T> {
    load: T,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let hyq = Hyq { load: 8.0 }.prepare();
    println!(
        "{} coordinates, {} speeds, {} inputs",
        HyqPrepared::<f64>::NQ,
        HyqPrepared::<f64>::NV,
        HyqPrepared::<f64>::NU
    );

    let q = hyq.neutral();
    let mut v = SVector::zeros();
    (v[2], v[3], v[11]) = (3.0, 1.0, -4.0);
    let mut flight = Simulation::new(&hyq, State::new(q, v), 1e-3)?;
    let mut seen = Recording::of(&hyq).with_masses();
    println!("   t    height of the centre of mass    angular momentum about it");
    for step in 0..=5 {
        let sample = if step == 0 {
            flight.sample()
        } else {
            seen.watch(flight.steps(100)).last().transpose()?.unwrap_or(flight.sample())
        };
        let State { q, v } = sample.state;
        let (center, momentum) = (hyq.center_of_mass(&q), hyq.centroidal_momentum(&q, &v));
        println!(
            "{:.1} s  {:8.4} m  {:26.6} {:9.6} {:9.6} N·m·s",
            sample.time, center[2], momentum[3], momentum[4], momentum[5]
        );
    }
    draw(|| seen.figure("A quadruped, thrown"), || seen.film())
}
