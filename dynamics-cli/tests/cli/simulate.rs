//! `dynamics simulate`: energy stays, and the table is as asked for.

use super::{dynamics, dynamics_on, folder, model};

/// The rows of a table, without its head.
fn rows(csv: &str) -> Vec<Vec<f64>> {
    csv.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
}

#[test]
fn a_swinging_pole_keeps_its_energy() {
    let arguments = ["simulate", &model("cartpole"), "--time", "2", "--step", "1e-3", "--q", "0,1"];
    let csv = dynamics(&[&arguments[..], &["--every", "100"]].concat()).unstopped();
    let head = csv.lines().next().unwrap();
    assert_eq!(head, "time,q.slider,q.hinge,v.slider,v.hinge,kinetic,potential,elastic,total,drift");
    let rows = rows(&csv);
    assert_eq!(rows.len(), 21);
    for (k, row) in rows.iter().enumerate() {
        assert_eq!(row[0], k as f64 / 10.0);
        assert_eq!(row[8], row[5] + row[6] + row[7]);
        assert_eq!(row[9], row[8] - rows[0][8]);
        assert!(row[9].abs() < 1e-9, "{row:?}");
    }
    let moved = rows.iter().map(|row| (row[2] - 1.0).abs()).fold(0.0, f64::max);
    assert!(moved > 1.0);
}

#[test]
fn the_last_step_ends_with_the_time() {
    let arguments = ["simulate", &model("scara"), "--time", "0.25", "--step", "0.1", "--every", "2"];
    let times: Vec<f64> = rows(&dynamics(&arguments).unstopped()).iter().map(|row| row[0]).collect();
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
    let q = ["x", "y", "z", "qx", "qy", "qz", "qw"].map(|part| format!("q.root_joint.{part}")).join(",");
    let v = ["vx", "vy", "vz", "wx", "wy", "wz"].map(|part| format!("v.root_joint.{part}")).join(",");
    assert_eq!(head, format!("time,{q},{v},kinetic,potential,elastic,total,drift"));
    let rows = rows(&csv);
    let end = &rows[1];
    assert!(end[18].abs() < 1e-9 * end[14], "{end:?}");
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

/// A brick that nothing holds.
const BRICK: &str = r#"<robot name="brick"><link name="brick"><inertial><mass value="2"/>
  <inertia ixx="1" ixy="0" ixz="0" iyy="2" iyz="0" izz="2.5"/></inertial></link></robot>"#;

fn tossed(step: &str, v: &str) -> Vec<Vec<f64>> {
    let arguments = ["simulate", "-", "--base", "free", "--time", "1", "--step", step, "--v", v];
    rows(&dynamics_on(BRICK.as_bytes(), &arguments).ok())
}

/// About a main axis it turns evenly, while it falls; the speeds are in its own axes.
#[test]
fn a_tossed_brick_turns_and_falls() {
    let rows = tossed("1e-2", "root_joint.vx=3,root_joint.vz=4,root_joint.wz=-2.5");
    for row in &rows {
        let t = row[0];
        let (sine, cosine) = (-2.5 * t / 2.0_f64).sin_cos();
        let fallen = 4.0 * t - 0.5 * 9.81 * t * t;
        let (turn, speed) = (-2.5 * t, 4.0 - 9.81 * t);
        let expected = [3.0 * t, 0.0, fallen, 0.0, 0.0, sine, cosine];
        let speeds = [3.0 * turn.cos(), -3.0 * turn.sin(), speed, 0.0, 0.0, -2.5];
        for (found, expected) in row[1..].iter().zip(expected.iter().chain(&speeds)) {
            // The method's error, h⁴ in size.
            assert!((found - expected).abs() < 1e-7, "{t}: {found} is not {expected}");
        }
        assert!(row[18].abs() < 1e-6, "{row:?}");
    }
    assert_eq!(rows.len(), 101);
}

/// Tumbling has no end of turning axes: the order four shows only if steps stay on the manifold.
#[test]
fn a_tumbling_brick_is_followed_to_the_fourth_order() {
    let last =
        |step: &str| tossed(step, "root_joint.wx=0.1,root_joint.wy=4,root_joint.wz=0.1").pop().unwrap();
    let exact = last("1e-3");
    let off = |row: &[f64]| (1..14).map(|k| (row[k] - exact[k]).abs()).fold(0.0, f64::max);
    let (coarse, fine) = (last("4e-2"), last("2e-2"));
    let ratio = off(&coarse) / off(&fine);
    assert!((12.0..20.0).contains(&ratio), "{ratio}");
    let norm = coarse[4..8].iter().map(|x| x * x).sum::<f64>();
    assert!((norm - 1.0).abs() < 1e-15, "{norm}");
}

/// A pole that falls and swings, after a second: its angle and its speed.
fn swung(step: &str, method: &[&str]) -> [f64; 2] {
    let cart = model("cartpole");
    let arguments = ["simulate", &cart, "--time", "1", "--step", step, "--q", "0,1", "--every", "1000000"];
    let rows = rows(&dynamics(&[&arguments[..], method].concat()).unstopped());
    assert_eq!(rows.len(), 2);
    [rows[1][2], rows[1][4]]
}

/// Methods of order 1, 4 and 5 come to the same end, each with its error.
#[test]
fn methods_agree_as_well_as_they_can() {
    let off = |found: [f64; 2], exact: [f64; 2]| f64::hypot(found[0] - exact[0], found[1] - exact[1]);
    let adaptive = ["--method", "adaptive", "--tolerance", "1e-12"];
    let exact = swung("0.1", &adaptive);
    // Its rows come from the polynomials of its own steps, and do not change these.
    assert_eq!(swung("0.01", &adaptive), exact);
    assert!(off(swung("1e-3", &["--method", "rk4"]), exact) < 1e-9);
    assert_eq!(swung("1e-3", &[]), swung("1e-3", &["--method", "rk4"]));
    let euler = ["1e-3", "5e-4"].map(|step| off(swung(step, &["--method", "euler"]), exact));
    assert!((euler[0] / euler[1] - 2.0).abs() < 0.05 && euler[0] > 1e-5, "{euler:?}");
    let loose = off(swung("0.1", &["--method", "adaptive", "--tolerance", "1e-4"]), exact);
    assert!(loose > 1e-9 && loose < 1e-2, "{loose}");
}

/// Between the ends of long steps too a brick is on its manifold, and turns evenly.
#[test]
fn rows_between_long_steps_are_of_the_motion() {
    let v = "root_joint.vx=3,root_joint.vz=4,root_joint.wz=-2.5";
    let arguments = ["simulate", "-", "--base", "free", "--time", "1", "--step", "0.01", "--v", v];
    let adaptive = ["--method", "adaptive", "--tolerance", "1e-10"];
    let rows = rows(&dynamics_on(BRICK.as_bytes(), &[&arguments[..], &adaptive].concat()).ok());
    assert_eq!(rows.len(), 101);
    for (k, row) in rows.iter().enumerate() {
        let t = k as f64 / 100.0;
        let (sine, cosine) = (-2.5 * t / 2.0_f64).sin_cos();
        let expected = [t, 3.0 * t, 0.0, 4.0 * t - 0.5 * 9.81 * t * t, 0.0, 0.0, sine, cosine];
        for (found, expected) in row.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-8, "{t}: {found} is not {expected}");
        }
        let norm = row[4..8].iter().map(|x| x * x).sum::<f64>();
        assert!((norm - 1.0).abs() < 1e-15, "{norm}");
    }
}

/// A cart on a spring and a damper: `x = e^(−ζωt)·(cos ω_d t + …)`, and what the damper takes is missing.
#[test]
fn springs_and_dampers_of_options_act() {
    let cart = model("cartpole");
    let joints = ["--joint", "slider, stiffness = 11, damping = 0.55", "--joint", "hinge, locked = 0"];
    let arguments = ["simulate", &cart, "--time", "1", "--step", "1e-2", "--q", "slider=0.3"];
    let csv = dynamics(&[&arguments[..], &joints].concat()).ok();
    assert_eq!(csv.lines().next().unwrap(), "time,q.slider,v.slider,kinetic,potential,elastic,total,drift");
    let (mass, k, d) = (1.1, 11.0, 0.55_f64);
    let decay = d / (2.0 * mass);
    let omega = (k / mass - decay * decay).sqrt();
    for row in rows(&csv) {
        let (sine, cosine) = (omega * row[0]).sin_cos();
        let expected = 0.3 * (-decay * row[0]).exp() * (cosine + decay / omega * sine);
        assert!((row[1] - expected).abs() < 1e-7, "{row:?}");
        assert!((row[5] - 0.5 * k * row[1] * row[1]).abs() < 1e-12 && row[7] <= 0.0, "{row:?}");
    }
}

/// What attributes accept for a number, a start accepts; plain numbers are in SI units.
#[test]
fn a_start_may_have_units() {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, FRAC_PI_6};
    let cart = model("cartpole");
    let begun = |options: &[&str]| {
        let arguments = ["simulate", &cart, "--time", "0", "--step", "1"];
        rows(&dynamics(&[&arguments[..], options].concat()).ok()).remove(0)[1..5].to_vec()
    };
    for (options, expected) in [
        (&["--q", "-0.5,0.25", "--v", "1e-1,.5"][..], [-0.5, 0.25, 0.1, 0.5]),
        (&["--q", "300mm, 90deg"], [0.3, FRAC_PI_2, 0.0, 0.0]),
        (&["--q", "[-0.5, -pi / 4]"], [-0.5, -FRAC_PI_4, 0.0, 0.0]),
        (&["--q", "hinge = 0.25rad", "--v", "slider=20cm/1s, hinge=30deg / 1s"], [0.0, 0.25, 0.2, FRAC_PI_6]),
        (&["--v", "0m / 1s, -60deg / 2s"], [0.0, 0.0, 0.0, -FRAC_PI_6]),
    ] {
        let found = begun(options);
        for (found, expected) in found.iter().zip(expected) {
            // The nearest double, but for the rounding of a product.
            assert!((found - expected).abs() <= f64::EPSILON * expected.abs(), "{options:?}: {found}");
        }
    }
}

/// A stone that is thrown up along a pole, and comes down again: `x = v·t − g·t²/2`.
const STONE: &str = r#"<robot name="stone"><link name="pole"/>
  <link name="stone"><inertial><mass value="2"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="pole"/><child link="stone"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="0.3" effort="1" velocity="1"/></joint></robot>"#;

/// The numbers of a note, in order.
fn numbers(note: &str) -> Vec<f64> {
    note.split([' ', ',']).filter_map(|word| word.parse().ok()).collect()
}

/// When a limit was passed and how far is that of the parabola, though no step ends beyond the limit.
#[test]
fn who_passes_a_limit_and_comes_back_is_named() {
    let (v, g, upper, time) = (3.0_f64, 9.81_f64, 0.3, 0.55);
    assert!(v * time - 0.5 * g * time * time < upper);
    let expected = [upper, (v - (v * v - 2.0 * g * upper).sqrt()) / g, v * v / (2.0 * g)];
    for options in [&["--method", "rk4"][..], &["--method", "adaptive"]] {
        let arguments = ["simulate", "-", "--time", "0.55", "--step", "0.55", "--v", "3"];
        let arguments = [&arguments[..], options].concat();
        let done = dynamics_on(STONE.as_bytes(), &arguments);
        let note = done.stderr.as_str();
        assert!(
            note.starts_with("`slide` passes its upper limit of 0.3 m after ") && note.lines().count() == 1
        );
        for (found, expected) in numbers(note).into_iter().zip(expected) {
            // Notes have six digits.
            assert!((found - expected).abs() < 1e-5 * expected, "{note}: {expected}");
        }
        assert_eq!(numbers(note).len(), expected.len());
        // What a program reads is what it would be without limits.
        let free = STONE.replace("0.3", "9");
        assert_eq!(done.unstopped(), dynamics_on(free.as_bytes(), &arguments).ok());
    }
}

/// Two wheels that nothing turns, each at its speed.
const WHEELS: &str = r#"<robot name="wheels"><link name="base"/>
  <link name="a"><inertial><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="b"><inertial><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="one" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="other" type="revolute"><parent link="base"/><child link="b"/><axis xyz="0 0 1"/>
    <limit lower="-0.5" upper="0.5" effort="1" velocity="1"/></joint></robot>"#;

#[test]
fn limits_are_named_once_each_in_the_order_of_time() {
    let said = |options: &[&str]| {
        let arguments = ["simulate", "-", "--time", "4", "--step", "0.3"];
        let done = dynamics_on(WHEELS.as_bytes(), &[&arguments[..], options].concat());
        let said = done.stderr.clone();
        done.unstopped();
        said
    };
    let of = |v, q| said(&["--v", v, "--q", q]);
    assert_eq!(
        of("1,-1", "0,0"),
        "`other` passes its lower limit of -0.5 rad after 0.5 s, and comes to -4 rad: a simulation has no stops\n\
         `one` passes its upper limit of 2 rad after 2 s, and comes to 4 rad: a simulation has no stops\n"
    );
    // From beyond one limit through the other.
    let back =
        "`one` begins beyond its upper limit of 2 rad, and comes to 2.5 rad: a simulation has no stops\n";
    assert_eq!(of("-2,0", "2.5,0.5"), back);
    // On them, and of a bit beyond them.
    assert_eq!(of("0,0", "2,-0.5"), "");
    let bit = "`other` begins beyond its upper limit of 0.5 rad, and comes to 0.5000000000000001 rad: a simulation has no stops\n";
    assert_eq!(of("0,0", "0,0.5000000000000001"), bit);
}

/// What happened before a motion was lost is said before that.
#[test]
fn limits_passed_by_a_lost_motion_are_named() {
    let arguments = ["simulate", &model("cartpole"), "--time", "300", "--step", "100", "--v", "1,1"];
    let done = dynamics(&arguments);
    let mut lines = done.stderr.lines();
    assert!(lines.next().unwrap().starts_with("`slider` passes its "), "{}", done.stderr);
    assert!(done.code == 1 && lines.any(|line| line.starts_with("error: ")), "{}", done.stderr);
}
