//! Robots written by hand, as the derive macro would write them.
#![allow(dead_code, unreachable_pub, missing_docs, reason = "every test file uses its share of these robots")]

pub mod dual;
pub mod elliptic;
pub mod free_box;
#[cfg(feature = "derive")]
pub mod leaper;

use dynamics_core::__private::{
    ball_rate, ball_rate_transposed, ball_tangent_rate, columns, difference_ball, integrate_ball, vector,
};
#[cfg(feature = "simd")]
use dynamics_core::lanes::Lanes;
use dynamics_core::prelude::*;

pub const G: f64 = 9.81;

/// Numbers between −1 and 1, the same for the same seed.
pub fn random_numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / (1_u64 << 30) as f64 - 1.0
    }
}

pub fn random_vector<const N: usize>(random: &mut impl FnMut() -> f64, size: f64) -> SVector<f64, N> {
    SVector::from_fn(|_, _| size * random())
}

/// One matrix of as many as there are lanes, and the bits of its entries.
#[cfg(feature = "simd")]
pub fn bits_of_lane<L: Lanes<Element = f64>, const R: usize, const C: usize>(
    m: &SMatrix<L, R, C>,
    lane: usize,
) -> SMatrix<u64, R, C> {
    m.map(|x| {
        let mut numbers = vec![[0.0]; L::COUNT];
        L::scatter(&[x], &mut numbers, |number| number);
        numbers[lane][0].to_bits()
    })
}

/// The matrices side by side, one in each lane.
#[cfg(feature = "simd")]
pub fn in_lanes_of<L: Lanes<Element = f64>, const R: usize, const C: usize>(
    matrices: &[SMatrix<f64, R, C>],
) -> SMatrix<L, R, C> {
    SMatrix::from_fn(|i, j| {
        let numbers: Vec<[f64; 1]> = matrices.iter().map(|m| [m[(i, j)]]).collect();
        L::gather(&numbers, |number| number)[0]
    })
}

/// A point mass on a rod about the world's x axis, hanging along −z at q = 0; generic in its scalar.
#[derive(Clone, Copy, Debug)]
pub struct Pendulum<T> {
    pub m: T,
    pub l: T,
    pub damping: T,
}

/// The point mass of a [`Pendulum`], turning with it.
pub struct Bob;

impl<T> Mechanism for Pendulum<T> {
    const NQ: usize = 1;
    const NV: usize = 1;
    const NU: usize = 1;
    const NAME: &'static str = "Pendulum";
    const JOINT_NAMES: &'static [&'static str] = &["pivot"];
    const BODY_NAMES: &'static [&'static str] = &["bob"];
    const LIMITS: &'static [JointLimits] = &[JointLimits::NONE];
    const COST: Costs = Costs::ZERO;
}

impl<T: Scalar> Dynamics<T, 1, 1> for Pendulum<T> {
    fn mass_matrix(&self, _q: &SVector<T, 1>) -> SMatrix<T, 1, 1> {
        columns([[self.m * self.l * self.l]])
    }
    fn coriolis_matrix(&self, _q: &SVector<T, 1>, _v: &SVector<T, 1>) -> SMatrix<T, 1, 1> {
        columns([[T::zero()]])
    }
    fn gravity_forces(&self, q: &SVector<T, 1>) -> SVector<T, 1> {
        let [[q0]] = q.data.0;
        let (s, _) = q0.sin_cos();
        vector([self.m * T::of(G) * self.l * s])
    }
    fn passive_forces(&self, _q: &SVector<T, 1>, v: &SVector<T, 1>) -> SVector<T, 1> {
        v * self.damping
    }
    fn bias_forces(&self, q: &SVector<T, 1>, v: &SVector<T, 1>) -> SVector<T, 1> {
        self.gravity_forces(q) + self.passive_forces(q, v)
    }
    fn inverse_dynamics(&self, q: &SVector<T, 1>, v: &SVector<T, 1>, a: &SVector<T, 1>) -> SVector<T, 1> {
        self.mass_matrix(q) * a + self.bias_forces(q, v)
    }
    fn forward_dynamics(&self, q: &SVector<T, 1>, v: &SVector<T, 1>, tau: &SVector<T, 1>) -> SVector<T, 1> {
        (tau - self.bias_forces(q, v)) / (self.m * self.l * self.l)
    }
    fn kinetic_energy(&self, _q: &SVector<T, 1>, v: &SVector<T, 1>) -> T {
        let [[v0]] = v.data.0;
        T::of(0.5) * self.m * self.l * self.l * v0 * v0
    }
    fn potential_energy(&self, q: &SVector<T, 1>) -> T {
        let [[q0]] = q.data.0;
        let (_, c) = q0.sin_cos();
        -self.m * T::of(G) * self.l * c
    }
    fn lagrangian(&self, q: &SVector<T, 1>, v: &SVector<T, 1>) -> T {
        self.kinetic_energy(q, v) - self.potential_energy(q)
    }
}

impl<T: Scalar> Configuration<T, 1, 1> for Pendulum<T> {
    fn integrate(&self, q: &SVector<T, 1>, delta: &SVector<T, 1>) -> SVector<T, 1> {
        q + delta
    }
}

impl<T: Scalar> Frame<Pendulum<T>, T, 1, 1> for Bob {
    const NAME: &'static str = "bob";

    fn pose(robot: &Pendulum<T>, q: &SVector<T, 1>) -> Pose<T> {
        let (o, i) = (T::zero(), T::one());
        let [[q0]] = q.data.0;
        let (s, c) = q0.sin_cos();
        let (y, z) = (robot.l * s, -robot.l * c);
        Pose { rotation: columns([[i, o, o], [o, c, s], [o, -s, c]]), translation: vector([o, y, z]) }
    }
    fn jacobian(robot: &Pendulum<T>, _q: &SVector<T, 1>) -> SMatrix<T, 6, 1> {
        let (o, i) = (T::zero(), T::one());
        vector([o, robot.l, o, i, o, o])
    }
    fn world_jacobian(robot: &Pendulum<T>, q: &SVector<T, 1>) -> SMatrix<T, 6, 1> {
        let (o, i) = (T::zero(), T::one());
        let [[q0]] = q.data.0;
        let (s, c) = q0.sin_cos();
        vector([o, robot.l * c, robot.l * s, i, o, o])
    }
    fn velocity(robot: &Pendulum<T>, _q: &SVector<T, 1>, v: &SVector<T, 1>) -> SVector<T, 6> {
        let (o, [[v0]]) = (T::zero(), v.data.0);
        vector([o, robot.l * v0, o, v0, o, o])
    }
    fn acceleration(
        robot: &Pendulum<T>,
        _q: &SVector<T, 1>,
        _v: &SVector<T, 1>,
        a: &SVector<T, 1>,
    ) -> SVector<T, 6> {
        let (o, [[a0]]) = (T::zero(), a.data.0);
        vector([o, robot.l * a0, o, a0, o, o])
    }
}

/// Two unit point masses on two unit rods about x; the second angle is relative. A unit struct, for every scalar.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum;

/// The end of the second rod, turning with it.
pub struct Tool0;

impl Mechanism for DoublePendulum {
    const NQ: usize = 2;
    const NV: usize = 2;
    const NU: usize = 1;
    const NAME: &'static str = "DoublePendulum";
    const JOINT_NAMES: &'static [&'static str] = &["shoulder", "elbow"];
    const BODY_NAMES: &'static [&'static str] = &["upper", "lower"];
    const LIMITS: &'static [JointLimits] = &[JointLimits::NONE; 2];
    const COST: Costs = Costs::ZERO;
}

impl<T: Scalar> Dynamics<T, 2, 2> for DoublePendulum {
    fn mass_matrix(&self, q: &SVector<T, 2>) -> SMatrix<T, 2, 2> {
        let [[_, q1]] = q.data.0;
        let (_, c2) = q1.sin_cos();
        let (m00, m01) = (T::of(3.0) + T::of(2.0) * c2, T::one() + c2);
        columns([[m00, m01], [m01, T::one()]])
    }
    fn coriolis_matrix(&self, q: &SVector<T, 2>, v: &SVector<T, 2>) -> SMatrix<T, 2, 2> {
        let ([[_, q1]], [[v0, v1]]) = (q.data.0, v.data.0);
        let (s2, _) = q1.sin_cos();
        columns([[-s2 * v1, s2 * v0], [-s2 * (v0 + v1), T::zero()]])
    }
    fn gravity_forces(&self, q: &SVector<T, 2>) -> SVector<T, 2> {
        let [[q0, q1]] = q.data.0;
        let ((s1, _), (s12, _)) = (q0.sin_cos(), (q0 + q1).sin_cos());
        vector([T::of(G) * (T::of(2.0) * s1 + s12), T::of(G) * s12])
    }
    fn bias_forces(&self, q: &SVector<T, 2>, v: &SVector<T, 2>) -> SVector<T, 2> {
        self.coriolis_matrix(q, v) * v + self.gravity_forces(q)
    }
    fn inverse_dynamics(&self, q: &SVector<T, 2>, v: &SVector<T, 2>, a: &SVector<T, 2>) -> SVector<T, 2> {
        self.mass_matrix(q) * a + self.bias_forces(q, v)
    }
    fn forward_dynamics(&self, q: &SVector<T, 2>, v: &SVector<T, 2>, tau: &SVector<T, 2>) -> SVector<T, 2> {
        inverse(self.mass_matrix(q)) * (tau - self.bias_forces(q, v))
    }
    fn kinetic_energy(&self, q: &SVector<T, 2>, v: &SVector<T, 2>) -> T {
        v.dot(&(self.mass_matrix(q) * v)) * T::of(0.5)
    }
    fn potential_energy(&self, q: &SVector<T, 2>) -> T {
        let [[q0, q1]] = q.data.0;
        let ((_, c1), (_, c12)) = (q0.sin_cos(), (q0 + q1).sin_cos());
        -T::of(G) * (T::of(2.0) * c1 + c12)
    }
    fn lagrangian(&self, q: &SVector<T, 2>, v: &SVector<T, 2>) -> T {
        self.kinetic_energy(q, v) - self.potential_energy(q)
    }
}

fn inverse<T: Scalar>(m: SMatrix<T, 2, 2>) -> SMatrix<T, 2, 2> {
    let [[a, b], [c, d]] = m.data.0;
    columns([[d, -b], [-c, a]]) / (a * d - b * c)
}

impl<T: Scalar> DynamicsDerivatives<T, 2, 2> for DoublePendulum {
    fn inverse_dynamics_derivatives(
        &self,
        q: &SVector<T, 2>,
        v: &SVector<T, 2>,
        a: &SVector<T, 2>,
    ) -> InverseDynamicsDerivatives<T, 2> {
        let ([[q0, q1]], [[v0, v1]], [[a0, a1]]) = (q.data.0, v.data.0, a.data.0);
        let ((_, c1), (s2, c2), (_, c12)) = (q0.sin_cos(), q1.sin_cos(), (q0 + q1).sin_cos());
        let (g, two) = (T::of(G), T::of(2.0));
        let elbow = -two * s2 * a0 - s2 * a1 - c2 * v1 * (two * v0 + v1) + g * c12;
        InverseDynamicsDerivatives {
            dtau_dq: columns([[g * (two * c1 + c12), g * c12], [elbow, -s2 * a0 + c2 * v0 * v0 + g * c12]]),
            dtau_dv: columns([[-two * s2 * v1, two * s2 * v0], [-two * s2 * (v0 + v1), T::zero()]]),
            dtau_da: self.mass_matrix(q),
        }
    }
    fn forward_dynamics_derivatives(
        &self,
        q: &SVector<T, 2>,
        v: &SVector<T, 2>,
        tau: &SVector<T, 2>,
    ) -> ForwardDynamicsDerivatives<T, 2> {
        let a = self.forward_dynamics(q, v, tau);
        let InverseDynamicsDerivatives { dtau_dq, dtau_dv, dtau_da } =
            self.inverse_dynamics_derivatives(q, v, &a);
        let da_dtau = inverse(dtau_da);
        ForwardDynamicsDerivatives { da_dq: -(da_dtau * dtau_dq), da_dv: -(da_dtau * dtau_dv), da_dtau }
    }
}

impl<T: Scalar> Configuration<T, 2, 2> for DoublePendulum {
    fn integrate(&self, q: &SVector<T, 2>, delta: &SVector<T, 2>) -> SVector<T, 2> {
        q + delta
    }
}

/// One motor, in the elbow.
impl<T: Scalar> StateSpaceModel<T, 2, 2, 4, 1> for DoublePendulum {
    fn input_map(&self) -> SMatrix<T, 2, 1> {
        vector([T::zero(), T::one()])
    }
}

impl<T: Scalar> Frame<DoublePendulum, T, 2, 2> for Tool0 {
    const NAME: &'static str = "tool0";

    fn pose(_robot: &DoublePendulum, q: &SVector<T, 2>) -> Pose<T> {
        let (o, i) = (T::zero(), T::one());
        let [[q0, q1]] = q.data.0;
        let ((s1, c1), (s, c)) = (q0.sin_cos(), (q0 + q1).sin_cos());
        Pose {
            rotation: columns([[i, o, o], [o, c, s], [o, -s, c]]),
            translation: vector([o, s1 + s, -c1 - c]),
        }
    }
    fn jacobian(robot: &DoublePendulum, q: &SVector<T, 2>) -> SMatrix<T, 6, 2> {
        let [[_, q1]] = q.data.0;
        let (s2, c2) = q1.sin_cos();
        let _ = robot;
        let (o, i) = (T::zero(), T::one());
        columns([[o, i + c2, -s2, i, o, o], [o, i, o, i, o, o]])
    }
    fn world_jacobian(_robot: &DoublePendulum, q: &SVector<T, 2>) -> SMatrix<T, 6, 2> {
        let (o, i) = (T::zero(), T::one());
        let [[q0, q1]] = q.data.0;
        let ((s1, c1), (s, c)) = (q0.sin_cos(), (q0 + q1).sin_cos());
        columns([[o, c1 + c, s1 + s, i, o, o], [o, c, s, i, o, o]])
    }
    fn acceleration(
        _robot: &DoublePendulum,
        q: &SVector<T, 2>,
        v: &SVector<T, 2>,
        a: &SVector<T, 2>,
    ) -> SVector<T, 6> {
        let ([[_, q1]], [[v0, v1]], [[a0, a1]]) = (q.data.0, v.data.0, a.data.0);
        let ((s2, c2), o) = (q1.sin_cos(), T::zero());
        let (y, z) = ((T::one() + c2) * a0 + a1 - s2 * v1 * v0, -s2 * a0 - c2 * v1 * v0);
        vector([o, y, z, a0 + a1, o, o])
    }
}

/// A free-turning body with principal moments 1, 2, 3: q is a quaternion i, j, k, w; v is in the body.
#[derive(Clone, Copy, Debug)]
pub struct Spinner;

const MOMENTS: [f64; 3] = [1.0, 2.0, 3.0];

impl Dynamics<f64, 4, 3> for Spinner {
    fn mass_matrix(&self, _q: &SVector<f64, 4>) -> SMatrix<f64, 3, 3> {
        SMatrix::from_diagonal(&vector(MOMENTS))
    }
    /// `½ (ω̂ I + I ω̂ − (I ω)^)`, Levi-Civita's.
    fn coriolis_matrix(&self, q: &SVector<f64, 4>, v: &SVector<f64, 3>) -> SMatrix<f64, 3, 3> {
        let inertia = self.mass_matrix(q);
        (v.cross_matrix() * inertia + inertia * v.cross_matrix() - (inertia * v).cross_matrix()) * 0.5
    }
    fn gravity_forces(&self, _q: &SVector<f64, 4>) -> SVector<f64, 3> {
        SVector::zeros()
    }
    fn bias_forces(&self, q: &SVector<f64, 4>, v: &SVector<f64, 3>) -> SVector<f64, 3> {
        v.cross(&(self.mass_matrix(q) * v))
    }
    fn inverse_dynamics(
        &self,
        q: &SVector<f64, 4>,
        v: &SVector<f64, 3>,
        a: &SVector<f64, 3>,
    ) -> SVector<f64, 3> {
        self.mass_matrix(q) * a + self.bias_forces(q, v)
    }
    fn forward_dynamics(
        &self,
        q: &SVector<f64, 4>,
        v: &SVector<f64, 3>,
        tau: &SVector<f64, 3>,
    ) -> SVector<f64, 3> {
        (tau - self.bias_forces(q, v)).component_div(&vector(MOMENTS))
    }
    fn kinetic_energy(&self, q: &SVector<f64, 4>, v: &SVector<f64, 3>) -> f64 {
        0.5 * v.dot(&(self.mass_matrix(q) * v))
    }
    fn potential_energy(&self, _q: &SVector<f64, 4>) -> f64 {
        0.0
    }
    fn lagrangian(&self, q: &SVector<f64, 4>, v: &SVector<f64, 3>) -> f64 {
        self.kinetic_energy(q, v)
    }
    fn check_configuration(&self, q: &SVector<f64, 4>) -> Result<(), Error> {
        let [q] = q.data.0;
        Error::unless_unit_quaternion(0, q)
    }
}

impl DynamicsDerivatives<f64, 4, 3> for Spinner {
    fn inverse_dynamics_derivatives(
        &self,
        q: &SVector<f64, 4>,
        v: &SVector<f64, 3>,
        _a: &SVector<f64, 3>,
    ) -> InverseDynamicsDerivatives<f64, 3> {
        let inertia = self.mass_matrix(q);
        InverseDynamicsDerivatives {
            dtau_dq: SMatrix::zeros(),
            dtau_dv: v.cross_matrix() * inertia - (inertia * v).cross_matrix(),
            dtau_da: inertia,
        }
    }
    fn forward_dynamics_derivatives(
        &self,
        q: &SVector<f64, 4>,
        v: &SVector<f64, 3>,
        tau: &SVector<f64, 3>,
    ) -> ForwardDynamicsDerivatives<f64, 3> {
        let a = self.forward_dynamics(q, v, tau);
        let da_dtau = SMatrix::from_diagonal(&vector(MOMENTS.map(f64::recip)));
        let InverseDynamicsDerivatives { dtau_dq, dtau_dv, .. } = self.inverse_dynamics_derivatives(q, v, &a);
        ForwardDynamicsDerivatives { da_dq: -(da_dtau * dtau_dq), da_dv: -(da_dtau * dtau_dv), da_dtau }
    }
}

/// A torque about every axis of the body.
impl StateSpaceModel<f64, 4, 3, 6, 3> for Spinner {
    fn input_map(&self) -> SMatrix<f64, 3, 3> {
        SMatrix::identity()
    }
    fn tangent_rate(&self, v: &SVector<f64, 3>) -> SMatrix<f64, 3, 3> {
        let [v] = v.data.0;
        columns(ball_tangent_rate(v))
    }
}

impl Configuration<f64, 4, 3> for Spinner {
    fn integrate(&self, q: &SVector<f64, 4>, delta: &SVector<f64, 3>) -> SVector<f64, 4> {
        let ([q], [delta]) = (q.data.0, delta.data.0);
        vector(integrate_ball(q, delta))
    }
    fn difference(&self, q0: &SVector<f64, 4>, q1: &SVector<f64, 4>) -> SVector<f64, 3> {
        let ([q0], [q1]) = (q0.data.0, q1.data.0);
        vector(difference_ball(q0, q1))
    }
    fn rate(&self, delta: &SVector<f64, 3>, v: &SVector<f64, 3>) -> SVector<f64, 3> {
        let ([delta], [v]) = (delta.data.0, v.data.0);
        vector(ball_rate(delta, v))
    }
    fn rate_transposed(&self, delta: &SVector<f64, 3>, p: &SVector<f64, 3>) -> SVector<f64, 3> {
        let ([delta], [p]) = (delta.data.0, p.data.0);
        vector(ball_rate_transposed(delta, p))
    }
    fn neutral(&self) -> SVector<f64, 4> {
        vector([0.0, 0.0, 0.0, 1.0])
    }
}
