//! The ring in which equal expressions are equal polynomials: symbols, and sines and cosines of independent angles,
//! modulo `sin² + cos² = 1`, unit quaternions modulo the sum of their squares, roots modulo theirs.
//!
//! All work is counted, and ends where there is too much of it.

use super::Notation;
use super::monomial::{Monomial, VARIABLES};
use super::polynomial::Polynomial;
use crate::symbolic::{Number, SymbolId};

/// The expression is too large to be multiplied out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Swelling;

impl std::fmt::Display for Swelling {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("the expression is too large to be multiplied out")
    }
}

impl std::error::Error for Swelling {}

/// What is multiplied out, or the sign that it is too much.
pub(super) type Result<T> = std::result::Result<T, Swelling>;

/// What a variable of polynomials is.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Variable {
    /// π
    Pi,
    /// An input.
    Symbol(SymbolId),
    /// The sine of an angle, a polynomial.
    Sin(Polynomial),
    /// The cosine of an angle.
    Cos(Polynomial),
    /// The root of a polynomial.
    Root(Polynomial),
    /// One over a polynomial of several terms, the first of which is a monomial with the coefficient one.
    Inverse(Polynomial),
}

/// The variables, and what their squares are.
pub(super) struct Ring {
    variables: Vec<Variable>,
    /// Variables whose squares are polynomials in others.
    squares: Vec<(usize, Polynomial)>,
    /// Products of terms that may still be made.
    work: usize,
}

impl Ring {
    /// The ring of the symbols that are used, in their order, with work for so many products of terms.
    pub(super) fn new(notation: &Notation, used: &[SymbolId], work: usize) -> Result<Self> {
        let mut ring = Self { variables: vec![Variable::Pi], squares: vec![], work };
        for &symbol in used {
            ring.variable(Variable::Symbol(symbol))?;
        }
        for quaternion in notation.quaternions() {
            let places: Vec<_> = quaternion.iter().map(|&k| ring.place(&Variable::Symbol(k))).collect();
            if places.iter().all(Option::is_none) {
                continue;
            }
            let mut terms = vec![(Monomial::ONE, Number::ONE)];
            for &component in &quaternion[..3] {
                let place = ring.variable(Variable::Symbol(component))?;
                terms.push((Monomial::power(place, 2), -Number::ONE));
            }
            let real = ring.variable(Variable::Symbol(quaternion[3]))?;
            ring.squares.push((real, Polynomial::of_terms(terms)));
        }
        Ok(ring)
    }

    /// What the variables are.
    pub(super) fn variables(&self) -> &[Variable] {
        &self.variables
    }

    /// The place of a variable, if it is known.
    pub(super) fn place(&self, variable: &Variable) -> Option<usize> {
        self.variables.iter().position(|known| known == variable)
    }

    /// The place of a variable, which is new perhaps.
    pub(super) fn variable(&mut self, variable: Variable) -> Result<usize> {
        if let Some(known) = self.place(&variable) {
            return Ok(known);
        }
        if self.variables.len() == VARIABLES {
            return Err(Swelling);
        }
        self.variables.push(variable);
        Ok(self.variables.len() - 1)
    }

    /// The sine and the cosine of an angle, two variables.
    pub(super) fn angle(&mut self, angle: &Polynomial) -> Result<[usize; 2]> {
        let cos = self.variable(Variable::Cos(angle.clone()))?;
        let is_new = self.place(&Variable::Sin(angle.clone())).is_none();
        let sin = self.variable(Variable::Sin(angle.clone()))?;
        if is_new {
            let terms = vec![(Monomial::ONE, Number::ONE), (Monomial::power(cos, 2), -Number::ONE)];
            self.squares.push((sin, Polynomial::of_terms(terms)));
        }
        Ok([sin, cos])
    }

    /// A number, with its powers of π as a variable.
    pub(super) fn number(value: Number) -> Polynomial {
        match value {
            Number::Exact(exact) if exact.pi_power() != 0 => {
                let power = i32::from(exact.pi_power());
                let unit = if power > 0 { Number::PI } else { Number::ONE / Number::PI };
                let rest = (0..power.abs()).fold(value, |rest, _| rest / unit);
                Polynomial::term(Monomial::power(0, power), rest)
            }
            _ => Polynomial::term(Monomial::ONE, value),
        }
    }

    /// A variable, by its place.
    pub(super) fn polynomial(place: usize) -> Polynomial {
        Polynomial::term(Monomial::power(place, 1), Number::ONE)
    }

    /// `a·b`
    pub(super) fn product(&mut self, a: &Polynomial, b: &Polynomial) -> Result<Polynomial> {
        self.work = self.work.checked_sub(a.len() * b.len()).ok_or(Swelling)?;
        let mut terms = Vec::with_capacity(a.len() * b.len());
        for &(left, k) in a.terms() {
            for &(right, l) in b.terms() {
                self.reduce(left.times(&right).ok_or(Swelling)?, k * l, &mut terms)?;
            }
        }
        Ok(Polynomial::of_terms(terms))
    }

    /// Adds a term, with what its squares are.
    fn reduce(
        &mut self,
        monomial: Monomial,
        coefficient: Number,
        terms: &mut Vec<(Monomial, Number)>,
    ) -> Result<()> {
        if coefficient.is_zero() {
            return Ok(());
        }
        let mut waiting = vec![(monomial, coefficient)];
        while let Some((monomial, coefficient)) = waiting.pop() {
            let mut k = 0;
            let reducible = loop {
                let Some((place, _)) = self.squares.get(k) else { break None };
                let exponent = monomial.exponent(*place);
                if exponent >= 2 {
                    break Some((k, monomial.with(*place, exponent - 2)));
                }
                k += 1;
            };
            let Some((square, rest)) = reducible else {
                terms.push((monomial, coefficient));
                continue;
            };
            let square = &self.squares[square].1;
            self.work = self.work.checked_sub(square.len()).ok_or(Swelling)?;
            for &(other, factor) in square.terms() {
                waiting.push((rest.times(&other).ok_or(Swelling)?, coefficient * factor));
            }
        }
        Ok(())
    }

    /// `1/a`: of one term a term, else a variable of its own. `None` of zero.
    pub(super) fn inverse(&mut self, a: &Polynomial) -> Result<Option<Polynomial>> {
        if a.is_zero() {
            return Ok(None);
        }
        let (leading, outside, inside) = self.parts(a).ok_or(Swelling)?;
        let mut inverse = Polynomial::term(Monomial::ONE, Number::ONE / leading);
        for (place, exponent) in outside.exponents() {
            // One over a sine is a sine over its square.
            let square =
                self.squares.iter().find(|(known, _)| *known == place).map(|(_, square)| square.clone());
            let factor = match square {
                Some(square) if exponent == 1 => {
                    let Some(below) = self.inverse(&square)? else { return Ok(None) };
                    self.product(&below, &Self::polynomial(place))?
                }
                _ => Polynomial::term(Monomial::power(place, -exponent), Number::ONE),
            };
            inverse = self.product(&inverse, &factor)?;
        }
        if let Some(inside) = inside {
            let place = self.variable(Variable::Inverse(inside))?;
            inverse = self.product(&inverse, &Self::polynomial(place))?;
        }
        Ok(Some(inverse))
    }

    /// A number, powers that all terms have in common, and what is left of several terms: a polynomial whose largest
    /// monomial has the coefficient one. `None` of zero, and where exponents are out of range.
    pub(super) fn parts(&self, a: &Polynomial) -> Option<(Number, Monomial, Option<Polynomial>)> {
        let &(first, leading) = a.terms().last()?;
        if a.len() == 1 {
            return Some((leading, first, None));
        }
        let shared = self.content(a);
        let by = shared.inverse()?;
        let terms = a.terms().iter().map(|(monomial, k)| Some((monomial.times(&by)?, *k / leading)));
        Some((leading, shared, Some(Polynomial::of_terms(terms.collect::<Option<_>>()?))))
    }

    /// The powers that all terms have in common, of variables whose squares are their own.
    fn content(&self, a: &Polynomial) -> Monomial {
        let mut content = Monomial::ONE;
        for variable in 0..self.variables.len() {
            let least = a.terms().iter().map(|(monomial, _)| monomial.exponent(variable)).min().unwrap_or(0);
            if !self.squares.iter().any(|(place, _)| *place == variable) {
                content = content.with(variable, least);
            }
        }
        content
    }

    /// `√a`, of a perfect square of one term, else a variable of its own.
    pub(super) fn root(&mut self, a: &Polynomial) -> Result<Polynomial> {
        if let Some(value) = a.as_number()
            && let Some(root) = value.sqrt()
        {
            return Ok(Self::number(root));
        }
        let place = self.variable(Variable::Root(a.clone()))?;
        if !self.squares.iter().any(|(known, _)| *known == place) {
            self.squares.push((place, a.clone()));
        }
        Ok(Self::polynomial(place))
    }

    /// `∂a/∂symbol`
    pub(super) fn derivative(&mut self, a: &Polynomial, symbol: SymbolId) -> Result<Polynomial> {
        let mut sum = Polynomial::zero();
        for place in 0..self.variables.len() {
            let mut partial = Vec::new();
            for (monomial, coefficient) in a.terms() {
                let exponent = monomial.exponent(place);
                if exponent != 0 {
                    let less = monomial.with(place, exponent - 1);
                    partial.push((less, *coefficient * Number::integer(exponent.into())));
                }
            }
            if !partial.is_empty() {
                let inner = self.derivative_of_variable(place, symbol)?;
                if !inner.is_zero() {
                    let term = self.product(&Polynomial::of_terms(partial), &inner)?;
                    sum = sum.plus(Number::ONE, &term);
                }
            }
        }
        Ok(sum)
    }

    fn derivative_of_variable(&mut self, place: usize, symbol: SymbolId) -> Result<Polynomial> {
        let minus = |p: Polynomial| p.scaled(-Number::ONE);
        Ok(match self.variables[place].clone() {
            Variable::Symbol(known) if known == symbol => Polynomial::one(),
            Variable::Pi | Variable::Symbol(_) => Polynomial::zero(),
            Variable::Sin(angle) => {
                let [_, cos] = self.angle(&angle)?;
                let inner = self.derivative(&angle, symbol)?;
                self.product(&Self::polynomial(cos), &inner)?
            }
            Variable::Cos(angle) => {
                let [sin, _] = self.angle(&angle)?;
                let inner = self.derivative(&angle, symbol)?;
                minus(self.product(&Self::polynomial(sin), &inner)?)
            }
            Variable::Root(square) => {
                let inner = self.derivative(&square, symbol)?.scaled(Number::ratio(1, 2));
                let Some(below) = self.inverse(&square)? else { return Err(Swelling) };
                let slope = self.product(&Self::polynomial(place), &below)?;
                self.product(&slope, &inner)?
            }
            Variable::Inverse(below) => {
                let inner = self.derivative(&below, symbol)?;
                let square = Polynomial::term(Monomial::power(place, 2), -Number::ONE);
                self.product(&square, &inner)?
            }
        })
    }
}
