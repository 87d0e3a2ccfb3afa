//! Two roads to the equations of motion, and the laws of mechanics they must both keep.
//!
//! The oracle (Newton–Euler, six-vectors) against Lagrange (energies, differentiated), on random trees with
//! oblique axes, branches, skewed inertias and mass at rest; and against what is true of every robot.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_codegen::mechanics::lagrange::{self, Coordinates, Lagrange};
use dynamics_codegen::mechanics::plain::{self, Dual, Oracle};
use dynamics_codegen::model::{Frame, Link, Motion, Tree};
use dynamics_codegen::spatial::{Matrix3, Pose, PseudoInertia, Symmetric3, Vector3};
use dynamics_codegen::symbolic::{Evaluator, Expr, Graph, Number, SymbolId};

/// Two ways to one number in doubles. The trees have up to 7 links, so up to some 10³ rounded operations of
/// 1e-16 each lie on a path, most of them averaging out; the worst seen here is 2e-14.
const ROUNDING: f64 = 1e-12;

/// Central differences with the step 1e-5: the truncation is h² = 1e-10 times third derivatives, the rounding
/// 1e-16/h = 1e-11 of the function; the worst seen here is 8e-10 of the largest entry.
const DIFFERENCES: f64 = 2e-8;

// ---- Random robots -----------------------------------------------------------------------------------------

/// Marsaglia's xorshift64.
struct Random(u64);

impl Random {
    /// Uniform in −1..1.
    fn symmetric(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn chance(&mut self) -> bool {
        self.symmetric() < 0.0
    }

    fn below(&mut self, n: usize) -> usize {
        (((self.symmetric() + 1.0) / 2.0 * n as f64) as usize).min(n - 1)
    }

    fn vector(&mut self, size: f64) -> Vector3<f64> {
        Vector3([self.symmetric(), self.symmetric(), self.symmetric()]).scale(size)
    }

    fn numbers(&mut self, n: usize, size: f64) -> Vec<f64> {
        (0..n).map(|_| size * self.symmetric()).collect()
    }

    fn pose(&mut self) -> Pose<f64> {
        let [r, p, y] = self.vector(3.0).0;
        let rotation = Matrix3::rotation_z(y.cos(), y.sin())
            * Matrix3::rotation_y(p.cos(), p.sin())
            * Matrix3::rotation_x(r.cos(), r.sin());
        Pose { rotation, translation: self.vector(0.6) }
    }

    /// Six point masses, off the origin: full in every moment, and physical by construction.
    fn body(&mut self) -> PseudoInertia<f64> {
        let offset = self.vector(0.3);
        (0..6).fold(PseudoInertia::zero(), |sum, _| {
            sum + point(0.2 + self.symmetric().abs(), offset + self.vector(0.4))
        })
    }

    fn tree(&mut self, n: usize, shape: Shape) -> Tree<f64> {
        let links: Vec<Link<f64>> = (0..n)
            .map(|k| Link {
                parent: match shape {
                    Shape::Chain => k.checked_sub(1),
                    // Sometimes a second tree on the same world.
                    Shape::Branched => self.below(k + 1).checked_sub(1),
                },
                motion: if shape == Shape::Branched && self.chance() {
                    Motion::Prismatic
                } else {
                    Motion::Revolute
                },
                placement: self.pose(),
                // A massless link between joints is legal, as long as something follows it.
                inertia: if k == 1 && shape == Shape::Chain && n > 3 {
                    PseudoInertia::zero()
                } else {
                    self.body()
                },
            })
            .collect();
        let carriers = (0..n).map(Some).chain([None]);
        let frames = carriers.map(|link| Frame { name: format!("on {link:?}"), link, pose: self.pose() });
        let frames = frames.collect();
        Tree { links, base: self.body(), frames, gravity: self.vector(10.0) }
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Shape {
    Chain,
    Branched,
}

/// The mass `m` at the point `r`.
fn point(m: f64, r: Vector3<f64>) -> PseudoInertia<f64> {
    PseudoInertia::new(m, r, Symmetric3::zero())
}

/// A robot in motion.
struct State {
    tree: Tree<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    a: Vec<f64>,
}

fn state(seed: u64, n: usize, shape: Shape) -> State {
    let mut random = Random(0x9E37_79B9_7F4A_7C15 ^ seed.wrapping_mul(0xD134_2543_DE82_EF95));
    // The first numbers of nearby seeds resemble each other.
    random.numbers(20, 1.0);
    let tree = random.tree(n, shape);
    State { tree, q: random.numbers(n, 3.0), v: random.numbers(n, 2.0), a: random.numbers(n, 4.0) }
}

fn for_each_state(check: impl Fn(&State)) {
    for seed in 0..60 {
        let n = 1 + seed as usize % 7;
        check(&state(seed, n, if seed % 3 == 0 { Shape::Chain } else { Shape::Branched }));
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
    let h = 1e-5;
    let columns: Vec<Vec<f64>> = (0..x.len())
        .map(|j| {
            let step = |h: f64| f(&plus(x, &unit(x.len(), j).iter().map(|e| h * e).collect::<Vec<_>>()));
            step(h).iter().zip(step(-h)).map(|(p, m)| (p - m) / (2.0 * h)).collect()
        })
        .collect();
    (0..columns[0].len()).flat_map(|i| columns.iter().map(move |column| column[i])).collect()
}

// ---- Oracle = Lagrange -------------------------------------------------------------------------------------

fn symbols(n: usize, block: usize) -> Vec<SymbolId> {
    (0..n).map(|k| SymbolId(u32::try_from(block * n + k).expect("a small robot"))).collect()
}

fn constant<'g>(x: f64) -> Expr<'g> {
    Number::from_f64(x).expect("random numbers are finite").into()
}

fn agrees_with_lagrange(state: &State) {
    let State { tree, q, v, a } = state;
    let (graph, n) = (Graph::new(), tree.dof());
    let at = Coordinates { q: &symbols(n, 0), v: &symbols(n, 1), a: &symbols(n, 2) };
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
    for seed in 100..112 {
        let n = 1 + seed as usize % 4;
        agrees_with_lagrange(&state(seed, n, if seed % 3 == 0 { Shape::Chain } else { Shape::Branched }));
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
        let input =
            |block| symbols(q.len(), block).into_iter().map(|id| graph.symbol(id)).collect::<Vec<_>>();
        let derived = plain::inverse_dynamics(&tree.map(constant), &input(0), &input(1), &input(2));
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
        let (oracle, n) = (Oracle::new(tree), q.len());
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
        let bias = plus(&times(&C, v), &oracle.gravity_forces(q));
        assert_close("C·v + G", &bias, &oracle.bias_forces(q, v), ROUNDING);
        let twice: Vec<f64> = flat(&C).iter().map(|c| 2.0 * c).collect();
        let by_v = oracle.inverse_dynamics_derivatives(q, v, a).dtau_dv;
        assert_close("∂τ/∂v = 2C", &flat(&by_v), &twice, ROUNDING);
    });
}

/// `Ṁ = C + Cᵀ`: the Coriolis forces do no work of their own.
#[test]
fn mass_matrix_changes_by_the_coriolis_matrix() {
    for_each_state(|State { tree, q, v, .. }| {
        let rate = plain::mass_matrix(&tree.map(Dual::constant), &Dual::moving(q, v));
        let C = Oracle::new(tree).coriolis_matrix(q, v);
        let n = q.len();
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
        let slope = |j| plain::potential_energy(&dual, &Dual::moving(q, &unit(q.len(), j))).tangent;
        let slopes: Vec<f64> = (0..q.len()).map(slope).collect();
        assert_close("G", &Oracle::new(tree).gravity_forces(q), &slopes, ROUNDING);
    });
}

/// `vᵀτ = d(T + V)/dt`
#[test]
fn power_in_is_energy_gained() {
    for_each_state(|State { tree, q, v, a }| {
        let (dual, q_moving, v_moving) = (tree.map(Dual::constant), Dual::moving(q, v), Dual::moving(v, a));
        let kinetic = plain::kinetic_energy(&dual, &q_moving, &v_moving).tangent;
        let gained = kinetic + plain::potential_energy(&dual, &q_moving).tangent;
        let power = dot(v, &Oracle::new(tree).inverse_dynamics(q, v, a));
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
        let by_q = differences(|q| oracle.inverse_dynamics(q, v, a), q);
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
        assert_close("∂a/∂q", &flat(&exact.da_dq), &differences(|q| solve(q, v, tau), q), DIFFERENCES);
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
            let moving = plain::pose(&dual, frame, &Dual::moving(q, v));
            let (still, rate) = (moving.map(|x| x.value), moving.map(|x| x.tangent));
            assert_eq!(still, oracle.pose(k, q), "the value of a dual is the number");
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
