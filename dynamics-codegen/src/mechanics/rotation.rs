//! Rotations as products of planar turns: four multiplications a vector, eight a symmetric matrix.

use crate::spatial::{Matrix3, Scalar, Symmetric3, Vector3};

/// A turn in a plane, by its cosine and sine.
#[derive(Clone, Copy, Debug)]
pub struct PlanarTurn<S> {
    /// The cosine of the angle.
    pub cos: S,
    /// The sine of the angle.
    pub sin: S,
}

impl<S: Scalar> PlanarTurn<S> {
    /// No turn.
    pub fn identity() -> Self {
        Self { cos: S::one(), sin: S::zero() }
    }

    /// The turn by `angle`.
    pub fn of_angle(angle: S) -> Self {
        Self { cos: angle.cos(), sin: angle.sin() }
    }

    /// The turn by a further `quarters` times 90°.
    pub fn plus_quarters(self, quarters: u8) -> Self {
        let Self { cos, sin } = self;
        match quarters % 4 {
            0 => self,
            1 => Self { cos: -sin, sin: cos },
            2 => Self { cos: -cos, sin: -sin },
            _ => Self { cos: sin, sin: -cos },
        }
    }

    /// The turn by the sum of both angles.
    pub fn then(self, other: Self) -> Self {
        Self {
            cos: self.cos * other.cos - self.sin * other.sin,
            sin: self.sin * other.cos + self.cos * other.sin,
        }
    }

    /// The turn back.
    pub fn inverse(self) -> Self {
        Self { cos: self.cos, sin: -self.sin }
    }

    /// The number of quarters, if the turn is by a multiple of 90°.
    pub fn quarters(self) -> Option<u8> {
        match (self.cos.as_sign()?, self.sin.as_sign()?) {
            (1, 0) => Some(0),
            (0, 1) => Some(1),
            (-1, 0) => Some(2),
            (0, -1) => Some(3),
            _ => None,
        }
    }

    /// `Rz v`
    pub fn up(self, v: Vector3<S>) -> Vector3<S> {
        let (Self { cos, sin }, [x, y, z]) = (self, v.0);
        Vector3([cos * x - sin * y, sin * x + cos * y, z])
    }

    /// `Rzᵀ v`
    pub fn down(self, v: Vector3<S>) -> Vector3<S> {
        self.inverse().up(v)
    }

    /// `Rz m Rzᵀ` of a symmetric matrix, in eight multiplications.
    pub fn up_symmetric(self, m: Symmetric3<S>) -> Symmetric3<S> {
        let (Self { cos, sin }, Symmetric3 { xx, yy, zz, xy, xz, yz }) = (self, m);
        let [xz, yz, _] = self.up(Vector3([xz, yz, S::zero()])).0;
        match self.quarters() {
            Some(0 | 2) => Symmetric3 { xx, yy, zz, xy, xz, yz },
            Some(_) => Symmetric3 { xx: yy, yy: xx, zz, xy: -xy, xz, yz },
            None => {
                let u = sin * (yy - xx) - cos * xy.twice();
                Symmetric3 { xx: xx + sin * u, yy: yy - sin * u, zz, xy: -(cos * u + xy), xz, yz }
            }
        }
    }

    /// `Rz m Rzᵀ` of any matrix, in eleven multiplications.
    pub fn up_matrix(self, m: Matrix3<S>) -> Matrix3<S> {
        let (Self { cos, sin }, [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]]) = (self, m.0);
        let [xz, yz, _] = self.up(Vector3([xz, yz, S::zero()])).0;
        let [zx, zy, _] = self.up(Vector3([zx, zy, S::zero()])).0;
        let [[xx, xy], [yx, yy]] = match self.quarters() {
            Some(0 | 2) => [[xx, xy], [yx, yy]],
            Some(_) => [[yy, -yx], [-xy, xx]],
            None => {
                let u = sin * (yy - xx) - cos * (xy + yx);
                let (su, cu) = (sin * u, cos * u);
                [[xx + su, -(cu + yx)], [-(cu + xy), yy - su]]
            }
        };
        Matrix3([[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]])
    }
}

/// A constant rotation.
#[derive(Clone, Copy, Debug)]
pub enum Turn<S> {
    /// `Rz(γ)·Rx(α)`: what is left of any rotation once a turn about z is taken into the joint.
    Planar {
        /// The turn about z.
        gamma: PlanarTurn<S>,
        /// The turn about the new x.
        alpha: PlanarTurn<S>,
    },
    /// A rotation whose entries depend on parameters.
    General(Matrix3<S>),
}

impl<S: Scalar> Turn<S> {
    /// No rotation.
    pub fn identity() -> Self {
        Turn::Planar { gamma: PlanarTurn::identity(), alpha: PlanarTurn::identity() }
    }

    /// The matrix.
    pub fn matrix(self) -> Matrix3<S> {
        match self {
            Turn::Planar { gamma, alpha } => {
                Matrix3::rotation_z(gamma.cos, gamma.sin) * Matrix3::rotation_x(alpha.cos, alpha.sin)
            }
            Turn::General(matrix) => matrix,
        }
    }

    /// `R v`
    pub fn up(self, v: Vector3<S>) -> Vector3<S> {
        match self {
            Turn::Planar { gamma, alpha } => gamma.up(about_x(v, |v| alpha.up(v))),
            Turn::General(matrix) => matrix * v,
        }
    }

    /// `Rᵀ v`
    pub fn down(self, v: Vector3<S>) -> Vector3<S> {
        match self {
            Turn::Planar { gamma, alpha } => about_x(gamma.down(v), |v| alpha.down(v)),
            Turn::General(matrix) => matrix.transpose() * v,
        }
    }

    /// `R m Rᵀ` of a symmetric matrix.
    pub fn up_symmetric(self, m: Symmetric3<S>) -> Symmetric3<S> {
        match self {
            Turn::Planar { gamma, alpha } => {
                // A turn about x is one about z after the axes x, y, z are named z, x, y.
                let Symmetric3 { xx, yy, zz, xy, xz, yz } = m;
                let renamed = Symmetric3 { xx: yy, yy: zz, zz: xx, xy: yz, xz: xy, yz: xz };
                let Symmetric3 { xx, yy, zz, xy, xz, yz } = alpha.up_symmetric(renamed);
                gamma.up_symmetric(Symmetric3 { xx: zz, yy: xx, zz: yy, xy: xz, xz: yz, yz: xy })
            }
            Turn::General(matrix) => m.rotated(matrix),
        }
    }

    /// `R m Rᵀ`
    pub fn up_matrix(self, m: Matrix3<S>) -> Matrix3<S> {
        match self {
            Turn::Planar { gamma, alpha } => {
                let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = m.0;
                let renamed = Matrix3([[yy, yz, yx], [zy, zz, zx], [xy, xz, xx]]);
                let [[yy, yz, yx], [zy, zz, zx], [xy, xz, xx]] = alpha.up_matrix(renamed).0;
                gamma.up_matrix(Matrix3([[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]]))
            }
            Turn::General(matrix) => matrix * m * matrix.transpose(),
        }
    }
}

/// Applies a turn about z to the axes y, z in the place of x, y.
fn about_x<S: Scalar>(v: Vector3<S>, turn: impl Fn(Vector3<S>) -> Vector3<S>) -> Vector3<S> {
    let [x, y, z] = v.0;
    let [y, z, x] = turn(Vector3([y, z, x])).0;
    Vector3([x, y, z])
}
