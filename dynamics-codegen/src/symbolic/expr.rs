//! `Expr`: a constant or a signed node, with operators. Every rule that needs no look-ahead is here.
//!
//! The rules, in the order they are tried: constants fold exactly; `0` and `1` vanish; signs move outwards;
//! constants move outwards (`k·(l·x) = (k·l)·x`, `(k·x)·(l·y) = (k·l)·(x·y)`); `k·x ± l·x = (k ± l)·x`.
//! They hold for real numbers; infinities and NaN are not expressions.

use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::graph::{Graph, NodeId, Op};
use super::number::Number;

/// A scalar expression.
#[derive(Clone, Copy)]
pub enum Expr<'g> {
    /// A constant. It becomes a node only as an operand of another node.
    Constant(Number),
    /// A node of a graph, or its negative; never the node of a constant.
    Node {
        /// Where the node lives.
        graph: &'g Graph,
        /// The node.
        id: NodeId,
        /// Whether the expression is minus the node.
        negative: bool,
    },
}

use Expr::{Constant, Node};

impl<'g> Expr<'g> {
    /// Zero.
    pub const ZERO: Self = Constant(Number::ZERO);
    /// One.
    pub const ONE: Self = Constant(Number::ONE);

    /// The node `id` of `graph`, as an expression.
    pub fn of_node(graph: &'g Graph, id: NodeId) -> Self {
        match graph.op(id) {
            Op::Constant(k) => Constant(graph.number(k)),
            _ => Self::positive(graph, id),
        }
    }

    pub(super) fn positive(graph: &'g Graph, id: NodeId) -> Self {
        Node { graph, id, negative: false }
    }

    /// Whether this is the constant zero.
    pub fn is_zero(self) -> bool {
        matches!(self, Constant(value) if value.is_zero())
    }

    /// The constant's value, if the expression is constant.
    pub fn as_number(self) -> Option<Number> {
        match self {
            Constant(value) => Some(value),
            Node { .. } => None,
        }
    }

    /// `√self`; of a negative constant there is none.
    pub fn sqrt(self) -> Option<Self> {
        Some(match self {
            Constant(value) => Constant(value.sqrt()?),
            Node { graph, .. } => Self::positive(graph, graph.intern(Op::Sqrt(self.unsigned_node(graph)))),
        })
    }

    /// `sin self`
    pub fn sin(self) -> Self {
        match self {
            Constant(value) => Constant(value.sin()),
            Node { graph, id, negative } => {
                Self::positive(graph, graph.intern(Op::Sin(id))).negate_if(negative)
            }
        }
    }

    /// `cos self`
    pub fn cos(self) -> Self {
        match self {
            Constant(value) => Constant(value.cos()),
            Node { graph, id, .. } => Self::positive(graph, graph.intern(Op::Cos(id))),
        }
    }

    /// `self`, whatever it is made of.
    pub fn opaque(self) -> Self {
        match self {
            Constant(_) => self,
            Node { graph, id, negative } => {
                Self::positive(graph, graph.intern(Op::Opaque(id))).negate_if(negative)
            }
        }
    }

    /// `self / divisor`; by the constant zero there is none.
    pub fn checked_div(self, divisor: Self) -> Option<Self> {
        if self.is_zero() && !divisor.is_zero() {
            return Some(Self::ZERO);
        }
        match divisor {
            Constant(value) => {
                let inverse = Number::ONE.checked_div(value)?;
                Some(match self {
                    Constant(dividend) => Constant(dividend.checked_div(value)?),
                    Node { .. } => self * Constant(inverse),
                })
            }
            Node { graph, id, negative } => {
                let op = Op::Div(self.node_of_magnitude(graph), id);
                Some(Self::positive(graph, graph.intern(op)).negate_if(negative != self.is_negative()))
            }
        }
    }

    /// Whether the expression is minus a node, or a negative constant.
    pub fn is_negative(self) -> bool {
        match self {
            Constant(value) => value.is_negative(),
            Node { negative, .. } => negative,
        }
    }

    fn negate_if(self, condition: bool) -> Self {
        if condition { -self } else { self }
    }

    /// The node of the expression without its sign; a constant becomes a node.
    fn node_of_magnitude(self, graph: &Graph) -> NodeId {
        match self {
            Constant(value) => graph.intern(Op::Constant(graph.number_index(value.abs()))),
            Node { id, .. } => id,
        }
    }

    /// A node equal to the expression, for an operation through which a sign cannot move.
    fn unsigned_node(self, graph: &'g Graph) -> NodeId {
        match self {
            Node { id, negative: true, .. } => {
                let zero = graph.intern(Op::Constant(graph.number_index(Number::ZERO)));
                graph.intern(Op::Sub(zero, id))
            }
            _ => self.node_of_magnitude(graph),
        }
    }

    /// `coefficient·node`, with the coefficients of both gathered in front.
    fn scaled(graph: &'g Graph, coefficient: Self, id: NodeId) -> Self {
        let (inner, id) = split_coefficient(graph, id);
        match coefficient * inner {
            Constant(value) if value.is_zero() => Self::ZERO,
            Constant(value) => {
                let magnitude = value.abs();
                let positive = if magnitude.is_one() {
                    Self::positive(graph, id)
                } else {
                    Self::positive(graph, graph.intern(Op::Scale(graph.number_index(magnitude), id)))
                };
                positive.negate_if(value.is_negative())
            }
            Node { id: parameter, negative, .. } => {
                let op = Op::Mul(parameter.min(id), parameter.max(id));
                Self::positive(graph, graph.intern(op)).negate_if(negative)
            }
        }
    }
}

/// `(k, x)` of a node `k·x` with a constant or parameters alone in `k`; `k = 1` if there is none.
fn split_coefficient(graph: &Graph, id: NodeId) -> (Expr<'_>, NodeId) {
    match graph.op(id) {
        Op::Scale(k, x) => (Constant(graph.number(k)), x),
        Op::Mul(a, b) => match (graph.is_parameter_only(a), graph.is_parameter_only(b)) {
            (true, false) => (Expr::positive(graph, a), b),
            (false, true) => (Expr::positive(graph, b), a),
            _ => (Expr::ONE, id),
        },
        _ => (Expr::ONE, id),
    }
}

impl<'g> Neg for Expr<'g> {
    type Output = Self;
    fn neg(self) -> Self {
        match self {
            Constant(value) => Constant(-value),
            Node { graph, id, negative } => Node { graph, id, negative: !negative },
        }
    }
}

impl<'g> Mul for Expr<'g> {
    type Output = Self;
    fn mul(self, rhs: Self) -> Self {
        match (self, rhs) {
            (Constant(a), Constant(b)) => Constant(a * b),
            (Constant(value), node @ Node { graph, id, negative })
            | (node @ Node { graph, id, negative }, Constant(value)) => {
                if value.is_zero() {
                    Self::ZERO
                } else if value.abs().is_one() {
                    node.negate_if(value.is_negative())
                } else {
                    Self::scaled(graph, Constant(value), id).negate_if(negative)
                }
            }
            (Node { graph, id: a, negative: minus_a }, Node { id: b, negative: minus_b, .. }) => {
                product(graph, a, b).negate_if(minus_a != minus_b)
            }
        }
    }
}

/// `a·b`; two coefficients are gathered, a single one stays where it is shared.
fn product<'g>(graph: &'g Graph, a: NodeId, b: NodeId) -> Expr<'g> {
    let plain = |x: NodeId, y: NodeId| Expr::positive(graph, graph.intern(Op::Mul(x.min(y), x.max(y))));
    match (graph.is_parameter_only(a), graph.is_parameter_only(b)) {
        (true, false) => return Expr::scaled(graph, Expr::positive(graph, a), b),
        (false, true) => return Expr::scaled(graph, Expr::positive(graph, b), a),
        _ => {}
    }
    let ((k, x), (l, y)) = (split_coefficient(graph, a), split_coefficient(graph, b));
    if k == Expr::ONE || l == Expr::ONE {
        return plain(a, b);
    }
    match plain(x, y) {
        Node { id, .. } => Expr::scaled(graph, k * l, id),
        Constant(_) => unreachable!("a product of nodes is a node"),
    }
}

impl<'g> Add for Expr<'g> {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        if self.is_zero() {
            return rhs;
        }
        if rhs.is_zero() {
            return self;
        }
        match (self, rhs) {
            (Constant(a), Constant(b)) => Constant(a + b),
            (Node { graph, .. }, _) | (_, Node { graph, .. }) => sum(graph, self, rhs),
        }
    }
}

fn sum<'g>(graph: &'g Graph, left: Expr<'g>, right: Expr<'g>) -> Expr<'g> {
    let (a, minus_a) = (left.node_of_magnitude(graph), left.is_negative());
    let (b, minus_b) = (right.node_of_magnitude(graph), right.is_negative());
    let ((k, x), (l, y)) = (split_coefficient(graph, a), split_coefficient(graph, b));
    if x == y {
        return (k.negate_if(minus_a) + l.negate_if(minus_b)) * Expr::of_node(graph, x);
    }
    let (a, minus_a, b, minus_b) = if a <= b { (a, minus_a, b, minus_b) } else { (b, minus_b, a, minus_a) };
    let op = if minus_a == minus_b { Op::Add(a, b) } else { Op::Sub(a, b) };
    Expr::positive(graph, graph.intern(op)).negate_if(minus_a)
}

impl<'g> Sub for Expr<'g> {
    type Output = Self;
    fn sub(self, rhs: Self) -> Self {
        self + -rhs
    }
}

impl<'g> Div for Expr<'g> {
    type Output = Self;
    fn div(self, rhs: Self) -> Self {
        self.checked_div(rhs).expect("a division by the constant zero is refused where the spec is read")
    }
}

impl From<Number> for Expr<'_> {
    fn from(value: Number) -> Self {
        Constant(value)
    }
}

impl From<i32> for Expr<'_> {
    fn from(value: i32) -> Self {
        Constant(Number::integer(i64::from(value)))
    }
}

impl PartialEq for Expr<'_> {
    /// Equality of form, not of meaning: equal expressions have equal values, and not always vice versa.
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Constant(a), Constant(b)) => a == b,
            (Node { id: a, negative: minus_a, .. }, Node { id: b, negative: minus_b, .. }) => {
                a == b && minus_a == minus_b
            }
            _ => false,
        }
    }
}

impl fmt::Debug for Expr<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Constant(value) => write!(f, "{value}"),
            Node { id, negative, .. } => write!(f, "{}#{}", if *negative { "-" } else { "" }, id.index()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Expr;
    use crate::symbolic::{Graph, Number, SymbolId};

    #[test]
    fn a_coefficient_too_small_for_a_double_is_zero() {
        let graph = Graph::new();
        let (x, y) = (graph.symbol(SymbolId(0)), graph.symbol(SymbolId(1)));
        let tiny = Number::parse_decimal("1.3e-200").map(Expr::Constant).expect("a double holds it");
        assert_eq!(tiny * tiny, Expr::ZERO);
        assert_eq!(tiny * (tiny * x), Expr::ZERO);
        assert_eq!((tiny * x) * -(tiny * y), Expr::ZERO);
        assert_eq!(tiny * (tiny * x) + y, y);
    }

    #[test]
    fn a_coefficient_too_large_for_a_double_shows_as_no_number() {
        let huge = Number::parse_decimal("1.3e200").map(Expr::Constant).expect("a double holds it");
        assert!((huge * huge).as_number().is_some_and(|product| !product.is_finite()));
    }
}
