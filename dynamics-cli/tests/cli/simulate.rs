//! `dynamics simulate`: energy stays, and the table is as asked for.

use super::{dynamics, folder, model};

/// The rows of a table, without its head.
fn rows(csv: &str) -> Vec<Vec<f64>> {
    csv.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
}

#[test]
fn a_swinging_pole_keeps_its_energy() {
    let arguments = ["simulate", &model("cartpole"), "--time", "2", "--step", "1e-3", "--q", "0,1"];
    let csv = dynamics(&[&arguments[..], &["--every", "100"]].concat()).ok();
    let head = csv.lines().next().unwrap();
    assert_eq!(head, "time,q.slider,q.hinge,v.slider,v.hinge,kinetic,potential,total");
    let rows = rows(&csv);
    assert_eq!(rows.len(), 21);
    for (k, row) in rows.iter().enumerate() {
        assert_eq!(row[0], k as f64 / 10.0);
        assert_eq!(row[7], row[5] + row[6]);
        assert!((row[7] - rows[0][7]).abs() < 1e-9, "{row:?}");
    }
    let moved = rows.iter().map(|row| (row[2] - 1.0).abs()).fold(0.0, f64::max);
    assert!(moved > 1.0);
}

#[test]
fn the_last_step_ends_with_the_time() {
    let arguments = ["simulate", &model("scara"), "--time", "0.25", "--step", "0.1", "--every", "2"];
    let times: Vec<f64> = rows(&dynamics(&arguments).ok()).iter().map(|row| row[0]).collect();
    assert_eq!(times, [0.0, 0.2, 0.25]);
    let arguments = ["simulate", &model("scara"), "--time", "0", "--step", "1", "--v", "-1,2,0,0"];
    assert_eq!(rows(&dynamics(&arguments).ok()).len(), 1);
}

#[test]
fn a_table_is_written_to_a_file() {
    let file = folder("simulate").join("scara.csv");
    let arguments = ["simulate", &model("scara"), "--time", "0.1", "--step", "0.01"];
    let to_file = [&arguments[..], &["-o", file.to_str().unwrap()]].concat();
    assert_eq!(dynamics(&to_file).ok(), "");
    assert_eq!(std::fs::read_to_string(file).unwrap(), dynamics(&arguments).ok());
}
