//! A page of SVG that is written from top to bottom.

use std::fmt::Write as _;

/// Text for XML: what has a meaning there is escaped, what is not allowed there replaced.
pub(crate) fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// A pixel, to a tenth.
pub(crate) fn px(x: f64) -> String {
    let text = format!("{x:.1}");
    let text = text.strip_suffix(".0").unwrap_or(&text);
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Elements, one a line.
#[derive(Default)]
pub(crate) struct Page(String);

impl Page {
    /// A text whose baseline begins at a point; the classes may say that it ends or has its middle there.
    pub(crate) fn text(&mut self, [x, y]: [f64; 2], classes: &str, text: &str) {
        self.put(&format!(r#"<text x="{}" y="{}"{}>{}</text>"#, px(x), px(y), class(classes), escaped(text)));
    }

    /// A path; `name` is shown where the mouse rests.
    pub(crate) fn path(&mut self, data: &str, classes: &str, name: &str) {
        let end = if name.is_empty() {
            "/>".to_owned()
        } else {
            format!("><title>{}</title></path>", escaped(name))
        };
        self.put(&format!(r#"<path d="{data}"{}{end}"#, class(classes)));
    }

    /// A polyline.
    pub(crate) fn line(&mut self, points: &[[f64; 2]], classes: &str, name: &str) {
        self.path(&path(points), classes, name);
    }

    /// A dot.
    pub(crate) fn dot(&mut self, [x, y]: [f64; 2], radius: f64, classes: &str) {
        self.put(&format!(r#"<circle cx="{}" cy="{}" r="{}"{}/>"#, px(x), px(y), px(radius), class(classes)));
    }

    /// Anything else.
    pub(crate) fn put(&mut self, element: &str) {
        let _ = writeln!(self.0, "{element}");
    }

    /// The document.
    pub(crate) fn document(&self, [width, height]: [f64; 2], title: &str, style: &str) -> String {
        let (w, h) = (px(width), px(height));
        format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" viewBox="0 0 {w} {h}" role="img">
<title>{}</title>
<style>
{style}</style>
<rect width="{w}" height="{h}" class="b"/>
{}</svg>
"#,
            escaped(title),
            self.0
        )
    }

    /// The same within HTML, as wide as there is room.
    pub(crate) fn fragment(&self, [width, height]: [f64; 2], title: &str) -> String {
        let (w, h) = (px(width), px(height));
        format!(
            r#"<svg width="{w}" height="{h}" viewBox="0 0 {w} {h}" role="img">
<title>{}</title>
{}</svg>"#,
            escaped(title),
            self.0
        )
    }
}

fn class(classes: &str) -> String {
    if classes.is_empty() { String::new() } else { format!(r#" class="{classes}""#) }
}

/// `M…L…`; of one point a dot, by a round cap.
pub(crate) fn path(points: &[[f64; 2]]) -> String {
    let [first, rest @ ..] = points else { return String::new() };
    let mut data = format!("M{} {}", px(first[0]), px(first[1]));
    if rest.is_empty() {
        data += "h0";
    }
    for (k, [x, y]) in rest.iter().enumerate() {
        let _ = write!(data, "{}{} {}", if k == 0 { "L" } else { " " }, px(*x), px(*y));
    }
    data
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_cannot_end_their_element() {
        assert_eq!(escaped("a<b> & \"c\"\u{0}"), "a&lt;b&gt; &amp; &quot;c&quot;\u{fffd}");
    }

    #[test]
    fn pixels_are_short() {
        assert_eq!([12.04, -0.04, 3.25].map(px), ["12", "0", "3.2"]);
        assert_eq!(path(&[[0.0, 1.0], [2.5, 3.0], [4.0, 5.0]]), "M0 1L2.5 3 4 5");
        assert_eq!(path(&[[0.0, 1.0]]), "M0 1h0");
    }
}
