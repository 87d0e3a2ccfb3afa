//! A compiled robot with its sizes, behind the interface without them.

use dynamics_core::prelude::*;
use dynamics_core::simulate::{CoordinateAt, EnergyMonitor};
use dynamics_core::state;

use crate::frames::Frames;
use crate::robot::{Axes, Method, Robot, Run};
use crate::{Matrix, Vector};

/// A compiled robot of `NQ` coordinates, `NV` speeds, `NX` states, `NU` inputs, `NP` inertial and `NB` base
/// parameters.
pub struct Specialised<
    R,
    T,
    const NQ: usize,
    const NV: usize,
    const NX: usize,
    const NU: usize,
    const NP: usize,
    const NB: usize,
> {
    /// The robot, or its prepared companion.
    pub robot: R,
    /// Its frames.
    pub frames: Vec<Frames<R, T, NQ, NV>>,
}

fn fixed<T: Scalar, const N: usize>(x: &Vector<T>) -> SVector<T, N> {
    SVector::from_column_slice(x.as_slice())
}

fn vector<T: Scalar, const N: usize>(x: SVector<T, N>) -> Vector<T> {
    Vector::from_column_slice(x.as_slice())
}

fn matrix<T: Scalar, const N: usize, const K: usize>(m: SMatrix<T, N, K>) -> Matrix<T> {
    Matrix::from_column_slice(N, K, m.as_slice())
}

impl<
    R,
    T,
    const NQ: usize,
    const NV: usize,
    const NX: usize,
    const NU: usize,
    const NP: usize,
    const NB: usize,
> Robot<T> for Specialised<R, T, NQ, NV, NX, NU, NP, NB>
where
    R: StateSpaceModel<T, NQ, NV, NX, NU>
        + CentroidalDynamics<T, NQ, NV>
        + Regressor<T, NQ, NV, NP>
        + BaseRegressor<T, NQ, NV, NB>,
    T: Scalar + PartialOrd + Into<f64>,
{
    fn mass_matrix(&self, q: &Vector<T>) -> Matrix<T> {
        matrix(self.robot.mass_matrix(&fixed(q)))
    }

    fn inverse_mass_matrix(&self, q: &Vector<T>) -> Matrix<T> {
        matrix(self.robot.inverse_mass_matrix(&fixed(q)))
    }

    fn coriolis_matrix(&self, q: &Vector<T>, v: &Vector<T>) -> Matrix<T> {
        matrix(self.robot.coriolis_matrix(&fixed(q), &fixed(v)))
    }

    fn gravity_forces(&self, q: &Vector<T>) -> Vector<T> {
        vector(self.robot.gravity_forces(&fixed(q)))
    }

    fn passive_forces(&self, q: &Vector<T>, v: &Vector<T>) -> Vector<T> {
        vector(self.robot.passive_forces(&fixed(q), &fixed(v)))
    }

    fn bias_forces(&self, q: &Vector<T>, v: &Vector<T>) -> Vector<T> {
        vector(self.robot.bias_forces(&fixed(q), &fixed(v)))
    }

    fn inverse_dynamics(&self, q: &Vector<T>, v: &Vector<T>, a: &Vector<T>) -> Vector<T> {
        vector(self.robot.inverse_dynamics(&fixed(q), &fixed(v), &fixed(a)))
    }

    fn forward_dynamics(&self, q: &Vector<T>, v: &Vector<T>, tau: &Vector<T>) -> Vector<T> {
        vector(self.robot.forward_dynamics(&fixed(q), &fixed(v), &fixed(tau)))
    }

    fn try_forward_dynamics(
        &self,
        q: &Vector<T>,
        v: &Vector<T>,
        tau: &Vector<T>,
    ) -> Result<Vector<T>, Error> {
        self.robot.try_forward_dynamics(&fixed(q), &fixed(v), &fixed(tau)).map(vector)
    }

    fn kinetic_energy(&self, q: &Vector<T>, v: &Vector<T>) -> T {
        self.robot.kinetic_energy(&fixed(q), &fixed(v))
    }

    fn potential_energy(&self, q: &Vector<T>) -> T {
        self.robot.potential_energy(&fixed(q))
    }

    fn elastic_energy(&self, q: &Vector<T>) -> T {
        self.robot.elastic_energy(&fixed(q))
    }

    fn lagrangian(&self, q: &Vector<T>, v: &Vector<T>) -> T {
        self.robot.lagrangian(&fixed(q), &fixed(v))
    }

    fn equations_of_motion(&self, q: &Vector<T>, v: &Vector<T>) -> (Matrix<T>, Matrix<T>, Vector<T>) {
        let all = self.robot.equations_of_motion(&fixed(q), &fixed(v));
        (matrix(all.mass_matrix), matrix(all.coriolis_matrix), vector(all.gravity_forces))
    }

    fn inverse_dynamics_derivatives(&self, q: &Vector<T>, v: &Vector<T>, a: &Vector<T>) -> [Matrix<T>; 3] {
        let InverseDynamicsDerivatives { dtau_dq, dtau_dv, dtau_da } =
            self.robot.inverse_dynamics_derivatives(&fixed(q), &fixed(v), &fixed(a));
        [dtau_dq, dtau_dv, dtau_da].map(matrix)
    }

    fn forward_dynamics_derivatives(&self, q: &Vector<T>, v: &Vector<T>, tau: &Vector<T>) -> [Matrix<T>; 3] {
        let ForwardDynamicsDerivatives { da_dq, da_dv, da_dtau } =
            self.robot.forward_dynamics_derivatives(&fixed(q), &fixed(v), &fixed(tau));
        [da_dq, da_dv, da_dtau].map(matrix)
    }

    fn inverse_dynamics_with_derivatives(&self, [q, v, a]: [&Vector<T>; 3]) -> (Vector<T>, [Matrix<T>; 3]) {
        let (tau, InverseDynamicsDerivatives { dtau_dq, dtau_dv, dtau_da }) =
            self.robot.inverse_dynamics_with_derivatives(&fixed(q), &fixed(v), &fixed(a));
        (vector(tau), [dtau_dq, dtau_dv, dtau_da].map(matrix))
    }

    fn forward_dynamics_with_derivatives(&self, [q, v, tau]: [&Vector<T>; 3]) -> (Vector<T>, [Matrix<T>; 3]) {
        let (a, ForwardDynamicsDerivatives { da_dq, da_dv, da_dtau }) =
            self.robot.forward_dynamics_with_derivatives(&fixed(q), &fixed(v), &fixed(tau));
        (vector(a), [da_dq, da_dv, da_dtau].map(matrix))
    }

    fn total_mass(&self) -> T {
        self.robot.total_mass()
    }

    fn center_of_mass(&self, q: &Vector<T>) -> Vector<T> {
        vector(self.robot.center_of_mass(&fixed(q)))
    }

    fn center_of_mass_jacobian(&self, q: &Vector<T>) -> Matrix<T> {
        matrix(self.robot.center_of_mass_jacobian(&fixed(q)))
    }

    fn centroidal_momentum(&self, q: &Vector<T>, v: &Vector<T>) -> Vector<T> {
        vector(self.robot.centroidal_momentum(&fixed(q), &fixed(v)))
    }

    fn centroidal_momentum_matrix(&self, q: &Vector<T>) -> Matrix<T> {
        matrix(self.robot.centroidal_momentum_matrix(&fixed(q)))
    }

    fn regressor(&self, q: &Vector<T>, v: &Vector<T>, a: &Vector<T>) -> Matrix<T> {
        matrix(self.robot.regressor(&fixed(q), &fixed(v), &fixed(a)))
    }

    fn inertial_parameters(&self) -> Vector<T> {
        vector(self.robot.inertial_parameters())
    }

    fn base_regressor(&self, q: &Vector<T>, v: &Vector<T>, a: &Vector<T>) -> Matrix<T> {
        matrix(self.robot.base_regressor(&fixed(q), &fixed(v), &fixed(a)))
    }

    fn base_parameters(&self) -> Vector<T> {
        vector(self.robot.base_parameters())
    }

    fn integrate(&self, q: &Vector<T>, delta: &Vector<T>) -> Vector<T> {
        vector(self.robot.integrate(&fixed(q), &fixed(delta)))
    }

    fn difference(&self, q0: &Vector<T>, q1: &Vector<T>) -> Vector<T> {
        vector(self.robot.difference(&fixed(q0), &fixed(q1)))
    }

    fn rate(&self, delta: &Vector<T>, v: &Vector<T>) -> Vector<T> {
        vector(self.robot.rate(&fixed(delta), &fixed(v)))
    }

    fn rate_transposed(&self, delta: &Vector<T>, p: &Vector<T>) -> Vector<T> {
        vector(self.robot.rate_transposed(&fixed(delta), &fixed(p)))
    }

    fn neutral(&self) -> Vector<T> {
        vector(self.robot.neutral())
    }

    fn check_configuration(&self, q: &Vector<T>) -> Result<(), Error> {
        self.robot.check_configuration(&fixed(q))
    }

    fn input_map(&self) -> Matrix<T> {
        matrix(self.robot.input_map())
    }

    fn tangent_rate(&self, v: &Vector<T>) -> Matrix<T> {
        matrix(self.robot.tangent_rate(&fixed(v)))
    }

    fn linearize(&self, q: &Vector<T>, v: &Vector<T>, u: &Vector<T>) -> (Matrix<T>, Matrix<T>, Vector<T>) {
        let Linearization { a, b, drift } = self.robot.linearize(&fixed(q), &fixed(v), &fixed(u));
        (matrix(a), matrix(b), vector(drift))
    }

    fn frame_names(&self) -> Vec<&'static str> {
        self.frames.iter().map(|frame| frame.name).collect()
    }

    fn pose(&self, frame: usize, q: &Vector<T>) -> (Matrix<T>, Vector<T>) {
        let Pose { rotation, translation } = (self.frames[frame].pose)(&self.robot, &fixed(q));
        (matrix(rotation), vector(translation))
    }

    fn jacobian(&self, frame: usize, axes: Axes, q: &Vector<T>) -> Matrix<T> {
        matrix((self.frames[frame].jacobian[axes as usize])(&self.robot, &fixed(q)))
    }

    fn velocity(&self, frame: usize, axes: Axes, q: &Vector<T>, v: &Vector<T>) -> Vector<T> {
        vector((self.frames[frame].velocity[axes as usize])(&self.robot, &fixed(q), &fixed(v)))
    }

    fn acceleration(&self, frame: usize, axes: Axes, [q, v, a]: [&Vector<T>; 3]) -> Vector<T> {
        let acceleration = self.frames[frame].acceleration[axes as usize];
        vector(acceleration(&self.robot, &fixed(q), &fixed(v), &fixed(a)))
    }

    fn bias_acceleration(&self, frame: usize, axes: Axes, q: &Vector<T>, v: &Vector<T>) -> Vector<T> {
        vector((self.frames[frame].bias_acceleration[axes as usize])(&self.robot, &fixed(q), &fixed(v)))
    }

    fn external_forces(&self, frame: usize, axes: Axes, q: &Vector<T>, wrench: &Vector<T>) -> Vector<T> {
        vector((self.frames[frame].external_forces[axes as usize])(&self.robot, &fixed(q), &fixed(wrench)))
    }

    fn simulate(
        &self,
        (q, v): (&Vector<T>, &Vector<T>),
        step: T,
        count: usize,
        by: Method,
    ) -> Result<Run<T>, Error> {
        let from = state::State::new(fixed(q), fixed(v));
        let simulation = Simulation::new(&self.robot, from, step)?;
        let first = simulation.sample();
        match by {
            Method::Rk4 => run(first, { simulation }.steps(count)),
            Method::SemiImplicitEuler => {
                run(first, simulation.with_integrator(SemiImplicitEuler).steps(count))
            }
            Method::Variational => run(first, simulation.with_integrator(Variational).steps(count)),
            Method::Adaptive => {
                let mut adaptive = Adaptive::new(&self.robot, from, Tolerances::of(T::of(1e-11)))?;
                let end = step * T::of(count as f64);
                run(first, adaptive.every(step, end))
            }
        }
    }

    fn everything_on_the_stack(&self, q: &[T], v: &[T], a: &[T], count: usize) -> Result<T, Error> {
        let (q, [v, a]) = (SVector::from_column_slice(q), [v, a].map(SVector::from_column_slice));
        let (q, v, a) = (&q, &v, &a);
        let robot = &self.robot;
        robot.check_configuration(q)?;
        let mut sum = robot.kinetic_energy(q, v) + robot.lagrangian(q, v) + robot.total_energy(q, v);
        sum += robot.mass_matrix(q).sum() + robot.inverse_mass_matrix(q).sum();
        sum += robot.coriolis_matrix(q, v).sum() + robot.gravity_forces(q).sum();
        sum += robot.passive_forces(q, v).sum() + robot.bias_forces(q, v).sum();
        sum += robot.inverse_dynamics(q, v, a).sum() + robot.forward_dynamics(q, v, a).sum();
        sum += robot.try_inverse_dynamics(q, v, a)?.sum() + robot.try_forward_dynamics(q, v, a)?.sum();
        sum += robot.equations_of_motion(q, v).mass_matrix.sum();
        sum += robot.inverse_dynamics_derivatives(q, v, a).dtau_dq.sum();
        sum += robot.forward_dynamics_derivatives(q, v, a).da_dq.sum();
        sum += robot.inverse_dynamics_with_derivatives(q, v, a).0.sum();
        sum += robot.forward_dynamics_with_derivatives(q, v, a).0.sum();
        sum += robot.total_mass() + robot.center_of_mass(q).sum() + robot.center_of_mass_jacobian(q).sum();
        sum += robot.centroidal_momentum(q, v).sum() + robot.centroidal_momentum_matrix(q).sum();
        sum += robot.regressor(q, v, a).sum() + robot.inertial_parameters().sum();
        sum += robot.base_regressor(q, v, a).sum() + robot.base_parameters().sum();
        sum += robot.difference(&robot.neutral(), &robot.integrate(q, v)).sum();
        sum += robot.linearize(q, v, &SVector::zeros()).a.sum();
        for frame in &self.frames {
            sum += (frame.pose)(robot, q).translation.sum();
            for axes in Axes::BOTH.map(|axes| axes as usize) {
                let twist = (frame.velocity[axes])(robot, q, v);
                sum += (frame.jacobian[axes])(robot, q).sum() + twist.sum();
                sum += (frame.acceleration[axes])(robot, q, v, a).sum();
                sum += (frame.bias_acceleration[axes])(robot, q, v).sum();
                sum += (frame.external_forces[axes])(robot, q, &twist).sum();
            }
        }
        let from = state::State::new(*q, *v);
        for sample in Simulation::new(robot, from, T::of(1e-3))?.with_input(|_, _| *a).steps(count) {
            sum += sample?.energy().total();
        }
        let euler = Simulation::new(robot, from, T::of(1e-3))?.with_integrator(SemiImplicitEuler);
        for sample in euler.with_input(|_, _| *a).steps(count) {
            sum += sample?.energy().total();
        }
        let mut variational = Simulation::new(robot, from, T::of(1e-3))?.with_integrator(Variational);
        let mut monitor = EnergyMonitor::new(&variational.sample());
        for sample in variational.steps(count) {
            monitor.observe(&sample?, |_, _| *a);
        }
        let mut adaptive = Adaptive::new(robot, from, Tolerances::of(T::of(1e-4)))?;
        let never = CoordinateAt { index: 0, value: T::of(1e3) };
        sum +=
            monitor.work() + adaptive.advance_until(T::of(1e-3), &[never])?.sample.momentum().angular.sum();
        Ok(sum)
    }
}

fn run<'r, R, T, const NQ: usize, const NV: usize>(
    first: Sample<'r, R, T, NQ, NV>,
    samples: impl Iterator<Item = Result<Sample<'r, R, T, NQ, NV>, Error>>,
) -> Result<Run<T>, Error>
where
    R: Dynamics<T, NQ, NV> + 'r,
    T: Scalar,
{
    let (mut energies, mut last) = (vec![first.energy().total()], first);
    for sample in samples {
        last = sample?;
        energies.push(last.energy().total());
    }
    let state::State { q, v } = last.state;
    Ok(Run { energies, q: vector(q), v: vector(v) })
}

/// A compiled robot over a scalar with these frames; the sizes are those of the type `$sized`.
#[macro_export]
macro_rules! specialised {
    ([$($frame:path),*] [$sized:ty] $scalar:ty, $robot:expr) => {
        $crate::Specialised::<
            _,
            $scalar,
            { <$sized as dynamics_core::Mechanism>::NQ },
            { <$sized as dynamics_core::Mechanism>::NV },
            { 2 * <$sized as dynamics_core::Mechanism>::NV },
            { <$sized as dynamics_core::Mechanism>::NU },
            { <$sized as dynamics_core::Mechanism>::PARAMETER_NAMES.len() },
            { <$sized as dynamics_core::Mechanism>::BASE_PARAMETER_NAMES.len() },
        > {
            robot: $robot,
            frames: vec![$($crate::frame::<
                $frame,
                _,
                $scalar,
                { <$sized as dynamics_core::Mechanism>::NQ },
                { <$sized as dynamics_core::Mechanism>::NV },
            >()),*],
        }
    };
}
