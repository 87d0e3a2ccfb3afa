//! Numbers as text, without `core::fmt`, whose formatting of floats can panic and is tens of kilobytes.

use dynamics_core::Scalar;

use crate::trial::Listener;

/// A scalar that can be printed, and hashed by its bits.
pub trait Number: Scalar {
    /// In ten-thousandths, towards zero; what is out of range saturates, NaN is 0.
    fn ten_thousandths(self) -> i32;

    /// The bits, folded to 32.
    fn bits(self) -> u32;

    /// The constant `value`. [`Scalar::of`] converts from `f64`, which is free only where the compiler sees the value.
    fn of_single(value: f32) -> Self;
}

impl Number for f32 {
    fn ten_thousandths(self) -> i32 {
        (self * 1e4) as i32
    }

    fn bits(self) -> u32 {
        self.to_bits()
    }

    fn of_single(value: f32) -> Self {
        value
    }
}

impl Number for f64 {
    fn ten_thousandths(self) -> i32 {
        (self * 1e4) as i32
    }

    fn bits(self) -> u32 {
        (self.to_bits() ^ (self.to_bits() >> 32)) as u32
    }

    fn of_single(value: f32) -> Self {
        Self::from(value)
    }
}

/// Right-aligned in twelve places, four of them behind the point.
#[must_use]
pub fn decimal(ten_thousandths: i32) -> [u8; 12] {
    let mut text = [b' '; 12];
    let mut rest = ten_thousandths.unsigned_abs();
    let mut sign = if ten_thousandths < 0 { b'-' } else { b' ' };
    for (place, byte) in text.iter_mut().rev().enumerate() {
        *byte = match place {
            4 => b'.',
            0..=5 => digit(&mut rest),
            _ if rest > 0 => digit(&mut rest),
            _ => core::mem::replace(&mut sign, b' '),
        };
    }
    text
}

/// Right-aligned in four places; what is longer loses its front.
#[must_use]
pub fn whole(x: u32) -> [u8; 4] {
    let mut text = [b' '; 4];
    let mut rest = x;
    for (place, byte) in text.iter_mut().rev().enumerate() {
        if place == 0 || rest > 0 {
            *byte = digit(&mut rest);
        }
    }
    text
}

fn digit(rest: &mut u32) -> u8 {
    let last = (*rest % 10) as u8;
    *rest /= 10;
    b'0' + last
}

/// Eight hexadecimal digits.
#[must_use]
pub fn hexadecimal(bits: u32) -> [u8; 8] {
    let mut text = [b'0'; 8];
    let mut rest = bits;
    for byte in text.iter_mut().rev() {
        let nibble = (rest & 15) as u8;
        *byte = if nibble < 10 { b'0' + nibble } else { b'a' + (nibble - 10) };
        rest >>= 4;
    }
    text
}

/// A hash of all bits that were put in, in their order (Fowler, Noll, Vo 1a on words).
#[derive(Clone, Copy, Debug)]
pub struct Fingerprint(pub u32);

impl Fingerprint {
    /// Of nothing.
    pub const EMPTY: Self = Self(0x811C_9DC5);

    /// And of these bits.
    pub fn put(&mut self, bits: u32) {
        self.0 = (self.0 ^ bits).wrapping_mul(0x0100_0193);
    }
}

/// Prints every fiftieth step, and at the end of each law the [`Fingerprint`] of all its joint forces.
#[derive(Debug)]
pub struct Printer<W> {
    write: W,
    step: u32,
    fingerprint: Fingerprint,
}

impl<W: FnMut(&[u8])> Printer<W> {
    /// Prints by `write`.
    pub fn new(write: W) -> Self {
        Self { write, step: 0, fingerprint: Fingerprint::EMPTY }
    }
}

impl<T: Number, W: FnMut(&[u8])> Listener<T> for Printer<W> {
    fn begin(&mut self, robot: &'static str, law: &'static str) {
        (self.step, self.fingerprint) = (0, Fingerprint::EMPTY);
        for text in [robot, ", ", law, "\n"] {
            (self.write)(text.as_bytes());
        }
    }

    fn step(&mut self, tau: &[T]) {
        for tau in tau {
            self.fingerprint.put(tau.bits());
        }
        if self.step.is_multiple_of(50) {
            (self.write)(b"  step");
            (self.write)(&whole(self.step));
            for tau in tau {
                (self.write)(&decimal(tau.ten_thousandths()));
            }
            (self.write)(b"\n");
        }
        self.step = self.step.wrapping_add(1);
    }

    fn end(&mut self) {
        (self.write)(b"  all steps, all bits: ");
        (self.write)(&hexadecimal(self.fingerprint.0));
        (self.write)(b"\n");
    }
}

#[cfg(test)]
mod tests {
    use std::format;

    use super::*;

    #[test]
    fn decimals_are_as_format_writes_them() {
        for x in [0, 1, -1, 9999, -10_000, 123_456_789, i32::MAX, i32::MIN] {
            let magnitude = x.unsigned_abs();
            let sign = if x < 0 { "-" } else { "" };
            let expected =
                format!("{:>12}", format!("{sign}{}.{:04}", magnitude / 10_000, magnitude % 10_000));
            assert_eq!(core::str::from_utf8(&decimal(x)), Ok(expected.as_str()));
        }
    }

    #[test]
    fn hexadecimals_are_as_format_writes_them() {
        for x in [0, 0x0123_4567, 0x89AB_CDEF, u32::MAX] {
            assert_eq!(core::str::from_utf8(&hexadecimal(x)), Ok(format!("{x:08x}").as_str()));
        }
    }

    #[test]
    fn saturates_and_knows_nan() {
        assert_eq!(f32::NAN.ten_thousandths(), 0);
        assert_eq!(f32::INFINITY.ten_thousandths(), i32::MAX);
        assert_eq!((-1.5_f64).ten_thousandths(), -15_000);
    }
}
