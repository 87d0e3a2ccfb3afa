//! Charts one below the other, on one page.

use crate::chart::{Chart, Kind, Plane};
use crate::error::Error;
use crate::scale::{Scale, Ticks, padded, range};
use crate::svg::Page;
use crate::text::{SIZE, shortened, width};
use crate::{lines, phase, poles, style};

/// The usual width of the page, and the widest names beside it, in pixels.
const WIDTH: f64 = 720.0;
const WIDEST_NAME: f64 = 170.0;
/// Around everything; of a chart's heading; of ticks with the axis' name; between charts.
const EDGE: f64 = 16.0;
const HEADING: f64 = 25.0;
const FOOT: f64 = 38.0;
const GAP: f64 = 15.0;
/// Between two labels, from baseline to baseline.
pub(crate) const ROW: f64 = 14.0;

/// Charts with a title. Same input, same bytes.
///
/// # Example
///
/// ```
/// use dynamics_view::{Chart, Figure};
///
/// let times: Vec<f64> = (0..=200).map(|k| 0.01 * f64::from(k)).collect();
/// let angle = Chart::over_time("angle", "rad", &times).line("theta", times.iter().map(|t| 0.1 * (4.4 * t).cos()));
/// let svg = Figure::new("A small swing").with(angle).svg()?;
/// assert!(svg.starts_with("<svg"));
/// # Ok::<(), dynamics_view::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Figure {
    title: String,
    charts: Vec<Chart>,
    width: f64,
}

/// Where a chart is on the page: the rectangle of its axes, and what is on them.
pub(crate) struct Frame {
    pub(crate) x: Scale,
    pub(crate) y: Scale,
    pub(crate) x_ticks: Ticks,
    pub(crate) y_ticks: Ticks,
}

impl Frame {
    /// The place of a pair of numbers.
    pub(crate) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x.at(x), self.y.at(y)]
    }

    /// Left and right.
    pub(crate) fn columns(&self) -> [f64; 2] {
        self.x.pixels
    }

    /// Top and bottom.
    pub(crate) fn rows(&self) -> [f64; 2] {
        [self.y.pixels[1], self.y.pixels[0]]
    }
}

impl Figure {
    /// An empty page with a title, or without one.
    #[must_use]
    pub fn new(title: &str) -> Self {
        Self { title: title.to_owned(), charts: vec![], width: WIDTH }
    }

    /// With a chart below those before it.
    #[must_use]
    pub fn with(mut self, chart: Chart) -> Self {
        self.charts.push(chart);
        self
    }

    /// With several charts.
    #[must_use]
    pub fn with_all(mut self, charts: impl IntoIterator<Item = Chart>) -> Self {
        self.charts.extend(charts);
        self
    }

    /// On a page of this width, in pixels; without it, of 720.
    #[must_use]
    pub fn wide(mut self, width: f64) -> Self {
        self.width = width;
        self
    }

    /// The charts.
    #[must_use]
    pub fn charts(&self) -> &[Chart] {
        &self.charts
    }

    /// The page as SVG, which follows the reader's choice of light or dark.
    ///
    /// # Errors
    ///
    /// [`Error::Empty`], [`Error::LengthsDiffer`], [`Error::NotDrawable`] and [`Error::TimesNotIncreasing`], of the
    /// first chart that cannot be drawn.
    pub fn svg(&self) -> Result<String, Error> {
        let (page, size) = self.drawn()?;
        Ok(page.document(size, &self.title, &(style::PALETTE.to_owned() + style::CHART)))
    }

    /// The same as a part of HTML, which has the style; `title` is for those who do not see it.
    pub(crate) fn fragment(&self, title: &str) -> Result<String, Error> {
        let (page, size) = self.drawn()?;
        Ok(page.fragment(size, title))
    }

    fn drawn(&self) -> Result<(Page, [f64; 2]), Error> {
        if self.charts.is_empty() {
            return Err(Error::Empty { what: format!("the figure `{}`", self.title) });
        }
        self.charts.iter().try_for_each(Chart::check)?;
        let left = self.charts.iter().map(tick_width).fold(0.0, f64::max) + EDGE + 8.0;
        let names = self.charts.iter().map(name_width).fold(0.0, f64::max);
        let right = self.width - if names > 0.0 { names + lines::LEADER + EDGE } else { EDGE + 8.0 };

        let mut page = Page::default();
        let mut top = 4.0;
        if !self.title.is_empty() {
            top = EDGE + 15.0;
            page.text([EDGE, top], "h", &shortened(&self.title, 15.0, self.width - 2.0 * EDGE));
            top += 12.0;
        }
        for (k, chart) in self.charts.iter().enumerate() {
            let next = self.charts.get(k + 1);
            let has_foot = next.is_none_or(|next| !shares_time(chart, next));
            let height = height(chart, [left, right]);
            top += HEADING;
            let frame = frame(chart, [left, right], [top, top + height]);
            heading(&mut page, chart, &frame);
            match &chart.kind {
                Kind::OverTime { times, lines } => lines::draw(&mut page, &frame, times, lines),
                Kind::Phase { points, .. } => phase::draw(&mut page, &frame, points),
                Kind::Poles { plane, sets } => poles::draw(&mut page, &frame, *plane, sets),
            }
            if has_foot {
                foot(&mut page, chart, &frame);
            }
            top += height + if has_foot { FOOT } else { 0.0 } + if next.is_some() { GAP } else { 0.0 };
        }
        Ok((page, [self.width, top + 8.0]))
    }
}

/// Whether two charts are over the same times: then the lower one has the ticks of both.
fn shares_time(one: &Chart, other: &Chart) -> bool {
    match (&one.kind, &other.kind) {
        (Kind::OverTime { times: a, .. }, Kind::OverTime { times: b, .. }) => {
            (a.first(), a.last()) == (b.first(), b.last())
        }
        _ => false,
    }
}

/// The heights that all charts have, or those of more names than there is room for.
fn height(chart: &Chart, [left, right]: [f64; 2]) -> f64 {
    match &chart.kind {
        Kind::OverTime { lines, .. } => f64::max(132.0, ROW * lines.len().min(lines::NAMED) as f64),
        Kind::Phase { .. } => 300.0,
        Kind::Poles { .. } => (right - left).min(380.0),
    }
}

fn name_width(chart: &Chart) -> f64 {
    let Kind::OverTime { lines, .. } = &chart.kind else { return 0.0 };
    lines.iter().map(|line| width(&shortened(&line.name, SIZE, WIDEST_NAME), SIZE)).fold(0.0, f64::max)
}

/// A name that has room beside the charts.
pub(crate) fn name_beside(name: &str) -> String {
    shortened(name, SIZE, WIDEST_NAME)
}

fn tick_width(chart: &Chart) -> f64 {
    let frame = frame(chart, [0.0, 500.0], [0.0, height(chart, [0.0, 500.0])]);
    frame.y_ticks.labels.iter().map(|label| width(label, SIZE)).fold(0.0, f64::max)
}

/// The axes of a chart in a rectangle.
fn frame(chart: &Chart, [left, right]: [f64; 2], [top, bottom]: [f64; 2]) -> Frame {
    let (x, y) = match &chart.kind {
        Kind::OverTime { times, lines } => {
            let ends = [times[0], times[times.len() - 1]];
            let x = if ends[1] > ends[0] { ends } else { [ends[0] - 0.5, ends[0] + 0.5] };
            (x, padded(range(lines.iter().flat_map(|line| line.values.iter().copied())), 0.06))
        }
        Kind::Phase { points, .. } => {
            let [q, v] = points.each_ref().map(|values| padded(range(values.iter().copied()), 0.06));
            (q, v)
        }
        Kind::Poles { plane, sets } => poles::extent(*plane, sets, (right - left) / (bottom - top)),
    };
    // The last tick's label may reach beyond the axis by half its width.
    let x_ticks = Ticks::within(x, ((right - left) / 80.0).floor());
    let y_ticks = Ticks::within(y, ((bottom - top) / 34.0).floor());
    Frame {
        x: Scale { numbers: x, pixels: [left, right] },
        y: Scale { numbers: y, pixels: [bottom, top] },
        x_ticks,
        y_ticks,
    }
}

/// What the vertical axis has, above it, and its ticks with their lines.
fn heading(page: &mut Page, chart: &Chart, frame: &Frame) {
    let ([left, right], [top, bottom]) = (frame.columns(), frame.rows());
    let unit = match &chart.kind {
        Kind::Poles { plane: Plane::Continuous, .. } => {
            format!("imaginary part, {}", frame.y_ticks.unit("rad/s"))
        }
        Kind::Poles { .. } => "imaginary part".to_owned(),
        _ => frame.y_ticks.unit(&chart.unit),
    };
    let separator = if unit.is_empty() { "" } else { ", " };
    let text = format!("{}{separator}{unit}", chart.quantity);
    page.text([EDGE, top - 8.0], "q", &shortened(&text, SIZE, right - EDGE));
    for (value, label) in frame.y_ticks.values.iter().zip(&frame.y_ticks.labels) {
        let y = frame.y.at(*value);
        let classes = if *value == 0.0 { "a" } else { "g" };
        page.line(&[[left, y], [right, y]], classes, "");
        page.text([left - 8.0, y + 4.0], "e", label);
    }
    for value in &frame.x_ticks.values {
        let x = frame.x.at(*value);
        page.line(&[[x, top], [x, bottom]], "g", "");
    }
    page.line(&[[left, bottom], [right, bottom]], "a", "");
}

/// What is below the horizontal axis.
fn foot(page: &mut Page, chart: &Chart, frame: &Frame) {
    let (right, bottom) = (frame.columns()[1], frame.rows()[1]);
    for (value, label) in frame.x_ticks.values.iter().zip(&frame.x_ticks.labels) {
        let x = frame.x.at(*value);
        page.line(&[[x, bottom], [x, bottom + 4.0]], "a", "");
        page.text([x, bottom + 17.0], "m", label);
    }
    let (name, unit) = match &chart.kind {
        Kind::OverTime { .. } => ("time", "s"),
        Kind::Phase { x, x_unit, .. } => (x.as_str(), x_unit.as_str()),
        Kind::Poles { plane: Plane::Continuous, .. } => ("real part", "1/s"),
        Kind::Poles { plane: Plane::Discrete, .. } => ("real part", ""),
    };
    let unit = frame.x_ticks.unit(unit);
    let separator = if unit.is_empty() { "" } else { ", " };
    page.text([right, bottom + 33.0], "e", &format!("{name}{separator}{unit}"));
}
