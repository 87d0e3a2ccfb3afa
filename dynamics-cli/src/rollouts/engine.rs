//! Rollouts in lanes: as many at a time as there are lanes, each step by the tapes of the robot's programs.

use dynamics_codegen::mechanics::equations::{Argument, Input, Method};
use dynamics_codegen::model::Motion;
use dynamics_codegen::passes::Program;
use dynamics_core::__private::{integrate_ball, integrate_free};
use dynamics_core::lanes::{Lanes, f64x8};

use super::study::{Study, Target};
use super::tape::{Machine, Tape};
use crate::failure::{Failure, Problem};
use crate::robot::Robot;
use crate::simulate::Clock;

/// So many rollouts are computed at a time.
pub(super) type Wide = f64x8;
pub(super) const LANES: usize = Wide::COUNT;

/// How a step is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Integrator {
    /// The classical method of Runge and Kutta, of order 4
    Rk4,
    /// The semi-implicit method of Euler, of order 1
    Euler,
}

/// A robot's programs as tapes.
pub(super) struct Engine {
    preparation: Tape,
    acceleration: Tape,
    energies: [Tape; 3],
    /// How each link moves, and the first of its coordinates and of its speeds.
    links: Vec<(Motion, usize, usize)>,
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
            links: robot.tree.links.iter().map(|link| (link.motion, link.drive.q, link.drive.v)).collect(),
            sizes,
        })
    }

    /// How many numbers a sample has: its time, coordinates, speeds, three energies and their sum.
    pub(super) fn width(&self) -> usize {
        1 + self.sizes.q + self.sizes.v + 4
    }

    /// `q ⊕ δ`, as `Configuration::integrate`, to `moved`.
    fn integrate(&self, q: &[Wide], delta: &[Wide], moved: &mut [Wide]) {
        for &(motion, at, from) in &self.links {
            match motion {
                // Several links may share a coordinate.
                Motion::Revolute | Motion::Prismatic => moved[at] = q[at] + delta[from],
                Motion::Ball => {
                    let ball = integrate_ball(part::<4>(q, at), part::<3>(delta, from));
                    moved[at..at + 4].copy_from_slice(&ball);
                }
                Motion::Free => {
                    let free = integrate_free(part::<7>(q, at), part::<6>(delta, from));
                    moved[at..at + 7].copy_from_slice(&free);
                }
            }
        }
    }
}

fn part<const N: usize>(x: &[Wide], from: usize) -> [Wide; N] {
    std::array::from_fn(|k| x[from + k])
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
    pub(super) integrator: Integrator,
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
            match self.integrator {
                Integrator::Rk4 => mover.rk4(now - before),
                Integrator::Euler => mover.euler(now - before),
            }
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
        let mut mover = Mover::new(self.engine);
        let splat = |numbers: &[f64]| numbers.iter().map(|&x| Wide::from(x)).collect::<Vec<_>>();
        (mover.q, mover.v) = (splat(self.start.0), splat(self.start.1));
        let mut fields = vec![Wide::from(0.0); parameters];
        for (k, axis) in self.study.axes.iter().enumerate() {
            let of_lane =
                |lane: usize| rollouts.get(lane).or(rollouts.last()).map_or(0.0, |r| r.parameters[k]);
            let value = Wide::from(std::array::from_fn(of_lane));
            match axis.target {
                Target::Field(field) => fields[field] = value,
                Target::Coordinate(at) => mover.q[at] = value,
                Target::Speed(at) => mover.v[at] = value,
            }
        }
        let mut preparation = Machine::new(&self.engine.preparation);
        preparation.inputs(0).copy_from_slice(&fields);
        preparation.run();
        let constant: Vec<Wide> =
            std::iter::once(Wide::from(0.0)).chain(fields).chain(preparation.results()).collect();
        for machine in std::iter::once(&mut mover.acceleration).chain(&mut mover.energies) {
            machine.inputs(q + v).copy_from_slice(&constant);
        }
        mover
    }
}

/// Rollouts on their way.
struct Mover<'e> {
    engine: &'e Engine,
    acceleration: Machine<'e, Wide>,
    energies: [Machine<'e, Wide>; 3],
    q: Vec<Wide>,
    v: Vec<Wide>,
    /// Room for stages: configurations, and vectors of speeds.
    configurations: [Vec<Wide>; 3],
    speeds: [Vec<Wide>; 8],
}

impl<'e> Mover<'e> {
    fn new(engine: &'e Engine) -> Self {
        let zeros = |length: usize| vec![Wide::from(0.0); length];
        let Sizes { q, v, .. } = engine.sizes;
        Self {
            engine,
            acceleration: Machine::new(&engine.acceleration),
            energies: engine.energies.each_ref().map(Machine::new),
            q: zeros(q),
            v: zeros(v),
            configurations: std::array::from_fn(|_| zeros(q)),
            speeds: std::array::from_fn(|_| zeros(v)),
        }
    }

    /// `q̇ = v`, `v̇ = a` by `dynamics_core`'s `SemiImplicitEuler`.
    fn euler(&mut self, h: f64) {
        let h = Wide::from(h);
        let Self { engine, acceleration, q, v, configurations: [moved, ..], speeds: [a, delta, ..], .. } =
            self;
        accelerate(acceleration, q, v, a);
        for ((v, a), delta) in v.iter_mut().zip(&*a).zip(&mut *delta) {
            *v += *a * h;
            *delta = *v * h;
        }
        engine.integrate(q, delta, moved);
        std::mem::swap(q, moved);
    }

    /// The same by its `Rk4`: the classical method of Runge and Kutta, with two `⊕` where on a manifold one would lose
    /// order (Celledoni, Marthinsen, Owren 2003).
    fn rk4(&mut self, h: f64) {
        let [half, sixth, twelfth] = [0.5, 1.0 / 6.0, 1.0 / 12.0].map(|part| Wide::from(h * part));
        let [one, two, three] = [1.0, 2.0, 3.0].map(Wide::from);
        let h = Wide::from(h);
        let Self { engine, acceleration, q, v, configurations, speeds, .. } = self;
        let [q2, q3, q4] = configurations;
        let [a1, a2, a3, a4, v2, v3, v4, delta] = speeds;
        accelerate(acceleration, q, v, a1);
        set(v2, |k| v[k] + a1[k] * half);
        set(delta, |k| v[k] * half);
        engine.integrate(q, delta, q2);
        accelerate(acceleration, q2, v2, a2);
        set(v3, |k| v[k] + a2[k] * half);
        set(delta, |k| v2[k] * half);
        engine.integrate(q, delta, q3);
        accelerate(acceleration, q3, v3, a3);
        set(v4, |k| v[k] + a3[k] * h);
        set(delta, |k| v3[k] * h - v[k] * half);
        engine.integrate(q2, delta, q4);
        accelerate(acceleration, q4, v4, a4);
        let middle = |k: usize| (v2[k] + v3[k]) * two;
        set(delta, |k| (v[k] * three + middle(k) - v4[k] * one) * twelfth);
        engine.integrate(q, delta, q2);
        set(delta, |k| (v4[k] * three + middle(k) - v[k] * one) * twelfth);
        engine.integrate(q2, delta, q);
        for (k, v) in v.iter_mut().enumerate() {
            *v += (a1[k] + (a2[k] + a3[k]) * two + a4[k]) * sixth;
        }
    }

    /// Notes which rollouts are no longer finite; they were so at `before`.
    fn note_losses(&self, before: f64, rollouts: &mut [Rollout]) {
        // Zero where all is finite, else not a number.
        let nothing = self.q.iter().chain(&self.v).fold(Wide::from(0.0), |sum, x| sum + *x * Wide::from(0.0));
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
            load(machine, &self.q, &self.v);
            machine.run();
            machine.results().next().unwrap_or(Wide::from(0.0))
        });
        let total = energies[0] + energies[1] + energies[2];
        let numbers: Vec<[f64; LANES]> = std::iter::once(Wide::from(time))
            .chain(self.q.iter().copied())
            .chain(self.v.iter().copied())
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

fn accelerate(machine: &mut Machine<'_, Wide>, q: &[Wide], v: &[Wide], a: &mut [Wide]) {
    load(machine, q, v);
    machine.run();
    a.iter_mut().zip(machine.results()).for_each(|(a, result)| *a = result);
}

fn set(x: &mut [Wide], f: impl Fn(usize) -> Wide) {
    x.iter_mut().enumerate().for_each(|(k, x)| *x = f(k));
}
