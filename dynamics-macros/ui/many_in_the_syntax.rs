use dynamics_core::prelude::*;

#[derive(Dynamics)]
#[dynamics(gravty = [0, 0, -g], snap = perhaps)]
#[joint(theta1: revolute(up), world -> column)]
#[body(column, mass = m, com = [0, 0], inertia = diag(i, i))]
#[joint(theta2: revolute(-x) column -> arm, at = [0, 0, 350mmm])]
#[body(arm, mas = m, com = [0, l, 0], inertia = diag(i, tan(i), i))]
struct Arm<T> {
    m: T,
    l: T,
    i: T,
}

fn main() {
    let q = SVector::from([0.1, 0.1]);
    let robot = Arm { m: 1.0, l: 0.5, i: 0.1 };
    println!("{}", robot.mass_matrix(&q)[(0, 0)]);
}
