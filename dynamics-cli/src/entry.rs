//! An entry of a state as it is written: a plain number, in SI units, or one with a unit, `30deg`, `pi / 4`, `1mm / 2s`.

use dynamics_codegen::diagnostics::{Code, Diagnostic};
use proc_macro2::{Span, TokenStream, TokenTree};

use crate::assignment::formula;
use crate::quantity::{self, Exponents};
use crate::robot::Robot;

/// The entries of a vector of a state.
pub(crate) struct Entries<'r> {
    /// What they are called.
    pub(crate) names: &'r [String],
    /// Their units; a quaternion's have none.
    units: Vec<Option<Exponents>>,
}

/// What is wrong with an entry.
pub(crate) enum Wrong {
    /// It is no number.
    NoNumber,
    /// What the compiler has a word for.
    Of(Box<Diagnostic>),
}

/// The unit of power, W: that of a force times a speed.
const POWER: Exponents = [1, 2, -3];

impl<'r> Entries<'r> {
    /// Those of `q`, `v`, `a` or `tau`.
    pub(crate) fn of(robot: &'r Robot<'_>, key: &str) -> Option<Self> {
        let known = &robot.coordinates;
        let of_v =
            |unit: fn(Exponents) -> Exponents| known.units_of_v.iter().map(|&own| Some(unit(own))).collect();
        let (names, units) = match key {
            "q" => (&known.q, known.units_of_q.clone()),
            "v" => (&known.v, of_v(|own| own)),
            "a" => (&known.v, of_v(|[kg, m, s]| [kg, m, s - 1])),
            "tau" => (&known.v, of_v(|own| std::array::from_fn(|k| POWER[k] - own[k]))),
            _ => return None,
        };
        Some(Self { names, units })
    }

    /// The value of an entry, in SI units; so many characters of a text stand before it.
    pub(crate) fn number(&self, entry: usize, text: &str, before: usize) -> Result<f64, Wrong> {
        // So all is read that is a number to other programs: `+1`, `.5`, `inf`.
        if let Ok(number) = text.parse() {
            return Ok(number);
        }
        let padded = " ".repeat(before) + text;
        let tokens: Vec<TokenTree> =
            padded.parse::<TokenStream>().map_err(|_| Wrong::NoNumber)?.into_iter().collect();
        let name = self.names.get(entry).map_or("", String::as_str);
        self.value(&tokens, entry, name).map_err(|found| match found.code {
            Code::Syntax | Code::ConstantNeeded => Wrong::NoNumber,
            _ => Wrong::Of(Box::new(found)),
        })
    }

    fn value(&self, tokens: &[TokenTree], entry: usize, name: &str) -> Result<f64, Diagnostic> {
        let formula = formula(tokens, Span::call_site())?;
        let own = quantity::unit(&formula)?;
        let wanted = self.units.get(entry).copied().flatten();
        if let (Some(own), None) = (own, wanted) {
            let (text, own) = (formula.short_text(), quantity::text(own));
            let message =
                format!("`{text}` has the unit {own}, and `{name}`, a part of a quaternion, has none");
            let wrong = Diagnostic::new(Code::UnitMismatch, &formula.place, message);
            return Err(wrong.help("give a plain number; no rotation is 0, 0, 0, 1"));
        }
        quantity::value(&formula, wanted, name).map_err(|found| match own.zip(wanted) {
            Some((own, wanted)) if own[..2] == wanted[..2] && own[2] > wanted[2] => {
                let seconds = if own[2] - wanted[2] == 1 { "1s" } else { "1s^2" };
                let rate = format!("{} / {seconds}", formula.short_text());
                found.help(format!(
                    "give a rate, `{rate}`, or a number, which is in {}",
                    quantity::text(wanted)
                ))
            }
            _ => found,
        })
    }
}
