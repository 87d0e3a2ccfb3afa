//! From programs to text.

mod body;
pub mod c;
mod names;
pub mod rust;
