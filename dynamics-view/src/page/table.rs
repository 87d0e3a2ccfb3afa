//! Tables, matrices, and the structure of a matrix.

use super::html::{Html, inline};
use super::number::number;
use crate::error::{Error, check_length, check_numbers};
use crate::svg::escaped;

/// A table with a caption. The first column says what a row is of.
#[derive(Clone, Debug)]
pub struct Table {
    caption: String,
    columns: String,
    head: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// A matrix of numbers, with the names of its rows and columns. What is zero stands back.
#[derive(Clone, Debug)]
pub struct Matrix {
    /// What it is called: `A`.
    pub name: String,
    /// What it is, in words.
    pub caption: String,
    /// The names of its rows.
    pub rows: Vec<String>,
    /// Those of its columns.
    pub columns: Vec<String>,
    /// By rows.
    pub entries: Vec<Vec<f64>>,
}

/// The structure of a matrix: what each entry depends on.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// What it is, in words.
    pub caption: String,
    /// The names of its rows.
    pub rows: Vec<String>,
    /// Those of its columns, in few letters.
    pub columns: Vec<String>,
    /// What entries can depend on, in few letters: `q₁`.
    pub variables: Vec<String>,
    /// By rows.
    pub cells: Vec<Vec<Cell>>,
}

/// An entry of a matrix.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// It is zero.
    Zero,
    /// It is this number.
    Constant(f64),
    /// It depends on variables, by their indices, increasing.
    Varies(Vec<usize>),
}

/// Digits of entries.
const DIGITS: usize = 4;
/// Matrices of more rows than this have no room for names in their cells.
const NAMED: usize = 9;

impl Table {
    /// An empty table, with columns to the left (`l`), as code to the left (`c`), or to the right (`r`).
    #[must_use]
    pub fn new(caption: &str, columns: &str) -> Self {
        Self { caption: caption.to_owned(), columns: columns.to_owned(), head: vec![], rows: vec![] }
    }

    /// With the names of its columns.
    #[must_use]
    pub fn head<S: Into<String>>(mut self, names: impl IntoIterator<Item = S>) -> Self {
        self.head = names.into_iter().map(Into::into).collect();
        self
    }

    /// With a row below those before it.
    #[must_use]
    pub fn row<S: Into<String>>(mut self, cells: impl IntoIterator<Item = S>) -> Self {
        self.rows.push(cells.into_iter().map(Into::into).collect());
        self
    }

    /// With several rows.
    #[must_use]
    pub fn rows(mut self, rows: impl IntoIterator<Item = Vec<String>>) -> Self {
        self.rows.extend(rows);
        self
    }

    /// Whether it has no rows.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    pub(super) fn write(&self, html: &mut Html) {
        let side = |k: usize| match self.columns.as_bytes().get(k) {
            Some(b'r') => r#" class="right""#,
            _ => "",
        };
        html.put(r#"<div class="wide" tabindex="0" role="group" aria-label="a table, to be scrolled">"#);
        html.put(&format!("<table><caption>{}</caption>", inline(&self.caption)));
        let head = self.head.iter().enumerate();
        let head = head.map(|(k, name)| format!(r#"<th scope="col"{}>{}</th>"#, side(k), inline(name)));
        html.put(&format!("<thead><tr>{}</tr></thead><tbody>", head.collect::<String>()));
        for row in &self.rows {
            let cell = |(k, text): (usize, &String)| {
                let is_code = self.columns.as_bytes().get(k) == Some(&b'c');
                let text = if is_code && !text.is_empty() {
                    format!("<code>{}</code>", escaped(text))
                } else {
                    inline(text)
                };
                match k {
                    0 => format!(r#"<th scope="row"{}>{text}</th>"#, side(k)),
                    _ => format!("<td{}>{text}</td>", side(k)),
                }
            };
            html.put(&format!("<tr>{}</tr>", row.iter().enumerate().map(cell).collect::<String>()));
        }
        html.put("</tbody></table></div>");
    }
}

impl Matrix {
    pub(super) fn write(&self, html: &mut Html, id: &str) -> Result<(), Error> {
        check_length(&format!("the rows of {}", self.name), self.rows.len(), self.entries.len())?;
        html.put(&format!(r#"<div class="wide" tabindex="0" role="group" aria-labelledby="{id}">"#));
        html.put(&format!(
            r#"<table class="matrix"><caption id="{id}"><i>{}</i>, {}</caption>"#,
            escaped(&self.name),
            inline(&self.caption)
        ));
        let column = |name: &String| format!(r#"<th scope="col">{}</th>"#, inline(name));
        let columns: String = self.columns.iter().map(column).collect();
        html.put(&format!("<thead><tr><td></td>{columns}</tr></thead><tbody>"));
        for (name, row) in self.rows.iter().zip(&self.entries) {
            check_length(&format!("a row of {}", self.name), self.columns.len(), row.len())?;
            check_numbers(&format!("an entry of {}", self.name), row.iter().copied())?;
            let cell = |entry: &f64| match *entry {
                0.0 => r#"<td class="zero">0</td>"#.to_owned(),
                entry => format!("<td>{}</td>", number(entry, DIGITS)),
            };
            let cells: String = row.iter().map(cell).collect();
            html.put(&format!(r#"<tr><th scope="row">{}</th>{cells}</tr>"#, inline(name)));
        }
        html.put("</tbody></table></div>");
        Ok(())
    }
}

impl Pattern {
    pub(super) fn write(&self, html: &mut Html) -> Result<(), Error> {
        let n = self.rows.len();
        check_length("the rows of a pattern", n, self.cells.len())?;
        check_length("the columns of a pattern", n, self.columns.len())?;
        let size = if n <= NAMED { "" } else { " small" };
        html.put(
            r#"<div class="wide" tabindex="0" role="group" aria-label="the structure, to be scrolled">"#,
        );
        html.put(&format!(r#"<table class="pattern{size}"><caption>{}</caption>"#, inline(&self.caption)));
        // Where there is no room for names, columns are those of the rows, in their order.
        let column = |(k, name): (usize, &String)| match n <= NAMED {
            true => format!(r#"<th scope="col">{}</th>"#, inline(name)),
            false => format!(r#"<th scope="col" title="{}">{}</th>"#, escaped(name), k + 1),
        };
        let columns: String = self.columns.iter().enumerate().map(column).collect();
        html.put(&format!("<thead><tr><td></td>{columns}</tr></thead><tbody>"));
        for (i, (name, row)) in self.rows.iter().zip(&self.cells).enumerate() {
            check_length("a row of a pattern", n, row.len())?;
            let cells: String = row.iter().map(|cell| self.cell(cell, n <= NAMED)).collect();
            let number = if n <= NAMED { String::new() } else { format!("{} ", i + 1) };
            html.put(&format!(r#"<tr><th scope="row">{number}{}</th>{cells}</tr>"#, inline(name)));
        }
        html.put("</tbody></table></div>");
        html.put(LEGEND);
        Ok(())
    }

    fn cell(&self, cell: &Cell, has_room: bool) -> String {
        match cell {
            Cell::Zero => r#"<td class="zero">0</td>"#.to_owned(),
            Cell::Constant(value) => {
                let value = number(*value, DIGITS);
                let text = if has_room { &*value } else { "c" };
                format!(r#"<td class="constant" title="{value}, always">{text}</td>"#)
            }
            Cell::Varies(on) => {
                let name =
                    |k: &usize| self.variables.get(*k).map_or_else(|| k.to_string(), |name| escaped(name));
                let names: Vec<String> = on.iter().map(name).collect();
                let depth = on.len().min(5);
                let text = if has_room { names.join(" ") } else { on.len().to_string() };
                let title = names.join(", ");
                format!(r#"<td class="varies depth{depth}" title="depends on {title}">{text}</td>"#)
            }
        }
    }
}

const LEGEND: &str = r#"<p class="legend-of-pattern"><span class="zero">0</span> always zero <span class="constant">c</span> constant <span class="varies depth1">q</span> depends on one coordinate <span class="varies depth5">q q q</span> on several</p>"#;
