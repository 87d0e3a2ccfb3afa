//! What C says in words of its own: literals of one type, a product and a sum, and a call for sine and cosine.

use std::fmt::Write as _;

use super::names::{ARGUMENTS, KEYWORDS, Robot};
use super::{Input, Real};
use crate::emit::body::{Language, Named, Statement};
use crate::emit::names::Names;
use crate::emit::text::{Binding, Sums};
use crate::mechanics::equations::Argument;

/// What a body is made from.
pub(super) struct Context<'a> {
    pub(super) robot: &'a Robot,
    pub(super) real: Real,
}

impl<'a> Context<'a> {
    pub(super) fn of(input: &Input<'_, '_>, robot: &'a Robot) -> Self {
        Self { robot, real: input.real }
    }

    /// A number; programs with one that is too large for the type are not written.
    pub(super) fn number(&self, value: f64) -> String {
        self.real.literal(value).expect("constants have been checked")
    }
}

impl Language for Context<'_> {
    fn taken(&self) -> Vec<&str> {
        [ARGUMENTS, KEYWORDS].concat()
    }

    fn parameter(&self, k: usize) -> String {
        format!("fields->{}", self.robot.parameters[k])
    }

    fn parameter_name(&self, k: usize) -> String {
        self.robot.parameters[k].clone()
    }

    fn field(&self, k: usize) -> String {
        format!("robot->{}", self.robot.fields[k])
    }

    fn component(&self, argument: Argument, k: usize, _: &mut Names) -> String {
        format!("{}[{k}]", argument.name())
    }

    fn constant(&self, value: f64) -> (String, Binding) {
        (self.number(value), if value < 0.0 { Binding::Negation } else { Binding::Atom })
    }

    fn multiply_add(&self, _: &str, _: &str, _: &str) -> Option<String> {
        None // a compiler contracts it where the machine has an instruction
    }

    fn square_root(&self, a: &str) -> String {
        format!("{}({a})", self.robot.size("SQRT"))
    }

    fn sums(&self) -> Sums {
        Sums::Explicit // what C computes is what the interpreter does, to the last bit
    }

    fn layout(&self, statements: &[Statement], _: &[usize], indent: usize) -> String {
        let (pad, real) = ("    ".repeat(indent), self.real.name());
        let mut lines = String::new();
        let is_ignored = |statement: &Statement| match &statement.named {
            Named::Value(_) => false,
            Named::SinCos(sin, cos) => sin.is_none() || cos.is_none(),
            Named::Rows(_) | Named::Nothing => false,
        };
        if statements.iter().any(is_ignored) {
            let _ = writeln!(lines, "{pad}{real} ignored;");
        }
        for Statement { named, value, .. } in statements {
            let _ = match named {
                Named::Value(name) => writeln!(lines, "{pad}const {real} {name} = {};", value),
                Named::SinCos(sin, cos) => {
                    for name in sin.iter().chain(cos) {
                        let _ = writeln!(lines, "{pad}{real} {name};");
                    }
                    let [sin, cos] = [sin, cos].map(|name| name.as_deref().unwrap_or("ignored"));
                    writeln!(lines, "{pad}{}({value}, &{sin}, &{cos});", self.robot.size("SIN_COS"))
                }
                Named::Rows(_) | Named::Nothing => unreachable!("nothing is side by side here"),
            };
        }
        lines
    }
}
