//! The expression graph: every scalar that the generated code may compute.
//!
//! Nodes are hash-consed, so equal expressions have equal ids and sharing costs nothing. An id only ever
//! points backwards: `0..len` is a topological order, and it is the order of creation, never of a hash.
//! A node stands for its positive form; the sign of an expression lives in [`Expr`], so negation is free.

use std::cell::{Ref, RefCell};

use rustc_hash::FxHashMap;

use super::{Expr, Number};

/// A node of a [`Graph`]. Copyable, ordered, meaningless in another graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(u32);

impl NodeId {
    /// The position of the node in its graph.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// An input of the expressions: a coordinate, a speed, a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SymbolId(pub u32);

/// An operation. Operands carry no sign: it is pulled outwards when a node is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// A positive constant, by its place in the table of constants.
    Constant(u32),
    /// An input.
    Symbol(SymbolId),
    /// `a + b`
    Add(NodeId, NodeId),
    /// `a − b`
    Sub(NodeId, NodeId),
    /// `a·b`
    Mul(NodeId, NodeId),
    /// `k·a` with a positive constant `k`, by its place in the table of constants.
    Scale(u32, NodeId),
    /// `a / b`
    Div(NodeId, NodeId),
    /// `√a`
    Sqrt(NodeId),
    /// `sin a`
    Sin(NodeId),
    /// `cos a`
    Cos(NodeId),
    /// `a`, whatever that is made of: whoever renames what expressions are made of leaves it as it is.
    Opaque(NodeId),
}

impl Op {
    /// The nodes that the operation reads.
    pub fn operands(self) -> Operands {
        let (first, second) = match self {
            Op::Constant(_) | Op::Symbol(_) => (None, None),
            Op::Add(a, b) | Op::Sub(a, b) | Op::Mul(a, b) | Op::Div(a, b) => (Some(a), Some(b)),
            Op::Scale(_, a) | Op::Sqrt(a) | Op::Sin(a) | Op::Cos(a) | Op::Opaque(a) => (Some(a), None),
        };
        Operands { first, second }
    }
}

/// The nodes that an operation reads, one after another. Iterators of arrays are slow where nothing is optimised.
pub struct Operands {
    first: Option<NodeId>,
    second: Option<NodeId>,
}

impl Iterator for Operands {
    type Item = NodeId;

    fn next(&mut self) -> Option<NodeId> {
        let next = self.first;
        self.first = self.second;
        self.second = None;
        next
    }
}

/// The arena of all nodes and constants.
#[derive(Default)]
pub struct Graph {
    inner: RefCell<Inner>,
}

#[derive(Default)]
struct Inner {
    nodes: Vec<Op>,
    /// Whether a node depends on parameters and constants alone.
    parameter_only: Vec<bool>,
    index: FxHashMap<Op, NodeId>,
    numbers: Vec<Number>,
    number_index: FxHashMap<Number, u32>,
}

impl Graph {
    /// An empty graph.
    pub fn new() -> Self {
        Self::default()
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.inner.borrow().nodes.len()
    }

    /// Whether nothing has been made yet.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The operation of a node.
    pub fn op(&self, id: NodeId) -> Op {
        self.inner.borrow().nodes[id.index()]
    }

    /// All operations, in order of creation.
    pub fn ops(&self) -> Ref<'_, [Op]> {
        Ref::map(self.inner.borrow(), |inner| inner.nodes.as_slice())
    }

    /// The node at a position that [`NodeId::index`] gave.
    pub fn node(&self, index: usize) -> NodeId {
        assert!(index < self.len(), "a node of another graph");
        NodeId(u32::try_from(index).expect("ids are made from u32"))
    }

    /// A constant of the table.
    pub fn number(&self, index: u32) -> Number {
        self.inner.borrow().numbers[index as usize]
    }

    /// The parameter `symbol`: an input that changes seldom. Its products with other parameters are gathered
    /// as coefficients, as constants are.
    pub fn symbol(&self, symbol: SymbolId) -> Expr<'_> {
        let id = self.intern(Op::Symbol(symbol));
        self.inner.borrow_mut().parameter_only[id.index()] = true;
        Expr::positive(self, id)
    }

    /// The input `symbol` that changes with every evaluation.
    pub fn variable(&self, symbol: SymbolId) -> Expr<'_> {
        Expr::positive(self, self.intern(Op::Symbol(symbol)))
    }

    /// Whether a node depends on parameters and constants alone.
    pub fn is_parameter_only(&self, id: NodeId) -> bool {
        self.inner.borrow().parameter_only[id.index()]
    }

    pub(super) fn number_index(&self, value: Number) -> u32 {
        let mut inner = self.inner.borrow_mut();
        if let Some(&k) = inner.number_index.get(&value) {
            return k;
        }
        let k = u32::try_from(inner.numbers.len()).expect("fewer than 2^32 constants");
        inner.numbers.push(value);
        inner.number_index.insert(value, k);
        k
    }

    /// The node of an operation, made if it is new.
    pub(super) fn intern(&self, op: Op) -> NodeId {
        let mut inner = self.inner.borrow_mut();
        if let Some(&id) = inner.index.get(&op) {
            return id;
        }
        let id = NodeId(u32::try_from(inner.nodes.len()).expect("fewer than 2^32 nodes"));
        let known = match op {
            Op::Constant(_) => true,
            Op::Symbol(_) => false,
            _ => op.operands().all(|x| inner.parameter_only[x.index()]),
        };
        inner.nodes.push(op);
        inner.parameter_only.push(known);
        inner.index.insert(op, id);
        id
    }
}
