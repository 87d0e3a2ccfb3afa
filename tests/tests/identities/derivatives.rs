//! The derivatives of inverse and forward dynamics, in the tangent space, and the linear models of them.

use dynamics_tests::close::{DIFFERENCES, ROUNDING};
use dynamics_tests::{Dual, Matrix, State, assert_close};

use crate::{
    DUAL, close, for_each_dual_state, for_each_state, forces, jacobian_by_differences, moving, unit,
};

#[test]
fn derivatives_of_inverse_dynamics_agree_with_differences() {
    for_each_state(|name, robot, state| {
        let State { q, v, a, .. } = state;
        let [dtau_dq, dtau_dv, dtau_da] = robot.inverse_dynamics_derivatives(q, v, a);
        // Friction changes within its speed, of a tenth: its third derivative is that much larger.
        let size = forces(robot, state) + dtau_dv.amax();
        let n = v.len();
        let by_q =
            jacobian_by_differences(n, |delta| robot.inverse_dynamics(&robot.integrate(q, delta), v, a));
        close("∂τ/∂q", name, &dtau_dq, &by_q, DIFFERENCES, size);
        let by_v = jacobian_by_differences(n, |dv| robot.inverse_dynamics(q, &(v + dv), a));
        close("∂τ/∂v", name, &dtau_dv, &by_v, DIFFERENCES, size);
        let by_a = jacobian_by_differences(n, |da| robot.inverse_dynamics(q, v, &(a + da)));
        close("∂τ/∂a", name, &dtau_da, &by_a, DIFFERENCES, size);
        assert_close!(dtau_da.as_slice(), robot.mass_matrix(q).as_slice(), ROUNDING, "{name}: ∂τ/∂a = M");
    });
}

#[test]
fn derivatives_of_inverse_dynamics_are_those_of_dual_numbers() {
    for_each_dual_state(|entry, robot, dual, State { q, v, a, .. }| {
        let [dtau_dq, dtau_dv, _] = robot.inverse_dynamics_derivatives(q, v, a);
        let size = robot.mass_matrix(q).amax();
        let (still_q, still_v, still_a) = (Dual::resting(q), Dual::resting(v), Dual::resting(a));
        for j in 0..v.len() {
            let unit = unit(v.len(), j);
            let by_q = dual.inverse_dynamics(&moving(entry, q, &unit), &still_v, &still_a);
            let by_v = dual.inverse_dynamics(&still_q, &Dual::moving(v, &unit), &still_a);
            let blocks = [("∂τ/∂q", by_q, &dtau_dq), ("∂τ/∂v", by_v, &dtau_dv)];
            for (what, column, block) in blocks {
                let expected: Vec<f64> = column.iter().map(|tau| tau.tangent).collect();
                let found = block.column(j).iter().copied().collect::<Vec<_>>();
                let size = size.max(block.amax());
                assert_close!(found, expected, DUAL, floor = size, "{}: {what}, column {j}", entry.name);
            }
        }
    });
}

#[test]
fn derivatives_of_forward_dynamics_follow_from_those_of_inverse_dynamics() {
    for_each_state(|name, robot, State { q, v, tau, .. }| {
        let a = robot.forward_dynamics(q, v, tau);
        let [dtau_dq, dtau_dv, M] = robot.inverse_dynamics_derivatives(q, v, &a);
        let [da_dq, da_dv, da_dtau] = robot.forward_dynamics_derivatives(q, v, tau);
        let solves = |what: &str, X: &Matrix, B: &Matrix| {
            let terms = (M.abs() * X.abs()).amax().max(M.amax());
            close(what, name, &(&M * X), B, ROUNDING, terms);
        };
        solves("M·∂a/∂q = −∂τ/∂q", &da_dq, &-dtau_dq);
        solves("M·∂a/∂v = −∂τ/∂v", &da_dv, &-dtau_dv);
        solves("M·∂a/∂τ = 1", &da_dtau, &Matrix::identity(v.len(), v.len()));
        let asymmetry = (&da_dtau - da_dtau.transpose()).amax();
        assert!(asymmetry <= ROUNDING * da_dtau.amax(), "{name}: M⁻¹ is symmetric");
    });
}

#[test]
fn derivatives_of_forward_dynamics_are_those_of_dual_numbers() {
    for_each_dual_state(|entry, robot, dual, State { q, v, a, tau }| {
        let [da_dq, da_dv, da_dtau] = robot.forward_dynamics_derivatives(q, v, tau);
        // All directions at once: q along v, v along a, τ along itself.
        let all = dual.forward_dynamics(&moving(entry, q, v), &Dual::moving(v, a), &Dual::moving(tau, tau));
        let found = &da_dq * v + &da_dv * a + &da_dtau * tau;
        let expected: Vec<f64> = all.iter().map(|a| a.tangent).collect();
        let values = robot.mass_matrix(q).symmetric_eigenvalues();
        let tolerance = DUAL.max(8.0 * f64::EPSILON * values.max() / values.min());
        let terms = (da_dq.abs() * v.abs() + da_dv.abs() * a.abs() + da_dtau.abs() * tau.abs()).amax();
        assert_close!(found.as_slice(), expected, tolerance, floor = terms, "{}: ȧ", entry.name);
    });
}

/// `A = [∂δ̇/∂δ 1; ∂a/∂q ∂a/∂v]`, `B = [0; M⁻¹·B_u]`, and the drift is where the state goes.
#[test]
fn linearisation_is_made_of_the_derivatives() {
    for_each_state(|name, robot, State { q, v, tau, .. }| {
        let (n, input_map) = (v.len(), robot.input_map());
        let u = tau.rows(0, input_map.ncols()).into_owned();
        let tau = &input_map * &u;
        let (a, [da_dq, da_dv, da_dtau]) = robot.forward_dynamics_with_derivatives([q, v, &tau]);
        let (A, B, drift) = robot.linearize(q, v, &u);
        let block = |m: &Matrix, i, j| m.view((i * n, j * n), (n, n)).into_owned();
        assert_eq!(block(&A, 0, 0), robot.tangent_rate(v), "{name}");
        assert_eq!(block(&A, 0, 1), Matrix::identity(n, n), "{name}");
        assert_eq!((block(&A, 1, 0), block(&A, 1, 1)), (da_dq, da_dv), "{name}");
        assert_eq!(B.rows(0, n), Matrix::zeros(n, u.len()), "{name}");
        close("M⁻¹·B_u", name, &B.rows(n, n).into_owned(), &(da_dtau * input_map), ROUNDING, 0.0);
        assert_eq!(drift.as_slice(), [v.as_slice(), a.as_slice()].concat(), "{name}");
    });
}

/// Where `f(x, u) = (δ̇, v̇)` goes beside the state, by differences on the manifold.
#[test]
fn linearisation_agrees_with_differences() {
    for_each_state(|name, robot, State { q, v, tau, .. }| {
        let (n, input_map) = (v.len(), robot.input_map());
        let u = tau.rows(0, input_map.ncols()).into_owned();
        let (A, B, drift) = robot.linearize(q, v, &u);
        let acceleration = |q: &_, v: &_, u: &_| robot.forward_dynamics(q, v, &(&input_map * u));
        let lower = |by_q: Matrix, by_v: Matrix| {
            let mut both = Matrix::zeros(n, 2 * n);
            both.columns_mut(0, n).copy_from(&by_q);
            both.columns_mut(n, n).copy_from(&by_v);
            both
        };
        let found = lower(
            jacobian_by_differences(n, |delta| acceleration(&robot.integrate(q, delta), v, &u)),
            jacobian_by_differences(n, |dv| acceleration(q, &(v + dv), &u)),
        );
        // What is differentiated has rounding by the condition of M, a hundred-thousandfold in the quotient.
        let values = robot.mass_matrix(q).symmetric_eigenvalues();
        let condition = values.max() / values.min();
        let tolerance = 10.0 * DIFFERENCES + 1e-11 * condition;
        let size = drift.amax() + A.amax();
        close("A", name, &A.rows(n, n).into_owned(), &found, tolerance, size);
        if !u.is_empty() {
            let found = jacobian_by_differences(u.len(), |du| acceleration(q, v, &(&u + du)));
            close("B", name, &B.rows(n, n).into_owned(), &found, tolerance, size);
        }
    });
}
