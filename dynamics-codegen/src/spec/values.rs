//! The parts that all attributes share: keys, scalars, vectors, lists of arguments.

use proc_macro2::Delimiter;

use super::cursor::{Cursor, Result};
use super::keys::Switch;
use super::{Formula, Name};
use crate::diagnostics::{Code, Diagnostic, Diagnostics, Place};

/// An item of an attribute: `key = value` or `key(value)`, its value not yet read.
pub(super) struct Entry {
    pub(super) key: Name,
    pub(super) value: Cursor,
    pub(super) place: Place,
}

impl Entry {
    /// Reads the key, which must be one of the `known` ones; `what` says what they are.
    pub(super) fn parse(mut item: Cursor, what: &str, known: &[&str]) -> Result<Self> {
        let place = item.place();
        let Some(key) = item.ident() else { return Err(item.expected(&format!("a {what}"))) };
        let key = Name::new(&key);
        if !known.contains(&key.text.as_str()) {
            let message = format!("there is no {what} `{key}`");
            let list = format!("use one of {}", known.join(", "));
            let unknown = Diagnostic::new(Code::KeyUnknown, &key.place, message).help(list);
            return Err(unknown.suggest(&key.text, known.iter().copied()));
        }
        Ok(Self { key, value: item, place })
    }

    /// `= value`
    pub(super) fn assigned(self) -> Result<Cursor> {
        let mut value = self.value;
        if value.punct('=') { Ok(value) } else { Err(value.expected(&format!("`=` after `{}`", self.key))) }
    }

    /// `= scalar`
    pub(super) fn scalar(self) -> Result<Formula> {
        Formula::parse(self.assigned()?)
    }

    /// `= [a, b, …]`, exactly as many as `parts` names.
    pub(super) fn vector<const N: usize>(self, parts: [&str; N]) -> Result<[Formula; N]> {
        let key = self.key.text.clone();
        let mut value = self.assigned()?;
        if !value.peek_group(Delimiter::Bracket) {
            let list = format!("[{}]", parts.join(", "));
            let wrong = value.expected(&format!("`{list}`"));
            return Err(match key.as_str() {
                "gravity" => wrong.help("give the acceleration of free fall: `gravity = [0, 0, -9.81]`"),
                _ => wrong.help(format!("write `{key} = {list}`")),
            });
        }
        vector(value, &key, parts)
    }

    /// `(a, b, …)`, exactly as many as `parts` names.
    pub(super) fn arguments<const N: usize>(mut self, parts: [&str; N]) -> Result<[Formula; N]> {
        let (arguments, place) = self.parenthesised()?;
        formulas(arguments.items(), &place, &self.key.text, parts)
    }

    /// `= name`
    pub(super) fn name(self, what: &str) -> Result<Name> {
        name(self.assigned()?, what)
    }

    /// `= on`, `= off`
    pub(super) fn switch(self) -> Result<Switch> {
        let key = self.key.text.clone();
        let word = self.name("`on` or `off`")?;
        let is_on = match word.text.as_str() {
            "on" => true,
            "off" => false,
            _ => {
                let message = format!("expected `on` or `off`, found `{word}`");
                let wrong = Diagnostic::new(Code::Syntax, &word.place, message);
                return Err(wrong.help(format!("write `{key} = on` or `{key} = off`")));
            }
        };
        Ok(Switch { is_on, place: word.place })
    }

    /// The contents of `(…)`.
    pub(super) fn parenthesised(&mut self) -> Result<(Cursor, Place)> {
        let Some(contents) = self.value.group(Delimiter::Parenthesis)? else {
            return Err(self.value.expected(&format!("`(…)` after `{}`", self.key)));
        };
        if !self.value.is_empty() {
            return Err(self.value.expected(&format!("`,` after `{}(…)`", self.key)));
        }
        Ok(contents)
    }

    /// The names in `(…)`.
    pub(super) fn names(mut self) -> Result<Vec<Name>> {
        let (contents, _) = self.parenthesised()?;
        contents.items().into_iter().map(|item| name(item, "a name")).collect()
    }
}

/// `[a, b, …]` and nothing more.
pub(super) fn vector<const N: usize>(mut value: Cursor, of: &str, parts: [&str; N]) -> Result<[Formula; N]> {
    let Some((contents, place)) = value.group(Delimiter::Bracket)? else {
        return Err(value.expected(&format!("`[{}]`", parts.join(", "))));
    };
    value.finish("`]`")?;
    formulas(contents.items(), &place, of, parts)
}

/// Reads as many formulas as `parts` names.
pub(super) fn formulas<const N: usize>(
    items: Vec<Cursor>,
    place: &Place,
    of: &str,
    parts: [&str; N],
) -> Result<[Formula; N]> {
    let count = items.len();
    let wrong = || count_wrong(count, place, of, &parts);
    if count != N {
        return Err(wrong());
    }
    let formulas = items.into_iter().map(Formula::parse).collect::<Result<Vec<_>>>()?;
    formulas.try_into().map_err(|_| wrong())
}

/// The mistake that something has another number of parts than those named.
pub(super) fn count_wrong(count: usize, place: &Place, of: &str, parts: &[&str]) -> Diagnostic {
    let message =
        format!("`{of}` has {} part{}, found {count}", parts.len(), if parts.len() == 1 { "" } else { "s" });
    Diagnostic::new(Code::CountWrong, place, message).help(format!("give exactly {}", parts.join(", ")))
}

/// A single name.
pub(super) fn name(mut item: Cursor, what: &str) -> Result<Name> {
    let Some(name) = item.name() else { return Err(item.expected(what)) };
    item.finish("the name")?;
    Ok(name)
}

/// Fills a slot; a second time is a mistake.
pub(super) fn fill<T>(slot: &mut Option<T>, key: &Name, value: Result<T>, diags: &mut Diagnostics) {
    if slot.is_some() {
        diags.error(Code::KeyDuplicate, &key.place, format!("`{key}` is given twice"));
    }
    if let Some(value) = diags.keep(value) {
        slot.get_or_insert(value);
    }
}
