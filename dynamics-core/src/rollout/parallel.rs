//! Rollouts over all cores.

use nalgebra::SVector;
use rayon::prelude::*;

use super::{Moment, Rollout, RolloutError, Rollouts};
use crate::batch::{Pack, States};
use crate::dynamics::Dynamics;
use crate::lanes::{Element, Lanes};
use crate::simulate::Explicit;
use crate::state::{Configuration, State};

/// A task has at least so many steps of a block: a millisecond or so, beside which handing it over is little.
const STEPS: usize = 2000;

impl<T: Element + Send + Sync, L: Lanes<Element = T>, I: Explicit + Sync> Rollouts<T, L, I> {
    /// [`run`](Self::run) on all cores, by the thread pool of the crate `rayon`; the same bits, however many there are.
    ///
    /// Allocates where `rayon` does, which is once for the pool, and panics if it cannot start its threads.
    ///
    /// # Errors
    ///
    /// Those of [`run`](Self::run).
    pub fn par_run<G, O, R, U, W, const NQ: usize, const NV: usize>(
        &self,
        given: G,
        samples: &mut [O],
        sound: &mut [T],
        rollout: impl Fn(G::Packed<L>) -> Rollout<R, L, NQ, NV, U, W> + Sync,
    ) -> Result<(), RolloutError>
    where
        G: States<Element = T> + Send + Sync,
        O: Pack<Element = T> + Send,
        R: Dynamics<L, NQ, NV> + Configuration<L, NQ, NV>,
        U: FnMut(L, &State<L, NQ, NV>) -> SVector<L, NV>,
        W: FnMut(&Moment<'_, R, L, NQ, NV>) -> O::Packed<L>,
    {
        self.check_lengths(given, samples.len(), sound.len())?;
        self.check_starts(given, sound.len(), &rollout)?;
        let task = L::COUNT * (STEPS / self.steps.max(1)).max(1);
        if self.samples() == 0 {
            self.blocks(given, 0, samples, sound, &rollout);
            return Ok(());
        }
        let samples = samples.par_chunks_mut(task * self.samples());
        samples.zip(sound.par_chunks_mut(task)).enumerate().for_each(|(k, (samples, sound))| {
            self.blocks(given, k * task, samples, sound, &rollout);
        });
        Ok(())
    }
}
