//! Numbers with twice the digits, as sums of two: for residuals, where all that is known cancels.

use nalgebra::SMatrix;

use super::real::Real;

/// `high + low`, with a `low` below the last digit of `high`.
///
/// # Source
///
/// T. Dekker, *A floating-point technique for extending the available precision*, Numerische Mathematik 18 (1971)
/// 224–242.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Twice<T> {
    high: T,
    low: T,
}

impl<T: Real> Twice<T> {
    /// The number x, exactly.
    pub(crate) fn of(x: T) -> Self {
        Self { high: x, low: T::zero() }
    }

    /// The nearest number of one.
    pub(crate) fn rounded(self) -> T {
        self.high + self.low
    }

    /// `−self`.
    pub(crate) fn negated(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }

    /// `x + y` of two numbers, exactly.
    fn sum(x: T, y: T) -> Self {
        let high = x + y;
        let of_y = high - x;
        let of_x = high - of_y;
        Self { high, low: (x - of_x) + (y - of_y) }
    }

    /// `x·y` of two numbers, exactly.
    fn product(x: T, y: T) -> Self {
        let high = x * y;
        let (x1, x2) = x.halves();
        let (y1, y2) = y.halves();
        Self { high, low: ((x1 * y1 - high) + x1 * y2 + x2 * y1) + x2 * y2 }
    }

    /// The sum of two.
    pub(crate) fn plus(self, other: Self) -> Self {
        let sum = Self::sum(self.high, other.high);
        Self::sum(sum.high, sum.low + (self.low + other.low))
    }

    /// The product of two.
    fn times(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        Self::sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

/// A matrix of numbers with twice the digits.
pub(crate) type TwiceMatrix<T, const R: usize, const C: usize> = SMatrix<Twice<T>, R, C>;

/// `A·B`.
pub(crate) fn twice_product<T: Real, const I: usize, const J: usize, const K: usize>(
    a: &TwiceMatrix<T, I, J>,
    b: &TwiceMatrix<T, J, K>,
) -> TwiceMatrix<T, I, K> {
    let zero = Twice::of(T::zero());
    SMatrix::from_fn(|i, k| (0..J).fold(zero, |sum, j| sum.plus(a[(i, j)].times(b[(j, k)]))))
}

/// `A + B`.
pub(crate) fn twice_sum<T: Real, const R: usize, const C: usize>(
    a: &TwiceMatrix<T, R, C>,
    b: &TwiceMatrix<T, R, C>,
) -> TwiceMatrix<T, R, C> {
    SMatrix::from_fn(|i, j| a[(i, j)].plus(b[(i, j)]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cancels_keeps_its_digits() {
        let (x, y) = (1.0 + f64::EPSILON, 1.0 - f64::EPSILON);
        let one = Twice::of(1.0);
        let product = Twice::of(x).times(Twice::of(y)); // 1 − ε²
        assert_eq!(product.plus(one.negated()).rounded(), -f64::EPSILON * f64::EPSILON);
        let tiny = Twice::of(1e-20_f64);
        let sum = one.plus(tiny).plus(one.negated());
        assert_eq!(sum.rounded(), 1e-20);
        let single = Twice::of(1.0_f32 + f32::EPSILON).times(Twice::of(1.0 - f32::EPSILON));
        assert_eq!(single.plus(Twice::of(-1.0)).rounded(), -f32::EPSILON * f32::EPSILON);
    }
}
