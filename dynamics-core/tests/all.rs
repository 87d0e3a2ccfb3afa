//! All tests of the crate but those that need `serde`, in one program: what they share is compiled once, and long ones
//! run side by side.

mod common;

mod adaptive;
mod centroidal;
mod control;
mod dynamics;
mod events;
mod flow;
mod kinematics;
mod lanes;
mod linear;
mod linear_reference;
mod linearize;
mod manifold;
mod output;
mod recursion;
mod regressor;
mod simulate;
mod solve;
mod state_space;
mod tossed_box;
mod trajectory;
mod trim;
mod variational;
