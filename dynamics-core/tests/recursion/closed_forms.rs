//! Robots whose equations stand in textbooks.

use dynamics_core::__private::recursion::{Drive, Friction, Joint, Link, Passive, Tree};
use dynamics_core::nalgebra::{Matrix3, UnitQuaternion, Vector3};
use dynamics_core::prelude::*;

use super::robots::{AXES, AddPoint, INERT, bare, by_rows, drive, massless, rows};
use super::{TOLERANCE, close, close_numbers};
use crate::common::{DoublePendulum, G, Pendulum, Tool0};

/// z along the world's x, −y downwards.
const HANGING: [[f64; 3]; 3] = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// Point masses on massless rods about the world's x axis, hanging along −z.
fn pendulums<const N: usize>(m: f64, l: f64) -> Tree<f64, N, N, N> {
    let links = core::array::from_fn(|k| Link {
        rotation: if k == 0 { HANGING } else { AXES },
        position: if k == 0 { [0.0; 3] } else { [0.0, -l, 0.0] },
        ..bare(k.checked_sub(1), Joint::Revolute(drive(k), INERT))
    });
    let mut tree =
        Tree { links, masses: massless(), base_mass: 0.0, base_first: [0.0; 3], gravity: [0.0, 0.0, -G] };
    (0..N).for_each(|k| tree.add_point(Some(k), m, Vector3::new(0.0, -l, 0.0)));
    tree
}

#[test]
fn agrees_with_the_pendulum_of_the_textbook() {
    let (m, l) = (0.7, 1.3);
    let (tree, pendulum) = (pendulums::<1>(m, l), Pendulum { m, l, damping: 0.0 });
    let ([q, v, tau], t) = ([0.9, -2.0, 0.4].map(|x| SVector::from([x])), TOLERANCE);
    close(&tree.mass_matrix(&q), &pendulum.mass_matrix(&q), t);
    close(&tree.coriolis_matrix(&q, &v), &pendulum.coriolis_matrix(&q, &v), t);
    close(&tree.gravity_forces(&q), &pendulum.gravity_forces(&q), t);
    close(&tree.forward_dynamics(&q, &v, &tau), &pendulum.forward_dynamics(&q, &v, &tau), t);
    close_numbers(tree.lagrangian(&q, &v), pendulum.lagrangian(&q, &v), t);
}

#[test]
fn agrees_with_the_double_pendulum_of_the_textbook() {
    let (tree, robot, t) = (pendulums::<2>(1.0, 1.0), DoublePendulum, TOLERANCE);
    let [q, v, a] = [[0.9, -0.5], [1.7, -2.0], [0.3, 4.0]].map(SVector::from);
    close(&tree.mass_matrix(&q), &robot.mass_matrix(&q), t);
    close(&tree.coriolis_matrix(&q, &v), &robot.coriolis_matrix(&q, &v), t);
    close(&tree.bias_forces(&q, &v), &robot.bias_forces(&q, &v), t);
    close(&tree.forward_dynamics(&q, &v, &a), &robot.forward_dynamics(&q, &v, &a), t);
    let (own, theirs) =
        (tree.inverse_dynamics_derivatives(&q, &v, &a), robot.inverse_dynamics_derivatives(&q, &v, &a));
    close(&own.dtau_dq, &theirs.dtau_dq, t);
    close(&own.dtau_dv, &theirs.dtau_dv, t);
    let (own, theirs) =
        (tree.forward_dynamics_derivatives(&q, &v, &a), robot.forward_dynamics_derivatives(&q, &v, &a));
    close(&own.da_dq, &theirs.da_dq, t);
    close(&own.da_dv, &theirs.da_dv, t);

    let (link, rotation, translation) = (Some(1), HANGING, [0.0, -1.0, 0.0]);
    let rotation = rows(&by_rows(rotation).transpose());
    let (own, theirs) =
        (tree.pose(link, rotation, translation, &q), <Tool0 as Frame<_, f64, 2, 2>>::pose(&robot, &q));
    close(&own.rotation, &theirs.rotation, t);
    close(&own.translation, &theirs.translation, t);
    close(&tree.jacobian(link, rotation, translation, &q), &Tool0::jacobian(&robot, &q), t);
    close(&tree.world_jacobian(link, rotation, translation, &q), &Tool0::world_jacobian(&robot, &q), t);
}

// One body on a joint of every kind.

const MASS: f64 = 1.7;
const CENTER: [f64; 3] = [0.2, -0.1, 0.4];

/// Three point masses on the last of the links, which has no symmetry; gravity along −z.
fn body<const NL: usize, const NQ: usize, const NV: usize>(
    joints: [Joint<f64>; NL],
) -> Tree<f64, NL, NQ, NV> {
    let links = core::array::from_fn(|k| bare(k.checked_sub(1), joints[k]));
    let mut tree =
        Tree { links, masses: massless(), base_mass: 0.0, base_first: [0.0; 3], gravity: [0.0, 0.0, -G] };
    let arms = [[0.5, 0.1, -0.2], [-0.3, 0.6, 0.1], [-0.2, -0.7, 0.1]].map(Vector3::from);
    for arm in arms {
        tree.add_point(Some(NL - 1), MASS / 3.0, Vector3::from(CENTER) + arm);
    }
    tree
}

/// Its inertia about the origin of its link.
fn inertia<const NL: usize, const NQ: usize, const NV: usize>(tree: &Tree<f64, NL, NQ, NV>) -> Matrix3<f64> {
    let [xx, yy, zz, xy, xz, yz] = tree.masses.second.map(|x| x[NL - 1]);
    Matrix3::new(yy + zz, -xy, -xz, -xy, xx + zz, -yz, -xz, -yz, xx + yy)
}

/// Coordinates of a turned body, and the same as a rotation.
fn turned() -> ([f64; 4], Matrix3<f64>) {
    let rotation = UnitQuaternion::from_euler_angles(0.4, -1.2, 2.0);
    (rotation.coords.into(), rotation.to_rotation_matrix().into_inner())
}

/// Euler's equations, and Levi-Civita's matrix for them.
#[test]
fn a_body_on_a_ball_joint_turns_as_euler_says() {
    let tree = body::<1, 4, 3>([Joint::Ball { q: 0, v: 0 }]);
    let (inertia, (q, rotation)) = (inertia(&tree), turned());
    let (q, w, a) = (q.into(), Vector3::new(1.0, -2.0, 0.7), Vector3::new(0.3, 0.9, -1.4));
    let (turning, spin) = (w.cross_matrix(), (inertia * w).cross_matrix());
    let weight = rotation.transpose() * Vector3::new(0.0, 0.0, -MASS * G);
    let gravity_forces = -Vector3::from(CENTER).cross(&weight);
    let bias = w.cross(&(inertia * w)) + gravity_forces;
    close(&tree.mass_matrix(&q), &inertia, TOLERANCE);
    close(&tree.coriolis_matrix(&q, &w), &((turning * inertia + inertia * turning - spin) * 0.5), TOLERANCE);
    close(&tree.gravity_forces(&q), &gravity_forces, TOLERANCE);
    close(&tree.bias_forces(&q, &w), &bias, TOLERANCE);
    close(&tree.forward_dynamics(&q, &w, &(inertia * a + bias)), &a, TOLERANCE);
    let derivatives = tree.inverse_dynamics_derivatives(&q, &w, &a);
    close(&derivatives.dtau_dv, &(turning * inertia - spin), TOLERANCE);
    let lever = Vector3::from(CENTER).cross_matrix();
    close(&derivatives.dtau_dq, &(-lever * weight.cross_matrix()), TOLERANCE);
}

/// Newton and Euler in the axes of the body, about a point that is not its centre.
#[test]
fn a_free_body_moves_as_newton_and_euler_say() {
    let tree = body::<1, 7, 6>([Joint::Free { q: 0, v: 0 }]);
    let (inertia, ([x, y, z, w], rotation)) = (inertia(&tree), turned());
    let q = SVector::from([3.0, -1.0, 0.5, x, y, z, w]);
    let (v, w) = (Vector3::new(0.6, 1.1, -0.8), Vector3::new(1.0, -2.0, 0.7));
    let (center, identity) = (Vector3::from(CENTER), Matrix3::identity());
    let lever = center.cross_matrix() * MASS;
    let mut mass_matrix = SMatrix::<f64, 6, 6>::zeros();
    mass_matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&(identity * MASS));
    mass_matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&-lever);
    mass_matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&lever);
    mass_matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&inertia);
    let lift = rotation.transpose() * Vector3::new(0.0, 0.0, MASS * G);
    let turning = w.cross(&v);
    let bias_force = (turning + w.cross(&w.cross(&center))) * MASS + lift;
    let bias_moment = lever * turning + w.cross(&(inertia * w)) + center.cross(&lift);

    let stacked = |x: Vector3<f64>, y: Vector3<f64>| {
        SVector::<f64, 6>::from_fn(|i, _| if i < 3 { x[i] } else { y[i - 3] })
    };
    let (twist, bias) = (stacked(v, w), stacked(bias_force, bias_moment));
    close(&tree.mass_matrix(&q), &mass_matrix, TOLERANCE);
    close(&tree.bias_forces(&q, &twist), &bias, TOLERANCE);
    let fall = rotation.transpose() * Vector3::new(0.0, 0.0, -G);
    let a = tree.forward_dynamics(&q, &stacked(v, Vector3::zeros()), &SVector::zeros());
    close(&a, &stacked(fall, Vector3::zeros()), TOLERANCE);

    let momentum = rotation * (v + w.cross(&center)) * MASS;
    let about_center = inertia + Matrix3::from(center.cross_matrix() * lever);
    close(&tree.center_of_mass(&q), &(Vector3::new(3.0, -1.0, 0.5) + rotation * center), TOLERANCE);
    let expected = stacked(momentum, rotation * about_center * w);
    close(&tree.centroidal_momentum(&q, &twist), &expected, TOLERANCE);
}

/// A shaft that turns and slides along the vertical: a massless link stands between its two joints.
#[test]
fn a_cylindrical_joint_is_two_joints() {
    let tree = body::<2, 2, 2>([Joint::Revolute(drive(0), INERT), Joint::Prismatic(drive(1), INERT)]);
    let about_axis = inertia(&tree)[(2, 2)];
    let [q, v, tau] = [[0.7, 0.3], [-2.0, 1.5], [0.4, 3.0]].map(SVector::from);
    close(&tree.mass_matrix(&q), &SMatrix::from_diagonal(&[about_axis, MASS].into()), TOLERANCE);
    close(&tree.bias_forces(&q, &v), &[0.0, MASS * G].into(), TOLERANCE);
    let a = [0.4 / about_axis, 3.0 / MASS - G].into();
    close(&tree.forward_dynamics(&q, &v, &tau), &a, TOLERANCE);
}

/// A nut on a screw, vertical: it slides by its pitch while it turns, and weighs on the thread.
#[test]
fn a_helical_joint_is_two_joints_of_one_coordinate() {
    const PITCH: f64 = 0.03;
    const ROTOR: f64 = 0.2;
    let sliding = Drive { ratio: PITCH, ..drive(0) };
    let damped = Passive { armature: ROTOR, damping: 0.6, ..INERT };
    let tree = body::<2, 1, 1>([Joint::Revolute(drive(0), damped), Joint::Prismatic(sliding, INERT)]);
    let mass = inertia(&tree)[(2, 2)] + MASS * PITCH * PITCH + ROTOR;
    let [q, v, tau] = [0.7, -2.0, 0.4].map(|x| SVector::from([x]));
    let weight = MASS * G * PITCH;
    close(&tree.mass_matrix(&q), &SMatrix::from([[mass]]), TOLERANCE);
    close(&tree.inverse_mass_matrix(&q), &SMatrix::from([[1.0 / mass]]), TOLERANCE);
    close(&tree.gravity_forces(&q), &SVector::from([weight]), TOLERANCE);
    let a = (0.4 + 0.6 * 2.0 - weight) / mass;
    close(&tree.forward_dynamics(&q, &v, &tau), &SVector::from([a]), TOLERANCE);
    let ForwardDynamicsDerivatives { da_dq, da_dv, da_dtau } =
        tree.forward_dynamics_derivatives(&q, &v, &tau);
    close(&da_dq, &SMatrix::zeros(), TOLERANCE);
    close(&da_dv, &SMatrix::from([[-0.6 / mass]]), TOLERANCE);
    close(&da_dtau, &SMatrix::from([[1.0 / mass]]), TOLERANCE);
}

/// A mass on a spring with friction, through a gear: at rest friction is nothing, and never not a number.
#[test]
fn a_geared_spring_pulls_by_its_ratio() {
    let (ratio, offset, stiffness, rest) = (3.0, 0.1, 40.0, 0.25);
    let friction = Some(Friction { force: 2.0, speed: 0.05 });
    let sprung = Passive { stiffness, rest, friction, ..INERT };
    let tree = body::<1, 1, 1>([Joint::Prismatic(Drive { ratio, offset, ..drive(0) }, sprung)]);
    let (q, still) = (SVector::from([0.2]), SVector::from([0.0]));
    let stretch = ratio * 0.2 + offset - rest;
    close(&tree.mass_matrix(&q), &SMatrix::from([[ratio * ratio * MASS]]), TOLERANCE);
    close(&tree.passive_forces(&q, &still), &[ratio * stiffness * stretch].into(), TOLERANCE);
    close_numbers(tree.elastic_energy(&q), 0.5 * stiffness * stretch * stretch, TOLERANCE);
    let derivatives = tree.inverse_dynamics_derivatives(&q, &still, &still);
    close(&derivatives.dtau_dq, &SMatrix::from([[ratio * ratio * stiffness]]), TOLERANCE);
    close(&derivatives.dtau_dv, &SMatrix::from([[ratio * ratio * 2.0 / 0.05]]), TOLERANCE);
}
