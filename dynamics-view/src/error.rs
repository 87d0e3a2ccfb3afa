//! What cannot be drawn.

use std::fmt;

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Error {
    /// There is nothing to draw.
    Empty {
        /// The chart, figure or animation.
        what: String,
    },
    /// Numbers that belong together are not as many.
    LengthsDiffer {
        /// What has the wrong length.
        what: String,
        /// How many there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A number is not finite, or larger than 10¹⁰⁰, which no axis can carry.
    NotDrawable {
        /// What it belongs to.
        what: String,
        /// Where it stands.
        index: usize,
        /// The number.
        value: f64,
    },
    /// Times do not increase.
    TimesNotIncreasing {
        /// The index of the first time that is not after the one before it.
        index: usize,
    },
    /// The bodies that carry a body do not lead to the world.
    BodyUnconnected {
        /// The body.
        body: String,
    },
    /// A link is on none that comes before it, or a body on one that there is not.
    LinkUnconnected {
        /// The index of the link.
        link: usize,
    },
    /// No body has this name.
    BodyUnknown {
        /// The name.
        name: String,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty { what } => write!(f, "{what} has nothing to draw"),
            Self::LengthsDiffer { what, expected, found } => {
                write!(f, "{what} has {found} numbers, and needs {expected}")
            }
            Self::NotDrawable { what, index, value } => {
                write!(f, "{what} is {value:e} at index {index}, which cannot be drawn")
            }
            Self::TimesNotIncreasing { index } => {
                write!(f, "the time at index {index} is not after the one before it")
            }
            Self::BodyUnconnected { body } => write!(f, "nothing joins the body `{body}` to the world"),
            Self::LinkUnconnected { link } => write!(f, "link {link} hangs on none that comes before it"),
            Self::BodyUnknown { name } => write!(f, "there is no body `{name}`"),
        }
    }
}

impl std::error::Error for Error {}

/// Numbers beyond this are drawn by nobody.
const LARGEST: f64 = 1e100;

/// Fails at the first number that cannot be drawn.
pub(crate) fn check_numbers(what: &str, values: impl IntoIterator<Item = f64>) -> Result<(), Error> {
    match values.into_iter().enumerate().find(|(_, value)| !value.is_finite() || value.abs() > LARGEST) {
        Some((index, value)) => Err(Error::NotDrawable { what: what.to_owned(), index, value }),
        None => Ok(()),
    }
}

/// Fails unless there are as many as there should be.
pub(crate) fn check_length(what: &str, expected: usize, found: usize) -> Result<(), Error> {
    if found == expected {
        Ok(())
    } else {
        Err(Error::LengthsDiffer { what: what.to_owned(), expected, found })
    }
}
