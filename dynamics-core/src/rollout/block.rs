//! Rollouts in blocks of as many as there are lanes.

use nalgebra::SVector;

use super::{Moment, Rollout, RolloutError, Rollouts};
use crate::batch::{Pack, States};
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::lanes::{Element, Lanes};
use crate::scalar::Scalar;
use crate::simulate::Explicit;
use crate::state::{Configuration, State};

/// The most lanes that there are.
const MOST_LANES: usize = 16;

/// Time in steps, summed as a [`Simulation`](crate::Simulation) sums it (W. Kahan), so that inputs are of one time.
#[derive(Clone, Copy)]
pub(super) struct Clock<T> {
    step: T,
    pub(super) time: T,
    error: T,
}

impl<T: Scalar> Clock<T> {
    pub(super) fn new(step: T) -> Self {
        Self { step, time: T::zero(), error: T::zero() }
    }

    pub(super) fn tick(&mut self) {
        let step = self.step - self.error;
        let time = self.time + step;
        self.error = (time - self.time) - step;
        self.time = time;
    }
}

/// Which rollouts of a block are lost, and until when each is sound.
struct Soundness<'t, T> {
    is_lost: [bool; MOST_LANES],
    sound: &'t mut [T],
}

impl<T: Element> Soundness<'_, T> {
    /// Goes on to `time`, at which the lanes are in `state`.
    #[inline(always)]
    fn note<L: Lanes<Element = T>, const NQ: usize, const NV: usize>(
        &mut self,
        state: &State<L, NQ, NV>,
        time: T,
    ) {
        // Zero where all is finite, else not a number.
        let nothing = state.q.iter().chain(state.v.iter()).fold(L::zero(), |sum, x| sum + *x * L::zero());
        if nothing.is_finite() {
            let unlost = self.sound.iter_mut().zip(&self.is_lost).filter(|(_, is_lost)| !**is_lost);
            unlost.for_each(|(sound, _)| *sound = time);
            return;
        }
        let mut of_lanes = [T::zero(); MOST_LANES];
        L::scatter(&[nothing], &mut of_lanes, core::array::from_mut);
        for ((sound, is_lost), nothing) in self.sound.iter_mut().zip(&mut self.is_lost).zip(of_lanes) {
            *is_lost |= !nothing.is_finite();
            if !*is_lost {
                *sound = time;
            }
        }
    }
}

impl<T: Element, L: Lanes<Element = T>, I: Explicit> Rollouts<T, L, I> {
    /// `Ok` if so many rollouts start from states.
    pub(super) fn check_starts<G, R, U, W, const NQ: usize, const NV: usize>(
        &self,
        given: G,
        count: usize,
        rollout: &impl Fn(G::Packed<L>) -> Rollout<R, L, NQ, NV, U, W>,
    ) -> Result<(), RolloutError>
    where
        G: States<Element = T>,
        R: Dynamics<L, NQ, NV>,
    {
        let check = |first: usize, count: usize| -> Result<(), Error> {
            let Rollout { robot, start, .. } = rollout(given.pack::<L>(first, count));
            start.check()?;
            robot.check_configuration(&start.q)
        };
        for block in (0..count).step_by(L::COUNT) {
            let here = L::COUNT.min(count - block);
            if check(block, here).is_err() {
                // One alone fills all lanes.
                for k in block..block + here {
                    check(k, 1).map_err(|error| RolloutError::Start { rollout: k, error })?;
                }
            }
        }
        Ok(())
    }

    /// The rollouts from the `first` on, as many as there are times.
    #[inline(always)]
    pub(super) fn blocks<G, O, R, U, W, const NQ: usize, const NV: usize>(
        &self,
        given: G,
        first: usize,
        samples: &mut [O],
        sound: &mut [T],
        rollout: &impl Fn(G::Packed<L>) -> Rollout<R, L, NQ, NV, U, W>,
    ) where
        G: States<Element = T>,
        O: Pack<Element = T>,
        R: Dynamics<L, NQ, NV> + Configuration<L, NQ, NV>,
        U: FnMut(L, &State<L, NQ, NV>) -> SVector<L, NV>,
        W: FnMut(&Moment<'_, R, L, NQ, NV>) -> O::Packed<L>,
    {
        let mut samples = samples;
        for (block, sound) in sound.chunks_mut(L::COUNT).enumerate() {
            let given = given.pack::<L>(first + block * L::COUNT, sound.len());
            let here = (sound.len() * self.samples()).min(samples.len());
            let (of_block, rest) = samples.split_at_mut(here);
            samples = rest;
            self.block(rollout(given), of_block, sound);
        }
    }

    /// The rollouts of one block.
    fn block<O, R, U, W, const NQ: usize, const NV: usize>(
        &self,
        rollout: Rollout<R, L, NQ, NV, U, W>,
        samples: &mut [O],
        sound: &mut [T],
    ) where
        O: Pack<Element = T>,
        R: Dynamics<L, NQ, NV> + Configuration<L, NQ, NV>,
        U: FnMut(L, &State<L, NQ, NV>) -> SVector<L, NV>,
        W: FnMut(&Moment<'_, R, L, NQ, NV>) -> O::Packed<L>,
    {
        const { assert!(L::COUNT <= MOST_LANES) };
        let Rollout { robot, start: mut state, mut input, mut observer } = rollout;
        let mut rows: [&mut [O]; MOST_LANES] = core::array::from_fn(|_| &mut [][..]);
        let lanes = sound.len().min(MOST_LANES);
        for (row, samples) in rows.iter_mut().zip(samples.chunks_mut(self.samples().max(1))) {
            *row = samples;
        }
        let mut soundness = Soundness { is_lost: [false; MOST_LANES], sound };
        let mut clock = Clock::new(self.step);
        soundness.note(&state, clock.time);
        let mut sample = 0;
        for k in 1..=self.steps {
            let time = L::from(clock.time);
            state = self.integrator.next(&robot, time, &state, L::from(self.step), &mut input);
            clock.tick();
            soundness.note(&state, clock.time);
            let is_sample = self.is_sample(k);
            let moment = Moment { time: L::from(clock.time), state, robot: &robot, is_sample };
            let seen = observer(&moment);
            if is_sample {
                unpack_at::<L, O>(&seen, &mut rows[..lanes], sample);
                sample += 1;
            }
        }
    }
}

/// Writes what was seen of each lane to the place `sample` of its row.
#[inline(always)]
fn unpack_at<L: Lanes, O: Pack<Element = L::Element>>(
    seen: &O::Packed<L>,
    rows: &mut [&mut [O]],
    sample: usize,
) {
    O::unpack::<L, _>(seen, rows, |row| &mut row[sample]);
}
