use dynamics_core::prelude::*;

#[derive(Dynamics)]
#[joint(shoulder: revolute(z), world -> arm)]
#[body(arm, mass = 1, inertia = tensor(0.1, 0.02, 0.01, 0.02, 0.1, 0.03))]
struct Arm;

fn main() {
    let q = SVector::from([0.1]);
    let robot = Arm;
    println!("{}", robot.mass_matrix(&q)[(0, 0)]);
}
