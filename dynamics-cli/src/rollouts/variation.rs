//! What `--vary` and `--grid` say: which quantity, and what its values are.

use std::ops::Range;

use dynamics_codegen::diagnostics::{Code, Diagnostic, Place};
use dynamics_codegen::spec::Formula;
use proc_macro2::{Delimiter, Span, TokenStream, TokenTree};

use super::quantity::{Exponents, value};
use crate::failure::{Failure, Problem, Spot};
use crate::input::shown;

/// The value of one of the options, before it is known what its name stands for.
pub(super) struct Given {
    /// `vary` or `grid`.
    option: &'static str,
    text: String,
    /// What is before the sign.
    pub(super) name: String,
    what: Written,
}

/// What is behind the sign.
enum Written {
    /// A distribution, and its arguments.
    Drawn(Distribution, [Formula; 2]),
    /// Several values, one after another.
    Listed(Vec<Formula>),
    /// So many between two, at equal distances.
    Spread([Formula; 2], usize),
}

/// How numbers are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Distribution {
    /// All between two are as likely.
    Uniform,
    /// The mean, and the standard deviation.
    Normal,
    /// All between two are as likely by their logarithms.
    LogUniform,
}

/// The values of a quantity, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Values {
    /// Another one for each rollout.
    Drawn(Distribution, [f64; 2]),
    /// Those of a grid, or the same for all.
    Listed(Vec<f64>),
}

const FORMS: &str =
    "write a distribution, `uniform(0, 2)`, `normal(1, 0.1)` or `loguniform(0.01, 1)`, or a number";
const LISTS: &str = "write numbers, `0, 0.5, 1`, or so many at equal distances, `linspace(0, 1, 11)`";

/// What may stand behind the sign.
fn forms(option: &str) -> &'static str {
    if option == "vary" { FORMS } else { LISTS }
}

impl Given {
    /// Reads an option.
    pub(super) fn read(option: &'static str, text: &str) -> Result<Self, Failure> {
        let text = text.replace(['\n', '\r'], " ");
        let example = match option {
            "vary" => "--vary 'payload = uniform(0, 2)'",
            _ => "--grid 'payload = 0, 0.5, 1'",
        };
        let (Some((before, _)), end) = (text.rsplit_once('='), text.chars().count()) else {
            let problem = Problem::new(format!("`--{option}` has no `=`"));
            return Err(spotted(problem, option, &text, 0..text.chars().count())
                .help(format!("write a name and its values: {example}"))
                .into());
        };
        let name = before.trim().to_owned();
        let columns = before.chars().count() + 1;
        if name.is_empty() {
            let problem = Problem::new(format!("`--{option}` has no name before the `=`"));
            return Err(spotted(problem, option, &text, 0..columns)
                .help(format!("name what varies: {example}"))
                .into());
        }
        // With as many columns before it, so that what is wrong is found again.
        let padded: String = " ".repeat(columns) + &text.chars().skip(columns).collect::<String>();
        let help = forms(option);
        let Ok(tokens) = padded.parse::<TokenStream>() else {
            let problem = Problem::new(format!("`--{option}` has a bracket or a quote without its partner"));
            return Err(spotted(problem, option, &text, columns..end).help("close what is opened").into());
        };
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        if tokens.is_empty() {
            let problem = Problem::new(format!("`{}` is given no value", shown(&name)));
            return Err(spotted(problem, option, &text, 0..end).help(help).into());
        }
        let read = if option == "vary" { drawn(&tokens) } else { listed(&tokens) };
        match read {
            Ok(what) => Ok(Self { option, text, name, what }),
            Err(Wrong::Of(found)) => Err(problem_of(&found, option, &text).into()),
            Err(Wrong::Form(message, range)) => {
                let range = range.unwrap_or(columns..end);
                Err(spotted(Problem::new(message), option, &text, range).help(help).into())
            }
        }
    }

    /// A mistake that is about the name.
    pub(super) fn wrong_name(&self, title: String, help: String) -> Problem {
        let start = self.text.chars().take_while(|c| c.is_whitespace()).count();
        let range = start..start + self.name.chars().count();
        spotted(Problem::new(title), self.option, &self.text, range).help(help)
    }

    /// A mistake that is about the values.
    pub(super) fn wrong_values(&self, title: String, help: &str) -> Problem {
        let end = self.text.chars().count();
        let behind = self.text.rsplit_once('=').map_or("", |(_, behind)| behind);
        let start = end - behind.trim_start().chars().count();
        spotted(Problem::new(title), self.option, &self.text, start..end).help(help)
    }

    /// The values in SI units, where those of a quantity of this unit are wanted.
    pub(super) fn values(&self, unit: Option<Exponents>) -> Result<Values, Failure> {
        let of = |formula: &Formula| {
            value(formula, unit, &self.name).map_err(|found| problem_of(&found, self.option, &self.text))
        };
        let both = |[a, b]: &[Formula; 2]| Ok::<_, Problem>([of(a)?, of(b)?]);
        match &self.what {
            Written::Listed(formulas) => {
                Ok(Values::Listed(formulas.iter().map(of).collect::<Result<_, Problem>>()?))
            }
            Written::Spread(ends, count) => {
                let [from, to] = both(ends)?;
                let part = |k: usize| k as f64 / (*count as f64 - 1.0);
                let at = |k: usize| if k + 1 == *count { to } else { from + (to - from) * part(k) };
                Ok(Values::Listed((0..*count).map(at).collect()))
            }
            Written::Drawn(distribution, arguments) => {
                let arguments = both(arguments)?;
                self.check(*distribution, arguments)?;
                Ok(Values::Drawn(*distribution, arguments))
            }
        }
    }

    fn check(&self, distribution: Distribution, [a, b]: [f64; 2]) -> Result<(), Failure> {
        let (title, help) = match distribution {
            Distribution::Normal if b < 0.0 => (
                format!("the standard deviation {b:?} is negative"),
                "give the mean, and a deviation of 0 or more",
            ),
            Distribution::LogUniform if a <= 0.0 => {
                (format!("the logarithm of {a:?} is no number"), "give two numbers above zero")
            }
            Distribution::Uniform | Distribution::LogUniform if a > b => {
                (format!("the range from {a:?} to {b:?} is empty"), "give the smaller number first")
            }
            Distribution::Uniform if !(b - a).is_finite() => (
                format!("the range from {a:?} to {b:?} is out of range"),
                "give numbers nearer to each other",
            ),
            _ => return Ok(()),
        };
        Err(self.wrong_values(title, help).into())
    }
}

/// What is wrong with values.
enum Wrong {
    Of(Diagnostic),
    Form(String, Option<Range<usize>>),
}

impl From<Diagnostic> for Wrong {
    fn from(found: Diagnostic) -> Self {
        Self::Of(found)
    }
}

/// `uniform(a, b)`, `a..b`, and the like, or a number.
fn drawn(tokens: &[TokenTree]) -> Result<Written, Wrong> {
    if let Some((name, arguments, span)) = call(tokens)
        && !["sin", "cos", "sqrt"].contains(&name.as_str())
    {
        let distribution = match name.as_str() {
            "uniform" => Distribution::Uniform,
            "normal" => Distribution::Normal,
            "loguniform" => Distribution::LogUniform,
            _ => {
                return Err(Wrong::Form(
                    format!("there is no distribution `{}`", shown(&name)),
                    columns(span),
                ));
            }
        };
        let parts = split(arguments);
        let [a, b] = parts.as_slice() else {
            let message = format!("`{name}` has 2 arguments, found {}", parts.len());
            return Err(Wrong::Form(message, None));
        };
        return Ok(Written::Drawn(distribution, [formula(a, span)?, formula(b, span)?]));
    }
    let is_dot = |token: &TokenTree| matches!(token, TokenTree::Punct(punct) if punct.as_char() == '.');
    if let Some(at) = tokens.windows(2).position(|pair| pair.iter().all(is_dot)) {
        let (from, to) = (&tokens[..at], &tokens[at + 2..]);
        if from.is_empty() || to.is_empty() {
            return Err(Wrong::Form("a range needs a number on both sides".to_owned(), None));
        }
        return Ok(Written::Drawn(
            Distribution::Uniform,
            [formula(from, from[0].span())?, formula(to, to[0].span())?],
        ));
    }
    Ok(Written::Listed(vec![formula(tokens, Span::call_site())?]))
}

/// More points than this are no grid to wait for.
const MOST_POINTS: usize = 1_000_000;

/// `a, b, c`, or `linspace(a, b, n)`.
fn listed(tokens: &[TokenTree]) -> Result<Written, Wrong> {
    if let Some((name, arguments, span)) = call(tokens)
        && name == "linspace"
    {
        let parts = split(arguments);
        let [a, b, n] = parts.as_slice() else {
            let message = format!("`linspace` has 3 arguments, found {}", parts.len());
            return Err(Wrong::Form(message, None));
        };
        let count = match n.as_slice() {
            [TokenTree::Literal(literal)] => literal.to_string().parse::<usize>().ok(),
            _ => None,
        };
        let Some(count) = count.filter(|count| (2..=MOST_POINTS).contains(count)) else {
            let message = format!("`linspace` gives from 2 to {MOST_POINTS} numbers");
            return Err(Wrong::Form(message, n.first().and_then(|token| columns(token.span()))));
        };
        return Ok(Written::Spread([formula(a, span)?, formula(b, span)?], count));
    }
    let parts = split(tokens.iter().cloned().collect());
    Ok(Written::Listed(parts.iter().map(|part| formula(part, Span::call_site())).collect::<Result<_, _>>()?))
}

/// The name and the arguments of `name(…)`.
fn call(tokens: &[TokenTree]) -> Option<(String, TokenStream, Span)> {
    match tokens {
        [TokenTree::Ident(name), TokenTree::Group(group)] if group.delimiter() == Delimiter::Parenthesis => {
            Some((name.to_string(), group.stream(), name.span()))
        }
        _ => None,
    }
}

/// What is between commas; the last comma may have nothing behind it.
fn split(tokens: TokenStream) -> Vec<Vec<TokenTree>> {
    let mut parts = vec![vec![]];
    for token in tokens {
        match &token {
            TokenTree::Punct(punct) if punct.as_char() == ',' => parts.push(vec![]),
            _ => parts.last_mut().into_iter().for_each(|part| part.push(token.clone())),
        }
    }
    if parts.last().is_some_and(Vec::is_empty) {
        parts.pop();
    }
    parts
}

fn formula(tokens: &[TokenTree], around: Span) -> Result<Formula, Diagnostic> {
    Formula::read(tokens.iter().cloned().collect(), around)
}

fn columns(span: Span) -> Option<Range<usize>> {
    let (start, end) = (span.start(), span.end());
    (start.line == 1 && end.column > start.column).then_some(start.column..end.column)
}

/// A mistake that the compiler has a word for.
fn problem_of(found: &Diagnostic, option: &'static str, text: &str) -> Problem {
    let range = match &found.place {
        Place::Tokens { start, end } => columns(*start).zip(columns(*end)).map(|(a, b)| a.start..b.end),
        Place::Text { .. } => None,
    };
    let problem = Problem { code: Some(found.code.to_string()), ..Problem::new(found.message.clone()) };
    let problem = spotted(problem, option, text, range.unwrap_or(0..text.chars().count()));
    // The catalogue's help is about attributes.
    problem.help(if found.code == Code::Syntax { forms(option) } else { found.help_text() })
}

fn spotted(problem: Problem, option: &str, text: &str, characters: Range<usize>) -> Problem {
    Problem { spot: Some(Spot::in_line(format!("--{option}"), text, characters).into()), ..problem }
}

#[cfg(test)]
mod tests {
    use super::{Distribution, Given, Values};
    use crate::failure::Failure;

    fn values(option: &'static str, text: &str, unit: Option<[i32; 3]>) -> Result<Values, String> {
        let title = |failure| match failure {
            Failure::Wrong(problems) => problems.into_iter().map(|problem| problem.title).collect::<String>(),
            Failure::CommandLine(problem) => problem.title,
            Failure::PipeClosed => String::new(),
        };
        Given::read(option, text).and_then(|given| given.values(unit)).map_err(title)
    }

    #[test]
    fn values_are_read_in_si_units() {
        let mass = Some([1, 0, 0]);
        let uniform = |a, b| Ok(Values::Drawn(Distribution::Uniform, [a, b]));
        assert_eq!(values("vary", "m = uniform(0, 2)", mass), uniform(0.0, 2.0));
        assert_eq!(values("vary", "m = 500g..2", mass), uniform(0.5, 2.0));
        assert_eq!(values("vary", "q.a=-1 .. 1", None), uniform(-1.0, 1.0));
        assert_eq!(values("vary", "m = 0.5..1.5", mass), uniform(0.5, 1.5));
        let normal = Ok(Values::Drawn(Distribution::Normal, [0.0, std::f64::consts::FRAC_PI_6]));
        assert_eq!(values("vary", "q.a = normal(0, 30deg)", Some([0; 3])), normal);
        assert_eq!(
            values("vary", "v.a = 180deg / 2s", Some([0, 0, -1])),
            Ok(Values::Listed(vec![std::f64::consts::FRAC_PI_2]))
        );
        let list = Ok(Values::Listed(vec![0.0, 0.25, 0.5, 0.75, 1.0]));
        assert_eq!(values("grid", "m = linspace(0, 1, 5)", mass), list);
        assert_eq!(values("grid", "m = 0, 250g, 1/2, 0.75, 1", mass), list);
    }

    #[test]
    fn what_is_no_value_is_refused() {
        for (option, text, expected) in [
            ("vary", "m", "`--vary` has no `=`"),
            ("vary", "= 2", "`--vary` has no name before the `=`"),
            ("vary", "m =", "`m` is given no value"),
            ("vary", "m = (1", "`--vary` has a bracket or a quote without its partner"),
            ("vary", "m = gamma(1, 2)", "there is no distribution `gamma`"),
            ("vary", "m = uniform(1)", "`uniform` has 2 arguments, found 1"),
            ("vary", "m = uniform(2, 1)", "the range from 2.0 to 1.0 is empty"),
            ("vary", "m = normal(1, -1)", "the standard deviation -1.0 is negative"),
            ("vary", "m = loguniform(0, 1)", "the logarithm of 0.0 is no number"),
            ("vary", "m = ..2", "a range needs a number on both sides"),
            ("vary", "m = 2m", "`2m` has the unit m, and `m` kg"),
            ("vary", "m = payload", "`payload` is no number"),
            ("vary", "m = 1e999", "the number `1e999` is out of range"),
            ("grid", "m = linspace(0, 1, 1)", "`linspace` gives from 2 to 1000000 numbers"),
            ("grid", "m = linspace(0, 1)", "`linspace` has 3 arguments, found 2"),
        ] {
            assert_eq!(values(option, text, Some([1, 0, 0])), Err(expected.to_owned()), "{text}");
        }
        for text in ["m = 1 2", "m = ,", "m = 1,,2", "m = uniform", "m = \"1\"", "m = 2furlong"] {
            assert!(values("grid", text, None).is_err() && values("vary", text, None).is_err(), "{text}");
        }
    }
}
