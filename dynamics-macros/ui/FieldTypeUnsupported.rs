use dynamics_core::prelude::*;

#[derive(Dynamics)]
#[joint(shoulder: revolute(z), world -> arm)]
#[body(arm, mass = m, com = [l, 0, 0], inertia = diag(i, i, i))]
struct Arm {
    m: f64,
    l: u32,
    i: f64,
}

fn main() {
    let q = SVector::from([0.1]);
    let robot = Arm { m: 1.0, l: 2, i: 0.1 };
    println!("{}", robot.mass_matrix(&q)[(0, 0)]);
}
