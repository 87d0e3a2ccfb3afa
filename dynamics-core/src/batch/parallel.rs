//! A batch over all cores.

use rayon::prelude::*;

use super::{Pack, States, blocks};
use crate::error::Error;
use crate::lanes::{Lanes, Native};

/// So many blocks of lanes are one task: some ten microseconds of work, beside which handing it over is little.
const BLOCKS: usize = 64;

/// [`map`](super::map) on all cores, by the thread pool of the crate `rayon`; the same bits, however many there are.
///
/// Allocates where `rayon` does, which is once for the pool, and panics if it cannot start its threads.
///
/// # Errors
///
/// Those of [`map`](super::map).
pub fn par_map<I, O>(
    states: I,
    results: &mut [O],
    f: impl Fn(I::Packed<Native<I::Element>>) -> O::Packed<Native<I::Element>> + Sync,
) -> Result<(), Error>
where
    I: States + Send + Sync,
    O: Pack<Element = I::Element> + Send,
{
    par_map_in::<Native<I::Element>, I, O>(states, results, f)
}

/// [`par_map`], in lanes of the type `L`.
///
/// # Errors
///
/// Those of [`map`](super::map).
pub fn par_map_in<L, I, O>(
    states: I,
    results: &mut [O],
    f: impl Fn(I::Packed<L>) -> O::Packed<L> + Sync,
) -> Result<(), Error>
where
    L: Lanes,
    I: States<Element = L::Element> + Send + Sync,
    O: Pack<Element = L::Element> + Send,
{
    states.check_length(results.len())?;
    let task = BLOCKS * L::COUNT;
    results.par_chunks_mut(task).enumerate().for_each(|(k, results)| {
        blocks::<L, I, O>(states, k * task, results, &mut &f);
    });
    Ok(())
}
