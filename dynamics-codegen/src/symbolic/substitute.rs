//! Expressions with other things in the place of symbols.

use super::{Expr, Graph, NodeId, NodeMap, Op, SymbolId, Walk};

/// Puts expressions in the place of symbols, each node once.
pub struct Substitution<'g, F> {
    graph: &'g Graph,
    values: NodeMap<Expr<'g>>,
    value_of: F,
}

impl<'g, F: Fn(SymbolId) -> Option<Expr<'g>>> Substitution<'g, F> {
    /// A substitution that asks `value_of` for what stands in the place of a symbol; none leaves it.
    pub fn new(graph: &'g Graph, value_of: F) -> Self {
        Self { graph, values: NodeMap::new(graph), value_of }
    }

    /// `expr` with the symbols replaced.
    pub fn apply(&mut self, expr: Expr<'g>) -> Expr<'g> {
        match expr {
            Expr::Constant(_) => expr,
            Expr::Node { id, negative, .. } => {
                let value = self.node(id);
                if negative { -value } else { value }
            }
        }
    }

    fn node(&mut self, root: NodeId) -> Expr<'g> {
        let mut walk = Walk::to(root);
        while let Some(id) = walk.next(self.graph, |x| self.values.contains(x)) {
            let value = self.applied(id);
            self.values.insert(id, value);
        }
        self.values[root]
    }

    fn applied(&self, id: NodeId) -> Expr<'g> {
        match self.graph.op(id) {
            Op::Symbol(symbol) => (self.value_of)(symbol).unwrap_or_else(|| Expr::of_node(self.graph, id)),
            _ => rebuilt(self.graph, id, |operand| self.values[operand]),
        }
    }
}

/// The operation of a node on what its operands became; a node without operands stays, and one whose operation on them
/// is not defined.
pub fn rebuilt<'g>(graph: &'g Graph, id: NodeId, of: impl Fn(NodeId) -> Expr<'g>) -> Expr<'g> {
    let same = || Expr::of_node(graph, id);
    match graph.op(id) {
        Op::Constant(_) | Op::Symbol(_) => same(),
        Op::Add(a, b) => of(a) + of(b),
        Op::Sub(a, b) => of(a) - of(b),
        Op::Mul(a, b) => of(a) * of(b),
        Op::Scale(k, a) => Expr::Constant(graph.number(k)) * of(a),
        Op::Div(a, b) => of(a).checked_div(of(b)).unwrap_or_else(same),
        Op::Sqrt(a) => of(a).sqrt().unwrap_or_else(same),
        Op::Sin(a) => of(a).sin(),
        Op::Cos(a) => of(a).cos(),
        Op::Opaque(a) => of(a).opaque(),
    }
}
