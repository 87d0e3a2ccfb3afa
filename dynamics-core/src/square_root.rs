//! Square roots for targets that have neither the standard library nor `libm`.
//!
//! Scale to [1, 4), estimate 1/√m from the bits, refine by Newton's iteration, then correct s ≈ √m by the residual
//! m − s², which is formed exactly from a split s (Veltkamp, Dekker 1971). The result is within 1 ulp.

macro_rules! square_root {
    ($name:ident, $float:ident, $bits:ident, $int:ident, $shift:literal, $bias:literal, $estimate:literal,
     $iterations:literal, $splitter:literal, $subnormal_up:literal, $subnormal_down:literal) => {
        /// `√x`: within 1 ulp; ±0 and +∞ give themselves, NaN and anything below zero give NaN.
        pub(crate) fn $name(x: $float) -> $float {
            if x == 0.0 || x == $float::INFINITY {
                return x;
            }
            if x.is_nan() || x < 0.0 {
                return $float::NAN;
            }
            let (x, unscale) =
                if x < $float::MIN_POSITIVE { (x * $subnormal_up, $subnormal_down) } else { (x, 1.0) };
            let exponent = (x.to_bits() >> $shift).wrapping_sub($bias) as $int;
            let half = exponent >> 1; // towards −∞
            let m = $float::from_bits(x.to_bits().wrapping_sub(((half << 1) as $bits) << $shift));

            let mut y = $float::from_bits($estimate - (m.to_bits() >> 1));
            for _ in 0..$iterations {
                y *= 1.5 - 0.5 * m * y * y;
            }
            let s = m * y;
            let split = $splitter * s;
            let high = split - (split - s);
            let low = s - high;
            let residual = ((m - high * high) - 2.0 * high * low) - low * low;
            let root = s + 0.5 * y * residual;

            $float::from_bits(root.to_bits().wrapping_add((half as $bits) << $shift)) * unscale
        }
    };
}

square_root!(
    sqrt_f64,
    f64,
    u64,
    i64,
    52,
    1023,
    0x5FE6_EB50_C7B5_37A9,
    3,
    134_217_729.0,            // 2²⁷ + 1
    18_014_398_509_481_984.0, // 2⁵⁴
    7.450_580_596_923_828e-9  // 2⁻²⁷
);
square_root!(
    sqrt_f32,
    f32,
    u32,
    i32,
    23,
    127,
    0x5F37_59DF,
    2,
    4097.0,         // 2¹² + 1
    16_777_216.0,   // 2²⁴
    2.441_406_2e-4  // 2⁻¹²
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn special_values() {
        assert_eq!(sqrt_f64(0.0).to_bits(), 0.0_f64.to_bits());
        assert_eq!(sqrt_f64(-0.0).to_bits(), (-0.0_f64).to_bits());
        assert_eq!(sqrt_f64(f64::INFINITY), f64::INFINITY);
        assert!(
            sqrt_f64(-1.0).is_nan() && sqrt_f64(f64::NAN).is_nan() && sqrt_f64(f64::NEG_INFINITY).is_nan()
        );
        assert!(sqrt_f32(-1.0).is_nan() && sqrt_f32(f32::NAN).is_nan());
        assert_eq!(sqrt_f32(f32::INFINITY), f32::INFINITY);
    }

    #[test]
    fn squares_have_exact_roots() {
        for k in 1..100_000_u32 {
            assert_eq!(sqrt_f64(f64::from(k) * f64::from(k)), f64::from(k));
        }
        for k in 1..4096_u16 {
            assert_eq!(sqrt_f32(f32::from(k) * f32::from(k)), f32::from(k));
        }
    }

    #[cfg(feature = "std")]
    #[test]
    fn within_one_ulp_over_all_exponents() {
        for bits in (1..0x7F80_0000_u32).step_by(977) {
            let x = f32::from_bits(bits);
            assert!(sqrt_f32(x).to_bits().abs_diff(x.sqrt().to_bits()) <= 1, "x = {x:e}");
        }
        for bits in (1..0x7FF0_0000_0000_0000_u64).step_by(4_611_686_018_427) {
            let x = f64::from_bits(bits);
            assert!(sqrt_f64(x).to_bits().abs_diff(x.sqrt().to_bits()) <= 1, "x = {x:e}");
        }
        for x in [5e-324, f64::MIN_POSITIVE, f64::MAX] {
            assert!(sqrt_f64(x).to_bits().abs_diff(x.sqrt().to_bits()) <= 1, "x = {x:e}");
        }
    }
}
