//! From expressions to forms: multiplied out where that is short, else with names for what they share.

use super::expand::Expansion;
use super::item::Writer;
use super::ring::{Result, Swelling};
use super::share::shared;
use super::{Form, Notation};
use crate::symbolic::{Expr, Graph, SymbolId};

/// Expressions as they are written.
#[derive(Clone, Debug)]
pub struct Closed {
    /// Names for parts of the forms, and what they stand for, in an order in which each uses those before it alone. None
    /// where the forms are short enough without.
    pub definitions: Vec<(SymbolId, Form)>,
    /// One for each expression.
    pub forms: Vec<Form>,
}

/// What is not written any more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// How many products of terms may be made to multiply all out.
    pub work: usize,
    /// How many terms an expression may have when it is multiplied out.
    pub terms: usize,
    /// How many names there may be for parts of expressions.
    pub names: usize,
}

impl Limits {
    /// What a reader takes, and a procedural macro has the time for: some ten milliseconds, unoptimised.
    pub const READABLE: Self = Self { work: 60_000, terms: 60, names: 200 };
}

/// The closed forms of expressions in the symbols of `notation`: the normal form, where it is short. Where it is not, parts
/// that several expressions share have names, which `notation` gets.
///
/// # Errors
///
/// If there were more names than the limits allow.
pub fn close<'g>(
    graph: &'g Graph,
    notation: &mut Notation,
    exprs: &[Expr<'g>],
    limits: Limits,
) -> Result<Closed> {
    match multiplied_out(graph, notation, exprs, limits) {
        Ok(forms) => Ok(Closed { definitions: vec![], forms }),
        Err(Swelling) => shared(graph, notation, exprs, limits.names),
    }
}

fn multiplied_out<'g>(
    graph: &'g Graph,
    notation: &Notation,
    exprs: &[Expr<'g>],
    limits: Limits,
) -> Result<Vec<Form>> {
    let mut expansion = Expansion::new(graph, notation, exprs, limits.work)?;
    let polynomials = exprs.iter().map(|&expr| {
        let polynomial = expansion.polynomial(expr)?;
        if polynomial.len() > limits.terms { Err(Swelling) } else { Ok(polynomial) }
    });
    let polynomials = polynomials.collect::<Result<Vec<_>>>()?;
    let writer = Writer::new(notation, &expansion.ring);
    Ok(polynomials.iter().map(|polynomial| writer.form(polynomial)).collect())
}
