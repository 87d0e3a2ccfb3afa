use dynamics_core::prelude::*;

#[derive(Dynamics)]
#[joint(shoulder: revolute(z), world -> arm)]
#[body(arm, mass = 1.5, com = [0.2, 0, 0], inertia = diag(0.1, 0.1, 0.2))]
#[joint(left: fixed, arm -> tool_0)]
#[joint(right: fixed, arm -> Tool0)]
struct Arm;

fn main() {
    let tip = Arm.pose::<Tool0>(&SVector::from([0.1]));
    println!("{}", tip.translation[0]);
}
