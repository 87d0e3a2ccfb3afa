//! A chain of fifty-two joints, whose longest equations no straight line could hold: they are left to the run time's
//! recursion over a table, and must be the same equations.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_codegen::mechanics::plain::Oracle;
use dynamics_core::prelude::*;
use dynamics_tests::close::{ROUNDING, largest};
use dynamics_tests::roads::travel;
use dynamics_tests::zoo::Entry;
use dynamics_tests::{Part, Space, State, Vector, assert_close};

const N: usize = 52;

macro_rules! with_source {
    ($($item:tt)*) => {
        #[derive(Dynamics)]
        $($item)*

        const SOURCE: &str = stringify!($($item)*);
    };
}

/// Runs `check` with the plain recursion, at random states.
fn for_each_state(check: impl Fn(Oracle<'_>, &State, f64)) {
    let entry = Entry {
        name: "Chain",
        source: SOURCE,
        parameters: &[],
        space: Space(&[Part::Lines(N)]),
        costs: Chain::COST,
        joint_names: Chain::JOINT_NAMES,
        body_names: Chain::BODY_NAMES,
        parameter_names: Chain::PARAMETER_NAMES,
        base_parameter_names: Chain::BASE_PARAMETER_NAMES,
        double: None,
        single: None,
        dual: None,
    };
    travel(&entry, |roads| {
        for state in entry.states(3) {
            let force = largest(&roads.oracle().mass_matrix(state.q.as_slice()).concat());
            check(roads.oracle(), &state, force);
        }
    });
}

fn fixed(x: &Vector) -> SVector<f64, N> {
    SVector::from_column_slice(x.as_slice())
}

fn rows(m: &SMatrix<f64, N, N>) -> Vec<f64> {
    m.transpose().as_slice().to_vec()
}

#[test]
fn equations_of_motion_by_the_table_agree_with_the_plain_recursion() {
    for_each_state(|oracle, State { q, v, a, .. }, force| {
        let [qs, vs, accelerations] = [q, v, a].map(Vector::as_slice);
        let [q, v, a] = [q, v, a].map(fixed);
        let EquationsOfMotion { mass_matrix, coriolis_matrix, gravity_forces } =
            Chain.equations_of_motion(&q, &v);
        let close = |what: &str, found: &[f64], expected: Vec<f64>| {
            assert_close!(found, expected, ROUNDING, floor = force, "chain: {what}");
        };
        close("M", &rows(&mass_matrix), oracle.mass_matrix(qs).concat());
        close("C", &rows(&coriolis_matrix), oracle.coriolis_matrix(qs, vs).concat());
        close("C alone", &rows(&Chain.coriolis_matrix(&q, &v)), oracle.coriolis_matrix(qs, vs).concat());
        close("G", gravity_forces.as_slice(), oracle.gravity_forces(qs));
        let tau = Chain.inverse_dynamics(&q, &v, &a);
        close("τ", tau.as_slice(), oracle.inverse_dynamics(qs, vs, accelerations));
    });
}

#[test]
fn derivatives_by_the_table_agree_with_the_plain_recursion() {
    for_each_state(|oracle, State { q, v, a, .. }, force| {
        let [qs, vs, accelerations] = [q, v, a].map(Vector::as_slice);
        let exact = oracle.inverse_dynamics_derivatives(qs, vs, accelerations);
        let [q, v, a] = [q, v, a].map(fixed);
        let InverseDynamicsDerivatives { dtau_dq, dtau_dv, dtau_da } =
            Chain.inverse_dynamics_derivatives(&q, &v, &a);
        let close = |what: &str, found: &SMatrix<f64, N, N>, expected: Vec<f64>| {
            assert_close!(rows(found), expected, ROUNDING, floor = force, "chain: {what}");
        };
        close("∂τ/∂q", &dtau_dq, exact.dtau_dq.concat());
        close("∂τ/∂v", &dtau_dv, exact.dtau_dv.concat());
        close("∂τ/∂a", &dtau_da, exact.dtau_da.concat());
    });
}

#[test]
fn forward_dynamics_and_its_derivatives_answer_the_forces() {
    for_each_state(|oracle, State { q, v, tau, .. }, _| {
        let [qs, vs, forces] = [q, v, tau].map(Vector::as_slice);
        let [q, v, tau] = [q, v, tau].map(fixed);
        let a = Chain.forward_dynamics(&q, &v, &tau);
        let residual = oracle.forward_dynamics_residual(qs, vs, forces, a.as_slice());
        assert!(residual <= ROUNDING, "chain: a misses τ by {residual:.1e}");

        let exact = oracle.inverse_dynamics_derivatives(qs, vs, a.as_slice());
        let ForwardDynamicsDerivatives { da_dq, da_dv, da_dtau } =
            Chain.forward_dynamics_derivatives(&q, &v, &tau);
        let M = Chain.equations_of_motion(&q, &v).mass_matrix;
        let solves = |what: &str, X: &SMatrix<f64, N, N>, B: Vec<f64>| {
            let terms = (M.abs() * X.abs()).amax();
            assert_close!(rows(&(M * X)), B, ROUNDING, floor = terms, "chain: M·{what}");
        };
        let negative = |block: Vec<Vec<f64>>| block.concat().iter().map(|x| -x).collect::<Vec<f64>>();
        solves("∂a/∂q", &da_dq, negative(exact.dtau_dq));
        solves("∂a/∂v", &da_dv, negative(exact.dtau_dv));
        solves("∂a/∂τ", &da_dtau, rows(&SMatrix::identity()));
    });
}

with_source! {
    /// Alike links one after the other, with a slide and a massless one here and there.
    #[dynamics(outputs(equations_of_motion, coriolis_matrix, inverse_dynamics, forward_dynamics,
        inverse_dynamics_derivatives, forward_dynamics_derivatives))]
    #[joint(j1: revolute(y), world -> b1)]
    #[body(b1, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j2: revolute([1, 0, 0.5]), b1 -> b2, at = [0.05, 0, 0])]
    #[body(b2, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j3: revolute(x), b2 -> b3, at = [0.05, 0, 0])]
    #[body(b3, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j4: revolute(-y), b3 -> b4, at = [0.05, 0, 0])]
    #[body(b4, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j5: revolute([0, 1, 1]), b4 -> b5, at = [0.05, 0, 0], rpy = [0.2, -0.1, 0.3])]
    #[body(b5, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j6: revolute(-z), b5 -> b6, at = [0.05, 0, 0])]
    #[body(b6, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j7: revolute(z), b6 -> b7, at = [0.05, 0, 0])]
    #[body(b7, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j8: revolute(y), b7 -> b8, at = [0.05, 0, 0])]
    #[body(b8, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j9: prismatic(x), b8 -> b9, at = [0.05, 0, 0])]
    #[body(b9, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j10: revolute(x), b9 -> b10, at = [0.05, 0, 0], rpy = [0.2, -0.1, 0.3])]
    #[body(b10, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j11: revolute(-y), b10 -> b11, at = [0.05, 0, 0])]
    #[body(b11)]
    #[joint(j12: revolute([0, 1, 1]), b11 -> b12, at = [0.05, 0, 0])]
    #[body(b12, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j13: revolute(-z), b12 -> b13, at = [0.05, 0, 0])]
    #[body(b13, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j14: revolute(z), b13 -> b14, at = [0.05, 0, 0])]
    #[body(b14, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j15: revolute(y), b14 -> b15, at = [0.05, 0, 0], rpy = [0.2, -0.1, 0.3])]
    #[body(b15, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j16: revolute([1, 0, 0.5]), b15 -> b16, at = [0.05, 0, 0])]
    #[body(b16, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j17: revolute(x), b16 -> b17, at = [0.05, 0, 0])]
    #[body(b17, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j18: revolute(-y), b17 -> b18, at = [0.05, 0, 0])]
    #[body(b18, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j19: revolute([0, 1, 1]), b18 -> b19, at = [0.05, 0, 0])]
    #[body(b19, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j20: revolute(-z), b19 -> b20, at = [0.05, 0, 0], rpy = [0.2, -0.1, 0.3])]
    #[body(b20, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j21: revolute(z), b20 -> b21, at = [0.05, 0, 0])]
    #[body(b21, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j22: revolute(y), b21 -> b22, at = [0.05, 0, 0])]
    #[body(b22)]
    #[joint(j23: revolute([1, 0, 0.5]), b22 -> b23, at = [0.05, 0, 0])]
    #[body(b23, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j24: revolute(x), b23 -> b24, at = [0.05, 0, 0])]
    #[body(b24, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j25: revolute(-y), b24 -> b25, at = [0.05, 0, 0], rpy = [0.2, -0.1, 0.3])]
    #[body(b25, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j26: revolute([0, 1, 1]), b25 -> b26, at = [0.05, 0, 0])]
    #[body(b26, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j27: revolute(-z), b26 -> b27, at = [0.05, 0, 0])]
    #[body(b27, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j28: revolute(z), b27 -> b28, at = [0.05, 0, 0])]
    #[body(b28, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j29: revolute(y), b28 -> b29, at = [0.05, 0, 0])]
    #[body(b29, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j30: revolute([1, 0, 0.5]), b29 -> b30, at = [0.05, 0, 0], rpy = [0.2, -0.1, 0.3])]
    #[body(b30, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j31: revolute(x), b30 -> b31, at = [0.05, 0, 0])]
    #[body(b31, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j32: revolute(-y), b31 -> b32, at = [0.05, 0, 0])]
    #[body(b32, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j33: prismatic(x), b32 -> b33, at = [0.05, 0, 0])]
    #[body(b33)]
    #[joint(j34: revolute(-z), b33 -> b34, at = [0.05, 0, 0])]
    #[body(b34, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j35: revolute(z), b34 -> b35, at = [0.05, 0, 0], rpy = [0.2, -0.1, 0.3])]
    #[body(b35, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j36: revolute(y), b35 -> b36, at = [0.05, 0, 0])]
    #[body(b36, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j37: revolute([1, 0, 0.5]), b36 -> b37, at = [0.05, 0, 0])]
    #[body(b37, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j38: revolute(x), b37 -> b38, at = [0.05, 0, 0])]
    #[body(b38, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j39: revolute(-y), b38 -> b39, at = [0.05, 0, 0])]
    #[body(b39, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j40: revolute([0, 1, 1]), b39 -> b40, at = [0.05, 0, 0], rpy = [0.2, -0.1, 0.3])]
    #[body(b40, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j41: revolute(-z), b40 -> b41, at = [0.05, 0, 0])]
    #[body(b41, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j42: revolute(z), b41 -> b42, at = [0.05, 0, 0])]
    #[body(b42, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j43: revolute(y), b42 -> b43, at = [0.05, 0, 0])]
    #[body(b43, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j44: revolute([1, 0, 0.5]), b43 -> b44, at = [0.05, 0, 0])]
    #[body(b44)]
    #[joint(j45: revolute(x), b44 -> b45, at = [0.05, 0, 0], rpy = [0.2, -0.1, 0.3])]
    #[body(b45, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j46: revolute(-y), b45 -> b46, at = [0.05, 0, 0])]
    #[body(b46, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j47: revolute([0, 1, 1]), b46 -> b47, at = [0.05, 0, 0])]
    #[body(b47, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j48: revolute(-z), b47 -> b48, at = [0.05, 0, 0])]
    #[body(b48, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j49: revolute(z), b48 -> b49, at = [0.05, 0, 0])]
    #[body(b49, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j50: revolute(y), b49 -> b50, at = [0.05, 0, 0], rpy = [0.2, -0.1, 0.3])]
    #[body(b50, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    #[joint(j51: revolute([1, 0, 0.5]), b50 -> b51, at = [0.05, 0, 0])]
    #[body(b51, mass = 0.3, com = [0.02, 0.01, -0.005],
        inertia = tensor(0.0002, 0.00001, 0, 0.0003, 0.00002, 0.0003))]
    #[joint(j52: revolute(x), b51 -> b52, at = [0.05, 0, 0])]
    #[body(b52, mass = 0.2, com = [0.03, 0, 0.01], inertia = diag(0.0001, 0.0002, 0.0002))]
    pub struct Chain;
}
