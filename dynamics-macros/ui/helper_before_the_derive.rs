use dynamics_core::prelude::*;

#[joint(shoulder: revolute(z), world -> arm)]
#[body(arm, mass = 1.5, com = [0.2, 0, 0], inertia = diag(0.1, 0.1, 0.2))]
#[derive(Dynamics)]
struct Arm;

fn main() {
    println!("{}", Arm.mass_matrix(&SVector::from([0.1]))[(0, 0)]);
}
