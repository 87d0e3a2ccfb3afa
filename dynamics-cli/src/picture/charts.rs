//! The charts of a simulation: what is asked for, and what is on them.

use dynamics_codegen::diagnostics::did_you_mean;
use dynamics_codegen::mechanics::equations::Method;
use dynamics_codegen::model::Motion;
use dynamics_codegen::spec::JointKind;
use dynamics_core::__private::{ball_tangent_rate, free_tangent_rate};
use dynamics_core::Energy;
use dynamics_core::nalgebra::{DMatrix, Schur};
use dynamics_view::{Chart, Coordinate, Coordinates, Loose, Measure, Plane};

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
    /// The energy and its change.
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

/// What is drawn of the coordinates of a robot.
fn parts(robot: &Robot<'_>) -> Coordinates {
    let mut parts = Coordinates::default();
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
            parts.single.push(Coordinate { name, q, v, measure: *measure });
        }
    }
    parts
}

/// Whether the robot has what is asked for.
pub(super) fn check(wish: &Wish, robot: &Robot<'_>) -> Result<(), Failure> {
    let Wish::Phase(name) = wish else { return Ok(()) };
    let parts = parts(robot);
    if parts.single.iter().any(|entry| entry.name == *name) {
        return Ok(());
    }
    let problem = Problem::new(format!("there is no coordinate `{}` with a speed of its own", shown(name)));
    let names = || parts.single.iter().map(|entry| entry.name.as_str());
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
            let (q, v) = states(&moments.iter().collect::<Vec<_>>());
            Ok(parts(robot).phase(name, &q, &v).into_iter().collect())
        }
        wish => Ok(over_time(wish, robot, &moments.iter().collect::<Vec<_>>())),
    }
}

/// Those over time; none of a phase portrait or of poles.
pub(super) fn over_time(wish: &Wish, robot: &Robot<'_>, moments: &[&Moment]) -> Vec<Chart> {
    let times: Vec<f64> = moments.iter().map(|moment| moment.time).collect();
    let (q, v) = states(moments);
    match wish {
        Wish::Angles => parts(robot).charts(&times, &q),
        Wish::Speeds => parts(robot).speed_charts(&times, &v),
        Wish::Energy => {
            let energy: Vec<Energy<f64>> = moments.iter().map(|moment| moment.energy).collect();
            Chart::energy(&times, &energy).into()
        }
        Wish::Phase(_) | Wish::Poles => vec![],
    }
}

/// Coordinates and speeds at each moment.
fn states<'a>(moments: &[&'a Moment]) -> (Vec<&'a [f64]>, Vec<&'a [f64]>) {
    moments.iter().map(|moment| (&*moment.state.q, &*moment.state.v)).unzip()
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
}
