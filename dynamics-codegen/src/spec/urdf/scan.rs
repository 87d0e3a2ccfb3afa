//! What bounds a file before the parser sees it: size, elements, depth, attributes, and no DTD.

use super::source::Source;
use crate::diagnostics::{Code, Diagnostic};

/// The largest file, in bytes.
pub const SIZE_LIMIT: usize = 16 << 20;
/// The most nodes: elements, texts and comments.
pub(super) const NODE_LIMIT: u32 = 1_000_000;
/// The deepest element.
const DEPTH_LIMIT: usize = 64;
/// The most attributes of an element; the parser compares each with each.
const ATTRIBUTE_LIMIT: usize = 256;
/// The most declarations of namespaces; the parser copies those in scope.
const NAMESPACE_LIMIT: usize = 1000;

/// Checks that the parser will have an easy life. What is no XML is left for it to complain about.
pub(super) fn check(source: &Source<'_>) -> Result<(), Diagnostic> {
    let text = source.text();
    if text.len() > SIZE_LIMIT {
        let message = format!("the file has {} bytes, {SIZE_LIMIT} are allowed", text.len());
        return Err(Diagnostic::new(Code::FileTooLarge, &source.place(0), message));
    }
    if text.matches("xmlns").count() > NAMESPACE_LIMIT {
        let message = format!("the file declares more than {NAMESPACE_LIMIT} namespaces");
        return Err(Diagnostic::new(Code::FileTooLarge, &source.place(0), message));
    }
    let (mut at, mut depth, mut elements) = (0, 0_usize, 0);
    while let Some(start) = text[at..].find('<').map(|next| at + next) {
        let rest = &text[start..];
        let Some(token) = Token::of(rest) else { return Ok(()) };
        match token.kind {
            Kind::Open if token.attributes > ATTRIBUTE_LIMIT => {
                let message =
                    format!("the element has {} attributes, {ATTRIBUTE_LIMIT} are allowed", token.attributes);
                return Err(Diagnostic::new(Code::FileTooLarge, &source.place(start), message));
            }
            Kind::Open => {
                elements += 1;
                depth += 1;
            }
            Kind::Close => depth = depth.saturating_sub(1),
            Kind::Other => {}
            Kind::Declaration => {
                let message = "the file has a document type declaration, which can define entities";
                return Err(Diagnostic::new(Code::XmlInvalid, &source.place(start), message)
                    .help("take the `<!DOCTYPE …>` out, and write its entities out where they are used"));
            }
        }
        if depth > DEPTH_LIMIT {
            let message = format!("elements are nested more than {DEPTH_LIMIT} deep");
            return Err(Diagnostic::new(Code::FileTooLarge, &source.place(start), message));
        }
        if elements > NODE_LIMIT {
            return Err(too_many_nodes(source));
        }
        depth -= usize::from(token.is_empty);
        at = start + token.length;
    }
    Ok(())
}

/// The mistake that a file has more than [`NODE_LIMIT`] nodes.
pub(super) fn too_many_nodes(source: &Source<'_>) -> Diagnostic {
    let message = format!("the file has more than {NODE_LIMIT} elements, texts and comments");
    Diagnostic::new(Code::FileTooLarge, &source.place(0), message)
}

/// What begins with `<`.
struct Token {
    kind: Kind,
    /// In bytes, with its end.
    length: usize,
    attributes: usize,
    /// Whether it is `<…/>`.
    is_empty: bool,
}

enum Kind {
    Open,
    Close,
    /// `<!…>`
    Declaration,
    /// Comments, character data, processing instructions.
    Other,
}

impl Token {
    /// The token at the start of a text; `None` if it does not end.
    fn of(text: &str) -> Option<Self> {
        let until = |kind: Kind, end: &str| {
            let length = text.find(end)? + end.len();
            Some(Self { kind, length, attributes: 0, is_empty: false })
        };
        match text.as_bytes() {
            [_, b'!', b'-', b'-', ..] => until(Kind::Other, "-->"),
            [_, b'!', b'[', ..] => until(Kind::Other, "]]>"),
            [_, b'!', ..] => {
                Some(Self { kind: Kind::Declaration, length: 2, attributes: 0, is_empty: false })
            }
            [_, b'?', ..] => until(Kind::Other, "?>"),
            [_, b'/', ..] => until(Kind::Close, ">"),
            bytes => Self::opening(bytes),
        }
    }

    /// `<name key="value" …>`; a value may contain `>`.
    fn opening(bytes: &[u8]) -> Option<Self> {
        let (mut quote, mut attributes) = (None, 0);
        for (i, &byte) in bytes.iter().enumerate() {
            match (quote, byte) {
                (None, b'>') => {
                    let is_empty = bytes[i - 1] == b'/';
                    return Some(Self { kind: Kind::Open, length: i + 1, attributes, is_empty });
                }
                (None, b'"' | b'\'') => (quote, attributes) = (Some(byte), attributes + 1),
                (Some(open), _) if open == byte => quote = None,
                _ => {}
            }
        }
        None
    }
}
