//! Numbers with a derivative: a scalar that a user might bring, and a second way to every derivative.

use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use dynamics_core::scalar::{One, Scalar, Zero};

use crate::Vector;

/// `value + tangent·ε` with `ε² = 0`.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Dual {
    /// The number.
    pub value: f64,
    /// Its derivative.
    pub tangent: f64,
}

impl Dual {
    /// The entries of `x` on their way along `rate`.
    pub fn moving(x: &Vector, rate: &Vector) -> Vector<Self> {
        x.zip_map(rate, |value, tangent| Self { value, tangent })
    }

    /// The entries of `x` at rest.
    pub fn resting(x: &Vector) -> Vector<Self> {
        x.map(Self::of)
    }
}

impl Add for Dual {
    type Output = Self;

    fn add(self, rhs: Self) -> Self {
        Self { value: self.value + rhs.value, tangent: self.tangent + rhs.tangent }
    }
}

impl Sub for Dual {
    type Output = Self;

    fn sub(self, rhs: Self) -> Self {
        Self { value: self.value - rhs.value, tangent: self.tangent - rhs.tangent }
    }
}

impl Mul for Dual {
    type Output = Self;

    fn mul(self, rhs: Self) -> Self {
        let tangent = self.tangent * rhs.value + self.value * rhs.tangent;
        Self { value: self.value * rhs.value, tangent }
    }
}

impl Div for Dual {
    type Output = Self;

    fn div(self, rhs: Self) -> Self {
        let value = self.value / rhs.value;
        Self { value, tangent: (self.tangent - value * rhs.tangent) / rhs.value }
    }
}

impl Neg for Dual {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, tangent: -self.tangent }
    }
}

impl AddAssign for Dual {
    fn add_assign(&mut self, rhs: Self) {
        *self = *self + rhs;
    }
}

impl SubAssign for Dual {
    fn sub_assign(&mut self, rhs: Self) {
        *self = *self - rhs;
    }
}

impl MulAssign for Dual {
    fn mul_assign(&mut self, rhs: Self) {
        *self = *self * rhs;
    }
}

impl DivAssign for Dual {
    fn div_assign(&mut self, rhs: Self) {
        *self = *self / rhs;
    }
}

impl Zero for Dual {
    fn zero() -> Self {
        Self::of(0.0)
    }

    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl One for Dual {
    fn one() -> Self {
        Self::of(1.0)
    }
}

impl Scalar for Dual {
    fn of(value: f64) -> Self {
        Self { value, tangent: 0.0 }
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        let sine = Self { value: sin, tangent: cos * self.tangent };
        (sine, Self { value: cos, tangent: -sin * self.tangent })
    }

    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        Self { value, tangent: self.tangent / (2.0 * value) }
    }

    fn is_finite(self) -> bool {
        self.value.is_finite() && self.tangent.is_finite()
    }
}

/// The value, which steps of an adaptive size and events go by.
impl From<Dual> for f64 {
    fn from(dual: Dual) -> Self {
        dual.value
    }
}
