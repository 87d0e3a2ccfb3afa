//! The race as a picture: a line for each output of each robot, a dot for each contestant, time on a logarithmic scale.

use std::fmt::Write as _;

use crate::tables::Row;

/// With the classes of their dots.
const CONTESTANTS: [(&str, &str); 3] = [("Pinocchio", "p"), ("CasADi", "c"), ("ours", "o")];
/// Light and dark, for those who see no red or no green too; the colours of `dynamics-view`.
const STYLE: &str = "\
svg{font:11px system-ui,sans-serif;fill:#1c2126;stroke:none}.paper{fill:#fff}.grid{stroke:#e6e9ec}.line{stroke:#b4bcc4}\
.bound{stroke:#1c2126;stroke-width:1.5}.e{text-anchor:end}.m{text-anchor:middle}.r{font-weight:600}\
.p{fill:#c04a00}.c{fill:#2f7550}.o{fill:#0443c2}
@media(prefers-color-scheme:dark){svg{fill:#e8ebee}.paper{fill:#14181c}.grid{stroke:#2a3138}.line{stroke:#5a646e}\
.bound{stroke:#e8ebee}.p{fill:#f58256}.c{fill:#3fe0a4}.o{fill:#5ba0ff}}";
/// Where the scale begins and ends, and the first line; in pixels.
const LEFT: f64 = 170.0;
const RIGHT: f64 = 770.0;
const TOP: f64 = 56.0;
const LINE: f64 = 14.0;
/// Between robots.
const GAP: f64 = 8.0;

/// The chart as SVG.
pub(crate) fn svg(rows: &[Row]) -> String {
    let known = rows.iter().flat_map(|row| row.nanoseconds).flatten();
    let (least, most) = known.fold((f64::INFINITY, 1.0_f64), |(a, b), time| (a.min(time), b.max(time)));
    let decades = least.log10().floor() as i32..=most.log10().ceil() as i32;
    let span = f64::from(decades.end() - decades.start()).max(1.0);
    let place = |time: f64| LEFT + (time.log10() - f64::from(*decades.start())) / span * (RIGHT - LEFT);
    let mut lines = String::new();
    let mut y = TOP;
    let mut robot = "";
    for row in rows {
        if row.robot != robot {
            robot = &row.robot;
            y += GAP;
            let _ = writeln!(lines, r#"<text x="8" y="{}" class="r">{robot}</text>"#, y + 4.0);
        }
        line(&mut lines, row, y, place);
        y += LINE;
    }
    let (width, height) = (RIGHT + 30.0, y + 8.0);
    let mut text = format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}">
<style>
{STYLE}
</style>
<rect width="100%" height="100%" class="paper"/>
"##
    );
    for (k, (name, class)) in CONTESTANTS.iter().enumerate() {
        let x = LEFT + 90.0 * k as f64;
        let _ = writeln!(
            text,
            r#"<circle cx="{x}" cy="14" r="4" class="{class}"/><text x="{}" y="18">{name}</text>"#,
            x + 9.0
        );
    }
    let x = LEFT + 270.0;
    let _ = writeln!(
        text,
        r##"<path d="M{x} 9v10" class="bound"/><text x="{}" y="18">bound by our operations</text>"##,
        x + 9.0
    );
    for decade in decades.clone() {
        let x = place(10_f64.powi(decade));
        // Nanoseconds, and from a thousand on microseconds.
        let (unit, power) = if decade < 3 { ("ns", decade) } else { ("µs", decade - 3) };
        let power = 10_f64.powi(power);
        let _ = writeln!(
            text,
            r##"<path d="M{x:.1} {TOP}V{y}" class="grid"/><text x="{x:.1}" y="{}" class="m">{power} {unit}</text>"##,
            TOP - 8.0
        );
    }
    text + &lines + "</svg>\n"
}

/// One output: a line from its fastest contestant to its slowest.
fn line(text: &mut String, row: &Row, y: f64, place: impl Fn(f64) -> f64) {
    let places: Vec<f64> = row.nanoseconds.iter().flatten().map(|&time| place(time)).collect();
    let (left, right) = places.iter().fold((RIGHT, LEFT), |(a, b), &x| (a.min(x), b.max(x)));
    let _ = writeln!(text, r#"<text x="{}" y="{}" class="e">{}</text>"#, LEFT - 8.0, y + 4.0, row.output);
    let _ = writeln!(text, r##"<path d="M{left:.1} {y}H{right:.1}" class="line"/>"##);
    let bound = place(row.bound.operations).max(LEFT);
    let _ = writeln!(text, r##"<path d="M{bound:.1} {}v8" class="bound"/>"##, y - 4.0);
    for (time, (name, class)) in row.nanoseconds.iter().zip(CONTESTANTS) {
        let Some(time) = *time else { continue };
        let x = place(time);
        let _ = writeln!(
            text,
            r#"<circle cx="{x:.1}" cy="{y}" r="4" class="{class}"><title>{name}: {time:.1} ns</title></circle>"#
        );
    }
}
