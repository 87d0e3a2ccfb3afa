//! The text of a file, and the line and column of every place in it.

use std::cell::Cell;
use std::rc::Rc;

use super::Urdf;
use crate::diagnostics::{Code, Diagnostic, Place};

/// A text whose places can be named.
pub(super) struct Source<'a> {
    file: Rc<str>,
    text: &'a str,
    /// In order; the first is the start of the text.
    marks: Vec<Mark>,
    /// The mark that was found last.
    last: Cell<usize>,
}

/// A place whose line and column are known: the start of each line, and some within long lines.
struct Mark {
    offset: usize,
    line: u32,
    column: u32,
}

/// The longest way from a mark to the next, in bytes: what is counted for one place.
const STRIDE: usize = 1024;

impl<'a> Source<'a> {
    /// Marks the lines of a text.
    pub(super) fn new(urdf: Urdf<'a>) -> Self {
        let Urdf { file, text } = urdf;
        let mut marks = vec![];
        // A byte-order mark has no column.
        let mut offset = text.len() - text.trim_start_matches('\u{feff}').len();
        for (line, content) in (1..).zip(text[offset..].split_inclusive('\n')) {
            let (mut column, mut rest) = (1, content);
            marks.push(Mark { offset, line, column });
            while rest.len() > STRIDE {
                let step = (0..=STRIDE).rev().find(|&end| rest.is_char_boundary(end)).unwrap_or(STRIDE);
                column += count(&rest[..step]);
                (offset, rest) = (offset + step, &rest[step..]);
                marks.push(Mark { offset, line, column });
            }
            offset += rest.len();
        }
        Self { file: file.into(), text, marks, last: Cell::new(0) }
    }

    /// The whole text.
    pub(super) fn text(&self) -> &'a str {
        self.text
    }

    /// The place at a byte of the text. Places are asked for in the order of the text, mostly.
    pub(super) fn place(&self, offset: usize) -> Place {
        let is_near = |at: &usize| {
            let starts_after = |at: usize| self.marks.get(at).is_none_or(|mark| mark.offset > offset);
            !starts_after(*at) && starts_after(at + 1)
        };
        let last = self.last.get();
        let near = (last..last + 4).find(is_near);
        let at = near
            .unwrap_or_else(|| self.marks.partition_point(|mark| mark.offset <= offset).saturating_sub(1));
        self.last.set(at);
        match self.marks.get(at) {
            Some(mark) => {
                let between = self.text.get(mark.offset..offset).unwrap_or_default();
                self.at(mark.line, mark.column + count(between))
            }
            None => self.at(1, 1),
        }
    }

    /// The place at a line and a column.
    pub(super) fn at(&self, line: u32, column: u32) -> Place {
        Place::Text { file: self.file.clone(), line, column }
    }
}

fn count(text: &str) -> u32 {
    u32::try_from(text.chars().count()).unwrap_or(u32::MAX)
}

/// The text of a file as it was read.
///
/// # Errors
///
/// If it is not UTF-8: the place of the first byte that is not.
pub fn text_of<'a>(file: &str, bytes: &'a [u8]) -> Result<&'a str, Diagnostic> {
    std::str::from_utf8(bytes).map_err(|error| {
        let text = std::str::from_utf8(&bytes[..error.valid_up_to()]).unwrap_or_default();
        let place = Source::new(Urdf { file, text }).place(text.len());
        let byte = bytes.get(text.len()).copied().unwrap_or_default();
        let message = match bytes {
            [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => "the file is in UTF-16".to_owned(),
            _ => format!("the file is not in UTF-8: here is the byte {byte:#04x}"),
        };
        Diagnostic::new(Code::XmlInvalid, &place, message).help("save the file in UTF-8")
    })
}

/// A name or a value for a message: in backticks, and cut where it gets long.
pub(super) fn quoted(text: &str) -> String {
    let end = text.char_indices().nth(48).map_or(text.len(), |(end, _)| end);
    let is_harmless = |c: char| !(c.is_control() || turns_text(c));
    let shown: String = text[..end].chars().map(|c| if is_harmless(c) { c } else { '\u{fffd}' }).collect();
    let more = if end < text.len() { "…" } else { "" };
    format!("`{shown}{more}`")
}

/// Whether a character, itself without a shape, turns the direction in which what follows is shown.
pub(super) fn turns_text(c: char) -> bool {
    matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}
