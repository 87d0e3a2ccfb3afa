//! Why rollouts were not begun.

use core::fmt;

use crate::error::Error;

/// Why rollouts were not begun. That one is lost on the way is no error: its time tells.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum RolloutError {
    /// A slice of what is given is not as long as that of the times: [`Error::BatchLength`].
    Given(Error),
    /// The slice of the samples has another length than so many rollouts need.
    Samples {
        /// The length it has.
        found: usize,
        /// The rollouts times the samples of each.
        needed: usize,
    },
    /// The state that a rollout starts from is not finite, or has a quaternion that is no rotation.
    Start {
        /// Which rollout, counted from 0.
        rollout: usize,
        /// What is wrong with its state.
        error: Error,
    },
}

impl fmt::Display for RolloutError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Given(error) => error.fmt(f),
            Self::Samples { found, needed } => {
                write!(f, "there is room for {found} samples, and the rollouts have {needed}")
            }
            Self::Start { rollout, error } => write!(f, "the start of rollout {rollout}: {error}"),
        }
    }
}

impl core::error::Error for RolloutError {}
