//! Frames: their poses, velocities and accelerations, and the wrenches that act on them.

use dynamics_tests::close::{DIFFERENCES, ROUNDING};
use dynamics_tests::{Axes, Dual, Matrix, Random, State, Vector, assert_close};

use crate::{difference, for_each_dual_state, for_each_state, moving, tangents};

#[test]
fn poses_are_rigid() {
    for_each_state(|name, robot, State { q, .. }| {
        for (k, frame) in robot.frame_names().iter().enumerate() {
            let (R, _) = robot.pose(k, q);
            let identity = Matrix::identity(3, 3);
            assert_close!(
                (R.transpose() * &R).as_slice(),
                identity.as_slice(),
                ROUNDING,
                "{name}: RᵀR of {frame}"
            );
            assert!((R.determinant() - 1.0).abs() <= ROUNDING, "{name}: {frame} is mirrored");
        }
    });
}

/// `J·v` is the velocity of the frame: `Rᵀṗ` and the vector of `RᵀṘ` in its own axes, `ṗ` and that of `ṘRᵀ` in the
/// world's.
#[test]
fn velocities_are_the_rates_of_poses() {
    for_each_dual_state(|entry, robot, dual, State { q, v, .. }| {
        for (k, frame) in entry.body_names.iter().enumerate() {
            let (rotation, translation) = dual.pose(k, &moving(entry, q, v));
            let (R, R_dot) = (rotation.map(|x| x.value), tangents(&rotation));
            let p_dot = translation.map(|x| x.tangent);
            let R_T = R.transpose();
            let own = [(&R_T * &p_dot).as_slice(), &axis_of(&(&R_T * &R_dot))].concat();
            let world = [p_dot.as_slice(), &axis_of(&(R_dot * R_T))].concat();
            for (axes, expected) in [(Axes::Own, own), (Axes::World, world)] {
                let by_jacobian = robot.jacobian(k, axes, q) * v;
                for found in [by_jacobian, robot.velocity(k, axes, q, v)] {
                    let (size, name) = (v.amax(), entry.name);
                    let found = found.as_slice();
                    assert_close!(found, expected, ROUNDING, floor = size, "{name}: {axes:?} V of {frame}");
                }
            }
        }
    });
}

/// `ω` of `ω̂`.
fn axis_of(skew: &Matrix) -> [f64; 3] {
    [skew[(2, 1)], skew[(0, 2)], skew[(1, 0)]]
}

/// The acceleration is the rate of the velocity's components, in either axes.
#[test]
fn accelerations_are_the_rates_of_velocities() {
    for_each_dual_state(|entry, robot, dual, State { q, v, a, .. }| {
        for (k, frame) in entry.body_names.iter().enumerate() {
            for axes in Axes::BOTH {
                let velocity = dual.velocity(k, axes, &moving(entry, q, v), &Dual::moving(v, a));
                let expected: Vec<f64> = velocity.iter().map(|x| x.tangent).collect();
                let (found, name) = (robot.acceleration(k, axes, [q, v, a]), entry.name);
                let size = a.amax() + v.norm_squared();
                let found = found.as_slice();
                assert_close!(found, expected, ROUNDING, floor = size, "{name}: {axes:?} V̇ of {frame}");
            }
        }
    });
}

#[test]
fn accelerations_agree_with_differences_of_velocities() {
    for_each_state(|name, robot, State { q, v, a, .. }| {
        for (k, frame) in robot.frame_names().iter().enumerate() {
            for axes in Axes::BOTH {
                let expected = difference(|t| {
                    robot.velocity(k, axes, &robot.integrate(q, &(v * t + a * (t * t / 2.0))), &(v + a * t))
                });
                let (found, size) = (robot.acceleration(k, axes, [q, v, a]), a.amax() + v.norm_squared());
                let (found, expected) = (found.as_slice(), expected.as_slice());
                assert_close!(found, expected, DIFFERENCES, floor = size, "{name}: {axes:?} V̇ of {frame}");
            }
        }
    });
}

/// `V̇ = J·a + J̇·v`
#[test]
fn bias_accelerations_are_those_without_that_of_the_joints() {
    for_each_state(|name, robot, State { q, v, a, .. }| {
        for (k, frame) in robot.frame_names().iter().enumerate() {
            for axes in Axes::BOTH {
                let found = robot.bias_acceleration(k, axes, q, v);
                let expected = robot.acceleration(k, axes, [q, v, a]) - robot.jacobian(k, axes, q) * a;
                let size = a.amax() + v.norm_squared();
                let (found, expected) = (found.as_slice(), expected.as_slice());
                assert_close!(found, expected, ROUNDING, floor = size, "{name}: {axes:?} J̇·v of {frame}");
            }
        }
    });
}

/// The work that a wrench does on its frame is what the joints get: `vᵀ(Jᵀw) = wᵀV` for every v.
#[test]
fn external_forces_do_the_work_of_their_wrench() {
    for_each_state(|name, robot, State { q, v, a, .. }| {
        let mut random = Random::of(name);
        for (k, frame) in robot.frame_names().iter().enumerate() {
            for axes in Axes::BOTH {
                let wrench = random.vector(6, 10.0);
                let found = robot.external_forces(k, axes, q, &wrench);
                for v in [v, a] {
                    let expected = wrench.dot(&robot.velocity(k, axes, q, v));
                    let size = v.amax() * wrench.amax();
                    let work = [v.dot(&found)];
                    assert_close!(work, [expected], ROUNDING, floor = size, "{name}: work on {frame}");
                }
            }
        }
    });
}

/// A wrench is the same in both axes.
#[test]
fn external_forces_do_not_depend_on_the_axes() {
    for_each_state(|name, robot, State { q, v, .. }| {
        let wrench = Random::of(name).vector(6, 10.0);
        for (k, frame) in robot.frame_names().iter().enumerate() {
            let (R, _) = robot.pose(k, q);
            let halves = [&R * wrench.rows(0, 3), &R * wrench.rows(3, 3)];
            let in_world = Vector::from_iterator(6, halves.iter().flatten().copied());
            let own = robot.external_forces(k, Axes::Own, q, &wrench);
            let world = robot.external_forces(k, Axes::World, q, &in_world);
            let (own, world, size) = (own.as_slice(), world.as_slice(), wrench.amax() * v.len() as f64);
            assert_close!(own, world, ROUNDING, floor = size, "{name}: forces of a wrench on {frame}");
        }
    });
}

/// The sine's range is the coordinate's: an axis that stands oblique to its neighbours adds nothing to the angle
/// before it is reduced. Rodrigues' formula for one turn after the other, at a hundred thousand radians.
#[test]
fn oblique_axes_keep_the_accuracy_of_the_sine() {
    use dynamics_core::prelude::*;

    #[derive(Dynamics)]
    #[joint(j: revolute([1, 2, 3]), world -> b)]
    #[body(b, com = [0.3, 0.1, 0.1], solid = cuboid(1kg, [0.2, 0.1, 0.1]))]
    #[joint(k: revolute([3, -1, 2]), b -> c, at = [0.5, 0, 0])]
    #[body(c, com = [0.3, 0.1, 0.1], solid = cuboid(1kg, [0.2, 0.1, 0.1]))]
    struct Oblique;

    /// Some ten roundings of entries no larger than one.
    const TOLERANCE: f64 = 1e-15;
    let turn = |axis: [f64; 3], angle: f64| {
        let k = nalgebra::Vector3::from(axis).normalize();
        let hat = k.cross_matrix();
        nalgebra::Matrix3::identity() + hat * angle.sin() + hat * hat * (1.0 - angle.cos())
    };
    for q in [[0.4, -1.0], [99_999.1, 77_777.7], [-1e6, 1e9]] {
        let expected = turn([1.0, 2.0, 3.0], q[0]) * turn([3.0, -1.0, 2.0], q[1]);
        let pose = Oblique.pose::<oblique_frames::C>(&SVector::from(q));
        let miss = (pose.rotation - expected).amax();
        assert!(miss < TOLERANCE, "{q:?}: {miss:e}");
    }
}
