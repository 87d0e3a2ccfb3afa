//! Three-dimensional vector algebra over any [`Scalar`]: numbers compute, expressions derive.

mod matrix;
mod pose;
mod pseudo_inertia;
mod random;
mod scalar;
mod vector;

pub use matrix::{Matrix3, Symmetric3};
pub use pose::Pose;
pub use pseudo_inertia::PseudoInertia;
pub use random::Random;
pub use scalar::Scalar;
pub use vector::Vector3;
