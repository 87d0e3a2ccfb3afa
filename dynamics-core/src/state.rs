//! The state of a robot, and how a configuration moves along a velocity.

use nalgebra::SVector;

use crate::error::Error;
use crate::scalar::Scalar;

/// Position and velocity: `x = (q, v)`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(bound(
        serialize = "T: Scalar + serde::Serialize",
        deserialize = "T: Scalar + serde::Deserialize<'de>"
    ))
)]
pub struct State<T, const NQ: usize, const NV: usize> {
    /// The configuration, in rad or m; of ball and free joints quaternions, without unit.
    pub q: SVector<T, NQ>,
    /// The velocity, in rad/s or m/s.
    pub v: SVector<T, NV>,
}

impl<T: Scalar, const NQ: usize, const NV: usize> State<T, NQ, NV> {
    /// The state `(q, v)`.
    #[must_use]
    pub const fn new(q: SVector<T, NQ>, v: SVector<T, NV>) -> Self {
        Self { q, v }
    }

    /// The state `(q, 0)`.
    #[must_use]
    pub fn rest(q: SVector<T, NQ>) -> Self {
        Self { q, v: SVector::zeros() }
    }

    /// `Ok` if every entry is finite.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`] with `q` or `v` and the index.
    pub fn check(&self) -> Result<(), Error> {
        Error::unless_finite("q", &self.q)?;
        Error::unless_finite("v", &self.v)
    }
}

/// The configurations of a robot: a vector space for one-dof joints, a manifold with ball and free joints.
///
/// What is provided here serves robots without quaternions; of others it does not compile.
pub trait Configuration<T: Scalar, const NQ: usize, const NV: usize> {
    /// `q ⊕ δ`, NQ: where `q` gets to under the constant velocity `δ` in one unit of time.
    ///
    /// For one-dof joints `q + δ`. For a ball joint `q·exp(δ)`, a unit quaternion; for a free joint the same in SE(3),
    /// `δ` being a twist in the body. It must be that exponential and no mere first-order update: the order of
    /// [`Rk4`](crate::simulate::Rk4) rests on it.
    fn integrate(&self, q: &SVector<T, NQ>, delta: &SVector<T, NV>) -> SVector<T, NQ>;

    /// `δ = q₁ ⊖ q₀`, NV: the constant velocity that takes `q0` to `q1` in one unit of time, so that `q₁ = q₀ ⊕ δ`.
    ///
    /// For one-dof joints `q₁ − q₀`, with the whole turns of a revolute one. For ball and free joints the logarithm
    /// of `q₀⁻¹·q₁`, by the shorter way, up to half a turn.
    #[inline]
    fn difference(&self, q0: &SVector<T, NQ>, q1: &SVector<T, NQ>) -> SVector<T, NV> {
        const { assert!(NQ == NV, "quaternions are not subtracted: `difference` must be written") };
        let mut delta = SVector::<T, NV>::zeros();
        for ((delta, q0), q1) in delta.iter_mut().zip(q0).zip(q1) {
            *delta = *q1 - *q0;
        }
        delta
    }

    /// `δ̇`, NV: the rate of δ where `q ⊕ δ` moves with the velocity `v`, for every `q`.
    ///
    /// For one-dof joints `v`. For ball and free joints the inverse of the exponential's derivative, linear in `v`:
    /// `v + ½ [δ, v] + …`, where `[·,·]` is the commutator of twists; of rotations below a whole turn.
    ///
    /// A method for vector spaces becomes one for manifolds where it integrates this in place of `q̇ = v`.
    ///
    /// # Source
    ///
    /// H. Munthe-Kaas, *High order Runge–Kutta methods on manifolds*, Applied Numerical Mathematics 29 (1999) 115–127;
    /// F. Bullo, R. Murray, *Proportional derivative control on the Euclidean group*, Caltech 1995, for SE(3).
    #[inline]
    fn rate(&self, delta: &SVector<T, NV>, v: &SVector<T, NV>) -> SVector<T, NV> {
        const { assert!(NQ == NV, "a rotation vector does not grow with the velocity: `rate` must be written") };
        let _ = delta;
        *v
    }

    /// The transposed of the map `v ↦ δ̇` of [`rate`](Self::rate), NV: of joint forces or momenta, the forces of δ.
    #[inline]
    fn rate_transposed(&self, delta: &SVector<T, NV>, p: &SVector<T, NV>) -> SVector<T, NV> {
        const { assert!(NQ == NV, "a rotation vector has other forces: `rate_transposed` must be written") };
        let _ = delta;
        *p
    }

    /// The configuration of zeros, NQ, where quaternions are `0, 0, 0, 1`.
    #[inline]
    fn neutral(&self) -> SVector<T, NQ> {
        const { assert!(NQ == NV, "a quaternion is never zero: `neutral` must be written") };
        SVector::zeros()
    }
}
