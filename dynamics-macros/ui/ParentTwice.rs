use dynamics_core::prelude::*;

#[derive(Dynamics)]
#[joint(shoulder: revolute(z), world -> arm)]
#[body(arm, mass = 1.5, com = [0.2, 0, 0], inertia = diag(0.1, 0.1, 0.2))]
#[joint(other: fixed, world -> arm)]
struct Arm;

fn main() {
    let q = SVector::from([0.1]);
    let robot = Arm;
    println!("{}", robot.mass_matrix(&q)[(0, 0)]);
}
