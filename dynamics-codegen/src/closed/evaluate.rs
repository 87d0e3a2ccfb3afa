//! The value of a form at numbers, and the expression that it stands for.

use super::Form;
use crate::symbolic::{Expr, Number, Real, SymbolId};

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

/// The expression that a form stands for, or `None` if it divides by the constant zero, or takes a root of less.
pub fn expression<'g>(form: &Form, input: &impl Fn(SymbolId) -> Expr<'g>) -> Option<Expr<'g>> {
    let of = |form: &Form| expression(form, input);
    Some(match form {
        Form::Number(value) => Expr::Constant(*value),
        Form::Symbol(symbol) => input(*symbol),
        Form::Negative(inner) => -of(inner)?,
        Form::Sum(terms) => terms.iter().try_fold(Expr::ZERO, |sum, term| Some(sum + of(term)?))?,
        Form::Product(factors) => {
            factors.iter().try_fold(Expr::ONE, |product, factor| Some(product * of(factor)?))?
        }
        Form::Quotient(above, below) => of(above)?.checked_div(of(below)?)?,
        Form::Power(base, n) => {
            let base = of(base)?;
            (0..*n).fold(Expr::ONE, |power, _| power * base)
        }
        Form::Sin(inner) => of(inner)?.sin(),
        Form::Cos(inner) => of(inner)?.cos(),
        Form::Root(inner) => of(inner)?.sqrt()?,
    })
}
