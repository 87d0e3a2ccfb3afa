//! Energies, power, and the centre of mass.

use nalgebra::SVector;

use super::frame::Triple;
use super::{OperatingPoint, Output, Row};
use crate::centroidal::CentroidalDynamics;
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::product::{product, transposed_product};
use crate::scalar::Scalar;
use crate::state_space::Signal;

/// The kinetic energy `T = ½ vᵀ·M·v`, 1, in J.
///
/// `∂T/∂v = M·v`, and `∂T/∂q = Cᵀ·v − ad(v)ᵀ·M·v`: along `w` the energy changes by `vᵀ·C(q,w)·v`, for the Coriolis
/// matrix is metric, and `C(q,w)·v = C(q,v)·w + M·ad(w)·v`, for it has no torsion.
pub const fn kinetic_energy() -> Energy {
    Energy { kinetic: true, potential: false }
}

/// The potential energy `V(q)`, 1, in J. `∂V/∂q = G`.
pub const fn potential_energy() -> Energy {
    Energy { kinetic: false, potential: true }
}

/// The total energy, 1, in J: kinetic, potential and of springs.
pub const fn total_energy() -> Energy {
    Energy { kinetic: true, potential: true }
}

/// The power `vᵀ·τ` of the joint forces, 1, in W; what dampers and friction take is no part of it.
pub const fn power() -> Power {
    Power
}

/// The centre of mass in the world, 3, in m. Its gradient is the Jacobian of the centre of mass.
pub const fn center_of_mass() -> CenterOfMass {
    CenterOfMass
}

/// The output of [`kinetic_energy`], [`potential_energy`] and [`total_energy`].
#[derive(Clone, Copy, Debug)]
pub struct Energy {
    kinetic: bool,
    potential: bool,
}

/// The output of [`power`].
#[derive(Clone, Copy, Debug)]
pub struct Power;

/// The output of [`center_of_mass`].
#[derive(Clone, Copy, Debug)]
pub struct CenterOfMass;

impl Triple for CenterOfMass {}

impl<R, T: Scalar, const NQ: usize, const NV: usize> Output<R, T, NQ, NV> for Energy
where
    R: Dynamics<T, NQ, NV> + ?Sized,
{
    const ROWS: usize = 1;

    fn write(&self, robot: &R, at: &OperatingPoint<T, NQ, NV>, rows: &mut [Row<T, NV>]) -> Result<(), Error> {
        let Some(row) = rows.first_mut() else { return Ok(()) };
        let OperatingPoint { q, v, tangent_rate, .. } = at;
        if self.kinetic {
            row.value += robot.kinetic_energy(q, v);
            let momentum = product(&robot.mass_matrix(q), v);
            let turning = transposed_product(tangent_rate, &momentum);
            row.by_q += transposed_product(&robot.coriolis_matrix(q, v), v) + turning + turning;
            row.by_v += momentum;
        }
        if self.potential {
            row.value += robot.potential_energy(q);
            row.by_q += robot.gravity_forces(q);
        }
        if self.kinetic && self.potential {
            row.value += robot.elastic_energy(q);
            // At rest there is neither damping nor friction.
            row.by_q += robot.passive_forces(q, &SVector::zeros());
        }
        let name = match (self.kinetic, self.potential) {
            (true, false) => "kinetic energy",
            (false, true) => "potential energy",
            _ => "total energy",
        };
        row.signal = Signal::new(name, "J");
        Ok(())
    }
}

impl<R: ?Sized, T: Scalar, const NQ: usize, const NV: usize> Output<R, T, NQ, NV> for Power {
    const ROWS: usize = 1;

    fn write(&self, _: &R, at: &OperatingPoint<T, NQ, NV>, rows: &mut [Row<T, NV>]) -> Result<(), Error> {
        let Some(row) = rows.first_mut() else { return Ok(()) };
        let [value] = transposed_product(&at.v, &at.tau).data.0;
        [row.value] = value;
        (row.by_v, row.by_tau) = (at.tau, at.v);
        row.signal = Signal::new("power", "W");
        Ok(())
    }
}

impl<R, T: Scalar, const NQ: usize, const NV: usize> Output<R, T, NQ, NV> for CenterOfMass
where
    R: CentroidalDynamics<T, NQ, NV> + ?Sized,
{
    const ROWS: usize = 3;

    fn write(&self, robot: &R, at: &OperatingPoint<T, NQ, NV>, rows: &mut [Row<T, NV>]) -> Result<(), Error> {
        let center = robot.center_of_mass(&at.q);
        let jacobian = robot.center_of_mass_jacobian(&at.q);
        let axes = nalgebra::SMatrix::<T, 3, 3>::identity().data.0;
        let parts = [".x", ".y", ".z"];
        for (((row, part), value), axis) in rows.iter_mut().zip(parts).zip(&center).zip(axes) {
            row.signal = Signal::part("com", part, "m");
            row.value = *value;
            row.by_q = transposed_product(&jacobian, &SVector::from(axis));
        }
        Ok(())
    }
}
