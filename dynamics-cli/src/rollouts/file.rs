//! A file that is whole or is not there: it is written under another name, and gets its own at the end.

use std::ffi::OsString;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use crate::failure::Failure;
use crate::output::{failed, refuse_input};

/// A file that is being written, as `out.csv.part`. Who interrupts it leaves that behind, and an older `out.csv` as it was.
pub(super) struct Draft {
    /// As it was named.
    path: PathBuf,
    /// What is written, and what it is to be called; nothing where the path is that of a device or a pipe.
    names: Option<(PathBuf, PathBuf)>,
}

impl Draft {
    /// Begins to write a file. One that is read is not written.
    pub(super) fn begin(path: &Path, input: &Path) -> Result<(File, Self), Failure> {
        refuse_input(path, input)?;
        let lost = |error| failed(Some(path), &error);
        if fs::metadata(path).is_ok_and(|found| !found.is_file()) {
            let file = File::create(path).map_err(lost)?;
            return Ok((file, Self { path: path.to_owned(), names: None }));
        }
        // A link stays one.
        let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let mut name = whole.file_name().map_or_else(OsString::new, OsString::from);
        name.push(".part");
        let part = whole.with_file_name(name);
        refuse_input(&part, input)?;
        let file = File::create(&part).map_err(lost)?;
        Ok((file, Self { path: path.to_owned(), names: Some((part, whole)) }))
    }

    /// Gives the file its name.
    pub(super) fn finish(mut self) -> Result<(), Failure> {
        let Some((part, whole)) = self.names.take() else { return Ok(()) };
        fs::rename(&part, whole).map_err(|error| {
            let _ = fs::remove_file(&part);
            failed(Some(&self.path), &error)
        })
    }
}

/// What is not finished is taken away.
impl Drop for Draft {
    fn drop(&mut self) {
        if let Some((part, _)) = &self.names {
            let _ = fs::remove_file(part);
        }
    }
}
