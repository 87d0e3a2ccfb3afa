//! Forward dynamics of long chains: the articulated-body algorithm, O(n).
//!
//! Inertias are `[[J, H], [Hᵀ, M]]` on (angular, linear) accelerations, about the origin of each link's frame;
//! accelerations are those of the origin itself, so gravity is the base's acceleration upwards.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, ch. 7.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::motion::{LinkVelocity, velocities};
use super::normal::{NormalTree, PlacedJoint};
use super::rnea::Wrench;
use crate::model::Motion;
use crate::spatial::{Matrix3, PseudoInertia, Scalar, Symmetric3, Vector3};

/// The joint accelerations that `tau` causes.
pub fn forward_dynamics<S: Scalar>(tree: &NormalTree<S>, q: &[S], qd: &[S], tau: &[S]) -> Vec<S> {
    let joints = tree.place(q);
    let velocity = velocities(tree, &joints, qd);
    let drift = drifts(tree, &joints, &velocity, qd);
    let articulated = tip_to_base(tree, &joints, &velocity, &drift, tau);
    base_to_tip(tree, &joints, &drift, &articulated)
}

/// An acceleration: angular, and of the origin.
#[derive(Clone, Copy)]
struct Rate<S> {
    angular: Vector3<S>,
    linear: Vector3<S>,
}

impl<S: Scalar> Rate<S> {
    /// The rate in the frame of the link beyond the joint, without the joint's own.
    fn down(self, joint: &PlacedJoint<S>) -> Self {
        let linear = self.linear + self.angular.cross(joint.position);
        Self { angular: joint.down(self.angular), linear: joint.down(linear) }
    }
}

impl<S: Scalar> std::ops::Add for Rate<S> {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        Self { angular: self.angular + rhs.angular, linear: self.linear + rhs.linear }
    }
}

#[derive(Clone, Copy)]
struct ArticulatedInertia<S> {
    J: Symmetric3<S>,
    H: Matrix3<S>,
    M: Symmetric3<S>,
}

/// What is left of a joint once all beyond it is folded into it: `a = (u − Uᵀ rate)·inverse_D`.
#[derive(Clone, Copy)]
struct Joint<S> {
    U: Rate<S>,
    inverse_D: S,
    u: S,
}

/// The part of each link's acceleration that comes of speeds alone.
fn drifts<S: Scalar>(
    tree: &NormalTree<S>,
    joints: &[PlacedJoint<S>],
    velocity: &[LinkVelocity<S>],
    qd: &[S],
) -> Vec<Rate<S>> {
    let drift = |k: usize| {
        let joint = &joints[k];
        let w_parent = tree.links[k].parent.map_or(Vector3::zero(), |p| velocity[p].w);
        let centripetal = joint.down(w_parent.cross(w_parent.cross(joint.position)));
        let sweep = velocity[k].w.cross_z().scale(qd[k]);
        match joint.motion {
            Motion::Revolute => Rate { angular: sweep, linear: centripetal },
            Motion::Prismatic => {
                Rate { angular: Vector3::zero(), linear: centripetal + sweep.scale(S::from(2)) }
            }
        }
    };
    (0..tree.dof()).map(drift).collect()
}

fn tip_to_base<S: Scalar>(
    tree: &NormalTree<S>,
    joints: &[PlacedJoint<S>],
    velocity: &[LinkVelocity<S>],
    drift: &[Rate<S>],
    tau: &[S],
) -> Vec<Joint<S>> {
    let mut inertias: Vec<ArticulatedInertia<S>> =
        tree.links.iter().map(|link| own_inertia(&link.inertia)).collect();
    let mut wrenches: Vec<Wrench<S>> =
        tree.links.iter().zip(velocity).map(|(link, v)| velocity_wrench(&link.inertia, v)).collect();
    let mut folded = vec![None; tree.dof()];
    for k in (0..tree.dof()).rev() {
        let joint = fold(&inertias[k], &wrenches[k], joints[k].motion, tau[k]);
        if let Some(parent) = tree.links[k].parent {
            let inertia = without_joint(&inertias[k], &joint, joints[k].motion);
            let wrench = wrenches[k] + without_joint_wrench(&inertia, &joint, drift[k]);
            inertias[parent] = sum(inertias[parent], inertia_up(&inertia, &joints[k]));
            wrenches[parent] = wrenches[parent] + wrench.up(&joints[k]);
        }
        folded[k] = Some(joint);
    }
    folded.into_iter().flatten().collect()
}

fn base_to_tip<S: Scalar>(
    tree: &NormalTree<S>,
    joints: &[PlacedJoint<S>],
    drift: &[Rate<S>],
    folded: &[Joint<S>],
) -> Vec<S> {
    let base = Rate { angular: Vector3::zero(), linear: -tree.gravity };
    let mut rates: Vec<Rate<S>> = Vec::with_capacity(tree.dof());
    let mut accelerations = Vec::with_capacity(tree.dof());
    for (k, (link, joint)) in tree.links.iter().zip(joints).enumerate() {
        let rate = link.parent.map_or(base, |p| rates[p]).down(joint) + drift[k];
        let Joint { U, inverse_D, u } = folded[k];
        let a = (u - (U.angular.dot(rate.angular) + U.linear.dot(rate.linear))) * inverse_D;
        let along = Vector3::unit_z().scale(a);
        rates.push(match joint.motion {
            Motion::Revolute => Rate { angular: rate.angular + along, ..rate },
            Motion::Prismatic => Rate { linear: rate.linear + along, ..rate },
        });
        accelerations.push(a);
    }
    accelerations
}

fn own_inertia<S: Scalar>(inertia: &PseudoInertia<S>) -> ArticulatedInertia<S> {
    let m = inertia.mass;
    ArticulatedInertia {
        J: inertia.rotational(),
        H: Matrix3::skew(inertia.first),
        M: Symmetric3::diagonal(m, m, m),
    }
}

/// The wrench that a link needs for its speed alone: `w × Jw` and `w × (w × h)`.
fn velocity_wrench<S: Scalar>(inertia: &PseudoInertia<S>, velocity: &LinkVelocity<S>) -> Wrench<S> {
    let (w, h) = (velocity.w, inertia.first);
    Wrench { N: w.cross(inertia.rotational().times(w)), F: w.cross(w.cross(h)) }
}

fn fold<S: Scalar>(inertia: &ArticulatedInertia<S>, wrench: &Wrench<S>, motion: Motion, tau: S) -> Joint<S> {
    let ArticulatedInertia { J, H, M } = inertia;
    let (U, D) = match motion {
        Motion::Revolute => (Rate { angular: J.full().column(2), linear: H.row(2) }, J.zz),
        Motion::Prismatic => (Rate { angular: H.column(2), linear: M.full().column(2) }, M.zz),
    };
    Joint { U, inverse_D: S::one() / D, u: tau - wrench.along_joint(motion) }
}

/// `I − U Uᵀ/D`; what lies along the joint is zero.
fn without_joint<S: Scalar>(
    inertia: &ArticulatedInertia<S>,
    joint: &Joint<S>,
    motion: Motion,
) -> ArticulatedInertia<S> {
    let Rate { angular: n, linear: f } = joint.U;
    let (dn, df) = (n.scale(joint.inverse_D), f.scale(joint.inverse_D));
    let less = |a: Symmetric3<S>, x: Vector3<S>, y: Vector3<S>| {
        let Symmetric3 { xx, yy, zz, xy, xz, yz } =
            Symmetric3::upper_of(Matrix3::outer(x, y).scale(-S::one()));
        a + Symmetric3 { xx, yy, zz, xy, xz, yz }
    };
    let o = S::zero();
    let mut J = less(inertia.J, dn, n);
    let mut M = less(inertia.M, df, f);
    let mut H = inertia.H + Matrix3::outer(dn, f).scale(-S::one());
    match motion {
        Motion::Revolute => {
            (J.zz, J.xz, J.yz) = (o, o, o);
            H.0[2] = [o; 3];
        }
        Motion::Prismatic => {
            (M.zz, M.xz, M.yz) = (o, o, o);
            for row in &mut H.0 {
                row[2] = o;
            }
        }
    }
    ArticulatedInertia { J, H, M }
}

/// What the joint's own force and the drift add to the wrench: `I c + U u/D`.
fn without_joint_wrench<S: Scalar>(
    inertia: &ArticulatedInertia<S>,
    joint: &Joint<S>,
    drift: Rate<S>,
) -> Wrench<S> {
    let ArticulatedInertia { J, H, M } = *inertia;
    let pushed = joint.u * joint.inverse_D;
    Wrench {
        N: J.times(drift.angular) + H * drift.linear + joint.U.angular.scale(pushed),
        F: H.transpose() * drift.angular + M.times(drift.linear) + joint.U.linear.scale(pushed),
    }
}

/// The inertia in the parent's frame.
fn inertia_up<S: Scalar>(inertia: &ArticulatedInertia<S>, joint: &PlacedJoint<S>) -> ArticulatedInertia<S> {
    let up = |m: Symmetric3<S>| joint.constant.up_symmetric(joint.about_z.up_symmetric(m));
    let (J, M) = (up(inertia.J), up(inertia.M));
    let H = joint.constant.up_matrix(joint.about_z.up_matrix(inertia.H));
    let p = Matrix3::skew(joint.position);
    let shifted = H + p * M.full();
    let coupling = p * H.transpose() + (shifted * p).scale(-S::one());
    ArticulatedInertia { J: J + Symmetric3::upper_of(coupling), H: shifted, M }
}

fn sum<S: Scalar>(a: ArticulatedInertia<S>, b: ArticulatedInertia<S>) -> ArticulatedInertia<S> {
    ArticulatedInertia { J: a.J + b.J, H: a.H + b.H, M: a.M + b.M }
}
