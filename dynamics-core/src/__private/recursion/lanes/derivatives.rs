//! The derivatives of both dynamics, as [`composite`](super::super::composite) writes those of the inverse.
//!
//! What the derivatives of forward dynamics are solved with, M and its factors, gives the acceleration too: no articulated
//! body is folded. The links are placed once, and what they do at that acceleration is what they do without any, and what it
//! adds.
//!
//! J. Carpentier, N. Mansard, *Analytical derivatives of rigid body dynamics algorithms*, RSS 2018.

use nalgebra::{SMatrix, SVector};

use super::bodies::{MomentaInLanes, MomentsInLanes, WrenchesInLanes};
use super::matrices::{by_speed, set_momenta, set_rows};
use super::motion::TwistsInLanes;
use super::pairs::{Changes, Pairs, Square};
use super::place::Placed;
use super::{InLanes, Vectors};
use crate::__private::recursion::entries;
use crate::__private::recursion::screw::Wrench;
use crate::__private::recursion::vector::Vector;
use crate::__private::{EliminationTree, Factors, columns, vector};
use crate::dynamics::{ForwardDynamicsDerivatives, InverseDynamicsDerivatives};
use crate::scalar::Scalar;

/// How often the acceleration is refined by the forces that it leaves: without, what M rounds is seen where M is ill conditioned.
const REFINEMENTS: usize = 1;

impl<T: Scalar, const NL: usize, const NQ: usize, const N: usize> InLanes<'_, T, NL, NQ, N> {
    /// `∂τ/∂q`, `∂τ/∂v` and `∂τ/∂a = M` of inverse dynamics.
    pub fn inverse_dynamics_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, N>,
        a: &SVector<T, N>,
    ) -> InverseDynamicsDerivatives<T, N> {
        let mut moving = Moving::zero();
        self.set_moving(entries(q), entries(v), entries(a), &mut moving);
        self.collect(&mut moving);
        self.differentiated(v, &moving)
    }

    /// `τ` and these: it is what the joints feel of the wrenches by which they change.
    pub fn inverse_dynamics_with_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, N>,
        a: &SVector<T, N>,
    ) -> (SVector<T, N>, InverseDynamicsDerivatives<T, N>) {
        let mut moving = Moving::zero();
        self.set_moving(entries(q), entries(v), entries(a), &mut moving);
        self.collect(&mut moving);
        let tau = self.forces(&self.tree.passive_forces(q, v), entries(a), &moving);
        (vector(tau), self.differentiated(v, &moving))
    }

    /// `∂a/∂q = −M⁻¹ ∂τ/∂q`, `∂a/∂v = −M⁻¹ ∂τ/∂v` and `∂a/∂τ = M⁻¹`, where `τ` causes `a`; with the tree by which M is
    /// factored.
    pub fn forward_dynamics_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, N>,
        tau: &SVector<T, N>,
        tree: &'static EliminationTree<N>,
    ) -> ForwardDynamicsDerivatives<T, N> {
        self.accelerated((q, v, tau), tree, |_, accelerated| accelerated.derivatives())
    }

    /// `a` and these.
    pub fn forward_dynamics_with_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, N>,
        tau: &SVector<T, N>,
        tree: &'static EliminationTree<N>,
    ) -> (SVector<T, N>, ForwardDynamicsDerivatives<T, N>) {
        self.accelerated((q, v, tau), tree, |a, accelerated| (vector(a), accelerated.derivatives()))
    }

    /// The derivatives of the forces that cause a motion.
    #[inline(always)]
    fn differentiated(&self, v: &SVector<T, N>, moving: &Moving<T, N>) -> InverseDynamicsDerivatives<T, N> {
        let (mut changing, mut rows) = (Changing::zero(), WrenchesInLanes::zero());
        self.change(v, moving, &mut changing);
        set_rows(&moving.placed, &moving.moments, &mut rows);
        inverse_dynamics_derivatives(&self.pairs(&moving.placed, &rows), &changing, &self.armatures())
    }

    /// What `finish` makes of the acceleration, and of what its derivatives come of: they are computed where it puts them.
    #[inline(always)]
    fn accelerated<R>(
        &self,
        (q, v, tau): (&SVector<T, NQ>, &SVector<T, N>, &SVector<T, N>),
        tree: &'static EliminationTree<N>,
        finish: impl FnOnce([T; N], Accelerated<'_, T, N>) -> R,
    ) -> R {
        let mut moving = Moving::zero();
        self.set_moving(entries(q), entries(v), &[T::zero(); N], &mut moving);
        let own = moving.moments.clone();
        self.collect(&mut moving);
        let mut rows = WrenchesInLanes::zero();
        set_rows(&moving.placed, &moving.moments, &mut rows);
        let mut factors = Factors::new(tree);
        let mut inverse = self.pairs(&moving.placed, &rows).half_mass_matrix(&self.armatures());
        factors.invert(&mut inverse);

        let passive = self.tree.passive_forces(q, v);
        let mut a = [T::zero(); N];
        for _ in 0..=REFINEMENTS {
            let mut missing = self.forces(&passive, &a, &moving);
            for (force, tau) in missing.iter_mut().zip(entries(tau)) {
                *force -= *tau;
            }
            let [change] = factors.minus_solved(&[missing]);
            self.accelerate(&change, &own, &mut moving);
            for (a, change) in a.iter_mut().zip(change) {
                *a += change;
            }
        }
        let mut changing = Changing::zero();
        self.change(v, &moving, &mut changing);
        let pairs = self.pairs(&moving.placed, &rows);
        finish(a, Accelerated { pairs, changing: &changing, factors: &factors, inverse: &inverse })
    }

    /// Writes, over zeros, how the links move, and of each by itself its moments, its momenta, and the wrench on it.
    #[inline(always)]
    fn set_moving(&self, q: &[T; NQ], v: &[T; N], a: &[T; N], moving: &mut Moving<T, N>) {
        let Moving { placed, velocities, accelerations, moments, momenta, wrenches } = moving;
        self.place(q, placed);
        self.motions(placed, v, a, [velocities, accelerations]);
        self.moments(placed, moments);
        set_momenta(moments, velocities, momenta);
        for k in 0..N {
            let (body, w) = (moments.at(k), velocities.angular.at(k));
            let centripetal =
                Wrench { moment: w.cross(body.rotational_times(w)), force: w.cross(w.cross(body.first)) };
            wrenches.set(k, centripetal + body.wrench_of(accelerations.at(k)));
        }
    }

    /// Adds to them what hangs on each.
    #[inline(always)]
    fn collect(&self, moving: &mut Moving<T, N>) {
        let Moving { placed, moments, momenta, wrenches, .. } = moving;
        self.collect_moments(placed, moments);
        self.collect_momenta(placed, momenta);
        self.collect_wrenches(placed, wrenches);
    }

    /// `τ`: what the joints feel of the wrenches, of armatures at accelerations `a`, and of passive forces.
    #[inline(always)]
    fn forces(&self, passive: &SVector<T, N>, a: &[T; N], moving: &Moving<T, N>) -> [T; N] {
        let mut forces = *entries(passive);
        self.tree.add_armature_forces(a, &mut forces);
        for (k, force) in forces.iter_mut().enumerate() {
            *force += moving.placed.twist(k).dot(moving.wrenches.at(k));
        }
        forces
    }

    /// Adds what joint accelerations add: to the accelerations, and to the wrenches on all that hangs on each joint, by the
    /// links' own moments.
    #[inline(always)]
    fn accelerate(&self, a: &[T; N], own: &MomentsInLanes<T, N>, moving: &mut Moving<T, N>) {
        let Moving { placed, accelerations, wrenches, .. } = moving;
        let (mut added, mut felt) = (TwistsInLanes::zero(), WrenchesInLanes::zero());
        self.velocities(placed, a, &mut added); // linear in speeds as in accelerations
        for k in 0..N {
            felt.set(k, own.at(k).wrench_of(added.at(k)));
        }
        self.collect_wrenches(placed, &mut felt);
        for k in 0..N {
            accelerations.set(k, accelerations.at(k) + added.at(k));
            wrenches.set(k, wrenches.at(k) + felt.at(k));
        }
    }

    /// Writes how the joints change by place and by speed.
    #[inline(always)]
    fn change(&self, v: &SVector<T, N>, moving: &Moving<T, N>, changing: &mut Changing<T, N>) {
        let Changing { by_place, by_speed: changes, nu, slopes } = changing;
        *slopes = self.passive_slopes(entries(v));
        by_speed(&moving.placed, &moving.velocities, (&moving.moments, &moving.momenta), changes, nu);
        moving.change_by_place(changes, by_place);
        self.change_base(moving, [by_place, changes]);
    }

    /// Writes over the changes of a free base those of a joint of six parts, which turn each other: by place, they change as
    /// what carries the base does, which is at rest; by speed, at the mean of its velocity and of the base's.
    fn change_base(&self, moving: &Moving<T, N>, [by_place, by_speed]: [&mut Changes<T, N>; 2]) {
        for k in 0..Self::BASE {
            let (unit, moments, momenta) =
                (moving.placed.twist(k), moving.moments.at(k), moving.momenta.at(k));
            let twist = self.upwards().cross(unit);
            by_place.twists.set(k, twist);
            by_place.turns.set(k, Vector::zero());
            by_place.wrenches.set(k, moments.wrench_of(twist));
            let twist = moving.velocities.at(k).scaled(T::of(0.5)).cross(unit);
            by_speed.twists.set(k, twist);
            by_speed.wrenches.set(k, moments.wrench_of(twist) + momenta.wrench_of(unit.angular));
        }
    }
}

/// How the links move, and what of each, or of all that hangs on its joint, comes of it.
struct Moving<T, const N: usize> {
    placed: Placed<T, N>,
    velocities: TwistsInLanes<T, N>,
    /// Less gravity.
    accelerations: TwistsInLanes<T, N>,
    moments: MomentsInLanes<T, N>,
    momenta: MomentaInLanes<T, N>,
    wrenches: WrenchesInLanes<T, N>,
}

impl<T: Scalar, const N: usize> Moving<T, N> {
    #[inline(always)]
    fn zero() -> Self {
        Self {
            placed: Placed::zero(),
            velocities: TwistsInLanes::zero(),
            accelerations: TwistsInLanes::zero(),
            moments: MomentsInLanes::zero(),
            momenta: MomentaInLanes::zero(),
            wrenches: WrenchesInLanes::zero(),
        }
    }

    /// Writes the changes of `∂τ/∂q`, from those of C.
    #[inline(always)]
    fn change_by_place(&self, by_speed: &Changes<T, N>, by_place: &mut Changes<T, N>) {
        for k in 0..N {
            let (unit, velocity, rate) = (self.placed.twist(k), self.velocities.at(k), by_speed.twists.at(k));
            let acceleration = self.accelerations.at(k).without_turning(velocity);
            let twist = acceleration.cross(unit) + velocity.cross(rate);
            let turn = rate.angular + rate.angular;
            let wrench = self.moments.at(k).wrench_of(twist) + self.momenta.at(k).wrench_of(turn);
            by_place.wrenches.set(k, wrench + unit.cross_wrench(self.wrenches.at(k)));
            by_place.twists.set(k, twist);
            by_place.turns.set(k, turn);
        }
    }
}

/// How the joints change by place and by speed, the latter as C asks for it, ν, and what passive forces add for each.
struct Changing<T, const N: usize> {
    by_place: Changes<T, N>,
    by_speed: Changes<T, N>,
    nu: Vectors<T, N>,
    slopes: [[T; N]; 2],
}

impl<T: Scalar, const N: usize> Changing<T, N> {
    #[inline(always)]
    fn zero() -> Self {
        let slopes = [[T::zero(); N]; 2];
        Self { by_place: Changes::zero(), by_speed: Changes::zero(), nu: Vectors::zero(), slopes }
    }
}

// Here, with what they call: where LLVM does not see all of it together, it makes some matrices elsewhere and copies them.

#[inline(never)]
fn inverse_dynamics_derivatives<T: Scalar, const N: usize>(
    pairs: &Pairs<'_, T, N>,
    changing: &Changing<T, N>,
    armatures: &[T; N],
) -> InverseDynamicsDerivatives<T, N> {
    InverseDynamicsDerivatives {
        dtau_dq: columns(pairs.dtau_dq(changing)),
        dtau_dv: columns(pairs.dtau_dv(changing)),
        dtau_da: columns(pairs.mass_matrix(armatures)),
    }
}

/// What derivatives of forward dynamics come of.
struct Accelerated<'a, T, const N: usize> {
    pairs: Pairs<'a, T, N>,
    changing: &'a Changing<T, N>,
    factors: &'a Factors<T, N>,
    /// `M⁻¹`
    inverse: &'a Square<T, N>,
}

impl<T: Scalar, const N: usize> Accelerated<'_, T, N> {
    #[inline(never)]
    fn derivatives(&self) -> ForwardDynamicsDerivatives<T, N> {
        let Self { pairs, changing, factors, inverse } = self;
        ForwardDynamicsDerivatives {
            da_dq: minus_solved(factors, || pairs.dtau_dq(changing)),
            da_dv: minus_solved(factors, || pairs.dtau_dv(changing)),
            da_dtau: columns(**inverse),
        }
    }
}

// On their own, for the stack of unoptimised builds: there each step between is a matrix.

fn minus_solved<T: Scalar, const N: usize>(
    factors: &Factors<T, N>,
    b: impl FnOnce() -> Square<T, N>,
) -> SMatrix<T, N, N> {
    columns(factors.minus_solved(&b()))
}

impl<T: Scalar, const N: usize> Pairs<'_, T, N> {
    #[inline(always)]
    fn dtau_dq(&self, Changing { by_place, nu, slopes: [slopes, _], .. }: &Changing<T, N>) -> Square<T, N> {
        self.changes(by_place, nu, T::one(), slopes)
    }

    /// 2C, and what passive forces add.
    #[inline(always)]
    fn dtau_dv(&self, Changing { by_speed, nu, slopes: [_, slopes], .. }: &Changing<T, N>) -> Square<T, N> {
        self.changes(by_speed, nu, T::of(2.0), slopes)
    }
}
