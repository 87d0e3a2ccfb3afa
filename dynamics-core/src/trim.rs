//! Equilibria and steady motions: states that a constant input holds, under constraints.
//!
//! Of `M(q)·a + C(q,v)·v + G(q) + passive forces = B_u·u` some of `q`, `v`, `a` and `u` are given and some are looked for;
//! besides, outputs may be given values. That is as many equations as there are joints and constraints, and as many
//! unknowns as are left free: there may be one solution, a family of them, or none.
//!
//! # Example
//!
//! ```
//! # use dynamics_core::prelude::*;
//! # fn hold<R, Tool0>(robot: &R) -> Result<(), Error>
//! # where R: StateSpaceModel<f64, 2, 2, 4, 2> + Mechanism, Tool0: Frame<R, f64, 2, 2> {
//! // Where do the joints hold the tool half a metre above the ground, and with which torques?
//! let guess = State::rest(SVector::from([0.3, -0.5]));
//! let held = Trim::new(robot, guess)
//!     .subject_to(output::position::<Tool0>().z(), SVector::from([0.5]))
//!     .solve()?;
//! let plant = robot.linearize(&held.state.q, &held.state.v, &held.u); // its drift is zero
//! # let _ = plant;
//!
//! // What does it take to turn on and on, at two radians per second?
//! let turning = Trim::new(robot, State::new(SVector::from([0.0, 1.2]), SVector::from([2.0, 0.0])));
//! match turning.hold_positions().solve() {
//!     Ok(steady) => println!("by {}; it lasts if this is zero: {}", steady.u, steady.jerk(robot)),
//!     Err(failure) => println!("{failure}"),
//! }
//! # Ok(()) }
//! ```
//!
//! # Method
//!
//! Least squares by Levenberg's and Marquardt's steps, in the tangent space of the configuration, with exact derivatives:
//! those of inverse dynamics and of the outputs. Each step is solved by Givens rotations, row by row. Forces are weighed
//! by the largest of the robot at the guess, outputs by the size of their targets. Where solutions are a family, what
//! comes out is one near the guess.
//!
//! # Source
//!
//! B. Stevens, F. Lewis, E. Johnson, *Aircraft Control and Simulation*, 3rd ed., Wiley 2016, §3.6, for trim as
//! minimisation; J. Moré, *The Levenberg–Marquardt algorithm: implementation and theory*, Lecture Notes in Mathematics
//! 630, Springer 1978; G. Golub, C. Van Loan, *Matrix Computations*, 4th ed. 2013, §5.1.8 and §6.5 for rotations that
//! take in a row.

mod failure;
mod problem;
mod search;
mod unknowns;

pub use failure::TrimFailure;

use nalgebra::SVector;

use crate::dynamics::{DynamicsDerivatives, ForwardDynamicsDerivatives};
use crate::error::Error;
use crate::linearize::StateSpaceModel;
use crate::mechanism::Mechanism;
use crate::output::{Output, Which};
use crate::product::product;
use crate::scalar::Scalar;
use crate::state::State;
use unknowns::Unknowns;

/// A search for an equilibrium or a steady motion, near a guess.
///
/// As made by [`new`](Self::new) it looks for the positions and inputs that keep the robot at rest: `q` and `u` are free,
/// `v` and `a` are held at the guess's speeds and at zero. Joints are named as in [`Mechanism`], or by their index.
#[derive(Clone, Copy, Debug)]
pub struct Trim<'r, R, T, const NQ: usize, const NV: usize, const NU: usize, O = (), const NC: usize = 0> {
    robot: &'r R,
    state: State<T, NQ, NV>,
    a: SVector<T, NV>,
    u: SVector<T, NU>,
    free: Unknowns<bool, NV, NU>,
    outputs: O,
    targets: SVector<T, NC>,
    iterations: usize,
    mistake: Option<Error>,
}

/// A state with its input, and how nearly the forces balance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trimmed<T, const NQ: usize, const NV: usize, const NU: usize> {
    /// The state.
    pub state: State<T, NQ, NV>,
    /// The acceleration: zero, unless it was asked for or left free.
    pub a: SVector<T, NV>,
    /// The input that holds it.
    pub u: SVector<T, NU>,
    /// The joint forces `τ = B_u·u`.
    pub tau: SVector<T, NV>,
    /// The forces `M·a + h − τ` that are left, in N and N·m.
    pub imbalance: SVector<T, NV>,
    /// The distance of the outputs from their targets, the root of the sum of squares.
    pub miss: T,
    /// How many steps it took.
    pub iterations: usize,
}

impl<T: Scalar, const NQ: usize, const NV: usize, const NU: usize> Trimmed<T, NQ, NV, NU> {
    /// The rate of the acceleration under a constant input, `∂a/∂q·v + ∂a/∂v·a`, NV.
    ///
    /// A motion with `a = 0` is steady if that is zero: it then goes on by itself. If not, forces balance for a moment.
    pub fn jerk<R>(&self, robot: &R) -> SVector<T, NV>
    where
        R: DynamicsDerivatives<T, NQ, NV> + ?Sized,
    {
        let State { q, v } = &self.state;
        let ForwardDynamicsDerivatives { da_dq, da_dv, .. } =
            robot.forward_dynamics_derivatives(q, v, &self.tau);
        product(&da_dq, v) + product(&da_dv, &self.a)
    }
}

impl<'r, R, T, const NQ: usize, const NV: usize, const NU: usize> Trim<'r, R, T, NQ, NV, NU>
where
    R: Mechanism,
    T: Scalar + PartialOrd,
{
    /// A search from `guess` on, with the input zero.
    pub fn new<const NX: usize>(robot: &'r R, guess: State<T, NQ, NV>) -> Self
    where
        R: StateSpaceModel<T, NQ, NV, NX, NU>,
    {
        Self {
            robot,
            state: guess,
            a: SVector::zeros(),
            u: SVector::zeros(),
            free: Unknowns { q: [true; NV], v: [false; NV], a: [false; NV], u: [true; NU] },
            outputs: (),
            targets: SVector::zeros(),
            iterations: 100,
            mistake: None,
        }
    }
}

impl<'r, R, T, O, const NQ: usize, const NV: usize, const NU: usize, const NC: usize>
    Trim<'r, R, T, NQ, NV, NU, O, NC>
where
    R: Mechanism,
    T: Scalar + PartialOrd,
{
    /// The same search with these outputs at these values.
    ///
    /// An [`orientation`](crate::output::orientation) is to be given what it is [from](crate::output::Orientation::from).
    #[must_use]
    pub fn subject_to<P, const ND: usize>(
        self,
        outputs: P,
        targets: SVector<T, ND>,
    ) -> Trim<'r, R, T, NQ, NV, NU, P, ND>
    where
        P: Output<R, T, NQ, NV>,
    {
        const { assert!(ND == P::ROWS, "there is one target for each row of the outputs") };
        let Self { robot, state, a, u, free, iterations, mistake, .. } = self;
        Trim { robot, state, a, u, free, outputs, targets, iterations, mistake }
    }

    /// The same search from the input `u` on.
    #[must_use]
    pub fn with_input(self, u: SVector<T, NU>) -> Self {
        Self { u, ..self }
    }

    /// The same search for a motion of the acceleration `a`, or from it on where it is free.
    #[must_use]
    pub fn with_acceleration(self, a: SVector<T, NV>) -> Self {
        Self { a, ..self }
    }

    /// The same search with at most so many steps; 100 as made.
    #[must_use]
    pub fn with_iterations(self, iterations: usize) -> Self {
        Self { iterations, ..self }
    }

    /// The same search with all positions as guessed.
    #[must_use]
    pub fn hold_positions(mut self) -> Self {
        self.free.q = [false; NV];
        self
    }

    /// The same search with one position as guessed; of a ball or free joint a displacement, such as `root_joint.rx`.
    #[must_use]
    pub fn hold_position(mut self, joint: impl Into<Which>) -> Self {
        self.mistake = self.mistake.or(set(&mut self.free.q, R::DISPLACEMENT_NAMES, joint.into(), false));
        self
    }

    /// The same search with the input as guessed.
    #[must_use]
    pub fn hold_inputs(mut self) -> Self {
        self.free.u = [false; NU];
        self
    }

    /// The same search with one input as guessed, by the name of the speed that it drives or by its index in `u`.
    #[must_use]
    pub fn hold_input(mut self, input: impl Into<Which>) -> Self {
        let index = match input.into() {
            Which::Named(name) => {
                let is_it = |speed: &&usize| R::SPEED_NAMES.get(**speed) == Some(&name);
                let found = R::ACTUATED.iter().position(|speed| is_it(&speed));
                found.map(Which::Index).unwrap_or(Which::Named(name))
            }
            index => index,
        };
        self.mistake = self.mistake.or(set(&mut self.free.u, &[], index, false));
        self
    }

    /// The same search with one speed free.
    #[must_use]
    pub fn free_speed(mut self, joint: impl Into<Which>) -> Self {
        self.mistake = self.mistake.or(set(&mut self.free.v, R::SPEED_NAMES, joint.into(), true));
        self
    }

    /// The same search with one acceleration free.
    #[must_use]
    pub fn free_acceleration(mut self, joint: impl Into<Which>) -> Self {
        self.mistake = self.mistake.or(set(&mut self.free.a, R::SPEED_NAMES, joint.into(), true));
        self
    }

    /// The equilibrium or motion that was found.
    ///
    /// Forces then balance to 2¹² times the rounding of `T`, relative to the largest of the robot at the guess, and the
    /// outputs are as near to their targets. Limits of joints are not looked at; whether the motors can do it,
    /// [`saturated`](crate::control::saturated) says of `tau`.
    ///
    /// # Errors
    ///
    /// [`TrimFailure`], which has the best state that was found: there is no equilibrium near the guess, or the limit of
    /// steps came first, or an argument is wrong. Into an [`Error`] it goes by `?`.
    ///
    /// # Cost
    ///
    /// For each step one `inverse_dynamics_derivatives`, two `inverse_dynamics`, the outputs twice, and about
    /// `4·n²·(2n + NC)` multiplications for `n = 3·NV + NU`; on the stack about `n² + 2·n·(NV + NC)` numbers. It never takes
    /// more steps than its limit.
    pub fn solve<const NX: usize>(&self) -> Result<Trimmed<T, NQ, NV, NU>, TrimFailure<T, NQ, NV, NU>>
    where
        R: StateSpaceModel<T, NQ, NV, NX, NU>,
        O: Output<R, T, NQ, NV>,
    {
        search::search(self)
    }
}

/// Sets what is named; a name that is unknown comes back.
fn set(flags: &mut [bool], names: &[&str], which: Which, value: bool) -> Option<Error> {
    match which.find(names, flags.len()) {
        Ok(index) => {
            if let Some(flag) = flags.get_mut(index) {
                *flag = value;
            }
            None
        }
        Err(error) => Some(error),
    }
}
