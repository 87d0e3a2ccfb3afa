//! Dual numbers: exact derivatives along one direction.

use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use dynamics_core::prelude::*;
use dynamics_core::scalar::{One, Zero};

/// `value + tangent·ε` with `ε² = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual {
    pub value: f64,
    pub tangent: f64,
}

macro_rules! dual_operator {
    ($trait:ident, $method:ident, $assign:ident, $assign_method:ident, |$a:ident, $b:ident| $result:expr) => {
        impl $trait for Dual {
            type Output = Self;
            fn $method(self, $b: Self) -> Self {
                let $a = self;
                let (value, tangent) = $result;
                Self { value, tangent }
            }
        }
        impl $assign for Dual {
            fn $assign_method(&mut self, rhs: Self) {
                *self = $trait::$method(*self, rhs);
            }
        }
    };
}

dual_operator!(Add, add, AddAssign, add_assign, |a, b| (a.value + b.value, a.tangent + b.tangent));
dual_operator!(Sub, sub, SubAssign, sub_assign, |a, b| (a.value - b.value, a.tangent - b.tangent));
dual_operator!(Mul, mul, MulAssign, mul_assign, |a, b| {
    (a.value * b.value, a.tangent * b.value + a.value * b.tangent)
});
dual_operator!(Div, div, DivAssign, div_assign, |a, b| {
    (a.value / b.value, (a.tangent - a.value / b.value * b.tangent) / b.value)
});

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, tangent: -self.tangent }
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
        let (sin, cos) = f64::sin_cos(self.value);
        let sine = Self { value: sin, tangent: cos * self.tangent };
        (sine, Self { value: cos, tangent: -sin * self.tangent })
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Self { value: root, tangent: self.tangent / (2.0 * root) }
    }
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.tangent.is_finite()
    }
}

/// `x + rate·ε`
pub fn moving<const N: usize>(x: &SVector<f64, N>, rate: &SVector<f64, N>) -> SVector<Dual, N> {
    x.zip_map(rate, |value, tangent| Dual { value, tangent })
}

pub fn resting<const N: usize>(x: &SVector<f64, N>) -> SVector<Dual, N> {
    x.map(Dual::of)
}

pub fn tangent<const R: usize, const C: usize>(x: &SMatrix<Dual, R, C>) -> SMatrix<f64, R, C> {
    x.map(|x| x.tangent)
}
