use dynamics_core::prelude::*;

#[derive(Dynamics)]
#[joint(shoulder: revolute(z), world -> arm)]
#[body(arm, mass = 1.5, com = [0.2, 0, 0], inertia = diag(0.1, 0.1, 0.2))]
#[joint(weld: fixed, arm -> tip)]
struct Arm;

fn main() {
    println!("{}", Arm.pose::<Tipp>(&SVector::from([0.1])).translation[0]);
}
