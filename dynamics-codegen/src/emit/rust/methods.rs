//! One method: its signature, its documentation, its body.

use std::fmt::Write as _;

use super::context::Context;
use super::equations;
use super::loops::{by_loops, by_shared_loops, elimination_tree, shared_loops};
use crate::emit::body::{self, Body};
use crate::mechanics::equations::{Argument, Block, Input, Method, Shape};
use crate::passes::{CompiledMethod, Cost, Plan, Program, Sizes};

/// A method on its way into an impl.
pub(super) struct Written {
    /// The method.
    pub(super) method: Method,
    /// Its operations.
    pub(super) cost: Cost,
    /// Its text at the indentation of an impl's item.
    pub(super) text: String,
    /// The body that a bundle and its part share.
    pub(super) shared: Option<Shared>,
}

/// The body that a bundle and its part share.
pub(super) struct Shared {
    /// Its text, named as the bundle.
    pub(super) text: String,
    /// A type parameter of its own.
    pub(super) parameter: Option<&'static str>,
}

/// Writes a method; `scalar` is the name of its scalar type, `robot` that of the type it is a method of.
pub(super) fn write(
    compiled: &CompiledMethod<'_>,
    context: &Context<'_>,
    scalar: &str,
    robot: &str,
) -> Written {
    let CompiledMethod { method, plan, cost, shares } = compiled;
    let mut text = String::new();
    text.push_str(&documentation(*method, context));
    let operations = describe(*cost);
    let _ = match plan {
        Plan::Table { lanes, .. } => {
            let how = if lanes.is_some() { ", in lanes" } else { "" };
            writeln!(text, "    ///\n    /// By recursion over a table of links{how}: about {operations}.")
        }
        Plan::StraightLine { program, .. } if program.has_lanes() => writeln!(
            text,
            "    ///\n    /// {operations}; each `l…` has a number for every one of the branches that are alike, or of the \
             columns that are solved for."
        ),
        _ => writeln!(text, "    ///\n    /// {operations}."),
    };
    let mut shared = None;
    text.push_str(&match plan {
        Plan::StraightLine { blocks, program } => {
            let body = || straight_line(*method, blocks, program, context, scalar, robot);
            match *shares {
                None => body(),
                Some(bundle) => {
                    shared = (bundle == *method).then(|| Shared { text: body(), parameter: None });
                    by_shared(*method, bundle, scalar, context.sizes)
                }
            }
        }
        Plan::Loops { parents } => match *shares {
            None => by_loops(*method, parents, context.sizes, scalar),
            Some(bundle) => {
                shared = (bundle == *method).then(|| shared_loops(*method, parents, context.sizes, scalar));
                by_shared_loops(*method, bundle, scalar, context.sizes)
            }
        },
        Plan::Table { frame: None, lanes } => by_table(*method, lanes.as_deref(), scalar, context.sizes),
        Plan::Table { frame: Some((link, program)), .. } => {
            frame_by_table(*method, *link, program, context, scalar, robot)
        }
    });
    Written { method: *method, cost: *cost, text, shared }
}

/// The first lines of a method's documentation: what it is, and its closed form.
pub(super) fn documentation(method: Method, context: &Context<'_>) -> String {
    let mut text = format!("    /// {}\n", headline(method, context));
    let closed = equations::documentation(context.closed, method);
    if !closed.is_empty() {
        text.push_str("    ///\n");
    }
    for line in closed {
        let _ = writeln!(text, "    /// {line}");
    }
    text
}

fn straight_line(
    method: Method,
    blocks: &[Block<'_>],
    program: &Program,
    context: &Context<'_>,
    scalar: &str,
    robot: &str,
) -> String {
    let names = body::entry_names(blocks, context.sizes.inputs.dof);
    let body = body::write(program, &names, context, 2);
    let reads_robot = if body.fields.is_empty() { "_robot" } else { "robot" };
    let receiver = if takes_robot(method) { format!("{reads_robot}: &{robot}") } else { "&self".to_owned() };
    let mut text = signature(method, &receiver, scalar, context.sizes, &body) + "\n";
    text.push_str(&bindings(method, context, &body));
    if !body.statements.is_empty() {
        text.push('\n');
        text.push_str(&body.statements);
    }
    if !body.statements.is_empty() || !body.inputs.is_empty() || !body.fields.is_empty() {
        text.push('\n');
    }
    text.push_str(&result(method, blocks, &body));
    text.push_str("    }\n");
    text
}

/// Whether the method gives a value and its derivatives.
fn is_bundle(method: Method) -> bool {
    matches!(method, Method::InverseDynamicsWithDerivatives | Method::ForwardDynamicsWithDerivatives)
}

/// What the body is called that a bundle shares with its part. It is inlined into both: a copy of so many numbers that
/// were just written takes a third to a half of the time that computing them does.
pub(super) fn shared_name(bundle: Method) -> String {
    format!("__{}", bundle.name())
}

/// The body that calls the shared one, and drops the value if it is not asked for.
fn by_shared(method: Method, bundle: Method, scalar: &str, sizes: Sizes) -> String {
    let part = if method == bundle { "" } else { ".1" };
    format!(
        "    fn {}(&self{}) -> {} {{\n        self.{}({}){part}\n    }}\n",
        method.name(),
        typed_arguments(method, scalar, sizes),
        return_type(method, scalar, sizes),
        shared_name(bundle),
        pass_on(method)
    )
}

/// The body that leaves everything to the run time's recursion; in lanes, it is told by which tree to factor M.
fn by_table(method: Method, lanes: Option<&[Option<usize>]>, scalar: &str, sizes: Sizes) -> String {
    let arguments = typed_arguments(method, scalar, sizes);
    let solves = matches!(
        method,
        Method::InverseMassMatrix
            | Method::ForwardDynamicsDerivatives
            | Method::ForwardDynamicsWithDerivatives
    );
    let tree = lanes.filter(|_| solves);
    let (name, passed_on) = (method.name(), pass_on(method));
    let way = if lanes.is_some() { "in_lanes()." } else { "" };
    let by_tree = if tree.is_some() { ", tree" } else { "" };
    format!(
        "    fn {name}(&self{arguments}) -> {} {{\n{}        self.__table(|table| table.{way}{name}({passed_on}{by_tree}))\n    }}\n",
        return_type(method, scalar, sizes),
        tree.map(elimination_tree).unwrap_or_default(),
    )
}

/// The same for a frame, whose pose in its link is given along.
fn frame_by_table(
    method: Method,
    link: Option<usize>,
    program: &Program,
    context: &Context<'_>,
    scalar: &str,
    robot: &str,
) -> String {
    let body = body::write(program, &[], context, 2);
    let entries: Vec<&str> = body.results.iter().map(String::as_str).collect();
    let rows: Vec<String> = entries[..9].chunks(3).map(|row| format!("[{}]", row.join(", "))).collect();
    let mut text = format!(
        "    fn {}(robot: &{robot}{}) -> {} {{\n",
        method.name(),
        typed_arguments(method, scalar, context.sizes),
        return_type(method, scalar, context.sizes)
    );
    text.push_str(&bindings(method, context, &body));
    let _ = writeln!(
        text,
        "        robot.__table(|table| table.{}({link:?}, [{}], [{}], {}))\n    }}",
        method.name(),
        rows.join(", "),
        entries[9..].join(", "),
        pass_on(method)
    );
    text
}

/// Whether the method belongs to a frame, and is given the robot.
pub(super) fn takes_robot(method: Method) -> bool {
    method.frame().is_some()
}

/// The signature without the body.
pub(super) fn signature(method: Method, receiver: &str, scalar: &str, sizes: Sizes, body: &Body) -> String {
    let mut arguments = receiver.to_owned();
    for &argument in method.arguments() {
        let read =
            body.inputs.iter().any(|(input, _)| matches!(input, Input::Argument(a, _) if *a == argument));
        let underscore = if read { "" } else { "_" };
        let type_ = argument_type(argument, scalar, sizes);
        let _ = write!(arguments, ", {underscore}{}: {type_}", argument.name());
    }
    format!("    fn {}({arguments}) -> {} {{", method.name(), return_type(method, scalar, sizes))
}

/// `, q: &SVector<T, 7>, v: …`
pub(super) fn typed_arguments(method: Method, scalar: &str, sizes: Sizes) -> String {
    let typed =
        |&argument: &Argument| format!(", {}: {}", argument.name(), argument_type(argument, scalar, sizes));
    method.arguments().iter().map(typed).collect()
}

/// The type of an argument.
fn argument_type(argument: Argument, scalar: &str, sizes: Sizes) -> String {
    format!("&SVector<{scalar}, {}>", sizes.inputs.size(argument))
}

/// The type that a method returns.
pub(super) fn return_type(method: Method, scalar: &str, sizes: Sizes) -> String {
    let n = sizes.inputs.dof;
    match method {
        Method::MassMatrix | Method::CoriolisMatrix | Method::InverseMassMatrix => {
            format!("SMatrix<{scalar}, {n}, {n}>")
        }
        Method::GravityForces
        | Method::BiasForces
        | Method::PassiveForces
        | Method::InverseDynamics
        | Method::ForwardDynamics => format!("SVector<{scalar}, {n}>"),
        Method::KineticEnergy | Method::PotentialEnergy | Method::ElasticEnergy | Method::Lagrangian => {
            scalar.to_owned()
        }
        Method::EquationsOfMotion => format!("EquationsOfMotion<{scalar}, {n}>"),
        Method::InverseDynamicsDerivatives => format!("InverseDynamicsDerivatives<{scalar}, {n}>"),
        Method::ForwardDynamicsDerivatives => format!("ForwardDynamicsDerivatives<{scalar}, {n}>"),
        Method::InverseDynamicsWithDerivatives => {
            format!("(SVector<{scalar}, {n}>, InverseDynamicsDerivatives<{scalar}, {n}>)")
        }
        Method::ForwardDynamicsWithDerivatives => {
            format!("(SVector<{scalar}, {n}>, ForwardDynamicsDerivatives<{scalar}, {n}>)")
        }
        Method::Pose(_) => format!("Pose<{scalar}>"),
        Method::Jacobian(_) | Method::WorldJacobian(_) => format!("SMatrix<{scalar}, 6, {n}>"),
        Method::TotalMass => scalar.to_owned(),
        Method::CenterOfMass => format!("SVector<{scalar}, 3>"),
        Method::CenterOfMassJacobian => format!("SMatrix<{scalar}, 3, {n}>"),
        Method::CentroidalMomentum | Method::Velocity(_) | Method::Acceleration(_) => {
            format!("SVector<{scalar}, 6>")
        }
        Method::CentroidalMomentumMatrix => format!("SMatrix<{scalar}, 6, {n}>"),
        Method::Regressor => format!("SMatrix<{scalar}, {n}, {}>", sizes.parameters),
        Method::InertialParameters => format!("SVector<{scalar}, {}>", sizes.parameters),
        Method::BaseRegressor => format!("SMatrix<{scalar}, {n}, {}>", sizes.base_parameters),
        Method::BaseParameters => format!("SVector<{scalar}, {}>", sizes.base_parameters),
    }
}

fn headline(method: Method, context: &Context<'_>) -> String {
    let n = context.sizes.inputs.dof;
    match method {
        Method::MassMatrix => format!("`M(q)`: {n}×{n}, symmetric positive definite."),
        Method::CoriolisMatrix => format!("`C(q,v)`: {n}×{n}, with `Ṁ = C + Cᵀ`."),
        Method::GravityForces => "`G(q) = ∂V/∂q`, on the left-hand side.".to_owned(),
        Method::BiasForces if context.is_passive => "`C(q,v)·v + G(q) + P(q,v)`.".to_owned(),
        Method::BiasForces => "`C(q,v)·v + G(q)`.".to_owned(),
        Method::PassiveForces => {
            "`P(q,v)`: what dampers, friction, springs and terms of dissipation do, on the left-hand side."
                .to_owned()
        }
        Method::InverseDynamics if context.is_passive => "`τ = M·a + C·v + G + P`.".to_owned(),
        Method::InverseDynamics => "`τ = M·a + C·v + G`.".to_owned(),
        Method::ForwardDynamics if context.is_passive => "`a = M⁻¹·(τ − C·v − G − P)`.".to_owned(),
        Method::ForwardDynamics => "`a = M⁻¹·(τ − C·v − G)`.".to_owned(),
        Method::InverseMassMatrix => format!("`M(q)⁻¹`: {n}×{n}."),
        Method::KineticEnergy => "`T = ½ vᵀ·M·v`, J.".to_owned(),
        Method::PotentialEnergy => "`V(q)`, J.".to_owned(),
        Method::ElasticEnergy => {
            "The energy of springs in joints, J; no part of `V`, for their forces are in `P`.".to_owned()
        }
        Method::Lagrangian => "`L = T − V`, J.".to_owned(),
        Method::EquationsOfMotion => "`M(q)`, `C(q,v)` and `G(q)` in one.".to_owned(),
        Method::InverseDynamicsDerivatives => "`∂τ/∂q`, `∂τ/∂v` and `∂τ/∂a = M`.".to_owned(),
        Method::ForwardDynamicsDerivatives => "`∂a/∂q`, `∂a/∂v` and `∂a/∂τ = M⁻¹`.".to_owned(),
        Method::InverseDynamicsWithDerivatives => {
            "`τ`, and `∂τ/∂q`, `∂τ/∂v` and `∂τ/∂a = M`, in one.".to_owned()
        }
        Method::ForwardDynamicsWithDerivatives => {
            "`a`, and `∂a/∂q`, `∂a/∂v` and `∂a/∂τ = M⁻¹`, in one.".to_owned()
        }
        Method::TotalMass => "The mass of all that moves, kg.".to_owned(),
        Method::CenterOfMass => "The centre of mass in the world, m.".to_owned(),
        Method::CenterOfMassJacobian => format!("The Jacobian of the centre of mass: 3×{n}."),
        Method::CentroidalMomentum => {
            "The momentum about the centre of mass, linear first, in world axes.".to_owned()
        }
        Method::CentroidalMomentumMatrix => format!("The matrix that takes `v` to that momentum: 6×{n}."),
        Method::Regressor => "`Y(q,v,a)` of `τ = Y·π`.".to_owned(),
        Method::InertialParameters => "`π`: the parameters of the regressor.".to_owned(),
        Method::BaseRegressor => "The regressor of the parameters that can be told apart.".to_owned(),
        Method::BaseParameters => "The parameters that can be told apart.".to_owned(),
        Method::Pose(_) => "The frame's pose in the world.".to_owned(),
        Method::Jacobian(_) => {
            "The twist of the frame in its own axes for each joint's unit speed.".to_owned()
        }
        Method::WorldJacobian(_) => "The same in the world's axes.".to_owned(),
        Method::Velocity(_) => "The twist of the frame in its own axes.".to_owned(),
        Method::Acceleration(_) => "The rate of that twist.".to_owned(),
    }
}

/// `193 mul, 183 add, 7 sincos`
pub(super) fn describe(cost: Cost) -> String {
    let parts = [
        (cost.multiplications, "mul"),
        (cost.additions, "add"),
        (cost.divisions, "div"),
        (cost.square_roots, "sqrt"),
        (cost.sines_and_cosines, "sincos"),
    ];
    let parts: Vec<String> =
        parts.iter().filter(|(count, _)| *count > 0).map(|(count, name)| format!("{count} {name}")).collect();
    if parts.is_empty() { "No arithmetic".to_owned() } else { parts.join(", ") }
}

/// The lines that take inputs apart: `let [[q0, q1]] = q.data.0;`
fn bindings(method: Method, context: &Context<'_>, body: &Body) -> String {
    let mut lines = String::new();
    for &argument in method.arguments() {
        let component = |k: usize| {
            let input = Input::Argument(argument, k);
            body.inputs.iter().find(|(known, _)| *known == input).map_or("_", |(_, name)| name.as_str())
        };
        let components: Vec<&str> = (0..context.sizes.inputs.size(argument)).map(component).collect();
        if components.iter().any(|&name| name != "_") {
            let _ =
                writeln!(lines, "        let [[{}]] = {}.data.0;", shortened(&components), argument.name());
        }
    }
    let (name, receiver) = if takes_robot(method) { (context.companion, "robot") } else { ("Self", "self") };
    lines + &fields_binding(context, body, name, receiver, 2)
}

/// `let Self { k0, k1, .. } = *self;`, if any field is read.
pub(super) fn fields_binding(
    context: &Context<'_>,
    body: &Body,
    name: &str,
    receiver: &str,
    indent: usize,
) -> String {
    if body.fields.is_empty() {
        return String::new();
    }
    let mut fields = body.fields.clone();
    fields.sort_unstable();
    let names: Vec<&str> = fields.iter().map(|&k| context.fields[k].as_str()).collect();
    let rest = if names.len() < context.fields.len() { ", .." } else { "" };
    format!("{}let {name} {{ {}{rest} }} = *{receiver};\n", "    ".repeat(indent), names.join(", "))
}

/// `q0, q1, ..` where the last components are not read.
pub(super) fn shortened(components: &[&str]) -> String {
    let read = components.iter().rposition(|&name| name != "_").map_or(0, |last| last + 1);
    let mut text = components[..read].join(", ");
    if read < components.len() {
        text.push_str(", ..");
    }
    text
}

/// The expression that is returned.
fn result(method: Method, blocks: &[Block<'_>], body: &Body) -> String {
    let mut texts = body.results.iter().map(String::as_str);
    let mut block_text = |block: &Block<'_>, indent: usize| {
        let entries: Vec<&str> = texts.by_ref().take(block.entries.len()).collect();
        block_expression(block.shape, &entries, indent)
    };
    let structure = match method {
        Method::EquationsOfMotion => "EquationsOfMotion",
        Method::InverseDynamicsDerivatives | Method::InverseDynamicsWithDerivatives => {
            "InverseDynamicsDerivatives"
        }
        Method::ForwardDynamicsDerivatives | Method::ForwardDynamicsWithDerivatives => {
            "ForwardDynamicsDerivatives"
        }
        Method::Pose(_) => "Pose",
        _ => return format!("        {}\n", block_text(&blocks[0], 2)),
    };
    // A bundle is its first block and a structure of the others.
    let (first, blocks) = blocks.split_at(usize::from(is_bundle(method)));
    let indent = 2 + first.len();
    let pad = "    ".repeat(indent);
    let mut text = String::new();
    for block in first {
        let _ = writeln!(text, "        (\n{pad}{},", block_text(block, indent));
    }
    let _ = writeln!(text, "{pad}{structure} {{");
    for block in blocks {
        let _ = writeln!(text, "{pad}    {}: {},", block.name, block_text(block, indent + 1));
    }
    text.push_str(&pad);
    text.push_str(if is_bundle(method) { "},\n        )\n" } else { "}\n" });
    text
}

fn block_expression(shape: Shape, entries: &[&str], indent: usize) -> String {
    let pad = "    ".repeat(indent);
    match shape {
        Shape::Scalar => entries[0].to_owned(),
        Shape::Vector(_) => format!("vector([{}])", entries.join(", ")),
        Shape::Matrix(_, columns) => {
            let mut text = "columns([\n".to_owned();
            for column in 0..columns {
                let entries: Vec<&str> = entries.iter().skip(column).step_by(columns).copied().collect();
                let _ = writeln!(text, "{pad}    [{}],", entries.join(", "));
            }
            let _ = write!(text, "{pad}])");
            text
        }
    }
}

/// The arguments of a call that passes them on.
pub(super) fn pass_on(method: Method) -> String {
    method.arguments().iter().map(|argument| Argument::name(*argument)).collect::<Vec<_>>().join(", ")
}
