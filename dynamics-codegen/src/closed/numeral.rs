//! How a number is written: whole, as a decimal, or as a fraction, with roots and powers of π and of ten.

use crate::symbolic::Number;

/// A number that is not negative, in the parts that any notation writes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Numeral {
    /// Digits, with a point if need be; `1` before a power of π or a root is not written.
    pub(super) digits: String,
    /// The power of ten that follows.
    pub(super) exponent: i32,
    /// The power of π that follows.
    pub(super) pi: u8,
    /// What stands below a root that follows, or 1.
    pub(super) radicand: u16,
    /// What all of it is divided by, if it is a fraction: digits, and a power of π.
    pub(super) below: Option<(String, u8)>,
}

/// Decimals have this many zeros after the point at most, and whole numbers this many at their end; beyond, there is a
/// power of ten.
const ZEROS: usize = 3;

/// Halves and quarters are written as such up to this numerator; beyond, they are decimals.
const SMALL: u128 = 3;

impl Numeral {
    /// The parts of a number.
    pub(super) fn of(value: Number) -> Self {
        let Number::Exact(exact) = value else {
            let (digits, exponent) = scientific(&value.to_string());
            return Self { digits, exponent, pi: 0, radicand: 1, below: None };
        };
        let (num, den) = (exact.numerator().unsigned_abs(), exact.denominator().unsigned_abs());
        let power = exact.pi_power();
        let (pi, pi_below) = (power.max(0).unsigned_abs(), power.min(0).unsigned_abs());
        let is_simple = num <= SMALL && matches!(den, 2 | 4);
        let is_fraction = is_simple || !exact.is_rational() && den != 1;
        let decimal = if is_fraction { None } else { decimal(num, den) };
        let (digits, exponent, is_fraction) = match decimal {
            Some(text) => {
                let (digits, exponent) = scientific(&text);
                (digits, exponent, false)
            }
            None => (num.to_string(), 0, true),
        };
        let below = match (is_fraction, pi_below) {
            (false, 0) => None,
            (false, pi) => Some(("1".to_owned(), pi)),
            (true, pi) => Some((den.to_string(), pi)),
        };
        Self { digits, exponent, pi, radicand: exact.radicand(), below }
    }

    /// The parts of a number that stands in front of a product, where one over a power of two is written as such.
    pub(super) fn in_front(value: Number) -> Self {
        match value {
            Number::Exact(exact)
                if exact.is_rational()
                    && exact.numerator() == 1
                    && matches!(exact.denominator(), 8 | 16 | 32) =>
            {
                let below = Some((exact.denominator().to_string(), 0));
                Self { digits: "1".to_owned(), exponent: 0, pi: 0, radicand: 1, below }
            }
            value => Self::of(value),
        }
    }

    /// Whether it is digits alone, or a root alone.
    pub(super) fn is_atom(&self) -> bool {
        let is_root = self.radicand != 1;
        self.below.is_none() && self.exponent == 0 && self.pi == 0 && (!is_root || self.digits == "1")
    }
}

/// `num / den` in decimal, if it ends.
fn decimal(num: u128, den: u128) -> Option<String> {
    let twos = den.trailing_zeros();
    let (mut rest, mut fives) = (den >> twos, 0);
    while rest.is_multiple_of(5) {
        (rest, fives) = (rest / 5, fives + 1);
    }
    let places = twos.max(fives);
    let scale = 2_u128.checked_pow(places - twos)?.checked_mul(5_u128.checked_pow(places - fives)?)?;
    let digits = num.checked_mul(scale).filter(|_| rest == 1)?.to_string();
    let places = places as usize;
    if places == 0 {
        return Some(digits);
    }
    let padded = format!("{digits:0>width$}", width = places + 1);
    let (whole, part) = padded.split_at(padded.len() - places);
    Some(format!("{whole}.{part}"))
}

/// Digits and a power of ten, where there would be many zeros; the text is a decimal, perhaps with an exponent.
fn scientific(text: &str) -> (String, i32) {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let (whole, part) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = format!("{whole}{part}");
    let leading = digits.len() - digits.trim_start_matches('0').len();
    let significant = digits.trim_matches('0');
    if significant.is_empty() {
        return ("0".to_owned(), 0);
    }
    // The value is 0.significant · 10^point.
    let point = whole.len() as i32 - leading as i32 + exponent;
    let length = significant.len() as i32;
    if point > length + ZEROS as i32 || point < -(ZEROS as i32) {
        let (first, rest) = significant.split_at(1);
        let mantissa = if rest.is_empty() { first.to_owned() } else { format!("{first}.{rest}") };
        return (mantissa, point - 1);
    }
    let text = if point <= 0 {
        format!("0.{}{significant}", "0".repeat(point.unsigned_abs() as usize))
    } else if point >= length {
        format!("{significant}{}", "0".repeat((point - length) as usize))
    } else {
        let (whole, part) = significant.split_at(point as usize);
        format!("{whole}.{part}")
    };
    (text, 0)
}
