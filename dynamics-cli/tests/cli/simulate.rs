//! `dynamics simulate`: energy stays, and the table is as asked for.

use super::{dynamics, dynamics_on, folder, model};

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

/// A body in the air.
const BODY: &str = r#"<robot name="body"><link name="hull"><inertial><origin xyz="0.1 0 0"/><mass value="2"/>
  <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.25"/></inertial></link></robot>"#;

/// It falls as a stone, it tumbles, and neither its energy nor its quaternion changes size.
#[test]
fn a_body_that_nothing_holds_falls_and_tumbles() {
    let v = "0,-0.6,0,1,-2,6";
    let arguments = ["simulate", "-", "--base", "free", "--time", "1", "--step", "1e-3", "--v", v];
    let csv = dynamics_on(BODY.as_bytes(), &[&arguments[..], &["--every", "1000"]].concat()).ok();
    let head = csv.lines().next().unwrap();
    let q = "q.root_joint.x,q.root_joint.y,q.root_joint.z,q.root_joint.i,q.root_joint.j,q.root_joint.k,q.root_joint.w";
    let v = "v.root_joint.x,v.root_joint.y,v.root_joint.z,v.root_joint.wx,v.root_joint.wy,v.root_joint.wz";
    assert_eq!(head, format!("time,{q},{v},kinetic,potential,total"));
    let rows = rows(&csv);
    let [start, end] = [0, 1].map(|k| &rows[k]);
    assert!((end[16] - start[16]).abs() < 1e-9 * end[14], "{end:?}");
    let quaternion: f64 = end[4..8].iter().map(|x| x * x).sum();
    assert!((quaternion - 1.0).abs() < 1e-14, "{end:?}");
    // Its centre of mass began at (0.1, 0, 0) with the speed v + ω × r = (0, 0, 0.2).
    let [i, j, k, w] = [4, 5, 6, 7].map(|at| end[at]);
    let axis = [1.0 - 2.0 * (j * j + k * k), 2.0 * (i * j + k * w), 2.0 * (i * k - j * w)];
    let fallen = [0.1, 0.0, 0.2 - 0.5 * 9.81];
    for c in 0..3 {
        assert!((end[1 + c] + 0.1 * axis[c] - fallen[c]).abs() < 1e-8, "{c}: {end:?}");
    }
}

#[test]
fn a_table_is_written_to_a_file() {
    let file = folder("simulate").join("scara.csv");
    let arguments = ["simulate", &model("scara"), "--time", "0.1", "--step", "0.01"];
    let to_file = [&arguments[..], &["-o", file.to_str().unwrap()]].concat();
    assert_eq!(dynamics(&to_file).ok(), "");
    assert_eq!(std::fs::read_to_string(file).unwrap(), dynamics(&arguments).ok());
}
