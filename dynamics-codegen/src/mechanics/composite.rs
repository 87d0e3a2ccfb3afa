//! Composite bodies: mass matrix, Coriolis matrix and derivatives of inverse dynamics, from the tips inwards.
//!
//! All that hangs on a joint is one body with moments `(m, h, Σ)`, and with `𝔹 = Σ_k 𝕁_k V_kᵀ`, the same sum
//! weighted with each link's velocity, by its blocks `B = Σ ŵᵀ + h vᵀ` and `b = w × h + m v`. With `Ŝ` the 4×4
//! matrix of a column's twist, carried along by its link, and the composite beyond the outer of i and j,
//!
//! ```text
//! C_ij      = tr(Ŝ_i (𝕁 [V_j, S_j]^ᵀ + 𝔹 Ŝ_jᵀ))
//! ∂τ_i/∂v_j = tr(Ŝ_i (𝕁 [V_j + V_p, S_j]^ᵀ + 2 𝔹 Ŝ_jᵀ))
//! ∂τ_i/∂q_j = tr(Ŝ_i (𝕁 ([A_p, S_j] + [V_p, [V_p, S_j]])^ᵀ + 2 𝔹 [V_p, S_j]^ᵀ))
//! ```
//!
//! where V_j is the velocity of the link of j, and V_p, A_p the motion of its parent; where j is the outer one, the
//! joint i feels besides how the wrench beyond j turns. A column commutes with itself, so of one degree of freedom
//! V_j serves for V_p, and ∂τ/∂v is 2C.
//!
//! S. Echeandia, P. Wensing, *Numerical methods to compute the Coriolis matrix and Christoffel symbols for
//! rigid-body systems*, 2021; S. Singh, R. Russell, P. Wensing, *Efficient analytical derivatives of rigid-body
//! dynamics using spatial vector algebra*, RA-L 2022; here in 4×4 pseudo-inertia form.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use super::columns::Twist;
use super::motion::{
    LinkAcceleration, LinkVelocity, accelerations, carrier_velocities, carriers, velocities,
};
use super::normal::{NormalTree, PlacedJoint};
use super::rnea::{Wrench, collect_tip_to_base, link_wrench};
use crate::model::Motion;
use crate::spatial::{Matrix3, PseudoInertia, Scalar, Symmetric3, Vector3};

/// A square matrix, by rows.
pub type Square<S> = Vec<Vec<S>>;

/// The mass matrix `M(q)` of the columns, both halves, without rotors: composite rigid bodies.
///
/// M. Walker, D. Orin 1982; R. Featherstone, *Rigid Body Dynamics Algorithms*, 2008, ch. 6.
pub fn mass_matrix<S: Scalar>(tree: &NormalTree<S>, q: &[S]) -> Square<S> {
    let joints = tree.place(q);
    let composites = composite_inertias(tree, &joints);
    let n = tree.columns.len();
    let mut M = vec![vec![S::zero(); n]; n];
    for (j, column) in tree.columns.iter().enumerate() {
        let mut wrench = wrench_of(&composites[column.link], column.direction.twist());
        for link in tree.path_to_base(column.link) {
            for k in tree.columns_of(link).filter(|&k| k <= j) {
                let entry = wrench.along(tree.columns[k].direction);
                (M[j][k], M[k][j]) = (entry, entry);
            }
            if tree.links[link].parent.is_some() {
                wrench = wrench.up(&joints[link]);
            }
        }
    }
    M
}

/// The Coriolis matrix `C(q,v)` of Levi-Civita, of the columns.
pub fn coriolis_matrix<S: Scalar>(tree: &NormalTree<S>, q: &[S], qd: &[S]) -> Square<S> {
    let joints = tree.place(q);
    let velocity = velocities(tree, &joints, qd);
    let momenta = composite_momenta(tree, &joints, &velocity, S::one());
    let bodies = Bodies::new(tree, joints, momenta);
    bodies.velocity_matrix(&velocity)
}

/// `∂τ/∂q` and `∂τ/∂v` of inverse dynamics, of the columns, without passive forces.
pub struct InverseDynamicsDerivatives<S> {
    /// `∂τ/∂q`, in the tangent space.
    pub dtau_dq: Square<S>,
    /// `∂τ/∂v`, which is `2C` between joints of one degree of freedom.
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
    let velocity = velocities(tree, &joints, qd);
    let carrier = carriers(tree, &joints, &acceleration);
    let carrier_velocity = carrier_velocities(tree, &joints, &velocity);
    let sums: Vec<_> = velocity.iter().zip(&carrier_velocity).map(|(own, carrier)| *own + *carrier).collect();
    let twice = composite_momenta(tree, &joints, &velocity, S::from(2));
    let bodies = Bodies::new(tree, joints, twice);
    InverseDynamicsDerivatives {
        dtau_dq: bodies.stiffness_matrix(&carrier_velocity, &carrier, &wrenches),
        dtau_dv: bodies.velocity_matrix(&sums),
    }
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
    inertia: Vec<PseudoInertia<S>>,
    /// `𝔹`, or twice that.
    weighted: Vec<Weighted<S>>,
}

impl<S: Scalar> Twist<S> {
    fn paired_with(self, wrench: Wrench<S>) -> S {
        self.angular.dot(wrench.N) + self.linear.dot(wrench.F)
    }
}

impl<'t, S: Scalar> Bodies<'t, S> {
    fn new(tree: &'t NormalTree<S>, joints: Vec<PlacedJoint<S>>, weighted: Vec<Weighted<S>>) -> Self {
        let inertia = composite_inertias(tree, &joints);
        Self { tree, joints, inertia, weighted }
    }

    /// `tr(Ŝ_i (𝕁 [V_j, S_j]^ᵀ + 𝔹 Ŝ_jᵀ))` with the `V` of each link given: C with the links' own velocities, ∂τ/∂v
    /// with these and their parents' added up, and `2𝔹`.
    fn velocity_matrix(&self, carrier: &[LinkVelocity<S>]) -> Square<S> {
        let columns = self.tree.columns.iter();
        let changes = columns.map(|column| {
            let twist = column.direction.twist();
            Change {
                by_moments: carrier[column.link].twist().carries(twist),
                by_momenta: twist.angular,
                by_wrench: Wrench::zero(),
            }
        });
        self.matrix(&changes.collect::<Vec<_>>())
    }

    /// `∂τ/∂q` with `2𝔹`, given the motion that carries each joint and the wrench on each composite body.
    fn stiffness_matrix(
        &self,
        velocity: &[LinkVelocity<S>],
        carrier: &[LinkAcceleration<S>],
        wrenches: &[Wrench<S>],
    ) -> Square<S> {
        let columns = self.tree.columns.iter();
        let changes = columns.map(|column| {
            let twist = column.direction.twist();
            let velocity = velocity[column.link].twist();
            let rate = velocity.carries(twist);
            Change {
                by_moments: second_rate(velocity, rate, &carrier[column.link], twist),
                by_momenta: rate.angular,
                by_wrench: turned_wrench(wrenches[column.link], twist),
            }
        });
        self.matrix(&changes.collect::<Vec<_>>())
    }

    /// `tr(Ŝ_i (𝕁 t̂_jᵀ + 𝔹 r̂_jᵀ))` for the twists `t` and turns `r` of the changes, and in rows of joints nearer to
    /// the base what they feel of the changed wrench.
    fn matrix(&self, changes: &[Change<S>]) -> Square<S> {
        let (tree, n) = (self.tree, changes.len());
        let mut matrix = vec![vec![S::zero(); n]; n];
        for (j, (outer, change)) in tree.columns.iter().zip(changes).enumerate() {
            let body = outer.link;
            let mut column = wrench_of(&self.inertia[body], change.by_moments)
                + self.weighted[body].wrench_of(change.by_momenta)
                + change.by_wrench;
            let mut row = wrench_of(&self.inertia[body], outer.direction.twist());
            let mut nu = self.weighted[body].row_of(outer.direction.twist());
            for link in tree.path_to_base(body) {
                for k in tree.columns_of(link) {
                    let Change { by_moments, by_momenta, .. } = changes[k];
                    matrix[j][k] = by_moments.paired_with(row) + nu.dot(by_momenta);
                    if link != body {
                        matrix[k][j] = column.along(tree.columns[k].direction);
                    }
                }
                if tree.links[link].parent.is_some() {
                    let joint = &self.joints[link];
                    (column, row, nu) = (column.up(joint), row.up(joint), joint.up(nu));
                }
            }
        }
        matrix
    }
}

/// How a column changes the motion of all that hangs on it.
#[derive(Clone, Copy)]
struct Change<S> {
    /// What `𝕁` is applied to.
    by_moments: Twist<S>,
    /// What `𝔹` is applied to: only the turn counts.
    by_momenta: Vector3<S>,
    /// What the wrench on the composite becomes.
    by_wrench: Wrench<S>,
}

impl<S: Scalar> Weighted<S> {
    /// The wrench of `𝔹 ŝᵀ`: `tr(B)·s − Bᵀs` and `s × b`.
    fn wrench_of(&self, s: Vector3<S>) -> Wrench<S> {
        let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = self.B.0;
        let [x, y, z] = s.0;
        let N = Vector3::new(
            (yy + zz) * x - yx * y - zx * z,
            (xx + zz) * y - xy * x - zy * z,
            (xx + yy) * z - xz * x - yz * y,
        );
        Wrench { N, F: s.cross(self.b) }
    }

    /// `ν` with `tr(Ŝ 𝔹 ŝᵀ) = ν·s` for a turn `s` nearer to the base.
    fn row_of(&self, twist: Twist<S>) -> Vector3<S> {
        let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = self.B.0;
        let [x, y, z] = twist.angular.0;
        let turned = Vector3::new(
            (yy + zz) * x - xy * y - xz * z,
            (xx + zz) * y - yx * x - yz * z,
            (xx + yy) * z - zx * x - zy * y,
        );
        turned + self.b.cross(twist.linear)
    }
}

/// `[A, S] + [V, [V, S]]` of the motion that carries a joint, where `rate = [V, S]`.
fn second_rate<S: Scalar>(
    velocity: Twist<S>,
    rate: Twist<S>,
    carrier: &LinkAcceleration<S>,
    twist: Twist<S>,
) -> Twist<S> {
    let swept = velocity.linear.cross(rate.angular).scale(S::from(2));
    Twist {
        angular: carrier.U * twist.angular,
        linear: swept + carrier.a.cross(twist.angular) + carrier.U * twist.linear,
    }
}

/// The wrench that gives a body the acceleration `twist`.
pub fn wrench_of<S: Scalar>(inertia: &PseudoInertia<S>, twist: Twist<S>) -> Wrench<S> {
    let PseudoInertia { mass, first: h, .. } = *inertia;
    let Twist { angular, linear } = twist;
    let turning = if angular.is_zero() { Vector3::zero() } else { inertia.rotational().times(angular) };
    Wrench { N: turning + h.cross(linear), F: angular.cross(h) + linear.scale(mass) }
}

/// How the wrench changes when a column moves the body it acts on: `S ×* F`.
fn turned_wrench<S: Scalar>(wrench: Wrench<S>, twist: Twist<S>) -> Wrench<S> {
    let Twist { angular, linear } = twist;
    Wrench { F: angular.cross(wrench.F), N: angular.cross(wrench.N) + linear.cross(wrench.F) }
}

/// The moments of all that hangs on each joint, in the link's frame.
pub fn composite_inertias<S: Scalar>(
    tree: &NormalTree<S>,
    joints: &[PlacedJoint<S>],
) -> Vec<PseudoInertia<S>> {
    let mut bodies: Vec<PseudoInertia<S>> = tree.links.iter().map(|link| link.inertia).collect();
    for k in (0..tree.links.len()).rev() {
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
        Motion::Revolute | Motion::Ball => {
            Symmetric3::outer_self(body.mass, p) + Symmetric3::outer_twice(first, p)
        }
        Motion::Prismatic | Motion::Free => {
            let half = S::one() / S::from(2);
            Symmetric3::outer_twice(first + p.scale(body.mass * half), p)
        }
    };
    PseudoInertia { mass: body.mass, first: first + p.scale(body.mass), second: second + shifted }
}

/// `𝔹` of all that hangs on each joint, in the link's frame, so many times: by the links' own moments, which are numbers or
/// parameters, so that it costs a call nothing.
fn composite_momenta<S: Scalar>(
    tree: &NormalTree<S>,
    joints: &[PlacedJoint<S>],
    velocity: &[LinkVelocity<S>],
    times: S,
) -> Vec<Weighted<S>> {
    let own = |k: usize| {
        let (PseudoInertia { mass, first: h, second }, LinkVelocity { w, v }) =
            (tree.links[k].inertia.map(|moment| moment * times), velocity[k]);
        let B = second.full() * Matrix3::skew(w).transpose() + Matrix3::outer(h, v);
        Weighted { B, b: w.cross(h) + v.scale(mass) }
    };
    let mut bodies: Vec<Weighted<S>> = (0..tree.links.len()).map(own).collect();
    for k in (0..tree.links.len()).rev() {
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
