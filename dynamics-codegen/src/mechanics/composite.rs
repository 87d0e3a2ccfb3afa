//! Composite bodies: mass matrix, Coriolis matrix and derivatives of inverse dynamics, from the tips inwards.
//!
//! All that hangs on a joint is one body with moments `(m, h, Σ)`, and with `𝔹 = Σ_k 𝕁_k V_kᵀ`, the same sum
//! weighted with each link's velocity, by its blocks `B = Σ ŵᵀ + h vᵀ` and `b = w × h + m v`. With `Ŝ` the 4×4
//! matrix of a joint's twist, between joints of one degree of freedom
//!
//! ```text
//! C_ij = tr(Ŝ_i (𝕁 dŜ_jᵀ/dt + 𝔹 Ŝ_jᵀ))        composite beyond the outer of i and j
//! ```
//!
//! S. Echeandia, P. Wensing, *Numerical methods to compute the Coriolis matrix and Christoffel symbols for
//! rigid-body systems*, 2021; S. Singh, R. Russell, P. Wensing, *Efficient analytical derivatives of rigid-body
//! dynamics using spatial vector algebra*, RA-L 2022; here in 4×4 pseudo-inertia form.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::motion::{LinkAcceleration, LinkVelocity, accelerations, velocities};
use super::normal::{NormalTree, PlacedJoint};
use super::rnea::{Wrench, collect_tip_to_base, link_wrench};
use crate::model::Motion;
use crate::spatial::{Matrix3, PseudoInertia, Scalar, Symmetric3, Vector3};

/// A square matrix, by rows.
pub type Square<S> = Vec<Vec<S>>;

/// The mass matrix `M(q)`, both halves: composite rigid bodies.
///
/// M. Walker, D. Orin 1982; R. Featherstone, *Rigid Body Dynamics Algorithms*, 2008, ch. 6.
pub fn mass_matrix<S: Scalar>(tree: &NormalTree<S>, q: &[S]) -> Square<S> {
    let joints = tree.place(q);
    let composites = composite_inertias(tree, &joints);
    let mut M = vec![vec![S::zero(); tree.dof()]; tree.dof()];
    for j in 0..tree.dof() {
        let mut wrench = unit_wrench(&composites[j], joints[j].motion);
        for k in tree.path_to_base(j) {
            let entry = wrench.along_joint(joints[k].motion);
            (M[j][k], M[k][j]) = (entry, entry);
            if tree.links[k].parent.is_some() {
                wrench = wrench.up(&joints[k]);
            }
        }
    }
    M
}

/// The Coriolis matrix `C(q,v)` of Christoffel symbols.
pub fn coriolis_matrix<S: Scalar>(tree: &NormalTree<S>, q: &[S], qd: &[S]) -> Square<S> {
    let joints = tree.place(q);
    let velocity = velocities(tree, &joints, qd);
    let bodies = Bodies {
        tree,
        inertia: composite_inertias(tree, &joints),
        weighted: composite_momenta(tree, &joints, &velocity),
        joints,
        velocity,
    };
    bodies.coriolis_matrix()
}

/// `∂τ/∂q` and `∂τ/∂v` of inverse dynamics, and τ itself.
pub struct InverseDynamicsDerivatives<S> {
    /// The joint forces.
    pub tau: Vec<S>,
    /// `∂τ/∂q`
    pub dtau_dq: Square<S>,
    /// `∂τ/∂v = 2C` between joints of one degree of freedom.
    pub dtau_dv: Square<S>,
}

/// The derivatives of inverse dynamics.
pub fn inverse_dynamics_derivatives<S: Scalar>(
    tree: &NormalTree<S>,
    q: &[S],
    qd: &[S],
    qdd: &[S],
) -> InverseDynamicsDerivatives<S> {
    let joints = tree.place(q);
    let acceleration = accelerations(tree, &joints, qd, qdd);
    let wrenches =
        tree.links.iter().zip(&acceleration).map(|(link, a)| link_wrench(&link.inertia, a)).collect();
    let wrenches = collect_tip_to_base(tree, &joints, wrenches);
    let tau = wrenches.iter().zip(&joints).map(|(wrench, joint)| wrench.along_joint(joint.motion)).collect();
    let velocity = velocities(tree, &joints, qd);
    let bodies = Bodies {
        tree,
        inertia: composite_inertias(tree, &joints),
        weighted: composite_momenta(tree, &joints, &velocity),
        joints,
        velocity,
    };
    let dtau_dv =
        bodies.coriolis_matrix().iter().map(|row| row.iter().map(|x| x.twice()).collect()).collect();
    InverseDynamicsDerivatives { dtau_dq: bodies.stiffness_matrix(&acceleration, &wrenches), dtau_dv, tau }
}

/// `𝔹` by its blocks.
#[derive(Clone, Copy)]
struct Weighted<S> {
    B: Matrix3<S>,
    b: Vector3<S>,
}

/// All composite quantities at one state.
struct Bodies<'t, S> {
    tree: &'t NormalTree<S>,
    joints: Vec<PlacedJoint<S>>,
    velocity: Vec<LinkVelocity<S>>,
    inertia: Vec<PseudoInertia<S>>,
    weighted: Vec<Weighted<S>>,
}

/// The twist of a joint, or a derivative of it: (angular, linear), in the link's frame.
#[derive(Clone, Copy)]
struct Twist<S> {
    angular: Vector3<S>,
    linear: Vector3<S>,
}

impl<S: Scalar> Twist<S> {
    fn paired_with(self, wrench: Wrench<S>) -> S {
        self.angular.dot(wrench.N) + self.linear.dot(wrench.F)
    }
}

impl<S: Scalar> Bodies<'_, S> {
    fn coriolis_matrix(&self) -> Square<S> {
        let n = self.tree.dof();
        let rates: Vec<Twist<S>> = (0..n).map(|k| self.twist_rate(k)).collect();
        let mut C = vec![vec![S::zero(); n]; n];
        for j in 0..n {
            let mut column = self.wrench_of(j, rates[j]) + self.velocity_wrench(j);
            let mut row = unit_wrench(&self.inertia[j], self.joints[j].motion);
            let mut nu = self.row_vector(j);
            for k in self.tree.path_to_base(j) {
                C[j][k] = rates[k].paired_with(row) + self.about_axis(k, nu);
                if k != j {
                    C[k][j] = column.along_joint(self.joints[k].motion);
                }
                if self.tree.links[k].parent.is_some() {
                    let joint = &self.joints[k];
                    (column, row, nu) = (column.up(joint), row.up(joint), joint.up(nu));
                }
            }
        }
        C
    }

    /// `∂τ/∂q`, given all accelerations and the wrench on each composite body.
    fn stiffness_matrix(&self, acceleration: &[LinkAcceleration<S>], wrenches: &[Wrench<S>]) -> Square<S> {
        let n = self.tree.dof();
        let rates: Vec<Twist<S>> = (0..n).map(|k| self.twist_rate(k)).collect();
        let second: Vec<Twist<S>> = (0..n).map(|k| self.twist_second_rate(k, &acceleration[k])).collect();
        let mut K = vec![vec![S::zero(); n]; n];
        for j in 0..n {
            let mut column = self.wrench_of(j, second[j])
                + self.twice_weighted(j, rates[j].angular)
                + turned_wrench(wrenches[j], self.joints[j].motion);
            let mut row = unit_wrench(&self.inertia[j], self.joints[j].motion);
            let mut nu = self.row_vector(j);
            for k in self.tree.path_to_base(j) {
                K[j][k] = second[k].paired_with(row) + nu.dot(rates[k].angular).twice();
                if k != j {
                    K[k][j] = column.along_joint(self.joints[k].motion);
                }
                if self.tree.links[k].parent.is_some() {
                    let joint = &self.joints[k];
                    (column, row, nu) = (column.up(joint), row.up(joint), joint.up(nu));
                }
            }
        }
        K
    }

    /// `dS/dt`: the axis is carried along by the link.
    fn twist_rate(&self, k: usize) -> Twist<S> {
        let LinkVelocity { w, v } = self.velocity[k];
        match self.joints[k].motion {
            Motion::Revolute => Twist { angular: w.cross_z(), linear: v.cross_z() },
            Motion::Prismatic => Twist { angular: Vector3::zero(), linear: w.cross_z() },
        }
    }

    /// `d²S/dt²`
    fn twist_second_rate(&self, k: usize, acceleration: &LinkAcceleration<S>) -> Twist<S> {
        let LinkVelocity { w, v } = self.velocity[k];
        let Uz = acceleration.U.column(2);
        match self.joints[k].motion {
            Motion::Revolute => {
                let linear = v.cross(w.cross_z()).scale(S::from(2)) + acceleration.a.cross_z();
                Twist { angular: Uz, linear }
            }
            Motion::Prismatic => Twist { angular: Vector3::zero(), linear: Uz },
        }
    }

    /// The wrench that gives the composite body `k` the acceleration `twist`.
    fn wrench_of(&self, k: usize, twist: Twist<S>) -> Wrench<S> {
        let PseudoInertia { mass, first: h, .. } = self.inertia[k];
        let Twist { angular, linear } = twist;
        let turning =
            if angular.is_zero() { Vector3::zero() } else { self.inertia[k].rotational().times(angular) };
        Wrench { N: turning + h.cross(linear), F: angular.cross(h) + linear.scale(mass) }
    }

    /// The wrench of `𝔹 Ŝᵀ`.
    fn velocity_wrench(&self, k: usize) -> Wrench<S> {
        let Weighted { B, b } = self.weighted[k];
        let [[xx, ..], [_, yy, _], [zx, zy, _]] = B.0;
        match self.joints[k].motion {
            Motion::Revolute => Wrench { N: Vector3::new(-zx, -zy, xx + yy), F: -b.cross_z() },
            Motion::Prismatic => Wrench { N: Vector3::zero(), F: Vector3::zero() },
        }
    }

    /// The wrench of `2 𝔹 ŝᵀ` for an angular rate `s`: `2(tr B·s − Bᵀs)` and `2 s × b`.
    fn twice_weighted(&self, k: usize, s: Vector3<S>) -> Wrench<S> {
        let Weighted { B, b } = self.weighted[k];
        let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = B.0;
        let [x, y, z] = s.0;
        let N = Vector3::new(
            (yy + zz) * x - yx * y - zx * z,
            (xx + zz) * y - xy * x - zy * z,
            (xx + yy) * z - xz * x - yz * y,
        );
        let two = S::from(2);
        Wrench { N: N.scale(two), F: s.cross(b).scale(two) }
    }

    /// `ν` with `tr(Ŝ_k 𝔹 Ŝ_iᵀ) = ν·s_i` for a turning joint `i` nearer to the base.
    fn row_vector(&self, k: usize) -> Vector3<S> {
        let Weighted { B, b } = self.weighted[k];
        let [[xx, _, xz], [_, yy, yz], _] = B.0;
        match self.joints[k].motion {
            Motion::Revolute => Vector3::new(-xz, -yz, xx + yy),
            Motion::Prismatic => b.cross_z(),
        }
    }

    fn about_axis(&self, k: usize, nu: Vector3<S>) -> S {
        match self.joints[k].motion {
            Motion::Revolute => nu.0[2],
            Motion::Prismatic => S::zero(),
        }
    }
}

/// The wrench that accelerates the body along its joint by one.
fn unit_wrench<S: Scalar>(inertia: &PseudoInertia<S>, motion: Motion) -> Wrench<S> {
    let [hx, hy, _] = inertia.first.0;
    let Symmetric3 { xx, yy, xz, yz, .. } = inertia.second;
    match motion {
        Motion::Revolute => {
            Wrench { F: Vector3::new(-hy, hx, S::zero()), N: Vector3::new(-xz, -yz, xx + yy) }
        }
        Motion::Prismatic => Wrench {
            F: Vector3::new(S::zero(), S::zero(), inertia.mass),
            N: Vector3::new(hy, -hx, S::zero()),
        },
    }
}

/// How the wrench changes when the joint moves the body it acts on: `S ×* F`.
fn turned_wrench<S: Scalar>(wrench: Wrench<S>, motion: Motion) -> Wrench<S> {
    match motion {
        Motion::Revolute => Wrench { F: -wrench.F.cross_z(), N: -wrench.N.cross_z() },
        Motion::Prismatic => Wrench { F: Vector3::zero(), N: -wrench.F.cross_z() },
    }
}

/// The moments of all that hangs on each joint, in the link's frame.
fn composite_inertias<S: Scalar>(tree: &NormalTree<S>, joints: &[PlacedJoint<S>]) -> Vec<PseudoInertia<S>> {
    let mut bodies: Vec<PseudoInertia<S>> = tree.links.iter().map(|link| link.inertia).collect();
    for k in (0..tree.dof()).rev() {
        if let Some(parent) = tree.links[k].parent {
            bodies[parent] = bodies[parent] + moments_up(bodies[k], &joints[k]);
        }
    }
    bodies
}

/// The moments in the parent's frame.
fn moments_up<S: Scalar>(body: PseudoInertia<S>, joint: &PlacedJoint<S>) -> PseudoInertia<S> {
    let first = joint.up(body.first);
    let second = joint.constant.up_symmetric(joint.about_z.up_symmetric(body.second));
    let p = joint.position;
    let shifted = match joint.motion {
        Motion::Revolute => Symmetric3::outer_self(body.mass, p) + Symmetric3::outer_twice(first, p),
        Motion::Prismatic => {
            let half = S::one() / S::from(2);
            Symmetric3::outer_twice(first + p.scale(body.mass * half), p)
        }
    };
    PseudoInertia { mass: body.mass, first: first + p.scale(body.mass), second: second + shifted }
}

/// `𝔹` of all that hangs on each joint, in the link's frame.
fn composite_momenta<S: Scalar>(
    tree: &NormalTree<S>,
    joints: &[PlacedJoint<S>],
    velocity: &[LinkVelocity<S>],
) -> Vec<Weighted<S>> {
    let own = |k: usize| {
        let (PseudoInertia { mass, first: h, second }, LinkVelocity { w, v }) =
            (tree.links[k].inertia, velocity[k]);
        let B = second.full() * Matrix3::skew(w).transpose() + Matrix3::outer(h, v);
        Weighted { B, b: w.cross(h) + v.scale(mass) }
    };
    let mut bodies: Vec<Weighted<S>> = (0..tree.dof()).map(own).collect();
    for k in (0..tree.dof()).rev() {
        if let Some(parent) = tree.links[k].parent {
            let joint = &joints[k];
            let B = joint.constant.up_matrix(joint.about_z.up_matrix(bodies[k].B));
            let b = joint.up(bodies[k].b);
            bodies[parent].B = bodies[parent].B + B + Matrix3::outer(joint.position, b);
            bodies[parent].b = bodies[parent].b + b;
        }
    }
    bodies
}
