//! The source file: hooks, the kernel of sine and cosine, and the bodies.

use std::fmt::Write as _;

use super::context::Context;
use super::functions::Function;
use super::loops::{self, filled};
use super::names::Robot;
use super::words::comment;
use super::{Input, Real, header};
use crate::emit::body;
use crate::model::Motion;
use crate::passes::{Operation, Program};

const SINE_FLOAT: &str = include_str!("templates/sine_float.c");
const SINE_DOUBLE: &str = include_str!("templates/sine_double.c");
const BALL: &str = include_str!("templates/ball.c");
const FREE: &str = include_str!("templates/free.c");

/// What would change the results of the kernel is refused before it does.
const GUARDS: &str = "\
#if defined(__FAST_MATH__)
#error \"compile PREFIX.c without -ffast-math: it would round away what the sine's reduction keeps\"
#endif
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD > GREATEST
#error \"PREFIX.c needs arithmetic in REAL, as with -msse2 -mfpmath=sse; or give it a UPPER_SIN_COS of your own\"
#endif

";

/// Writes the file.
pub(super) fn write(input: &Input<'_, '_>, robot: &Robot, functions: &[Function]) -> String {
    let Input { real, .. } = *input;
    let quaternions = input.model.tree.quaternions().next().is_some();
    let has = |wanted: fn(&Operation) -> bool| {
        input
            .compiled
            .programs()
            .any(|program: &Program| program.steps.iter().any(|step| wanted(&step.operation)))
    };
    let has_sines = quaternions || has(|operation| matches!(operation, Operation::SinCos(..)));
    let has_roots = quaternions || has(|operation| matches!(operation, Operation::Sqrt(..)));

    let mut text = header::banner(input);
    let _ = writeln!(text, "#include \"{}.h\"\n", robot.prefix);
    if has_sines {
        text.push_str(&sine(robot, real));
    }
    if has_roots {
        text.push_str(&root(robot, real));
    }
    let frees = input.model.tree.links.iter().any(|link| link.motion == Motion::Free);
    for (needed, template) in [(quaternions, BALL), (frees, FREE)] {
        if needed {
            text.push_str(&filled(template, robot, real));
            text.push('\n');
        }
    }
    if robot.has_fields() {
        text.push_str(&prepare(input, robot));
    }
    text.push_str(&configuration(input, robot));
    let is_looped = |function: &&Function| function.has_loops;
    let (looped, straight): (Vec<_>, Vec<_>) = functions.iter().partition(is_looped);
    for function in straight {
        let _ = writeln!(text, "{}{}\n{}", function.comment, function.signature, function.body);
    }
    if !looped.is_empty() {
        text.push_str(&loops::helpers(robot, real));
    }
    for function in looped {
        let _ = writeln!(text, "{}{}\n{}", function.comment, function.signature, function.body);
    }
    text.truncate(text.trim_end().len());
    text.push('\n');
    text
}

/// The hook for sine and cosine, and what it is without one.
fn sine(robot: &Robot, real: Real) -> String {
    let (kernel, greatest) = match real {
        Real::Float => (SINE_FLOAT, "0"),
        Real::Double => (SINE_DOUBLE, "1"),
    };
    let hook = comment(&[
        "A hook: `-DUPPER_SIN_COS=f` calls `void f(REAL x, REAL *sine, REAL *cosine)`, as sincosf".to_owned(),
        "of the GNU C library is.".to_owned(),
    ]);
    let text = format!(
        "{hook}#ifndef UPPER_SIN_COS\n#define UPPER_SIN_COS(x, sine, cosine) PREFIX_sin_cos((x), (sine), (cosine))\n\n\
         #include <float.h>\n#include <stdint.h>\n\n{GUARDS}{kernel}#endif\n\n"
    );
    filled(&text.replace("GREATEST", greatest), robot, real)
}

/// The hook for square roots.
fn root(robot: &Robot, real: Real) -> String {
    let function = if real == Real::Float { "sqrtf" } else { "sqrt" };
    let hook = comment(&["A hook: `-DUPPER_SQRT=f` calls `REAL f(REAL x)`.".to_owned()]);
    let text = format!(
        "{hook}#ifndef UPPER_SQRT\n#include <math.h>\n#define UPPER_SQRT(x) {function}(x)\n#endif\n\n"
    );
    filled(&text, robot, real)
}

/// The work that depends on the fields alone.
fn prepare(input: &Input<'_, '_>, robot: &Robot) -> String {
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

/// `neutral`, `integrate`.
fn configuration(input: &Input<'_, '_>, robot: &Robot) -> String {
    let context = Context::of(input, robot);
    let (zero, one) = (context.number(0.0), context.number(1.0));
    let quaternions: Vec<usize> = input.model.tree.quaternions().map(|first| first + 3).collect();
    let mut text = format!(
        "{}\n{{\n    for (int k = 0; k < {}; ++k) {{\n        q[k] = {zero};\n    }}\n",
        header::neutral(robot, input.real),
        robot.size("NQ")
    );
    for w in quaternions {
        let _ = writeln!(text, "    q[{w}] = {one};");
    }
    let _ = writeln!(text, "}}\n\n{}\n{{", header::integrate(robot, input.real));
    if input.compiled.inputs.coordinates == input.compiled.inputs.dof {
        let n = robot.size("NQ");
        let _ = writeln!(
            text,
            "    for (int k = 0; k < {n}; ++k) {{\n        moved[k] = q[k] + delta[k];\n    }}"
        );
    } else {
        let mut next = 0;
        for link in &input.model.tree.links {
            let (q, v) = (link.drive.q, link.drive.v);
            if q != next {
                continue; // it follows another joint
            }
            next += link.motion.coordinates();
            let prefix = &robot.prefix;
            let _ = match link.motion {
                Motion::Ball => {
                    writeln!(text, "    {prefix}_integrate_ball(q + {q}, delta + {v}, moved + {q});")
                }
                Motion::Free => {
                    writeln!(text, "    {prefix}_integrate_free(q + {q}, delta + {v}, moved + {q});")
                }
                Motion::Revolute | Motion::Prismatic => {
                    writeln!(text, "    moved[{q}] = q[{q}] + delta[{v}];")
                }
            };
        }
    }
    text + "}\n\n"
}
