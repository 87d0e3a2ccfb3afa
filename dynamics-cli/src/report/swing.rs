//! A robot left to itself for a while.

use dynamics_core::Energy;
use dynamics_view::Measure;
use dynamics_view::page::{Section, number};

use super::Subject;
use crate::failure::Failure;
use crate::motion::stepped;
use crate::picture::charts::parts;
use crate::picture::{Moment, thinned};
use crate::robot::{Robot, State};
use crate::simulate::{Clock, energies};
use crate::state;

/// How far each joint that turns is from neutral where nothing else is said, rad.
const OFF: f64 = 0.3;

/// A motion, and why it ended.
pub(super) struct Swing {
    moments: Vec<Moment>,
    end: End,
}

/// Why a motion ended.
enum End {
    /// The time was over.
    Time,
    /// A joint came to a limit.
    Limit { joint: String },
    /// Numbers got out of hand.
    Lost { why: String },
}

/// How long a robot is left to itself where nothing is said, s: one that falls is soon out of sight.
pub(super) fn usual_time(robot: &Robot<'_>) -> f64 {
    if parts(robot).loose.iter().any(|joint| joint.is_free) { 1.0 } else { 3.0 }
}

/// Where it starts: at rest, off by the same angle in each joint, as far as their limits allow; or as it is said.
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
    state::override_by("q", &mut start.q, q, &robot.coordinates.q)?;
    state::override_by("v", &mut start.v, v, &robot.coordinates.v)?;
    state::check_quaternions(robot, &start.q)?;
    Ok(start)
}

/// The limits of a coordinate of one number; infinite where there are none.
pub(super) fn limits(robot: &Robot<'_>, q: usize, v: usize) -> [f64; 2] {
    let joint = robot.model.joints.iter().find(|joint| joint.q.contains(&q));
    let limits = joint.and_then(|joint| joint.limits.get(v - joint.v.start));
    limits.map_or([f64::NEG_INFINITY, f64::INFINITY], |limits| [limits.lower, limits.upper])
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
        let mut swing = Self { moments: vec![moment(robot, 0.0, &start)?], end: End::Time };
        let mut state = start;
        for k in 1..=clock.steps {
            let (before, now) = (clock.at(k - 1), clock.at(k));
            let next = stepped(robot, &state, now - before);
            let next = next.and_then(|next| Ok((moment(robot, now, &next)?, next)));
            let (seen, next) = match next {
                Ok(next) => next,
                Err(Failure::Wrong(problems)) => {
                    let why = problems.into_iter().next().map_or(String::new(), |problem| problem.title);
                    swing.end = End::Lost { why };
                    break;
                }
                Err(failure) => return Err(failure),
            };
            let beyond = bounded.iter().find(|([low, high], part)| !(*low..=*high).contains(&next.q[part.q]));
            if let Some((_, part)) = beyond {
                swing.end = End::Limit { joint: part.name.clone() };
                break;
            }
            if k % stride == 0 || k == clock.steps {
                swing.moments.push(seen);
            }
            state = next;
        }
        Ok(swing)
    }

    /// The moments of a picture.
    pub(super) fn frames(&self) -> Vec<&Moment> {
        thinned(&self.moments)
    }

    pub(super) fn section(&self, subject: &Subject<'_, '_>) -> Section {
        let (Some(first), Some(last)) = (self.moments.first(), self.moments.last()) else {
            return Section::new("swing", "A swing");
        };
        let time = number(last.time, 4);
        let ending = match &self.end {
            End::Time => format!("for {time} s"),
            End::Limit { joint } => {
                format!("for {time} s, until `{joint}` comes to its limit, where nothing here stops it")
            }
            End::Lost { why } => {
                format!("for {time} s; then {why}: with a smaller `--step` it may go on")
            }
        };
        let drift = self.moments.iter().map(|now| (now.energy.total() - first.energy.total()).abs());
        let drift = number(drift.fold(0.0, f64::max), 2);
        let loses = subject.robot.tree.links.iter().any(|link| {
            link.passive.damping != 0.0 || link.passive.friction != 0.0
        });
        let account = match loses {
            true => format!("Dampers and friction, and the method's error, changed the total energy by up to {drift} J."),
            false => format!("Nothing takes energy from it: the total changed by no more than {drift} J, which is the method's error."),
        };
        Section::new("swing", "A swing")
            .text(&format!("The robot left to itself {ending}. Its motors are off. {account}"))
            .swing()
            .remark(
                "By the classical method of Runge and Kutta, of fourth order; `dynamics simulate` writes the numbers, \
                 with other starts (`--q`, `--v`) and steps.",
            )
    }
}

fn moment(robot: &Robot<'_>, time: f64, state: &State) -> Result<Moment, Failure> {
    let [kinetic, potential, elastic, _] = energies(robot, state)?;
    Ok(Moment { time, state: state.clone(), energy: Energy { kinetic, potential, elastic } })
}
