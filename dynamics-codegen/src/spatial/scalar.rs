//! What a recursion needs of its numbers.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::symbolic::{Expr, Real};

/// A number, or something that becomes one: `f64`, an expression, a dual number.
pub trait Scalar:
    Copy
    + Debug
    + From<i32>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Zero.
    fn zero() -> Self {
        Self::from(0)
    }

    /// One.
    fn one() -> Self {
        Self::from(1)
    }

    /// Whether this is zero whatever the inputs are.
    fn is_zero(self) -> bool;

    /// The value, if it is 0, 1 or −1 whatever the inputs are.
    fn as_sign(self) -> Option<i8> {
        self.is_zero().then_some(0)
    }

    /// `sin self`
    fn sin(self) -> Self;

    /// `cos self`
    fn cos(self) -> Self;

    /// `√self` of what cannot be negative.
    fn sqrt(self) -> Self;

    /// `2·self`
    fn twice(self) -> Self {
        self + self
    }
}

impl<R: Real> Scalar for R {
    fn is_zero(self) -> bool {
        Real::is_zero(self)
    }
    fn sin(self) -> Self {
        Real::sin(self)
    }
    fn cos(self) -> Self {
        Real::cos(self)
    }
    fn sqrt(self) -> Self {
        Real::sqrt(self)
    }
}

impl Scalar for Expr<'_> {
    fn is_zero(self) -> bool {
        Expr::is_zero(self)
    }
    fn as_sign(self) -> Option<i8> {
        let value = self.as_number()?;
        if value.is_zero() {
            Some(0)
        } else {
            value.abs().is_one().then_some(if value.is_negative() { -1 } else { 1 })
        }
    }
    fn sin(self) -> Self {
        Expr::sin(self)
    }
    fn cos(self) -> Self {
        Expr::cos(self)
    }
    fn sqrt(self) -> Self {
        Expr::sqrt(self).expect("the root of a sum of squares")
    }
}
