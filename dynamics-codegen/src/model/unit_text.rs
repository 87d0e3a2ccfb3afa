//! Units as text: `kg·m²`, `m/s²`, `kg^(1/2)`.

use super::dimensions::Exponents;
use crate::spec::{Formula, FormulaKind};
use crate::symbolic::Number;

/// The text of a unit; what stands for an unknown field's unit is `unit of name`.
pub(super) fn unit_text(unit: &Exponents, name: impl Fn(usize) -> String) -> String {
    let base = ["kg", "m", "s"].map(str::to_owned).into_iter().zip(unit.constant);
    let unknown =
        unit.fields.iter().map(|(field, factor)| (format!("[unit of `{}`]", name(*field)), *factor));
    let parts: Vec<_> = base.chain(unknown).filter(|(_, exponent)| !exponent.is_zero()).collect();
    let side = |negative: bool| {
        let on_side = parts.iter().filter(|(_, exponent)| exponent.is_negative() == negative);
        on_side.map(|(symbol, exponent)| format!("{symbol}{}", raised(exponent.abs()))).collect::<Vec<_>>()
    };
    match (side(false), side(true)) {
        (above, below) if below.is_empty() => above.join("·"),
        (above, below) => {
            let above = if above.is_empty() { "1".to_owned() } else { above.join("·") };
            let below = if below.len() == 1 { below.join("") } else { format!("({})", below.join("·")) };
            format!("{above}/{below}")
        }
    }
}

fn raised(exponent: Number) -> String {
    match exponent.to_f64() {
        1.0 => String::new(),
        2.0 => "²".to_owned(),
        3.0 => "³".to_owned(),
        4.0 => "⁴".to_owned(),
        _ => match exponent.exact_text() {
            whole if whole.bytes().all(|byte| byte.is_ascii_digit()) => format!("^{whole}"),
            fraction => format!("^({fraction})"),
        },
    }
}

/// What an expression without unit is.
pub(super) fn angle_text(formula: &Formula) -> &'static str {
    if has_angle(formula) { "an angle" } else { "a plain number" }
}

/// Whether an angle's unit is written in one of the terms or factors.
fn has_angle(formula: &Formula) -> bool {
    match &formula.kind {
        FormulaKind::Number(_, unit) => unit.is_some_and(|unit| unit.is_angle()),
        FormulaKind::Negative(inner) => has_angle(inner),
        FormulaKind::Sum(terms) => terms.iter().any(|term| has_angle(&term.formula)),
        FormulaKind::Product(factors) => factors.iter().any(|factor| has_angle(&factor.formula)),
        FormulaKind::Power(base, _) => has_angle(base),
        FormulaKind::Name(_) | FormulaKind::Call(..) | FormulaKind::Moving(_) => false,
    }
}
