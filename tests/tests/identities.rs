//! Laws that hold for every robot at every state. A bug in any phase breaks one.
//! Each runs over the whole zoo, at seeded random states of each robot.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

mod identities {
    mod configurations;
    mod derivatives;
    mod equations;
    mod frames;
    mod parameters;
    mod whole;
}

use dynamics_tests::zoo::{self, Entry};
use dynamics_tests::{Dual, Forms, Matrix, Robot, State, Vector, assert_close};

/// At how many states of each robot.
const STATES: usize = 32;

/// Two programs for one quantity, or the same derivative of two: as [`dynamics_tests::close::ROUNDING`], for the
/// larger terms within.
const DUAL: f64 = 1e-11;

fn for_each_state(check: impl Fn(&str, &dyn Robot<f64>, &State)) {
    for (entry, Forms { robot, .. }) in zoo::in_double() {
        for state in entry.states(STATES) {
            check(entry.name, &*robot, &state);
        }
    }
}

/// The robots that leave the scalar open, in doubles and over dual numbers.
fn for_each_dual_state(check: impl Fn(&Entry, &dyn Robot<f64>, &dyn Robot<Dual>, &State)) {
    let mut count = 0;
    for mut entry in zoo::all() {
        let (Some(double), Some(dual)) = (entry.double.take(), entry.dual.take()) else { continue };
        count += 1;
        for state in entry.states(STATES) {
            check(&entry, &*double.robot, &*dual.robot, &state);
        }
    }
    assert!(count > 20, "the zoo has {count} generic robots");
}

fn close(what: &str, name: &str, found: &Matrix, expected: &Matrix, tolerance: f64, floor: f64) {
    assert_close!(found.as_slice(), expected.as_slice(), tolerance, floor = floor, "{name}: {what}");
}

/// The central difference of `f` at zero.
fn difference(f: impl Fn(f64) -> Vector) -> Vector {
    let h = 1e-5;
    (f(h) - f(-h)) / (2.0 * h)
}

/// The columns `∂f/∂x_j` of `f(x)` at zero, by central differences.
fn jacobian_by_differences(n: usize, f: impl Fn(&Vector) -> Vector) -> Matrix {
    Matrix::from_columns(&(0..n).map(|j| difference(|h| f(&(unit(n, j) * h)))).collect::<Vec<_>>())
}

fn unit(n: usize, j: usize) -> Vector {
    Vector::from_fn(n, |i, _| f64::from(u8::from(i == j)))
}

/// The entries of a matrix as a column.
fn flat(m: &Matrix) -> Vector {
    Vector::from_column_slice(m.as_slice())
}

fn tangents(m: &Matrix<Dual>) -> Matrix {
    m.map(|x| x.tangent)
}

/// Coordinates on their way at the speeds `v`.
fn moving(entry: &Entry, q: &Vector, v: &Vector) -> Vector<Dual> {
    Dual::moving(q, &entry.space.rate(q, v))
}

/// The size of the forces in a robot that moves as in `state`: below it all is rounding.
fn forces(robot: &dyn Robot<f64>, State { q, v, a, .. }: &State) -> f64 {
    let C = robot.coriolis_matrix(q, v);
    robot.mass_matrix(q).amax() * (1.0 + a.amax())
        + C.amax() * v.amax()
        + robot.gravity_forces(q).amax()
        + robot.passive_forces(q, v).amax()
}
