//! What a robot says of its own parameters, and what is left of it when only some outputs are wanted.

use dynamics_core::prelude::*;

#[derive(Dynamics, Clone, Copy)]
#[dynamics(gravity = [0, -g, 0])]
#[joint(pivot: revolute(z), world -> rod)]
#[body(rod, mass = m, com = [l / 2, 0, 0], inertia = diag(0, i, i))]
struct Rod<T> {
    m: T,
    l: T,
    i: T,
    g: T,
}

const SOUND: Rod<f64> = Rod { m: 2.0, l: 0.5, i: 0.04, g: 9.81 };

#[test]
fn sound_parameters_pass() {
    assert_eq!(SOUND.check(), Ok(()));
    assert_eq!(Rod { g: -9.81, ..SOUND }.check(), Ok(()), "gravity may point anywhere");
}

#[test]
fn the_first_field_that_is_wrong_is_named() {
    let with_mass = |m: f64| Rod { m, ..SOUND }.check();
    assert_eq!(with_mass(0.0), Err(Error::MassNotPositive { field: "m" }));
    assert_eq!(with_mass(-1.0), Err(Error::MassNotPositive { field: "m" }));
    assert_eq!(with_mass(f64::NAN), Err(Error::ParameterNotFinite { field: "m" }));
    assert_eq!(Rod { l: f64::INFINITY, ..SOUND }.check(), Err(Error::ParameterNotFinite { field: "l" }));
}

#[derive(Dynamics)]
#[dynamics(outputs(inverse_dynamics, pose))]
#[joint(slide: prismatic(x), world -> cart)]
#[body(cart, mass = 1, inertia = diag(0.1, 0.1, 0.1))]
#[joint(hinge: revolute(y), cart -> pole)]
#[body(pole, mass = m, com = [0, 0, 0.5], inertia = diag(0.1, 0.1, 0.1))]
struct OnlySome<T> {
    m: T,
}

#[derive(Dynamics)]
#[dynamics(outputs(gravity_forces, forward_dynamics))]
#[joint(pivot: revolute(y), world -> rod)]
#[body(rod, solid = rod(2, 1.2), com = [0, 0, 0.6])]
struct OnlySomeOfUnit;

/// Two roundings of forces of the size of ten.
const TOLERANCE: f64 = 1e-14;

#[test]
fn wanted_outputs_are_methods_without_the_trait() {
    let robot = OnlySome { m: 0.2 };
    let (q, v, a) = (SVector::from([0.0, 0.0]), SVector::zeros(), SVector::from([0.0, 1.0]));
    // The pole's angular acceleration pushes the cart: τ = (m l a, (m l² + I) a).
    let tau = robot.inverse_dynamics(&q, &v, &a);
    assert!((tau - SVector::from([0.1, 0.15])).amax() < TOLERANCE, "{tau}");
    assert_eq!(robot.prepare().inverse_dynamics(&q, &v, &a), tau);
    assert_eq!(robot.pose::<only_some_frames::Pole>(&SVector::from([0.3, 0.0])).translation.x, 0.3);
    assert_eq!(<OnlySome<f64>>::NV, 2);
}

#[test]
fn a_unit_struct_takes_the_scalar_with_the_call() {
    let q = SVector::from([0.5_f64]);
    let tau = OnlySomeOfUnit.gravity_forces(&q);
    assert!((tau[0] + 2.0 * 9.81 * 0.6 * 0.5_f64.sin()).abs() < TOLERANCE);
    let single = OnlySomeOfUnit.gravity_forces(&SVector::from([0.5_f32]));
    assert!((f64::from(single[0]) - tau[0]).abs() < 1e-6, "one rounding of f32 at the size of ten");
    assert!(OnlySomeOfUnit.forward_dynamics(&q, &SVector::zeros(), &tau)[0].abs() < TOLERANCE);
}

/// What acts in joints, and gravity, are parameters as others are.
#[test]
fn fields_of_joints_and_of_gravity_are_checked() {
    use dynamics_tests::zoo::driven::{on_a_vehicle, sprung};

    let sound = sprung::robot::<f64>();
    assert_eq!(sound.check(), Ok(()));
    let error = Err(Error::ParameterNotFinite { field: "stiff" });
    assert_eq!(sprung::Sprung { stiff: f64::NAN, ..sound }.check(), error);
    let error = Err(Error::ParameterNotFinite { field: "f" });
    assert_eq!(sprung::Sprung { f: f64::INFINITY, ..sound }.check(), error);
    let sound = on_a_vehicle::robot::<f64>();
    assert_eq!(on_a_vehicle::OnAVehicle { gz: 0.0, ..sound }.check(), Ok(()), "nothing weighs anything");
    let error = Err(Error::ParameterNotFinite { field: "gx" });
    assert_eq!(on_a_vehicle::OnAVehicle { gx: f64::NAN, ..sound }.check(), error);
}

/// Of a robot whose base moves, gravity is another in each call: what the vehicle's acceleration makes of it.
#[test]
fn gravity_may_be_another_in_each_call() {
    use dynamics_tests::zoo::driven::on_a_vehicle::{self, OnAVehicle};

    let robot = on_a_vehicle::robot::<f64>();
    let q = SVector::from([0.3, -0.4]);
    let forces = |gx, gy, gz| OnAVehicle { gx, gy, gz, ..robot }.gravity_forces(&q);
    let sum = forces(1.0, 0.0, 0.0) * 1.5 + forces(0.0, 1.0, 0.0) * -0.5 + forces(0.0, 0.0, 1.0) * -9.0;
    assert!(
        (forces(1.5, -0.5, -9.0) - sum).amax() < 1e-12,
        "three roundings of forces of the size of a hundred"
    );
    assert!(forces(0.0, 0.0, 0.0).amax() == 0.0);
}
