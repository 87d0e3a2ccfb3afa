//! A program: the straight line of operations that one method runs.
//!
//! Steps are in static single assignment and read only what stands before them. The same program is
//! interpreted, counted, and written as text.

use rustc_hash::{FxHashMap, FxHashSet};

use super::signs;
use crate::mechanics::equations::{Input, Inputs};
use crate::symbolic::{Expr, Graph, NodeId, Number, Op};

/// Where a value comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// A constant, positive unless it is a result.
    Constant(Number),
    /// A parameter, or a component of an argument.
    Input(Input),
    /// A field of the prepared companion.
    Field(usize),
    /// The result of a step.
    Step(usize),
    /// The sine that a step [`Operation::SinCos`] computes.
    Sin(usize),
    /// The cosine that a step [`Operation::SinCos`] computes.
    Cos(usize),
}

/// A value or its negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Operand {
    /// The value.
    pub source: Source,
    /// Whether it is negated.
    pub negative: bool,
}

/// What a step does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operation {
    /// `a + b`
    Add(Operand, Operand),
    /// `a·b`
    Mul(Operand, Operand),
    /// `a·b + c`, rounded once where the target can.
    MulAdd(Operand, Operand, Operand),
    /// `a / b`
    Div(Operand, Operand),
    /// `√a`
    Sqrt(Operand),
    /// `sin a` and `cos a`
    SinCos(Operand),
}

impl Operation {
    /// The operands, in order.
    pub fn operands(&self) -> impl Iterator<Item = Operand> {
        let operands = match *self {
            Operation::Add(a, b) | Operation::Mul(a, b) | Operation::Div(a, b) => [Some(a), Some(b), None],
            Operation::MulAdd(a, b, c) => [Some(a), Some(b), Some(c)],
            Operation::Sqrt(a) | Operation::SinCos(a) => [Some(a), None, None],
        };
        operands.into_iter().flatten()
    }
}

/// One operation of a program.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// What it does.
    pub operation: Operation,
    /// How often later steps and the results read it.
    pub uses: usize,
}

/// How many operations a program has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Multiplications; a fused multiply-add is one and an addition.
    pub multiplications: u32,
    /// Additions and subtractions.
    pub additions: u32,
    /// Divisions.
    pub divisions: u32,
    /// Square roots.
    pub square_roots: u32,
    /// Pairs of sine and cosine.
    pub sines_and_cosines: u32,
}

impl std::ops::Add for Cost {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        Self {
            multiplications: self.multiplications + rhs.multiplications,
            additions: self.additions + rhs.additions,
            divisions: self.divisions + rhs.divisions,
            square_roots: self.square_roots + rhs.square_roots,
            sines_and_cosines: self.sines_and_cosines + rhs.sines_and_cosines,
        }
    }
}

/// A straight line of steps and its results.
#[derive(Clone, Debug)]
pub struct Program {
    /// The operations.
    pub steps: Vec<Step>,
    /// The results.
    pub results: Vec<Operand>,
}

impl Program {
    /// The program that computes `results`; `field` says which nodes are at hand already, and as what.
    pub fn of<'g>(
        graph: &'g Graph,
        inputs: Inputs,
        results: &[Expr<'g>],
        field: impl Fn(NodeId) -> Option<Operand>,
    ) -> Self {
        let live = Live::of(graph, results, &field);
        let mut builder = Builder {
            graph,
            inputs,
            live: &live,
            field,
            made: FxHashMap::default(),
            sines: FxHashMap::default(),
            steps: Vec::new(),
        };
        for &id in &live.order {
            builder.node(id);
        }
        let results = results.iter().map(|&result| builder.result(result)).collect();
        let mut program = Self { steps: builder.steps, results };
        program.count_uses();
        signs::settle(&mut program);
        program
    }

    /// The number of operations; a product with two is an addition.
    pub fn cost(&self) -> Cost {
        let mut cost = Cost::default();
        for step in &self.steps {
            match step.operation {
                Operation::Add(..) => cost.additions += 1,
                Operation::Mul(..) => cost.multiplications += 1,
                Operation::MulAdd(a, ..) if a.source == Source::Constant(Number::integer(2)) => {
                    cost.additions += 2
                }
                Operation::MulAdd(..) => {
                    cost.multiplications += 1;
                    cost.additions += 1;
                }
                Operation::Div(..) => cost.divisions += 1,
                Operation::Sqrt(..) => cost.square_roots += 1,
                Operation::SinCos(..) => cost.sines_and_cosines += 1,
            }
        }
        cost
    }

    /// The results for given inputs and fields.
    pub fn evaluate(&self, input: impl Fn(Input) -> f64, fields: &[f64]) -> Vec<f64> {
        let mut values: Vec<(f64, f64)> = Vec::with_capacity(self.steps.len());
        let read = |values: &[(f64, f64)], operand: Operand| {
            let value = match operand.source {
                Source::Constant(value) => value.to_f64(),
                Source::Input(symbol) => input(symbol),
                Source::Field(k) => fields[k],
                Source::Step(k) | Source::Sin(k) => values[k].0,
                Source::Cos(k) => values[k].1,
            };
            if operand.negative { -value } else { value }
        };
        for step in &self.steps {
            let of = |operand| read(&values, operand);
            let value = match step.operation {
                Operation::Add(a, b) => (of(a) + of(b), 0.0),
                Operation::Mul(a, b) => (of(a) * of(b), 0.0),
                Operation::MulAdd(a, b, c) => (of(a) * of(b) + of(c), 0.0),
                Operation::Div(a, b) => (of(a) / of(b), 0.0),
                Operation::Sqrt(a) => (of(a).sqrt(), 0.0),
                Operation::SinCos(a) => of(a).sin_cos(),
            };
            values.push(value);
        }
        self.results.iter().map(|&operand| read(&values, operand)).collect()
    }

    /// A constant that no double can hold, if there is one.
    pub fn constant_out_of_range(&self) -> Option<Number> {
        let operands = self.steps.iter().flat_map(|step| step.operation.operands());
        operands.chain(self.results.iter().copied()).find_map(|operand| match operand.source {
            Source::Constant(value) if !value.to_f64().is_finite() => Some(value),
            _ => None,
        })
    }

    fn count_uses(&mut self) {
        let mut uses = vec![0; self.steps.len()];
        let operands = self.steps.iter().flat_map(|step| step.operation.operands());
        for operand in operands.chain(self.results.iter().copied()) {
            if let Source::Step(k) | Source::Sin(k) | Source::Cos(k) = operand.source {
                uses[k] += 1;
            }
        }
        for (step, uses) in self.steps.iter_mut().zip(uses) {
            step.uses = uses;
        }
    }
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
    fn of(graph: &Graph, results: &[Expr<'_>], field: &impl Fn(NodeId) -> Option<Operand>) -> Self {
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
                if field(id).is_none() {
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
    field: F,
    made: FxHashMap<NodeId, Operand>,
    /// The step that turns an angle into its sine and cosine.
    sines: FxHashMap<NodeId, usize>,
    steps: Vec<Step>,
}

impl<F: Fn(NodeId) -> Option<Operand>> Builder<'_, '_, F> {
    fn node(&mut self, id: NodeId) {
        if let Some(at_hand) = (self.field)(id) {
            self.made.insert(id, at_hand);
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
        product && self.live.uses[&id] == 1 && (self.field)(id).is_none()
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
