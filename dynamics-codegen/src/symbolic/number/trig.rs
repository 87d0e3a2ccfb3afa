//! Sine, cosine and arc tangent of constants, from IEEE 754 arithmetic alone.
//!
//! Angles that are fractions of π are reduced exactly, and give exact results wherever the square of the
//! result is rational (I. Niven: only 0, 1/4, 1/2, 3/4 and 1 are). Other angles are reduced by a π/2 of
//! 159 bits, and then summed by their Taylor series on `[-π/4, π/4]`.

use super::ratio::Exact;
use super::wide::Wide;
use super::{Number, Number::Float};
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4};

/// π/2 in three parts; the first two are those of [`Wide`].
const HALF_PI: [f64; 3] = [FRAC_PI_2, 6.123233995736766e-17, -1.4973849048591698e-33];

/// Angles in radians from here on are refused: their digits would all belong to the multiple of 2π.
const TOO_LARGE: f64 = (1_u64 << 50) as f64;

/// The sine of `turns` quarter turns more than `angle`; `angle` is in radians.
///
/// Not a number from 2^50 radians on, unless the angle is a fraction of π.
pub(super) fn sin_after_quarters(angle: Number, quarters: i64) -> Number {
    if let Number::Exact(fraction) = angle
        && let Some((whole, rest)) = split_quarters(fraction)
    {
        return sin_of_fraction(rest, whole + quarters);
    }
    let (hi, rest) = split_double(angle);
    if hi.is_nan() || hi.abs() >= TOO_LARGE {
        return Float(Wide::NAN);
    }
    let (quadrant, rest) = reduce(hi, rest);
    let value = match (quadrant + quarters).rem_euclid(4) {
        0 => sin_kernel(rest),
        1 => cos_kernel(rest),
        2 => sin_kernel(rest).neg(),
        _ => cos_kernel(rest).neg(),
    };
    Number::from_wide(value)
}

/// `hi + rest`; to more than the bits of [`Wide`] if the angle is a fraction, as a user would write it:
/// the reduction of one close to a multiple of π/2 uses them up.
fn split_double(angle: Number) -> (f64, Wide) {
    if let Number::Exact(exact) = angle
        && let Some(parts) = exact.split_double()
    {
        return parts;
    }
    let wide = angle.to_wide();
    (wide.hi(), Wide::from_f64(wide.lo()))
}

/// The angle of the point `(x, y)`, in `(-π, π]`.
pub(super) fn atan2(y: Number, x: Number) -> Number {
    if !y.is_finite() || !x.is_finite() {
        return Float(Wide::NAN);
    }
    let octant = angle_in_octant(y.abs(), x.abs());
    let angle = if x.is_negative() { Number::PI - octant } else { octant };
    if y.is_negative() { -angle } else { angle }
}

/// The angle of a point of the first quadrant, from an angle of at most π/4.
fn angle_in_octant(y: Number, x: Number) -> Number {
    let pi_over = |n| Number::PI * Number::ratio(1, n);
    let order = y.cmp_value(x);
    if y.is_zero() {
        Number::ZERO
    } else if order.is_eq() {
        pi_over(4)
    } else if order.is_lt() {
        atan_of_quotient(y, x)
    } else {
        pi_over(2) - atan_of_quotient(x, y)
    }
}

/// `atan(small / large)` for `0 ≤ small ≤ large`.
fn atan_of_quotient(small: Number, large: Number) -> Number {
    // An exact quotient first: equal angles then have equal bits, however long their sides are.
    let slope = small.checked_div(large).expect("the larger of two different sides is not zero").to_wide();
    let start = atan_start(slope.hi());
    let guess = Wide::from_f64(start);
    let (sin, cos) = (sin_kernel(guess), cos_kernel(guess));
    // tan(θ - guess), below 1e-7: three terms of its arc tangent are exact to more than 105 bits.
    let tan = slope.mul(cos).sub(sin).div(cos.add(slope.mul(sin)));
    let t = tan.hi();
    let bend = Wide::from_f64(t * t * t * (t * t / 5.0 - 1.0 / 3.0));
    Number::from_wide(guess.add(tan.add(bend)))
}

/// The arc tangent on `[0, 1]`, to 1e-7: the Taylor series, about 0 or about 1.
fn atan_start(slope: f64) -> f64 {
    let (base, z) = if slope > 0.414 { (FRAC_PI_4, (slope - 1.0) / (slope + 1.0)) } else { (0.0, slope) };
    let square = z * z;
    let series = [15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0].iter().fold(0.0, |sum, n| square * (1.0 / n - sum));
    base + z * (1.0 - series)
}

/// `r·π = whole·π/2 + rest·π` with `|rest| ≤ 1/4`; `rest` is without its π, `whole` modulo 4.
fn split_quarters(angle: Exact) -> Option<(i64, Exact)> {
    let (num, den) = (angle.numerator(), angle.denominator());
    if angle.pi_power() != 1 || angle.radicand() != 1 || den >= 1 << 120 {
        return (num == 0).then_some((0, Exact::ZERO));
    }
    let num = num.rem_euclid(2 * den);
    let whole = (4 * num + den) / (2 * den);
    Some((whole as i64, Exact::reduced(2 * num - whole * den, 2 * den)?))
}

/// `sin(quarters·π/2 + rest·π)` for `|rest| ≤ 1/4`.
fn sin_of_fraction(rest: Exact, quarters: i64) -> Number {
    let magnitude = match (quarters.rem_euclid(2), rest.numerator().abs(), rest.denominator()) {
        (0, 0, _) => Number::ZERO,
        (0, 1, 6) => Number::ratio(1, 2),
        (1, 0, _) => Number::ONE,
        (1, 1, 6) => root_of_ratio(3, 4),
        (_, 1, 4) => root_of_ratio(1, 2),
        (odd, ..) => {
            let angle = rest.abs().to_wide().mul(Wide::PI);
            Number::from_wide(if odd == 0 { sin_kernel(angle) } else { cos_kernel(angle) })
        }
    };
    let quarters = quarters.rem_euclid(4);
    let sine_is_negative = quarters % 2 == 0 && rest.numerator() < 0;
    if (quarters >= 2) != sine_is_negative { -magnitude } else { magnitude }
}

fn root_of_ratio(num: i64, den: i64) -> Number {
    Number::ratio(num, den).sqrt().expect("the ratios given here are positive")
}

/// The multiple n of π/2 nearest to `hi + lo`, and the rest, in `[-π/4, π/4]` or just outside.
fn reduce(hi: f64, lo: Wide) -> (i64, Wide) {
    let n = (hi * FRAC_2_PI).round();
    // The first difference is exact: a multiple of 2^-53, and small.
    let rest = Wide::from_f64(hi).sub(Wide::product(n, HALF_PI[0])).add(lo);
    let rest = rest.sub(Wide::product(n, HALF_PI[1])).sub(Wide::product(n, HALF_PI[2]));
    (n as i64, rest)
}

/// `x - x³/3! + … + x²⁷/27!` for `|x| ≤ π/4`; the next term is below 2^-112.
fn sin_kernel(x: Wide) -> Wide {
    x.mul(alternating(x.mul(x), 26.0))
}

/// `1 - x²/2! + … + x²⁸/28!` for `|x| ≤ π/4`; the next term is below 2^-117.
fn cos_kernel(x: Wide) -> Wide {
    alternating(x.mul(x), 27.0)
}

/// `1 - s/(n(n+1))·(…)` from the innermost n = `last` down to 2 or 1, in steps of two.
fn alternating(square: Wide, last: f64) -> Wide {
    let (mut sum, mut n) = (Wide::ONE, last);
    while n > 0.0 {
        sum = Wide::ONE.sub(square.mul(sum).div_small(n * (n + 1.0)));
        n -= 2.0;
    }
    sum
}
