//! Terms of one's own in the energies, as trees of operations on what moves.
//!
//! They are kept as written, in the robot's own coordinates and in SI units: what differentiates them does so in ways of
//! its own.

use std::ops::Range;

use super::{Link, Tree};
use crate::spatial::Scalar;
use crate::spec::Function;

/// What is added to the energies of a tree.
#[derive(Clone, Debug)]
pub struct Terms<S> {
    /// Terms of `V`, J.
    pub potential: Vec<Term<S>>,
    /// Terms of Rayleigh's `D`, W: `∂D/∂v` is on the left-hand side.
    pub dissipation: Vec<Term<S>>,
    /// Terms of `T`, J: quadratic in the speeds.
    pub kinetic: Vec<Term<S>>,
}

/// A part of a term, or all of it.
#[derive(Clone, Debug)]
pub enum Term<S> {
    /// What does not move: numbers and fields.
    Still(S),
    /// The coordinate of a joint of one degree of freedom, `ratio·q[q] + offset`, or of another joint one of its
    /// coordinates; it changes with the speeds `v`.
    Coordinate {
        /// Which of the robot's.
        q: usize,
        /// The speeds by which it changes.
        v: (usize, usize),
        /// Of the joint's to the robot's.
        ratio: S,
        /// Where the robot's is zero.
        offset: S,
    },
    /// A speed that is no rate of a coordinate.
    Speed(usize),
    /// The origin of a frame in the world, along x, y or z (0, 1, 2).
    Place(usize, usize),
    /// How far the origins of two frames are from each other; `None` is the world.
    Distance([Option<usize>; 2]),
    /// How fast it changes.
    Rate(Box<Term<S>>),
    /// `−x`
    Negative(Box<Term<S>>),
    /// All of them added.
    Sum(Vec<Term<S>>),
    /// All of them multiplied.
    Product(Vec<Term<S>>),
    /// `x/y`
    Quotient(Box<[Term<S>; 2]>),
    /// `xⁿ`
    Power(Box<Term<S>>, u32),
    /// `f(x)`
    Call(Function, Box<Term<S>>),
}

impl<S> Terms<S> {
    /// Nothing is added.
    pub fn none() -> Self {
        Self { potential: vec![], dissipation: vec![], kinetic: vec![] }
    }

    /// Whether nothing is.
    pub fn is_empty(&self) -> bool {
        self.potential.is_empty() && self.dissipation.is_empty() && self.kinetic.is_empty()
    }

    /// All of them: those of `V`, of `D`, of `T`.
    pub fn all(&self) -> impl Iterator<Item = &Term<S>> {
        self.potential.iter().chain(&self.dissipation).chain(&self.kinetic)
    }
}

impl<S: Scalar> Terms<S> {
    /// The terms with `f` applied to what does not move.
    pub fn map<R>(&self, f: &mut dyn FnMut(S) -> R) -> Terms<R> {
        let mut each = |terms: &[Term<S>]| terms.iter().map(|term| term.map(f)).collect();
        Terms {
            potential: each(&self.potential),
            dissipation: each(&self.dissipation),
            kinetic: each(&self.kinetic),
        }
    }
}

impl<S: Copy> Term<S> {
    /// The term with `f` applied to what does not move.
    pub fn map<R>(&self, f: &mut dyn FnMut(S) -> R) -> Term<R> {
        let mut each = |terms: &[Self]| terms.iter().map(|term| term.map(f)).collect();
        match self {
            Self::Still(value) => Term::Still(f(*value)),
            Self::Coordinate { q, v, ratio, offset } => {
                Term::Coordinate { q: *q, v: *v, ratio: f(*ratio), offset: f(*offset) }
            }
            Self::Speed(v) => Term::Speed(*v),
            Self::Place(axis, frame) => Term::Place(*axis, *frame),
            Self::Distance(frames) => Term::Distance(*frames),
            Self::Sum(terms) => Term::Sum(each(terms)),
            Self::Product(factors) => Term::Product(each(factors)),
            Self::Rate(inner) => Term::Rate(Box::new(inner.map(f))),
            Self::Negative(inner) => Term::Negative(Box::new(inner.map(f))),
            Self::Quotient(parts) => {
                let [above, below] = &**parts;
                Term::Quotient(Box::new([above.map(f), below.map(f)]))
            }
            Self::Power(base, exponent) => Term::Power(Box::new(base.map(f)), *exponent),
            Self::Call(function, inner) => Term::Call(*function, Box::new(inner.map(f))),
        }
    }
}

impl<S> Term<S> {
    /// The parts of which it is made.
    pub fn parts(&self) -> Vec<&Self> {
        match self {
            Self::Still(_)
            | Self::Coordinate { .. }
            | Self::Speed(_)
            | Self::Place(..)
            | Self::Distance(_) => {
                vec![]
            }
            Self::Rate(inner) | Self::Negative(inner) | Self::Power(inner, _) | Self::Call(_, inner) => {
                vec![inner]
            }
            Self::Sum(parts) | Self::Product(parts) => parts.iter().collect(),
            Self::Quotient(parts) => parts.iter().collect(),
        }
    }

    /// Whether it asks where frames are.
    pub fn has_places(&self) -> bool {
        matches!(self, Self::Place(..) | Self::Distance(_)) || self.parts().into_iter().any(Self::has_places)
    }

    /// The speeds by which it changes, and those that stand in it, in order.
    pub fn speeds<R>(&self, tree: &Tree<R>) -> Vec<usize> {
        let mut speeds: Vec<usize> = match self {
            Self::Coordinate { v, .. } => (v.0..v.1).collect(),
            Self::Speed(v) => vec![*v],
            Self::Place(_, frame) => speeds_of(tree, path(tree, tree.frames[*frame].link)),
            Self::Distance([a, b]) => {
                let [a, b] = [a, b].map(|frame| path(tree, frame.and_then(|frame| tree.frames[frame].link)));
                let apart = |one: &[usize], other: &[usize]| {
                    one.iter().copied().filter(|link| !other.contains(link)).collect::<Vec<_>>()
                };
                speeds_of(tree, [apart(&a, &b), apart(&b, &a)].concat())
            }
            _ => self.parts().into_iter().flat_map(|part| part.speeds(tree)).collect(),
        };
        speeds.sort_unstable();
        speeds.dedup();
        speeds
    }
}

/// The links from one down to the base.
fn path<R>(tree: &Tree<R>, link: Option<usize>) -> Vec<usize> {
    std::iter::successors(link, |&k| tree.links[k].parent).collect()
}

fn speeds_of<R>(tree: &Tree<R>, links: Vec<usize>) -> Vec<usize> {
    let of_link = |link: &Link<R>| -> Range<usize> { link.drive.v..link.drive.v + link.motion.speeds() };
    links.into_iter().flat_map(|k| of_link(&tree.links[k])).collect()
}

impl<S> Tree<S> {
    /// The pairs of speeds whose product may be in the kinetic terms, the larger one first.
    pub fn coupled_by_terms(&self) -> Vec<(usize, usize)> {
        let mut pairs = vec![];
        for term in &self.terms.kinetic {
            if let Quadratic::Pairs(found) = quadratic(term, self) {
                pairs.extend(found);
            }
        }
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }
}

/// Which speeds a part of a kinetic term is a form of.
enum Quadratic {
    /// None: it is a coefficient.
    None,
    /// A linear form of these.
    Linear(Vec<usize>),
    /// A quadratic form, of products of these.
    Pairs(Vec<(usize, usize)>),
}

fn quadratic<S>(term: &Term<S>, tree: &Tree<S>) -> Quadratic {
    use Quadratic::{Linear, Pairs};
    let join = |one: Quadratic, other: Quadratic| match (one, other) {
        (Quadratic::None, other) | (other, Quadratic::None) => other,
        (Linear(mut one), Linear(other)) => {
            one.extend(other);
            Linear(one)
        }
        (Pairs(mut one), Pairs(other)) => {
            one.extend(other);
            Pairs(one)
        }
        // What is judged has terms of one degree only.
        (one, _) => one,
    };
    let times = |one: Quadratic, other: Quadratic| match (one, other) {
        (Linear(one), Linear(other)) => {
            let pair = |(&a, &b): (&usize, &usize)| (a.max(b), a.min(b));
            Pairs(one.iter().flat_map(|a| other.iter().map(move |b| (a, b))).map(pair).collect())
        }
        (one, other) => join(one, other),
    };
    let parts = || term.parts().into_iter().map(|part| quadratic(part, tree));
    match term {
        Term::Speed(v) => Linear(vec![*v]),
        Term::Rate(_) => Linear(term.speeds(tree)),
        Term::Product(_) => parts().fold(Quadratic::None, times),
        Term::Power(base, 2) => times(quadratic(base, tree), quadratic(base, tree)),
        Term::Power(base, 0) if matches!(quadratic(base, tree), Linear(_)) => Quadratic::None,
        _ => parts().fold(Quadratic::None, join),
    }
}
