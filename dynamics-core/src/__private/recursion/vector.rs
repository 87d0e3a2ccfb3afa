//! Three-vectors and three-by-three matrices.

use core::ops::{Add, Neg, Sub};

use crate::scalar::Scalar;

/// A vector `(x, y, z)`.
#[derive(Clone, Copy)]
pub(super) struct Vector<T>(pub(super) [T; 3]);

impl<T: Scalar> Vector<T> {
    /// The zero vector.
    #[inline(always)]
    pub(super) fn zero() -> Self {
        Self([T::zero(); 3])
    }

    /// `k·self`
    #[inline(always)]
    pub(super) fn scaled(self, k: T) -> Self {
        Self(self.0.map(|x| x * k))
    }

    /// `self + k·other`
    #[inline(always)]
    pub(super) fn plus_scaled(self, other: Self, k: T) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([x.mul_add(k, a), y.mul_add(k, b), z.mul_add(k, c)])
    }

    /// `self · other`
    #[inline(always)]
    pub(super) fn dot(self, other: Self) -> T {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        a.mul_add(x, b.mul_add(y, c * z))
    }

    /// `self × other`
    #[inline(always)]
    pub(super) fn cross(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([b.mul_add(z, -(c * y)), c.mul_add(x, -(a * z)), a.mul_add(y, -(b * x))])
    }
}

impl<T: Scalar> Add for Vector<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, rhs: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, rhs.0);
        Self([a + x, b + y, c + z])
    }
}

impl<T: Scalar> Sub for Vector<T> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, rhs: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, rhs.0);
        Self([a - x, b - y, c - z])
    }
}

impl<T: Scalar> Neg for Vector<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}

/// A matrix, by rows.
#[derive(Clone, Copy)]
pub(super) struct Matrix<T>(pub(super) [[T; 3]; 3]);

impl<T: Scalar> Matrix<T> {
    /// The zero matrix.
    #[inline(always)]
    pub(super) fn zero() -> Self {
        Self([[T::zero(); 3]; 3])
    }

    /// The identity.
    #[inline(always)]
    pub(super) fn identity() -> Self {
        let (o, i) = (T::zero(), T::one());
        Self([[i, o, o], [o, i, o], [o, o, i]])
    }

    /// The rotation of a unit quaternion i, j, k, w.
    #[inline(always)]
    pub(super) fn of_quaternion([x, y, z, w]: [T; 4]) -> Self {
        let (one, two) = (T::one(), T::of(2.0));
        let diagonal = |a: T, b: T| one - two * a.mul_add(a, b * b);
        let twice = |a: T, b: T, c: T, d: T| two * a.mul_add(b, c * d);
        Self([
            [diagonal(y, z), twice(x, y, -w, z), twice(x, z, w, y)],
            [twice(x, y, w, z), diagonal(x, z), twice(y, z, -w, x)],
            [twice(x, z, -w, y), twice(y, z, w, x), diagonal(x, y)],
        ])
    }

    /// `self·R_z`, the rotation about z by an angle with this sine and cosine.
    #[inline(always)]
    pub(super) fn about_z(self, sine: T, cosine: T) -> Self {
        Self(self.0.map(|[x, y, z]| [x.mul_add(cosine, y * sine), y.mul_add(cosine, -(x * sine)), z]))
    }

    /// The symmetric matrix of the entries xx, yy, zz, xy, xz, yz.
    #[inline(always)]
    pub(super) fn symmetric([xx, yy, zz, xy, xz, yz]: [T; 6]) -> Self {
        Self([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    }

    /// `a bᵀ`
    #[inline(always)]
    pub(super) fn outer(a: Vector<T>, b: Vector<T>) -> Self {
        Self(a.0.map(|k| b.scaled(k).0))
    }

    /// The transpose.
    #[inline(always)]
    pub(super) fn transpose(self) -> Self {
        let [[a, b, c], [d, e, f], [g, h, i]] = self.0;
        Self([[a, d, g], [b, e, h], [c, f, i]])
    }

    /// The third column: where a rotation takes z.
    #[inline(always)]
    pub(super) fn third_column(self) -> Vector<T> {
        Vector(self.0.map(|[_, _, z]| z))
    }

    /// `self·v`
    #[inline(always)]
    pub(super) fn times(self, v: Vector<T>) -> Vector<T> {
        Vector(self.0.map(|row| Vector(row).dot(v)))
    }

    /// `self·rhs`
    #[inline(always)]
    pub(super) fn product(self, rhs: Self) -> Self {
        let columns = rhs.transpose();
        Self(self.0.map(|row| columns.times(Vector(row)).0))
    }

    /// `self·v̂ᵀ`, with `v̂ x = v × x`.
    #[inline(always)]
    pub(super) fn times_skew_transposed(self, v: Vector<T>) -> Self {
        Self(self.0.map(|row| v.cross(Vector(row)).0))
    }

    /// `(tr(self)·1 − self)·v`: from second moments, what the inertia does to `v`.
    #[inline(always)]
    pub(super) fn trace_minus_times(self, v: Vector<T>) -> Vector<T> {
        let [[xx, ..], [_, yy, _], [.., zz]] = self.0;
        v.scaled(xx + yy + zz) - self.times(v)
    }
}

impl<T: Scalar> Add for Matrix<T> {
    type Output = Self;

    #[inline(always)]
    fn add(self, rhs: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0.map(Vector), rhs.0.map(Vector));
        Self([(a + x).0, (b + y).0, (c + z).0])
    }
}
