//! What stands beside a fraction: a root of a whole number, and a power of π.
//!
//! Numbers are brought to square-free radicands by trial division. Of those that nobody would write, as of an axis in
//! decimals, nothing is gained by roots: from [`LIMIT`] on they are left to rounded arithmetic.

use super::wide::Wide;

/// Radicands are less than this.
const LIMIT: u16 = 100;

/// What is tried as a divisor is less than this.
const DIVISORS: u128 = 256;

/// `√root·π^pi`, with a square-free `root ≥ 1`.
///
/// No two of them are rational multiples of each other: roots of different square-free numbers are not, and π is
/// transcendental.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Unit {
    pub(super) root: u16,
    pub(super) pi: i8,
}

impl Unit {
    pub(super) const ONE: Self = Self { root: 1, pi: 0 };
    pub(super) const PI: Self = Self { root: 1, pi: 1 };

    /// `self·rhs`, a whole number times a unit: `√6·√15 = 3·√10`.
    pub(super) fn checked_mul(self, rhs: Self) -> Option<(i128, Self)> {
        let pi = self.pi.checked_add(rhs.pi)?;
        if self.root == 1 || rhs.root == 1 {
            return Some((1, Self { root: self.root.max(rhs.root), pi }));
        }
        let shared = gcd(self.root, rhs.root);
        let root = (self.root / shared) * (rhs.root / shared);
        (root < LIMIT).then(|| (shared.into(), Self { root, pi }))
    }

    /// The root as a whole number times a unit; `None` of what is a root already, and of odd powers of π.
    pub(super) fn checked_sqrt(self) -> Option<Self> {
        (self.root == 1 && self.pi % 2 == 0).then_some(Self { root: 1, pi: self.pi / 2 })
    }

    pub(super) fn to_wide(self) -> Wide {
        let root = match self.root {
            1 => Wide::ONE,
            root => Wide::from_f64(root.into()).sqrt(),
        };
        let power = || Wide::PI.power(self.pi.unsigned_abs());
        match self.pi {
            0 => root,
            1.. => root.mul(power()),
            _ => root.div(power()),
        }
    }
}

/// `(s, n)` with `square = s²·n` and n square-free; `None` where that is not found, and of numbers below 1.
pub(super) fn square_and_rest(square: i128) -> Option<(i128, u16)> {
    let mut rest = u128::try_from(square).ok().filter(|rest| *rest > 0)?;
    let (mut root, mut radicand, mut divisor) = (1, 1_u128, 2);
    while divisor < DIVISORS && divisor * divisor <= rest {
        while rest.is_multiple_of(divisor * divisor) {
            (root, rest) = (root * divisor, rest / (divisor * divisor));
        }
        if rest.is_multiple_of(divisor) {
            (radicand, rest) = (radicand * divisor, rest / divisor);
        }
        divisor += 1;
    }
    // No divisor is left that was tried: a rest below the limit is prime, or 1.
    let last = rest.isqrt();
    if last * last == rest {
        root *= last;
    } else {
        radicand = radicand.checked_mul(rest)?;
    }
    let radicand = u16::try_from(radicand).ok().filter(|radicand| *radicand < LIMIT)?;
    Some((i128::try_from(root).ok()?, radicand))
}

fn gcd(mut a: u16, mut b: u16) -> u16 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}
