//! The source file: hooks, the kernel of sine and cosine, and the bodies.

use std::fmt::Write as _;

use super::functions::Function;
use super::loops::{self, filled};
use super::names::Robot;
use super::words::comment;
use super::{Input, Real, configuration, header};
use crate::passes::{Operation, Program};

const SINE_FLOAT: &str = include_str!("templates/sine_float.c");
const SINE_DOUBLE: &str = include_str!("templates/sine_double.c");

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
    let quaternions = configuration::has_quaternions(input);
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
    text.push_str(&hooks(robot, real, has_sines, has_roots));
    text.push_str(&configuration::helpers(input, robot));
    if robot.has_fields() {
        text.push_str(&configuration::prepare(input, robot));
    }
    text.push_str(&configuration::functions(input, robot));
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

/// What a firmware may have of its own, and what is there without it.
fn hooks(robot: &Robot, real: Real, has_sines: bool, has_roots: bool) -> String {
    if !has_sines && !has_roots {
        return String::new();
    }
    let (kernel, greatest) = match real {
        Real::Float => (SINE_FLOAT, "0"),
        Real::Double => (SINE_DOUBLE, "1"),
    };
    let root = if real == Real::Float { "sqrtf" } else { "sqrt" };
    let offers = [
        (has_sines, "  UPPER_SIN_COS(x, sine, cosine), as `void f(REAL x, REAL *sine, REAL *cosine)`"),
        (has_roots, "  UPPER_SQRT(x), as `REAL f(REAL x)`"),
    ];
    let mut lines = vec!["Hooks: `-DUPPER_HOOKS='\"file.h\"'` includes a file that may define".to_owned()];
    lines.extend(offers.iter().filter(|(is_there, _)| *is_there).map(|(_, line)| (*line).to_owned()));
    lines.push("and declares what these call.".to_owned());
    let mut text = comment(&lines) + "#ifdef UPPER_HOOKS\n#include UPPER_HOOKS\n#endif\n";
    if has_sines {
        text.push_str("#ifndef UPPER_SIN_COS\n#include <float.h>\n#include <stdint.h>\n#endif\n");
    }
    if has_roots {
        text.push_str("#ifndef UPPER_SQRT\n#include <math.h>\n#endif\n");
    }
    if has_roots {
        let _ = write!(text, "\n#ifndef UPPER_SQRT\n#define UPPER_SQRT(x) {root}(x)\n#endif\n");
    }
    if has_sines {
        let call = "#define UPPER_SIN_COS(x, sine, cosine) PREFIX_sin_cos((x), (sine), (cosine))";
        let _ = write!(text, "\n#ifndef UPPER_SIN_COS\n{call}\n\n{GUARDS}{kernel}#endif\n");
    }
    filled(&text.replace("GREATEST", greatest), robot, real) + "\n"
}
