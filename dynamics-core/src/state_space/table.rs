//! A state-space model as a table: a row for each rate and each output, a column for each state and each input.

use core::fmt::{self, Display, LowerExp, Write};

use nalgebra::SMatrix;

use super::{Signal, StateSpace};
use crate::scalar::Scalar;

/// What can be printed in a table: `f32`, `f64` and the like.
pub(crate) trait Number: Scalar + PartialOrd + Display + LowerExp {}
impl<T: Scalar + PartialOrd + Display + LowerExp> Number for T {}

/// A column is at least so wide, with the space before it.
const COLUMN: usize = 12;
/// Digits behind the point unless the user says otherwise.
const DIGITS: usize = 4;

impl<T, const NX: usize, const NU: usize, const NY: usize> Display for StateSpace<T, NX, NU, NY>
where
    T: Scalar + PartialOrd + Display + LowerExp,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = f.precision().unwrap_or(DIGITS);
        let columns = || of_letter(&self.states, 'x').chain(of_letter(&self.inputs, 'u'));
        let rows = || of_letter(&self.states, 'x').chain(of_letter(&self.outputs, 'y'));
        let width = columns().map(|label| width(&label) + 2).fold(COLUMN.max(digits + 8), usize::max);
        let name = rows().map(|label| self::width(&label)).fold(0, usize::max);
        let unit = rows().map(|label| label.signal.unit.chars().count()).fold(0, usize::max);
        let table = Table { digits, width, name, unit };
        match &self.sample_time {
            None => writeln!(f, "x' = A x + B u + drift, y = C x + D u + offset")?,
            Some(time) => writeln!(f, "x+ = A x + B u + drift, y = C x + D u + offset, every {time} s")?,
        }
        table.heading(f, of_letter(&self.states, 'x'), of_letter(&self.inputs, 'u'))?;
        let head = if self.sample_time.is_none() { "x'" } else { "x+" };
        for (index, label) in of_letter(&self.states, 'x').enumerate() {
            table.row(f, head, &label, &Row { x: &self.a, u: &self.b, constant: &self.drift, index })?;
        }
        for (index, label) in of_letter(&self.outputs, 'y').enumerate() {
            table.row(f, "y ", &label, &Row { x: &self.c, u: &self.d, constant: &self.offset, index })?;
        }
        Ok(())
    }
}

/// A signal, or its letter and index where it has no name.
struct Label {
    signal: Signal,
    letter: char,
    index: usize,
}

fn of_letter(signals: &[Signal], letter: char) -> impl Iterator<Item = Label> + Clone {
    signals.iter().enumerate().map(move |(index, signal)| Label { signal: *signal, letter, index })
}

impl Display for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.signal.name.is_empty() && self.signal.part.is_empty() {
            return write!(f, "{}[{}]", self.letter, self.index);
        }
        self.signal.fmt(f)
    }
}

/// One row of the matrices.
struct Row<'m, T, const R: usize, const NX: usize, const NU: usize> {
    x: &'m SMatrix<T, R, NX>,
    u: &'m SMatrix<T, R, NU>,
    constant: &'m SMatrix<T, R, 1>,
    index: usize,
}

/// The widths of a table.
struct Table {
    digits: usize,
    width: usize,
    name: usize,
    unit: usize,
}

impl Table {
    fn heading(
        &self,
        f: &mut fmt::Formatter<'_>,
        states: impl Iterator<Item = Label> + Clone,
        inputs: impl Iterator<Item = Label> + Clone,
    ) -> fmt::Result {
        self.spaces(f, self.name + self.unit + 4)?;
        states.clone().try_for_each(|label| right(f, self.width, &label))?;
        f.write_str(" |")?;
        inputs.clone().try_for_each(|label| right(f, self.width, &label))?;
        f.write_str(" |")?;
        right(f, self.width, &"constant")?;
        f.write_char('\n')?;
        let has_units = |label: Label| !label.signal.unit.is_empty();
        if states.clone().any(has_units) || inputs.clone().any(has_units) {
            self.spaces(f, self.name + self.unit + 4)?;
            states.clone().try_for_each(|label| right(f, self.width, &label.signal.unit))?;
            f.write_str(" |")?;
            inputs.clone().try_for_each(|label| right(f, self.width, &label.signal.unit))?;
            f.write_str(" |\n")?;
        }
        Ok(())
    }

    fn row<T: Number, const R: usize, const NX: usize, const NU: usize>(
        &self,
        f: &mut fmt::Formatter<'_>,
        head: &str,
        label: &Label,
        row: &Row<'_, T, R, NX, NU>,
    ) -> fmt::Result {
        write!(f, "{head} {label}")?;
        self.spaces(f, (self.name + 1).saturating_sub(width(label)))?;
        f.write_str(label.signal.unit)?;
        self.spaces(f, self.unit.saturating_sub(label.signal.unit.chars().count()))?;
        self.numbers(f, row.x, row.index)?;
        f.write_str(" |")?;
        self.numbers(f, row.u, row.index)?;
        f.write_str(" |")?;
        self.numbers(f, row.constant, row.index)?;
        f.write_char('\n')
    }

    fn numbers<T: Number, const R: usize, const C: usize>(
        &self,
        f: &mut fmt::Formatter<'_>,
        matrix: &SMatrix<T, R, C>,
        row: usize,
    ) -> fmt::Result {
        for column in &matrix.data.0 {
            match column.get(row) {
                Some(value) => right(f, self.width, &Short { value: *value, digits: self.digits })?,
                None => return Err(fmt::Error),
            }
        }
        Ok(())
    }

    fn spaces(&self, f: &mut fmt::Formatter<'_>, count: usize) -> fmt::Result {
        write!(f, "{:count$}", "")
    }
}

/// A number by its digits behind the point, or in powers of ten where these would not show it.
pub(crate) struct Short<T> {
    pub(crate) value: T,
    pub(crate) digits: usize,
}

impl<T: Number> Display for Short<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { value, digits } = *self;
        let size = if value < T::zero() { -value } else { value };
        if size == T::zero() {
            f.write_char('0')
        } else if size < T::of(1e-3) || size >= T::of(1e5) {
            write!(f, "{value:.*e}", digits.saturating_sub(1))
        } else {
            write!(f, "{value:.digits$}")
        }
    }
}

/// Writes `text` so that it ends where the column does.
fn right(f: &mut fmt::Formatter<'_>, column: usize, text: &impl Display) -> fmt::Result {
    let space = column.saturating_sub(width(text));
    write!(f, "{:space$}{text}", "")
}

/// How many letters a text has.
fn width(text: &impl Display) -> usize {
    struct Counter(usize);
    impl Write for Counter {
        fn write_str(&mut self, text: &str) -> fmt::Result {
            self.0 += text.chars().count();
            Ok(())
        }
    }
    let mut counter = Counter(0);
    match write!(counter, "{text}") {
        Ok(()) => counter.0,
        Err(fmt::Error) => 0,
    }
}
