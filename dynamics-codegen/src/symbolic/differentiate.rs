//! `∂/∂x` by the chain rule, forward, each node once.

use super::{Expr, Graph, NodeId, NodeMap, Number, Op, SymbolId, Walk};

/// The derivatives of expressions with respect to one input, remembered node by node.
pub struct Differentiator<'g> {
    graph: &'g Graph,
    symbol: SymbolId,
    known: NodeMap<Expr<'g>>,
}

impl<'g> Differentiator<'g> {
    /// Differentiates with respect to `symbol`.
    pub fn new(graph: &'g Graph, symbol: SymbolId) -> Self {
        Self { graph, symbol, known: NodeMap::new(graph) }
    }

    /// `∂expr/∂symbol`
    pub fn derivative(&mut self, expr: Expr<'g>) -> Expr<'g> {
        match expr {
            Expr::Constant(_) => Expr::ZERO,
            Expr::Node { id, negative, .. } => {
                let derivative = self.node(id);
                if negative { -derivative } else { derivative }
            }
        }
    }

    fn node(&mut self, root: NodeId) -> Expr<'g> {
        let mut walk = Walk::to(root);
        while let Some(id) = walk.next(self.graph, |x| self.known.contains(x)) {
            let derivative = self.rule(id, self.graph.op(id));
            self.known.insert(id, derivative);
        }
        self.known[root]
    }

    fn rule(&self, id: NodeId, op: Op) -> Expr<'g> {
        let d = |x: NodeId| self.known[x];
        let e = |x: NodeId| Expr::of_node(self.graph, x);
        match op {
            Op::Constant(_) => Expr::ZERO,
            Op::Symbol(symbol) if symbol == self.symbol => Expr::ONE,
            Op::Symbol(_) => Expr::ZERO,
            Op::Add(a, b) => d(a) + d(b),
            Op::Sub(a, b) => d(a) - d(b),
            Op::Mul(a, b) => d(a) * e(b) + e(a) * d(b),
            Op::Scale(k, a) => Expr::Constant(self.graph.number(k)) * d(a),
            Op::Div(a, b) => (d(a) - e(id) * d(b)) / e(b),
            Op::Sqrt(a) => d(a) / (Expr::Constant(Number::integer(2)) * e(id)),
            Op::Sin(a) => e(a).cos() * d(a),
            Op::Cos(a) => -(e(a).sin() * d(a)),
            Op::Opaque(a) => d(a),
        }
    }
}
