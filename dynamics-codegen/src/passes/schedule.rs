//! From expressions to a program: which products are fused into sums, and in which order everything runs.

use rustc_hash::FxHashMap;

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
    let (order, nodes) = live(graph, results, at_hand);
    let mut builder = Builder { graph, inputs, nodes, sines: FxHashMap::default(), steps: Vec::new() };
    for id in order {
        builder.node(id);
    }
    let results = results.iter().map(|&result| builder.result(result)).collect();
    let mut program = Program { steps: builder.steps, results };
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
        count += usize::from(!matches!(op, Op::Constant(_) | Op::Symbol(_) | Op::Sin(_) | Op::Cos(_)));
        for operand in op.operands() {
            stack.push(operand);
        }
    }
    count
}

fn nodes_of(results: &[Expr<'_>]) -> Vec<NodeId> {
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
    results: &[Expr<'_>],
    at_hand: impl Fn(NodeId) -> Option<Operand>,
) -> (Vec<NodeId>, NodeMap<Live>) {
    let mut nodes: NodeMap<Live> = NodeMap::new(graph);
    let mut order = Vec::new();
    let mut stack = nodes_of(results);
    while let Some(id) = stack.pop() {
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
    order.sort_unstable_by_key(|id| id.index());
    let order = super::order::order(graph, &order, &nodes_of(results), |id| nodes[id].made.is_some());
    for &id in &order {
        let op = nodes[id].op;
        let is_sum = matches!(op, Op::Add(..) | Op::Sub(..));
        let mut depth = 0;
        for operand in op.operands() {
            // What is at hand has operands that nobody needs.
            if let Some(operand) = nodes.get_mut(operand) {
                operand.read_by_sum |= is_sum;
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

struct Builder<'g> {
    graph: &'g Graph,
    inputs: Inputs,
    nodes: NodeMap<Live>,
    /// The step that turns an angle into its sine and cosine.
    sines: FxHashMap<NodeId, usize>,
    steps: Vec<Step>,
}

impl Builder<'_> {
    fn node(&mut self, id: NodeId) {
        let Live { op, read_by_sum, can_fuse, made, .. } = self.nodes[id];
        if made.is_some() || (can_fuse && read_by_sum) {
            // It is at hand, or the sum that reads it decides what becomes of it.
            return;
        }
        let source = match op {
            Op::Constant(k) => Source::Constant(self.graph.number(k).to_f64()),
            Op::Symbol(symbol) => Source::Input(self.inputs.meaning(symbol)),
            Op::Add(a, b) => match self.fused(a, b) {
                Some((product, other)) => self.multiply_add(product, false, other, false),
                None => self.push(Operation::Add(self.operand(a), self.operand(b))),
            },
            Op::Sub(a, b) => match self.fused(a, b) {
                Some((product, other)) => self.multiply_add(product, product == b, other, other == b),
                None => self.push(Operation::Add(self.operand(a), negated(self.operand(b)))),
            },
            Op::Mul(..) | Op::Scale(..) => self.product(op),
            Op::Div(a, b) => self.push(Operation::Div(self.operand(a), self.operand(b))),
            Op::Sqrt(a) => self.push(Operation::Sqrt(self.operand(a))),
            Op::Sin(a) => Source::Sin(self.sin_cos(a)),
            Op::Cos(a) => Source::Cos(self.sin_cos(a)),
        };
        self.make(id, source);
    }

    fn make(&mut self, id: NodeId, source: Source) {
        if let Some(node) = self.nodes.get_mut(id) {
            node.made = Some(Operand { source, negative: false });
        }
    }

    fn push(&mut self, operation: Operation) -> Source {
        self.steps.push(Step { operation, uses: 0 });
        Source::Step(self.steps.len() - 1)
    }

    /// The step that computes sine and cosine of a node; one for both.
    fn sin_cos(&mut self, angle: NodeId) -> usize {
        if let Some(&step) = self.sines.get(&angle) {
            return step;
        }
        self.push(Operation::SinCos(self.operand(angle)));
        let step = self.steps.len() - 1;
        self.sines.insert(angle, step);
        step
    }

    fn operand(&self, id: NodeId) -> Operand {
        self.nodes[id].made.expect("a node is made before it is read")
    }

    fn result(&self, result: Expr<'_>) -> Operand {
        match result {
            Expr::Constant(value) => Operand::constant(value),
            Expr::Node { id, negative, .. } => {
                let value = self.operand(id);
                Operand { negative: negative != value.negative, ..value }
            }
        }
    }

    /// Which operand of a sum is multiplied within it, and the other one. Of two candidates the one that is
    /// ready later.
    fn fused(&mut self, a: NodeId, b: NodeId) -> Option<(NodeId, NodeId)> {
        let (first, second) = (&self.nodes[a], &self.nodes[b]);
        let (product, other) = match (first.can_fuse, second.can_fuse) {
            (false, false) => return None,
            (true, false) => (a, b),
            (false, true) => (b, a),
            (true, true) if first.depth >= second.depth => (a, b),
            (true, true) => (b, a),
        };
        let Live { op, can_fuse, made, .. } = self.nodes[other];
        if can_fuse && made.is_none() {
            let source = self.product(op);
            self.make(other, source);
        }
        Some((product, other))
    }

    fn factors(&self, op: Op) -> (Operand, Operand) {
        match op {
            Op::Mul(a, b) => (self.operand(a), self.operand(b)),
            Op::Scale(k, a) => (Operand::constant(self.graph.number(k)), self.operand(a)),
            op => unreachable!("{op:?} is no product"),
        }
    }

    fn product(&mut self, op: Op) -> Source {
        let (a, b) = self.factors(op);
        match a.source {
            Source::Constant(2.0) if !a.negative => self.push(Operation::Add(b, b)),
            _ => self.push(Operation::Mul(a, b)),
        }
    }

    fn multiply_add(
        &mut self,
        product: NodeId,
        minus_product: bool,
        other: NodeId,
        minus_other: bool,
    ) -> Source {
        let (a, b) = self.factors(self.nodes[product].op);
        let a = if minus_product { negated(a) } else { a };
        let other = if minus_other { negated(self.operand(other)) } else { self.operand(other) };
        self.push(Operation::MulAdd(a, b, other))
    }
}

fn negated(operand: Operand) -> Operand {
    Operand { negative: !operand.negative, ..operand }
}
