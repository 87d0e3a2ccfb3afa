//! Matrices and vectors of forms; of symmetric ones each entry is there once.

use super::name::subscript;
use super::{Form, Notation, Unreadable};

/// A matrix of forms; a vector is one of a single column. Two matrices are equal if their entries are.
#[derive(Clone, Debug)]
pub struct Matrix {
    rows: usize,
    columns: usize,
    /// By rows; of a symmetric matrix the upper half with the diagonal.
    entries: Vec<Form>,
    is_symmetric: bool,
}

impl Matrix {
    /// The matrix of its rows.
    pub fn of_rows(rows: Vec<Vec<Form>>) -> Self {
        let (count, columns) = (rows.len(), rows.first().map_or(0, Vec::len));
        Self { rows: count, columns, entries: rows.into_iter().flatten().collect(), is_symmetric: false }
    }

    /// The symmetric matrix of its upper half: rows from the diagonal on.
    pub fn symmetric(upper: Vec<Vec<Form>>) -> Self {
        let n = upper.len();
        Self { rows: n, columns: n, entries: upper.into_iter().flatten().collect(), is_symmetric: true }
    }

    /// A column.
    pub fn vector(entries: Vec<Form>) -> Self {
        Self { rows: entries.len(), columns: 1, entries, is_symmetric: false }
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// How many columns there are.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Whether it is symmetric by its making.
    pub fn is_symmetric(&self) -> bool {
        self.is_symmetric
    }

    /// An entry, from zero on.
    pub fn entry(&self, row: usize, column: usize) -> &Form {
        let (row, column) =
            if self.is_symmetric { (row.min(column), row.max(column)) } else { (row, column) };
        let before = if self.is_symmetric { row * (row + 1) / 2 } else { 0 };
        &self.entries[row * self.columns + column - before]
    }

    /// The entries that are there, with their rows and columns: of a symmetric matrix those on and above the diagonal.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, &Form)> {
        let is_there = |row: usize, column: usize| !self.is_symmetric || column >= row;
        (0..self.rows)
            .flat_map(move |row| (0..self.columns).map(move |column| (row, column)))
            .filter(move |&(row, column)| is_there(row, column))
            .map(|(row, column)| (row, column, self.entry(row, column)))
    }

    /// The matrix with another form for each entry.
    #[must_use]
    pub fn map(&self, f: impl FnMut(&Form) -> Form) -> Self {
        Self { entries: self.entries.iter().map(f).collect(), ..self.clone() }
    }

    /// In brackets, its columns aligned, one line for each row.
    pub fn unicode(&self, notation: &Notation) -> Vec<String> {
        let texts: Vec<Vec<String>> = (0..self.rows)
            .map(|row| (0..self.columns).map(|column| self.entry(row, column).unicode(notation)).collect())
            .collect();
        let widths: Vec<usize> = (0..self.columns)
            .map(|column| texts.iter().map(|row| width(&row[column])).max().unwrap_or(0))
            .collect();
        let line = |(k, row): (usize, &Vec<String>)| {
            let (open, close) = match (k, self.rows) {
                (_, 1) => ('[', ']'),
                (0, _) => ('⎡', '⎤'),
                (k, n) if k + 1 == n => ('⎣', '⎦'),
                _ => ('⎢', '⎥'),
            };
            let cells = row.iter().zip(&widths).map(|(text, &wide)| {
                let space = wide - width(text);
                format!("{}{text}{}", " ".repeat(space / 2), " ".repeat(space - space / 2))
            });
            format!("{open}{}{close}", cells.collect::<Vec<_>>().join("  "))
        };
        texts.iter().enumerate().map(line).collect()
    }

    /// An equation for each entry that is not zero: `M₁₂ = M₂₁ = …`, `G₁ = …`. Rows and columns count from one.
    pub fn unicode_entries(&self, letter: &str, notation: &Notation) -> Vec<String> {
        let lowered = |k: usize| (k + 1).to_string().bytes().map(subscript).collect::<String>();
        let index = |row: usize, column: usize| match self.columns {
            1 => format!("{letter}{}", lowered(row)),
            _ if self.rows.max(self.columns) < 10 => format!("{letter}{}{}", lowered(row), lowered(column)),
            _ => format!("{letter}{}‚{}", lowered(row), lowered(column)),
        };
        let line = |(row, column, form): (usize, usize, &Form)| {
            let mirrored =
                if self.is_symmetric && row != column { index(column, row) + " = " } else { String::new() };
            format!("{} = {mirrored}{}", index(row, column), form.unicode(notation))
        };
        self.entries().filter(|(_, _, form)| !form.is_zero()).map(line).collect()
    }

    /// In LaTeX, as a `bmatrix`.
    pub fn latex(&self, notation: &Notation) -> String {
        let row = |row: usize| {
            let cells = (0..self.columns).map(|column| self.entry(row, column).latex(notation));
            cells.collect::<Vec<_>>().join(" & ")
        };
        let rows: Vec<_> = (0..self.rows).map(row).collect();
        format!("\\begin{{bmatrix}} {} \\end{{bmatrix}}", rows.join(" \\\\ "))
    }

    /// In MathML, as a table in brackets.
    pub fn mathml(&self, notation: &Notation) -> String {
        let mut text = String::from("<mrow><mo>[</mo><mtable>");
        for row in 0..self.rows {
            text.push_str("<mtr>");
            for column in 0..self.columns {
                text.push_str(&format!("<mtd>{}</mtd>", self.entry(row, column).mathml(notation)));
            }
            text.push_str("</mtr>");
        }
        text.push_str("</mtable><mo>]</mo></mrow>");
        text
    }
}

/// # Reading
impl Matrix {
    /// Reads what [`Matrix::unicode`] wrote, its lines one below the other, to the same matrix.
    ///
    /// # Errors
    ///
    /// The first place that cannot be read, in bytes from the start of the text.
    pub fn parse_unicode(text: &str, notation: &Notation) -> Result<Self, Unreadable> {
        let mut rows = Vec::new();
        for line in text.lines() {
            let at = line.as_ptr().addr() - text.as_ptr().addr();
            let inside = line.trim().strip_prefix(['[', '⎡', '⎢', '⎣']);
            let inside = inside.and_then(|inside| inside.strip_suffix([']', '⎤', '⎥', '⎦']));
            let Some(inside) = inside else { return Err(Unreadable { at, expected: "a row in brackets" }) };
            // Columns have two spaces between them, and entries none that are double.
            let cells = inside.split("  ").filter(|cell| !cell.trim().is_empty());
            rows.push(
                cells
                    .map(|cell| read(cell, text, notation, Form::parse_unicode))
                    .collect::<Result<_, _>>()?,
            );
        }
        Self::of_equal_rows(rows)
    }

    /// Reads what [`Matrix::latex`] wrote, to the same matrix.
    ///
    /// # Errors
    ///
    /// The first place that cannot be read, in bytes from the start of the text.
    pub fn parse_latex(text: &str, notation: &Notation) -> Result<Self, Unreadable> {
        let inside = text.trim().strip_prefix("\\begin{bmatrix}");
        let inside = inside.and_then(|inside| inside.strip_suffix("\\end{bmatrix}"));
        let Some(inside) = inside else { return Err(Unreadable { at: 0, expected: "a `bmatrix`" }) };
        let row =
            |row: &str| row.split('&').map(|cell| read(cell, text, notation, Form::parse_latex)).collect();
        Self::of_equal_rows(inside.split("\\\\").map(row).collect::<Result<_, _>>()?)
    }

    fn of_equal_rows(rows: Vec<Vec<Form>>) -> Result<Self, Unreadable> {
        match rows.iter().all(|row| row.len() == rows[0].len()) {
            true => Ok(Self::of_rows(rows)),
            false => Err(Unreadable { at: 0, expected: "rows of one length" }),
        }
    }
}

/// Reads an entry that is a part of a text.
fn read(
    cell: &str,
    text: &str,
    notation: &Notation,
    parse: fn(&str, &Notation) -> Result<Form, Unreadable>,
) -> Result<Form, Unreadable> {
    let cell = cell.trim();
    let before = cell.as_ptr().addr() - text.as_ptr().addr();
    parse(cell, notation).map_err(|Unreadable { at, expected }| Unreadable { at: before + at, expected })
}

impl PartialEq for Matrix {
    fn eq(&self, other: &Self) -> bool {
        let same = |row: usize, column: usize| self.entry(row, column) == other.entry(row, column);
        let size = (self.rows, self.columns);
        size == (other.rows, other.columns)
            && (0..size.0).all(|row| (0..size.1).all(|column| same(row, column)))
    }
}

impl Eq for Matrix {}

/// How many places a text takes: dots above letters take none.
pub(super) fn width(text: &str) -> usize {
    text.chars().filter(|c| !matches!(c, '\u{300}'..='\u{36f}')).count()
}
