//! Motions, control, and what is asked of a robot: all tests of the crate but those of `arithmetic.rs` and those that need
//! `serde`, in one program: what they share is compiled once, and long ones run side by side.

mod common;

mod adaptive;
mod centroidal;
mod control;
mod dynamics;
mod events;
mod flow;
mod kinematics;
mod linearize;
mod output;
mod regressor;
mod simulate;
mod state_space;
mod tossed_box;
mod trajectory;
mod trim;
mod variational;
