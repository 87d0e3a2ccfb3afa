//! Forms as text: `m₂ r₁² cos²θ₂`, on one line, with spaces for products.
//!
//! A space multiplies, and a stroke divides all that stands before it in the product by the one thing after it. So that
//! nobody has to know that, it ends a product, and is in parentheses where it does not, `(g/l) sin θ`; but for numbers
//! before a bracket, `m/24 (a + b)`. What ends with the argument of a function is in parentheses above it, `(sin θ)/l`.

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
pub(super) const FRACTIONS: [(char, i64, i64); 7] =
    [('½', 1, 2), ('⅓', 1, 3), ('⅔', 2, 3), ('¼', 1, 4), ('¾', 3, 4), ('⅙', 1, 6), ('⅛', 1, 8)];

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
                numeral if numeral.is_atom() => Bond::Base,
                _ => Bond::Factor,
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
        Form::Number(value) => number(&Numeral::of(*value), *value, text),
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
                match factor {
                    Form::Number(value) => number(&Numeral::in_front(*value), *value, text),
                    Form::Quotient(_, below) if k == 0 && is_plain(below, &factors[1]) => {
                        write(factor, Bond::Product, notation, text);
                    }
                    factor => write(factor, Bond::Factor, notation, text),
                }
            }
        }
        Form::Quotient(above, below) => {
            let least = if ends_with_function(above) { Bond::Base } else { Bond::Product };
            write(above, least, notation, text);
            text.push('/');
            let is_one_piece = !matches!(**below, Form::Sin(_) | Form::Cos(_) | Form::Number(_));
            let least = if is_one_piece { Bond::Factor } else { Bond::Base };
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

/// Whether a quotient by this is read as one where it stands before that: numbers below, and a bracket.
fn is_plain(below: &Form, next: &Form) -> bool {
    matches!((below, next), (Form::Number(_), Form::Sum(_)))
}

fn ends_with_function(form: &Form) -> bool {
    match form {
        Form::Product(factors) => factors.last().is_some_and(Form::is_function),
        form => form.is_function(),
    }
}

fn number(numeral: &Numeral, value: Number, text: &mut String) {
    if let Some(letter) = fraction_letter(value) {
        text.push(letter);
        return;
    }
    part(&numeral.digits, numeral.exponent, numeral.pi, numeral.radicand, text);
    if let Some((digits, pi)) = &numeral.below {
        text.push('/');
        let is_product = *pi > 0 && digits != "1";
        text.push_str(if is_product { "(" } else { "" });
        part(digits, 0, *pi, 1, text);
        text.push_str(if is_product { ")" } else { "" });
    }
}

fn part(digits: &str, exponent: i32, pi: u8, radicand: u16, text: &mut String) {
    if digits != "1" || (pi == 0 && radicand == 1 && exponent == 0) {
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
    if radicand != 1 {
        text.push_str(&format!("√{radicand}"));
    }
}
