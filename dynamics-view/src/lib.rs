//! Pictures of moving robots.
//!
//! - A [`Figure`] of [`Chart`]s becomes SVG: lines over time, energy, phase portraits, poles.
//! - A [`Film`] of a [`Scene`] becomes one HTML file that needs nothing else: the robot in three dimensions, to be
//!   played, wound and turned, with its charts below.
//!
//! - A [`page`] has sections of text, tables, equations and pictures, and the robot to be moved by its joints.
//!
//! A [`Recording`] makes the first two of a robot of the derive.
//!
//! Same input, same bytes. What cannot be drawn is an [`Error`]; nothing panics. SI units and radians.
//! `node dynamics-view/browser/check.mjs FILE…` tries pictures in a browser, and `report.mjs` beside it a page.

mod chart;
mod coordinates;
mod embed;
mod encode;
mod error;
mod figure;
mod film;
mod labels;
mod lines;
mod linkage;
pub mod page;
mod phase;
mod poles;
mod recording;
mod scale;
mod scene;
mod style;
mod svg;
mod text;
mod thin;

pub use chart::{Account, Chart, Plane};
pub use coordinates::{Coordinate, Coordinates, Loose, Measure};
pub use error::Error;
pub use figure::Figure;
pub use film::Film;
pub use linkage::{Drive, Link, Linkage, Mount};
pub use recording::Recording;
pub use scene::{Body, Joint, Motion, Placed, Scene};
