//! Linear models: discretisation, analysis, and design of feedback and of filters.
//!
//! On matrices of fixed size, and as methods of a [`StateSpace`](crate::StateSpace):
//!
//! | | |
//! |---|---|
//! | [`zero_order_hold`], [`Hold`] | `x⁺ = Φ·x + Γ·u`, exact for held and for ramped inputs; Tustin's rule; and back |
//! | [`poles`](fn@poles), [`Mode`] | eigenvalues, natural frequencies, damping |
//! | [`stability`] | stable, marginal or unstable beyond rounding, with the margin |
//! | [`controllability`], [`observability`] | which modes inputs reach and outputs show, with the distance to losing one |
//! | [`lqr`](fn@lqr), [`quadratic_cost`] | `u = −K·x` of least cost, and what any K costs |
//! | [`kalman`](fn@kalman), [`Observer`] | the filter of least variance, and its estimate sample by sample |
//! | [`place_poles`] | `u = −k·x` by desired poles, for one input |
//!
//! Scalars are `f32` and `f64`. There is no heap and no panic, and each iteration has a bound; what is not finite is
//! found before any begins. Square roots are those of [`Scalar`](crate::Scalar), so that all of it runs without a standard
//! library: a microcontroller may design its own gains.
//!
//! # Decisions
//!
//! What is asked as yes or no (a rank, the side of the imaginary axis) is answered for the data as they are known: a
//! matrix that differs by `10·N·ε` of its norm is the same matrix, with the states in the units that they have, or in
//! those that the weights of a cost give them. Every decision comes with the distance on which it rests, and every gain
//! with the residual of the equation that it solves.
//!
//! # Errors
//!
//! A [`LinearError`] has the fact, with the pole, the matrix or the number; its message says what to do.

mod balance;
mod complex;
mod discretize;
mod error;
mod exponential;
mod kalman;
mod logarithm;
mod lqr;
mod lu;
mod lyapunov;
mod matrix;
mod model;
mod observer;
mod place;
mod poles;
#[cfg(test)]
mod random;
mod reach;
mod real;
mod reflector;
mod riccati;
mod schur;
mod singular;
mod symmetric;
mod twice;

pub use discretize::{Hold, zero_order_hold};
pub use error::LinearError;
pub use kalman::{Kalman, kalman};
pub use lqr::{Lqr, Weights, lqr, quadratic_cost};
pub use observer::Observer;
pub use place::{Placement, place_poles};
pub use poles::{Mode, Stability, Time, Verdict, poles, stability};
pub use reach::{Reach, controllability, observability};
pub use real::Real;
