//! Three-by-three matrices, general and symmetric.

use std::ops::{Add, Mul};

use super::{Scalar, Vector3};

/// A matrix, by rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrix3<S>(pub [[S; 3]; 3]);

impl<S: Scalar> Matrix3<S> {
    /// The zero matrix.
    pub fn zero() -> Self {
        Self([[S::zero(); 3]; 3])
    }

    /// The identity.
    pub fn identity() -> Self {
        let (o, i) = (S::zero(), S::one());
        Self([[i, o, o], [o, i, o], [o, o, i]])
    }

    /// The rotation by the angle with cosine `c` and sine `s` about x.
    pub fn rotation_x(c: S, s: S) -> Self {
        let (o, i) = (S::zero(), S::one());
        Self([[i, o, o], [o, c, -s], [o, s, c]])
    }

    /// The rotation about y.
    pub fn rotation_y(c: S, s: S) -> Self {
        let (o, i) = (S::zero(), S::one());
        Self([[c, o, s], [o, i, o], [-s, o, c]])
    }

    /// The rotation about z.
    pub fn rotation_z(c: S, s: S) -> Self {
        let (o, i) = (S::zero(), S::one());
        Self([[c, -s, o], [s, c, o], [o, o, i]])
    }

    /// The rotation of the unit quaternion `i, j, k, w`.
    pub fn of_quaternion([i, j, k, w]: [S; 4]) -> Self {
        let (ii, jj, kk) = ((i * i).twice(), (j * j).twice(), (k * k).twice());
        let (ij, ik, jk) = ((i * j).twice(), (i * k).twice(), (j * k).twice());
        let (iw, jw, kw) = ((i * w).twice(), (j * w).twice(), (k * w).twice());
        let one = S::one();
        Self([
            [one - (jj + kk), ij - kw, ik + jw],
            [ij + kw, one - (ii + kk), jk - iw],
            [ik - jw, jk + iw, one - (ii + jj)],
        ])
    }

    /// `v̂`, with `v̂ x = v × x`.
    pub fn skew(v: Vector3<S>) -> Self {
        let ([x, y, z], o) = (v.0, S::zero());
        Self([[o, -z, y], [z, o, -x], [-y, x, o]])
    }

    /// `a bᵀ`
    pub fn outer(a: Vector3<S>, b: Vector3<S>) -> Self {
        Self(a.0.map(|x| b.0.map(|y| x * y)))
    }

    /// The transpose.
    pub fn transpose(self) -> Self {
        let [[a, b, c], [d, e, f], [g, h, i]] = self.0;
        Self([[a, d, g], [b, e, h], [c, f, i]])
    }

    /// The row `i`.
    pub fn row(self, i: usize) -> Vector3<S> {
        Vector3(self.0[i])
    }

    /// The column `j`.
    pub fn column(self, j: usize) -> Vector3<S> {
        Vector3(self.0.map(|row| row[j]))
    }

    /// `k·self`
    pub fn scale(self, k: S) -> Self {
        Self(self.0.map(|row| row.map(|x| k * x)))
    }

    /// The sum of the diagonal.
    pub fn trace(self) -> S {
        self.0[0][0] + self.0[1][1] + self.0[2][2]
    }

    /// The matrix with `f` applied to each entry.
    pub fn map<R>(self, mut f: impl FnMut(S) -> R) -> Matrix3<R> {
        Matrix3(self.0.map(|row| row.map(&mut f)))
    }
}

impl<S: Scalar> Mul<Vector3<S>> for Matrix3<S> {
    type Output = Vector3<S>;
    fn mul(self, v: Vector3<S>) -> Vector3<S> {
        Vector3(self.0.map(|row| Vector3(row).dot(v)))
    }
}

impl<S: Scalar> Mul for Matrix3<S> {
    type Output = Self;
    fn mul(self, rhs: Self) -> Self {
        let columns = rhs.transpose();
        Self(self.0.map(|row| columns.0.map(|column| Vector3(row).dot(Vector3(column)))))
    }
}

impl<S: Scalar> Add for Matrix3<S> {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        let mut sum = self;
        for (row, other) in sum.0.iter_mut().zip(rhs.0) {
            for (entry, other) in row.iter_mut().zip(other) {
                *entry = *entry + other;
            }
        }
        sum
    }
}

/// A symmetric matrix, by its six entries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Symmetric3<S> {
    /// Row 1, column 1.
    pub xx: S,
    /// Row 2, column 2.
    pub yy: S,
    /// Row 3, column 3.
    pub zz: S,
    /// Row 1, column 2.
    pub xy: S,
    /// Row 1, column 3.
    pub xz: S,
    /// Row 2, column 3.
    pub yz: S,
}

impl<S: Scalar> Symmetric3<S> {
    /// The zero matrix.
    pub fn zero() -> Self {
        let o = S::zero();
        Self { xx: o, yy: o, zz: o, xy: o, xz: o, yz: o }
    }

    /// The diagonal matrix.
    pub fn diagonal(xx: S, yy: S, zz: S) -> Self {
        Self { xx, yy, zz, ..Self::zero() }
    }

    /// `½(a bᵀ + b aᵀ)·2 = a bᵀ + b aᵀ`
    pub fn outer_twice(a: Vector3<S>, b: Vector3<S>) -> Self {
        let ([a, b, c], [x, y, z]) = (a.0, b.0);
        Self {
            xx: (a * x).twice(),
            yy: (b * y).twice(),
            zz: (c * z).twice(),
            xy: a * y + x * b,
            xz: a * z + x * c,
            yz: b * z + y * c,
        }
    }

    /// `k·a aᵀ`
    pub fn outer_self(k: S, a: Vector3<S>) -> Self {
        let ([a, b, c], [x, y, z]) = (a.scale(k).0, a.0);
        Self { xx: a * x, yy: b * y, zz: c * z, xy: a * y, xz: a * z, yz: b * z }
    }

    /// All nine entries.
    pub fn full(self) -> Matrix3<S> {
        let Self { xx, yy, zz, xy, xz, yz } = self;
        Matrix3([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    }

    /// The symmetric matrix of the upper half of `m`.
    pub fn upper_of(m: Matrix3<S>) -> Self {
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = m.0;
        Self { xx, yy, zz, xy, xz, yz }
    }

    /// `R self Rᵀ`
    pub fn rotated(self, rotation: Matrix3<S>) -> Self {
        let half = rotation * self.full();
        let entry = |i: usize, j: usize| half.row(i).dot(rotation.row(j));
        Self {
            xx: entry(0, 0),
            yy: entry(1, 1),
            zz: entry(2, 2),
            xy: entry(0, 1),
            xz: entry(0, 2),
            yz: entry(1, 2),
        }
    }

    /// `tr(self)·1 − self`: an inertia from second moments, and the reverse up to a factor of two.
    pub fn trace_minus(self) -> Self {
        let Self { xx, yy, zz, xy, xz, yz } = self;
        Self { xx: yy + zz, yy: xx + zz, zz: xx + yy, xy: -xy, xz: -xz, yz: -yz }
    }

    /// The matrix with row and column `k` zero.
    pub fn without(self, k: usize) -> Self {
        let mut full = self.full();
        full.0[k] = [S::zero(); 3];
        for row in &mut full.0 {
            row[k] = S::zero();
        }
        Self::upper_of(full)
    }

    /// `self v`
    pub fn times(self, v: Vector3<S>) -> Vector3<S> {
        self.full() * v
    }

    /// The matrix with `f` applied to each entry.
    pub fn map<R>(self, mut f: impl FnMut(S) -> R) -> Symmetric3<R> {
        let Self { xx, yy, zz, xy, xz, yz } = self;
        Symmetric3 { xx: f(xx), yy: f(yy), zz: f(zz), xy: f(xy), xz: f(xz), yz: f(yz) }
    }
}

impl<S: Scalar> Add for Symmetric3<S> {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        Self {
            xx: self.xx + rhs.xx,
            yy: self.yy + rhs.yy,
            zz: self.zz + rhs.zz,
            xy: self.xy + rhs.xy,
            xz: self.xz + rhs.xz,
            yz: self.yz + rhs.yz,
        }
    }
}
