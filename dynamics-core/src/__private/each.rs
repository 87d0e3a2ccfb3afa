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
    for (number, value) in each.iter_mut().zip(values) {
        *number = T::of(value);
    }
    Each(each)
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
