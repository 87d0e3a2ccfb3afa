//! The charts of a simulation: what is asked for, and what is on them.

use dynamics_codegen::diagnostics::did_you_mean;
use dynamics_codegen::mechanics::equations::Method;
use dynamics_codegen::model::Motion;
use dynamics_codegen::spatial::Matrix3;
use dynamics_codegen::spec::JointKind;
use dynamics_core::__private::{ball_tangent_rate, free_tangent_rate};
use dynamics_core::Energy;
use dynamics_core::nalgebra::{DMatrix, Schur};
use dynamics_view::{Chart, Plane};

use super::Moment;
use crate::failure::{Failure, Problem};
use crate::input::shown;
use crate::robot::Robot;

/// What a chart may be of.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Wish {
    /// All coordinates.
    Angles,
    /// All speeds.
    Speeds,
    /// The energy and its drift.
    Energy,
    /// The speed of one coordinate over its value.
    Phase(String),
    /// The poles of the linear model at the start.
    Poles,
}

/// Reads one.
pub(super) fn wish(text: &str) -> Result<Wish, String> {
    match text.split_once(':') {
        None if text == "angles" => Ok(Wish::Angles),
        None if text == "speeds" => Ok(Wish::Speeds),
        None if text == "energy" => Ok(Wish::Energy),
        None if text == "poles" => Ok(Wish::Poles),
        Some(("phase", name)) if !name.is_empty() => Ok(Wish::Phase(name.to_owned())),
        _ => {
            Err("give `angles`, `speeds`, `energy`, `poles`, or `phase:` and the name of a coordinate"
                .to_owned())
        }
    }
}

/// What is measured.
#[derive(Clone, Copy, PartialEq)]
enum Measure {
    Angle,
    Distance,
}

/// A coordinate whose rate is a speed.
struct Entry {
    name: String,
    q: usize,
    v: usize,
    measure: Measure,
}

/// A joint with a quaternion: its name, where its coordinates and speeds begin, and whether it has a position as well.
struct Loose {
    name: String,
    q: usize,
    v: usize,
    is_free: bool,
}

/// All that is drawn of coordinates and speeds.
struct Parts {
    entries: Vec<Entry>,
    loose: Vec<Loose>,
}

impl Parts {
    fn of(robot: &Robot<'_>) -> Self {
        let mut parts = Self { entries: vec![], loose: vec![] };
        let own = robot.spec.joints.iter().filter(|joint| joint.has_coordinates());
        for (joint, kind) in robot.model.joints.iter().zip(own.map(|joint| joint.kind)) {
            use Measure::{Angle, Distance};
            let measures: &[Measure] = match kind {
                JointKind::Ball | JointKind::Free => {
                    let (name, q, v) = (joint.name.clone(), joint.q.start, joint.v.start);
                    parts.loose.push(Loose { name, q, v, is_free: kind == JointKind::Free });
                    continue;
                }
                JointKind::Prismatic => &[Distance],
                JointKind::Cylindrical => &[Angle, Distance],
                JointKind::Universal => &[Angle, Angle],
                JointKind::Planar => &[Distance, Distance, Angle],
                JointKind::Translation => &[Distance; 3],
                _ => &[Angle],
            };
            for ((q, v), measure) in joint.q.clone().zip(joint.v.clone()).zip(measures) {
                let name = robot.coordinates.q[q].clone();
                parts.entries.push(Entry { name, q, v, measure: *measure });
            }
        }
        parts
    }

    fn measured(&self, measure: Measure) -> impl Iterator<Item = &Entry> {
        self.entries.iter().filter(move |entry| entry.measure == measure)
    }
}

/// Whether the robot has what is asked for.
pub(super) fn check(wish: &Wish, robot: &Robot<'_>) -> Result<(), Failure> {
    let Wish::Phase(name) = wish else { return Ok(()) };
    let parts = Parts::of(robot);
    if parts.entries.iter().any(|entry| entry.name == *name) {
        return Ok(());
    }
    let problem = Problem::new(format!("there is no coordinate `{}` with a speed of its own", shown(name)));
    let names = || parts.entries.iter().map(|entry| entry.name.as_str());
    let help = match did_you_mean(name, names()) {
        Some(meant) => format!("did you mean `phase:{meant}`?"),
        None => format!("the coordinates are {}", names().collect::<Vec<_>>().join(", ")),
    };
    Err(problem.help(help).into())
}

/// The charts of a wish.
pub(super) fn of(wish: &Wish, robot: &Robot<'_>, moments: &[Moment]) -> Result<Vec<Chart>, Failure> {
    match wish {
        Wish::Poles => Ok(vec![poles(robot, moments)?]),
        Wish::Phase(name) => {
            let parts = Parts::of(robot);
            let found = parts.entries.iter().filter(|entry| entry.name == *name);
            let chart = |entry: &Entry| {
                let q: Vec<f64> = moments.iter().map(|moment| moment.state.q[entry.q]).collect();
                let v: Vec<f64> = moments.iter().map(|moment| moment.state.v[entry.v]).collect();
                let units = if entry.measure == Measure::Angle { ["rad", "rad/s"] } else { ["m", "m/s"] };
                Chart::phase(&entry.name, units, &q, &v)
            };
            Ok(found.map(chart).collect())
        }
        wish => Ok(over_time(wish, robot, &moments.iter().collect::<Vec<_>>())),
    }
}

/// Those over time; none of a phase portrait or of poles.
pub(super) fn over_time(wish: &Wish, robot: &Robot<'_>, moments: &[&Moment]) -> Vec<Chart> {
    let times: Vec<f64> = moments.iter().map(|moment| moment.time).collect();
    match wish {
        Wish::Angles => coordinates(&Parts::of(robot), &times, moments),
        Wish::Speeds => speeds(&Parts::of(robot), &times, moments),
        Wish::Energy => {
            let energy: Vec<Energy<f64>> = moments.iter().map(|moment| moment.energy).collect();
            Chart::energy(&times, &energy).into()
        }
        Wish::Phase(_) | Wish::Poles => vec![],
    }
}

fn coordinates(parts: &Parts, times: &[f64], moments: &[&Moment]) -> Vec<Chart> {
    let q = |k: usize| moments.iter().map(move |moment| moment.state.q[k]);
    let mut charts = vec![];
    for loose in &parts.loose {
        let mut at = loose.q;
        if loose.is_free {
            let chart = Chart::over_time(&format!("position of {}", loose.name), "m", times);
            charts.push(
                ["x", "y", "z"]
                    .iter()
                    .enumerate()
                    .fold(chart, |chart, (k, name)| chart.line(name, q(at + k))),
            );
            at += 3;
        }
        charts.push(orientation(&loose.name, times, [0, 1, 2, 3].map(|k| q(at + k).collect())));
    }
    for (measure, quantity, unit) in [(Measure::Angle, "angle", "rad"), (Measure::Distance, "distance", "m")]
    {
        if parts.measured(measure).next().is_some() {
            let chart = Chart::over_time(quantity, unit, times);
            charts.push(
                parts.measured(measure).fold(chart, |chart, entry| chart.line(&entry.name, q(entry.q))),
            );
        }
    }
    charts
}

fn speeds(parts: &Parts, times: &[f64], moments: &[&Moment]) -> Vec<Chart> {
    let v = |k: usize| moments.iter().map(move |moment| moment.state.v[k]);
    let mut charts = vec![];
    for loose in &parts.loose {
        let mut at = loose.v;
        let mut three = |quantity: &str, unit: &str, names: [&str; 3]| {
            let chart = Chart::over_time(&format!("{quantity} of {}, in the body", loose.name), unit, times);
            charts.push(names.iter().enumerate().fold(chart, |chart, (k, name)| chart.line(name, v(at + k))));
            at += 3;
        };
        if loose.is_free {
            three("velocity", "m/s", ["vx", "vy", "vz"]);
        }
        three("angular velocity", "rad/s", ["wx", "wy", "wz"]);
    }
    for (measure, quantity, unit) in [(Measure::Angle, "speed", "rad/s"), (Measure::Distance, "speed", "m/s")]
    {
        if parts.measured(measure).next().is_some() {
            let chart = Chart::over_time(quantity, unit, times);
            charts.push(
                parts.measured(measure).fold(chart, |chart, entry| chart.line(&entry.name, v(entry.v))),
            );
        }
    }
    charts
}

/// Roll, pitch and yaw are what people see in their minds; near a pitch of a right angle they jump, so that of a body
/// that comes near it the quaternion is drawn.
fn orientation(joint: &str, times: &[f64], quaternion: [Vec<f64>; 4]) -> Chart {
    const STEEP: f64 = 0.97; // a pitch of 76 degrees
    let at = |k: usize| quaternion.each_ref().map(|entry| entry[k]);
    let angles: Vec<[f64; 3]> = (0..times.len()).map(|k| roll_pitch_yaw(at(k))).collect();
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
fn roll_pitch_yaw(quaternion: [f64; 4]) -> [f64; 3] {
    let Matrix3(r) = Matrix3::of_quaternion(quaternion);
    [r[2][1].atan2(r[2][2]), (-r[2][0]).clamp(-1.0, 1.0).asin(), r[1][0].atan2(r[0][0])]
}

/// Angles without jumps of whole turns.
fn unwound(angles: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut found: Vec<f64> = vec![];
    for angle in angles {
        let turns = found.last().map_or(0.0, |last| ((last - angle) / std::f64::consts::TAU).round());
        found.push(angle + turns * std::f64::consts::TAU);
    }
    found
}

/// The eigenvalues of `A = [0 1; ∂a/∂q ∂a/∂v]` at the start, as `linearize` has it.
fn poles(robot: &Robot<'_>, moments: &[Moment]) -> Result<Chart, Failure> {
    let (Some(start), n) = (moments.first(), robot.dof()) else { return Ok(Chart::poles(Plane::Continuous)) };
    let entries = robot.evaluate(Method::ForwardDynamicsDerivatives, &start.state)?;
    let mut a = DMatrix::<f64>::zeros(2 * n, 2 * n);
    for i in 0..n {
        a[(i, n + i)] = 1.0;
        for j in 0..n {
            a[(n + i, j)] = entries[i * n + j];
            a[(n + i, n + j)] = entries[(n + i) * n + j];
        }
    }
    let mut put = |from: usize, rows: &[&[f64]]| {
        for (i, row) in rows.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                a[(from + i, from + j)] = *entry;
            }
        }
    };
    let v = &start.state.v;
    for link in &robot.tree.links {
        let from = link.drive.v;
        match link.motion {
            Motion::Revolute | Motion::Prismatic => {}
            Motion::Ball => {
                let rate = ball_tangent_rate::<f64>(std::array::from_fn(|k| v[from + k]));
                put(from, &rate.each_ref().map(|row| &row[..]));
            }
            Motion::Free => {
                let rate = free_tangent_rate::<f64>(std::array::from_fn(|k| v[from + k]));
                put(from, &rate.each_ref().map(|row| &row[..]));
            }
        }
    }
    const ROUNDS: usize = 10_000;
    let schur = Schur::try_new(a, f64::EPSILON, ROUNDS).ok_or_else(|| {
        let problem = Problem::new("the poles at the start cannot be found");
        Failure::from(problem.help("leave `poles` out of `--plot-of`"))
    })?;
    let found = schur.complex_eigenvalues();
    Ok(Chart::poles(Plane::Continuous).set("at the start", found.iter().map(|pole| [pole.re, pole.im])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wishes_are_read() {
        assert_eq!(wish("phase:root.x"), Ok(Wish::Phase("root.x".to_owned())));
        assert!(["", "phase", "phase:", "angle", "angles:x"].iter().all(|text| wish(text).is_err()));
    }

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
