//! The reference interpreter: the value of expressions at numbers.

use super::{Expr, Graph, NodeId, Op, Real, SymbolId};

/// Evaluates nodes of a graph at one assignment of its inputs, each node once.
pub struct Evaluator<'g, F, R = f64> {
    graph: &'g Graph,
    values: Vec<Option<R>>,
    input: F,
}

impl<'g, R: Real, F: Fn(SymbolId) -> R> Evaluator<'g, F, R> {
    /// An evaluator that asks `input` for the value of each symbol.
    pub fn new(graph: &'g Graph, input: F) -> Self {
        Self { graph, values: vec![None; graph.len()], input }
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

    /// Operands before operations, without recursion: graphs may be deep.
    fn node(&mut self, root: NodeId) -> R {
        let mut stack = vec![root];
        while let Some(&id) = stack.last() {
            let waiting = stack.len();
            let op = self.graph.op(id);
            if self.values[id.index()].is_none() {
                stack
                    .extend(op.operands().into_iter().flatten().filter(|x| self.values[x.index()].is_none()));
            }
            if stack.len() == waiting {
                let value = self.apply(op);
                self.values[id.index()].get_or_insert(value);
                stack.pop();
            }
        }
        self.known(root)
    }

    fn known(&self, id: NodeId) -> R {
        self.values[id.index()].expect("operands are evaluated before operations")
    }

    fn apply(&self, op: Op) -> R {
        match op {
            Op::Constant(k) => R::of(self.graph.number(k)),
            Op::Symbol(symbol) => (self.input)(symbol),
            Op::Add(a, b) => self.known(a) + self.known(b),
            Op::Sub(a, b) => self.known(a) - self.known(b),
            Op::Mul(a, b) => self.known(a) * self.known(b),
            Op::Scale(k, a) => R::of(self.graph.number(k)) * self.known(a),
            Op::Div(a, b) => self.known(a) / self.known(b),
            Op::Sqrt(a) => self.known(a).sqrt(),
            Op::Sin(a) => self.known(a).sin(),
            Op::Cos(a) => self.known(a).cos(),
        }
    }
}
