//! The kinds of joints: how each moves, which coordinates it takes, and what keys make of it.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use dynamics_codegen::diagnostics::Diagnostics;
use dynamics_codegen::mechanics::plain;
use dynamics_codegen::model::{self, Model, Passive, Tree};
use dynamics_codegen::spatial::{Matrix3, Pose, Vector3};
use dynamics_codegen::spec;
use dynamics_codegen::symbolic::{Evaluator, Graph};

/// The fields' values.
fn field(name: &str) -> f64 {
    match name {
        "l" => 0.4,
        "u" => 0.3,
        _ => 2.0,
    }
}

/// What `look` sees of the model and of its tree in numbers.
fn with_model<R>(lines: &str, look: impl FnOnce(&Model<'_>, &Tree<f64>) -> R) -> R {
    let text = format!("{lines} struct Robot<T> {{ l: T, u: T, m: T }}");
    let (graph, mut diags) = (Graph::new(), Diagnostics::new());
    let spec = spec::parse(&syn::parse_str(&text).unwrap(), &mut diags);
    let model = model::build(&spec, &graph, &mut diags);
    let errors = diags.into_text();
    let model = model.unwrap_or_else(|| panic!("{lines}: {errors}"));
    let mut evaluator = Evaluator::new(&graph, |id| field(&model.parameters[id.0 as usize].name));
    let tree = model.tree.map(|entry| evaluator.value(entry));
    look(&model, &tree)
}

/// The pose of the last frame in the world.
fn tip(lines: &str, q: &[f64]) -> Pose<f64> {
    with_model(lines, |_, tree| {
        assert_eq!(tree.coordinates(), q.len(), "{lines}");
        plain::pose(tree, tree.frames.last().unwrap(), q)
    })
}

const BODY: &str = "#[body(a, mass = 1, inertia = diag(1, 1, 1))]";
const SECOND: &str = "#[body(b, mass = 1, inertia = diag(1, 1, 1))]";

/// The pose of a body on one joint, which is placed askew; without the place.
fn moved(kind: &str, q: &[f64]) -> Pose<f64> {
    let place = shift(0.4, 0.2, 0.7) * about([0.0, 0.0, 1.0], 0.3) * about([1.0, 0.0, 0.0], 1.1);
    let lines = format!("#[joint(q: {kind}, world -> a, at = [l, 0.2, 0.7], rpy = [1.1, 0, u])] {BODY}");
    place.inverse() * tip(&lines, q)
}

fn shift(x: f64, y: f64, z: f64) -> Pose<f64> {
    Pose::translation(Vector3([x, y, z]))
}

/// Rodrigues' rotation about a unit vector.
fn about(axis: [f64; 3], angle: f64) -> Pose<f64> {
    let k = Matrix3::skew(Vector3(axis));
    Pose::rotation(Matrix3::identity() + k.scale(angle.sin()) + (k * k).scale(1.0 - angle.cos()))
}

fn along(axis: [f64; 3], distance: f64) -> Pose<f64> {
    shift(axis[0] * distance, axis[1] * distance, axis[2] * distance)
}

/// Equal but for the rounding of a few products.
#[track_caller]
fn assert_same(found: Pose<f64>, expected: Pose<f64>) {
    let entries = |pose: Pose<f64>| [pose.rotation.0.concat(), pose.translation.0.to_vec()].concat();
    for (a, b) in entries(found).into_iter().zip(entries(expected)) {
        assert!((a - b).abs() < 1e-14, "{found:?}\n{expected:?}");
    }
}

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];
const BACK: [f64; 3] = [0.0, -1.0, 0.0];
const OBLIQUE: [f64; 3] = [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0];
const P: f64 = 0.37;
const Q: f64 = -0.52;
const R: f64 = 1.21;

#[test]
fn joints_about_one_axis_turn_and_slide() {
    for (text, axis) in [("x", X), ("-y", BACK), ("[2, -1, 2]", OBLIQUE)] {
        let pitch = 0.005 / std::f64::consts::TAU;
        assert_same(
            moved(&format!("helical({text}, 5mm / (2*pi))"), &[P]),
            about(axis, P) * along(axis, pitch * P),
        );
        assert_same(moved(&format!("helical({text}, -l)"), &[P]), about(axis, P) * along(axis, -0.4 * P));
        assert_same(moved(&format!("cylindrical({text})"), &[P, Q]), about(axis, P) * along(axis, Q));
    }
}

#[test]
fn the_second_axis_of_a_universal_joint_is_carried_by_the_first() {
    let root = 0.5_f64.sqrt();
    for (text, first, second) in [
        ("x, y", X, Y),
        ("z, -y", Z, BACK),
        ("[2, -1, 2], z", OBLIQUE, Z),
        ("y, [0, 1, 1]", Y, [0.0, root, root]),
    ] {
        assert_same(moved(&format!("universal({text})"), &[P, Q]), about(first, P) * about(second, Q));
    }
}

/// The in-plane axes follow the normal in the cycle x, y, z; those of an oblique one begin with `e × n`, e being the
/// axis to which the normal is the least inclined.
#[test]
fn a_planar_joint_slides_across_its_normal_and_turns_about_it() {
    let fifth = 0.2_f64.sqrt();
    for (text, normal, first, second) in [
        ("z", Z, X, Y),
        ("x", X, Y, Z),
        ("y", Y, Z, X),
        ("-z", [0.0, 0.0, -1.0], Y, X),
        ("-y", BACK, X, Z),
        ("[0, 0, 3]", Z, X, Y),
        ("[0, 1, 2]", [0.0, fifth, 2.0 * fifth], X, [0.0, 2.0 * fifth, -fifth]),
        (
            "[2, -1, 2]",
            OBLIQUE,
            [0.5_f64.sqrt(), 0.0, -0.5_f64.sqrt()],
            [1.0 / 18.0_f64.sqrt(), 4.0 / 18.0_f64.sqrt(), 1.0 / 18.0_f64.sqrt()],
        ),
    ] {
        let expected = along(first, P) * along(second, Q) * about(normal, R);
        assert_same(moved(&format!("planar({text})"), &[P, Q, R]), expected);
    }
}

#[test]
fn translations_balls_and_free_joints_move_in_the_joints_frame() {
    assert_same(moved("translation", &[P, Q, R]), shift(P, Q, R));
    let (sine, cosine) = (0.5 * P).sin_cos();
    let [i, j, k] = OBLIQUE.map(|part| part * sine);
    assert_same(moved("ball", &[i, j, k, cosine]), about(OBLIQUE, P));
    assert_same(moved("free", &[P, Q, R, i, j, k, cosine]), shift(P, Q, R) * about(OBLIQUE, P));
}

#[test]
fn a_screw_gives_the_line_of_every_kind_with_one_axis() {
    let line = shift(0.1, 0.4, 0.7);
    let place = shift(0.4, 0.0, 1.0) * about(Y, 0.3);
    let screw = "screw([2, -1, 2], through = [0.1, l, 0.7]), at = [l, 0, 1], rpy = [0, u, 0]";
    let at = |kind: &str, q: &[f64]| tip(&format!("#[joint(q: {kind}, world -> a, {screw})] {BODY}"), q);
    let on_line = |motion: Pose<f64>| line * motion * line.inverse() * place;
    assert_same(at("helical(l)", &[P]), on_line(about(OBLIQUE, P) * along(OBLIQUE, 0.4 * P)));
    assert_same(at("cylindrical", &[P, Q]), on_line(about(OBLIQUE, P) * along(OBLIQUE, Q)));
    let (first, second) =
        ([0.5_f64.sqrt(), 0.0, -0.5_f64.sqrt()], [1.0, 4.0, 1.0].map(|x| x / 18.0_f64.sqrt()));
    assert_same(at("planar", &[P, Q, R]), on_line(along(first, P) * along(second, Q) * about(OBLIQUE, R)));
}

/// Every kind once, in one chain.
const EVERY_KIND: &str = "
    #[joint(base: free, world -> a0)] #[body(a0, solid = sphere(1, 1))]
    #[joint(hip: universal(x, y), a0 -> a1)] #[body(a1, solid = sphere(1, 1))]
    #[joint(knee: revolute(y), a1 -> a2, limits = [-1, 90deg], velocity = 3, effort = 40)]
    #[body(a2, solid = sphere(1, 1))]
    #[joint(foot: ball, a2 -> a3, actuated = off)] #[body(a3, solid = sphere(1, 1))]
    #[joint(weld: fixed, a3 -> tool)]
    #[joint(turret: cylindrical(z), a0 -> b0)] #[body(b0, solid = sphere(1, 1))]
    #[joint(stage: planar(z), b0 -> b1)] #[body(b1, solid = sphere(1, 1))]
    #[joint(gantry: translation, b1 -> b2)] #[body(b2, solid = sphere(1, 1))]
    #[joint(spindle: helical(z, 2mm), b2 -> b3, limits = [-10, 10])] #[body(b3, solid = sphere(1, 1))]
    #[joint(wheel: continuous(y), b2 -> b4, effort = 5)] #[body(b4, solid = sphere(1, 1))]";

#[test]
fn coordinates_are_taken_in_the_order_of_the_lines() {
    with_model(EVERY_KIND, |model, tree| {
        let joints = model.joints.iter().map(|joint| (joint.name.as_str(), joint.q.clone(), joint.v.clone()));
        assert_eq!(
            joints.collect::<Vec<_>>(),
            [
                ("base", 0..7, 0..6),
                ("hip", 7..9, 6..8),
                ("knee", 9..10, 8..9),
                ("foot", 10..14, 9..12),
                ("turret", 14..16, 12..14),
                ("stage", 16..19, 14..17),
                ("gantry", 19..22, 17..20),
                ("spindle", 22..23, 20..21),
                ("wheel", 23..24, 21..22),
            ]
        );
        assert_eq!((tree.coordinates(), tree.dof(), tree.links.len()), (24, 22, 16));
        let unactuated: Vec<_> = (0..22).filter(|speed| !model.actuated.contains(speed)).collect();
        assert_eq!(unactuated, [0, 1, 2, 3, 4, 5, 9, 10, 11]);
        let limits = |joint: usize| model.joints[joint].limits.as_slice();
        let endless = [f64::NEG_INFINITY, f64::INFINITY, f64::INFINITY, f64::INFINITY];
        let numbers = |limits: &model::Limits| [limits.lower, limits.upper, limits.velocity, limits.effort];
        assert_eq!(limits(0).iter().map(numbers).collect::<Vec<_>>(), [endless; 6]);
        let knee = [-1.0, std::f64::consts::FRAC_PI_2, 3.0, 40.0];
        assert_eq!(limits(2).iter().map(numbers).collect::<Vec<_>>(), [knee]);
        let mass: f64 = tree.links.iter().map(|link| link.inertia.mass).sum();
        assert_eq!(mass, 9.0);
    });
}

/// The expansion compares itself with the textbook.
#[test]
fn every_kind_is_derived() {
    let passive = "armature = 0.01, damping = 0.1, friction = 0.2, stiffness = 3, rest = 0.1, velocity = 3";
    let follower = "#[joint(f: prismatic(x), b4 -> b5, mimic = knee, ratio = 20mm, damping = 1)] #[body(b5, solid = sphere(1, 1))]";
    let text = format!("{} {follower} struct Robot;", EVERY_KIND.replace("velocity = 3", passive));
    let found = dynamics_codegen::generate(&syn::parse_str(&text).unwrap());
    let mistakes = found.err().map(dynamics_codegen::diagnostics::Diagnostics::into_text);
    assert_eq!(mistakes, None);
}

#[test]
fn parents_come_before_children_and_own_coordinates_grow() {
    with_model(EVERY_KIND, |_, tree| {
        for (k, link) in tree.links.iter().enumerate() {
            assert!(link.parent.is_none_or(|parent| parent < k));
            let before = k.checked_sub(1).map_or(0, |before| tree.links[before].drive.v);
            assert!(before <= link.drive.v, "link {k}");
        }
    });
}

mod followers {
    use super::*;

    /// A follower has the pose that its own joint has at `ratio·q + offset`.
    #[test]
    fn a_follower_is_where_its_leader_says() {
        let leader = format!("#[joint(lead: revolute(x), world -> b)] {SECOND}");
        let follower = |kind: &str, keys: &str| {
            tip(&format!("{leader} #[joint(f: {kind}, world -> a, at = [0, 1, 0], {keys})] {BODY}"), &[P])
        };
        let at = shift(0.0, 1.0, 0.0);
        assert_same(follower("revolute(y)", "mimic = lead"), at * about(Y, P));
        assert_same(
            follower("continuous(y)", "mimic = lead, ratio = -1, offset = 30deg"),
            at * about(Y, -P + 30_f64.to_radians()),
        );
        assert_same(
            follower("prismatic(z)", "mimic = lead, ratio = 20mm, offset = 2mm"),
            at * along(Z, 0.02 * P + 0.002),
        );
        assert_same(
            follower("helical(z, 10mm)", "mimic = lead, ratio = l / 1m, offset = u"),
            at * about(Z, 0.4 * P + 0.3) * along(Z, 0.01 * (0.4 * P + 0.3)),
        );
        // Its length for each unit of a slider: rad/m.
        let slider = format!("#[joint(lead: prismatic(x), world -> b)] {SECOND}");
        let wheel =
            format!("{slider} #[joint(f: revolute(y), world -> a, mimic = lead, ratio = 1 / l)] {BODY}");
        assert_same(tip(&wheel, &[P]), about(Y, P / 0.4));
    }

    #[test]
    fn a_chain_of_followers_is_resolved_and_may_stand_in_any_order() {
        let lines = format!(
            "#[joint(third: revolute(z), world -> a, mimic = second, ratio = 3, offset = 0.1)] {BODY}
             #[joint(second: revolute(z), world -> b, mimic = first, ratio = -2, offset = 0.25)] {SECOND}
             #[joint(other: revolute(z), world -> c)] #[body(c, solid = sphere(1, 1))]
             #[joint(first: revolute(z), world -> d)] #[body(d, solid = sphere(1, 1))]
             #[joint(f: fixed, a -> tip)]"
        );
        assert_same(tip(&lines, &[Q, P]), about(Z, 3.0 * (-2.0 * P + 0.25) + 0.1));
        with_model(&lines, |model, tree| {
            let names: Vec<_> = model.joints.iter().map(|joint| joint.name.as_str()).collect();
            assert_eq!(
                (names.as_slice(), tree.dof(), tree.links.len()),
                (["other", "first"].as_slice(), 2, 4)
            );
            let drives = tree.links.iter().map(|link| (link.drive.q, link.drive.v, link.drive.ratio));
            assert_eq!(drives.collect::<Vec<_>>(), [(1, 1, -6.0), (1, 1, -2.0), (0, 0, 1.0), (1, 1, 1.0)]);
        });
    }

    /// A finger between two joints that have coordinates: it has none, and is a link where it stands.
    #[test]
    fn a_follower_may_carry_joints() {
        let lines = "
            #[joint(q: revolute(x), world -> a)] #[body(a, solid = sphere(1, 1))]
            #[joint(f: revolute(x), a -> b, mimic = r, ratio = 2)] #[body(b, solid = sphere(1, 1))]
            #[joint(r: revolute(x), b -> c)] #[body(c, solid = sphere(1, 1))]";
        assert_same(tip(lines, &[P, Q]), about(X, P) * about(X, 2.0 * Q) * about(X, Q));
    }

    #[test]
    fn a_leader_without_mass_moves_that_of_its_followers() {
        let lines = "#[joint(q: revolute(x), world -> a)] #[body(a)]
            #[joint(f: prismatic(x), world -> b, mimic = q, ratio = 1mm)] #[body(b, solid = point(1))]";
        with_model(lines, |model, _| assert_eq!(model.joints.len(), 1));
    }
}

mod locked {
    use super::*;

    #[test]
    fn a_locked_joint_is_a_weld_at_its_value() {
        let lines = |keys: &str| {
            format!(
                "#[joint(q: revolute(z), world -> b)] {SECOND}
                 #[joint(e: {keys})] #[body(a, mass = 3, com = [l, 0, 0], inertia = diag(1, 1, 1))]
                 #[joint(f: revolute(y), a -> c)] #[body(c, solid = sphere(m, 1))] #[joint(t: fixed, c -> tip)]"
            )
        };
        let value = 30_f64.to_radians();
        let turn = about(Z, P);
        let cases = [
            ("revolute(y), b -> a, at = [l, 0, 1], locked = 30deg", shift(0.4, 0.0, 1.0) * about(Y, value)),
            ("revolute(y), b -> a, limits = [-1, 1], damping = 3, locked = u", about(Y, 0.3)),
            (
                "prismatic([2, -1, 2]), b -> a, rpy = [0, u, 0], locked = l",
                about(Y, 0.3) * along(OBLIQUE, 0.4),
            ),
            ("helical(y, 10mm), b -> a, locked = u", about(Y, 0.3) * along(Y, 0.003)),
            (
                "revolute, b -> a, mdh(l, 0, 0, u), locked = 30deg",
                shift(0.4, 0.0, 0.0) * about(Z, 0.3 + value),
            ),
            (
                "revolute, b -> a, dh(l, 0, 0, u), locked = 30deg",
                about(Z, 0.3 + value) * shift(0.4, 0.0, 0.0),
            ),
        ];
        for (keys, expected) in cases {
            assert_same(tip(&lines(keys), &[P, Q]), turn * expected * about(Y, Q));
            with_model(&lines(keys), |model, tree| {
                let names: Vec<_> = model.joints.iter().map(|joint| joint.name.as_str()).collect();
                assert_eq!((names.as_slice(), tree.links.len()), (["q", "f"].as_slice(), 2), "{keys}");
                assert_eq!(tree.links[0].inertia.mass, 4.0, "{keys}");
            });
        }
    }

    #[test]
    fn followers_of_a_locked_joint_are_locked_too() {
        let lines = format!(
            "#[joint(q: revolute(z), world -> b)] {SECOND}
             #[joint(f: prismatic(z), b -> a, mimic = e, ratio = 0.5m, offset = 10mm)] {BODY}
             #[joint(e: revolute(y), b -> c, locked = 0.2)] #[body(c, solid = sphere(1, 1))]
             #[joint(t: fixed, a -> tip)]"
        );
        assert_same(tip(&lines, &[P]), about(Z, P) * along(Z, 0.11));
        with_model(&lines, |_, tree| assert_eq!((tree.links.len(), tree.links[0].inertia.mass), (1, 3.0)));
    }
}

mod passive {
    use super::*;

    /// Armature, damping, friction with its speed, stiffness and rest of the joint's first link.
    fn of(kind: &str, keys: &str) -> [f64; 6] {
        with_model(&format!("#[joint(q: {kind}, world -> a, {keys})] {BODY}"), |_, tree| {
            let others = tree.links[1..].iter().map(|link| numbers(link.passive));
            assert!(
                others.into_iter().all(|passive| passive == [0.0; 6]),
                "only the first link has passive forces"
            );
            numbers(tree.links[0].passive)
        })
    }

    fn numbers(passive: Passive<f64>) -> [f64; 6] {
        let Passive { armature, damping, friction, friction_speed, stiffness, rest } = passive;
        [armature, damping, friction, friction_speed, stiffness, rest]
    }

    #[test]
    fn each_key_has_its_place_and_its_unit() {
        let all = "armature = 0.02, damping = 0.1, friction = 0.3, friction_speed = 0.05, stiffness = 4, rest = 90deg";
        let right = std::f64::consts::FRAC_PI_2;
        assert_eq!(of("revolute(z)", all), [0.02, 0.1, 0.3, 0.05, 4.0, right]);
        assert_eq!(of("helical(z, 1mm)", all), [0.02, 0.1, 0.3, 0.05, 4.0, right]);
        let units =
            "armature = 20g, damping = 2N * 1s / 1m, friction = 3N, stiffness = 4N / 10mm, rest = 5cm";
        assert_eq!(of("prismatic(z)", units), [0.02, 2.0, 3.0, 0.01, 400.0, 0.05]);
        let keys = "armature = m * l*l, damping = m * l*l / 1s, friction = 1Nm, friction_speed = u / 1s, \
            stiffness = 2 * m * l*l / (1s * 1s), rest = -u";
        let expected = [2.0 * 0.16, 2.0 * 0.16, 1.0, 0.3, 4.0 * 0.16, -0.3];
        let found = of("continuous(z)", keys);
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{found:?} {expected:?}");
    }

    #[test]
    fn a_rotor_is_felt_with_the_square_of_its_gear() {
        assert_eq!(of("revolute(z)", "rotor = 1e-5, gear = -100")[0], 0.1);
        // A spindle: so many radians of the motor for each metre of the slide.
        assert_eq!(of("prismatic(z)", "rotor = 1e-5, gear = 2 / 1mm")[0], 40.0);
        // Where there is no friction, its speed is there all the same.
        assert_eq!(of("revolute(z)", "damping = 0"), [0.0, 0.0, 0.0, 0.01, 0.0, 0.0]);
    }

    #[test]
    fn followers_have_their_own() {
        let lines = format!(
            "#[joint(q: revolute(z), world -> b)] {SECOND}
             #[joint(f: prismatic(z), b -> a, mimic = q, ratio = 0.5m, damping = 3, stiffness = 2, rest = 1cm)] {BODY}"
        );
        with_model(&lines, |_, tree| {
            let passive = tree.links[1].passive;
            assert_eq!([passive.damping, passive.stiffness, passive.rest], [3.0, 2.0, 0.01]);
        });
    }

    /// A rotor gives the mass matrix what a body without mass does not.
    #[test]
    fn a_joint_with_an_armature_may_move_no_mass() {
        with_model("#[joint(q: revolute(z), world -> a, armature = 0.1)] #[body(a)]", |_, tree| {
            assert_eq!(tree.links[0].passive.armature, 0.1);
        });
    }
}
