//! What the command line says of a robot, as the attributes that would say it on its struct.

use dynamics_codegen::diagnostics::Place;
use proc_macro2::{LineColumn, TokenStream};

use crate::failure::{Failure, Problem, Spot};
use crate::input::shown;

/// Options of the command line, each an attribute.
#[derive(Default)]
pub(crate) struct Attributes(Vec<Given>);

/// An option and its value, and what makes an attribute of the value.
struct Given {
    option: &'static str,
    head: &'static str,
    value: String,
    tail: &'static str,
}

impl Attributes {
    /// Adds an option whose value stands between `head` and `tail` in an attribute.
    pub(crate) fn add(&mut self, option: &'static str, head: &'static str, value: &str, tail: &'static str) {
        self.0.push(Given { option, head, value: value.to_owned(), tail });
    }

    /// Puts each value on one line, by which it is found again. Fails if one has brackets or quotes without their
    /// partners: it would reach beyond its attribute.
    pub(crate) fn checked(mut self) -> Result<Self, Failure> {
        for given in &mut self.0 {
            if given.value.contains('\n') && given.value.contains("//") {
                let title = format!("`--{}` has a comment, and lines behind it", given.option);
                return Err(Problem::new(title).help("leave the comment out").into());
            }
            given.value = given.value.replace(['\n', '\r'], " ");
            if let Err(error) = given.value.parse::<TokenStream>() {
                let at = error.span();
                let title = format!("`--{}` has a bracket or a quote without its partner", given.option);
                let mut problem = Problem::new(title).help("close what is opened");
                problem.spot = Some(given.spot(0, at.start(), at.end()).into());
                return Err(problem.into());
            }
        }
        Ok(self)
    }

    /// As above a struct. The first line is empty, since what has no place is on the first line; then each has two,
    /// for a comment may end the first.
    pub(crate) fn text(&self) -> String {
        let line = |Given { head, value, tail, .. }: &Given| format!("{head}{value}\n{tail}\n");
        format!("\n{}", self.0.iter().map(line).collect::<String>())
    }

    /// As on the command line, with a space before each.
    pub(crate) fn flags(&self) -> String {
        let flag = |Given { option, value, .. }: &Given| format!(" --{option} {}", quoted(&shown(value)));
        self.0.iter().map(flag).collect()
    }

    /// Where tokens of [`text`](Self::text) were written, which had so many lines before it; nowhere if they are not of
    /// it.
    pub(crate) fn spot(&self, place: &Place, lines: usize) -> Option<Spot> {
        let Place::Tokens { start, end } = place else { return None };
        let [start, end] = [start.start(), end.end()]
            .map(|LineColumn { line, column }| LineColumn { line: line.saturating_sub(lines), column });
        let given = self.0.get(start.line.checked_sub(2)? / 2)?;
        Some(given.spot(given.head.len(), start, end))
    }
}

impl Given {
    /// The place from `start` to `end` where `before` columns are before the value.
    fn spot(&self, before: usize, start: LineColumn, end: LineColumn) -> Spot {
        // On its second line an attribute has nothing but its end.
        let is_first = |at: LineColumn| at.line.is_multiple_of(2) || before == 0;
        let column = |at: LineColumn| match is_first(at) {
            true => at.column.saturating_sub(before),
            false => self.value.chars().count(),
        };
        Spot::in_line(format!("--{}", self.option), &self.value, column(start)..column(end))
    }
}

/// A word for a shell.
pub(crate) fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "_-./=".contains(c);
    if word.chars().all(is_plain) && !word.is_empty() {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn words_are_quoted_for_a_shell() {
        assert_eq!(quoted("nonphysical_inertia"), "nonphysical_inertia");
        assert_eq!(quoted("elbow, damping = 0.1"), "'elbow, damping = 0.1'");
        assert_eq!(quoted("it's"), "'it'\\''s'");
        assert_eq!(quoted(""), "''");
    }
}
