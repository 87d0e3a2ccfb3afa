//! Which step comes next, by the errors of the last two.

use super::numbers::{larger, smaller};
use crate::scalar::Scalar;

/// The factor that keeps most steps from being taken twice.
const SAFETY: f64 = 0.9;
/// A step is at most so many times the one before it.
const LARGEST: f64 = 10.0;
/// And at least this.
const LEAST: f64 = 0.2;

/// A proportional and integral controller: `h₁ = h·0.9·ε₀^(1/20)/ε^(3/20)`, ε the error in units of the tolerances.
///
/// The proportional part keeps steps even where stability and not the error bounds them.
///
/// # Source
///
/// K. Gustafsson, *Control theoretic techniques for stepsize selection in explicit Runge–Kutta methods*, ACM TOMS 17
/// (1991) 533–554; E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, Springer 1996, §IV.2.
#[derive(Clone, Copy, Debug)]
pub(super) struct Controller<T> {
    /// The fifth root of the last error that was accepted.
    before: T,
    /// Whether the step is a second attempt.
    again: bool,
}

impl<T: Scalar + PartialOrd> Controller<T> {
    pub(super) fn new() -> Self {
        Self { before: T::of(0.16), again: false } // the root of 1e-4
    }

    /// The factor of the next step after one that was good enough.
    pub(super) fn accepted(&mut self, error: T) -> T {
        let root = fifth_root(error);
        let damping = self.before.sqrt().sqrt();
        let power = root.sqrt() * root.sqrt().sqrt();
        let most = if self.again { T::one() } else { T::of(LARGEST) };
        *self = Self { before: larger(root, T::of(0.16)), again: false };
        smaller(larger(T::of(SAFETY) * damping / power, T::of(LEAST)), most)
    }

    /// The factor of the step in place of one that was not.
    pub(super) fn rejected(&mut self, error: T) -> T {
        self.again = true;
        // Of an error that is no number, the least.
        if error.is_finite() { larger(T::of(SAFETY) / fifth_root(error), T::of(LEAST)) } else { T::of(LEAST) }
    }
}

/// `x^(1/5)` to some digits, for x between 1e-30 and 1e30 and else of the nearer end.
pub(super) fn fifth_root<T: Scalar + PartialOrd>(x: T) -> T {
    let x = smaller(larger(x, T::of(1e-30)), T::of(1e30));
    let eighth = x.sqrt().sqrt().sqrt();
    let near = eighth * eighth.sqrt(); // x^(3/16); 3/16 + 3/256 + … = 1/5
    let mut root = near * near.sqrt().sqrt().sqrt().sqrt();
    for _ in 0..4 {
        let square = root * root;
        root = T::of(0.8) * root + T::of(0.2) * (x / square) / square; // Newton's
    }
    root
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fifth_roots_are_roots() {
        for power in -30..=30 {
            let x = 10_f64.powi(power);
            assert!((fifth_root(x) / x.powf(0.2) - 1.0).abs() < 1e-6, "{x}");
            assert!((fifth_root(x as f32) / (x as f32).powf(0.2) - 1.0).abs() < 1e-5, "{x}");
        }
        assert_eq!(fifth_root(0.0), fifth_root(1e-30));
    }

    #[test]
    fn steps_shrink_and_grow_within_bounds() {
        let mut controller = Controller::new();
        assert_eq!(controller.rejected(f64::NAN), LEAST);
        assert!(controller.accepted(1e-9) <= 1.0, "no growth right after a rejection");
        assert!(controller.accepted(0.0) <= LARGEST);
        assert!(controller.rejected(2.0) < SAFETY);
    }
}
