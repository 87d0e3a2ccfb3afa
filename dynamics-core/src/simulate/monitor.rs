//! What a motion keeps, gains and loses: energy, power, momentum.

use nalgebra::SVector;

use super::numbers::{larger, magnitude};
use super::{Sample, Segment};
use crate::centroidal::CentroidalDynamics;
use crate::dynamics::Dynamics;
use crate::product::dot;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

impl<R, T: Scalar, const NQ: usize, const NV: usize> Sample<'_, R, T, NQ, NV>
where
    R: Dynamics<T, NQ, NV>,
{
    /// `vᵀ·τ`, in W: the power that joint forces put in.
    #[must_use]
    pub fn power(&self, tau: &SVector<T, NV>) -> T {
        dot(&self.state.v, tau)
    }

    /// The power that dampers and friction take, in W; not negative. That of springs comes back, and is not in it.
    #[must_use]
    pub fn dissipation(&self) -> T {
        dissipation(self.robot, &self.state)
    }
}

fn dissipation<R, T, const NQ: usize, const NV: usize>(robot: &R, State { q, v }: &State<T, NQ, NV>) -> T
where
    R: Dynamics<T, NQ, NV>,
    T: Scalar,
{
    let springs = robot.passive_forces(q, &SVector::zeros());
    dot(v, &(robot.passive_forces(q, v) - springs))
}

impl<R, T: Scalar, const NQ: usize, const NV: usize> Sample<'_, R, T, NQ, NV>
where
    R: CentroidalDynamics<T, NQ, NV>,
{
    /// The momentum of all that moves, in world axes.
    #[must_use]
    pub fn momentum(&self) -> Momentum<T> {
        let State { q, v } = &self.state;
        let [[x, y, z, l, m, n]] = self.robot.centroidal_momentum(q, v).data.0;
        Momentum {
            center: self.robot.center_of_mass(q),
            linear: SVector::from([x, y, z]),
            angular: SVector::from([l, m, n]),
        }
    }
}

/// The momentum of a robot, in world axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Momentum<T> {
    /// The centre of mass, in m.
    pub center: SVector<T, 3>,
    /// In kg·m/s.
    pub linear: SVector<T, 3>,
    /// About the centre of mass, in kg·m²/s.
    pub angular: SVector<T, 3>,
}

impl<T: Scalar> Momentum<T> {
    /// The angular momentum about a point of the world, in kg·m²/s; about the origin, `about(&SVector::zeros())`.
    #[must_use]
    pub fn about(&self, point: &SVector<T, 3>) -> SVector<T, 3> {
        let ([[x, y, z]], [[a, b, c]]) = ((self.center - point).data.0, self.linear.data.0);
        self.angular + SVector::from([y * c - z * b, z * a - x * c, x * b - y * a])
    }
}

/// The account of a motion's energy: what it has, what was put in, and what dampers and friction took.
///
/// # Example
///
/// ```
/// # use dynamics_core::prelude::*;
/// # use dynamics_core::simulate::EnergyMonitor;
/// # fn swing<R>(robot: &R, q0: SVector<f64, 2>) -> Result<(), Error>
/// # where R: Dynamics<f64, 2, 2> + Configuration<f64, 2, 2> {
/// let brake = |_time: f64, state: &State<f64, 2, 2>| -0.1 * state.v;
/// let mut simulation = Simulation::new(robot, State::rest(q0), 1e-3)?.with_input(brake);
/// let mut monitor = EnergyMonitor::new(&simulation.sample());
/// for sample in simulation.steps(10_000) {
///     monitor.observe(&sample?, brake);
/// }
/// assert!(monitor.drift() < 1e-6); // J that came from nowhere
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct EnergyMonitor<T, const NQ: usize, const NV: usize> {
    time: T,
    state: State<T, NQ, NV>,
    start: T,
    now: T,
    work: T,
    dissipated: T,
    drift: T,
}

impl<T: Scalar + PartialOrd, const NQ: usize, const NV: usize> EnergyMonitor<T, NQ, NV> {
    /// An account that begins with a sample.
    pub fn new<R: Dynamics<T, NQ, NV>>(sample: &Sample<'_, R, T, NQ, NV>) -> Self {
        let (start, zero) = (sample.energy().total(), T::zero());
        let Sample { time, state, .. } = *sample;
        Self { time, state, start, now: start, work: zero, dissipated: zero, drift: zero }
    }

    /// Goes on to a later sample, under the joint forces `τ = input(time, state)`.
    ///
    /// Powers are integrated by Simpson's rule, with the state in the middle of a [`Segment`] between the samples: the
    /// error goes with the fourth power of the time between.
    pub fn observe<R>(
        &mut self,
        sample: &Sample<'_, R, T, NQ, NV>,
        mut input: impl FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
    ) where
        R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV>,
    {
        let Sample { time, state, robot } = *sample;
        if time > self.time {
            let middle = self.time + (time - self.time) * T::of(0.5);
            let between = Segment::between(robot, [self.time, time], [&self.state, &state]);
            let third = (time - self.time) * T::of(1.0 / 6.0);
            let moments = [
                (self.time, self.state, third),
                (middle, between.at(robot, middle), third * T::of(4.0)),
                (time, state, third),
            ];
            for (time, state, weight) in moments {
                self.work = dot(&state.v, &input(time, &state)).mul_add(weight, self.work);
                self.dissipated = dissipation(robot, &state).mul_add(weight, self.dissipated);
            }
        }
        (self.time, self.state, self.now) = (time, state, sample.energy().total());
        self.drift = larger(self.drift, magnitude(self.imbalance()));
    }

    /// What joint forces have put in since the start, in J.
    #[must_use]
    pub fn work(&self) -> T {
        self.work
    }

    /// What dampers and friction have taken since the start, in J.
    #[must_use]
    pub fn dissipated(&self) -> T {
        self.dissipated
    }

    /// What the energy has grown by, less work, and with what was dissipated, in J: the error of the method, and of the
    /// account.
    #[must_use]
    pub fn imbalance(&self) -> T {
        self.now - self.start - self.work + self.dissipated
    }

    /// The greatest size that the imbalance has had at a sample, in J.
    #[must_use]
    pub fn drift(&self) -> T {
        self.drift
    }
}

/// How far a motion's momenta have gone from those at its start.
///
/// Of a robot that nothing holds or pulls all of them stay; under gravity the angular one about the centre of mass does.
/// So it is in the motion itself, and in a simulation to the order of the method; what
/// [`Variational`](super::Variational) keeps to rounding, it says there.
#[derive(Clone, Copy, Debug)]
pub struct MomentumMonitor<T> {
    start: Momentum<T>,
    linear: T,
    angular: T,
    about_origin: T,
}

impl<T: Scalar + PartialOrd> MomentumMonitor<T> {
    /// An account that begins with a sample.
    pub fn new<R, const NQ: usize, const NV: usize>(sample: &Sample<'_, R, T, NQ, NV>) -> Self
    where
        R: CentroidalDynamics<T, NQ, NV>,
    {
        let zero = T::zero();
        Self { start: sample.momentum(), linear: zero, angular: zero, about_origin: zero }
    }

    /// Goes on to another sample.
    pub fn observe<R, const NQ: usize, const NV: usize>(&mut self, sample: &Sample<'_, R, T, NQ, NV>)
    where
        R: CentroidalDynamics<T, NQ, NV>,
    {
        let (now, start, origin) = (sample.momentum(), self.start, SVector::zeros());
        let distance = |a: SVector<T, 3>, b: SVector<T, 3>| dot(&(a - b), &(a - b)).sqrt();
        self.linear = larger(self.linear, distance(now.linear, start.linear));
        self.angular = larger(self.angular, distance(now.angular, start.angular));
        let about_origin = distance(now.about(&origin), start.about(&origin));
        self.about_origin = larger(self.about_origin, about_origin);
    }

    /// The greatest change of the linear momentum, in kg·m/s.
    #[must_use]
    pub fn linear(&self) -> T {
        self.linear
    }

    /// The greatest change of the angular momentum about the centre of mass, in kg·m²/s.
    #[must_use]
    pub fn angular(&self) -> T {
        self.angular
    }

    /// The greatest change of the angular momentum about the world's origin, in kg·m²/s.
    #[must_use]
    pub fn about_origin(&self) -> T {
        self.about_origin
    }
}
