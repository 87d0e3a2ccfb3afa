//! One operation on as many numbers as there are, in lanes.
//!
//! By name, as the [sines](super::sines) are: compilers find no lanes within a long function. Without loops: generated code
//! calls this by the hundred in one function, and with loops to unroll in each call a humanoid's forward dynamics took 20 s
//! to compile. Numbers that fill the lanes are taken whole, which takes a fifth off what is left.

use super::{f32x4, f32x8, f64x2, f64x4, f64x8};
use crate::scalar::Elementwise;

macro_rules! together {
    ($float:ident: $($lanes:ident[$($place:literal)*] of $width:literal for $n:pat),*) => {
        /// The operation on each number.
        #[inline]
        pub(crate) fn $float<F: Elementwise, const N: usize>(operands: [&[$float; N]; 3]) -> [$float; N] {
            let [a, b, c] = operands;
            let mut results = *a;
            match N {
                $($n => {
                    let lanes = |numbers: &[$float; N]| match numbers.first_chunk::<$width>() {
                        Some(numbers) => $lanes::from(*numbers),
                        // Behind the numbers there are ones.
                        None => $lanes::from([$(if $place < N { numbers[$place] } else { 1.0 }),*]),
                    };
                    let lanes = F::of([lanes(a), lanes(b), lanes(c)]).to_array();
                    match results.first_chunk_mut::<$width>() {
                        Some(results) => *results = lanes,
                        None => {
                            $(if $place < N {
                                results[$place] = lanes[$place];
                            })*
                        }
                    }
                })*
                _ => {
                    for (((result, a), b), c) in results.iter_mut().zip(a).zip(b).zip(c) {
                        *result = F::of([*a, *b, *c]);
                    }
                }
            }
            results
        }
    };
}

together!(f64: f64x2[0 1] of 2 for 2, f64x4[0 1 2 3] of 4 for 3..=4, f64x8[0 1 2 3 4 5 6 7] of 8 for 5..=8);
together!(f32: f32x4[0 1 2 3] of 4 for 2..=4, f32x8[0 1 2 3 4 5 6 7] of 8 for 5..=8);
