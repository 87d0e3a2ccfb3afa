//! `M`, `C` and the derivatives of inverse dynamics, as [`composite`](super::super::composite) writes them.

use nalgebra::{SMatrix, SVector};

use super::bodies::{Momenta, MomentaInLanes, MomentsInLanes, WrenchesInLanes};
use super::motion::TwistsInLanes;
use super::pairs::{Changes, Pairs};
use super::place::Placed;
use super::{InLanes, Vectors};
use crate::__private::recursion::entries;
use crate::__private::recursion::screw::Wrench;
use crate::__private::recursion::vector::Vector;
use crate::__private::{columns, vector};
use crate::dynamics::{EquationsOfMotion, InverseDynamicsDerivatives};
use crate::scalar::Scalar;

impl<T: Scalar, const NL: usize, const NQ: usize, const N: usize> InLanes<'_, T, NL, NQ, N> {
    /// The mass matrix `M(q)`, both halves, with the armatures.
    pub fn mass_matrix(&self, q: &SVector<T, NQ>) -> SMatrix<T, N, N> {
        let mut placed = Placed::zero();
        self.place(entries(q), &mut placed);
        let mut moments = MomentsInLanes::zero();
        self.moments(&placed, &mut moments);
        self.collect_moments(&placed, &mut moments);
        let mut rows = WrenchesInLanes::zero();
        set_rows(&placed, &moments, &mut rows);
        columns(self.pairs(&placed, &rows).mass_matrix(&self.armatures()))
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

    /// `∂τ/∂q`, `∂τ/∂v` and `∂τ/∂a = M` of inverse dynamics.
    pub fn inverse_dynamics_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, N>,
        a: &SVector<T, N>,
    ) -> InverseDynamicsDerivatives<T, N> {
        self.differentiated((q, v, a), |_, differentiated| differentiated.derivatives())
    }

    /// `τ` and these: it is what the joints feel of the wrenches by which they change.
    pub fn inverse_dynamics_with_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, N>,
        a: &SVector<T, N>,
    ) -> (SVector<T, N>, InverseDynamicsDerivatives<T, N>) {
        self.differentiated((q, v, a), |wrenches, differentiated| {
            let [mut tau] = self.tree.passive_forces(q, v).data.0;
            self.tree.add_armature_forces(entries(a), &mut tau);
            for (k, force) in tau.iter_mut().enumerate() {
                *force += differentiated.placed.twist(k).dot(wrenches.at(k));
            }
            (vector(tau), differentiated.derivatives())
        })
    }

    /// What `finish` makes of the wrench on each joint and of what its derivatives come of.
    #[inline(always)]
    fn differentiated<R>(
        &self,
        (q, v, a): (&SVector<T, NQ>, &SVector<T, N>, &SVector<T, N>),
        finish: impl FnOnce(&WrenchesInLanes<T, N>, Differentiated<'_, T, N>) -> R,
    ) -> R {
        let mut placed = Placed::zero();
        self.place(entries(q), &mut placed);
        let (mut velocities, mut accelerations) = (TwistsInLanes::zero(), TwistsInLanes::zero());
        self.motions(&placed, entries(v), entries(a), [&mut velocities, &mut accelerations]);
        let (mut moments, mut momenta) = (MomentsInLanes::zero(), MomentaInLanes::zero());
        let mut wrenches = WrenchesInLanes::zero();
        self.moments(&placed, &mut moments);
        set_momenta(&moments, &velocities, &mut momenta);
        set_wrenches(&moments, &velocities, &accelerations, &mut wrenches);
        self.collect_moments(&placed, &mut moments);
        self.collect_momenta(&placed, &mut momenta);
        self.collect_wrenches(&placed, &mut wrenches);
        let composites = (&moments, &momenta);

        let (mut of_speeds, mut of_places, mut nu) = (Changes::zero(), Changes::zero(), Vectors::zero());
        by_speed(&placed, &velocities, composites, &mut of_speeds, &mut nu);
        by_place(&placed, [&velocities, &accelerations], composites, &wrenches, &of_speeds, &mut of_places);
        self.change_base(&placed, &velocities, composites, [&mut of_places, &mut of_speeds]);
        let mut rows = WrenchesInLanes::zero();
        set_rows(&placed, &moments, &mut rows);
        let (armatures, [slopes_by_place, slopes_by_speed]) =
            (self.armatures(), self.passive_slopes(entries(v)));
        let differentiated = Differentiated {
            placed: &placed,
            pairs: self.pairs(&placed, &rows),
            changes: [&of_places, &of_speeds],
            nu: &nu,
            slopes: [&slopes_by_place, &slopes_by_speed],
            armatures: &armatures,
        };
        finish(&wrenches, differentiated)
    }

    /// Writes over the changes of a free base those of a joint of six parts, which turn each other: by place, they change as
    /// what carries the base does, which is at rest; by speed, at the mean of its velocity and of the base's.
    fn change_base(
        &self,
        placed: &Placed<T, N>,
        velocities: &TwistsInLanes<T, N>,
        (moments, momenta): Composites<'_, T, N>,
        [of_places, of_speeds]: [&mut Changes<T, N>; 2],
    ) {
        for k in 0..Self::BASE {
            let (unit, moments, momenta) = (placed.twist(k), moments.at(k), momenta.at(k));
            let by_place = self.upwards().cross(unit);
            of_places.twists.set(k, by_place);
            of_places.turns.set(k, Vector::zero());
            of_places.wrenches.set(k, moments.wrench_of(by_place));
            let by_speed = velocities.at(k).scaled(T::of(0.5)).cross(unit);
            of_speeds.twists.set(k, by_speed);
            of_speeds.wrenches.set(k, moments.wrench_of(by_speed) + momenta.wrench_of(unit.angular));
        }
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

/// What derivatives of inverse dynamics come of.
struct Differentiated<'a, T, const N: usize> {
    placed: &'a Placed<T, N>,
    pairs: Pairs<'a, T, N>,
    changes: [&'a Changes<T, N>; 2],
    nu: &'a Vectors<T, N>,
    slopes: [&'a [T; N]; 2],
    armatures: &'a [T; N],
}

impl<T: Scalar, const N: usize> Differentiated<'_, T, N> {
    #[inline(always)]
    fn derivatives(&self) -> InverseDynamicsDerivatives<T, N> {
        self.pairs.derivatives(self.changes, self.nu, self.slopes, self.armatures)
    }
}

type Composites<'a, T, const N: usize> = (&'a MomentsInLanes<T, N>, &'a MomentaInLanes<T, N>);

/// Writes `𝕁 S`: the wrenches of unit motions.
fn set_rows<T: Scalar, const N: usize>(
    placed: &Placed<T, N>,
    moments: &MomentsInLanes<T, N>,
    rows: &mut WrenchesInLanes<T, N>,
) {
    for k in 0..N {
        rows.set(k, moments.at(k).wrench_of(placed.twist(k)));
    }
}

/// 𝔹 of each link.
fn set_momenta<T: Scalar, const N: usize>(
    moments: &MomentsInLanes<T, N>,
    velocities: &TwistsInLanes<T, N>,
    momenta: &mut MomentaInLanes<T, N>,
) {
    for k in 0..N {
        momenta.set(k, Momenta::new(&moments.at(k), velocities.at(k)));
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
        wrenches.set(k, moving + body.wrench_of(accelerations.at(k)));
    }
}

/// The changes of C, and ν.
fn by_speed<T: Scalar, const N: usize>(
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

/// Those of `∂τ/∂q`, from those of C.
fn by_place<T: Scalar, const N: usize>(
    placed: &Placed<T, N>,
    [velocities, accelerations]: [&TwistsInLanes<T, N>; 2],
    (moments, momenta): Composites<'_, T, N>,
    wrenches: &WrenchesInLanes<T, N>,
    of_speeds: &Changes<T, N>,
    changes: &mut Changes<T, N>,
) {
    for k in 0..N {
        let (unit, velocity, rate) = (placed.twist(k), velocities.at(k), of_speeds.twists.at(k));
        let acceleration = accelerations.at(k).without_turning(velocity);
        let twist = acceleration.cross(unit) + velocity.cross(rate);
        let turn = rate.angular + rate.angular;
        let wrench = moments.at(k).wrench_of(twist) + momenta.at(k).wrench_of(turn);
        changes.wrenches.set(k, wrench + unit.cross_wrench(wrenches.at(k)));
        changes.twists.set(k, twist);
        changes.turns.set(k, turn);
    }
}
