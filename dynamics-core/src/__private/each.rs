//! Numbers side by side: one of each branch of a robot whose branches are alike.
//!
//! Generated code computes with them as with one number; lanes hold them where the scalar has such.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::scalar::{Elementwise, One, Scalar, Zero};

/// `N` numbers, on each of which every operation acts alone, with the bits of one operation on one number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Each<T, const N: usize>(pub [T; N]);

/// The same number `N` times.
#[inline(always)]
pub const fn each<T: Copy, const N: usize>(value: T) -> Each<T, N> {
    Each([value; N])
}

/// Constants.
#[inline(always)]
pub fn each_of<T: Scalar, const N: usize>(values: [f64; N]) -> Each<T, N> {
    let mut each = [T::zero(); N];
    let mut place = 0;
    while place < N {
        each[place] = T::of(values[place]); // no iterators: LLVM takes a quarter longer with them
        place += 1;
    }
    Each(each)
}

impl<T: Copy, const N: usize> Each<T, N> {
    /// The same numbers in a circle, from that at `FIRST` on.
    #[inline(always)]
    pub fn turned<const FIRST: usize>(self) -> Self {
        // Not `rotate_left`, which goes through memory.
        Self(core::array::from_fn(|k| self.0[(FIRST + k) % N]))
    }
}

macro_rules! operator {
    ($trait:ident $method:ident $assign:ident $assigning:ident) => {
        impl<T: Scalar, const N: usize> $trait for Each<T, N> {
            type Output = Self;

            #[inline]
            fn $method(self, other: Self) -> Self {
                struct Operation;
                impl Elementwise for Operation {
                    #[inline(always)]
                    fn of<S: Scalar>([a, b, _]: [S; 3]) -> S {
                        $trait::$method(a, b)
                    }
                }
                Self(T::each::<Operation, N>([&self.0, &other.0, &other.0]))
            }
        }

        impl<T: Scalar, const N: usize> $assign for Each<T, N> {
            #[inline]
            fn $assigning(&mut self, other: Self) {
                *self = $trait::$method(*self, other);
            }
        }
    };
}

operator!(Add add AddAssign add_assign);
operator!(Sub sub SubAssign sub_assign);
operator!(Mul mul MulAssign mul_assign);
operator!(Div div DivAssign div_assign);

struct Negative;

impl Elementwise for Negative {
    #[inline]
    fn of<S: Scalar>([a, ..]: [S; 3]) -> S {
        -a
    }
}

struct Root;

impl Elementwise for Root {
    #[inline]
    fn of<S: Scalar>([a, ..]: [S; 3]) -> S {
        a.sqrt()
    }
}

struct MultiplyAdd;

impl Elementwise for MultiplyAdd {
    #[inline]
    fn of<S: Scalar>([a, b, c]: [S; 3]) -> S {
        a.mul_add(b, c)
    }
}

impl<T: Scalar, const N: usize> Neg for Each<T, N> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self(T::each::<Negative, N>([&self.0; 3]))
    }
}

impl<T: Scalar, const N: usize> Zero for Each<T, N> {
    #[inline]
    fn zero() -> Self {
        each(T::zero())
    }

    #[inline]
    fn is_zero(&self) -> bool {
        self.0.iter().all(T::is_zero)
    }
}

impl<T: Scalar, const N: usize> One for Each<T, N> {
    #[inline]
    fn one() -> Self {
        each(T::one())
    }
}

impl<T: Scalar, const N: usize> Scalar for Each<T, N> {
    #[inline]
    fn of(value: f64) -> Self {
        each(T::of(value))
    }

    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let [sines, cosines] = T::sin_cos_each(self.0);
        (Self(sines), Self(cosines))
    }

    #[inline]
    fn sqrt(self) -> Self {
        Self(T::each::<Root, N>([&self.0; 3]))
    }

    #[inline]
    fn is_finite(self) -> bool {
        self.0.into_iter().all(T::is_finite)
    }

    #[inline]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self(T::each::<MultiplyAdd, N>([&self.0, &a.0, &b.0]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every operation on `N` numbers, and on one after the other.
    fn agree<T: Scalar, const N: usize>() {
        let row = |a: f64, b: f64| {
            let mut k = 0.0;
            Each([T::zero(); N].map(|_| {
                k += 1.0;
                T::of((a * k).sin() + b)
            }))
        };
        let (a, b, c) = (row(1.3, 0.2), row(0.7, 1.9), row(2.1, -0.4));
        let (sin, cos) = a.sin_cos();
        for k in 0..N {
            let (x, y, z) = (a.0[k], b.0[k], c.0[k]);
            assert_eq!((a + b).0[k], x + y);
            assert_eq!((a - b).0[k], x - y);
            assert_eq!((a * b).0[k], x * y);
            assert_eq!((a / b).0[k], x / y);
            assert_eq!((-a).0[k], -x);
            assert_eq!(a.mul_add(b, c).0[k], x.mul_add(y, z));
            assert_eq!(b.sqrt().0[k], y.sqrt());
            assert_eq!((sin.0[k], cos.0[k]), x.sin_cos());
        }
        assert!(a.is_finite() && !(a / Each::zero()).is_finite());
        assert_eq!(a.turned::<1>().0.as_slice(), [&a.0[1..], &a.0[..1]].concat());
        assert_eq!(Each::<T, N>::of(0.3), each(T::of(0.3)));
        assert_eq!(each_of::<T, N>([0.3; N]), each(T::of(0.3)));
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
