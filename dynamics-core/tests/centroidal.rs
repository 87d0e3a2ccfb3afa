//! The centre of mass and the momentum about it: what is provided, and the laws of momentum.
#![cfg(feature = "std")]

use crate::common::free_box::FreeBox;
use dynamics_core::nalgebra::Vector3;
use dynamics_core::prelude::*;

fn state() -> State<f64, 7, 6> {
    State::new(
        SVector::from([0.2, -0.3, 1.0, 0.1, -0.5, 0.7, 0.5]),
        SVector::from([1.0, -2.0, 4.0, 2.0, 5.0, -3.0]),
    )
}

/// The derivative of `f` along the motion at `state`, by central differences.
fn along_the_motion<const N: usize>(
    robot: &FreeBox,
    a: &SVector<f64, 6>,
    f: impl Fn(&State<f64, 7, 6>) -> SVector<f64, N>,
) -> SVector<f64, N> {
    let (State { q, v }, h) = (state(), 1e-5);
    // q(t) = q ⊕ (v t + a t²/2) is right to the second order, as the difference needs it.
    let after = |t: f64| f(&State { q: robot.integrate(&q, &(v * t + a * (0.5 * t * t))), v: v + a * t });
    (after(h) - after(-h)) / (2.0 * h)
}

#[test]
fn the_jacobian_is_the_velocity_of_the_centre_of_mass() {
    let (robot, State { q, v }) = (FreeBox::tossed(), state());
    let rate =
        along_the_motion(&robot, &SVector::zeros(), |s| CentroidalDynamics::center_of_mass(&robot, &s.q));
    assert!((robot.center_of_mass_jacobian(&q) * v - rate).amax() < 1e-8);
}

#[test]
fn momentum_is_that_of_the_bodies() {
    let (robot, State { q, v }) = (FreeBox::tossed(), state());
    let momentum = robot.centroidal_momentum(&q, &v);
    assert!((momentum - robot.centroidal_momentum_matrix(&q) * v).amax() < 1e-14);
    // M·v is the momentum in the body about its origin: turned, and moved to the centre of mass.
    let in_body = robot.mass_matrix(&q) * v;
    let [p, l]: [Vector3<f64>; 2] = [in_body.fixed_rows::<3>(0).into(), in_body.fixed_rows::<3>(3).into()];
    let rotation = FreeBox::rotation(&q);
    assert!((momentum.fixed_rows::<3>(0) - rotation * p).amax() < 1e-14);
    assert!((momentum.fixed_rows::<3>(3) - rotation * (l - robot.com.cross(&p))).amax() < 1e-14);
}

#[test]
fn the_rate_of_momentum_is_weight_and_wrench() {
    let (robot, State { q, v }) = (FreeBox::tossed(), state());
    let wrench = SVector::from([1.0, -3.0, 2.0, 0.5, 0.3, -0.7]);
    let a = robot.forward_dynamics(&q, &v, &wrench);
    let rate = along_the_motion(&robot, &a, |s| robot.centroidal_momentum(&s.q, &s.v));
    let [force, moment]: [Vector3<f64>; 2] =
        [wrench.fixed_rows::<3>(0).into(), wrench.fixed_rows::<3>(3).into()];
    let rotation = FreeBox::rotation(&q);
    let linear = rotation * force + robot.gravity * robot.total_mass();
    assert!((rate.fixed_rows::<3>(0) - linear).amax() < 1e-7);
    assert!((rate.fixed_rows::<3>(3) - rotation * (moment - robot.com.cross(&force))).amax() < 1e-8);
}
