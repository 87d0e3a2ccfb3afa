//! What is put into a page of HTML: scripts, and their data.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::chart::{Chart, Kind};
use crate::encode::{numbers, short, varying};
use crate::scene::{Body, Motion};

/// A script: where poses come from, all that draws and plays them, and the page's own part.
pub(crate) fn script([poses, page]: [&str; 2]) -> String {
    [
        include_str!("../viewer/data.js"),
        poses,
        include_str!("../viewer/view.js"),
        include_str!("../viewer/charts.js"),
        include_str!("../viewer/player.js"),
        include_str!("../viewer/hands.js"),
        page,
    ]
    .concat()
}

/// Data within a script element: nothing ends it but its own end, for no tag begins in it.
pub(crate) fn embedded(data: &Value) -> String {
    data.to_string().replace('<', "\\u003c").replace('\u{2028}', "\\u2028")
}

/// What is drawn of a body, wherever it is.
pub(crate) fn written(body: &Body) -> BTreeMap<&'static str, Value> {
    let mut entries = BTreeMap::from([("name", json!(body.name))]);
    if !body.joint.kind.is_empty() {
        entries.insert("joint", json!(body.joint.name));
        entries.insert("kind", json!(body.joint.kind));
        entries.insert("motions", json!(body.joint.motions.iter().map(motion).collect::<Vec<_>>()));
    }
    if body.mass > 0.0 {
        entries.insert("mass", short(body.mass));
        entries.insert("com", json!(body.com.map(short)));
        entries.extend(body.ellipsoid().map(|squares| ("ellipsoid", json!(squares.map(short)))));
    }
    entries
}

fn motion(motion: &Motion) -> Value {
    match motion {
        Motion::Turn { through, along } => {
            json!({ "through": through.map(short), "along": along.map(short) })
        }
        Motion::Slide { along } => json!({ "along": along.map(short) }),
    }
}

/// A chart over time, whose own times are left out if they are those of all; none of another chart.
pub(crate) fn lines(chart: &Chart, of_all: &[f64]) -> Option<Value> {
    let Kind::OverTime { times, lines } = &chart.kind else { return None };
    let own = (times != of_all).then(|| numbers(times));
    let line = |line: &crate::chart::Line| {
        let mut entries = BTreeMap::from(varying(&line.values));
        entries.insert("name", json!(line.name));
        json!(entries)
    };
    let lines: Vec<Value> = lines.iter().map(line).collect();
    Some(
        json!({ "quantity": chart.quantity, "unit": chart.unit, "time": own, "count": times.len(), "lines": lines }),
    )
}

/// A page with its parts put in, from left to right: what is put in is not looked at again.
pub(crate) fn filled(page: &str, parts: &[(&str, String)]) -> String {
    let mut text = String::new();
    let mut rest = page;
    while let Some((at, (mark, part))) =
        parts.iter().filter_map(|part| Some((rest.find(part.0)?, part))).min_by_key(|(at, _)| *at)
    {
        text += &rest[..at];
        text += part;
        rest = &rest[at + mark.len()..];
    }
    text + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_put_in_stays_as_it_is() {
        let parts = [("{a}", "{b}".to_owned()), ("{b}", "x".to_owned())];
        assert_eq!(filled("<{a}|{b}|{c}>", &parts), "<{b}|x|{c}>");
    }
}
