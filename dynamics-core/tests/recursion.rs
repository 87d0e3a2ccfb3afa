//! The recursion over a table of links: against point masses, dual numbers and hand-written pendulums.
#![cfg(feature = "std")]

mod common;

use common::dual::{Dual, moving, resting, tangent};
use common::{DoublePendulum, G, Pendulum, Tool0, random_numbers, random_vector};
use dynamics_core::__private::recursion::{Link, Tree};
use dynamics_core::nalgebra::{Matrix3, Rotation3, Vector3};
use dynamics_core::prelude::*;

/// Roundings of long sums, relative to the largest entry.
const TOLERANCE: f64 = 1e-11;

/// The same behind a mass matrix of a hundred joints.
const TOLERANCE_OF_SOLUTIONS: f64 = 1e-8;

// Robots.

/// A robot as the recursion sees it, and as the point masses it is made of.
struct Robot<const N: usize> {
    tree: Tree<f64, N>,
    points: Vec<(Option<usize>, f64, Vector3<f64>)>,
}

#[derive(Clone, Copy)]
enum Shape {
    Chain,
    Branched,
}

fn rows(m: &Matrix3<f64>) -> [[f64; 3]; 3] {
    m.transpose().data.0
}

impl<const N: usize> Robot<N> {
    /// Oblique joints of both kinds, six point masses on each link, two in the world.
    fn random(shape: Shape, seed: u64) -> Self {
        let mut random = random_numbers(seed);
        let mut points = Vec::new();
        let mut add_points = |owner, count, random: &mut dyn FnMut() -> f64| {
            for _ in 0..count {
                points.push((owner, 0.3 + 0.2 * random(), Vector3::from_fn(|_, _| 0.4 * random())));
            }
        };
        add_points(None, 2, &mut random);
        let links = core::array::from_fn(|k| {
            add_points(Some(k), 6, &mut random);
            let back = match shape {
                Shape::Chain => 1,
                Shape::Branched => 1 + (2.0 * (random() + 1.0)) as usize,
            };
            let [roll, pitch, yaw]: [f64; 3] = core::array::from_fn(|_| 3.0 * random());
            Link {
                parent: k.checked_sub(back),
                prismatic: k % 3 == 2,
                rotation: rows(Rotation3::from_euler_angles(roll, pitch, yaw).matrix()),
                position: core::array::from_fn(|_| 0.3 * random()),
                mass: 0.0,
                first: [0.0; 3],
                second: [0.0; 6],
            }
        });
        let gravity = [0.7, -0.4, -9.81];
        let mut tree = Tree { links, base_mass: 0.0, base_first: [0.0; 3], gravity };
        for &(owner, m, r) in &points {
            tree.add_point(owner, m, r);
        }
        Self { tree, points }
    }

    /// Where each point mass is.
    fn positions<T: Scalar>(&self, q: &SVector<T, N>) -> impl Iterator<Item = (f64, SVector<T, 3>)> {
        let tree = lifted::<T, N>(&self.tree);
        let identity = rows(&Matrix3::identity()).map(|row| row.map(T::of));
        let mut poses: Vec<Pose<T>> = Vec::new();
        for (link, &q) in tree.links.iter().zip(q.iter()) {
            let parent = link.parent.map_or(Pose::identity(), |parent| poses[parent]);
            let fixed = Pose { rotation: by_rows(link.rotation), translation: link.position.into() };
            let (s, c) = q.sin_cos();
            let (o, i) = (T::zero(), T::one());
            poses.push(
                parent
                    * fixed
                    * if link.prismatic {
                        Pose { rotation: by_rows(identity), translation: [o, o, q].into() }
                    } else {
                        let about_z = by_rows([[c, -s, o], [s, c, o], [o, o, i]]);
                        Pose { rotation: about_z, translation: SVector::zeros() }
                    },
            );
        }
        self.points.iter().map(move |(owner, m, r)| {
            let pose = owner.map_or(Pose::identity(), |owner| poses[owner]);
            (*m, pose.transform_point(&r.map(T::of)))
        })
    }
}

fn by_rows<T: Scalar>(rows: [[T; 3]; 3]) -> SMatrix<T, 3, 3> {
    SMatrix::<T, 3, 3>::from(rows).transpose()
}

trait AddPoint {
    fn add_point(&mut self, owner: Option<usize>, m: f64, r: Vector3<f64>);
}

impl<const N: usize> AddPoint for Tree<f64, N> {
    fn add_point(&mut self, owner: Option<usize>, m: f64, r: Vector3<f64>) {
        let [[x, y, z]] = r.data.0;
        let Some(owner) = owner else {
            self.base_mass += m;
            self.base_first.iter_mut().zip([x, y, z]).for_each(|(h, x)| *h += m * x);
            return;
        };
        let link = &mut self.links[owner];
        link.mass += m;
        link.first.iter_mut().zip([x, y, z]).for_each(|(h, x)| *h += m * x);
        let products = [x * x, y * y, z * z, x * y, x * z, y * z];
        link.second.iter_mut().zip(products).for_each(|(sigma, x)| *sigma += m * x);
    }
}

/// The robot in another scalar.
fn lifted<T: Scalar, const N: usize>(tree: &Tree<f64, N>) -> Tree<T, N> {
    Tree {
        links: tree.links.map(|link| Link {
            parent: link.parent,
            prismatic: link.prismatic,
            rotation: link.rotation.map(|row| row.map(T::of)),
            position: link.position.map(T::of),
            mass: T::of(link.mass),
            first: link.first.map(T::of),
            second: link.second.map(T::of),
        }),
        base_mass: T::of(tree.base_mass),
        base_first: tree.base_first.map(T::of),
        gravity: tree.gravity.map(T::of),
    }
}

// Laws.

#[track_caller]
fn close<const R: usize, const C: usize>(a: &SMatrix<f64, R, C>, b: &SMatrix<f64, R, C>, tolerance: f64) {
    let (error, size) = ((a - b).amax(), b.amax());
    assert!(error <= tolerance * size.max(1e-3), "{error:e} of {size:e}");
}

#[track_caller]
fn close_numbers(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * b.abs().max(1e-3), "{a:e} is not {b:e}");
}

fn for_each_state<const N: usize>(
    mut check: impl FnMut(&Robot<N>, SVector<f64, N>, SVector<f64, N>, SVector<f64, N>),
) {
    for (shape, seed) in [(Shape::Chain, 1), (Shape::Branched, 2), (Shape::Branched, 3)] {
        let robot = Robot::random(shape, seed);
        let mut random = random_numbers(seed + 100);
        let [q, v, a] = core::array::from_fn(|_| random_vector(&mut random, 2.0));
        check(&robot, q, v, a);
    }
}

/// `T = Σ ½ m ṙ²`, `V = −Σ m g·r`, `L = T − V`, `½ vᵀMv = T`, `G = ∂V/∂q`.
fn energies<const N: usize>() {
    for_each_state::<N>(|robot, q, v, rate| {
        let tree = &robot.tree;
        let (mut kinetic, mut potential, mut power) = (0.0, 0.0, 0.0);
        let g = Vector3::from(tree.gravity);
        for (m, r) in robot.positions(&moving(&q, &v)) {
            kinetic += 0.5 * m * tangent(&r).norm_squared();
            potential -= m * g.dot(&r.map(|x| x.value));
        }
        for (m, r) in robot.positions(&moving(&q, &rate)) {
            power -= m * g.dot(&tangent(&r));
        }
        close_numbers(tree.kinetic_energy(&q, &v), kinetic, TOLERANCE);
        close_numbers(tree.potential_energy(&q), potential, TOLERANCE);
        close_numbers(tree.lagrangian(&q, &v), kinetic - potential, TOLERANCE);
        close_numbers(0.5 * v.dot(&(tree.mass_matrix(&q) * v)), kinetic, TOLERANCE);
        close_numbers(tree.gravity_forces(&q).dot(&rate), power, TOLERANCE);
    });
}

/// `C_ij = ½ Σ_k (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i) v_k`, entry by entry.
fn christoffel<const N: usize>() {
    for_each_state::<N>(|robot, q, v, _| {
        let dual = lifted::<Dual, N>(&robot.tree);
        let slopes: Vec<_> = (0..N)
            .map(|k| {
                let mut unit = SVector::zeros();
                unit[k] = 1.0;
                tangent(&dual.mass_matrix(&moving(&q, &unit)))
            })
            .collect();
        let expected = SMatrix::from_fn(|i, j| {
            let terms = (0..N).map(|k| (slopes[k][(i, j)] + slopes[j][(i, k)] - slopes[i][(j, k)]) * v[k]);
            0.5 * terms.sum::<f64>()
        });
        close(&robot.tree.coriolis_matrix(&q, &v), &expected, TOLERANCE);
    });
}

/// `Ṁ = C + Cᵀ`, `M = Mᵀ`, `τ = M a + C v + G`, and the bundle says what its parts say.
fn equations<const N: usize>() {
    for_each_state::<N>(|robot, q, v, a| {
        let tree = &robot.tree;
        let EquationsOfMotion { mass_matrix, coriolis_matrix, gravity_forces } =
            tree.equations_of_motion(&q, &v);
        assert_eq!(mass_matrix, tree.mass_matrix(&q));
        assert_eq!(coriolis_matrix, tree.coriolis_matrix(&q, &v));
        assert_eq!(gravity_forces, tree.gravity_forces(&q));
        assert_eq!(mass_matrix, mass_matrix.transpose());
        let bias = coriolis_matrix * v + gravity_forces;
        close(&tree.bias_forces(&q, &v), &bias, TOLERANCE);
        close(&tree.inverse_dynamics(&q, &v, &a), &(mass_matrix * a + bias), TOLERANCE);
        let rate = tangent(&lifted::<Dual, N>(tree).mass_matrix(&moving(&q, &v)));
        close(&(coriolis_matrix + coriolis_matrix.transpose()), &rate, TOLERANCE);
    });
}

/// The derivatives of inverse dynamics along random directions.
fn inverse_derivatives<const N: usize>() {
    for_each_state::<N>(|robot, q, v, a| {
        let dual = lifted::<Dual, N>(&robot.tree);
        let direction = random_vector::<N>(&mut random_numbers(7), 1.0);
        let InverseDynamicsDerivatives { dtau_dq, dtau_dv, dtau_da } =
            robot.tree.inverse_dynamics_derivatives(&q, &v, &a);
        let by_q = dual.inverse_dynamics(&moving(&q, &direction), &resting(&v), &resting(&a));
        let by_v = dual.inverse_dynamics(&resting(&q), &moving(&v, &direction), &resting(&a));
        let by_a = dual.inverse_dynamics(&resting(&q), &resting(&v), &moving(&a, &direction));
        close(&(dtau_dq * direction), &tangent(&by_q), TOLERANCE);
        close(&(dtau_dv * direction), &tangent(&by_v), TOLERANCE);
        close(&(dtau_da * direction), &tangent(&by_a), TOLERANCE);
    });
}

/// `ID ∘ FD` is the identity, and so are the derivatives of forward dynamics along random directions.
fn forward<const N: usize>() {
    for_each_state::<N>(|robot, q, v, tau| {
        let tree = &robot.tree;
        let a = tree.forward_dynamics(&q, &v, &tau);
        let scale = tree.mass_matrix(&q).amax() * a.amax();
        let error = (tree.inverse_dynamics(&q, &v, &a) - tau).amax();
        assert!(error <= TOLERANCE * scale, "{error:e} of {scale:e}");

        let dual = lifted::<Dual, N>(tree);
        let direction = random_vector::<N>(&mut random_numbers(8), 1.0);
        let ForwardDynamicsDerivatives { da_dq, da_dv, da_dtau } =
            tree.forward_dynamics_derivatives(&q, &v, &tau);
        let by_q = dual.forward_dynamics(&moving(&q, &direction), &resting(&v), &resting(&tau));
        let by_v = dual.forward_dynamics(&resting(&q), &moving(&v, &direction), &resting(&tau));
        let by_tau = dual.forward_dynamics(&resting(&q), &resting(&v), &moving(&tau, &direction));
        close(&(da_dq * direction), &tangent(&by_q), TOLERANCE_OF_SOLUTIONS);
        close(&(da_dv * direction), &tangent(&by_v), TOLERANCE_OF_SOLUTIONS);
        close(&(da_dtau * direction), &tangent(&by_tau), TOLERANCE_OF_SOLUTIONS);
    });
}

/// `J·v` is how the pose changes, in both kinds of axes, on every link and in the world.
fn frames<const N: usize>() {
    for_each_state::<N>(|robot, q, v, _| {
        let dual = lifted::<Dual, N>(&robot.tree);
        let rotation = Rotation3::from_euler_angles(0.3, -1.1, 2.0);
        let (rotation, translation) = (rows(rotation.matrix()), [0.2, -0.5, 0.4]);
        for link in (0..N).step_by(7).map(Some).chain([None, Some(N - 1)]) {
            let pose = dual.pose(
                link,
                rotation.map(|row| row.map(Dual::of)),
                translation.map(Dual::of),
                &moving(&q, &v),
            );
            let here = robot.tree.pose(link, rotation, translation, &q);
            close(&pose.rotation.map(|x| x.value), &here.rotation, TOLERANCE);
            close(&pose.translation.map(|x| x.value), &here.translation, TOLERANCE);
            let turning = tangent(&pose.rotation) * here.rotation.transpose();
            let w = Vector3::new(turning[(2, 1)], turning[(0, 2)], turning[(1, 0)]);
            let velocity = tangent(&pose.translation);

            let in_world = robot.tree.world_jacobian(link, rotation, translation, &q) * v;
            close(&in_world.fixed_rows::<3>(0).into_owned(), &velocity, TOLERANCE);
            close(&in_world.fixed_rows::<3>(3).into_owned(), &w, TOLERANCE);
            let in_frame = robot.tree.jacobian(link, rotation, translation, &q) * v;
            let to_frame = here.rotation.transpose();
            close(&in_frame.fixed_rows::<3>(0).into_owned(), &(to_frame * velocity), TOLERANCE);
            close(&in_frame.fixed_rows::<3>(3).into_owned(), &(to_frame * w), TOLERANCE);
        }
    });
}

fn with_stack(bytes: usize, run: impl FnOnce() + Send + 'static) {
    let thread = std::thread::Builder::new().stack_size(bytes).spawn(run).expect("a thread with its stack");
    if let Err(panic) = thread.join() {
        std::panic::resume_unwind(panic);
    }
}

macro_rules! for_every_size {
    ($($law:ident: $name:ident;)*) => {$(
        #[test]
        fn $name() {
            $law::<1>();
            $law::<2>();
            $law::<6>();
            $law::<12>();
            with_stack(16 << 20, $law::<100>); // for the matrices of the test itself, many and dual
        }
    )*};
}

for_every_size! {
    energies: energies_are_those_of_the_point_masses;
    equations: the_equations_of_motion_hold_together;
    inverse_derivatives: derivatives_of_inverse_dynamics_are_exact;
    forward: forward_dynamics_undoes_inverse_dynamics;
    frames: jacobians_are_the_rates_of_poses;
}

#[test]
fn the_coriolis_matrix_is_that_of_christoffel_symbols() {
    christoffel::<1>();
    christoffel::<2>();
    christoffel::<6>();
    christoffel::<12>();
}

/// A second opinion on the dual numbers.
#[test]
fn derivatives_of_forward_dynamics_are_quotients_of_differences() {
    const STEP: f64 = 1e-5;
    for_each_state::<6>(|robot, q, v, tau| {
        let tree = &robot.tree;
        let step = random_vector::<6>(&mut random_numbers(9), STEP);
        let derivatives = tree.forward_dynamics_derivatives(&q, &v, &tau);
        let by_q =
            tree.forward_dynamics(&(q + step), &v, &tau) - tree.forward_dynamics(&(q - step), &v, &tau);
        let by_v =
            tree.forward_dynamics(&q, &(v + step), &tau) - tree.forward_dynamics(&q, &(v - step), &tau);
        close(&(derivatives.da_dq * step / STEP), &(by_q / (2.0 * STEP)), 1e-6);
        close(&(derivatives.da_dv * step / STEP), &(by_v / (2.0 * STEP)), 1e-6);
        close(&(derivatives.da_dtau * tree.mass_matrix(&q)), &SMatrix::identity(), 1e-9);
    });
}

// Closed forms.

/// z along the world's x, −y downwards.
const HANGING: [[f64; 3]; 3] = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// Point masses on massless rods about the world's x axis, hanging along −z.
fn pendulums<const N: usize>(m: f64, l: f64) -> Tree<f64, N> {
    let links = core::array::from_fn(|k| Link {
        parent: k.checked_sub(1),
        prismatic: false,
        rotation: if k == 0 { HANGING } else { rows(&Matrix3::identity()) },
        position: if k == 0 { [0.0; 3] } else { [0.0, -l, 0.0] },
        mass: 0.0,
        first: [0.0; 3],
        second: [0.0; 6],
    });
    let mut tree = Tree { links, base_mass: 0.0, base_first: [0.0; 3], gravity: [0.0, 0.0, -G] };
    (0..N).for_each(|k| tree.add_point(Some(k), m, Vector3::new(0.0, -l, 0.0)));
    tree
}

#[test]
fn agrees_with_the_pendulum_of_the_textbook() {
    let (m, l) = (0.7, 1.3);
    let (tree, pendulum) = (pendulums::<1>(m, l), Pendulum { m, l, damping: 0.0 });
    let ([q, v, tau], t) = ([0.9, -2.0, 0.4].map(|x| SVector::from([x])), TOLERANCE);
    close(&tree.mass_matrix(&q), &pendulum.mass_matrix(&q), t);
    close(&tree.coriolis_matrix(&q, &v), &pendulum.coriolis_matrix(&q, &v), t);
    close(&tree.gravity_forces(&q), &pendulum.gravity_forces(&q), t);
    close(&tree.forward_dynamics(&q, &v, &tau), &pendulum.forward_dynamics(&q, &v, &tau), t);
    close_numbers(tree.lagrangian(&q, &v), pendulum.lagrangian(&q, &v), t);
}

#[test]
fn agrees_with_the_double_pendulum_of_the_textbook() {
    let (tree, robot, t) = (pendulums::<2>(1.0, 1.0), DoublePendulum, TOLERANCE);
    let [q, v, a] = [[0.9, -0.5], [1.7, -2.0], [0.3, 4.0]].map(SVector::from);
    close(&tree.mass_matrix(&q), &robot.mass_matrix(&q), t);
    close(&tree.coriolis_matrix(&q, &v), &robot.coriolis_matrix(&q, &v), t);
    close(&tree.bias_forces(&q, &v), &robot.bias_forces(&q, &v), t);
    close(&tree.forward_dynamics(&q, &v, &a), &robot.forward_dynamics(&q, &v, &a), t);
    let (own, theirs) =
        (tree.inverse_dynamics_derivatives(&q, &v, &a), robot.inverse_dynamics_derivatives(&q, &v, &a));
    close(&own.dtau_dq, &theirs.dtau_dq, t);
    close(&own.dtau_dv, &theirs.dtau_dv, t);
    let (own, theirs) =
        (tree.forward_dynamics_derivatives(&q, &v, &a), robot.forward_dynamics_derivatives(&q, &v, &a));
    close(&own.da_dq, &theirs.da_dq, t);
    close(&own.da_dv, &theirs.da_dv, t);

    let (link, rotation, translation) = (Some(1), HANGING, [0.0, -1.0, 0.0]);
    let rotation = rows(&by_rows(rotation).transpose());
    let (own, theirs) =
        (tree.pose(link, rotation, translation, &q), <Tool0 as Frame<_, f64, 2, 2>>::pose(&robot, &q));
    close(&own.rotation, &theirs.rotation, t);
    close(&own.translation, &theirs.translation, t);
    close(&tree.jacobian(link, rotation, translation, &q), &Tool0::jacobian(&robot, &q), t);
    close(&tree.world_jacobian(link, rotation, translation, &q), &Tool0::world_jacobian(&robot, &q), t);
}

#[test]
fn single_precision_agrees_with_double() {
    for_each_state::<12>(|robot, q, v, tau| {
        let single = lifted::<f32, 12>(&robot.tree);
        let [q32, v32, tau32] = [q, v, tau].map(|x| x.map(|x| x as f32));
        let a = single.inverse_dynamics(&q32, &v32, &tau32).map(f64::from);
        close(&a, &robot.tree.inverse_dynamics(&q, &v, &tau), 1e-4);
        let c = single.coriolis_matrix(&q32, &v32).map(f64::from);
        close(&c, &robot.tree.coriolis_matrix(&q, &v), 1e-4);
    });
}

/// Unoptimised, and with the results (up to 240 kB) on the same stack.
#[test]
fn a_hundred_joints_fit_on_a_small_stack() {
    type Call = fn(&Tree<f64, 100>, &SVector<f64, 100>) -> f64;
    let calls: [Call; 6] = [
        |tree, x| tree.inverse_dynamics(x, x, x)[0],
        |tree, x| tree.forward_dynamics(x, x, x)[0],
        |tree, x| tree.lagrangian(x, x),
        |tree, x| tree.equations_of_motion(x, x).coriolis_matrix[0],
        |tree, x| tree.inverse_dynamics_derivatives(x, x, x).dtau_dq[0],
        |tree, x| tree.forward_dynamics_derivatives(x, x, x).da_dq[0],
    ];
    let tree = Box::new(Robot::<100>::random(Shape::Chain, 4).tree);
    for call in calls {
        let tree = tree.clone();
        with_stack(1_500 << 10, move || assert!(call(&tree, &SVector::repeat(0.5)).is_finite()));
    }
}

/// A parent that is not smaller is the world: nothing panics, nothing runs for ever.
#[test]
fn a_malformed_tree_is_still_a_tree() {
    let mut malformed = Robot::<3>::random(Shape::Chain, 5).tree;
    let mut rooted = malformed;
    for (link, parent) in malformed.links.iter_mut().zip([0, 2, 100]) {
        link.parent = Some(parent);
    }
    rooted.links.iter_mut().for_each(|link| link.parent = None);
    let x = SVector::from([0.4, -1.0, 2.0]);
    assert_eq!(malformed.mass_matrix(&x), rooted.mass_matrix(&x));
    assert_eq!(
        malformed.forward_dynamics_derivatives(&x, &x, &x),
        rooted.forward_dynamics_derivatives(&x, &x, &x)
    );
    let (axes, origin) = (rows(&Matrix3::identity()), [0.0; 3]);
    assert_eq!(malformed.pose(Some(2), axes, origin, &x), rooted.pose(Some(2), axes, origin, &x));
    assert_eq!(malformed.pose(Some(9), axes, origin, &x), Pose::identity());
}
