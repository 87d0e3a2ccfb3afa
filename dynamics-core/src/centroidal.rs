//! The centre of mass of a robot, and its momentum about it.

use nalgebra::{SMatrix, SVector};

use crate::product::product;
use crate::scalar::Scalar;

/// The motion of a robot as a whole: of all mass that moves, while mass welded to the world does not count.
///
/// Everything is in world axes; six-vectors are linear first, then angular. What is provided here is made from the
/// rest; generated code writes all methods.
///
/// # Source
///
/// D. Orin, A. Goswami, S. Lee, *Centroidal dynamics of a humanoid robot*, Autonomous Robots 35 (2013) 161–176.
pub trait CentroidalDynamics<T: Scalar, const NQ: usize, const NV: usize> {
    /// The mass of all that moves, in kg.
    fn total_mass(&self) -> T;

    /// The centre of mass in the world, 3, in m.
    fn center_of_mass(&self, q: &SVector<T, NQ>) -> SVector<T, 3>;

    /// The centroidal momentum matrix `A(q)`, 6×NV: `A·v` is the [`centroidal_momentum`](Self::centroidal_momentum).
    fn centroidal_momentum_matrix(&self, q: &SVector<T, NQ>) -> SMatrix<T, 6, NV>;

    /// The momentum `h = A(q)·v`, 6: linear in kg·m/s, then angular about the centre of mass in kg·m²/s.
    ///
    /// Its rate is the wrench of all external forces about the centre of mass, with weight and what the joints to
    /// the world transmit.
    #[inline]
    fn centroidal_momentum(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> SVector<T, 6> {
        product(&self.centroidal_momentum_matrix(q), v)
    }

    /// The Jacobian of the centre of mass, 3×NV: `J·v` is its velocity, in m/s.
    ///
    /// It is the linear half of `A(q)` by the mass.
    #[inline]
    fn center_of_mass_jacobian(&self, q: &SVector<T, NQ>) -> SMatrix<T, 3, NV> {
        let per_mass = T::one() / self.total_mass();
        let columns = self.centroidal_momentum_matrix(q).data.0;
        let linear = columns.map(|[x, y, z, ..]| [x * per_mass, y * per_mass, z * per_mass]);
        crate::__private::columns(linear)
    }
}
