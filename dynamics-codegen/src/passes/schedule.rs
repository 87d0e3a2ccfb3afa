//! From expressions to a program: which products are fused into sums, and in which order everything runs.

use rustc_hash::{FxHashMap, FxHashSet};

use super::program::{Operand, Operation, Program, Source, Step};
use super::signs;
use crate::mechanics::equations::Inputs;
use crate::symbolic::{Expr, Graph, NodeId, Number, Op};

/// The program that computes `results`; `at_hand` says which nodes need no step, and what they are read as.
pub fn schedule<'g>(
    graph: &'g Graph,
    inputs: Inputs,
    results: &[Expr<'g>],
    at_hand: impl Fn(NodeId) -> Option<Operand>,
) -> Program {
    let live = Live::of(graph, results, &at_hand);
    let mut builder = Builder {
        graph,
        inputs,
        live: &live,
        at_hand,
        made: FxHashMap::default(),
        sines: FxHashMap::default(),
        steps: Vec::new(),
    };
    for &id in &live.order {
        builder.node(id);
    }
    let results = results.iter().map(|&result| builder.result(result)).collect();
    let mut program = Program { steps: builder.steps, results };
    program.count_uses();
    signs::settle(&mut program);
    program
}

/// The nodes that the results need, in order, and how often each is read.
struct Live {
    order: Vec<NodeId>,
    uses: FxHashMap<NodeId, usize>,
    /// The length of the longest chain of operations up to a node.
    depth: FxHashMap<NodeId, usize>,
    read_by_sum: FxHashSet<NodeId>,
}

impl Live {
    fn of(graph: &Graph, results: &[Expr<'_>], at_hand: &impl Fn(NodeId) -> Option<Operand>) -> Self {
        let mut uses: FxHashMap<NodeId, usize> = FxHashMap::default();
        let mut order = Vec::new();
        let mut stack = Vec::new();
        for result in results {
            let Expr::Node { id, .. } = *result else { continue };
            stack.push(id);
        }
        while let Some(id) = stack.pop() {
            let uses = uses.entry(id).or_insert(0);
            *uses += 1;
            if *uses == 1 {
                order.push(id);
                if at_hand(id).is_none() {
                    stack.extend(graph.op(id).operands().into_iter().flatten());
                }
            }
        }
        order.sort_unstable();
        let mut depth: FxHashMap<NodeId, usize> = FxHashMap::default();
        let mut read_by_sum = FxHashSet::default();
        for &id in &order {
            if let Op::Add(a, b) | Op::Sub(a, b) = graph.op(id) {
                read_by_sum.extend([a, b]);
            }
            let below = graph.op(id).operands().into_iter().flatten().filter_map(|x| depth.get(&x)).max();
            depth.insert(id, below.map_or(0, |below| below + 1));
        }
        Self { order, uses, depth, read_by_sum }
    }
}

struct Builder<'g, 'l, F> {
    graph: &'g Graph,
    inputs: Inputs,
    live: &'l Live,
    at_hand: F,
    made: FxHashMap<NodeId, Operand>,
    /// The step that turns an angle into its sine and cosine.
    sines: FxHashMap<NodeId, usize>,
    steps: Vec<Step>,
}

impl<F: Fn(NodeId) -> Option<Operand>> Builder<'_, '_, F> {
    fn node(&mut self, id: NodeId) {
        if let Some(operand) = (self.at_hand)(id) {
            self.made.insert(id, operand);
            return;
        }
        let source = match self.graph.op(id) {
            Op::Constant(k) => Source::Constant(self.graph.number(k)),
            Op::Symbol(symbol) => Source::Input(self.inputs.meaning(symbol)),
            Op::Add(a, b) => match self.fused(a, b) {
                Some((product, other)) => self.multiply_add(product, false, other, false),
                None => self.push(Operation::Add(self.operand(a), self.operand(b))),
            },
            Op::Sub(a, b) => match self.fused(a, b) {
                Some((product, other)) => self.multiply_add(product, product == b, other, other == b),
                None => self.push(Operation::Add(self.operand(a), negated(self.operand(b)))),
            },
            Op::Mul(..) | Op::Scale(..) if self.waits_for_its_sum(id) => return,
            Op::Mul(a, b) => self.push(Operation::Mul(self.operand(a), self.operand(b))),
            Op::Scale(k, a) => {
                let (value, a) = (self.graph.number(k), self.operand(a));
                if value == Number::integer(2) {
                    self.push(Operation::Add(a, a))
                } else {
                    self.push(Operation::Mul(constant(value), a))
                }
            }
            Op::Div(a, b) => self.push(Operation::Div(self.operand(a), self.operand(b))),
            Op::Sqrt(a) => self.push(Operation::Sqrt(self.operand(a))),
            Op::Sin(a) => Source::Sin(self.sin_cos(a)),
            Op::Cos(a) => Source::Cos(self.sin_cos(a)),
        };
        self.made.insert(id, Operand { source, negative: false });
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
        *self.made.get(&id).expect("a node is made before it is read")
    }

    fn result(&self, result: Expr<'_>) -> Operand {
        match result {
            Expr::Constant(value) => {
                Operand { source: Source::Constant(value.abs()), negative: value.is_negative() }
            }
            Expr::Node { id, negative, .. } => {
                let value = self.operand(id);
                Operand { negative: negative != value.negative, ..value }
            }
        }
    }

    /// Whether a product is read once, by a sum: then the sum decides what becomes of it.
    fn waits_for_its_sum(&self, id: NodeId) -> bool {
        self.can_fuse(id) && self.live.read_by_sum.contains(&id)
    }

    fn can_fuse(&self, id: NodeId) -> bool {
        let product = matches!(self.graph.op(id), Op::Mul(..) | Op::Scale(..));
        product && self.live.uses[&id] == 1 && (self.at_hand)(id).is_none()
    }

    /// Which operand of a sum is multiplied within it, and the other one. Of two candidates the one that is
    /// ready later.
    fn fused(&mut self, a: NodeId, b: NodeId) -> Option<(NodeId, NodeId)> {
        let chosen = match (self.can_fuse(a), self.can_fuse(b)) {
            (false, false) => return None,
            (true, false) => (a, b),
            (false, true) => (b, a),
            (true, true) if self.live.depth[&a] >= self.live.depth[&b] => (a, b),
            (true, true) => (b, a),
        };
        if self.can_fuse(chosen.1) && !self.made.contains_key(&chosen.1) {
            let source = self.product(chosen.1);
            self.made.insert(chosen.1, Operand { source, negative: false });
        }
        Some(chosen)
    }

    fn factors(&self, id: NodeId) -> (Operand, Operand) {
        match self.graph.op(id) {
            Op::Mul(a, b) => (self.operand(a), self.operand(b)),
            Op::Scale(k, a) => (constant(self.graph.number(k)), self.operand(a)),
            op => unreachable!("{op:?} is no product"),
        }
    }

    fn product(&mut self, id: NodeId) -> Source {
        let (a, b) = self.factors(id);
        if a == constant(Number::integer(2)) {
            self.push(Operation::Add(b, b))
        } else {
            self.push(Operation::Mul(a, b))
        }
    }

    fn multiply_add(
        &mut self,
        product: NodeId,
        minus_product: bool,
        other: NodeId,
        minus_other: bool,
    ) -> Source {
        let (a, b) = self.factors(product);
        let a = if minus_product { negated(a) } else { a };
        let other = if minus_other { negated(self.operand(other)) } else { self.operand(other) };
        self.push(Operation::MulAdd(a, b, other))
    }
}

fn constant(value: Number) -> Operand {
    Operand { source: Source::Constant(value), negative: false }
}

fn negated(operand: Operand) -> Operand {
    Operand { negative: !operand.negative, ..operand }
}
