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

/// What the module claims of `f32` up to ten thousand; `cargo bench -p dynamics-core --bench sine` tries all floats.
#[cfg(feature = "std")]
const SINGLE: f64 = 9.4e-8;

/// The larger of the two errors at `x`.
#[cfg(feature = "std")]
fn single_error(x: f32) -> f64 {
    let ((s, c), exact) = (sin_cos_f32(x), f64::from(x));
    (f64::from(s) - exact.sin()).abs().max((f64::from(c) - exact.cos()).abs())
}

#[cfg(feature = "std")]
#[test]
fn f32_is_as_exact_as_stated_up_to_ten_thousand() {
    let mut worst = 0.0_f64;
    for bits in (0..=10_000.0_f32.to_bits()).step_by(211) {
        for x in [f32::from_bits(bits), -f32::from_bits(bits)] {
            worst = worst.max(single_error(x));
        }
    }
    std::eprintln!("f32: largest absolute error {worst:e}");
    assert!(worst <= SINGLE, "largest absolute error {worst:e}");
}

#[cfg(feature = "std")]
#[test]
fn f32_beyond_is_no_worse_than_the_spacing_of_its_argument() {
    for bits in (10_000.0_f32.to_bits()..1_048_576.0_f32.to_bits()).step_by(211) {
        let x = f32::from_bits(bits);
        let spacing = f64::from(f32::from_bits(bits + 1) - x);
        assert!(single_error(x) <= SINGLE + spacing, "x = {x:e}");
    }
}

#[test]
fn the_range_of_f32_ends_at_a_power_of_two() {
    let end = 1_048_576.0_f32;
    let (s, c) = sin_cos_f32(end.next_down());
    assert!(s.abs() <= 1.0 && c.abs() <= 1.0, "{s}, {c}");
    for x in [end, -end, f32::MAX, f32::MIN] {
        let (s, c) = sin_cos_f32(x);
        assert!(s.is_nan() && c.is_nan(), "x = {x}");
    }
}

/// What is smaller than the smallest normal float is not lost.
#[test]
fn small_angles_are_their_own_sines() {
    for zero in [0.0, -0.0] {
        let (s, c) = sin_cos_f32(zero);
        assert_eq!((s.to_bits(), c), (0, 1.0), "the sine of a zero is +0");
    }
    for x in [1e-45, f32::MIN_POSITIVE, 1e-20, 1e-5] {
        for x in [x, -x] {
            let (s, c) = sin_cos_f32(x);
            assert_eq!((s.to_bits(), c), (x.to_bits(), 1.0), "x = {x:e}");
        }
    }
}

#[test]
fn the_sine_is_odd_and_the_cosine_even_to_the_bit() {
    for bits in (1..1_048_576.0_f32.to_bits()).step_by(100_003) {
        let x = f32::from_bits(bits);
        let ((s, c), (minus_s, same_c)) = (sin_cos_f32(x), sin_cos_f32(-x));
        assert_eq!((minus_s.to_bits(), same_c.to_bits()), ((-s).to_bits(), c.to_bits()), "x = {x:e}");
    }
}
