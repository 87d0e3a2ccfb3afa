//! Exact constants: what the compiler knows of a number until it writes it down.
//!
//! A constant is a fraction times a root of a whole number and a power of π, exactly, for as long as that
//! fits into 128 bits, and otherwise a float of more than 100 bits. It is rounded to a double once, by
//! [`Number::to_f64`].
//! Nothing here depends on the host: no library function, no fused operation, no heap but for text.

mod ratio;
#[cfg(test)]
mod tests;
mod text;
mod trig;
mod unit;
mod wide;

pub use ratio::Exact;
pub use wide::Wide;

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A constant of the equations.
///
/// `==` compares what is stored: numbers that are `==` have the same value and may be merged. A value
/// that is one double and fits [`Number::Exact`] is always stored as such; in particular zero is always
/// [`Number::ZERO`], and one is [`Number::ONE`]. By value, with order: [`cmp_value`](Self::cmp_value).
///
/// The operators are exact where the result fits. Where it does not they round to a [`Wide`], and
/// - a sum of rounded terms below 2^-96 of the larger one is noise, and is zero;
/// - a result beyond the range of doubles is not a number: ask [`is_finite`](Self::is_finite).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Number {
    /// A fraction times a root of a whole number and a power of π.
    Exact(Exact),
    /// A rounded number, never zero; or the mark of a result that is no number.
    Float(Wide),
}

impl Number {
    /// 0
    pub const ZERO: Self = Self::Exact(Exact::ZERO);
    /// 1
    pub const ONE: Self = Self::Exact(Exact::ONE);
    /// π, exactly.
    pub const PI: Self = Self::Exact(Exact::PI);

    /// What is no number.
    pub(crate) const NAN: Self = Self::Float(Wide::NAN);

    /// A whole number.
    pub const fn integer(value: i64) -> Self {
        Self::Exact(Exact::integer(value))
    }

    /// `num / den`.
    ///
    /// # Panics
    ///
    /// If `den` is zero.
    pub fn ratio(num: i64, den: i64) -> Self {
        Self::Exact(
            Exact::reduced(num.into(), den.into()).expect("a ratio needs a denominator other than zero"),
        )
    }

    /// The value a finite double has, exactly; `None` of infinities and of what is not a number.
    pub fn from_f64(value: f64) -> Option<Self> {
        value.is_finite().then(|| Self::from_wide(Wide::from_f64(value)))
    }

    /// The number `text` says in decimal, as in `0.42`, `1e-3`, `1_000.5`, `-2`, `+.5`.
    ///
    /// Exact if it fits, else rounded to the nearest [`Wide`]. `None` of text that is not a decimal
    /// number, and of numbers so large or so small that their double is infinity, or zero.
    pub fn parse_decimal(text: &str) -> Option<Self> {
        text::parse_decimal(text)
    }

    /// Stores a rounded result: exactly, if it is one double and fits.
    fn from_wide(wide: Wide) -> Self {
        if wide.lo() == 0.0
            && let Some(exact) = Exact::from_f64(wide.hi())
        {
            return Self::Exact(exact);
        }
        Self::Float(wide)
    }

    fn to_wide(self) -> Wide {
        match self {
            Self::Exact(exact) => exact.to_wide(),
            Self::Float(wide) => wide,
        }
    }

    /// The nearest double: always for fractions, parsed numbers and floats, and for roots and powers of π up
    /// to their 100 bits. Not a number if the number is not finite.
    pub fn to_f64(self) -> f64 {
        match self {
            Self::Exact(exact) if exact.is_rational() => exact.ratio_to_f64(),
            _ => self.to_wide().hi(),
        }
    }

    /// The number as it is stored: `21/50`, `-π/2`, `3π²/4`, `√3/2`; the shortest decimal of a float.
    pub fn exact_text(self) -> String {
        match self {
            Self::Exact(exact) => text::exact_text(exact),
            Self::Float(_) => self.to_string(),
        }
    }

    /// Whether this is a number at all: false once a result was beyond the range of doubles.
    pub fn is_finite(self) -> bool {
        match self {
            Self::Exact(_) => true,
            Self::Float(wide) => wide.is_finite(),
        }
    }

    /// Whether this is 0.
    pub fn is_zero(self) -> bool {
        matches!(self, Self::Exact(exact) if exact.numerator() == 0)
    }

    /// Whether this is 1.
    pub fn is_one(self) -> bool {
        self == Self::ONE
    }

    /// Whether this is less than 0.
    pub fn is_negative(self) -> bool {
        self.signum() < 0
    }

    /// -1, 0 or 1, the sign of the number; 0 also if it is not finite.
    pub fn signum(self) -> i32 {
        match self {
            Self::Exact(exact) => exact.numerator().signum() as i32,
            Self::Float(wide) => i32::from(wide.hi() > 0.0) - i32::from(wide.is_negative()),
        }
    }

    /// `|self|`
    pub fn abs(self) -> Self {
        if self.is_negative() { -self } else { self }
    }

    /// The order by value, `Equal` only for equal values; what is not finite comes last.
    ///
    /// Different roots and powers of π closer than 2^-100 of their size are told apart, but by these.
    pub fn cmp_value(self, other: Self) -> Ordering {
        if self == other {
            return Ordering::Equal;
        }
        match (self, other) {
            (Self::Exact(a), Self::Exact(b)) if a.unit() == b.unit() => a.cmp_ratio(b),
            (Self::Exact(a), Self::Exact(b)) => a.to_wide().cmp(b.to_wide()).then(a.unit().cmp(&b.unit())),
            (Self::Float(a), Self::Float(b)) => a.cmp(b),
            (Self::Exact(a), Self::Float(b)) => cmp_exact_float(a, b),
            (Self::Float(a), Self::Exact(b)) => cmp_exact_float(b, a).reverse(),
        }
    }

    /// `self / rhs`; `None` if `rhs` is zero.
    pub fn checked_div(self, rhs: Self) -> Option<Self> {
        if rhs.is_zero() {
            return None;
        }
        if let (Self::Exact(a), Self::Exact(b)) = (self, rhs)
            && let Some(quotient) = b.checked_recip().and_then(|recip| a.checked_mul(recip))
        {
            return Some(Self::Exact(quotient));
        }
        Some(Self::from_wide(self.to_wide().div(rhs.to_wide())))
    }

    /// `√self`, exact of fractions with a short radicand; `None` of negative numbers.
    pub fn sqrt(self) -> Option<Self> {
        if self.is_negative() {
            return None;
        }
        if let Self::Exact(exact) = self
            && let Some(root) = exact.checked_sqrt()
        {
            return Some(Self::Exact(root));
        }
        Some(Self::from_wide(self.to_wide().sqrt()))
    }

    /// `sin(self)`, in radians; exact of multiples of π wherever it, or its square, is rational.
    ///
    /// Not finite from 2^50 rad on, unless the angle is a fraction of π.
    pub fn sin(self) -> Self {
        trig::sin_after_quarters(self, 0)
    }

    /// `cos(self)`, under the rules of [`sin`](Self::sin).
    pub fn cos(self) -> Self {
        trig::sin_after_quarters(self, 1)
    }

    /// The angle of the point `(x, y)` in `(-π, π]`, in radians; 0 at the origin.
    ///
    /// An exact multiple of π/4 on the axes and on the diagonals.
    pub fn atan2(y: Self, x: Self) -> Self {
        trig::atan2(y, x)
    }
}

/// As [`Number::cmp_value`]. An exact value as close to a float as that is decided by its difference,
/// and one whose difference does not fit is not equal to it: it comes first.
fn cmp_exact_float(exact: Exact, float: Wide) -> Ordering {
    let difference = || {
        let float = Exact::from_f64(float.hi())?.checked_add(Exact::from_f64(float.lo())?)?;
        exact.checked_add(float.neg())
    };
    match exact.to_wide().cmp(float) {
        Ordering::Equal => difference().map_or(Ordering::Less, |rest| rest.cmp_ratio(Exact::ZERO)),
        order => order,
    }
}

/// `a + b` of rounded terms, where what cancels to noise is zero.
fn rounded_sum(a: Wide, b: Wide) -> Number {
    let sum = a.add(b);
    let larger = a.hi().abs().max(b.hi().abs());
    if sum.hi().abs() < larger * wide::power_of_two(-96) {
        return Number::ZERO;
    }
    Number::from_wide(sum)
}

impl Add for Number {
    type Output = Self;

    fn add(self, rhs: Self) -> Self {
        if let (Self::Exact(a), Self::Exact(b)) = (self, rhs)
            && let Some(sum) = a.checked_add(b)
        {
            return Self::Exact(sum);
        }
        rounded_sum(self.to_wide(), rhs.to_wide())
    }
}

impl Sub for Number {
    type Output = Self;

    fn sub(self, rhs: Self) -> Self {
        self + -rhs
    }
}

impl Mul for Number {
    type Output = Self;

    fn mul(self, rhs: Self) -> Self {
        if let (Self::Exact(a), Self::Exact(b)) = (self, rhs)
            && let Some(product) = a.checked_mul(b)
        {
            return Self::Exact(product);
        }
        Self::from_wide(self.to_wide().mul(rhs.to_wide()))
    }
}

impl Div for Number {
    type Output = Self;

    /// By zero it is not a number: where that can be, ask [`Number::checked_div`].
    fn div(self, rhs: Self) -> Self {
        self.checked_div(rhs).unwrap_or(Self::NAN)
    }
}

impl From<i32> for Number {
    fn from(value: i32) -> Self {
        Self::integer(value.into())
    }
}

impl Neg for Number {
    type Output = Self;

    fn neg(self) -> Self {
        match self {
            Self::Exact(exact) => Self::Exact(exact.neg()),
            Self::Float(wide) => Self::Float(wide.neg()),
        }
    }
}
