//! Numbers that carry a derivative: forward automatic differentiation.
//!
//! `value + tangent·ε` with `ε² = 0`. A function of duals gives its value, and its derivative along the
//! tangents of its arguments, both to rounding: there is no step to choose.
//!
//! A. Griewank, A. Walther, *Evaluating Derivatives*, SIAM 2008, ch. 3.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::spatial::Scalar;

/// `value + tangent·ε`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<S = f64> {
    /// The number.
    pub value: S,
    /// Its derivative along the direction of differentiation.
    pub tangent: S,
}

impl<S: Scalar> Dual<S> {
    /// A number that does not change.
    pub fn constant(value: S) -> Self {
        Self { value, tangent: S::zero() }
    }

    /// The point `at`, moving with the velocity `direction`.
    pub fn moving(at: &[S], direction: &[S]) -> Vec<Self> {
        assert_eq!(at.len(), direction.len(), "a point moves in its own space");
        at.iter().zip(direction).map(|(&value, &tangent)| Self { value, tangent }).collect()
    }

    /// The point `at`, at rest.
    pub fn resting(at: &[S]) -> Vec<Self> {
        at.iter().copied().map(Self::constant).collect()
    }
}

impl<S: Scalar> Add for Dual<S> {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        Self { value: self.value + rhs.value, tangent: self.tangent + rhs.tangent }
    }
}

impl<S: Scalar> Sub for Dual<S> {
    type Output = Self;
    fn sub(self, rhs: Self) -> Self {
        Self { value: self.value - rhs.value, tangent: self.tangent - rhs.tangent }
    }
}

impl<S: Scalar> Mul for Dual<S> {
    type Output = Self;
    fn mul(self, rhs: Self) -> Self {
        let tangent = self.tangent * rhs.value + self.value * rhs.tangent;
        Self { value: self.value * rhs.value, tangent }
    }
}

impl<S: Scalar> Div for Dual<S> {
    type Output = Self;
    fn div(self, rhs: Self) -> Self {
        let value = self.value / rhs.value;
        Self { value, tangent: (self.tangent - value * rhs.tangent) / rhs.value }
    }
}

impl<S: Scalar> Neg for Dual<S> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, tangent: -self.tangent }
    }
}

impl<S: Scalar> From<i32> for Dual<S> {
    fn from(value: i32) -> Self {
        Self::constant(value.into())
    }
}

impl<S: Scalar> Scalar for Dual<S> {
    fn is_zero(self) -> bool {
        self.value.is_zero() && self.tangent.is_zero()
    }
    fn sin(self) -> Self {
        let (sin, cos) = (self.value.sin(), self.value.cos());
        Self { value: sin, tangent: cos * self.tangent }
    }
    fn cos(self) -> Self {
        let (sin, cos) = (self.value.sin(), self.value.cos());
        Self { value: cos, tangent: -sin * self.tangent }
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Self { value: root, tangent: self.tangent / (root + root) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `f(x) = sin(x²)/(2 − cos x)` at 0.7, against the derivative worked out by hand.
    #[test]
    fn follows_the_chain_rule() {
        let x = Dual { value: 0.7, tangent: 3.0 };
        let f = (x * x).sin() / (Dual::from(2) - x.cos());
        let (s, c) = 0.7_f64.sin_cos();
        let below = 2.0 - c;
        let slope = (2.0 * 0.7 * 0.49_f64.cos() * below - 0.49_f64.sin() * s) / (below * below);
        // A handful of operations of the size of one.
        assert!((f.value - 0.49_f64.sin() / below).abs() < 1e-15);
        assert!((f.tangent - 3.0 * slope).abs() < 1e-14);
    }
}
