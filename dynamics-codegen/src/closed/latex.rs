//! Forms in LaTeX's mathematics: `m_2 r_1^{2} \cos^{2}\theta_2`.

use super::form::signed;
use super::numeral::Numeral;
use super::unicode::Bond;
use super::{Form, Notation};

impl Form {
    /// The form in LaTeX, without `$`.
    pub fn latex(&self, notation: &Notation) -> String {
        let mut text = String::new();
        write(self, Bond::Sum, notation, &mut text);
        text
    }

    /// As [`Form::bond`], where fractions are drawn with a bar, and need no parentheses.
    fn drawn_bond(&self) -> Bond {
        match self {
            Self::Quotient(..) => Bond::Factor,
            Self::Number(value) => match Numeral::of(*value) {
                numeral if numeral.is_atom() => Bond::Base,
                _ => Bond::Factor,
            },
            form => form.bond(),
        }
    }
}

fn write(form: &Form, least: Bond, notation: &Notation, text: &mut String) {
    if form.drawn_bond() < least {
        text.push_str("\\left(");
        write(form, Bond::Sum, notation, text);
        text.push_str("\\right)");
        return;
    }
    match form {
        Form::Number(value) => number(&Numeral::of(*value), text),
        Form::Symbol(symbol) => text.push_str(notation.latex(*symbol)),
        Form::Negative(inner) => {
            text.push('-');
            write(inner, Bond::Term, notation, text);
        }
        Form::Sum(terms) => {
            for (sign, term) in signed(terms, ["-", " - ", " + "]) {
                text.push_str(sign);
                write(term, Bond::Term, notation, text);
            }
        }
        Form::Product(factors) => {
            for (k, factor) in factors.iter().enumerate() {
                if k > 0 {
                    text.push_str(if matches!(factors[k - 1], Form::Number(_)) { " \\, " } else { " " });
                }
                match factor {
                    Form::Number(value) => number(&Numeral::in_front(*value), text),
                    factor => write(factor, Bond::Factor, notation, text),
                }
            }
        }
        Form::Quotient(above, below) => {
            text.push_str("\\frac{");
            write(above, Bond::Sum, notation, text);
            text.push_str("}{");
            write(below, Bond::Sum, notation, text);
            text.push('}');
        }
        Form::Power(base, n) => match &**base {
            Form::Sin(argument) => function("\\sin", Some(*n), argument, notation, text),
            Form::Cos(argument) => function("\\cos", Some(*n), argument, notation, text),
            base => {
                write(base, Bond::Base, notation, text);
                text.push_str(&format!("^{{{n}}}"));
            }
        },
        Form::Sin(argument) => function("\\sin", None, argument, notation, text),
        Form::Cos(argument) => function("\\cos", None, argument, notation, text),
        Form::Root(inner) => {
            text.push_str("\\sqrt{");
            write(inner, Bond::Sum, notation, text);
            text.push('}');
        }
    }
}

fn function(name: &str, power: Option<u32>, argument: &Form, notation: &Notation, text: &mut String) {
    text.push_str(name);
    if let Some(n) = power {
        text.push_str(&format!("^{{{n}}}"));
    }
    if argument.is_plain_argument() {
        text.push(' ');
        let factors =
            if let Form::Product(factors) = argument { factors } else { std::slice::from_ref(argument) };
        for factor in factors {
            write(factor, Bond::Factor, notation, text);
        }
    } else {
        text.push_str("\\left(");
        write(argument, Bond::Sum, notation, text);
        text.push_str("\\right)");
    }
}

fn number(numeral: &Numeral, text: &mut String) {
    let above = part(&numeral.digits, numeral.exponent, numeral.pi, numeral.radicand);
    match &numeral.below {
        None => text.push_str(&above),
        Some((digits, pi)) => text.push_str(&format!("\\frac{{{above}}}{{{}}}", part(digits, 0, *pi, 1))),
    }
}

fn part(digits: &str, exponent: i32, pi: u8, radicand: u16) -> String {
    let is_hidden = digits == "1" && (pi > 0 || radicand != 1 || exponent != 0);
    let mut text = if is_hidden { String::new() } else { digits.to_owned() };
    if exponent != 0 {
        text.push_str(if digits == "1" { "10" } else { " \\cdot 10" });
        text.push_str(&format!("^{{{exponent}}}"));
    }
    match pi {
        0 => {}
        1 => text.push_str("\\pi"),
        pi => text.push_str(&format!("\\pi^{{{pi}}}")),
    }
    if radicand != 1 {
        text.push_str(&format!("\\sqrt{{{radicand}}}"));
    }
    text
}
