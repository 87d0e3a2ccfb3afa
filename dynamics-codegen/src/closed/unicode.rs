//! Forms as text: `m₂ r₁² cos²θ₂`, on one line, with spaces for products.
//!
//! A space multiplies, and a stroke divides all that stands before it in the product by the one thing after it:
//! `m l²/3 (a + b)` is m l² over three, times a sum.

use super::form::signed;
use super::numeral::Numeral;
use super::{Form, Notation};
use crate::symbolic::Number;

/// How tightly something is bound: what binds less than its place asks for stands in parentheses.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Bond {
    Sum,
    Term,
    /// The first factors of a product, or its numerator.
    Product,
    Factor,
    Base,
}

/// Fractions that are letters.
pub(super) const FRACTIONS: [(char, i64, i64); 5] =
    [('½', 1, 2), ('⅓', 1, 3), ('⅔', 2, 3), ('¼', 1, 4), ('¾', 3, 4)];

pub(super) const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

impl Form {
    /// The form on one line.
    pub fn unicode(&self, notation: &Notation) -> String {
        let mut text = String::new();
        write(self, Bond::Sum, notation, &mut text);
        text
    }

    /// How tightly the form is bound where it stands by itself.
    pub(super) fn bond(&self) -> Bond {
        match self {
            Self::Sum(_) => Bond::Sum,
            Self::Negative(_) => Bond::Sum,
            Self::Product(_) | Self::Quotient(..) => Bond::Product,
            Self::Sin(_) | Self::Cos(_) | Self::Power(..) => Bond::Factor,
            Self::Number(value) if fraction_letter(*value).is_some() => Bond::Factor,
            Self::Number(value) => match Numeral::of(*value) {
                numeral if numeral.below.is_some() => Bond::Product,
                numeral if !numeral.is_atom() || numeral.pi > 0 || numeral.exponent != 0 => Bond::Factor,
                _ => Bond::Base,
            },
            Self::Symbol(_) | Self::Root(_) => Bond::Base,
        }
    }
}

fn fraction_letter(value: Number) -> Option<char> {
    FRACTIONS.iter().find(|(_, num, den)| value == Number::ratio(*num, *den)).map(|(letter, ..)| *letter)
}

fn write(form: &Form, least: Bond, notation: &Notation, text: &mut String) {
    if form.bond() < least {
        text.push('(');
        write(form, Bond::Sum, notation, text);
        text.push(')');
        return;
    }
    match form {
        Form::Number(value) => match fraction_letter(*value) {
            Some(letter) => text.push(letter),
            None => number(&Numeral::of(*value), text),
        },
        Form::Symbol(symbol) => text.push_str(notation.unicode(*symbol)),
        Form::Negative(inner) => {
            text.push('−');
            write(inner, Bond::Term, notation, text);
        }
        Form::Sum(terms) => {
            for (sign, term) in signed(terms, ["−", " − ", " + "]) {
                text.push_str(sign);
                write(term, Bond::Term, notation, text);
            }
        }
        Form::Product(factors) => {
            for (k, factor) in factors.iter().enumerate() {
                if k > 0 {
                    text.push(' ');
                }
                write(factor, if k == 0 { Bond::Product } else { Bond::Factor }, notation, text);
            }
        }
        Form::Quotient(above, below) => {
            write(above, Bond::Product, notation, text);
            text.push('/');
            let least =
                if matches!(**below, Form::Sin(_) | Form::Cos(_)) { Bond::Base } else { Bond::Factor };
            write(below, least, notation, text);
        }
        Form::Power(base, n) => match &**base {
            Form::Sin(argument) => function("sin", Some(*n), argument, notation, text),
            Form::Cos(argument) => function("cos", Some(*n), argument, notation, text),
            base => {
                write(base, Bond::Base, notation, text);
                raised(*n, text);
            }
        },
        Form::Sin(argument) => function("sin", None, argument, notation, text),
        Form::Cos(argument) => function("cos", None, argument, notation, text),
        Form::Root(inner) => {
            text.push('√');
            let is_short = matches!(**inner, Form::Symbol(_))
                || inner.bond() == Bond::Base && matches!(**inner, Form::Number(_));
            if is_short {
                write(inner, Bond::Base, notation, text);
            } else {
                text.push('(');
                write(inner, Bond::Sum, notation, text);
                text.push(')');
            }
        }
    }
}

fn function(name: &str, power: Option<u32>, argument: &Form, notation: &Notation, text: &mut String) {
    text.push_str(name);
    if let Some(n) = power {
        raised(n, text);
    }
    match argument {
        Form::Symbol(symbol) => {
            if power.is_none() {
                text.push(' ');
            }
            text.push_str(notation.unicode(*symbol));
        }
        Form::Product(factors) if argument.is_plain_argument() => {
            text.push(' ');
            for factor in factors {
                write(factor, Bond::Factor, notation, text);
            }
        }
        argument => {
            text.push('(');
            write(argument, Bond::Sum, notation, text);
            text.push(')');
        }
    }
}

fn raised(n: u32, text: &mut String) {
    text.extend(n.to_string().bytes().map(|digit| RAISED[usize::from(digit - b'0')]));
}

fn number(numeral: &Numeral, text: &mut String) {
    part(&numeral.digits, numeral.exponent, numeral.pi, text);
    if let Some((digits, pi)) = &numeral.below {
        text.push('/');
        let is_product = *pi > 0 && digits != "1";
        text.push_str(if is_product { "(" } else { "" });
        part(digits, 0, *pi, text);
        text.push_str(if is_product { ")" } else { "" });
    }
}

fn part(digits: &str, exponent: i32, pi: u8, text: &mut String) {
    if digits != "1" || (pi == 0 && exponent == 0) {
        text.push_str(digits);
    }
    if exponent != 0 {
        text.push_str(if digits == "1" { "10" } else { "·10" });
        text.push_str(if exponent < 0 { "⁻" } else { "" });
        raised(exponent.unsigned_abs(), text);
    }
    match pi {
        0 => {}
        1 => text.push('π'),
        _ => {
            text.push('π');
            raised(pi.into(), text);
        }
    }
}
