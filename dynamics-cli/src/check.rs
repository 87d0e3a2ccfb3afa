//! `dynamics check FILE`: what was read, and whether it can be a robot.

use dynamics_codegen::diagnostics::{Diagnostics, Place};
use dynamics_codegen::model::names::check_types;
use dynamics_codegen::model::{JointInfo, Limits, Motion, Parameter, Passive, Tree};
use dynamics_codegen::passes::Plan;
use dynamics_codegen::spec::urdf::Note;
use dynamics_codegen::spec::{Field, JointKind, JointSpec, RobotSpec, TermKind, TermSpec, plain, welded};
use dynamics_codegen::symbolic::{Evaluator, Graph, Number, SymbolId};

use crate::absence::{Absence, listed, rough_term};
use crate::failure::Failure;
use crate::generate::rust_name;
use crate::input::{Input, shown};
use crate::output::{print, table};
use crate::progress::Progress;
use crate::reading::InputArgs;
use crate::robot::{Robot, State, Wanted};
use crate::tree;

/// Say what a file describes, what was not used of it, and whether it can be a robot
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  dynamics check arm.urdf\n  xacro arm.xacro | dynamics check -")]
pub(crate) struct Args {
    #[command(flatten)]
    input: InputArgs,
}

/// Runs the command.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let input = args.input.read()?;
    let graph = Graph::new();
    let robot = Robot::with_fields(&input, &graph, Wanted::Possible, &[])?;
    let unwritten = unwritten(&input, &robot)?;
    let _progress = Progress::of("checking");
    let text = summary(args, &input, &robot, &graph, &unwritten);
    print(&text.split('\n').map(shown).collect::<Vec<_>>().join("\n"))
}

/// Why it cannot be written in Rust: of a struct that is a mistake, and a file may be for other uses.
fn unwritten(input: &Input, robot: &Robot<'_>) -> Result<Vec<String>, Failure> {
    let mut diags = Diagnostics::new();
    if input.item().is_some() {
        check_types(&robot.spec, &mut diags);
        return diags.check().map(|()| vec![]).map_err(|found| Failure::mistakes(found, input));
    }
    let ident = syn::Ident::new(&rust_name(&robot.report), robot.spec.ident.span());
    check_types(&RobotSpec { ident, ..robot.spec.clone() }, &mut diags);
    Ok(diags.take().into_iter().map(|found| found.message).collect())
}

fn summary<'g>(
    args: &Args,
    input: &Input,
    robot: &Robot<'g>,
    graph: &'g Graph,
    unwritten: &[String],
) -> String {
    let Robot { spec, report, .. } = robot;
    let name =
        report.robot.as_deref().map_or(String::new(), |name| format!(" `{}`", name.replace('\n', " ")));
    let mut text = format!("robot{name} in {}\n", input.name);
    let parts = match input.is_of_file() {
        true => counted(report.links, "link", "links"),
        false => counted(report.links, "body", "bodies"),
    };
    text += &format!("  {parts}, {}\n", joints(input, spec, report.joints));
    let facts = [Some(base(input, robot)), Some(freedom(robot)), Some(mass(robot)), parameters(robot)];
    for fact in facts.into_iter().flatten() {
        text += &format!("  {fact}\n");
    }
    text += "\ntree\n";
    text += &tree::draw(spec, &report.root);
    for (title, rows) in [
        ("fields", fields(robot)),
        ("joints", of_joints(robot)),
        ("followers", followers(spec)),
        ("passive", passive(robot)),
        ("terms", terms(spec)),
    ] {
        if !rows.is_empty() {
            text += &format!("\n{title}\n{rows}");
        }
    }
    text += "\nchecks\n";
    text += &checks(args, robot, graph);
    let unwritten: String = unwritten.iter().map(|why| format!("  code in Rust: {why}\n")).collect();
    let absent = absent(robot) + &unwritten;
    if !absent.is_empty() {
        text += &format!("\nabsent\n{absent}");
    }
    for (title, notes) in [
        ("suspicious", &report.suspicions),
        ("merged", &report.merged),
        ("ignored", &report.ignored),
        ("snapped", &report.snapped),
        ("remarks", &report.remarks),
    ] {
        text += &self::notes(title, notes, input);
    }
    text
}

pub(crate) fn counted(count: usize, one: &str, many: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {many}") }
}

/// The joints of the file, or of the struct: that of a free base is not one of them.
pub(crate) fn joints(input: &Input, spec: &RobotSpec, count: usize) -> String {
    let is_welded = welded(&spec.joints);
    let of_file = spec.joints.iter().zip(is_welded);
    let is_counted = |joint: &JointSpec| !input.is_of_file() || matches!(joint.place, Place::Text { .. });
    let of_file: Vec<_> = of_file.filter(|(joint, _)| is_counted(joint)).collect();
    let moving = of_file.iter().filter(|(joint, _)| joint.has_coordinates()).count();
    let following = of_file.iter().filter(|(joint, still)| joint.keys.mimic.is_some() && !still).count();
    let locked = of_file.iter().filter(|(joint, still)| joint.kind != JointKind::Fixed && *still).count();
    let fixed = count.saturating_sub(moving + following + locked);
    let parts = [(moving, "moving"), (following, "following"), (locked, "locked"), (fixed, "fixed")];
    let parts = parts.into_iter().filter(|(count, what)| *count > 0 || matches!(*what, "moving" | "fixed"));
    let parts: Vec<String> = parts.map(|(count, what)| format!("{count} {what}")).collect();
    format!("{} ({})", counted(count, "joint", "joints"), parts.join(", "))
}

/// How it is in the world.
pub(crate) fn base(input: &Input, robot: &Robot<'_>) -> String {
    if !input.is_of_file() {
        let carried = robot.spec.joints.iter().filter(|joint| joint.parent.text == "world");
        let names: Vec<String> =
            carried.map(|joint| format!("`{}`", joint.child.text.trim_start_matches('\0'))).collect();
        return format!("the world carries {}", names.join(", "));
    }
    let root = &robot.report.root;
    let of_root =
        robot.spec.joints.iter().find(|joint| joint.child.text == *root && joint.parent.text == "world");
    match of_root {
        Some(joint) if joint.kind == JointKind::Free => {
            format!("its base `{root}` is free, by the joint `{}`", joint.name)
        }
        _ if root.is_empty() => match input.item() {
            Some(_) => "its base is carried by a joint of the struct".to_owned(),
            None => "its base is carried by a joint of the command line".to_owned(),
        },
        _ => format!("its base `{root}` is fixed"),
    }
}

pub(crate) fn freedom(robot: &Robot<'_>) -> String {
    let (n, driven) = (robot.dof(), robot.model.actuated.len());
    let mut text = counted(n, "degree of freedom", "degrees of freedom");
    if robot.tree.coordinates() != n {
        text += &format!(" and {} coordinates", robot.tree.coordinates());
    }
    match driven {
        _ if driven == n => text,
        0 => text + ", none actuated",
        _ => text + &format!(", {driven} of them actuated"),
    }
}

/// The mass, exactly.
pub(crate) fn mass(robot: &Robot<'_>) -> String {
    let tree = &robot.model.tree;
    let mut moving = tree.links.iter().map(|link| link.inertia.mass.as_number());
    let moving = moving.try_fold(Number::ZERO, |sum, mass| Some(sum + mass?));
    let (Some(moving), Some(base)) = (moving, tree.base.mass.as_number()) else {
        return "its mass is that of its fields".to_owned();
    };
    let at_rest = if base.is_zero() { String::new() } else { format!(", {} kg of it at rest", plain(base)) };
    format!("{} kg{at_rest}", plain(moving + base))
}

/// How many parameters its regressor has, if it has one.
pub(crate) fn parameters(robot: &Robot<'_>) -> Option<String> {
    let compiled = &robot.compiled;
    match (compiled.base_parameter_names.len(), compiled.parameter_names.len()) {
        (_, 0) => None,
        (base, all) => Some(format!("{base} base parameters, of {all} parameters")),
    }
}

/// The fields: their units, and their numbers if they have any.
fn fields(robot: &Robot<'_>) -> String {
    let Robot { spec, model, .. } = robot;
    let row = |field: &Field| {
        let name = &field.name.text;
        let used = model.parameters.iter().find(|parameter| parameter.name == *name);
        let known = spec.known.iter().find(|(known, _)| known == name);
        let what = match (used, known) {
            (Some(Parameter { unit: Some(unit), .. }), _) if unit == "1" => {
                "rad, or a plain number".to_owned()
            }
            (Some(Parameter { unit: Some(unit), .. }), _) => unit.clone(),
            (Some(_), _) => "of a unit that its uses do not tell".to_owned(),
            (None, Some((_, number))) => plain(*number),
            (None, None) => "in no equation".to_owned(),
        };
        vec![name.clone(), what]
    };
    table("ll", &spec.fields.iter().map(row).collect::<Vec<_>>())
}

/// The joints with coordinates, their entries of q, v and u, and their limits.
fn of_joints(robot: &Robot<'_>) -> String {
    table(if is_plain(robot) { "lllrrrr" } else { "lllllrrrr" }, &joint_rows(robot))
}

/// Whether all joints have one entry of q, v and u each: then that of q is enough.
pub(crate) fn is_plain(robot: &Robot<'_>) -> bool {
    robot.tree.coordinates() == robot.dof() && robot.model.actuated.len() == robot.dof()
}

/// The rows of the table of joints, and before them its head.
pub(crate) fn joint_rows(robot: &Robot<'_>) -> Vec<Vec<String>> {
    let (inputs, is_plain) = (&robot.model.actuated, is_plain(robot));
    let entries = if is_plain { vec![""] } else { vec!["", "", ""] };
    let head = [entries, vec!["joint", "kind", "lower", "upper", "velocity", "effort"]].concat();
    let mut rows: Vec<Vec<String>> = vec![head.into_iter().map(str::to_owned).collect()];
    let moving = robot.spec.joints.iter().filter(|joint| joint.has_coordinates());
    for (info, joint) in robot.model.joints.iter().zip(moving) {
        let mut row = vec![tree::entries("q", &info.q)];
        if !is_plain {
            row.push(tree::entries("v", &info.v));
            let first = inputs.iter().position(|speed| info.v.contains(speed));
            row.push(first.map_or("no input".to_owned(), |u| tree::entries("u", &(u..u + info.v.len()))));
        }
        row.extend([info.name.clone(), joint.kind.name().to_owned()]);
        row.extend(limits(info, joint.kind));
        rows.push(row);
    }
    rows
}

/// Lower, upper, velocity, effort: of a joint of several degrees of freedom there are none.
fn limits(info: &JointInfo, kind: JointKind) -> [String; 4] {
    let [position, speed, force] =
        if kind == JointKind::Prismatic { ["m", "m/s", "N"] } else { ["rad", "rad/s", "N·m"] };
    let of = |value: fn(&Limits) -> f64, unit: &str| {
        let value = info.limits.first().map(value).filter(|value| value.is_finite());
        value.map_or("-".to_owned(), |value| format!("{value} {unit}"))
    };
    [
        of(|limits| limits.lower, position),
        of(|limits| limits.upper, position),
        of(|limits| limits.velocity, speed),
        of(|limits| limits.effort, force),
    ]
}

/// Joints that follow others, as `finger2 = -1·finger1 + 0.02`.
pub(crate) fn followers(spec: &RobotSpec) -> String {
    let is_welded = welded(&spec.joints);
    let following = spec.joints.iter().zip(is_welded).filter(|(_, still)| !still);
    let line = |(joint, _): (&JointSpec, bool)| {
        let leader = joint.keys.mimic.as_ref()?;
        let ratio =
            joint.keys.ratio.as_ref().map_or(String::new(), |ratio| format!("{}·", ratio.short_text()));
        let offset =
            joint.keys.offset.as_ref().map_or(String::new(), |offset| format!(" + {}", offset.short_text()));
        Some(format!("  {} = {ratio}{leader}{offset}\n", joint.name))
    };
    following.filter_map(line).collect()
}

/// What acts in joints by itself.
fn passive(robot: &Robot<'_>) -> String {
    let rows = passive_rows(robot);
    if rows.is_empty() { String::new() } else { table("lrrrr", &rows) }
}

/// The rows of the table of what acts in joints by itself, and before them its head; none if nothing does.
pub(crate) fn passive_rows(robot: &Robot<'_>) -> Vec<Vec<String>> {
    let mut rows = vec![];
    for (link, info) in robot.tree.links.iter().zip(&robot.model.links).filter(|(_, info)| info.acts) {
        let Passive { armature, damping, friction, stiffness, .. } = link.passive;
        let slides = link.motion == Motion::Prismatic;
        let units = match slides {
            true => ["kg", "N·s/m", "N", "N/m"],
            false => ["kg·m²", "N·m·s/rad", "N·m", "N·m/rad"],
        };
        let values = [armature, damping, friction, stiffness];
        if values == [0.0; 4] {
            continue;
        }
        let cell = |(value, unit): (f64, &str)| match value {
            0.0 => "-".to_owned(),
            value if value.is_nan() => "of fields".to_owned(),
            value => format!("{value} {unit}"),
        };
        rows.push([vec![info.joint.clone()], values.into_iter().zip(units).map(cell).collect()].concat());
    }
    if !rows.is_empty() {
        rows.insert(0, ["joint", "armature", "damping", "friction", "stiffness"].map(str::to_owned).to_vec());
    }
    rows
}

/// What is added to the energies, as `V + k / 2 * (r - r0)^2`.
pub(crate) fn terms(spec: &RobotSpec) -> String {
    let line = |term: &TermSpec| {
        let energy = match term.kind {
            TermKind::Potential => "V",
            TermKind::Dissipation => "D",
            TermKind::Kinetic => "T",
        };
        format!("  {energy} + {}\n", term.formula)
    };
    spec.terms.iter().map(line).collect()
}

/// The tree in doubles, with a value of its size for each field.
fn sample<'g>(robot: &Robot<'g>, graph: &'g Graph) -> Tree<f64> {
    let sample = |symbol: SymbolId| robot.model.parameters[symbol.0 as usize].sample;
    let mut evaluator = Evaluator::new(graph, sample);
    robot.model.tree.map(|expr| evaluator.value(expr))
}

/// What holds, since the robot was accepted.
fn checks<'g>(args: &Args, robot: &Robot<'g>, graph: &'g Graph) -> String {
    let inertias = match args.input.judges_inertias() {
        true if !robot.model.parameters.is_empty() => {
            "each body that moves has a possible inertia, where that is of numbers"
        }
        true => "each body that moves has a possible inertia",
        false => "inertias were not judged",
    };
    let is_flat = robot.tree.quaternions().next().is_none();
    let at = if is_flat { "at q = 0" } else { "at the neutral q" };
    let of = if robot.model.parameters.is_empty() { "" } else { ", for one choice of the fields" };
    let at = format!("{at}{of}");
    let (sample, neutral) = (sample(robot, graph), State::neutral(robot));
    let definite = match Absence::of_inverse(robot, &sample, &neutral) {
        None => format!("M(q) is positive definite {at}"),
        Some(why) => format!("{at}, {}: forward dynamics has no value there", why.fact()),
    };
    let rough = rough_term(&robot.spec, &sample, &neutral, |term| term.kind != TermKind::Kinetic);
    let rough =
        rough.map_or(String::new(), |why| format!("  {at}, {}: its force has no value there\n", why.fact()));
    let methods = &robot.compiled.methods;
    let (compared, loops): (Vec<_>, Vec<_>) =
        methods.iter().partition(|method| matches!(method.plan, Plan::StraightLine { .. }));
    let (compared, all) = (compared.len(), methods.len());
    let loops: Vec<_> = loops.iter().map(|method| method.method.name().to_owned()).collect();
    let others = match loops.is_empty() {
        true => String::new(),
        false => format!("; loops of the run time, which its tests compare: {}", listed(&loops)),
    };
    format!(
        "  {inertias}\n  {definite}\n{rough}  {compared} of {all} methods were run against the plain recursion, and \
         agree{others}\n"
    )
}

/// The methods that it does not get, and why.
fn absent(robot: &Robot<'_>) -> String {
    let line = |(why, methods): &(Absence, Vec<String>)| format!("  {}: {}\n", listed(methods), why.fact());
    Absence::of_methods(robot).iter().map(line).collect()
}

/// Notes under a title.
fn notes(title: &str, notes: &[Note], input: &Input) -> String {
    let lines: String = input.placed(notes).iter().map(|line| format!("  {line}\n")).collect();
    if lines.is_empty() { lines } else { format!("\n{title}\n{lines}") }
}
