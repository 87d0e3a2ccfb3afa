use dynamics_core::prelude::*;

#[derive(Dynamics)]
#[joint(theta1: revolute(z), world -> column)]
#[body(column, solid = cylinder(m1, 0.1, 0.5))]
#[joint(theta2: revolute(-x), column -> arm, at = [0, 0, 0.5])]
#[body(arm, mass = m2, com = [0, r1, 0], inertia = diag(m2 * r1, 0.1, 0.1))]
struct RoboJudge<T> {
    m1: T,
    m2: T,
    r1: T,
}

fn main() {
    let q = SVector::from([0.1, 0.1]);
    let robot = RoboJudge { m1: 1.0, m2: 0.5, r1: 0.2 };
    println!("{}", robot.mass_matrix(&q)[(0, 0)]);
}
