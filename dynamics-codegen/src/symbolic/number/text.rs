//! Constants from and to text.
//!
//! Reading is exact, or rounded once: the leading double is that of the standard library's parser,
//! which rounds correctly, and the rest is the double nearest to the decimal difference.

use super::Number;
use super::ratio::Exact;
use super::wide::Wide;
use std::fmt;

/// A decimal number as written: `±digits · 10^exponent`, without zeros at the ends of `digits`.
struct Decimal {
    negative: bool,
    digits: Vec<u8>,
    exponent: i64,
}

/// Reads `[+-] digits [. digits] [e [+-] digits]`; one `_` or more may follow a digit.
///
/// `None` of other text, and of numbers that round to infinity or, not being zero, to zero.
pub(super) fn parse_decimal(text: &str) -> Option<Number> {
    let decimal = scan(text)?;
    if decimal.digits.is_empty() {
        return Some(Number::ZERO);
    }
    let magnitude = match exact(&decimal) {
        Some(exact) => Number::Exact(exact),
        None => rounded(&decimal)?,
    };
    Some(if decimal.negative { -magnitude } else { magnitude })
}

/// In one pass over the bytes: files have hundreds of thousands of numbers, and macros are not optimised.
fn scan(text: &str) -> Option<Decimal> {
    let (negative, text) = strip_sign(text);
    let mut digits = Vec::with_capacity(text.len());
    let (mut any, mut point, mut exponent, mut before) = (false, false, 0_i64, b'.');
    for (at, &byte) in text.as_bytes().iter().enumerate() {
        match byte {
            b'0'..=b'9' => {
                any = true;
                exponent -= i64::from(point);
                if byte != b'0' || !digits.is_empty() {
                    digits.push(byte);
                }
            }
            b'_' if before != b'.' => {}
            b'.' if !point => point = true,
            b'e' | b'E' => {
                exponent = exponent.saturating_add(scan_exponent(&text[at + 1..])?);
                break;
            }
            _ => return None,
        }
        before = byte;
    }
    while digits.pop_if(|last| *last == b'0').is_some() {
        exponent = exponent.saturating_add(1);
    }
    any.then_some(Decimal { negative, digits, exponent })
}

/// The digits of `text` without their underscores, possibly none.
fn scan_digits(text: &str) -> Option<Vec<u8>> {
    if text.starts_with('_') || !text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'_') {
        return None;
    }
    Some(text.bytes().filter(|byte| *byte != b'_').collect())
}

/// The exponent, saturated: from far below its limits on, it makes no difference.
fn scan_exponent(text: &str) -> Option<i64> {
    let (negative, text) = strip_sign(text);
    let digits = scan_digits(text)?;
    if digits.is_empty() {
        return None;
    }
    let limit = i64::from(i32::MAX);
    let value = digits.iter().fold(0, |sum: i64, digit| (sum * 10 + i64::from(digit - b'0')).min(limit));
    Some(if negative { -value } else { value })
}

fn strip_sign(text: &str) -> (bool, &str) {
    match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    }
}

/// The magnitude as a fraction, if it fits.
fn exact(decimal: &Decimal) -> Option<Exact> {
    let mut num = 0_i128;
    for digit in &decimal.digits {
        num = num.checked_mul(10)?.checked_add(i128::from(digit - b'0'))?;
    }
    let places = u32::try_from(decimal.exponent.unsigned_abs()).ok()?;
    if decimal.exponent >= 0 {
        return Exact::reduced(num.checked_mul(10_i128.checked_pow(places)?)?, 1);
    }
    // The last digit is not zero: twos or fives cancel, never both.
    let twos = num.trailing_zeros().min(places);
    num >>= twos;
    let mut fives = 0;
    while twos == 0 && fives < places && num % 5 == 0 {
        (num, fives) = (num / 5, fives + 1);
    }
    let den = 5_i128.checked_pow(places - fives)?.checked_mul(2_i128.checked_pow(places - twos)?)?;
    Exact::reduced(num, den)
}

/// The magnitude to two doubles.
fn rounded(decimal: &Decimal) -> Option<Number> {
    let hi = parse(&decimal.digits, decimal.exponent);
    if hi == 0.0 || hi.is_infinite() {
        return None;
    }
    // Neither expansion is much longer than what was written, or than the longest double.
    let (mut written, mut double) = (decimal.digits.clone(), format!("{hi:.1074}").into_bytes());
    double.retain(|byte| *byte != b'.');
    let last = decimal.exponent.min(-1074);
    written.resize(written.len() + (decimal.exponent - last) as usize, b'0');
    double.resize(double.len() + (-1074 - last) as usize, b'0');
    let lo = difference(written, double, last);
    Some(Number::from_wide(Wide::keeping_hi(hi, lo)))
}

/// `(a - b) · 10^exponent` of two whole numbers, to the nearest double.
fn difference(mut a: Vec<u8>, mut b: Vec<u8>, exponent: i64) -> f64 {
    let length = a.len().max(b.len());
    a.splice(0..0, std::iter::repeat_n(b'0', length - a.len()));
    b.splice(0..0, std::iter::repeat_n(b'0', length - b.len()));
    let negative = a < b;
    if negative {
        std::mem::swap(&mut a, &mut b);
    }
    let mut borrow = 0;
    for (digit, less) in a.iter_mut().zip(&b).rev() {
        let less = less - b'0' + borrow;
        borrow = u8::from(*digit - b'0' < less);
        *digit = *digit + 10 * borrow - less;
    }
    let magnitude = parse(&a, exponent);
    if negative { -magnitude } else { magnitude }
}

fn parse(digits: &[u8], exponent: i64) -> f64 {
    let digits = String::from_utf8_lossy(digits);
    format!("{digits}e{exponent}").parse().expect("digits and an exponent make a number")
}

impl fmt::Display for Number {
    /// The shortest decimal that reads back as [`Number::to_f64`].
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.to_f64(), f)
    }
}

/// `21/50`, `-π/2`, `3π²/4`, `2/(3π)`, `2π√3/3`.
pub(super) fn exact_text(exact: Exact) -> String {
    let (magnitude, den) = (exact.numerator().unsigned_abs(), exact.denominator());
    let sign = if exact.numerator() < 0 { "-" } else { "" };
    let pi = power_of_pi(exact.pi_power().unsigned_abs());
    let above = exact.pi_power() > 0;
    let root = match exact.radicand() {
        1 => String::new(),
        radicand => format!("√{radicand}"),
    };
    let unit = if above { format!("{pi}{root}") } else { root };
    let num = match magnitude {
        1 if !unit.is_empty() => unit,
        _ => format!("{magnitude}{unit}"),
    };
    match (den, above || pi.is_empty()) {
        (1, true) => format!("{sign}{num}"),
        (_, true) => format!("{sign}{num}/{den}"),
        (1, false) => format!("{sign}{num}/{pi}"),
        (_, false) => format!("{sign}{num}/({den}{pi})"),
    }
}

fn power_of_pi(power: u8) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    match power {
        0 => String::new(),
        1 => "π".to_owned(),
        _ => {
            let raised =
                power.to_string().bytes().map(|digit| RAISED[usize::from(digit - b'0')]).collect::<String>();
            format!("π{raised}")
        }
    }
}
