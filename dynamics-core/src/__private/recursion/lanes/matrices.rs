//! `M`, `C` and the derivatives of inverse dynamics, as [`composite`](super::super::composite) writes them.

use nalgebra::{SMatrix, SVector};

use super::bodies::{Additive, Momenta, MomentaInLanes, Moments, MomentsInLanes, WrenchesInLanes};
use super::motion::TwistsInLanes;
use super::pairs::Changes;
use super::place::Placed;
use super::{InLanes, Vectors};
use crate::__private::recursion::entries;
use crate::__private::recursion::screw::{Twist, Wrench};
use crate::__private::recursion::sweep::zeros;
use crate::__private::recursion::vector::Vector;
use crate::dynamics::{EquationsOfMotion, InverseDynamicsDerivatives};
use crate::scalar::Scalar;

impl<T: Scalar, const N: usize> InLanes<'_, T, N> {
    /// The mass matrix `M(q)`, both halves, with the armatures.
    pub fn mass_matrix(&self, q: &SVector<T, N>) -> SMatrix<T, N, N> {
        let mut placed = Placed::zero();
        self.place(entries(q), &mut placed);
        let mut moments = MomentsInLanes::zero();
        self.moments(&placed, &mut moments);
        self.collect::<Moments<T>>(&placed.offsets, &mut moments);
        let mut m = zeros();
        self.pairs(&placed, &rows(&placed, &moments)).write_mass_matrix(&mut m.data.0);
        self.tree.add_armatures(&mut m);
        m
    }

    /// The Coriolis matrix `C(q,v)`: Levi-Civita's, without passive forces.
    pub fn coriolis_matrix(&self, q: &SVector<T, N>, v: &SVector<T, N>) -> SMatrix<T, N, N> {
        let mut placed = Placed::zero();
        self.place(entries(q), &mut placed);
        let velocities = self.velocities(&placed, entries(v));
        let composites = self.composites(&placed, &velocities);
        let mut c = zeros();
        let (mut changes, mut nu) = (Changes::zero(), Vectors::zero());
        by_speed(&placed, &velocities, &composites, &mut changes, &mut nu);
        self.pairs(&placed, &rows(&placed, &composites.0)).write_changes(&changes, &nu, &mut c.data.0);
        c
    }

    /// `M`, `C` and `G`.
    pub fn equations_of_motion(&self, q: &SVector<T, N>, v: &SVector<T, N>) -> EquationsOfMotion<T, N> {
        let mut placed = Placed::zero();
        self.place(entries(q), &mut placed);
        let velocities = self.velocities(&placed, entries(v));
        let composites = self.composites(&placed, &velocities);
        let upwards = Twist { angular: Vector::zero(), linear: -Vector(self.tree.gravity) };
        let mut result = EquationsOfMotion {
            mass_matrix: zeros(),
            coriolis_matrix: zeros(),
            gravity_forces: SVector::zeros(),
        };
        let [forces] = &mut result.gravity_forces.data.0;
        for (k, force) in forces.iter_mut().enumerate() {
            *force = placed.twist(k).dot(composites.0.at(k).wrench_of(upwards));
        }
        let rows = rows(&placed, &composites.0);
        let pairs = self.pairs(&placed, &rows);
        pairs.write_mass_matrix(&mut result.mass_matrix.data.0);
        let (mut changes, mut nu) = (Changes::zero(), Vectors::zero());
        by_speed(&placed, &velocities, &composites, &mut changes, &mut nu);
        pairs.write_changes(&changes, &nu, &mut result.coriolis_matrix.data.0);
        self.tree.add_armatures(&mut result.mass_matrix);
        result
    }

    /// `∂τ/∂q`, `∂τ/∂v` and `∂τ/∂a = M` of inverse dynamics.
    pub fn inverse_dynamics_derivatives(
        &self,
        q: &SVector<T, N>,
        v: &SVector<T, N>,
        a: &SVector<T, N>,
    ) -> InverseDynamicsDerivatives<T, N> {
        let mut placed = Placed::zero();
        self.place(entries(q), &mut placed);
        let (velocities, accelerations) = self.motions(&placed, entries(v), entries(a));
        let mut bodies = ((MomentsInLanes::zero(), MomentaInLanes::zero()), WrenchesInLanes::zero());
        let (composites, wrenches) = &mut bodies;
        self.moments(&placed, &mut composites.0);
        set_momenta(composites, &velocities);
        set_wrenches(&composites.0, &velocities, &accelerations, wrenches);
        self.collect::<((Moments<T>, Momenta<T>), Wrench<T>)>(&placed.offsets, &mut bodies);
        let (composites, wrenches) = &bodies;

        let rows = rows(&placed, &composites.0);
        let pairs = self.pairs(&placed, &rows);
        let mut result = InverseDynamicsDerivatives { dtau_dq: zeros(), dtau_dv: zeros(), dtau_da: zeros() };
        let (mut changes, mut nu) = (Changes::zero(), Vectors::zero());
        by_speed(&placed, &velocities, composites, &mut changes, &mut nu);
        pairs.write_changes(&changes, &nu, &mut result.dtau_dv.data.0);
        for entry in result.dtau_dv.data.0.as_flattened_mut() {
            *entry += *entry; // ∂τ/∂v = 2C
        }
        by_place(&placed, &velocities, &accelerations, composites, wrenches, &mut changes);
        pairs.write_changes(&changes, &nu, &mut result.dtau_dq.data.0);
        pairs.write_mass_matrix(&mut result.dtau_da.data.0);
        self.tree.add_passive_slopes(entries(v), &mut result.dtau_dq, &mut result.dtau_dv);
        self.tree.add_armatures(&mut result.dtau_da);
        result
    }

    /// 𝕁 and 𝔹 of all that hangs on each joint.
    fn composites(&self, placed: &Placed<T, N>, velocities: &TwistsInLanes<T, N>) -> Composites<T, N> {
        let mut composites = (MomentsInLanes::zero(), MomentaInLanes::zero());
        self.moments(placed, &mut composites.0);
        set_momenta(&mut composites, velocities);
        self.collect::<(Moments<T>, Momenta<T>)>(&placed.offsets, &mut composites);
        composites
    }
}

type Composites<T, const N: usize> = (MomentsInLanes<T, N>, MomentaInLanes<T, N>);

/// `𝕁 S`: the wrenches of unit motions.
fn rows<T: Scalar, const N: usize>(
    placed: &Placed<T, N>,
    moments: &MomentsInLanes<T, N>,
) -> WrenchesInLanes<T, N> {
    let mut rows = WrenchesInLanes::zero();
    for k in 0..N {
        moments.at(k).wrench_of(placed.twist(k)).write(&mut rows, k);
    }
    rows
}

/// 𝔹 of each link.
fn set_momenta<T: Scalar, const N: usize>(
    (moments, momenta): &mut Composites<T, N>,
    velocities: &TwistsInLanes<T, N>,
) {
    for k in 0..N {
        Momenta::new(&moments.at(k), velocities.at(k)).write(momenta, k);
    }
}

/// The wrench on each link.
fn set_wrenches<T: Scalar, const N: usize>(
    moments: &MomentsInLanes<T, N>,
    velocities: &TwistsInLanes<T, N>,
    accelerations: &TwistsInLanes<T, N>,
    wrenches: &mut WrenchesInLanes<T, N>,
) {
    for k in 0..N {
        let (body, w) = (moments.at(k), velocities.angular.at(k));
        let moving =
            Wrench { moment: w.cross(body.rotational_times(w)), force: w.cross(w.cross(body.first)) };
        (moving + body.wrench_of(accelerations.at(k))).write(wrenches, k);
    }
}

/// The changes of C, and ν.
fn by_speed<T: Scalar, const N: usize>(
    placed: &Placed<T, N>,
    velocities: &TwistsInLanes<T, N>,
    (moments, momenta): &Composites<T, N>,
    changes: &mut Changes<T, N>,
    nu: &mut Vectors<T, N>,
) {
    for k in 0..N {
        let (unit, momenta) = (placed.twist(k), Momenta::read(momenta, k));
        let twist = velocities.at(k).cross(unit);
        changes.twists.set(k, twist);
        changes.turns.set(k, unit.angular);
        (moments.at(k).wrench_of(twist) + momenta.wrench_of(unit.angular)).write(&mut changes.wrenches, k);
        nu.set(k, momenta.row_of(unit));
    }
}

/// Those of `∂τ/∂q`, from those of C.
fn by_place<T: Scalar, const N: usize>(
    placed: &Placed<T, N>,
    velocities: &TwistsInLanes<T, N>,
    accelerations: &TwistsInLanes<T, N>,
    (moments, momenta): &Composites<T, N>,
    wrenches: &WrenchesInLanes<T, N>,
    changes: &mut Changes<T, N>,
) {
    for k in 0..N {
        let (unit, velocity, rate) = (placed.twist(k), velocities.at(k), changes.twists.at(k));
        let acceleration = accelerations.at(k).without_turning(velocity);
        let twist = acceleration.cross(unit) + velocity.cross(rate);
        let turn = rate.angular + rate.angular;
        let wrench = moments.at(k).wrench_of(twist) + Momenta::read(momenta, k).wrench_of(turn);
        (wrench + unit.cross_wrench(wrenches.at(k))).write(&mut changes.wrenches, k);
        changes.twists.set(k, twist);
        changes.turns.set(k, turn);
    }
}
