//! What the symbols of some expressions are called, and what they are.

use super::Name;
use crate::symbolic::SymbolId;

/// The names of symbols, no two alike, and what an expression's order depends on.
#[derive(Clone, Debug, Default)]
pub struct Notation {
    letters: Vec<Letter>,
    /// Unit quaternions: the symbols of `x`, `y`, `z` and `w`, whose squares sum to one.
    quaternions: Vec<[SymbolId; 4]>,
}

/// A symbol as it is written.
#[derive(Clone, Debug)]
pub struct Letter {
    /// Its name.
    pub name: Name,
    /// What it is.
    pub role: Role,
    /// Where a parameter stands among factors: masses before what weighs, and that before lengths.
    pub rank: u8,
    /// In Unicode and in LaTeX.
    texts: [String; 2],
}

/// What a symbol is. Factors are written in this order, but for what a textbook has otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// A number that is known before the motion.
    Parameter,
    /// A name for a part of expressions.
    Intermediate,
    /// A coordinate.
    Coordinate,
    /// The rate of a coordinate, or another speed.
    Speed,
    /// The rate of a speed.
    Acceleration,
    /// A force.
    Force,
}

/// What no name can be, in Unicode and in LaTeX.
const RESERVED: [&[&str]; 2] = [&["sin", "cos", "π"], &["\\pi"]];

impl Notation {
    /// No symbols.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds the next symbol, which is that of its place; a name that is taken gets marks.
    pub fn add(&mut self, mut name: Name, role: Role) -> SymbolId {
        while !self.is_free(&name) {
            name = name.marked();
        }
        let texts = [name.unicode(), name.latex()];
        self.letters.push(Letter { name, role, rank: 0, texts });
        SymbolId(u32::try_from(self.letters.len() - 1).expect("fewer than 2^32 symbols"))
    }

    /// Whether a name is written like that of no symbol, nor like π or a function.
    pub fn is_free(&self, name: &Name) -> bool {
        let is_taken = |(k, text): (usize, &String)| {
            RESERVED[k].contains(&&**text) || self.letters.iter().any(|letter| letter.texts[k] == *text)
        };
        ![name.unicode(), name.latex()].iter().enumerate().any(is_taken)
    }

    /// All symbols, in their order.
    pub fn letters(&self) -> &[Letter] {
        &self.letters
    }

    /// Moves a parameter behind those of smaller rank; without it the rank is zero, and symbols have their own order.
    pub fn set_rank(&mut self, symbol: SymbolId, rank: u8) {
        self.letters[symbol.0 as usize].rank = rank.min(u8::MAX - 1);
    }

    /// Says that four coordinates are a unit quaternion.
    pub fn add_quaternion(&mut self, components: [SymbolId; 4]) {
        self.quaternions.push(components);
    }

    /// The unit quaternions.
    pub fn quaternions(&self) -> &[[SymbolId; 4]] {
        &self.quaternions
    }

    /// How many symbols there are.
    pub fn len(&self) -> usize {
        self.letters.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.letters.is_empty()
    }

    /// Whether a symbol begins with a letter, with or without an index.
    pub(super) fn has_letter(&self, letter: &str) -> bool {
        self.letters.iter().any(|known| known.texts[0].starts_with(letter))
    }

    /// A symbol as it is written.
    pub fn letter(&self, symbol: SymbolId) -> &Letter {
        &self.letters[symbol.0 as usize]
    }

    /// The name of a symbol in Unicode.
    pub(super) fn unicode(&self, symbol: SymbolId) -> &str {
        &self.letter(symbol).texts[0]
    }

    /// The name of a symbol in LaTeX.
    pub(super) fn latex(&self, symbol: SymbolId) -> &str {
        &self.letter(symbol).texts[1]
    }

    /// The symbol whose name a text begins with, the longest, and how long it is.
    pub(super) fn at_start_of(&self, text: &str, latex: bool) -> Option<(SymbolId, usize)> {
        let name = |k: usize| self.letters[k].texts[usize::from(latex)].as_str();
        let goes_on = |c: char| {
            c.is_alphabetic() || matches!(c, '_' | '\'' | '′' | '0'..='9' | '₀'..='₉' | '\u{300}'..='\u{36f}')
        };
        let begins = |&k: &usize| text.strip_prefix(name(k)).is_some_and(|rest| !rest.starts_with(goes_on));
        let found = (0..self.letters.len()).filter(begins).max_by_key(|&k| name(k).len())?;
        Some((SymbolId(u32::try_from(found).ok()?), name(found).len()))
    }
}
