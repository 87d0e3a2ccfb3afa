//! Which operations are done for all branches that are alike at once.
//!
//! What renames one branch into another takes expressions into expressions. Where that takes a node of the first branch
//! to a node that is needed as well, in each of the others, all of these are one operation on numbers side by side.
//! Equal expressions are one node, so nothing is searched for, and what is not there is computed alone.
//!
//! What couples two branches goes into what couples others if all branches are renamed at once, each into the one that is
//! so many after it, in a circle: the first with the second, the second with the third, the last with the first are one
//! operation, on the numbers of all branches and on the same numbers once round.

use rustc_hash::FxHashMap;

use super::schedule::nodes_of;
use crate::mechanics::branches::{Branches, Owner};
use crate::symbolic::{Expr, Graph, NodeId, NodeMap, Op, Substitution, SymbolId};

/// Where a node is computed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// The node for which it is computed: of the first branch, or of it and others.
    pub(super) node: NodeId,
    /// How many branches after those of that node.
    pub(super) lane: usize,
    /// Whether it is minus what is computed there.
    pub(super) negative: bool,
}

/// What is computed side by side.
pub(super) struct Layout<'g> {
    places: NodeMap<Place>,
    has_lanes: bool,
    /// For each node of the first branch, or of several, what stands in its place in all of them.
    rows: NodeMap<Vec<Expr<'g>>>,
}

impl<'g> Layout<'g> {
    /// Everything one by one.
    pub(super) fn one_by_one(graph: &'g Graph) -> Self {
        Self { has_lanes: false, places: NodeMap::new(graph), rows: NodeMap::new(graph) }
    }

    /// What can be computed side by side of what `results` need; `is_at_hand` are the nodes that need no step.
    pub(super) fn of(
        graph: &'g Graph,
        results: &[Expr<'g>],
        branches: &Branches<'g>,
        is_at_hand: impl Fn(NodeId) -> bool,
    ) -> Self {
        let mut layout = Self::one_by_one(graph);
        let (needed, is_needed) = needed(graph, results, &is_at_hand);
        for (number, set) in branches.sets.iter().enumerate() {
            let mut renamings: Vec<_> =
                (1..set.len()).map(|lane| renaming(graph, branches, set, lane)).collect();
            for &id in &needed {
                let is_leaf = is_at_hand(id) || matches!(graph.op(id), Op::Symbol(_));
                let begins = match branches.owner(graph, id) {
                    Owner::Branch(own, branch) => own == number && (branch == 0 || is_leaf),
                    Owner::Set(own) => own == number && layout.place(id).is_none(),
                    Owner::Trunk | Owner::Several => false,
                };
                if !begins {
                    continue;
                }
                let own = Expr::of_node(graph, id);
                let images = renamings.iter_mut().map(|renaming| renaming.apply(own));
                let row: Vec<Expr<'g>> = std::iter::once(own).chain(images).collect();
                let is_there =
                    |image: &Expr<'g>| matches!(*image, Expr::Node { id, .. } if is_needed.contains(id));
                if !row.iter().all(is_there) {
                    continue;
                }
                if !is_leaf {
                    layout.lay(id, &row);
                }
                layout.rows.insert(id, row);
            }
        }
        layout
    }

    /// Says of each expression of a row that it is computed beside the first one, which is that of `node`.
    fn lay(&mut self, node: NodeId, row: &[Expr<'g>]) {
        self.has_lanes = true;
        for (lane, image) in row.iter().enumerate() {
            if let Expr::Node { id, negative, .. } = *image
                && self.place(id).is_none()
            {
                self.places.insert(id, Place { node, lane, negative });
            }
        }
    }

    /// How many operations there are, several side by side being one, and what is taken out of these, or read in another order,
    /// being one as well.
    pub(super) fn operations(
        &self,
        graph: &Graph,
        results: &[Expr<'g>],
        is_free: impl Fn(NodeId) -> bool,
    ) -> usize {
        let mut seen: NodeMap<()> = NodeMap::new(graph);
        let mut taken: NodeMap<()> = NodeMap::new(graph);
        let mut count = 0;
        // What is read, and whether by one alone.
        let mut stack: Vec<(NodeId, bool)> = nodes_of(results).into_iter().map(|id| (id, true)).collect();
        while let Some((id, is_alone)) = stack.pop() {
            let is_moved = self.place(id).is_some_and(|place| is_alone || place.lane > 0);
            if is_moved && !taken.contains(id) {
                taken.insert(id, ());
                count += 1;
            }
            let id = self.representative(id);
            if seen.contains(id) {
                continue;
            }
            seen.insert(id, ());
            let op = graph.op(id);
            if is_free(id) || matches!(op, Op::Constant(_) | Op::Symbol(_)) {
                continue;
            }
            count += usize::from(!matches!(op, Op::Sin(_) | Op::Cos(_) | Op::Opaque(_)));
            let is_alone = self.lanes(id) == 1;
            stack.extend(op.operands().map(|operand| (operand, is_alone)));
        }
        count
    }

    /// Where a node is computed, if that is not alone.
    pub(super) fn place(&self, node: NodeId) -> Option<Place> {
        self.places.get(node).copied()
    }

    /// The node for which a node is computed.
    pub(super) fn representative(&self, node: NodeId) -> NodeId {
        self.place(node).map_or(node, |place| place.node)
    }

    /// Whether anything is computed side by side.
    pub(super) fn has_lanes(&self) -> bool {
        self.has_lanes
    }

    /// Whether so many numbers are computed for a node, and it is the first of them.
    pub(super) fn is_first_of(&self, node: NodeId, lanes: usize) -> bool {
        self.lanes(node) == lanes && self.place(node).is_none_or(|place| place.lane == 0)
    }

    /// How many numbers are computed for a node.
    pub(super) fn lanes(&self, node: NodeId) -> usize {
        match self.place(node) {
            Some(place) => self.rows[place.node].len(),
            None => 1,
        }
    }

    /// What stands in the place of a node of a first branch in all branches.
    pub(super) fn row(&self, node: NodeId) -> Option<&[Expr<'g>]> {
        self.rows.get(node).map(Vec::as_slice)
    }
}

/// From what is of each branch to what is of the one that is so many after it, in a circle; what is the trunk's stays.
fn renaming<'g>(
    graph: &'g Graph,
    branches: &Branches<'g>,
    set: &[Vec<(SymbolId, bool)>],
    steps: usize,
) -> Substitution<'g, impl Fn(NodeId) -> Option<Expr<'g>>> {
    let pair = |(&(from, minus), &(to, also_minus)): (&(SymbolId, bool), &(SymbolId, bool))| {
        let symbol = graph.variable(to);
        (from, if minus == also_minus { symbol } else { -symbol })
    };
    let others = set.iter().cycle().skip(steps);
    let names: FxHashMap<_, _> =
        set.iter().zip(others).flat_map(|(one, other)| one.iter().zip(other).map(pair)).collect();
    Substitution::new(graph, move |id| match graph.op(id) {
        Op::Symbol(symbol) => names.get(&symbol).copied(),
        _ => (branches.owner(graph, id) == Owner::Trunk).then(|| Expr::of_node(graph, id)),
    })
}

/// The nodes that results need, operands first.
fn needed(
    graph: &Graph,
    results: &[Expr<'_>],
    is_at_hand: impl Fn(NodeId) -> bool,
) -> (Vec<NodeId>, NodeMap<()>) {
    let mut known = NodeMap::new(graph);
    let mut found = Vec::new();
    let mut stack = nodes_of(results);
    while let Some(id) = stack.pop() {
        if known.contains(id) {
            continue;
        }
        known.insert(id, ());
        found.push(id);
        if !is_at_hand(id) {
            stack.extend(graph.op(id).operands());
        }
    }
    found.sort_unstable_by_key(|id| id.index());
    (found, known)
}
