//! Closed forms: expressions as people write them, in Unicode, LaTeX and MathML, and read back.
//!
//! Nothing in here knows of robots. A [`Notation`] says what each input is called and what it is; a [`Form`] is what
//! stands on paper.

mod canonical;
mod close;
mod collect;
mod evaluate;
mod expand;
mod factor;
mod form;
mod item;
mod latex;
mod mathml;
mod matrix;
mod monomial;
mod motion;
mod name;
mod notation;
mod numeral;
mod parse;
mod polynomial;
mod quotient;
mod ring;
mod share;
#[cfg(test)]
mod tests;
mod trig;
mod unicode;

pub use canonical::Canonical;
pub use close::{Closed, Limits, close};
pub use evaluate::{evaluate, expression};
pub use form::Form;
pub use mathml::math;
pub use matrix::Matrix;
pub use name::{Name, ascii};
pub use notation::{Letter, Notation, Role};
pub use parse::Unreadable;
pub use polynomial::Polynomial;
pub use ring::Swelling;
