//! Work that depends on parameters alone is done once: it becomes a field of the robot's companion.

use rustc_hash::FxHashMap;

use super::program::Program;
use crate::mechanics::equations::Equations;
use crate::symbolic::{Expr, Graph, NodeId, Op};

/// The fields of the prepared companion: parameters that methods read, and what is made of them.
pub struct Companion<'g> {
    /// The value of each field.
    pub fields: Vec<Expr<'g>>,
    index: FxHashMap<NodeId, usize>,
}

impl<'g> Companion<'g> {
    /// Finds what the equations need of parameter-only work.
    pub fn of(graph: &'g Graph, equations: &Equations<'g>) -> Self {
        let mut companion = Self { fields: Vec::new(), index: FxHashMap::default() };
        let mut seen = vec![false; graph.len()];
        for block in equations.equations.iter().flat_map(|equation| &equation.blocks) {
            for &entry in &block.entries {
                companion.collect(graph, entry, &mut seen);
            }
        }
        companion
    }

    /// The field that holds a node, if it is hoisted.
    pub fn field(&self, node: NodeId) -> Option<usize> {
        self.index.get(&node).copied()
    }

    /// How the fields are computed from the parameters.
    pub fn program(&self, graph: &'g Graph, equations: &Equations<'g>) -> Program {
        Program::of(graph, equations.inputs, &self.fields, |_| None)
    }

    fn collect(&mut self, graph: &'g Graph, root: Expr<'g>, seen: &mut [bool]) {
        let Expr::Node { id, .. } = root else { return };
        let mut stack = vec![id];
        while let Some(id) = stack.pop() {
            if std::mem::replace(&mut seen[id.index()], true) {
                continue;
            }
            if graph.is_parameter_only(id) {
                self.index.insert(id, self.fields.len());
                self.fields.push(Expr::of_node(graph, id));
            } else {
                let needed = |x: &NodeId| !matches!(graph.op(*x), Op::Constant(_));
                stack.extend(graph.op(id).operands().into_iter().flatten().filter(needed));
            }
        }
    }
}
