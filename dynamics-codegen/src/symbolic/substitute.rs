//! Expressions with other things in the place of symbols, or of more.

use super::{Expr, Graph, NodeId, NodeMap, Op, SymbolId, Walk};

/// Puts expressions in the place of others, each node once.
pub struct Substitution<'g, F> {
    graph: &'g Graph,
    values: NodeMap<Expr<'g>>,
    value_of: F,
}

/// A substitution that asks `value_of` for what stands in the place of a symbol; none leaves it.
pub fn of_symbols<'g>(
    graph: &'g Graph,
    value_of: impl Fn(SymbolId) -> Option<Expr<'g>>,
) -> Substitution<'g, impl Fn(NodeId) -> Option<Expr<'g>>> {
    Substitution::new(graph, move |id| match graph.op(id) {
        Op::Symbol(symbol) => value_of(symbol),
        _ => None,
    })
}

impl<'g, F: Fn(NodeId) -> Option<Expr<'g>>> Substitution<'g, F> {
    /// A substitution that asks `value_of` for what stands in the place of a node, whatever that is made of; none goes
    /// on with what it is made of.
    pub fn new(graph: &'g Graph, value_of: F) -> Self {
        Self { graph, values: NodeMap::new(graph), value_of }
    }

    /// `expr` with its parts replaced.
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
        while let Some(id) = walk.next(self.graph, |x| self.known(x).is_some()) {
            let value = rebuilt(self.graph, id, |operand| {
                self.known(operand).unwrap_or_else(|| Expr::of_node(self.graph, operand))
            });
            self.values.insert(id, value);
        }
        self.known(root).unwrap_or_else(|| Expr::of_node(self.graph, root))
    }

    fn known(&self, id: NodeId) -> Option<Expr<'g>> {
        self.values.get(id).copied().or_else(|| (self.value_of)(id))
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
