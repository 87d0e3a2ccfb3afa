//! The provided methods of `Dynamics`, and its errors.
#![cfg(feature = "std")]

mod common;

use common::{DoublePendulum, Pendulum, Spinner};
use dynamics_core::prelude::*;

#[test]
fn constants_stand_on_the_type() {
    assert_eq!(DoublePendulum::JOINT_NAMES, ["shoulder", "elbow"]);
    assert_eq!(DoublePendulum::COST.inverse_dynamics.multiplications, 0);
}

#[test]
fn a_turning_body_has_the_matrix_of_levi_civita() {
    let (q, v) = (SVector::from([0.0, 0.0, 0.0, 1.0]), SVector::from([1.0, -2.0, 0.5]));
    let coriolis_matrix = Spinner.coriolis_matrix(&q, &v);
    assert_eq!(coriolis_matrix * v, Spinner.bias_forces(&q, &v));
    // The mass matrix is constant: Ṁ = C + Cᵀ = 0.
    assert_eq!(coriolis_matrix + coriolis_matrix.transpose(), SMatrix::<f64, 3, 3>::zeros());
}

#[test]
fn the_bundle_agrees_with_its_parts() {
    let (q, v) = (SVector::from([0.3, -0.8]), SVector::from([1.0, 2.0]));
    let EquationsOfMotion { mass_matrix, coriolis_matrix, gravity_forces } =
        DoublePendulum.equations_of_motion(&q, &v);
    assert_eq!(mass_matrix, DoublePendulum.mass_matrix(&q));
    assert_eq!(coriolis_matrix * v + gravity_forces, DoublePendulum.bias_forces(&q, &v));
    let energy: f64 = DoublePendulum.total_energy(&q, &v);
    assert_eq!(energy, DoublePendulum.kinetic_energy(&q, &v) + DoublePendulum.potential_energy(&q));
}

#[test]
fn checked_methods_name_the_argument_and_the_index() {
    let fine = SVector::from([0.1, 0.2]);
    let broken = SVector::from([0.1, f64::NAN]);
    let at = |vector| Err(Error::NotFinite { vector, index: 1 });
    assert_eq!(DoublePendulum.try_forward_dynamics(&broken, &fine, &fine), at("q"));
    assert_eq!(DoublePendulum.try_forward_dynamics(&fine, &broken, &fine), at("v"));
    assert_eq!(DoublePendulum.try_forward_dynamics(&fine, &fine, &broken), at("tau"));
    assert_eq!(DoublePendulum.try_inverse_dynamics(&fine, &fine, &broken), at("a"));
    let a = DoublePendulum.try_forward_dynamics(&fine, &fine, &fine).expect("all is finite");
    let tau = DoublePendulum.try_inverse_dynamics(&fine, &fine, &a).expect("all is finite");
    assert!((tau - fine).norm() < 1e-14);
}

#[test]
fn a_massless_robot_is_singular() {
    let robot = Pendulum { m: 0.0, l: 1.0, damping: 0.0 };
    let x = SVector::from([1.0]);
    assert_eq!(robot.try_forward_dynamics(&x, &x, &x), Err(Error::SingularMassMatrix));
}

#[test]
fn an_overflowing_result_is_reported() {
    let robot = Pendulum { m: 1e200, l: 1e200, damping: 0.0 };
    let x = SVector::from([1.0]);
    assert_eq!(robot.try_inverse_dynamics(&x, &x, &x), Err(Error::NotFinite { vector: "tau", index: 0 }));
}

#[test]
fn speeds_that_overflow_are_no_singular_mass_matrix() {
    let (q, v) = (SVector::from([0.3, -0.8]), SVector::from([1e200, 1e200]));
    let a = DoublePendulum.try_forward_dynamics(&q, &v, &SVector::zeros());
    assert!(matches!(a, Err(Error::NotFinite { vector: "a", .. })), "{a:?}");
}
