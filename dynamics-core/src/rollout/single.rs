//! One rollout of lanes: what moves, what drives it, and what is kept of it.

use nalgebra::SVector;

use crate::lanes::Lanes;
use crate::simulate::Unforced;
use crate::state::State;

/// The type of the observer that keeps the state, which a [`Rollout`] has until it is given another.
pub type StateOf<R, L, const NQ: usize, const NV: usize> =
    for<'m, 'r> fn(&'m Moment<'r, R, L, NQ, NV>) -> State<L, NQ, NV>;

/// As many rollouts as there are lanes: a robot, a state to start from, what drives it, and what is kept of it.
pub struct Rollout<R, L, const NQ: usize, const NV: usize, U = Unforced<L, NQ, NV>, W = StateOf<R, L, NQ, NV>>
{
    pub(super) robot: R,
    pub(super) start: State<L, NQ, NV>,
    pub(super) input: U,
    pub(super) observer: W,
}

/// The end of a step.
pub struct Moment<'r, R, L, const NQ: usize, const NV: usize> {
    /// The time since the start, in s, the same in all lanes.
    pub time: L,
    /// The state at that time.
    pub state: State<L, NQ, NV>,
    /// The robot.
    pub robot: &'r R,
    /// Whether what the observer returns is kept; else it need not compute it.
    pub is_sample: bool,
}

impl<R, L: Lanes, const NQ: usize, const NV: usize> Rollout<R, L, NQ, NV> {
    /// A robot that starts from a state, without joint forces; what is kept is its state.
    pub fn new(robot: R, start: State<L, NQ, NV>) -> Self {
        Self { robot, start, input: |_, _| SVector::zeros(), observer: |now| now.state }
    }
}

impl<R, L: Lanes, const NQ: usize, const NV: usize, U, W> Rollout<R, L, NQ, NV, U, W> {
    /// The same under the joint forces `τ = input(time, state)`, in N·m or N.
    pub fn with_input<V>(self, input: V) -> Rollout<R, L, NQ, NV, V, W>
    where
        V: FnMut(L, &State<L, NQ, NV>) -> SVector<L, NV>,
    {
        let Self { robot, start, observer, .. } = self;
        Rollout { robot, start, input, observer }
    }

    /// The same with `observer(moment)` kept of each sample. It is called after every step.
    pub fn with_observer<V, P>(self, observer: V) -> Rollout<R, L, NQ, NV, U, V>
    where
        V: FnMut(&Moment<'_, R, L, NQ, NV>) -> P,
    {
        let Self { robot, start, input, .. } = self;
        Rollout { robot, start, input, observer }
    }
}
