//! The equation of motion M(q)·v̇ + C(q,v)·v + G(q) = τ, and what is asked of it.
//!
//! Everything is in SI units and radians. Passive joint forces (damping, friction, springs, armature) act as soon as
//! the robot's specification has them; armature is part of M.

use nalgebra::{ArrayStorage, SMatrix, SVector};

use crate::error::Error;
use crate::scalar::Scalar;

/// The dynamics of a robot with `NQ` coordinates and `NV` velocities.
///
/// | | length | revolute | prismatic | ball, free |
/// |---|---|---|---|---|
/// | `q` | NQ | rad | m | quaternion i, j, k, w; position before it |
/// | `v` | NV | rad/s | m/s | twist of the body in the body, linear before angular |
/// | `a` | NV | rad/s² | m/s² | v̇ |
/// | `tau` | NV | N·m | N | wrench on the body in the body; power is vᵀτ |
///
/// A force is positive along its joint's axis. The methods follow IEEE 754 and never panic: what is not finite, or a
/// singular M, comes out as infinity or NaN; the `try_…` variants report it.
///
/// # Source
///
/// R. Murray, Z. Li, S. Sastry, *A Mathematical Introduction to Robotic Manipulation*, CRC Press 1994, ch. 4;
/// R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008.
pub trait Dynamics<T: Scalar, const NQ: usize, const NV: usize> {
    /// The mass matrix `M(q)`, NV×NV, symmetric positive definite; both halves are filled.
    ///
    /// In kg·m² between revolute, kg between prismatic coordinates.
    fn mass_matrix(&self, q: &SVector<T, NQ>) -> SMatrix<T, NV, NV>;

    /// The inverse `M(q)⁻¹` of the mass matrix, NV×NV, symmetric.
    ///
    /// As provided: what each joint force accelerates. It is then symmetric up to rounding, which is that of the
    /// acceleration under gravity.
    ///
    /// # Cost
    ///
    /// As provided, NV + 1 times [`forward_dynamics`](Self::forward_dynamics); generated code has a shorter way.
    fn inverse_mass_matrix(&self, q: &SVector<T, NQ>) -> SMatrix<T, NV, NV> {
        let rest = SVector::zeros();
        let released = self.forward_dynamics(q, &rest, &rest);
        let mut inverse = SMatrix::<T, NV, NV>::identity();
        for column in &mut inverse.data.0 {
            let unit = SVector::from_array_storage(ArrayStorage([*column]));
            let [accelerations] = (self.forward_dynamics(q, &rest, &unit) - released).data.0;
            *column = accelerations;
        }
        inverse
    }

    /// The Coriolis matrix `C(q,v)`, NV×NV, with `Ṁ = C + Cᵀ`.
    ///
    /// The Levi-Civita choice: between one-dof joints the matrix of Christoffel symbols.
    ///
    /// # Source
    ///
    /// S. Echeandia, P. Wensing, *Numerical methods to compute the Coriolis matrix*, J. Comput. Nonlinear Dyn. 2021.
    fn coriolis_matrix(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> SMatrix<T, NV, NV>;

    /// The gravity forces `G(q) = ∂V/∂q`, NV, on the left-hand side: the joint forces that hold the robot still.
    fn gravity_forces(&self, q: &SVector<T, NQ>) -> SVector<T, NV>;

    /// The passive joint forces `P(q,v)` of damping, friction and springs, NV, on the left-hand side.
    ///
    /// `damping·v + friction·v/√(v² + friction_speed²) + stiffness·(q − rest)`, for each joint that has them, and `∂D/∂v` of
    /// the robot's own `#[dissipation(…)]`s; zero as provided. Armature is no force, but part of M.
    #[inline]
    fn passive_forces(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> SVector<T, NV> {
        let _ = (q, v);
        SVector::zeros()
    }

    /// The bias forces `h(q,v) = C·v + G + P`, NV, with the [`passive_forces`](Self::passive_forces) P.
    fn bias_forces(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> SVector<T, NV>;

    /// The joint forces `τ = M·a + C·v + G + P`, NV, with the [`passive_forces`](Self::passive_forces) P.
    fn inverse_dynamics(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>, a: &SVector<T, NV>) -> SVector<T, NV>;

    /// The accelerations `a = M(q)⁻¹·(τ − h(q,v))`, NV.
    fn forward_dynamics(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        tau: &SVector<T, NV>,
    ) -> SVector<T, NV>;

    /// The kinetic energy `T = ½ vᵀ·M(q)·v`, in J.
    fn kinetic_energy(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> T;

    /// The potential energy `V(q)`, in J: of gravity, zero where all centres of mass are at the world's origin, and of the
    /// robot's own `#[potential(…)]`s.
    fn potential_energy(&self, q: &SVector<T, NQ>) -> T;

    /// The elastic energy of the springs in joints, `Σ ½ stiffness·(q − rest)²`, in J; zero as provided.
    ///
    /// It is no part of `V(q)`, so that `G = ∂V/∂q` is gravity's; its derivative is the springs' share of
    /// [`passive_forces`](Self::passive_forces). A spring that belongs in V is a `#[potential(k / 2 * (theta - rest)^2)]`.
    #[inline]
    fn elastic_energy(&self, q: &SVector<T, NQ>) -> T {
        let _ = q;
        T::zero()
    }

    /// The Lagrangian `L = T − V`, in J; springs count as forces.
    fn lagrangian(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> T;

    /// The total energy `T + V +` elastic energy, in J; conserved without damping, friction and driving forces.
    #[inline]
    fn total_energy(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> T {
        self.kinetic_energy(q, v) + self.potential_energy(q) + self.elastic_energy(q)
    }

    /// `M(q)`, `C(q,v)` and `G(q)` in one; generated code shares the work between them.
    #[inline]
    fn equations_of_motion(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> EquationsOfMotion<T, NV> {
        EquationsOfMotion {
            mass_matrix: self.mass_matrix(q),
            coriolis_matrix: self.coriolis_matrix(q, v),
            gravity_forces: self.gravity_forces(q),
        }
    }

    /// `Ok` if the quaternions in `q` are of unit length; `Ok` as provided, for robots without quaternions.
    ///
    /// Asked by the `try_…` methods and at the start of a [`Simulation`](crate::Simulation). The plain methods take
    /// a quaternion as it is.
    ///
    /// # Errors
    ///
    /// [`Error::NotUnitQuaternion`], of the first; see [`Error::unless_unit_quaternion`] for how exact it must be.
    #[inline]
    fn check_configuration(&self, q: &SVector<T, NQ>) -> Result<(), Error> {
        let _ = q;
        Ok(())
    }

    /// [`inverse_dynamics`](Self::inverse_dynamics), checked.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`] names the argument and the index; under the name `tau` it is the result that overflowed.
    /// Those of [`check_configuration`](Self::check_configuration).
    fn try_inverse_dynamics(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        a: &SVector<T, NV>,
    ) -> Result<SVector<T, NV>, Error> {
        Error::unless_finite("q", q)?;
        Error::unless_finite("v", v)?;
        Error::unless_finite("a", a)?;
        self.check_configuration(q)?;
        let tau = self.inverse_dynamics(q, v, a);
        Error::unless_finite("tau", &tau)?;
        Ok(tau)
    }

    /// [`forward_dynamics`](Self::forward_dynamics), checked.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`] names the argument and the index; under the name `a` it is a result that is not finite
    /// because the bias forces already are not: speeds that overflow, angles beyond the range of the sine, a
    /// parameter that is NaN. [`Error::SingularMassMatrix`] if arguments and bias forces are finite and the result
    /// is not. Those of [`check_configuration`](Self::check_configuration).
    fn try_forward_dynamics(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        tau: &SVector<T, NV>,
    ) -> Result<SVector<T, NV>, Error> {
        check_arguments(self, q, v, tau)?;
        let a = self.forward_dynamics(q, v, tau);
        check_acceleration(self, q, v, &a)?;
        Ok(a)
    }
}

/// What forward dynamics is asked of.
fn check_arguments<R, T, const NQ: usize, const NV: usize>(
    robot: &R,
    q: &SVector<T, NQ>,
    v: &SVector<T, NV>,
    tau: &SVector<T, NV>,
) -> Result<(), Error>
where
    R: Dynamics<T, NQ, NV> + ?Sized,
    T: Scalar,
{
    Error::unless_finite("q", q)?;
    Error::unless_finite("v", v)?;
    Error::unless_finite("tau", tau)?;
    robot.check_configuration(q)
}

/// What it came to; of what is not finite, why.
fn check_acceleration<R, T, const NQ: usize, const NV: usize>(
    robot: &R,
    q: &SVector<T, NQ>,
    v: &SVector<T, NV>,
    a: &SVector<T, NV>,
) -> Result<(), Error>
where
    R: Dynamics<T, NQ, NV> + ?Sized,
    T: Scalar,
{
    let finite = Error::unless_finite("a", a);
    if finite.is_err() && Error::unless_finite("h", &robot.bias_forces(q, v)).is_ok() {
        return Err(Error::SingularMassMatrix);
    }
    finite
}

/// The exact first derivatives of the dynamics.
///
/// With ball and free joints a derivative by `q` is taken in the tangent space, by the `δ` of `q ⊕ δ`.
pub trait DynamicsDerivatives<T: Scalar, const NQ: usize, const NV: usize>: Dynamics<T, NQ, NV> {
    /// The derivatives of [`inverse_dynamics`](Dynamics::inverse_dynamics), three of NV×NV.
    fn inverse_dynamics_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        a: &SVector<T, NV>,
    ) -> InverseDynamicsDerivatives<T, NV>;

    /// The derivatives of [`forward_dynamics`](Dynamics::forward_dynamics), three of NV×NV.
    fn forward_dynamics_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        tau: &SVector<T, NV>,
    ) -> ForwardDynamicsDerivatives<T, NV>;

    /// `τ` and its derivatives in one: [`inverse_dynamics`](Dynamics::inverse_dynamics), and
    /// [`inverse_dynamics_derivatives`](Self::inverse_dynamics_derivatives), `M(q)` being one of them.
    ///
    /// # Cost
    ///
    /// As provided, that of both. In generated code little more than that of the derivatives, which compute the forces
    /// on their way.
    #[inline]
    fn inverse_dynamics_with_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        a: &SVector<T, NV>,
    ) -> (SVector<T, NV>, InverseDynamicsDerivatives<T, NV>) {
        (self.inverse_dynamics(q, v, a), self.inverse_dynamics_derivatives(q, v, a))
    }

    /// `a` and its derivatives in one: [`forward_dynamics`](Dynamics::forward_dynamics), and
    /// [`forward_dynamics_derivatives`](Self::forward_dynamics_derivatives), `M(q)⁻¹` being one of them.
    ///
    /// # Cost
    ///
    /// As provided, that of both. In generated code that of the derivatives, which begin with the acceleration.
    #[inline]
    fn forward_dynamics_with_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        tau: &SVector<T, NV>,
    ) -> (SVector<T, NV>, ForwardDynamicsDerivatives<T, NV>) {
        (self.forward_dynamics(q, v, tau), self.forward_dynamics_derivatives(q, v, tau))
    }

    /// [`forward_dynamics_with_derivatives`](Self::forward_dynamics_with_derivatives), checked.
    ///
    /// # Errors
    ///
    /// Those of [`try_forward_dynamics`](Dynamics::try_forward_dynamics), of arguments and of `a`. The derivatives are not
    /// looked at.
    fn try_forward_dynamics_with_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        tau: &SVector<T, NV>,
    ) -> Result<(SVector<T, NV>, ForwardDynamicsDerivatives<T, NV>), Error> {
        check_arguments(self, q, v, tau)?;
        let (a, derivatives) = self.forward_dynamics_with_derivatives(q, v, tau);
        check_acceleration(self, q, v, &a)?;
        Ok((a, derivatives))
    }
}

/// `M(q)`, `C(q,v)` and `G(q)` at one state.
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
pub struct EquationsOfMotion<T, const NV: usize> {
    /// `M(q)`, see [`Dynamics::mass_matrix`].
    pub mass_matrix: SMatrix<T, NV, NV>,
    /// `C(q,v)`, see [`Dynamics::coriolis_matrix`].
    pub coriolis_matrix: SMatrix<T, NV, NV>,
    /// `G(q)`, see [`Dynamics::gravity_forces`].
    pub gravity_forces: SVector<T, NV>,
}

/// How the joint forces change with position, velocity and acceleration. Row: force; column: what changes.
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
pub struct InverseDynamicsDerivatives<T, const NV: usize> {
    /// `∂τ/∂q`.
    pub dtau_dq: SMatrix<T, NV, NV>,
    /// `∂τ/∂v`.
    pub dtau_dv: SMatrix<T, NV, NV>,
    /// `∂τ/∂a = M(q)`.
    pub dtau_da: SMatrix<T, NV, NV>,
}

/// How the accelerations change with position, velocity and force. Row: acceleration; column: what changes.
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
pub struct ForwardDynamicsDerivatives<T, const NV: usize> {
    /// `∂a/∂q`.
    pub da_dq: SMatrix<T, NV, NV>,
    /// `∂a/∂v`.
    pub da_dv: SMatrix<T, NV, NV>,
    /// `∂a/∂τ = M(q)⁻¹`.
    pub da_dtau: SMatrix<T, NV, NV>,
}
