//! Calculus in the normal form: derivatives, products and sums of polynomials, and what they look like.

use super::expand::Expansion;
use super::item::Writer;
use super::monomial::VARIABLES;
use super::ring::{Result, Ring, Swelling, Variable};
use super::{Form, Notation, Polynomial};
use crate::symbolic::{Expr, Graph, Number, SymbolId};

/// Expressions multiplied out, modulo what holds for sines and cosines: two of them are equal if their polynomials are,
/// and then they are written alike, whatever they were derived by.
///
/// This is exact where all constants are fractions, multiples of one root, and powers of π. Sums of different roots, and
/// sines of other numbers, are known to thirty digits, and are compared by these. Where something is divided by a sum, `1/(a + b)` is a symbol of its own: fractions are
/// cancelled by products, and not by sums.
pub struct Canonical<'g> {
    expansion: Expansion<'g>,
}

/// What is written in so many terms has this many times more at most when sines of sums are multiplied out.
const EXPANDED: usize = 4;

impl<'g> Canonical<'g> {
    /// How many symbols, sines, cosines, roots and quotients there can be at once.
    pub const MOST_SYMBOLS: usize = VARIABLES;

    /// The normal form for these expressions, and for what is made of them, with so many products of terms.
    ///
    /// # Errors
    ///
    /// If there are too many variables.
    pub fn new(graph: &'g Graph, notation: &Notation, exprs: &[Expr<'g>], work: usize) -> Result<Self> {
        Ok(Self { expansion: Expansion::new(graph, notation, exprs, work)? })
    }

    /// The normal form of an expression.
    ///
    /// # Errors
    ///
    /// If it is too much work.
    pub fn polynomial(&mut self, expr: Expr<'g>) -> Result<Polynomial> {
        self.expansion.polynomial(expr)
    }

    /// A symbol.
    ///
    /// # Errors
    ///
    /// If there are too many variables.
    pub fn symbol(&mut self, symbol: SymbolId) -> Result<Polynomial> {
        Ok(Ring::polynomial(self.expansion.ring.variable(Variable::Symbol(symbol))?))
    }

    /// `a·b`
    ///
    /// # Errors
    ///
    /// If it is too much work.
    pub fn product(&mut self, a: &Polynomial, b: &Polynomial) -> Result<Polynomial> {
        self.expansion.ring.product(a, b)
    }

    /// `∂a/∂symbol`
    ///
    /// # Errors
    ///
    /// If it is too much work.
    pub fn derivative(&mut self, a: &Polynomial, symbol: SymbolId) -> Result<Polynomial> {
        self.expansion.ring.derivative(a, symbol)
    }

    /// `Σ a_k·b_k`
    ///
    /// # Errors
    ///
    /// If it is too much work.
    pub fn dot(&mut self, a: &[Polynomial], b: &[Polynomial]) -> Result<Polynomial> {
        let mut sum = Polynomial::zero();
        for (a, b) in a.iter().zip(b).filter(|(a, b)| !a.is_zero() && !b.is_zero()) {
            sum = sum.plus(Number::ONE, &self.product(a, b)?);
        }
        Ok(sum)
    }

    /// How polynomials are written; of each no more than so many terms.
    ///
    /// # Errors
    ///
    /// If one is longer.
    pub fn forms(&self, notation: &Notation, polynomials: &[Polynomial], terms: usize) -> Result<Vec<Form>> {
        let writer = Writer::new(notation, &self.expansion.ring);
        let is_long = |polynomial: &Polynomial| {
            polynomial.len() > terms
                && (polynomial.len() > EXPANDED * terms || writer.terms(polynomial, terms) > terms)
        };
        if polynomials.iter().any(is_long) {
            return Err(Swelling);
        }
        Ok(polynomials.iter().map(|polynomial| writer.form(polynomial)).collect())
    }
}
