//! What depends on the arithmetic of a target: lanes and their registers, factors and recursions in them, quaternions, linear
//! models. A program of its own, which `.ci/run` also builds for this very processor.

mod common;

mod lanes;
mod linear;
mod linear_reference;
mod manifold;
mod recursion;
mod solve;
