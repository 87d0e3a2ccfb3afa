//! From expressions to forms.

use super::{Form, Notation, of};
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

/// The closed forms of expressions in the symbols of `notation`, which gets the names of intermediates.
pub fn close<'g>(graph: &'g Graph, _notation: &mut Notation, exprs: &[Expr<'g>]) -> Closed {
    const PARTS: usize = 10_000;
    let forms = exprs.iter().map(|&expr| of(graph, expr, PARTS).unwrap_or(Form::ZERO)).collect();
    Closed { definitions: vec![], forms }
}
