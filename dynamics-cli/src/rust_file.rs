//! The robots of a file of Rust: what has `#[derive(Dynamics)]`, wherever it stands in the file.

use std::ops::Range;
use std::path::{Path, PathBuf};

use dynamics_codegen::diagnostics::{Code, did_you_mean};
use dynamics_codegen::spec::nested_deeper_than;
use proc_macro2::{Delimiter, LineColumn, Span, TokenStream, TokenTree};
use syn::DeriveInput;
use syn::parse::{ParseStream, Parser};

use crate::failure::{Failure, Problem, Spot};
use crate::input::shown;

/// The deepest nesting that is read.
const NESTING_LIMIT: usize = 64;
/// So many names of robots are listed.
const NAMES_SHOWN: usize = 20;

/// The robot of a file: the only one, or that of this name.
pub(crate) fn robot(file: &str, text: &str, wanted: Option<&str>) -> Result<DeriveInput, Failure> {
    let mut found = robots(file, text)?;
    let names: Vec<String> = found.iter().map(|robot| robot.ident.to_string()).collect();
    let list = || {
        let shown: Vec<_> = names.iter().take(NAMES_SHOWN).map(|name| format!("`{name}`")).collect();
        let more = if names.len() > NAMES_SHOWN { " and more" } else { "" };
        shown.join(", ") + more
    };
    let at = match wanted {
        _ if found.is_empty() => {
            let problem = Problem::new(format!("{file} has no robot"));
            return Err(problem.help("put `#[derive(Dynamics)]` on a struct").into());
        }
        None if found.len() == 1 => 0,
        None => {
            let problem = Problem::new(format!("{file} has {} robots: {}", found.len(), list()));
            let is_alone = |name: &&String| names.iter().filter(|other| other == name).count() == 1;
            let help = match names.iter().find(is_alone) {
                Some(name) => format!("choose one, as by `--robot {name}`"),
                None => "give each a name of its own, and choose by `--robot`".to_owned(),
            };
            return Err(problem.help(help).into());
        }
        Some(wanted) => {
            let mut of_name = (0..names.len()).filter(|&k| names[k] == wanted);
            let Some(at) = of_name.next() else {
                let problem = Problem::new(format!("{file} has no robot `{}`", shown(wanted)));
                let help = match did_you_mean(wanted, names.iter().map(String::as_str)) {
                    Some(meant) => format!("did you mean `{meant}`?"),
                    None => format!("it has {}", list()),
                };
                return Err(problem.help(help).into());
            };
            if let Some(again) = of_name.next() {
                let line = |k: usize| found[k].ident.span().start().line;
                let title = format!(
                    "{file} has two robots `{wanted}`, in the lines {} and {}",
                    line(at),
                    line(again)
                );
                let help = "give one of them another name, or a file that has one alone";
                return Err(Problem::new(title).help(help).into());
            }
            at
        }
    };
    Ok(found.swap_remove(at))
}

/// All robots of a file, in order.
fn robots(file: &str, text: &str) -> Result<Vec<DeriveInput>, Failure> {
    let tokens: TokenStream =
        text.parse().map_err(|error: proc_macro2::LexError| no_tokens(file, text, error.span().start()))?;
    if nested_deeper_than(&tokens, NESTING_LIMIT) {
        let problem = Problem::new(format!("groups are nested more than {NESTING_LIMIT} deep in {file}"));
        let code = Some(Code::NestingTooDeep.to_string());
        return Err(Problem { code, ..problem.help(Code::NestingTooDeep.help()) }.into());
    }
    let mut robots = vec![];
    let mut wrong = vec![];
    // Each level of nesting, and how far it has been looked through.
    let mut open: Vec<(Vec<TokenTree>, usize)> = vec![(tokens.into_iter().collect(), 0)];
    while let Some((level, next)) = open.last_mut() {
        let at = *next;
        let Some(token) = level.get(at) else {
            open.pop();
            continue;
        };
        *next += 1;
        match token {
            TokenTree::Punct(punct) if punct.as_char() == '#' => {
                let attributes = attributes(&level[at..]);
                if attributes.clone().any(derives_dynamics) {
                    match item(&level[at..]) {
                        Ok(robot) => robots.push(robot),
                        Err(error) => wrong.push(not_read(file, text, &error)),
                    }
                }
                *next = at + (2 * attributes.count()).max(1);
            }
            // What a macro is made of is not yet an item.
            TokenTree::Ident(ident) if ident == "macro_rules" => *next = at + 4,
            TokenTree::Group(group) => {
                let inner = group.stream().into_iter().collect();
                open.push((inner, 0));
            }
            _ => {}
        }
    }
    if wrong.is_empty() { Ok(robots) } else { Err(Failure::Wrong(wrong)) }
}

/// What is wrong where a file stops being tokens: at a bracket without a partner, or at what begins no token.
fn no_tokens(file: &str, text: &str, LineColumn { line, column }: LineColumn) -> Problem {
    let found = text.split('\n').nth(line.saturating_sub(1)).unwrap_or_default();
    let at = found.chars().nth(column);
    let fact = match at {
        Some(open @ ('(' | '[' | '{')) => format!("the bracket `{open}` is never closed"),
        Some(close @ (')' | ']' | '}')) => {
            format!("the bracket `{close}` is no partner of the last one that is open")
        }
        Some('"' | '\'' | 'r' | 'b' | 'c') => {
            "what begins here with a quote has no end, or is no token".to_owned()
        }
        Some('0'..='9') => "what begins here is no number".to_owned(),
        Some(other) => format!("no token begins with `{}`", shown(&other.to_string())),
        None => "it ends within a token".to_owned(),
    };
    let mut spot = Spot::in_text(file, text, line, column + 1);
    if let Some((line, span)) = &mut spot.source {
        let length = line[span.start..].chars().next().map_or(0, char::len_utf8);
        *span = span.start..span.start + length;
    }
    let problem = Problem::new(format!("{file} is no Rust: {fact}"));
    Problem { spot: Some(spot.into()), ..problem.help("correct the file, so that rustc reads it") }
}

/// The contents of the attributes that tokens begin with.
fn attributes(tokens: &[TokenTree]) -> impl Iterator<Item = TokenStream> + Clone + '_ {
    tokens.chunks(2).map_while(|pair| match pair {
        [TokenTree::Punct(punct), TokenTree::Group(group)]
            if punct.as_char() == '#' && group.delimiter() == Delimiter::Bracket =>
        {
            Some(group.stream())
        }
        _ => None,
    })
}

/// `derive(…, Dynamics, …)`, with or without a path.
fn derives_dynamics(attribute: TokenStream) -> bool {
    let mut tokens = attribute.into_iter();
    let (Some(TokenTree::Ident(name)), Some(TokenTree::Group(list))) = (tokens.next(), tokens.next()) else {
        return false;
    };
    let names = |token: TokenTree| matches!(token, TokenTree::Ident(ident) if ident == "Dynamics");
    name == "derive" && list.stream().into_iter().any(names)
}

/// The item that tokens begin with.
fn item(tokens: &[TokenTree]) -> syn::Result<DeriveInput> {
    let first = |input: ParseStream<'_>| {
        let item: DeriveInput = input.parse()?;
        input.parse::<TokenStream>()?;
        Ok(item)
    };
    first.parse2(tokens.iter().cloned().collect())
}

fn not_read(file: &str, text: &str, error: &syn::Error) -> Problem {
    let problem = Problem::new(error.to_string()).help(Code::Syntax.help());
    let spot = spot_of(file, text, error.span(), error.span()).map(Box::new);
    Problem { spot, code: Some(Code::Syntax.to_string()), ..problem }
}

/// Where tokens of a file stand; nowhere if they are not of it.
pub(crate) fn spot_of(file: &str, text: &str, start: Span, end: Span) -> Option<Spot> {
    if start.byte_range().is_empty() {
        return None;
    }
    let (LineColumn { line, column }, end) = (start.start(), end.end());
    let source = crate::render::line_of(text, line).map(|found| {
        let byte = |k: usize| found.char_indices().nth(k).map_or(found.len(), |(byte, _)| byte);
        // What goes on over several lines is shown by its first.
        let end = if end.line == line { byte(end.column) } else { found.trim_end().len() };
        (found.to_owned(), byte(column)..end.max(byte(column)))
    });
    Some(Spot { file: file.to_owned(), line, column: column + 1, source })
}

/// The folder of the crate that a file is of: the nearest one upwards with a `Cargo.toml`.
pub(crate) fn crate_of(file: &Path) -> Result<PathBuf, String> {
    let here =
        || std::env::current_dir().map_err(|error| format!("the current folder is not known: {error}"));
    let folder = file.parent().unwrap_or(Path::new(""));
    let has_manifest = |folder: &&Path| folder.join("Cargo.toml").is_file();
    // As it was given, as long as that goes: so the paths of messages are those of the command line.
    if let Some(found) = folder.ancestors().find(has_manifest) {
        return Ok(found.to_owned());
    }
    let folder = here()?.join(folder);
    let folder = folder.canonicalize().unwrap_or(folder);
    let found = folder.ancestors().find(has_manifest).map(Path::to_owned);
    found.ok_or_else(|| "there is no `Cargo.toml` above the file, from where its path would begin".to_owned())
}

/// The text of tokens.
pub(crate) fn text_of<'t>(text: &'t str, tokens: &impl syn::spanned::Spanned) -> &'t str {
    let Range { start, end } = tokens.span().byte_range();
    text.get(start..end).unwrap_or_default()
}
