//! Angles without their whole turns.

use core::f64::consts::TAU;

use crate::scalar::Scalar;
use crate::simulate::numbers::rounding;

/// The angle, in rad, less as many whole turns as leave it within half a turn of zero.
///
/// Of an angle that is half a turn off, either end. What is left is exact to the rounding of the angle. There is no
/// branch: lanes and derivatives go through it.
///
/// ```
/// use core::f64::consts::PI;
/// use dynamics_core::control::within_half_a_turn;
///
/// assert!((within_half_a_turn(7.0 * PI + 0.1) - (0.1 - PI)).abs() < 1e-14);
/// assert_eq!(within_half_a_turn(-3.0), -3.0);
/// ```
#[inline]
pub fn within_half_a_turn<T: Scalar>(angle: T) -> T {
    // Between a number so large and the next one there is 1: the sum is rounded to a whole number.
    let large = T::of(1.5) / rounding::<T>();
    let turns = (angle * T::of(1.0 / TAU) + large) - large;
    turns.mul_add(-T::of(TAU), angle)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2π is rounded, as often as there are turns: 300 in `f64`, and the angle itself in `f32`.
    const ROUNDING: [f64; 2] = [300.0 * TAU * f64::EPSILON, 2e3 * f32::EPSILON as f64];

    #[test]
    fn what_is_left_is_the_same_angle() {
        for k in -5000..5000 {
            let angle = 0.37 * f64::from(k);
            let left = within_half_a_turn(angle);
            let turns = (angle - left) / TAU;
            assert!(left.abs() <= TAU / 2.0 + ROUNDING[0], "{left}");
            assert!((turns - turns.round()).abs() < ROUNDING[0], "{angle}");
            let single = f64::from(within_half_a_turn(angle as f32));
            // Half a turn may be left on either side.
            let between = (single - left).abs();
            assert!(between < ROUNDING[1] || (between - TAU).abs() < ROUNDING[1], "{angle}: {single}");
        }
    }

    #[test]
    fn a_small_angle_stays_to_the_last_bit() {
        for angle in [0.0, 1e-300, -1e-9, 1.5, -3.125] {
            assert_eq!(within_half_a_turn(angle), angle);
            assert_eq!(within_half_a_turn(angle as f32), angle as f32);
        }
        assert!(within_half_a_turn(f64::NAN).is_nan() && within_half_a_turn(f64::INFINITY).is_nan());
    }
}
