//! Comparisons of scalars, and their rounding.

use crate::scalar::Scalar;

/// `|x|`
pub(super) fn magnitude<T: Scalar + PartialOrd>(x: T) -> T {
    if x < T::zero() { -x } else { x }
}

/// The larger one; the first if they do not compare.
pub(super) fn larger<T: PartialOrd>(a: T, b: T) -> T {
    if b > a { b } else { a }
}

/// The smaller one; the first if they do not compare.
pub(super) fn smaller<T: PartialOrd>(a: T, b: T) -> T {
    if b < a { b } else { a }
}

/// `a ≤ b`, of scalars that do not compare: below zero there is no root.
pub(super) fn is_at_most<T: Scalar>(a: T, b: T) -> bool {
    (b - a).sqrt().is_finite()
}

/// The distance from 1 to the next number, by what thirds lose (M. Malcolm 1972).
pub(crate) fn rounding<T: Scalar>() -> T {
    let third = T::of(4.0) / T::of(3.0) - T::one();
    let lost = third + third + third - T::one();
    (lost * lost).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_is_that_of_the_scalar() {
        assert_eq!((rounding::<f64>(), rounding::<f32>()), (f64::EPSILON, f32::EPSILON));
    }

    #[test]
    fn order_needs_no_comparison() {
        assert!(is_at_most(1.0, 1.0) && is_at_most(1.0, 2.0) && !is_at_most(2.0, 1.0));
        assert!(!is_at_most(f64::NAN, 1.0) && !is_at_most(1.0, f64::NAN));
    }

    #[test]
    fn what_does_not_compare_is_the_second() {
        assert_eq!((larger(1.0, f64::NAN), smaller(1.0, f64::NAN)), (1.0, 1.0));
        assert_eq!((larger(1.0, 2.0), smaller(1.0, 2.0), magnitude(-3.0)), (2.0, 1.0, 3.0));
    }
}
