//! The variational integrator: order, energy, momentum, reversal, and what it does not solve.
#![cfg(feature = "std")]

use crate::common::free_box::FreeBox;
use crate::common::{DoublePendulum, G, Pendulum, Spinner, random_numbers, random_vector};
use dynamics_core::nalgebra::Vector3;
use dynamics_core::prelude::*;
use dynamics_core::simulate::MomentumMonitor;

fn tossed() -> State<f64, 7, 6> {
    State::new(
        SVector::from([0.2, -0.3, 1.0, 0.1, -0.5, 0.7, 0.5]),
        SVector::from([1.0, -2.0, 4.0, 2.0, 5.0, -3.0]),
    )
}

/// `h²·a` by central differences is Störmer's method, which it must be where M is constant.
#[test]
fn of_a_pendulum_it_is_stoermer_and_verlet() {
    let robot = Pendulum { m: 0.7_f64, l: 1.3, damping: 0.0 };
    let (h, start) = (0.05, State::new(SVector::from([1.1]), SVector::from([-0.4])));
    let mut simulation = Simulation::new(&robot, start, h).expect("valid").with_integrator(Variational);
    let mut q = vec![start.q[0]];
    q.extend(simulation.steps(200).map(|sample| sample.expect("finite").state.q[0]));
    for three in q.windows(3) {
        let by_differences = three[2] - 2.0 * three[1] + three[0];
        let by_force = -h * h * G / 1.3 * three[1].sin();
        assert!((by_differences - by_force).abs() < 4e-15, "{by_differences:e} is not {by_force:e}");
    }
}

/// The greatest distance of the energy from that at the start, in steps from `from` on.
fn swing<R, const NQ: usize, const NV: usize>(
    robot: &R,
    start: State<f64, NQ, NV>,
    step: f64,
    steps: usize,
) -> f64
where
    R: Dynamics<f64, NQ, NV> + Configuration<f64, NQ, NV>,
{
    let mut simulation = Simulation::new(robot, start, step).expect("valid").with_integrator(Variational);
    let joules = simulation.sample().energy().total();
    let off = |sample: Sample<'_, R, f64, NQ, NV>| (sample.energy().total() - joules).abs();
    simulation.steps(steps).map(|sample| off(sample.expect("finite"))).fold(0.0, f64::max)
}

#[test]
fn the_energy_of_a_pendulum_is_bounded_over_a_million_steps() {
    let robot = Pendulum { m: 1.0_f64, l: 1.0, damping: 0.0 };
    let start = State::rest(SVector::from([1.0]));
    let (short, long) = (swing(&robot, start, 1e-2, 1_000), swing(&robot, start, 1e-2, 1_000_000));
    // In more swings there are more states; they come nearer to the worst.
    assert!(long < 1.001 * short, "{short:e} J became {long:e} J");
    assert!(short < 2e-3, "some squares of the step by the time constant: {short:e} J");
}

/// Regular motion: of a chaotic one it is known for a time only that grows with 1/h.
#[test]
fn so_is_that_of_a_double_pendulum_whose_mass_matrix_varies() {
    let start = State::rest(SVector::from([0.6, -0.4]));
    let (short, long) =
        (swing(&DoublePendulum, start, 5e-3, 2_000), swing(&DoublePendulum, start, 5e-3, 30_000));
    // Two frequencies meet at their worst only after many periods.
    assert!(long < 1.2 * short, "{short:e} J became {long:e} J");
}

#[test]
fn so_is_that_of_a_box_that_tumbles() {
    let (robot, start) = (FreeBox::drifting(), tossed());
    let (short, long) = (swing(&robot, start, 2e-3, 2_000), swing(&robot, start, 2e-3, 20_000));
    assert!(long < 1.05 * short, "{short:e} J became {long:e} J");
}

/// The momentum in world axes, linear and about the origin: what translations and turns of the world conserve.
fn momentum(robot: &FreeBox, State { q, v }: &State<f64, 7, 6>) -> [Vector3<f64>; 2] {
    let [linear, angular]: [Vector3<f64>; 2] = [v.fixed_rows::<3>(0).into(), v.fixed_rows::<3>(3).into()];
    let rotation = FreeBox::rotation(q);
    let linear = rotation * (linear + angular.cross(&robot.com)) * robot.mass;
    [linear, rotation * (robot.inertia * angular) + robot.center_of_mass(q).cross(&linear)]
}

/// Noether's theorem holds of the sum as of the action: at a coarse step, where energy is off in its third digit.
#[test]
fn momenta_stay_to_rounding() {
    let (robot, start) = (FreeBox::drifting(), tossed());
    let [p, l] = momentum(&robot, &start);
    let mut simulation = Simulation::new(&robot, start, 1e-2).expect("valid").with_integrator(Variational);
    for sample in simulation.steps(10_000) {
        let Sample { time, state, .. } = sample.expect("finite");
        let [linear, angular] = momentum(&robot, &state);
        // Of 8 kg·m/s, by ten thousand roundings that wander; the other one is that times a distance of 5 m/s.
        assert!((linear - p).norm() < 1e-12, "{:e}", (linear - p).norm());
        assert!((angular - l).norm() < 1e-12 * (1.0 + 5.0 * time), "{:e}", (angular - l).norm());
    }
}

#[test]
fn under_gravity_the_momentum_grows_by_the_weight() {
    let (robot, start) = (FreeBox::tossed(), tossed());
    let [p, _] = momentum(&robot, &start);
    let mut simulation = Simulation::new(&robot, start, 1e-2).expect("valid").with_integrator(Variational);
    for sample in simulation.steps(200) {
        let Sample { time, state, .. } = sample.expect("finite");
        let [linear, _] = momentum(&robot, &state);
        let error = (linear - p - robot.mass * robot.gravity * time).norm();
        assert!(error < 1e-12, "{error:e} after {time} s");
    }
}

/// Galilei's parabola and his relativity: whatever a box flies at, it turns as it does at rest.
#[test]
fn a_box_about_its_centre_of_mass_turns_alike_at_any_speed() {
    let robot = FreeBox::new(Vector3::zeros(), FreeBox::tossed().gravity);
    let about_center = |State { q, v }: &State<f64, 7, 6>| {
        FreeBox::rotation(q) * (robot.inertia * v.fixed_rows::<3>(3).into_owned())
    };
    let mut turned = Vec::new();
    for speed in [0.0, 100.0, 1000.0] {
        let mut start = tossed();
        start.v[0] += speed;
        let [p, _] = momentum(&robot, &start);
        let (from, l) = (robot.center_of_mass(&start.q), about_center(&start));
        let mut simulation =
            Simulation::new(&robot, start, 1e-2).expect("valid").with_integrator(Variational);
        for (k, sample) in (1..).zip(simulation.steps(1_000)) {
            let Sample { time, state, .. } = sample.expect("no speed is too large");
            let expected = from + p / robot.mass * time + robot.gravity * (0.5 * time * time);
            // In each step some roundings of the speed, which go on as it does, and of a torque `v × m·v` that is zero.
            let size = 4.0 * f64::EPSILON * f64::from(k) * (1.0 + speed + 10.0 * time);
            let error = (robot.center_of_mass(&state.q) - expected).norm();
            assert!(error < size * (1.0 + time), "{error:e} after {time} s at {speed} m/s");
            let error = (about_center(&state) - l).norm();
            assert!(error < size, "{error:e} after {time} s at {speed} m/s");
        }
        turned.push(FreeBox::rotation(&simulation.state().q));
    }
    for rotation in &turned {
        // The tumbling makes more of those roundings.
        assert!((rotation.matrix() - turned[0].matrix()).amax() < 1e-6, "{rotation} is not {}", turned[0]);
    }
}

/// Where its frame is elsewhere, the centre of mass goes straight to the order of the method, and so is what is about it.
#[test]
fn about_a_centre_of_mass_away_from_the_frame_momentum_is_kept_to_second_order() {
    let off = |robot: &FreeBox, steps: u32| {
        let mut simulation = Simulation::new(robot, tossed(), 1.0 / f64::from(steps))
            .expect("valid")
            .with_integrator(Variational);
        let mut monitor = MomentumMonitor::new(&simulation.sample());
        for sample in simulation.steps(steps as usize) {
            monitor.observe(&sample.expect("finite"));
        }
        monitor.angular()
    };
    for robot in [FreeBox::drifting(), FreeBox::tossed()] {
        let ratio = off(&robot, 200) / off(&robot, 400);
        assert!((3.8..4.2).contains(&ratio), "{ratio}");
        assert!(off(&robot, 400) > 1e-6, "it is not kept to rounding");
    }
    let centred = FreeBox::new(Vector3::zeros(), FreeBox::tossed().gravity);
    assert!(off(&centred, 100) < 1e-13);
}

/// Under gravity along z turns about vertical axes are a symmetry.
#[test]
fn the_momentum_about_a_vertical_axis_of_the_world_stays() {
    let robot = FreeBox::new(FreeBox::tossed().com, Vector3::new(0.0, 0.0, -G));
    let [_, l] = momentum(&robot, &tossed());
    let mut simulation = Simulation::new(&robot, tossed(), 1e-2).expect("valid").with_integrator(Variational);
    for sample in simulation.steps(200) {
        let [_, angular] = momentum(&robot, &sample.expect("finite").state);
        assert!((angular.z - l.z).abs() < 1e-12, "{:e}", angular.z - l.z);
    }
}

/// What is in the documentation as a step too large: of 10 m, turning by 0.06 rad, with the frame 0.2 m from the centre.
#[test]
fn a_free_base_away_from_its_centre_of_mass_can_be_too_fast() {
    let robot = FreeBox::drifting();
    let fate = |speed: f64| {
        let mut start = tossed();
        start.v[0] += speed;
        let mut simulation =
            Simulation::new(&robot, start, 1e-2).expect("valid").with_integrator(Variational);
        simulation.steps(100).find_map(Result::err)
    };
    assert_eq!(fate(10.0), None);
    assert!(matches!(fate(1000.0), Some(Error::NotConverged { .. })));
}

#[test]
fn a_motion_backwards_comes_to_where_it_began() {
    let there = |start| {
        let mut simulation =
            Simulation::new(&DoublePendulum, start, 1e-2).expect("valid").with_integrator(Variational);
        let State { q, v } = simulation.steps(500).last().expect("steps").expect("finite").state;
        State::new(q, -v)
    };
    let start = State::new(SVector::from([0.9, -0.3]), SVector::from([0.4, 1.0]));
    let State { q, v } = there(there(start));
    // Neighbouring motions part by some hundreds of times in ten seconds.
    assert!((q - start.q).amax() < 1e-12 && (v - start.v).amax() < 1e-12, "{:e}", (q - start.q).amax());
}

#[test]
fn a_box_tumbles_back_too() {
    let robot = FreeBox::drifting();
    let there = |start: State<f64, 7, 6>| {
        let mut simulation =
            Simulation::new(&robot, start, 1e-2).expect("valid").with_integrator(Variational);
        let State { q, v } = simulation.steps(300).last().expect("steps").expect("finite").state;
        State::new(q, -v)
    };
    let start = tossed();
    let State { q, v } = there(there(start));
    assert!(robot.difference(&start.q, &q).amax() < 1e-11);
    assert!((v - start.v).amax() < 1e-11);
}

#[test]
fn a_quaternion_alone_keeps_length_and_momentum() {
    let (inertia, mut random) = (Spinner.mass_matrix(&Spinner.neutral()), random_numbers(5));
    let start = State::new(random_vector::<4>(&mut random, 1.0).normalize(), random_vector(&mut random, 3.0));
    let in_world = |State { q, v }: &State<f64, 4, 3>| {
        use dynamics_core::nalgebra::{Quaternion, UnitQuaternion};
        UnitQuaternion::new_unchecked(Quaternion::from(*q)) * (inertia * v)
    };
    let before = in_world(&start);
    let mut simulation = Simulation::new(&Spinner, start, 2e-2).expect("valid").with_integrator(Variational);
    for sample in simulation.steps(5_000) {
        let state = sample.expect("finite").state;
        assert!((in_world(&state) - before).norm() < 1e-12);
        assert!((state.q.norm_squared() - 1.0).abs() <= 4.0 * f64::EPSILON);
    }
}

#[test]
fn a_step_too_large_is_an_error_and_leaves_the_state() {
    let start = State::new(SVector::from([0.4, 0.9]), SVector::from([3.0, -5.0]));
    let mut simulation =
        Simulation::new(&DoublePendulum, start, 3.0).expect("valid").with_integrator(Variational);
    let refused = simulation.step().err();
    assert!(matches!(refused, Some(Error::NotConverged { iterations: 2..=50 })), "{refused:?}");
    assert_eq!((simulation.time(), simulation.state()), (0.0, &start));
}

#[test]
fn what_rests_stays_at_rest() {
    let start = State::rest(SVector::from([1.2, -0.7]));
    let mut simulation = Simulation::new(&DoublePendulum, start, 1e-2)
        .expect("valid")
        .with_integrator(Variational)
        .with_input(|_time, state| DoublePendulum.gravity_forces(&state.q));
    for sample in simulation.steps(100) {
        assert!((sample.expect("finite").state.q - start.q).norm() < 1e-14);
    }
    let drifting = FreeBox::drifting();
    let mut nothing = Simulation::new(&drifting, State::rest(tossed().q), 1e-2)
        .expect("valid")
        .with_integrator(Variational);
    let last = nothing.steps(10).last().expect("steps").expect("nothing moves").state;
    assert_eq!(last.v.amax(), 0.0);
}

#[test]
fn it_runs_in_single_precision() {
    let robot = Pendulum { m: 1.0_f32, l: 1.0, damping: 0.5 };
    let mut simulation = Simulation::new(&robot, State::rest(SVector::from([0.5_f32])), 1e-3)
        .expect("valid")
        .with_integrator(Variational);
    assert!(simulation.steps(20_000).all(|sample| sample.is_ok()));
    assert!(simulation.state().q.norm() < 0.01, "damping brings it to rest");
}

/// A monitor of momenta sees what the box does; its centre of mass is its own.
#[test]
fn a_monitor_watches_the_momenta() {
    let (robot, start) = (FreeBox::drifting(), tossed());
    let mut simulation = Simulation::new(&robot, start, 1e-2).expect("valid").with_integrator(Variational);
    let mut monitor = MomentumMonitor::new(&simulation.sample());
    for sample in simulation.steps(1_000) {
        monitor.observe(&sample.expect("finite"));
    }
    // The centre of mass has flown 50 m, and not exactly straight: about it the method conserves to its order.
    assert!(monitor.linear() < 1e-12 && monitor.about_origin() < 1e-10, "{monitor:?}");
    assert!(monitor.angular() < 0.1, "{monitor:?}");

    let falls = FreeBox::tossed();
    let mut simulation = Simulation::new(&falls, start, 1e-3).expect("valid");
    let mut monitor = MomentumMonitor::new(&simulation.sample());
    for sample in simulation.steps(1_000) {
        monitor.observe(&sample.expect("finite"));
    }
    let expected = falls.mass * falls.gravity.norm();
    assert!((monitor.linear() - expected).abs() < 1e-6, "{monitor:?} is not {expected}");
    assert!(monitor.about_origin() > 1.0);
}
