//! A product of powers, packed: eight bits for the exponent of each variable.

/// How many variables there can be.
pub(super) const VARIABLES: usize = 8 * WORDS;

const WORDS: usize = 6;

/// The exponent zero, in every byte: what is added to exponents, so that they order as numbers do.
const ZEROS: u64 = 0x4040_4040_4040_4040;

/// Powers of variables, with exponents from −31 to 63. The order is lexicographic by exponents of the first variable,
/// the second, and so on, and goes with products.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Monomial([u64; WORDS]);

impl Monomial {
    /// The empty product.
    pub(super) const ONE: Self = Self([ZEROS; WORDS]);

    /// A variable to a power.
    pub(super) fn power(variable: usize, exponent: i32) -> Self {
        Self::ONE.with(variable, exponent)
    }

    fn shift(variable: usize) -> usize {
        56 - 8 * (variable % 8)
    }

    /// The exponent of a variable.
    pub(super) fn exponent(&self, variable: usize) -> i32 {
        (self.0[variable / 8] >> Self::shift(variable) & 0xff) as i32 - 0x40
    }

    /// The same with another exponent of a variable.
    pub(super) fn with(mut self, variable: usize, exponent: i32) -> Self {
        let (word, shift) = (&mut self.0[variable / 8], Self::shift(variable));
        *word = *word & !(0xff << shift) | ((exponent + 0x40) as u64 & 0xff) << shift;
        self
    }

    /// The product, if its exponents are in range.
    pub(super) fn times(&self, other: &Self) -> Option<Self> {
        let mut product = [0; WORDS];
        let mut k = 0;
        while k < WORDS {
            let sum = (self.0[k] + other.0[k]).wrapping_sub(ZEROS);
            // In range are bytes of 0x21 to 0x7f: the highest bit is clear, and one of the next two is set.
            let (high, middle) = (sum & 0x8080_8080_8080_8080, (sum | sum << 1) & ZEROS);
            if high != 0 || middle != ZEROS {
                return None;
            }
            product[k] = sum;
            k += 1;
        }
        Some(Self(product))
    }

    /// The inverse, if its exponents are in range.
    pub(super) fn inverse(&self) -> Option<Self> {
        let mut inverse = Self::ONE;
        for (variable, exponent) in self.exponents() {
            inverse = inverse.with(variable, -exponent);
            (exponent < 0x20).then_some(())?;
        }
        Some(inverse)
    }

    /// The variables with exponents other than zero, in order.
    pub(super) fn exponents(&self) -> Vec<(usize, i32)> {
        let mut exponents = Vec::new();
        for (k, &word) in self.0.iter().enumerate() {
            let mut rest = word ^ ZEROS;
            while rest != 0 {
                let byte = rest.leading_zeros() as usize / 8;
                let variable = 8 * k + byte;
                exponents.push((variable, self.exponent(variable)));
                rest &= !(0xff << Self::shift(variable));
            }
        }
        exponents
    }
}
