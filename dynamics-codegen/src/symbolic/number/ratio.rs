//! An exact constant: a reduced 128-bit fraction times a root and a power of π.
//!
//! Every operation answers `None` where its exact result does not fit, and the caller goes on with
//! [`Wide`]. Sums and products reduce before they multiply (D. Knuth, *The Art of Computer
//! Programming* 2, §4.5.1), so that intermediate values overflow only if the result nearly does.

use super::unit::{Unit, square_and_rest};
use super::wide::{Wide, power_of_two};
use std::cmp::Ordering;

/// `num / den · √root · π^pi`: `den > 0`, `gcd(num, den) = 1`, `num ≠ i128::MIN`, and the unit is 1 if `num = 0`.
///
/// The fields are canonical, and so are units: two values are equal exactly if their fields are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Exact {
    num: i128,
    den: i128,
    unit: Unit,
}

impl Exact {
    pub(super) const ZERO: Self = Self::integer(0);
    pub(super) const ONE: Self = Self::integer(1);
    pub(super) const PI: Self = Self { num: 1, den: 1, unit: Unit::PI };

    /// The numerator; it carries the sign.
    pub const fn numerator(self) -> i128 {
        self.num
    }

    /// The denominator, greater than zero.
    pub const fn denominator(self) -> i128 {
        self.den
    }

    /// The square-free number whose root it is a multiple of; 1 if it is none.
    pub const fn radicand(self) -> u16 {
        self.unit.root
    }

    /// The power of π.
    pub const fn pi_power(self) -> i8 {
        self.unit.pi
    }

    pub(super) const fn unit(self) -> Unit {
        self.unit
    }

    /// Whether it is a fraction alone.
    pub const fn is_rational(self) -> bool {
        self.unit.root == 1 && self.unit.pi == 0
    }

    pub(super) const fn integer(value: i64) -> Self {
        Self { num: value as i128, den: 1, unit: Unit::ONE }
    }

    /// `num / den` in lowest terms; `None` if `den` is zero or a part does not fit.
    pub(super) fn reduced(num: i128, den: i128) -> Option<Self> {
        if den == 0 || num == i128::MIN || den == i128::MIN {
            return None;
        }
        let (num, den) = if den < 0 { (-num, -den) } else { (num, den) };
        let g = gcd(num, den);
        Self::canonical(num / g, den / g, Unit::ONE)
    }

    /// `num / den · unit` of parts that are already in lowest terms.
    fn canonical(num: i128, den: i128, unit: Unit) -> Option<Self> {
        match num {
            0 => Some(Self::ZERO),
            i128::MIN => None,
            _ => Some(Self { num, den, unit }),
        }
    }

    /// The dyadic fraction a finite double is.
    pub(super) fn from_f64(value: f64) -> Option<Self> {
        if value == 0.0 {
            return Some(Self::ZERO);
        }
        let bits = value.to_bits();
        let biased = (bits >> 52 & 0x7ff) as i32;
        if biased == 0 || biased == 0x7ff {
            return None;
        }
        let mantissa = (bits & ((1 << 52) - 1) | 1 << 52) as i128;
        let zeros = mantissa.trailing_zeros();
        let odd = if value < 0.0 { -(mantissa >> zeros) } else { mantissa >> zeros };
        match biased - 1075 + zeros as i32 {
            shift @ 0..=126 => Self::canonical(odd.checked_mul(1 << shift)?, 1, Unit::ONE),
            shift @ -126..=-1 => Self::canonical(odd, 1 << -shift, Unit::ONE),
            _ => None,
        }
    }

    pub(super) fn neg(self) -> Self {
        Self { num: -self.num, ..self }
    }

    pub(super) fn abs(self) -> Self {
        Self { num: self.num.abs(), ..self }
    }

    /// `None` also for units that differ: such a sum is no longer of this form.
    pub(super) fn checked_add(self, rhs: Self) -> Option<Self> {
        if self.num == 0 {
            return Some(rhs);
        }
        if rhs.num == 0 {
            return Some(self);
        }
        if self.unit != rhs.unit {
            return None;
        }
        if self.den == 1 && rhs.den == 1 {
            return Self::canonical(self.num.checked_add(rhs.num)?, 1, self.unit);
        }
        let g = gcd(self.den, rhs.den);
        let (left, right) = if g == 1 { (self.den, rhs.den) } else { (self.den / g, rhs.den / g) };
        let num = self.num.checked_mul(right)?.checked_add(rhs.num.checked_mul(left)?)?;
        if num == 0 {
            return Some(Self::ZERO);
        }
        if num == i128::MIN {
            return None;
        }
        let shared = if g == 1 { 1 } else { gcd(num, g) };
        let (num, right) = if shared == 1 { (num, rhs.den) } else { (num / shared, rhs.den / shared) };
        Self::canonical(num, left.checked_mul(right)?, self.unit)
    }

    pub(super) fn checked_mul(self, rhs: Self) -> Option<Self> {
        if self.num == 0 || rhs.num == 0 {
            return Some(Self::ZERO);
        }
        let (whole, unit) = self.unit.checked_mul(rhs.unit)?;
        let product = if self.den == 1 && rhs.den == 1 {
            Self::canonical(self.num.checked_mul(rhs.num)?, 1, unit)?
        } else {
            let (a, d) = cancel(self.num, rhs.den);
            let (c, b) = cancel(rhs.num, self.den);
            Self::canonical(a.checked_mul(c)?, b.checked_mul(d)?, unit)?
        };
        if whole == 1 { Some(product) } else { product.checked_scale(whole) }
    }

    /// `whole · self`
    fn checked_scale(self, whole: i128) -> Option<Self> {
        let (whole, den) = cancel(whole, self.den);
        Self::canonical(self.num.checked_mul(whole)?, den, self.unit)
    }

    /// `1 / self`; `None` of zero.
    pub(super) fn checked_recip(self) -> Option<Self> {
        let unit = Unit { pi: self.unit.pi.checked_neg()?, ..self.unit };
        let recip = match self.num.signum() {
            0 => return None,
            1 => Self { num: self.den, den: self.num, unit },
            _ => Self { num: -self.den, den: -self.num, unit },
        };
        if unit.root == 1 {
            return Some(recip);
        }
        // 1/√n = √n/n
        let (num, root) = cancel(recip.num, unit.root.into());
        Self::canonical(num, recip.den.checked_mul(root)?, unit)
    }

    /// The root of a fraction, times an even power of π.
    pub(super) fn checked_sqrt(self) -> Option<Self> {
        let unit = self.unit.checked_sqrt()?;
        if self.num == 0 {
            return Some(self);
        }
        // √(n/d) = √(nd)/d, and n and d have no divisor in common.
        let ((num, above), (den, below)) = (square_and_rest(self.num)?, square_and_rest(self.den)?);
        let above = Unit { root: above, ..unit };
        let (_, unit) = above.checked_mul(Unit { root: below, pi: 0 })?;
        Self::canonical(num, den.checked_mul(below.into())?, unit)
    }

    /// The order by value of two constants with the same unit.
    pub(super) fn cmp_ratio(self, rhs: Self) -> Ordering {
        let (left, right) = (self.num.checked_mul(rhs.den), rhs.num.checked_mul(self.den));
        if let (Some(left), Some(right)) = (left, right) {
            return left.cmp(&right);
        }
        cmp_continued((self.num, self.den), (rhs.num, rhs.den))
    }

    /// `hi + rest` of a fraction, the rest to its own 100 bits.
    pub(super) fn split_double(self) -> Option<(f64, Wide)> {
        let hi = self.ratio_to_f64();
        let rest = self.checked_add(Self::from_f64(hi)?.neg())?;
        self.is_rational().then(|| (hi, rest.to_wide()))
    }

    /// The double nearest to `num / den`, ties to even; the unit is left out.
    pub(super) fn ratio_to_f64(self) -> f64 {
        const EXACT: u128 = 1 << 53;
        let (num, den) = (self.num.unsigned_abs(), self.den.unsigned_abs());
        if num <= EXACT && den <= EXACT {
            return self.num as f64 / self.den as f64;
        }
        let (mut quotient, mut rest, mut shift) = (num / den, num % den, 0);
        while quotient < EXACT << 2 && rest != 0 {
            // The rest is below den < 2^127: at least one bit is free.
            let step = rest.leading_zeros().min(64);
            rest <<= step;
            quotient = (quotient << step) | (rest / den);
            rest %= den;
            shift -= step as i32;
        }
        let sticky = u128::from(rest != 0);
        let magnitude = (quotient | sticky) as f64 * power_of_two(shift);
        if self.num < 0 { -magnitude } else { magnitude }
    }

    pub(super) fn to_wide(self) -> Wide {
        let num = Wide::from_i128(self.num);
        let ratio = if self.den == 1 { num } else { num.div(Wide::from_i128(self.den)) };
        if self.is_rational() { ratio } else { ratio.mul(self.unit.to_wide()) }
    }
}

/// `num / g` and `den / g` with their greatest common divisor g.
fn cancel(num: i128, den: i128) -> (i128, i128) {
    if den == 1 {
        return (num, den);
    }
    match gcd(num, den) {
        1 => (num, den),
        g => (num / g, den / g),
    }
}

/// Euclid's greatest common divisor, in 64 bits as soon as the numbers fit: that is many times quicker.
fn gcd(a: i128, b: i128) -> i128 {
    const NARROW: u128 = u64::MAX as u128;
    let (mut a, mut b) = (a.unsigned_abs(), b.unsigned_abs());
    while a > NARROW || b > NARROW {
        if b == 0 {
            return a as i128;
        }
        (a, b) = (b, a % b);
    }
    let (mut a, mut b) = (a as u64, b as u64);
    while b != 0 {
        let rest = a % b;
        a = b;
        b = rest;
    }
    i128::from(a)
}

/// Compares two fractions too large to cross-multiply, by their continued fractions.
fn cmp_continued(left: (i128, i128), right: (i128, i128)) -> Ordering {
    let ((mut a, mut b), (mut c, mut d)) = (left, right);
    loop {
        let order = a.div_euclid(b).cmp(&c.div_euclid(d));
        let (rest_left, rest_right) = (a.rem_euclid(b), c.rem_euclid(d));
        if order.is_ne() || rest_left == 0 || rest_right == 0 {
            // At equal whole parts the smaller rest is zero, if one of them is.
            return order.then(rest_left.signum().cmp(&rest_right.signum()));
        }
        // r/b < s/d exactly if d/s < b/r.
        ((a, b), (c, d)) = ((d, rest_right), (b, rest_left));
    }
}
