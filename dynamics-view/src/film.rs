//! An animation: the poses of a scene over time, in one HTML file.

use dynamics_core::Pose;
use serde_json::{Value, json};

use crate::chart::{Chart, check_times};
use crate::embed::{embedded, filled, lines, script, written};
use crate::encode::{numbers, quantum, row};
use crate::error::{Error, check_length, check_numbers};
use crate::scene::{Body, Scene};
use crate::{style, svg};

/// Quaternions are rounded to this.
const TURN: f64 = 1e-5;
/// A body that moves less than this against the one that carries it is welded to it, m and without unit.
const STILL: f64 = 1e-9;

const PAGE: &str = include_str!("../viewer/page.html");
const STYLE: [&str; 3] =
    [style::PALETTE, include_str!("../viewer/stage.css"), include_str!("../viewer/style.css")];
/// What the script has that is of films alone; the rest is shared with pages.
const OF_FILMS: [&str; 2] = [include_str!("../viewer/film.js"), include_str!("../viewer/main.js")];

/// A scene that moves: poses of all its bodies, frame by frame, and charts beside them. Same input, same bytes.
///
/// The page plays, winds and turns, by mouse, touch and keys; it asks no network for anything. Between frames it goes
/// the straight way, so that 60 frames a second are plenty, and 20 do.
///
/// # Example
///
/// ```
/// use dynamics_core::Pose;
/// use dynamics_view::{Body, Film, Scene};
///
/// let ball = Body { name: "ball".into(), mass: 0.1, ..Body::default() };
/// let mut film = Film::new(Scene { name: "A ball that falls".into(), bodies: vec![ball] });
/// for k in 0..=30 {
///     let t = f64::from(k) / 60.0;
///     let mut pose = Pose::identity();
///     pose.translation[2] = 2.0 - 0.5 * 9.81 * t * t;
///     film.push(t, vec![pose]);
/// }
/// let html = film.html()?;
/// assert!(html.starts_with("<!doctype html>"));
/// # Ok::<(), dynamics_view::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Film {
    scene: Scene,
    times: Vec<f64>,
    poses: Vec<Vec<Pose<f64>>>,
    charts: Vec<Chart>,
    trace: Option<String>,
}

impl Film {
    /// No frames yet.
    #[must_use]
    pub fn new(scene: Scene) -> Self {
        Self { scene, times: vec![], poses: vec![], charts: vec![], trace: None }
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// One more frame: the poses in the world of all bodies, in their order, at a time in s after those before it.
    pub fn push(&mut self, time: f64, poses: Vec<Pose<f64>>) {
        self.times.push(time);
        self.poses.push(poses);
    }

    /// With charts below, whose cursor is the time; those over time are drawn, others left out.
    #[must_use]
    pub fn with_charts(mut self, charts: impl IntoIterator<Item = Chart>) -> Self {
        self.charts.extend(charts);
        self
    }

    /// With the path of a body's origin.
    #[must_use]
    pub fn tracing(mut self, body: &str) -> Self {
        self.trace = Some(body.to_owned());
        self
    }

    /// The page.
    ///
    /// # Errors
    ///
    /// [`Error::Empty`] without bodies or frames; [`Error::LengthsDiffer`] for a frame with too many or too few poses;
    /// [`Error::NotDrawable`], [`Error::TimesNotIncreasing`], [`Error::BodyUnconnected`], [`Error::BodyUnknown`]; those
    /// of [`Figure::svg`](crate::Figure::svg) for the charts.
    pub fn html(&self) -> Result<String, Error> {
        self.check()?;
        let parts = [
            ("{title}", svg::escaped(&self.scene.name)),
            ("{style}", STYLE.concat()),
            ("{script}", script(OF_FILMS)),
            ("{data}", embedded(&self.data()?)),
        ];
        Ok(filled(PAGE, &parts))
    }

    fn check(&self) -> Result<(), Error> {
        let Scene { name, bodies } = &self.scene;
        if bodies.is_empty() || self.times.is_empty() {
            return Err(Error::Empty { what: format!("the animation of `{name}`") });
        }
        check_times(&self.times)?;
        self.scene.order()?;
        bodies.iter().try_for_each(Body::check)?;
        for (poses, time) in self.poses.iter().zip(&self.times) {
            check_length(&format!("the frame at {time} s"), bodies.len(), poses.len())?;
            for (pose, body) in poses.iter().zip(bodies) {
                let entries = pose.translation.iter().chain(pose.rotation.iter()).copied();
                check_numbers(&format!("the pose of `{}` at {time} s", body.name), entries)?;
            }
        }
        self.charts.iter().try_for_each(Chart::check)
    }

    fn data(&self) -> Result<Value, Error> {
        let order = self.scene.order()?;
        let place = |body: usize| order.iter().position(|k| *k == body);
        let size = self.poses.iter().flatten().flat_map(|pose| pose.translation.iter().map(|x| x.abs()));
        let unit = quantum(size.fold(0.0, f64::max)).min(1e-3);
        let parent = |body: &Body| body.parent.and_then(place);
        let written = |k: &usize| self.body(*k, parent(&self.scene.bodies[*k]), unit);
        let bodies: Vec<Value> = order.iter().map(written).collect();
        let trace = match &self.trace {
            None => Value::Null,
            Some(name) => {
                let at = self.scene.bodies.iter().position(|body| body.name == *name);
                json!(place(at.ok_or_else(|| Error::BodyUnknown { name: name.clone() })?))
            }
        };
        let charts: Vec<Value> = self.charts.iter().filter_map(|chart| lines(chart, &self.times)).collect();
        Ok(json!({
            "name": self.scene.name,
            "count": self.times.len(),
            "time": numbers(&self.times),
            "unit": unit,
            "turn": TURN,
            "bodies": bodies,
            "trace": trace,
            "charts": charts,
        }))
    }

    fn body(&self, k: usize, parent: Option<usize>, unit: f64) -> Value {
        let body = &self.scene.bodies[k];
        let places = self.places(k);
        let of =
            |entry: usize| row(places.iter().map(|place| place[entry]), if entry < 3 { unit } else { TURN });
        let mut entries = written(body);
        entries.insert("parent", json!(parent));
        entries.insert("place", json!((0..7).map(of).collect::<Vec<_>>()));
        json!(entries)
    }

    /// Positions and quaternions of a body in the frame of the one that carries it, over all frames.
    fn places(&self, k: usize) -> Vec<[f64; 7]> {
        let parent = self.scene.bodies[k].parent;
        let mut places: Vec<[f64; 7]> = vec![];
        for poses in &self.poses {
            let own = poses[k];
            let Pose { rotation, translation } = parent.map_or(own, |parent| poses[parent].inverse() * own);
            let mut turn = quaternion(|row, column| rotation[(row, column)]);
            // q and −q are one rotation: the one that is nearer to the last.
            let along = places.last().map_or(1.0, |last| (0..4).map(|c| last[3 + c] * turn[c]).sum::<f64>());
            if along < 0.0 {
                turn = turn.map(|x| -x);
            }
            let [i, j, k, w] = turn;
            places.push([translation[0], translation[1], translation[2], i, j, k, w]);
        }
        let first = places[0];
        let moves = |place: &[f64; 7]| place.iter().zip(first).any(|(x, first)| (x - first).abs() > STILL);
        if !places.iter().any(moves) {
            places.fill(first);
        }
        places
    }
}

/// The quaternion i, j, k, w of a rotation, by S. Shepperd's method (1978): it divides by the largest entry.
fn quaternion(r: impl Fn(usize, usize) -> f64) -> [f64; 4] {
    let trace = r(0, 0) + r(1, 1) + r(2, 2);
    let squares = [r(0, 0), r(1, 1), r(2, 2), trace];
    let largest = (0..4).fold(3, |best, k| if squares[k] > squares[best] { k } else { best });
    let turn = if largest == 3 {
        [r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1), 1.0 + trace]
    } else {
        let (i, j, k) = (largest, (largest + 1) % 3, (largest + 2) % 3);
        let mut turn = [0.0; 4];
        turn[i] = 1.0 + r(i, i) - r(j, j) - r(k, k);
        turn[j] = r(j, i) + r(i, j);
        turn[k] = r(k, i) + r(i, k);
        turn[3] = r(k, j) - r(j, k);
        turn
    };
    let norm = turn.iter().fold(0.0, |norm: f64, x| norm.hypot(*x));
    if norm > 0.0 { turn.map(|x| x / norm) } else { [0.0, 0.0, 0.0, 1.0] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quaternions_turn_as_their_matrices_do() {
        let (s, c) = (0.3_f64.sin(), 0.3_f64.cos());
        let about_z = [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]];
        let half = [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]];
        let found = quaternion(|i, j| about_z[i][j]);
        let expected = [0.0, 0.0, 0.15_f64.sin(), 0.15_f64.cos()];
        assert!(found.iter().zip(expected).all(|(x, y)| (x - y).abs() < 1e-15), "{found:?}");
        assert_eq!(quaternion(|i, j| half[i][j]), [0.0, 1.0, 0.0, 0.0]);
    }
}
