//! Formulas to expressions: fields become inputs of the graph, numbers with units become SI.

use rustc_hash::FxHashMap;

use super::quantities::Slot;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::spatial::Vector3;
use crate::spec::{
    Factor, Field, Formula, FormulaKind, Function, JointKind, JointSpec, Moving, Name, RobotSpec, Unit,
};
use crate::symbolic::{Expr, Graph, Number, SymbolId};

/// A value, or the first mistake in it.
pub(super) type Result<T> = std::result::Result<T, Diagnostic>;

/// The values of names.
pub(super) struct Values<'s, 'g> {
    fields: &'s [Field],
    /// For look-up only.
    by_name: FxHashMap<&'s str, usize>,
    /// What stands for each field that is used: an input, or its number.
    used: Vec<Option<Expr<'g>>>,
    joints: &'s [JointSpec],
    /// For look-up only.
    joint_by_name: FxHashMap<&'s str, usize>,
}

impl<'s, 'g> Values<'s, 'g> {
    /// Finds the fields that are used, and numbers them in the order of declaration.
    pub(super) fn new(
        spec: &'s RobotSpec,
        slots: &[Slot<'s>],
        graph: &'g Graph,
        diags: &mut Diagnostics,
    ) -> Self {
        let fields = &spec.fields;
        let by_name: FxHashMap<_, _> =
            fields.iter().enumerate().map(|(i, field)| (&*field.name.text, i)).collect();
        let mut used = vec![false; fields.len()];
        for slot in slots {
            for_each_name(slot.formula, &mut |name| match by_name.get(&*name.text) {
                Some(&field) if slot.constant.is_none() => used[field] = true,
                Some(_) => diags.push(field_where_number_is_needed(slot, name)),
                None if is_pi(name) => {}
                // Whether it is a coordinate is for those to judge who know what moves.
                None if slot.is_term() => {}
                None => diags.push(unknown_field(fields, name)),
            });
        }
        let mut count = 0;
        let number = |field: &Field| spec.known.iter().find(|(name, _)| *name == field.name.text);
        let used = fields.iter().zip(used).map(|(field, used)| {
            used.then(|| match number(field) {
                Some((_, number)) => Expr::Constant(*number),
                None => {
                    count += 1;
                    graph.symbol(SymbolId(count - 1))
                }
            })
        });
        let joint_by_name = spec.joints.iter().enumerate().map(|(k, joint)| (&*joint.name.text, k)).collect();
        Self { fields, used: used.collect(), by_name, joints: &spec.joints, joint_by_name }
    }

    /// The joint of a name that is no field.
    pub(super) fn joint(&self, name: &Name) -> Option<usize> {
        match self.field(name) {
            None => self.joint_by_name.get(&*name.text).copied(),
            Some(_) => None,
        }
    }

    /// The exponents of kg, m and s in a joint's one coordinate.
    pub(super) fn unit_of_coordinate(&self, name: &Name) -> Option<[i8; 3]> {
        let joint = &self.joints[self.joint(name)?];
        match joint.kind {
            JointKind::Prismatic => Some([0, 1, 0]),
            kind => (kind.speeds() == 1).then_some([0; 3]),
        }
    }

    /// The same in a coordinate or a speed of a joint that has several.
    pub(super) fn unit_of_part(&self, joint: &Name, part: &Name) -> Option<[i8; 3]> {
        let kind = self.joints[*self.joint_by_name.get(&*joint.text)?].kind;
        let at = |parts: &[&str]| parts.iter().position(|known| part.text == *known);
        let (index, seconds) = match (at(kind.coordinate_parts()), at(kind.speed_parts())) {
            // The position of a free joint comes first, as its linear speeds do.
            (Some(index), _) => (index, 0),
            (None, Some(index)) => (index, -1),
            (None, None) => return None,
        };
        Some(if *kind.turns().get(index)? { [0, 0, seconds] } else { [0, 1, seconds] })
    }

    /// The fields that are inputs, in order of declaration, as their positions among all fields.
    pub(super) fn inputs(&self) -> impl Iterator<Item = usize> {
        let is_input = |value: &Expr<'g>| value.as_number().is_none();
        self.used
            .iter()
            .enumerate()
            .filter(move |(_, used)| used.as_ref().is_some_and(is_input))
            .map(|(field, _)| field)
    }

    /// The position of a field.
    pub(super) fn field(&self, name: &Name) -> Option<usize> {
        self.by_name.get(&*name.text).copied()
    }

    /// The fields of the struct.
    pub(super) fn fields(&self) -> &'s [Field] {
        self.fields
    }

    /// The value of a formula.
    pub(super) fn scalar(&self, formula: &Formula) -> Result<Expr<'g>> {
        let value = match &formula.kind {
            FormulaKind::Number(value, unit) => Expr::Constant(in_si(*value, *unit)),
            FormulaKind::Name(name) => self.name(name)?,
            FormulaKind::Negative(inner) => -self.scalar(inner)?,
            FormulaKind::Sum(terms) => {
                let mut sum = Expr::ZERO;
                for term in terms {
                    let value = self.scalar(&term.formula)?;
                    sum = if term.negative { sum - value } else { sum + value };
                }
                sum
            }
            FormulaKind::Product(factors) => self.product(factors)?,
            FormulaKind::Call(function, argument) => self.call(*function, argument)?,
            FormulaKind::Power(base, exponent) => self.power(base, *exponent)?,
            FormulaKind::Moving(_) => return Err(moves(formula)),
        };
        match value.as_number() {
            Some(number) if !number.is_finite() || !number.to_f64().is_finite() => Err(out_of_range(formula)),
            _ => Ok(value),
        }
    }

    fn name(&self, name: &Name) -> Result<Expr<'g>> {
        match self.field(name) {
            Some(field) => self.used[field].ok_or_else(|| unknown_field(self.fields, name)),
            None if is_pi(name) => Ok(Expr::Constant(Number::PI)),
            None => Err(unknown_field(self.fields, name)),
        }
    }

    fn product(&self, factors: &[Factor]) -> Result<Expr<'g>> {
        let mut product = Expr::ONE;
        for Factor { divides, formula } in factors {
            let value = self.scalar(formula)?;
            product = match divides {
                false => product * value,
                true if value.is_zero() || self.cancels(formula) => return Err(divisor_is_zero(formula)),
                true => product.checked_div(value).ok_or_else(|| out_of_range(formula))?,
            };
        }
        Ok(product)
    }

    fn power(&self, base: &Formula, exponent: i32) -> Result<Expr<'g>> {
        let value = self.scalar(base)?;
        let power = (0..exponent.unsigned_abs()).fold(Expr::ONE, |power, _| power * value);
        match exponent < 0 {
            true if value.is_zero() || self.cancels(base) => Err(divisor_is_zero(base)),
            true => Expr::ONE.checked_div(power).ok_or_else(|| out_of_range(base)),
            false => Ok(power),
        }
    }

    /// Whether the terms of a formula cancel whatever the fields are, as in `(a + b) - a - b`.
    fn cancels(&self, formula: &Formula) -> bool {
        [0.3, 0.7, 1.1].iter().all(|&step| {
            let (value, size) = self.trial(formula, step);
            value.abs() <= 1e-13 * size
        })
    }

    /// The value of a formula where no two fields are alike, and the sum of the sizes of its terms.
    fn trial(&self, formula: &Formula, step: f64) -> (f64, f64) {
        match &formula.kind {
            FormulaKind::Number(value, unit) => {
                let value = in_si(*value, *unit).to_f64();
                (value, value.abs())
            }
            FormulaKind::Name(name) => {
                let field = |k: usize| 0.5 + (0.618_034 * (k + 1) as f64 * step).fract();
                let value = self.field(name).map_or(std::f64::consts::PI, field);
                (value, value)
            }
            FormulaKind::Negative(inner) => {
                let (value, size) = self.trial(inner, step);
                (-value, size)
            }
            FormulaKind::Sum(terms) => terms.iter().fold((0.0, 0.0), |(sum, sizes), term| {
                let (value, size) = self.trial(&term.formula, step);
                (if term.negative { sum - value } else { sum + value }, sizes + size)
            }),
            FormulaKind::Product(factors) => factors.iter().fold((1.0, 1.0), |(product, sizes), factor| {
                let (value, size) = self.trial(&factor.formula, step);
                if factor.divides {
                    (product / value, sizes / value.abs())
                } else {
                    (product * value, sizes * size)
                }
            }),
            FormulaKind::Call(function, argument) => {
                let (value, size) = self.trial(argument, step);
                match function {
                    Function::Sin => (value.sin(), 1.0),
                    Function::Cos => (value.cos(), 1.0),
                    Function::Sqrt => (value.sqrt(), size.sqrt()),
                }
            }
            FormulaKind::Power(base, exponent) => {
                let (value, size) = self.trial(base, step);
                let size = if *exponent < 0 { value.abs() } else { size };
                (value.powi(*exponent), size.powi(*exponent))
            }
            FormulaKind::Moving(_) => (f64::NAN, f64::NAN),
        }
    }

    fn call(&self, function: Function, argument: &Formula) -> Result<Expr<'g>> {
        let value = self.scalar(argument)?;
        match function {
            Function::Sin => Ok(value.sin()),
            Function::Cos => Ok(value.cos()),
            Function::Sqrt => value.sqrt().ok_or_else(|| {
                let message = format!("the root of `{}` is no number", argument.short_text());
                Diagnostic::new(Code::RootOfNegative, &argument.place, message)
            }),
        }
    }

    /// The value of a formula, or of nothing.
    pub(super) fn scalar_or(&self, formula: Option<&Formula>, nothing: Expr<'g>) -> Result<Expr<'g>> {
        formula.map_or(Ok(nothing), |formula| self.scalar(formula))
    }

    /// The values of three formulas.
    pub(super) fn vector(&self, [x, y, z]: &[Formula; 3]) -> Result<Vector3<Expr<'g>>> {
        Ok(Vector3([self.scalar(x)?, self.scalar(y)?, self.scalar(z)?]))
    }

    /// The values of three formulas; zero if nothing was written.
    pub(super) fn vector_or_zero(&self, parts: Option<&[Formula; 3]>) -> Result<Vector3<Expr<'g>>> {
        parts.map_or(Ok(Vector3([Expr::ZERO; 3])), |parts| self.vector(parts))
    }

    /// The value of a formula without fields.
    pub(super) fn number(&self, formula: &Formula) -> Result<Number> {
        self.scalar(formula)?.as_number().ok_or_else(|| {
            Diagnostic::new(Code::ConstantNeeded, &formula.place, "a number is needed here, not a field")
        })
    }
}

/// Calls `visit` with each name of a field, or of π, in a formula.
pub(super) fn for_each_name(formula: &Formula, visit: &mut impl FnMut(&Name)) {
    match &formula.kind {
        FormulaKind::Number(..) => {}
        FormulaKind::Name(name) => visit(name),
        FormulaKind::Negative(inner)
        | FormulaKind::Call(_, inner)
        | FormulaKind::Power(inner, _)
        | FormulaKind::Moving(Moving::Rate(inner)) => for_each_name(inner, visit),
        FormulaKind::Moving(_) => {}
        FormulaKind::Sum(terms) => terms.iter().for_each(|term| for_each_name(&term.formula, visit)),
        FormulaKind::Product(factors) => {
            factors.iter().for_each(|factor| for_each_name(&factor.formula, visit))
        }
    }
}

/// What the number π is called in formulas.
const PI: [&str; 3] = ["pi", "PI", "π"];

/// Whether a name is that of the number π.
pub(super) fn is_pi(name: &Name) -> bool {
    PI.contains(&name.text.as_str())
}

/// Fields and joints that would hide π from a formula, each once, where they are declared.
pub(super) fn check_reserved(spec: &RobotSpec, slots: &[Slot], diags: &mut Diagnostics) {
    let mut asked = [false; PI.len()];
    for slot in slots {
        for_each_name(slot.formula, &mut |name| {
            if let Some(at) = PI.iter().position(|known| *known == name.text) {
                // A value has no joints.
                let is_hidden =
                    slot.is_term() || spec.fields.iter().any(|field| field.name.text == name.text);
                asked[at] |= is_hidden;
            }
        });
    }
    let is_asked = |name: &Name| PI.iter().zip(asked).any(|(known, asked)| asked && *known == name.text);
    let fields = spec.fields.iter().map(|field| ("field", &field.name));
    let joints = spec.joints.iter().map(|joint| ("joint", &joint.name));
    for (what, name) in fields.chain(joints).filter(|(_, name)| is_asked(name)) {
        let message = format!("the {what} `{name}` hides the number π, which formulas call so");
        let help = "choose another name: `pi`, `PI` and `π` are the number in every formula";
        diags.push(Diagnostic::new(Code::NameReserved, &name.place, message).help(help));
    }
}

fn in_si(value: Number, unit: Option<Unit>) -> Number {
    let Some(unit) = unit else { return value };
    let (num, den, pi) = unit.scale;
    let scale = Number::ratio(num, den);
    value * if pi { scale * Number::PI } else { scale }
}

fn divisor_is_zero(formula: &Formula) -> Diagnostic {
    let message = format!("the divisor `{}` is zero", formula.short_text());
    Diagnostic::new(Code::DivisionByZero, &formula.place, message)
}

fn moves(formula: &Formula) -> Diagnostic {
    let message = format!("`{}` moves, and a value is needed", formula.short_text());
    Diagnostic::new(Code::ConstantNeeded, &formula.place, message)
}

fn out_of_range(formula: &Formula) -> Diagnostic {
    let message = format!("the value of `{}` is out of range", formula.short_text());
    Diagnostic::new(Code::NumberOutOfRange, &formula.place, message)
}

fn field_where_number_is_needed(slot: &Slot, name: &Name) -> Diagnostic {
    let message = format!("{} depends on the field `{name}`", slot.name());
    Diagnostic::new(slot.constant.unwrap_or(Code::ConstantNeeded), &name.place, message)
}

fn unknown_field(fields: &[Field], name: &Name) -> Diagnostic {
    let message = format!("there is no field `{name}`");
    let known = fields.iter().map(|field| field.name.text.as_str()).chain(["pi"]);
    Diagnostic::new(Code::FieldUnknown, &name.place, message).suggest(&name.text, known)
}
