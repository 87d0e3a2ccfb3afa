//! Five robots under three control laws, at a kilohertz: the same code on a microcontroller and on its host.
//!
//! Nothing here allocates or panics. Over `f32` nothing computes in `f64`: constants are rounded when the code is
//! compiled.
#![no_std]

#[cfg(test)]
extern crate std;

pub mod gains;
pub mod report;
pub mod robots;
pub mod trial;
