//! Expressions: exact constants, a hash-consed graph, and what can be done with it.
//!
//! Nothing in here knows of robots.

mod differentiate;
mod evaluate;
mod expr;
mod graph;
mod node_map;
pub mod number;
mod real;
mod substitute;
mod walk;

pub use differentiate::Differentiator;
pub use evaluate::Evaluator;
pub use expr::Expr;
pub use graph::{Graph, NodeId, Op, Operands, SymbolId};
pub use node_map::NodeMap;
pub use number::Number;
pub use real::Real;
pub use substitute::{Substitution, of_symbols, rebuilt};
pub use walk::Walk;
