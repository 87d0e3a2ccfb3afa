//! The charts of all coordinates and speeds of a robot, each in the unit that it has.

use std::f64::consts::TAU;

use crate::chart::Chart;

/// What is measured by a coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// rad
    Angle,
    /// m
    Distance,
}

/// A coordinate whose rate is one of the speeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// What it is called.
    pub name: String,
    /// Its index among the coordinates.
    pub q: usize,
    /// The index of its speed.
    pub v: usize,
    /// What it measures.
    pub measure: Measure,
}

/// A joint with a quaternion i, j, k, w.
#[derive(Clone, Debug, PartialEq)]
pub struct Loose {
    /// What it is called.
    pub name: String,
    /// The index of its first coordinate.
    pub q: usize,
    /// The index of its first speed.
    pub v: usize,
    /// Whether there is a position before the quaternion, and its velocity before the angular one.
    pub is_free: bool,
}

/// All that is drawn of the coordinates of a robot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Coordinates {
    /// Those of one number.
    pub single: Vec<Coordinate>,
    /// Those with a quaternion.
    pub loose: Vec<Loose>,
}

impl Measure {
    fn units(self) -> [&'static str; 2] {
        match self {
            Self::Angle => ["rad", "rad/s"],
            Self::Distance => ["m", "m/s"],
        }
    }
}

impl Coordinates {
    /// The coordinates over time: angles in one chart, distances in another; of a free joint the position, and roll, pitch
    /// and yaw about the fixed axes x, y, z. Near a pitch of a right angle these jump: of a body that comes near it the
    /// quaternion is drawn.
    ///
    /// `q` has the coordinates at each time.
    #[must_use]
    pub fn charts(&self, times: &[f64], q: &[&[f64]]) -> Vec<Chart> {
        let mut charts = vec![];
        for Loose { name, q: from, is_free, .. } in &self.loose {
            let mut at = *from;
            if *is_free {
                charts.push(three(&format!("position of {name}"), "m", times, ["x", "y", "z"], at, q));
                at += 3;
            }
            charts.push(orientation(name, times, [0, 1, 2, 3].map(|k| column(q, at + k).collect())));
        }
        for (measure, quantity) in [(Measure::Angle, "angle"), (Measure::Distance, "distance")] {
            let lines = |coordinate: &Coordinate| column(q, coordinate.q).collect();
            charts.extend(self.measured(measure, quantity, measure.units()[0], times, lines));
        }
        charts
    }

    /// The speeds over time; of a free joint the twist of the body, in the body's axes. `v` has the speeds at each time.
    #[must_use]
    pub fn speed_charts(&self, times: &[f64], v: &[&[f64]]) -> Vec<Chart> {
        let mut charts = vec![];
        for Loose { name, v: from, is_free, .. } in &self.loose {
            let mut at = *from;
            if *is_free {
                let quantity = format!("velocity of {name}, in the body");
                charts.push(three(&quantity, "m/s", times, ["vx", "vy", "vz"], at, v));
                at += 3;
            }
            let quantity = format!("angular velocity of {name}, in the body");
            charts.push(three(&quantity, "rad/s", times, ["wx", "wy", "wz"], at, v));
        }
        for measure in [Measure::Angle, Measure::Distance] {
            let lines = |coordinate: &Coordinate| column(v, coordinate.v).collect();
            charts.extend(self.measured(measure, "speed", measure.units()[1], times, lines));
        }
        charts
    }

    /// The phase portrait of one coordinate; none, if no coordinate of one number has this name.
    #[must_use]
    pub fn phase(&self, name: &str, q: &[&[f64]], v: &[&[f64]]) -> Option<Chart> {
        let found = self.single.iter().find(|coordinate| coordinate.name == name)?;
        let [q, v]: [Vec<f64>; 2] = [column(q, found.q).collect(), column(v, found.v).collect()];
        Some(Chart::phase(name, found.measure.units(), &q, &v))
    }

    fn measured(
        &self,
        measure: Measure,
        quantity: &str,
        unit: &str,
        times: &[f64],
        line: impl Fn(&Coordinate) -> Vec<f64>,
    ) -> Option<Chart> {
        let mut found = self.single.iter().filter(|coordinate| coordinate.measure == measure).peekable();
        found.peek()?;
        let chart = Chart::over_time(quantity, unit, times);
        Some(found.fold(chart, |chart, coordinate| chart.line(&coordinate.name, line(coordinate))))
    }
}

/// One entry of each row; what is missing cannot be drawn.
fn column(rows: &[&[f64]], k: usize) -> impl Iterator<Item = f64> {
    rows.iter().map(move |row| row.get(k).copied().unwrap_or(f64::NAN))
}

fn three(quantity: &str, unit: &str, times: &[f64], names: [&str; 3], at: usize, rows: &[&[f64]]) -> Chart {
    let chart = Chart::over_time(quantity, unit, times);
    names.iter().enumerate().fold(chart, |chart, (k, name)| chart.line(name, column(rows, at + k)))
}

fn orientation(joint: &str, times: &[f64], quaternion: [Vec<f64>; 4]) -> Chart {
    const STEEP: f64 = 0.97; // a pitch of 76 degrees
    let at = |k: usize| quaternion.each_ref().map(|entry| entry[k]);
    let angles: Vec<[f64; 3]> = (0..quaternion[0].len()).map(|k| roll_pitch_yaw(at(k))).collect();
    let quantity = format!("orientation of {joint}");
    if angles.iter().any(|[_, pitch, _]| pitch.sin().abs() > STEEP) {
        let chart = Chart::over_time(&format!("{quantity}, a quaternion"), "", times);
        let names = ["qx", "qy", "qz", "qw"];
        return names.iter().zip(quaternion).fold(chart, |chart, (name, values)| chart.line(name, values));
    }
    let chart = Chart::over_time(&quantity, "rad", times);
    ["roll", "pitch", "yaw"]
        .iter()
        .enumerate()
        .fold(chart, |chart, (k, name)| chart.line(name, unwound(angles.iter().map(|angles| angles[k]))))
}

/// The angles about the fixed axes x, y and z, as URDF has them.
fn roll_pitch_yaw([i, j, k, w]: [f64; 4]) -> [f64; 3] {
    let roll = (2.0 * (j * k + i * w)).atan2(1.0 - 2.0 * (i * i + j * j));
    let pitch = (2.0 * (j * w - i * k)).clamp(-1.0, 1.0).asin();
    let yaw = (2.0 * (i * j + k * w)).atan2(1.0 - 2.0 * (j * j + k * k));
    [roll, pitch, yaw]
}

/// Angles without jumps of whole turns.
fn unwound(angles: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut found: Vec<f64> = vec![];
    for angle in angles {
        let turns = found.last().map_or(0.0, |last| ((last - angle) / TAU).round());
        found.push(angle + turns * TAU);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_turn_is_no_jump() {
        let turning = (0..40).map(|k| (0.5 * f64::from(k)).sin().atan2((0.5 * f64::from(k)).cos()));
        for (k, angle) in unwound(turning).into_iter().enumerate() {
            assert!((angle - 0.5 * k as f64).abs() < 1e-12);
        }
    }

    #[test]
    fn angles_are_those_of_urdf() {
        // Rz(0.3)·Ry(−0.2)·Rx(0.5)
        let half = |angle: f64| ((angle / 2.0).sin(), (angle / 2.0).cos());
        let ((sr, cr), (sp, cp), (sy, cy)) = (half(0.5), half(-0.2), half(0.3));
        let quaternion = [
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
            cr * cp * cy + sr * sp * sy,
        ];
        for (found, expected) in roll_pitch_yaw(quaternion).iter().zip([0.5, -0.2, 0.3]) {
            assert!((found - expected).abs() < 1e-15, "{found} {expected}");
        }
    }
}
