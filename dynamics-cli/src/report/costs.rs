//! What each method costs.

use dynamics_codegen::mechanics::equations::Method;
use dynamics_view::page::{Section, Table};

use crate::count;
use crate::robot::Robot;

pub(super) fn section(robot: &Robot<'_>) -> Section {
    let [method, counts @ ..] = count::HEAD;
    let methods =
        robot.compiled.methods.iter().filter(|compiled| Method::OF_ROBOT.contains(&compiled.method));
    let rows = methods.map(|compiled| count::row(robot, compiled));
    let table = Table::new("Operations of one call", "lrrrrrrrl")
        .head([method].into_iter().chain(counts))
        .rows(rows.map(|mut row| {
            row[0] = format!("`{}`", row[0]);
            row
        }));
    Section::new("costs", "What it costs")
        .text(
            "The equations are compiled into straight-line code for exactly this robot: what is zero is not \
             multiplied, what is constant is computed once. These are the operations that are left.",
        )
        .table(table)
        .remark(
            "A product with its sum is one instruction (`instr`), a sine with its cosine twenty; `chain` is the \
             longest chain of operations in cycles, of four for a sum or a product: no core takes less for one call.",
        )
}
