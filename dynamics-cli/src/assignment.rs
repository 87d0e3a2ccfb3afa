//! An option that gives a name its value: `--set 'm = 4kg'`, `--vary 'm = uniform(0, 2)'`.

use std::ops::Range;

use dynamics_codegen::diagnostics::{Code, Diagnostic, Place};
use dynamics_codegen::spec::Formula;
use proc_macro2::{Span, TokenStream, TokenTree};

use crate::failure::{Failure, Problem, Spot};
use crate::input::shown;

/// What an option may say.
pub(crate) struct Kind {
    /// Its name.
    pub(crate) option: &'static str,
    /// The whole of it, as one would type it.
    pub(crate) example: &'static str,
    /// What may stand behind the sign.
    pub(crate) forms: &'static str,
    /// Whether a comma ends it, and another one follows.
    pub(crate) separates: bool,
}

/// `name = tokens`, before it is known what the name stands for.
pub(crate) struct Assignment {
    kind: &'static Kind,
    text: String,
    /// What is before the sign.
    pub(crate) name: String,
    /// What is behind it.
    pub(crate) tokens: Vec<TokenTree>,
}

impl Assignment {
    /// Reads the value of an option.
    pub(crate) fn read(kind: &'static Kind, text: &str) -> Result<Self, Failure> {
        let Kind { option, example, forms, separates } = kind;
        let text = text.replace(['\n', '\r'], " ");
        let end = text.chars().count();
        let Some((before, _)) = text.rsplit_once('=') else {
            let problem = spotted(Problem::new(format!("`--{option}` has no `=`")), kind, &text, 0..end);
            let is_number = text.trim().starts_with(|c: char| c.is_ascii_digit());
            return Err(match is_number && *separates {
                true => {
                    problem.help("write a point in a number, as in 1.5: a comma stands before the next name")
                }
                false => problem.help(format!("write a name and its value: {example}")),
            }
            .into());
        };
        let name = before.trim().to_owned();
        let columns = before.chars().count() + 1;
        if name.is_empty() {
            let problem = Problem::new(format!("`--{option}` has no name before the `=`"));
            let problem = spotted(problem, kind, &text, 0..columns);
            return Err(problem.help(format!("write a name and its value: {example}")).into());
        }
        // With as many columns before it, so that what is wrong is found again.
        let padded: String = " ".repeat(columns) + &text.chars().skip(columns).collect::<String>();
        let Ok(tokens) = padded.parse::<TokenStream>() else {
            let problem = Problem::new(format!("`--{option}` has a bracket or a quote without its partner"));
            return Err(spotted(problem, kind, &text, columns..end).help("close what is opened").into());
        };
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        if tokens.is_empty() {
            let problem = Problem::new(format!("`{}` is given no value", shown(&name)));
            return Err(spotted(problem, kind, &text, 0..end).help(*forms).into());
        }
        Ok(Self { kind, text, name, tokens })
    }

    /// All tokens as one formula.
    pub(crate) fn formula(&self) -> Result<Formula, Problem> {
        formula(&self.tokens, Span::call_site()).map_err(|found| self.wrong(&found))
    }

    /// A mistake that is about the name.
    pub(crate) fn wrong_name(&self, title: String, help: String) -> Problem {
        let start = self.text.chars().take_while(|c| c.is_whitespace()).count();
        let range = start..start + self.name.chars().count();
        spotted(Problem::new(title), self.kind, &self.text, range).help(help)
    }

    /// A mistake that is about the value.
    pub(crate) fn wrong_value(&self, title: String, help: &str) -> Problem {
        let end = self.text.chars().count();
        let behind = self.text.rsplit_once('=').map_or("", |(_, behind)| behind);
        let start = end - behind.trim_start().chars().count();
        spotted(Problem::new(title), self.kind, &self.text, start..end).help(help)
    }

    /// A mistake that is about what is between two columns; without these, about all that is behind the sign.
    pub(crate) fn wrong_form(&self, title: String, columns: Option<Range<usize>>) -> Problem {
        let before = self.text.rsplit_once('=').map_or(0, |(before, _)| before.chars().count() + 1);
        let columns = columns.unwrap_or(before..self.text.chars().count());
        spotted(Problem::new(title), self.kind, &self.text, columns).help(self.kind.forms)
    }

    /// A mistake that the compiler has a word for.
    pub(crate) fn wrong(&self, found: &Diagnostic) -> Problem {
        let problem = Problem { code: Some(found.code.to_string()), ..Problem::new(found.message.clone()) };
        let range = place_of(found).unwrap_or(0..self.text.chars().count());
        // The catalogue's help is about attributes.
        let is_of_catalogue = found.code == Code::Syntax && found.help.is_none();
        let help = if is_of_catalogue { self.kind.forms } else { found.help_text() };
        spotted(problem, self.kind, &self.text, range).help(help)
    }
}

/// Reads some tokens as a formula; `around` is their place if there are none.
pub(crate) fn formula(tokens: &[TokenTree], around: Span) -> Result<Formula, Diagnostic> {
    Formula::read(tokens.iter().cloned().collect(), around)
}

/// Where in an option a mistake is, if it is in one.
pub(crate) fn place_of(found: &Diagnostic) -> Option<Range<usize>> {
    match &found.place {
        Place::Tokens { start, end } => {
            columns(*start).zip(columns(*end)).map(|(start, end)| start.start..end.end)
        }
        Place::Text { .. } => None,
    }
}

/// Where a token stands in an option, if it is of one.
pub(crate) fn columns(span: Span) -> Option<Range<usize>> {
    let (start, end) = (span.start(), span.end());
    (start.line == 1 && end.column > start.column).then_some(start.column..end.column)
}

fn spotted(problem: Problem, kind: &Kind, text: &str, characters: Range<usize>) -> Problem {
    Problem { spot: Some(Spot::in_line(format!("--{}", kind.option), text, characters).into()), ..problem }
}
