//! The distribution of mass of a body by its moments of order 0, 1 and 2.
//!
//! P. Wensing, S. Kim, J.-J. Slotine, *Linear matrix inequalities for physically consistent inertial
//! parameter identification*, RA-L 2018: ten parameters that add, and that transform by products.

use std::ops::Add;

use super::{Pose, Scalar, Symmetric3, Vector3};

/// `m = ∫dm`, `h = ∫r dm`, `Σ = ∫r rᵀ dm`, about the origin of the body's frame, in its axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PseudoInertia<S> {
    /// Mass, kg.
    pub mass: S,
    /// First moment, kg·m.
    pub first: Vector3<S>,
    /// Second moment, kg·m².
    pub second: Symmetric3<S>,
}

impl<S: Scalar> PseudoInertia<S> {
    /// No mass.
    pub fn zero() -> Self {
        Self { mass: S::zero(), first: Vector3::zero(), second: Symmetric3::zero() }
    }

    /// A body of `mass` with its centre of mass at `com` and the inertia tensor `inertia` about it.
    pub fn new(mass: S, com: Vector3<S>, inertia: Symmetric3<S>) -> Self {
        let half = S::one() / S::from(2);
        let Symmetric3 { xx, yy, zz, xy, xz, yz } = inertia;
        let about_com = Symmetric3 {
            xx: (yy + zz - xx) * half,
            yy: (xx + zz - yy) * half,
            zz: (xx + yy - zz) * half,
            xy: -xy,
            xz: -xz,
            yz: -yz,
        };
        let first = com.scale(mass);
        Self { mass, first, second: about_com + Symmetric3::outer_self(mass, com) }
    }

    /// The rotational inertia `tr(Σ)·1 − Σ` about the origin, kg·m².
    pub fn rotational(self) -> Symmetric3<S> {
        self.second.trace_minus()
    }

    /// The same mass, seen from the frame A in which this body's frame has the pose `X_AB`.
    pub fn transformed(self, pose: Pose<S>) -> Self {
        let first = pose.rotation * self.first;
        let p = pose.translation;
        Self {
            mass: self.mass,
            first: first + p.scale(self.mass),
            second: self.second.rotated(pose.rotation)
                + Symmetric3::outer_twice(first, p)
                + Symmetric3::outer_self(self.mass, p),
        }
    }

    /// The moments with `f` applied to each.
    pub fn map<R>(self, mut f: impl FnMut(S) -> R) -> PseudoInertia<R> {
        PseudoInertia { mass: f(self.mass), first: self.first.map(&mut f), second: self.second.map(f) }
    }
}

impl<S: Scalar> Add for PseudoInertia<S> {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        Self { mass: self.mass + rhs.mass, first: self.first + rhs.first, second: self.second + rhs.second }
    }
}
