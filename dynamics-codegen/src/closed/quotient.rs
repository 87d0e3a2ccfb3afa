//! What divides, on paper: where it stands, with which sign, and what it cancels.
//!
//! A line of text is read from left to right, and so a quotient is the last thing in a product, or its numbers stand in
//! front: `m ẋ²/x²`, `¼ a² cos²q`. Nothing is divided behind the argument of a function: that is `(g/l) sin θ`.

use super::form::is_written_exactly;
use super::item::{Factor, Item, Writer};
use super::notation::Role;
use super::ring::Variable;
use super::{Form, Polynomial};
use crate::symbolic::Number;

/// A root, or what divides: a variable of the ring, as it is written.
pub(super) struct Other {
    pub(super) place: usize,
    /// The root, or what is below.
    pub(super) form: Form,
    /// Of what divides: one over the polynomial of the ring is this over the form.
    scale: Number,
}

/// What divides is multiplied by this at most to be without fractions.
const MULTIPLE: i64 = 12;

impl Other {
    /// The root of a polynomial.
    pub(super) fn root(place: usize, inner: &Polynomial, writer: &Writer<'_>) -> Self {
        Self { place, form: writer.form(inner).root(), scale: Number::ONE }
    }

    /// What is below, with a plus in front, and without halves and thirds.
    pub(super) fn below(place: usize, below: &Polynomial, writer: &Writer<'_>) -> Self {
        let is_whole = |value: Number| matches!(value, Number::Exact(exact) if exact.denominator() == 1);
        let makes_whole = |multiple: &Number| below.terms().iter().all(|(_, k)| is_whole(*k * *multiple));
        let multiple = (1..=MULTIPLE).map(Number::integer).find(makes_whole).unwrap_or(Number::ONE);
        let form = writer.form(&below.scaled(multiple));
        let first = if let Form::Sum(terms) = &form { terms.first() } else { None };
        if matches!(first, Some(Form::Negative(_))) {
            return Self { place, form: writer.form(&below.scaled(-multiple)), scale: -multiple };
        }
        Self { place, form, scale: multiple }
    }
}

impl Writer<'_> {
    /// The item in which roots are cancelled, and what divides has the number of its form.
    pub(super) fn tidy(&self, mut item: Item) -> Item {
        for other in &self.others {
            let exponent = item.exponent(&Factor::Other(other.place));
            match &self.ring.variables()[other.place] {
                Variable::Root(square) if exponent == 1 => self.cancel_root(other.place, square, &mut item),
                _ => {}
            }
        }
        for other in &self.others {
            for _ in 0..item.exponent(&Factor::Other(other.place)) {
                item.coefficient = item.coefficient * other.scale;
            }
        }
        item
    }

    /// `√s/s = 1/√s`, and the same for higher powers of s below.
    fn cancel_root(&self, root: usize, square: &Polynomial, item: &mut Item) {
        let Some((leading, shared, inside)) = self.ring.parts(square) else { return };
        let mut cancelled = item.clone();
        let mut times = 1;
        if let Some(inside) = inside {
            let Some(place) = self.ring.place(&Variable::Inverse(inside)) else { return };
            times = item.exponent(&Factor::Other(place));
            cancelled.multiply(Factor::Other(place), -times);
        }
        if times < 1 {
            return;
        }
        cancelled.multiply(Factor::Other(root), -2 * times);
        for (place, exponent) in shared.exponents() {
            let factor = self.factor(place);
            cancelled.multiply(factor.clone(), times * exponent);
            if exponent.signum() * cancelled.exponent(&factor) > 0 {
                return; // more would be multiplied with than is cancelled
            }
        }
        for _ in 0..times {
            cancelled.coefficient = cancelled.coefficient * leading;
        }
        *item = cancelled;
    }

    /// A number times factors times other forms, which stand where factors of their kind would: `(place, form)` is
    /// before the factor with that place.
    pub(super) fn product(
        &self,
        coefficient: Number,
        factors: &[(Factor, i32)],
        others: Vec<(usize, Form)>,
    ) -> Form {
        let (mut above, mut below) = (Vec::new(), Vec::new());
        let mut others = others.into_iter().peekable();
        for k in 0..=factors.len() {
            while let Some((_, form)) = others.next_if(|(place, _)| *place <= k) {
                above.push(form);
            }
            let Some((factor, exponent)) = factors.get(k) else { continue };
            let form = self.form_of_factor(factor);
            let is_inverse = matches!(factor, Factor::Other(place) if matches!(self.ring.variables()[*place], Variable::Inverse(_)));
            let power = form.power(exponent.unsigned_abs());
            if (*exponent < 0) != is_inverse { below.push(power) } else { above.push(power) }
        }
        above.extend(others.map(|(_, form)| form));
        let above = flat(above);
        let magnitude = coefficient.abs();
        let form = match below.is_empty() {
            true => self.multiple(magnitude, above),
            false => quotient(magnitude, above, below),
        };
        if coefficient.is_negative() { form.negative() } else { form }
    }

    /// A number times factors: fractions are in front, or have what they divide on top of them, where that is short and
    /// all there is, or stands before a bracket.
    fn multiple(&self, number: Number, mut above: Vec<Form>) -> Form {
        let in_front = |above: Vec<Form>| Form::product(std::iter::once(Form::number(number)).chain(above));
        let Some((num, den)) = fraction(number).filter(|(_, den)| !is_half(number) && !den.is_one()) else {
            return in_front(above);
        };
        let over = |above: Vec<Form>| {
            Form::product(std::iter::once(Form::number(num)).chain(above)).over(Form::number(den))
        };
        let short = above.iter().take_while(|form| self.is_short(form)).count();
        match &above[short..] {
            [] if short > 0 => over(above),
            [Form::Sum(_)] if short > 0 => {
                let bracket = above.split_off(short);
                Form::product(std::iter::once(over(above)).chain(bracket))
            }
            [Form::Sum(_)] => over(above),
            _ => in_front(above),
        }
    }

    /// Whether it is π, a symbol that does not move, or a power of one.
    fn is_short(&self, form: &Form) -> bool {
        match form {
            Form::Number(_) => true,
            Form::Symbol(symbol) => self.notation.letter(*symbol).role <= Role::Coordinate,
            Form::Power(base, _) => self.is_short(base),
            _ => false,
        }
    }
}

/// The factors of factors, and no ones.
fn flat(forms: Vec<Form>) -> Vec<Form> {
    let factors = forms.into_iter().flat_map(|form| match form {
        Form::Product(factors) => factors,
        form => vec![form],
    });
    factors.filter(|form| !form.is_one()).collect()
}

/// `number · above / below`: all over all, but for sines at its end, which stand behind.
fn quotient(number: Number, mut above: Vec<Form>, mut below: Vec<Form>) -> Form {
    let (num, den) = fraction(number).unwrap_or((number, Number::ONE));
    below.insert(0, Form::number(den));
    let below = Form::product(below);
    let functions = above.iter().rev().take_while(|form| form.is_function()).count();
    let behind = if functions < above.len() { above.split_off(above.len() - functions) } else { vec![] };
    let quotient = Form::product(std::iter::once(Form::number(num)).chain(above)).over(below);
    Form::product(std::iter::once(quotient).chain(behind))
}

/// Numerator and denominator of a coefficient that is written as a fraction: halves, quarters, thirds and the like, and
/// one over powers of two; decimals are not. A root is above.
fn fraction(value: Number) -> Option<(Number, Number)> {
    let Number::Exact(exact) = value else { return None };
    let den = exact.denominator();
    let mut rest = den >> den.trailing_zeros();
    while rest % 5 == 0 {
        rest /= 5;
    }
    let is_decimal = rest == 1;
    let is_power = den <= 32 && exact.numerator() == 1 && den.count_ones() == 1;
    let is_fraction = !is_decimal || is_half(value) || is_power;
    (is_fraction && exact.pi_power() == 0 && is_written_exactly(value)).then_some(())?;
    let den = Number::parse_decimal(&den.to_string())?;
    Some((value * den, den))
}

/// Whether a coefficient is a half, or has a few halves or quarters, which stand in front.
fn is_half(value: Number) -> bool {
    matches!(value, Number::Exact(exact) if matches!((exact.numerator(), exact.denominator()), (1..=3, 2) | (3, 4)))
}
