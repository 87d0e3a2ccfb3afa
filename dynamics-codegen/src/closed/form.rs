//! `Form`: an expression as it stands on paper, with its order, its signs and its parentheses.

use crate::symbolic::{Number, SymbolId};

/// An expression as it is written. Two forms are equal if they are written alike.
///
/// What is made by the functions of its kinds ([`Form::sum`] and the like) can be printed and read back to the same
/// form: signs stand in front of terms only, numbers in front of products, sums do not stand directly in sums.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Form {
    /// A number that is not negative.
    Number(Number),
    /// A name.
    Symbol(SymbolId),
    /// `−x`
    Negative(Box<Form>),
    /// Two terms or more.
    Sum(Vec<Form>),
    /// Two factors or more.
    Product(Vec<Form>),
    /// `a/b`
    Quotient(Box<Form>, Box<Form>),
    /// `xⁿ` for n ≥ 2.
    Power(Box<Form>, u32),
    /// `sin x`
    Sin(Box<Form>),
    /// `cos x`
    Cos(Box<Form>),
    /// `√x`
    Root(Box<Form>),
}

impl Form {
    /// 0
    pub const ZERO: Self = Self::Number(Number::ZERO);
    /// 1
    pub const ONE: Self = Self::Number(Number::ONE);

    /// A number. What is not written exactly has six digits on paper, for nobody reads more.
    pub fn number(value: Number) -> Self {
        let magnitude = match value.abs() {
            exact if is_written_exactly(exact) => exact,
            float => Number::parse_decimal(&format!("{:.5e}", float.to_f64())).unwrap_or(float),
        };
        let form = Self::Number(magnitude);
        if value.is_negative() { Self::Negative(Box::new(form)) } else { form }
    }

    /// A whole number.
    pub fn integer(value: i64) -> Self {
        Self::number(Number::integer(value))
    }

    /// Whether this is 0.
    pub fn is_zero(&self) -> bool {
        *self == Self::ZERO
    }

    /// Whether this is 1.
    pub fn is_one(&self) -> bool {
        *self == Self::ONE
    }

    /// `−self`
    #[must_use]
    pub fn negative(self) -> Self {
        match self {
            Self::Negative(inner) => *inner,
            zero if zero.is_zero() => zero,
            form => Self::Negative(Box::new(form)),
        }
    }

    /// The sign of a form, and what is left without it.
    pub fn split_sign(self) -> (bool, Self) {
        match self {
            Self::Negative(inner) => (true, *inner),
            form => (false, form),
        }
    }

    /// The sum of terms, in their order. Sums among them become terms.
    pub fn sum(terms: impl IntoIterator<Item = Self>) -> Self {
        let mut flat = Vec::new();
        for term in terms {
            match term {
                Self::Sum(terms) => flat.extend(terms),
                zero if zero.is_zero() => {}
                term => flat.push(term),
            }
        }
        match flat.len() {
            0 => Self::ZERO,
            1 => flat.swap_remove(0),
            _ => Self::Sum(flat),
        }
    }

    /// The product of factors, in their order, with the signs and the numbers among them in front.
    pub fn product(factors: impl IntoIterator<Item = Self>) -> Self {
        let (mut negative, mut number, mut flat) = (false, Number::ONE, Vec::new());
        let mut waiting: Vec<Self> = factors.into_iter().collect();
        waiting.reverse();
        while let Some(factor) = waiting.pop() {
            match factor {
                Self::Number(value) => number = number * value,
                Self::Negative(inner) => {
                    negative = !negative;
                    waiting.push(*inner);
                }
                Self::Product(factors) => waiting.extend(factors.into_iter().rev()),
                factor => flat.push(factor),
            }
        }
        if number.is_zero() {
            return Self::ZERO;
        }
        if !number.is_one() || flat.is_empty() {
            flat.insert(0, Self::Number(number));
        }
        let product = if flat.len() == 1 { flat.swap_remove(0) } else { Self::Product(flat) };
        if negative { product.negative() } else { product }
    }

    /// `self / divisor`, with the sign in front. A quotient of numbers is a number; one by zero stays as it is.
    #[must_use]
    pub fn over(self, divisor: Self) -> Self {
        let ((minus, above), (minus_below, below)) = (self.split_sign(), divisor.split_sign());
        let quotient = match (above, below) {
            (above, below) if below.is_one() || above.is_zero() && !below.is_zero() => above,
            (Self::Number(above), Self::Number(below)) if !below.is_zero() => {
                Self::number(above.checked_div(below).unwrap_or(above))
            }
            (Self::Quotient(above, first), below) => {
                Self::Quotient(above, Box::new(Self::product([*first, below])))
            }
            (above, below) => Self::Quotient(Box::new(above), Box::new(below)),
        };
        if minus == minus_below { quotient } else { quotient.negative() }
    }

    /// `selfⁿ`
    #[must_use]
    pub fn power(self, n: u32) -> Self {
        match (self, n) {
            (_, 0) => Self::ONE,
            (form, 1) => form,
            (Self::Number(value), n) => Self::number((0..n).fold(Number::ONE, |power, _| power * value)),
            (Self::Negative(inner), n) if n % 2 == 0 => inner.power(n),
            (Self::Negative(inner), n) => inner.power(n).negative(),
            (Self::Power(base, m), n) => Self::Power(base, m * n),
            (form, n) => Self::Power(Box::new(form), n),
        }
    }

    /// `sin self`
    #[must_use]
    pub fn sin(self) -> Self {
        Self::Sin(Box::new(self))
    }

    /// `cos self`
    #[must_use]
    pub fn cos(self) -> Self {
        Self::Cos(Box::new(self))
    }

    /// `√self`; of a number it is one where that is exact.
    #[must_use]
    pub fn root(self) -> Self {
        let number = if let Self::Number(value) = self { value.sqrt() } else { None };
        match number {
            Some(root @ Number::Exact(_)) => Self::number(root),
            _ => Self::Root(Box::new(self)),
        }
    }

    /// Whether the argument of a function is written without parentheses: a name, or a whole number of it.
    pub(super) fn is_plain_argument(&self) -> bool {
        match self {
            Self::Symbol(_) => true,
            Self::Product(factors) => {
                let is_whole = |value: &Number| matches!(value, Number::Exact(exact) if exact.denominator() == 1 && exact.is_rational());
                matches!(&factors[..], [Self::Number(value), Self::Symbol(_)] if is_whole(value))
            }
            _ => false,
        }
    }

    /// Whether it ends with the argument of a sine or cosine, for it is one or a power of one.
    pub(super) fn is_function(&self) -> bool {
        match self {
            Self::Sin(_) | Self::Cos(_) => true,
            Self::Power(base, _) => base.is_function(),
            _ => false,
        }
    }

    /// The parts of a form.
    pub fn parts(&self) -> Vec<&Self> {
        match self {
            Self::Number(_) | Self::Symbol(_) => vec![],
            Self::Negative(x) | Self::Power(x, _) | Self::Sin(x) | Self::Cos(x) | Self::Root(x) => vec![x],
            Self::Quotient(a, b) => vec![a, b],
            Self::Sum(parts) | Self::Product(parts) => parts.iter().collect(),
        }
    }
}

/// Whether a number is written as it is: a fraction of no more than twelve digits above and below, a root beside no more
/// than two, what has powers of π; but no float.
pub(super) fn is_written_exactly(value: Number) -> bool {
    const TWELVE_DIGITS: u128 = 1_000_000_000_000;
    const TWO_DIGITS: u128 = 100;
    let Number::Exact(exact) = value else { return false };
    let longest = exact.numerator().unsigned_abs().max(exact.denominator().unsigned_abs());
    match (exact.radicand(), exact.pi_power()) {
        (1, 0) => longest < TWELVE_DIGITS,
        (1, _) => true,
        _ => longest < TWO_DIGITS,
    }
}

/// The terms of a sum, each with its sign in front: of a first one that is subtracted, of others that are, of others.
pub(super) fn signed<'f>(
    terms: &'f [Form],
    [first_minus, minus, plus]: [&'f str; 3],
) -> impl Iterator<Item = (&'f str, &'f Form)> {
    terms.iter().enumerate().map(move |(k, term)| match (k, term) {
        (0, Form::Negative(inner)) => (first_minus, &**inner),
        (0, term) => ("", term),
        (_, Form::Negative(inner)) => (minus, &**inner),
        (_, term) => (plus, term),
    })
}
