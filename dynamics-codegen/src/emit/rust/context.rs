//! What Rust says in words of its own: literals of any scalar, fused products, and nested blocks.
//!
//! A function never has more than [`BLOCK`] statements in one block: rustc overflows its stack on flat runs of some
//! 2,600 in debug builds.

use std::fmt::Write as _;

use super::names::CALLED;
use crate::emit::body::{Binding, Language, Named, Statement, last_readers};
use crate::emit::names::{Names, component};
use crate::mechanics::closed::ClosedForms;
use crate::mechanics::equations::Argument;
use crate::passes::Sizes;

/// The most statements in one block.
const BLOCK: usize = 250;

/// How constants are written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Literals {
    /// `0.42`
    Plain,
    /// `T::of(0.42)`
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
            Literals::Of(scalar) => (format!("{scalar}::of({number})"), Binding::Atom),
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

    fn regroups_sums(&self) -> bool {
        true // fewer parentheses: generated code is read
    }

    fn layout(&self, statements: &[Statement], needed: &[usize], indent: usize) -> String {
        let mut lines = String::new();
        let pad = |levels: usize| "    ".repeat(levels);
        if statements.len() <= BLOCK {
            for statement in statements {
                let _ = writeln!(lines, "{}{}", pad(indent), binding(statement));
            }
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
            for statement in chunk {
                let _ = writeln!(lines, "{}{}", pad(indent + 1), binding(statement));
            }
            let _ = writeln!(lines, "{}{leaving}", pad(indent + 1));
            let _ = writeln!(lines, "{}}};", pad(indent));
        }
        lines
    }
}

/// `let e0 = …;`, or `let (s0, c0) = sin_cos(…);`
fn binding(Statement { named, value, .. }: &Statement) -> String {
    match named {
        Named::Value(name) => format!("let {name} = {value};"),
        Named::SinCos(sin, cos) => {
            let [sin, cos] = [sin, cos].map(|name| name.as_deref().unwrap_or("_"));
            format!("let ({sin}, {cos}) = sin_cos({value});")
        }
    }
}
