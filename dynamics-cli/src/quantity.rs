//! A number with its unit, as it is written in an option: `2`, `500g`, `-30deg`, `pi / 4`, `30deg / 1s`.

use dynamics_codegen::diagnostics::{Code, Diagnostic};
use dynamics_codegen::spec::{Formula, FormulaKind, Function};
use dynamics_codegen::symbolic::Number;

/// The exponents of kg, m and s.
pub(crate) type Exponents = [i32; 3];

/// A value, in SI units, and of which: nothing if it takes the unit of its place, as a bare number does.
type Value = (Number, Option<Exponents>);

/// The value of a formula without fields, in SI units, where `unit` is wanted; nothing is wanted of what has none that
/// is known.
pub(crate) fn value(formula: &Formula, unit: Option<Exponents>, place: &str) -> Result<f64, Diagnostic> {
    number(formula, unit, place).map(Number::to_f64)
}

/// The same, exactly.
pub(crate) fn number(formula: &Formula, unit: Option<Exponents>, place: &str) -> Result<Number, Diagnostic> {
    let (value, own) = of(formula)?;
    if let (Some(own), Some(unit)) = (own, unit)
        && own != unit
    {
        let message =
            format!("`{}` has the unit {}, and `{place}` {}", formula.short_text(), text(own), text(unit));
        let wrong = Diagnostic::new(Code::UnitMismatch, &formula.place, message);
        return Err(wrong.help(format!("give a number, which is in {}, or another unit", text(unit))));
    }
    if value.to_f64().is_finite() { Ok(value) } else { Err(out_of_range(formula)) }
}

/// The unit that a formula has of itself.
pub(crate) fn unit(formula: &Formula) -> Result<Option<Exponents>, Diagnostic> {
    of(formula).map(|(_, unit)| unit)
}

fn of(formula: &Formula) -> Result<Value, Diagnostic> {
    Ok(match &formula.kind {
        FormulaKind::Number(value, None) => (*value, None),
        FormulaKind::Number(value, Some(unit)) => {
            let (num, den, pi) = unit.scale;
            let scale = Number::ratio(num, den) * if pi { Number::PI } else { Number::ONE };
            (*value * scale, Some(unit.exponents.map(i32::from)))
        }
        FormulaKind::Name(name) if matches!(name.text.as_str(), "pi" | "PI") => (Number::PI, None),
        FormulaKind::Name(name) => {
            let message = format!("`{name}` is no number");
            let wrong = Diagnostic::new(Code::ConstantNeeded, &name.place, message);
            return Err(wrong.help("write a number, with a unit behind it or without"));
        }
        FormulaKind::Negative(inner) => {
            let (value, unit) = of(inner)?;
            (-value, unit)
        }
        FormulaKind::Sum(terms) => {
            let mut sum = (Number::ZERO, None);
            for term in terms {
                let (value, unit) = of(&term.formula)?;
                if let (Some(before), Some(unit)) = (sum.1, unit)
                    && before != unit
                {
                    let message = format!(
                        "`{}` has the unit {}, and the term before it {}",
                        term.formula.short_text(),
                        text(unit),
                        text(before)
                    );
                    return Err(Diagnostic::new(Code::UnitMismatch, &term.formula.place, message));
                }
                sum = (sum.0 + if term.negative { -value } else { value }, sum.1.or(unit));
            }
            sum
        }
        FormulaKind::Product(factors) => {
            let mut product: Value = (Number::ONE, None);
            for factor in factors {
                let (value, unit) = of(&factor.formula)?;
                let sign = if factor.divides { -1 } else { 1 };
                let units = unit.map(|unit| {
                    let before = product.1.unwrap_or_default();
                    std::array::from_fn(|k| before[k] + sign * unit[k])
                });
                let value = match factor.divides {
                    true => product.0.checked_div(value).ok_or_else(|| by_zero(&factor.formula))?,
                    false => product.0 * value,
                };
                product = (value, units.or(product.1));
            }
            product
        }
        FormulaKind::Power(base, exponent) => {
            let (value, unit) = of(base)?;
            let power = (0..exponent.unsigned_abs()).fold(Number::ONE, |power, _| power * value);
            let power = match *exponent < 0 {
                true => Number::ONE.checked_div(power).ok_or_else(|| by_zero(base))?,
                false => power,
            };
            (power, unit.map(|unit| unit.map(|own| own * exponent)))
        }
        // No value is read with them.
        FormulaKind::Moving(_) => return Err(out_of_range(formula)),
        FormulaKind::Call(function, argument) => {
            let (value, _) = of(argument)?;
            let value = match function {
                Function::Sin => Some(value.sin()),
                Function::Cos => Some(value.cos()),
                Function::Sqrt => value.sqrt(),
            };
            (value.ok_or_else(|| rootless(argument))?, None)
        }
    })
}

fn by_zero(formula: &Formula) -> Diagnostic {
    let message = format!("the divisor `{}` is zero", formula.short_text());
    Diagnostic::new(Code::DivisionByZero, &formula.place, message)
}

fn rootless(formula: &Formula) -> Diagnostic {
    let message = format!("`{}` is negative, and has no root", formula.short_text());
    Diagnostic::new(Code::RootOfNegative, &formula.place, message)
}

fn out_of_range(formula: &Formula) -> Diagnostic {
    let message = format!("the value of `{}` is out of range", formula.short_text());
    Diagnostic::new(Code::NumberOutOfRange, &formula.place, message)
}

/// A unit as text.
pub(crate) fn text(exponents: Exponents) -> String {
    let power = |(symbol, exponent): (&str, &i32)| match exponent.abs() {
        0 => None,
        1 => Some(symbol.to_owned()),
        power => Some(format!("{symbol}^{power}")),
    };
    let side = |sign: i32| -> Vec<String> {
        let of_side = ["kg", "m", "s"].into_iter().zip(&exponents).filter(|(_, e)| e.signum() == sign);
        of_side.filter_map(power).collect()
    };
    match (side(1).join("·"), side(-1)) {
        (above, below) if below.is_empty() && above.is_empty() => "rad".to_owned(),
        (above, below) if below.is_empty() => above,
        (above, below) => {
            // An angle has no unit of its own, and its rates are what has seconds alone.
            let of_rate = if matches!(exponents, [0, 0, _]) { "rad" } else { "1" };
            let above = if above.is_empty() { of_rate.to_owned() } else { above };
            let below = if below.len() > 1 { format!("({})", below.join("·")) } else { below.concat() };
            format!("{above}/{below}")
        }
    }
}
