//! Motions that move no mass: a mass matrix that is singular, at one configuration or in all.
//!
//! It is factored with the largest of what is left as the next pivot, each joint in a unit of its own, so that of a
//! singular matrix nothing is left before its end. What rounding leaves there of doubles may as well be a small mass. Where
//! they do not tell, M is computed again in the numbers of the compiler, whose rounding no mass is as small as. A robot has
//! such a motion in every configuration if it has one at a few of them, with the parameters' sample values.
//!
//! N. Higham, *Analysis of the Cholesky decomposition of a semi-definite matrix*, 1990.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::plain::{Oracle, motion_subspace, pose_in_parent};
use crate::model::{Model, Tree};
use crate::spatial::PseudoInertia;
use crate::symbolic::{Evaluator, Graph, Number, Real, SymbolId};

/// A pivot below this part of its joint's unit is what rounding may have left of zero, in doubles.
const NOTHING: f64 = 1e-13;
/// One above this part is none of rounding.
const SOMETHING: f64 = 1e-8;
/// What rounding may have left of zero in the numbers of the compiler, with their thirty digits.
const NOTHING_AT_ALL: f64 = 1e-24;
/// The share of a joint in the motion, relative to the largest, from which on it takes part.
const SHARE: f64 = 1e-6;
/// In how many configurations a motion that moves no mass in any is looked for.
const STATES: usize = 3;
/// Above this size a robot is not judged: the matrix is dense here.
const MOST_JOINTS: usize = 128;

/// The speeds, in order, that can be together without moving any mass, whatever the configuration.
pub fn idle_motion(model: &Model<'_>, graph: &Graph) -> Option<Vec<usize>> {
    if model.tree.dof() > MOST_JOINTS {
        return None;
    }
    // Most robots have no such motion, and doubles show it at once.
    idle_in(&sampled::<f64>(model, graph), 0, SOMETHING)?;
    let tree = sampled::<Number>(model, graph);
    let first = idle_in(&tree, 0, NOTHING_AT_ALL)?;
    (1..STATES).all(|state| idle_in(&tree, state, NOTHING_AT_ALL).is_some()).then_some(first)
}

/// The speeds, in order, that can be together at `q` without moving any mass: M(q) is singular there.
pub fn idle_motion_at(tree: &Tree<f64>, q: &[f64]) -> Option<Vec<usize>> {
    let M = Oracle::new(tree).mass_matrix(q);
    idle_motion_of(&M, &diagonal(&M), NOTHING)
}

/// Whether some speeds can be together without moving any mass in whatever configuration.
pub fn is_idle_everywhere(tree: &Tree<f64>) -> bool {
    (0..STATES).all(|state| idle_in(tree, state, NOTHING).is_some())
}

/// Whether M has no inverse: a motion moves no mass, or an entry is no number.
pub(super) fn is_singular(M: &[Vec<f64>]) -> bool {
    !is_finite(M) || idle_motion_of(M, &diagonal(M), NOTHING).is_some()
}

/// The tree with the sample values of the parameters.
fn sampled<R: Real>(model: &Model<'_>, graph: &Graph) -> Tree<R> {
    let sample = |symbol: SymbolId| R::of_double(model.parameters[symbol.0 as usize].sample);
    let mut evaluator = Evaluator::new(graph, sample);
    model.tree.map(|expr| evaluator.value(expr))
}

/// The speeds of a motion that moves no mass in one of a few configurations.
fn idle_in<R: Real>(tree: &Tree<R>, state: usize, nothing: f64) -> Option<Vec<usize>> {
    // Irrational steps: no angle is like another, and none is a right one.
    let size = tree.coordinates();
    let angle = |k: usize| (0.7 + 1.618_034 * (state * size + k) as f64) % 3.0;
    let mut q: Vec<R> = (0..size).map(|k| R::of_double(angle(k))).collect();
    tree.normalise(&mut q);
    let M = Oracle::new(tree).mass_matrix(&q);
    let units = diagonal(&M).into_iter().zip(reaches(tree, &q)).map(|(entry, reach)| entry.larger(reach));
    idle_motion_of(&M, &units.collect::<Vec<_>>(), nothing)
}

/// The diagonal of M if all that hangs on each joint were as far from the joint's axis as it is from the joint's origin. What
/// rounding leaves of a diagonal entry that is zero, as of a point on an oblique axis, is small beside it.
fn reaches<R: Real>(tree: &Tree<R>, q: &[R]) -> Vec<R> {
    let mut beyond: Vec<PseudoInertia<R>> = tree.links.iter().map(|link| link.inertia).collect();
    let mut reaches = vec![R::from(0); tree.dof()];
    for (k, link) in tree.links.iter().enumerate().rev() {
        let spread = beyond[k].second.full().trace();
        for (speed, motion) in motion_subspace(link) {
            let (linear, angular) = (motion.linear(), motion.angular());
            let reach = linear.dot(linear) * beyond[k].mass + angular.dot(angular) * spread;
            reaches[speed] = reaches[speed] + reach.magnitude();
        }
        if let Some(parent) = link.parent {
            beyond[parent] = beyond[parent] + beyond[k].transformed(pose_in_parent(link, q));
        }
    }
    reaches
}

/// The speeds of a motion with `M·v = 0`, if there is one: of several, one of few speeds. A speed's unit is what its entry on
/// the diagonal is compared with.
fn idle_motion_of<R: Real>(M: &[Vec<R>], units: &[R], nothing: f64) -> Option<Vec<usize>> {
    if !is_finite(M) {
        return None;
    }
    let one = |unit: &R| if unit.is_positive() { R::from(1) / unit.sqrt() } else { R::from(1) };
    let scales: Vec<R> = units.iter().map(one).collect();
    let Eliminated { pivots, rest, left } = Eliminated::of(M, &scales, R::of_double(nothing));
    let is_nothing = |x: R| !(x.magnitude() - R::of_double(nothing)).is_positive();
    // Of an indefinite matrix the diagonal may be nothing and the rest not.
    if !rest.iter().all(|&i| rest.iter().all(|&j| is_nothing(left[i][j]))) {
        return None;
    }
    let motion = |&free: &usize| {
        let mut v = vec![R::from(0); M.len()];
        v[free] = R::from(1);
        for &k in pivots.iter().rev() {
            let row = left[k].iter().zip(&v).enumerate().filter(|(j, _)| *j != k);
            let taken = row.fold(R::from(0), |sum, (_, (&entry, &v))| sum + entry * v);
            v[k] = -taken / left[k][k];
        }
        let shares: Vec<R> = v.iter().zip(&scales).map(|(&v, &scale)| (v * scale).magnitude()).collect();
        let largest = shares.iter().copied().fold(R::from(0), R::larger);
        let takes_part = |&k: &usize| (shares[k] - R::of_double(SHARE) * largest).is_positive();
        (0..shares.len()).filter(takes_part).collect::<Vec<_>>()
    };
    rest.iter().map(motion).min_by_key(Vec::len)
}

/// A symmetric matrix from which variables have been eliminated.
struct Eliminated<R> {
    /// Those that have been, in order.
    pivots: Vec<usize>,
    /// Those of which nothing is left.
    rest: Vec<usize>,
    /// The rows of pivots as they were when their turn came, zero before their pivots, and what is left of the others.
    left: Vec<Vec<R>>,
}

impl<R: Real> Eliminated<R> {
    /// Eliminates from `S·M·S` the largest on the diagonal, until they are `nothing`.
    fn of(M: &[Vec<R>], scales: &[R], nothing: R) -> Self {
        let scaled = |(row, &scale): (&Vec<R>, &R)| -> Vec<R> {
            row.iter().zip(scales).map(|(&entry, &other)| scale * entry * other).collect()
        };
        let mut left: Vec<Vec<R>> = M.iter().zip(scales).map(scaled).collect();
        let (mut pivots, mut rest) = (vec![], (0..M.len()).collect::<Vec<_>>());
        loop {
            let size = |k: usize| left[k][k].magnitude();
            let larger = |best: usize, k: usize| if (size(k) - size(best)).is_positive() { k } else { best };
            let Some(pivot) = rest.iter().copied().reduce(larger) else { break };
            if !(size(pivot) - nothing).is_positive() {
                break;
            }
            rest.retain(|&k| k != pivot);
            pivots.push(pivot);
            let row = left[pivot].clone();
            for &i in &rest {
                let share = row[i] / row[pivot];
                for &j in &rest {
                    left[i][j] = left[i][j] - share * row[j];
                }
                left[i][pivot] = R::from(0);
            }
        }
        Self { pivots, rest, left }
    }
}

fn diagonal<R: Real>(M: &[Vec<R>]) -> Vec<R> {
    (0..M.len()).map(|k| M[k][k].magnitude()).collect()
}

fn is_finite<R: Real>(M: &[Vec<R>]) -> bool {
    let is_within = |size: R| size.is_positive() && !(size - R::of_double(f64::MAX)).is_positive();
    M.iter().flatten().all(|&entry| Real::is_zero(entry) || is_within(entry.magnitude()))
}

#[cfg(test)]
mod tests {
    use super::{diagonal, idle_motion_of, is_singular};

    #[test]
    fn joints_on_one_axis_cancel_each_other() {
        let idle = |M: &Vec<Vec<f64>>| idle_motion_of(M, &diagonal(M), 1e-13);
        let M = vec![vec![3.0, 2.0, 2.0], vec![2.0, 2.0, 2.0], vec![2.0, 2.0, 2.0]];
        assert_eq!(idle(&M), Some(vec![1, 2]));
        let M = vec![vec![0.0, 0.0], vec![0.0, 2.0]];
        assert_eq!(idle(&M), Some(vec![0]));
        let M = vec![vec![3.0, 0.0], vec![0.0, 1e-9]];
        assert_eq!(idle(&M), None);
        assert!(!is_singular(&M));
        assert!(is_singular(&[vec![3.0, 3.0], vec![3.0, 3.0]]));
        assert!(is_singular(&[vec![f64::NAN]]) && is_singular(&[vec![f64::INFINITY]]));
    }

    /// Neither moves mass alone, and both together do: less than none.
    #[test]
    fn a_matrix_that_is_indefinite_has_an_inverse() {
        assert!(!is_singular(&[vec![0.0, 1.0], vec![1.0, 0.0]]));
        assert!(!is_singular(&[vec![1.0, 2.0], vec![2.0, 1.0]]));
    }
}
