//! Pictures are whole, ask for nothing from outside, are the same each time, and say what they were given.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use dynamics_core::nalgebra::{Rotation3, SVector, Vector3};
use dynamics_core::{Energy, Pose};
use dynamics_view::{Body, Chart, Error, Figure, Film, Joint, Motion, Plane, Scene};
use serde_json::Value;

fn times(count: usize) -> Vec<f64> {
    (0..count).map(|k| k as f64 / 60.0).collect()
}

/// A pose of two angles and a place.
fn pose(yaw: f64, pitch: f64, place: [f64; 3]) -> Pose<f64> {
    let rotation = Rotation3::from_axis_angle(&Vector3::z_axis(), yaw)
        * Rotation3::from_axis_angle(&Vector3::y_axis(), pitch);
    Pose { rotation: *rotation.matrix(), translation: SVector::from(place) }
}

/// Three bodies that wave: the last one is welded to the second, and stands before the first.
fn waving(count: usize) -> (Film, Vec<Vec<Pose<f64>>>) {
    let named = |name: &str, parent| Body { name: name.to_owned(), parent, mass: 1.0, ..Body::default() };
    let joint = Joint {
        name: "shoulder".to_owned(),
        kind: "revolute".to_owned(),
        motions: vec![Motion::Turn { through: [0.0; 3], along: [0.0, 0.0, 1.0] }],
    };
    let bodies = vec![
        named("hand</script>", Some(2)),
        Body { joint, ..named("upper", None) },
        named("lower", Some(1)),
    ];
    let mut film = Film::new(Scene { name: "A \"wave\" & <more>".to_owned(), bodies });
    let mut all = vec![];
    for t in times(count) {
        let upper = pose(3.0 * t, 0.4 * (5.0 * t).sin(), [0.1, 0.0, 0.5]);
        let lower = upper * pose(0.0, 2.0 * (2.0 * t).sin(), [0.0, 0.0, 0.4]);
        let poses = vec![lower * pose(0.3, -0.2, [0.0, 0.1, 0.2]), upper, lower];
        film.push(t, poses.clone());
        all.push(poses);
    }
    (film, all)
}

fn data(html: &str) -> Value {
    let start = html.split(r#"<script type="application/json" id="data">"#).nth(1).unwrap();
    serde_json::from_str(start.split("</script>").next().unwrap()).unwrap()
}

/// What the page's script makes of a row.
fn decoded(row: &Value, count: usize, unit: f64) -> Vec<f64> {
    let Some(list) = row.as_array() else { return vec![row.as_f64().unwrap() * unit; count] };
    let (mut value, mut step) = (0, 0);
    let next = |(k, second): (usize, &Value)| {
        let second = second.as_i64().unwrap();
        match k {
            0 => value = second,
            1 => (step, value) = (second, value + second),
            _ => {
                step += second;
                value += step;
            }
        }
        value as f64 * unit
    };
    list.iter().enumerate().map(next).collect()
}

/// What is embedded, put together as the page does, is where the bodies were, within what was rounded away.
#[test]
fn a_film_has_the_poses_that_it_was_given() {
    let (film, expected) = waving(120);
    let data = data(&film.html().unwrap());
    let names: Vec<&str> =
        data["bodies"].as_array().unwrap().iter().map(|body| body["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["upper", "lower", "hand</script>"]);
    let (unit, turn) = (data["unit"].as_f64().unwrap(), data["turn"].as_f64().unwrap());
    let mut found: Vec<Vec<Pose<f64>>> = vec![];
    for body in data["bodies"].as_array().unwrap() {
        let of = |k: usize| decoded(&body["place"][k], 120, if k < 3 { unit } else { turn });
        let place: Vec<Vec<f64>> = (0..7).map(of).collect();
        let poses = (0..120).map(|k| {
            let [i, j, l, w] = [3, 4, 5, 6].map(|c| place[c][k]);
            let quaternion = dynamics_core::nalgebra::Quaternion::new(w, i, j, l);
            let rotation =
                dynamics_core::nalgebra::UnitQuaternion::new_normalize(quaternion).to_rotation_matrix();
            let own = Pose {
                rotation: *rotation.matrix(),
                translation: SVector::from([place[0][k], place[1][k], place[2][k]]),
            };
            body["parent"].as_u64().map_or(own, |parent| found[parent as usize][k] * own)
        });
        let poses = poses.collect();
        found.push(poses);
    }
    // Half a quantum of each of three links, at a reach of a metre.
    let tolerance = 3.0 * (unit + 2.0 * turn);
    for (k, poses) in expected.iter().enumerate() {
        for (body, at) in [(1, 0), (2, 1), (0, 2)] {
            let off = (poses[body].translation - found[at][k].translation).amax();
            let turned = (poses[body].rotation - found[at][k].rotation).amax();
            assert!(off < tolerance && turned < tolerance, "{k}, {body}: {off:e} {turned:e}");
        }
    }
    // The hand is welded: its place is seven numbers.
    assert!(data["bodies"][2]["place"].as_array().unwrap().iter().all(Value::is_number));
}

#[test]
fn ten_seconds_of_seven_joints_are_small() {
    let bodies = (0..7).map(|k| Body {
        name: format!("link{k}"),
        parent: (k as usize).checked_sub(1),
        ..Body::default()
    });
    let mut film = Film::new(Scene { name: "arm".to_owned(), bodies: bodies.collect() });
    for t in times(600) {
        let mut at = Pose::identity();
        let next = |k: usize| {
            at = at * pose(f64::sin((1.0 + 0.7 * k as f64) * t), 0.5 * k as f64, [0.0, 0.02, 0.3]);
            at
        };
        film.push(t, (0..7).map(next).collect());
    }
    let data = data(&film.html().unwrap()).to_string().len();
    assert!(data < 200_000, "{data}");
}

#[test]
fn a_page_needs_nothing_else() {
    let (film, _) = waving(30);
    let angle = Chart::over_time("angle", "rad", &times(30)).line("<upper>", times(30));
    let film = film.with_charts([angle]).tracing("lower");
    let html = film.html().unwrap();
    for outside in [
        "http:",
        "https:",
        "//www",
        "src=",
        "href=",
        "url(",
        "import ",
        "fetch(",
        "XMLHttpRequest",
        "WebSocket",
    ] {
        assert!(!html.contains(outside), "{outside}");
    }
    assert!(
        html.contains("default-src 'none'")
            && html.contains("<h1>A &quot;wave&quot; &amp; &lt;more&gt;</h1>")
    );
    for (open, close) in [("<script", "</script>"), ("<style", "</style>"), ("<table", "</table>")] {
        assert_eq!(html.matches(open).count(), html.matches(close).count(), "{open}");
    }
    assert!(!html.contains("{data}") && !html.contains("{script}"));
    assert_eq!(html, film.html().unwrap());
}

/// All kinds of charts.
fn figure() -> Figure {
    let times = times(200);
    let wave = |rate: f64| times.iter().map(|t| (rate * t).sin()).collect::<Vec<_>>();
    let energy: Vec<Energy<f64>> =
        times.iter().map(|t| Energy { kinetic: t * t, potential: -t * t, elastic: 0.0 }).collect();
    Figure::new("<all> & more")
        .with(Chart::over_time("angle", "rad", &times).line("a", wave(3.0)).line("b & c", wave(5.0)))
        .with_all(Chart::energy(&times, &energy))
        .with(Chart::phase("a", ["rad", "rad/s"], &wave(3.0), &wave(2.0)))
        .with(Chart::poles(Plane::Continuous).set("alone", [[4.0, 0.0], [-4.0, 0.0], [0.0, 0.0], [0.0, 0.0]]))
        .with(Chart::poles(Plane::Discrete).set("sampled", [[0.5, 0.5], [0.5, -0.5]]))
}

#[test]
fn charts_are_whole_and_the_same_each_time() {
    let svg = figure().svg().unwrap();
    assert_eq!(svg, figure().svg().unwrap());
    for text in [
        "angle, rad",
        "time, s",
        "energy, J",
        ">b &amp; c<",
        "ζ = 0.7",
        ">unstable<",
        "prefers-color-scheme:dark",
    ] {
        assert!(svg.contains(text), "{text}");
    }
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    for tag in ["g", "svg", "style", "text", "title", "clipPath"] {
        let opened = svg.matches(&format!("<{tag} ")).count() + svg.matches(&format!("<{tag}>")).count();
        assert_eq!(opened, svg.matches(&format!("</{tag}>")).count(), "{tag}");
    }
}

/// What is odd is drawn, and what cannot be is told by its name and place.
#[test]
fn odd_numbers_are_drawn_or_refused() {
    let one = |values: &[f64]| {
        let times: Vec<f64> = (0..values.len()).map(|k| k as f64).collect();
        Figure::new("x")
            .with(Chart::over_time("angle", "rad", &times).line("a", values.iter().copied()))
            .svg()
    };
    for values in
        [&[0.0][..], &[3.0; 4], &[1e-300, -1e-300], &[1e99, -1e99], &[1.0, 1.0 + 1e-15], &[5e-324, 0.0]]
    {
        let svg = one(values).unwrap();
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{values:?}");
    }
    let Err(Error::NotDrawable { what, index, .. }) = one(&[0.0, f64::NAN]) else { panic!("NaN was drawn") };
    assert_eq!((what.as_str(), index), ("the line `a`", 1));
    assert!(matches!(one(&[f64::INFINITY]), Err(Error::NotDrawable { .. })));
    assert!(matches!(one(&[1e101]), Err(Error::NotDrawable { .. })));
    assert!(matches!(one(&[]), Err(Error::Empty { .. })));
    assert!(matches!(Figure::new("x").svg(), Err(Error::Empty { .. })));
    let uneven = Chart::over_time("angle", "rad", &[0.0, 1.0]).line("a", [1.0]);
    assert!(matches!(
        Figure::new("x").with(uneven).svg(),
        Err(Error::LengthsDiffer { expected: 2, found: 1, .. })
    ));
    let back = Chart::over_time("angle", "rad", &[0.0, 0.0]).line("a", [1.0, 1.0]);
    assert!(matches!(Figure::new("x").with(back).svg(), Err(Error::TimesNotIncreasing { index: 1 })));
}

#[test]
fn a_film_that_is_none_is_refused() {
    let body = |name: &str, parent| Body { name: name.to_owned(), parent, ..Body::default() };
    let film = |bodies: Vec<Body>| Film::new(Scene { name: "x".to_owned(), bodies });
    assert!(matches!(film(vec![]).html(), Err(Error::Empty { .. })));
    assert!(matches!(film(vec![body("a", None)]).html(), Err(Error::Empty { .. })));
    let filmed = |bodies: Vec<Body>, poses: usize| {
        let mut film = film(bodies);
        film.push(0.0, vec![Pose::identity(); poses]);
        film
    };
    assert!(filmed(vec![body("a", None)], 1).html().is_ok());
    assert!(matches!(filmed(vec![body("a", None)], 2).html(), Err(Error::LengthsDiffer { .. })));
    let circle = filmed(vec![body("a", Some(1)), body("b", Some(0))], 2).html();
    assert_eq!(circle, Err(Error::BodyUnconnected { body: "a".to_owned() }));
    let unknown = filmed(vec![body("a", None)], 1).tracing("b").html();
    assert_eq!(unknown, Err(Error::BodyUnknown { name: "b".to_owned() }));
    let mut broken = filmed(vec![body("a", None)], 1);
    let mut pose = Pose::identity();
    pose.translation[0] = f64::NAN;
    broken.push(1.0, vec![pose]);
    assert!(matches!(broken.html(), Err(Error::NotDrawable { .. })));
}
