//! Composite bodies: mass matrix, Coriolis matrix and derivatives of inverse dynamics, O(N·depth).
//!
//! All that hangs on a joint is one body with the moments 𝕁 = `(m, h, Σ)`, and with 𝔹 = `∫r ṙᵀ dm`, `∫ṙ dm`.
//! With `Ŝ` the 4×4 matrix of a joint's twist, of the composite body beyond the outer of joints i and j,
//!
//! ```text
//! C_ij      = tr(Ŝ_i (𝕁 dŜ_jᵀ/dt + 𝔹 Ŝ_jᵀ))
//! ∂τ_i/∂v_j = 2 C_ij
//! ∂τ_i/∂q_j = tr(Ŝ_i (𝕁 d²Ŝ_jᵀ/dt² + 2 𝔹 dŜ_jᵀ/dt))   and S_i·(S_j ×* F_j) where j is the outer one
//! ```
//!
//! M. Walker, D. Orin 1982; S. Echeandia, P. Wensing, *Numerical methods to compute the Coriolis matrix and
//! Christoffel symbols for rigid-body systems*, 2021; S. Singh, R. Russell, P. Wensing, *Efficient analytical
//! derivatives of rigid-body dynamics using spatial vector algebra*, RA-L 2022; here in pseudo-inertia form.

use core::ops::Add;

use nalgebra::{SMatrix, SVector};

use super::motion::Motion;
use super::place::{Body, Moments};
use super::screw::{Twist, Wrench};
use super::sweep::{each, set, zeros};
use super::vector::{Matrix, Vector};
use super::{Tree, entries};
use crate::dynamics::{EquationsOfMotion, InverseDynamicsDerivatives};
use crate::scalar::Scalar;

impl<T: Scalar, const N: usize> Tree<T, N> {
    /// The mass matrix `M(q)`, both halves.
    pub fn mass_matrix(&self, q: &SVector<T, N>) -> SMatrix<T, N, N> {
        let bodies = self.place(entries(q));
        let mut m = zeros();
        self.write_mass_matrix(&bodies, &self.composite_moments(&bodies), &mut m);
        m
    }

    /// The Coriolis matrix `C(q,v)` of Christoffel symbols.
    pub fn coriolis_matrix(&self, q: &SVector<T, N>, v: &SVector<T, N>) -> SMatrix<T, N, N> {
        let bodies = self.place(entries(q));
        let motions = self.motions(&bodies, entries(v));
        let composites = self.composites(&bodies, &motions, &self.composite_moments(&bodies));
        let mut c = zeros();
        self.write_coriolis_matrix(&composites, T::one(), &mut c);
        c
    }

    /// `M`, `C` and `G`.
    pub fn equations_of_motion(&self, q: &SVector<T, N>, v: &SVector<T, N>) -> EquationsOfMotion<T, N> {
        let bodies = self.place(entries(q));
        let motions = self.motions(&bodies, entries(v));
        let moments = self.composite_moments(&bodies);
        let gravity_forces = self.gravity_forces_on(&bodies, &moments);
        let mut result = EquationsOfMotion { mass_matrix: zeros(), coriolis_matrix: zeros(), gravity_forces };
        self.write_mass_matrix(&bodies, &moments, &mut result.mass_matrix);
        let composites = self.composites(&bodies, &motions, &moments);
        self.write_coriolis_matrix(&composites, T::one(), &mut result.coriolis_matrix);
        result
    }

    /// `∂τ/∂q`, `∂τ/∂v = 2C` and `∂τ/∂a = M` of inverse dynamics.
    pub fn inverse_dynamics_derivatives(
        &self,
        q: &SVector<T, N>,
        v: &SVector<T, N>,
        a: &SVector<T, N>,
    ) -> InverseDynamicsDerivatives<T, N> {
        let mut result = InverseDynamicsDerivatives { dtau_dq: zeros(), dtau_dv: zeros(), dtau_da: zeros() };
        let InverseDynamicsDerivatives { dtau_dq, dtau_dv, dtau_da } = &mut result;
        self.write_inverse_dynamics_derivatives(q, v, a, [dtau_dq, dtau_dv, dtau_da]);
        result
    }

    /// `∂τ/∂q`, `∂τ/∂v` and `∂τ/∂a` into matrices that are zero.
    pub(super) fn write_inverse_dynamics_derivatives(
        &self,
        q: &SVector<T, N>,
        v: &SVector<T, N>,
        a: &SVector<T, N>,
        [dtau_dq, dtau_dv, dtau_da]: [&mut SMatrix<T, N, N>; 3],
    ) {
        let bodies = self.place(entries(q));
        let motions = self.motions(&bodies, entries(v));
        let accelerations = self.accelerations(&bodies, &motions, entries(a));
        let wrenches = self.wrenches(&bodies, &motions, &accelerations);
        let moments = self.composite_moments(&bodies);
        let composites = self.composites(&bodies, &motions, &moments);
        self.write_stiffness_matrix(&composites, &motions, &accelerations, &wrenches, dtau_dq);
        self.write_coriolis_matrix(&composites, T::of(2.0), dtau_dv);
        self.write_mass_matrix(&bodies, &moments, dtau_da);
    }

    /// The moments of all that hangs on each joint.
    pub(super) fn composite_moments(&self, bodies: &[Body<T>; N]) -> [Moments<T>; N] {
        self.collect_tip_to_base(bodies, bodies.map(|body| body.moments), Moments::shifted)
    }

    fn write_mass_matrix(&self, bodies: &[Body<T>; N], moments: &[Moments<T>; N], m: &mut SMatrix<T, N, N>) {
        for (j, (body, moments)) in bodies.iter().zip(moments).enumerate() {
            let mut wrench = moments.wrench_of(body.twist());
            for k in self.path_to_base(Some(j)) {
                let Some(ancestor) = bodies.get(k) else { continue };
                let entry = ancestor.along_joint(wrench);
                set(m, j, k, entry);
                set(m, k, j, entry);
                wrench = wrench.shifted(ancestor.offset);
            }
        }
    }

    /// `factor·C`
    fn write_coriolis_matrix(&self, composites: &[Composite<T>; N], factor: T, c: &mut SMatrix<T, N, N>) {
        let changes = each(composites, Change::zero(), |composite| Change {
            by_moments: composite.rate.scaled(factor),
            by_momenta: composite.body.twist().angular.scaled(factor),
            by_wrench: Wrench::zero(),
        });
        self.write_matrix(composites, &changes, c);
    }

    /// `∂τ/∂q`, given all accelerations and the wrench on each composite body.
    fn write_stiffness_matrix(
        &self,
        composites: &[Composite<T>; N],
        motions: &[Motion<T>; N],
        accelerations: &[Twist<T>; N],
        wrenches: &[Wrench<T>; N],
        k: &mut SMatrix<T, N, N>,
    ) {
        let items = composites.iter().zip(motions).zip(accelerations.iter().zip(wrenches));
        let changes = each(items, Change::zero(), |((composite, motion), (acceleration, wrench))| {
            let Twist { angular: w, linear: v } = motion.velocity;
            // Of the twist, where `acceleration` is of the origin.
            let spatial = Twist { angular: acceleration.angular, linear: acceleration.linear - w.cross(v) };
            let twist = composite.body.twist();
            Change {
                by_moments: spatial.cross(twist) + motion.velocity.cross(composite.rate),
                by_momenta: composite.rate.angular.scaled(T::of(2.0)),
                by_wrench: twist.cross_wrench(*wrench),
            }
        });
        self.write_matrix(composites, &changes, k);
    }

    /// `tr(Ŝ_i (𝕁 t̂_jᵀ + 𝔹 r̂_jᵀ))` for the twists `t` and turns `r` of each change, and its wrench in column `j`
    /// above the diagonal; on it the wrench of a joint has no part.
    fn write_matrix(
        &self,
        composites: &[Composite<T>; N],
        changes: &[Change<T>; N],
        m: &mut SMatrix<T, N, N>,
    ) {
        for (j, (outer, change)) in composites.iter().zip(changes).enumerate() {
            let twist = outer.body.twist();
            let turned = outer.momenta.wrench_of(change.by_momenta) + change.by_wrench;
            let mut column = outer.moments.wrench_of(change.by_moments) + turned;
            let mut row = outer.moments.wrench_of(twist);
            let row_of_turns = outer.momenta.row_of(twist);
            for k in self.path_to_base(Some(j)) {
                let (Some(inner), Some(change)) = (composites.get(k), changes.get(k)) else { continue };
                set(m, k, j, inner.body.along_joint(column));
                set(m, j, k, change.by_moments.dot(row) + row_of_turns.dot(change.by_momenta));
                column = column.shifted(inner.body.offset);
                row = row.shifted(inner.body.offset);
            }
        }
    }

    fn composites(
        &self,
        bodies: &[Body<T>; N],
        motions: &[Motion<T>; N],
        moments: &[Moments<T>; N],
    ) -> [Composite<T>; N] {
        let own = each(bodies.iter().zip(motions), Momenta::zero(), |(body, motion)| {
            Momenta::new(&body.moments, motion.velocity)
        });
        let momenta = self.collect_tip_to_base(bodies, own, Momenta::shifted);
        let blank = Composite::of_world();
        let items = bodies.iter().zip(motions).zip(moments.iter().zip(&momenta));
        each(items, blank, |((body, motion), (moments, momenta))| Composite {
            body: *body,
            moments: *moments,
            momenta: *momenta,
            rate: motion.velocity.cross(body.twist()),
        })
    }
}

/// A joint, and all that hangs on it as one body.
#[derive(Clone, Copy)]
struct Composite<T> {
    body: Body<T>,
    moments: Moments<T>,
    momenta: Momenta<T>,
    /// `dS/dt`: the joint's twist is carried along by the link.
    rate: Twist<T>,
}

impl<T: Scalar> Composite<T> {
    fn of_world() -> Self {
        Self { body: Body::world(), moments: Moments::zero(), momenta: Momenta::zero(), rate: Twist::zero() }
    }
}

/// How a joint changes the motion of all that hangs on it.
#[derive(Clone, Copy)]
struct Change<T> {
    /// What `𝕁` is applied to.
    by_moments: Twist<T>,
    /// What `𝔹` is applied to: only the angular part counts.
    by_momenta: Vector<T>,
    /// What the composite body's wrench becomes.
    by_wrench: Wrench<T>,
}

impl<T: Scalar> Change<T> {
    fn zero() -> Self {
        Self { by_moments: Twist::zero(), by_momenta: Vector::zero(), by_wrench: Wrench::zero() }
    }
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
