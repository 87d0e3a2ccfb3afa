//! Six-vectors of motion and of force, and the dense 6×6 matrices that act on them.
//!
//! Motions are `(v, ω)`: the velocity of the point of the body at the frame's origin, and the angular velocity.
//! Forces are `(f, n)`: the force, and its moment about the frame's origin. Their product is power.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, ch. 2, in the order of R. Murray, Z. Li,
//! S. Sastry, *A Mathematical Introduction to Robotic Manipulation*, CRC 1994, ch. 2.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use std::ops::{Add, Mul};

use crate::spatial::{Matrix3, Pose, PseudoInertia, Scalar, Vector3};

/// A motion or a force, linear part first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Six<S>(pub [S; 6]);

/// A 6×6 matrix, by rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrix6<S>(pub [[S; 6]; 6]);

impl<S: Scalar> Six<S> {
    /// The six-vector of its two parts.
    pub fn new(linear: Vector3<S>, angular: Vector3<S>) -> Self {
        let ([a, b, c], [d, e, f]) = (linear.0, angular.0);
        Self([a, b, c, d, e, f])
    }

    /// The zero vector.
    pub fn zero() -> Self {
        Self([S::zero(); 6])
    }

    /// The linear part.
    pub fn linear(self) -> Vector3<S> {
        let [a, b, c, ..] = self.0;
        Vector3([a, b, c])
    }

    /// The angular part.
    pub fn angular(self) -> Vector3<S> {
        let [.., d, e, f] = self.0;
        Vector3([d, e, f])
    }

    /// Whether every component is zero.
    pub fn is_zero(self) -> bool {
        self.0.into_iter().all(S::is_zero)
    }

    /// `k·self`
    pub fn scale(self, k: S) -> Self {
        Self(self.0.map(|x| k * x))
    }

    /// The sum of the products of components; of a motion and a force it is power.
    pub fn dot(self, other: Self) -> S {
        let ([a, b, c, d, e, f], [u, v, w, x, y, z]) = (self.0, other.0);
        a * u + b * v + c * w + d * x + e * y + f * z
    }
}

impl<S: Scalar> Add for Six<S> {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        let mut sum = self;
        for (x, y) in sum.0.iter_mut().zip(rhs.0) {
            *x = *x + y;
        }
        sum
    }
}

impl<S: Scalar> Matrix6<S> {
    /// The matrix of its four blocks.
    fn of_blocks([[A, B], [C, D]]: [[Matrix3<S>; 2]; 2]) -> Self {
        let row = |left: &Matrix3<S>, right: &Matrix3<S>, i: usize| Six::new(left.row(i), right.row(i)).0;
        Self([row(&A, &B, 0), row(&A, &B, 1), row(&A, &B, 2), row(&C, &D, 0), row(&C, &D, 1), row(&C, &D, 2)])
    }

    /// `Ad(X_AB) = [R, p̂ R; 0, R]`: takes motions written in B to A. Its transpose takes forces from A to B.
    pub fn adjoint(X_AB: Pose<S>) -> Self {
        let (R, p) = (X_AB.rotation, X_AB.translation);
        Self::of_blocks([[R, Matrix3::skew(p) * R], [Matrix3::zero(), R]])
    }

    /// `V× = [ω̂, v̂; 0, ω̂]`: how motions at rest in a body change that moves with V.
    /// Minus its transpose, `V×*`, is the same for forces.
    pub fn cross(V: Six<S>) -> Self {
        let (v, w) = (Matrix3::skew(V.linear()), Matrix3::skew(V.angular()));
        Self::of_blocks([[w, v], [Matrix3::zero(), w]])
    }

    /// `[m·1, −ĥ; ĥ, J]` with `J = tr(Σ)·1 − Σ`: takes the motion of a body to its momentum. No division by the
    /// mass, so a massless body is no special case.
    pub fn inertia(inertia: &PseudoInertia<S>) -> Self {
        let h = inertia.first;
        let m = Matrix3::identity().scale(inertia.mass);
        let second = inertia.second.full();
        let J = Matrix3::identity().scale(second.trace()) + second.scale(-S::one());
        Self::of_blocks([[m, Matrix3::skew(-h)], [Matrix3::skew(h), J]])
    }

    /// The transpose.
    pub fn transpose(self) -> Self {
        let mut transpose = self;
        for (i, row) in self.0.into_iter().enumerate() {
            for (j, entry) in row.into_iter().enumerate() {
                transpose.0[j][i] = entry;
            }
        }
        transpose
    }
}

impl<S: Scalar> Mul<Six<S>> for Matrix6<S> {
    type Output = Six<S>;
    fn mul(self, x: Six<S>) -> Six<S> {
        Six(self.0.map(|row| Six(row).dot(x)))
    }
}
