//! What is written: to standard output, or to a file.

use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::Path;

use crate::failure::{Failure, Problem};
use crate::input::name_of;

/// Writes a text to standard output.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()).map_err(|error| failed(None, &error))
}

/// A file, or standard output without one. A file that is read is not written.
pub(crate) fn writer(path: Option<&Path>, input: &Path) -> Result<Box<dyn Write>, Failure> {
    let Some(path) = path.filter(|path| *path != Path::new("-")) else {
        return Ok(Box::new(BufWriter::new(io::stdout().lock())));
    };
    refuse_input(path, input)?;
    let file = File::create(path).map_err(|error| failed(Some(path), &error))?;
    Ok(Box::new(BufWriter::new(file)))
}

/// Fails if [`writer`] would fail now: who waits long for what is written is told before. Nothing is written over.
pub(crate) fn check_writable(path: Option<&Path>, input: &Path) -> Result<(), Failure> {
    let Some(path) = path.filter(|path| *path != Path::new("-")) else { return Ok(()) };
    refuse_input(path, input)?;
    let found = path.metadata();
    // What is opened in vain of a pipe is at its end for the reader.
    if found.as_ref().is_ok_and(|found| !found.is_file() && !found.is_dir()) {
        return Ok(());
    }
    let opened = OpenOptions::new().append(true).create(true).open(path);
    opened.map_err(|error| failed(Some(path), &error))?;
    if found.is_err() {
        // It was not there, and may never be.
        let _ = std::fs::remove_file(path);
    }
    Ok(())
}

/// Fails if the file that would be written is the one that is read.
pub(crate) fn refuse_input(path: &Path, input: &Path) -> Result<(), Failure> {
    let both = path.canonicalize().ok().zip(input.canonicalize().ok());
    if both.is_none_or(|(output, input)| output != input) {
        return Ok(());
    }
    let problem = Problem::new(format!("{} would be written over: it is the input", name_of(path)));
    Err(problem.help("give another file to be written").into())
}

/// What it means that something could not be written.
pub(crate) fn failed(path: Option<&Path>, error: &io::Error) -> Failure {
    let is_stdout = path.is_none_or(|path| path == Path::new("-"));
    if is_stdout && error.kind() == ErrorKind::BrokenPipe {
        return Failure::PipeClosed;
    }
    let name = path.filter(|_| !is_stdout).map_or("standard output".to_owned(), name_of);
    let help = match error.kind() {
        _ if is_stdout => "write to a file by `-o`, where the command has it",
        ErrorKind::NotFound => "make the folder first, or give the path of a file in one that is there",
        ErrorKind::IsADirectory => "give the path of a file in this folder",
        ErrorKind::AlreadyExists => "give the path of a folder: there is a file of this name",
        ErrorKind::NotADirectory => "give the path of a file in a folder",
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "give the path of a file that you may write, or change who may"
        }
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "make room, or give a path on another disk",
        _ => "give the path of another file",
    };
    Problem::new(format!("{name} cannot be written: {error}")).help(help).into()
}

/// Columns of equal width, two spaces apart, each to the left (`l`) or to the right (`r`).
pub(crate) fn table(columns: &str, rows: &[Vec<String>]) -> String {
    let width = |k: usize| rows.iter().filter_map(|row| row.get(k)).map(|cell| cell.chars().count()).max();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (k, (cell, side)) in row.iter().zip(columns.chars()).enumerate() {
            let width = width(k).unwrap_or_default();
            line += &if side == 'l' { format!("  {cell:<width$}") } else { format!("  {cell:>width$}") };
        }
        text += line.trim_end();
        text += "\n";
    }
    text
}
