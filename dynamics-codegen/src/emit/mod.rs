//! From programs to text.

pub mod rust;
