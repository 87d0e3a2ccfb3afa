//! Equilibria and steady motions, beside closed forms; and that there is none where there is none.
#![cfg(feature = "derive")]

use dynamics_core::prelude::*;
use dynamics_core::{TrimFailure, Trimmed};

const G: f64 = 9.81;

/// What a found state may differ from a closed form: 2¹² roundings of forces, times the inverse of slopes of one.
const TOLERANCE: f64 = 1e-10;

/// Two links in a vertical plane, each 0.5 m long, with a motor in every joint.
#[derive(Dynamics)]
#[joint(shoulder: revolute(-y), world -> upper, damping = 0.2)]
#[body(upper, solid = rod(2, 0.5, x), com = [0.25, 0, 0])]
#[joint(elbow: revolute(-y), upper -> lower, at = [0.5, 0, 0])]
#[body(lower, solid = rod(1, 0.5, x), com = [0.25, 0, 0])]
#[joint(grip: fixed, lower -> tool, at = [0.5, 0, 0])]
struct Arm;

/// A pole on a cart; the cart is driven.
#[derive(Dynamics)]
#[joint(slider: prismatic(x), world -> cart)]
#[body(cart, solid = point(1))]
#[joint(hinge: revolute(y), cart -> pole, actuated = off)]
#[body(pole, solid = rod(100g, 1, z), com = [0, 0, 0.5])]
struct CartPole;

/// A point of 2 kg at the end of a string of 0.8 m; nothing drives it. At zero it hangs down.
#[derive(Dynamics)]
#[joint(azimuth: revolute(z), world -> turret, actuated = off)]
#[body(turret, mass = 0, inertia = diag(0, 0, 0))]
#[joint(elevation: revolute(-y), turret -> bob, actuated = off)]
#[body(bob, solid = point(2), com = [0, 0, -0.8])]
struct Conical;

/// A body in a socket, beside its centre of mass.
#[derive(Dynamics)]
#[joint(socket: ball, world -> clapper, actuated = off)]
#[body(clapper, mass = 2.3, com = [0.04, -0.03, -0.6], inertia = tensor(0.03, 0.002, -0.001, 0.04, 0.002, 0.02))]
struct Bell;

/// A box that nothing holds.
#[derive(Dynamics)]
#[joint(flight: free, world -> parcel)]
#[body(parcel, solid = cuboid(1.5, [0.4, 0.3, 0.2]))]
struct Parcel;

type Found<const N: usize, const M: usize> = Result<Trimmed<f64, N, N, M>, TrimFailure<f64, N, N, M>>;

#[test]
fn an_arm_is_held_by_its_gravity_forces() {
    let guess = State::rest(SVector::from([0.3_f64, -0.8]));
    let held = Trim::new(&Arm, guess).hold_positions().solve().expect("motors hold it anywhere");
    assert_eq!(held.state, guess);
    assert!((held.u - Arm.gravity_forces(&guess.q)).amax() < TOLERANCE);
    assert!(held.jerk(&Arm).amax() < TOLERANCE);
}

#[test]
fn a_tool_is_held_at_a_height() {
    let target = SVector::from([0.5, 0.6]);
    let measured = (output::position::<Tool>().z(), output::position::<Tool>().x());
    let held = Trim::new(&Arm, State::rest(SVector::from([0.3_f64, 0.4])))
        .subject_to(measured, target)
        .solve()
        .expect("it is within reach");
    let tool = Arm.pose::<Tool>(&held.state.q).translation;
    assert!((tool[2] - 0.5).abs() < TOLERANCE && (tool[0] - 0.6).abs() < TOLERANCE, "{tool}");
    assert!((held.u - Arm.gravity_forces(&held.state.q)).amax() < TOLERANCE);
    // Of a family of solutions, one is found.
    let height = Trim::new(&Arm, State::rest(SVector::from([0.3_f64, 0.4])))
        .subject_to(output::position::<Tool>().z(), SVector::from([0.5]));
    let held = height.solve().expect("there are many");
    assert!((Arm.pose::<Tool>(&held.state.q).translation[2] - 0.5).abs() < TOLERANCE);
    let model = Arm.linearize(&held.state.q, &held.state.v, &held.u);
    assert!(model.drift.amax() < 1e-9, "an equilibrium has no drift: {}", model.drift);
}

/// Two metres are beyond a metre of arm: there is none, and what is nearest is the arm that points there.
#[test]
fn beyond_reach_there_is_none() {
    let far = Trim::new(&Arm, State::rest(SVector::from([0.3_f64, 0.4])))
        .subject_to(output::position::<Tool>().x(), SVector::from([2.0]));
    let Err(TrimFailure::NoEquilibrium(best)) = far.solve() else { panic!("{:?}", far.solve()) };
    assert!((best.miss - 1.0).abs() < 1e-6, "{best:?}");
}

/// `τ = m·g·l·cos q` has no root within reach of a limited position, and one at the bottom if it is free.
#[test]
fn a_pendulum_stands_at_no_angle_without_a_torque() {
    let guess = State::rest(SVector::from([0.5_f64, 0.0]));
    let none = Trim::new(&Arm, guess).hold_positions().hold_inputs();
    let Err(TrimFailure::NoEquilibrium(best)) = none.solve() else { panic!("{:?}", none.solve()) };
    assert_eq!(best.state, guess);
    assert!((best.imbalance - Arm.gravity_forces(&guess.q)).amax() < TOLERANCE);
    assert_eq!(Error::from(none.solve().expect_err("as above")), Error::NoEquilibrium);

    let hanging = Trim::new(&Arm, guess).hold_inputs().solve().expect("it may hang");
    assert!(hanging.state.q[0].cos().abs() < TOLERANCE, "{}", hanging.state.q);
    assert_eq!(hanging.u, SVector::<f64, 2>::zeros());
}

/// Stretched out and level its forces are greatest, and no small change makes a difference at first; it finds its way.
#[test]
fn a_search_leaves_a_crest() {
    let level = Trim::new(&Arm, State::rest(SVector::from([0.0_f64, 0.0]))).hold_inputs();
    let found = level.solve().expect("it may hang, or stand");
    assert!(Arm.gravity_forces(&found.state.q).amax() < TOLERANCE, "{}", found.state.q);
}

/// A pole leans at an angle only while its cart is pushed on: `a = g·tan θ`.
#[test]
fn a_leaning_pole_needs_an_accelerating_cart() {
    let leaning = SVector::from([0.0_f64, 0.3]);
    let at_rest = Trim::new(&CartPole, State::rest(leaning)).hold_positions();
    assert!(matches!(at_rest.solve(), Err(TrimFailure::NoEquilibrium(_))), "{:?}", at_rest.solve());
    let pushed = at_rest.free_acceleration("slider").solve().expect("by an acceleration");
    assert!((pushed.a[0] - G * 0.3_f64.tan()).abs() < TOLERANCE, "{}", pushed.a);
    assert_eq!(pushed.a[1], 0.0);
    assert!((pushed.u[0] - 1.1 * pushed.a[0]).abs() < TOLERANCE, "{}", pushed.u);
    // Left to itself it falls to where it can stay: up or down.
    let free = Trim::new(&CartPole, State::rest(SVector::from([0.0_f64, 2.0]))).solve().expect("it can hang");
    assert!(free.state.q[1].sin().abs() < TOLERANCE && free.u.amax() < TOLERANCE, "{free:?}");
}

/// `Ω² = g/(l·cos θ)` of a conical pendulum; it goes on for ever.
#[test]
fn a_conical_pendulum_is_a_steady_motion() {
    let guess = State::new(SVector::from([0.2_f64, 0.7]), SVector::from([1.0, 0.0]));
    let cone = Trim::new(&Conical, guess).hold_positions().free_speed("azimuth");
    let cone = cone.solve().expect("it goes round");
    let expected = (G / (0.8 * 0.7_f64.cos())).sqrt();
    assert!((cone.state.v[0] - expected).abs() < TOLERANCE, "{}", cone.state.v);
    assert!(cone.jerk(&Conical).amax() < 1e-9, "{}", cone.jerk(&Conical));
}

/// At the bottom of a swing forces balance for a moment: it is no steady motion, and the jerk says so.
#[test]
fn a_swing_is_not_steady() {
    let bottom = State::new(SVector::from([0.0, 0.0]), SVector::from([0.0_f64, 2.0]));
    let moment = Trim::new(&Conical, bottom).hold_positions().solve().expect("no force is left");
    let jerk = moment.jerk(&Conical);
    assert!((jerk[1] + G / 0.8 * 2.0).abs() < TOLERANCE, "{jerk}");
}

/// Turning on and on takes a torque against the damper; the elbow bears the centripetal force.
#[test]
fn a_turning_arm_needs_its_torques() {
    let turning = State::new(SVector::from([0.4_f64, 0.9]), SVector::from([2.0, 0.0]));
    let found: Found<2, 2> = Trim::new(&Arm, turning).hold_positions().solve();
    let expected = Arm.inverse_dynamics(&turning.q, &turning.v, &SVector::zeros());
    let found = found.expect("motors can");
    assert!((found.u - expected).amax() < TOLERANCE);
    assert!(found.jerk(&Arm).amax() > 1.0, "its weight turns with it");
}

#[test]
fn a_bell_hangs_below_its_socket() {
    let (start, turn) = (Bell.neutral(), SVector::from([1.0_f64, -0.7, 0.4]));
    let guess = State::rest(Bell.integrate(&start, &turn));
    let hanging = Trim::new(&Bell, guess).solve().expect("it can hang");
    let center = Bell.center_of_mass(&hanging.state.q);
    assert!(center[0].hypot(center[1]) < TOLERANCE, "{center}");
    assert!(Bell.check_configuration(&hanging.state.q).is_ok());
}

/// From anywhere it comes to rest, below its socket or above it, and within the limit of steps.
#[test]
fn from_every_guess_a_bell_comes_to_rest() {
    let weight = 2.3 * G * 0.6;
    for count in 0..200 {
        let angle = f64::from(count) * 2.399_963; // the golden one, so that no two guesses are alike
        let turn = SVector::from([2.0 * angle.sin(), 2.5 * angle.cos(), (3.0 * angle).sin()]);
        let guess = State::rest(Bell.integrate(&Bell.neutral(), &turn));
        let found = Trim::new(&Bell, guess).solve();
        let found = found.unwrap_or_else(|failure| panic!("{turn}: {failure}"));
        assert!(Bell.gravity_forces(&found.state.q).amax() < TOLERANCE * weight, "{}", found.state.q);
        assert!(Bell.check_configuration(&found.state.q).is_ok());
    }
}

#[test]
fn an_orientation_can_be_asked_for() {
    let turned = Bell.integrate(&Bell.neutral(), &SVector::from([0.3, 0.5, -0.4]));
    let from = Bell.pose::<Clapper>(&turned).rotation;
    let guess = State::rest(Bell.integrate(&Bell.neutral(), &SVector::from([-0.9, 1.1, 0.4])));
    let asked = Trim::new(&Bell, guess)
        .subject_to(output::orientation::<Clapper, f64>().from(from), SVector::<f64, 3>::zeros())
        .free_acceleration("socket.wx")
        .free_acceleration("socket.wy")
        .free_acceleration("socket.wz");
    let found = asked.solve().expect("it may fall from there");
    let left = Bell.difference(&turned, &found.state.q);
    assert!(left.amax() < TOLERANCE, "{left}");
    let falling = Bell.forward_dynamics(&turned, &SVector::zeros(), &SVector::zeros());
    assert!((found.a - falling).amax() < 1e-9, "{} {falling}", found.a);
}

#[test]
fn nothing_floats() {
    let guess = State::<f64, 7, 6>::rest(Parcel.neutral());
    let floating = Trim::new(&Parcel, guess);
    let Err(TrimFailure::NoEquilibrium(best)) = floating.solve() else { panic!("{:?}", floating.solve()) };
    assert!((best.imbalance.norm() - 1.5 * G).abs() < TOLERANCE, "{}", best.imbalance);
    let falling = floating.free_acceleration("flight.vz").solve().expect("it falls");
    assert!((falling.a[2] + G).abs() < TOLERANCE, "{}", falling.a);
}

#[test]
fn single_precision_is_enough_for_its_own_digits() {
    let guess = State::rest(SVector::from([0.3_f32, 0.4]));
    let held = Trim::new(&Arm, guess)
        .subject_to(output::position::<Tool>().z(), SVector::from([0.5]))
        .solve()
        .expect("within reach");
    let tool = Arm.pose::<Tool>(&held.state.q).translation;
    assert!((tool[2] - 0.5).abs() < 1e-3, "{tool}");
    let none = Trim::new(&CartPole, State::rest(SVector::from([0.0_f32, 0.3]))).hold_positions();
    assert!(matches!(none.solve(), Err(TrimFailure::NoEquilibrium(_))));
}

#[test]
fn a_limit_of_steps_is_kept_and_told() {
    let few = Trim::new(&Arm, State::rest(SVector::from([0.3_f64, 0.4])))
        .subject_to(output::position::<Tool>().z(), SVector::from([0.5]))
        .with_iterations(1);
    let Err(failure) = few.solve() else { panic!("one step is not enough") };
    assert!(matches!(failure, TrimFailure::NotConverged(_)), "{failure:?}");
    assert!(
        failure
            .to_string()
            .starts_with("not converged at step 1: allow more, or guess nearer; so far forces ["),
        "{failure}"
    );
    assert_eq!(Error::from(failure), Error::NotConverged { iterations: 1 });
}

#[test]
fn what_cannot_be_asked_is_an_error() {
    let guess = State::rest(SVector::from([0.3_f64, 0.4]));
    let error = |trim: Found<2, 2>| Error::from(trim.expect_err("it is wrong"));
    let unknown = Trim::new(&Arm, guess).hold_position("wrist").solve();
    assert_eq!(error(unknown), Error::NameUnknown { name: "wrist" });
    let unknown = Trim::new(&Arm, guess).hold_input("wrist").solve();
    assert_eq!(error(unknown), Error::NameUnknown { name: "wrist" });
    let beyond = Trim::new(&Arm, guess).free_speed(2).solve();
    assert_eq!(error(beyond), Error::IndexTooLarge { index: 2, count: 2 });
    let nan = Trim::new(&Arm, State::rest(SVector::from([f64::NAN, 0.0]))).solve();
    assert_eq!(error(nan), Error::NotFinite { vector: "q", index: 0 });
    let target = Trim::new(&Arm, guess).subject_to(output::joint("elbow"), SVector::from([f64::INFINITY]));
    assert_eq!(error(target.solve()), Error::NotFinite { vector: "targets", index: 0 });
}

/// An input is held by the name of the speed that it drives.
#[test]
fn inputs_have_the_names_of_their_joints() {
    let held = Trim::new(&Arm, State::rest(SVector::from([0.3_f64, 0.4]))).hold_input("elbow").solve();
    let held = held.expect("the lower link hangs");
    assert_eq!(held.u[1], 0.0);
    assert!((held.state.q[0] + held.state.q[1]).cos().abs() < TOLERANCE, "{}", held.state.q);
}
