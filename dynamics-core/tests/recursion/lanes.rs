//! The matrices in lanes, against the recursion link by link.

use dynamics_core::__private::recursion::{Drive, Joint, Tree};
#[cfg(feature = "simd")]
use dynamics_core::lanes::{Lanes, f64x2, f64x4, f64x8};
use dynamics_core::prelude::*;

#[cfg(feature = "simd")]
use super::robots::lifted;
use super::robots::{Robot, Shape};
use super::{TOLERANCE, close, with_stack};
#[cfg(feature = "simd")]
use crate::common::{bits_of_lane, in_lanes_of};
use crate::common::{random_numbers, random_vector};

/// A chain or a tree of joints that move as their coordinates do.
fn driven_directly<const N: usize>(joints: &str, shape: Shape, seed: u64) -> Tree<f64, N, N, N> {
    let mut tree = Robot::<N, N, N>::random(joints, shape, seed).tree;
    for (k, link) in tree.links.iter_mut().enumerate() {
        if let Joint::Revolute(drive, _) | Joint::Prismatic(drive, _) = &mut link.joint {
            *drive = Drive::own(k, k);
        }
    }
    tree
}

/// Whether right after each link comes all that hangs on it.
fn is_walk<const N: usize>(tree: &Tree<f64, N, N, N>) -> bool {
    let ways = |k: usize| std::iter::successors(Some(k), |&k| tree.links[k].parent);
    (1..N).all(|k| tree.links[k].parent.is_none_or(|parent| ways(k - 1).any(|link| link == parent)))
}

fn agrees<const N: usize>(tree: &Tree<f64, N, N, N>, seed: u64) {
    let mut random = random_numbers(seed);
    let [q, v, a]: [SVector<f64, N>; 3] = core::array::from_fn(|_| random_vector(&mut random, 2.0));
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
    #[cfg(feature = "simd")]
    {
        each_state_has_the_bits_of_one::<f64x2, N>(tree, &mut random);
        each_state_has_the_bits_of_one::<f64x4, N>(tree, &mut random);
        each_state_has_the_bits_of_one::<f64x8, N>(tree, &mut random);
    }
}

/// Several states as one scalar, for which rows and columns are taken otherwise.
#[cfg(feature = "simd")]
fn each_state_has_the_bits_of_one<L: Lanes<Element = f64>, const N: usize>(
    tree: &Tree<f64, N, N, N>,
    random: &mut impl FnMut() -> f64,
) {
    let mut states =
        || -> Vec<SVector<f64, N>> { (0..L::COUNT).map(|_| random_vector(random, 2.0)).collect() };
    let (q, v, a) = (states(), states(), states());
    let wide = lifted::<L, N, N, N>(tree);
    let (wide, single) = (wide.in_lanes(), tree.in_lanes());
    let [wide_q, wide_v, wide_a] = [&q, &v, &a].map(|x| in_lanes_of::<L, N, 1>(x));
    let m = wide.mass_matrix(&wide_q);
    let c = wide.coriolis_matrix(&wide_q, &wide_v);
    let (tau, derivatives) = wide.inverse_dynamics_with_derivatives(&wide_q, &wide_v, &wide_a);
    for (lane, ((q, v), a)) in q.iter().zip(&v).zip(&a).enumerate() {
        let check = |found: &SMatrix<L, N, N>, expected: SMatrix<f64, N, N>| {
            assert_eq!(bits_of_lane(found, lane), expected.map(f64::to_bits));
        };
        check(&m, single.mass_matrix(q));
        check(&c, single.coriolis_matrix(q, v));
        let (forces, expected) = single.inverse_dynamics_with_derivatives(q, v, a);
        assert_eq!(bits_of_lane(&tau, lane), forces.map(f64::to_bits));
        check(&derivatives.dtau_dq, expected.dtau_dq);
        check(&derivatives.dtau_dv, expected.dtau_dv);
        check(&derivatives.dtau_da, expected.dtau_da);
    }
}

/// With room for unoptimised code on eight states at once.
fn chain_agrees<const N: usize>(joints: &'static str, seed: u64) {
    with_stack(8 << 20, move || agrees(&driven_directly::<N>(joints, Shape::Chain, seed), seed));
}

#[test]
fn chains_of_every_length_agree() {
    chain_agrees::<0>("R", 1);
    chain_agrees::<1>("P", 2);
    chain_agrees::<3>("RPR", 3);
    chain_agrees::<4>("RRPR", 4);
    chain_agrees::<5>("RuPpR", 5);
    chain_agrees::<8>("RRP", 12);
    chain_agrees::<10>("RPR", 13);
    chain_agrees::<11>("RRPR", 14);
    chain_agrees::<13>("RRP", 15);
    chain_agrees::<15>("RPRR", 16);
    chain_agrees::<16>("RPRuR", 6);
    chain_agrees::<18>("RRP", 7);
    chain_agrees::<31>("RRRP", 8);
}

/// Branches within a group of four, and across several.
#[test]
fn branched_trees_agree() {
    let mut seen = 0;
    for seed in 0..400 {
        let tree = driven_directly::<9>("RPR", Shape::Branched, seed);
        if is_walk(&tree) && tree.links.windows(2).any(|two| two[0].parent == two[1].parent) {
            agrees(&tree, seed);
            seen += 1;
        }
    }
    assert!(seen > 5, "only {seen} trees in the order of a walk");

    // Legs of three on every second link of a spine: what hangs on a link ends within other groups.
    let mut tree = driven_directly::<23>("RRRP", Shape::Chain, 9);
    let parents = [0, 1, 2, 0, 4, 5, 6, 4, 8, 9, 10, 8, 12, 13, 8, 15, 0, 17, 18, 19, 17, 17];
    for (link, parent) in tree.links.iter_mut().skip(1).zip(parents) {
        link.parent = Some(parent);
    }
    assert!(is_walk(&tree));
    agrees(&tree, 10);

    // Two robots on one world.
    tree.links[12].parent = None;
    for (link, parent) in tree.links.iter_mut().skip(13).zip([12, 13, 12, 15, 12, 17, 18, 19, 17, 17]) {
        link.parent = Some(parent);
    }
    assert!(is_walk(&tree));
    agrees(&tree, 11);
}
