//! What is computed of each branch of a robot whose branches are alike: by one piece of code, in lanes where the scalar
//! has such.

use crate::scalar::Scalar;
pub use crate::scalar::{Branches, Elementwise};

/// What `F` makes of each of `N` branches, of their `own` numbers and of those that they `share`: K results, each a
/// number for every branch.
#[inline(always)]
pub fn of_each<F, T, const N: usize, const I: usize, const J: usize, const K: usize>(
    own: [[T; N]; I],
    shared: [T; J],
) -> [[T; N]; K]
where
    F: Elementwise,
    T: Scalar,
{
    T::of_each::<F, N, I, J, K>(&own, &shared)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Some operations of each kind.
    struct Sample;

    impl Elementwise for Sample {
        fn of<S: Scalar>(mut each: impl Branches<S>) {
            let (a, b, c) = (each.own(0), each.own(1), each.shared(0));
            let (sin, cos) = a.sin_cos();
            each.give(0, a + b * c);
            each.give(1, (a - b) / c);
            each.give(2, -a.mul_add(b, c));
            each.give(3, b.sqrt() + S::of(0.3));
            each.give(4, sin);
            each.give(5, cos);
        }
    }

    /// One branch, in floats.
    struct Alone<'a, T> {
        own: [T; 2],
        shared: [T; 1],
        results: &'a mut [T; 6],
    }

    impl<T: Scalar> Branches<T> for Alone<'_, T> {
        fn own(&self, place: usize) -> T {
            self.own[place]
        }

        fn shared(&self, place: usize) -> T {
            self.shared[place]
        }

        fn give(&mut self, place: usize, value: T) {
            self.results[place] = value;
        }
    }

    /// All at once, and one after the other.
    fn agree<T: Scalar, const N: usize>() {
        let row = |a: f64, b: f64| {
            let mut k = 0.0;
            [T::zero(); N].map(|_| {
                k += 1.0;
                T::of((a * k).sin() + b)
            })
        };
        let (own, shared) = ([row(1.3, 0.2), row(0.7, 1.9)], [T::of(2.1)]);
        let together: [[T; N]; 6] = of_each::<Sample, T, N, 2, 1, 6>(own, shared);
        for k in 0..N {
            let mut alone = [T::zero(); 6];
            Sample::of(Alone { own: own.map(|row| row[k]), shared, results: &mut alone });
            assert_eq!(together.map(|row| row[k]), alone, "of {N}, number {k}");
        }
    }

    #[test]
    fn each_number_has_the_bits_of_one_alone() {
        agree::<f64, 2>();
        agree::<f64, 3>();
        agree::<f64, 4>();
        agree::<f64, 5>();
        agree::<f64, 6>();
        agree::<f64, 8>();
        agree::<f64, 9>();
        agree::<f32, 2>();
        agree::<f32, 3>();
        agree::<f32, 6>();
        agree::<f32, 9>();
        #[cfg(feature = "simd")]
        agree::<crate::lanes::f64x4, 3>();
    }
}
