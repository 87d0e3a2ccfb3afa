//! A robot left to itself for a while.

use dynamics_core::Energy;
use dynamics_view::page::{Section, number};
use dynamics_view::{Chart, Coordinate, Figure, Measure};

use super::equations::{listed, passive};
use super::{Subject, stage};
use crate::absence::Absent;
use crate::failure::Failure;
use crate::limits::limits;
use crate::motion::{FixedStep, Mover};
use crate::picture::charts::{self, Wish, parts};
use crate::picture::{Moment, thinned};
use crate::robot::{Robot, State};
use crate::simulate::{Clock, energies};
use crate::start;

/// How far each joint that turns is from neutral where nothing else is said, rad.
const OFF: f64 = 0.3;
/// How fast a body that is free turns about each of its axes where nothing else is said, rad/s.
const SPIN: f64 = 1.0;

/// The width of a chart that nothing moves, in pixels.
const WIDTH: f64 = 560.0;

/// A motion, and what became of it.
pub(super) struct Swing {
    moments: Vec<Moment>,
    /// The joints that went beyond their limits, each with when.
    beyond: Vec<(String, f64)>,
    end: End,
}

/// Why a motion ended.
enum End {
    /// The time was over.
    Time,
    /// A joint that slides came to its end.
    Stop { joint: String },
    /// Numbers got out of hand.
    Lost { why: String },
}

/// How long a robot is left to itself where nothing is said, s: one that falls is soon out of sight.
pub(super) fn usual_time(robot: &Robot<'_>) -> f64 {
    if parts(robot).loose.iter().any(|joint| joint.is_free) { 1.0 } else { 3.0 }
}

/// Where it starts: off by the same angle in each joint, as far as their limits allow, and at rest but for bodies that are
/// free, which spin; or as it is said.
pub(super) fn start(robot: &Robot<'_>, q: Option<&str>, v: Option<&str>) -> Result<State, Failure> {
    let mut start = State::neutral(robot);
    if q.is_none() {
        for part in parts(robot).single {
            let [low, high] = limits(robot, part.q, part.v);
            let off = if part.measure == Measure::Angle { OFF } else { 0.0 };
            // Where a limit is nearer than that, the way to it is halved.
            start.q[part.q] = if off > high { high / 2.0 } else { off }.clamp(low, high.max(low));
        }
    }
    if v.is_none() {
        for joint in parts(robot).loose {
            let from = if joint.is_free { joint.v + 3 } else { joint.v };
            start.v[from..from + 3].fill(SPIN);
        }
    }
    start::put(robot, &mut start, q, v)?;
    Ok(start)
}

impl Swing {
    /// The motion from a state, in steps of `step`.
    pub(super) fn of(robot: &Robot<'_>, start: State, time: f64, step: f64) -> Result<Self, Failure> {
        let clock = Clock::of(time, step)?;
        let bounded: Vec<_> = parts(robot)
            .single
            .into_iter()
            .map(|part| (limits(robot, part.q, part.v), part))
            .filter(|([low, high], part)| (*low..=*high).contains(&start.q[part.q]))
            .collect();
        // What the picture shows 60 times a second need not be kept a thousand times.
        let stride = (1.0 / (240.0 * step)).floor().max(1.0) as u64;
        let mut swing = Self { moments: vec![moment(robot, 0.0, &start)?], beyond: vec![], end: End::Time };
        let mut mover = Mover::fixed(robot, start, FixedStep::Rk4);
        for k in 1..=clock.steps {
            let (before, now) = (clock.at(k - 1), clock.at(k));
            let moved = mover.advance([before, now], time, |_, _, _| {}).map_err(|(failure, _)| failure);
            let seen = match moved.and_then(|()| Ok(moment(robot, now, mover.state())?)) {
                Ok(seen) => seen,
                Err(Failure::Wrong(problems)) => {
                    let why = problems.into_iter().next().map_or(String::new(), |problem| problem.title);
                    swing.end = End::Lost { why };
                    break;
                }
                Err(failure) => return Err(failure),
            };
            let is_beyond = |([low, high], part): &&([f64; 2], Coordinate)| {
                !(*low..=*high).contains(&seen.state.q[part.q])
            };
            for (_, part) in bounded.iter().filter(is_beyond) {
                match part.measure {
                    Measure::Distance => swing.end = End::Stop { joint: part.name.clone() },
                    Measure::Angle if swing.beyond.iter().all(|(known, _)| *known != part.name) => {
                        swing.beyond.push((part.name.clone(), now));
                    }
                    Measure::Angle => {}
                }
            }
            if matches!(swing.end, End::Stop { .. }) {
                break;
            }
            if k % stride == 0 || k == clock.steps {
                swing.moments.push(seen);
            }
        }
        Ok(swing)
    }

    /// The moments of a picture.
    pub(super) fn frames(&self) -> Vec<&Moment> {
        thinned(&self.moments)
    }

    /// Coordinates, speeds and energy over time.
    pub(super) fn charts(&self, robot: &Robot<'_>) -> Vec<Chart> {
        let frames = self.frames();
        let wishes = [Wish::Angles, Wish::Speeds, Wish::Energy];
        wishes.iter().flat_map(|wish| charts::over_time(wish, robot, &frames)).collect()
    }

    pub(super) fn section(&self, subject: &Subject<'_, '_>) -> Section {
        let (Some(first), Some(last)) = (self.moments.first(), self.moments.last()) else {
            return Section::new("swing", "A swing");
        };
        let time = number(last.time, 4);
        let ending = match &self.end {
            End::Time => format!("for {time} s"),
            End::Stop { joint } => format!("for {time} s, until `{joint}` comes to its end"),
            End::Lost { why } => {
                format!("for {time} s; then {why}. With a smaller `--step` it may go on")
            }
        };
        let drift = self.moments.iter().map(|now| (now.energy.total() - first.energy.total()).abs());
        let drift = number(drift.fold(0.0, f64::max), 2);
        let losses = passive(subject.robot).into_iter().filter(|kind| *kind != "springs");
        let losses: Vec<&str> = losses.chain(["the method's error"]).collect();
        let account = match losses.len() > 1 {
            true => {
                let losses = listed(&losses);
                let first = losses[..1].to_uppercase();
                format!("{first}{} changed the total energy by up to {drift} J.", &losses[1..])
            }
            false => format!(
                "Nothing takes energy from it: the total changed by no more than {drift} J, which is the method's error."
            ),
        };
        let section = Section::new("swing", "A swing").text(&format!(
            "The robot left to itself {ending}. Its motors are off. {account}{}",
            self.limits_passed()
        ));
        let section = match stage::is_empty(subject.robot) {
            true => self.charts(subject.robot).into_iter().fold(section, |section, chart| {
                section.figure("a chart over time", Figure::new("").with(chart).wide(WIDTH))
            }),
            false => section.swing(),
        };
        section.remark(
                "By the classical method of Runge and Kutta, of fourth order; `dynamics simulate` writes the numbers, \
                 with other starts (`--q`, `--v`) and steps.",
            )
    }
}

impl Swing {
    /// Which joints went where they cannot.
    fn limits_passed(&self) -> String {
        let Some((joint, time)) = self.beyond.first() else { return String::new() };
        let others = match self.beyond.len() - 1 {
            0 => String::new(),
            1 => ", and one other later".to_owned(),
            more => format!(", and {more} others later"),
        };
        format!(
            " Its joints have no stops here: `{joint}` passes its limit after {} s{others}.",
            number(*time, 3)
        )
    }
}

fn moment(robot: &Robot<'_>, time: f64, state: &State) -> Result<Moment, Absent> {
    let [kinetic, potential, elastic, _] = energies(robot, state)?;
    Ok(Moment { time, state: state.clone(), energy: Energy { kinetic, potential, elastic } })
}
