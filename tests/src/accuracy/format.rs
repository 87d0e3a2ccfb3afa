//! The formats of floats in which accuracy is measured.

use std::ops::{Add, Div, Mul, Neg, Sub};

use dynamics_codegen::symbolic::{Number, Real};
use dynamics_core::prelude::Scalar;

/// A format of floats, as the plain recursion computes in it.
pub trait Format: Real {
    /// The same for the derived Rust.
    type Float: Scalar + Into<f64>;

    /// The nearest number of the format.
    fn round(x: f64) -> Self;

    /// The same for the derived Rust.
    fn float(x: f64) -> Self::Float;

    /// The double with the same value.
    fn to_f64(self) -> f64;
}

impl Format for f64 {
    type Float = f64;
    fn round(x: f64) -> Self {
        x
    }
    fn float(x: f64) -> f64 {
        x
    }
    fn to_f64(self) -> f64 {
        self
    }
}

/// A number in single precision. `f32` itself cannot be a [`Real`]: it is not made of every `i32`.
#[derive(Clone, Copy, Debug)]
pub struct Single(f32);

impl Format for Single {
    type Float = f32;
    fn round(x: f64) -> Self {
        Self(x as f32)
    }
    fn float(x: f64) -> f32 {
        x as f32
    }
    fn to_f64(self) -> f64 {
        self.0.into()
    }
}

impl From<i32> for Single {
    fn from(x: i32) -> Self {
        Self(x as f32)
    }
}

impl Add for Single {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        Self(self.0 + rhs.0)
    }
}

impl Sub for Single {
    type Output = Self;
    fn sub(self, rhs: Self) -> Self {
        Self(self.0 - rhs.0)
    }
}

impl Mul for Single {
    type Output = Self;
    fn mul(self, rhs: Self) -> Self {
        Self(self.0 * rhs.0)
    }
}

impl Div for Single {
    type Output = Self;
    fn div(self, rhs: Self) -> Self {
        Self(self.0 / rhs.0)
    }
}

impl Neg for Single {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Real for Single {
    fn of(number: Number) -> Self {
        Self(number.to_f64() as f32)
    }
    fn is_zero(self) -> bool {
        self.0 == 0.0
    }
    fn is_positive(self) -> bool {
        self.0 > 0.0
    }
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    fn sin(self) -> Self {
        Self(self.0.sin())
    }
    fn cos(self) -> Self {
        Self(self.0.cos())
    }
}
