//! What is drawn in one frame of axes.

use dynamics_core::Energy;

use crate::error::{Error, check_length, check_numbers};

/// One chart: lines over time, a phase portrait, or poles.
#[derive(Clone, Debug)]
pub struct Chart {
    pub(crate) quantity: String,
    pub(crate) unit: String,
    pub(crate) kind: Kind,
}

#[derive(Clone, Debug)]
pub(crate) enum Kind {
    /// Each line has as many values as there are times.
    OverTime { times: Vec<f64>, lines: Vec<Line> },
    /// A path in the plane of a coordinate and its speed.
    Phase { x: String, x_unit: String, points: [Vec<f64>; 2] },
    /// Sets of complex numbers.
    Poles { plane: Plane, sets: Vec<Poles> },
}

/// A named row of numbers.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    pub(crate) name: String,
    pub(crate) values: Vec<f64>,
}

/// A named set of complex numbers, real part first.
#[derive(Clone, Debug)]
pub(crate) struct Poles {
    pub(crate) name: String,
    pub(crate) values: Vec<[f64; 2]>,
}

/// The plane in which poles are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// Of `ẋ = A·x`: stable to the left of the imaginary axis; with rays of equal damping ratio, in 1/s.
    Continuous,
    /// Of `x⁺ = A·x`: stable within the unit circle; with curves of equal damping ratio, without unit.
    Discrete,
}

/// Where energy went since the start, in J, as an [`EnergyMonitor`](dynamics_core::simulate::EnergyMonitor) has it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Account {
    /// What the motors gave.
    pub work: f64,
    /// What dampers and friction took.
    pub dissipated: f64,
    /// What cannot be accounted for.
    pub imbalance: f64,
}

impl Chart {
    /// Lines over time, in s, of a quantity in a unit: `Chart::over_time("angle", "rad", &times)`.
    #[must_use]
    pub fn over_time(quantity: &str, unit: &str, times: &[f64]) -> Self {
        let kind = Kind::OverTime { times: times.to_vec(), lines: vec![] };
        Self { quantity: quantity.to_owned(), unit: unit.to_owned(), kind }
    }

    /// With one more line, one value for each time; of a chart that is not over time, the chart as it is.
    #[must_use]
    pub fn line(mut self, name: &str, values: impl IntoIterator<Item = f64>) -> Self {
        if let Kind::OverTime { lines, .. } = &mut self.kind {
            lines.push(Line { name: name.to_owned(), values: values.into_iter().collect() });
        }
        self
    }

    /// The energy over time, in J, and how its sum has changed since the start.
    ///
    /// What motors gave, what dampers and friction took, and the integrator's error are in the change;
    /// [`energy_account`](Self::energy_account) tells them apart. Energy of springs is drawn where there is some.
    #[must_use]
    pub fn energy(times: &[f64], energy: &[Energy<f64>]) -> [Self; 2] {
        let start = energy.first().map_or(0.0, Energy::total);
        let change = energy.iter().map(|e| e.total() - start);
        [
            Self::energies(times, energy),
            Self::over_time("change of the energy", "J", times).line("total − start", change),
        ]
    }

    /// The energy over time, in J; where its change came from, the work of the motors and what dampers and friction took;
    /// and what is left, the integrator's error and that of the account.
    #[must_use]
    pub fn energy_account(times: &[f64], energy: &[Energy<f64>], accounts: &[Account]) -> Vec<Self> {
        let [parts, mut change] = Self::energy(times, energy);
        let of = |entry: fn(&Account) -> f64| accounts.iter().map(entry).collect::<Vec<_>>();
        let (work, taken) = (of(|account| account.work), of(|account| -account.dissipated));
        let [has_work, has_taken] = [&work, &taken].map(|line| line.iter().any(|joules| *joules != 0.0));
        if has_work {
            change = change.line("work of the motors", work);
        }
        if has_taken {
            change = change.line("taken by dampers", taken);
        }
        let what_is_left = match (has_work, has_taken) {
            (true, true) => "change − work + taken",
            (true, false) => "change − work",
            (false, true) => "change + taken",
            (false, false) => "total − start",
        };
        let error = Self::over_time("error of the energy", "J", times);
        let error = error.line(what_is_left, of(|account| account.imbalance));
        if has_work || has_taken { vec![parts, change, error] } else { vec![parts, error] }
    }

    fn energies(times: &[f64], energy: &[Energy<f64>]) -> Self {
        let of = |part: fn(&Energy<f64>) -> f64| energy.iter().map(part).collect::<Vec<_>>();
        let parts = Self::over_time("energy", "J", times)
            .line("total", of(Energy::total))
            .line("kinetic", of(|e| e.kinetic))
            .line("potential", of(|e| e.potential));
        if energy.iter().any(|e| e.elastic != 0.0) { parts.line("elastic", of(|e| e.elastic)) } else { parts }
    }

    /// The phase portrait of one coordinate: its speed over its value.
    ///
    /// A ring is where it begins, a dot where it ends, and arrows say which way it goes.
    #[must_use]
    pub fn phase(name: &str, [q_unit, v_unit]: [&str; 2], q: &[f64], v: &[f64]) -> Self {
        let kind =
            Kind::Phase { x: name.to_owned(), x_unit: q_unit.to_owned(), points: [q.to_vec(), v.to_vec()] };
        Self { quantity: format!("speed of {name}"), unit: v_unit.to_owned(), kind }
    }

    /// An empty plane for poles, to which [`set`](Self::set) adds some.
    #[must_use]
    pub fn poles(plane: Plane) -> Self {
        let unit = if plane == Plane::Continuous { "1/s" } else { "" };
        Self {
            quantity: "poles".to_owned(),
            unit: unit.to_owned(),
            kind: Kind::Poles { plane, sets: vec![] },
        }
    }

    /// With one more set of poles, each its real and its imaginary part; of a chart without poles, as it is.
    #[must_use]
    pub fn set(mut self, name: &str, poles: impl IntoIterator<Item = [f64; 2]>) -> Self {
        if let Kind::Poles { sets, .. } = &mut self.kind {
            sets.push(Poles { name: name.to_owned(), values: poles.into_iter().collect() });
        }
        self
    }

    /// Whether all of it can be drawn.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let empty = || Error::Empty { what: format!("the chart of `{}`", self.quantity) };
        match &self.kind {
            Kind::OverTime { times, lines } => {
                if times.is_empty() || lines.is_empty() {
                    return Err(empty());
                }
                check_times(times)?;
                for Line { name, values } in lines {
                    check_length(&format!("the line `{name}`"), times.len(), values.len())?;
                    check_numbers(&format!("the line `{name}`"), values.iter().copied())?;
                }
            }
            Kind::Phase { x, points: [q, v], .. } => {
                if q.is_empty() {
                    return Err(empty());
                }
                check_length(&format!("the speed of `{x}`"), q.len(), v.len())?;
                check_numbers(&format!("`{x}`"), q.iter().copied())?;
                check_numbers(&format!("the speed of `{x}`"), v.iter().copied())?;
            }
            Kind::Poles { sets, .. } => {
                if sets.iter().all(|set| set.values.is_empty()) {
                    return Err(empty());
                }
                for Poles { name, values } in sets {
                    for part in [0, 1] {
                        check_numbers(&format!("a pole of `{name}`"), values.iter().map(|pole| pole[part]))?;
                    }
                }
            }
        }
        Ok(())
    }
}

/// Finite times, each after the one before it.
pub(crate) fn check_times(times: &[f64]) -> Result<(), Error> {
    check_numbers("the time", times.iter().copied())?;
    match times.windows(2).position(|pair| pair[1] <= pair[0]) {
        Some(before) => Err(Error::TimesNotIncreasing { index: before + 1 }),
        None => Ok(()),
    }
}
