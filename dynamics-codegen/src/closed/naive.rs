//! An expression as a form, as it was computed: nothing is collected, and nothing shared.

use super::Form;
use crate::symbolic::{Expr, Graph, NodeId, NodeMap, Op};

/// The form of an expression with the order and the sharing of its graph, or `None` if it has more than `limit` parts:
/// what a graph shares is written each time.
pub fn of(graph: &Graph, expr: Expr<'_>, limit: usize) -> Option<Form> {
    let (root, negative) = match expr {
        Expr::Constant(value) => return Some(Form::number(value)),
        Expr::Node { id, negative, .. } => (id, negative),
    };
    let mut known: NodeMap<(Form, usize)> = NodeMap::new(graph);
    let mut stack = vec![root];
    while let Some(&id) = stack.last() {
        let waiting = stack.len();
        if known.contains(id) {
            stack.pop();
            continue;
        }
        stack.extend(graph.op(id).operands().filter(|&operand| !known.contains(operand)));
        if stack.len() > waiting {
            continue;
        }
        let size =
            graph.op(id).operands().fold(1, |sum: usize, operand| sum.saturating_add(known[operand].1));
        if size > limit {
            return None;
        }
        let form = operation(graph, id, &known);
        known.insert(id, (form, size));
    }
    let form = known[root].0.clone();
    Some(if negative { form.negative() } else { form })
}

fn operation(graph: &Graph, id: NodeId, known: &NodeMap<(Form, usize)>) -> Form {
    let of = |id: NodeId| known[id].0.clone();
    match graph.op(id) {
        Op::Constant(k) => Form::number(graph.number(k)),
        Op::Symbol(symbol) => Form::Symbol(symbol),
        Op::Add(a, b) => Form::sum([of(a), of(b)]),
        Op::Sub(a, b) => Form::sum([of(a), of(b).negative()]),
        Op::Mul(a, b) => Form::product([of(a), of(b)]),
        Op::Scale(k, a) => Form::product([Form::number(graph.number(k)), of(a)]),
        Op::Div(a, b) => of(a).over(of(b)),
        Op::Sqrt(a) => of(a).root(),
        Op::Sin(a) => of(a).sin(),
        Op::Cos(a) => of(a).cos(),
    }
}
