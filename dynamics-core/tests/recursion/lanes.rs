//! The matrices in lanes, against the recursion link by link.

use dynamics_core::__private::EliminationTree;
use dynamics_core::__private::recursion::{Drive, Joint, Tree};
#[cfg(feature = "simd")]
use dynamics_core::lanes::{Lanes, f64x2, f64x4, f64x8};
use dynamics_core::prelude::*;

#[cfg(feature = "simd")]
use super::robots::lifted;
use super::robots::{Robot, Shape};
use super::{TOLERANCE, TOLERANCE_OF_SOLUTIONS, close, with_stack};
#[cfg(feature = "simd")]
use crate::common::{bits_of_lane, in_lanes_of};
use crate::common::{random_numbers, random_vector};

/// A chain or a tree of joints that move as their coordinates do, and have their indices; after a free base, if there is one.
fn driven_directly<const NL: usize, const NQ: usize, const N: usize>(
    joints: &str,
    shape: Shape,
    seed: u64,
) -> Robot<NL, NQ, N> {
    let mut robot = Robot::random(joints, shape, seed);
    for (k, link) in robot.tree.links.iter_mut().enumerate() {
        if let Joint::Revolute(drive, _) | Joint::Prismatic(drive, _) = &mut link.joint {
            *drive = Drive { q: NQ - NL + k, v: N - NL + k, ratio: 1.0, offset: 0.0 };
        }
    }
    robot
}

/// By which M is factored: the speed before each on its way to the base; those of a free one follow each other.
fn elimination<const NL: usize, const NQ: usize, const N: usize>(
    tree: &Tree<f64, NL, NQ, N>,
) -> &'static EliminationTree<N> {
    let before = N.saturating_sub(NL); // so many speeds of a free base but the first
    let parent = |speed: usize| match speed.checked_sub(before) {
        Some(link) if link > 0 || before == 0 => tree.links[link].parent.map(|parent| parent + before),
        _ => speed.checked_sub(1),
    };
    Box::leak(Box::new(EliminationTree::of(core::array::from_fn(parent))))
}

/// Whether right after each link comes all that hangs on it.
fn is_walk<const NL: usize, const NQ: usize, const N: usize>(tree: &Tree<f64, NL, NQ, N>) -> bool {
    let ways = |k: usize| std::iter::successors(Some(k), |&k| tree.links[k].parent);
    (1..NL).all(|k| tree.links[k].parent.is_none_or(|parent| ways(k - 1).any(|link| link == parent)))
}

fn agrees<const NL: usize, const NQ: usize, const N: usize>(robot: &Robot<NL, NQ, N>, seed: u64) {
    let (tree, mut random) = (&robot.tree, random_numbers(seed));
    let q = robot.random_coordinates(&mut random, 2.0);
    let [v, a]: [SVector<f64, N>; 2] = core::array::from_fn(|_| random_vector(&mut random, 2.0));
    let lanes = tree.in_lanes();
    close(&lanes.mass_matrix(&q), &tree.mass_matrix(&q), TOLERANCE);
    close(&lanes.coriolis_matrix(&q, &v), &tree.coriolis_matrix(&q, &v), TOLERANCE);
    let (ours, theirs) = (lanes.equations_of_motion(&q, &v), tree.equations_of_motion(&q, &v));
    close(&ours.mass_matrix, &theirs.mass_matrix, TOLERANCE);
    close(&ours.coriolis_matrix, &theirs.coriolis_matrix, TOLERANCE);
    close(&ours.gravity_forces, &theirs.gravity_forces, TOLERANCE);
    let (ours, theirs) =
        (lanes.inverse_dynamics_derivatives(&q, &v, &a), tree.inverse_dynamics_derivatives(&q, &v, &a));
    close(&ours.dtau_dq, &theirs.dtau_dq, TOLERANCE);
    close(&ours.dtau_dv, &theirs.dtau_dv, TOLERANCE);
    close(&ours.dtau_da, &theirs.dtau_da, TOLERANCE);
    let (tau, derivatives) = lanes.inverse_dynamics_with_derivatives(&q, &v, &a);
    close(&tau, &tree.inverse_dynamics(&q, &v, &a), TOLERANCE);
    assert_eq!(derivatives, ours);
    let by = elimination(tree);
    let (ours, theirs) =
        (lanes.forward_dynamics_derivatives(&q, &v, &a, by), tree.forward_dynamics_derivatives(&q, &v, &a));
    close(&ours.da_dq, &theirs.da_dq, TOLERANCE_OF_SOLUTIONS);
    close(&ours.da_dv, &theirs.da_dv, TOLERANCE_OF_SOLUTIONS);
    close(&ours.da_dtau, &theirs.da_dtau, TOLERANCE_OF_SOLUTIONS);
    assert_eq!(lanes.inverse_mass_matrix(&q, by), ours.da_dtau);
    let (found, derivatives) = lanes.forward_dynamics_with_derivatives(&q, &v, &a, by);
    close(&found, &tree.forward_dynamics(&q, &v, &a), TOLERANCE_OF_SOLUTIONS);
    assert_eq!(derivatives, ours);
}

/// The same of several states as one scalar: as much code again for each width. So not for each size, but where what is left
/// over of rows and columns differs.
fn agrees_in_lanes<const NL: usize, const NQ: usize, const N: usize>(robot: &Robot<NL, NQ, N>, seed: u64) {
    agrees(robot, seed);
    #[cfg(feature = "simd")]
    {
        let mut random = random_numbers(seed);
        each_state_has_the_bits_of_one::<f64x2, NL, NQ, N>(robot, &mut random);
        each_state_has_the_bits_of_one::<f64x4, NL, NQ, N>(robot, &mut random);
        each_state_has_the_bits_of_one::<f64x8, NL, NQ, N>(robot, &mut random);
    }
}

/// Several states as one scalar, for which rows and columns are taken otherwise.
#[cfg(feature = "simd")]
fn each_state_has_the_bits_of_one<
    L: Lanes<Element = f64>,
    const NL: usize,
    const NQ: usize,
    const N: usize,
>(
    robot: &Robot<NL, NQ, N>,
    random: &mut impl FnMut() -> f64,
) {
    let q: Vec<_> = (0..L::COUNT).map(|_| robot.random_coordinates(random, 2.0)).collect();
    let mut vectors =
        || -> Vec<SVector<f64, N>> { (0..L::COUNT).map(|_| random_vector(random, 2.0)).collect() };
    let (v, a) = (vectors(), vectors());
    let wide = lifted::<L, NL, NQ, N>(&robot.tree);
    let (wide, single) = (wide.in_lanes(), robot.tree.in_lanes());
    let wide_q = in_lanes_of::<L, NQ, 1>(&q);
    let [wide_v, wide_a] = [&v, &a].map(|x| in_lanes_of::<L, N, 1>(x));
    let by = elimination(&robot.tree);
    let m = wide.mass_matrix(&wide_q);
    let inverse = wide.inverse_mass_matrix(&wide_q, by);
    let c = wide.coriolis_matrix(&wide_q, &wide_v);
    let (tau, derivatives) = wide.inverse_dynamics_with_derivatives(&wide_q, &wide_v, &wide_a);
    let (found, responses) = wide.forward_dynamics_with_derivatives(&wide_q, &wide_v, &wide_a, by);
    for (lane, ((q, v), a)) in q.iter().zip(&v).zip(&a).enumerate() {
        let check = |found: &SMatrix<L, N, N>, expected: SMatrix<f64, N, N>| {
            assert_eq!(bits_of_lane(found, lane), expected.map(f64::to_bits));
        };
        check(&m, single.mass_matrix(q));
        check(&inverse, single.inverse_mass_matrix(q, by));
        check(&c, single.coriolis_matrix(q, v));
        let (forces, expected) = single.inverse_dynamics_with_derivatives(q, v, a);
        assert_eq!(bits_of_lane(&tau, lane), forces.map(f64::to_bits));
        check(&derivatives.dtau_dq, expected.dtau_dq);
        check(&derivatives.dtau_dv, expected.dtau_dv);
        check(&derivatives.dtau_da, expected.dtau_da);
        let (accelerations, expected) = single.forward_dynamics_with_derivatives(q, v, a, by);
        assert_eq!(bits_of_lane(&found, lane), accelerations.map(f64::to_bits));
        check(&responses.da_dq, expected.da_dq);
        check(&responses.da_dv, expected.da_dv);
        check(&responses.da_dtau, expected.da_dtau);
    }
}

fn chain_agrees<const N: usize>(joints: &'static str, seed: u64) {
    with_stack(8 << 20, move || agrees(&driven_directly::<N, N, N>(joints, Shape::Chain, seed), seed));
}

/// With room for unoptimised code on eight states at once.
fn chain_agrees_in_lanes<const N: usize>(joints: &'static str, seed: u64) {
    with_stack(16 << 20, move || {
        agrees_in_lanes(&driven_directly::<N, N, N>(joints, Shape::Chain, seed), seed);
    });
}

/// The same of one that floats.
fn floating_chain_agrees<const NL: usize, const NQ: usize, const N: usize>(joints: &'static str, seed: u64) {
    with_stack(8 << 20, move || {
        agrees(&driven_directly::<NL, NQ, N>(&floating::<NL>(joints), Shape::Chain, seed), seed);
    });
}

fn floating_chain_agrees_in_lanes<const NL: usize, const NQ: usize, const N: usize>(
    joints: &'static str,
    seed: u64,
) {
    with_stack(16 << 20, move || {
        agrees_in_lanes(&driven_directly::<NL, NQ, N>(&floating::<NL>(joints), Shape::Chain, seed), seed);
    });
}

/// A free base, and these joints again and again.
fn floating<const NL: usize>(joints: &str) -> String {
    std::iter::once('F').chain(joints.chars().cycle()).take(NL).collect()
}

#[test]
fn chains_of_every_length_agree() {
    chain_agrees::<0>("R", 1);
    chain_agrees::<1>("P", 2);
    chain_agrees_in_lanes::<3>("RPR", 3);
    chain_agrees::<4>("RRPR", 4);
    chain_agrees::<5>("RuPpR", 5);
    chain_agrees_in_lanes::<8>("RRP", 12);
    chain_agrees::<10>("RPR", 13);
    chain_agrees::<11>("RRPR", 14);
    chain_agrees_in_lanes::<13>("RRP", 15);
    chain_agrees::<15>("RPRR", 16);
    chain_agrees::<16>("RPRuR", 6);
    chain_agrees_in_lanes::<18>("RRP", 7);
    chain_agrees::<31>("RRRP", 8);
}

#[test]
fn floating_chains_of_every_length_agree() {
    floating_chain_agrees::<1, 7, 6>("", 21);
    floating_chain_agrees::<2, 8, 7>("P", 22);
    floating_chain_agrees::<3, 9, 8>("RP", 23);
    floating_chain_agrees::<6, 12, 11>("RuPpR", 24);
    floating_chain_agrees_in_lanes::<8, 14, 13>("RRP", 25);
    floating_chain_agrees::<11, 17, 16>("RRPR", 26);
    floating_chain_agrees::<22, 28, 27>("RPRRR", 27);
}

/// Arms are differences of origins, which are counted from the base.
#[test]
fn nothing_is_lost_where_a_robot_floats_far_away() {
    let robot = driven_directly::<5, 11, 10>(&floating::<5>("RRPR"), Shape::Chain, 28);
    let (lanes, mut random) = (robot.tree.in_lanes(), random_numbers(29));
    let q = robot.random_coordinates(&mut random, 2.0);
    let [v, a] = core::array::from_fn(|_| random_vector(&mut random, 2.0));
    let mut far = q;
    far[0] = 1e9;
    assert_eq!(lanes.coriolis_matrix(&far, &v), lanes.coriolis_matrix(&q, &v));
    assert_eq!(
        lanes.inverse_dynamics_with_derivatives(&far, &v, &a),
        lanes.inverse_dynamics_with_derivatives(&q, &v, &a)
    );
    let by = elimination(&robot.tree);
    assert_eq!(
        lanes.forward_dynamics_with_derivatives(&far, &v, &a, by),
        lanes.forward_dynamics_with_derivatives(&q, &v, &a, by)
    );
}

/// Branches within a group of four, and across several.
#[test]
fn branched_trees_agree() {
    let (mut seen, mut floating_seen) = (0, 0);
    for seed in 0..400 {
        seen += usize::from(agrees_if_branched(
            &driven_directly("RPR", Shape::Branched, seed),
            seed,
            agrees::<9, 9, 9>,
        ));
        let robot = driven_directly::<8, 14, 13>(&floating::<8>("RPR"), Shape::Branched, seed);
        floating_seen += usize::from(agrees_if_branched(&robot, seed, agrees_in_lanes));
    }
    assert!(seen > 5 && floating_seen > 5, "only {seen} and {floating_seen} trees in the order of a walk");
}

/// If it stands in the order of a walk.
fn agrees_if_branched<const NL: usize, const NQ: usize, const N: usize>(
    robot: &Robot<NL, NQ, N>,
    seed: u64,
    agrees: fn(&Robot<NL, NQ, N>, u64),
) -> bool {
    let links = &robot.tree.links;
    let is_branched = is_walk(&robot.tree) && links.windows(2).any(|two| two[0].parent == two[1].parent);
    if is_branched {
        agrees(robot, seed);
    }
    is_branched
}

/// Legs of three on every second link of a spine: what hangs on a link ends within other groups.
#[test]
fn legs_along_a_spine_agree() {
    with_stack(16 << 20, spines_agree);
}

fn spines_agree() {
    let parents = [0, 1, 2, 0, 4, 5, 6, 4, 8, 9, 10, 8, 12, 13, 8, 15, 0, 17, 18, 19, 17, 17].map(Some);
    let mut robot = driven_directly::<23, 23, 23>("RRRP", Shape::Chain, 9);
    hang(&mut robot, &parents);
    agrees_in_lanes(&robot, 10);
    let mut floating = driven_directly::<23, 29, 28>(&floating::<23>("RRRP"), Shape::Chain, 9);
    hang(&mut floating, &parents);
    agrees_in_lanes(&floating, 10);

    // Two robots on one world; and one that floats beside one that does not.
    let mut parents = parents;
    parents[11] = None;
    parents[12..].copy_from_slice(&[12, 13, 12, 15, 12, 17, 18, 19, 17, 17].map(Some));
    hang(&mut robot, &parents);
    agrees(&robot, 11);
    hang(&mut floating, &parents);
    agrees(&floating, 11);
}

/// Gives the links but the first these parents.
fn hang<const NL: usize, const NQ: usize, const N: usize>(
    robot: &mut Robot<NL, NQ, N>,
    parents: &[Option<usize>],
) {
    for (link, parent) in robot.tree.links.iter_mut().skip(1).zip(parents) {
        link.parent = *parent;
    }
    assert!(is_walk(&robot.tree));
}
