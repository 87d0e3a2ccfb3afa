//! `dynamics check FILE`: what was read, and whether it can be a robot.

use dynamics_codegen::diagnostics::Place;
use dynamics_codegen::mechanics::equations::Method;
use dynamics_codegen::mechanics::plain::{Cholesky, Oracle};
use dynamics_codegen::passes::Plan;
use dynamics_codegen::spec::urdf::Note;
use dynamics_codegen::spec::{JointKind, RobotSpec, plain, welded};
use dynamics_codegen::symbolic::{Graph, Number};

use crate::failure::Failure;
use crate::input::{Input, InputArgs, shown};
use crate::output::{print, table};
use crate::robot::{Read, Robot, Wanted};
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
    let robot = Robot::of(&input, &graph, Wanted::Only(&Method::OF_ROBOT))?;
    let text = summary(&input, &robot);
    print(&text.split('\n').map(shown).collect::<Vec<_>>().join("\n"))
}

fn summary(input: &Input, robot: &Robot<'_>) -> String {
    let read = &robot.read;
    let Read { spec, report, .. } = read;
    let name =
        report.robot.as_deref().map_or(String::new(), |name| format!(" `{}`", name.replace('\n', " ")));
    let mut text = format!("robot{name} in {}\n", input.name);
    text += &format!("  {}, {}\n", counted(report.links, "link", "links"), joints(spec, report.joints));
    text += &format!("  {}\n", counted(read.model.tree.dof(), "degree of freedom", "degrees of freedom"));
    text += &format!("  {}\n", mass(read));
    text += "\ntree\n";
    text += &tree::draw(spec, &report.root);
    text += "\njoints\n";
    text += &limits(read);
    text += "\nchecks\n";
    text += &checks(input, robot);
    for (title, notes) in [
        ("merged", &report.merged),
        ("ignored", &report.ignored),
        ("snapped", &report.snapped),
        ("remarks", &report.remarks),
    ] {
        text += &listed(title, notes);
    }
    text
}

fn counted(count: usize, one: &str, many: &str) -> String {
    if count == 1 { format!("1 {one}") } else { format!("{count} {many}") }
}

/// The joints of the file: that of a free base is not one of them.
fn joints(spec: &RobotSpec, count: usize) -> String {
    let of_file: Vec<_> =
        spec.joints.iter().filter(|joint| matches!(joint.place, Place::Text { .. })).collect();
    let moving = of_file.iter().filter(|joint| joint.has_coordinates()).count();
    let is_welded = welded(&spec.joints);
    let following = spec.joints.iter().zip(is_welded);
    let following = following.filter(|(joint, still)| joint.keys.mimic.is_some() && !still).count();
    let fixed = count.saturating_sub(moving + following);
    let followers = if following > 0 { format!("{following} following, ") } else { String::new() };
    format!("{} ({moving} moving, {followers}{fixed} fixed)", counted(count, "joint", "joints"))
}

/// The mass, exactly.
fn mass(read: &Read<'_>) -> String {
    let tree = &read.model.tree;
    let moving = tree.links.iter().filter_map(|link| link.inertia.mass.as_number());
    let moving = moving.fold(Number::ZERO, |sum, mass| sum + mass);
    let base = tree.base.mass.as_number().unwrap_or(Number::ZERO);
    let at_rest = if base.is_zero() { String::new() } else { format!(", {} kg of it at rest", plain(base)) };
    format!("{} kg{at_rest}", plain(moving + base))
}

fn limits(read: &Read<'_>) -> String {
    let head = ["", "joint", "kind", "lower", "upper", "velocity", "effort"].map(str::to_owned);
    let mut rows = vec![head.to_vec()];
    let moving = read.spec.joints.iter().filter(|joint| joint.has_coordinates());
    let limit = |value: f64, unit: &str| match value.is_finite() {
        true => format!("{value} {unit}"),
        false => "-".to_owned(),
    };
    for (info, joint) in read.model.joints.iter().zip(moving) {
        // A joint of several degrees of freedom has none.
        let Some(limits) = info.limits.first() else { continue };
        let slides = joint.kind == JointKind::Prismatic;
        let [unit, speed, force] = if slides { ["m", "m/s", "N"] } else { ["rad", "rad/s", "N·m"] };
        rows.push(vec![
            tree::entries(&info.q),
            info.name.clone(),
            joint.kind.name().to_owned(),
            limit(limits.lower, unit),
            limit(limits.upper, unit),
            limit(limits.velocity, speed),
            limit(limits.effort, force),
        ]);
    }
    table("lllrrrr", &rows)
}

/// What holds, since the robot was accepted.
fn checks(input: &Input, robot: &Robot<'_>) -> String {
    let tree = &robot.read.tree;
    let allowed = input.options.contains("nonphysical_inertia");
    let inertias =
        if allowed { "inertias were not judged" } else { "each body that moves has a possible inertia" };
    let mut q = vec![0.0; tree.coordinates()];
    tree.normalise(&mut q);
    let definite = match Cholesky::of(&Oracle::new(tree).mass_matrix(&q)) {
        Some(_) => "M(q) is positive definite at q = 0",
        None => "M(q) is NOT positive definite at q = 0: forward dynamics has no meaning there",
    };
    let methods = &robot.compiled.methods;
    let compared = methods.iter().filter(|method| matches!(method.plan, Plan::StraightLine { .. })).count();
    let all = methods.len();
    format!(
        "  {inertias}\n  {definite}\n  {compared} of {all} methods were run against the plain recursion, and agree\n"
    )
}

/// Notes in the order of the file.
fn listed(title: &str, notes: &[Note]) -> String {
    if notes.is_empty() {
        return String::new();
    }
    let mut text = format!("\n{title}\n");
    let mut notes: Vec<&Note> = notes.iter().collect();
    notes.sort_by_key(|note| match note.place {
        Place::Text { line, column, .. } => (line, column),
        Place::Tokens { .. } => (0, 0),
    });
    for note in notes {
        let place = match &note.place {
            Place::Text { file, line, column } => format!("{file}:{line}:{column}: "),
            Place::Tokens { .. } => String::new(),
        };
        text += &format!("  {place}{}\n", note.text);
    }
    text
}
