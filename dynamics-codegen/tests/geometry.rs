//! Placements, axes and inertias of specifications, compared with their definitions at numbers.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::model::{self, Motion, Tree};
use dynamics_codegen::spatial::{Matrix3, Pose, PseudoInertia, Symmetric3, Vector3};
use dynamics_codegen::spec;
use dynamics_codegen::symbolic::{Evaluator, Graph};

/// The tree in numbers. The fields `l`, `h`, `u` are 0.4 m, 0.7 m and 0.3 rad.
fn tree(lines: &str) -> Tree<f64> {
    let text = format!("{lines} struct Robot<T> {{ l: T, h: T, u: T, m: T }}");
    let (graph, mut diags) = (Graph::new(), Diagnostics::new());
    let spec = spec::parse(&syn::parse_str(&text).unwrap(), &mut diags);
    let model = model::build(&spec, &graph, &mut diags);
    let errors = diags.into_text();
    let model = model.unwrap_or_else(|| panic!("{errors}"));
    let value = |name: &str| match name {
        "l" => 0.4,
        "h" => 0.7,
        "u" => 0.3,
        _ => 2.0,
    };
    let mut evaluator = Evaluator::new(&graph, |symbol| value(&model.parameters[symbol.0 as usize].name));
    model.tree.map(|entry| evaluator.value(entry))
}

const BODY: &str = "#[body(a, mass = 1, inertia = diag(1, 1, 1))]";

/// The pose of the last frame, all coordinates at `q`.
fn tip(tree: &Tree<f64>, q: f64) -> Pose<f64> {
    let mut poses: Vec<Pose<f64>> = vec![];
    for link in &tree.links {
        let parent = link.parent.map_or(Pose::identity(), |parent| poses[parent]);
        let moved = match link.motion {
            Motion::Revolute => rz(q),
            Motion::Prismatic => shift(0.0, 0.0, q),
            Motion::Ball | Motion::Free => unreachable!("these robots have one degree of freedom a joint"),
        };
        poses.push(parent * link.placement * moved);
    }
    let frame = tree.frames.last().unwrap();
    frame.link.map_or(Pose::identity(), |link| poses[link]) * frame.pose
}

fn rx(angle: f64) -> Pose<f64> {
    Pose::rotation(Matrix3::rotation_x(angle.cos(), angle.sin()))
}
fn ry(angle: f64) -> Pose<f64> {
    Pose::rotation(Matrix3::rotation_y(angle.cos(), angle.sin()))
}
fn rz(angle: f64) -> Pose<f64> {
    Pose::rotation(Matrix3::rotation_z(angle.cos(), angle.sin()))
}
fn shift(x: f64, y: f64, z: f64) -> Pose<f64> {
    Pose::translation(Vector3([x, y, z]))
}
/// Rodrigues' rotation about a unit vector.
fn about(axis: [f64; 3], angle: f64) -> Pose<f64> {
    let k = Matrix3::skew(Vector3(axis));
    Pose::rotation(Matrix3::identity() + k.scale(angle.sin()) + (k * k).scale(1.0 - angle.cos()))
}

#[track_caller]
fn assert_same(found: Pose<f64>, expected: Pose<f64>) {
    let entries = |pose: Pose<f64>| [pose.rotation.0.concat(), pose.translation.0.to_vec()].concat();
    for (a, b) in entries(found).into_iter().zip(entries(expected)) {
        assert!((a - b).abs() < 1e-14, "{found:?}\n{expected:?}");
    }
}

const Q: f64 = 0.37;

#[test]
fn dh_is_its_product_and_its_body_is_distal() {
    let spec = |kind: &str| tree(&format!("#[joint(q: {kind}, world -> a, dh(l, u, h, 20deg))] {BODY}"));
    let theta = 20f64.to_radians();
    let expected = |theta: f64, d: f64| rz(theta) * shift(0.0, 0.0, d) * shift(0.4, 0.0, 0.0) * rx(0.3);
    assert_same(tip(&spec("revolute"), Q), expected(theta + Q, 0.7));
    assert_same(tip(&spec("prismatic"), Q), expected(theta, 0.7 + Q));
    let fixed = tree(&format!(
        "#[joint(q: revolute(z), world -> a)] {BODY} #[joint(f: fixed, a -> b, dh(l, u, h, 20deg))]"
    ));
    assert_same(tip(&fixed, Q), rz(Q) * expected(theta, 0.7));
}

#[test]
fn modified_dh_is_its_product_and_its_body_is_the_moving_frame() {
    let spec = |kind: &str| tree(&format!("#[joint(q: {kind}, world -> a, mdh(l, u, h, 20deg))] {BODY}"));
    let theta = 20f64.to_radians();
    let expected = |theta: f64, d: f64| rx(0.3) * shift(0.4, 0.0, 0.0) * rz(theta) * shift(0.0, 0.0, d);
    assert_same(tip(&spec("revolute"), Q), expected(theta + Q, 0.7));
    assert_same(tip(&spec("prismatic"), Q), expected(theta, 0.7 + Q));
}

#[test]
fn a_screw_turns_about_a_line_of_the_parent_at_zero() {
    let axis = [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0];
    let line = |q: f64| shift(0.1, 0.4, 0.7) * about(axis, q) * shift(-0.1, -0.4, -0.7);
    let screw = "screw([2, -1, 2], [0.1, l, h])";
    let plain = tree(&format!("#[joint(q: revolute, world -> a, {screw})] {BODY}"));
    assert_same(tip(&plain, Q), line(Q));
    let placed =
        tree(&format!("#[joint(q: revolute, world -> a, {screw}, at = [l, 0, 1], rpy = [0, u, 0])] {BODY}"));
    assert_same(tip(&placed, Q), line(Q) * shift(0.4, 0.0, 1.0) * ry(0.3));
    let sliding = tree(&format!("#[joint(q: prismatic, world -> a, {screw})] {BODY}"));
    assert_same(tip(&sliding, Q), shift(axis[0] * Q, axis[1] * Q, axis[2] * Q));
}

#[test]
fn every_axis_is_in_the_frame_that_at_and_rpy_give() {
    let root = 0.5f64.sqrt();
    let axes = [
        ("x", [1.0, 0.0, 0.0]),
        ("y", [0.0, 1.0, 0.0]),
        ("z", [0.0, 0.0, 1.0]),
        ("-x", [-1.0, 0.0, 0.0]),
        ("-y", [0.0, -1.0, 0.0]),
        ("-z", [0.0, 0.0, -1.0]),
        ("[0, -3, 0]", [0.0, -1.0, 0.0]),
        ("[1, 0, -1]", [root, 0.0, -root]),
        ("[-0.6, 0.8, 0]", [-0.6, 0.8, 0.0]),
        ("[-2, 1, 2]", [-2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0]),
    ];
    for (text, axis) in axes {
        let place = shift(0.4, 0.2, 0.7) * rz(0.3) * ry(-0.2) * rx(1.1);
        let spec = |kind: &str| {
            tree(&format!(
                "#[joint(q: {kind}({text}), world -> a, at = [l, 0.2, h], rpy = [1.1, -0.2, u])] {BODY}"
            ))
        };
        assert_same(tip(&spec("continuous"), Q), place * about(axis, Q));
        assert_same(tip(&spec("prismatic"), Q), place * shift(axis[0] * Q, axis[1] * Q, axis[2] * Q));
    }
}

#[test]
fn rotations_are_snapped_only_next_to_right_angles() {
    let entry = |angle: &str, option: &str| {
        let text = format!("{option} #[joint(q: revolute(z), world -> a, rpy = [{angle}, 0, 0])] {BODY}");
        tree(&text).links[0].placement.rotation.0[1][1]
    };
    assert_eq!(entry("1.57079632679", ""), 0.0);
    assert_eq!(entry("90deg", "#[dynamics(snap = off)]"), 0.0);
    assert!((entry("1.57079632679", "#[dynamics(snap = off)]") - 4.9e-12).abs() < 1e-13);
    assert!(entry("1.5708", "") < -3e-6);
}

#[test]
fn inertia_is_about_the_centre_of_mass_in_turned_axes() {
    let text = "#[joint(q: revolute(y), world -> a)] #[body(a, mass = m, com = [0.1, l, -0.2],
        inertia = tensor(3, 0.1, -0.2, 4, 0.3, 5), inertia_rpy = [0.4, 0.5, u])]";
    let tree = tree(text);
    let turned = (rz(0.3) * ry(0.5) * rx(0.4)).rotation;
    let tensor = Symmetric3 { xx: 3.0, xy: 0.1, xz: -0.2, yy: 4.0, yz: 0.3, zz: 5.0 }.rotated(turned);
    let expected =
        PseudoInertia::new(2.0, Vector3([0.1, 0.4, -0.2]), tensor).transformed(tree.frames[0].pose);
    assert_inertia(tree.links[0].inertia, expected);
}

#[track_caller]
fn assert_inertia(found: PseudoInertia<f64>, expected: PseudoInertia<f64>) {
    let entries =
        |i: PseudoInertia<f64>| [vec![i.mass], i.first.0.to_vec(), i.second.full().0.concat()].concat();
    for (a, b) in entries(found).into_iter().zip(entries(expected)) {
        assert!((a - b).abs() < 1e-13, "{found:?}\n{expected:?}");
    }
}

#[test]
fn welded_bodies_are_one_link_and_what_is_welded_to_the_world_is_its() {
    let text = "#[joint(base: fixed, world -> pedestal, at = [0, 0, 1])] #[body(pedestal, solid = point(7))]
        #[joint(q: revolute(z), pedestal -> a)] #[body(a, mass = 1, com = [l, 0, 0], inertia = diag(1, 2, 2.5))]
        #[joint(grip: fixed, a -> tool, at = [h, 0, 0], rpy = [0, 90deg, 0])]
        #[body(tool, mass = m, com = [0, 0, 0.1], inertia = diag(0.1, 0.2, 0.25))]
        #[joint(tcp: fixed, tool -> tip, at = [0, 0, 0.2])]";
    let tree = tree(text);
    let own = PseudoInertia::new(1.0, Vector3([0.4, 0.0, 0.0]), Symmetric3::diagonal(1.0, 2.0, 2.5));
    let tool = PseudoInertia::new(2.0, Vector3([0.0, 0.0, 0.1]), Symmetric3::diagonal(0.1, 0.2, 0.25));
    let grip = shift(0.7, 0.0, 0.0) * ry(90f64.to_radians());
    assert_eq!(tree.links.len(), 1);
    assert_inertia(tree.links[0].inertia, own + tool.transformed(grip));
    assert_inertia(tree.base, PseudoInertia::new(7.0, Vector3([0.0, 0.0, 1.0]), Symmetric3::zero()));
    let names: Vec<_> = tree.frames.iter().map(|frame| frame.name.as_str()).collect();
    assert_eq!(names, ["pedestal", "a", "tool", "tip"]);
    assert_same(tip(&tree, Q), shift(0.0, 0.0, 1.0) * rz(Q) * grip * shift(0.0, 0.0, 0.2));
}

#[test]
fn solids_have_the_inertia_of_the_textbook() {
    let moments = |solid: &str| {
        let text = format!("#[joint(q: prismatic(z), world -> a)] #[body(a, solid = {solid})]");
        let inertia = tree(&text).links[0].inertia.rotational();
        [inertia.xx, inertia.yy, inertia.zz].map(|moment| (moment * 1e9).round() / 1e9)
    };
    assert_eq!(moments("cuboid(12, [1, 2, 300cm])"), [13.0, 10.0, 5.0]);
    assert_eq!(moments("cylinder(12, 1, 2)"), [7.0, 7.0, 6.0]);
    assert_eq!(moments("cylinder(12, 1, 2, y)"), [7.0, 6.0, 7.0]);
    assert_eq!(moments("sphere(5, 1)"), [2.0; 3]);
    assert_eq!(moments("rod(m, 6)"), [6.0, 6.0, 0.0]);
    assert_eq!(moments("rod(m, 6, x)"), [0.0, 6.0, 6.0]);
    assert_eq!(moments("point(3)"), [0.0; 3]);
}

/// Rotations that are right but for the last digits of a file, and axes that are all but parallel: nothing is
/// divided by what is nearly zero. Found on the iCub, whose frames are turned by 1.5e-11 rad.
#[test]
fn nearly_aligned_frames_lose_no_digits() {
    for tilt in ["1.53e-11", "-3e-9", "2e-7", "3.7e-6", "1e-4", "0.02"] {
        for quarter in ["0", "1.5708", "1.57079632679", "3.1416", "90deg"] {
            let text = format!(
                "#[joint(a: revolute(z), world -> l1, at = [0.1, 0, 0.2], rpy = [{tilt}, 1.5708, {quarter}])]
                 #[body(l1, mass = 2, com = [0.1, 0.02, -0.03], inertia = tensor(0.2, 0.01, 0.02, 0.3, 0.03, 0.25))]
                 #[joint(b: revolute(z), l1 -> l2, at = [0.2, 0.1, 0.3], rpy = [{quarter}, {tilt}, {tilt}])]
                 #[body(l2, mass = 1, com = [0, 0.1, 0], inertia = tensor(0.2, 0.01, 0.02, 0.3, 0.03, 0.25))]
                 #[joint(c: revolute([{tilt}, 1, 0]), l2 -> l3, at = [0.3, 0.1, 0.1], rpy = [0, {quarter}, {tilt}])]
                 #[body(l3, mass = 1, com = [0, 0.1, 0.2], inertia = diag(0.1, 0.12, 0.15))]
                 struct Tilted;"
            );
            // The expansion compares itself with the plain recursion, to 1e-9.
            let result = dynamics_codegen::generate(&syn::parse_str(&text).unwrap());
            let mistakes = result.err().map(dynamics_codegen::diagnostics::Diagnostics::into_text);
            assert_eq!(mistakes, None, "tilt {tilt}, quarter {quarter}");
        }
    }
}
