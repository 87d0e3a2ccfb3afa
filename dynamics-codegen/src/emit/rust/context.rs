//! What Rust says in words of its own: literals of any scalar, fused products, and nested blocks.
//!
//! A function never has more than [`BLOCK`] statements in one block: rustc overflows its stack on flat runs of some
//! 2,600 in debug builds.

use std::fmt::Write as _;

use super::names::CALLED;
use crate::emit::body::{Language, Named, Statement, last_readers};
use crate::emit::branches::{BranchCode, SideBySide};
use crate::emit::names::{Names, component};
use crate::emit::text::{Binding, Sums};
use crate::mechanics::closed::ClosedForms;
use crate::mechanics::equations::Argument;
use crate::passes::Sizes;

/// The most statements in one block.
const BLOCK: usize = 250;

/// The most sines in one call: what the run time computes side by side.
const SINES: usize = 4;

/// How constants are written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Literals {
    /// `0.42`
    Plain,
    /// `T::of(0.42)`, by this function.
    Of(String),
}

/// What a body is made from.
pub(super) struct Context<'a> {
    /// The name of the companion.
    pub(super) companion: &'a str,
    /// The names of the companion's fields.
    pub(super) fields: &'a [String],
    /// The names of the parameters.
    pub(super) parameters: &'a [String],
    /// How constants are written.
    pub(super) literals: Literals,
    /// The sizes of the arguments.
    pub(super) sizes: Sizes,
    /// Whether something acts by itself: there is a P beside M, C and G.
    pub(super) is_passive: bool,
    /// The robot's equations as people write them, where these are short.
    pub(super) closed: Option<&'a ClosedForms>,
}

impl Language for Context<'_> {
    fn taken(&self) -> Vec<&str> {
        let fields = if self.fields.is_empty() { self.parameters } else { self.fields };
        let reserved = ["q", "v", "a", "tau", "self", "robot"].iter().chain(CALLED).copied();
        fields.iter().map(String::as_str).chain(reserved).collect()
    }

    fn parameter(&self, k: usize) -> String {
        self.parameters[k].clone()
    }

    fn field(&self, k: usize) -> String {
        self.fields[k].clone()
    }

    fn component(&self, argument: Argument, k: usize, names: &mut Names) -> String {
        names.fresh(&component(argument, k))
    }

    fn constant(&self, value: f64) -> (String, Binding) {
        let number = format!("{value:?}");
        match &self.literals {
            Literals::Of(function) => (format!("{function}({number})"), Binding::Atom),
            Literals::Plain if value < 0.0 => (number, Binding::Negation),
            Literals::Plain => (number, Binding::Atom),
        }
    }

    fn multiply_add(&self, a: &str, b: &str, c: &str) -> Option<String> {
        Some(format!("madd({a}, {b}, {c})"))
    }

    fn square_root(&self, a: &str) -> String {
        format!("sqrt({a})")
    }

    fn side_by_side(&self) -> Option<&dyn SideBySide> {
        Some(self)
    }

    fn sums(&self) -> Sums {
        Sums::Regrouped // fewer parentheses: generated code is read
    }

    fn layout(&self, statements: &[Statement], needed: &[usize], indent: usize) -> String {
        let mut lines = String::new();
        let pad = |levels: usize| "    ".repeat(levels);
        if statements.len() <= BLOCK {
            write_bindings(&mut lines, statements, 0, &pad(indent));
            return lines;
        }
        let last_reader = last_readers(statements, needed);
        for (block, chunk) in statements.chunks(BLOCK).enumerate() {
            let end = (block + 1) * BLOCK;
            let leaving: Vec<&str> = (block * BLOCK..)
                .zip(chunk)
                .filter(|(k, _)| last_reader[*k] >= end)
                .flat_map(|(_, statement)| statement.names())
                .collect();
            let leaving = match leaving.as_slice() {
                [name] => (*name).to_owned(),
                names => format!("({})", names.join(", ")),
            };
            let _ = writeln!(lines, "{}let {leaving} = {{", pad(indent));
            write_bindings(&mut lines, chunk, block * BLOCK, &pad(indent + 1));
            let _ = writeln!(lines, "{}{leaving}", pad(indent + 1));
            let _ = writeln!(lines, "{}}};", pad(indent));
        }
        lines
    }
}

/// What is computed of each branch, by a call of the run time.
impl SideBySide for Context<'_> {
    fn constant(&self, value: f64) -> String {
        format!("S::of({value:?})")
    }

    fn own(&self, place: usize) -> String {
        format!("each.own({place})")
    }

    fn shared(&self, place: usize) -> String {
        format!("each.shared({place})")
    }

    fn give(&self, place: usize, value: &str) -> String {
        format!("each.give({place}, {value})")
    }

    fn row(&self, numbers: &[String]) -> String {
        format!("[{}]", numbers.join(", "))
    }

    fn one(&self, numbers: &str, branch: usize) -> String {
        format!("{numbers}[{branch}]")
    }

    fn call(&self, BranchCode { branches, statements, own, shared }: &BranchCode) -> String {
        format!(
            "{{
    struct Branch;
    impl Elementwise for Branch {{
        #[inline(always)]
        fn of<S: Scalar>(mut each: impl Branches<S>) {{
{}        }}
    }}
    of_each::<Branch, _, {branches}, _, _, _>(
        [
{}        ],
        [{}],
    )
}}",
            self.layout(statements, &[], 3),
            own.iter().fold(String::new(), |all, text| all + "            " + text + ",\n"),
            shared.join(", ")
        )
    }
}

/// A line for each statement, and one for all sines that stand together; `first` is the number of the first statement.
fn write_bindings(lines: &mut String, statements: &[Statement], first: usize, pad: &str) {
    let mut done = 0;
    while let Some(statement) = statements.get(done) {
        let is_sine =
            |next: &&Statement| matches!(next.named, Named::SinCos(..)) && !next.reads_from(first + done);
        let together = statements[done..].iter().take(SINES).take_while(is_sine).count();
        let _ = match together {
            0 | 1 => writeln!(lines, "{pad}{}", binding(statement).replace('\n', &format!("\n{pad}"))),
            _ => writeln!(lines, "{pad}{}", sines_together(&statements[done..done + together])),
        };
        done += together.max(1);
    }
}

/// `let e0 = …;`, or `let (s0, c0) = sin_cos(…);`
fn binding(Statement { named, value, .. }: &Statement) -> String {
    match named {
        Named::Value(name) => format!("let {name} = {value};"),
        Named::SinCos(sin, cos) => {
            let [sin, cos] = [sin, cos].map(read_or_not);
            format!("let ({sin}, {cos}) = sin_cos({value});")
        }
        Named::Rows(names) => format!("let [{}] = {value};", names.join(", ")),
        Named::Nothing => format!("{value};"),
    }
}

/// `let [[s0, s1], [c0, c1]] = sin_cos_each([…, …]);`
fn sines_together(statements: &[Statement]) -> String {
    let [mut sines, mut cosines, mut angles] = [const { Vec::new() }; 3];
    for Statement { named, value, .. } in statements {
        if let Named::SinCos(sin, cos) = named {
            sines.push(read_or_not(sin));
            cosines.push(read_or_not(cos));
            angles.push(value.as_str());
        }
    }
    let [sines, cosines, angles] = [sines, cosines, angles].map(|texts| texts.join(", "));
    format!("let [[{sines}], [{cosines}]] = sin_cos_each([{angles}]);")
}

fn read_or_not(name: &Option<String>) -> &str {
    name.as_deref().unwrap_or("_")
}
