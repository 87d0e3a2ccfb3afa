//! How long each method takes: `cargo bench -p dynamics-bench`.
//!
//! One line a robot and method: robot, degrees of freedom, `ours`, algorithm by the peers' name, minimum and
//! median nanoseconds a call, over batches that cycle through 256 random states. `peers/race.sh` runs it beside
//! Pinocchio and CasADi. Set `RUSTFLAGS="-C target-cpu=native"` for what the machine can do.
#![allow(clippy::print_stdout, reason = "the table is the product")]

use std::hint::black_box;
use std::time::Instant;

use dynamics_bench::{industrial, models};
use dynamics_core::prelude::*;

const STATES: usize = 256;
const BATCHES: usize = 400;

fn main() {
    let wanted: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let wants = |name: &str| wanted.is_empty() || wanted.iter().any(|wanted| wanted == name);
    if wants("double_pendulum") {
        race("double_pendulum", &industrial::planar_2dof::Planar2Dof);
    }
    if wants("cartpole") {
        race("cartpole", &industrial::reference_cart_pole::ReferenceCartPole);
    }
    if wants("puma560") {
        race("puma560", &industrial::puma560::Puma560);
    }
    if wants("iiwa14") {
        race("iiwa14", &industrial::iiwa14::Iiwa14);
    }
    if wants("hyq") {
        race("hyq", &models::Hyq);
    }
    if wants("chain4") {
        race("chain4", &models::Chain4);
    }
    if wants("chain16") {
        race("chain16", &models::Chain16);
    }
    if wants("chain32") {
        race("chain32", &models::Chain32);
    }
}

/// Coordinates, speeds, and accelerations or forces.
type States<const NQ: usize, const NV: usize> = (SVector<f64, NQ>, SVector<f64, NV>, SVector<f64, NV>);

/// Times every method of a robot.
fn race<R, const NQ: usize, const NV: usize>(name: &str, robot: &R)
where
    R: DynamicsDerivatives<f64, NQ, NV> + Configuration<f64, NQ, NV>,
{
    let mut seed = 2026_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let mut vector = || SVector::<f64, NV>::from_fn(|_, _| random());
    // Where a motion from no rotation leads: quaternions are of unit length there.
    let neutral = robot.neutral();
    let mut configuration = || robot.integrate(&neutral, &vector());
    let configurations: Vec<_> = (0..STATES).map(|_| configuration()).collect();
    let states: Vec<_> = configurations.into_iter().map(|q| (q, vector(), vector())).collect();
    let time = |algorithm: &str, call: &mut dyn FnMut(&States<NQ, NV>)| {
        let mut batches: Vec<f64> = (0..BATCHES)
            .map(|_| {
                let start = Instant::now();
                states.iter().for_each(&mut *call);
                start.elapsed().as_nanos() as f64 / STATES as f64
            })
            .collect();
        batches.sort_by(f64::total_cmp);
        println!("{name}\t{NV}\tours\t{algorithm}\t{:.1}\t{:.1}", batches[0], batches[BATCHES / 2]);
    };
    time("g", &mut |(q, _, _)| _ = black_box(robot.gravity_forces(black_box(q))));
    time("rnea", &mut |(q, v, a)| _ = black_box(robot.inverse_dynamics(black_box(q), v, a)));
    time("nle", &mut |(q, v, _)| _ = black_box(robot.bias_forces(black_box(q), v)));
    time("crba", &mut |(q, _, _)| _ = black_box(robot.mass_matrix(black_box(q))));
    time("cor", &mut |(q, v, _)| _ = black_box(robot.coriolis_matrix(black_box(q), v)));
    time("aba", &mut |(q, v, tau)| _ = black_box(robot.forward_dynamics(black_box(q), v, tau)));
    time("minv", &mut |(q, _, _)| _ = black_box(robot.inverse_mass_matrix(black_box(q))));
    time("M+C+G", &mut |(q, v, _)| _ = black_box(robot.equations_of_motion(black_box(q), v)));
    time("drnea", &mut |(q, v, a)| _ = black_box(robot.inverse_dynamics_derivatives(black_box(q), v, a)));
    time("daba", &mut |(q, v, tau)| _ = black_box(robot.forward_dynamics_derivatives(black_box(q), v, tau)));
}
