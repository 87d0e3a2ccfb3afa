use dynamics_core::prelude::*;

#[derive(Dynamics)]
#[joint(shoulder: revolute(z), world -> arm)]
#[body(arm, solid = cylinder(2kg, -30mm, 400mm))]
struct Arm;

fn main() {
    let q = SVector::from([0.1]);
    let robot = Arm;
    println!("{}", robot.mass_matrix(&q)[(0, 0)]);
}
