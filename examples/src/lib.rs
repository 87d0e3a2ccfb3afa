//! The programs are beside this folder, one per file: `cargo run --example pendulum`.
//!
//! This library is empty: it compiles and runs the Rust in the workspace's Markdown, as documentation tests.

#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
mod readme {}

#[cfg(doctest)]
#[doc = include_str!("../../DESIGN.md")]
mod design {}

#[cfg(doctest)]
#[doc = include_str!("../../ARCHITECTURE.md")]
mod architecture {}

#[cfg(doctest)]
#[doc = include_str!("../../CHANGELOG.md")]
mod changelog {}

#[cfg(doctest)]
#[doc = include_str!("../../COMPARE.md")]
mod compare {}

#[cfg(doctest)]
#[doc = include_str!("../../ACCURACY.md")]
mod accuracy {}

#[cfg(doctest)]
#[doc = include_str!("../firmware/README.md")]
mod firmware {}
