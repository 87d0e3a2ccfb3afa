//! The limits of joints, and a watch over these while a robot moves: nothing stops it there.

use std::io::Write;

use dynamics_view::{Coordinate, Measure};

use crate::digits::{rounded, said};
use crate::picture::charts::parts;
use crate::robot::{Robot, State};

/// The limits of a coordinate of one number; infinite where there are none. Files in which nobody knew them have 0 and 0:
/// an interval that has no inside is no limit.
pub(crate) fn limits(robot: &Robot<'_>, q: usize, v: usize) -> [f64; 2] {
    let joint = robot.model.joints.iter().find(|joint| joint.q.contains(&q));
    let limits = joint.and_then(|joint| joint.limits.get(v - joint.v.start));
    let limits = limits.filter(|limits| limits.lower < limits.upper);
    limits.map_or([f64::NEG_INFINITY, f64::INFINITY], |limits| [limits.lower, limits.upper])
}

/// What a motion does at the limits of joints, from one state that is seen to the next.
pub(crate) struct Watch {
    time: f64,
    joints: Vec<Bounded>,
}

/// A joint with limits.
struct Bounded {
    joint: Coordinate,
    limits: [f64; 2],
    /// Its value and its speed when it was seen last.
    last: [f64; 2],
    passed: Option<Passed>,
}

/// A limit that was passed, the first one of a joint.
struct Passed {
    /// None if the motion began beyond it.
    time: Option<f64>,
    limit: Limit,
    /// How far the joint came on that side.
    furthest: f64,
}

#[derive(Clone, Copy, PartialEq)]
enum Limit {
    Lower,
    Upper,
}

impl Watch {
    /// One that begins with the state at the start.
    pub(crate) fn of(robot: &Robot<'_>, start: &State) -> Self {
        let joints = parts(robot).single.into_iter().map(|joint| {
            let (limits, last) = (limits(robot, joint.q, joint.v), [start.q[joint.q], start.v[joint.v]]);
            let passed = beyond(last[0], limits);
            let passed = passed.map(|limit| Passed { time: None, limit, furthest: last[0] });
            Bounded { joint, limits, last, passed }
        });
        let joints = joints.filter(|joint| joint.limits.iter().any(|limit| limit.is_finite())).collect();
        Self { time: 0.0, joints }
    }

    /// Goes on to a later state.
    pub(crate) fn see(&mut self, time: f64, q: &[f64], v: &[f64]) {
        let length = time - self.time;
        for Bounded { joint, limits, last, passed } in &mut self.joints {
            let now = [q[joint.q], v[joint.v]];
            let way = Way { ends: [last[0], now[0]], rates: [last[1] * length, now[1] * length] };
            let stations = way.stations();
            if passed.is_none() {
                *passed = way.passes(&stations, *limits).map(|(part, limit)| {
                    let time = part.mul_add(length, self.time);
                    Passed { time: Some(time), limit, furthest: way.at(part) }
                });
            }
            if let Some(Passed { limit, furthest, .. }) = passed {
                for x in stations.iter().map(|part| way.at(*part)) {
                    *furthest = if *limit == Limit::Upper { furthest.max(x) } else { furthest.min(x) };
                }
            }
            *last = now;
        }
        self.time = time;
    }

    /// Says on standard error which joints passed a limit, in the order in which they did.
    pub(crate) fn tell(&self) {
        let mut said: Vec<_> =
            self.joints.iter().filter_map(|joint| Some((joint, joint.passed.as_ref()?))).collect();
        let time = |passed: &Passed| passed.time.unwrap_or(0.0);
        said.sort_by(|(_, one), (_, other)| time(one).total_cmp(&time(other)));
        let lines: String = said.into_iter().map(|(joint, passed)| joint.note(passed) + "\n").collect();
        // Nobody is left to be told that there is nobody to tell.
        let _ = std::io::stderr().write_all(lines.as_bytes());
    }
}

impl Bounded {
    fn note(&self, passed: &Passed) -> String {
        let Self { joint, limits: [lower, upper], .. } = self;
        let unit = if joint.measure == Measure::Angle { "rad" } else { "m" };
        let (side, limit) = match passed.limit {
            Limit::Lower => ("lower", lower),
            Limit::Upper => ("upper", upper),
        };
        let (begins, after) = match passed.time {
            None => ("begins beyond", String::new()),
            Some(time) => ("passes", format!(" after {} s", said(rounded(time)))),
        };
        // Where rounding would hide that it is beyond, it is not rounded.
        let short = rounded(passed.furthest);
        let furthest = said(if beyond(short, self.limits).is_some() { short } else { passed.furthest });
        let limit = said(*limit);
        format!(
            "`{}` {begins} its {side} limit of {limit} {unit}{after}, and comes to {furthest} {unit}: \
             a simulation has no stops",
            joint.name
        )
    }
}

/// The limit that a value is beyond, if it is beyond one.
fn beyond(x: f64, [lower, upper]: [f64; 2]) -> Option<Limit> {
    match () {
        () if x < lower => Some(Limit::Lower),
        () if x > upper => Some(Limit::Upper),
        () => None,
    }
}

/// So many halvings find the moment of a passage to the last bit.
const HALVINGS: usize = 53;

/// A coordinate from one moment to another, θ from 0 to 1: the cubic of its values, and of its rates by θ, at both.
///
/// So a joint that passes a limit and comes back between two states is seen. Its error goes with the fourth power of the
/// time between, as that of the steps.
struct Way {
    ends: [f64; 2],
    rates: [f64; 2],
}

impl Way {
    /// At both ends it has exactly their values.
    fn at(&self, part: f64) -> f64 {
        let (Self { ends: [from, to], rates: [first, second] }, rest) = (self, 1.0 - part);
        let way = to - from;
        rest * from + part * to + part * rest * (rest * (first - way) - part * (second - way))
    }

    /// Where it turns, in order, and its end: from one to the next it goes one way.
    fn stations(&self) -> Vec<f64> {
        let ([from, to], [first, second]) = (self.ends, self.rates);
        let way = to - from;
        // Its rate is a + 2bθ + cθ², with no difference of nearly equal roots.
        let (a, b, c) = (first, 3.0 * way - 2.0 * first - second, 3.0 * (first + second) - 6.0 * way);
        let root = (b * b - a * c).sqrt();
        let sum = -(b + root.copysign(b));
        let mut stations = vec![sum / c, a / sum];
        // What is no number is nowhere.
        stations.retain(|part| *part > 0.0 && *part < 1.0);
        stations.push(1.0);
        stations.sort_by(f64::total_cmp);
        stations
    }

    /// When it first passes one of two limits between which it begins, and which.
    fn passes(&self, stations: &[f64], limits: [f64; 2]) -> Option<(f64, Limit)> {
        let first = stations.iter().position(|part| beyond(self.at(*part), limits).is_some())?;
        let mut within = first.checked_sub(1).map_or(0.0, |before| stations[before]);
        let mut without = stations[first];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (within + without);
            match beyond(self.at(middle), limits) {
                None => within = middle,
                Some(_) => without = middle,
            }
        }
        beyond(self.at(without), limits).map(|limit| (without, limit))
    }
}
