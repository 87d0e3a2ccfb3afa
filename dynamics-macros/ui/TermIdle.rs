use dynamics_core::prelude::*;

#[derive(Dynamics)]
#[joint(theta: revolute(y), world -> arm)]
#[body(arm)]
#[joint(r: prismatic(-z), arm -> bob)]
#[body(bob, solid = point(m))]
#[potential(k / 2 * distance(bob, bob)^2)]
struct OnASpring<T> {
    m: T,
    k: T,
}

fn main() {
    let robot = OnASpring { m: 1.0, k: 20.0 };
    println!("{}", robot.gravity_forces(&SVector::from([0.1, 0.5]))[1]);
}
