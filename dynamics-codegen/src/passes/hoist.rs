//! Work that depends on parameters alone is done once: it becomes a field of the robot's companion.

use rustc_hash::FxHashMap;

use super::parameters::{Normaliser, reads_negative};
use super::program::{Operand, Program, Source};
use super::schedule::schedule;
use super::share::share;
use crate::mechanics::equations::{Equation, Inputs};
use crate::symbolic::{Expr, Graph, NodeId, Op};

/// The fields of the prepared companion: parameters that methods read, and what is made of them.
pub struct Companion<'g> {
    /// The value of each field.
    pub fields: Vec<Expr<'g>>,
    /// What each hoisted node is read as.
    reads: FxHashMap<NodeId, Operand>,
}

impl<'g> Companion<'g> {
    /// Finds what the equations and the table of links need of parameter-only work.
    pub fn of(graph: &'g Graph, equations: &[Equation<'g>], table: &[Expr<'g>]) -> Self {
        let mut companion = Self { fields: Vec::new(), reads: FxHashMap::default() };
        let mut normaliser = Normaliser::new(graph);
        for id in hoisted_nodes(graph, equations, table) {
            let value = normaliser.normalise(Expr::of_node(graph, id));
            let operand = companion.operand(graph, value);
            companion.reads.insert(id, operand);
        }
        companion
    }

    /// What a node is read as, if it is hoisted.
    pub fn read(&self, node: NodeId) -> Option<Operand> {
        self.reads.get(&node).copied()
    }

    /// How the fields are computed from the parameters.
    pub fn program(&self, graph: &'g Graph, inputs: Inputs) -> Program {
        let shared = share(graph, &self.fields, |_| false);
        schedule(graph, inputs, &shared, |_| None)
    }

    /// A field for the value, or for its negative if that reads better.
    fn operand(&mut self, graph: &'g Graph, value: Expr<'g>) -> Operand {
        if let Expr::Constant(value) = value {
            return Operand { source: Source::Constant(value.abs()), negative: value.is_negative() };
        }
        let negative = reads_negative(graph, value);
        let value = if negative { -value } else { value };
        let known = self.fields.iter().position(|field| *field == value);
        let field = known.unwrap_or_else(|| {
            self.fields.push(value);
            self.fields.len() - 1
        });
        Operand { source: Source::Field(field), negative }
    }
}

/// The outermost parameter-only nodes, in the order in which the equations read them.
fn hoisted_nodes(graph: &Graph, equations: &[Equation<'_>], table: &[Expr<'_>]) -> Vec<NodeId> {
    let mut seen = vec![false; graph.len()];
    let mut found = Vec::new();
    let blocks = equations.iter().flat_map(|equation| &equation.blocks);
    for entry in blocks.flat_map(|block| &block.entries).chain(table) {
        let Expr::Node { id, .. } = *entry else { continue };
        let mut stack = vec![id];
        while let Some(id) = stack.pop() {
            if std::mem::replace(&mut seen[id.index()], true) {
                continue;
            }
            if graph.is_parameter_only(id) {
                found.push(id);
            } else {
                let needed = |x: &NodeId| !matches!(graph.op(*x), Op::Constant(_));
                stack.extend(graph.op(id).operands().into_iter().flatten().filter(needed));
            }
        }
    }
    found
}
