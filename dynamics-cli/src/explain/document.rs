//! A text with equations, before it is known how it will be written.

use dynamics_codegen::closed::{Form, Matrix};

use crate::digits::short;

/// A part of a document, on lines of its own.
pub(super) enum Block {
    Title(Vec<Piece>),
    Heading(String),
    Text(Vec<Piece>),
    List(Vec<Vec<Piece>>),
    /// Sides with equality signs between them.
    Equation(Vec<Side>),
}

impl Block {
    /// What is written in it of a robot's own.
    pub(super) fn forms(&self) -> Vec<&Form> {
        match self {
            Self::Title(pieces) | Self::Text(pieces) => pieces.iter().flat_map(Piece::forms).collect(),
            Self::Heading(_) => vec![],
            Self::List(items) => items.iter().flatten().flat_map(Piece::forms).collect(),
            Self::Equation(sides) => sides.iter().flat_map(Side::forms).collect(),
        }
    }

    /// Rounds its numbers.
    pub(super) fn shorten(&mut self) {
        match self {
            Self::Title(pieces) | Self::Text(pieces) => pieces.iter_mut().for_each(Piece::shorten),
            Self::Heading(_) => {}
            Self::List(items) => items.iter_mut().flatten().for_each(Piece::shorten),
            Self::Equation(sides) => sides.iter_mut().for_each(Side::shorten),
        }
    }
}

/// A part of a line.
#[derive(Clone)]
pub(super) enum Piece {
    Words(String),
    /// A name of the program.
    Name(String),
    Math(Math),
    Form(Form),
    /// A vector, on the line.
    Vector(Matrix),
}

impl Piece {
    fn forms(&self) -> Vec<&Form> {
        match self {
            Self::Form(form) => vec![form],
            Self::Vector(vector) => vector.entries().map(|(_, _, form)| form).collect(),
            Self::Words(_) | Self::Name(_) | Self::Math(_) => vec![],
        }
    }

    fn shorten(&mut self) {
        match self {
            Self::Form(form) => *form = short(form),
            Self::Vector(vector) => *vector = vector.map(short),
            Self::Words(_) | Self::Name(_) | Self::Math(_) => {}
        }
    }
}

/// Mathematics that is the same for every robot.
#[derive(Clone)]
pub(super) struct Math {
    pub(super) unicode: String,
    pub(super) latex: String,
}

/// A side of an equation.
#[derive(Clone)]
pub(super) enum Side {
    Math(Math),
    Form(Form),
    Matrix(Matrix),
}

impl Side {
    fn forms(&self) -> Vec<&Form> {
        match self {
            Self::Math(_) => vec![],
            Self::Form(form) => vec![form],
            Self::Matrix(matrix) => matrix.entries().map(|(_, _, form)| form).collect(),
        }
    }

    fn shorten(&mut self) {
        match self {
            Self::Math(_) => {}
            Self::Form(form) => *form = short(form),
            Self::Matrix(matrix) => *matrix = matrix.map(short),
        }
    }
}

/// Mathematics in both notations.
pub(super) fn math(unicode: impl Into<String>, latex: impl Into<String>) -> Math {
    Math { unicode: unicode.into(), latex: latex.into() }
}

/// Words, with mathematics as `$T = ½ v|T = \frac{1}{2} v$` in both notations, and names in backquotes.
pub(super) fn words(text: &str) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for (k, part) in text.split('$').enumerate() {
        match part.split_once('|') {
            Some((unicode, latex)) if k % 2 == 1 => pieces.push(Piece::Math(math(unicode, latex))),
            _ if k % 2 == 1 => pieces.push(Piece::Math(math(part, part))),
            _ => pieces.extend(names(part)),
        }
    }
    pieces
}

fn names(text: &str) -> impl Iterator<Item = Piece> + '_ {
    let parts = text.split('`').enumerate().filter(|(_, part)| !part.is_empty());
    parts.map(
        |(k, part)| {
            if k % 2 == 1 { Piece::Name(part.to_owned()) } else { Piece::Words(part.to_owned()) }
        },
    )
}

/// A whole number, lowered: `₁₂`.
pub(super) fn lowered(k: usize) -> String {
    k.to_string()
        .bytes()
        .filter_map(|digit| char::from_u32(u32::from('₀') + u32::from(digit - b'0')))
        .collect()
}

/// A letter with indices from zero on, written from one on, and a raised letter behind it: `J₁ᵇ`.
pub(super) fn indexed(unicode: &str, latex: &str, indices: &[usize], raised: Option<(&str, &str)>) -> Math {
    let separator = if indices.iter().any(|&k| k >= 9) { [",", ","] } else { ["", " "] };
    let below: Vec<String> = indices.iter().map(|&k| lowered(k + 1)).collect();
    let below_latex: Vec<String> = indices.iter().map(|&k| (k + 1).to_string()).collect();
    let (up, up_latex) = raised.unwrap_or_default();
    let up_latex = if up_latex.is_empty() { String::new() } else { format!("^{{{up_latex}}}") };
    let unicode = format!("{unicode}{}{up}", below.join(separator[0]));
    math(unicode, format!("{latex}_{{{}}}{up_latex}", below_latex.join(separator[1])))
}
