//! A SCARA by standard Denavit–Hartenberg parameters: pose, Jacobian, and computed-torque control along a line.
//!
//! `cargo run --example scara`

use dynamics_core::prelude::*;

/// An Adept Cobra 600 (dimensions of the maker, masses of the order that such arms have).
///
/// With `dh` a body's frame is at the far end of its link; the joint's variable comes before length and twist.
#[derive(Dynamics)]
#[joint(shoulder: revolute, world -> upper_arm, dh(325mm, 0, 387mm, 0), limits = [-105deg, 105deg])]
#[body(upper_arm, mass = 11.2, com = [-160mm, 0, 10mm], inertia = tensor(0.03, 0, 0.002, 0.12, 0, 0.13))]
#[joint(elbow: revolute, upper_arm -> forearm, dh(275mm, 180deg, 0, 0), limits = [-150deg, 150deg])]
#[body(forearm, mass = 6.8, com = [-140mm, 2mm, -30mm], inertia = tensor(0.015, 0, 0, 0.06, 0.0005, 0.07))]
#[joint(lift: prismatic, forearm -> quill, dh(0, 0, 0, 0), limits = [0, 210mm])]
#[body(quill, mass = 1.6, com = [0, 0, -80mm], inertia = diag(0.012, 0.012, 0.0009))]
#[joint(wrist: revolute, quill -> flange, dh(0, 0, 0, 0), velocity = 20)]
#[body(flange, mass = 0.45, com = [4mm, 0, 20mm], inertia = diag(0.0006, 0.0005, 0.0004))]
#[joint(mount: fixed, flange -> gripper, at = [0, 0, 60mm])]
#[body(gripper, solid = cylinder(payload, 20mm, 40mm))]
struct Cobra600 {
    payload: f64,
}

fn main() -> Result<(), Error> {
    let robot = Cobra600 { payload: 2.0 };
    for (name, limit) in Cobra600::JOINT_NAMES.iter().zip(Cobra600::LIMITS) {
        println!("{name:10} from {:6.3} to {:6.3}", limit.lower, limit.upper);
    }

    let q = SVector::from([0.3, 1.1, 0.1, 0.0]);
    let pose = robot.pose::<Gripper>(&q);
    println!(
        "\nThe gripper at q = {:.1?} is at{:.4}and its Jacobian in world axes is",
        q.data.0[0], pose.translation
    );
    println!("{:.4}", robot.world_jacobian::<Gripper>(&q));
    println!("The motors hold {:.3?} there.", robot.gravity_forces(&q).data.0[0]);

    // All work that depends on the payload alone, done once.
    let prepared = robot.prepare();
    let reference = |t: f64| {
        let (s, c) = f64::sin_cos(2.0 * t);
        let swing = SVector::from([0.5, -0.8, 0.05, 1.0]);
        (q + swing * (1.0 - c), swing * (2.0 * s), swing * (4.0 * c))
    };
    let control = |time: f64, state: &State<f64, 4, 4>| {
        let (q, v, a) = reference(time);
        let wanted = a + (v - state.v) * 20.0 + (q - state.q) * 100.0;
        prepared.inverse_dynamics(&state.q, &state.v, &wanted)
    };

    println!("Computed torque, from a start that is off by 0.1:\n  time, s   largest joint error");
    let start = State::rest(q + SVector::from([0.1, -0.1, 0.0, 0.1]));
    let mut simulation = Simulation::new(&prepared, start, 1e-3)?.with_input(control);
    for _ in 0..6 {
        let sample = simulation.steps(250).last().expect("some steps have a last")?;
        let error = (sample.state.q - reference(sample.time).0).abs().max();
        println!("{:9.2}   {error:.2e}", sample.time);
    }
    Ok(())
}
