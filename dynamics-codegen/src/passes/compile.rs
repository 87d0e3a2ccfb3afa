//! The passes, in order: derive in the best unit, share, hoist, schedule.

use super::parameters::Normaliser;
use super::plan::{Form, Plan, Plans, RunTime, calls};
use super::schedule::{arithmetic, schedule};
use super::share::share;
use super::table;
use super::{Companion, Cost, Program};
use crate::mechanics::equations::{Block, Derivation, Equation, Inputs, Method};
use crate::mechanics::regressor::RegressorColumn;
use crate::model::Model;
use crate::symbolic::{Expr, Graph, Number};

/// A robot's programs, ready to be written.
pub struct Compiled<'g> {
    /// Where the expressions live.
    pub graph: &'g Graph,
    /// The meaning of the symbols.
    pub inputs: Inputs,
    /// What is computed once for all calls.
    pub companion: Companion<'g>,
    /// The entries of the table of links, for methods too large for straight lines.
    pub table: Option<Program>,
    /// The methods, in order.
    pub methods: Vec<CompiledMethod<'g>>,
    /// What the regressor's parameters are called; none where there is no regressor.
    pub parameter_names: Vec<String>,
    /// What the base parameters are called.
    pub base_parameter_names: Vec<String>,
}

/// How long the vectors of a robot are.
#[derive(Clone, Copy, Debug)]
pub struct Sizes {
    /// Coordinates and speeds.
    pub inputs: Inputs,
    /// NP, the parameters of the regressor.
    pub parameters: usize,
    /// NB, those that can be told apart.
    pub base_parameters: usize,
}

impl Compiled<'_> {
    /// How long its vectors are.
    pub fn sizes(&self) -> Sizes {
        let (parameters, base_parameters) = (self.parameter_names.len(), self.base_parameter_names.len());
        Sizes { inputs: self.inputs, parameters, base_parameters }
    }

    /// The program of a method that has one.
    pub fn program(&self, method: Method) -> Option<&Program> {
        self.methods.iter().find(|compiled| compiled.method == method).and_then(|compiled| {
            match &compiled.plan {
                Plan::StraightLine { program, .. } => Some(program),
                Plan::Loops | Plan::Table { .. } => None,
            }
        })
    }

    /// Every program: the preparation, and those of the methods.
    pub fn programs(&self) -> impl Iterator<Item = &Program> {
        let of_methods = self.methods.iter().filter_map(|method| match &method.plan {
            Plan::StraightLine { program, .. } => Some(program),
            Plan::Loops | Plan::Table { .. } => None,
        });
        std::iter::once(&self.companion.preparation).chain(&self.table).chain(of_methods)
    }
}

/// A method, ready to be written.
pub struct CompiledMethod<'g> {
    /// Which one.
    pub method: Method,
    /// How it is computed.
    pub plan: Plan<'g>,
    /// Its operations.
    pub cost: Cost,
}

/// Compiles `methods` of `model`.
pub fn compile<'g>(
    model: &Model<'g>,
    graph: &'g Graph,
    methods: &[Method],
    run_time: RunTime,
) -> Compiled<'g> {
    let derivation = Derivation::of(model, graph);
    let unit = best_unit(&derivation);
    let derivation = derivation.in_unit(unit);
    let plan = Plans::of(model, run_time);
    let straight = methods.iter().copied().filter(|&method| plan.form(method) == Form::StraightLine);
    let mut normaliser = Normaliser::new(graph);
    let equations: Vec<Equation<'g>> = straight
        .map(|method| Equation { method, blocks: cheapest(&derivation, method, &mut normaliser) })
        .collect();
    let table = methods
        .iter()
        .any(|&method| matches!(plan.form(method), Form::Table | Form::Lanes))
        .then(|| table::entries(model));
    let inputs = derivation.inputs;
    let companion = Companion::of(graph, inputs, &equations, table.as_deref().unwrap_or_default());
    let program_of = |results: &[Expr<'g>]| schedule(graph, inputs, results, |node| companion.read(node));
    let mut equations = equations.into_iter();
    let mut compiled: Vec<CompiledMethod<'g>> = Vec::with_capacity(methods.len());
    for &method in methods {
        let (plan, cost) = match plan.form(method) {
            Form::StraightLine => {
                let blocks = equations.next().map(|equation| equation.blocks).unwrap_or_default();
                let program = program_of(&entries(&blocks));
                let cost = program.cost();
                (Plan::StraightLine { blocks, program }, cost)
            }
            Form::Loops => {
                let cost = cost_of_loops(method, inputs.dof, &compiled);
                (Plan::Loops, cost)
            }
            form @ (Form::Table | Form::Lanes) => {
                let frame = table::frame(model, method).map(|(link, entries)| (link, program_of(&entries)));
                (Plan::Table { frame, in_lanes: form == Form::Lanes }, plan.cost_of_table(method))
            }
        };
        compiled.push(CompiledMethod { method, cost, plan });
    }
    let table = table.map(|entries| program_of(&entries));
    let names = |columns: &[RegressorColumn<Expr<'g>>]| columns.iter().map(|c| c.name.clone()).collect();
    let has = |wanted: [Method; 2]| methods.iter().any(|method| wanted.contains(method));
    let parameter_names = match has([Method::Regressor, Method::InertialParameters]) {
        true => names(derivation.regressor()),
        false => vec![],
    };
    let base_parameter_names = match has([Method::BaseRegressor, Method::BaseParameters]) {
        true => names(derivation.base_regressor()),
        false => vec![],
    };
    Compiled { graph, inputs, table, methods: compiled, companion, parameter_names, base_parameter_names }
}

/// What the loops of the run time cost, with the methods that they call.
fn cost_of_loops(method: Method, dof: usize, compiled: &[CompiledMethod<'_>]) -> Cost {
    let count = |value: usize| u32::try_from(value).unwrap_or(u32::MAX);
    // A factorisation and the inverse of the factor are a sixth of n³ each, and half of it each product with the factor:
    // one of them for M⁻¹, two for each matrix that is solved for.
    let sixths = match method {
        Method::InverseMassMatrix => 2 + 3,
        _ => 2 + 3 + 12,
    };
    let of_products = count(sixths * dof * dof * dof / 6);
    let mut cost = Cost {
        multiplications: of_products,
        additions: of_products,
        divisions: count(dof),
        ..Cost::default()
    };
    for &part in calls(method) {
        // Methods come after those that they call.
        cost = cost
            + compiled.iter().find(|known| known.method == part).map_or(Cost::default(), |known| known.cost);
    }
    cost
}

/// The unit of length in which inverse dynamics is cheapest.
fn best_unit(derivation: &Derivation<'_>) -> Number {
    let units = derivation.units();
    if units.len() == 1 {
        return units[0];
    }
    let cost = |unit: &Number| {
        let entries = entries(&derivation.in_unit(*unit).blocks(Method::InverseDynamics));
        arithmetic(derivation.graph, &entries, |_| false)
    };
    units.into_iter().min_by_key(cost).unwrap_or(Number::ONE)
}

/// The cheapest way to compute a method's result, simplified.
fn cheapest<'g>(
    derivation: &Derivation<'g>,
    method: Method,
    normaliser: &mut Normaliser<'g>,
) -> Vec<Block<'g>> {
    let graph = derivation.graph;
    let is_free = |node| graph.is_parameter_only(node);
    let cost = |blocks: &Vec<Block<'g>>| arithmetic(graph, &entries(blocks), is_free);
    let mut plain: Vec<Vec<Block<'g>>> = Vec::new();
    for blocks in derivation.alternatives(method) {
        let entries = entries(&blocks).into_iter().map(|entry| normaliser.normalise(entry)).collect();
        plain.push(with_entries(&blocks, entries));
    }
    if derivation.inputs.dof > MOST_TO_SHARE_EACH {
        plain.sort_by_key(cost);
        plain.truncate(1);
    }
    let simplified = plain.into_iter().flat_map(|blocks| {
        let shared = share(graph, &entries(&blocks), is_free);
        [with_entries(&blocks, shared), blocks]
    });
    simplified.min_by_key(cost).unwrap_or_default()
}

/// The largest robot of which every alternative is simplified before the cheapest is chosen.
const MOST_TO_SHARE_EACH: usize = 3;

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
