//! Units of fields from how they are used, and whether every expression has the unit that its place needs.
//!
//! A unit is a product of powers of kg, m and s. The unit of an expression is linear in the exponents of its
//! fields' units, so each place gives a linear equation. They are solved in the order of the places, those of
//! bare fields first; the first equation that contradicts the ones before it is the mistake.

use super::quantities::{Quantity, Slot};
use super::unit_text::{angle_text, unit_text};
use super::values::{Values, for_each_name, is_pi};
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::spec::{Formula, FormulaKind, Function, Moving};
use crate::symbolic::Number;

/// The exponents of a unit: a constant, and multiples of the exponents of fields' units.
#[derive(Clone, Debug)]
pub(super) struct Exponents {
    /// Of kg, m and s.
    pub(super) constant: [Number; 3],
    /// Fields, in order, each with a factor other than zero.
    pub(super) fields: Vec<(usize, Number)>,
}

impl Exponents {
    fn none() -> Self {
        Self::of([0; 3])
    }

    fn of(exponents: [i8; 3]) -> Self {
        Self { constant: exponents.map(|exponent| Number::integer(exponent.into())), fields: vec![] }
    }

    fn of_field(field: usize) -> Self {
        Self { fields: vec![(field, Number::ONE)], ..Self::none() }
    }

    /// `self + k·other`
    fn plus(mut self, k: Number, other: &Self) -> Self {
        for (sum, constant) in self.constant.iter_mut().zip(other.constant) {
            *sum = *sum + k * constant;
        }
        for &(field, factor) in &other.fields {
            match self.fields.binary_search_by_key(&field, |(known, _)| *known) {
                Ok(at) => self.fields[at].1 = self.fields[at].1 + k * factor,
                Err(at) => self.fields.insert(at, (field, k * factor)),
            }
        }
        self.fields.retain(|(_, factor)| !factor.is_zero());
        self
    }

    /// Whether no unit is left. Exponents are fractions; a rounded one means that they got absurdly long.
    pub(super) fn is_none(&self) -> bool {
        self.fields.is_empty() && self.constant.iter().all(|exponent| exponent.to_f64().abs() < 1e-9)
    }
}

/// What is known of the units of fields.
pub(super) struct Units<'a> {
    values: &'a Values<'a, 'a>,
    /// The exponents of each field that is solved, in terms of those that are not.
    solved: Vec<Option<Exponents>>,
    /// The place that a bare field got its unit from.
    origins: Vec<Option<String>>,
    /// Whether names may be those of joints.
    is_term: bool,
}

/// The unit of an expression; `None` if it takes the unit of its place, as literals do.
type Unit = Option<Exponents>;

impl<'a> Units<'a> {
    /// Solves for all units, and reports the contradictions.
    pub(super) fn infer(values: &'a Values<'a, 'a>, slots: &[Slot], diags: &mut Diagnostics) -> Self {
        let count = values.fields().len();
        let mut units =
            Self { values, solved: vec![None; count], origins: vec![None; count], is_term: false };
        // A field where a number is needed is a mistake already, and tells nothing of the field's unit; so is a name that
        // nothing has, and of it nobody knows a unit.
        let (bare, composed): (Vec<&Slot>, Vec<&Slot>) = slots
            .iter()
            .filter(|slot| slot.constant.is_none() || !units.names_field(slot.formula))
            .filter(|slot| slot.is_term() || !units.names_nothing(slot.formula))
            .partition(|slot| units.bare_field(slot.formula).is_some());
        let mut wrong = vec![];
        for slot in bare.into_iter().chain(composed) {
            units.is_term = slot.is_term();
            let Err(mistake) = units.fits(slot, slot.formula) else { continue };
            // The entries of one list are wrong together, mostly.
            let list = (slot.owner, slot.key, slot.quantity);
            if !(mistake.code == Code::UnitMismatch && wrong.contains(&list)) {
                wrong.push(list);
                diags.push(mistake);
            }
        }
        units
    }

    /// The unit of a field, if all of it is known.
    pub(super) fn of_field(&self, field: usize) -> Option<[Number; 3]> {
        let unit = self.solved[field].as_ref()?;
        unit.fields.is_empty().then_some(unit.constant)
    }

    fn names_field(&self, formula: &Formula) -> bool {
        let mut found = false;
        for_each_name(formula, &mut |name| found |= self.values.field(name).is_some());
        found
    }

    /// Whether a name in it is of no field, nor of π.
    fn names_nothing(&self, formula: &Formula) -> bool {
        let mut found = false;
        for_each_name(formula, &mut |name| found |= self.values.field(name).is_none() && !is_pi(name));
        found
    }

    fn bare_field(&self, formula: &Formula) -> Option<usize> {
        match &formula.kind {
            FormulaKind::Name(name) => self.values.field(name),
            FormulaKind::Negative(inner) => self.bare_field(inner),
            _ => None,
        }
    }

    /// The formula has the unit that its slot needs; of a sum each term has it.
    fn fits(&mut self, slot: &Slot, formula: &Formula) -> Result<(), Diagnostic> {
        match &formula.kind {
            FormulaKind::Sum(terms) => {
                return terms.iter().try_for_each(|term| self.fits(slot, &term.formula));
            }
            FormulaKind::Negative(inner) => return self.fits(slot, inner),
            // What nearly all places of a file are: nothing to solve.
            FormulaKind::Number(_, unit)
                if unit.is_none_or(|unit| unit.exponents == slot.quantity.exponents()) =>
            {
                return Ok(());
            }
            FormulaKind::Name(name) => {
                if let Some(field) = self.values.field(name) {
                    self.origins[field].get_or_insert_with(|| slot.name());
                }
            }
            _ => {}
        }
        let Some(found) = self.unit(formula)? else { return Ok(()) };
        if self.equate(&found, &Exponents::of(slot.quantity.exponents())) {
            return Ok(());
        }
        let unit = slot.quantity.unit();
        let message = format!("{} needs {unit}, and {}", slot.name(), self.text(formula, &found));
        let mismatch = Diagnostic::new(Code::UnitMismatch, &formula.place, message);
        Err(match formula.kind {
            FormulaKind::Number(..) => {
                mismatch.help(format!("write the number in {unit}, or without a unit"))
            }
            FormulaKind::Name(_) => self.explained(mismatch.help("use a field of its own here"), &[formula]),
            _ if slot.is_term() && has_bare_factor(formula) => {
                let help = "give numbers that are no plain ones their units, as in `20N_per_m`";
                self.explained(mismatch.help(help), &[formula])
            }
            _ => self.explained(mismatch, &[formula]),
        })
    }

    /// The unit of a formula. Equations within it are solved on the way.
    fn unit(&mut self, formula: &Formula) -> Result<Unit, Diagnostic> {
        match &formula.kind {
            FormulaKind::Number(_, unit) => Ok(unit.map(|unit| Exponents::of(unit.exponents))),
            FormulaKind::Name(name) => {
                let of_joint = || self.values.unit_of_coordinate(name).filter(|_| self.is_term);
                let field = self.values.field(name).map(Exponents::of_field);
                Ok(field.or_else(|| of_joint().map(Exponents::of)))
            }
            FormulaKind::Negative(inner) => self.unit(inner),
            FormulaKind::Sum(terms) => {
                let mut first: Option<(&Formula, Exponents)> = None;
                for term in terms {
                    let Some(unit) = self.unit(&term.formula)? else { continue };
                    match &first {
                        None => first = Some((&term.formula, unit)),
                        Some(first) => self.same(first, (&term.formula, &unit))?,
                    }
                }
                Ok(first.map(|(_, unit)| unit))
            }
            FormulaKind::Product(factors) => {
                let mut product = None;
                for factor in factors {
                    let Some(unit) = self.unit(&factor.formula)? else { continue };
                    let k = Number::integer(if factor.divides { -1 } else { 1 });
                    product = Some(product.unwrap_or_else(Exponents::none).plus(k, &unit));
                }
                Ok(product)
            }
            FormulaKind::Call(function, argument) => self.call(*function, argument),
            FormulaKind::Power(base, exponent) => {
                let unit = self.unit(base)?;
                let exponent = Number::integer((*exponent).into());
                Ok(unit.map(|unit| Exponents::none().plus(exponent, &unit)))
            }
            FormulaKind::Moving(moving) => self.moving(moving),
        }
    }

    fn moving(&mut self, moving: &Moving) -> Result<Unit, Diagnostic> {
        Ok(match moving {
            Moving::Part(joint, part) => self.values.unit_of_part(joint, part).map(Exponents::of),
            Moving::Rate(of) => {
                let unit = self.unit(of)?;
                unit.map(|unit| unit.plus(Number::integer(-1), &Exponents::of([0, 0, 1])))
            }
            Moving::Distance(_) | Moving::Place(..) => Some(Exponents::of([0, 1, 0])),
        })
    }

    fn call(&mut self, function: Function, argument: &Formula) -> Result<Unit, Diagnostic> {
        let Some(unit) = self.unit(argument)? else { return Ok(None) };
        if function == Function::Sqrt {
            return Ok(Some(Exponents::none().plus(Number::ratio(1, 2), &unit)));
        }
        if self.equate(&unit, &Exponents::none()) {
            // The sine of an angle in numbers is a number as any other.
            let mut constant = true;
            for_each_name(argument, &mut |name| constant &= self.values.field(name).is_none());
            return Ok((!constant).then(Exponents::none));
        }
        let message = format!("`{}` needs an angle, and {}", function.name(), self.text(argument, &unit));
        let mismatch = Diagnostic::new(Code::UnitMismatch, &argument.place, message);
        Err(self.explained(mismatch, &[argument]))
    }

    /// Terms of one sum have one unit.
    fn same(
        &mut self,
        first: &(&Formula, Exponents),
        term: (&Formula, &Exponents),
    ) -> Result<(), Diagnostic> {
        if self.equate(term.1, &first.1) {
            return Ok(());
        }
        let message = format!("{}, and {}", self.text(first.0, &first.1), self.text(term.0, term.1));
        let differ = Diagnostic::new(Code::UnitsDiffer, &first.0.place.to(&term.0.place), message);
        Err(self.explained(differ, &[first.0, term.0]))
    }

    /// Adds the equation `left = right`; false if it contradicts those before.
    fn equate(&mut self, left: &Exponents, right: &Exponents) -> bool {
        let rest = self.reduced(&left.clone().plus(Number::integer(-1), right));
        let Some(&(field, factor)) = rest.fields.first() else { return rest.is_none() };
        let Some(k) = Number::integer(-1).checked_div(factor) else { return true };
        let others = rest.plus(-factor, &Exponents::of_field(field));
        let solution = Exponents::none().plus(k, &others);
        for solved in self.solved.iter_mut().flatten() {
            let Some((_, factor)) = solved.fields.iter().find(|(known, _)| *known == field).copied() else {
                continue;
            };
            *solved = solved.clone().plus(-factor, &Exponents::of_field(field)).plus(factor, &solution);
        }
        self.solved[field] = Some(solution);
        true
    }

    /// The exponents in terms of unsolved fields only.
    fn reduced(&self, unit: &Exponents) -> Exponents {
        let mut reduced = Exponents { constant: unit.constant, fields: vec![] };
        for &(field, factor) in &unit.fields {
            reduced = match &self.solved[field] {
                Some(solution) => reduced.plus(factor, solution),
                None => reduced.plus(factor, &Exponents::of_field(field)),
            };
        }
        reduced
    }

    /// As in "`m2 * r1` is in kg·m".
    fn text(&self, formula: &Formula, unit: &Exponents) -> String {
        let unit = self.reduced(unit);
        let text = if unit.is_none() {
            angle_text(formula).to_owned()
        } else {
            format!("in {}", unit_text(&unit, |field| self.values.fields()[field].name.text.clone()))
        };
        format!("`{}` is {text}", formula.short_text())
    }

    /// Says where the fields of the formulas got their units from.
    fn explained(&self, diagnostic: Diagnostic, formulas: &[&Formula]) -> Diagnostic {
        let mut fields = vec![];
        for formula in formulas {
            for_each_name(formula, &mut |name| {
                fields.extend(self.values.field(name).filter(|field| !fields.contains(field)));
            });
        }
        let reasons = fields.into_iter().filter_map(|field| {
            let (origin, name) = (self.origins[field].as_ref()?, &self.values.fields()[field].name);
            let unit = Exponents { constant: self.of_field(field)?, fields: vec![] };
            let unit = if unit.is_none() {
                "an angle".into()
            } else {
                format!("in {}", unit_text(&unit, |_| "".into()))
            };
            Some(format!("`{name}` is {unit} as {origin}"))
        });
        let reasons = reasons.take(4).collect::<Vec<_>>().join(", ");
        let general = diagnostic.help_text().to_owned();
        if reasons.is_empty() { diagnostic } else { diagnostic.help(format!("{general}; {reasons}")) }
    }
}

/// Whether a literal without a unit multiplies something.
fn has_bare_factor(formula: &Formula) -> bool {
    let is_bare = |formula: &Formula| matches!(formula.kind, FormulaKind::Number(_, None));
    match &formula.kind {
        FormulaKind::Product(factors) => factors
            .iter()
            .any(|factor| (!factor.divides && is_bare(&factor.formula)) || has_bare_factor(&factor.formula)),
        _ => false,
    }
}

/// The unit of a place, for parameters.
pub(super) fn unit_of(constant: [Number; 3]) -> String {
    let unit = Exponents { constant, fields: vec![] };
    if unit.is_none() { "1".to_owned() } else { unit_text(&unit, |_| String::new()) }
}

/// Whether exponents are those of a quantity.
pub(super) fn is_quantity(constant: [Number; 3], quantity: Quantity) -> bool {
    Exponents { constant, fields: vec![] }
        .plus(Number::integer(-1), &Exponents::of(quantity.exponents()))
        .is_none()
}
