//! Floating point of about 104 bits: the unevaluated sum of two doubles.
//!
//! Only `+ - * /` and the square root of IEEE 754 doubles are used, and products are split by hand:
//! no fused operation, no library function, hence the same bits on every host.
//!
//! T. Dekker, *A floating-point technique for extending the available precision*, Numer. Math. 18
//! (1971); M. Joldes, J.-M. Muller, V. Popescu, *Tight and rigorous error bounds for basic building
//! blocks of double-word arithmetic*, ACM TOMS 44 (2017).
#![allow(clippy::should_implement_trait, reason = "named so that a rounded operation shows")]

use std::cmp::Ordering;
use std::fmt;

/// `hi + lo` with `hi` the double nearest to the sum, or the mark of what is no number.
///
/// The parts are unique to the value and kept as bits without negative zeros: equal values, and only
/// those, are `==`. Close to the smallest normal double (below 2^-969) `lo` runs out of bits.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Wide {
    hi: u64,
    lo: u64,
}

impl Wide {
    pub(super) const ZERO: Self = Self { hi: 0, lo: 0 };
    pub(super) const ONE: Self = Self { hi: 0x3ff0_0000_0000_0000, lo: 0 };
    pub(super) const PI: Self = Self { hi: 0x4009_21fb_5444_2d18, lo: 0x3ca1_a626_3314_5c07 };
    /// The mark of a result that is no number or is beyond the range of doubles.
    pub(super) const NAN: Self = Self { hi: 0x7ff8_0000_0000_0000, lo: 0 };

    /// The double nearest to the value.
    pub fn hi(self) -> f64 {
        f64::from_bits(self.hi)
    }

    /// What [`hi`](Self::hi) leaves out.
    pub fn lo(self) -> f64 {
        f64::from_bits(self.lo)
    }

    /// `hi + lo`, for `|hi| ≥ |lo|` or `hi = 0`.
    pub(super) fn new(hi: f64, lo: f64) -> Self {
        let sum = hi + lo;
        if !sum.is_finite() {
            return Self::NAN;
        }
        let rest = lo - (sum - hi);
        // Adding zero turns -0 into +0.
        Self { hi: (sum + 0.0).to_bits(), lo: (rest + 0.0).to_bits() }
    }

    /// `hi + lo` rounded such that `hi` stays, although `lo` may be half a unit in its last place.
    pub(super) fn keeping_hi(hi: f64, lo: f64) -> Self {
        let towards_zero = || f64::from_bits(lo.to_bits() - 1);
        Self::new(hi, if hi + lo == hi { lo } else { towards_zero() })
    }

    pub(super) fn from_f64(value: f64) -> Self {
        Self::new(value, 0.0)
    }

    pub(super) fn from_i128(value: i128) -> Self {
        let hi = value as f64;
        let magnitude = value.unsigned_abs();
        // Both are at most 2^127 and close to each other.
        let rest = magnitude.wrapping_sub(hi.abs() as u128) as i128 as f64;
        Self::new(hi, if value < 0 { -rest } else { rest })
    }

    /// `a · b` without an error, for factors of moderate size.
    pub(super) fn product(a: f64, b: f64) -> Self {
        let (hi, lo) = two_product(a, b);
        Self::new(hi, lo)
    }

    pub(super) fn is_finite(self) -> bool {
        self.hi != Self::NAN.hi
    }

    pub(super) fn is_zero(self) -> bool {
        self.hi == 0
    }

    pub(super) fn is_negative(self) -> bool {
        self.hi() < 0.0
    }

    pub(super) fn neg(self) -> Self {
        if self.is_finite() { Self::new(-self.hi(), -self.lo()) } else { self }
    }

    /// Relative error below 2^-104, also after cancellation.
    pub(super) fn add(self, rhs: Self) -> Self {
        let (hi, high_rest) = two_sum(self.hi(), rhs.hi());
        let (low, low_rest) = two_sum(self.lo(), rhs.lo());
        let (hi, rest) = quick_two_sum(hi, high_rest + low);
        Self::new(hi, rest + low_rest)
    }

    pub(super) fn sub(self, rhs: Self) -> Self {
        self.add(rhs.neg())
    }

    /// Relative error below 2^-103.
    pub(super) fn mul(self, rhs: Self) -> Self {
        if self.is_moderate() && rhs.is_moderate() {
            return self.mul_moderate(rhs);
        }
        self.by_mantissas(rhs, Self::mul_moderate, |a, b| a + b)
    }

    fn mul_moderate(self, rhs: Self) -> Self {
        let (hi, rest) = two_product(self.hi(), rhs.hi());
        let cross = self.hi() * rhs.lo() + self.lo() * rhs.hi();
        Self::new(hi, rest + (cross + self.lo() * rhs.lo()))
    }

    /// Relative error below 2^-102; not a number for a divisor of zero.
    pub(super) fn div(self, rhs: Self) -> Self {
        if rhs.is_zero() {
            return Self::NAN;
        }
        if self.is_moderate() && rhs.is_moderate() {
            return self.div_moderate(rhs);
        }
        self.by_mantissas(rhs, Self::div_moderate, |a, b| a - b)
    }

    /// Schoolbook division: three digits of 53 bits.
    fn div_moderate(self, rhs: Self) -> Self {
        let first = self.hi() / rhs.hi();
        let rest = self.sub(rhs.mul_moderate(Self::from_f64(first)));
        let second = rest.hi() / rhs.hi();
        let rest = rest.sub(rhs.mul_moderate(Self::from_f64(second)));
        let third = rest.hi() / rhs.hi();
        let (hi, lo) = quick_two_sum(first, second);
        Self::new(hi, lo + third)
    }

    /// Division by a small whole number, for dividends of moderate size.
    pub(super) fn div_small(self, divisor: f64) -> Self {
        let first = self.hi() / divisor;
        let (hi, lo) = two_product(first, divisor);
        Self::new(first, ((self.hi() - hi) - lo + self.lo()) / divisor)
    }

    /// Relative error below 2^-102; not a number if negative.
    pub(super) fn sqrt(self) -> Self {
        if self.is_zero() || !self.is_finite() {
            return self;
        }
        // An even power of two, so that its root is one.
        let scale = if self.is_moderate() { 0 } else { exponent(self.hi()) & !1 };
        let square = self.scaled(-scale);
        let root = square.hi().sqrt();
        let rest = square.sub(Self::product(root, root)).hi();
        Self::new(root, rest / (2.0 * root)).scaled(scale / 2)
    }

    /// `self^n` by repeated squaring.
    pub(super) fn power(self, n: u8) -> Self {
        let (mut result, mut square, mut n) = (Self::ONE, self, n);
        while n > 0 {
            if n & 1 == 1 {
                result = result.mul(square);
            }
            n >>= 1;
            if n > 0 {
                square = square.mul(square);
            }
        }
        result
    }

    /// The order by value; what is not a number comes last.
    pub(super) fn cmp(self, rhs: Self) -> Ordering {
        match (self.is_finite(), rhs.is_finite()) {
            (true, true) => self.hi().total_cmp(&rhs.hi()).then(self.lo().total_cmp(&rhs.lo())),
            (left, right) => right.cmp(&left),
        }
    }

    /// Whether products and quotients of such numbers are far from overflow and underflow: 2^±400.
    fn is_moderate(self) -> bool {
        (623..=1423).contains(&(self.hi >> 52 & 0x7ff))
    }

    /// Does in `[1, 2)` what could overflow or lose bits as it stands.
    fn by_mantissas(self, rhs: Self, op: fn(Self, Self) -> Self, exponents: fn(i32, i32) -> i32) -> Self {
        if !self.is_finite() || !rhs.is_finite() {
            return Self::NAN;
        }
        if self.is_zero() || rhs.is_zero() {
            return Self::ZERO;
        }
        let (a, b) = (exponent(self.hi()), exponent(rhs.hi()));
        op(self.scaled(-a), rhs.scaled(-b)).scaled(exponents(a, b))
    }

    /// `self · 2^by`.
    fn scaled(self, by: i32) -> Self {
        let (mut hi, mut lo, mut by) = (self.hi(), self.lo(), by);
        while by != 0 {
            let step = by.clamp(-1000, 1000);
            (hi, lo, by) = (hi * power_of_two(step), lo * power_of_two(step), by - step);
        }
        Self::new(hi, lo)
    }
}

impl fmt::Debug for Wide {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} + {:?}", self.hi(), self.lo())
    }
}

/// `2^e`, for the exponents of normal doubles.
pub(super) fn power_of_two(e: i32) -> f64 {
    f64::from_bits(((e + 1023) as u64) << 52)
}

/// The power of two at or below a finite `|x| > 0`.
fn exponent(x: f64) -> i32 {
    match (x.to_bits() >> 52 & 0x7ff) as i32 {
        0 => exponent(x * power_of_two(200)) - 200,
        biased => biased - 1023,
    }
}

/// `a + b` and its rounding error, exactly.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    (sum, (a - (sum - b_part)) + (b - b_part))
}

/// [`two_sum`] for `|a| ≥ |b|`.
fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// `a · b` and its rounding error, exactly, for factors of moderate size.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (halves(a), halves(b));
    let rest = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    (product, rest)
}

/// Veltkamp's split into two parts of 26 bits.
fn halves(a: f64) -> (f64, f64) {
    let shifted = 134_217_729.0 * a; // 2^27 + 1
    let high = shifted - (shifted - a);
    (high, a - high)
}
