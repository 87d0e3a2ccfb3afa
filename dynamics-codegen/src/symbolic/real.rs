//! Numbers of any precision: what expressions have as their values.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Number;

/// A real number to some precision: `f64`, a constant of the compiler with its thirty digits, or another.
pub trait Real:
    Copy
    + Debug
    + From<i32>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The value nearest to `number`.
    fn of(number: Number) -> Self;

    /// Whether this is 0.
    fn is_zero(self) -> bool;

    /// Whether this is more than 0; what is no number is not.
    fn is_positive(self) -> bool;

    /// `√self` of what is not negative.
    fn sqrt(self) -> Self;

    /// `sin self`, in radians.
    fn sin(self) -> Self;

    /// `cos self`, in radians.
    fn cos(self) -> Self;

    /// The value of a double; no number, if that is none or infinite.
    fn of_double(value: f64) -> Self {
        Self::of(Number::from_f64(value).unwrap_or(Number::NAN))
    }

    /// `|self|`
    fn magnitude(self) -> Self {
        if self.is_positive() { self } else { -self }
    }

    /// The larger of two.
    fn larger(self, other: Self) -> Self {
        if (other - self).is_positive() { other } else { self }
    }
}

impl Real for f64 {
    fn of(number: Number) -> Self {
        number.to_f64()
    }
    fn is_zero(self) -> bool {
        self == 0.0
    }
    fn is_positive(self) -> bool {
        self > 0.0
    }
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    fn sin(self) -> Self {
        f64::sin(self)
    }
    fn cos(self) -> Self {
        f64::cos(self)
    }
}

impl Real for Number {
    fn of(number: Number) -> Self {
        number
    }
    fn is_zero(self) -> bool {
        Number::is_zero(self)
    }
    fn is_positive(self) -> bool {
        self.signum() > 0
    }
    fn sqrt(self) -> Self {
        Number::sqrt(self).unwrap_or(Number::NAN)
    }
    fn sin(self) -> Self {
        Number::sin(self)
    }
    fn cos(self) -> Self {
        Number::cos(self)
    }
}
