//! `dynamics rollouts`: each is the simulation of its numbers, whatever computes it beside it, and wherever it is written.

use std::fs::File;
use std::path::Path;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::RowAccessor;

use super::{dynamics, folder, model};

/// The head, and the rows of a table.
fn table(csv: &str) -> (Vec<&str>, Vec<Vec<f64>>) {
    let mut lines = csv.lines();
    let head = lines.next().unwrap().split(',').collect();
    (head, lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect())
}

/// A load on the pole of a cart, whose mass and whose friction are not known.
const LOADED: [&str; 10] = [
    "--joint",
    "strap: fixed, pole -> load, at = [0, 0, 0.9]",
    "--body",
    "load, solid = point(m)",
    "--joint",
    "hinge, damping = c",
    "--time",
    "0.5",
    "--step",
    "1e-3",
];

/// Compiled code and the interpreter differ by the sines they take and by what they round, over 500 steps.
const TOLERANCE: f64 = 1e-10;

/// Each row is one of `simulate` with its numbers written into the options.
#[test]
fn a_rollout_is_a_simulation_of_its_numbers() {
    let cart = model("cartpole");
    let vary = [
        "--vary",
        "m = uniform(100g, 2kg)",
        "--vary",
        "c = loguniform(0.01, 1)",
        "--vary",
        "q.hinge = normal(0, 30deg)",
        "--vary",
        "v.slider = -1..1",
        "--count",
        "11",
        "--seed",
        "3",
        "--every",
        "250",
    ];
    let csv = dynamics(&[&["rollouts", &cart][..], &LOADED, &vary].concat()).ok();
    let (head, rows) = table(&csv);
    let expected = "rollout,time,m,c,start.q.hinge,start.v.slider,q.slider,q.hinge,v.slider,v.hinge,kinetic,potential,\
                    elastic,total";
    assert_eq!(head.join(","), expected);
    assert_eq!(rows.len(), 33);
    let replaced = |text: &str, m: f64, c: f64| {
        text.replace("point(m)", &format!("point({m:?})")).replace("= c", &format!("= {c:?}"))
    };
    for (rollout, rows) in rows.chunks(3).enumerate() {
        let [_, _, m, c, q, v] = *rows[0].first_chunk().unwrap();
        assert!(rows.iter().all(|row| row[0] == rollout as f64 && row[2..6] == [m, c, q, v]));
        assert!((0.1..2.0).contains(&m) && (0.01..1.0).contains(&c) && (-1.0..1.0).contains(&v));
        assert_eq!((rows[0][7], rows[0][8]), (q, v));
        let options = LOADED.map(|option| replaced(option, m, c));
        let (q, v) = (format!("hinge={q:?}"), format!("slider={v:?}"));
        let options: Vec<&str> = options.iter().map(String::as_str).collect();
        let alone = ["simulate", &cart, "--every", "250", "--q", &q, "--v", &v];
        let alone = dynamics(&[&alone[..], &options].concat()).ok();
        for (row, alone) in rows.iter().zip(table(&alone).1) {
            assert_eq!(row[1], alone[0]);
            for (found, expected) in row[6..].iter().zip(&alone[1..9]) {
                assert!((found - expected).abs() < TOLERANCE, "{row:?} is not {alone:?}");
            }
        }
    }
}

/// Quaternions too; and the other method, whose error of first order is the one expected.
#[test]
fn a_free_body_rolls_out_as_it_is_simulated() {
    let hyq = model("hyq");
    let common = ["--base", "free", "--time", "0.02", "--q", "root_joint.z=0.6,lf_kfe_joint=-1.2"];
    let rolled = |step: &str, method: &str| {
        let options = ["rollouts", &hyq, "--step", step, "--method", method, "--v", "root_joint.wz=2"];
        table(&dynamics(&[&options[..], &common].concat()).ok()).1.pop().unwrap()
    };
    let alone = ["simulate", &hyq, "--step", "1e-3", "--v", "root_joint.wz=2", "--every", "20"];
    let alone = table(&dynamics(&[&alone[..], &common].concat()).unstopped()).1.pop().unwrap();
    let error = |row: &[f64]| {
        row[2..39].iter().zip(&alone[1..38]).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()))
    };
    assert!(error(&rolled("1e-3", "rk4")) < 1e-8, "{}", error(&rolled("1e-3", "rk4")));
    let [coarse, fine] = ["1e-3", "5e-4"].map(|step| error(&rolled(step, "euler")));
    assert!((1.8..2.2).contains(&(coarse / fine)), "{coarse} and {fine}");
}

#[test]
fn a_table_is_one_of_its_seed_alone() {
    let cart = model("cartpole");
    let vary = ["--vary", "m = uniform(0.1, 2)", "--vary", "c = 0.1", "--count", "40", "--every", "100"];
    let run = |more: &[&str]| dynamics(&[&["rollouts", &cart][..], &LOADED, &vary, more].concat()).ok();
    let first = run(&["--seed", "5"]);
    for threads in ["1", "2", "3"] {
        assert!(run(&["--seed", "5", "--threads", threads]) == first, "{threads} threads");
    }
    assert!(run(&["--seed", "6"]) != first && run(&[]) == run(&["--seed", "0"]));
    // A part of it is what fewer give, and one that stands behind changes nothing before it.
    let fewer = ["--vary", "m = uniform(0.1, 2)", "--vary", "c = 0.1", "--vary", "q.slider = normal(0, 0)"];
    let fewer =
        [&["rollouts", &cart][..], &LOADED, &fewer, &["--count", "9", "--every", "100", "--seed", "5"]];
    let fewer = dynamics(&fewer.concat()).ok();
    for (few, many) in table(&fewer).1.iter().zip(table(&first).1) {
        assert_eq!((&few[..4], &few[5..]), (&many[..4], &many[4..]));
    }
}

#[test]
fn a_grid_goes_through_all_and_draws_the_same_at_each_point() {
    let cart = model("cartpole");
    let grid = [
        "--grid",
        "m = 0, 500g, 1",
        "--grid",
        "c = linspace(0, 0.2, 2)",
        "--vary",
        "q.hinge = -1..1",
        "--count",
        "2",
    ];
    let (_, rows) = table(dynamics(&[&["rollouts", &cart][..], &LOADED, &grid].concat()).ok().leak());
    let starts: Vec<&[f64]> = rows.iter().step_by(2).map(|row| &row[2..5]).collect();
    assert_eq!(rows.len(), 24);
    for (k, start) in starts.iter().enumerate() {
        let expected = [starts[k % 2][0], [0.0, 0.5, 1.0][k / 4], [0.0, 0.2][k / 2 % 2]];
        assert_eq!(start, &expected, "{k}");
    }
}

/// The numbers of both files are the same to the last bit; a group of rows is no bound.
#[test]
fn parquet_has_what_csv_has_and_how_it_was_made() {
    let (cart, here) = (model("cartpole"), folder("rollouts"));
    let vary = [
        "--vary",
        "m = uniform(0.1, 2)",
        "--vary",
        "c = 0.1",
        "--count",
        "300",
        "--every",
        "1",
        "--seed",
        "7",
    ];
    let run = |name: &str, more: &[&str]| {
        let path = here.join(name).to_str().unwrap().to_owned();
        let out = ["-o", &path];
        dynamics(&[&["rollouts", &cart][..], &LOADED, &vary, &out, more].concat()).ok();
        path
    };
    let (csv, parquet) = (run("a.csv", &[]), run("a.parquet", &["--threads", "2"]));
    let again = run("b.parquet", &["--threads", "1"]);
    assert!(std::fs::read(&parquet).unwrap() == std::fs::read(again).unwrap(), "the same bytes");
    assert!(!Path::new(&format!("{csv}.part")).exists() && !Path::new(&format!("{parquet}.part")).exists());
    let csv = std::fs::read_to_string(csv).unwrap();
    let (head, rows) = table(&csv);
    let reader = SerializedFileReader::new(File::open(parquet).unwrap()).unwrap();
    let metadata = reader.metadata().file_metadata();
    let names: Vec<&str> = metadata.schema_descr().columns().iter().map(|column| column.name()).collect();
    assert_eq!(names, head);
    assert!(reader.num_row_groups() > 1 && rows.len() == 300 * 501);
    for (row, expected) in reader.get_row_iter(None).unwrap().zip(&rows) {
        let row = row.unwrap();
        assert_eq!(row.get_long(0).unwrap() as f64, expected[0]);
        assert!(
            (1..head.len()).all(|k| row.get_double(k).unwrap() == expected[k]),
            "{row} is not {expected:?}"
        );
    }
    let story = metadata.key_value_metadata().unwrap();
    let story = |key: &str| {
        story.iter().find(|entry| entry.key == key).and_then(|entry| entry.value.clone()).unwrap()
    };
    assert_eq!(story("dynamics.seed"), "7");
    assert_eq!(story("dynamics.version"), env!("CARGO_PKG_VERSION"));
    assert!(
        story("dynamics.command").contains("--vary 'm = uniform(0.1, 2)'"),
        "{}",
        story("dynamics.command")
    );
    assert!(metadata.created_by().unwrap().starts_with("dynamics "));
}

/// A spring that pushes away throws one of the two poles out of all numbers.
#[test]
fn a_rollout_that_is_lost_is_named_and_the_others_are_written() {
    let (cart, here) = (model("cartpole"), folder("lost"));
    let out = here.join("lost.csv");
    let arguments = [
        "rollouts",
        &cart,
        "--time",
        "1",
        "--step",
        "1e-2",
        "--every",
        "10",
        "--joint",
        "hinge, damping = c",
        "--grid",
        "c = 0, 1e9, 0.1",
        "--v",
        "hinge=1",
        "-o",
        out.to_str().unwrap(),
    ];
    let complaint = dynamics(&arguments).failed(1);
    assert!(complaint.contains("1 of 3 rollouts did not stay finite: 1 after 0."), "{complaint}");
    let csv = std::fs::read_to_string(&out).unwrap();
    let (_, rows) = table(&csv);
    let of = |rollout: f64| rows.iter().filter(|row| row[0] == rollout).count();
    assert!(of(0.0) == 11 && of(2.0) == 11 && (1..11).contains(&of(1.0)), "{csv}");
    let alone = dynamics(&[&arguments[..11], &["c = 0", "--v", "hinge=1"]].concat()).ok();
    assert!(csv.lines().skip(1).take(11).eq(alone.lines().skip(1)), "its neighbour makes no difference");
}

#[test]
fn mistakes_are_shown_where_they_are() {
    let (cart, here) = (model("cartpole"), folder("rollout_mistakes"));
    let run = |more: &[&str]| dynamics(&[&["rollouts", &cart][..], &LOADED, more].concat()).failed(1);
    let both =
        ["--vary", "m = uniform(2, 1)", "--vary", "q.hing = 3", "--vary", "d = 1", "--grid", "c = 0m, 1"];
    insta::assert_snapshot!(run(&both));
    insta::assert_snapshot!(run(&["--vary", "m = gauss(2, 1)", "--grid", "c = 1,, 2", "--vary", "hinge"]));
    for (more, expected) in [
        (&["--vary", "m = 1"][..], "there is no field `c`"),
        (&["--vary", "m = 1", "--vary", "m = 2", "--vary", "c = 1"], "`m` is given values twice"),
        (&["--vary", "m = normal(1, 1)", "--vary", "c = 1", "--count", "100"], "the mass `m` is -"),
        (&["--vary", "m = 1", "--vary", "c = 1", "--vary", "type = 1"], "`type` cannot stand for a number"),
        (&["--vary", "m = 1", "--vary", "c = 1", "-o", "x.json"], "ends neither in `.csv` nor in `.parquet`"),
        (&["--vary", "m = 1", "--vary", "c = 1", "-o", "no/such/x.csv"], "no/such/x.csv cannot be written"),
        (
            &[
                "--vary",
                "m = 1",
                "--vary",
                "c = 1",
                "--grid",
                "q.hinge = linspace(0, 1, 1000000)",
                "--count",
                "9007199254740992",
            ],
            "are too many rollouts",
        ),
    ] {
        assert!(run(more).contains(expected), "{more:?}: {}", run(more));
    }
    let free = ["--base", "free", "--time", "1", "--step", "1", "--vary", "q.root_joint.qx = 0..1"];
    let complaint = dynamics(&[&["rollouts", &model("hyq")][..], &free].concat()).failed(1);
    assert!(complaint.contains("`q.root_joint.qx` is a part of a quaternion"), "{complaint}");
    let long = ["--time", "1e4", "--step", "1e-6", "--every", "1"];
    let complaint = dynamics(&[&["rollouts", &cart][..], &long].concat()).failed(1);
    assert!(complaint.contains("which are too many to keep"), "{complaint}");
    let over = here.join("robot.csv");
    std::fs::copy(super::robots().join(&cart), &over).unwrap();
    let over = over.to_str().unwrap();
    let complaint = dynamics(&["rollouts", over, "--time", "1", "--step", "1", "-o", over]).failed(1);
    assert!(complaint.contains("it is the input"), "{complaint}");
}

/// A slider that follows the hinge behind it does not make its angle a length.
#[test]
fn a_coordinate_has_the_unit_of_its_joint() {
    let cart = model("cartpole");
    let follower = ["--joint", "slider, mimic = hinge, ratio = 0.1m"];
    let rolled = |value: &str| {
        let arguments = ["rollouts", &cart, "--time", "0", "--step", "1", "--vary", value];
        dynamics(&[&arguments[..], &follower].concat())
    };
    let (_, rows) = table(rolled("q.hinge = 30deg").ok().leak());
    assert!((rows[0][2] - std::f64::consts::FRAC_PI_6).abs() < 1e-15, "{rows:?}");
    assert!(rolled("q.hinge = 30mm").failed(1).contains("`30mm` has the unit m, and `q.hinge` rad"));
    let here = folder("unit_of_a_leader");
    let generate = [
        "generate",
        &cart,
        "--lang",
        "c",
        "--name",
        "cart",
        "--outputs",
        "mass_matrix",
        "-o",
        here.to_str().unwrap(),
    ];
    dynamics(&[&generate[..], &follower].concat()).ok();
    let header = std::fs::read_to_string(here.join("cart.h")).unwrap();
    assert!(
        header.contains("q[0]  hinge, rad, ") && header.contains("v[0]  hinge, rad/s, N m, "),
        "{header}"
    );
}
