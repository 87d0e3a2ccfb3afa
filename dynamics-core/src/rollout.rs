//! Rollouts: a robot, or a thousand versions of it, let go from a thousand states, in [lanes](crate::lanes) and with
//! feature `rayon` on all cores.
//!
//! What the rollouts differ in comes in slices, as in a [batch](crate::batch); a closure makes a [`Rollout`] of it, of
//! as many as there are lanes; samples go to a slice. Each rollout has the bits that a [`Simulation`](crate::Simulation)
//! of it alone has, however wide the lanes are, however many rollouts there are, and on however many threads. One that
//! is lost in infinities leaves its neighbours alone, and says until when it was sound.
//!
#![cfg_attr(feature = "derive", doc = "```")]
#![cfg_attr(not(feature = "derive"), doc = "```ignore")]
//! use dynamics_core::lanes::Native;
//! use dynamics_core::prelude::*;
//!
//! #[derive(Dynamics)]
//! #[joint(shoulder: revolute(y), world -> upper, damping = friction)]
//! #[body(upper, solid = rod(2, 0.5, z), com = [0, 0, -0.25])]
//! #[joint(elbow: revolute(y), upper -> lower, at = [0, 0, -0.5], damping = friction)]
//! #[body(lower, solid = rod(1, 0.4, z), com = [0, 0, -0.2])]
//! #[joint(wrist: fixed, lower -> load, at = [0, 0, -0.4])]
//! #[body(load, solid = point(payload))]
//! struct Arm<T> { friction: T, payload: T }
//!
//! // Four seconds in steps of a millisecond; a sample every second.
//! let rollouts = Rollouts::new(1e-3, 4000)?.every(1000);
//! let start = State::rest(SVector::from([0.8, 0.4]));
//! let starts = vec![start; 100];
//! let payloads: Vec<f64> = (0..100).map(|k| 0.02 * f64::from(k)).collect();
//!
//! let mut samples = vec![start; 100 * rollouts.samples()]; // those of the first rollout, those of the second, …
//! let mut sound = vec![0.0; 100];
//! rollouts.run((&starts, &payloads), &mut samples, &mut sound, |(start, payload)| {
//!     let arm = Arm { friction: 0.1.into(), payload };
//!     let spring = Native::<f64>::from(-5.0); // the same in all lanes
//!     Rollout::new(arm, start).with_input(move |_time, state| state.q * spring)
//! })?;
//! assert!(sound.iter().all(|time| *time == sound[0]), "none is lost");
//!
//! let arm = Arm { friction: 0.1, payload: payloads[42] };
//! let mut alone = Simulation::new(&arm, start, 1e-3)?.with_input(|_, state| state.q * -5.0);
//! let end = alone.steps(4000).last().expect("there are steps")?;
//! assert_eq!(samples[42 * rollouts.samples() + 3], end.state); // to the last bit
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! What else is wanted of a rollout, an observer computes; it is called after every step, so that it may add up, and
//! what it returns at a sample is the sample:
//!
#![cfg_attr(feature = "derive", doc = "```")]
#![cfg_attr(not(feature = "derive"), doc = "```ignore")]
//! # use dynamics_core::lanes::Native;
//! # use dynamics_core::prelude::*;
//! # #[derive(Dynamics)]
//! # #[joint(hinge: revolute(y), world -> rod, damping = c)]
//! # #[body(rod, com = [0, 0, -0.5], solid = rod(2, 1, z))]
//! # struct Pendulum<T> { c: T }
//! let rollouts = Rollouts::new(1e-3, 2000)?;
//! let dampings = [0.0, 0.1, 0.2, 0.3];
//! let mut lost = [(0.0_f64, 0.0_f64); 4]; // of each, the energy it has lost, and what its damper took, J
//! rollouts.run(&dampings, &mut lost, &mut [0.0; 4], |c| {
//!     let start = State::rest(SVector::from([Native::<f64>::from(1.0)]));
//!     let pendulum = Pendulum { c };
//!     let energy = pendulum.total_energy(&start.q, &start.v);
//!     let (step, mut taken) = (Native::<f64>::from(1e-3), 0.0.into());
//!     Rollout::new(pendulum, start).with_observer(move |now| {
//!         taken += c * now.state.v[0] * now.state.v[0] * step;
//!         (energy - now.robot.total_energy(&now.state.q, &now.state.v), taken)
//!     })
//! })?;
//! assert!(lost.iter().all(|(energy, taken)| (energy - taken).abs() < 1e-2));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod block;
mod error;
#[cfg(feature = "rayon")]
mod parallel;
mod single;

pub use error::RolloutError;
pub use single::{Moment, Rollout, StateOf};

use core::marker::PhantomData;

use nalgebra::SVector;

use crate::batch::{Pack, States};
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::lanes::{Element, Lanes, Native};
use crate::simulate::{Explicit, Rk4};
use crate::state::{Configuration, State};

/// How rollouts are computed: in which steps, how many, and which of them are samples.
#[derive(Clone, Copy, Debug)]
pub struct Rollouts<T, L = Native<T>, I = Rk4> {
    step: T,
    steps: usize,
    every: usize,
    integrator: I,
    lanes: PhantomData<fn() -> L>,
}

impl<T: Element + PartialOrd> Rollouts<T> {
    /// Rollouts of so many steps of `step` seconds, by [`Rk4`], in lanes as wide as the target's registers. Their one
    /// sample is at the end.
    ///
    /// # Errors
    ///
    /// [`Error::StepNotPositive`].
    pub fn new(step: T, steps: usize) -> Result<Self, Error> {
        let positive = step > T::zero() && step.is_finite();
        if !positive {
            return Err(Error::StepNotPositive);
        }
        Ok(Self { step, steps, every: usize::MAX, integrator: Rk4, lanes: PhantomData })
    }
}

impl<T: Element, L, I> Rollouts<T, L, I> {
    /// With a sample after every so many steps, and after the last one; 0 is taken for 1.
    #[must_use]
    pub fn every(self, every: usize) -> Self {
        Self { every: every.max(1), ..self }
    }

    /// The same rollouts by another integrator.
    #[must_use]
    pub fn with_integrator<J: Explicit>(self, integrator: J) -> Rollouts<T, L, J> {
        let Self { step, steps, every, lanes, .. } = self;
        Rollouts { step, steps, every, integrator, lanes }
    }

    /// The same rollouts in lanes of the type `M`: `rollouts.in_lanes::<f64x4>()`.
    #[must_use]
    pub fn in_lanes<M: Lanes<Element = T>>(self) -> Rollouts<T, M, I> {
        let Self { step, steps, every, integrator, .. } = self;
        Rollouts { step, steps, every, integrator, lanes: PhantomData }
    }

    /// How many samples a rollout has.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.steps.div_ceil(self.every)
    }

    /// The times of the samples, in s.
    pub fn times(&self) -> impl Iterator<Item = T> {
        let mut clock = block::Clock::new(self.step);
        (1..=self.steps).filter_map(move |k| {
            clock.tick();
            self.is_sample(k).then_some(clock.time)
        })
    }

    fn is_sample(&self, step: usize) -> bool {
        step == self.steps || step.is_multiple_of(self.every)
    }
}

impl<T: Element, L: Lanes<Element = T>, I: Explicit> Rollouts<T, L, I> {
    /// Computes all rollouts on this thread.
    ///
    /// `given` is what they differ in, a slice or a tuple of slices as in [`batch::map`](crate::batch::map); `rollout`
    /// makes of it, in lanes, a robot and a state to start from.
    ///
    /// | | |
    /// |---|---|
    /// | `samples` | those of the first rollout, those of the second, and so on: [`samples`](Self::samples) of each |
    /// | `sound` | of each rollout the time of its last finite state, in s: that of the end if it was not lost |
    ///
    /// A sample later than that time has no meaning.
    ///
    /// # Errors
    ///
    /// [`RolloutError`], if a slice has another length, or a state to start from is not one; the first such rollout is
    /// named, and nothing is written.
    ///
    /// # Cost
    ///
    /// `rollout` is called twice for as many rollouts as there are lanes, the observer after each step. No heap.
    pub fn run<G, O, R, U, W, const NQ: usize, const NV: usize>(
        &self,
        given: G,
        samples: &mut [O],
        sound: &mut [T],
        rollout: impl Fn(G::Packed<L>) -> Rollout<R, L, NQ, NV, U, W>,
    ) -> Result<(), RolloutError>
    where
        G: States<Element = T>,
        O: Pack<Element = T>,
        R: Dynamics<L, NQ, NV> + Configuration<L, NQ, NV>,
        U: FnMut(L, &State<L, NQ, NV>) -> SVector<L, NV>,
        W: FnMut(&Moment<'_, R, L, NQ, NV>) -> O::Packed<L>,
    {
        self.check_lengths(given, samples.len(), sound.len())?;
        self.check_starts(given, sound.len(), &rollout)?;
        self.blocks(given, 0, samples, sound, &rollout);
        Ok(())
    }

    fn check_lengths<G: States<Element = T>>(
        &self,
        given: G,
        samples: usize,
        rollouts: usize,
    ) -> Result<(), RolloutError> {
        given.check_length(rollouts).map_err(RolloutError::Given)?;
        let needed = rollouts.saturating_mul(self.samples());
        if samples == needed { Ok(()) } else { Err(RolloutError::Samples { found: samples, needed }) }
    }
}
