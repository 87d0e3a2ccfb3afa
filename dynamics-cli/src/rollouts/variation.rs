//! What `--vary` and `--grid` say: which quantity, and what its values are.

use std::ops::Range;

use dynamics_codegen::diagnostics::Diagnostic;
use dynamics_codegen::spec::Formula;
use proc_macro2::{Delimiter, Span, TokenStream, TokenTree};

use crate::assignment::{Assignment, Kind, columns, formula};
use crate::failure::{Failure, Problem};
use crate::input::shown;
use crate::quantity::{Exponents, value};

/// The value of one of the options, before it is known what its name stands for.
pub(super) struct Given {
    /// The name, and how to complain of it.
    pub(super) assignment: Assignment,
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

/// `--vary`
pub(super) const VARY: Kind = Kind {
    option: "vary",
    example: "--vary 'payload = uniform(0, 2)'",
    forms: "write a distribution, `uniform(0, 2)`, `normal(1, 0.1)` or `loguniform(0.01, 1)`, or a number",
    separates: false,
};

/// `--grid`
pub(super) const GRID: Kind = Kind {
    option: "grid",
    example: "--grid 'payload = 0, 0.5, 1'",
    forms: "write numbers, `0, 0.5, 1`, or so many at equal distances, `linspace(0, 1, 11)`",
    separates: false,
};

impl Given {
    /// Reads an option.
    pub(super) fn read(kind: &'static Kind, text: &str) -> Result<Self, Failure> {
        let assignment = Assignment::read(kind, text)?;
        let tokens = &assignment.tokens;
        let read = if kind.option == VARY.option { drawn(tokens) } else { listed(tokens) };
        match read {
            Ok(what) => Ok(Self { assignment, what }),
            Err(Wrong::Of(found)) => Err(assignment.wrong(&found).into()),
            Err(Wrong::Form(message, range)) => Err(assignment.wrong_form(message, range).into()),
        }
    }

    /// The values in SI units, where those of a quantity of this unit are wanted.
    pub(super) fn values(&self, unit: Option<Exponents>) -> Result<Values, Failure> {
        let of = |formula: &Formula| {
            value(formula, unit, &self.assignment.name).map_err(|found| self.assignment.wrong(&found))
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
        Err(self.assignment.wrong_value(title, help).into())
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

#[cfg(test)]
mod tests {
    use super::{Distribution, GRID, Given, VARY, Values};
    use crate::failure::Failure;

    fn values(option: &str, text: &str, unit: Option<[i32; 3]>) -> Result<Values, String> {
        let title = |failure| match failure {
            Failure::Wrong(problems) => problems.into_iter().map(|problem| problem.title).collect::<String>(),
            Failure::CommandLine(problem) => problem.title,
            Failure::PipeClosed => String::new(),
        };
        let kind = if option == "vary" { &VARY } else { &GRID };
        Given::read(kind, text).and_then(|given| given.values(unit)).map_err(title)
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
