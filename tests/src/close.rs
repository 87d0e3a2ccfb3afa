//! Comparison of blocks of numbers by the size of their largest entry, with tolerances that say why.

use std::fmt::Display;

/// Two roads that compute one number in double precision: some hundred operations, 1.1e-16 each.
pub const ROUNDING: f64 = 1e-12;

/// Derivatives of a stiff robot carry larger terms that cancel: three digits more than [`ROUNDING`].
pub const DERIVATIVES: f64 = 1e-9;

/// Central differences with a step of 1e-5: 1e-10 from the third derivative, and 1e-16/1e-5 from rounding, both
/// times the size of what is differentiated and a little more for fast angles.
pub const DIFFERENCES: f64 = 1e-8;

/// Single precision: some hundred operations of 6e-8 each, which mostly cancel, and sines with an absolute error
/// of 9.4e-8.
pub const SINGLE: f64 = 1e-5;

/// Asserts that two blocks of numbers agree: the largest difference over the larger of the largest entry and
/// `floor` is at most `tolerance`. What they are is a format string, of robot and quantity.
///
/// The `floor` is the size below which a block counts as zero; without it only the block's own size counts.
#[macro_export]
macro_rules! assert_close {
    ($found:expr, $expected:expr, $tolerance:expr, floor = $floor:expr, $($what:tt)+) => {
        $crate::close::check(&$found[..], &$expected[..], $tolerance, $floor, &format_args!($($what)+))
    };
    ($found:expr, $expected:expr, $tolerance:expr, $($what:tt)+) => {
        $crate::close::check(&$found[..], &$expected[..], $tolerance, 0.0, &format_args!($($what)+))
    };
}

/// The size of the largest entry; NaN if there is one.
pub fn largest(block: &[f64]) -> f64 {
    block.iter().fold(0.0, |worst: f64, x| if x.is_nan() || x.abs() > worst { x.abs() } else { worst })
}

/// The largest difference relative to the size of the expected block or `floor`, whichever is larger.
pub fn distance(found: &[f64], expected: &[f64], floor: f64) -> f64 {
    let differences: Vec<f64> = found.iter().zip(expected).map(|(x, y)| x - y).collect();
    let missed = largest(&differences);
    if missed == 0.0 { 0.0 } else { missed / largest(expected).max(floor) }
}

/// See [`assert_close!`].
///
/// # Panics
///
/// If the blocks differ in length or by more than the tolerance.
#[track_caller]
pub fn check(found: &[f64], expected: &[f64], tolerance: f64, floor: f64, what: &dyn Display) {
    assert_eq!(found.len(), expected.len(), "{what}: sizes differ");
    let distance = distance(found, expected, floor);
    assert!(
        distance <= tolerance,
        "{what}: off by {distance:.2e} where {tolerance:.0e} is allowed\n   found {found:?}\nexpected {expected:?}"
    );
}
