//! Motions that move no mass: a mass matrix that is singular, at one configuration or in all.
//!
//! It is factored in doubles. Where joints cancel each other a pivot is nothing but rounding. A robot has such a motion in
//! every configuration if it has one at a few of them, with the parameters' sample values.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::columns::columns;
use super::coupling::elimination_parents;
use super::factor::Factor;
use super::plain::Oracle;
use crate::model::{Model, Tree};
use crate::symbolic::{Evaluator, Graph, SymbolId};

/// A pivot below this part of its diagonal entry is what rounding left of zero.
const NOTHING: f64 = 1e-13;
/// The share of a joint in the motion, relative to the largest, from which on it takes part.
const SHARE: f64 = 1e-6;
/// Above this size a robot is not judged: the matrix is dense here.
const MOST_JOINTS: usize = 128;

/// The joints, in order, that can move together without moving any mass, whatever the configuration.
pub fn idle_motion(model: &Model<'_>, graph: &Graph) -> Option<Vec<usize>> {
    let n = model.tree.dof();
    if n > MOST_JOINTS {
        return None;
    }
    let sample = |symbol: SymbolId| model.parameters[symbol.0 as usize].sample;
    let mut evaluator = Evaluator::new(graph, sample);
    let tree = model.tree.map(|expr| evaluator.value(expr));
    let parents = elimination(&tree);
    let motion_at = |state: usize| {
        // Irrational steps: no angle is like another, and none is a right one.
        let size = tree.coordinates();
        let mut q: Vec<f64> =
            (0..size).map(|k| (0.7 + 1.618_034 * (state * size + k) as f64) % 3.0).collect();
        tree.normalise(&mut q);
        idle_motion_of(&Oracle::new(&tree).mass_matrix(&q), &parents)
    };
    let first = motion_at(0)?;
    (1..3).all(|state| motion_at(state).is_some()).then_some(first)
}

/// The speeds, in order, that can be together at `q` without moving any mass: M(q) is singular there.
pub fn idle_motion_at(tree: &Tree<f64>, q: &[f64]) -> Option<Vec<usize>> {
    idle_motion_of(&Oracle::new(tree).mass_matrix(q), &elimination(tree))
}

/// Whether M has no inverse: a motion moves no mass, or an entry is no number.
pub(super) fn is_singular(M: &Vec<Vec<f64>>) -> bool {
    let one_by_one: Vec<_> = (0..M.len()).map(|k: usize| k.checked_sub(1)).collect();
    M.iter().flatten().any(|entry| !entry.is_finite()) || idle_motion_of(M, &one_by_one).is_some()
}

/// The speeds that each speed is eliminated into.
fn elimination(tree: &Tree<f64>) -> Vec<Option<usize>> {
    let columns = columns(tree.links.iter().map(|link| (link.parent, link.motion, link.drive)));
    elimination_parents(&columns, tree.dof(), &tree.coupled_by_terms())
}

/// The speeds of a motion with `M·v = 0`, if there is one.
fn idle_motion_of(M: &Vec<Vec<f64>>, parents: &[Option<usize>]) -> Option<Vec<usize>> {
    if !M.iter().flatten().all(|entry| entry.is_finite()) {
        return None;
    }
    let factor = Factor::of(M, parents.to_vec());
    let is_nothing = |&k: &usize| (1.0 / factor.inverse_D[k]).abs() <= NOTHING * M[k][k].abs();
    let idle = (0..M.len()).rev().find(is_nothing)?;
    // `L·v` is one at the idle pivot and zero elsewhere.
    let mut v = vec![0.0_f64; M.len()];
    v[idle] = 1.0;
    for i in idle + 1..M.len() {
        let mut ancestor = parents[i];
        while let Some(j) = ancestor {
            v[i] -= factor.L[i][j] * v[j];
            ancestor = parents[j];
        }
    }
    let largest = v.iter().fold(0.0, |largest: f64, share| largest.max(share.abs()));
    Some((0..v.len()).filter(|&k| v[k].abs() > SHARE * largest).collect())
}

#[cfg(test)]
mod tests {
    use super::{idle_motion_of, is_singular};

    #[test]
    fn joints_on_one_axis_cancel_each_other() {
        let M = vec![vec![3.0, 2.0, 2.0], vec![2.0, 2.0, 2.0], vec![2.0, 2.0, 2.0]];
        assert_eq!(idle_motion_of(&M, &[None, Some(0), Some(1)]), Some(vec![1, 2]));
        let M = vec![vec![0.0, 0.0], vec![0.0, 2.0]];
        assert_eq!(idle_motion_of(&M, &[None, Some(0)]), Some(vec![0]));
        let M = vec![vec![3.0, 0.0], vec![0.0, 1e-9]];
        assert_eq!(idle_motion_of(&M, &[None, Some(0)]), None);
        assert!(!is_singular(&M));
        assert!(is_singular(&vec![vec![3.0, 3.0], vec![3.0, 3.0]]));
        assert!(is_singular(&vec![vec![f64::NAN]]));
    }
}
