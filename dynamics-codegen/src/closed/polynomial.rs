//! Polynomials with exact coefficients: sums of monomials, in order, none twice.

use super::monomial::Monomial;
use crate::symbolic::Number;

/// A sum of terms, the smallest monomial first. Coefficients are not zero, and have no power of π.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Polynomial(Vec<(Monomial, Number)>);

impl Polynomial {
    /// 0
    pub fn zero() -> Self {
        Self(vec![])
    }

    /// 1
    pub(super) fn one() -> Self {
        Self::term(Monomial::ONE, Number::ONE)
    }

    /// One term.
    pub(super) fn term(monomial: Monomial, coefficient: Number) -> Self {
        if coefficient.is_zero() { Self::zero() } else { Self(vec![(monomial, coefficient)]) }
    }

    /// Sorts terms, and adds up those of one monomial.
    pub(super) fn of_terms(mut terms: Vec<(Monomial, Number)>) -> Self {
        if terms.len() > 1 {
            terms.sort_unstable_by_key(|(monomial, _)| *monomial);
        }
        let mut sum: Vec<(Monomial, Number)> = Vec::with_capacity(terms.len());
        for (monomial, coefficient) in terms {
            match sum.last_mut() {
                Some((last, total)) if *last == monomial => *total = *total + coefficient,
                _ => {
                    sum.pop_if(|(_, total)| total.is_zero());
                    sum.push((monomial, coefficient));
                }
            }
        }
        sum.pop_if(|(_, total)| total.is_zero());
        Self(sum)
    }

    /// The terms.
    pub(super) fn terms(&self) -> &[(Monomial, Number)] {
        &self.0
    }

    /// How many terms there are.
    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether it is 0.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The number that it is, if it has no variable.
    pub(super) fn as_number(&self) -> Option<Number> {
        match self.0.as_slice() {
            [] => Some(Number::ZERO),
            [(Monomial::ONE, value)] => Some(*value),
            _ => None,
        }
    }

    /// `self + k·other`
    pub fn plus(&self, k: Number, other: &Self) -> Self {
        let mut sum = Vec::with_capacity(self.len() + other.len());
        let (mut left, mut right) = (self.0.iter().peekable(), other.0.iter().peekable());
        loop {
            let order = match (left.peek(), right.peek()) {
                (Some((a, _)), Some((b, _))) => a.cmp(b),
                (Some(_), None) => std::cmp::Ordering::Less,
                (None, Some(_)) => std::cmp::Ordering::Greater,
                (None, None) => return Self(sum),
            };
            let (mut monomial, mut coefficient) = (Monomial::ONE, Number::ZERO);
            if order.is_le()
                && let Some(&(m, c)) = left.next()
            {
                (monomial, coefficient) = (m, c);
            }
            if order.is_ge()
                && let Some(&(m, c)) = right.next()
            {
                (monomial, coefficient) = (m, coefficient + k * c);
            }
            if !coefficient.is_zero() {
                sum.push((monomial, coefficient));
            }
        }
    }

    /// `k·self`
    pub fn scaled(&self, k: Number) -> Self {
        if k.is_zero() {
            return Self::zero();
        }
        if k.is_one() {
            return self.clone();
        }
        let scaled = self.0.iter().map(|&(monomial, coefficient)| (monomial, k * coefficient));
        Self(scaled.filter(|(_, coefficient)| !coefficient.is_zero()).collect())
    }

    /// The same with fractions for floats that are next to one: products of roots are often rational again.
    pub(super) fn with_fractions(&self) -> Self {
        let terms = self.0.iter().map(|&(monomial, coefficient)| (monomial, fraction_near(coefficient)));
        Self(terms.filter(|(_, coefficient)| !coefficient.is_zero()).collect())
    }
}

/// The denominators that are looked for, if they are not those of decimals. Of a float with a hundred bits, a fraction as
/// close as that is no chance.
const DENOMINATORS: i64 = 400;

/// The denominators of decimals that are looked for.
const DECIMALS: i64 = 1_000_000;

/// The fraction with a small denominator that a float is, but for its last bits; else the float.
fn fraction_near(value: Number) -> Number {
    let Number::Float(_) = value else { return value };
    if value.abs().to_f64() > 1e6 {
        return value;
    }
    // Continued fractions: the convergents p/q of the value.
    let (mut before, mut last) = ((0, 1), (1, 0));
    let mut rest = value.abs();
    for _ in 0..32 {
        let whole = rest.to_f64().floor();
        if !(0.0..1e9).contains(&whole) {
            return value;
        }
        let whole = whole as i64;
        let next = (whole * last.0 + before.0, whole * last.1 + before.1);
        if next.1 > DECIMALS {
            return value;
        }
        (before, last) = (last, next);
        let fraction = Number::ratio(last.0, last.1);
        let distance = (value.abs() - fraction).abs();
        let is_decimal = DECIMALS % last.1 == 0;
        if distance.to_f64() <= 1e-28 * value.abs().to_f64() {
            if last.1 > DENOMINATORS && !is_decimal {
                return value;
            }
            return if value.is_negative() { -fraction } else { fraction };
        }
        rest = rest - Number::integer(whole);
        let Some(inverse) = Number::ONE.checked_div(rest) else { return value };
        rest = inverse;
    }
    value
}
