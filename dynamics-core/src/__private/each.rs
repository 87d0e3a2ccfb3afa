//! What is computed of each branch of a robot whose branches are alike: by one piece of code, in lanes where the scalar
//! has such.

pub use crate::scalar::Elementwise;
use crate::scalar::Scalar;

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
        fn of<S: Scalar>(
            own: impl Fn(usize) -> S,
            shared: impl Fn(usize) -> S,
            mut give: impl FnMut(usize, S),
        ) {
            let (a, b, c) = (own(0), own(1), shared(0));
            let (sin, cos) = a.sin_cos();
            give(0, a + b * c);
            give(1, (a - b) / c);
            give(2, -a.mul_add(b, c));
            give(3, b.sqrt() + S::of(0.3));
            give(4, sin);
            give(5, cos);
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
            Sample::of(|i| own[i][k], |j| shared[j], |place, value| alone[place] = value);
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
