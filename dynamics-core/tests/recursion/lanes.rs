//! The matrices in lanes, against the recursion link by link.

use dynamics_core::__private::recursion::{Drive, Joint, Tree};
use dynamics_core::prelude::*;

use super::robots::{Robot, Shape};
use super::{TOLERANCE, close};
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
}

#[test]
fn chains_of_every_length_agree() {
    agrees(&driven_directly::<0>("R", Shape::Chain, 1), 1);
    agrees(&driven_directly::<1>("P", Shape::Chain, 2), 2);
    agrees(&driven_directly::<3>("RPR", Shape::Chain, 3), 3);
    agrees(&driven_directly::<4>("RRPR", Shape::Chain, 4), 4);
    agrees(&driven_directly::<5>("RuPpR", Shape::Chain, 5), 5);
    agrees(&driven_directly::<16>("RPRuR", Shape::Chain, 6), 6);
    agrees(&driven_directly::<18>("RRP", Shape::Chain, 7), 7);
    agrees(&driven_directly::<31>("RRRP", Shape::Chain, 8), 8);
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
