use dynamics_core::prelude::*;

#[derive(Dynamics)]
#[joint(shoulder: revolute(z), world -> arm)]
#[body(arm)]
#[joint(elbow: revolute(z), arm -> hand)]
#[body(hand, com = [0.1, 0, 0], solid = sphere(0.3, 0.02))]
struct Arm;

fn main() {
    let q = SVector::from([0.1, 0.1]);
    let robot = Arm;
    println!("{}", robot.mass_matrix(&q)[(0, 0)]);
}
