//! `dynamics count FILE`: what each method costs.

use dynamics_codegen::mechanics::equations::Method;
use dynamics_codegen::passes::{CompiledMethod, Plan};
use dynamics_codegen::symbolic::Graph;

use crate::failure::Failure;
use crate::output::{print, table};
use crate::reading::InputArgs;
use crate::robot::{Robot, Wanted};

/// Count the operations of each method
///
/// `instr` are instructions, a product with its sum being one, and a sine with its cosine twenty; `chain` is the longest
/// chain of operations in cycles, of four for a sum or a product. No core takes less for a call on its own.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  dynamics count arm.urdf")]
pub(crate) struct Args {
    #[command(flatten)]
    input: InputArgs,
}

/// Runs the command.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let input = args.input.read()?;
    let graph = Graph::new();
    let robot = Robot::with_fields(&input, &graph, Wanted::All, &[])?;
    input.warn(&robot.report);
    let (of_robot, of_frames): (Vec<_>, Vec<_>) =
        robot.compiled.methods.iter().partition(|compiled| Method::OF_ROBOT.contains(&compiled.method));
    let row = |compiled: &&CompiledMethod<'_>| row(&robot, compiled);
    let rows: Vec<_> = std::iter::once(HEAD.map(str::to_owned).to_vec())
        .chain(of_robot.iter().map(row))
        .chain(std::iter::once(vec![]))
        .chain(of_frames.iter().map(row))
        .collect();
    print(&table("lrrrrrrrl", &rows))
}

/// The columns of the table.
pub(crate) const HEAD: [&str; 9] =
    ["method", "mul", "add", "div", "sqrt", "sin+cos", "instr", "chain", "form"];

/// What a method costs.
pub(crate) fn row(robot: &Robot<'_>, compiled: &CompiledMethod<'_>) -> Vec<String> {
    let frame = compiled.method.frame().and_then(|k| robot.tree.frames.get(k));
    let frame = frame.map_or(String::new(), |frame| format!("::<{}>", frame.name));
    let cost = compiled.cost;
    let (bounds, form) = match &compiled.plan {
        Plan::StraightLine { program, .. } => {
            ([program.instructions(), program.latency()].map(|bound| bound.to_string()), "straight line")
        }
        Plan::Loops { .. } => ([String::new(), String::new()], "loops"),
        Plan::Table { .. } => ([String::new(), String::new()], "recursion; about"),
    };
    let counts =
        [cost.multiplications, cost.additions, cost.divisions, cost.square_roots, cost.sines_and_cosines];
    let mut row = vec![format!("{}{frame}", compiled.method.name())];
    row.extend(counts.map(|count| count.to_string()));
    row.extend(bounds);
    row.push(form.to_owned());
    row
}
