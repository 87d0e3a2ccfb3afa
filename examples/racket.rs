//! A thrown box turns over and over about its middle axis until it comes down; then in space, by three integrators.
//!
//! `cargo run --example racket`

use dynamics_core::prelude::*;
use dynamics_core::simulate::{Event, MomentumMonitor, PlaneCrossing, TurningPoint};

/// A box that nothing holds; its middle moment of inertia is the one about y.
#[derive(Dynamics)]
#[joint(flight: free, world -> parcel)]
#[body(parcel, solid = cuboid(1.2, [25cm, 40cm, 60cm]))]
#[dynamics(gravity = [0, 0, -g])]
struct Thrown {
    g: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A metre up, thrown upwards with a spin about y, and a little about the other axes.
    let place = SVector::from([0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    let start = State::new(place, SVector::from([0.3, 0.0, 9.0, 0.05, 12.0, 0.02]));

    let earth = Thrown { g: 9.81 };
    let mut flight = Adaptive::new(&earth, start, Tolerances::of(1e-10))?;
    let (over, ground) = (TurningPoint { index: 4 }, PlaneCrossing::<Parcel, f64>::down_to(0.0));
    println!("   time, s   height, m");
    let mut flips = 0;
    loop {
        let arrival = flight.advance_until(10.0, &[&over as &dyn Event<_, _, 7, 6>, &ground])?;
        let what = match arrival.events {
            [_, true] => "it is on the ground",
            [true, _] => "the spin about y is over, and goes the other way",
            _ => "it flies",
        };
        let Sample { time, state, .. } = arrival.sample;
        println!("{time:10.6} {:11.6}   {what}", state.q[2]);
        if arrival.events != [true, false] {
            break;
        }
        flips += 1;
    }
    if flips == 0 {
        return Err("it came down without a flip".into());
    }

    println!("\nA minute in space, in steps of 5 ms: the greatest change of");
    println!("  method                energy, J   angular momentum, kg m^2/s");
    let space = Thrown { g: 0.0 };
    let simulation = Simulation::new(&space, start, 5e-3)?;
    account("Runge and Kutta", simulation.clone())?;
    account("variational", simulation.with_integrator(Variational))?;
    Ok(())
}

fn account<I: Integrator>(
    name: &str,
    mut simulation: Simulation<'_, Thrown, f64, 7, 6, I>,
) -> Result<(), Error> {
    let start = simulation.sample();
    let (mut momentum, mut energy) = (MomentumMonitor::new(&start), 0.0_f64);
    for sample in simulation.steps(12_000) {
        let sample = sample?;
        momentum.observe(&sample);
        energy = energy.max((sample.energy().total() - start.energy().total()).abs());
    }
    println!("  {name:20} {energy:10.1e} {:10.1e}", momentum.about_origin());
    Ok(())
}
