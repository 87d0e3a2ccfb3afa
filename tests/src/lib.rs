//! The robot zoo, and what the tests across the crates share.
//!
//! Every robot of the [`zoo`] is compiled by the derive and keeps the text of its specification, so that the same
//! robot can be run on every road to a number: the compiled Rust through [`Robot`], the compiler's own through
//! [`roads`]. Comparison is by [`assert_close!`], with tolerances that have names.

pub mod accuracy;
pub mod close;
pub mod dual;
mod frames;
pub mod random;
pub mod reference;
pub mod roads;
mod robot;
pub mod space;
mod specialised;
pub mod zoo;

pub use dual::Dual;
pub use frames::{Frames, frame};
pub use random::{Random, State};
pub use robot::{Axes, Forms, Method, Robot, Run};
pub use space::{Part, Space};
pub use specialised::Specialised;

/// A matrix of any size.
pub type Matrix<T = f64> = nalgebra::DMatrix<T>;
/// A column of any length.
pub type Vector<T = f64> = nalgebra::DVector<T>;
