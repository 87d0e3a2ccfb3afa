use dynamics_core::prelude::*;

#[derive(Dynamics)]
#[joint(theta1: revolute(z), world -> column, limits = [1, -1])]
#[body(column, mass = m, com = [0, 0, m], inertia = diag(i, i, m * l))]
#[joint(theta2: revolute, colum -> arm, at = [0, 0, length])]
#[body(arm, mass = -2, com = [0, l, 0])]
#[joint(weld: fixed, arm -> tip, at = [0, 2 * l, 0], velocity = 2)]
struct Arm<T> {
    m: T,
    l: T,
    i: T,
}

fn main() {
    let robot = Arm { m: 1.0, l: 0.5, i: 0.1 };
    let (q, v) = (SVector::from([0.1, 0.2]), SVector::from([0.3, 0.4]));
    let torque = robot.prepare().inverse_dynamics(&q, &v, &v) + robot.coriolis_matrix(&q, &v) * v;
    let linear = robot.linearize(&q, &v, &torque);
    let tip: Pose<f64> = robot.pose::<Tip>(&q);
    println!("{} {} {}", torque[0], linear.a[(0, 0)], tip.translation[0]);
    println!("{:?}", Simulation::new(&robot, State { q, v }, 1e-3).map(|_| Arm::<f64>::JOINT_NAMES));
}
