//! Pages are whole, ask for nothing from outside, and have the numbers that they were given.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use dynamics_core::Pose;
use dynamics_core::nalgebra::{Rotation3, SVector, Vector3};
use dynamics_view::page::{Cell, Equation, Handle, HandleKind, Matrix, Page, Pattern, Section, Stage, Table};
use dynamics_view::{Body, Chart, Drive, Error, Figure, Link, Linkage, Mount, Plane, Scene};
use serde_json::Value;

/// A pose of an angle about an axis, and a place.
fn pose(axis: Vector3<f64>, place: [f64; 3]) -> Pose<f64> {
    Pose { rotation: *Rotation3::new(axis).matrix(), translation: SVector::from(place) }
}

fn link(parent: Option<usize>, placement: Pose<f64>, drive: Drive, q: usize) -> Link {
    Link { parent, placement, drive, q, ratio: 1.0, offset: 0.0 }
}

/// A screw on a slide, a ball on the screw, and a free body: q is a distance, an angle, a quaternion, and seven more.
fn linkage() -> Linkage {
    let links = vec![
        link(None, pose(Vector3::new(0.0, 0.5, 0.0), [0.0, 0.0, 1.0]), Drive::Slide, 0),
        link(Some(0), pose(Vector3::new(0.3, 0.0, 0.0), [0.1, 0.0, 0.0]), Drive::Turn, 1),
        // The pitch of the screw.
        Link { ratio: 0.25, offset: 0.5, ..link(Some(1), Pose::identity(), Drive::Slide, 1) },
        link(Some(2), pose(Vector3::zeros(), [0.0, 0.2, 0.0]), Drive::Ball, 2),
        link(None, pose(Vector3::new(0.0, 0.0, 0.7), [1.0, 0.0, 0.0]), Drive::Free, 6),
    ];
    let mount =
        |link: usize, place: [f64; 3]| Mount { link: Some(link), pose: pose(Vector3::zeros(), place) };
    let mounts = vec![mount(0, [0.0; 3]), mount(2, [0.0; 3]), mount(3, [0.0, 0.0, 0.4]), mount(4, [0.0; 3])];
    Linkage { links, mounts }
}

const Q: [f64; 13] = [0.3, 0.8, 0.6, 0.0, 0.0, 0.8, 0.1, 0.2, 0.3, 0.0, 0.6, 0.0, 0.8];

fn stage() -> Stage {
    let named = |name: &str, parent| Body { name: name.to_owned(), parent, mass: 1.0, ..Body::default() };
    let bodies = vec![
        named("slide", None),
        named("screw", Some(0)),
        named("ball</script>", Some(1)),
        named("free", None),
    ];
    let times = vec![0.0, 0.5, 1.0];
    Stage {
        scene: Scene { name: "all".to_owned(), bodies },
        linkage: linkage(),
        handles: vec![
            Handle { name: "slide".to_owned(), q: 0, kind: HandleKind::Distance, range: [-1.0, 1.0] },
            Handle { name: "ball".to_owned(), q: 2, kind: HandleKind::Ball, range: [-1.0, 1.0] },
        ],
        start: Q.to_vec(),
        motion: times.iter().map(|t| Q.map(|x| x * (1.0 - 0.1 * t)).to_vec()).collect(),
        charts: vec![Chart::over_time("distance", "m", &times).line("slide", [0.3, 0.285, 0.27])],
        times,
        tip: Some("ball</script>".to_owned()),
    }
}

fn page() -> Page {
    let equation = Equation {
        title: "Energy & more".to_owned(),
        mathml: "<math><mi>T</mi></math>".to_owned(),
        latex: "T < \\frac{1}{2}\n+ 1".to_owned(),
    };
    let pattern = Pattern {
        caption: "M".to_owned(),
        rows: vec!["a".to_owned(), "b".to_owned()],
        columns: vec!["a".to_owned(), "b".to_owned()],
        variables: vec!["θ".to_owned()],
        cells: vec![vec![Cell::Zero, Cell::Constant(0.5)], vec![Cell::Constant(0.5), Cell::Varies(vec![0])]],
    };
    let matrix = Matrix {
        name: "A".to_owned(),
        caption: "of states".to_owned(),
        rows: vec!["x".to_owned()],
        columns: vec!["x".to_owned(), "v".to_owned()],
        entries: vec![vec![0.0, -0.012_34]],
    };
    let poles =
        Figure::new("").with(Chart::poles(Plane::Continuous).set("poles", [[-1.0, 2.0], [-1.0, -2.0]]));
    let everything = Section::new("all", "All <parts>")
        .text("Of `code` & text.")
        .remark("r")
        .heading("h")
        .facts([["what".to_owned(), "a fact".to_owned()]])
        .list(["one".to_owned()])
        .preformatted("a tree", "world\n└─ <arm>")
        .table(Table::new("numbers", "lr").head(["name", "x"]).row(["a", "1"]))
        .matrix(matrix)
        .pattern(pattern)
        .equation(equation)
        .figure("poles", poles.wide(400.0));
    Page::new("A \"page\" & <more>")
        .summary("first")
        .with_stage(stage())
        .section(Section::new("robot", "The robot").robot())
        .section(everything)
        .section(Section::new("swing", "A swing").swing())
        .footer("Made by `us`.")
}

fn data(html: &str) -> Value {
    let start = html.split(r#"<script type="application/json" id="data">"#).nth(1).unwrap();
    serde_json::from_str(start.split("</script>").next().unwrap()).unwrap()
}

#[test]
fn a_page_needs_nothing_else() {
    let html = page().html().unwrap();
    for outside in
        ["http:", "https:", "//www", "src=", "import ", "fetch(", "XMLHttpRequest", "WebSocket", "@import"]
    {
        assert!(!html.contains(outside), "{outside}");
    }
    // Links lead to places on the page alone, which are there.
    for link in html.split("href=\"").skip(1) {
        let target = link.split('"').next().unwrap().strip_prefix('#').unwrap();
        assert!(html.contains(&format!(r#"id="{target}""#)), "{target}");
    }
    assert_eq!(html.matches("url(").count(), html.matches("url(#").count());
    assert!(html.contains("default-src 'none'"));
    assert_eq!(html, page().html().unwrap());
}

#[test]
fn a_page_is_whole() {
    let html = page().html().unwrap();
    let elements =
        ["section", "table", "tr", "td", "th", "div", "details", "svg", "p", "pre", "code", "dl", "ul", "li"];
    for tag in elements {
        let opened = html.matches(&format!("<{tag} ")).count() + html.matches(&format!("<{tag}>")).count();
        assert_eq!(opened, html.matches(&format!("</{tag}>")).count(), "{tag}");
    }
    for text in [
        "<h1>A &quot;page&quot; &amp; &lt;more&gt;</h1>",
        "Of <code>code</code> &amp; text.",
        "world\n└─ &lt;arm&gt;",
        "T &lt; \\frac{1}{2}\n+ 1",
        r#"<td class="zero">0</td><td>−0.01234</td>"#,
        r#"title="depends on θ">θ</td>"#,
        "Made by <code>us</code>.",
    ] {
        assert!(html.contains(text), "{text}");
    }
    for left in ["{title}", "{style}", "{data}", "{script}", "{sections}", "NaN"] {
        assert!(!html.split("<script>").next().unwrap().contains(left), "{left}");
    }
    let ids: Vec<&str> = html.split(" id=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
    let mut once = ids.clone();
    once.sort_unstable();
    once.dedup();
    assert_eq!(once.len(), ids.len(), "{ids:?}");
}

/// Each motion by nalgebra's own rotations.
#[test]
fn a_linkage_moves_as_its_joints_do() {
    let poses = linkage().poses(&Q).unwrap();
    let slide = pose(Vector3::new(0.0, 0.5, 0.0), [0.0, 0.0, 1.0]) * pose(Vector3::zeros(), [0.0, 0.0, 0.3]);
    let turn = slide
        * pose(Vector3::new(0.3, 0.0, 0.0), [0.1, 0.0, 0.0])
        * pose(Vector3::new(0.0, 0.0, 0.8), [0.0; 3]);
    let screw = turn * pose(Vector3::zeros(), [0.0, 0.0, 0.25 * 0.8 + 0.5]);
    // The quaternion (0.6, 0, 0, 0.8) turns about x by twice the angle whose sine is 0.6.
    let ball = screw
        * pose(Vector3::zeros(), [0.0, 0.2, 0.0])
        * pose(Vector3::new(2.0 * 0.6_f64.asin(), 0.0, 0.0), [0.0; 3])
        * pose(Vector3::zeros(), [0.0, 0.0, 0.4]);
    let free = pose(Vector3::new(0.0, 0.0, 0.7), [1.0, 0.0, 0.0])
        * pose(Vector3::new(0.0, 2.0 * 0.6_f64.asin(), 0.0), [0.1, 0.2, 0.3]);
    for (k, expected) in [slide, screw, ball, free].iter().enumerate() {
        let off = (poses[k].translation - expected.translation).amax();
        let turned = (poses[k].rotation - expected.rotation).amax();
        // A handful of products of entries of size one.
        assert!(off < 1e-14 && turned < 1e-14, "{k}: {off:e} {turned:e}");
    }
}

/// What is embedded is the linkage to the last bit, and the motion within what was rounded away.
#[test]
fn a_page_has_the_numbers_that_it_was_given() {
    let data = data(&page().html().unwrap());
    let numbers = |value: &Value| -> Vec<f64> {
        value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
    };
    assert_eq!(numbers(&data["start"]), Q);
    let Linkage { links, mounts } = linkage();
    let entries = |pose: &Pose<f64>| -> Vec<f64> {
        pose.translation.iter().copied().chain(pose.rotation.transpose().iter().copied()).collect()
    };
    for (written, link) in data["links"].as_array().unwrap().iter().zip(&links) {
        assert_eq!(numbers(&written["at"]), entries(&link.placement));
        assert_eq!(written["parent"].as_u64().map(|k| k as usize), link.parent);
        assert_eq!(
            (written["ratio"].as_f64(), written["offset"].as_f64()),
            (Some(link.ratio), Some(link.offset))
        );
    }
    for (written, mount) in data["bodies"].as_array().unwrap().iter().zip(&mounts) {
        assert_eq!(numbers(&written["at"]), entries(&mount.pose));
    }
    assert_eq!(data["bodies"][2]["name"], "ball</script>");
    assert_eq!(data["trace"], 2);
    for (k, row) in data["q"].as_array().unwrap().iter().enumerate() {
        let (from, unit) = (row["from"].as_f64().unwrap(), row["unit"].as_f64().unwrap());
        let last = match row["row"].as_array() {
            // Second differences: x₀, x₁ − x₀, x₂ − 2x₁ + x₀.
            Some(row) => (0..3).map(|k| row[k].as_i64().unwrap() * [1, 2, 1][k]).sum::<i64>() as f64,
            None => row["row"].as_f64().unwrap(),
        };
        assert!((from + unit * last - 0.9 * Q[k]).abs() <= 2.0 * unit, "{k}");
    }
}

#[test]
fn what_cannot_be_shown_is_refused() {
    assert!(matches!(Page::new("x").html(), Err(Error::Empty { .. })));
    let robot = Page::new("x").section(Section::new("robot", "r").robot());
    assert!(matches!(robot.html(), Err(Error::Empty { .. })));
    let with = |change: fn(&mut Stage)| {
        let mut stage = stage();
        change(&mut stage);
        Page::new("x").section(Section::new("robot", "r").robot()).with_stage(stage).html()
    };
    assert!(with(|_| ()).is_ok());
    assert!(matches!(
        with(|stage| stage.linkage.links[1].parent = Some(1)),
        Err(Error::LinkUnconnected { link: 1 })
    ));
    assert!(matches!(
        with(|stage| stage.linkage.mounts[0].link = Some(9)),
        Err(Error::LinkUnconnected { link: 9 })
    ));
    assert!(matches!(
        with(|stage| stage.start.truncate(12)),
        Err(Error::LengthsDiffer { expected: 13, found: 12, .. })
    ));
    assert!(matches!(with(|stage| stage.start[0] = f64::NAN), Err(Error::NotDrawable { .. })));
    assert!(matches!(with(|stage| stage.handles[1].q = 10), Err(Error::LengthsDiffer { expected: 14, .. })));
    assert!(matches!(with(|stage| stage.times.clear()), Err(Error::Empty { .. })));
    assert!(matches!(with(|stage| stage.tip = Some("x".to_owned())), Err(Error::BodyUnknown { .. })));
    let wrong = Matrix {
        name: "A".to_owned(),
        caption: String::new(),
        rows: vec!["x".to_owned()],
        columns: vec!["x".to_owned()],
        entries: vec![vec![1.0, 2.0]],
    };
    let page = Page::new("x").section(Section::new("a", "a").matrix(wrong));
    assert!(matches!(page.html(), Err(Error::LengthsDiffer { expected: 1, found: 2, .. })));
}
