//! What is computed of each of several branches, in lanes.
//!
//! By name, as the [sines](super::sines) are: compilers find no lanes within a long function. Branches that fit into a
//! register are one run of the code, and so are those of a second one; the last register begins early enough to be full.

use super::{f32x4, f32x8, f64x2, f64x4, f64x8};
use crate::scalar::{Branches, Elementwise};

/// Whether registers hold four doubles.
const HAS_256_BITS: bool = cfg!(target_feature = "avx");
/// Whether registers hold eight doubles.
const HAS_512_BITS: bool = cfg!(target_feature = "avx512f");

macro_rules! together {
    ($name:ident: $float:ident, $lanes:ident[$($place:literal)*] of $width:literal) => {
        #[inline(always)]
        fn $name<F: Elementwise, const N: usize, const I: usize, const J: usize, const K: usize>(
            own: &[[$float; N]; I],
            shared: &[$float; J],
        ) -> [[$float; N]; K] {
            let mut results = [[0.0; N]; K];
            // A macro, so that the code is inlined as often as it stands here.
            macro_rules! compute {
                ($first:expr) => {
                    F::of::<$lanes>(Register { own, shared, results: &mut results, first: $first })
                };
            }
            // Decided where `N` becomes a number: the compiler sees no code that is not run.
            if const { N <= 2 * $width } {
                compute!(0);
                if const { N > $width } {
                    compute!(N - $width);
                }
            } else {
                for register in 0..N.div_ceil($width) {
                    compute!(($width * register).min(N - $width));
                }
            }
            results
        }

        impl<const N: usize, const I: usize, const J: usize, const K: usize> Branches<$lanes>
            for Register<'_, $float, N, I, J, K>
        {
            #[inline(always)]
            fn own(&self, place: usize) -> $lanes {
                let numbers = &self.own[place];
                // Behind the numbers there are ones.
                $lanes::from([$(if $place < N { numbers[self.first + $place] } else { 1.0 }),*])
            }

            #[inline(always)]
            fn shared(&self, place: usize) -> $lanes {
                $lanes::from(self.shared[place])
            }

            #[inline(always)]
            fn give(&mut self, place: usize, value: $lanes) {
                let (lanes, results) = (value.to_array(), &mut self.results[place]);
                $(if $place < N {
                    results[self.first + $place] = lanes[$place];
                })*
            }
        }
    };
}

/// As many branches as a register holds, from the first on.
struct Register<'a, T, const N: usize, const I: usize, const J: usize, const K: usize> {
    own: &'a [[T; N]; I],
    shared: &'a [T; J],
    results: &'a mut [[T; N]; K],
    first: usize,
}

together!(by_f64x2: f64, f64x2[0 1] of 2);
together!(by_f64x4: f64, f64x4[0 1 2 3] of 4);
together!(by_f64x8: f64, f64x8[0 1 2 3 4 5 6 7] of 8);
together!(by_f32x4: f32, f32x4[0 1 2 3] of 4);
together!(by_f32x8: f32, f32x8[0 1 2 3 4 5 6 7] of 8);

/// What `F` makes of each of N branches.
#[inline(always)]
pub(crate) fn f64<F: Elementwise, const N: usize, const I: usize, const J: usize, const K: usize>(
    own: &[[f64; N]; I],
    shared: &[f64; J],
) -> [[f64; N]; K] {
    if const { HAS_512_BITS && N > 4 } {
        by_f64x8::<F, N, I, J, K>(own, shared)
    } else if const { HAS_256_BITS && N > 2 } {
        by_f64x4::<F, N, I, J, K>(own, shared)
    } else {
        by_f64x2::<F, N, I, J, K>(own, shared)
    }
}

/// What `F` makes of each of N branches.
#[inline(always)]
pub(crate) fn f32<F: Elementwise, const N: usize, const I: usize, const J: usize, const K: usize>(
    own: &[[f32; N]; I],
    shared: &[f32; J],
) -> [[f32; N]; K] {
    if const { HAS_256_BITS && N > 4 } {
        by_f32x8::<F, N, I, J, K>(own, shared)
    } else {
        by_f32x4::<F, N, I, J, K>(own, shared)
    }
}
