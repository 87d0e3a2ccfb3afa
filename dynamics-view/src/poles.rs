//! Poles in their plane, on lines of equal damping and equal natural frequency.

use std::f64::consts::PI;

use crate::chart::{Plane, Poles};
use crate::figure::Frame;
use crate::scale::{padded, range};
use crate::style::{COLOURS, fill};
use crate::svg::{Page, path, px};
use crate::text::{SIZE, width};

/// The damping ratios that have a line.
const DAMPING: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];

/// The intervals of both axes, of equal scale for a rectangle of this `aspect`, width over height.
pub(crate) fn extent(plane: Plane, sets: &[Poles], aspect: f64) -> ([f64; 2], [f64; 2]) {
    let all = || sets.iter().flat_map(|set| set.values.iter().copied());
    let (x, y) = match plane {
        Plane::Continuous => {
            let size = all().map(|[re, im]| re.abs().max(im.abs())).fold(0.0, f64::max);
            let size = if size > 1e-90 { size } else { 1.0 };
            let x = range(all().map(|pole| pole[0]).chain([0.0, -0.25 * size, 0.2 * size]));
            (
                padded(x, 0.1),
                padded(
                    range(all().flat_map(|pole| [pole[1], -pole[1]]).chain([0.3 * size, -0.3 * size])),
                    0.12,
                ),
            )
        }
        Plane::Discrete => {
            let of = |part: usize| range(all().map(move |pole| pole[part]).chain([-1.0, 1.0]));
            (padded(of(0), 0.08), padded(of(1), 0.08))
        }
    };
    let wide = (x[1] - x[0]).max(aspect * (y[1] - y[0]));
    let about =
        |[low, high]: [f64; 2], length: f64| [(low + high - length) / 2.0, (low + high + length) / 2.0];
    (about(x, wide), about(y, wide / aspect))
}

pub(crate) fn draw(page: &mut Page, frame: &Frame, plane: Plane, sets: &[Poles]) {
    let ([left, right], [top, bottom]) = (frame.columns(), frame.rows());
    let clip = format!("c{}-{}", px(left), px(top)).replace('.', "_");
    let (w, h) = (px(right - left), px(bottom - top));
    let rectangle = format!(r#"x="{}" y="{}" width="{w}" height="{h}""#, px(left), px(top));
    page.put(&format!(r#"<clipPath id="{clip}"><rect {rectangle}/></clipPath><g clip-path="url(#{clip})">"#));
    let mut taken = Taken::default();
    for pole in sets.iter().flat_map(|set| &set.values) {
        let [x, y] = frame.at(*pole);
        taken.boxes.push([x - 8.0, y - 8.0, x + 8.0, y + 8.0]);
    }
    match plane {
        Plane::Continuous => continuous(page, frame, &mut taken),
        Plane::Discrete => discrete(page, frame, &mut taken),
    }
    page.put("</g>");
    for (k, set) in sets.iter().enumerate() {
        for (pole, count) in counted(frame, &set.values) {
            let [x, y] = frame.at(pole);
            let cross = path(&[[x - 5.0, y - 5.0], [x + 5.0, y + 5.0]])
                + &path(&[[x + 5.0, y - 5.0], [x - 5.0, y + 5.0]]);
            page.path(&cross, &format!("l k s{}", k % COLOURS), &said(plane, set, pole));
            let label = if count > 1 { format!("{count}×") } else { continue };
            let places =
                [[x + 12.0, y - 7.0], [x + 12.0, y + 15.0], [x - 12.0 - width(&label, SIZE), y - 7.0]];
            if let Some(at) = places.into_iter().find(|at| taken.take(*at, &label)) {
                page.text(at, &format!("{} halo", fill(k)), &label);
            }
        }
    }
    // The names of the sets, above the right end.
    let mut x = right;
    for (k, set) in sets.iter().enumerate().rev() {
        let y = top - 8.0;
        page.text([x, y], &format!("e {}", fill(k)), &set.name);
        x -= width(&set.name, SIZE) + 10.0;
        let cross = path(&[[x - 4.0, y - 8.0], [x + 4.0, y]]) + &path(&[[x + 4.0, y - 8.0], [x - 4.0, y]]);
        page.path(&cross, &format!("l k s{}", k % COLOURS), "");
        x -= 22.0;
    }
}

/// What the mouse is told of a pole.
fn said(plane: Plane, set: &Poles, [re, im]: [f64; 2]) -> String {
    let size = re.hypot(im);
    let number = format!("{}: {re:.4} ± {:.4}i", set.name, im.abs());
    match plane {
        Plane::Continuous if size > 0.0 => {
            format!("{number}; natural frequency {size:.4} rad/s, damping ratio {:.4}", -re / size)
        }
        Plane::Continuous => number,
        Plane::Discrete => format!("{number}; size {size:.4}"),
    }
}

/// Poles that fall into one place, and how many.
fn counted(frame: &Frame, poles: &[[f64; 2]]) -> Vec<([f64; 2], usize)> {
    let mut found: Vec<([f64; 2], usize)> = vec![];
    for pole in poles {
        let [x, y] = frame.at(*pole);
        let is_there = |(other, _): &&mut ([f64; 2], usize)| {
            let [a, b] = frame.at(*other);
            (a - x).hypot(b - y) < 2.5
        };
        match found.iter_mut().find(is_there) {
            Some((_, count)) => *count += 1,
            None => found.push((*pole, 1)),
        }
    }
    found
}

/// Labels and poles that are drawn already.
#[derive(Default)]
struct Taken {
    boxes: Vec<[f64; 4]>,
}

impl Taken {
    /// Takes the place of a text whose baseline begins at a point, if it is free.
    fn take(&mut self, [x, y]: [f64; 2], text: &str) -> bool {
        let own = [x - 3.0, y - SIZE, x + width(text, SIZE) + 3.0, y + 4.0];
        let meets = |other: &[f64; 4]| {
            own[0] < other[2] && other[0] < own[2] && own[1] < other[3] && other[1] < own[3]
        };
        if self.boxes.iter().any(meets) {
            return false;
        }
        self.boxes.push(own);
        true
    }
}

/// The unstable half is tinted; rays of equal damping, circles of equal natural frequency.
fn continuous(page: &mut Page, frame: &Frame, taken: &mut Taken) {
    let ([left, right], [top, bottom]) = (frame.columns(), frame.rows());
    let [x, y] = frame.at([0.0, 0.0]);
    page.put(&format!(
        r#"<rect x="{}" y="{}" width="{}" height="{}" class="t"/>"#,
        px(x),
        px(top),
        px((right - x).max(0.0)),
        px(bottom - top)
    ));
    let unit = frame.x.at(1.0) - x;
    let far = (x - left).hypot(bottom - top);
    for radius in frame.x_ticks.values.iter().filter(|value| **value < 0.0).map(|value| -value * unit) {
        page.path(
            &format!(
                "M{} {}A{r} {r} 0 0 0 {} {}",
                px(x),
                px(y - radius),
                px(x),
                px(y + radius),
                r = px(radius)
            ),
            "g",
            "",
        );
    }
    page.line(&[[x, top], [x, bottom]], "a", "");
    page.line(&[[left, y], [right, y]], "a", "");
    for ratio in DAMPING {
        let way = [-ratio, (1.0 - ratio * ratio).sqrt()];
        for sign in [-1.0, 1.0] {
            page.line(&[[x, y], [x + far * way[0], y + sign * far * way[1]]], "g x", "");
        }
        // Where the upper ray leaves, just within.
        let label = format!("ζ = {ratio}");
        let long = width(&label, SIZE);
        let reach = ((x - left - 6.0) / -way[0]).abs().min((y - top - 16.0) / way[1]);
        let end = [x + reach * way[0], y - reach * way[1]];
        let at =
            [(end[0] - long / 2.0).clamp(left + 4.0, (right - long - 4.0).max(left + 4.0)), end[1] + 4.0];
        if reach > 40.0 && taken.take(at, &label) {
            page.text(at, "halo", &label);
        }
    }
    let label = "unstable";
    let at = [x + 8.0, bottom - 8.0];
    if right - x > width(label, SIZE) + 16.0 && taken.take(at, label) {
        page.text(at, "halo", label);
    }
}

/// Outside of the unit circle is tinted; curves of equal damping within.
fn discrete(page: &mut Page, frame: &Frame, taken: &mut Taken) {
    let ([left, right], [top, bottom]) = (frame.columns(), frame.rows());
    let [x, y] = frame.at([0.0, 0.0]);
    let radius = px(frame.x.at(1.0) - x);
    let circle = format!("M{} {}a{radius} {radius} 0 1 0 .1 0z", px(x), px(frame.y.at(1.0)));
    let outside = path(&[[left, top], [right, top], [right, bottom], [left, bottom]]) + "Z";
    page.put(&format!(r#"<path d="{outside}{circle}" class="t" fill-rule="evenodd"/>"#));
    page.line(&[[x, top], [x, bottom]], "a", "");
    page.line(&[[left, y], [right, y]], "a", "");
    for ratio in DAMPING {
        let slope = ratio / f64::sqrt(1.0 - ratio * ratio);
        let curve = |sign: f64| -> Vec<[f64; 2]> {
            let at = |k: u32| {
                let angle = PI * f64::from(k) / 48.0;
                let size = (-slope * angle).exp();
                frame.at([size * angle.cos(), sign * size * angle.sin()])
            };
            (0..=48).map(at).collect()
        };
        for sign in [-1.0, 1.0] {
            page.line(&curve(sign), "g x", "");
        }
        let label = format!("ζ = {ratio}");
        let top_of = curve(1.0).into_iter().min_by(|a, b| a[1].total_cmp(&b[1])).unwrap_or([x, y]);
        let at = [top_of[0] - width(&label, SIZE) / 2.0, top_of[1] + 4.0];
        if taken.take(at, &label) {
            page.text(at, "halo", &label);
        }
    }
    page.path(&circle, "n", "the unit circle");
    let at = [left + 6.0, bottom - 8.0];
    if taken.take(at, "unstable") {
        page.text(at, "halo", "unstable");
    }
}
