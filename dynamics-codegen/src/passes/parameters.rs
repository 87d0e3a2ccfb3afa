//! Parameter-only expressions in normal form: polynomials with exact coefficients, gathered and in order.
//!
//! `½(iz + ix − iy) + ½(iz − ix + iy)` becomes `iz`, and what cancels is gone, before anything is counted or
//! hoisted. Only what depends on parameters alone is expanded, and no further than [`MOST_TERMS`]: beyond it a
//! product stays as it is.

use std::collections::BTreeMap;
use std::rc::Rc;

use crate::symbolic::{Expr, Graph, NodeId, NodeMap, Number, Op, Walk, rebuilt};

/// The longest polynomial that is expanded.
const MOST_TERMS: usize = 40;

/// A product of nodes, in order.
type Monomial = Vec<NodeId>;
type Polynomial = BTreeMap<Monomial, Number>;

/// Rewrites expressions so that every parameter-only part of them is in normal form.
pub(super) struct Normaliser<'g> {
    graph: &'g Graph,
    polynomials: NodeMap<Rc<Polynomial>>,
    rewritten: NodeMap<Expr<'g>>,
}

impl<'g> Normaliser<'g> {
    /// A normaliser for expressions of `graph`.
    pub(super) fn new(graph: &'g Graph) -> Self {
        Self { graph, polynomials: NodeMap::new(graph), rewritten: NodeMap::new(graph) }
    }

    /// The expression in normal form.
    pub(super) fn normalise(&mut self, expr: Expr<'g>) -> Expr<'g> {
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
        while let Some(id) = walk.next(self.graph, |x| self.rewritten.contains(x)) {
            let value = self.rewrite(id, self.graph.op(id));
            self.rewritten.insert(id, value);
        }
        self.rewritten[root]
    }

    fn rewrite(&mut self, id: NodeId, op: Op) -> Expr<'g> {
        if self.graph.is_parameter_only(id) && !matches!(op, Op::Constant(_)) {
            let polynomial = self.polynomial(id, op);
            let value = self.expression(&polynomial);
            self.polynomials.insert(id, polynomial);
            return value;
        }
        self.applied(id)
    }

    /// The operation on rewritten operands.
    fn applied(&self, id: NodeId) -> Expr<'g> {
        rebuilt(self.graph, id, |operand| self.rewritten[operand])
    }

    /// The polynomial of a parameter-only node, whose operands have theirs.
    fn polynomial(&self, id: NodeId, op: Op) -> Rc<Polynomial> {
        let of = |x: NodeId| self.known(x);
        let expanded = match op {
            Op::Add(a, b) => Some(sum(&of(a), &of(b), Number::ONE)),
            Op::Sub(a, b) => Some(sum(&of(a), &of(b), -Number::ONE)),
            Op::Scale(k, a) => Some(scaled(&of(a), self.graph.number(k))),
            Op::Mul(a, b) => product(&of(a), &of(b)),
            _ => None,
        };
        match expanded.filter(|polynomial| polynomial.len() <= MOST_TERMS) {
            Some(polynomial) => Rc::new(polynomial),
            None => Rc::new(atom(self.applied(id))),
        }
    }

    fn known(&self, id: NodeId) -> Rc<Polynomial> {
        match (self.graph.op(id), self.polynomials.get(id)) {
            (_, Some(polynomial)) => Rc::clone(polynomial),
            (Op::Constant(k), None) => Rc::new(Polynomial::from([(Vec::new(), self.graph.number(k))])),
            (_, None) => Rc::new(atom(self.rewritten[id])),
        }
    }

    fn expression(&self, polynomial: &Polynomial) -> Expr<'g> {
        let term = |(monomial, &coefficient): (&Monomial, &Number)| {
            let product = monomial.iter().map(|&id| Expr::of_node(self.graph, id)).reduce(|a, b| a * b);
            product.map_or(Expr::Constant(coefficient), |product| Expr::Constant(coefficient) * product)
        };
        polynomial.iter().map(term).fold(Expr::ZERO, |sum, term| sum + term)
    }
}

/// Whether the larger part of a parameter-only expression is negative, so that its negative reads better.
pub(super) fn reads_negative(graph: &Graph, expr: Expr<'_>) -> bool {
    let (mut plus, mut minus) = (0, 0);
    let mut stack = match expr {
        Expr::Constant(value) => return value.is_negative(),
        Expr::Node { id, negative, .. } => vec![(id, negative)],
    };
    while let Some((id, negative)) = stack.pop() {
        match graph.op(id) {
            Op::Add(a, b) => stack.extend([(a, negative), (b, negative)]),
            Op::Sub(a, b) => stack.extend([(a, negative), (b, !negative)]),
            _ if negative => minus += 1,
            _ => plus += 1,
        }
    }
    minus > plus
}

fn atom(expr: Expr<'_>) -> Polynomial {
    match expr {
        Expr::Constant(value) if value.is_zero() => Polynomial::new(),
        Expr::Constant(value) => Polynomial::from([(Vec::new(), value)]),
        Expr::Node { id, negative, .. } => {
            Polynomial::from([(vec![id], if negative { -Number::ONE } else { Number::ONE })])
        }
    }
}

fn add_term(polynomial: &mut Polynomial, monomial: Monomial, coefficient: Number) {
    let sum = polynomial.get(&monomial).map_or(coefficient, |&known| known + coefficient);
    if sum.is_zero() {
        polynomial.remove(&monomial);
    } else {
        polynomial.insert(monomial, sum);
    }
}

fn sum(a: &Polynomial, b: &Polynomial, sign: Number) -> Polynomial {
    let mut result = a.clone();
    for (monomial, &coefficient) in b {
        add_term(&mut result, monomial.clone(), sign * coefficient);
    }
    result
}

fn scaled(a: &Polynomial, factor: Number) -> Polynomial {
    a.iter().map(|(monomial, &coefficient)| (monomial.clone(), factor * coefficient)).collect()
}

/// The product, unless it is longer than any polynomial may be.
fn product(a: &Polynomial, b: &Polynomial) -> Option<Polynomial> {
    if a.len() * b.len() > 2 * MOST_TERMS {
        return None;
    }
    let mut result = Polynomial::new();
    for (x, &k) in a {
        for (y, &l) in b {
            let mut monomial: Monomial = x.iter().chain(y).copied().collect();
            monomial.sort_unstable();
            add_term(&mut result, monomial, k * l);
        }
    }
    Some(result)
}
