//! Robots whose longest equations no straight line could hold: they are left to the run time's recursion over a table,
//! and must be the same equations.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

#[path = "long_robots/chain.rs"]
mod chain;
#[path = "long_robots/floating.rs"]
mod floating;
#[path = "long_robots/tree.rs"]
mod tree;

use dynamics_codegen::mechanics::plain::Oracle;
use dynamics_core::Mechanism;
use dynamics_tests::close::largest;
use dynamics_tests::roads::{generated, travel};
use dynamics_tests::zoo::Entry;
use dynamics_tests::{Part, Space, State, Vector};
use nalgebra::{SMatrix, SVector};

/// The robot in the zoo's terms.
fn entry<R: Mechanism>(source: &'static str, parts: &'static [Part]) -> Entry {
    let entry = Entry {
        name: R::NAME,
        source,
        parameters: &[],
        space: Space(parts),
        costs: R::COST,
        joint_names: R::JOINT_NAMES,
        body_names: R::BODY_NAMES,
        parameter_names: R::PARAMETER_NAMES,
        base_parameter_names: R::BASE_PARAMETER_NAMES,
        double: None,
        single: None,
        dual: None,
    };
    assert_eq!((entry.space.coordinates(), entry.space.speeds()), (R::NQ, R::NV));
    entry
}

/// Runs `check` with the plain recursion, at random states, and the forces of a unit of acceleration.
fn for_each_state(entry: &Entry, check: impl Fn(Oracle<'_>, &State, f64)) {
    travel(entry, |roads| {
        for state in entry.states(3) {
            let force = largest(&roads.oracle().mass_matrix(state.q.as_slice()).concat());
            check(roads.oracle(), &state, force);
        }
    });
}

fn fixed<const N: usize>(x: &Vector) -> SVector<f64, N> {
    SVector::from_column_slice(x.as_slice())
}

fn rows<const N: usize>(m: &SMatrix<f64, N, N>) -> Vec<f64> {
    m.transpose().as_slice().to_vec()
}

/// Whether these methods recurse over a table.
fn are_by_table(entry: &Entry, methods: &[&str]) -> bool {
    let text = generated(entry);
    let is_by_table = |method: &&str| {
        let (_, rest) = text.split_once(&format!("fn {method}")).expect("it is among the outputs");
        rest.split("fn ").next().is_some_and(|body| body.contains("__table"))
    };
    methods.iter().all(is_by_table)
}

/// Derives a robot with the configuration `parts`, and holds it against the plain recursion. A robot of a few outputs
/// only has no traits that a function could be generic over.
macro_rules! robot {
    ($name:ident, $parts:expr; $($item:tt)*) => {
        use dynamics_codegen::mechanics::plain::Rows;
        use dynamics_core::prelude::*;
        use dynamics_tests::close::ROUNDING;
        use dynamics_tests::zoo::Entry;
        use dynamics_tests::{Part, State as StateOf, Vector, assert_close};

        use crate::{fixed, for_each_state, rows};

        #[derive(Dynamics)]
        $($item)*

        fn entry() -> Entry {
            crate::entry::<$name>(stringify!($($item)*), $parts)
        }

        const NAME: &str = stringify!($name);
        type Square = SMatrix<f64, { $name::NV }, { $name::NV }>;

        #[test]
        fn equations_of_motion_by_the_table_agree_with_the_plain_recursion() {
            for_each_state(&entry(), |oracle, StateOf { q, v, a, .. }, force| {
                let [qs, vs, accelerations] = [q, v, a].map(Vector::as_slice);
                let (q, v, a) = (fixed(q), fixed(v), fixed(a));
                let EquationsOfMotion { mass_matrix, coriolis_matrix, gravity_forces } =
                    $name.equations_of_motion(&q, &v);
                let close = |what: &str, found: &[f64], expected: Vec<f64>| {
                    assert_close!(found, expected, ROUNDING, floor = force, "{NAME}: {what}");
                };
                close("M", &rows(&mass_matrix), oracle.mass_matrix(qs).concat());
                close("C", &rows(&coriolis_matrix), oracle.coriolis_matrix(qs, vs).concat());
                close("C alone", &rows(&$name.coriolis_matrix(&q, &v)), oracle.coriolis_matrix(qs, vs).concat());
                close("G", gravity_forces.as_slice(), oracle.gravity_forces(qs));
                let tau = $name.inverse_dynamics(&q, &v, &a);
                close("τ", tau.as_slice(), oracle.inverse_dynamics(qs, vs, accelerations));
            });
        }

        #[test]
        fn derivatives_by_the_table_agree_with_the_plain_recursion() {
            for_each_state(&entry(), |oracle, StateOf { q, v, a, .. }, force| {
                let [qs, vs, accelerations] = [q, v, a].map(Vector::as_slice);
                let exact = oracle.inverse_dynamics_derivatives(qs, vs, accelerations);
                let (q, v, a) = (fixed(q), fixed(v), fixed(a));
                let InverseDynamicsDerivatives { dtau_dq, dtau_dv, dtau_da } =
                    $name.inverse_dynamics_derivatives(&q, &v, &a);
                let close = |what: &str, found: &Square, expected: Vec<f64>| {
                    assert_close!(rows(found), expected, ROUNDING, floor = force, "{NAME}: {what}");
                };
                close("∂τ/∂q", &dtau_dq, exact.dtau_dq.concat());
                close("∂τ/∂v", &dtau_dv, exact.dtau_dv.concat());
                close("∂τ/∂a", &dtau_da, exact.dtau_da.concat());
            });
        }

        #[test]
        fn forward_dynamics_and_its_derivatives_answer_the_forces() {
            for_each_state(&entry(), |oracle, StateOf { q, v, tau, .. }, _| {
                let [qs, vs, forces] = [q, v, tau].map(Vector::as_slice);
                let (q, v, tau) = (fixed(q), fixed(v), fixed(tau));
                let a = $name.forward_dynamics(&q, &v, &tau);
                let residual = oracle.forward_dynamics_residual(qs, vs, forces, a.as_slice());
                assert!(residual <= ROUNDING, "{NAME}: a misses τ by {residual:.1e}");

                let exact = oracle.inverse_dynamics_derivatives(qs, vs, a.as_slice());
                let ForwardDynamicsDerivatives { da_dq, da_dv, da_dtau } =
                    $name.forward_dynamics_derivatives(&q, &v, &tau);
                let M = $name.equations_of_motion(&q, &v).mass_matrix;
                let solves = |what: &str, X: &Square, B: Vec<f64>| {
                    let terms = (M.abs() * X.abs()).amax();
                    assert_close!(rows(&(M * X)), B, ROUNDING, floor = terms, "{NAME}: M·{what}");
                };
                let negative = |block: Rows| block.concat().iter().map(|x| -x).collect::<Vec<f64>>();
                solves("∂a/∂q", &da_dq, negative(exact.dtau_dq));
                solves("∂a/∂v", &da_dv, negative(exact.dtau_dv));
                solves("∂a/∂τ", &da_dtau, rows(&Square::identity()));
            });
        }


        #[test]
        fn the_long_ones_are_by_the_table() {
            let methods = ["coriolis_matrix", "equations_of_motion", "inverse_dynamics_derivatives"];
            assert!(crate::are_by_table(&entry(), &methods));
        }
    };
}
pub(crate) use robot;
