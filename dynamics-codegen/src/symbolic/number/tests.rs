//! Constants against identities, exact fractions, the standard parser and 40 digits of mpmath.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]

mod text;
mod trig;

use super::wide::power_of_two;
use super::{Exact, Number, Wide};
use std::cmp::Ordering;

fn n(text: &str) -> Number {
    Number::parse_decimal(text).unwrap_or_else(|| panic!("{text} is a number"))
}

fn exact(num: i128, den: i128) -> Exact {
    Exact::reduced(num, den).unwrap()
}

fn pi_times(num: i64, den: i64) -> Number {
    Number::PI * Number::ratio(num, den)
}

/// `|a - b|`, without the rule that noise is zero.
fn distance(a: Number, b: Number) -> f64 {
    a.to_wide().sub(b.to_wide()).hi().abs()
}

/// `|a - b| ≤ 2^-100 · |b|`, or to that of 1 if `b` is smaller.
#[track_caller]
fn assert_close(a: Number, b: Number) {
    let error = distance(a, b);
    assert!(error <= power_of_two(-100) * b.abs().to_f64().max(1.0), "{a:?} is not {b:?}: {error:e}");
}

#[track_caller]
fn assert_relatively_close(a: Number, b: Number) {
    let error = distance(a, b);
    assert!(error <= power_of_two(-100) * b.abs().to_f64(), "{a:?} is not {b:?}: {error:e}");
}

/// A seeded generator (xorshift*), so that each run tests the same.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    fn below(&mut self, limit: u64) -> u64 {
        (self.next() >> 11) % limit
    }

    fn digits(&mut self, count: u64) -> String {
        (0..count).map(|_| char::from(b'0' + self.below(10) as u8)).collect()
    }

    fn signed(&mut self, bits: u32) -> i128 {
        let magnitude = (u128::from(self.next()) << 64 | u128::from(self.next())) >> (128 - bits);
        if self.below(2) == 0 { magnitude as i128 } else { -(magnitude as i128) }
    }
}

impl Number {
    fn recip(self) -> Number {
        Number::ONE.checked_div(self).unwrap()
    }
}

#[test]
fn decimals_add_and_multiply_exactly() {
    assert_eq!(n("0.1") + n("0.2") - n("0.3"), Number::ZERO);
    assert_eq!(n("0.42"), Number::ratio(21, 50));
    assert_eq!(n("0.42") * n("1.5"), Number::ratio(63, 100));
    assert_eq!(n("0.63").checked_div(n("1.5")), Some(n("0.42")));
    assert_eq!(Number::ratio(3, -6), Number::ratio(-1, 2));
    assert_eq!(Number::ONE.checked_div(Number::ZERO), None);
    assert_eq!(Number::PI + Number::PI, pi_times(2, 1));
    assert_eq!(Number::PI.checked_div(Number::PI), Some(Number::ONE));
    assert_eq!(Number::PI - Number::PI, Number::ZERO);
    assert_eq!(Number::PI * Number::ZERO, Number::ZERO);
}

#[test]
fn exact_operations_agree_with_unreduced_fractions() {
    let mut random = Random(1);
    for _ in 0..2000 {
        let (a, c) = (random.signed(30), random.signed(30));
        let (b, d) = (random.signed(29).abs() + 1, random.signed(29).abs() + 1);
        let (x, y) = (Number::Exact(exact(a, b)), Number::Exact(exact(c, d)));
        assert_eq!(x + y, Number::Exact(exact(a * d + c * b, b * d)));
        assert_eq!(x - y, Number::Exact(exact(a * d - c * b, b * d)));
        assert_eq!(x * y, Number::Exact(exact(a * c, b * d)));
        assert_eq!(x.cmp_value(y), (a * d).cmp(&(c * b)));
        if c != 0 {
            assert_eq!(x.checked_div(y), Some(Number::Exact(exact(a * d, b * c))));
        }
    }
}

#[test]
fn wide_operations_agree_with_exact_fractions() {
    let mut random = Random(2);
    for _ in 0..2000 {
        let (a, b) = (exact(random.signed(60), random.signed(50).abs() + 1), exact(random.signed(60) | 1, 3));
        let close = |wide: Wide, exact: Exact| {
            assert_relatively_close(Number::from_wide(wide), Number::from_wide(exact.to_wide()));
        };
        let (x, y) = (a.to_wide(), b.to_wide());
        close(x.add(y), a.checked_add(b).unwrap());
        close(x.mul(y), a.checked_mul(b).unwrap());
        close(x.div(y), b.checked_recip().and_then(|b| a.checked_mul(b)).unwrap());
        close(x.mul(x).sqrt(), a.abs());
        assert_eq!((x.add(y), x.mul(y)), (y.add(x), y.mul(x)));
    }
}

#[test]
fn what_does_not_fit_becomes_wide_and_cancels_to_zero() {
    let large = n("123456789012345678901234567890");
    let product = large * large;
    assert!(matches!(product, Number::Float(_)));
    assert_relatively_close(product.checked_div(large).unwrap(), large);
    assert_eq!(product - product, Number::ZERO);
    assert_eq!((product + Number::ONE) - product, Number::ZERO);
    let root = n("2").sqrt().unwrap();
    assert_eq!(root * n("0.3") - n("0.3") * root, Number::ZERO);
    assert_eq!(Number::PI - n("3.1415926535897932384626433832795028842"), Number::ZERO);
    let sum = Number::PI + Number::ONE;
    assert!(matches!(sum, Number::Float(_)));
    assert_close(sum - Number::ONE, Number::PI);
    let mut power = Number::ONE;
    for _ in 0..130 {
        power = power * Number::PI;
    }
    assert!(matches!(power, Number::Float(_)));
    assert_relatively_close(power.checked_div(n("426.0e62")).unwrap(), power * n("426.0e62").recip());
}

#[test]
fn results_out_of_range_are_flagged_or_zero() {
    let (large, small) = (n("1e300"), n("1e-300"));
    let lost = large * large;
    assert!(!lost.is_finite() && lost.to_f64().is_nan() && lost.signum() == 0);
    for result in [lost + Number::ONE, lost * Number::ZERO, -lost, lost - lost, lost.sin(), lost.abs()] {
        assert!(!result.is_finite());
    }
    assert!(!lost.sqrt().unwrap().is_finite() && !Number::atan2(lost, Number::ONE).is_finite());
    assert!(!large.checked_div(small).unwrap().is_finite());
    assert_eq!(small * small, Number::ZERO);
    assert_eq!(small.checked_div(large), Some(Number::ZERO));
    assert_relatively_close((large * n("1e-280")).sqrt().unwrap(), n("1e10"));
    assert_relatively_close(n("1e307").sqrt().unwrap() * n("1e307").sqrt().unwrap(), n("1e307"));
    assert_relatively_close(n("1.5e308") * n("0.3"), n("0.45e308"));
}

#[test]
fn order_is_by_value() {
    let root = n("2").sqrt().unwrap();
    let ascending = [
        n("-1e200"),
        -root,
        n("-1.414"),
        Number::ZERO,
        n("1e-300"),
        Number::ratio(1, 3),
        n("0.34"),
        root,
        n("1.4142135623730950489"),
        n("3.1415926"),
        Number::PI,
        n("3.1415927"),
        pi_times(2, 1),
        Number::PI * Number::PI,
        n("1e39"),
    ];
    for (i, a) in ascending.iter().enumerate() {
        for (j, b) in ascending.iter().enumerate() {
            assert_eq!(a.cmp_value(*b), i.cmp(&j), "{a:?} {b:?}");
        }
    }
    let (a, b) = (exact(i128::MAX, i128::MAX - 1), exact(i128::MAX - 1, i128::MAX - 2));
    assert_eq!(
        (a.cmp_ratio(b), b.cmp_ratio(a), a.cmp_ratio(a)),
        (Ordering::Less, Ordering::Greater, Ordering::Equal)
    );
    assert_eq!(a.neg().cmp_ratio(b.neg()), Ordering::Greater);
    let sum = Wide::new(1.0, power_of_two(-100));
    let same = exact((1 << 100) + 1, 1 << 100);
    assert_eq!(Number::Float(sum).cmp_value(Number::Exact(same)), Ordering::Equal);
    assert!((-root).is_negative() && (-root).abs() == root && root.signum() == 1 && Number::ONE.is_one());
}

#[test]
fn roots_are_exact_where_their_radicands_are_short() {
    assert_eq!(Number::ratio(49, 64).sqrt(), Some(Number::ratio(7, 8)));
    assert_eq!((Number::PI * Number::PI).sqrt(), Some(Number::PI));
    assert_eq!(Number::ZERO.sqrt(), Some(Number::ZERO));
    assert_eq!(n("-1").sqrt(), None);
    assert_eq!(Number::ratio(1, 3).sqrt().map(Number::exact_text).as_deref(), Some("√3/3"));
    assert_eq!(n("0.5").sqrt().map(Number::exact_text).as_deref(), Some("√2/2"));
    assert_eq!(Number::integer(13 * 11 * 11).sqrt(), n("13").sqrt().map(|root| root * n("11")));
    assert_eq!((n("12") * Number::PI * Number::PI).sqrt().map(Number::exact_text).as_deref(), Some("2π√3"));
    // Of a root and of an odd power of π there is no exact root.
    for inexact in [n("2").sqrt().unwrap(), Number::PI, n("101"), n("65537"), n("123456789.5")] {
        assert!(matches!(inexact.sqrt(), Some(Number::Float(_))), "{inexact:?}");
    }
    for text in ["2", "0.3", "1e-9", "123456789.5", "1e300", "1e-250"] {
        let root = n(text).sqrt().unwrap();
        assert_relatively_close(root * root, n(text));
    }
    assert_close(n("2").sqrt().unwrap(), n("1.414213562373095048801688724209698078570"));
}

#[test]
fn roots_multiply_exactly_and_add_where_they_are_alike() {
    let root = |square: i64| Number::integer(square).sqrt().unwrap();
    assert_eq!(root(2) * root(2), n("2"));
    assert_eq!(root(6) * root(15), n("3") * root(10));
    assert_eq!(root(12) - root(3), root(3));
    assert_eq!(root(3) - root(3), Number::ZERO);
    assert_eq!(root(3).recip() * root(3), Number::ONE);
    assert_eq!(-(root(18) / n("-6")), root(2) / n("2"));
    let [third, sixth] = [3, 6].map(|den| pi_times(1, den));
    assert_eq!(third.sin(), root(3) / n("2"));
    assert_eq!(sixth.cos() * sixth.cos() + sixth.sin() * sixth.sin(), Number::ONE);
    assert_eq!(pi_times(3, 4).cos(), -root(2) / n("2"));
    // Those of others are sums of roots, which are rounded.
    let sum = root(2) + root(3);
    assert!(matches!(sum, Number::Float(_)));
    assert_close(sum * sum, n("5") + n("2") * root(6));
    assert_close((root(6) - root(2)) / n("4"), pi_times(1, 12).sin());
}

#[test]
fn operations_on_roots_agree_with_rounded_ones() {
    let mut random = Random(3);
    let mut next = || {
        let ratio = exact(random.signed(40) | 1, random.signed(30).abs() + 1);
        let root = Number::integer([1, 2, 3, 5, 6, 10, 15, 30][random.below(8) as usize]).sqrt().unwrap();
        Number::Exact(ratio) * root * [Number::ONE, Number::PI, Number::PI.recip()][random.below(3) as usize]
    };
    for _ in 0..2000 {
        let (x, y) = (next(), next());
        assert!(matches!(x, Number::Exact(_)) && matches!(x * y, Number::Exact(_)));
        assert_relatively_close(x * y, Number::from_wide(x.to_wide().mul(y.to_wide())));
        assert_relatively_close(x / y, Number::from_wide(x.to_wide().div(y.to_wide())));
        assert_close(x + y, Number::from_wide(x.to_wide().add(y.to_wide())));
        assert_eq!((x / y) * y, x);
        assert_eq!(x.cmp_value(y), x.to_wide().cmp(y.to_wide()));
        assert_eq!(x.to_f64(), x.to_wide().hi());
    }
}
