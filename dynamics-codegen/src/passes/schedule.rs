//! From expressions to a program: which products are fused into sums, and in which order everything runs.

use rustc_hash::FxHashMap;

use super::lanes::{Layout, Place};
use super::order::both;
use super::program::{Operand, Operation, Program, Source, Step};
use super::signs;
use crate::mechanics::equations::Inputs;
use crate::symbolic::{Expr, Graph, NodeId, NodeMap, Op};

/// The program that computes `results`; `at_hand` says which nodes need no step, and what they are read as.
pub fn schedule<'g>(
    graph: &'g Graph,
    inputs: Inputs,
    results: &[Expr<'g>],
    at_hand: impl Fn(NodeId) -> Option<Operand>,
) -> Program {
    schedule_in(&Layout::one_by_one(graph), graph, inputs, results, at_hand)
}

/// The same with some of it side by side.
pub(super) fn schedule_in<'g>(
    layout: &Layout<'g>,
    graph: &'g Graph,
    inputs: Inputs,
    results: &[Expr<'g>],
    at_hand: impl Fn(NodeId) -> Option<Operand>,
) -> Program {
    let (order, nodes) = live(graph, layout, results, &at_hand);
    let mut builder = Builder {
        graph,
        inputs,
        layout,
        at_hand: &at_hand,
        nodes,
        sines: FxHashMap::default(),
        laid: FxHashMap::default(),
        taken: FxHashMap::default(),
        turned: FxHashMap::default(),
        steps: Vec::new(),
        rows: Vec::new(),
    };
    for id in order {
        builder.node(id);
    }
    let results = results.iter().map(|&result| builder.result(result)).collect();
    let mut program = Program { steps: builder.steps, results, rows: builder.rows };
    program.count_uses();
    signs::settle(&mut program);
    program
}

/// How many additions, multiplications, divisions and roots the program of `results` would have, where `is_free` says
/// which nodes need no step: each operation is one, and fused ones are two.
pub(super) fn arithmetic(graph: &Graph, results: &[Expr<'_>], is_free: impl Fn(NodeId) -> bool) -> usize {
    let mut seen = NodeMap::new(graph);
    let mut stack = nodes_of(results);
    let mut count = 0;
    while let Some(id) = stack.pop() {
        if seen.contains(id) {
            continue;
        }
        seen.insert(id, ());
        if is_free(id) {
            continue;
        }
        let op = graph.op(id);
        let is_free = matches!(op, Op::Constant(_) | Op::Symbol(_) | Op::Sin(_) | Op::Cos(_) | Op::Opaque(_));
        count += usize::from(!is_free);
        for operand in op.operands() {
            stack.push(operand);
        }
    }
    count
}

pub(super) fn nodes_of(results: &[Expr<'_>]) -> Vec<NodeId> {
    let node = |result: &Expr<'_>| match *result {
        Expr::Node { id, .. } => Some(id),
        Expr::Constant(_) => None,
    };
    results.iter().filter_map(node).collect()
}

/// A node that the results need.
struct Live {
    op: Op,
    /// How often it is read.
    uses: usize,
    /// The length of the longest chain of operations up to it.
    depth: usize,
    read_by_sum: bool,
    /// Whether a sum that reads it may do the multiplication: it is a product that is read once.
    can_fuse: bool,
    /// What it is read as, once that is known.
    made: Option<Operand>,
}

/// The nodes that the results need, in order.
fn live(
    graph: &Graph,
    layout: &Layout<'_>,
    results: &[Expr<'_>],
    at_hand: impl Fn(NodeId) -> Option<Operand>,
) -> (Vec<NodeId>, NodeMap<Live>) {
    let mut nodes: NodeMap<Live> = NodeMap::new(graph);
    let mut order = Vec::new();
    let mut stack = nodes_of(results);
    while let Some(id) = stack.pop() {
        let id = layout.representative(id);
        if let Some(node) = nodes.get_mut(id) {
            node.uses += 1;
            continue;
        }
        let (op, made) = (graph.op(id), at_hand(id));
        if made.is_none() {
            for operand in op.operands() {
                stack.push(operand);
            }
        }
        nodes.insert(id, Live { op, uses: 1, depth: 0, read_by_sum: false, can_fuse: false, made });
        order.push(id);
    }
    let is_at_hand = |id: NodeId| nodes[id].made.is_some();
    let operands = |id| match is_at_hand(id) {
        true => [None; 2],
        false => both(graph.op(id).operands().map(|operand| layout.representative(operand))),
    };
    let results: Vec<NodeId> = nodes_of(results).into_iter().map(|id| layout.representative(id)).collect();
    order.sort_unstable_by_key(|id| id.index());
    if layout.has_lanes() {
        order = in_order(graph, &results, operands);
    }
    let order = super::order::order(graph, &order, &results, operands);
    for &id in &order {
        let op = nodes[id].op;
        let is_sum = matches!(op, Op::Add(..) | Op::Sub(..));
        let mut depth = 0;
        for operand in op.operands() {
            let is_alike = layout.is_first_of(operand, layout.lanes(id));
            let operand = layout.representative(operand);
            // What is at hand has operands that nobody needs.
            if let Some(operand) = nodes.get_mut(operand) {
                operand.read_by_sum |= is_sum && is_alike;
                depth = depth.max(operand.depth + 1);
            }
        }
        if let Some(node) = nodes.get_mut(id) {
            node.depth = depth;
            node.can_fuse =
                matches!(op, Op::Mul(..) | Op::Scale(..)) && node.uses == 1 && node.made.is_none();
        }
    }
    (order, nodes)
}

/// The nodes that results need, each after its operands.
fn in_order(
    graph: &Graph,
    results: &[NodeId],
    operands: impl Fn(NodeId) -> [Option<NodeId>; 2],
) -> Vec<NodeId> {
    let mut done: NodeMap<()> = NodeMap::new(graph);
    let mut order = Vec::new();
    let mut stack: Vec<(NodeId, bool)> = results.iter().rev().map(|&id| (id, false)).collect();
    while let Some((id, is_ready)) = stack.pop() {
        if done.contains(id) {
            continue;
        }
        if is_ready {
            done.insert(id, ());
            order.push(id);
            continue;
        }
        stack.push((id, true));
        stack.extend(operands(id).into_iter().flatten().map(|operand| (operand, false)));
    }
    order
}

struct Builder<'a, 'g> {
    graph: &'g Graph,
    inputs: Inputs,
    layout: &'a Layout<'g>,
    at_hand: &'a dyn Fn(NodeId) -> Option<Operand>,
    nodes: NodeMap<Live>,
    /// The steps that lay inputs of branches side by side, by the node; those that take one number out of several, and those
    /// that begin with another one, by its place.
    laid: FxHashMap<NodeId, usize>,
    taken: FxHashMap<(NodeId, usize), usize>,
    turned: FxHashMap<(NodeId, usize), usize>,
    rows: Vec<Vec<Operand>>,
    /// The step that turns an angle into its sine and cosine.
    sines: FxHashMap<NodeId, usize>,
    steps: Vec<Step>,
}

impl<'g> Builder<'_, 'g> {
    fn node(&mut self, id: NodeId) {
        let Live { op, read_by_sum, can_fuse, made, .. } = self.nodes[id];
        if made.is_some() || (can_fuse && read_by_sum) {
            // It is at hand, or the sum that reads it decides what becomes of it.
            return;
        }
        let lanes = self.layout.lanes(id);
        let source = match op {
            Op::Constant(k) => Source::Constant(self.graph.number(k).to_f64()),
            Op::Symbol(symbol) => Source::Input(self.inputs.meaning(symbol)),
            Op::Add(a, b) => match self.fused(a, b, lanes) {
                Some((product, other)) => self.multiply_add(product, false, other, false, lanes),
                None => {
                    let (a, b) = (self.operand(a, lanes), self.operand(b, lanes));
                    self.push(Operation::Add(a, b), lanes)
                }
            },
            Op::Sub(a, b) => match self.fused(a, b, lanes) {
                Some((product, other)) => self.multiply_add(product, product == b, other, other == b, lanes),
                None => {
                    let (a, b) = (self.operand(a, lanes), negated(self.operand(b, lanes)));
                    self.push(Operation::Add(a, b), lanes)
                }
            },
            Op::Mul(..) | Op::Scale(..) => self.product(op, lanes),
            Op::Div(a, b) => {
                let (a, b) = (self.operand(a, lanes), self.operand(b, lanes));
                self.push(Operation::Div(a, b), lanes)
            }
            Op::Sqrt(a) => {
                let a = self.operand(a, lanes);
                self.push(Operation::Sqrt(a), lanes)
            }
            Op::Opaque(a) => {
                let made = Some(self.operand(a, lanes));
                if let Some(node) = self.nodes.get_mut(id) {
                    node.made = made;
                }
                return;
            }
            Op::Sin(a) => Source::Sin(self.sin_cos(a, lanes)),
            Op::Cos(a) => Source::Cos(self.sin_cos(a, lanes)),
        };
        self.make(id, source);
    }

    fn make(&mut self, id: NodeId, source: Source) {
        if let Some(node) = self.nodes.get_mut(id) {
            node.made = Some(Operand { source, negative: false });
        }
    }

    fn push(&mut self, operation: Operation, lanes: usize) -> Source {
        self.steps.push(Step { operation, uses: 0, lanes });
        Source::Step(self.steps.len() - 1)
    }

    /// The step that computes sine and cosine of a node; one for both.
    fn sin_cos(&mut self, angle: NodeId, lanes: usize) -> usize {
        if let Some(&step) = self.sines.get(&angle) {
            return step;
        }
        let operand = self.operand(angle, lanes);
        self.push(Operation::SinCos(operand), lanes);
        let step = self.steps.len() - 1;
        self.sines.insert(angle, step);
        step
    }

    /// A node as a step that computes so many numbers reads it.
    fn operand(&mut self, id: NodeId, lanes: usize) -> Operand {
        let place = self.layout.place(id);
        let made = self.nodes.get(self.layout.representative(id)).and_then(|node| node.made);
        match place {
            None if lanes > 1 && self.layout.row(id).is_some() => self.row(id, lanes),
            None => made.expect("a node is made before it is read"),
            Some(Place { lane: 0, .. }) if lanes > 1 => made.expect("a node is made before it is read"),
            Some(place) => self.moved(place, made.expect("a node is made before it is read"), lanes),
        }
    }

    /// A node that is computed beside others: alone, or with those that come after it.
    fn moved(&mut self, Place { node, lane, negative }: Place, made: Operand, lanes: usize) -> Operand {
        let known = if lanes > 1 { &self.turned } else { &self.taken };
        let step = known.get(&(node, lane)).copied().unwrap_or_else(|| {
            let numbers = Operand { negative: false, ..made };
            let (known, operation) = match lanes {
                1 => (&mut self.taken, Operation::Lane(numbers, lane)),
                _ => (&mut self.turned, Operation::Turn(numbers, lane)),
            };
            known.insert((node, lane), self.steps.len());
            self.push(operation, lanes);
            self.steps.len() - 1
        });
        Operand { source: Source::Step(step), negative: negative != made.negative }
    }

    /// What stands in the place of a node in all branches, side by side.
    fn row(&mut self, id: NodeId, lanes: usize) -> Operand {
        let step = match self.laid.get(&id) {
            Some(&step) => step,
            None => {
                let row = self.layout.row(id).unwrap_or_default();
                let operands = row.iter().map(|&expr| self.of_leaf(expr)).collect();
                self.rows.push(operands);
                self.push(Operation::Each(self.rows.len() - 1), lanes);
                self.laid.insert(id, self.steps.len() - 1);
                self.steps.len() - 1
            }
        };
        Operand { source: Source::Step(step), negative: false }
    }

    /// An input, or what is at hand.
    fn of_leaf(&self, expr: Expr<'g>) -> Operand {
        let Expr::Node { id, negative, .. } = expr else { unreachable!("a branch has nodes") };
        let operand = match ((self.at_hand)(id), self.graph.op(id)) {
            (Some(operand), _) => operand,
            (None, Op::Symbol(symbol)) => {
                Operand { source: Source::Input(self.inputs.meaning(symbol)), negative: false }
            }
            (None, op) => unreachable!("{op:?} is no leaf"),
        };
        Operand { negative: negative != operand.negative, ..operand }
    }

    fn result(&mut self, result: Expr<'_>) -> Operand {
        match result {
            Expr::Constant(value) => Operand::constant(value),
            Expr::Node { id, negative, .. } => {
                let value = self.operand(id, 1);
                Operand { negative: negative != value.negative, ..value }
            }
        }
    }

    /// Which operand of a sum is multiplied within it, and the other one. Of two candidates the one that is
    /// ready later.
    fn fused(&mut self, a: NodeId, b: NodeId, lanes: usize) -> Option<(NodeId, NodeId)> {
        let can_fuse = |id: NodeId| {
            let own = self.layout.representative(id);
            self.nodes.get(own).is_some_and(|node| node.can_fuse) && self.layout.is_first_of(id, lanes)
        };
        let depth = |id: NodeId| self.nodes[self.layout.representative(id)].depth;
        let (product, other) = match (can_fuse(a), can_fuse(b)) {
            (false, false) => return None,
            (true, false) => (a, b),
            (false, true) => (b, a),
            (true, true) if depth(a) >= depth(b) => (a, b),
            (true, true) => (b, a),
        };
        if can_fuse(other) && self.nodes[other].made.is_none() {
            let source = self.product(self.nodes[other].op, lanes);
            self.make(other, source);
        }
        Some((product, other))
    }

    fn factors(&mut self, op: Op, lanes: usize) -> (Operand, Operand) {
        match op {
            Op::Mul(a, b) => (self.operand(a, lanes), self.operand(b, lanes)),
            Op::Scale(k, a) => (Operand::constant(self.graph.number(k)), self.operand(a, lanes)),
            op => unreachable!("{op:?} is no product"),
        }
    }

    fn product(&mut self, op: Op, lanes: usize) -> Source {
        let (a, b) = self.factors(op, lanes);
        match a.source {
            Source::Constant(2.0) if !a.negative => self.push(Operation::Add(b, b), lanes),
            _ => self.push(Operation::Mul(a, b), lanes),
        }
    }

    fn multiply_add(
        &mut self,
        product: NodeId,
        minus_product: bool,
        other: NodeId,
        minus_other: bool,
        lanes: usize,
    ) -> Source {
        let (a, b) = self.factors(self.nodes[product].op, lanes);
        let a = if minus_product { negated(a) } else { a };
        let other =
            if minus_other { negated(self.operand(other, lanes)) } else { self.operand(other, lanes) };
        self.push(Operation::MulAdd(a, b, other), lanes)
    }
}

fn negated(operand: Operand) -> Operand {
    Operand { negative: !operand.negative, ..operand }
}
