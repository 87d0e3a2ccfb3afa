//! The linear model against central differences of the nonlinear one.
#![cfg(feature = "std")]

mod common;

use common::DoublePendulum;
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
