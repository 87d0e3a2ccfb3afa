//! A phase portrait: where it begins, which way it goes, where it ends.

use crate::figure::Frame;
use crate::svg::{Page, path};
use crate::thin::thinned;

/// So many arrows are on a path.
const ARROWS: usize = 4;

pub(crate) fn draw(page: &mut Page, frame: &Frame, [q, v]: &[Vec<f64>; 2]) {
    let mut points: Vec<[f64; 2]> = vec![];
    for at in q.iter().zip(v).map(|(q, v)| frame.at([*q, *v])) {
        // Points that nobody could tell apart would take long to simplify.
        if points.last().is_none_or(|last| (at[0] - last[0]).hypot(at[1] - last[1]) > 0.2) {
            points.push(at);
        }
    }
    let thin = thinned(&points);
    page.line(&thin, "l s0", "");
    for (at, along) in arrows(&thin) {
        let [x, y] = at;
        let ([fx, fy], [sx, sy]) = ([along[0] * 9.0, along[1] * 9.0], [along[1] * 4.5, -along[0] * 4.5]);
        page.path(&(path(&[[x - fx + sx, y - fy + sy], [x, y], [x - fx - sx, y - fy - sy]]) + "Z"), "f0", "");
    }
    if let (Some(first), Some(last)) = (points.first(), points.last()) {
        page.dot(*first, 5.0, "b k s1");
        page.dot(*last, 5.0, "f1");
    }
    // What ring and dot are, beside the heading.
    let (right, y) = (frame.columns()[1], frame.rows()[0] - 8.0);
    page.text([right, y], "e", "end");
    page.dot([right - 32.0, y - 4.0], 4.0, "f1");
    page.text([right - 48.0, y], "e", "start");
    page.dot([right - 88.0, y - 4.0], 4.0, "b k s1");
}

/// Tips of arrows at equal lengths of the path, and the way it goes there.
fn arrows(points: &[[f64; 2]]) -> Vec<([f64; 2], [f64; 2])> {
    let steps = || points.windows(2).map(|ab| (ab[0], [ab[1][0] - ab[0][0], ab[1][1] - ab[0][1]]));
    let total: f64 = steps().map(|(_, d)| d[0].hypot(d[1])).sum();
    if total < 40.0 {
        return vec![];
    }
    // One turn of a swing is enough for arrows: more of them would lie on each other.
    let reach = total.min(1600.0);
    let mut found = vec![];
    let mut gone = 0.0;
    for (from, d) in steps() {
        let length = d[0].hypot(d[1]);
        while found.len() < ARROWS {
            let next = reach * (found.len() as f64 + 0.75) / ARROWS as f64;
            if next > gone + length {
                break;
            }
            let part = (next - gone) / length;
            found.push(([from[0] + part * d[0], from[1] + part * d[1]], [d[0] / length, d[1] / length]));
        }
        gone += length;
    }
    // A second turn may bring an arrow to one of the first.
    let far = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) > 60.0;
    let all = found.clone();
    let mut k = 0;
    found.retain(|(at, _)| {
        k += 1;
        all[..k - 1].iter().all(|(other, _)| far(*at, *other))
    });
    found
}
