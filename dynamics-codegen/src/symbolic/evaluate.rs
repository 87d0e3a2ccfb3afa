//! The reference interpreter: the value of expressions at numbers.

use super::{Expr, Graph, NodeId, NodeMap, Op, Real, SymbolId, Walk};

/// Evaluates nodes of a graph at one assignment of its inputs, each node once.
pub struct Evaluator<'g, F, R = f64> {
    graph: &'g Graph,
    values: NodeMap<R>,
    input: F,
}

impl<'g, R: Real, F: Fn(SymbolId) -> R> Evaluator<'g, F, R> {
    /// An evaluator that asks `input` for the value of each symbol.
    pub fn new(graph: &'g Graph, input: F) -> Self {
        Self { graph, values: NodeMap::new(graph), input }
    }

    /// The value of `expr`.
    pub fn value(&mut self, expr: Expr<'g>) -> R {
        match expr {
            Expr::Constant(value) => R::of(value),
            Expr::Node { id, negative, .. } => {
                let value = self.node(id);
                if negative { -value } else { value }
            }
        }
    }

    fn node(&mut self, root: NodeId) -> R {
        let mut walk = Walk::to(root);
        while let Some(id) = walk.next(self.graph, |x| self.values.contains(x)) {
            let value = self.apply(self.graph.op(id));
            self.values.insert(id, value);
        }
        self.values[root]
    }

    fn apply(&self, op: Op) -> R {
        match op {
            Op::Constant(k) => R::of(self.graph.number(k)),
            Op::Symbol(symbol) => (self.input)(symbol),
            Op::Add(a, b) => self.values[a] + self.values[b],
            Op::Sub(a, b) => self.values[a] - self.values[b],
            Op::Mul(a, b) => self.values[a] * self.values[b],
            Op::Scale(k, a) => R::of(self.graph.number(k)) * self.values[a],
            Op::Div(a, b) => self.values[a] / self.values[b],
            Op::Sqrt(a) => self.values[a].sqrt(),
            Op::Sin(a) => self.values[a].sin(),
            Op::Cos(a) => self.values[a].cos(),
            Op::Opaque(a) => self.values[a],
        }
    }
}
