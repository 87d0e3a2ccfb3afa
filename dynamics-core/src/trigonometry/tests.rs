//! Errors over dense samples; what the table at the top of the module claims.

use super::*;

/// A seeded stream of numbers in −1..1 (SplitMix64).
#[cfg(feature = "std")]
fn random() -> impl Iterator<Item = f64> {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    core::iter::repeat_with(move || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    })
}

#[test]
fn cardinal_angles() {
    assert_eq!(sin_cos_f64(0.0), (0.0, 1.0));
    assert_eq!(sin_cos_f32(0.0), (0.0, 1.0));
    let (s, c) = sin_cos_f64(core::f64::consts::FRAC_PI_2);
    assert!(s == 1.0 && (c - 6.123_233_995_736_766e-17).abs() < 1e-30, "{c:e}");
    let (s, c) = sin_cos_f64(-core::f64::consts::PI);
    assert!((s + 1.224_646_799_147_353_2e-16).abs() < 1e-30 && c == -1.0, "{s:e}");
}

#[test]
fn infinity_nan_and_what_is_beyond_the_range_give_nan() {
    for x in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1e16, -1e300] {
        let (s, c) = sin_cos_f64(x);
        assert!(s.is_nan() && c.is_nan(), "x = {x}");
    }
    for x in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 2e6, -1e38] {
        let (s, c) = sin_cos_f32(x);
        assert!(s.is_nan() && c.is_nan(), "x = {x}");
    }
}

/// glibc's sine is within 0.55 ulp, at most 0.6e-16: the bound here leaves that much beside our own 1.7e-16.
#[cfg(feature = "std")]
#[test]
fn f64_is_within_two_ulp_up_to_2_to_the_30() {
    const TOLERANCE: f64 = 2.3e-16;
    let mut worst = 0.0_f64;
    for scale in [1e-9, 1e-3, 0.1, 0.8, 1.0, 3.2, 10.0, 100.0, 1e4, 1e6, 1_073_741_824.0] {
        for u in random().take(200_000) {
            let x = u * scale;
            let (s, c) = sin_cos_f64(x);
            worst = worst.max((s - x.sin()).abs()).max((c - x.cos()).abs());
        }
    }
    std::eprintln!("f64: largest absolute error {worst:e}");
    assert!(worst < TOLERANCE, "largest absolute error {worst:e}");
}

#[cfg(feature = "std")]
#[test]
fn f64_beyond_is_no_worse_than_the_spacing_of_its_argument() {
    for u in random().take(100_000) {
        let x = u * 562_949_953_421_311.0;
        let (s, c) = sin_cos_f64(x);
        let tolerance = 3e-16 + x.abs() * f64::EPSILON;
        assert!((s - x.sin()).abs() < tolerance && (c - x.cos()).abs() < tolerance, "x = {x:e}");
    }
}

#[cfg(feature = "std")]
#[test]
fn f32_is_within_1e_7_up_to_ten_thousand() {
    let mut worst = 0.0_f64;
    for bits in (0..=10_000.0_f32.to_bits()).step_by(211) {
        for x in [f32::from_bits(bits), -f32::from_bits(bits)] {
            let (s, c) = sin_cos_f32(x);
            let exact = f64::from(x);
            worst = worst.max((f64::from(s) - exact.sin()).abs()).max((f64::from(c) - exact.cos()).abs());
        }
    }
    std::eprintln!("f32: largest absolute error {worst:e}");
    assert!(worst < 1e-7, "largest absolute error {worst:e}");
}
