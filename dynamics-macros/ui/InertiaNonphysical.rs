use dynamics_core::prelude::*;

#[derive(Dynamics)]
#[joint(shoulder: revolute(z), world -> arm)]
#[body(arm, mass = 4.8, com = [0, -0.07, 0.014], inertia = diag(0.066, 0.0125, 0.086))]
#[joint(elbow: revolute(x), arm -> hand)]
#[body(hand, mass = 0, inertia = diag(0.35, 0, 0))]
struct Arm;

fn main() {
    let q = SVector::from([0.1, 0.1]);
    let robot = Arm;
    println!("{}", robot.mass_matrix(&q)[(0, 0)]);
}
