//! Frames as type arguments: the calls a user writes, and what the Jacobians mean.
#![cfg(feature = "std")]

use crate::common::free_box::{Corner, FreeBox};
use crate::common::{Bob, DoublePendulum, Pendulum, Tool0};
use dynamics_core::prelude::*;

#[test]
fn a_frame_is_the_only_type_argument() {
    let robot = Pendulum { m: 2.0, l: 0.5, damping: 0.0 };
    let q = SVector::from([0.3]);
    let v = SVector::from([2.0]);
    assert_eq!(robot.pose::<Bob>(&q).translation.x, 0.0);
    assert_eq!(robot.jacobian::<Bob>(&q)[1], 0.5);
    assert_eq!(robot.velocity::<Bob>(&q, &v)[3], 2.0);

    let robot = DoublePendulum;
    let q = SVector::from([0.3, -0.4]);
    assert!(robot.pose::<Tool0>(&q).translation.norm() < 2.0);
    assert_eq!(robot.world_jacobian::<Tool0>(&q).shape(), (6, 2));
    let q = SVector::from([0.3_f32, -0.4]);
    assert!(robot.pose::<Tool0>(&q).translation.norm() < 2.0_f32);
}

#[test]
fn frames_work_in_generic_code() {
    fn height<T: Scalar, R, F>(robot: &R, q: &SVector<T, 2>) -> T
    where
        R: Mechanism,
        F: Frame<R, T, 2, 2>,
    {
        robot.pose::<F>(q).translation.z
    }
    assert_eq!(height::<f64, _, Tool0>(&DoublePendulum, &SVector::from([0.0, 0.0])), -2.0);
}

#[test]
fn a_boxed_robot_is_a_robot() {
    let robot: Box<dyn Dynamics<f64, 2, 2>> = Box::new(DoublePendulum);
    assert_eq!(robot.gravity_forces(&SVector::zeros()).norm(), 0.0);
}

#[test]
fn world_jacobian_is_the_derivative_of_the_origin() {
    let (robot, q, h) = (DoublePendulum, SVector::from([0.7, -1.1]), 1e-6);
    let jacobian = robot.world_jacobian::<Tool0>(&q);
    for joint in 0..2 {
        let mut delta = SVector::zeros();
        delta[joint] = h;
        let (ahead, behind) = (robot.pose::<Tool0>(&(q + delta)), robot.pose::<Tool0>(&(q - delta)));
        let difference = (ahead.translation - behind.translation) / (2.0 * h);
        assert!((difference - jacobian.fixed_view::<3, 1>(0, joint)).norm() < 1e-9);
    }
}

#[test]
fn body_jacobian_is_the_world_one_seen_from_the_frame() {
    let (robot, q) = (DoublePendulum, SVector::from([0.7, -1.1]));
    let back = robot.pose::<Tool0>(&q).rotation.transpose();
    let (body, world) = (robot.jacobian::<Tool0>(&q), robot.world_jacobian::<Tool0>(&q));
    for row in [0, 3] {
        assert!((body.fixed_rows::<3>(row) - back * world.fixed_rows::<3>(row)).norm() < 1e-14);
    }
}

#[test]
fn poses_compose_and_invert() {
    let a = DoublePendulum.pose::<Tool0>(&SVector::from([0.7, -1.1]));
    let b = DoublePendulum.pose::<Tool0>(&SVector::from([-0.2, 2.0]));
    let x = SVector::from([1.0, 2.0, 3.0]);
    assert!(((a * b).transform_point(&x) - a.transform_point(&b.transform_point(&x))).norm() < 1e-14);
    assert!((a.inverse().transform_point(&a.transform_point(&x)) - x).norm() < 1e-14);
    assert_eq!(Pose::identity() * a, a);
    assert!((a.transform_vector(&x) - a.rotation * x).norm() < 1e-14);
}

/// A box on its way.
fn flight() -> (FreeBox, SVector<f64, 7>, SVector<f64, 6>) {
    let q = SVector::from([0.2, -0.3, 1.0, 0.1, -0.5, 0.7, 0.5]);
    (FreeBox::tossed(), q, SVector::from([1.0, -2.0, 4.0, 2.0, 5.0, -3.0]))
}

#[test]
fn velocities_are_jacobians_times_speeds() {
    let (robot, q, v) = flight();
    assert!((robot.velocity::<Corner>(&q, &v) - robot.jacobian::<Corner>(&q) * v).amax() < 1e-14);
    assert!((robot.world_velocity::<Corner>(&q, &v) - robot.world_jacobian::<Corner>(&q) * v).amax() < 1e-14);
    let (robot, q, v) = (DoublePendulum, SVector::from([0.7, -1.1]), SVector::from([2.0, -3.0]));
    let world_velocity: SVector<f64, 6> = robot.world_velocity::<Tool0>(&q, &v);
    assert!((world_velocity - robot.world_jacobian::<Tool0>(&q) * v).amax() < 1e-14);
}

#[test]
fn external_forces_do_the_work_of_the_wrench() {
    let ((robot, q, v), wrench) = (flight(), SVector::from([1.0, -3.0, 2.0, 0.5, 0.3, -0.7]));
    let power = robot.external_forces::<Corner>(&q, &wrench).dot(&v);
    assert!((power - wrench.dot(&robot.velocity::<Corner>(&q, &v))).abs() < 1e-13);
    let power = robot.world_external_forces::<Corner>(&q, &wrench).dot(&v);
    assert!((power - wrench.dot(&robot.world_velocity::<Corner>(&q, &v))).abs() < 1e-13);
}

/// The double pendulum's unit point masses at the elbow and the tool: pushed up by their weight they hang on nothing.
#[test]
fn external_forces_of_several_bodies_add_up() {
    /// The end of the first rod.
    struct Elbow;
    impl Frame<DoublePendulum, f64, 2, 2> for Elbow {
        const NAME: &'static str = "elbow";

        fn pose(_robot: &DoublePendulum, q: &SVector<f64, 2>) -> Pose<f64> {
            let (sine, cosine) = q.x.sin_cos();
            let rotation = SMatrix::from([[1.0, 0.0, 0.0], [0.0, cosine, sine], [0.0, -sine, cosine]]);
            Pose { rotation, translation: SVector::from([0.0, sine, -cosine]) }
        }
        fn jacobian(_robot: &DoublePendulum, _q: &SVector<f64, 2>) -> SMatrix<f64, 6, 2> {
            SMatrix::from([[0.0, 1.0, 0.0, 1.0, 0.0, 0.0], [0.0; 6]])
        }
        fn world_jacobian(_robot: &DoublePendulum, q: &SVector<f64, 2>) -> SMatrix<f64, 6, 2> {
            let (sine, cosine) = q.x.sin_cos();
            SMatrix::from([[0.0, cosine, sine, 1.0, 0.0, 0.0], [0.0; 6]])
        }
        fn acceleration(
            robot: &DoublePendulum,
            q: &SVector<f64, 2>,
            _v: &SVector<f64, 2>,
            a: &SVector<f64, 2>,
        ) -> SVector<f64, 6> {
            Self::jacobian(robot, q) * a
        }
    }
    let (robot, q) = (DoublePendulum, SVector::from([0.7, -1.1]));
    let lift = SVector::from([0.0, 0.0, crate::common::G, 0.0, 0.0, 0.0]);
    let external: SVector<f64, 2> =
        robot.world_external_forces::<Elbow>(&q, &lift) + robot.world_external_forces::<Tool0>(&q, &lift);
    let o = SVector::zeros();
    assert!((robot.inverse_dynamics(&q, &o, &o) - external).amax() < 1e-14);
    assert!(robot.forward_dynamics(&q, &o, &external).amax() < 1e-14);

    // In the frame's own axes the same force has other components.
    let turned =
        robot.pose::<Tool0>(&q).inverse().transform_vector(&SVector::from([0.0, 0.0, crate::common::G]));
    let in_frame = SVector::from([turned.x, turned.y, turned.z, 0.0, 0.0, 0.0]);
    let (own, world) =
        (robot.external_forces::<Tool0>(&q, &in_frame), robot.world_external_forces::<Tool0>(&q, &lift));
    assert!((own - world).amax() < 1e-14);
}

/// Accelerations, against central differences of velocities along the motion, and in their parts.
fn accelerations_are_rates<F, R, const NQ: usize, const NV: usize>(
    robot: &R,
    q: &SVector<f64, NQ>,
    v: &SVector<f64, NV>,
    a: &SVector<f64, NV>,
) where
    R: Mechanism + Configuration<f64, NQ, NV>,
    F: Frame<R, f64, NQ, NV>,
{
    let h = 1e-5;
    let after = |t: f64| State::new(robot.integrate(q, &(v * t + a * (0.5 * t * t))), v + a * t);
    let (ahead, behind) = (after(h), after(-h));
    let twists = [ahead, behind].map(|at| robot.velocity::<F>(&at.q, &at.v));
    let rate = (twists[0] - twists[1]) / (2.0 * h);
    assert!((robot.acceleration::<F>(q, v, a) - rate).amax() < 1e-7, "{}", F::NAME);
    let velocities = [ahead, behind].map(|at| robot.world_velocity::<F>(&at.q, &at.v));
    let rate = (velocities[0] - velocities[1]) / (2.0 * h);
    assert!((robot.world_acceleration::<F>(q, v, a) - rate).amax() < 1e-7, "{}", F::NAME);

    // What is left without `a`, and what `a` adds.
    let own = robot.bias_acceleration::<F>(q, v) + robot.jacobian::<F>(q) * a;
    assert!((robot.acceleration::<F>(q, v, a) - own).amax() < 1e-13);
    let world = robot.world_bias_acceleration::<F>(q, v) + robot.world_jacobian::<F>(q) * a;
    assert!((robot.world_acceleration::<F>(q, v, a) - world).amax() < 1e-13);
}

#[test]
fn accelerations_are_the_rates_of_velocities() {
    let robot = Pendulum { m: 2.0, l: 0.5, damping: 0.0 };
    accelerations_are_rates::<Bob, _, 1, 1>(&robot, &[0.3].into(), &[2.0].into(), &[-1.0].into());
    let (q, v, a) = ([0.7, -1.1].into(), [2.0, -3.0].into(), [0.4, 1.5].into());
    accelerations_are_rates::<Tool0, _, 2, 2>(&DoublePendulum, &q, &v, &a);
    let ((robot, q, v), a) = (flight(), SVector::from([0.3, 0.2, -1.0, 2.0, -0.5, 0.7]));
    accelerations_are_rates::<Corner, _, 7, 6>(&robot, &q, &v, &a);
}

#[test]
fn what_falls_freely_accelerates_by_gravity() {
    let (robot, q, _) = flight();
    // Released from rest a box does not begin to turn, so that its corner falls as its centre of mass does.
    let at_rest = SVector::zeros();
    let a = robot.forward_dynamics(&q, &at_rest, &SVector::zeros());
    let found = robot.world_acceleration::<Corner>(&q, &at_rest, &a);
    assert!((found.fixed_rows::<3>(0) - robot.gravity).amax() < 1e-13);
    assert!(found.fixed_rows::<3>(3).amax() < 1e-13);
}
