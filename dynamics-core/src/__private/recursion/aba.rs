//! Forward dynamics: the articulated-body algorithm, O(N).
//!
//! Articulated inertias are `[[J, H], [Hᵀ, M]]` on (angular, linear) accelerations.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, ch. 7.

use core::ops::Add;

use nalgebra::SVector;

use super::motion::Motion;
use super::place::{Body, Moments};
use super::screw::{Twist, Wrench};
use super::sweep::each;
use super::vector::{Matrix, Vector};
use super::{Tree, entries};
use crate::__private::vector;
use crate::scalar::Scalar;

impl<T: Scalar, const N: usize> Tree<T, N> {
    /// The accelerations `a = M(q)⁻¹·(τ − C(q,v)·v − G(q))`.
    pub fn forward_dynamics(
        &self,
        q: &SVector<T, N>,
        v: &SVector<T, N>,
        tau: &SVector<T, N>,
    ) -> SVector<T, N> {
        let bodies = self.place(entries(q));
        let motions = self.motions(&bodies, entries(v));
        let joints = self.fold_tip_to_base(&bodies, &motions, entries(tau));
        let base = (self.base_acceleration(), T::zero());
        let items = bodies.iter().zip(&motions).zip(&joints);
        let solved = self.base_to_tip(items, base, |((body, motion), joint), (parent, _)| {
            let acceleration = parent.carried(body.offset) + motion.drift;
            let a = (joint.u - acceleration.dot(joint.wrench)) * joint.inverse_mass;
            (acceleration + body.twist().scaled(a), a)
        });
        vector(solved.map(|(_, a)| a))
    }

    /// Folds each link, with all that is folded into it already, into its parent.
    fn fold_tip_to_base(
        &self,
        bodies: &[Body<T>; N],
        motions: &[Motion<T>; N],
        tau: &[T; N],
    ) -> [Joint<T>; N] {
        let links = bodies.iter().zip(motions);
        let mut articulated: [_; N] = each(links, Articulated::zero(), |(body, motion)| {
            Articulated::new(&body.moments, motion.velocity.angular)
        });
        let mut joints = [Joint::blank(); N];
        let links = self.links.iter().zip(&mut joints).zip(bodies.iter().zip(motions).zip(tau));
        for (k, ((link, joint), ((body, motion), tau))) in links.enumerate().rev() {
            let Some((before, [own, ..])) = articulated.split_at_mut_checked(k) else { continue };
            *joint = own.joint(body, *tau);
            if let Some(parent) = link.parent.and_then(|parent| before.get_mut(parent)) {
                *parent = *parent + own.without_joint(joint, motion.drift).shifted(body.offset);
            }
        }
        joints
    }
}

/// What is left of a joint once all beyond it is folded into it: `a = (u − wrench·acceleration)·inverse_mass`.
#[derive(Clone, Copy)]
struct Joint<T> {
    /// `I S`: the wrench for one unit of the joint's acceleration.
    wrench: Wrench<T>,
    /// `1/(Sᵀ I S)`
    inverse_mass: T,
    /// What remains of the joint's force: `τ − Sᵀ p`.
    u: T,
}

impl<T: Scalar> Joint<T> {
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

    fn joint(&self, body: &Body<T>, tau: T) -> Joint<T> {
        let wrench = self.times(body.twist());
        Joint {
            wrench,
            inverse_mass: T::one() / body.along_joint(wrench),
            u: tau - body.along_joint(self.bias),
        }
    }

    /// What the parent feels of it through the joint: `I − U Uᵀ/D`, and `p + (I − U Uᵀ/D) c + U u/D`.
    fn without_joint(&self, joint: &Joint<T>, drift: Twist<T>) -> Self {
        let Wrench { moment, force } = joint.wrench;
        let less = joint.wrench.scaled(-joint.inverse_mass);
        let rest = Self {
            angular: self.angular + Matrix::outer(moment, less.moment),
            coupling: self.coupling + Matrix::outer(moment, less.force),
            linear: self.linear + Matrix::outer(force, less.force),
            bias: self.bias,
        };
        let pushed = joint.wrench.scaled(joint.u * joint.inverse_mass);
        Self { bias: self.bias + rest.times(drift) + pushed, ..rest }
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
