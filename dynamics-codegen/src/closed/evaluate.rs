//! The value of a form at numbers.

use super::Form;
use crate::symbolic::{Number, Real, SymbolId};

/// The value of a form at numbers.
pub fn evaluate<R: Real>(form: &Form, input: &impl Fn(SymbolId) -> R) -> R {
    let of = |form: &Form| evaluate(form, input);
    match form {
        Form::Number(value) => R::of(*value),
        Form::Symbol(symbol) => input(*symbol),
        Form::Negative(inner) => -of(inner),
        Form::Sum(terms) => terms.iter().map(of).fold(R::of(Number::ZERO), |sum, term| sum + term),
        Form::Product(factors) => {
            factors.iter().map(of).fold(R::of(Number::ONE), |product, factor| product * factor)
        }
        Form::Quotient(above, below) => of(above) / of(below),
        Form::Power(base, n) => {
            let base = of(base);
            (0..*n).fold(R::of(Number::ONE), |power, _| power * base)
        }
        Form::Sin(inner) => of(inner).sin(),
        Form::Cos(inner) => of(inner).cos(),
        Form::Root(inner) => of(inner).sqrt(),
    }
}
