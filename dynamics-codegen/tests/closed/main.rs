//! The closed forms of robots: what is written, that it is read back, and that it is what the code computes.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod field;
mod letters;
mod proof;
mod properties;
mod robots;
mod textbook;
mod written;
