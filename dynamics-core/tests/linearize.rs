//! The linear model against central differences of the nonlinear one.
#![cfg(feature = "std")]

use crate::common::{DoublePendulum, Spinner};
use dynamics_core::nalgebra::SVector as Vector;
use dynamics_core::prelude::*;

fn rate(x: &Vector<f64, 4>, u: f64) -> Vector<f64, 4> {
    let (q, v) = (x.fixed_rows::<2>(0).into_owned(), x.fixed_rows::<2>(2).into_owned());
    let a = DoublePendulum.forward_dynamics(&q, &v, &SVector::from([0.0, u]));
    Vector::from([v[0], v[1], a[0], a[1]])
}

#[test]
fn agrees_with_central_differences() {
    let (x, u, h) = (Vector::from([0.4, -0.9, 1.1, 0.3]), 2.0, 1e-5);
    let model = DoublePendulum.linearize(
        &SVector::from([0.4, -0.9]),
        &SVector::from([1.1, 0.3]),
        &SVector::from([u]),
    );
    assert!((model.drift - rate(&x, u)).norm() < 1e-12);
    for column in 0..4 {
        let mut delta = Vector::zeros();
        delta[column] = h;
        let difference = (rate(&(x + delta), u) - rate(&(x - delta), u)) / (2.0 * h);
        assert!((model.a.column(column) - difference).norm() < 1e-7, "column {column}");
    }
    let difference = (rate(&x, u + h) - rate(&x, u - h)) / (2.0 * h);
    assert!((model.b - difference).norm() < 1e-7);
}

#[test]
fn the_hanging_robot_is_an_equilibrium() {
    let o = SVector::zeros();
    let model: Linearization<f64, 4, 1> = DoublePendulum.linearize(&o, &o, &SVector::zeros());
    assert_eq!(model.drift.norm(), 0.0);
}

/// `ẋ` of a turning body, where `x = (q ⊖ q₀, v)`: by a short motion from there, and back.
fn rate_of_a_ball(q0: &SVector<f64, 4>, x: &Vector<f64, 6>, torque: &SVector<f64, 3>) -> Vector<f64, 6> {
    let (delta, v) = (x.fixed_rows::<3>(0).into_owned(), x.fixed_rows::<3>(3).into_owned());
    let (q, h) = (Spinner.integrate(q0, &delta), 1e-4);
    let after = |time: f64| Spinner.difference(q0, &Spinner.integrate(&q, &(v * time)));
    let (near, far) = ((after(h) - after(-h)) / (2.0 * h), (after(2.0 * h) - after(-2.0 * h)) / (4.0 * h));
    let (delta_rate, a) = ((near * 4.0 - far) / 3.0, Spinner.forward_dynamics(&q, &v, torque));
    Vector::from_fn(|i, _| if i < 3 { delta_rate[i] } else { a[i - 3] })
}

#[test]
fn agrees_with_central_differences_on_quaternions() {
    let (q, v) = (SVector::from([0.1, -0.5, 0.7, 0.5]), SVector::from([1.0, -2.0, 0.5]));
    let (torque, h) = (SVector::from([0.3, 0.2, -0.1]), 1e-2);
    let model = Spinner.linearize(&q, &v, &torque);
    let x = Vector::from([0.0, 0.0, 0.0, 1.0, -2.0, 0.5]);
    assert!((model.drift - rate_of_a_ball(&q, &x, &torque)).amax() < 1e-11);
    for column in 0..6 {
        let mut delta = Vector::zeros();
        delta[column] = h;
        let [ahead, behind] = [x + delta, x - delta].map(|x| rate_of_a_ball(&q, &x, &torque));
        let difference = (ahead - behind) / (2.0 * h);
        // Exact but for rounding: the rate is quadratic in v, and in δ linear but for even parts.
        assert!((model.a.column(column) - difference).amax() < 1e-9, "column {column}");
    }
}
