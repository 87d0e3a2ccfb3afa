//! A KUKA LBR iiwa 14 from the numbers of its URDF: torques of a motion, the tool's pose, operation counts.
//!
//! `cargo run --example iiwa14`

use dynamics_core::prelude::*;

/// Placements and inertias as in the description of the iiwa14 that comes with Drake (BSD-3-Clause).
///
/// A joint's `at` and `rpy` are a URDF's `<origin>`; `com`, `mass` and `inertia` its `<inertial>`.
#[derive(Dynamics)]
#[joint(joint1: revolute(z), world -> link1, at = [0, 0, 0.1575], limits = [-170deg, 170deg])]
#[body(link1, mass = 5.76, com = [0, -0.03, 0.12], inertia = diag(0.033, 0.0333, 0.0123))]
#[joint(joint2: revolute(z), link1 -> link2, at = [0, 0, 0.2025], rpy = [90deg, 0, 180deg], limits = [-120deg, 120deg])]
#[body(link2, mass = 6.35, com = [0.0003, 0.059, 0.042], inertia = diag(0.0305, 0.0304, 0.011))]
#[joint(joint3: revolute(z), link2 -> link3, at = [0, 0.2045, 0], rpy = [90deg, 0, 180deg], limits = [-170deg, 170deg])]
#[body(link3, mass = 3.5, com = [0, 0.03, 0.13], inertia = diag(0.025, 0.0238, 0.0076))]
#[joint(joint4: revolute(z), link3 -> link4, at = [0, 0, 0.2155], rpy = [90deg, 0, 0], limits = [-120deg, 120deg])]
#[body(link4, mass = 3.5, com = [0, 0.067, 0.034], inertia = diag(0.017, 0.0164, 0.006))]
#[joint(joint5: revolute(z), link4 -> link5, at = [0, 0.1845, 0], rpy = [-90deg, 180deg, 0], limits = [-170deg, 170deg])]
#[body(link5, mass = 3.5, com = [0.0001, 0.021, 0.076], inertia = diag(0.01, 0.0087, 0.00449))]
#[joint(joint6: revolute(z), link5 -> link6, at = [0, 0, 0.2155], rpy = [90deg, 0, 0], limits = [-120deg, 120deg])]
#[body(link6, mass = 1.8, com = [0, 0.0006, 0.0004], inertia = diag(0.0049, 0.0047, 0.0036))]
#[joint(joint7: revolute(z), link6 -> link7, at = [0, 0.081, 0], rpy = [-90deg, 180deg, 0], limits = [-175deg, 175deg])]
#[body(link7, mass = 1.2, com = [0, 0, 0.02], inertia = diag(0.001, 0.001, 0.001))]
#[joint(tool0_joint: fixed, link7 -> tool0, at = [0, 0, 0.045], rpy = [0, -90deg, 0])]
struct Iiwa14;

fn main() {
    let q = SVector::from([0.1, 0.6, -0.2, -1.4, 0.3, 0.9, -0.5]);
    let v = SVector::from([0.5, -0.4, 0.3, 0.6, -0.2, 0.1, 1.0]);
    let a = SVector::from([1.0, 0.5, -1.0, 2.0, 0.0, -0.5, 0.3]);

    let tau = Iiwa14.inverse_dynamics(&q, &v, &a);
    let hold = Iiwa14.gravity_forces(&q);
    println!("joint     q, rad   v, rad/s   a, rad/s²   tau, N m   of it G, N m");
    for (k, name) in Iiwa14::JOINT_NAMES.iter().enumerate() {
        println!("{name} {:9.2} {:10.2} {:11.2} {:10.4} {:14.4}", q[k], v[k], a[k], tau[k], hold[k]);
    }

    // The way back, and the same in single precision: one description serves every scalar.
    let back = Iiwa14.forward_dynamics(&q, &v, &tau);
    println!("\nForward dynamics gives those accelerations back within {:.1e},", (back - a).abs().max());
    let single = Iiwa14.inverse_dynamics(&to_f32(&q), &to_f32(&v), &to_f32(&a));
    println!("and in f32 the torques differ by {:.1e} N m.", (single.map(f64::from) - tau).abs().max());

    let tool = Iiwa14.pose::<Tool0>(&q);
    println!("\nThe tool is at {:.4?} m, and moves with", tool.translation.data.0[0]);
    println!("{:.4?} (m/s, rad/s) in its own axes.", Iiwa14.velocity::<Tool0>(&q, &v).data.0[0]);

    let cost = Iiwa14::COST;
    println!("\nOne call takes");
    println!("  mass_matrix                   {}", cost.mass_matrix);
    println!("  inverse_dynamics              {}", cost.inverse_dynamics);
    println!("  forward_dynamics              {}", cost.forward_dynamics);
    println!("  forward_dynamics_derivatives  {}", cost.forward_dynamics_derivatives);
}

fn to_f32(x: &SVector<f64, 7>) -> SVector<f32, 7> {
    x.map(|entry| entry as f32)
}
