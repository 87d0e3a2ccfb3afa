//! Work that depends on parameters alone is done once: it becomes a field of the robot's companion.

use super::parameters::{Normaliser, reads_negative};
use super::program::{Operand, Program, Source};
use super::schedule::schedule;
use super::share::share;
use crate::mechanics::branches::Branches;
use crate::mechanics::equations::{Equation, Inputs};
use crate::symbolic::{Expr, Graph, NodeId, NodeMap, Op, of_symbols};

/// The fields of the prepared companion: parameters that methods read, and what is made of them.
pub struct Companion<'g> {
    /// The value of each field.
    pub fields: Vec<Expr<'g>>,
    /// How the fields are computed from the parameters, in their order.
    pub preparation: Program,
    /// What each hoisted node is read as.
    reads: NodeMap<Operand>,
}

impl<'g> Companion<'g> {
    /// Finds what the equations and the table of links need of parameter-only work; names in `branches` are read as what
    /// they stand for.
    pub fn of(
        graph: &'g Graph,
        inputs: Inputs,
        equations: &[Equation<'g>],
        table: &[Expr<'g>],
        branches: Option<&Branches<'g>>,
    ) -> Self {
        let nothing = Program { steps: Vec::new(), results: Vec::new(), rows: Vec::new() };
        let mut companion = Self { fields: Vec::new(), preparation: nothing, reads: NodeMap::new(graph) };
        let mut normaliser = Normaliser::new(graph);
        let mut names = of_symbols(graph, |symbol| branches?.value(symbol));
        for id in hoisted_nodes(graph, equations, table) {
            let value = normaliser.normalise(names.apply(Expr::of_node(graph, id)));
            let operand = companion.operand(graph, value);
            companion.reads.insert(id, operand);
        }
        companion.preparation =
            schedule(graph, inputs, &share(graph, &companion.fields, |_| false), |_| None);
        companion.order_by_computation();
        companion
    }

    /// What a node is read as, if it is hoisted.
    pub fn read(&self, node: NodeId) -> Option<Operand> {
        self.reads.get(node).copied()
    }

    /// Puts the fields in the order in which they are computed, parameters first.
    fn order_by_computation(&mut self) {
        let computed_at = |field: &usize| match self.preparation.results[*field].source {
            Source::Step(step) | Source::Sin(step) | Source::Cos(step) => step + 1,
            Source::Constant(_) | Source::Input(_) | Source::Field(_) => 0,
        };
        let mut order: Vec<usize> = (0..self.fields.len()).collect();
        order.sort_by_key(computed_at);
        let mut place = vec![0; order.len()];
        for (new, &old) in order.iter().enumerate() {
            place[old] = new;
        }
        self.fields = order.iter().map(|&old| self.fields[old]).collect();
        self.preparation.results = order.iter().map(|&old| self.preparation.results[old]).collect();
        for operand in self.reads.values_mut() {
            if let Source::Field(field) = operand.source {
                operand.source = Source::Field(place[field]);
            }
        }
    }

    /// A field for the value, or for its negative if that reads better.
    fn operand(&mut self, graph: &'g Graph, value: Expr<'g>) -> Operand {
        if let Expr::Constant(value) = value {
            return Operand::constant(value);
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
                stack.extend(graph.op(id).operands().filter(needed));
            }
        }
    }
    found
}
