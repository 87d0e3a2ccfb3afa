//! Composite bodies: mass matrix, Coriolis matrix and derivatives of inverse dynamics, O(N·depth).
//!
//! All that hangs on a joint is one body with the moments 𝕁 = `(m, h, Σ)`, and with 𝔹 = `∫r ṙᵀ dm`, `∫ṙ dm`.
//! With `Ŝ` the 4×4 matrix of a column, of the composite body beyond the outer of links I and J, with `V_J` and
//! `V_p` the velocities of link J and of its parent, `A_p` the acceleration of the latter,
//!
//! ```text
//! C_ij      = tr(Ŝ_i (𝕁 t̂ᵀ + 𝔹 r̂ᵀ))    t = V_J × S_j             r = S_j
//! ∂τ_i/∂v_j = tr(Ŝ_i (𝕁 t̂ᵀ + 𝔹 r̂ᵀ))    t = (V_J + V_p) × S_j     r = 2 S_j
//! ∂τ_i/∂q_j = tr(Ŝ_i (𝕁 t̂ᵀ + 𝔹 r̂ᵀ))    t = A_p × S_j + V_p × (V_p × S_j)     r = 2 V_p × S_j
//!             and S_i·(S_j ×* F_J) where I is nearer to the base than J
//! ```
//!
//! and between joints of one degree of freedom `∂τ/∂v = 2C`.
//!
//! M. Walker, D. Orin 1982; S. Echeandia, P. Wensing, *Numerical methods to compute the Coriolis matrix and
//! Christoffel symbols for rigid-body systems*, 2021; S. Singh, R. Russell, P. Wensing, *Efficient analytical
//! derivatives of rigid-body dynamics using spatial vector algebra*, RA-L 2022; here in pseudo-inertia form.

use core::ops::Add;

use nalgebra::{SMatrix, SVector};

use super::motion::{Carried, Motion};
use super::place::{Body, Moments};
use super::screw::{Twist, Wrench};
use super::sweep::{add_entry, each, zeros};
use super::vector::{Matrix, Vector};
use super::{Tree, entries};
use crate::dynamics::{EquationsOfMotion, InverseDynamicsDerivatives};
use crate::scalar::Scalar;

impl<T: Scalar, const NL: usize, const NQ: usize, const NV: usize> Tree<T, NL, NQ, NV> {
    /// The mass matrix `M(q)`, both halves, with the armatures.
    pub fn mass_matrix(&self, q: &SVector<T, NQ>) -> SMatrix<T, NV, NV> {
        let bodies = self.place(entries(q));
        let mut m = zeros();
        self.add_mass_matrix(&bodies, &self.composite_moments(&bodies), &mut m);
        m
    }

    /// The Coriolis matrix `C(q,v)`: Levi-Civita's, without passive forces.
    pub fn coriolis_matrix(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> SMatrix<T, NV, NV> {
        let bodies = self.place(entries(q));
        let motions = self.motions(&bodies, entries(v));
        let composites = self.composites(&bodies, &motions, &self.composite_moments(&bodies));
        let mut c = zeros();
        self.add_coriolis_matrix(&bodies, &motions, &composites, &mut c);
        c
    }

    /// `M`, `C` and `G`.
    pub fn equations_of_motion(&self, q: &SVector<T, NQ>, v: &SVector<T, NV>) -> EquationsOfMotion<T, NV> {
        let bodies = self.place(entries(q));
        let motions = self.motions(&bodies, entries(v));
        let moments = self.composite_moments(&bodies);
        let gravity_forces = self.gravity_forces_on(&bodies, &moments);
        let mut result = EquationsOfMotion { mass_matrix: zeros(), coriolis_matrix: zeros(), gravity_forces };
        self.add_mass_matrix(&bodies, &moments, &mut result.mass_matrix);
        let composites = self.composites(&bodies, &motions, &moments);
        self.add_coriolis_matrix(&bodies, &motions, &composites, &mut result.coriolis_matrix);
        result
    }

    /// `∂τ/∂q`, `∂τ/∂v` and `∂τ/∂a = M` of inverse dynamics.
    pub fn inverse_dynamics_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        a: &SVector<T, NV>,
    ) -> InverseDynamicsDerivatives<T, NV> {
        let mut result = InverseDynamicsDerivatives { dtau_dq: zeros(), dtau_dv: zeros(), dtau_da: zeros() };
        let InverseDynamicsDerivatives { dtau_dq, dtau_dv, dtau_da } = &mut result;
        self.add_inverse_dynamics_derivatives(q, v, a, [dtau_dq, dtau_dv, dtau_da]);
        result
    }

    /// Adds `∂τ/∂q`, `∂τ/∂v` and `∂τ/∂a`.
    pub(super) fn add_inverse_dynamics_derivatives(
        &self,
        q: &SVector<T, NQ>,
        v: &SVector<T, NV>,
        a: &SVector<T, NV>,
        [dtau_dq, dtau_dv, dtau_da]: [&mut SMatrix<T, NV, NV>; 3],
    ) {
        let bodies = self.place(entries(q));
        let motions = self.motions(&bodies, entries(v));
        let accelerations = self.accelerations(&bodies, &motions, entries(a));
        let wrenches = self.wrenches(&bodies, &motions, &accelerations);
        let parents = self.carried(&bodies, &motions, &accelerations);
        let moments = self.composite_moments(&bodies);
        let composites = self.composites(&bodies, &motions, &moments);

        let two = T::of(2.0);
        let by_place = changes(&bodies, &parents, |Carried { velocity, acceleration }, s| {
            let rate = velocity.cross(s);
            Change { twist: acceleration.cross(s) + velocity.cross(rate), turn: rate.angular.scaled(two) }
        });
        let by_speed = changes(&bodies, motions.iter().zip(&parents), |(motion, parent), s| Change {
            twist: (motion.velocity + parent.velocity).cross(s),
            turn: s.angular.scaled(two),
        });
        self.add_changes(&bodies, &composites, &by_place, &wrenches, dtau_dq);
        self.add_changes(&bodies, &composites, &by_speed, &[Wrench::zero(); NL], dtau_dv);
        self.add_passive_slopes(entries(v), dtau_dq, dtau_dv);
        self.add_mass_matrix(&bodies, &moments, dtau_da);
    }

    /// The moments of all that hangs on each joint.
    pub(super) fn composite_moments(&self, bodies: &[Body<T>; NL]) -> [Moments<T>; NL] {
        self.collect_tip_to_base(bodies, bodies.map(|body| body.moments), Moments::shifted)
    }

    /// Adds `M(q)`, of bodies and armatures.
    fn add_mass_matrix(
        &self,
        bodies: &[Body<T>; NL],
        moments: &[Moments<T>; NL],
        m: &mut SMatrix<T, NV, NV>,
    ) {
        self.add_armatures(m);
        for (j, (body, moments)) in bodies.iter().zip(moments).enumerate() {
            for outer in body.columns.iter() {
                let mut wrench = moments.wrench_of(outer.twist());
                add_entry(m, outer.v, outer.v, outer.power(wrench));
                for k in self.path_to_base(Some(j)) {
                    let Some(ancestor) = bodies.get(k) else { continue };
                    // Of its own link's columns those before it: each pair once.
                    for inner in ancestor.columns.iter().take_while(|inner| k != j || inner.v < outer.v) {
                        let entry = inner.power(wrench);
                        add_entry(m, inner.v, outer.v, entry);
                        add_entry(m, outer.v, inner.v, entry);
                    }
                    wrench = wrench.shifted(ancestor.offset);
                }
            }
        }
    }

    /// Adds `C(q,v)`.
    fn add_coriolis_matrix(
        &self,
        bodies: &[Body<T>; NL],
        motions: &[Motion<T>; NL],
        composites: &[Composite<T>; NL],
        c: &mut SMatrix<T, NV, NV>,
    ) {
        let carried_along =
            changes(bodies, motions, |motion, s| Change { twist: motion.velocity.cross(s), turn: s.angular });
        self.add_changes(bodies, composites, &carried_along, &[Wrench::zero(); NL], c);
    }

    /// Adds `tr(Ŝ_i (𝕁 t̂_jᵀ + 𝔹 r̂_jᵀ))` for the twists `t` and turns `r` of the changes; where I is nearer to the base
    /// than J, also `S_i·(S_j ×* F_J)` for the wrenches `F`.
    fn add_changes(
        &self,
        bodies: &[Body<T>; NL],
        composites: &[Composite<T>; NL],
        changes: &[[Change<T>; 6]; NL],
        wrenches: &[Wrench<T>; NL],
        m: &mut SMatrix<T, NV, NV>,
    ) {
        let links = bodies.iter().zip(composites).zip(changes.iter().zip(wrenches));
        for (j, ((body, composite), (changes_of_body, wrench))) in links.enumerate() {
            for (outer, change) in body.columns.iter().zip(changes_of_body) {
                let twist = outer.twist();
                let mut column = composite.wrench_of(change) + twist.cross_wrench(*wrench);
                let mut row = composite.moments.wrench_of(twist);
                let turns = composite.momenta.row_of(twist);
                for k in self.path_to_base(Some(j)) {
                    let (Some(ancestor), Some(changes)) = (bodies.get(k), changes.get(k)) else { continue };
                    for (inner, change) in ancestor.columns.iter().zip(changes) {
                        add_entry(m, outer.v, inner.v, change.twist.dot(row) + turns.dot(change.turn));
                        if k != j {
                            add_entry(m, inner.v, outer.v, inner.power(column));
                        }
                    }
                    column = column.shifted(ancestor.offset);
                    row = row.shifted(ancestor.offset);
                }
            }
        }
    }

    fn composites(
        &self,
        bodies: &[Body<T>; NL],
        motions: &[Motion<T>; NL],
        moments: &[Moments<T>; NL],
    ) -> [Composite<T>; NL] {
        let own = each(bodies.iter().zip(motions), Momenta::zero(), |(body, motion)| {
            Momenta::new(&body.moments, motion.velocity)
        });
        let momenta = self.collect_tip_to_base(bodies, own, Momenta::shifted);
        let blank = Composite { moments: Moments::zero(), momenta: Momenta::zero() };
        each(moments.iter().zip(momenta), blank, |(moments, momenta)| Composite {
            moments: *moments,
            momenta,
        })
    }
}

/// All that hangs on a joint as one body.
#[derive(Clone, Copy)]
struct Composite<T> {
    /// `𝕁`
    moments: Moments<T>,
    /// `𝔹`
    momenta: Momenta<T>,
}

impl<T: Scalar> Composite<T> {
    /// The wrench of `𝕁 t̂ᵀ + 𝔹 r̂ᵀ`.
    fn wrench_of(&self, change: &Change<T>) -> Wrench<T> {
        self.moments.wrench_of(change.twist) + self.momenta.wrench_of(change.turn)
    }
}

/// What `𝕁` and `𝔹` are applied to: how a column changes.
#[derive(Clone, Copy)]
struct Change<T> {
    /// `t`
    twist: Twist<T>,
    /// `r`: only the angular part counts.
    turn: Vector<T>,
}

impl<T: Scalar> Change<T> {
    fn zero() -> Self {
        Self { twist: Twist::zero(), turn: Vector::zero() }
    }
}

/// The change of each column of each link, from an item of the link; the rest of the six is blank.
fn changes<T: Scalar, I: Copy, const NL: usize>(
    bodies: &[Body<T>; NL],
    items: impl IntoIterator<Item = I>,
    change: impl Fn(I, Twist<T>) -> Change<T>,
) -> [[Change<T>; 6]; NL] {
    each(bodies.iter().zip(items), [Change::zero(); 6], |(body, item)| {
        each(body.columns.iter(), Change::zero(), |column| change(item, column.twist()))
    })
}

/// `𝔹` by its blocks, `B = ∫r ṙᵀ dm = Σ ŵᵀ + h vᵀ` and the linear momentum `b = ∫ṙ dm = w × h + m v`.
#[derive(Clone, Copy)]
struct Momenta<T> {
    first: Matrix<T>,
    zeroth: Vector<T>,
}

impl<T: Scalar> Momenta<T> {
    fn zero() -> Self {
        Self { first: Matrix::zero(), zeroth: Vector::zero() }
    }

    fn new(moments: &Moments<T>, Twist { angular: w, linear: v }: Twist<T>) -> Self {
        Self {
            first: moments.second.times_skew_transposed(w) + Matrix::outer(moments.first, v),
            zeroth: w.cross(moments.first) + v.scaled(moments.mass),
        }
    }

    fn shifted(self, offset: Vector<T>) -> Self {
        Self { first: self.first + Matrix::outer(offset, self.zeroth), zeroth: self.zeroth }
    }

    /// The wrench of `𝔹 r̂ᵀ`: `tr(B)·r − Bᵀr` and `r × b`.
    fn wrench_of(&self, r: Vector<T>) -> Wrench<T> {
        Wrench { moment: self.first.transpose().trace_minus_times(r), force: r.cross(self.zeroth) }
    }

    /// `ν` with `tr(Ŝ 𝔹 r̂ᵀ) = ν·r` for a turn `r` about any point.
    fn row_of(&self, twist: Twist<T>) -> Vector<T> {
        self.first.trace_minus_times(twist.angular) + self.zeroth.cross(twist.linear)
    }
}

impl<T: Scalar> Add for Momenta<T> {
    type Output = Self;

    fn add(self, rhs: Self) -> Self {
        Self { first: self.first + rhs.first, zeroth: self.zeroth + rhs.zeroth }
    }
}
