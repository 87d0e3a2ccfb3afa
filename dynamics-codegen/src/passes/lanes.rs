//! Which operations are done for all branches that are alike at once.
//!
//! What renames one branch into another takes expressions into expressions. Where that takes a node of the first branch
//! to a node that is needed as well, in each of the others, all of these are one operation on numbers side by side.
//! Equal expressions are one node, so nothing is searched for, and what is not there is computed alone.

use rustc_hash::FxHashMap;

use super::schedule::nodes_of;
use crate::mechanics::branches::Branches;
use crate::symbolic::{Expr, Graph, NodeId, NodeMap, Op, Substitution, SymbolId};

/// Where a node is computed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// The node of the first branch, for which it is computed.
    pub(super) node: NodeId,
    /// The number of the branch.
    pub(super) lane: usize,
    /// Whether it is minus what is computed there.
    pub(super) negative: bool,
}

/// What is computed side by side.
pub(super) struct Layout<'g> {
    places: NodeMap<Place>,
    has_lanes: bool,
    /// For each node of a first branch what stands in its place in all of them.
    rows: NodeMap<Vec<Expr<'g>>>,
}

/// Of which branch a node is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Owner {
    /// Of none.
    Trunk,
    /// Of one in a set.
    Branch(usize, usize),
    /// Of several.
    Several,
}

impl Owner {
    fn with(self, other: Self) -> Self {
        match (self, other) {
            (Owner::Trunk, owner) | (owner, Owner::Trunk) => owner,
            (one, other) if one == other => one,
            _ => Owner::Several,
        }
    }
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
        let owners = owners(graph, branches);
        for (number, set) in branches.sets.iter().enumerate() {
            let mut renamings: Vec<_> =
                set[1..].iter().map(|branch| renaming(graph, &set[0], branch)).collect();
            for &id in &needed {
                if owners[id.index()] != Owner::Branch(number, 0) {
                    continue;
                }
                let own = Expr::of_node(graph, id);
                let is_leaf = is_at_hand(id) || matches!(graph.op(id), Op::Symbol(_));
                let images: Vec<Expr<'g>> =
                    renamings.iter_mut().map(|renaming| renaming.apply(own)).collect();
                let is_there =
                    |image: &Expr<'g>| matches!(*image, Expr::Node { id, .. } if is_needed.contains(id));
                if !images.iter().all(is_there) {
                    continue;
                }
                let row: Vec<Expr<'g>> = std::iter::once(own).chain(images).collect();
                if !is_leaf {
                    layout.has_lanes = true;
                    for (lane, image) in row.iter().enumerate() {
                        if let Expr::Node { id: image, negative, .. } = *image {
                            layout.places.insert(image, Place { node: id, lane, negative });
                        }
                    }
                }
                layout.rows.insert(id, row);
            }
        }
        layout
    }

    /// How many operations there are, several side by side being one, and what is taken out of these being one as well.
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
            if is_alone && self.place(id).is_some() && !taken.contains(id) {
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
            count += usize::from(!matches!(op, Op::Sin(_) | Op::Cos(_)));
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

/// From what is of one branch to what is of another.
fn renaming<'g>(
    graph: &'g Graph,
    one: &[(SymbolId, bool)],
    other: &[(SymbolId, bool)],
) -> Substitution<'g, impl Fn(SymbolId) -> Option<Expr<'g>>> {
    let pair = |(&(from, minus), &(to, also_minus)): (&(SymbolId, bool), &(SymbolId, bool))| {
        let symbol = graph.variable(to);
        (from, if minus == also_minus { symbol } else { -symbol })
    };
    let names: FxHashMap<SymbolId, Expr<'g>> = one.iter().zip(other).map(pair).collect();
    Substitution::new(graph, move |symbol| names.get(&symbol).copied())
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

/// Of which branch each node is.
fn owners(graph: &Graph, branches: &Branches<'_>) -> Vec<Owner> {
    let mut of_symbols: Vec<Owner> = Vec::new();
    for (number, set) in branches.sets.iter().enumerate() {
        for (branch, symbols) in set.iter().enumerate() {
            for &(symbol, _) in symbols {
                let place = symbol.0 as usize;
                if of_symbols.len() <= place {
                    of_symbols.resize(place + 1, Owner::Trunk);
                }
                of_symbols[place] = Owner::Branch(number, branch);
            }
        }
    }
    let mut owners: Vec<Owner> = Vec::with_capacity(graph.len());
    for &op in graph.ops().iter() {
        let owner = match op {
            Op::Symbol(symbol) => of_symbols.get(symbol.0 as usize).copied().unwrap_or(Owner::Trunk),
            op => op.operands().fold(Owner::Trunk, |owner, operand| owner.with(owners[operand.index()])),
        };
        owners.push(owner);
    }
    owners
}
