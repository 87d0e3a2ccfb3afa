//! Every output by the derived Rust.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_codegen::symbolic::Number;
use dynamics_core::prelude::Scalar;

use super::Output;
use crate::{Axes, Matrix, Robot, Vector};

/// All outputs at `q`, `v`, `a` and `τ`, in the order of the plain recursion's.
pub(super) fn outputs<T: Scalar + Into<f64>>(
    robot: &dyn Robot<T>,
    at: &[Vector<T>; 4],
) -> Vec<Output<Number>> {
    let [q, v, a, _] = at;
    let mut outputs = equations(robot, at);
    outputs.extend(derivatives(robot, at));
    outputs.extend(whole(robot, at));
    let (Y_b, parameters) = (robot.base_regressor(q, v, a), column(&robot.base_parameters()));
    // All digits of the product, so that only the errors of the factors count.
    let product = |row: &[Number]| {
        row.iter().zip(&parameters).fold(Number::ZERO, |sum, (&y, &parameter)| sum + y * parameter)
    };
    outputs.extend([
        one("Y", rows(&robot.regressor(q, v, a))),
        one("π", column(&robot.inertial_parameters())),
        one("Y_b·π_b", rows(&Y_b).chunks(parameters.len().max(1)).map(product).collect()),
    ]);
    outputs.extend(frames(robot, at));
    outputs
}

fn equations<T: Scalar + Into<f64>>(
    robot: &dyn Robot<T>,
    [q, v, a, tau]: &[Vector<T>; 4],
) -> Vec<Output<Number>> {
    let (M, C, G) = robot.equations_of_motion(q, v);
    vec![
        one("M", rows(&robot.mass_matrix(q))),
        one("C", rows(&robot.coriolis_matrix(q, v))),
        one("G", column(&robot.gravity_forces(q))),
        Output { name: "M, C, G in one", blocks: vec![rows(&M), rows(&C), column(&G)] },
        one("passive forces", column(&robot.passive_forces(q, v))),
        one("h", column(&robot.bias_forces(q, v))),
        one("τ", column(&robot.inverse_dynamics(q, v, a))),
        one("a", column(&robot.forward_dynamics(q, v, tau))),
        one("T", vec![exact(robot.kinetic_energy(q, v))]),
        one("V", vec![exact(robot.potential_energy(q))]),
        one("T − V", vec![exact(robot.lagrangian(q, v))]),
        one("energy of springs", vec![exact(robot.elastic_energy(q))]),
    ]
}

fn derivatives<T: Scalar + Into<f64>>(
    robot: &dyn Robot<T>,
    [q, v, a, tau]: &[Vector<T>; 4],
) -> Vec<Output<Number>> {
    let [dtau_dq, dtau_dv, dtau_da] = robot.inverse_dynamics_derivatives(q, v, a);
    let [da_dq, da_dv, da_dtau] = robot.forward_dynamics_derivatives(q, v, tau);
    vec![
        one("∂τ/∂q", rows(&dtau_dq)),
        one("∂τ/∂v", rows(&dtau_dv)),
        one("∂τ/∂a", rows(&dtau_da)),
        one("∂a/∂q", rows(&da_dq)),
        one("∂a/∂v", rows(&da_dv)),
        one("∂a/∂τ", rows(&da_dtau)),
        one("M⁻¹", rows(&robot.inverse_mass_matrix(q))),
    ]
}

fn whole<T: Scalar + Into<f64>>(robot: &dyn Robot<T>, [q, v, ..]: &[Vector<T>; 4]) -> Vec<Output<Number>> {
    vec![
        one("mass", vec![exact(robot.total_mass())]),
        one("c", column(&robot.center_of_mass(q))),
        one("J of c", rows(&robot.center_of_mass_jacobian(q))),
        one("A·v", column(&robot.centroidal_momentum(q, v))),
        one("A", rows(&robot.centroidal_momentum_matrix(q))),
    ]
}

fn frames<T: Scalar + Into<f64>>(robot: &dyn Robot<T>, [q, v, a, _]: &[Vector<T>; 4]) -> Vec<Output<Number>> {
    let each = |name, block: &dyn Fn(usize) -> Vec<Number>| {
        let blocks = (0..robot.frame_names().len()).map(block).collect();
        Output { name, blocks }
    };
    vec![
        each("R", &|frame| rows(&robot.pose(frame, q).0)),
        each("p", &|frame| column(&robot.pose(frame, q).1)),
        each("J", &|frame| rows(&robot.jacobian(frame, Axes::Own, q))),
        each("J in world axes", &|frame| rows(&robot.jacobian(frame, Axes::World, q))),
        each("J·v", &|frame| column(&robot.velocity(frame, Axes::Own, q, v))),
        each("J·a + J̇·v", &|frame| column(&robot.acceleration(frame, Axes::Own, [q, v, a]))),
    ]
}

fn one(name: &'static str, block: Vec<Number>) -> Output<Number> {
    Output { name, blocks: vec![block] }
}

fn rows<T: Scalar + Into<f64>>(m: &Matrix<T>) -> Vec<Number> {
    m.transpose().iter().map(|&x| exact(x)).collect()
}

fn column<T: Scalar + Into<f64>>(x: &Vector<T>) -> Vec<Number> {
    x.iter().map(|&x| exact(x)).collect()
}

fn exact<T: Into<f64>>(x: T) -> Number {
    Number::from_f64(x.into()).expect("outputs are finite")
}
