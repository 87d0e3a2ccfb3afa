//! The double pendulum as a careful person writes it, from its closed form.
//!
//! J. Craig, *Introduction to Robotics*, 4th ed., 6.7, with centres of mass anywhere in the plane. Angles turn about x,
//! from the plane's z to its −y; `p(q₂) = l₁·(y₂ sin q₂ + z₂ cos q₂)` is the first link's end times the second's centre.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_core::prelude::*;

/// A link: mass in kg, centre of mass in m from its joint, moment in kg·m² about the joint's axis at that centre.
#[derive(Clone, Copy, Debug)]
pub struct Link {
    mass: f64,
    y: f64,
    z: f64,
    moment: f64,
}

/// Two links in a vertical plane.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum {
    first: Link,
    second: Link,
    /// From the first joint to the second, m.
    length: f64,
    /// m/s²
    gravity: f64,
}

impl DoublePendulum {
    /// That of `double_pendulum/model.urdf`.
    pub const PLANAR_2DOF: Self = Self {
        first: Link { mass: 0.26703, y: 2.1727e-6, z: 0.036012, moment: 0.00040827 },
        second: Link { mass: 0.33238, y: 1.9371e-10, z: 0.10088, moment: 0.0011753 },
        length: 0.1,
        gravity: 9.81,
    };

    /// `M(q)`, 2 × 2, kg·m².
    pub fn mass_matrix(&self, q: &SVector<f64, 2>) -> SMatrix<f64, 2, 2> {
        let Self { first, second, length, .. } = self;
        let (s2, c2) = q[1].sin_cos();
        let p = length * (second.y * s2 + second.z * c2);
        let m22 = second.moment + second.mass * (second.y * second.y + second.z * second.z);
        let m12 = m22 + second.mass * p;
        let at_first = first.moment + first.mass * (first.y * first.y + first.z * first.z);
        let m11 = at_first + m22 + second.mass * (length * length + 2.0 * p);
        SMatrix::<f64, 2, 2>::new(m11, m12, m12, m22)
    }

    /// `C(q,v)` by Christoffel's symbols, 2 × 2, N·m·s.
    pub fn coriolis_matrix(&self, q: &SVector<f64, 2>, v: &SVector<f64, 2>) -> SMatrix<f64, 2, 2> {
        let Self { second, length, .. } = self;
        let (s2, c2) = q[1].sin_cos();
        let h = second.mass * length * (second.y * c2 - second.z * s2);
        SMatrix::<f64, 2, 2>::new(h * v[1], h * (v[0] + v[1]), -h * v[0], 0.0)
    }

    /// `G(q) = ∂V/∂q`, N·m.
    pub fn gravity_forces(&self, q: &SVector<f64, 2>) -> SVector<f64, 2> {
        let Self { first, second, length, gravity } = self;
        let (s1, c1) = q[0].sin_cos();
        let (s12, c12) = (q[0] + q[1]).sin_cos();
        let g2 = gravity * second.mass * (second.y * c12 - second.z * s12);
        let g1 = gravity * (first.mass * (first.y * c1 - first.z * s1) - second.mass * length * s1);
        SVector::from([g1 + g2, g2])
    }

    /// `a = M⁻¹·(τ − C·v − G)`, rad/s², by Cramer's rule.
    pub fn forward_dynamics(
        &self,
        q: &SVector<f64, 2>,
        v: &SVector<f64, 2>,
        tau: &SVector<f64, 2>,
    ) -> SVector<f64, 2> {
        let M = self.mass_matrix(q);
        let b = tau - self.coriolis_matrix(q, v) * v - self.gravity_forces(q);
        let determinant = M[(0, 0)] * M[(1, 1)] - M[(0, 1)] * M[(0, 1)];
        SVector::from([
            (M[(1, 1)] * b[0] - M[(0, 1)] * b[1]) / determinant,
            (M[(0, 0)] * b[1] - M[(0, 1)] * b[0]) / determinant,
        ])
    }
}
