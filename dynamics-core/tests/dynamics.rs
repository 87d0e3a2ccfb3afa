//! The provided methods of `Dynamics`, and its errors.
#![cfg(feature = "std")]

use crate::common::free_box::FreeBox;
use crate::common::{DoublePendulum, G, Pendulum, Spinner};
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
fn values_and_derivatives_are_provided_in_one() {
    let (q, v, x) = (SVector::from([0.3, -0.8]), SVector::from([1.0, 2.0]), SVector::from([0.5, -3.0]));
    let robot = DoublePendulum;
    let (tau, derivatives) = robot.inverse_dynamics_with_derivatives(&q, &v, &x);
    assert_eq!(tau, robot.inverse_dynamics(&q, &v, &x));
    assert_eq!(derivatives, robot.inverse_dynamics_derivatives(&q, &v, &x));
    let (a, derivatives) = robot.forward_dynamics_with_derivatives(&q, &v, &x);
    assert_eq!(a, robot.forward_dynamics(&q, &v, &x));
    assert_eq!(derivatives, robot.forward_dynamics_derivatives(&q, &v, &x));
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

#[test]
fn the_inverse_of_the_mass_matrix_is_one() {
    let q = SVector::from([0.3, -0.8]);
    let (mass_matrix, inverse) = (DoublePendulum.mass_matrix(&q), DoublePendulum.inverse_mass_matrix(&q));
    assert!((mass_matrix * inverse - SMatrix::<f64, 2, 2>::identity()).amax() < 1e-14);
    let (robot, q) = (FreeBox::tossed(), SVector::from([1.0, 2.0, 3.0, 0.1, -0.5, 0.7, 0.5]));
    let error = (robot.inverse_mass_matrix(&q) - robot.inverse()).amax();
    assert!(error < 1e-12 * robot.inverse().amax(), "{error:e}");
}

#[test]
fn without_springs_and_damping_nothing_is_passive() {
    let (q, v) = (SVector::from([0.3, -0.8]), SVector::from([1.0, 2.0]));
    assert_eq!(DoublePendulum.passive_forces(&q, &v), SVector::<f64, 2>::zeros());
    let joules: f64 = DoublePendulum.elastic_energy(&q);
    assert_eq!(joules, 0.0);
}

/// A mass on a vertical rail, on a spring.
struct Spring {
    mass: f64,
    stiffness: f64,
}

impl Dynamics<f64, 1, 1> for Spring {
    fn mass_matrix(&self, _q: &SVector<f64, 1>) -> SMatrix<f64, 1, 1> {
        SMatrix::from([self.mass])
    }
    fn coriolis_matrix(&self, _q: &SVector<f64, 1>, _v: &SVector<f64, 1>) -> SMatrix<f64, 1, 1> {
        SMatrix::zeros()
    }
    fn gravity_forces(&self, _q: &SVector<f64, 1>) -> SVector<f64, 1> {
        SVector::from([self.mass * G])
    }
    fn passive_forces(&self, q: &SVector<f64, 1>, _v: &SVector<f64, 1>) -> SVector<f64, 1> {
        q * self.stiffness
    }
    fn elastic_energy(&self, q: &SVector<f64, 1>) -> f64 {
        0.5 * self.stiffness * q.norm_squared()
    }
    fn bias_forces(&self, q: &SVector<f64, 1>, v: &SVector<f64, 1>) -> SVector<f64, 1> {
        self.gravity_forces(q) + self.passive_forces(q, v)
    }
    fn inverse_dynamics(
        &self,
        q: &SVector<f64, 1>,
        v: &SVector<f64, 1>,
        a: &SVector<f64, 1>,
    ) -> SVector<f64, 1> {
        a * self.mass + self.bias_forces(q, v)
    }
    fn forward_dynamics(
        &self,
        q: &SVector<f64, 1>,
        v: &SVector<f64, 1>,
        tau: &SVector<f64, 1>,
    ) -> SVector<f64, 1> {
        (tau - self.bias_forces(q, v)) / self.mass
    }
    fn kinetic_energy(&self, _q: &SVector<f64, 1>, v: &SVector<f64, 1>) -> f64 {
        0.5 * self.mass * v.norm_squared()
    }
    fn potential_energy(&self, q: &SVector<f64, 1>) -> f64 {
        self.mass * G * q.x
    }
    fn lagrangian(&self, q: &SVector<f64, 1>, v: &SVector<f64, 1>) -> f64 {
        self.kinetic_energy(q, v) - self.potential_energy(q)
    }
}

impl Configuration<f64, 1, 1> for Spring {
    fn integrate(&self, q: &SVector<f64, 1>, delta: &SVector<f64, 1>) -> SVector<f64, 1> {
        q + delta
    }
}

#[test]
fn springs_conserve_the_energy_they_are_part_of() {
    let robot = Spring { mass: 2.0, stiffness: 50.0 };
    assert_eq!(robot.inverse_mass_matrix(&[0.7].into())[0], 0.5);
    let start = State::rest(robot.neutral());
    let mut simulation = Simulation::new(&robot, start, 1e-3).expect("valid");
    for sample in simulation.steps(2_000) {
        let Sample { time, state, .. } = sample.expect("finite");
        // It swings about where the spring carries the mass.
        let carried = -robot.mass * G / robot.stiffness;
        let expected = carried * (1.0 - (5.0 * time).cos());
        assert!((state.q.x - expected).abs() < 1e-9, "after {time} s");
        let energy = sample.expect("finite").energy();
        assert_eq!(energy.total(), energy.kinetic + energy.potential + energy.elastic);
        assert_eq!(energy.total(), robot.total_energy(&state.q, &state.v));
        assert!(energy.total().abs() < 1e-9, "after {time} s: {energy:?}");
    }
}

#[test]
fn configurations_of_one_dof_joints_are_vectors() {
    let (q0, q1) = (SVector::from([0.3, -7.0]), SVector::from([0.5, 9.0]));
    let delta: SVector<f64, 2> = DoublePendulum.difference(&q0, &q1);
    assert_eq!(delta, q1 - q0);
    assert_eq!(DoublePendulum.integrate(&q0, &delta), q1);
    assert_eq!(DoublePendulum.check_configuration(&q0), Ok(()));
    let neutral: SVector<f64, 2> = DoublePendulum.neutral();
    assert_eq!(neutral.norm(), 0.0);
}
