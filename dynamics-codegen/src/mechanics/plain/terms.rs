//! Terms of one's own in the energies, in numbers: differentiated by [`Dual`], and by what is exact of quadratic forms.
//!
//! `p_i(w) = T(w + e_i) − T(w) − T(e_i)` is `∂T/∂v_i` at the speeds `w`, so `M_ij = p_i(e_j)`, and Lagrange's equations, with
//! the brackets of G. Hamel where speeds are no rates, are `ṗ_i + Σ p_k [e_i, v]_k − E_i(T)`.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::coriolis::bracket;
use super::dual::Dual;
use super::kinematics::pose;
use crate::model::{Link, Term, Terms, Tree};
use crate::spatial::{Scalar, Vector3};
use crate::spec::Function;

/// The value of a term.
pub(super) fn value<S: Scalar>(term: &Term<S>, tree: &Tree<S>, q: &[S], v: &[S]) -> S {
    match term {
        Term::Speed(k) => v[*k],
        Term::Rate(inner) => {
            let rate = tree.configuration_rate(q, v);
            match &**inner {
                // Most rates are of these, and need no copy of the tree.
                Term::Coordinate { q: k, ratio, .. } => *ratio * rate[*k],
                inner => {
                    let (inner, dual) = (inner.map(&mut Dual::constant), tree.map(Dual::constant));
                    at_rest(&inner, &dual, &Dual::moving(q, &rate)).tangent
                }
            }
        }
        _ => operated(term, |part| value(part, tree, q, v), tree, q),
    }
}

/// The value of a term without speeds.
fn at_rest<S: Scalar>(term: &Term<S>, tree: &Tree<S>, q: &[S]) -> S {
    operated(term, |part| at_rest(part, tree, q), tree, q)
}

fn operated<S: Scalar>(term: &Term<S>, of: impl Fn(&Term<S>) -> S, tree: &Tree<S>, q: &[S]) -> S {
    match term {
        Term::Still(value) => *value,
        Term::Coordinate { q: k, ratio, offset, .. } => *ratio * q[*k] + *offset,
        Term::Speed(_) | Term::Rate(_) => unreachable!("speeds are in no rate"),
        Term::Place(axis, frame) => origin(tree, Some(*frame), q).0[*axis],
        Term::Distance(frames) => squared_distance(tree, *frames, q).sqrt(),
        Term::Negative(inner) => -of(inner),
        Term::Sum(terms) => terms.iter().map(of).fold(S::zero(), |sum, term| sum + term),
        Term::Product(factors) => factors.iter().map(of).fold(S::one(), |product, factor| product * factor),
        Term::Quotient(parts) => of(&parts[0]) / of(&parts[1]),
        // Where two points meet, the square of their distance is smooth and the distance is not.
        Term::Power(base, exponent) => match (&**base, exponent % 2) {
            (Term::Distance(frames), 0) => power(squared_distance(tree, *frames, q), exponent / 2),
            _ => power(of(base), *exponent),
        },
        Term::Call(Function::Sin, inner) => of(inner).sin(),
        Term::Call(Function::Cos, inner) => of(inner).cos(),
        Term::Call(Function::Sqrt, inner) => of(inner).sqrt(),
    }
}

/// What makes a term undefined, or useless, if it holds in every configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flaw {
    /// It divides by zero.
    DivisionByZero,
    /// Two points are one.
    NoDistance,
    /// It acts at rest, or is not smooth there.
    ForceAtRest,
    /// It gives energy.
    Drives,
}

/// What is wrong with a term of D at a configuration. Of those that drive, D as a whole must.
pub fn flaw_of_dissipation(term: &Term<f64>, tree: &Tree<f64>, q: &[f64], v: &[f64]) -> Option<Flaw> {
    let power_of = |tree: &Tree<f64>| -> f64 {
        dissipation_forces(tree, q, v).iter().zip(v).map(|(force, v)| force * v).sum()
    };
    let alone = Terms { dissipation: vec![term.clone()], ..Terms::none() };
    let alone = Tree { terms: alone, ..tree.clone() };
    let at_rest = dissipation_forces(&alone, q, &vec![0.0; v.len()]);
    // What is left of forces of the size of one.
    match at_rest.iter().all(|force| force.abs() < 1e-9) {
        false => Some(Flaw::ForceAtRest),
        true => (power_of(&alone) < 0.0 && power_of(tree) < 0.0).then_some(Flaw::Drives),
    }
}

/// The first flaw of a term at a configuration.
pub fn flaw(term: &Term<f64>, tree: &Tree<f64>, q: &[f64], v: &[f64]) -> Option<Flaw> {
    // Sums of a few numbers of the size of one, of which nothing but rounding is left.
    let is_nothing = |value: f64| value.abs() < 1e-12;
    match term {
        Term::Quotient(parts) if is_nothing(value(&parts[1], tree, q, v)) => Some(Flaw::DivisionByZero),
        Term::Distance(_) if is_nothing(value(term, tree, q, v)) => Some(Flaw::NoDistance),
        _ => term.parts().into_iter().find_map(|part| flaw(part, tree, q, v)),
    }
}

/// Why a term, or one of its derivatives, has no value at a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rough<S = f64> {
    /// It divides by zero.
    Division,
    /// Two points meet whose distance is not squared.
    Distance,
    /// It has the root of zero, or of less.
    Root(S),
}

/// The first reason for which a term has no derivative at a state. `is_rootless` is whether a number is zero, or negative
/// where that can be told.
pub fn rough<S: Scalar>(
    term: &Term<S>,
    tree: &Tree<S>,
    (q, v): (&[S], &[S]),
    is_rootless: fn(S) -> bool,
) -> Option<Rough<S>> {
    let of_part = |part| rough(part, tree, (q, v), is_rootless);
    match term {
        Term::Power(base, exponent) if exponent % 2 == 0 && matches!(**base, Term::Distance(_)) => None,
        Term::Distance(frames) => squared_distance(tree, *frames, q).is_zero().then_some(Rough::Distance),
        _ => term.parts().into_iter().find_map(of_part).or_else(|| match term {
            Term::Quotient(parts) => value(&parts[1], tree, q, v).is_zero().then_some(Rough::Division),
            Term::Call(Function::Sqrt, inner) => {
                Some(value(inner, tree, q, v)).filter(|inner| is_rootless(*inner)).map(Rough::Root)
            }
            _ => None,
        }),
    }
}

/// Whether a term has derivatives at rest at a configuration: nothing divides by zero there, and no root is of zero.
pub fn is_smooth<S: Scalar>(term: &Term<S>, tree: &Tree<S>, q: &[S]) -> bool {
    rough(term, tree, (q, &vec![S::zero(); tree.dof()]), S::is_zero).is_none()
}

fn power<S: Scalar>(base: S, exponent: u32) -> S {
    (0..exponent).fold(S::one(), |power, _| power * base)
}

fn origin<S: Scalar>(tree: &Tree<S>, frame: Option<usize>, q: &[S]) -> Vector3<S> {
    frame.map_or(Vector3::zero(), |frame| pose(tree, &tree.frames[frame], q).translation)
}

fn squared_distance<S: Scalar>(tree: &Tree<S>, [a, b]: [Option<usize>; 2], q: &[S]) -> S {
    let between = origin(tree, a, q) - origin(tree, b, q);
    between.dot(between)
}

/// The terms of `V`, J.
pub fn potential_energy<S: Scalar>(tree: &Tree<S>, q: &[S]) -> S {
    let terms = tree.terms.potential.iter();
    terms.fold(S::zero(), |sum, term| sum + at_rest(term, tree, q))
}

/// The terms of `T`, J.
pub fn kinetic_energy<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S]) -> S {
    let terms = tree.terms.kinetic.iter();
    terms.fold(S::zero(), |sum, term| sum + value(term, tree, q, v))
}

/// `∂V/∂q` of the terms, n.
pub(super) fn potential_forces<S: Scalar>(tree: &Tree<S>, q: &[S]) -> Vec<S> {
    let mut forces = vec![S::zero(); tree.dof()];
    if tree.terms.potential.is_empty() {
        return forces;
    }
    let dual = tree.map(Dual::constant);
    for (k, force) in forces.iter_mut().enumerate() {
        let moving = Dual::moving(q, &tree.configuration_rate(q, &unit(k, tree.dof())));
        *force = potential_energy(&dual, &moving).tangent;
    }
    forces
}

/// `∂D/∂v`, n.
pub(super) fn dissipation_forces<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S]) -> Vec<S> {
    let mut forces = vec![S::zero(); tree.dof()];
    if tree.terms.dissipation.is_empty() {
        return forces;
    }
    let (dual, q) = (tree.map(Dual::constant), Dual::resting(q));
    for (k, force) in forces.iter_mut().enumerate() {
        let moving = Dual::moving(v, &unit(k, v.len()));
        let terms = dual.terms.dissipation.iter();
        *force = terms.fold(S::zero(), |sum, term| sum + value(term, &dual, &q, &moving).tangent);
    }
    forces
}

/// `∂²T/∂v²` of the terms, n×n.
pub(super) fn mass_matrix<S: Scalar>(tree: &Tree<S>, q: &[S]) -> Vec<Vec<S>> {
    let n = tree.dof();
    let mut M = vec![vec![S::zero(); n]; n];
    let T = |v: &[S]| kinetic_energy(tree, q, v);
    for (i, j) in tree.coupled_by_terms() {
        let entry = momentum(&T, i, &unit(j, n));
        (M[i][j], M[j][i]) = (entry, entry);
    }
    M
}

/// `∂T/∂v_i` at the speeds `v`.
fn momentum<S: Scalar>(T: &impl Fn(&[S]) -> S, i: usize, v: &[S]) -> S {
    let unit = unit::<S>(i, v.len());
    let sum: Vec<S> = v.iter().zip(&unit).map(|(&v, &e)| v + e).collect();
    T(&sum) - T(v) - T(&unit)
}

/// What the terms of `T` need: their part in `M·a + C·v`, n.
pub(super) fn inertial_forces<S: Scalar>(tree: &Tree<S>, q: &[S], v: &[S], a: &[S]) -> Vec<S> {
    let n = tree.dof();
    let mut forces = vec![S::zero(); n];
    if tree.terms.kinetic.is_empty() {
        return forces;
    }
    let dual = tree.map(Dual::constant);
    let (moving, resting_v) = (Dual::moving(q, &tree.configuration_rate(q, v)), Dual::resting(v));
    let T = |v: &[S]| kinetic_energy(tree, q, v);
    let T_on_the_way = |v: &[Dual<S>]| kinetic_energy(&dual, &moving, v);
    let mut momenta = vec![S::zero(); n];
    for i in acting(tree) {
        let on_the_way = momentum(&T_on_the_way, i, &resting_v);
        momenta[i] = on_the_way.value;
        let along = Dual::moving(q, &tree.configuration_rate(q, &unit(i, n)));
        let slope = kinetic_energy(&dual, &along, &resting_v).tangent;
        forces[i] = momentum(&T, i, a) + on_the_way.tangent - slope;
    }
    if !tree.is_one_dof() {
        for (i, force) in forces.iter_mut().enumerate() {
            let turned = bracket(tree, &unit(i, n), v);
            *force = momenta.iter().zip(turned).fold(*force, |sum, (&p, b)| sum + p * b);
        }
    }
    forces
}

/// The speeds in whose directions the terms of `T` change, or which stand in them: all of a joint that has one of them,
/// for how fast a free joint's position changes depends on its orientation as well.
fn acting<S: Scalar>(tree: &Tree<S>) -> Vec<usize> {
    let named: Vec<usize> = tree.terms.kinetic.iter().flat_map(|term| term.speeds(tree)).collect();
    let of_link = |link: &Link<S>| link.drive.v..link.drive.v + link.motion.speeds();
    let links = tree.links.iter().filter(|link| named.iter().any(|speed| of_link(link).contains(speed)));
    let mut speeds: Vec<usize> = links.flat_map(of_link).collect();
    speeds.sort_unstable();
    speeds.dedup();
    speeds
}

fn unit<S: Scalar>(k: usize, n: usize) -> Vec<S> {
    (0..n).map(|i| if i == k { S::one() } else { S::zero() }).collect()
}
