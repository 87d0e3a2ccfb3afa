//! Two roads to the equations of motion, and the laws of mechanics they must both keep.
//!
//! The oracle (Newton–Euler, six-vectors) against Lagrange (energies, differentiated), on random trees with
//! oblique axes, branches, skewed inertias and mass at rest; and against what is true of every robot.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_codegen::mechanics::lagrange::{self, Coordinates, Lagrange};
use dynamics_codegen::mechanics::plain::{self, Dual, Oracle};
use dynamics_codegen::model::Tree;
use dynamics_codegen::spatial::{Matrix3, Pose, PseudoInertia};
use dynamics_codegen::symbolic::{Evaluator, Expr, Graph, Number, SymbolId};

mod random;

use random::{SHAPES, Shape, State, near_and_far, state, with_terms};

/// Two ways to one number in doubles. The trees have up to 7 links, so up to some 10³ rounded operations of
/// 1e-16 each lie on a path, most of them averaging out; the worst seen here is 2e-14.
const ROUNDING: f64 = 1e-12;

/// Central differences with the step 1e-5: the truncation is h² = 1e-10 times third derivatives, the rounding
/// 1e-16/h = 1e-11 of the function; the worst seen here is 8e-10 of the largest entry.
const DIFFERENCES: f64 = 2e-8;

fn for_each_state(check: impl Fn(&State)) {
    for seed in 0..60 {
        let n = 1 + seed as usize % 7;
        check(&state(seed, n, SHAPES[seed as usize % 3]));
    }
    for seed in 0..24 {
        let n = 1 + seed as usize % 4;
        check(&with_terms(state(200 + seed, n, SHAPES[seed as usize % 3]), seed));
    }
}

// ---- Comparison --------------------------------------------------------------------------------------------

fn assert_close(what: &str, found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{what}: sizes");
    let largest = found.iter().chain(expected).fold(1.0_f64, |l, x| l.max(x.abs()));
    for (i, (x, y)) in found.iter().zip(expected).enumerate() {
        let error = (x - y).abs() / largest;
        assert!(error <= tolerance, "{what}: entry {i} is {x}, expected {y}, off by {error:e} of {largest}");
    }
}

fn flat<T: Clone>(rows: &[Vec<T>]) -> Vec<T> {
    rows.concat()
}

fn times(A: &[Vec<f64>], x: &[f64]) -> Vec<f64> {
    A.iter().map(|row| dot(row, x)).collect()
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

fn plus(x: &[f64], y: &[f64]) -> Vec<f64> {
    x.iter().zip(y).map(|(x, y)| x + y).collect()
}

fn unit(n: usize, j: usize) -> Vec<f64> {
    (0..n).map(|i| f64::from(u8::from(i == j))).collect()
}

/// The columns `∂f/∂x_j` by central differences, laid out as the rows of `∂f/∂x`.
fn differences(f: impl Fn(&[f64]) -> Vec<f64>, x: &[f64]) -> Vec<f64> {
    let units: Vec<_> = (0..x.len()).map(|j| unit(x.len(), j)).collect();
    differences_along(&units, |step| f(&plus(x, step)))
}

/// The same in the tangent space of configurations: a step along a speed, and back to unit quaternions.
fn tangent_differences(tree: &Tree<f64>, f: impl Fn(&[f64]) -> Vec<f64>, q: &[f64]) -> Vec<f64> {
    let n = tree.dof();
    let rates: Vec<_> = (0..n).map(|j| tree.configuration_rate(q, &unit(n, j))).collect();
    differences_along(&rates, |step| {
        let mut q = plus(q, step);
        tree.normalise(&mut q);
        f(&q)
    })
}

fn differences_along(directions: &[Vec<f64>], f: impl Fn(&[f64]) -> Vec<f64>) -> Vec<f64> {
    let h = 1e-5;
    let columns: Vec<Vec<f64>> = directions
        .iter()
        .map(|direction| {
            let step = |h: f64| f(&direction.iter().map(|e| h * e).collect::<Vec<_>>());
            step(h).iter().zip(step(-h)).map(|(p, m)| (p - m) / (2.0 * h)).collect()
        })
        .collect();
    (0..columns[0].len()).flat_map(|i| columns.iter().map(move |column| column[i])).collect()
}

/// Where a tree stands is in no equation of motion. Each number of the one far away is as good as that near by: a way through
/// the world's origin would lose seven digits.
#[test]
fn no_digits_are_lost_far_from_the_worlds_origin() {
    for seed in 0..60 {
        let State { tree, q, v, a } = &state(seed, 1 + seed as usize % 7, SHAPES[seed as usize % 3]);
        let (near, far) = near_and_far(tree);
        let (near, far) = (Oracle::new(&near), Oracle::new(&far));
        let same = |what: &str, of: &dyn Fn(&Oracle<'_>) -> Vec<f64>| {
            assert_close(what, &of(&far), &of(&near), ROUNDING);
        };
        same("M", &|oracle| oracle.mass_matrix(q).concat());
        same("A", &|oracle| oracle.centroidal_momentum_matrix(q).concat());
        same("momentum", &|oracle| oracle.centroidal_momentum(q, v));
        for frame in 0..tree.frames.len() {
            same("J", &|oracle| oracle.body_jacobian(frame, q).concat());
            same("J of the world", &|oracle| oracle.world_jacobian(frame, q).concat());
            same("twist", &|oracle| oracle.velocity(frame, q, v));
            same("rate of the twist", &|oracle| oracle.acceleration(frame, q, v, a));
        }
    }
}

// ---- Oracle = Lagrange -------------------------------------------------------------------------------------

/// The inputs q, v and a, one after another.
fn symbols(tree: &Tree<f64>) -> [Vec<SymbolId>; 3] {
    let (nq, n) = (tree.coordinates(), tree.dof());
    [0..nq, nq..nq + n, nq + n..nq + 2 * n]
        .map(|ids| ids.map(|k| SymbolId(u32::try_from(k).expect("a small robot"))).collect())
}

fn constant<'g>(x: f64) -> Expr<'g> {
    Number::from_f64(x).expect("random numbers are finite").into()
}

fn agrees_with_lagrange(state: &State) {
    let State { tree, q, v, a } = state;
    let graph = Graph::new();
    let ids = symbols(tree);
    let at = Coordinates { q: &ids[0], v: &ids[1], a: &ids[2] };
    let Lagrange {
        kinetic_energy,
        potential_energy,
        mass_matrix,
        coriolis_matrix,
        gravity_forces,
        inverse_dynamics,
    } = lagrange::derive(&graph, &tree.map(constant), at);

    let oracle = Oracle::new(tree);
    let pairs = [
        ("T", vec![oracle.kinetic_energy(q, v)], vec![kinetic_energy]),
        ("V", vec![oracle.potential_energy(q)], vec![potential_energy]),
        ("L", vec![oracle.lagrangian(q, v)], vec![kinetic_energy - potential_energy]),
        ("M", flat(&oracle.mass_matrix(q)), flat(&mass_matrix)),
        ("C", flat(&oracle.coriolis_matrix(q, v)), flat(&coriolis_matrix)),
        ("G", oracle.gravity_forces(q), gravity_forces),
        ("tau", oracle.inverse_dynamics(q, v, a), inverse_dynamics),
    ];
    let inputs = [&q[..], v, a].concat();
    let mut evaluator = Evaluator::new(&graph, |symbol: SymbolId| inputs[symbol.0 as usize]);
    for (what, found, derived) in pairs {
        let derived: Vec<f64> = derived.into_iter().map(|expr| evaluator.value(expr)).collect();
        assert_close(what, &found, &derived, ROUNDING);
    }
}

#[test]
fn oracle_agrees_with_lagrange() {
    for seed in 100..124 {
        let n = 1 + seed as usize % 4;
        agrees_with_lagrange(&state(seed, n, SHAPES[seed as usize % 3]));
    }
}

/// Dual numbers and quadratic forms, and derivatives of expressions.
#[test]
fn oracle_agrees_with_lagrange_on_terms_of_the_energies() {
    for seed in 0..36 {
        let n = 1 + seed as usize % 3;
        agrees_with_lagrange(&with_terms(state(300 + seed, n, SHAPES[seed as usize % 3]), seed));
    }
}

#[test]
fn oracle_agrees_with_lagrange_on_an_arm_of_seven_joints() {
    agrees_with_lagrange(&state(7, 7, Shape::Chain));
}

/// The recursions, run on expressions and evaluated, are the recursions run on numbers.
#[test]
fn expressions_compute_what_numbers_compute() {
    for_each_state(|State { tree, q, v, a }| {
        let graph = Graph::new();
        let inputs = symbols(tree).map(|ids| ids.into_iter().map(|id| graph.symbol(id)).collect::<Vec<_>>());
        let derived = plain::inverse_dynamics(&tree.map(constant), &inputs[0], &inputs[1], &inputs[2]);
        let inputs = [&q[..], v, a].concat();
        let mut evaluator = Evaluator::new(&graph, |symbol: SymbolId| inputs[symbol.0 as usize]);
        let derived: Vec<f64> = derived.into_iter().map(|expr| evaluator.value(expr)).collect();
        assert_close("tau", &derived, &plain::inverse_dynamics(tree, q, v, a), ROUNDING);
    });
}

// ---- Laws --------------------------------------------------------------------------------------------------

#[test]
fn mass_matrix_is_the_columns_of_inverse_dynamics() {
    for_each_state(|State { tree, q, v, .. }| {
        let (oracle, n) = (Oracle::new(tree), v.len());
        let (M, h) = (oracle.mass_matrix(q), oracle.bias_forces(q, v));
        for j in 0..n {
            let column: Vec<f64> = M.iter().map(|row| row[j]).collect();
            assert_close("M = Mᵀ", &column, &M[j], ROUNDING);
            assert_close("column", &plus(&column, &h), &oracle.inverse_dynamics(q, v, &unit(n, j)), ROUNDING);
        }
    });
}

#[test]
fn coriolis_matrix_gives_the_bias_and_half_its_derivative() {
    for_each_state(|State { tree, q, v, a }| {
        let oracle = Oracle::new(tree);
        let C = oracle.coriolis_matrix(q, v);
        let bias = plus(&plus(&times(&C, v), &oracle.gravity_forces(q)), &oracle.passive_forces(q, v));
        assert_close("C·v + G", &bias, &oracle.bias_forces(q, v), ROUNDING);
        let has_passive =
            tree.links.iter().any(|link| link.passive.damping != 0.0) || !tree.terms.dissipation.is_empty();
        if has_passive || !tree.is_one_dof() {
            // Dampers add to ∂τ/∂v, and torsion parts it from 2C; differences check it there.
            return;
        }
        let twice: Vec<f64> = flat(&C).iter().map(|c| 2.0 * c).collect();
        let by_v = oracle.inverse_dynamics_derivatives(q, v, a).dtau_dv;
        assert_close("∂τ/∂v = 2C", &flat(&by_v), &twice, ROUNDING);
    });
}

/// `Ṁ = C + Cᵀ`: the Coriolis forces do no work of their own.
#[test]
fn mass_matrix_changes_by_the_coriolis_matrix() {
    for_each_state(|State { tree, q, v, .. }| {
        let moving = Dual::moving(q, &tree.configuration_rate(q, v));
        let rate = plain::mass_matrix(&tree.map(Dual::constant), &moving);
        let C = Oracle::new(tree).coriolis_matrix(q, v);
        let n = v.len();
        let sum: Vec<f64> = (0..n * n).map(|k| C[k / n][k % n] + C[k % n][k / n]).collect();
        let rate: Vec<f64> = flat(&rate).iter().map(|x| x.tangent).collect();
        assert_close("Ṁ", &rate, &sum, ROUNDING);
    });
}

#[test]
fn kinetic_energy_is_the_form_of_the_mass_matrix() {
    for_each_state(|State { tree, q, v, .. }| {
        let oracle = Oracle::new(tree);
        let form = dot(v, &times(&oracle.mass_matrix(q), v)) / 2.0;
        assert_close("T", &[oracle.kinetic_energy(q, v)], &[form], ROUNDING);
        assert!(form > 0.0, "mass in motion has energy");
    });
}

#[test]
fn gravity_forces_are_the_slope_of_the_potential_energy() {
    for_each_state(|State { tree, q, .. }| {
        let dual = tree.map(Dual::constant);
        let direction = |j| tree.configuration_rate(q, &unit(tree.dof(), j));
        let slope = |j| plain::potential_energy(&dual, &Dual::moving(q, &direction(j))).tangent;
        let slopes: Vec<f64> = (0..tree.dof()).map(slope).collect();
        assert_close("G", &Oracle::new(tree).gravity_forces(q), &slopes, ROUNDING);
    });
}

/// `vᵀτ = d(T + V)/dt + vᵀτ_passive`
#[test]
fn power_in_is_energy_gained() {
    for_each_state(|State { tree, q, v, a }| {
        let (dual, rate) = (tree.map(Dual::constant), tree.configuration_rate(q, v));
        let (q_moving, v_moving) = (Dual::moving(q, &rate), Dual::moving(v, a));
        let kinetic = plain::kinetic_energy(&dual, &q_moving, &v_moving).tangent;
        let gained = kinetic + plain::potential_energy(&dual, &q_moving).tangent;
        let oracle = Oracle::new(tree);
        let power = dot(v, &oracle.inverse_dynamics(q, v, a)) - dot(v, &oracle.passive_forces(q, v));
        assert_close("power", &[power], &[gained], ROUNDING);
    });
}

#[test]
fn forward_dynamics_undoes_inverse_dynamics() {
    for_each_state(|State { tree, q, v, a }| {
        let oracle = Oracle::new(tree);
        let tau = oracle.inverse_dynamics(q, v, a);
        let solved = oracle.forward_dynamics(q, v, &tau).expect("M of a physical tree is positive definite");
        // The residual is free of M's condition; the accelerations themselves are not, but these M are mild.
        assert!(oracle.forward_dynamics_residual(q, v, &tau, &solved) < ROUNDING);
        assert_close("a", &solved, a, ROUNDING);
        let wrong: Vec<f64> = solved.iter().map(|a| a * 1.001 + 0.001).collect();
        assert!(oracle.forward_dynamics_residual(q, v, &tau, &wrong) > 1e-6, "the residual sees an error");
    });
}

#[test]
fn derivatives_agree_with_differences() {
    for_each_state(|State { tree, q, v, a }| {
        let oracle = Oracle::new(tree);
        let exact = oracle.inverse_dynamics_derivatives(q, v, a);
        let by_q = tangent_differences(tree, |q| oracle.inverse_dynamics(q, v, a), q);
        assert_close("∂τ/∂q", &flat(&exact.dtau_dq), &by_q, DIFFERENCES);
        let by_v = differences(|v| oracle.inverse_dynamics(q, v, a), v);
        assert_close("∂τ/∂v", &flat(&exact.dtau_dv), &by_v, DIFFERENCES);
        let by_a = differences(|a| oracle.inverse_dynamics(q, v, a), a);
        assert_close("∂τ/∂a", &flat(&exact.dtau_da), &by_a, DIFFERENCES);
    });
}

#[test]
fn forward_derivatives_agree_with_differences() {
    for_each_state(|State { tree, q, v, a: tau }| {
        let oracle = Oracle::new(tree);
        let solve = |q: &[f64], v: &[f64], tau: &[f64]| {
            oracle.forward_dynamics(q, v, tau).expect("M of a physical tree is positive definite")
        };
        let mut exact = oracle.forward_dynamics_derivatives(q, v, tau).expect("M is positive definite");
        let by_q = tangent_differences(tree, |q| solve(q, v, tau), q);
        assert_close("∂a/∂q", &flat(&exact.da_dq), &by_q, DIFFERENCES);
        assert_close("∂a/∂v", &flat(&exact.da_dv), &differences(|v| solve(q, v, tau), v), DIFFERENCES);
        assert_close("∂a/∂τ", &flat(&exact.da_dtau), &differences(|tau| solve(q, v, tau), tau), DIFFERENCES);

        let a = solve(q, v, tau);
        assert!(oracle.forward_dynamics_derivatives_residual(q, v, &a, &exact) < ROUNDING);
        exact.da_dtau[0][0] *= 1.01;
        assert!(oracle.forward_dynamics_derivatives_residual(q, v, &a, &exact) > 1e-6, "it sees an error");
    });
}

/// `J v` is the velocity of the frame: `Rᵀṗ` and the vector of `RᵀṘ` in its own axes, `ṗ` and that of `ṘRᵀ` in
/// the world's.
#[test]
fn jacobians_are_the_velocities_of_poses() {
    for_each_state(|State { tree, q, v, .. }| {
        let oracle = Oracle::new(tree);
        let dual = tree.map(Dual::constant);
        for (k, frame) in dual.frames.iter().enumerate() {
            let moving = plain::pose(&dual, frame, &Dual::moving(q, &tree.configuration_rate(q, v)));
            let (still, rate) = (moving.map(|x| x.value), moving.map(|x| x.tangent));
            let numbers = |pose: Pose<f64>| [pose.rotation.0.concat(), pose.translation.0.to_vec()].concat();
            assert_close("a dual's value", &numbers(still), &numbers(oracle.pose(k, q)), ROUNDING);
            let R_T = still.rotation.transpose();
            let body = [(R_T * rate.translation).0, axis_of(R_T * rate.rotation)].concat();
            assert_close("body", &times(&oracle.body_jacobian(k, q), v), &body, ROUNDING);
            let world = [rate.translation.0, axis_of(rate.rotation * R_T)].concat();
            assert_close("world", &times(&oracle.world_jacobian(k, q), v), &world, ROUNDING);
        }
    });
}

/// `ω` of `ω̂`.
fn axis_of(skew: Matrix3<f64>) -> [f64; 3] {
    let [[_, _, y], [z, _, _], [_, x, _]] = skew.0;
    [x, y, z]
}

/// Mass at rest moves nothing, and has its share of the potential energy.
#[test]
fn mass_at_rest_has_potential_energy() {
    let State { mut tree, q, v, a } = state(3, 4, Shape::Branched);
    let with = (Oracle::new(&tree).inverse_dynamics(&q, &v, &a), Oracle::new(&tree).potential_energy(&q));
    let share = -tree.gravity.dot(tree.base.first);
    tree.base = PseudoInertia::zero();
    let without = Oracle::new(&tree);
    assert_eq!(with.0, without.inverse_dynamics(&q, &v, &a));
    assert_close("V", &[with.1], &[without.potential_energy(&q) + share], ROUNDING);
}
