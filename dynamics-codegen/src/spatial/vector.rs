//! Three-vectors.

use std::ops::{Add, Neg, Sub};

use super::Scalar;

/// A vector `(x, y, z)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector3<S>(pub [S; 3]);

impl<S: Scalar> Vector3<S> {
    /// The vector of three components.
    pub fn new(x: S, y: S, z: S) -> Self {
        Self([x, y, z])
    }

    /// The zero vector.
    pub fn zero() -> Self {
        Self([S::zero(); 3])
    }

    /// The unit vector along x, y or z (0, 1, 2).
    pub fn unit(k: usize) -> Self {
        let mut unit = Self::zero();
        unit.0[k] = S::one();
        unit
    }

    /// The unit vector along z.
    pub fn unit_z() -> Self {
        Self::unit(2)
    }

    /// `k·self`
    pub fn scale(self, k: S) -> Self {
        Self(self.0.map(|x| k * x))
    }

    /// `self · other`
    pub fn dot(self, other: Self) -> S {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        a * x + b * y + c * z
    }

    /// `self × other`
    pub fn cross(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    /// `self × e_z = (y, −x, 0)`
    pub fn cross_z(self) -> Self {
        let [x, y, _] = self.0;
        Self([y, -x, S::zero()])
    }

    /// Whether every component is zero whatever the inputs are.
    pub fn is_zero(self) -> bool {
        self.0.into_iter().all(S::is_zero)
    }

    /// The vector with `f` applied to each component.
    pub fn map<R>(self, f: impl FnMut(S) -> R) -> Vector3<R> {
        Vector3(self.0.map(f))
    }
}

impl<S: Scalar> Add for Vector3<S> {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, rhs.0);
        Self([a + x, b + y, c + z])
    }
}

impl<S: Scalar> Sub for Vector3<S> {
    type Output = Self;
    fn sub(self, rhs: Self) -> Self {
        self + -rhs
    }
}

impl<S: Scalar> Neg for Vector3<S> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}
