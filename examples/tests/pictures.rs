//! What a recording knows of a derived robot: its tree, its joints, its masses, and the charts that follow.

use dynamics_core::prelude::*;
use dynamics_view::{Measure, Motion, Recording};

/// A body that floats, and on it an arm of a turn and a slide, whose tip is described before it.
#[derive(Dynamics)]
#[joint(base: free, world -> hull)]
#[body(hull, mass = m, com = [0.1, 0, 0.2], inertia = diag(0.3, 0.4, 0.5))]
#[joint(turn: revolute(y), hull -> arm, at = [0, 0.2, 0.3], rpy = [0.3, 0, 0])]
#[joint(reach: prismatic(-x), arm -> fist, at = [0.4, 0, 0])]
#[joint(tip: fixed, fist -> tip, at = [0.1, 0, 0])]
#[body(fist, mass = 0.5, com = [0.02, 0, 0], inertia = diag(0.01, 0.02, 0.02))]
#[body(arm, solid = rod(1.5, 0.4, x), com = [0.2, 0, 0])]
struct Floating {
    m: f64,
}

fn close(found: [f64; 3], expected: [f64; 3]) -> bool {
    found.iter().zip(expected).all(|(x, y)| (x - y).abs() < 1e-12)
}

#[test]
fn joints_and_masses_are_those_that_were_written() {
    let robot = Floating { m: 2.0 };
    let seen = Recording::of(&robot).with_masses();
    let film = seen.film();
    let scene = film.scene();
    let named = |name: &str| scene.bodies.iter().find(|body| body.name == name).expect("the body is there");
    for (body, parent) in
        [("hull", None), ("arm", Some("hull")), ("fist", Some("arm")), ("tip", Some("fist"))]
    {
        let found = named(body).parent.map(|parent| scene.bodies[parent].name.as_str());
        assert_eq!(found, parent, "{body}");
    }
    let kinds = ["hull", "arm", "fist", "tip"]
        .map(|body| (named(body).joint.name.as_str(), named(body).joint.kind.as_str()));
    assert_eq!(kinds, [("base", "free"), ("turn", "revolute"), ("reach", "prismatic"), ("", "")]);
    let [Motion::Turn { through, along }] = named("arm").joint.motions[..] else { panic!("the arm turns") };
    assert!(close(through, [0.0; 3]) && close(along, [0.0, 1.0, 0.0]), "{through:?} {along:?}");
    let [Motion::Slide { along }] = named("fist").joint.motions[..] else { panic!("the fist slides") };
    assert!(close(along, [-1.0, 0.0, 0.0]), "{along:?}");
    for (body, mass, com, inertia) in [
        ("hull", 2.0, [0.1, 0.0, 0.2], [0.3, 0.4, 0.5]),
        ("arm", 1.5, [0.2, 0.0, 0.0], [0.0, 0.02, 0.02]),
        ("fist", 0.5, [0.02, 0.0, 0.0], [0.01, 0.02, 0.02]),
    ] {
        let found = named(body);
        assert!((found.mass - mass).abs() < 1e-12 && close(found.com, com), "{found:?}");
        for (i, row) in found.inertia.iter().enumerate() {
            let expected = std::array::from_fn(|j| if i == j { inertia[i] } else { 0.0 });
            assert!(close(*row, expected), "{found:?}");
        }
    }
}

#[test]
fn coordinates_have_their_names_and_places() {
    let robot = Floating { m: 2.0 };
    let seen = Recording::of(&robot);
    let coordinates = seen.coordinates();
    let free = &coordinates.loose[0];
    assert_eq!((free.name.as_str(), free.q, free.v, free.is_free), ("base", 0, 0, true));
    let single =
        coordinates.single.iter().map(|c| (c.name.as_str(), c.q, c.v, c.measure)).collect::<Vec<_>>();
    assert_eq!(single, [("turn", 7, 6, Measure::Angle), ("reach", 8, 7, Measure::Distance)]);
}

/// The visitor sees all frames, in the order of their names, as types.
#[test]
fn all_frames_are_shown() {
    struct Names(Vec<&'static str>);
    impl<R> FrameVisitor<R, f64, 9, 8> for Names {
        fn visit<F: Frame<R, f64, 9, 8>>(&mut self) {
            self.0.push(F::NAME);
        }
    }
    let (robot, mut names) = (Floating { m: 2.0 }, Names(vec![]));
    robot.each_frame(&mut names);
    assert_eq!(names.0, Floating::BODY_NAMES);
    names.0.clear();
    robot.prepare().each_frame(&mut names);
    assert_eq!(names.0, FloatingPrepared::BODY_NAMES);
}

#[test]
fn a_flight_becomes_charts_and_a_film() -> Result<(), Box<dyn std::error::Error>> {
    let robot = Floating { m: 2.0 };
    let mut v = SVector::zeros();
    (v[2], v[6]) = (3.0, 2.0);
    let mut flight = Simulation::new(&robot, State::new(robot.neutral(), v), 1e-3)?;
    let mut seen = Recording::of(&robot).with_masses();
    seen.see(&flight.sample());
    for sample in seen.watch(flight.steps(500)) {
        sample?;
    }
    let svg = seen.figure("A flight").svg()?;
    for text in ["position of base, m", "roll", "angle, rad", "distance, m", "energy, J"] {
        assert!(svg.contains(text), "{text}");
    }
    assert!(seen.phase("turn").is_some() && seen.phase("base").is_none());
    let html = seen.film().tracing("tip").html()?;
    assert_eq!(html, seen.film().tracing("tip").html()?);
    Ok(())
}

/// Where the input is known, what it did is told from the error; where it is not, nothing is called an error.
#[test]
fn the_energy_of_a_driven_robot_is_accounted_for() -> Result<(), Box<dyn std::error::Error>> {
    let robot = Floating { m: 2.0 };
    let lift =
        |time: f64, _: &State<f64, 9, 8>| SVector::from_fn(|k, _| if k > 5 { time.sin() } else { 0.0 });
    let mut flight = Simulation::new(&robot, State::rest(robot.neutral()), 1e-2)?.with_input(lift);
    let (mut knowing, mut watching) = (Recording::of(&robot), Recording::of(&robot));
    knowing.see(&flight.sample());
    watching.see(&flight.sample());
    for _ in 0..50 {
        let sample = flight.step()?;
        knowing.see_under(&sample, lift);
        watching.see(&sample);
    }
    let accounts = ["work of the motors", "error of the energy"];
    let drawn = |seen: &Recording<'_, _, 9, 8>| seen.figure("A flight").svg();
    let (known, unknown) = (drawn(&knowing)?, drawn(&watching)?);
    assert!(accounts.iter().all(|text| known.contains(text)), "the work is drawn");
    assert!(!accounts.iter().any(|text| unknown.contains(text)) && unknown.contains("change of the energy"));
    // One moment of which the input is not known, and the account has a hole.
    knowing.see(&flight.step()?);
    assert!(!drawn(&knowing)?.contains("work of the motors"));
    Ok(())
}

/// A body that slides, and beside it a coordinate of which there is no body.
#[derive(Dynamics)]
#[coordinate(sway: length, armature = 1kg)]
#[joint(slide: prismatic(x), world -> cart)]
#[body(cart, solid = point(2kg))]
#[potential(20N_per_m / 2 * (slide - sway)^2)]
struct Swaying;

#[test]
fn coordinates_without_bodies_are_charted_and_not_drawn() {
    let mut simulation =
        Simulation::new(&Swaying, State::rest(SVector::from([0.1, 0.0])), 0.01).expect("it is at rest");
    let mut seen = Recording::of(&Swaying).with_masses();
    assert_eq!(seen.watch(simulation.steps(100)).filter(Result::is_ok).count(), 100);
    let bodies: Vec<_> = seen.film().scene().bodies.iter().map(|body| body.name.clone()).collect();
    assert_eq!(bodies, ["cart"]);
    let single = &seen.coordinates().single;
    let named: Vec<_> = single.iter().map(|c| (c.name.as_str(), c.q, c.v, c.measure)).collect();
    assert_eq!(named, [("sway", 0, 0, Measure::Distance), ("slide", 1, 1, Measure::Distance)]);
    assert_eq!(seen.film().scene().bodies[0].joint.name, "slide");
}
