//! The passes, in order: derive in the best unit, share, hoist, schedule.

use super::lanes::Layout;
use super::parameters::Normaliser;
use super::plan::{Form, Plan, Plans, RunTime, calls};
use super::right_sides::{before_solving, solved};
use super::schedule::{arithmetic, schedule, schedule_in};
use super::share::share;
use super::table;
use super::{Companion, Cost, Program};
use crate::mechanics::branches::Branches;
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
                Plan::Loops { .. } | Plan::Table { .. } => None,
            }
        })
    }

    /// Every program: the preparation, and those of the methods.
    pub fn programs(&self) -> impl Iterator<Item = &Program> {
        let of_methods = self.methods.iter().filter_map(|method| match &method.plan {
            Plan::StraightLine { program, .. } => Some(program),
            Plan::Loops { .. } | Plan::Table { .. } => None,
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
    /// The bundle whose body it shares, being that bundle or all but the first block of it.
    pub shares: Option<Method>,
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
    let at_rest = derivation.at_rest();
    let alike = (run_time == RunTime::Core).then(|| derivation.alike(model, unit)).flatten();
    let alike_at_rest = alike.as_ref().and_then(Derivation::at_rest);
    let inputs = derivation.inputs;
    let plan = Plans::of(model, run_time);
    let is_straight = |method: Method| methods.contains(&method) && plan.form(method) == Form::StraightLine;
    let is_solved = |method: Method| methods.contains(&method) && plan.is_solved(method);
    let shares = |method: Method| {
        let both = method.bundle_and_part().filter(|_| inputs.dof > LARGEST_TO_SHARE_ALL)?;
        (both.into_iter().all(is_straight) || both.into_iter().all(is_solved)).then_some(both[0])
    };
    let has_own = |method: Method| shares(method).is_none_or(|bundle| bundle == method);
    let straight = methods.iter().copied().filter(|&method| is_straight(method) && has_own(method));
    let mut normaliser = Normaliser::new(graph);
    let mut side_by_side: Vec<Method> = Vec::new();
    let mut solved_side_by_side: Vec<Method> = Vec::new();
    let equations: Vec<Equation<'g>> = straight
        .map(|method| {
            let alike = alike.iter().chain(&alike_at_rest);
            if let Some(blocks) = cheapest_side_by_side(alike, method, &mut normaliser) {
                side_by_side.push(method);
                return Equation { method, blocks };
            }
            let at_rest = at_rest.as_ref().filter(|_| method.trait_().is_of_forces());
            let derivations = std::iter::once(&derivation).chain(at_rest);
            let to_solve = (run_time == RunTime::Core).then(|| before_solving(derivations.clone(), method));
            let blocks = match to_solve.flatten() {
                Some(candidates) => {
                    solved_side_by_side.push(method);
                    cheapest(&derivation, candidates.into_iter(), &mut normaliser)
                }
                None => {
                    let candidates = derivations.flat_map(|derivation| derivation.alternatives(method));
                    cheapest(&derivation, candidates, &mut normaliser)
                }
            };
            Equation { method, blocks }
        })
        .collect();
    let table = methods
        .iter()
        .any(|&method| matches!(plan.form(method), Form::Table | Form::Lanes))
        .then(|| table::entries(model));
    let entries_of_table = table.as_deref().unwrap_or_default();
    let branches = alike.as_ref().map(|alike| &alike.branches);
    let companion = Companion::of(graph, inputs, &equations, entries_of_table, branches);
    let program_of = |results: &[Expr<'g>]| schedule(graph, inputs, results, |node| companion.read(node));
    let program_side_by_side = |results: &[Expr<'g>], branches: &Branches<'g>| {
        let layout = Layout::of(graph, results, branches, |node| companion.read(node).is_some());
        schedule_in(&layout, graph, inputs, results, |node| companion.read(node))
    };
    let blocks_of = |method: Method| -> Vec<Block<'g>> {
        let of = |method| equations.iter().find(|equation| equation.method == method);
        let owner = shares(method).unwrap_or(method);
        let first = usize::from(owner != method);
        of(owner).map(|equation| equation.blocks[first..].to_vec()).unwrap_or_default()
    };
    let mut compiled: Vec<CompiledMethod<'g>> = Vec::with_capacity(methods.len());
    for &method in methods {
        let (plan, cost) = match plan.form(method) {
            Form::StraightLine => {
                let blocks = blocks_of(method);
                let owner = shares(method).unwrap_or(method);
                let program = match branches.filter(|_| side_by_side.contains(&owner)) {
                    Some(branches) => program_side_by_side(&entries(&blocks), branches),
                    None => program_of(&entries(&blocks)),
                };
                let (blocks, program) = match solved_side_by_side.contains(&owner) {
                    true => solved(blocks, program, inputs.dof),
                    false => (blocks, program),
                };
                let cost = program.cost();
                (Plan::StraightLine { blocks, program }, cost)
            }
            Form::Loops => {
                // Methods come after those that they call.
                let called = compiled.iter().filter(|known| calls(method).contains(&known.method));
                let own = plan.cost_of_loops(method);
                let cost = called.fold(own, |sum, called| sum + called.cost);
                (Plan::Loops { parents: plan.parents.clone() }, cost)
            }
            form @ (Form::Table | Form::Lanes) => {
                let frame = table::frame(model, method).map(|(link, entries)| (link, program_of(&entries)));
                let lanes = (form == Form::Lanes).then(|| plan.parents.clone());
                (Plan::Table { frame, lanes }, plan.cost_of_table(method))
            }
        };
        compiled.push(CompiledMethod { method, cost, plan, shares: shares(method) });
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

/// The cheapest of several ways to compute a method's result, simplified.
fn cheapest<'g>(
    derivation: &Derivation<'g>,
    candidates: impl Iterator<Item = Vec<Block<'g>>>,
    normaliser: &mut Normaliser<'g>,
) -> Vec<Block<'g>> {
    let Derivation { graph, inputs, .. } = *derivation;
    let is_free = |node| graph.is_parameter_only(node);
    let cost = |blocks: &Vec<Block<'g>>| arithmetic(graph, &entries(blocks), is_free);
    let mut plain: Vec<Vec<Block<'g>>> = candidates.map(|blocks| normalised(&blocks, normaliser)).collect();
    plain.sort_by_key(cost);
    if inputs.dof > LARGEST_TO_SHARE_ALL {
        plain.truncate(1);
    }
    let simplified = plain.into_iter().flat_map(|blocks| {
        let shared = share(graph, &entries(&blocks), is_free);
        [with_entries(&blocks, shared), blocks]
    });
    simplified.min_by_key(cost).unwrap_or_default()
}

/// The cheapest way to compute a method's result for branches that are alike at once, if that takes fewer operations by
/// a quarter than to compute it for one after the other: common parts are not looked for then.
fn cheapest_side_by_side<'d, 'g: 'd>(
    derivations: impl Iterator<Item = &'d Derivation<'g>>,
    method: Method,
    normaliser: &mut Normaliser<'g>,
) -> Option<Vec<Block<'g>>> {
    if !method.trait_().is_of_forces() {
        return None;
    }
    let mut candidate = |derivation: &Derivation<'g>, blocks: Vec<Block<'g>>| {
        let Derivation { graph, ref branches, .. } = *derivation;
        let blocks = normalised(&blocks, normaliser);
        let (entries, is_free) = (entries(&blocks), |node| graph.is_parameter_only(node));
        let alone = arithmetic(graph, &entries, is_free);
        let together = Layout::of(graph, &entries, branches, is_free).operations(graph, &entries, is_free);
        (4 * together <= 3 * alone).then_some((together, blocks))
    };
    derivations
        .flat_map(|derivation| {
            derivation.alternatives(method).into_iter().map(move |blocks| (derivation, blocks))
        })
        .filter_map(|(derivation, blocks)| candidate(derivation, blocks))
        .min_by_key(|(operations, _)| *operations)
        .map(|(_, blocks)| blocks)
}

/// The largest robot of which all alternatives are simplified before the cheapest is chosen, and of which derivatives
/// have a body of their own beside that with the value.
const LARGEST_TO_SHARE_ALL: usize = 3;

/// All entries of the blocks, in order.
pub fn entries<'g>(blocks: &[Block<'g>]) -> Vec<Expr<'g>> {
    blocks.iter().flat_map(|block| block.entries.iter().copied()).collect()
}

fn normalised<'g>(blocks: &[Block<'g>], normaliser: &mut Normaliser<'g>) -> Vec<Block<'g>> {
    let entries = entries(blocks).into_iter().map(|entry| normaliser.normalise(entry)).collect();
    with_entries(blocks, entries)
}

fn with_entries<'g>(blocks: &[Block<'g>], entries: Vec<Expr<'g>>) -> Vec<Block<'g>> {
    let mut entries = entries.into_iter();
    let block = |block: &Block<'g>| Block {
        entries: entries.by_ref().take(block.entries.len()).collect(),
        ..block.clone()
    };
    blocks.iter().map(block).collect()
}
