use dynamics_core::prelude::*;

#[derive(Dynamics)]
#[joint(theta: revolute(y), world -> arm)]
#[body(arm, com = [0, 0, -0.5], solid = point(2kg))]
#[kinetic(-0.6kg_m2 / 2 * dot(theta)^2)]
struct Pendulum;

fn main() {
    println!("{}", Pendulum.gravity_forces(&SVector::from([0.1]))[0]);
}
