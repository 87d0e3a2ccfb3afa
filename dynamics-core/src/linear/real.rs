//! The scalars that can be compared: what decisions of rank, of stability and of convergence need.

use num_traits::NumAssign;

use crate::scalar::Scalar;

/// A [`Scalar`] that is one real number: `f32` or `f64`.
pub trait Real: Scalar + PartialOrd + NumAssign {
    /// The distance from 1 to the next number.
    const EPSILON: Self;

    /// The number, for a message.
    fn to_f64(self) -> f64;

    /// `|self|`.
    #[inline]
    fn abs(self) -> Self {
        if self < Self::zero() { -self } else { self }
    }

    /// The larger of the two; `self` where `other` is NaN.
    #[inline]
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    /// Two numbers with half of the digits whose sum is `self`.
    fn halves(self) -> (Self, Self);

    /// The smallest power of two that is not below `self`, exact as a factor; one where there is none.
    fn power_of_two(self) -> Self {
        let (two, half) = (Self::of(2.0), Self::of(0.5));
        if !(self > Self::zero() && self.is_finite()) {
            return Self::one();
        }
        let mut power = Self::one();
        while power < self && (power * two).is_finite() {
            power *= two;
        }
        while power * half >= self && (Self::one() / (power * half)).is_finite() {
            power *= half;
        }
        power
    }
}

macro_rules! impl_real {
    ($float:ident) => {
        impl Real for $float {
            const EPSILON: Self = $float::EPSILON;

            #[inline]
            fn to_f64(self) -> f64 {
                self.into()
            }

            #[inline]
            fn halves(self) -> (Self, Self) {
                let spread = self * ((1_u32 << $float::MANTISSA_DIGITS.div_ceil(2)) + 1) as $float;
                let high = spread - (spread - self);
                (high, self - high)
            }
        }
    };
}

impl_real!(f64);
impl_real!(f32);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_two_bound_from_above() {
        assert_eq!(Real::power_of_two(1.0), 1.0);
        assert_eq!(Real::power_of_two(1.5), 2.0);
        assert_eq!(Real::power_of_two(0.3_f32), 0.5);
        for nothing in [0.0, -3.0, f64::NAN, f64::INFINITY] {
            assert_eq!(Real::power_of_two(nothing), 1.0);
        }
        for extreme in [f64::MAX, f64::MIN_POSITIVE, 5e-324] {
            let power = Real::power_of_two(extreme);
            assert!(power.is_finite() && (1.0 / power).is_finite());
        }
    }
}
