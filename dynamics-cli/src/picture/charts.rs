//! The charts of a simulation: what is asked for, and what is on them.

use dynamics_codegen::diagnostics::did_you_mean;
use dynamics_codegen::spec::JointKind;
use dynamics_core::Energy;
use dynamics_view::{Chart, Coordinate, Coordinates, Loose, Measure, Plane};

use super::Moment;
use crate::failure::{Failure, Problem};
use crate::input::shown;
use crate::linear;
use crate::robot::Robot;

/// What a chart may be of.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Wish {
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
pub(crate) fn parts(robot: &Robot<'_>) -> Coordinates {
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
pub(crate) fn over_time(wish: &Wish, robot: &Robot<'_>, moments: &[&Moment]) -> Vec<Chart> {
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

/// The poles of the linear model at the start.
fn poles(robot: &Robot<'_>, moments: &[Moment]) -> Result<Chart, Failure> {
    let Some(start) = moments.first() else { return Ok(Chart::poles(Plane::Continuous)) };
    let found = linear::eigenvalues(linear::state_matrix(robot, &start.state)?).ok_or_else(|| {
        let problem = Problem::new("the poles at the start cannot be found");
        Failure::from(problem.help("leave `poles` out of `--plot-of`"))
    })?;
    Ok(Chart::poles(Plane::Continuous).set("at the start", found))
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
