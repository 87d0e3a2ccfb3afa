//! Rollouts as rows of a table, a row for each sample: CSV, or Parquet, which is by columns, and keeps how it was made.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use parquet::basic::{Repetition, Type as Physical};
use parquet::data_type::{DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, Type};

use super::engine::Rollout;
use super::file::Draft;
use crate::failure::{Failure, Problem};
use crate::input::name_of;
use crate::output::{failed, writer};
use crate::simulate::quoted;

/// What a table is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Csv,
    Parquet,
}

impl Format {
    /// That of the file's ending; standard output is CSV.
    pub(super) fn of(path: Option<&Path>) -> Result<Self, Failure> {
        let Some(path) = path.filter(|path| *path != Path::new("-")) else { return Ok(Self::Csv) };
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("csv") => Ok(Self::Csv),
            Some("parquet") => Ok(Self::Parquet),
            _ => {
                let problem =
                    Problem::new(format!("{} ends neither in `.csv` nor in `.parquet`", name_of(path)));
                Err(problem
                    .help("give the file one of these endings; without `-o`, CSV goes to standard output")
                    .into())
            }
        }
    }
}

/// Where rows go, in order.
pub(super) struct Table {
    path: Option<PathBuf>,
    /// How many columns are of a rollout, behind its number; those of a sample have the others.
    of_rollout: usize,
    /// All columns but the first.
    columns: usize,
    sink: Sink,
    draft: Option<Draft>,
}

enum Sink {
    Csv(Box<dyn Write>),
    Parquet(Box<Columns>),
}

/// Rows that are ready to be written.
pub(super) enum Rows {
    Text(String),
    Numbers(Vec<Rollout>),
}

impl Table {
    /// Begins a table: the number of the rollout, then a column for each of the names, the first of which are of the
    /// rollout as a whole. `story` is how it is made, by keys.
    pub(super) fn begin(
        format: Format,
        (path, input): (Option<&Path>, &Path),
        of_rollout: &[String],
        of_sample: &[String],
        story: &[(&str, String)],
    ) -> Result<Self, Failure> {
        let names: Vec<&str> = ["rollout", "time"]
            .into_iter()
            .chain(of_rollout.iter().map(String::as_str))
            .chain(of_sample.iter().skip(1).map(String::as_str))
            .collect();
        let (file, draft) = match path.filter(|path| *path != Path::new("-")) {
            Some(path) => {
                let (file, draft) = Draft::begin(path, input)?;
                (Some(file), Some(draft))
            }
            None => (None, None),
        };
        let lost = |error: &io::Error| failed(path, error);
        let sink = match (format, file) {
            (Format::Parquet, Some(file)) => {
                let columns = Columns::begin(file, &names, of_rollout, story);
                Sink::Parquet(Box::new(columns.map_err(|error| lost(&io::Error::other(error)))?))
            }
            (_, file) => {
                let mut out = match file {
                    Some(file) => Box::new(io::BufWriter::new(file)) as Box<dyn Write>,
                    None => writer(None, input)?,
                };
                let head = names.iter().map(|name| quoted(name)).collect::<Vec<_>>().join(",") + "\n";
                out.write_all(head.as_bytes()).map_err(|error| lost(&error))?;
                Sink::Csv(out)
            }
        };
        let (path, of_rollout) = (path.map(Path::to_owned), of_rollout.len());
        Ok(Self { path, of_rollout, columns: of_rollout + of_sample.len(), sink, draft })
    }

    /// Whether `rows` are to be text.
    pub(super) fn is_text(&self) -> bool {
        matches!(self.sink, Sink::Csv(_))
    }

    /// Writes rows behind those that were written.
    pub(super) fn write(&mut self, rows: Rows) -> Result<(), Failure> {
        let (width, path) = (self.columns - self.of_rollout, self.path.as_deref());
        match (&mut self.sink, rows) {
            (Sink::Csv(out), Rows::Text(text)) => {
                out.write_all(text.as_bytes()).map_err(|error| failed(path, &error))
            }
            (Sink::Csv(out), Rows::Numbers(rollouts)) => {
                out.write_all(text(&rollouts, width).as_bytes()).map_err(|error| failed(path, &error))
            }
            (Sink::Parquet(columns), Rows::Numbers(rollouts)) => {
                let added = rollouts.iter().try_for_each(|rollout| columns.add(rollout, width));
                added.map_err(|error| failed(path, &io::Error::other(error)))
            }
            (Sink::Parquet(_), Rows::Text(_)) => Ok(()), // `is_text` says that there is none
        }
    }

    /// Ends the table, which gets its name now.
    pub(super) fn finish(self) -> Result<(), Failure> {
        let path = self.path.as_deref();
        match self.sink {
            Sink::Csv(mut out) => out.flush().map_err(|error| failed(path, &error))?,
            Sink::Parquet(columns) => {
                columns.finish().map_err(|error| failed(path, &io::Error::other(error)))?;
            }
        }
        self.draft.map_or(Ok(()), Draft::finish)
    }
}

/// Rows as CSV, whose samples are `width` numbers each.
pub(super) fn text(rollouts: &[Rollout], width: usize) -> String {
    let mut text = String::new();
    for Rollout { index, parameters, samples, .. } in rollouts {
        for sample in samples.chunks(width) {
            let numbers = sample[..1].iter().chain(parameters).chain(&sample[1..]);
            let _ = write!(text, "{index}");
            numbers.for_each(|number| _ = write!(text, ",{number:?}"));
            text.push('\n');
        }
    }
    text
}

/// So many rows are one group of a Parquet file: what is in memory, and what a reader may skip.
const GROUP: usize = 1 << 17;

/// A Parquet file, column by column.
struct Columns {
    writer: SerializedFileWriter<File>,
    rollouts: Vec<i64>,
    numbers: Vec<Vec<f64>>,
}

impl Columns {
    fn begin(
        file: File,
        names: &[&str],
        of_rollout: &[String],
        story: &[(&str, String)],
    ) -> Result<Self, ParquetError> {
        let column = |(k, name): (usize, &&str)| {
            let physical = if k == 0 { Physical::INT64 } else { Physical::DOUBLE };
            let column = Type::primitive_type_builder(name, physical).with_repetition(Repetition::REQUIRED);
            column.build().map(Arc::new)
        };
        let fields = names.iter().enumerate().map(column).collect::<Result<Vec<_>, _>>()?;
        let schema = Arc::new(Type::group_type_builder("rollouts").with_fields(fields).build()?);
        let entry = |(key, value): &(&str, String)| KeyValue::new(format!("dynamics.{key}"), value.clone());
        let mut properties = WriterProperties::builder()
            .set_created_by(format!("dynamics {}", env!("CARGO_PKG_VERSION")))
            .set_key_value_metadata(Some(story.iter().map(entry).collect()))
            .set_dictionary_enabled(false);
        // What is the same in many rows is written once.
        for name in ["rollout", "time"].into_iter().chain(of_rollout.iter().map(String::as_str)) {
            let path = ColumnPath::new(vec![name.to_owned()]);
            properties = properties.set_column_dictionary_enabled(path, true);
        }
        let writer = SerializedFileWriter::new(file, schema, Arc::new(properties.build()))?;
        Ok(Self { writer, rollouts: vec![], numbers: vec![vec![]; names.len() - 1] })
    }

    fn add(&mut self, rollout: &Rollout, width: usize) -> Result<(), ParquetError> {
        let Rollout { index, parameters, samples, .. } = rollout;
        for sample in samples.chunks(width) {
            self.rollouts.push(i64::try_from(*index).unwrap_or(i64::MAX));
            let row = sample[..1].iter().chain(parameters).chain(&sample[1..]);
            self.numbers.iter_mut().zip(row).for_each(|(column, number)| column.push(*number));
            if self.rollouts.len() == GROUP {
                self.write_group()?;
            }
        }
        Ok(())
    }

    fn write_group(&mut self) -> Result<(), ParquetError> {
        let mut group = self.writer.next_row_group()?;
        if let Some(mut column) = group.next_column()? {
            column.typed::<Int64Type>().write_batch(&self.rollouts, None, None)?;
            column.close()?;
        }
        for numbers in &self.numbers {
            if let Some(mut column) = group.next_column()? {
                column.typed::<DoubleType>().write_batch(numbers, None, None)?;
                column.close()?;
            }
        }
        group.close()?;
        self.rollouts.clear();
        self.numbers.iter_mut().for_each(Vec::clear);
        Ok(())
    }

    fn finish(mut self) -> Result<(), ParquetError> {
        if !self.rollouts.is_empty() {
            self.write_group()?;
        }
        self.writer.close().map(|_| ())
    }
}
