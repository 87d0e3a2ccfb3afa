//! The functions: which ones there are, and of each its declaration, its comment and its body.

use std::fmt::Write as _;

use super::context::Context;
use super::names::Robot;
use super::words::{self, comment, describe, headline};
use super::{Input, loops};
use crate::emit::body;
use crate::mechanics::equations::{Argument, Block, Method, Shape};
use crate::passes::{CompiledMethod, Cost, Plan, Program};

/// A method that a robot is too large for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// The function that would have been.
    pub function: String,
    /// What it would have computed.
    pub headline: &'static str,
}

/// One function.
pub(super) struct Function {
    /// Its comment, with a line break at the end.
    pub(super) comment: String,
    /// Its declaration without a semicolon.
    pub(super) signature: String,
    /// Its body in braces.
    pub(super) body: String,
    /// Whether it is put together by loops over the rows of M.
    pub(super) has_loops: bool,
}

/// What a function returns through its last arguments.
struct Output {
    name: &'static str,
    shape: Shape,
}

impl Function {
    /// Those of all methods that have a program or are put together from such; and the methods that have none.
    pub(super) fn all(input: &Input<'_, '_>, robot: &Robot) -> (Vec<Self>, Vec<LeftOut>) {
        let (mut functions, mut left_out) = (vec![], vec![]);
        for compiled in &input.compiled.methods {
            match Self::of(compiled, input, robot) {
                Some(function) => functions.push(function),
                None => left_out.push(LeftOut {
                    function: robot.function(compiled.method),
                    headline: headline(compiled.method, has_terms(input)),
                }),
            }
        }
        (functions, left_out)
    }

    fn of(compiled: &CompiledMethod<'_>, input: &Input<'_, '_>, robot: &Robot) -> Option<Self> {
        let CompiledMethod { method, plan, cost, .. } = compiled;
        let (method, mut cost) = (*method, *cost);
        let outputs: Vec<Output> = match plan {
            Plan::StraightLine { blocks, .. } => blocks.iter().map(|block| output(method, block)).collect(),
            Plan::Loops { .. } => {
                let n = input.compiled.inputs.dof;
                let outputs = loops::outputs(method).iter().map(|&(name, is_square)| {
                    let shape = if is_square { Shape::Matrix(n, n) } else { Shape::Vector(n) };
                    Output { name, shape }
                });
                outputs.collect()
            }
            Plan::Table { .. } => return None,
        };
        let body = match (bundle(method, input), plan) {
            (Some(bundle), _) => {
                cost = bundle.cost;
                loops::forward_derivatives_of_bundle(robot, input.real)
            }
            (None, Plan::StraightLine { blocks, program }) => {
                straight_line(method, blocks, &outputs, program, input, robot)
            }
            (None, _) => loops::body(method, robot, input.real)?,
        };
        Some(Self {
            comment: function_comment(method, cost, input),
            signature: signature(method, &outputs, input, robot),
            body,
            has_loops: matches!(plan, Plan::Loops { .. }),
        })
    }
}

/// What the derivatives of `a` call, so that a program has one body for both: `a` is computed for them anyway, and is N
/// numbers beside 3·N². Those of `tau` have a body of their own, which does without it.
fn bundle<'a, 'g>(method: Method, input: &'a Input<'_, 'g>) -> Option<&'a CompiledMethod<'g>> {
    let is_bundle = |other: &&CompiledMethod<'_>| other.method == Method::ForwardDynamicsWithDerivatives;
    let wants = method == Method::ForwardDynamicsDerivatives;
    input
        .compiled
        .methods
        .iter()
        .find(is_bundle)
        .filter(|bundle| wants && !matches!(bundle.plan, Plan::Table { .. }))
}

fn output(method: Method, block: &Block<'_>) -> Output {
    let name = match method {
        Method::MassMatrix => "M",
        Method::InverseMassMatrix => "W",
        Method::CoriolisMatrix => "C",
        Method::GravityForces => "G",
        Method::PassiveForces => "f",
        Method::BiasForces | Method::CentroidalMomentum => "h",
        Method::InverseDynamics => "tau",
        Method::ForwardDynamics => "a",
        Method::CenterOfMass => "p",
        Method::CenterOfMassJacobian | Method::Jacobian(_) | Method::WorldJacobian(_) => "J",
        Method::CentroidalMomentumMatrix => "A",
        Method::Regressor | Method::BaseRegressor => "Y",
        Method::InertialParameters | Method::BaseParameters => "pi",
        Method::Velocity(_) => "twist",
        Method::Acceleration(_) => "rate",
        _ => words::result(block.name),
    };
    Output { name, shape: block.shape }
}

fn has_terms(input: &Input<'_, '_>) -> bool {
    !input.model.tree.terms.is_empty()
}

fn function_comment(method: Method, cost: Cost, input: &Input<'_, '_>) -> String {
    let mut lines = vec![headline(method, has_terms(input)).to_owned()];
    if let Some(frame) = method.frame() {
        let name = &input.model.tree.frames[frame].name;
        lines = vec![format!("Frame `{name}`. {}", lines[0])];
    }
    let names = match method {
        Method::Regressor | Method::InertialParameters => &input.compiled.parameter_names,
        Method::BaseRegressor | Method::BaseParameters => &input.compiled.base_parameter_names,
        _ => &vec![],
    };
    if matches!(method, Method::InertialParameters | Method::BaseParameters) {
        lines.extend(names.iter().enumerate().map(|(k, name)| format!("  pi[{k}] = {name}")));
    }
    lines.push(describe(cost));
    comment(&lines)
}

/// `void iiwa14_mass_matrix(const float q[IIWA14_NQ], float M[IIWA14_NV][IIWA14_NV])`
fn signature(method: Method, outputs: &[Output], input: &Input<'_, '_>, robot: &Robot) -> String {
    let real = input.real.name();
    let mut arguments = vec![];
    if robot.has_fields() {
        arguments.push(format!("const {}_robot *robot", robot.prefix));
    }
    for argument in method.arguments() {
        let size = if *argument == Argument::Q { "NQ" } else { "NV" };
        arguments.push(format!("const {real} {}[{}]", argument.name(), robot.size(size)));
    }
    let (rows_are_speeds, columns_are_speeds) = spans(method);
    let length = |n: usize, is_of_speeds| if is_of_speeds { robot.size("NV") } else { n.to_string() };
    let mut returned = "void";
    for Output { name, shape } in outputs {
        match *shape {
            Shape::Scalar => returned = real,
            Shape::Vector(n) => arguments.push(format!("{real} {name}[{}]", length(n, rows_are_speeds))),
            Shape::Matrix(rows, columns) => {
                let [rows, columns] = [length(rows, rows_are_speeds), length(columns, columns_are_speeds)];
                arguments.push(format!("{real} {name}[{rows}][{columns}]"));
            }
        }
    }
    if arguments.is_empty() {
        arguments.push("void".to_owned());
    }
    format!("{returned} {}({})", robot.function(method), arguments.join(", "))
}

/// Whether there is a row, and a column, of a method's results for each speed.
fn spans(method: Method) -> (bool, bool) {
    match method {
        Method::Pose(_)
        | Method::Velocity(_)
        | Method::Acceleration(_)
        | Method::CenterOfMass
        | Method::CentroidalMomentum
        | Method::InertialParameters
        | Method::BaseParameters => (false, false),
        Method::Jacobian(_)
        | Method::WorldJacobian(_)
        | Method::CenterOfMassJacobian
        | Method::CentroidalMomentumMatrix => (false, true),
        Method::Regressor | Method::BaseRegressor => (true, false),
        _ => (true, true),
    }
}

fn straight_line(
    method: Method,
    blocks: &[Block<'_>],
    outputs: &[Output],
    program: &Program,
    input: &Input<'_, '_>,
    robot: &Robot,
) -> String {
    let context = Context::of(input, robot);
    let names = body::entry_names(blocks, input.compiled.inputs.dof);
    let body = body::write(program, &names, &context, 1);
    let mut text = "{\n".to_owned();
    let reads = |argument: Argument| {
        let of = |input: &crate::mechanics::equations::Input| matches!(input, crate::mechanics::equations::Input::Argument(a, _) if *a == argument);
        body.inputs.iter().any(|(input, _)| of(input))
    };
    let mut unread: Vec<&str> = vec![];
    if robot.has_fields() && body.fields.is_empty() {
        unread.push("robot");
    }
    unread.extend(method.arguments().iter().filter(|a| !reads(**a)).map(|a| a.name()));
    text.push_str(&body.statements);
    for name in unread {
        let _ = writeln!(text, "    (void){name};");
    }
    if text.len() > 2 {
        text.push('\n');
    }
    let mut results = body.results.iter();
    for (block, Output { name, shape }) in blocks.iter().zip(outputs) {
        for (k, result) in results.by_ref().take(block.entries.len()).enumerate() {
            let _ = match *shape {
                Shape::Scalar => writeln!(text, "    return {result};"),
                Shape::Vector(_) => writeln!(text, "    {name}[{k}] = {result};"),
                Shape::Matrix(_, columns) => {
                    writeln!(text, "    {name}[{}][{}] = {result};", k / columns, k % columns)
                }
            };
        }
    }
    text + "}\n"
}
