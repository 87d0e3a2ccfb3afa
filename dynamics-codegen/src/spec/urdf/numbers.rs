//! Numbers as a URDF writes them: decimals, with spaces between.

use super::elements::Text;
use super::source::quoted;
use crate::diagnostics::{Code, Diagnostic, Place};
use crate::spec::{Formula, FormulaKind, Unit};
use crate::symbolic::Number;

type Result<T> = std::result::Result<T, Diagnostic>;

/// The one number of a value.
pub(super) fn scalar(text: &Text<'_>, unit: Option<Unit>) -> Result<Formula> {
    let [number] = numbers(text, ["one number"], unit)?;
    Ok(number)
}

/// The three numbers of a value.
pub(super) fn vector(text: &Text<'_>, parts: [&str; 3], unit: Option<Unit>) -> Result<[Formula; 3]> {
    numbers(text, parts, unit)
}

/// As many numbers as `parts` names.
fn numbers<const N: usize>(text: &Text<'_>, parts: [&str; N], unit: Option<Unit>) -> Result<[Formula; N]> {
    let mut found = Vec::with_capacity(N);
    for (word, place) in text.words() {
        // The count of what is no number is of no interest.
        found.push(number(word, place, text, unit)?);
        if found.len() > N {
            break;
        }
    }
    found.try_into().map_err(|_| {
        let (value, what) = (quoted(text.value), text.what());
        let message = format!("{what} has {N} part{}, found {value}", if N == 1 { "" } else { "s" });
        Diagnostic::new(Code::CountWrong, &text.place(), message)
            .help(format!("give exactly {}", parts.join(" ")))
    })
}

fn number(word: &str, place: Place, text: &Text<'_>, unit: Option<Unit>) -> Result<Formula> {
    match (word.parse::<f64>(), Number::parse_decimal(word)) {
        (Ok(_), Some(value)) if value.is_finite() && value.to_f64().is_finite() => {
            Ok(Formula { kind: FormulaKind::Number(value, unit), place })
        }
        (Ok(_), _) if word.contains(|c: char| c.is_ascii_digit()) => {
            let message = format!("{} is {}, which is out of range", text.what(), quoted(word));
            Err(Diagnostic::new(Code::NumberOutOfRange, &place, message))
        }
        _ => Err(no_number(word, &place, text)),
    }
}

fn no_number(word: &str, place: &Place, text: &Text<'_>) -> Diagnostic {
    if let Some(left) = xacro_left(text) {
        return left;
    }
    let (value, what) = (quoted(text.value), text.what());
    let message = match word.len() == text.value.trim().len() {
        true => format!("{what} is {value}, which is no number"),
        false => format!("{what} is {value}: {} is no number", quoted(word)),
    };
    let wrong = Diagnostic::new(Code::NumberInvalid, place, message);
    if word.contains(',') {
        wrong.help("write a point before decimals, as in `0.1`, and spaces between numbers")
    } else if text.value.trim_start().starts_with(|c: char| c.is_ascii_digit())
        && word.parse::<f64>().is_err()
    {
        wrong.help("write numbers alone, in decimals: units are kg, m, rad, s and N")
    } else {
        wrong
    }
}

/// The number that was read.
pub(super) fn value(formula: &Formula) -> Option<Number> {
    match formula.kind {
        FormulaKind::Number(value, _) => Some(value),
        _ => None,
    }
}

/// The mistake that an expression of xacro is where its value should be.
pub(super) fn xacro_left(text: &Text<'_>) -> Option<Diagnostic> {
    ["${", "$("].iter().any(|open| text.value.contains(open)).then(|| {
        let message = format!("{} is {}, an expression of xacro", text.what(), quoted(text.value));
        Diagnostic::new(Code::XacroLeft, &text.place(), message)
    })
}
