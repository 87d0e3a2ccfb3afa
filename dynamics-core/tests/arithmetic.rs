//! What depends on the arithmetic of a target: square roots, fused products, lanes and their registers. One program, which
//! is also run without the standard library and on the registers of this processor.

mod common;

mod lanes;
mod linear;
mod linear_reference;
mod manifold;
mod recursion;
mod solve;
