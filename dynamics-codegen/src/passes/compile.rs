//! The passes, in order: derive in the best unit, share, hoist, schedule.

use super::parameters::Normaliser;
use super::share::share;
use super::{Companion, Cost, Operand, Program, Source};
use crate::mechanics::equations::{Block, Derivation, Equation, Equations, Method};
use crate::model::Model;
use crate::symbolic::{Expr, Graph, Number};

/// A robot's programs, ready to be written.
pub struct Compiled<'g> {
    /// Where the expressions live.
    pub graph: &'g Graph,
    /// The equations, simplified.
    pub equations: Equations<'g>,
    /// What is computed once for all calls.
    pub companion: Companion<'g>,
    /// How the companion's fields are computed.
    pub preparation: Program,
    /// One program for each equation.
    pub programs: Vec<Program>,
}

/// The methods to compile: those named, or all.
pub fn methods(wanted: Option<&[&str]>, frames: usize) -> Vec<Method> {
    let of_frames =
        (0..frames).flat_map(|k| [Method::Pose(k), Method::Jacobian(k), Method::WorldJacobian(k)]);
    let is_wanted = |method: &Method| wanted.is_none_or(|names| names.contains(&method.name()));
    Method::OF_ROBOT.into_iter().chain(of_frames).filter(is_wanted).collect()
}

/// Compiles `methods` of `model`.
pub fn compile<'g>(model: &Model<'g>, graph: &'g Graph, methods: &[Method]) -> Compiled<'g> {
    let derivation = Derivation::of(model, graph);
    let unit = best_unit(model, graph);
    let derivation = derivation.in_unit(unit);
    let equation = |&method: &Method| Equation { method, blocks: cheapest(graph, &derivation, method) };
    let equations =
        Equations { inputs: derivation.inputs, equations: methods.iter().map(equation).collect() };
    let companion = Companion::of(graph, &equations);
    let preparation = companion.program(graph, &equations);
    let program = |equation: &Equation<'g>| {
        Program::of(graph, equations.inputs, &entries(&equation.blocks), |node| companion.read(node))
    };
    let programs = equations.equations.iter().map(program).collect();
    Compiled { graph, preparation, programs, companion, equations }
}

/// The unit of length in which inverse dynamics is cheapest.
fn best_unit(model: &Model<'_>, graph: &Graph) -> Number {
    let units = Derivation::of(model, graph).units();
    if units.len() == 1 {
        return units[0];
    }
    let cost = |unit: &Number| {
        let scratch = Derivation::of(model, graph).in_unit(*unit);
        let program =
            Program::of(graph, scratch.inputs, &entries(&scratch.blocks(Method::InverseDynamics)), |_| None);
        arithmetic(program.cost())
    };
    units.into_iter().min_by_key(cost).unwrap_or(Number::ONE)
}

/// The cheapest way to compute a method's result, simplified.
fn cheapest<'g>(graph: &'g Graph, derivation: &Derivation<'g>, method: Method) -> Vec<Block<'g>> {
    let simplified = derivation.alternatives(method).into_iter().flat_map(|blocks| {
        let mut normaliser = Normaliser::new(graph);
        let plain: Vec<Expr<'g>> =
            entries(&blocks).into_iter().map(|entry| normaliser.normalise(entry)).collect();
        let shared = share(graph, &plain, |node| graph.is_parameter_only(node));
        [with_entries(&blocks, shared), with_entries(&blocks, plain)]
    });
    let at_hand = Operand { source: Source::Field(0), negative: false };
    let is_free = |node| graph.is_parameter_only(node).then_some(at_hand);
    let cost = |blocks: &Vec<Block<'g>>| {
        arithmetic(Program::of(graph, derivation.inputs, &entries(blocks), is_free).cost())
    };
    simplified.min_by_key(cost).unwrap_or_default()
}

fn arithmetic(cost: Cost) -> u32 {
    cost.multiplications + cost.additions + cost.divisions + cost.square_roots
}

/// All entries of the blocks, in order.
pub fn entries<'g>(blocks: &[Block<'g>]) -> Vec<Expr<'g>> {
    blocks.iter().flat_map(|block| block.entries.iter().copied()).collect()
}

fn with_entries<'g>(blocks: &[Block<'g>], entries: Vec<Expr<'g>>) -> Vec<Block<'g>> {
    let mut entries = entries.into_iter();
    let block = |block: &Block<'g>| Block {
        entries: entries.by_ref().take(block.entries.len()).collect(),
        ..block.clone()
    };
    blocks.iter().map(block).collect()
}
