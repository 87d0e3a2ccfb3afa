//! The numbers the generated code computes with.
//!
//! Straight-line code asks little of a number: ring operations, division, a constant, a sine with its cosine, a
//! square root. There is no comparison here, so that dual numbers and SIMD lanes can be scalars.

use core::ops::Neg;

use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign};
pub use num_traits::{One, Zero};

#[cfg(feature = "simd")]
use crate::lanes::sines::pair as sin_cos_double;
use crate::trigonometry::sin_cos_f32;
#[cfg(not(feature = "simd"))]
use crate::trigonometry::sin_cos_f64 as sin_cos_double;

/// Whether [`Scalar::mul_add`] of `f32` and `f64` rounds once, by one instruction.
///
/// True with feature `std` on a target with fused multiply-add: x86 with `-C target-feature=+fma` (or a
/// `target-cpu` that has it) and aarch64. Elsewhere a fused operation would be a library call, so `a·b + c` it is.
pub const FUSED: bool = cfg!(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64")));

/// The most branches that are in a line of code each.
const SPELT_OUT: usize = 14;

/// Computes one branch.
macro_rules! branch {
    ($F:ident, $own:ident, $shared:ident, $results:ident, $branch:expr) => {
        $F::of(Single { own: $own, shared: $shared, results: &mut $results, branch: $branch })
    };
}

/// A real number, or several of them side by side, or one with its derivatives.
///
/// Implemented for `f32` and `f64`. Every method of an implementation should be `#[inline(always)]`: generated code
/// calls them by the hundred, and firmware built without optimisation links whatever is not inlined.
pub trait Scalar:
    nalgebra::Scalar
    + Copy
    + Zero
    + One
    + ClosedAddAssign
    + ClosedSubAssign
    + ClosedMulAssign
    + ClosedDivAssign
    + Neg<Output = Self>
{
    /// The constant `value`, rounded to `Self`.
    fn of(value: f64) -> Self;

    /// `(sin self, cos self)`, the angle in radians, from one range reduction.
    ///
    /// For `f32` and `f64` the kernels of [`trigonometry`](crate::trigonometry), which state range and error.
    fn sin_cos(self) -> (Self, Self);

    /// The sines, then the cosines, of several angles: to the bit what [`sin_cos`](Self::sin_cos) gives of each.
    ///
    /// With feature `simd`, `f32` and `f64` compute four of them side by side.
    #[inline(always)]
    fn sin_cos_each<const N: usize>(angles: [Self; N]) -> [[Self; N]; 2] {
        one_by_one(angles)
    }

    /// What `F` makes of each of `N` branches, with the bits that it makes of one alone: `own` are the numbers that each
    /// branch has of its own, `shared` those that all have.
    ///
    /// With feature `simd`, `f32` and `f64` compute several branches side by side. Without it they come one after the
    /// other in a loop; those of scalars that are wider each in a line of its own, which keeps them in registers.
    #[inline(always)]
    fn of_each<F: Elementwise, const N: usize, const I: usize, const J: usize, const K: usize>(
        own: &[[Self; N]; I],
        shared: &[Self; J],
    ) -> [[Self; N]; K] {
        let mut results = [[Self::zero(); N]; K];
        macro_rules! spelt_out {
            ($($branch:literal)*) => {
                $(if const { $branch < N && N <= SPELT_OUT } {
                    branch!(F, own, shared, results, $branch);
                })*
            };
        }
        spelt_out!(0 1 2 3 4 5 6 7 8 9 10 11 12 13);
        if const { N > SPELT_OUT } {
            for branch in 0..N {
                branch!(F, own, shared, results, branch);
            }
        }
        results
    }

    /// The transpose of a tile, four columns of four rows.
    ///
    /// With feature `simd`, `f32` and `f64` exchange several numbers at a time.
    #[inline(always)]
    #[rustfmt::skip]
    fn transposed([[a, b, c, d], [e, f, g, h], [i, j, k, l], [m, n, o, p]]: [[Self; 4]; 4]) -> [[Self; 4]; 4] {
        // Entry by entry: loops would become gathers.
        [[a, e, i, m], [b, f, j, n], [c, g, k, o], [d, h, l, p]]
    }

    /// `√self`; NaN below zero.
    ///
    /// Correctly rounded for `f32` and `f64` with feature `std` or `libm`, within 1 ulp without either.
    fn sqrt(self) -> Self;

    /// Whether `self` is neither infinite nor NaN, in every lane and derivative it has.
    fn is_finite(self) -> bool;

    /// `self·a + b`, rounded once where that is one instruction ([`FUSED`]), else twice.
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }
}

/// What is computed of each of several branches of a robot that are alike, for [`Scalar::of_each`].
pub trait Elementwise {
    /// Computes the results of one branch, or of as many as lanes hold.
    fn of<S: Scalar>(each: impl Branches<S>);
}

/// One branch, or as many as lanes hold. Not in closures, which nothing obliges a compiler to inline: what they share would
/// stay in memory.
pub trait Branches<S> {
    /// A number that the branch has of its own, by its place.
    fn own(&self, place: usize) -> S;

    /// A number that all branches share.
    fn shared(&self, place: usize) -> S;

    /// Takes a result.
    fn give(&mut self, place: usize, value: S);
}

/// One branch of several.
struct Single<'a, T, const N: usize, const I: usize, const J: usize, const K: usize> {
    own: &'a [[T; N]; I],
    shared: &'a [T; J],
    results: &'a mut [[T; N]; K],
    branch: usize,
}

impl<T: Copy, const N: usize, const I: usize, const J: usize, const K: usize> Branches<T>
    for Single<'_, T, N, I, J, K>
{
    #[inline(always)]
    fn own(&self, place: usize) -> T {
        self.own[place][self.branch]
    }

    #[inline(always)]
    fn shared(&self, place: usize) -> T {
        self.shared[place]
    }

    #[inline(always)]
    fn give(&mut self, place: usize, value: T) {
        self.results[place][self.branch] = value;
    }
}

/// [`Scalar::sin_cos`] of each angle.
#[inline(always)]
fn one_by_one<T: Scalar, const N: usize>(angles: [T; N]) -> [[T; N]; 2] {
    let [mut sines, mut cosines] = [angles; 2];
    for ((sine, cosine), angle) in sines.iter_mut().zip(&mut cosines).zip(angles) {
        (*sine, *cosine) = angle.sin_cos();
    }
    [sines, cosines]
}

macro_rules! impl_scalar {
    ($float:ident, $sin_cos:path, $libm_sqrt:path, $own_sqrt:path) => {
        impl Scalar for $float {
            #[inline(always)]
            fn of(value: f64) -> Self {
                value as $float
            }

            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                $sin_cos(self)
            }

            #[inline(always)]
            fn sin_cos_each<const N: usize>(angles: [Self; N]) -> [[Self; N]; 2] {
                #[cfg(feature = "simd")]
                return crate::lanes::sines::$float(angles);
                #[cfg(not(feature = "simd"))]
                return one_by_one(angles);
            }

            #[cfg(feature = "simd")]
            #[inline(always)]
            fn of_each<F: Elementwise, const N: usize, const I: usize, const J: usize, const K: usize>(
                own: &[[Self; N]; I],
                shared: &[Self; J],
            ) -> [[Self; N]; K] {
                crate::lanes::together::$float::<F, N, I, J, K>(own, shared)
            }

            #[cfg(not(feature = "simd"))]
            #[inline(always)]
            fn of_each<F: Elementwise, const N: usize, const I: usize, const J: usize, const K: usize>(
                own: &[[Self; N]; I],
                shared: &[Self; J],
            ) -> [[Self; N]; K] {
                let mut results = [[0.0; N]; K];
                for branch in 0..N {
                    branch!(F, own, shared, results, branch);
                }
                results
            }

            #[cfg(feature = "simd")]
            #[inline(always)]
            fn transposed(tile: [[Self; 4]; 4]) -> [[Self; 4]; 4] {
                <Self as crate::lanes::tiles::Tile<4>>::transposed(tile)
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                #[cfg(feature = "std")]
                return $float::sqrt(self);
                #[cfg(all(feature = "libm", not(feature = "std")))]
                return $libm_sqrt(self);
                #[cfg(not(any(feature = "libm", feature = "std")))]
                return $own_sqrt(self);
            }

            #[inline(always)]
            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }

            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                #[cfg(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64")))]
                return $float::mul_add(self, a, b);
                #[cfg(not(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64"))))]
                return self * a + b;
            }
        }
    };
}

impl_scalar!(f64, sin_cos_double, libm::sqrt, crate::square_root::sqrt_f64);
impl_scalar!(f32, sin_cos_f32, libm::sqrtf, crate::square_root::sqrt_f32);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_are_rounded_to_the_scalar() {
        assert_eq!(<f32 as Scalar>::of(core::f64::consts::PI), core::f32::consts::PI);
        assert_eq!(<f64 as Scalar>::of(core::f64::consts::PI), core::f64::consts::PI);
    }

    #[test]
    fn mul_add_rounds_once_exactly_where_the_constant_says_so() {
        let x = 1.0 + f64::EPSILON;
        let lost_by_rounding = Scalar::mul_add(x, x, -(x * x));
        assert_eq!(lost_by_rounding != 0.0, FUSED);
    }
}
