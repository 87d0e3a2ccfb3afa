//! Where something was written: tokens of the derive's input, or a line of a file.

use std::rc::Rc;

use proc_macro2::{Delimiter, Group, Literal, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote_spanned};

/// A place in the user's input.
#[derive(Clone, Debug)]
pub enum Place {
    /// From the first token to the last; spans cannot be joined on stable Rust.
    Tokens {
        /// The first token.
        start: Span,
        /// The last token.
        end: Span,
    },
    /// In a text the compiler was handed, as a URDF.
    Text {
        /// The file's name.
        file: Rc<str>,
        /// Line, from 1.
        line: u32,
        /// Column in characters, from 1.
        column: u32,
    },
}

impl Place {
    /// The place of all tokens of a piece of syntax.
    pub fn of(syntax: &impl ToTokens) -> Self {
        let mut spans = syntax.to_token_stream().into_iter().map(|token| token.span());
        let start = spans.next().unwrap_or_else(Span::call_site);
        let end = spans.last().unwrap_or(start);
        Self::Tokens { start, end }
    }

    /// From the start of this place to the end of another.
    pub fn to(&self, last: &Self) -> Self {
        match (self, last) {
            (Self::Tokens { start, .. }, Self::Tokens { end, .. }) => {
                Self::Tokens { start: *start, end: *end }
            }
            _ => self.clone(),
        }
    }

    /// A `compile_error!` that rustc shows at this place; for a text, where its `file` is named.
    pub(super) fn compile_error(&self, message: &str, file: &Self) -> TokenStream {
        let (start, end) = match (self, file) {
            (Self::Tokens { start, end }, _) | (Self::Text { .. }, Self::Tokens { start, end }) => {
                (*start, *end)
            }
            (Self::Text { .. }, Self::Text { .. }) => (Span::call_site(), Span::call_site()),
        };
        let mut text = Literal::string(message);
        text.set_span(end);
        let mut group = Group::new(Delimiter::Brace, TokenTree::Literal(text).into());
        group.set_span(end);
        quote_spanned!(start=> ::core::compile_error! #group)
    }
}

impl From<Span> for Place {
    fn from(span: Span) -> Self {
        Self::Tokens { start: span, end: span }
    }
}
