//! The state at a start, as `--q` and `--v` give it: vectors, or some of their entries by name.

use std::ops::Range;

use crate::assignment::place_of;
use crate::entry::{Entries, Wrong};
use crate::failure::{Failure, Problem, Spot};
use crate::input::shown;
use crate::robot::{Robot, State};
use crate::state::{check_quaternions, position, wanted};

/// Puts into a state what the options say, and reports all that is wrong with them: `0.1,-20deg`, in brackets or not, or
/// `hinge=-20deg` of some entries.
pub(crate) fn put(
    robot: &Robot<'_>,
    state: &mut State,
    q: Option<&str>,
    v: Option<&str>,
) -> Result<(), Failure> {
    let mut wrong = vec![];
    for (key, text, vector) in [("q", q, &mut state.q), ("v", v, &mut state.v)] {
        if let Some((text, entries)) = text.zip(Entries::of(robot, key)) {
            let given = Given { option: format!("--{key}"), text: text.replace(['\n', '\r'], " "), entries };
            wrong.extend(given.put(vector));
        }
    }
    if wrong.is_empty() { check_quaternions(robot, &state.q) } else { Err(Failure::Wrong(wrong)) }
}

/// An option, and the vector that it is about.
struct Given<'r> {
    option: String,
    text: String,
    entries: Entries<'r>,
}

impl Given<'_> {
    /// Puts all numbers into a vector, and returns what is wrong.
    fn put(&self, vector: &mut [f64]) -> Vec<Problem> {
        let words = self.words();
        let is_named = self.text.contains('=');
        let (count, needed) = (words.len(), self.entries.names.len());
        if !is_named && count != needed {
            let entries = if count == 1 { "entry" } else { "entries" };
            let title = format!("`{}` has {count} {entries}, and needs {needed}", self.option);
            let problem = Problem::new(title).help(format!("give {}", self.wanted(0)));
            return vec![self.spotted(problem, self.trimmed(0..self.text.len()))];
        }
        let mut wrong = vec![];
        for (k, word) in words.into_iter().enumerate() {
            // Names may have the sign, numbers have not.
            let sign = self.text[word.clone()].rfind('=').filter(|_| is_named).map(|at| word.start + at);
            let name = self.trimmed(word.start..sign.unwrap_or(word.start));
            let value = self.trimmed(sign.map_or(word.start, |at| at + 1)..word.end);
            if is_named && sign.is_none() {
                let title =
                    format!("`{}` in `{}` has no name", shown(&self.text[value.clone()]), self.option);
                let help = format!("give {}", self.wanted(0));
                wrong.push(self.spotted(Problem::new(title).help(help), value));
                continue;
            }
            let entry = match is_named {
                true => position(&self.option, &self.text[name.clone()], self.entries.names)
                    .map_err(|problem| self.spotted(problem, name)),
                false => Ok(k),
            };
            match entry.and_then(|entry| Ok((entry, self.number(entry, value)?))) {
                Ok((entry, number)) => vector[entry] = number,
                Err(problem) => wrong.push(problem),
            }
        }
        wrong
    }

    /// What is between commas, in bytes.
    fn words(&self) -> Vec<Range<usize>> {
        let start = self.text.len() - self.text.trim_start().trim_start_matches('[').len();
        let inner = self.text[start..].trim_end().trim_end_matches(']');
        let mut at = start;
        let word = |word: &str| {
            let range = at..at + word.len();
            at = range.end + 1;
            range
        };
        inner.split(',').map(word).collect()
    }

    /// A finite number in SI units.
    fn number(&self, entry: usize, bytes: Range<usize>) -> Result<f64, Problem> {
        let (text, before) = (&self.text[bytes.clone()], self.text[..bytes.start].chars().count());
        let names = self.entries.names;
        match self.entries.number(entry, text, before) {
            Ok(number) if number.is_finite() => Ok(number),
            Ok(number) => {
                let title = format!("`{}` of `{}` is {number}", self.option, shown(&names[entry]));
                Err(self.spotted(Problem::new(title).help("give a finite number"), bytes))
            }
            Err(Wrong::NoNumber) => {
                let title = format!("`{}` in `{}` is no number", shown(text), self.option);
                let help = format!(
                    "give {}; in SI units, or with units, as in `30deg`, `2mm` and `30deg / 1s`",
                    self.wanted(entry)
                );
                Err(self.spotted(Problem::new(title).help(help), bytes))
            }
            Err(Wrong::Of(found)) => {
                let problem =
                    Problem { code: Some(found.code.to_string()), ..Problem::new(found.message.clone()) };
                let problem = problem.help(found.help_text());
                Err(match place_of(&found) {
                    Some(characters) => self.at(problem, characters),
                    None => self.spotted(problem, bytes),
                })
            }
        }
    }

    /// What to give instead, with an entry for an example.
    fn wanted(&self, entry: usize) -> String {
        let names = self.entries.names;
        let example = names.get(entry).map_or("", String::as_str);
        let all = wanted(names);
        format!("{all}, with commas between them, or some by their names, as in `{}=0.1`", shown(example))
    }

    /// Without spaces at both ends.
    fn trimmed(&self, bytes: Range<usize>) -> Range<usize> {
        let text = &self.text[bytes.clone()];
        let start = bytes.start + (text.len() - text.trim_start().len());
        start..start.max(bytes.start + text.trim_end().len())
    }

    /// A problem of some bytes of the option.
    fn spotted(&self, problem: Problem, bytes: Range<usize>) -> Problem {
        let character = |byte: usize| self.text[..byte].chars().count();
        self.at(problem, character(bytes.start)..character(bytes.end))
    }

    fn at(&self, problem: Problem, characters: Range<usize>) -> Problem {
        Problem { spot: Some(Spot::in_line(self.option.clone(), &self.text, characters).into()), ..problem }
    }
}
