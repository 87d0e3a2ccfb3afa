//! The compiler's own roads to a robot's numbers: the interpreted programs, the plain recursion, and Lagrange's.

use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::mechanics::equations::{Argument, Input, Method};
use dynamics_codegen::mechanics::lagrange::{self, Coordinates, Lagrange};
use dynamics_codegen::mechanics::plain::Oracle;
use dynamics_codegen::model::{self, Model, Tree};
use dynamics_codegen::passes::{self, Compiled, Plan, RunTime};
use dynamics_codegen::spec;
use dynamics_codegen::symbolic::{Evaluator, Expr, Graph, Number, Real, SymbolId};

use crate::State;
use crate::zoo::Entry;

/// The struct of a robot, read from its text.
///
/// # Panics
///
/// If the text is no struct: the derive has compiled it.
pub fn input(entry: &Entry) -> syn::DeriveInput {
    syn::parse_str(entry.source).unwrap_or_else(|error| panic!("{}: {error}", entry.name))
}

/// The code that the derive writes for a robot.
///
/// # Panics
///
/// If the compiler finds a mistake in the robot: the derive has compiled it.
pub fn generated(entry: &Entry) -> String {
    dynamics_codegen::generate_with(&input(entry), read)
        .unwrap_or_else(|mistakes| panic!("{}: {}", entry.name, mistakes.into_text()))
}

/// Reads a file by its path from the root of this crate, as the derive does.
///
/// # Errors
///
/// What the system says.
pub fn read(path: &str) -> Result<Vec<u8>, String> {
    std::fs::read(format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))).map_err(|error| error.to_string())
}

/// What a robot's text and file say.
///
/// # Panics
///
/// If the compiler finds a mistake in them: the derive has compiled the robot.
pub fn specification(entry: &Entry) -> spec::RobotSpec {
    let mut diags = Diagnostics::new();
    let mut spec = spec::parse(&input(entry), &mut diags);
    if let Some(path) = spec.options.urdf.clone() {
        let bytes = read(&path.text).unwrap_or_else(|error| panic!("{}: {error}", entry.name));
        let text = std::str::from_utf8(&bytes).unwrap_or_else(|error| panic!("{}: {error}", entry.name));
        spec::urdf::read(&mut spec, spec::urdf::Urdf { file: &path.text, text }, &mut diags);
    }
    let mistakes = diags.into_text();
    assert!(mistakes.is_empty(), "{}: {mistakes}", entry.name);
    spec
}

/// Runs `with` on the robot as the compiler sees it.
///
/// # Panics
///
/// If the compiler finds a mistake in the robot: the derive has compiled it.
pub fn travel<R>(entry: &Entry, with: impl FnOnce(&Roads<'_>) -> R) -> R {
    let graph = Graph::new();
    let mut diags = Diagnostics::new();
    let model = model::build(&specification(entry), &graph, &mut diags);
    let mistakes = diags.into_text();
    let model = model.unwrap_or_else(|| panic!("{}: {mistakes}", entry.name));
    with(&Roads::of(entry, &graph, model))
}

/// A robot inside the compiler, its parameters at the values of the zoo.
pub struct Roads<'g> {
    graph: &'g Graph,
    /// What the specification means.
    pub model: Model<'g>,
    /// The tree in numbers.
    pub tree: Tree<f64>,
    parameters: Vec<f64>,
}

impl<'g> Roads<'g> {
    fn of(entry: &Entry, graph: &'g Graph, model: Model<'g>) -> Self {
        let value = |name: &str| {
            let known = entry.parameters.iter().find(|(known, _)| *known == name);
            known.unwrap_or_else(|| panic!("{}: no value for `{name}`", entry.name)).1
        };
        let parameters: Vec<f64> = model.parameters.iter().map(|parameter| value(&parameter.name)).collect();
        let tree = tree_in(graph, &model, |symbol| parameters[symbol.0 as usize]);
        Self { graph, model, tree, parameters }
    }

    /// The tree in numbers of any precision, which are made of the fields by `field`.
    pub fn tree_in<R: Real>(&self, field: impl Fn(f64) -> R) -> Tree<R> {
        tree_in(self.graph, &self.model, |symbol| field(self.parameters[symbol.0 as usize]))
    }

    /// The plain recursion in doubles.
    pub fn oracle(&self) -> Oracle<'_> {
        Oracle::new(&self.tree)
    }

    /// The programs that the derive would write, to be run here.
    pub fn interpreter(&self) -> Interpreter<'_, 'g> {
        self.interpreter_for(RunTime::Core)
    }

    /// The programs that are written where there is this run time.
    pub fn interpreter_for(&self, run_time: RunTime) -> Interpreter<'_, 'g> {
        let methods = passes::methods(None, &self.model, run_time);
        let compiled = passes::compile(&self.model, self.graph, &methods, run_time);
        let read = |input| match input {
            Input::Parameter(k) => self.parameters[k],
            Input::Argument(..) => unreachable!("the preparation reads parameters only"),
        };
        let fields = compiled.companion.preparation.evaluate(read, &[]);
        Interpreter { roads: self, compiled, fields }
    }

    /// The equations of Lagrange, with their derivation's own mechanics.
    pub fn lagrangian(&self) -> Lagrangian {
        Lagrangian { tree: self.tree.clone() }
    }
}

fn tree_in<'g, R: Real>(graph: &'g Graph, model: &Model<'g>, field: impl Fn(SymbolId) -> R) -> Tree<R> {
    let mut evaluator = Evaluator::new(graph, field);
    model.tree.map(|expr| evaluator.value(expr))
}

/// The interpreted programs of a robot.
pub struct Interpreter<'r, 'g> {
    roads: &'r Roads<'g>,
    compiled: Compiled<'g>,
    fields: Vec<f64>,
}

impl Interpreter<'_, '_> {
    /// The results of a method's program, matrices by rows, one block after the other; `None` if the method has no
    /// program of its own and is left to the run time's loops.
    pub fn run(&self, method: Method, state: &State) -> Option<Vec<f64>> {
        let read = |input| match input {
            Input::Parameter(k) => self.roads.parameters[k],
            Input::Argument(Argument::Q, k) => state.q[k],
            Input::Argument(Argument::V, k) => state.v[k],
            Input::Argument(Argument::A, k) => state.a[k],
            Input::Argument(Argument::Tau, k) => state.tau[k],
        };
        let compiled = self.compiled.methods.iter().find(|compiled| compiled.method == method)?;
        match &compiled.plan {
            Plan::StraightLine { program, .. } => Some(program.evaluate(read, &self.fields)),
            Plan::Loops { .. } | Plan::Table { .. } => None,
        }
    }
}

/// The equations of motion by differentiating the energies.
pub struct Lagrangian {
    tree: Tree<f64>,
}

/// The numbers of Lagrange's equations at a state.
#[derive(Clone, Debug)]
pub struct Motion {
    /// `T`
    pub kinetic_energy: f64,
    /// `V`
    pub potential_energy: f64,
    /// `M`, by rows.
    pub mass_matrix: Vec<f64>,
    /// `C`, by rows.
    pub coriolis_matrix: Vec<f64>,
    /// `G`
    pub gravity_forces: Vec<f64>,
    /// `τ`
    pub inverse_dynamics: Vec<f64>,
}

impl Lagrangian {
    /// Derives once, and evaluates at each state.
    pub fn at(&self, states: &[State]) -> Vec<Motion> {
        let (graph, coordinates, n) = (Graph::new(), self.tree.coordinates(), self.tree.dof());
        let [q, v, a] = [0..coordinates, coordinates..coordinates + n, coordinates + n..coordinates + 2 * n]
            .map(|range| {
                range.map(|k| SymbolId(u32::try_from(k).expect("a small robot"))).collect::<Vec<_>>()
            });
        let tree =
            self.tree.map(|x| Expr::from(Number::from_f64(x).expect("the robot's numbers are finite")));
        let derived = lagrange::derive(&graph, &tree, Coordinates { q: &q, v: &v, a: &a });
        states.iter().map(|state| evaluate(&graph, &derived, state)).collect()
    }
}

fn evaluate<'g>(graph: &'g Graph, derived: &Lagrange<'g>, state: &State) -> Motion {
    let inputs = [state.q.as_slice(), state.v.as_slice(), state.a.as_slice()].concat();
    let mut evaluator = Evaluator::new(graph, |symbol: SymbolId| inputs[symbol.0 as usize]);
    let mut values =
        |block: &[Expr<'g>]| block.iter().map(|&expr| evaluator.value(expr)).collect::<Vec<f64>>();
    let energies = values(&[derived.kinetic_energy, derived.potential_energy]);
    Motion {
        kinetic_energy: energies[0],
        potential_energy: energies[1],
        mass_matrix: values(&derived.mass_matrix.concat()),
        coriolis_matrix: values(&derived.coriolis_matrix.concat()),
        gravity_forces: values(&derived.gravity_forces),
        inverse_dynamics: values(&derived.inverse_dynamics),
    }
}
