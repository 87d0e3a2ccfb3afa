//! `M` and `C`, as [`composite`](super::super::composite) writes them.

use nalgebra::{SMatrix, SVector};

use super::bodies::{Momenta, MomentaInLanes, MomentsInLanes, WrenchesInLanes};
use super::motion::TwistsInLanes;
use super::pairs::Changes;
use super::place::Placed;
use super::{InLanes, Vectors};
use crate::__private::recursion::entries;
use crate::__private::{EliminationTree, columns, inverse_of, vector};
use crate::dynamics::EquationsOfMotion;
use crate::scalar::Scalar;

impl<T: Scalar, const NL: usize, const NQ: usize, const N: usize> InLanes<'_, T, NL, NQ, N> {
    /// The mass matrix `M(q)`, both halves, with the armatures.
    pub fn mass_matrix(&self, q: &SVector<T, NQ>) -> SMatrix<T, N, N> {
        let (mut placed, mut rows) = (Placed::zero(), WrenchesInLanes::zero());
        self.set_unit_wrenches(q, &mut placed, &mut rows);
        columns(self.pairs(&placed, &rows).mass_matrix(&self.armatures()))
    }

    /// `M(q)⁻¹`, both halves.
    pub fn inverse_mass_matrix(&self, q: &SVector<T, NQ>, tree: &EliminationTree<N>) -> SMatrix<T, N, N> {
        let (mut placed, mut rows) = (Placed::zero(), WrenchesInLanes::zero());
        self.set_unit_wrenches(q, &mut placed, &mut rows);
        inverse_of(columns(self.pairs(&placed, &rows).half_mass_matrix(&self.armatures())), tree)
    }

    /// Writes where the links are, and the wrenches of unit motions on all that hangs on their joints.
    fn set_unit_wrenches(
        &self,
        q: &SVector<T, NQ>,
        placed: &mut Placed<T, N>,
        rows: &mut WrenchesInLanes<T, N>,
    ) {
        self.place(entries(q), placed);
        let mut moments = MomentsInLanes::zero();
        self.moments(placed, &mut moments);
        self.collect_moments(placed, &mut moments);
        set_rows(placed, &moments, rows);
    }

    /// The Coriolis matrix `C(q,v)`: Levi-Civita's, without passive forces.
    pub fn coriolis_matrix(&self, q: &SVector<T, NQ>, v: &SVector<T, N>) -> SMatrix<T, N, N> {
        let mut placed = Placed::zero();
        self.place(entries(q), &mut placed);
        let mut velocities = TwistsInLanes::zero();
        let mut composites = (MomentsInLanes::zero(), MomentaInLanes::zero());
        self.velocities(&placed, entries(v), &mut velocities);
        self.composites(&placed, &velocities, &mut composites);
        let (mut changes, mut nu) = (Changes::zero(), Vectors::zero());
        by_speed(&placed, &velocities, (&composites.0, &composites.1), &mut changes, &mut nu);
        let mut rows = WrenchesInLanes::zero();
        set_rows(&placed, &composites.0, &mut rows);
        columns(self.pairs(&placed, &rows).changes(&changes, &nu, T::one(), &[]))
    }

    /// `M`, `C` and `G`.
    pub fn equations_of_motion(&self, q: &SVector<T, NQ>, v: &SVector<T, N>) -> EquationsOfMotion<T, N> {
        let mut placed = Placed::zero();
        self.place(entries(q), &mut placed);
        let mut velocities = TwistsInLanes::zero();
        let mut composites = (MomentsInLanes::zero(), MomentaInLanes::zero());
        self.velocities(&placed, entries(v), &mut velocities);
        self.composites(&placed, &velocities, &mut composites);
        let (mut changes, mut nu) = (Changes::zero(), Vectors::zero());
        by_speed(&placed, &velocities, (&composites.0, &composites.1), &mut changes, &mut nu);
        let (mut rows, armatures) = (WrenchesInLanes::zero(), self.armatures());
        set_rows(&placed, &composites.0, &mut rows);
        let pairs = self.pairs(&placed, &rows);
        EquationsOfMotion {
            mass_matrix: columns(pairs.mass_matrix(&armatures)),
            coriolis_matrix: columns(pairs.changes(&changes, &nu, T::one(), &[])),
            gravity_forces: vector(self.gravity_forces(&placed, &composites.0)),
        }
    }

    /// `G`, from the moments of all that hangs on each joint.
    #[inline(never)] // or else M is copied once more
    fn gravity_forces(&self, placed: &Placed<T, N>, moments: &MomentsInLanes<T, N>) -> [T; N] {
        let mut forces = [T::zero(); N];
        for (k, force) in forces.iter_mut().enumerate() {
            *force = placed.twist(k).dot(moments.at(k).wrench_of(self.upwards()));
        }
        forces
    }

    /// Writes 𝕁 and 𝔹 of all that hangs on each joint.
    fn composites(
        &self,
        placed: &Placed<T, N>,
        velocities: &TwistsInLanes<T, N>,
        composites: &mut (MomentsInLanes<T, N>, MomentaInLanes<T, N>),
    ) {
        self.moments(placed, &mut composites.0);
        set_momenta(&composites.0, velocities, &mut composites.1);
        self.collect_moments(placed, &mut composites.0);
        self.collect_momenta(placed, &mut composites.1);
    }
}

type Composites<'a, T, const N: usize> = (&'a MomentsInLanes<T, N>, &'a MomentaInLanes<T, N>);

/// Writes `𝕁 S`: the wrenches of unit motions.
pub(super) fn set_rows<T: Scalar, const N: usize>(
    placed: &Placed<T, N>,
    moments: &MomentsInLanes<T, N>,
    rows: &mut WrenchesInLanes<T, N>,
) {
    for k in 0..N {
        rows.set(k, moments.at(k).wrench_of(placed.twist(k)));
    }
}

/// 𝔹 of each link.
pub(super) fn set_momenta<T: Scalar, const N: usize>(
    moments: &MomentsInLanes<T, N>,
    velocities: &TwistsInLanes<T, N>,
    momenta: &mut MomentaInLanes<T, N>,
) {
    for k in 0..N {
        momenta.set(k, Momenta::new(&moments.at(k), velocities.at(k)));
    }
}

/// The changes of C, and ν.
pub(super) fn by_speed<T: Scalar, const N: usize>(
    placed: &Placed<T, N>,
    velocities: &TwistsInLanes<T, N>,
    (moments, momenta): Composites<'_, T, N>,
    changes: &mut Changes<T, N>,
    nu: &mut Vectors<T, N>,
) {
    for k in 0..N {
        let (unit, momenta) = (placed.twist(k), momenta.at(k));
        let twist = velocities.at(k).cross(unit);
        changes.twists.set(k, twist);
        changes.turns.set(k, unit.angular);
        changes.wrenches.set(k, moments.at(k).wrench_of(twist) + momenta.wrench_of(unit.angular));
        nu.set(k, momenta.row_of(unit));
    }
}
