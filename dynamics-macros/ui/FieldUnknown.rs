use dynamics_core::prelude::*;

#[derive(Dynamics)]
#[joint(shoulder: revolute(z), world -> arm)]
#[body(arm, mass = m, com = [length, 0, 0], inertia = diag(mm * l^2, i, i))]
struct Arm<T> {
    m: T,
    l: T,
    i: T,
}

fn main() {
    let q = SVector::from([0.1]);
    let robot = Arm { m: 1.0, l: 0.5, i: 0.1 };
    println!("{}", robot.mass_matrix(&q)[(0, 0)]);
}
