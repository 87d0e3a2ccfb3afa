//! What holds for every robot: against point masses, by dual numbers, and between the methods.

use dynamics_core::__private::recursion::Passive;
use dynamics_core::nalgebra::{Rotation3, Vector3};
use dynamics_core::prelude::*;

use super::robots::{Robot, Shape, lifted, rows};
use super::{TOLERANCE, TOLERANCE_OF_SOLUTIONS, close, close_numbers, with_stack};
use crate::common::dual::{Dual, moving, resting, tangent};
use crate::common::{random_numbers, random_vector};

type State<const NQ: usize, const NV: usize> = (SVector<f64, NQ>, SVector<f64, NV>, SVector<f64, NV>);

pub(crate) fn for_each_state<const NL: usize, const NQ: usize, const NV: usize>(
    joints: &str,
    mut check: impl FnMut(&Robot<NL, NQ, NV>, State<NQ, NV>),
) {
    let shapes = [(Shape::Chain, 1), (Shape::Branched, 2), (Shape::Branched, 3), (Shape::Backwards, 4)];
    for (shape, seed) in shapes {
        let robot = Robot::random(joints, shape, seed);
        let mut random = random_numbers(seed + 100);
        let q = robot.random_coordinates(&mut random, 2.0);
        let [v, a] = core::array::from_fn(|_| random_vector(&mut random, 2.0));
        check(&robot, (q, v, a));
    }
}

/// `T = Σ ½ m ṙ² + Σ ½ armature s²`, `V = −Σ m g·r`, `L = T − V`, `½ vᵀMv = T`, `G = ∂V/∂q`.
fn energies<const NL: usize, const NQ: usize, const NV: usize>(joints: &str) {
    for_each_state::<NL, NQ, NV>(joints, |robot, (q, v, rate)| {
        let tree = &robot.tree;
        let (mut kinetic, mut potential, mut power) = (0.0, 0.0, 0.0);
        let g = Vector3::from(tree.gravity);
        for (m, r) in robot.positions(&robot.flow(&q, &v), true) {
            kinetic += 0.5 * m * tangent(&r).norm_squared();
            potential -= m * g.dot(&r.map(|x| x.value));
        }
        for (m, r) in robot.positions(&robot.flow(&q, &rate), true) {
            power -= m * g.dot(&tangent(&r));
        }
        for (m, r) in robot.positions(&q, false) {
            potential -= m * g.dot(&r);
        }
        for (drive, passive) in robot.driven() {
            kinetic += 0.5 * passive.armature * (drive.ratio * v[drive.v]).powi(2);
        }
        close_numbers(tree.kinetic_energy(&q, &v), kinetic, TOLERANCE);
        close_numbers(tree.potential_energy(&q), potential, TOLERANCE);
        close_numbers(tree.lagrangian(&q, &v), kinetic - potential, TOLERANCE);
        close_numbers(0.5 * v.dot(&(tree.mass_matrix(&q) * v)), kinetic, TOLERANCE);
        close_numbers(tree.gravity_forces(&q).dot(&rate), power, TOLERANCE);
    });
}

/// Each joint's own law, and `∂E/∂q` for the springs.
fn passive_forces<const NL: usize, const NQ: usize, const NV: usize>(joints: &str) {
    for_each_state::<NL, NQ, NV>(joints, |robot, (q, v, rate)| {
        let (mut forces, mut energy, mut power) = (SVector::<f64, NV>::zeros(), 0.0, 0.0);
        for (drive, passive) in robot.driven() {
            let stretch = drive.ratio * q[drive.q] + drive.offset - passive.rest;
            let spring = passive.stiffness * stretch;
            energy += 0.5 * spring * stretch;
            power += drive.ratio * rate[drive.v] * spring;
            forces[drive.v] += drive.ratio * (spring + resistance(&passive, drive.ratio * v[drive.v]));
        }
        let dual = lifted::<Dual, NL, NQ, NV>(&robot.tree);
        close(&robot.tree.passive_forces(&q, &v), &forces, TOLERANCE);
        close_numbers(robot.tree.elastic_energy(&q), energy, TOLERANCE);
        close_numbers(dual.elastic_energy(&robot.flow(&q, &rate)).tangent, power, TOLERANCE);
    });
}

/// Of damping and friction.
fn resistance(passive: &Passive<f64>, speed: f64) -> f64 {
    let dry = passive.friction.map_or(0.0, |friction| friction.force * speed / speed.hypot(friction.speed));
    passive.damping * speed + dry
}

/// `2 C_ij = Σ_k v_k (e_k M_ij + e_j M_ik − e_i M_jk + [e_k,e_j]·M e_i − [e_k,e_i]·M e_j − [e_j,e_i]·M e_k)`: Koszul's
/// formula for the connection of Levi-Civita, the brackets those of rotations and of rigid motions. Christoffel's
/// symbols are what is left of it between joints of one degree of freedom.
fn levi_civita<const NL: usize, const NQ: usize, const NV: usize>(joints: &str) {
    for_each_state::<NL, NQ, NV>(joints, |robot, (q, v, _)| {
        let dual = lifted::<Dual, NL, NQ, NV>(&robot.tree);
        let unit = |k: usize| SVector::<f64, NV>::from_fn(|i, _| if i == k { 1.0 } else { 0.0 });
        let slopes: Vec<_> = (0..NV).map(|k| tangent(&dual.mass_matrix(&robot.flow(&q, &unit(k))))).collect();
        let m = robot.tree.mass_matrix(&q);
        let lower = |x: &SVector<f64, NV>, y: &SVector<f64, NV>| m * robot.bracket(x, y);
        let along_v: Vec<_> = (0..NV).map(|j| lower(&v, &unit(j))).collect();
        let momentum = m * v;
        let expected = SMatrix::from_fn(|i, j| {
            let terms = (0..NV).map(|k| (slopes[k][(i, j)] + slopes[j][(i, k)] - slopes[i][(j, k)]) * v[k]);
            let bracket = robot.bracket(&unit(j), &unit(i));
            0.5 * (terms.sum::<f64>() + along_v[j][i] - along_v[i][j] - bracket.dot(&momentum))
        });
        close(&robot.tree.coriolis_matrix(&q, &v), &expected, TOLERANCE);
    });
}

/// `Ṁ = C + Cᵀ`, `M = Mᵀ`, `τ = M a + C v + G + passive`, and the bundle says what its parts say.
fn equations<const NL: usize, const NQ: usize, const NV: usize>(joints: &str) {
    for_each_state::<NL, NQ, NV>(joints, |robot, (q, v, a)| {
        let tree = &robot.tree;
        let EquationsOfMotion { mass_matrix, coriolis_matrix, gravity_forces } =
            tree.equations_of_motion(&q, &v);
        assert_eq!(mass_matrix, tree.mass_matrix(&q));
        assert_eq!(coriolis_matrix, tree.coriolis_matrix(&q, &v));
        assert_eq!(gravity_forces, tree.gravity_forces(&q));
        assert_eq!(mass_matrix, mass_matrix.transpose());
        let bias = coriolis_matrix * v + gravity_forces + tree.passive_forces(&q, &v);
        close(&tree.bias_forces(&q, &v), &bias, TOLERANCE);
        close(&tree.inverse_dynamics(&q, &v, &a), &(mass_matrix * a + bias), TOLERANCE);
        let rate = tangent(&lifted::<Dual, NL, NQ, NV>(tree).mass_matrix(&robot.flow(&q, &v)));
        close(&(coriolis_matrix + coriolis_matrix.transpose()), &rate, TOLERANCE);
    });
}

/// The derivatives of inverse dynamics along random directions.
fn inverse_derivatives<const NL: usize, const NQ: usize, const NV: usize>(joints: &str) {
    for_each_state::<NL, NQ, NV>(joints, |robot, (q, v, a)| {
        let dual = lifted::<Dual, NL, NQ, NV>(&robot.tree);
        let direction = random_vector(&mut random_numbers(7), 1.0);
        let InverseDynamicsDerivatives { dtau_dq, dtau_dv, dtau_da } =
            robot.tree.inverse_dynamics_derivatives(&q, &v, &a);
        let by_q = dual.inverse_dynamics(&robot.flow(&q, &direction), &resting(&v), &resting(&a));
        let by_v = dual.inverse_dynamics(&resting(&q), &moving(&v, &direction), &resting(&a));
        let by_a = dual.inverse_dynamics(&resting(&q), &resting(&v), &moving(&a, &direction));
        close(&(dtau_dq * direction), &tangent(&by_q), TOLERANCE);
        close(&(dtau_dv * direction), &tangent(&by_v), TOLERANCE);
        close(&(dtau_da * direction), &tangent(&by_a), TOLERANCE);
    });
}

/// `ID ∘ FD` is the identity, and so are the derivatives of forward dynamics along random directions.
fn forward<const NL: usize, const NQ: usize, const NV: usize>(joints: &str) {
    for_each_state::<NL, NQ, NV>(joints, |robot, (q, v, tau)| {
        let tree = &robot.tree;
        let a = tree.forward_dynamics(&q, &v, &tau);
        let scale = tree.mass_matrix(&q).amax() * a.amax();
        let error = (tree.inverse_dynamics(&q, &v, &a) - tau).amax();
        assert!(error <= TOLERANCE * scale, "{error:e} of {scale:e}");

        let dual = lifted::<Dual, NL, NQ, NV>(tree);
        let direction = random_vector(&mut random_numbers(8), 1.0);
        let ForwardDynamicsDerivatives { da_dq, da_dv, da_dtau } =
            tree.forward_dynamics_derivatives(&q, &v, &tau);
        let by_q = dual.forward_dynamics(&robot.flow(&q, &direction), &resting(&v), &resting(&tau));
        let by_v = dual.forward_dynamics(&resting(&q), &moving(&v, &direction), &resting(&tau));
        let by_tau = dual.forward_dynamics(&resting(&q), &resting(&v), &moving(&tau, &direction));
        close(&(da_dq * direction), &tangent(&by_q), TOLERANCE_OF_SOLUTIONS);
        close(&(da_dv * direction), &tangent(&by_v), TOLERANCE_OF_SOLUTIONS);
        close(&(da_dtau * direction), &tangent(&by_tau), TOLERANCE_OF_SOLUTIONS);
        assert_eq!(tree.inverse_mass_matrix(&q), da_dtau);
        let identity = tree.mass_matrix(&q) * da_dtau;
        close(&identity, &SMatrix::identity(), TOLERANCE_OF_SOLUTIONS);
    });
}

/// What is put in and is not turned to heat is energy: `vᵀτ = d(T + V + E)/dt + heat`.
fn power<const NL: usize, const NQ: usize, const NV: usize>(joints: &str) {
    for_each_state::<NL, NQ, NV>(joints, |robot, (q, v, tau)| {
        let a = robot.tree.forward_dynamics(&q, &v, &tau);
        let (flow, rate) = (robot.flow(&q, &v), moving(&v, &a));
        let dual = lifted::<Dual, NL, NQ, NV>(&robot.tree);
        let (kinetic, elastic) = (dual.kinetic_energy(&flow, &rate), dual.elastic_energy(&flow));
        let stored = kinetic.tangent + elastic.tangent + dual.potential_energy(&flow).tangent;
        let heat = robot.driven().map(|(drive, passive)| {
            let speed = drive.ratio * v[drive.v];
            speed * resistance(&passive, speed)
        });
        let error = (v.dot(&tau) - stored - heat.sum::<f64>()).abs();
        let size = robot.tree.mass_matrix(&q).amax() * v.amax() * a.amax();
        assert!(error <= TOLERANCE * size, "{error:e} of {size:e}");
    });
}

/// The centre of mass, its velocity, and the momentum, by point masses.
fn centroid<const NL: usize, const NQ: usize, const NV: usize>(joints: &str) {
    for_each_state::<NL, NQ, NV>(joints, |robot, (q, v, _)| {
        let tree = &robot.tree;
        let points: Vec<_> = robot.positions(&robot.flow(&q, &v), true).collect();
        let mass: f64 = points.iter().map(|(m, _)| m).sum();
        let center: Vector3<f64> = points.iter().map(|(m, r)| r.map(|x| x.value) * (*m / mass)).sum();
        let linear: Vector3<f64> = points.iter().map(|(m, r)| tangent(r) * *m).sum();
        let about_center = |r: &Vector3<Dual>| (r.map(|x| x.value) - center).cross(&tangent(r));
        let angular: Vector3<f64> = points.iter().map(|(m, r)| about_center(r) * *m).sum();
        close(&tree.center_of_mass(&q), &center, TOLERANCE);
        close(&(tree.center_of_mass_jacobian(&q) * v), &(linear / mass), TOLERANCE);
        for momentum in [tree.centroidal_momentum(&q, &v), tree.centroidal_momentum_matrix(&q) * v] {
            close(&momentum.fixed_rows::<3>(0).into_owned(), &linear, TOLERANCE);
            close(&momentum.fixed_rows::<3>(3).into_owned(), &angular, TOLERANCE);
        }
    });
}

/// `J·v` is how the pose changes, in both kinds of axes, `J·a + J̇·v` how the body velocity changes; on every link and
/// in the world.
fn frames<const NL: usize, const NQ: usize, const NV: usize>(joints: &str) {
    for_each_state::<NL, NQ, NV>(joints, |robot, (q, v, a)| {
        let dual = lifted::<Dual, NL, NQ, NV>(&robot.tree);
        let rotation = Rotation3::from_euler_angles(0.3, -1.1, 2.0);
        let (rotation, translation) = (rows(rotation.matrix()), [0.2, -0.5, 0.4]);
        let dual_rotation = rotation.map(|row| row.map(Dual::of));
        let (dual_translation, flow) = (translation.map(Dual::of), robot.flow(&q, &v));
        for link in (0..NL).step_by(7).map(Some).chain([None, Some(NL - 1)]) {
            let pose = dual.pose(link, dual_rotation, dual_translation, &flow);
            let here = robot.tree.pose(link, rotation, translation, &q);
            close(&pose.rotation.map(|x| x.value), &here.rotation, TOLERANCE);
            close(&pose.translation.map(|x| x.value), &here.translation, TOLERANCE);
            let turning = tangent(&pose.rotation) * here.rotation.transpose();
            let w = Vector3::new(turning[(2, 1)], turning[(0, 2)], turning[(1, 0)]);
            let in_world = stacked(tangent(&pose.translation), w);
            let to_frame = here.rotation.transpose();
            let in_frame = stacked(to_frame * tangent(&pose.translation), to_frame * w);

            close(&(robot.tree.world_jacobian(link, rotation, translation, &q) * v), &in_world, TOLERANCE);
            close(&(robot.tree.jacobian(link, rotation, translation, &q) * v), &in_frame, TOLERANCE);
            close(&robot.tree.velocity(link, rotation, translation, &q, &v), &in_frame, TOLERANCE);
            let rate = dual.velocity(link, dual_rotation, dual_translation, &flow, &moving(&v, &a));
            let acceleration = robot.tree.acceleration(link, rotation, translation, &q, &v, &a);
            close(&acceleration, &tangent(&rate), TOLERANCE);
        }
    });
}

fn stacked(linear: Vector3<f64>, angular: Vector3<f64>) -> SVector<f64, 6> {
    SVector::from_iterator(linear.iter().chain(&angular).copied())
}

macro_rules! for_every_robot {
    ($($law:ident: $name:ident;)*) => {$(
        #[test]
        fn $name() {
            $law::<1, 1, 1>("R");
            $law::<2, 2, 2>("RR");
            $law::<6, 6, 6>("RRP");
            $law::<12, 12, 12>("RRP");
            $law::<1, 4, 3>("B");
            $law::<1, 7, 6>("F");
            $law::<2, 2, 2>("uP");
            $law::<2, 1, 1>("us");
            $law::<15, 33, 29>("FRBPuPRBRFuRppR");
            $law::<18, 34, 30>("FRBPuPRfBRFuRusppR");
            with_stack(16 << 20, || $law::<100, 100, 100>("RRP")); // for the matrices of the test itself, many and dual
        }
    )*};
}

for_every_robot! {
    energies: energies_are_those_of_the_point_masses;
    passive_forces: passive_forces_are_those_of_the_joints;
    equations: the_equations_of_motion_hold_together;
    inverse_derivatives: derivatives_of_inverse_dynamics_are_exact;
    forward: forward_dynamics_undoes_inverse_dynamics;
    power: power_is_stored_or_turned_to_heat;
    centroid: momenta_are_those_of_the_point_masses;
    frames: jacobians_are_the_rates_of_poses;
}

#[test]
fn the_coriolis_matrix_is_that_of_levi_civita() {
    levi_civita::<1, 1, 1>("R");
    levi_civita::<2, 2, 2>("RR");
    levi_civita::<6, 6, 6>("RRP");
    levi_civita::<12, 12, 12>("RRP");
    levi_civita::<1, 4, 3>("B");
    levi_civita::<1, 7, 6>("F");
    levi_civita::<15, 33, 29>("FRBPuPRBRFuRppR");
    levi_civita::<18, 34, 30>("FRBPuPRfBRFuRusppR");
}

/// A second opinion on the dual numbers.
#[test]
fn derivatives_of_forward_dynamics_are_quotients_of_differences() {
    const STEP: f64 = 1e-5;
    for_each_state::<7, 6, 6>("RRPRRPf", |robot, (q, v, tau)| {
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
