//! Forward dynamics: the articulated-body algorithm, O(N).
//!
//! The columns of a joint are folded one after another, as if massless links stood between them. That needs a speed
//! for each column: where links share one, the mass matrix is factored.
//!
//! Articulated inertias are `[[J, H], [Hᵀ, M]]` on (angular, linear) accelerations.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, ch. 7.

use core::mem;
use core::ops::Add;

use nalgebra::SVector;

use super::joint::Column;
use super::motion::Motion;
use super::place::{Body, Moments};
use super::screw::{Twist, Wrench};
use super::sweep::{difference, each};
use super::vector::{Matrix, Vector};
use super::{Tree, entries, entry};
use crate::__private::vector;
use crate::scalar::Scalar;

impl<T: Scalar, const NL: usize, const NQ: usize, const NV: usize> Tree<T, NL, NQ, NV> {
    /// The accelerations `a = M(q)⁻¹·(τ − C(q,v)·v − G(q))`, τ less the passive forces.
    pub fn forward_dynamics(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        tau: &SVector<T, NV>,
    ) -> SVector<T, NV> {
        if self.shares_speeds() {
            self.forward_dynamics_by_factoring(q, v, tau)
        } else {
            self.forward_dynamics_by_folding(q, v, tau)
        }
    }

    /// Whether some links move by one speed.
    fn shares_speeds(&self) -> bool {
        let mut taken = [false; NV];
        let mut speeds = self.links.iter().flat_map(|link| link.joint.speeds());
        speeds.any(|v| taken.get_mut(v).is_some_and(|taken| mem::replace(taken, true)))
    }

    fn forward_dynamics_by_folding(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        tau: &SVector<T, NV>,
    ) -> SVector<T, NV> {
        let bodies = self.place(entries(q));
        let motions = self.motions(&bodies, entries(v));
        let forces = difference(entries(tau), entries(&self.passive_forces(q, v)));
        let folded = self.fold_tip_to_base(&bodies, &motions, &forces);
        let mut a = [T::zero(); NV];
        self.base_to_tip(bodies.iter().zip(&motions), self.base_acceleration(), |(body, motion), parent| {
            let acceleration = parent.carried(body.offset) + motion.drift;
            body.columns.iter().fold(acceleration, |acceleration, column| {
                let (Some(folded), Some(a)) = (folded.get(column.v), a.get_mut(column.v)) else {
                    return acceleration;
                };
                *a = (folded.u - acceleration.dot(folded.wrench)) * folded.inverse_mass;
                acceleration + column.twist().scaled(*a)
            })
        });
        vector(a)
    }

    /// Folds each link, with all that is folded into it already, into its parent.
    fn fold_tip_to_base(
        &self,
        bodies: &[Body<T>; NL],
        motions: &[Motion<T>; NL],
        forces: &[T; NV],
    ) -> [Folded<T>; NV] {
        let links = bodies.iter().zip(motions);
        let mut articulated: [_; NL] = each(links, Articulated::zero(), |(body, motion)| {
            Articulated::new(&body.moments, motion.velocity.angular)
        });
        let mut columns = [Folded::blank(); NV];
        let links = self.links.iter().zip(bodies.iter().zip(motions));
        for (k, (link, (body, motion))) in links.enumerate().rev() {
            let Some((before, [own, ..])) = articulated.split_at_mut_checked(k) else { continue };
            let armature = link.joint.armature();
            for column in body.columns.iter().rev() {
                let Some(folded) = columns.get_mut(column.v) else { continue };
                *folded = own.fold(column, armature, entry(forces, column.v));
                *own = own.without(folded);
            }
            if let Some(parent) = link.parent.and_then(|parent| before.get_mut(parent)) {
                *parent = *parent + own.pushed(motion.drift).shifted(body.offset);
            }
        }
        columns
    }
}

/// What is left of a column once all beyond it is folded into it: `a = (u − wrench·acceleration)·inverse_mass`.
#[derive(Clone, Copy)]
struct Folded<T> {
    /// `I S`: the wrench for one unit of the acceleration.
    wrench: Wrench<T>,
    /// `1/(Sᵀ I S)`, with the armature.
    inverse_mass: T,
    /// What remains of the joint's force: `τ − Sᵀ p`.
    u: T,
}

impl<T: Scalar> Folded<T> {
    fn blank() -> Self {
        Self { wrench: Wrench::zero(), inverse_mass: T::one(), u: T::zero() }
    }
}

/// A link and all beyond it, its joints free to move: the wrench that it needs is `I·acceleration + p`.
#[derive(Clone, Copy)]
struct Articulated<T> {
    angular: Matrix<T>,
    coupling: Matrix<T>,
    linear: Matrix<T>,
    bias: Wrench<T>,
}

impl<T: Scalar> Articulated<T> {
    fn zero() -> Self {
        let o = Matrix::zero();
        Self { angular: o, coupling: o, linear: o, bias: Wrench::zero() }
    }

    /// A link alone, turning with `w`.
    fn new(moments: &Moments<T>, w: Vector<T>) -> Self {
        let Moments { mass, first, second } = *moments;
        let Matrix([[xx, xy, xz], [_, yy, yz], [_, _, zz]]) = second;
        let o = T::zero();
        Self {
            angular: Matrix::symmetric([yy + zz, xx + zz, xx + yy, -xy, -xz, -yz]),
            coupling: Matrix::identity().times_skew_transposed(first).transpose(),
            linear: Matrix::symmetric([mass, mass, mass, o, o, o]),
            bias: moments.centripetal_wrench(w),
        }
    }

    fn times(&self, a: Twist<T>) -> Wrench<T> {
        Wrench {
            moment: self.angular.times(a.angular) + self.coupling.times(a.linear),
            force: self.coupling.transpose().times(a.angular) + self.linear.times(a.linear),
        }
    }

    fn fold(&self, column: Column<T>, armature: T, force: T) -> Folded<T> {
        let wrench = self.times(column.twist());
        Folded {
            wrench,
            inverse_mass: T::one() / (column.power(wrench) + armature),
            u: force - column.power(self.bias),
        }
    }

    /// What is felt of it through the column: `I − U Uᵀ/D`, and `p + U u/D`.
    fn without(&self, folded: &Folded<T>) -> Self {
        let Wrench { moment, force } = folded.wrench;
        let less = folded.wrench.scaled(-folded.inverse_mass);
        Self {
            angular: self.angular + Matrix::outer(moment, less.moment),
            coupling: self.coupling + Matrix::outer(moment, less.force),
            linear: self.linear + Matrix::outer(force, less.force),
            bias: self.bias + folded.wrench.scaled(folded.u * folded.inverse_mass),
        }
    }

    /// The same, its acceleration counted from `drift`: `p + I drift`.
    fn pushed(&self, drift: Twist<T>) -> Self {
        Self { bias: self.bias + self.times(drift), ..*self }
    }

    /// The same about the parent's origin.
    fn shifted(&self, offset: Vector<T>) -> Self {
        let coupling = self.coupling + self.linear.times_skew_transposed(offset).transpose();
        let across = self.coupling.times_skew_transposed(offset).transpose();
        Self {
            angular: self.angular + coupling.times_skew_transposed(offset) + across,
            coupling,
            linear: self.linear,
            bias: self.bias.shifted(offset),
        }
    }
}

impl<T: Scalar> Add for Articulated<T> {
    type Output = Self;

    fn add(self, rhs: Self) -> Self {
        Self {
            angular: self.angular + rhs.angular,
            coupling: self.coupling + rhs.coupling,
            linear: self.linear + rhs.linear,
            bias: self.bias + rhs.bias,
        }
    }
}
