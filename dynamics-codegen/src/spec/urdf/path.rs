//! Where a URDF is: a path from the crate's root that stays within the crate.

use super::source::quoted;
use crate::diagnostics::{Code, Diagnostic, Place};

/// A path as written: `urdf = "…"`.
#[derive(Clone, Debug)]
pub struct FilePath {
    /// The path, from the crate's root.
    pub text: String,
    /// Where it was written.
    pub place: Place,
}

/// Checks that a path leads to somewhere in the crate, on every system.
///
/// # Errors
///
/// If it is absolute, climbs by `..`, is a URL as `package://…`, or is empty.
pub fn check_path(path: &FilePath) -> Result<(), Diagnostic> {
    let FilePath { text, place } = path;
    let mut parts = text.split(['/', '\\']);
    let why = if text.trim().is_empty() {
        "is empty"
    } else if text.contains("://") {
        "is a URL"
    } else if text.starts_with(['/', '\\', '~']) || text.as_bytes().get(1) == Some(&b':') {
        "is absolute"
    } else if parts.any(|part| part == "..") {
        "leads out of the crate"
    } else if text.contains('\\') || text.chars().any(char::is_control) {
        "has characters that not every system takes in a path"
    } else {
        return Ok(());
    };
    let text = if text.trim().is_empty() { String::new() } else { quoted(text) + " " };
    Err(Diagnostic::new(Code::PathOutside, place, format!("the path {text}{why}")))
}
