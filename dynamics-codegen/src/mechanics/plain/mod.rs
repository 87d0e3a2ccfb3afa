//! The oracle: textbook mechanics of a tree, plain and slow, for checking everything else.
//!
//! Six-vectors and dense 6×6 matrices in the frames the tree was given in, nothing regrouped, re-gauged or
//! specialised. It shares with the specialised recursions no more than the tree and three-dimensional algebra.
//! Six-vectors are linear first, then angular; matrices are lists of rows. Written over any
//! [`Scalar`](crate::spatial::Scalar): `f64` computes, [`Dual`] differentiates, `Expr` derives.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, ch. 2–5; its order is angular first.

mod coriolis;
mod dense;
mod dual;
mod energy;
mod kinematics;
mod mass_matrix;
mod oracle;
pub mod passive;
mod rnea;
mod six;
mod terms;
#[cfg(test)]
mod tests;
mod whole;

pub use coriolis::{bracket, coriolis_matrix};
pub use dense::{Cholesky, Rows};
pub use dual::Dual;
pub use energy::{kinetic_energy, lagrangian, potential_energy};
pub use kinematics::{body_jacobian, link_poses, link_velocities, pose, world_jacobian};
pub(super) use kinematics::{motion_subspace, pose_in_parent};
pub use mass_matrix::mass_matrix;
pub use oracle::{ForwardDynamicsDerivatives, InverseDynamicsDerivatives, Oracle};
pub use rnea::{bias_forces, gravity_forces, inverse_dynamics};
pub use six::{Matrix6, Six};
pub use terms::{
    Flaw, Rough, flaw, flaw_of_dissipation, is_smooth, kinetic_energy as kinetic_terms,
    potential_energy as potential_terms, rough,
};
pub use whole::{center_of_mass, centroidal_momentum, total_mass};
