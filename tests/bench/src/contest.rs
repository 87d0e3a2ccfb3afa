//! What is raced: every output of every robot, at the same random states.

use std::hint::black_box;
use std::time::{Duration, Instant};

use dynamics_core::prelude::*;

use crate::{Entry, industrial, models};

/// The robots: their names among the peers, and those of their structs.
pub const ROBOTS: [(&str, &str); 8] = [
    ("double_pendulum", "Planar2Dof"),
    ("cartpole", "ReferenceCartPole"),
    ("puma560", "Puma560"),
    ("iiwa14", "Iiwa14"),
    ("hyq", "Hyq"),
    ("chain4", "Chain4"),
    ("chain16", "Chain16"),
    ("chain32", "Chain32"),
];

/// The outputs that the peers have too: what they are called here, and the method that computes them.
pub const OUTPUTS: [(&str, &str); 8] = [
    ("G", "gravity_forces"),
    ("ID", "inverse_dynamics"),
    ("M", "mass_matrix"),
    ("C", "coriolis_matrix"),
    ("FD", "forward_dynamics"),
    ("1/M", "inverse_mass_matrix"),
    ("dID", "inverse_dynamics_derivatives"),
    ("dFD", "forward_dynamics_derivatives"),
];

/// How many states a batch has.
const STATES: usize = 256;
/// For how long one output is timed, at least.
const TIME: Duration = Duration::from_millis(10);
/// How many batches there are, at least.
const FEWEST_BATCHES: usize = 5;

/// Where a robot is, how it moves, and its accelerations or joint forces.
#[derive(Clone, Copy, Debug)]
pub struct State<const NQ: usize, const NV: usize> {
    /// Coordinates.
    pub q: SVector<f64, NQ>,
    /// Speeds.
    pub v: SVector<f64, NV>,
    /// Accelerations, or joint forces.
    pub a: SVector<f64, NV>,
}

/// Random states, the same on every machine: angles and metres within ±π, speeds and accelerations within ±5.
pub fn states<R: Configuration<f64, NQ, NV>, const NQ: usize, const NV: usize>(
    robot: &R,
) -> Vec<State<NQ, NV>> {
    let mut seed = 2026_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let mut vector = |size: f64| SVector::<f64, NV>::from_fn(|_, _| size * random());
    // Where a motion from no rotation leads: quaternions are of unit length there.
    let neutral = robot.neutral();
    let mut state = || State {
        q: robot.integrate(&neutral, &vector(std::f64::consts::PI)),
        v: vector(5.0),
        a: vector(5.0),
    };
    (0..STATES).map(|_| state()).collect()
}

/// The least nanoseconds a call, over batches that go once through all states. Calls may overlap: none waits for
/// the result of another.
pub fn least<S, O>(states: &[S], call: impl Fn(&S) -> O) -> f64 {
    let batch = || {
        let start = Instant::now();
        for state in states {
            black_box(&call(black_box(state)));
        }
        start.elapsed().as_secs_f64() / states.len() as f64 * 1e9
    };
    let begun = Instant::now();
    let mut best = f64::INFINITY;
    let mut batches = 0;
    while batches < FEWEST_BATCHES || begun.elapsed() < TIME {
        best = best.min(batch());
        batches += 1;
    }
    best
}

/// A robot with every output, of one state and of several in lanes.
pub trait InLanes<const NQ: usize, const NV: usize>:
    DynamicsDerivatives<f64, NQ, NV>
    + DynamicsDerivatives<f64x4, NQ, NV>
    + DynamicsDerivatives<f64x8, NQ, NV>
    + DynamicsDerivatives<f32x8, NQ, NV>
    + Configuration<f64, NQ, NV>
    + Sync
{
}

impl<R, const NQ: usize, const NV: usize> InLanes<NQ, NV> for R where
    R: DynamicsDerivatives<f64, NQ, NV>
        + DynamicsDerivatives<f64x4, NQ, NV>
        + DynamicsDerivatives<f64x8, NQ, NV>
        + DynamicsDerivatives<f32x8, NQ, NV>
        + Configuration<f64, NQ, NV>
        + Sync
{
}

/// What is done with a robot.
pub trait Visitor {
    /// Does it.
    fn visit<R: InLanes<NQ, NV>, const NQ: usize, const NV: usize>(&mut self, name: &str, robot: &R);
}

/// Shows a visitor the robot of that name, if there is one.
pub fn visit(name: &str, visitor: &mut impl Visitor) {
    match name {
        "double_pendulum" => visitor.visit(name, &industrial::planar_2dof::Planar2Dof),
        "cartpole" => visitor.visit(name, &industrial::reference_cart_pole::ReferenceCartPole),
        "puma560" => visitor.visit(name, &industrial::puma560::Puma560),
        "iiwa14" => visitor.visit(name, &industrial::iiwa14::Iiwa14),
        "hyq" => visitor.visit(name, &models::hyq::Hyq),
        "chain4" => visitor.visit(name, &models::chain4::Chain4),
        "chain16" => visitor.visit(name, &models::chain16::Chain16),
        "chain32" => visitor.visit(name, &models::chain32::Chain32),
        _ => {}
    }
}

/// The robot of that name, as the compiler reads it.
pub fn entry(name: &str) -> Option<Entry> {
    let (_, wanted) = ROBOTS.into_iter().find(|(robot, _)| *robot == name)?;
    industrial::all().into_iter().chain(models::all()).find(|entry| entry.name == wanted)
}

/// What is done with an output.
pub trait Stage<const NQ: usize, const NV: usize> {
    /// Does it.
    fn enter<O: Entries>(&mut self, output: &str, call: impl Fn(&State<NQ, NV>) -> O);
}

/// Enters every output of a robot: those of [`OUTPUTS`], `h = C·v + G`, and the bundles.
pub fn enter_all<R, const NQ: usize, const NV: usize>(robot: &R, stage: &mut impl Stage<NQ, NV>)
where
    R: DynamicsDerivatives<f64, NQ, NV>,
{
    stage.enter("G", |s| robot.gravity_forces(&s.q));
    stage.enter("ID", |s| robot.inverse_dynamics(&s.q, &s.v, &s.a));
    stage.enter("h", |s| robot.bias_forces(&s.q, &s.v));
    stage.enter("M", |s| robot.mass_matrix(&s.q));
    stage.enter("C", |s| robot.coriolis_matrix(&s.q, &s.v));
    stage.enter("FD", |s| robot.forward_dynamics(&s.q, &s.v, &s.a));
    stage.enter("1/M", |s| robot.inverse_mass_matrix(&s.q));
    stage.enter("M,C,G", |s| robot.equations_of_motion(&s.q, &s.v));
    stage.enter("dID", |s| robot.inverse_dynamics_derivatives(&s.q, &s.v, &s.a));
    stage.enter("dFD", |s| robot.forward_dynamics_derivatives(&s.q, &s.v, &s.a));
    stage.enter("ID+dID", |s| robot.inverse_dynamics_with_derivatives(&s.q, &s.v, &s.a));
    stage.enter("FD+dFD", |s| robot.forward_dynamics_with_derivatives(&s.q, &s.v, &s.a));
}

/// What a method returns, as numbers.
pub trait Entries {
    /// All entries, of matrices by rows.
    fn entries(&self) -> Vec<f64>;
}

impl<const R: usize, const C: usize> Entries for SMatrix<f64, R, C> {
    fn entries(&self) -> Vec<f64> {
        self.transpose().as_slice().to_vec()
    }
}

impl<const NV: usize> Entries for EquationsOfMotion<f64, NV> {
    fn entries(&self) -> Vec<f64> {
        let matrices = [self.mass_matrix.entries(), self.coriolis_matrix.entries()].concat();
        [matrices, self.gravity_forces.entries()].concat()
    }
}

impl<const NV: usize> Entries for InverseDynamicsDerivatives<f64, NV> {
    fn entries(&self) -> Vec<f64> {
        [&self.dtau_dq, &self.dtau_dv, &self.dtau_da].map(Entries::entries).concat()
    }
}

impl<V: Entries, D: Entries> Entries for (V, D) {
    fn entries(&self) -> Vec<f64> {
        [self.0.entries(), self.1.entries()].concat()
    }
}

impl<const NV: usize> Entries for ForwardDynamicsDerivatives<f64, NV> {
    fn entries(&self) -> Vec<f64> {
        [&self.da_dq, &self.da_dv, &self.da_dtau].map(Entries::entries).concat()
    }
}
