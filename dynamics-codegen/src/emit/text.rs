//! Expressions as text, with parentheses where they are needed.

/// An expression on its way into a line.
#[derive(Clone, Debug)]
pub(super) struct Text {
    pub(super) text: String,
    pub(super) binding: Binding,
    /// How many expressions stand in one another.
    pub(super) depth: usize,
    /// The statements whose names occur in it.
    pub(super) reads: Vec<usize>,
}

/// How tightly the outermost operator binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    /// A sum that stays together: it is one operation.
    MultiplyAdd,
    Sum,
    Product,
    Negation,
    Atom,
}

/// How sums are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sums {
    /// `a + (b + c)` without parentheses, and so another sum to the last bit.
    Regrouped,
    /// In parentheses wherever the order of operations does not go by sums alone: `(a * b) + c`, `a + (b + c)`.
    Explicit,
}

/// What stands by itself.
pub(super) fn atom(text: String, reads: Vec<usize>) -> Text {
    Text { text, binding: Binding::Atom, depth: 0, reads }
}

/// What is made of parts.
pub(super) fn join(parts: &[&Text], text: String, binding: Binding) -> Text {
    let depth = parts.iter().map(|part| part.depth).max().unwrap_or(0) + 1;
    let reads = parts.iter().flat_map(|part| part.reads.iter().copied()).collect();
    Text { text, binding, depth, reads }
}

/// `a + b`, each with whether it is taken off; what is added binds at least as `added`, unless sums are explicit.
pub(super) fn sum(a: (bool, Text), b: (bool, Text), added: Binding, sums: Sums) -> Text {
    let ((is_negative, left), (minus, right)) = if a.0 && !b.0 { (b, a) } else { (a, b) };
    let left = if is_negative { negated(left) } else { left };
    let (left, least) = match sums {
        Sums::Regrouped => (left, if minus { Binding::Product } else { added }),
        Sums::Explicit if left.binding == Binding::Product => (wrap(left, Binding::Atom), Binding::Negation),
        Sums::Explicit => (left, Binding::Negation),
    };
    let right = wrap(right, least);
    let sign = if minus { '-' } else { '+' };
    join(&[&left, &right], format!("{} {sign} {}", left.text, right.text), Binding::Sum)
}

/// `a * b` or `a / b`.
pub(super) fn product(a: Text, operator: char, b: Text) -> Text {
    let (a, b) = (wrap(a, Binding::Product), wrap(b, Binding::Negation));
    join(&[&a, &b], format!("{} {operator} {}", a.text, b.text), Binding::Product)
}

/// `-a * b` is `-(a * b)`, and the negative of `-a * b` is `a * b`.
pub(super) fn negated(value: Text) -> Text {
    let value = wrap(value, Binding::Product);
    match value.text.strip_prefix('-') {
        Some(positive) => Text { text: positive.to_owned(), binding: Binding::Product, ..value },
        None => {
            let binding = value.binding.min(Binding::Negation);
            Text { text: format!("-{}", value.text), binding, ..value }
        }
    }
}

/// The text in parentheses, unless it binds at least as tightly as `least`.
pub(super) fn wrap(text: Text, least: Binding) -> Text {
    if text.binding >= least {
        text
    } else {
        Text { text: format!("({})", text.text), binding: Binding::Atom, ..text }
    }
}
