//! `dynamics simulate --plot --animate`: pictures that are whole, and mistakes before anybody waits.

use serde_json::Value;

use super::{dynamics, folder, model};

/// The data of an animation.
fn data(html: &str) -> Value {
    let start = html.split(r#"<script type="application/json" id="data">"#).nth(1).unwrap();
    serde_json::from_str(start.split("</script>").next().unwrap()).unwrap()
}

#[test]
fn a_swing_is_drawn() {
    let here = folder("pictures");
    let [svg, html] = ["swing.svg", "swing.html"].map(|name| here.join(name).to_str().unwrap().to_owned());
    let arguments = ["simulate", &model("cartpole"), "--time", "2", "--step", "1e-3", "--q", "hinge=1"];
    let pictures = ["--plot", &svg, "--animate", &html, "--trace", "pole"];
    let drawn = || {
        let all = [&arguments[..], &pictures, &["--plot-of", "angles,energy,phase:hinge,poles"]].concat();
        assert_eq!(dynamics(&all).unstopped(), "");
        [&svg, &html].map(|file| std::fs::read_to_string(file).unwrap())
    };
    let [chart, page] = drawn();
    for text in [
        "angle, rad",
        "distance, m",
        "energy, J",
        "change of the energy",
        "speed of hinge",
        "poles",
        ">slider<",
    ] {
        assert!(chart.contains(text), "{text}");
    }
    let data = data(&page);
    assert_eq!((&data["name"], &data["count"]), (&Value::from("cartpole"), &Value::from(121)));
    let joints: Vec<&str> =
        data["bodies"].as_array().unwrap().iter().filter_map(|body| body["kind"].as_str()).collect();
    assert_eq!(joints, ["prismatic", "revolute"]);
    assert_eq!(drawn(), [chart, page]);
}

/// The table is written beside the pictures if it is asked for.
#[test]
fn a_picture_does_not_replace_a_table() {
    let here = folder("picture_and_table");
    let [svg, csv] = ["a.svg", "a.csv"].map(|name| here.join(name).to_str().unwrap().to_owned());
    let arguments = ["simulate", &model("scara"), "--time", "0.1", "--step", "0.01"];
    dynamics(&[&arguments[..], &["--plot", &svg, "-o", &csv]].concat()).ok();
    assert_eq!(std::fs::read_to_string(csv).unwrap(), dynamics(&arguments).ok());
    assert!(std::fs::read_to_string(svg).unwrap().ends_with("</svg>\n"));
}

/// Where it is and how it lies; of one that turns over its quaternion.
#[test]
fn a_free_body_has_a_position_and_an_orientation() {
    let svg = folder("free").join("a.svg").to_str().unwrap().to_owned();
    let arguments =
        ["simulate", &model("hyq"), "--base", "free", "--time", "0.4", "--step", "0.02", "--plot", &svg];
    let drawn = |v: &str| {
        dynamics(&[&arguments[..], &["--v", v]].concat()).unstopped();
        std::fs::read_to_string(&svg).unwrap()
    };
    let level = drawn("root_joint.wx=0.5");
    assert!(level.contains(">position of root_joint, m<") && level.contains(">pitch<"));
    assert!(drawn("root_joint.wy=6").contains(">orientation of root_joint, a quaternion<"));
}

#[test]
fn what_cannot_be_drawn_is_said_at_once() {
    let cart = model("cartpole");
    let here = folder("undrawn");
    let file = |name: &str| here.join(name).to_str().unwrap().to_owned();
    let simulate = ["simulate", &cart, "--time", "1", "--step", "0.1"];
    for (options, expected) in [
        (vec!["--plot".to_owned(), file("no/such.svg")], "cannot be written"),
        (vec!["--animate".to_owned(), file("no/such.html")], "cannot be written"),
        (
            ["--plot", &file("a.svg"), "--plot-of", "phase:hing"].map(str::to_owned).into(),
            "did you mean `phase:hinge`?",
        ),
        (["--animate", &file("a.html"), "--trace", "pol"].map(str::to_owned).into(), "did you mean `pole`?"),
        (["--plot", &file("a"), "--animate", &file("a")].map(str::to_owned).into(), "name the same file"),
        (["--plot", &cart].map(str::to_owned).into(), "would be written over"),
    ] {
        let options: Vec<&str> = options.iter().map(String::as_str).collect();
        let complaint = dynamics(&[&simulate[..], &options].concat()).failed(1);
        assert!(complaint.contains(expected), "{complaint}");
    }
    for options in
        [&["--plot-of", "angles"][..], &["--trace", "pole"], &["--plot", "a.svg", "--plot-of", "angels"]]
    {
        dynamics(&[&simulate[..], options].concat()).failed(2);
    }
}
