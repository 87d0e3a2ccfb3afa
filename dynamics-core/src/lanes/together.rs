//! One operation on as many numbers as there are, in lanes.
//!
//! By name, as the [sines](super::sines) are: compilers find no lanes within a long function.

use super::{f32x4, f32x8, f64x2, f64x4, f64x8};
use crate::scalar::Elementwise;

macro_rules! together {
    ($float:ident: $($lanes:ident of $count:literal for $n:pat),*) => {
        /// The operation on each number.
        #[inline]
        pub(crate) fn $float<F: Elementwise, const N: usize>(operands: [&[$float; N]; 3]) -> [$float; N] {
            let [a, b, c] = operands;
            let mut results = *a;
            match N {
                $($n => {
                    let [a, b, c] = [padded(a), padded(b), padded(c)];
                    let lanes: [$float; $count] = F::of([$lanes::from(a), $lanes::from(b), $lanes::from(c)]).to_array();
                    for (result, lane) in results.iter_mut().zip(lanes) {
                        *result = lane;
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

together!(f64: f64x2 of 2 for 2, f64x4 of 4 for 3..=4, f64x8 of 8 for 5..=8);
together!(f32: f32x4 of 4 for 2..=4, f32x8 of 8 for 5..=8);

/// The numbers, and ones behind them.
#[inline]
fn padded<T: num_traits::One + Copy, const N: usize, const M: usize>(numbers: &[T; N]) -> [T; M] {
    let mut padded = [T::one(); M];
    for (place, number) in padded.iter_mut().zip(numbers) {
        *place = *number;
    }
    padded
}
