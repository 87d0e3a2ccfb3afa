//! Forward dynamics of long chains: the articulated-body algorithm, O(n).
//!
//! Inertias are `[[J, H], [Hᵀ, M]]` on (angular, linear) accelerations, about the origin of each link's frame;
//! accelerations are those of the origin itself, so gravity is the base's acceleration upwards.
//!
//! R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, ch. 7.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::columns::{Direction, Twist};
use super::motion::{LinkVelocity, velocities};
use super::normal::{NormalTree, PlacedJoint};
use super::rnea::Wrench;
use crate::model::Motion;
use crate::spatial::{Matrix3, PseudoInertia, Scalar, Symmetric3, Vector3};

/// The accelerations of the columns that the forces `tau` on them cause. Columns of one joint are folded one after
/// another.
pub fn forward_dynamics<S: Scalar>(tree: &NormalTree<S>, q: &[S], qd: &[S], tau: &[S]) -> Vec<S> {
    let joints = tree.place(q);
    let velocity = velocities(tree, &joints, qd);
    let drift = drifts(tree, &joints, &velocity, qd);
    let articulated = tip_to_base(tree, &joints, &velocity, &drift, tau);
    base_to_tip(tree, &joints, &drift, &articulated)
}

/// An acceleration, angular and of the origin, in the frame of the link beyond the joint, without the joint's own.
fn down<S: Scalar>(rate: Twist<S>, joint: &PlacedJoint<S>) -> Twist<S> {
    let linear = rate.linear + rate.angular.cross(joint.position);
    Twist { angular: joint.down(rate.angular), linear: joint.down(linear) }
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
    U: Twist<S>,
    inverse_D: S,
    u: S,
}

/// The part of each link's acceleration that comes of speeds alone.
fn drifts<S: Scalar>(
    tree: &NormalTree<S>,
    joints: &[PlacedJoint<S>],
    velocity: &[LinkVelocity<S>],
    qd: &[S],
) -> Vec<Twist<S>> {
    let speeds = tree.joint_motions(qd);
    let drift = |k: usize| {
        let joint = &joints[k];
        let w_parent = tree.links[k].parent.map_or(Vector3::zero(), |p| velocity[p].w);
        let centripetal = joint.down(w_parent.cross(w_parent.cross(joint.position)));
        let (w, Twist { angular, linear }) = (velocity[k].w, speeds[k]);
        match joint.motion {
            Motion::Revolute => Twist { angular: w.cross_z().scale(angular.0[2]), linear: centripetal },
            Motion::Prismatic => {
                let sweep = w.cross_z().scale(linear.0[2]);
                Twist { angular: Vector3::zero(), linear: centripetal + sweep.scale(S::from(2)) }
            }
            Motion::Ball | Motion::Free => {
                let carried = joint.down(w_parent);
                let sweep = (carried + w).cross(linear);
                Twist { angular: carried.cross(angular), linear: centripetal + sweep }
            }
        }
    };
    (0..tree.links.len()).map(drift).collect()
}

fn tip_to_base<S: Scalar>(
    tree: &NormalTree<S>,
    joints: &[PlacedJoint<S>],
    velocity: &[LinkVelocity<S>],
    drift: &[Twist<S>],
    tau: &[S],
) -> Vec<Joint<S>> {
    let mut inertias: Vec<ArticulatedInertia<S>> =
        tree.links.iter().map(|link| own_inertia(&link.inertia)).collect();
    let mut wrenches: Vec<Wrench<S>> =
        tree.links.iter().zip(velocity).map(|(link, v)| velocity_wrench(&link.inertia, v)).collect();
    let mut folded = vec![None; tree.columns.len()];
    for k in (0..tree.links.len()).rev() {
        let parent = tree.links[k].parent;
        for c in tree.columns_of(k).rev() {
            let direction = tree.columns[c].direction;
            let armature = tree.links[k].passive.armature;
            let joint = fold(&inertias[k], &wrenches[k], direction, armature, tau[c]);
            if parent.is_some() || c != tree.columns_of(k).start {
                inertias[k] = without_joint(&inertias[k], &joint, direction, !armature.is_zero());
                let pushed = joint.u * joint.inverse_D;
                wrenches[k] = wrenches[k]
                    + Wrench { N: joint.U.angular.scale(pushed), F: joint.U.linear.scale(pushed) };
            }
            folded[c] = Some(joint);
        }
        if let Some(parent) = parent {
            let wrench = wrenches[k] + wrench_for(&inertias[k], drift[k]);
            inertias[parent] = sum(inertias[parent], inertia_up(&inertias[k], &joints[k]));
            wrenches[parent] = wrenches[parent] + wrench.up(&joints[k]);
        }
    }
    folded.into_iter().flatten().collect()
}

fn base_to_tip<S: Scalar>(
    tree: &NormalTree<S>,
    joints: &[PlacedJoint<S>],
    drift: &[Twist<S>],
    folded: &[Joint<S>],
) -> Vec<S> {
    let base = Twist { angular: Vector3::zero(), linear: -tree.gravity };
    let mut rates: Vec<Twist<S>> = Vec::with_capacity(tree.links.len());
    let mut accelerations = Vec::with_capacity(tree.columns.len());
    for (k, (link, joint)) in tree.links.iter().zip(joints).enumerate() {
        let mut rate = down(link.parent.map_or(base, |p| rates[p]), joint) + drift[k];
        for c in tree.columns_of(k) {
            let Joint { U, inverse_D, u } = folded[c];
            let a = (u - (U.angular.dot(rate.angular) + U.linear.dot(rate.linear))) * inverse_D;
            match tree.columns[c].direction {
                Direction::About(k) => rate.angular.0[k] = rate.angular.0[k] + a,
                Direction::Along(k) => rate.linear.0[k] = rate.linear.0[k] + a,
            }
            accelerations.push(a);
        }
        rates.push(rate);
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

/// The armature adds to what the column feels of the inertia beyond it, and to nothing else.
fn fold<S: Scalar>(
    inertia: &ArticulatedInertia<S>,
    wrench: &Wrench<S>,
    direction: Direction,
    armature: S,
    tau: S,
) -> Joint<S> {
    let ArticulatedInertia { J, H, M } = inertia;
    let (U, D) = match direction {
        Direction::About(k) => {
            let angular = J.full().column(k);
            (Twist { angular, linear: H.row(k) }, angular.0[k])
        }
        Direction::Along(k) => {
            let linear = M.full().column(k);
            (Twist { angular: H.column(k), linear }, linear.0[k])
        }
    };
    Joint { U, inverse_D: S::one() / (D + armature), u: tau - wrench.along(direction) }
}

/// `I − U Uᵀ/D`; what lies along a column without armature is zero.
fn without_joint<S: Scalar>(
    inertia: &ArticulatedInertia<S>,
    joint: &Joint<S>,
    direction: Direction,
    has_armature: bool,
) -> ArticulatedInertia<S> {
    let Twist { angular: n, linear: f } = joint.U;
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
    if has_armature {
        return ArticulatedInertia { J, H, M };
    }
    match direction {
        Direction::About(k) => {
            J = J.without(k);
            H.0[k] = [o; 3];
        }
        Direction::Along(k) => {
            M = M.without(k);
            for row in &mut H.0 {
                row[k] = o;
            }
        }
    }
    ArticulatedInertia { J, H, M }
}

/// The wrench `I c` for a rate `c`.
fn wrench_for<S: Scalar>(inertia: &ArticulatedInertia<S>, rate: Twist<S>) -> Wrench<S> {
    let ArticulatedInertia { J, H, M } = *inertia;
    Wrench {
        N: J.times(rate.angular) + H * rate.linear,
        F: H.transpose() * rate.angular + M.times(rate.linear),
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
