//! `dynamics report`: a page whose numbers are those of the other commands, and of the textbook.

use dynamics_core::Pose;
use dynamics_core::nalgebra::{SMatrix, SVector};
use dynamics_view::{Drive, Link, Linkage, Mount};
use serde_json::{Value, json};

use super::{ROBOTS, dynamics, dynamics_on, folder, model};

/// The page of a robot, from standard output.
fn page(robot: &str, options: &[&str]) -> String {
    dynamics(&[&["report", &model(robot)], options].concat()).ok()
}

fn data(html: &str) -> Value {
    let start = html.split(r#"<script type="application/json" id="data">"#).nth(1).unwrap();
    serde_json::from_str(start.split("</script>").next().unwrap()).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// The text of a section's elements, with spaces between.
fn text(html: &str, section: &str) -> String {
    let start = html.split(&format!(r#"<section id="{section}""#)).nth(1).unwrap();
    let section = start.split("</section>").next().unwrap();
    let parts = section.split('<').skip(1).map(|part| part.split_once('>').unwrap().1);
    parts.filter(|part| !part.trim().is_empty()).collect::<Vec<_>>().join(" ").replace('\n', " ")
}

/// The linkage that the page's script moves.
fn linkage(data: &Value) -> Linkage {
    let pose = |value: &Value| {
        let x = numbers(value);
        Pose {
            translation: SVector::from([x[0], x[1], x[2]]),
            rotation: SMatrix::from_fn(|i, j| x[3 + 3 * i + j]),
        }
    };
    let index = |value: &Value| value.as_u64().map(|k| k as usize);
    let link = |link: &Value| Link {
        parent: index(&link["parent"]),
        placement: pose(&link["at"]),
        drive: match link["motion"].as_str().unwrap() {
            "turn" => Drive::Turn,
            "slide" => Drive::Slide,
            "ball" => Drive::Ball,
            _ => Drive::Free,
        },
        q: index(&link["q"]).unwrap(),
        ratio: link["ratio"].as_f64().unwrap(),
        offset: link["offset"].as_f64().unwrap(),
    };
    let mount = |body: &Value| Mount { link: index(&body["link"]), pose: pose(&body["at"]) };
    Linkage {
        links: data["links"].as_array().unwrap().iter().map(link).collect(),
        mounts: data["bodies"].as_array().unwrap().iter().map(mount).collect(),
    }
}

/// Whatever a reader's hand sets, every body is where the compiler's own programs have it.
#[test]
fn the_robot_stands_where_eval_says() {
    let tool = [
        "--joint",
        "wrist: ball, flange -> hand, at = [0, 0.1, 0.3]",
        "--body",
        "hand, solid = cuboid(1, [0.1, 0.2, 0.3])",
    ];
    let screw = [
        "--joint",
        "drill: helical(y, 10mm), flange -> bit, at = [0.1, 0, 0]",
        "--body",
        "bit, solid = cuboid(1, [0.1, 0.2, 0.3])",
    ];
    let follower = [
        "--joint",
        "copy: revolute(x), flange -> mirror, mimic = joint1, ratio = -2, offset = 0.3",
        "--body",
        "mirror, solid = cuboid(1, [0.1, 0.2, 0.3])",
    ];
    let also = [&tool[..], &screw, &follower].concat();
    let also: Vec<String> = also.iter().map(|option| option.replace("flange", "link2")).collect();
    let also: Vec<&str> = also.iter().map(String::as_str).collect();
    for (robot, options) in
        [("cartpole", &[][..]), ("iiwa14", &[]), ("hyq", &["--base", "free"]), ("double_pendulum", &also)]
    {
        let data = data(&page(robot, &[options, &["--time", "0"]].concat()));
        let size = data["start"].as_array().unwrap().len();
        let mut q: Vec<f64> = (0..size).map(|k| (1.7 * k as f64 + 0.4).sin()).collect();
        for link in data["links"].as_array().unwrap() {
            let from = match link["motion"].as_str().unwrap() {
                "ball" => link["q"].as_u64().unwrap() as usize,
                "free" => link["q"].as_u64().unwrap() as usize + 3,
                _ => continue,
            };
            let length = q[from..from + 4].iter().map(|x| x * x).sum::<f64>().sqrt();
            q[from..from + 4].iter_mut().for_each(|x| *x /= length);
        }
        let poses = linkage(&data).poses(&q).unwrap();
        let (state, file) = (json!({ "q": q }).to_string(), model(robot));
        let asked =
            [&["eval", &file], options, &["--frame", "*", "--only", "mass", "--state", &state]].concat();
        let said: Value = serde_json::from_str(&dynamics(&asked).ok()).unwrap();
        for (body, pose) in data["bodies"].as_array().unwrap().iter().zip(&poses) {
            let frame = &said["frames"][body["name"].as_str().unwrap()];
            let place = numbers(&frame["translation"]);
            for i in 0..3 {
                // Some ten products of rotations, at a reach of some metres.
                assert!((pose.translation[i] - place[i]).abs() < 1e-12, "{robot}: {}", body["name"]);
                for (j, entry) in numbers(&frame["rotation"][i]).iter().enumerate() {
                    assert!((pose.rotation[(i, j)] - entry).abs() < 1e-12, "{robot}: {}", body["name"]);
                }
            }
        }
    }
}

/// A cart of 1 kg and a pole of 0.1 kg with its mass at 0.5 m and 1/120 kg·m² about it: upright it falls with
/// `λ² = m·g·l·(M + m)/((M + m)·(I + m·l²) − m²·l²)`.
#[test]
fn the_poles_of_a_cart_pole_are_the_textbooks() {
    let [cart, mass, length, inertia, g] = [1.0, 0.1, 0.5, 0.1 / 12.0, 9.81];
    let moment: f64 = inertia + mass * length * length;
    let square = mass * g * length * (cart + mass) / ((cart + mass) * moment - (mass * length).powi(2));
    let pole = dynamics_view::page::number(square.sqrt(), 5);
    let html = page("cartpole", &["--time", "0", "--joint", "hinge, actuated = off"]);
    let said = text(&html, "linear");
    for expected in [
        format!(" {pole} {pole} −1 doubles in "),
        format!(" −{pole} {pole} 1 halves in "),
        "0, 2 times 0 stays, or drifts".to_owned(),
        "The equilibrium is unstable".to_owned(),
        "It is controllable: its motors reach all 4 states".to_owned(),
        "the torques below hold it there".to_owned(),
        "hinge θ̇ 0 no motor 0".to_owned(),
    ] {
        assert!(said.contains(&expected), "{expected}: {said}");
    }
    // Pushed where it hangs it comes back, for ever.
    let hanging = page("cartpole", &["--time", "0", "--state", r#"{"q": {"hinge": 3.141592653589793}}"#]);
    let said = text(&hanging, "linear");
    assert!(said.contains(&format!("0 ± {pole}i {pole} 0 period")) && said.contains("is marginal"), "{said}");
}

/// Entries that are there in closed form: `M₁₁ = M + m`, `M₁₂ = m·l·cos θ`, `M₂₂ = I + m·l²`.
#[test]
fn the_structure_of_a_cart_pole_is_the_textbooks() {
    let html = page("cartpole", &["--time", "0"]);
    let cells: Vec<&str> =
        html.split("<td class=\"").skip(1).map(|rest| rest.split("</td>").next().unwrap()).collect();
    let cells: Vec<&&str> = cells.iter().filter(|cell| cell.contains("title=")).collect();
    let expected = [
        r#"constant" title="1.1, always">1.1"#,
        r#"varies depth1" title="depends on θ">θ"#,
        r#"varies depth1" title="depends on θ">θ"#,
        r#"constant" title="0.03333, always">0.03333"#,
    ];
    assert_eq!(cells, expected.iter().collect::<Vec<_>>());
    let said = text(&html, "equations");
    for title in [
        "Mass matrix",
        "Coriolis matrix",
        "Potential forces",
        "Kinetic energy",
        "Potential energy",
        "Lagrangian",
    ] {
        assert!(said.contains(title), "{title}");
    }
    assert!(html.contains(r#"<math display="block">"#) && html.contains("\\begin{bmatrix}"));
}

/// The costs are those of `count`, line by line.
#[test]
fn the_costs_are_those_of_count() {
    let said = text(&page("iiwa14", &["--time", "0"]), "costs");
    let counted = dynamics(&["count", &model("iiwa14")]).ok();
    let of_robot = counted.lines().skip(1).take_while(|line| !line.trim().is_empty());
    let mut lines = 0;
    for line in of_robot {
        let cells: Vec<&str> = line.split_whitespace().collect();
        assert!(said.contains(&cells.join(" ")), "{line}");
        lines += 1;
    }
    assert!(lines > 20, "{counted}");
}

/// No page asks for anything, is larger than a picture, or differs from itself.
#[test]
fn pages_are_whole_bounded_and_the_same_each_time() {
    for (robot, options) in ROBOTS {
        let html = page(robot, &[*options, &["--time", "0.1", "--step", "1e-2"]].concat());
        let here = env!("CARGO_MANIFEST_DIR");
        for outside in
            ["http:", "https:", "//www", "src=", "fetch(", "XMLHttpRequest", "WebSocket", here, "/robots/"]
        {
            assert!(!html.contains(outside), "{robot}: {outside}");
        }
        assert_eq!(html.matches("url(").count(), html.matches("url(#").count(), "{robot}");
        assert!(html.len() < 400_000, "{robot}: {}", html.len());
        for id in [
            "robot",
            "parameters",
            "equations",
            "structure",
            "costs",
            "swing",
            "linear",
            "file",
            "conventions",
        ] {
            assert_eq!(html.matches(&format!(r#"<section id="{id}""#)).count(), 1, "{robot}: {id}");
        }
        // A limit of 0 and 0 is none: there is a way to go on every slider.
        let data = data(&html);
        let handles = data["handles"].as_array().unwrap();
        let has_way = |handle: &Value| handle["low"].as_f64().unwrap() < handle["high"].as_f64().unwrap();
        assert!(!handles.is_empty() && handles.iter().all(has_way), "{robot}: {handles:?}");
    }
    let arguments = ["--time", "0.1", "--step", "1e-2"];
    assert_eq!(page("scara", &arguments), page("scara", &arguments));
}

/// Of a robot with many joints the equations are left out, and the page says so.
#[test]
fn a_long_chain_has_a_page_of_bounded_size() {
    let mut text = String::from("<robot name=\"chain\"><link name=\"l0\"/>");
    for k in 1..=30 {
        let axis = ["1 0 0", "0 1 0", "0 0 1"][k % 3];
        text += &format!(
            "<link name=\"l{k}\"><inertial><mass value=\"1\"/><origin xyz=\"0 0 0.1\"/>\
             <inertia ixx=\"0.01\" iyy=\"0.01\" izz=\"0.01\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\
             <joint name=\"j{k}\" type=\"continuous\"><parent link=\"l{}\"/><child link=\"l{k}\"/>\
             <origin xyz=\"0 0 0.2\"/><axis xyz=\"{axis}\"/></joint>",
            k - 1
        );
    }
    let here = folder("chain");
    let [urdf, html] = ["chain.urdf", "chain.html"].map(|name| here.join(name).to_str().unwrap().to_owned());
    std::fs::write(&urdf, text + "</robot>").unwrap();
    assert_eq!(dynamics(&["report", &urdf, "--time", "0.1", "--step", "0.01", "-o", &html]).ok(), "");
    let html = std::fs::read_to_string(html).unwrap();
    assert!(html.len() < 500_000, "{}", html.len());
    assert!(html.contains("more terms than anybody could read"));
    assert!(html.contains("60 rows and columns"));
}

/// The swing is that of `simulate`, with the energy that it keeps, and ends where a slide does.
#[test]
fn the_swing_is_that_of_simulate() {
    let start = ["--time", "0.5", "--step", "1e-3", "--q", "hinge=1", "--v", "slider=0.5"];
    let data = data(&page("cartpole", &start));
    let csv = dynamics(&[&["simulate", &model("cartpole"), "--every", "500"], &start[..]].concat()).ok();
    let last: Vec<f64> = csv.lines().last().unwrap().split(',').map(|cell| cell.parse().unwrap()).collect();
    assert_eq!(data["count"], 31);
    for (k, row) in data["q"].as_array().unwrap().iter().enumerate() {
        let (mut value, mut step) = (0, 0);
        for (n, second) in numbers(&row["row"]).iter().enumerate() {
            (step, value) = match n {
                0 => (0, *second as i64),
                1 => (*second as i64, value + *second as i64),
                _ => (step + *second as i64, value + step + *second as i64),
            };
        }
        let unit = row["unit"].as_f64().unwrap();
        let found = row["from"].as_f64().unwrap() + unit * value as f64;
        assert!((found - last[1 + k]).abs() <= unit, "{found} for {}", last[1 + k]);
    }
    let short = page("cartpole", &["--v", "slider=4"]);
    assert!(text(&short, "swing").contains("until  slider  comes to its end"), "{}", text(&short, "swing"));
}

#[test]
fn mistakes_are_told_before_anybody_waits() {
    let cart = model("cartpole");
    let here = folder("no_report");
    let html = here.join("no/such.html").to_str().unwrap().to_owned();
    for (options, expected) in [
        (vec!["-o", &html], "cannot be written"),
        (vec!["--q", "hing=1"], "did you mean"),
        (vec!["--state", "{\"q\": [1]}"], "q"),
        (vec!["-o", &cart], "it is the input"),
    ] {
        let said = dynamics(&[&["report", &cart], &options[..]].concat()).failed(1);
        assert!(said.contains(expected), "{said}");
    }
}

/// Of a robot whose fields have values the equations are those of the fields, and all else is of the values.
#[test]
fn fields_are_letters_in_equations() {
    let spring = ["report", "../../examples/elastic_pendulum.rs", "--robot", "OnASpring"];
    let values = ["--set", "m = 500g, k = 40N_per_m, l = 40cm, c = 0"];
    let place = ["--state", r#"{"q": {"r": 0.5}}"#, "--q", "0.2,0.5"];
    let html = dynamics(&[&spring[..], &values, &place].concat()).ok();
    assert!(
        html.contains("M(q) = \\begin{bmatrix} m r^{2} &amp; 0 \\\\ 0 &amp; m \\end{bmatrix}"),
        "{}",
        text(&html, "equations")
    );
    assert!(text(&html, "parameters").contains("bob 0.5"), "{}", text(&html, "parameters"));
    // Where the spring has no length, an angle is none.
    let error = dynamics(&[&spring[..], &values].concat()).failed(1);
    assert!(
        error.contains("at q = [0.0, 0.0], it cannot move: M(q) is singular, since `theta` moves no mass"),
        "{error}"
    );
    assert!(error.contains("--state"), "{error}");
}

/// What takes energy is in the equations and in the account of the swing, where no joint has it, too.
#[test]
fn dissipation_is_told_and_written() {
    let pendulum = ["report", "../../examples/elastic_pendulum.rs", "--robot", "OnASpring"];
    let values = ["--set", "m = 500g, k = 40N_per_m, l = 40cm, c = 0.1"];
    let place = ["--state", r#"{"q": {"r": 0.5}}"#, "--q", "0.2,0.5"];
    let html = dynamics(&[&pendulum[..], &values, &place].concat()).ok();
    let equations = text(&html, "equations");
    assert!(equations.contains("M(q)·a + C(q,v)·v + G(q) + P(q,v) = τ"), "{equations}");
    assert!(html.contains("P(q,v) = \\begin{bmatrix} 0 \\\\ c \\dot{r} \\end{bmatrix}"), "{equations}");
    let swing = text(&html, "swing");
    assert!(
        swing.contains("Terms of dissipation and the method's error changed the total energy"),
        "{swing}"
    );
    let parameters = text(&html, "parameters");
    for told in ["D + c / 2 * dot(distance(world, bob))^2", "c c 0.1 kg/s"] {
        assert!(parameters.contains(told), "{told}: {parameters}");
    }

    let html = dynamics(&["report", &model("iiwa14"), "--time", "0.01"]).ok();
    assert!(text(&html, "equations").contains("M(q)·a + C(q,v)·v + G(q) = τ"));
    assert!(text(&html, "swing").contains("Nothing takes energy from it"));
}

/// A chain too long for derivatives without loops, which a term in its energies asks for, has a page with all else.
#[test]
fn a_page_says_why_there_is_no_linear_model() {
    let joint = |k: usize| {
        let (parent, axis) =
            (k.checked_sub(1).map_or("world".to_owned(), |k| format!("l{k}")), ["x", "y", "z"][k % 3]);
        format!(
            "#[joint(j{k}: revolute({axis}), {parent} -> l{k}, at = [0.1, 0.02, 0.3])]\n\
             #[body(l{k}, mass = 1.5, com = [0.01, 0.02, 0.1], inertia = diag(0.02, 0.03, 0.025))]\n"
        )
    };
    let chain: String = (0..40).map(joint).collect();
    let robot = format!("#[derive(Dynamics)]\n{chain}#[potential(5 * sin(j3)^2)]\nstruct Long;\n");
    let html = dynamics_on(robot.as_bytes(), &["report", "-", "--time", "0.005"]).ok();
    let linear = text(&html, "linear");
    assert!(
        linear.contains(
            "derivatives of forward dynamics, which this robot has not: the program would be too long"
        ),
        "{linear}"
    );
    assert!(text(&html, "swing").contains("Runge"), "{}", text(&html, "swing"));
}
