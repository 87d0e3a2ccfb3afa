//! A cursor over tokens, that says what it expected and what it found.

use std::vec::IntoIter;

use proc_macro2::{Delimiter, Ident, Literal, Span, TokenStream, TokenTree};

use super::Name;
use crate::diagnostics::{Code, Diagnostic, Place};

/// What reading returns: a value, or the first mistake in it.
pub(super) type Result<T> = std::result::Result<T, Diagnostic>;

/// How deep groups and functions may be nested.
const DEPTH_LIMIT: usize = 32;

/// The tokens of one group, or of one item of a list, not yet read.
pub(super) struct Cursor {
    tokens: std::iter::Peekable<IntoIter<TokenTree>>,
    /// The first token; the place of the whole is from here to `last`.
    first: Span,
    last: Span,
    /// How many groups this one is in.
    depth: usize,
}

impl Cursor {
    /// The tokens of a stream; `around` is the place of the whole if there are none.
    pub(super) fn new(stream: TokenStream, around: Span) -> Self {
        Self::nested(stream.into_iter().collect(), around, 0)
    }

    fn nested(tokens: Vec<TokenTree>, around: Span, depth: usize) -> Self {
        let tokens: Vec<_> = tokens.into_iter().map(without_invisible_group).collect();
        let first = tokens.first().map_or(around, TokenTree::span);
        let last = tokens.last().map_or(around, TokenTree::span);
        Self { tokens: tokens.into_iter().peekable(), first, last, depth }
    }

    /// From the first token to the last.
    pub(super) fn place(&self) -> Place {
        Place::from(self.first).to(&Place::from(self.last))
    }

    /// The place of the next token; at the end, the last.
    pub(super) fn here(&mut self) -> Place {
        let last = self.last;
        Place::from(self.tokens.peek().map_or(last, TokenTree::span))
    }

    pub(super) fn is_empty(&mut self) -> bool {
        self.tokens.peek().is_none()
    }

    pub(super) fn next(&mut self) -> Option<TokenTree> {
        self.tokens.next()
    }

    /// Takes the punctuation if it is next.
    pub(super) fn punct(&mut self, sign: char) -> bool {
        self.tokens.next_if(|token| matches!(token, TokenTree::Punct(p) if p.as_char() == sign)).is_some()
    }

    /// The punctuation that is next.
    pub(super) fn peek_punct(&mut self) -> Option<char> {
        match self.tokens.peek() {
            Some(TokenTree::Punct(punct)) => Some(punct.as_char()),
            _ => None,
        }
    }

    pub(super) fn ident(&mut self) -> Option<Ident> {
        match self.tokens.next_if(|token| matches!(token, TokenTree::Ident(_)))? {
            TokenTree::Ident(ident) => Some(ident),
            _ => None,
        }
    }

    /// A name: an identifier, or, of what is called otherwise in a file, a text in quotes.
    pub(super) fn name(&mut self) -> Option<Name> {
        if let Some(ident) = self.ident() {
            return Some(Name::new(&ident));
        }
        self.quoted_name()
    }

    /// A name in quotes.
    pub(super) fn quoted_name(&mut self) -> Option<Name> {
        let TokenTree::Literal(literal) = self.tokens.peek()? else { return None };
        let text = syn::parse_str::<syn::LitStr>(&literal.to_string()).ok()?.value();
        let place = literal.span().into();
        let is_visible = text.chars().any(|c| !c.is_whitespace()) && !text.contains(char::is_control);
        is_visible.then(|| {
            self.tokens.next();
            Name { text, place }
        })
    }

    pub(super) fn literal(&mut self) -> Option<Literal> {
        match self.tokens.next_if(|token| matches!(token, TokenTree::Literal(_)))? {
            TokenTree::Literal(literal) => Some(literal),
            _ => None,
        }
    }

    /// Whether a group with the delimiter is next.
    pub(super) fn peek_group(&mut self, delimiter: Delimiter) -> bool {
        matches!(self.tokens.peek(), Some(TokenTree::Group(group)) if group.delimiter() == delimiter)
    }

    /// The identifier that is all there is.
    pub(super) fn is_a_name(&self) -> bool {
        let mut tokens = self.tokens.clone();
        matches!((tokens.next(), tokens.next()), (Some(TokenTree::Ident(_) | TokenTree::Literal(_)), None))
    }

    /// Whether there is a `->`, not within a group.
    pub(super) fn has_arrow(&self) -> bool {
        let signs = self.tokens.clone().map(|token| match token {
            TokenTree::Punct(punct) => punct.as_char(),
            _ => ' ',
        });
        signs.collect::<String>().contains("->")
    }

    /// The contents of the group if one with the delimiter is next, and its place.
    pub(super) fn group(&mut self, delimiter: Delimiter) -> Result<Option<(Self, Place)>> {
        if !self.peek_group(delimiter) {
            return Ok(None);
        }
        let Some(TokenTree::Group(group)) = self.tokens.next() else { return Ok(None) };
        let place = Place::from(group.span());
        if self.depth >= DEPTH_LIMIT {
            let message = format!("groups are nested more than {DEPTH_LIMIT} deep");
            return Err(Diagnostic::new(Code::NestingTooDeep, &place, message));
        }
        let tokens = group.stream().into_iter().collect();
        Ok(Some((Self::nested(tokens, group.span(), self.depth + 1), place)))
    }

    /// The items between the commas; a comma may follow the last.
    pub(super) fn items(self) -> Vec<Self> {
        let (around, depth) = (self.last, self.depth);
        let mut items = vec![];
        let mut item = vec![];
        for token in self.tokens {
            match token {
                TokenTree::Punct(ref comma) if comma.as_char() == ',' => {
                    items.push(Self::nested(std::mem::take(&mut item), comma.span(), depth));
                }
                token => item.push(token),
            }
        }
        if !item.is_empty() {
            items.push(Self::nested(item, around, depth));
        }
        items
    }

    /// The mistake that something else than `what` is next.
    pub(super) fn expected(&mut self, what: &str) -> Diagnostic {
        let found = match self.tokens.peek() {
            None => "nothing more".to_owned(),
            Some(TokenTree::Group(group)) => match group.delimiter() {
                Delimiter::Parenthesis => "`(…)`".to_owned(),
                Delimiter::Bracket => "`[…]`".to_owned(),
                _ => "`{…}`".to_owned(),
            },
            Some(token) => format!("`{token}`"),
        };
        let place = self.here();
        Diagnostic::new(Code::Syntax, &place, format!("expected {what}, found {found}"))
    }

    /// The mistake that something is left, if something is.
    pub(super) fn finish(mut self, after: &str) -> Result<()> {
        if self.is_empty() { Ok(()) } else { Err(self.expected(&format!("`,` after {after}"))) }
    }
}

/// A group without delimiters, as macros make, is as its only token.
fn without_invisible_group(mut token: TokenTree) -> TokenTree {
    for _ in 0..DEPTH_LIMIT {
        let TokenTree::Group(group) = &token else { break };
        let mut inner = group.stream().into_iter();
        match (group.delimiter(), inner.next(), inner.next()) {
            (Delimiter::None, Some(only), None) => token = only,
            _ => break,
        }
    }
    token
}

/// Whether the tokens are nested deeper than `limit`; this does not recurse, what reads them may.
pub fn nested_deeper_than(tokens: &TokenStream, limit: usize) -> bool {
    let mut open = vec![tokens.clone().into_iter()];
    while let Some(level) = open.last_mut() {
        match level.next() {
            None => drop(open.pop()),
            Some(TokenTree::Group(group)) => open.push(group.stream().into_iter()),
            Some(_) => {}
        }
        if open.len() > limit {
            return true;
        }
    }
    false
}
