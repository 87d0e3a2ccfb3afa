//! Branches that are alike: the same joints on the same link, with other numbers.
//!
//! The legs of a quadruped are one tree four times. What is derived of one leg holds of the others, once the numbers
//! in which they differ have names: then their equations are the same but for the names, and can be computed side by
//! side. Where a leg is the mirror image of another, some of its axes point the other way; these are turned round,
//! and their coordinates with them.

use std::cell::RefCell;

use super::gauge::regauge;
use super::method::{Argument, Inputs};
use super::normal::{NormalLink, NormalTree};
use super::rotation::{PlanarTurn, Turn};
use crate::model::{Drive, Link, Passive, Tree};
use crate::spatial::{Matrix3, Pose, PseudoInertia, Scalar, Vector3};
use crate::symbolic::{Expr, Graph, NodeId, Op, SymbolId};

/// Branches that are alike, by the links of each in the same order.
pub type Alike = Vec<Vec<usize>>;

/// What stands for what in branches that are alike.
#[derive(Clone, Debug, Default)]
pub struct Branches<'g> {
    /// For each set of branches and each branch its symbols in the same order, each with whether it has the other sign.
    pub sets: Vec<Vec<Vec<(SymbolId, bool)>>>,
    /// The names given to numbers, from `first_name` on.
    values: Vec<Expr<'g>>,
    first_name: u32,
    /// For each set of branches and each branch the speeds of its joints in the same order.
    speeds: Vec<Vec<Vec<usize>>>,
    /// Of nodes, as far as anybody asked.
    owners: RefCell<Vec<Owner>>,
}

/// Of which branches an expression is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Owner {
    /// Of none.
    Trunk,
    /// Of one in a set.
    Branch(usize, usize),
    /// Of several in one set.
    Set(usize),
    /// Of several sets.
    Several,
}

impl Owner {
    fn with(self, other: Self) -> Self {
        match (self, other) {
            (Owner::Trunk, owner) | (owner, Owner::Trunk) => owner,
            (one, other) if one == other => one,
            (Owner::Branch(one, _) | Owner::Set(one), Owner::Branch(other, _) | Owner::Set(other))
                if one == other =>
            {
                Owner::Set(one)
            }
            _ => Owner::Several,
        }
    }

    /// Whether it is of more than one branch.
    fn is_plural(self) -> bool {
        matches!(self, Owner::Set(_) | Owner::Several)
    }
}

impl<'g> Branches<'g> {
    /// Of which branches a node is. What several of them made together, and nobody takes apart again, is the trunk's: what
    /// is opaque, and what depends on parameters alone.
    pub fn owner(&self, graph: &Graph, node: NodeId) -> Owner {
        let mut owners = self.owners.borrow_mut();
        for &op in &graph.ops()[owners.len()..] {
            let id = graph.node(owners.len());
            let owner = match op {
                Op::Symbol(symbol) => self.of_symbol(symbol),
                Op::Opaque(_) => Owner::Trunk,
                op => op.operands().fold(Owner::Trunk, |owner, operand| owner.with(owners[operand.index()])),
            };
            let is_settled = owner.is_plural() && graph.is_parameter_only(id);
            owners.push(if is_settled { Owner::Trunk } else { owner });
        }
        owners[node.index()]
    }

    fn of_symbol(&self, symbol: SymbolId) -> Owner {
        let is_of = |branch: &Vec<(SymbolId, bool)>| branch.iter().any(|(known, _)| *known == symbol);
        let of_set = |(number, set): (usize, &Vec<Vec<(SymbolId, bool)>>)| {
            set.iter().position(is_of).map(|branch| Owner::Branch(number, branch))
        };
        self.sets.iter().enumerate().find_map(of_set).unwrap_or(Owner::Trunk)
    }

    /// What a joint of the trunk feels, or does, of several branches together: nobody shall ask of which, or all that follows
    /// from it would be of all of them. The value itself where that is not so.
    pub fn together(&self, speed: usize, value: Expr<'g>) -> Expr<'g> {
        match value {
            Expr::Node { graph, id, .. }
                if self.joint(speed).is_none() && self.owner(graph, id).is_plural() =>
            {
                value.opaque()
            }
            _ => value,
        }
    }

    /// Whether to compute the entry `(i, k)` of a symmetric matrix of joints rather than `(k, i)`: between branches that are
    /// alike the same of each and the one that is so many after it, in a circle, so that all of these are one operation.
    pub fn is_computed(&self, i: usize, k: usize) -> bool {
        match (self.joint(i), self.joint(k)) {
            (Some((set, one, place)), Some((other_set, other, other_place)))
                if set == other_set && one != other =>
            {
                let count = self.speeds[set].len();
                let steps = |from: usize, to: usize| (to + count - from) % count;
                (steps(one, other), place, one) < (steps(other, one), other_place, other)
            }
            _ => i <= k,
        }
    }

    /// The set, the branch and the place of the joint with that speed; none if it is of the trunk.
    fn joint(&self, speed: usize) -> Option<(usize, usize, usize)> {
        let mut branches = self.speeds.iter().enumerate().flat_map(|(set, speeds)| {
            speeds.iter().enumerate().map(move |(branch, speeds)| (set, branch, speeds))
        });
        branches.find_map(|(set, branch, speeds)| {
            Some((set, branch, speeds.iter().position(|&known| known == speed)?))
        })
    }

    /// What a name stands for; none if the symbol is an input.
    pub fn value(&self, symbol: SymbolId) -> Option<Expr<'g>> {
        self.values.get(symbol.0.checked_sub(self.first_name)? as usize).copied()
    }
}

/// The branches of a tree that are alike, and the tree with the axes of their joints turned alike; none if there are no such.
pub fn of<'g>(tree: &Tree<Expr<'g>>) -> Option<(Tree<Expr<'g>>, Vec<Alike>)> {
    let mut sets = alike(tree);
    if sets.is_empty() {
        return None;
    }
    let turned = turned_alike(tree, &sets);
    let normal = regauge(&turned);
    let is_planar = |k: usize| matches!(normal.links[k].turn, Turn::Planar { .. });
    let is_same = |set: &Alike, place: usize| {
        set.iter().all(|branch| is_planar(branch[place]) == is_planar(set[0][place]))
    };
    sets.retain(|set| (0..set[0].len()).all(|place| is_same(set, place)));
    (!sets.is_empty()).then_some((turned, sets))
}

/// The branches of a tree that are alike, the largest first: within them none are looked for.
fn alike<S: Scalar>(tree: &Tree<S>) -> Vec<Alike> {
    let kinds = kinds(tree);
    let children = |parent: Option<usize>| {
        (0..tree.links.len()).filter(move |&k| tree.links[k].parent == parent).collect::<Vec<_>>()
    };
    let mut found: Vec<Alike> = Vec::new();
    let mut parents = vec![None];
    while let Some(parent) = parents.pop() {
        let roots = children(parent);
        let mut is_taken = vec![false; roots.len()];
        for (place, &root) in roots.iter().enumerate() {
            if is_taken[place] {
                continue;
            }
            let same = |&other: &usize| kinds[root].is_some() && kinds[roots[other]] == kinds[root];
            let of_kind: Vec<usize> = (place..roots.len()).filter(same).collect();
            if of_kind.len() < 2 {
                parents.push(Some(root));
                continue;
            }
            of_kind.iter().for_each(|&other| is_taken[other] = true);
            found.push(of_kind.iter().map(|&other| links_from(tree, roots[other])).collect());
        }
    }
    found
}

/// The links from `root` on, parents before children.
fn links_from<S>(tree: &Tree<S>, root: usize) -> Vec<usize> {
    let mut links = vec![root];
    for (k, link) in tree.links.iter().enumerate().skip(root + 1) {
        if link.parent.is_some_and(|parent| links.contains(&parent)) {
            links.push(k);
        }
    }
    links
}

/// For each link a number for the kind of branch that begins with it; none where a joint of it has more than one
/// degree of freedom, or shares a coordinate.
fn kinds<S: Scalar>(tree: &Tree<S>) -> Vec<Option<usize>> {
    let mut known: Vec<(crate::model::Motion, Vec<usize>)> = Vec::new();
    let mut kinds = vec![None; tree.links.len()];
    for (k, link) in tree.links.iter().enumerate().rev() {
        let is_alone = tree.links.iter().filter(|other| other.drive.v == link.drive.v).count() == 1;
        let is_own = link.motion.speeds() == 1 && link.drive.ratio.as_sign() == Some(1) && is_alone;
        let children: Option<Vec<usize>> = (k + 1..tree.links.len())
            .filter(|&c| tree.links[c].parent == Some(k))
            .map(|c| kinds[c])
            .collect();
        let Some(children) = children.filter(|_| is_own) else { continue };
        let kind = (link.motion, children);
        let place = known.iter().position(|other| *other == kind).unwrap_or_else(|| {
            known.push(kind);
            known.len() - 1
        });
        kinds[k] = Some(place);
    }
    kinds
}

/// The same tree, with the axes of joints turned round that point the other way than those of the first branch.
fn turned_alike<'g>(tree: &Tree<Expr<'g>>, sets: &[Alike]) -> Tree<Expr<'g>> {
    let mut turned = tree.clone();
    let longest = sets.iter().map(|set| set[0].len()).max().unwrap_or(0);
    let mut normal = regauge(&turned);
    for place in 0..longest {
        let mut changed = false;
        for set in sets.iter().filter(|set| set[0].len() > place) {
            let axis = |branch: &Vec<usize>| normal.links[branch[place]].turn.up(Vector3::unit_z());
            let first = axis(&set[0]);
            for branch in &set[1..] {
                if is_opposite(first, axis(branch)) {
                    turn_round(&mut turned, branch[place]);
                    changed = true;
                }
            }
        }
        if changed {
            normal = regauge(&turned);
        }
    }
    turned
}

/// Whether one vector is minus the other, in all that is 0 or ±1.
fn is_opposite(a: Vector3<Expr<'_>>, b: Vector3<Expr<'_>>) -> bool {
    let opposite =
        |(a, b): (&Expr<'_>, &Expr<'_>)| matches!((a.as_sign(), b.as_sign()), (Some(a), Some(b)) if a == -b);
    a.0.iter().zip(&b.0).all(opposite)
}

/// Turns the axis of a joint round, and its coordinate.
fn turn_round<'g>(tree: &mut Tree<Expr<'g>>, k: usize) {
    let half = Pose::rotation(Matrix3::rotation_x(-Expr::ONE, Expr::ZERO));
    let Link { drive, passive, placement, inertia, .. } = tree.links[k];
    let link = &mut tree.links[k];
    link.placement = placement * half;
    link.inertia = inertia.transformed(half);
    link.drive = Drive { ratio: -drive.ratio, offset: -drive.offset, ..drive };
    link.passive = Passive { rest: -passive.rest, ..passive };
    for child in tree.links.iter_mut().filter(|child| child.parent == Some(k)) {
        child.placement = half * child.placement;
    }
    for frame in tree.frames.iter_mut().filter(|frame| frame.link == Some(k)) {
        frame.pose = half * frame.pose;
    }
}

/// The same tree with names for the numbers in which branches differ.
pub fn named<'g>(
    tree: &NormalTree<Expr<'g>>,
    sets: &[Alike],
    graph: &'g Graph,
    inputs: Inputs,
) -> (NormalTree<Expr<'g>>, Branches<'g>) {
    let mut tree = tree.clone();
    let first_name = inputs.symbol(Argument::Tau, inputs.dof).0;
    let mut branches = Branches { first_name, ..Branches::default() };
    for set in sets {
        let mut symbols: Vec<Vec<(SymbolId, bool)>> = vec![Vec::new(); set.len()];
        let mut speeds: Vec<Vec<usize>> = vec![Vec::new(); set.len()];
        for place in 0..set[0].len() {
            let links: Vec<usize> = set.iter().map(|branch| branch[place]).collect();
            let mut numbers: Vec<Vec<Expr<'g>>> = links.iter().map(|&k| numbers(&tree.links[k])).collect();
            for of_number in 0..numbers[0].len() {
                let first = numbers[0][of_number];
                if numbers.iter().all(|numbers| numbers[of_number] == first) {
                    continue;
                }
                for (numbers, symbols) in numbers.iter_mut().zip(&mut symbols) {
                    let count = u32::try_from(branches.values.len()).expect("fewer than 2^32 names");
                    let symbol = SymbolId(first_name + count);
                    branches.values.push(numbers[of_number]);
                    numbers[of_number] = graph.symbol(symbol);
                    symbols.push((symbol, false));
                }
            }
            let of_branch = symbols.iter_mut().zip(&mut speeds);
            for ((&k, numbers), (symbols, speeds)) in links.iter().zip(numbers).zip(of_branch) {
                let link = &mut tree.links[k];
                *link = with_numbers(link, &mut numbers.into_iter());
                let Drive { q, v, ratio, .. } = link.drive;
                speeds.push(v);
                let is_turned = ratio.is_negative();
                symbols.push((inputs.symbol(Argument::Q, q), is_turned));
                let of_speed = |argument| (inputs.symbol(argument, v), is_turned);
                symbols.extend([Argument::V, Argument::A, Argument::Tau].map(of_speed));
            }
        }
        branches.sets.push(symbols);
        branches.speeds.push(speeds);
    }
    (tree, branches)
}

/// All numbers of a link but the ratio, which is ±1.
fn numbers<'g>(link: &NormalLink<Expr<'g>>) -> Vec<Expr<'g>> {
    let mut numbers = Vec::new();
    let _ = mapped(link, &mut |number| {
        numbers.push(number);
        number
    });
    numbers
}

fn with_numbers<'g>(
    link: &NormalLink<Expr<'g>>,
    numbers: &mut impl Iterator<Item = Expr<'g>>,
) -> NormalLink<Expr<'g>> {
    mapped(link, &mut |number| numbers.next().unwrap_or(number))
}

fn mapped<'g>(link: &NormalLink<Expr<'g>>, f: &mut dyn FnMut(Expr<'g>) -> Expr<'g>) -> NormalLink<Expr<'g>> {
    let planar = |turn: PlanarTurn<Expr<'g>>, f: &mut dyn FnMut(Expr<'g>) -> Expr<'g>| PlanarTurn {
        cos: f(turn.cos),
        sin: f(turn.sin),
    };
    let turn = match link.turn {
        Turn::Planar { gamma, alpha } => Turn::Planar { gamma: planar(gamma, f), alpha: planar(alpha, f) },
        Turn::General(matrix) => Turn::General(matrix.map(&mut *f)),
    };
    let offset = planar(link.offset, f);
    let passive = link.passive.map(&mut *f);
    let PseudoInertia { mass, first, second } = link.inertia;
    let inertia = PseudoInertia { mass: f(mass), first: first.map(&mut *f), second: second.map(&mut *f) };
    let drive = Drive { offset: f(link.drive.offset), ..link.drive };
    let position = link.position.map(&mut *f);
    NormalLink { turn, offset, passive, inertia, drive, position, ..*link }
}
