//! Functions on configurations: the neutral one, a step from one, and the way from one to another.

use std::fmt::Write as _;

use super::context::Context;
use super::header;
use super::loops::filled;
use super::names::Robot;
use super::{Input, Real};
use crate::emit::body;
use crate::model::Motion;

const BALL: &str = include_str!("templates/ball.c");
const FREE: &str = include_str!("templates/free.c");

/// The declaration of `neutral`.
pub(super) fn neutral(robot: &Robot, real: Real) -> String {
    format!("void {}_neutral({} q[{}])", robot.prefix, real.name(), robot.size("NQ"))
}

/// The declaration of `integrate`.
pub(super) fn integrate(robot: &Robot, real: Real) -> String {
    let (prefix, real, nq, nv) = (&robot.prefix, real.name(), robot.size("NQ"), robot.size("NV"));
    format!("void {prefix}_integrate(const {real} q[{nq}], const {real} delta[{nv}], {real} moved[{nq}])")
}

/// The declaration of `difference`.
pub(super) fn difference(robot: &Robot, real: Real) -> String {
    let (prefix, real, nq, nv) = (&robot.prefix, real.name(), robot.size("NQ"), robot.size("NV"));
    format!("void {prefix}_difference(const {real} q0[{nq}], const {real} q1[{nq}], {real} delta[{nv}])")
}

/// The static functions that the bodies call.
pub(super) fn helpers(input: &Input<'_, '_>, robot: &Robot) -> String {
    let frees = input.model.tree.links.iter().any(|link| link.motion == Motion::Free);
    let needed = [(has_quaternions(input), BALL), (frees, FREE)];
    let texts = needed.iter().filter(|(is_needed, _)| *is_needed);
    texts.map(|(_, template)| filled(template, robot, input.real) + "\n").collect()
}

/// Whether there are ball or free joints.
pub(super) fn has_quaternions(input: &Input<'_, '_>) -> bool {
    input.model.tree.quaternions().next().is_some()
}

/// All three functions.
pub(super) fn functions(input: &Input<'_, '_>, robot: &Robot) -> String {
    let context = Context::of(input, robot);
    let (zero, one) = (context.number(0.0), context.number(1.0));
    let mut text = format!(
        "{}\n{{\n{}",
        neutral(robot, input.real),
        each(&robot.size("NQ"), &format!("q[k] = {zero};"))
    );
    for first in input.model.tree.quaternions() {
        let _ = writeln!(text, "    q[{}] = {one};", first + 3);
    }
    let _ = writeln!(text, "}}\n\n{}\n{{", integrate(robot, input.real));
    text += &by_joints(input, robot, "moved[k] = q[k] + delta[k];", |motion, q, v| match motion {
        Motion::Ball => format!("{}_integrate_ball(&q[{q}], &delta[{v}], &moved[{q}]);", robot.prefix),
        Motion::Free => format!("{}_integrate_free(&q[{q}], &delta[{v}], &moved[{q}]);", robot.prefix),
        Motion::Revolute | Motion::Prismatic => format!("moved[{q}] = q[{q}] + delta[{v}];"),
    });
    let _ = writeln!(text, "}}\n\n{}\n{{", difference(robot, input.real));
    text += &by_joints(input, robot, "delta[k] = q1[k] - q0[k];", |motion, q, v| match motion {
        Motion::Ball => format!("{}_difference_ball(&q0[{q}], &q1[{q}], &delta[{v}]);", robot.prefix),
        Motion::Free => format!("{}_difference_free(&q0[{q}], &q1[{q}], &delta[{v}]);", robot.prefix),
        Motion::Revolute | Motion::Prismatic => format!("delta[{v}] = q1[{q}] - q0[{q}];"),
    });
    text + "}\n\n"
}

/// A loop over all coordinates where these are no quaternions; a line for each joint where some are.
fn by_joints(
    input: &Input<'_, '_>,
    robot: &Robot,
    of_coordinate: &str,
    of_joint: impl Fn(Motion, usize, usize) -> String,
) -> String {
    if input.compiled.inputs.coordinates == input.compiled.inputs.dof {
        return each(&robot.size("NQ"), of_coordinate);
    }
    let (mut text, mut next) = (String::new(), 0);
    for link in &input.model.tree.links {
        let (q, v) = (link.drive.q, link.drive.v);
        if q == next {
            next += link.motion.coordinates();
            let _ = writeln!(text, "    {}", of_joint(link.motion, q, v));
        } // else it follows another joint
    }
    text
}

fn each(count: &str, statement: &str) -> String {
    format!("    for (int k = 0; k < {count}; ++k) {{\n        {statement}\n    }}\n")
}

/// The work that depends on the fields alone.
pub(super) fn prepare(input: &Input<'_, '_>, robot: &Robot) -> String {
    let context = Context::of(input, robot);
    let program = &input.compiled.companion.preparation;
    let names = vec![String::new(); program.results.len()];
    let body = body::write(program, &names, &context, 1);
    let mut text = format!("{}\n{{\n{}", header::prepare(robot), body.statements);
    if !body.statements.is_empty() {
        text.push('\n');
    }
    for (field, value) in robot.fields.iter().zip(&body.results) {
        let _ = writeln!(text, "    robot->{field} = {value};");
    }
    text + "}\n\n"
}
