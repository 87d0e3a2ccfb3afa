//! Where the frames of a robot are, and how they move.
//!
//! A frame is a zero-sized type named after it, so that `robot.pose::<Tool0>(&q)` links the code of that one frame
//! and a misspelt frame is a compile error.

use core::ops::Mul;

use nalgebra::{SMatrix, SVector};

use crate::mechanism::{FrameCosts, Mechanism};
use crate::product::{product, transposed_product};
use crate::scalar::Scalar;

/// A frame fixed to a body of the robot `R`. Implemented by generated code on zero-sized types.
///
/// Six-vectors are linear first, then angular.
pub trait Frame<R: ?Sized, T: Scalar, const NQ: usize, const NV: usize> {
    /// The name of the body or frame in the robot's specification.
    const NAME: &'static str;

    /// What the methods cost; on a robot with parameters, after `prepare`.
    const COST: FrameCosts = FrameCosts::ZERO;

    /// The pose of the frame in the world.
    fn pose(robot: &R, q: &SVector<T, NQ>) -> Pose<T>;

    /// The body Jacobian, 6×NV: `J·v` is the frame's twist relative to the world, expressed in the frame itself.
    fn jacobian(robot: &R, q: &SVector<T, NQ>) -> SMatrix<T, 6, NV>;

    /// The Jacobian in world axes, 6×NV: `J·v` is the velocity of the frame's origin, then the angular velocity.
    fn world_jacobian(robot: &R, q: &SVector<T, NQ>) -> SMatrix<T, 6, NV>;

    /// The twist `V = J·v` of the frame relative to the world, expressed in the frame itself, 6.
    #[inline]
    fn velocity(robot: &R, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> SVector<T, 6> {
        product(&Self::jacobian(robot, q), v)
    }

    /// The rate `V̇ = J·a + J̇·v` of the components of that twist, 6.
    fn acceleration(robot: &R, q: &SVector<T, NQ>, v: &SVector<T, NV>, a: &SVector<T, NV>) -> SVector<T, 6>;
}

/// What is done with each frame of a robot `R`: a closure that is generic in the frame, which Rust has no word for.
pub trait FrameVisitor<R: ?Sized, T: Scalar, const NQ: usize, const NV: usize> {
    /// Called once for each frame.
    fn visit<F: Frame<R, T, NQ, NV>>(&mut self);
}

/// All frames of a robot, for code that asks the same of each, as drawing does. Implemented by generated code.
///
/// # Example
///
/// ```
/// # use dynamics_core::prelude::*;
/// /// Where all bodies are.
/// struct Places<'a, R> {
///     robot: &'a R,
///     q: SVector<f64, 7>,
///     found: Vec<(&'static str, Pose<f64>)>,
/// }
///
/// impl<R> FrameVisitor<R, f64, 7, 7> for Places<'_, R> {
///     fn visit<F: Frame<R, f64, 7, 7>>(&mut self) {
///         self.found.push((F::NAME, F::pose(self.robot, &self.q)));
///     }
/// }
///
/// fn places<R: EachFrame<f64, 7, 7>>(robot: &R, q: SVector<f64, 7>) -> Vec<(&'static str, Pose<f64>)> {
///     let mut places = Places { robot, q, found: vec![] };
///     robot.each_frame(&mut places);
///     places.found
/// }
/// ```
pub trait EachFrame<T: Scalar, const NQ: usize, const NV: usize> {
    /// Shows the visitor all frames, in the order of [`Mechanism::BODY_NAMES`].
    fn each_frame<V: FrameVisitor<Self, T, NQ, NV>>(&self, visitor: &mut V);
}

/// The kinematics of every robot: one method per question, the frame as its type argument.
///
/// All methods are provided; there is nothing to implement but [`Frame`].
pub trait Kinematics<T: Scalar, const NQ: usize, const NV: usize> {
    /// The pose of `F` in the world, in m.
    #[inline(always)]
    fn pose<F: Frame<Self, T, NQ, NV>>(&self, q: &SVector<T, NQ>) -> Pose<T> {
        F::pose(self, q)
    }

    /// The body Jacobian of `F`, 6×NV, linear rows first.
    ///
    /// `J·v` is the twist of `F` relative to the world, expressed in `F` (Murray, Li and Sastry's body Jacobian;
    /// Pinocchio's `LOCAL`).
    #[inline(always)]
    fn jacobian<F: Frame<Self, T, NQ, NV>>(&self, q: &SVector<T, NQ>) -> SMatrix<T, 6, NV> {
        F::jacobian(self, q)
    }

    /// The Jacobian of `F` in world axes, 6×NV, linear rows first.
    ///
    /// `J·v` is the velocity of the origin of `F`, then the angular velocity of `F`, both in world axes (Pinocchio's
    /// `LOCAL_WORLD_ALIGNED`; not the spatial Jacobian, whose reference point is the world's origin).
    #[inline(always)]
    fn world_jacobian<F: Frame<Self, T, NQ, NV>>(&self, q: &SVector<T, NQ>) -> SMatrix<T, 6, NV> {
        F::world_jacobian(self, q)
    }

    /// The body velocity `V = J(q)·v` of `F`: m/s, then rad/s, expressed in `F`.
    #[inline(always)]
    fn velocity<F: Frame<Self, T, NQ, NV>>(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> SVector<T, 6> {
        F::velocity(self, q, v)
    }

    /// The velocity of the origin of `F` in m/s, then the angular velocity of `F` in rad/s, in world axes.
    ///
    /// That is the product of [`world_jacobian`](Self::world_jacobian) and `v`.
    #[inline]
    fn world_velocity<F: Frame<Self, T, NQ, NV>>(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
    ) -> SVector<T, 6> {
        in_world(&F::pose(self, q), &F::velocity(self, q, v))
    }

    /// The body acceleration `V̇ = J·a + J̇·v` of `F`: the rate of the components of [`velocity`](Self::velocity), in
    /// m/s², then rad/s², expressed in `F`. Gravity has no part in it.
    ///
    /// Its linear half is no acceleration of a point: that of the origin is `V̇_linear + ω × V_linear`, which
    /// [`world_acceleration`](Self::world_acceleration) gives in world axes.
    #[inline(always)]
    fn acceleration<F: Frame<Self, T, NQ, NV>>(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        a: &SVector<T, NV>,
    ) -> SVector<T, 6> {
        F::acceleration(self, q, v, a)
    }

    /// The acceleration of the origin of `F` in m/s², then the angular acceleration of `F` in rad/s², in world axes:
    /// the rate of [`world_velocity`](Self::world_velocity).
    ///
    /// What an accelerometer at the origin feels is this less the acceleration of free fall.
    #[inline]
    fn world_acceleration<F: Frame<Self, T, NQ, NV>>(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        a: &SVector<T, NV>,
    ) -> SVector<T, 6> {
        let of_origin = of_origin(&F::velocity(self, q, v), &F::acceleration(self, q, v, a));
        in_world(&F::pose(self, q), &of_origin)
    }

    /// The bias acceleration `J̇·v` of `F`, expressed in `F`: its [`acceleration`](Self::acceleration) without `a`.
    #[inline]
    fn bias_acceleration<F: Frame<Self, T, NQ, NV>>(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
    ) -> SVector<T, 6> {
        F::acceleration(self, q, v, &SVector::zeros())
    }

    /// The bias acceleration `J̇·v` in world axes, where `J` is the [`world_jacobian`](Self::world_jacobian) of `F`:
    /// its [`world_acceleration`](Self::world_acceleration) without `a`.
    #[inline]
    fn world_bias_acceleration<F: Frame<Self, T, NQ, NV>>(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
    ) -> SVector<T, 6> {
        self.world_acceleration::<F>(q, v, &SVector::zeros())
    }

    /// The joint forces `Jᵀ·w` of a wrench `w` on the body of `F`: a force in N that acts at the origin of `F`, then
    /// a moment in N·m, both in the axes of `F`.
    ///
    /// They are what the wrench puts into the joints, so inverse dynamics needs that much less and forward dynamics
    /// has that much more; those of several wrenches, on the same body or on others, are added up.
    ///
    /// # Example
    ///
    /// ```
    /// # use dynamics_core::prelude::*;
    /// # fn hold<R, Hand>(robot: &R, q: &SVector<f64, 7>, v: &SVector<f64, 7>, a: &SVector<f64, 7>)
    /// # where R: Dynamics<f64, 7, 7> + Mechanism, Hand: Frame<R, f64, 7, 7> {
    /// // A rope pulls the hand down, with ten newtons.
    /// let pull = SVector::from([0.0, 0.0, -10.0, 0.0, 0.0, 0.0]);
    /// let external = robot.world_external_forces::<Hand>(q, &pull);
    /// let tau = robot.inverse_dynamics(q, v, a) - external;
    /// let back = robot.forward_dynamics(q, v, &(tau + external)); // = a
    /// # let _ = back;
    /// # }
    /// ```
    #[inline]
    fn external_forces<F: Frame<Self, T, NQ, NV>>(
        &self,
        q: &SVector<T, NQ>,
        wrench: &SVector<T, 6>,
    ) -> SVector<T, NV> {
        transposed_product(&F::jacobian(self, q), wrench)
    }

    /// The joint forces of a wrench on the body of `F`, as [`external_forces`](Self::external_forces), but in world
    /// axes: a force that acts at the origin of `F`, then a moment about this origin.
    #[inline]
    fn world_external_forces<F: Frame<Self, T, NQ, NV>>(
        &self,
        q: &SVector<T, NQ>,
        wrench: &SVector<T, 6>,
    ) -> SVector<T, NV> {
        transposed_product(&F::world_jacobian(self, q), wrench)
    }
}

impl<R: Mechanism + ?Sized, T: Scalar, const NQ: usize, const NV: usize> Kinematics<T, NQ, NV> for R {}

/// The acceleration of the origin, `V̇ + ω × V` in the linear half, from the twist and the rate of its components.
#[inline]
fn of_origin<T: Scalar>(velocity: &SVector<T, 6>, rate: &SVector<T, 6>) -> SVector<T, 6> {
    let ([[x, y, z, l, m, n]], [[a, b, c, d, e, f]]) = (velocity.data.0, rate.data.0);
    SVector::from([a + m * z - n * y, b + n * x - l * z, c + l * y - m * x, d, e, f])
}

/// A six-vector, from the axes of a frame to those of the world.
#[inline]
fn in_world<T: Scalar>(pose: &Pose<T>, x: &SVector<T, 6>) -> SVector<T, 6> {
    let [[a, b, c, l, m, n]] = x.data.0;
    let [[a, b, c]] = pose.transform_vector(&SVector::from([a, b, c])).data.0;
    let [[l, m, n]] = pose.transform_vector(&SVector::from([l, m, n])).data.0;
    SVector::from([a, b, c, l, m, n])
}

/// A rigid placement: `x_world = rotation·x_frame + translation`.
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
pub struct Pose<T> {
    /// The rotation, 3×3, that takes components in the frame to components in the world.
    pub rotation: SMatrix<T, 3, 3>,
    /// The origin of the frame in the world, in m.
    pub translation: SVector<T, 3>,
}

impl<T: Scalar> Pose<T> {
    /// The frame that coincides with the world.
    #[must_use]
    pub fn identity() -> Self {
        Self { rotation: SMatrix::identity(), translation: SVector::zeros() }
    }

    /// The placement of the world in the frame: `Rᵀ` and `−Rᵀ·p`.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.transpose();
        Self { rotation, translation: -product(&rotation, &self.translation) }
    }

    /// The point `R·x + p`: from coordinates in the frame to coordinates in the world, in m.
    #[must_use]
    pub fn transform_point(&self, point: &SVector<T, 3>) -> SVector<T, 3> {
        product(&self.rotation, point) + self.translation
    }

    /// The free vector `R·x`: from components in the frame to components in the world.
    #[must_use]
    pub fn transform_vector(&self, vector: &SVector<T, 3>) -> SVector<T, 3> {
        product(&self.rotation, vector)
    }
}

impl<T: Scalar> Mul for Pose<T> {
    type Output = Self;

    /// `X_AB·X_BC = X_AC`.
    fn mul(self, rhs: Self) -> Self {
        Self {
            rotation: product(&self.rotation, &rhs.rotation),
            translation: self.transform_point(&rhs.translation),
        }
    }
}
