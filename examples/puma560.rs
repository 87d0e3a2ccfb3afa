//! The PUMA 560 in one description: ten seconds of free swing, its linearisation, and what each method costs.
//!
//! `cargo run --example puma560`

use dynamics_core::prelude::*;

/// Modified Denavit–Hartenberg parameters and inertias as measured by B. Armstrong, O. Khatib and J. Burdick,
/// *The explicit dynamic model and inertial parameters of the PUMA 560 arm*, 1986; rotors and friction left out.
///
/// Of link 1 they give only the moment about its axis, the one entry that moves, and of link 3 moments that no body
/// can have. Both are errors unless they are allowed.
#[derive(Dynamics)]
#[joint(joint1: revolute, world -> link1, mdh(0, 0, 0, 0), limits = [-160deg, 160deg])]
#[body(link1, mass = 0, inertia = diag(0, 0, 0.35), allow(nonphysical_inertia))]
#[joint(joint2: revolute, link1 -> link2, mdh(0, -90deg, 0.2435, 0), limits = [-225deg, 45deg])]
#[body(link2, mass = 17.4, com = [0.068, 0.006, -0.016], inertia = diag(0.13, 0.524, 0.539))]
#[joint(joint3: revolute, link2 -> link3, mdh(0.4318, 0, -0.0934, 0), limits = [-45deg, 225deg])]
#[body(
    link3, mass = 4.8, com = [0, -0.07, 0.014], inertia = diag(0.066, 0.0125, 0.086), allow(nonphysical_inertia)
)]
#[joint(joint4: revolute, link3 -> link4, mdh(-0.0203, 90deg, 0.4331, 0), limits = [-110deg, 170deg])]
#[body(link4, mass = 0.82, com = [0, 0, -0.019], inertia = diag(1.8e-3, 1.8e-3, 1.3e-3))]
#[joint(joint5: revolute, link4 -> link5, mdh(0, -90deg, 0, 0), limits = [-100deg, 100deg])]
#[body(link5, mass = 0.34, inertia = diag(0.3e-3, 0.3e-3, 0.4e-3))]
#[joint(joint6: revolute, link5 -> link6, mdh(0, 90deg, 0, 0), limits = [-266deg, 266deg])]
#[body(link6, mass = 0.09, com = [0, 0, 0.032], inertia = diag(0.15e-3, 0.15e-3, 0.04e-3))]
struct Puma560;

const SECONDS: usize = 10;
const STEPS_PER_SECOND: usize = 10_000;

fn main() -> Result<(), Error> {
    swing()?;
    linearisation();
    costs();
    Ok(())
}

/// From rest, with no torque: nothing but M, C and G, and what the integrator loses.
fn swing() -> Result<(), Error> {
    let start = State::rest(SVector::from([0.0, 0.3, 0.4, 0.5, 0.6, 0.7]));
    let mut simulation = Simulation::new(&Puma560, start, 1.0 / STEPS_PER_SECOND as f64)?;
    let before = simulation.sample().energy().total();
    println!("{SECONDS} seconds of free swing in steps of {} s:", 1.0 / STEPS_PER_SECOND as f64);
    println!("  time, s   kinetic, J   potential, J   drift, J");
    for _ in 0..SECONDS {
        let sample = simulation.steps(STEPS_PER_SECOND).last().expect("a second has steps")?;
        let (energy, time) = (sample.energy(), sample.time);
        let drift = energy.total() - before;
        println!("{time:9.1} {:12.4} {:14.4} {drift:10.1e}", energy.kinetic, energy.potential);
    }
    Ok(())
}

/// `x' = A x + B u` about a pose that the motors hold.
fn linearisation() {
    let pose = SVector::from([0.0, -0.8, 0.5, 0.0, 0.6, 0.0]);
    let hold = Puma560.gravity_forces(&pose);
    let still = SVector::zeros();
    let Linearization { a, b, drift } = Puma560.linearize(&pose, &still, &hold);
    println!("\nAbout q = {:?}, held by tau = {:?} N m:", pose.data.0[0], rounded(hold).data.0[0]);
    println!("A = [0 1; A21 A22] with A21, 1/s²,{:.3}", rounded(a.fixed_view::<6, 6>(6, 0).into_owned()));
    println!(
        "and A22, 1/s, zero at rest: the largest entry is {:.0e}.",
        a.fixed_view::<6, 6>(6, 6).abs().max()
    );
    println!("B = [0; B2] with B2, 1/(kg m²),{:.3}", rounded(b.fixed_view::<6, 6>(6, 0).into_owned()));
    println!("There x' = 0 remains by {:.1e}, the largest entry of x'.", drift.abs().max());
}

/// To three places, and without the sign of zero.
fn rounded<const C: usize>(matrix: SMatrix<f64, 6, C>) -> SMatrix<f64, 6, C> {
    matrix.map(|entry| (entry * 1e3).round() / 1e3 + 0.0)
}

/// The operations, as the compiler counted them.
fn costs() {
    let cost = Puma560::COST;
    println!("\nWhat one call takes:");
    for (method, cost) in [
        ("mass_matrix", cost.mass_matrix),
        ("coriolis_matrix", cost.coriolis_matrix),
        ("gravity_forces", cost.gravity_forces),
        ("bias_forces", cost.bias_forces),
        ("equations_of_motion", cost.equations_of_motion),
        ("inverse_dynamics", cost.inverse_dynamics),
        ("forward_dynamics", cost.forward_dynamics),
        ("kinetic_energy", cost.kinetic_energy),
        ("potential_energy", cost.potential_energy),
        ("lagrangian", cost.lagrangian),
        ("inverse_dynamics_derivatives", cost.inverse_dynamics_derivatives),
        ("forward_dynamics_derivatives", cost.forward_dynamics_derivatives),
    ] {
        println!("  {method:28} {cost}");
    }
}
