use dynamics_core::prelude::*;

#[derive(Dynamics)]
#[joint(shoulder: revolute(z), world -> arm)]
#[body(arm, mass = 1.5, com = [0.2, 0, 0], inertia = diag(0.1, 0.1, 0.2))]
enum Arm {
    Left,
    Right,
}

fn main() {
    for arm in [Arm::Left, Arm::Right] {
        println!("{}", arm.mass_matrix(&SVector::from([0.1]))[(0, 0)]);
    }
}
