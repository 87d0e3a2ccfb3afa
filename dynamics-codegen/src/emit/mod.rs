//! From programs to text.

mod body;
mod branches;
pub mod c;
mod names;
pub mod rust;
mod text;
