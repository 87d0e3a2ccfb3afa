//! Sine and cosine together: straight-line kernels for `f64` and `f32`.
//!
//! One range reduction serves both functions. There is no branch, no table and no call, so that the kernels inline
//! into generated code; lanes run through the same source, and give the same bits. The `f32` kernel never touches `f64`.
//!
//! | kernel | range | largest absolute error | beyond |
//! |---|---|---|---|
//! | [`sin_cos_f64`] | \|x\| ≤ 2³⁰ | 1.7e-16 | NaN from 2⁴⁹ on |
//! | [`sin_cos_f32`] | \|x\| ≤ 10⁴ | 9.4e-8 | NaN from 2²⁰ on |
//!
//! In between, the error is at most that and the spacing of floats at `x`. Infinity and NaN give NaN. The sine is odd and
//! the cosine even, to the bit, but that the sine of −0 is +0. `cargo bench -p dynamics-core --bench sine` tries every `f32`.
//!
//! Sources: W. J. Cody and W. Waite, *Software Manual for the Elementary Functions*, Prentice-Hall 1980 (reduction in
//! parts); the polynomials of fdlibm (Sun Microsystems 1993) for `f64`, minimax fits of our own for `f32`.

use core::f32::consts as pi32;
use core::f64::consts as pi64;

use crate::scalar::{FUSED, Scalar};

/// What a kernel asks of a float, or of lanes of floats, beside arithmetic.
pub(crate) trait Kernel: Scalar {
    /// Turns `(sin, cos)` by the quarter turns in the two lowest bits of `quarter_turns`: swaps and signs without a
    /// branch.
    fn turn(sin: Self, cos: Self, quarter_turns: Self) -> (Self, Self);
}

macro_rules! impl_kernel {
    ($float:ident, $sign:literal) => {
        impl Kernel for $float {
            #[inline(always)]
            fn turn(sin: Self, cos: Self, quarter_turns: Self) -> (Self, Self) {
                // By bits and not by `if`, of which compilers make jumps that no core can foresee.
                let (turns, s, c) = (quarter_turns.to_bits(), sin.to_bits(), cos.to_bits());
                let odd = (turns & 1).wrapping_neg(); // all bits, or none
                let swap = (s ^ c) & odd;
                let sign_s = (turns & 2) << ($sign - 1);
                let sign_c = (turns.wrapping_add(1) & 2) << ($sign - 1);
                ($float::from_bits(s ^ swap ^ sign_s), $float::from_bits(c ^ swap ^ sign_c))
            }
        }
    };
}

impl_kernel!(f64, 63);
impl_kernel!(f32, 31);

/// `(sin x, cos x)`, with `x` in radians.
///
/// For |x| ≤ 2³⁰ the absolute error of either is at most 1.7e-16 (measured against 80-bit arithmetic). Beyond, where
/// the target has no fused multiply-add, the reduction is wrong by up to the spacing of `f64` at `x`. From
/// |x| = 2⁴⁹ on, and for infinity and NaN, both results are NaN: wrong digits would be worse.
///
/// # Cost
///
/// 21 multiplications, 19 additions, most of them fused where the target can; with feature `simd`, `f64` as a [`Scalar`]
/// has the two polynomials side by side.
#[inline(always)]
#[must_use]
pub fn sin_cos_f64(x: f64) -> (f64, f64) {
    sin_cos_double(x)
}

/// The sine is `r + r³·(s₀ + s₁·r² + …)` with these,
pub(crate) const SINE: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];
/// and the cosine `1 − r²/2 + r⁴·(c₀ + c₁·r² + …)` with these.
pub(crate) const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// [`sin_cos_f64`], in each lane.
#[inline(always)]
pub(crate) fn sin_cos_double<T: Kernel>(x: T) -> (T, T) {
    let (turns, r) = reduced_double(x);
    let z = r * r;
    let z2 = z * z;
    let sum =
        |[a, b, c, d, e, f]: [f64; 6]| madd(z2, madd(z2, linear(z, f, e), linear(z, d, c)), linear(z, b, a));
    let sin = madd(r * z, sum(SINE), r);
    let cos = madd(z2, sum(COSINE), of_halves(z));
    T::turn(sin, cos, turns)
}

/// How many quarter turns are nearest to `x`, in the low bits, and what is left of it; NaN from 2⁴⁹ on.
#[inline(always)]
pub(crate) fn reduced_double<T: Kernel>(x: T) -> (T, T) {
    const ROUND: f64 = 6_755_399_441_055_744.0; // 1.5·2⁵²: adding it leaves the integer in the low bits
    const TOO_LARGE: f64 = f64::from_bits((1023 + 975) << 52); // 2⁹⁷⁵: times 2⁴⁹ infinite, times less not
    let rounded = madd(x, T::of(pi64::FRAC_2_PI), T::of(ROUND));
    (rounded, or_nan(reduce_double(x, rounded - T::of(ROUND)), x * T::of(TOO_LARGE)))
}

/// `1 − z/2`
#[inline(always)]
pub(crate) fn of_halves<T: Scalar>(z: T) -> T {
    linear(z, -0.5, 1.0)
}

/// `r = x − k·π/2`, with π/2 in parts short enough that the first products are exact.
#[inline(always)]
fn reduce_double<T: Kernel>(x: T, k: T) -> T {
    if FUSED {
        let r = madd(-k, T::of(pi64::FRAC_PI_2), x); // exact
        madd(-k, T::of(6.123_233_995_736_766e-17), r)
    } else {
        // 23, 23 and 53 bits: the first two products are exact for |k| ≤ 2³⁰.
        const P1: f64 = f64::from_bits(0x3FF9_21FB_4000_0000);
        const P2: f64 = f64::from_bits(0x3E74_442D_0000_0000);
        const P3: f64 = f64::from_bits(0x3CF8_4698_98CC_5170);
        ((x - k * T::of(P1)) - k * T::of(P2)) - k * T::of(P3)
    }
}

/// `(sin x, cos x)`, with `x` in radians, without a single operation in `f64`.
///
/// For |x| ≤ 10⁴ the absolute error of either is at most 9.4e-8 (measured for each of them). Beyond, the reduction
/// is wrong by up to the spacing of `f32` at `x`. From |x| = 2²⁰ on, and for infinity and NaN, both results are NaN.
///
/// # Cost
///
/// 15 multiplications, 13 additions, most of them fused where the target can.
#[inline(always)]
#[must_use]
pub fn sin_cos_f32(x: f32) -> (f32, f32) {
    sin_cos_single(x)
}

/// [`sin_cos_f32`], in each lane. The constants are those of `f32`, which `of` rounds to without loss.
#[inline(always)]
pub(crate) fn sin_cos_single<T: Kernel>(x: T) -> (T, T) {
    const ROUND: f64 = 12_582_912.0; // 1.5·2²³
    const TOO_LARGE: f64 = f64::from_bits((1023 + 108) << 52); // 2¹⁰⁸: times 2²⁰ infinite, times less not
    let rounded = madd(x, T::of(pi32::FRAC_2_PI as f64), T::of(ROUND));
    let r = or_nan(reduce_single(x, rounded - T::of(ROUND)), x * T::of(TOO_LARGE));

    let z = r * r;
    let s = madd(z, linear(z, -1.949_595_5e-4, 8.331_982e-3), T::of(-1.666_665_1e-1));
    let c = madd(z, linear(z, 2.443_066_1e-5, -1.388_730_1e-3), T::of(4.166_664_6e-2));
    let sin = madd(r * z, s, r);
    let cos = madd(z * z, c, of_halves(z));

    T::turn(sin, cos, rounded)
}

/// `r = x − k·π/2`, with π/2 in parts short enough that the first products are exact.
#[inline(always)]
fn reduce_single<T: Kernel>(x: T, k: T) -> T {
    if FUSED {
        let r = madd(-k, T::of(pi32::FRAC_PI_2 as f64), x); // exact
        madd(-k, T::of(-4.371_139e-8), r)
    } else {
        // 11, 11 and 24 bits: the first two products are exact for |k| ≤ 2¹³.
        const P1: f32 = f32::from_bits(0x3FC9_0000);
        const P2: f32 = f32::from_bits(0x39FD_A000);
        const P3: f32 = f32::from_bits(0x33A2_2169);
        ((x - k * T::of(P1 as f64)) - k * T::of(P2 as f64)) - k * T::of(P3 as f64)
    }
}

/// `r`, and NaN where `size` is not finite.
#[inline(always)]
fn or_nan<T: Scalar>(r: T, size: T) -> T {
    madd(size, T::zero(), r)
}

/// `slope·x + offset`, fused where the target can.
#[inline(always)]
fn linear<T: Scalar>(x: T, slope: f64, offset: f64) -> T {
    madd(x, T::of(slope), T::of(offset))
}

/// `a·b + c`, fused where the target can.
#[inline(always)]
fn madd<T: Scalar>(a: T, b: T, c: T) -> T {
    a.mul_add(b, c)
}

#[cfg(test)]
mod tests;
