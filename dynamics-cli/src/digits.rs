//! Numbers as people read them in equations: with no more digits than they care for.

use dynamics_codegen::closed::Form;
use dynamics_codegen::symbolic::Number;

/// Numbers have so many digits in equations: of 1/30 nobody reads eighteen.
pub(crate) const DIGITS: usize = 6;

/// The form with its numbers rounded; small fractions stay as they are.
pub(crate) fn short(form: &Form) -> Form {
    let all = |parts: &[Form]| parts.iter().map(short).collect();
    let one = |part: &Form| Box::new(short(part));
    match form {
        Form::Number(value) => Form::Number(short_number(*value)),
        Form::Symbol(symbol) => Form::Symbol(*symbol),
        Form::Negative(inner) => Form::Negative(one(inner)),
        Form::Sum(terms) => Form::Sum(all(terms)),
        Form::Product(factors) => Form::Product(all(factors)),
        Form::Quotient(above, below) => Form::Quotient(one(above), one(below)),
        Form::Power(base, exponent) => Form::Power(one(base), *exponent),
        Form::Sin(inner) => Form::Sin(one(inner)),
        Form::Cos(inner) => Form::Cos(one(inner)),
        Form::Root(inner) => Form::Root(one(inner)),
    }
}

/// Whether a number in the form is rounded, or may have been before: it has as many digits as are written.
pub(crate) fn is_rounded(form: &Form) -> bool {
    match form {
        Form::Number(value) => !has_few_digits(*value) && of_digits(DIGITS - 1, *value) != Some(*value),
        _ => form.parts().into_iter().any(is_rounded),
    }
}

fn has_few_digits(value: Number) -> bool {
    value.exact_text().chars().filter(char::is_ascii_digit).count() <= DIGITS
}

fn short_number(value: Number) -> Number {
    match of_digits(DIGITS, value) {
        Some(rounded) if !has_few_digits(value) => rounded,
        _ => value,
    }
}

/// A number with as many digits as people care for.
pub(crate) fn rounded(value: f64) -> f64 {
    format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(value)
}

/// A number in a sentence.
pub(crate) fn said(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

/// The nearest decimal of so many digits.
fn of_digits(digits: usize, value: Number) -> Option<Number> {
    Number::parse_decimal(&format!("{:.*e}", digits - 1, value.to_f64()))
}
