//! What was printed, read back: Unicode and LaTeX.
//!
//! One grammar for both: `sum = ['−'] term {('+' | '−') term}`, `term = factor {['/'] factor}`, a factor being a base
//! with a power. Only the words differ.

use super::unicode::{FRACTIONS, RAISED};
use super::{Form, Notation};
use crate::symbolic::{Number, SymbolId};

/// Groups nest at most this deep.
const DEPTH: usize = 64;

/// Why a text is no form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unreadable {
    /// Where, in bytes.
    pub at: usize,
    /// What is missing there.
    pub expected: &'static str,
}

impl std::fmt::Display for Unreadable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "expected {} at byte {}", self.expected, self.at)
    }
}

impl std::error::Error for Unreadable {}

type Result<T> = std::result::Result<T, Unreadable>;

impl Form {
    /// Reads what [`Form::unicode`] wrote, to the same form.
    ///
    /// # Errors
    ///
    /// The first place that cannot be read.
    pub fn parse_unicode(text: &str, notation: &Notation) -> Result<Self> {
        Reader { text, at: 0, notation, latex: false, depth: 0 }.whole()
    }

    /// Reads what [`Form::latex`] wrote, to the same form.
    ///
    /// # Errors
    ///
    /// The first place that cannot be read.
    pub fn parse_latex(text: &str, notation: &Notation) -> Result<Self> {
        Reader { text, at: 0, notation, latex: true, depth: 0 }.whole()
    }
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
    notation: &'a Notation,
    latex: bool,
    depth: usize,
}

impl Reader<'_> {
    fn whole(mut self) -> Result<Form> {
        let form = self.sum()?;
        self.space();
        if self.at < self.text.len() { Err(self.expected("an operator or the end")) } else { Ok(form) }
    }

    fn expected(&self, expected: &'static str) -> Unreadable {
        Unreadable { at: self.at, expected }
    }

    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn space(&mut self) {
        loop {
            let rest = self.rest();
            let trimmed = rest.trim_start();
            let skipped = trimmed.strip_prefix("\\,").filter(|_| self.latex).unwrap_or(trimmed);
            if skipped.len() == rest.len() {
                return;
            }
            self.at += rest.len() - skipped.len();
        }
    }

    /// Takes a token if it is next.
    fn take(&mut self, token: &str) -> bool {
        self.space();
        let found = self.rest().starts_with(token);
        if found {
            self.at += token.len();
        }
        found
    }

    fn demand(&mut self, token: &'static str) -> Result<()> {
        if self.take(token) { Ok(()) } else { Err(self.expected(token)) }
    }

    fn open(&mut self) -> bool {
        if self.latex { self.take("\\left(") || self.take("(") } else { self.take("(") }
    }

    /// A sum up to a closing token.
    fn group(&mut self, close: &'static str) -> Result<Form> {
        self.depth += 1;
        if self.depth > DEPTH {
            return Err(self.expected("fewer groups in each other"));
        }
        let form = self.sum()?;
        self.depth -= 1;
        let closed = self.take(close) || close == ")" && self.latex && self.take("\\right)");
        if closed { Ok(form) } else { Err(self.expected(close)) }
    }

    fn minus(&mut self) -> bool {
        self.take("−") || self.take("-")
    }

    fn sum(&mut self) -> Result<Form> {
        let negative = self.minus();
        let mut terms = Vec::new();
        let first = self.term()?;
        terms.push(if negative { first.negative() } else { first });
        loop {
            if self.take("+") {
                terms.push(self.term()?);
            } else if self.minus() {
                terms.push(self.term()?.negative());
            } else {
                break;
            }
        }
        Ok(Form::sum(terms))
    }

    fn term(&mut self) -> Result<Form> {
        let mut product = self.factor()?.ok_or_else(|| self.expected("a number, a name or a function"))?;
        loop {
            if !self.latex && self.take("/") {
                let below = self.factor()?.ok_or_else(|| self.expected("what divides"))?;
                product = product.over(below);
            } else if let Some(factor) = self.factor()? {
                product = Form::product([product, factor]);
            } else {
                return Ok(product);
            }
        }
    }

    fn factor(&mut self) -> Result<Option<Form>> {
        self.space();
        let Some(base) = self.base()? else { return Ok(None) };
        let power = self.power()?;
        Ok(Some(power.map_or(base.clone(), |n| base.power(n))))
    }

    /// A power, if one is next.
    fn power(&mut self) -> Result<Option<u32>> {
        if self.latex {
            if !self.rest().starts_with("^{") {
                return Ok(None);
            }
            self.at += 2;
            let digits = self.digits().to_owned();
            self.demand("}")?;
            return digits.parse().map(Some).map_err(|_| self.expected("a power"));
        }
        let raised = |c: char| RAISED.iter().position(|raised| *raised == c);
        let mut power = None;
        while let Some((letter, digit)) = self.rest().chars().next().and_then(|c| Some((c, raised(c)?))) {
            let so_far: u32 = power.unwrap_or(0);
            let next = so_far.checked_mul(10).and_then(|tens| tens.checked_add(u32::try_from(digit).ok()?));
            power = Some(next.filter(|n| *n < 1000).ok_or_else(|| self.expected("a smaller power"))?);
            self.at += letter.len_utf8();
        }
        Ok(power)
    }

    fn digits(&mut self) -> &str {
        let rest = self.rest();
        let length = rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        self.at += length;
        &self.text[self.at - length..self.at]
    }

    fn base(&mut self) -> Result<Option<Form>> {
        if let Some((symbol, length)) = self.symbol() {
            self.at += length;
            return Ok(Some(Form::Symbol(symbol)));
        }
        if self.open() {
            let form = self.group(")")?;
            return Ok(Some(form));
        }
        if let Some(number) = self.number()? {
            return Ok(Some(Form::number(number)));
        }
        let (sin, cos) = if self.latex { ("\\sin", "\\cos") } else { ("sin", "cos") };
        if self.take(sin) {
            return self.function(Form::sin).map(Some);
        }
        if self.take(cos) {
            return self.function(Form::cos).map(Some);
        }
        if self.latex {
            if self.take("\\frac{") {
                let above = self.group("}")?;
                self.demand("{")?;
                let below = self.group("}")?;
                return Ok(Some(above.over(below)));
            }
            if self.take("\\sqrt{") {
                return Ok(Some(self.group("}")?.root()));
            }
        } else if self.take("√") {
            let inner = if self.open() { self.group(")")? } else { self.atom()? };
            return Ok(Some(inner.root()));
        }
        Ok(None)
    }

    fn symbol(&self) -> Option<(SymbolId, usize)> {
        self.notation.at_start_of(self.rest(), self.latex)
    }

    /// A name or a number.
    fn atom(&mut self) -> Result<Form> {
        self.space();
        if let Some((symbol, length)) = self.symbol() {
            self.at += length;
            return Ok(Form::Symbol(symbol));
        }
        self.number()?.map(Form::number).ok_or_else(|| self.expected("a name or a number"))
    }

    /// A power, then an argument: in parentheses, or a name with a whole number before it.
    fn function(&mut self, make: impl Fn(Form) -> Form) -> Result<Form> {
        let power = self.power()?;
        let argument = if self.open() {
            self.group(")")?
        } else {
            match self.atom()? {
                number @ Form::Number(_) => Form::product([number, self.atom()?]),
                symbol => symbol,
            }
        };
        Ok(make(argument).power(power.unwrap_or(1)))
    }

    /// Digits with a point, a power of ten; π; a fraction that is a letter.
    fn number(&mut self) -> Result<Option<Number>> {
        let rest = self.rest();
        if let Some((letter, num, den)) = FRACTIONS.iter().find(|(letter, ..)| rest.starts_with(*letter)) {
            self.at += letter.len_utf8();
            return Ok(Some(Number::ratio(*num, *den)));
        }
        if self.take(if self.latex { "\\pi" } else { "π" }) {
            return Ok(Some(Number::PI));
        }
        let start = self.at;
        if self.digits().is_empty() {
            return Ok(None);
        }
        if self.rest().starts_with('.') {
            self.at += 1;
            self.digits();
        }
        let mut decimal = self.text[start..self.at].to_owned();
        let (times, raised) = if self.latex { (" \\cdot 10", "^{") } else { ("·10", "") };
        let has_power = if self.rest().starts_with(times) {
            self.at += times.len();
            true
        } else {
            let is_power = if self.latex {
                self.rest().starts_with("^{")
            } else {
                self.rest().starts_with(['⁻', '⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'])
            };
            let is_ten = decimal == "10" && is_power;
            if is_ten {
                decimal = "1".to_owned();
            }
            is_ten
        };
        if has_power {
            let negative = if self.latex {
                self.demand(raised)?;
                self.minus()
            } else {
                self.take("⁻")
            };
            let power = if self.latex {
                let digits = self.digits().to_owned();
                self.demand("}")?;
                digits.parse().map_err(|_| self.expected("a power of ten"))?
            } else {
                self.power()?.ok_or_else(|| self.expected("a power of ten"))?
            };
            decimal = format!("{decimal}e{}{power}", if negative { "-" } else { "" });
        }
        Number::parse_decimal(&decimal).map(Some).ok_or_else(|| self.expected("a smaller number"))
    }
}
