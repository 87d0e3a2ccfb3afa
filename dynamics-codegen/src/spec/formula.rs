//! Arithmetic as written: numbers with units, fields, sums, products, powers and functions.
//!
//! A term of the energies may have what moves as well: coordinates, speeds, and where bodies are.

use proc_macro2::{Delimiter, Literal, Span, TokenStream};

use super::cursor::{Cursor, Result};
use super::moving::{self, Moving};
use super::{Name, Unit};
use crate::diagnostics::{Code, Diagnostic, Place};
use crate::symbolic::Number;

/// A scalar expression as written.
#[derive(Clone, Debug)]
pub struct Formula {
    /// What it is.
    pub kind: FormulaKind,
    /// Where it was written.
    pub place: Place,
}

/// The forms of a [`Formula`]. Sums and products are flat: only parentheses and functions nest, at most 32 deep, and
/// powers have no powers.
#[derive(Clone, Debug)]
pub enum FormulaKind {
    /// A literal with its unit, as in `90deg`. The value is in the unit.
    Number(Number, Option<Unit>),
    /// A field, or `pi`; in a term also a joint's one coordinate.
    Name(Name),
    /// `-x`
    Negative(Box<Formula>),
    /// Two terms or more.
    Sum(Vec<Term>),
    /// Two factors or more.
    Product(Vec<Factor>),
    /// `sin(x)` and the like.
    Call(Function, Box<Formula>),
    /// `x^n`
    Power(Box<Formula>, i32),
    /// What only terms have.
    Moving(Moving),
}

/// Which words a formula may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Words {
    /// Those of a value: numbers and fields.
    OfValues,
    /// Those of a term: what moves as well.
    OfTerms,
}

/// The largest exponent, and the smallest is its negative.
const LARGEST_EXPONENT: i32 = 16;

/// A term of a sum.
#[derive(Clone, Debug)]
pub struct Term {
    /// Whether it is subtracted.
    pub negative: bool,
    /// The term.
    pub formula: Formula,
}

/// A factor of a product.
#[derive(Clone, Debug)]
pub struct Factor {
    /// Whether it divides.
    pub divides: bool,
    /// The factor.
    pub formula: Formula,
}

/// A function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// Sine.
    Sin,
    /// Cosine.
    Cos,
    /// Square root.
    Sqrt,
}

impl Formula {
    /// Reads tokens that are a formula and nothing else; `around` is the place of the whole if there are none.
    ///
    /// # Errors
    ///
    /// The first mistake in it.
    pub fn read(tokens: TokenStream, around: Span) -> std::result::Result<Self, Diagnostic> {
        Self::parse(Cursor::new(tokens, around))
    }

    /// Reads all of the cursor.
    pub(super) fn parse(input: Cursor) -> Result<Self> {
        Self::parse_in(input, Words::OfValues)
    }

    /// Reads all of the cursor, in these words.
    pub(super) fn parse_in(mut input: Cursor, words: Words) -> Result<Self> {
        let formula = Self::sum(&mut input, words)?;
        match input.is_empty() {
            true => Ok(formula),
            false => Err(after(&formula, input)),
        }
    }

    /// Reads a sum, and stops at what cannot go on with it.
    fn sum(input: &mut Cursor, words: Words) -> Result<Self> {
        let first = Self::product(input, words)?;
        let mut terms = vec![Term { negative: false, formula: first }];
        while let Some(sign @ ('+' | '-')) = input.peek_punct() {
            input.next();
            terms.push(Term { negative: sign == '-', formula: Self::product(input, words)? });
        }
        let place = spanning(terms.iter().map(|term| &term.formula));
        Ok(match (terms.pop(), terms.is_empty(), place) {
            (Some(only), true, _) => only.formula,
            (last, _, place) => {
                terms.extend(last);
                Self { kind: FormulaKind::Sum(terms), place }
            }
        })
    }

    fn product(input: &mut Cursor, words: Words) -> Result<Self> {
        let first = Self::signed(input, words)?;
        let mut factors = vec![Factor { divides: false, formula: first }];
        while let Some(sign @ ('*' | '/')) = input.peek_punct() {
            input.next();
            factors.push(Factor { divides: sign == '/', formula: Self::signed(input, words)? });
        }
        let place = spanning(factors.iter().map(|factor| &factor.formula));
        Ok(match (factors.pop(), factors.is_empty(), place) {
            (Some(only), true, _) => only.formula,
            (last, _, place) => {
                factors.extend(last);
                Self { kind: FormulaKind::Product(factors), place }
            }
        })
    }

    fn signed(input: &mut Cursor, words: Words) -> Result<Self> {
        let (start, mut negative) = (input.here(), false);
        while input.punct('-') {
            negative = !negative;
        }
        let inner = Self::power(input, words)?;
        if !negative {
            return Ok(inner);
        }
        let place = start.to(&inner.place);
        Ok(Self { kind: FormulaKind::Negative(Box::new(inner)), place })
    }

    /// `x` or `x^n`: of `-x^2` the square is negative.
    fn power(input: &mut Cursor, words: Words) -> Result<Self> {
        let base = Self::atom(input, words)?;
        if !input.punct('^') {
            return Ok(base);
        }
        let (exponent, end) = exponent(input)?;
        if input.peek_punct() == Some('^') {
            return Err(input.expected("one exponent"));
        }
        let place = base.place.to(&end);
        Ok(Self { kind: FormulaKind::Power(Box::new(base), exponent), place })
    }

    fn atom(input: &mut Cursor, words: Words) -> Result<Self> {
        let place = input.here();
        if words == Words::OfTerms
            && let Some(name) = input.quoted_name()
        {
            return moving::named(name, input);
        }
        if let Some(literal) = input.literal() {
            return number(&literal, place);
        }
        for delimiter in [Delimiter::Parenthesis, Delimiter::None] {
            if let Some((inner, place)) = input.group(delimiter)? {
                let inner = Self::parse_in(inner, words)?;
                return Ok(Self { place, ..inner });
            }
        }
        let Some(ident) = input.ident() else {
            return Err(input.expected(match words {
                Words::OfValues => "a number or the name of a field",
                Words::OfTerms => "a number or the name of a field or a joint",
            }));
        };
        let name = Name::new(&ident);
        match input.group(Delimiter::Parenthesis)? {
            None if words == Words::OfTerms => moving::named(name, input),
            None => Ok(Self { place: name.place.clone(), kind: FormulaKind::Name(name) }),
            Some((argument, end)) => {
                let place = name.place.to(&end);
                if words == Words::OfTerms && moving::is_known(&name) {
                    return Ok(Self {
                        kind: FormulaKind::Moving(Moving::parse(&name, argument, &end)?),
                        place,
                    });
                }
                let function = Function::named(&name, words)?;
                let argument = Box::new(Self::parse_in(argument, words)?);
                Ok(Self { kind: FormulaKind::Call(function, argument), place })
            }
        }
    }

    /// The number without a unit at the end, as it is written.
    fn last_literal(&self) -> Option<String> {
        match &self.kind {
            FormulaKind::Number(_, None) => Some(self.short_text()),
            FormulaKind::Negative(inner) => inner.last_literal(),
            FormulaKind::Sum(terms) => terms.last()?.formula.last_literal(),
            FormulaKind::Product(factors) => factors.last()?.formula.last_literal(),
            _ => None,
        }
    }

    /// The value of a literal without a unit, with the signs before it.
    pub fn bare_literal(&self) -> Option<Number> {
        match &self.kind {
            FormulaKind::Number(value, None) => Some(*value),
            FormulaKind::Negative(inner) => inner.bare_literal().map(|value| -value),
            _ => None,
        }
    }
}

/// The mistake that an expression is followed by what does not go on with it.
fn after(formula: &Formula, mut input: Cursor) -> Diagnostic {
    let mistake = input.expected("an operator or the end of the expression");
    let Some(word) = input.ident().map(|ident| ident.to_string()) else { return mistake };
    match formula.last_literal() {
        Some(number) if Unit::named(&word).is_some() => {
            let message = format!("a space is between the number `{number}` and its unit `{word}`");
            Diagnostic::new(Code::Syntax, &mistake.place, message).help(format!("write `{number}{word}`"))
        }
        // The next key of the attribute.
        _ if input.peek_punct() == Some('=') => mistake.help(format!("write a comma before `{word}`")),
        _ => mistake.help(format!("write `* {word}` for a product")),
    }
}

fn spanning<'a>(mut parts: impl Iterator<Item = &'a Formula>) -> Place {
    let first = parts.next().map(|part| part.place.clone());
    let last = parts.last().map(|part| part.place.clone());
    match (first, last) {
        (Some(first), Some(last)) => first.to(&last),
        (first, _) => first.unwrap_or_else(|| proc_macro2::Span::call_site().into()),
    }
}

impl Function {
    const ALL: [(&'static str, Self); 3] = [("sin", Self::Sin), ("cos", Self::Cos), ("sqrt", Self::Sqrt)];

    fn named(name: &Name, words: Words) -> Result<Self> {
        let found = Self::ALL.iter().find(|(known, _)| *known == name.text);
        found.map(|(_, function)| *function).ok_or_else(|| {
            let message = format!("there is no function `{name}`");
            let unknown = Diagnostic::new(Code::FunctionUnknown, &name.place, message);
            let known = Self::ALL.iter().map(|(known, _)| *known);
            match words {
                Words::OfValues => unknown.suggest(&name.text, known),
                Words::OfTerms => {
                    let all: Vec<_> = known.chain(moving::FUNCTIONS.iter().copied()).collect();
                    unknown.help(format!("use one of {}", all.join(", "))).suggest(&name.text, all)
                }
            }
        })
    }
}

/// A whole number, with its sign.
fn exponent(input: &mut Cursor) -> Result<(i32, Place)> {
    let start = input.here();
    let negative = input.punct('-');
    let place = start.to(&input.here());
    let wrong = |found: &str| {
        let (sign, found) = (if negative { "-" } else { "" }, shortened(found));
        let message =
            format!("the exponent `{sign}{found}` is no whole number of at most {LARGEST_EXPONENT}");
        Diagnostic::new(Code::ExponentInvalid, &place, message)
    };
    let Some(literal) = input.literal() else {
        let found = input.next().map(|token| token.to_string()).unwrap_or_default();
        return Err(wrong(&found));
    };
    let text = literal.to_string();
    let value = text.parse::<i32>().ok().filter(|value| *value <= LARGEST_EXPONENT);
    let value = value.ok_or_else(|| wrong(&text))?;
    Ok((if negative { -value } else { value }, place))
}

/// Reads a literal as `digits[unit]`.
fn number(literal: &Literal, place: Place) -> Result<Formula> {
    let text = literal.to_string();
    let prefixed = text.get(..2).is_some_and(|start| matches!(start, "0x" | "0o" | "0b"));
    if prefixed || !text.starts_with(|c: char| c.is_ascii_digit() || c == '-') {
        let message = format!("expected a decimal number, found `{}`", shortened(&text));
        return Err(Diagnostic::new(Code::Syntax, &place, message));
    }
    let (digits, suffix) = text.split_at(length_of_number(&text));
    let unit = match suffix {
        "" | "f32" | "f64" => None,
        _ => Some(Unit::named(suffix).ok_or_else(|| {
            let message = format!("there is no unit `{}`", shortened(suffix));
            let known = Unit::ALL.iter().map(|unit| unit.name);
            Diagnostic::new(Code::UnitUnknown, &place, message).suggest(suffix, known)
        })?),
    };
    let value = Number::parse_decimal(digits).filter(|value| value.is_finite()).ok_or_else(|| {
        let message = format!("the number `{}` is out of range", shortened(digits));
        Diagnostic::new(Code::NumberOutOfRange, &place, message)
    })?;
    Ok(Formula { kind: FormulaKind::Number(value, unit), place })
}

/// How much of a literal is its number: `-`, digits, a point, an exponent. The rest is its suffix.
fn length_of_number(text: &str) -> usize {
    let digit = |c: char| c.is_ascii_digit() || c == '_' || c == '.';
    let mantissa = text.find(|c: char| !(digit(c) || c == '-')).unwrap_or(text.len());
    let rest = &text[mantissa..];
    let Some(exponent) = rest.strip_prefix(['e', 'E']) else { return mantissa };
    let digits = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
    let length = digits.find(|c: char| !(c.is_ascii_digit() || c == '_')).unwrap_or(digits.len());
    if length == 0 { mantissa } else { text.len() - digits.len() + length }
}

/// A text for a message, cut where it gets long.
fn shortened(text: &str) -> String {
    match text.char_indices().nth(24) {
        Some((at, _)) => format!("{}…", &text[..at]),
        None => text.to_owned(),
    }
}
