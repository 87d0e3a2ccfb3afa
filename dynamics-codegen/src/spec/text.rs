//! Formulas as text, for messages.

use std::fmt::{self, Write};

use super::{Formula, FormulaKind, Function, Moving};
use crate::symbolic::Number;

impl fmt::Display for Formula {
    /// As written, but for spaces.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.kind {
            FormulaKind::Number(value, unit) => {
                write!(f, "{}{}", plain(*value), unit.map_or("", |unit| unit.name))
            }
            FormulaKind::Name(name) => write!(f, "{name}"),
            FormulaKind::Negative(inner) => write!(f, "-{}", Operand(inner)),
            FormulaKind::Sum(terms) => {
                for (i, term) in terms.iter().enumerate() {
                    match (i, term.negative) {
                        (0, _) => {}
                        (_, false) => f.write_str(" + ")?,
                        (_, true) => f.write_str(" - ")?,
                    }
                    write!(f, "{}", Operand(&term.formula))?;
                }
                Ok(())
            }
            FormulaKind::Product(factors) => {
                for (i, factor) in factors.iter().enumerate() {
                    match (i, factor.divides) {
                        (0, _) => {}
                        (_, false) => f.write_str(" * ")?,
                        (_, true) => f.write_str(" / ")?,
                    }
                    match factor.formula.kind {
                        FormulaKind::Product(_) if factor.divides => write!(f, "({})", factor.formula)?,
                        _ => write!(f, "{}", Operand(&factor.formula))?,
                    }
                }
                Ok(())
            }
            FormulaKind::Call(function, argument) => write!(f, "{}({argument})", function.name()),
            FormulaKind::Power(base, exponent) => write!(f, "{}^{exponent}", Base(base)),
            FormulaKind::Moving(moving) => write!(f, "{moving}"),
        }
    }
}

/// A number as one would write it: without a fraction that is zero.
pub fn plain(value: Number) -> String {
    let text = value.to_string();
    text.strip_suffix(".0").map(str::to_owned).unwrap_or(text)
}

/// A part of a larger formula: sums are in parentheses, and what else needs them.
struct Operand<'a>(&'a Formula);

impl fmt::Display for Operand<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.kind {
            FormulaKind::Sum(_) => write!(f, "({})", self.0),
            _ => write!(f, "{}", self.0),
        }
    }
}

/// What is raised to a power: anything but an atom is in parentheses.
struct Base<'a>(&'a Formula);

impl fmt::Display for Base<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.kind {
            FormulaKind::Number(..)
            | FormulaKind::Name(_)
            | FormulaKind::Call(..)
            | FormulaKind::Moving(_) => write!(f, "{}", self.0),
            _ => write!(f, "({})", self.0),
        }
    }
}

impl fmt::Display for Moving {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Part(joint, part) => write!(f, "{joint}.{part}"),
            Self::Rate(of) => write!(f, "dot({of})"),
            Self::Distance(bodies) => write!(f, "distance({}, {})", bodies[0], bodies[1]),
            Self::Place(axis, body) => write!(f, "{}({body})", ["x", "y", "z"][*axis % 3]),
        }
    }
}

impl Function {
    /// The name as written.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Sqrt => "sqrt",
        }
    }
}

impl Formula {
    /// The text, cut where it gets long.
    pub fn short_text(&self) -> String {
        let mut text = Limited { text: String::new() };
        match write!(text, "{self}") {
            Ok(()) => text.text,
            Err(_) => text.text + "…",
        }
    }
}

/// A text of some 48 bytes at the most; more is an error, and stops the writer.
struct Limited {
    text: String,
}

impl Write for Limited {
    fn write_str(&mut self, part: &str) -> fmt::Result {
        if self.text.len() + part.len() > 48 {
            return Err(fmt::Error);
        }
        self.text.push_str(part);
        Ok(())
    }
}
