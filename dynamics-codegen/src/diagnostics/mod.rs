//! Mistakes of the user: collected by phase, and reported where they were written.

mod code;
mod place;
mod suggest;

pub use code::Code;
pub use place::Place;
pub use suggest::did_you_mean;

use proc_macro2::{Span, TokenStream};

/// One mistake.
#[derive(Clone, Debug)]
#[must_use = "a mistake that is not collected is never reported"]
pub struct Diagnostic {
    /// Which of the catalogue.
    pub code: Code,
    /// The fact, with names, values and units: lower case, no full stop.
    pub message: String,
    /// What to do, where it can be said better than the catalogue does.
    pub help: Option<String>,
    /// Where it was written.
    pub place: Place,
}

impl Diagnostic {
    /// A mistake, with the help of the catalogue.
    pub fn new(code: Code, place: &Place, message: impl Into<String>) -> Self {
        Self { code, message: message.into(), help: None, place: place.clone() }
    }

    /// The same mistake, with more fitting help than the catalogue's.
    pub fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// The same mistake, with "did you mean" as its help if one of the `known` names is close to `name`.
    pub fn suggest<'a>(self, name: &str, known: impl IntoIterator<Item = &'a str>) -> Self {
        match did_you_mean(name, known) {
            Some(known) => self.help(format!("did you mean `{known}`?")),
            None => self,
        }
    }

    /// What to do now.
    pub fn help_text(&self) -> &str {
        self.help.as_deref().unwrap_or_else(|| self.code.help())
    }

    /// The whole text as users see it.
    pub fn text(&self) -> String {
        let place = match &self.place {
            Place::Tokens { .. } => String::new(),
            Place::Text { file, line, column } => format!("{file}:{line}:{column}: "),
        };
        let Self { code, message, .. } = self;
        format!("{place}{message}\n\n  = help: {}\n  = note: {code}", self.help_text())
    }
}

/// The mistakes found so far. They must be reported: dropping them is a bug of the compiler.
#[derive(Debug, Default)]
#[must_use = "collected mistakes must be reported"]
pub struct Diagnostics {
    found: Vec<Diagnostic>,
}

impl Diagnostics {
    /// No mistakes yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a mistake.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.found.push(diagnostic);
    }

    /// Adds a mistake with the help of the catalogue.
    pub fn error(&mut self, code: Code, place: &Place, message: impl Into<String>) {
        self.push(Diagnostic::new(code, place, message));
    }

    /// The value, or `None` and the mistake added.
    pub fn keep<T>(&mut self, result: Result<T, Diagnostic>) -> Option<T> {
        result.map_err(|diagnostic| self.push(diagnostic)).ok()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.found.len()
    }

    /// Whether nothing is wrong.
    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// The mistakes, in the order in which they were found.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.found.iter()
    }

    /// Ends a phase: the next one runs only if nothing was wrong.
    ///
    /// # Errors
    ///
    /// All mistakes so far; they are moved out of `self`.
    pub fn check(&mut self) -> Result<(), Diagnostics> {
        if self.is_empty() { Ok(()) } else { Err(std::mem::take(self)) }
    }

    /// One `compile_error!` for each mistake, at the user's tokens; of those in a text, at the derive.
    pub fn into_compile_errors(self) -> TokenStream {
        self.into_compile_errors_of(&Span::call_site().into())
    }

    /// The same, but of mistakes in a text at what names its file.
    pub fn into_compile_errors_of(mut self, file: &Place) -> TokenStream {
        self.take().iter().map(|found| found.place.compile_error(&found.text(), file)).collect()
    }

    /// The mistakes as text, for a terminal or a test.
    pub fn into_text(mut self) -> String {
        let texts: Vec<_> = self.take().iter().map(Diagnostic::text).collect();
        texts.join("\n\n")
    }

    /// The mistakes, as reported: who takes them tells the user.
    pub fn take(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.found)
    }
}

impl Drop for Diagnostics {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            assert!(self.found.is_empty(), "diagnostics were collected but never reported");
        }
    }
}
