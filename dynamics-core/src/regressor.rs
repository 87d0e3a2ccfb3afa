//! The equation of motion as a linear function of a robot's inertial parameters, for identification and adaptation.

use nalgebra::{SMatrix, SVector};

use crate::scalar::Scalar;

/// `τ = Y(q,v,a)·π`: the joint forces are linear in the `NP` inertial parameters `π`.
///
/// First ten for each moving body, with all that is welded to it, about the origin of the body's frame in its axes:
///
/// | | | |
/// |---|---|---|
/// | `mass` | | kg |
/// | `mass_x`, `mass_y`, `mass_z` | mass times position of the centre of mass | kg·m |
/// | `inertia_xx`, `_xy`, `_yy`, `_xz`, `_yz`, `_zz` | rotational inertia `∫(r²·1 − r·rᵀ) dm` | kg·m² |
///
/// Then three for each one-dof joint, in the order of the coordinates: `armature` (kg·m², kg), `damping` (N·m·s/rad,
/// N·s/m) and `friction` (N·m, N). [`Mechanism::PARAMETER_NAMES`](crate::Mechanism::PARAMETER_NAMES) names all.
/// A joint with a spring has its `stiffness` (N·m/rad, N/m) besides, so that `Y·π` is all of `τ`.
///
/// # Source
///
/// C. Atkeson, C. An, J. Hollerbach, *Estimation of inertial parameters of manipulator loads and links*, Int. J.
/// Robotics Research 5 (1986) 101–119.
pub trait Regressor<T: Scalar, const NQ: usize, const NV: usize, const NP: usize> {
    /// The regressor `Y(q,v,a)`, NV×NP, with `τ = Y·π`; it depends on geometry and gravity alone, and in
    /// the columns of terms in the energies, whose parameters are 1, on these.
    fn regressor(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>, a: &SVector<T, NV>) -> SMatrix<T, NV, NP>;

    /// The parameters `π` that the robot has now, NP.
    fn inertial_parameters(&self) -> SVector<T, NP>;
}

/// `τ = Y_b(q,v,a)·π_b` with as few parameters as there can be: `NB` combinations of the inertial parameters, which
/// motion and joint forces determine.
///
/// The columns of `Y_b` are independent functions of the motion. Where the geometry of the robot is of fields, that is
/// promised of robots whose joints hang on a body that turns about two axes, or floats: combinations whose shares
/// change with the fields are not taken out.
/// [`Mechanism::BASE_PARAMETER_NAMES`](crate::Mechanism::BASE_PARAMETER_NAMES) writes out the combinations.
///
/// # Source
///
/// M. Gautier, W. Khalil, *Direct calculation of minimum set of inertial parameters of serial robots*, IEEE Trans.
/// Robotics and Automation 6 (1990) 368–373.
pub trait BaseRegressor<T: Scalar, const NQ: usize, const NV: usize, const NB: usize> {
    /// The regressor `Y_b(q,v,a)`, NV×NB, with `τ = Y_b·π_b`.
    fn base_regressor(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        a: &SVector<T, NV>,
    ) -> SMatrix<T, NV, NB>;

    /// The base parameters `π_b` that the robot has now, NB.
    fn base_parameters(&self) -> SVector<T, NB>;
}
