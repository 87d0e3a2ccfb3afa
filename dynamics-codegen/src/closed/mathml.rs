//! Forms in MathML: what browsers draw without anything else.

use super::form::signed;
use super::numeral::Numeral;
use super::unicode::Bond;
use super::{Form, Notation};

/// The invisible operators: a product, and the application of a function.
const TIMES: &str = "<mo>&#x2062;</mo>";
const APPLY: &str = "<mo>&#x2061;</mo>";
/// What a printer leaves beside the name of a function; browsers leave nothing.
const THIN: &str = "<mspace width=\"0.17em\"/>";

impl Form {
    /// The form as one `<mrow>` of MathML; [`math`] makes it an element that stands in a page.
    pub fn mathml(&self, notation: &Notation) -> String {
        let mut text = String::from("<mrow>");
        write(self, Bond::Sum, notation, &mut text);
        text.push_str("</mrow>");
        text
    }
}

/// A `<math>` element, displayed in a line of its own, around rows of MathML.
pub fn math(rows: &str) -> String {
    format!("<math xmlns=\"http://www.w3.org/1998/Math/MathML\" display=\"block\">{rows}</math>")
}

/// How tightly a form is bound: fractions have bars, and functions stand like factors.
fn bond(form: &Form) -> Bond {
    match form {
        Form::Quotient(..) => Bond::Factor,
        Form::Number(value) => {
            if Numeral::of(*value).is_atom() {
                Bond::Base
            } else {
                Bond::Factor
            }
        }
        form => form.bond(),
    }
}

fn write(form: &Form, least: Bond, notation: &Notation, text: &mut String) {
    if bond(form) < least {
        parenthesised(form, notation, text);
        return;
    }
    match form {
        Form::Number(value) => number(&Numeral::of(*value), text),
        Form::Symbol(symbol) => text.push_str(&notation.letter(*symbol).name.mathml()),
        Form::Negative(inner) => {
            text.push_str("<mo form=\"prefix\">&#x2212;</mo>");
            write(inner, Bond::Term, notation, text);
        }
        Form::Sum(terms) => {
            for (sign, term) in
                signed(terms, ["<mo form=\"prefix\">&#x2212;</mo>", "<mo>&#x2212;</mo>", "<mo>+</mo>"])
            {
                text.push_str(sign);
                write(term, Bond::Term, notation, text);
            }
        }
        Form::Product(factors) => {
            for (k, factor) in factors.iter().enumerate() {
                if k > 0 {
                    text.push_str(TIMES);
                    if factor.is_function() || factors[k - 1].is_function() {
                        text.push_str(THIN);
                    }
                }
                match factor {
                    Form::Number(value) => number(&Numeral::in_front(*value), text),
                    factor => write(factor, Bond::Factor, notation, text),
                }
            }
        }
        Form::Quotient(above, below) => {
            text.push_str("<mfrac>");
            text.push_str(&above.mathml(notation));
            text.push_str(&below.mathml(notation));
            text.push_str("</mfrac>");
        }
        Form::Power(base, n) => match &**base {
            Form::Sin(argument) => function("sin", Some(*n), argument, notation, text),
            Form::Cos(argument) => function("cos", Some(*n), argument, notation, text),
            base => {
                text.push_str("<msup><mrow>");
                write(base, Bond::Base, notation, text);
                text.push_str(&format!("</mrow><mn>{n}</mn></msup>"));
            }
        },
        Form::Sin(argument) => function("sin", None, argument, notation, text),
        Form::Cos(argument) => function("cos", None, argument, notation, text),
        Form::Root(inner) => {
            text.push_str("<msqrt>");
            text.push_str(&inner.mathml(notation));
            text.push_str("</msqrt>");
        }
    }
}

fn parenthesised(form: &Form, notation: &Notation, text: &mut String) {
    text.push_str("<mrow><mo>(</mo>");
    write(form, Bond::Sum, notation, text);
    text.push_str("<mo>)</mo></mrow>");
}

fn function(name: &str, power: Option<u32>, argument: &Form, notation: &Notation, text: &mut String) {
    match power {
        None => text.push_str(&format!("<mi>{name}</mi>")),
        Some(n) => text.push_str(&format!("<msup><mi>{name}</mi><mn>{n}</mn></msup>")),
    }
    text.push_str(APPLY);
    if argument.is_plain_argument() {
        text.push_str(THIN);
        write(argument, Bond::Sum, notation, text);
    } else {
        parenthesised(argument, notation, text);
    }
}

fn number(numeral: &Numeral, text: &mut String) {
    match &numeral.below {
        None => part(&numeral.digits, numeral.exponent, numeral.pi, numeral.radicand, text),
        Some((digits, pi)) => {
            text.push_str("<mfrac><mrow>");
            part(&numeral.digits, numeral.exponent, numeral.pi, numeral.radicand, text);
            text.push_str("</mrow><mrow>");
            part(digits, 0, *pi, 1, text);
            text.push_str("</mrow></mfrac>");
        }
    }
}

fn part(digits: &str, exponent: i32, pi: u8, radicand: u16, text: &mut String) {
    if digits != "1" || (pi == 0 && radicand == 1 && exponent == 0) {
        text.push_str(&format!("<mn>{digits}</mn>"));
    }
    if exponent != 0 {
        text.push_str(if digits == "1" { "" } else { "<mo>&#xB7;</mo>" });
        let sign = if exponent < 0 { "<mo form=\"prefix\">&#x2212;</mo>" } else { "" };
        let size = exponent.unsigned_abs();
        text.push_str(&format!("<msup><mn>10</mn><mrow>{sign}<mn>{size}</mn></mrow></msup>"));
    }
    match pi {
        0 => {}
        1 => text.push_str("<mi>&#x3C0;</mi>"),
        pi => text.push_str(&format!("<msup><mi>&#x3C0;</mi><mn>{pi}</mn></msup>")),
    }
    if radicand != 1 {
        text.push_str(&format!("<msqrt><mn>{radicand}</mn></msqrt>"));
    }
}
