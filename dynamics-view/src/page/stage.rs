//! The robot of a page: moved by hand through its linkage, or by a motion that was recorded.

use serde_json::{Value, json};

use super::html::Html;
use crate::chart::{Chart, check_times};
use crate::embed::{lines, written};
use crate::encode::{numbers, varying};
use crate::error::{Error, check_length, check_numbers};
use crate::figure::Figure;
use crate::linkage::{Linkage, entries};
use crate::scene::{Body, Scene};

/// A robot that stands on a page.
#[derive(Clone, Debug)]
pub struct Stage {
    /// What is drawn of it.
    pub scene: Scene,
    /// How its coordinates move it.
    pub linkage: Linkage,
    /// What the reader takes hold of.
    pub handles: Vec<Handle>,
    /// The configuration in which it opens.
    pub start: Vec<f64>,
    /// The times of a motion, s: one at least.
    pub times: Vec<f64>,
    /// The configuration at each.
    pub motion: Vec<Vec<f64>>,
    /// Charts of the motion.
    pub charts: Vec<Chart>,
    /// The body whose place is read out, and whose path is drawn.
    pub tip: Option<String>,
}

/// A coordinate, or a quaternion and what is before it, that the reader can change.
#[derive(Clone, Debug, PartialEq)]
pub struct Handle {
    /// What it is called.
    pub name: String,
    /// The index of its (first) coordinate.
    pub q: usize,
    /// What it is.
    pub kind: HandleKind,
    /// Between which numbers it goes: rad, or m; of a free joint, its position.
    pub range: [f64; 2],
}

/// What a reader can change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HandleKind {
    /// An angle, rad.
    Angle,
    /// A distance, m.
    Distance,
    /// A quaternion i, j, k, w.
    Ball,
    /// A position and a quaternion.
    Free,
}

/// Charts without script are this wide, in pixels.
const STILL: f64 = 560.0;

impl Stage {
    fn check(&self) -> Result<(), Error> {
        let Scene { name, bodies } = &self.scene;
        if bodies.is_empty() || self.times.is_empty() {
            return Err(Error::Empty { what: format!("the robot `{name}`") });
        }
        self.scene.order()?;
        bodies.iter().try_for_each(Body::check)?;
        check_length("the list of mounts", bodies.len(), self.linkage.mounts.len())?;
        self.linkage.check(self.start.len())?;
        check_times(&self.times)?;
        check_numbers("the configuration at the start", self.start.iter().copied())?;
        check_length("the motion", self.times.len(), self.motion.len())?;
        for (q, time) in self.motion.iter().zip(&self.times) {
            check_length(&format!("the configuration at {time} s"), self.start.len(), q.len())?;
            check_numbers(&format!("the configuration at {time} s"), q.iter().copied())?;
        }
        for Handle { name, q, kind, range } in &self.handles {
            let count = match kind {
                HandleKind::Angle | HandleKind::Distance => 1,
                HandleKind::Ball => 4,
                HandleKind::Free => 7,
            };
            check_numbers(&format!("the range of `{name}`"), range.iter().copied())?;
            if q + count > self.start.len() {
                let what = format!("the configuration, of which `{name}` needs {} numbers,", q + count);
                return Err(Error::LengthsDiffer { what, expected: q + count, found: self.start.len() });
            }
        }
        self.charts.iter().try_for_each(Chart::check)
    }

    /// What the page's script is given.
    pub(super) fn data(&self) -> Result<Value, Error> {
        self.check()?;
        let bodies = self.scene.bodies.iter().zip(&self.linkage.mounts).map(|(body, mount)| {
            let mut own = written(body);
            own.insert("parent", json!(body.parent));
            own.insert("link", json!(mount.link));
            own.insert("at", json!(entries(&mount.pose)));
            json!(own)
        });
        let tip = match &self.tip {
            None => Value::Null,
            Some(name) => {
                let at = self.scene.bodies.iter().position(|body| body.name == *name);
                json!(at.ok_or_else(|| Error::BodyUnknown { name: name.clone() })?)
            }
        };
        let row = |k: usize| {
            let values: Vec<f64> = self.motion.iter().map(|q| q[k]).collect();
            Value::Object(varying(&values).into_iter().map(|(key, value)| (key.to_owned(), value)).collect())
        };
        let handle = |handle: &Handle| {
            let kind = match handle.kind {
                HandleKind::Angle => "angle",
                HandleKind::Distance => "distance",
                HandleKind::Ball => "ball",
                HandleKind::Free => "free",
            };
            let [low, high] = handle.range;
            json!({ "name": handle.name, "q": handle.q, "kind": kind, "low": low, "high": high })
        };
        let charts = self.charts.iter().filter_map(|chart| lines(chart, &self.times));
        Ok(json!({
            "name": self.scene.name,
            "count": self.times.len(),
            "time": numbers(&self.times),
            "q": (0..self.start.len()).map(row).collect::<Vec<_>>(),
            "start": self.start,
            "links": self.linkage.data(),
            "bodies": bodies.collect::<Vec<_>>(),
            "handles": self.handles.iter().map(handle).collect::<Vec<_>>(),
            "trace": tip,
            "charts": charts.collect::<Vec<_>>(),
        }))
    }

    /// The robot and what moves it.
    pub(super) fn write_bench(&self, html: &mut Html) {
        html.put(BENCH);
    }

    /// The robot once more, small, with its time and its charts.
    pub(super) fn write_swing(&self, html: &mut Html) -> Result<(), Error> {
        html.put(SWING);
        html.put(r#"<div class="still">"#);
        for chart in &self.charts {
            let figure = Figure::new("").with(chart.clone()).wide(STILL);
            html.put(&figure.fragment("a chart over time")?);
        }
        html.put("</div>");
        Ok(())
    }
}

const BENCH: &str = include_str!("../../viewer/bench.html");
const SWING: &str = include_str!("../../viewer/swing.html");
