//! Lines over time, each with its name at its end.

use crate::chart::Line;
use crate::figure::{Frame, ROW, name_beside};
use crate::labels::apart;
use crate::style::{fill, stroke};
use crate::svg::Page;
use crate::thin::thinned;

/// From the end of a line to its name.
pub(crate) const LEADER: f64 = 22.0;
/// So many lines have a name; what is beyond would be read by nobody.
pub(crate) const NAMED: usize = 40;

pub(crate) fn draw(page: &mut Page, frame: &Frame, times: &[f64], lines: &[Line]) {
    let ([_, right], [top, bottom]) = (frame.columns(), frame.rows());
    // The first one is drawn last: it lies on top.
    for (k, line) in lines.iter().enumerate().rev() {
        let points: Vec<_> =
            times.iter().zip(&line.values).map(|(t, value)| frame.at([*t, *value])).collect();
        let classes = if k < NAMED { stroke(k) } else { "l g".to_owned() };
        match points.as_slice() {
            [only] => page.dot(*only, 3.0, &fill(k)),
            points => page.line(&thinned(points), &classes, &line.name),
        }
    }
    let named = &lines[..lines.len().min(NAMED)];
    let ends: Vec<f64> = named.iter().filter_map(|line| Some(frame.y.at(*line.values.last()?))).collect();
    let places = apart(&ends, ROW, [top + 2.0, bottom - 2.0]);
    for (k, ((line, end), place)) in named.iter().zip(&ends).zip(&places).enumerate() {
        let at = right + LEADER - 4.0;
        if times.len() > 1 {
            let leader = [[right + 2.0, *end], [right + 6.0, *end], [at - 6.0, *place], [at - 3.0, *place]];
            page.line(&leader, &format!("n s{}", k % crate::style::COLOURS), "");
        }
        page.text([at, place + 4.0], &fill(k), &name_beside(&line.name));
    }
}
