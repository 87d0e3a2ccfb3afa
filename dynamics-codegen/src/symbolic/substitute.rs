//! Expressions with other things in the place of symbols.

use super::{Expr, Graph, NodeId, NodeMap, Op, SymbolId};

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

    /// Operands before operations, without recursion: graphs may be deep.
    fn node(&mut self, root: NodeId) -> Expr<'g> {
        let mut stack = vec![root];
        while let Some(&id) = stack.last() {
            let waiting = stack.len();
            let op = self.graph.op(id);
            if self.values.contains(id) {
                stack.pop();
                continue;
            }
            for operand in op.operands() {
                if !self.values.contains(operand) {
                    stack.push(operand);
                }
            }
            if stack.len() == waiting {
                let value = self.applied(id, op);
                self.values.insert(id, value);
            }
        }
        self.values[root]
    }

    /// The operation on what its operands became.
    fn applied(&self, id: NodeId, op: Op) -> Expr<'g> {
        let of = |x: NodeId| self.values[x];
        let same = || Expr::of_node(self.graph, id);
        match op {
            Op::Constant(_) => same(),
            Op::Symbol(symbol) => (self.value_of)(symbol).unwrap_or_else(same),
            Op::Add(a, b) => of(a) + of(b),
            Op::Sub(a, b) => of(a) - of(b),
            Op::Mul(a, b) => of(a) * of(b),
            Op::Scale(k, a) => Expr::Constant(self.graph.number(k)) * of(a),
            Op::Div(a, b) => of(a).checked_div(of(b)).unwrap_or_else(same),
            Op::Sqrt(a) => of(a).sqrt().unwrap_or_else(same),
            Op::Sin(a) => of(a).sin(),
            Op::Cos(a) => of(a).cos(),
        }
    }
}
