//! Rollouts in lanes: as many at a time as there are lanes, each step by the tapes of the robot's programs.

use dynamics_codegen::mechanics::equations::{Argument, Input, Method};
use dynamics_codegen::passes::Program;
use dynamics_core::lanes::{Lanes, f64x8};
use dynamics_core::simulate::{Flow, Vector};

use super::row::{Row, Shelf};
use super::study::{Study, Target};
use super::tape::{Machine, Tape};
use crate::failure::{Failure, Problem};
use crate::motion::{FixedStep, Links};
use crate::robot::Robot;
use crate::simulate::Clock;

/// So many rollouts are computed at a time.
pub(super) type Wide = f64x8;
pub(super) const LANES: usize = Wide::COUNT;

/// A robot's programs as tapes.
pub(super) struct Engine {
    preparation: Tape,
    acceleration: Tape,
    energies: [Tape; 3],
    links: Links,
    sizes: Sizes,
}

#[derive(Clone, Copy)]
struct Sizes {
    parameters: usize,
    q: usize,
    v: usize,
}

impl Sizes {
    /// Where a method finds what a symbol stands for: behind coordinates and speeds a zero, which is all forces and
    /// accelerations, and then the parameters.
    fn place(self, symbol: Input) -> usize {
        match symbol {
            Input::Argument(Argument::Q, k) => k,
            Input::Argument(Argument::V, k) => self.q + k,
            Input::Argument(Argument::A | Argument::Tau, _) => self.q + self.v,
            Input::Parameter(k) => self.q + self.v + 1 + k,
        }
    }

    /// Where it finds the first field of the companion.
    fn fields(self) -> usize {
        self.q + self.v + 1 + self.parameters
    }
}

impl Engine {
    /// Lays out the programs of a robot.
    pub(super) fn of(robot: &Robot<'_>) -> Result<Self, Failure> {
        let compiled = &robot.compiled;
        let sizes =
            Sizes { parameters: robot.model.parameters.len(), q: robot.tree.coordinates(), v: robot.dof() };
        let fields = compiled.companion.preparation.results.len();
        let tape = |method: Method| {
            let program: Option<&Program> = compiled.program(method);
            let tape = |program| {
                Tape::of(program, sizes.fields() + fields, &|symbol| sizes.place(symbol), sizes.fields())
            };
            program.map(tape).ok_or_else(|| {
                let name = method.name();
                let problem = Problem::new(format!("this robot's `{name}` is too long to be run in lanes"));
                Failure::from(problem.help("run `dynamics simulate` for each rollout"))
            })
        };
        let of_parameters = |symbol| match symbol {
            Input::Parameter(k) => k,
            // The companion is of what depends on parameters alone.
            Input::Argument(..) => 0,
        };
        let preparation = &compiled.companion.preparation;
        Ok(Self {
            preparation: Tape::of(preparation, sizes.parameters, &of_parameters, sizes.parameters),
            acceleration: tape(Method::ForwardDynamics)?,
            energies: [
                tape(Method::KineticEnergy)?,
                tape(Method::PotentialEnergy)?,
                tape(Method::ElasticEnergy)?,
            ],
            links: Links::of(&robot.tree),
            sizes,
        })
    }

    /// How many numbers a sample has: its time, coordinates, speeds, three energies and their sum.
    pub(super) fn width(&self) -> usize {
        1 + self.sizes.q + self.sizes.v + 4
    }
}

/// What became of a rollout.
pub(super) struct Rollout {
    pub(super) index: u64,
    /// Of each axis of the study.
    pub(super) parameters: Vec<f64>,
    /// Rows of numbers: samples, as long as they are finite.
    pub(super) samples: Vec<f64>,
    /// When it was finite for the last time, if it did not stay so.
    pub(super) lost: Option<f64>,
}

/// How rollouts are made, and which of their steps are samples.
pub(super) struct Plan<'p> {
    pub(super) engine: &'p Engine,
    pub(super) study: &'p Study,
    pub(super) clock: &'p Clock,
    pub(super) every: u64,
    pub(super) integrator: FixedStep,
    /// Where rollouts start, unless the study says otherwise.
    pub(super) start: (&'p [f64], &'p [f64]),
}

impl Plan<'_> {
    /// As many rollouts from the `first` on as there are lanes and as there are any. `tick` is called now and then with
    /// the steps that were made since it was called last.
    pub(super) fn block(&self, first: u64, tick: &impl Fn(u64)) -> Vec<Rollout> {
        let indices = first..self.study.rollouts.min(first + LANES as u64);
        let mut rollouts: Vec<Rollout> = indices.map(|index| self.begun(index)).collect();
        let mut mover = self.mover(&rollouts);
        mover.sample(0.0, &mut rollouts);
        let mut told = 0;
        for k in 1..=self.clock.steps {
            let (before, now) = (self.clock.at(k - 1), self.clock.at(k));
            mover.step(self.integrator, before, now - before);
            mover.note_losses(before, &mut rollouts);
            if k % self.every == 0 || k == self.clock.steps {
                mover.sample(now, &mut rollouts);
            }
            if k - told >= 1000 || k == self.clock.steps {
                tick((k - told) * rollouts.len() as u64);
                told = k;
                if rollouts.iter().all(|rollout| rollout.lost.is_some()) {
                    tick((self.clock.steps - k) * rollouts.len() as u64);
                    break;
                }
            }
        }
        rollouts
    }

    fn begun(&self, index: u64) -> Rollout {
        let parameters = (0..self.study.axes.len()).map(|axis| self.study.value(axis, index)).collect();
        Rollout { index, parameters, samples: vec![], lost: None }
    }

    /// The lanes at the start of rollouts, the last of which fills the lanes that are left.
    fn mover(&self, rollouts: &[Rollout]) -> Mover<'_> {
        let Sizes { parameters, q, v } = self.engine.sizes;
        let mut mover = Mover::new(self.engine, self.start.0, self.start.1);
        let mut fields = vec![Wide::from(0.0); parameters];
        for (k, axis) in self.study.axes.iter().enumerate() {
            let of_lane =
                |lane: usize| rollouts.get(lane).or(rollouts.last()).map_or(0.0, |r| r.parameters[k]);
            let value = Wide::from(std::array::from_fn(of_lane));
            match axis.target {
                Target::Field(field) => fields[field] = value,
                Target::Coordinate(at) => mover.q.entries_mut()[at] = value,
                Target::Speed(at) => mover.v.entries_mut()[at] = value,
            }
        }
        let mut preparation = Machine::new(&self.engine.preparation);
        preparation.inputs(0).copy_from_slice(&fields);
        preparation.run();
        let constant: Vec<Wide> =
            std::iter::once(Wide::from(0.0)).chain(fields).chain(preparation.results()).collect();
        for machine in std::iter::once(&mut mover.flow.acceleration).chain(&mut mover.energies) {
            machine.inputs(q + v).copy_from_slice(&constant);
        }
        mover
    }
}

/// Rollouts on their way.
struct Mover<'e> {
    flow: Unforced<'e>,
    energies: [Machine<'e, Wide>; 3],
    q: Row,
    v: Row,
}

/// Robots in lanes that nothing drives.
struct Unforced<'e> {
    links: &'e Links,
    acceleration: Machine<'e, Wide>,
    shelf: Shelf,
}

impl Flow for Unforced<'_> {
    type Scalar = Wide;
    type Position = Row;
    type Velocity = Row;

    fn integrate(&self, q: &Row, delta: &Row) -> Row {
        let mut moved = q.clone();
        self.links.integrate(moved.entries_mut(), delta.entries());
        moved
    }

    fn rate(&self, delta: &Row, v: &Row) -> Row {
        let mut rate = v.clone();
        self.links.rate(delta.entries(), rate.entries_mut());
        rate
    }

    fn acceleration(&mut self, _time: Wide, q: &Row, v: &Row) -> Row {
        load(&mut self.acceleration, q.entries(), v.entries());
        self.acceleration.run();
        self.shelf.row(self.acceleration.results())
    }
}

impl<'e> Mover<'e> {
    /// At a position, with a velocity.
    fn new(engine: &'e Engine, q: &[f64], v: &[f64]) -> Self {
        let shelf = Shelf::default();
        let row = |numbers: &[f64]| shelf.row(numbers.iter().map(|&x| Wide::from(x)));
        let (q, v) = (row(q), row(v));
        let acceleration = Machine::new(&engine.acceleration);
        Self {
            flow: Unforced { links: &engine.links, acceleration, shelf },
            energies: engine.energies.each_ref().map(Machine::new),
            q,
            v,
        }
    }

    fn step(&mut self, method: FixedStep, time: f64, step: f64) {
        let from = (&self.q, &self.v);
        (self.q, self.v) = method.follow(&mut self.flow, Wide::from(time), from, Wide::from(step));
    }

    /// Notes which rollouts are no longer finite; they were so at `before`.
    fn note_losses(&self, before: f64, rollouts: &mut [Rollout]) {
        // Zero where all is finite, else not a number.
        let nothing = self
            .q
            .entries()
            .iter()
            .chain(self.v.entries())
            .fold(Wide::from(0.0), |sum, x| sum + *x * Wide::from(0.0));
        let nothing = nothing.to_array();
        if nothing.iter().all(|x| x.is_finite()) {
            return;
        }
        for (rollout, nothing) in rollouts.iter_mut().zip(nothing) {
            if !nothing.is_finite() && rollout.lost.is_none() {
                rollout.lost = Some(before);
            }
        }
    }

    /// Adds a sample to each rollout that is not lost. One whose energy is not finite is lost.
    fn sample(&mut self, time: f64, rollouts: &mut [Rollout]) {
        let energies = self.energies.each_mut().map(|machine| {
            load(machine, self.q.entries(), self.v.entries());
            machine.run();
            machine.results().next().unwrap_or(Wide::from(0.0))
        });
        let total = energies[0] + energies[1] + energies[2];
        let numbers: Vec<[f64; LANES]> = std::iter::once(Wide::from(time))
            .chain(self.q.entries().iter().copied())
            .chain(self.v.entries().iter().copied())
            .chain(energies)
            .chain([total])
            .map(Wide::to_array)
            .collect();
        for (lane, rollout) in rollouts.iter_mut().enumerate().filter(|(_, rollout)| rollout.lost.is_none()) {
            let length = rollout.samples.len();
            rollout.samples.extend(numbers.iter().map(|lanes| lanes[lane] + 0.0)); // no negative zeros
            if !rollout.samples[length..].iter().all(|x| x.is_finite()) {
                rollout.samples.truncate(length);
                rollout.lost = Some(rollout.samples.chunks(numbers.len()).last().map_or(0.0, |row| row[0]));
            }
        }
    }
}

/// Puts coordinates and speeds in their registers.
fn load(machine: &mut Machine<'_, Wide>, q: &[Wide], v: &[Wide]) {
    let inputs = machine.inputs(0);
    inputs[..q.len()].copy_from_slice(q);
    inputs[q.len()..q.len() + v.len()].copy_from_slice(v);
}
