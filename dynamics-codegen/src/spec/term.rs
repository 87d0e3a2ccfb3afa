//! `#[potential(…)]`, `#[dissipation(…)]`, `#[kinetic(…)]`: terms of one's own in the energies.

use super::Formula;
use super::cursor::{Cursor, Result};
use super::formula::Words;
use crate::diagnostics::{Code, Diagnostic, Place};

/// A term as written.
#[derive(Clone, Debug)]
pub struct TermSpec {
    /// What it adds to.
    pub kind: TermKind,
    /// What it is.
    pub formula: Formula,
    /// The whole line.
    pub place: Place,
}

/// What a term adds to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TermKind {
    /// `V`, J.
    Potential,
    /// Rayleigh's function `D`, W.
    Dissipation,
    /// `T`, J.
    Kinetic,
}

impl TermKind {
    /// All of them, by the names of their attributes.
    pub const ALL: [(&'static str, Self); 3] =
        [("potential", Self::Potential), ("dissipation", Self::Dissipation), ("kinetic", Self::Kinetic)];

    /// The name of the attribute.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, kind)| *kind == self).map_or("", |(name, _)| name)
    }

    /// As it is written.
    fn example(self) -> &'static str {
        match self {
            Self::Potential => "#[potential(k / 2 * (r - r0)^2)]",
            Self::Dissipation => "#[dissipation(c / 2 * dot(r)^2)]",
            Self::Kinetic => "#[kinetic(m / 2 * dot(r)^2)]",
        }
    }

    /// The kind of which an attribute has the name.
    pub(super) fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(known, _)| *known == name).map(|(_, kind)| *kind)
    }
}

impl TermSpec {
    /// Reads the contents of the attribute.
    pub(super) fn parse(kind: TermKind, input: Cursor, place: Place) -> Result<Self> {
        let form = |mistake: Diagnostic| match mistake.code {
            Code::Syntax => mistake.help(format!("write `{}`", kind.example())),
            _ => mistake,
        };
        let formula = Formula::parse_in(input, Words::OfTerms).map_err(form)?;
        Ok(Self { kind, formula, place })
    }
}
