//! The programs are beside this folder, one per file: `cargo run --example pendulum`.
//!
//! This library has what several of them do, and compiles and runs the Rust in the workspace's Markdown, as
//! documentation tests.

use std::error::Error;
use std::path::Path;

use dynamics_view::{Figure, Film};

/// Draws what the command line asks for: `--plot FILE.svg`, `--animate FILE.html`.
///
/// # Errors
///
/// Another option, one without its file, a file that cannot be written, and what cannot be drawn.
pub fn draw(figure: impl Fn() -> Figure, film: impl Fn() -> Film) -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args_os().skip(1);
    while let Some(word) = words.next() {
        let option = word.to_string_lossy();
        let file = words.next().ok_or_else(|| format!("{option} needs a file"))?;
        let picture = match &*option {
            "--plot" => figure().svg()?,
            "--animate" => film().html()?,
            _ => {
                return Err(
                    format!("{option} is not known: give --plot FILE.svg or --animate FILE.html").into()
                );
            }
        };
        let file = Path::new(&file);
        std::fs::write(file, picture).map_err(|why| format!("{}: {why}", file.display()))?;
        println!("Drawn in {}.", file.display());
    }
    Ok(())
}

#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
mod readme {}

#[cfg(doctest)]
#[doc = include_str!("../../DESIGN.md")]
mod design {}

#[cfg(doctest)]
#[doc = include_str!("../../ARCHITECTURE.md")]
mod architecture {}

#[cfg(doctest)]
#[doc = include_str!("../../CHANGELOG.md")]
mod changelog {}

#[cfg(doctest)]
#[doc = include_str!("../../COMPARE.md")]
mod compare {}

#[cfg(doctest)]
#[doc = include_str!("../../ACCURACY.md")]
mod accuracy {}

#[cfg(doctest)]
#[doc = include_str!("../firmware/README.md")]
mod firmware {}
