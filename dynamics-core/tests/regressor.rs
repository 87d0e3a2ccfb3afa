//! The equation of motion as a linear function of the parameters, of a pendulum written by hand.
#![cfg(feature = "std")]

use crate::common::{G, Pendulum};
use dynamics_core::__private::{columns, vector};
use dynamics_core::prelude::*;

/// At this speed friction has √½ of its full force, in rad/s.
const FRICTION_SPEED: f64 = 0.1;

impl Regressor<f64, 1, 1, 13> for Pendulum<f64> {
    fn regressor(
        &self,
        q: &SVector<f64, 1>,
        v: &SVector<f64, 1>,
        a: &SVector<f64, 1>,
    ) -> SMatrix<f64, 1, 13> {
        let [[[q]], [[v]], [[a]]] = [q, v, a].map(|x| x.data.0);
        let (sine, cosine) = q.sin_cos();
        let friction = v / v.hypot(FRICTION_SPEED);
        columns(
            [0.0, 0.0, G * cosine, -G * sine, a, 0.0, 0.0, 0.0, 0.0, 0.0, a, v, friction]
                .map(|entry| [entry]),
        )
    }
    fn inertial_parameters(&self) -> SVector<f64, 13> {
        let (m, l) = (self.m, self.l);
        let moment = m * l * l;
        vector([m, 0.0, 0.0, -m * l, moment, 0.0, moment, 0.0, 0.0, 0.0, 0.0, self.damping, 0.0])
    }
}

impl BaseRegressor<f64, 1, 1, 5> for Pendulum<f64> {
    fn base_regressor(
        &self,
        q: &SVector<f64, 1>,
        v: &SVector<f64, 1>,
        a: &SVector<f64, 1>,
    ) -> SMatrix<f64, 1, 5> {
        let columns_of_all = self.regressor(q, v, a).data.0;
        columns([2, 3, 4, 11, 12].map(|k: usize| columns_of_all[k]))
    }
    fn base_parameters(&self) -> SVector<f64, 5> {
        let [[_, _, my, mz, ixx, .., armature, damping, friction]] = self.inertial_parameters().data.0;
        vector([my, mz, ixx + armature, damping, friction])
    }
}

#[test]
fn forces_are_linear_in_the_parameters() {
    let robot = Pendulum { m: 2.0, l: 0.5, damping: 0.3 };
    let (q, v, a) = (SVector::from([0.7]), SVector::from([-1.2]), SVector::from([3.0]));
    let tau = robot.inverse_dynamics(&q, &v, &a);
    assert!((robot.regressor(&q, &v, &a) * robot.inertial_parameters() - tau).amax() < 1e-14);
    assert!((robot.base_regressor(&q, &v, &a) * robot.base_parameters() - tau).amax() < 1e-14);
}

#[test]
fn a_robot_without_a_regressor_names_no_parameters() {
    assert!(Pendulum::<f64>::PARAMETER_NAMES.is_empty() && Pendulum::<f64>::BASE_PARAMETER_NAMES.is_empty());
}
