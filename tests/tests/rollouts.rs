//! Rollouts in lanes and on all cores are simulations, one by one: to the last bit, and to the last finite state.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use dynamics_core::lanes::{Lanes, Native};
use dynamics_core::prelude::*;
use dynamics_core::rollout::RolloutError;
use dynamics_core::simulate::Explicit;
use dynamics_tests::random::Random;
use dynamics_tests::zoo::joints::free_box::FreeBox;
use rayon::ThreadPoolBuilder;

type Start = State<f64, 7, 6>;

/// Steps whose sums round.
const STEP: f64 = 5e-4;
const STEPS: usize = 200;
/// Ends with a sample that is nearer than the others.
const EVERY: usize = 60;

/// A box of some mass, which is turned by its own speed and by time.
fn parcel<T: Scalar>(m: T) -> FreeBox<T> {
    let [l, w, h, g] = [0.4, 0.3, 0.2, 9.81].map(T::of);
    FreeBox { m, l, w, h, g }
}

fn drive<T: Scalar>(gain: T, time: T, state: &State<T, 7, 6>) -> SVector<T, 6> {
    state.v * (gain * (time + T::one()))
}

/// What rollouts start from, their masses, and the gains of what drives them.
struct Given {
    starts: Vec<Start>,
    masses: Vec<f64>,
    gains: Vec<f64>,
}

impl Given {
    fn random(count: usize) -> Self {
        let mut random = Random::of("rollouts");
        let neutral: SVector<f64, 7> = parcel(1.0).neutral();
        let mut start = || {
            let [delta, v] = [(); 2].map(|()| SVector::<f64, 6>::from_fn(|_, _| 2.0 * random.number()));
            State::new(parcel(1.0).integrate(&neutral, &delta), v)
        };
        let starts = (0..count).map(|_| start()).collect();
        let masses = (0..count).map(|k| 0.5 + 0.1 * k as f64).collect();
        let gains = (0..count).map(|k| -0.2 + 0.05 * k as f64).collect();
        Self { starts, masses, gains }
    }

    /// By a simulation of each alone: samples as far as they are finite, and the time of the last finite state.
    fn alone(&self, k: usize, integrator: impl Integrator + Copy) -> (Vec<Start>, f64) {
        let (robot, gain) = (parcel(self.masses[k]), self.gains[k]);
        let simulation = Simulation::new(&robot, self.starts[k], STEP).unwrap();
        let mut simulation =
            simulation.with_integrator(integrator).with_input(|time, state| drive(gain, time, state));
        let mut samples = vec![];
        for step in 1..=STEPS {
            let Ok(now) = simulation.step() else { break };
            if step % EVERY == 0 || step == STEPS {
                samples.push(now.state);
            }
        }
        (samples, simulation.time())
    }

    /// By rollouts in lanes `L`: all samples, and the times of the last finite states.
    fn together<L: Lanes<Element = f64>>(
        &self,
        integrator: impl Explicit + Copy + Sync,
        threads: usize,
    ) -> (Vec<Start>, Vec<f64>) {
        let rollouts = Rollouts::new(STEP, STEPS).unwrap().every(EVERY).with_integrator(integrator);
        let rollouts = rollouts.in_lanes::<L>();
        let given = (&self.starts, &self.masses, &self.gains);
        let rollout = |(start, mass, gain)| {
            Rollout::new(parcel(mass), start).with_input(move |time, state| drive(gain, time, state))
        };
        let mut samples = vec![self.starts[0]; self.starts.len() * rollouts.samples()];
        let mut sound = vec![-1.0; self.starts.len()];
        if threads == 0 {
            rollouts.run(given, &mut samples, &mut sound, rollout).unwrap();
        } else {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| rollouts.par_run(given, &mut samples, &mut sound, rollout)).unwrap();
        }
        (samples, sound)
    }

    fn agree<L: Lanes<Element = f64>>(&self, integrator: impl Explicit + Copy + Sync, threads: usize) {
        let (samples, sound) = self.together::<L>(integrator, threads);
        let each = STEPS.div_ceil(EVERY);
        for k in 0..self.starts.len() {
            let (expected, until) = self.alone(k, integrator);
            assert_eq!(samples[k * each..][..expected.len()], expected, "rollout {k}");
            assert_eq!(sound[k], until, "rollout {k}");
        }
    }
}

#[test]
fn rollouts_are_simulations_in_any_lanes_on_any_number_of_threads() {
    for count in [1, 3, 8, 13] {
        let given = Given::random(count);
        for threads in [0, 1, 2, 3] {
            given.agree::<f64x4>(Rk4, threads);
            given.agree::<f64x8>(SemiImplicitEuler, threads);
        }
        given.agree::<Native<f64>>(Rk4, 0);
    }
}

#[test]
fn a_rollout_that_is_lost_says_when_and_leaves_its_neighbours_alone() {
    let mut given = Given::random(11);
    given.gains[2] = 1e5; // grows beyond all numbers within a few steps
    given.starts[6].v[3] = 1e200; // its square is infinite
    given.masses[9] = f64::NAN;
    for threads in [0, 2] {
        given.agree::<f64x4>(Rk4, threads);
        given.agree::<f64x8>(Rk4, threads);
    }
    let (_, sound) = given.together::<f64x8>(Rk4, 0);
    let end = sound[0];
    assert!(sound[2] > 0.0 && sound[2] < end && sound[6] == 0.0 && sound[9] == 0.0, "{sound:?}");
    assert!((0..11).filter(|k| ![2, 6, 9].contains(k)).all(|k| sound[k] == end));
}

#[test]
fn samples_have_the_times_that_simulations_have() {
    let rollouts = Rollouts::new(STEP, STEPS).unwrap().every(EVERY);
    let robot = parcel(1.0);
    let mut simulation = Simulation::new(&robot, Given::random(1).starts[0], STEP).unwrap();
    let all: Vec<f64> = simulation.steps(STEPS).map(|sample| sample.unwrap().time).collect();
    let expected: Vec<f64> = [60, 120, 180, 200].iter().map(|step| all[step - 1]).collect();
    assert_eq!(rollouts.times().collect::<Vec<_>>(), expected);
    assert_eq!(rollouts.samples(), 4);
    let few: Vec<f64> = Rollouts::new(STEP, 3).unwrap().every(0).times().collect();
    assert_eq!(few, all[..3]);
    assert_eq!(Rollouts::new(STEP, 0).unwrap().samples(), 0);
}

/// An observer may add up, in every lane, and sees each end of a step once.
#[test]
fn an_observer_sees_every_step_of_every_lane() {
    let Given { starts, masses, gains } = Given::random(6);
    let rollouts = Rollouts::new(STEP, STEPS).unwrap().every(100);
    let mut found = [(0.0, 0.0); 12];
    let observed = |(start, mass, gain)| {
        let mut way = Native::<f64>::from(0.0);
        let rollout =
            Rollout::new(parcel(mass), start).with_input(move |time, state| drive(gain, time, state));
        rollout.with_observer(move |now| {
            way += now.state.v[0] * now.state.v[0];
            (way, now.robot.total_energy(&now.state.q, &now.state.v) * now.time)
        })
    };
    rollouts.run((&starts, &masses, &gains), &mut found, &mut [0.0; 6], observed).unwrap();
    for k in 0..6 {
        let (robot, gain) = (parcel(masses[k]), gains[k]);
        let mut simulation =
            Simulation::new(&robot, starts[k], STEP).unwrap().with_input(|t, s| drive(gain, t, s));
        let mut way = 0.0;
        for (step, now) in simulation.steps(STEPS).enumerate() {
            let now = now.unwrap();
            way += now.state.v[0] * now.state.v[0];
            if (step + 1) % 100 == 0 {
                let expected = (way, robot.total_energy(&now.state.q, &now.state.v) * now.time);
                assert_eq!(found[2 * k + step / 100], expected, "rollout {k}");
            }
        }
    }
}

#[test]
fn what_cannot_begin_is_told_with_its_rollout() {
    let mut given = Given::random(11);
    let rollouts = Rollouts::new(STEP, STEPS).unwrap();
    let run = |given: &Given, samples: usize, times: usize| {
        let start = Given::random(1).starts[0];
        let (mut samples, mut sound) = (vec![start; samples], vec![7.0; times]);
        let error =
            rollouts.run((&given.starts, &given.masses), &mut samples, &mut sound, |(start, mass)| {
                Rollout::new(parcel(mass), start)
            });
        assert!(error.is_ok() || sound.iter().all(|time| *time == 7.0), "nothing is written");
        error
    };
    assert_eq!(run(&given, 11, 11), Ok(()));
    assert_eq!(run(&given, 10, 11), Err(RolloutError::Samples { found: 10, needed: 11 }));
    let length = Error::BatchLength { results: 10, states: 11 };
    assert_eq!(run(&given, 10, 10), Err(RolloutError::Given(length)));
    given.starts[9].v[4] = f64::INFINITY;
    let error = RolloutError::Start { rollout: 9, error: Error::NotFinite { vector: "v", index: 4 } };
    assert_eq!(run(&given, 11, 11), Err(error));
    assert_eq!(error.to_string(), "the start of rollout 9: v[4] is not finite");
    given.starts[3].q[6] += 0.1;
    let error = RolloutError::Start { rollout: 3, error: Error::NotUnitQuaternion { index: 3 } };
    assert_eq!(run(&given, 11, 11), Err(error));
    let starts = Given::random(5).starts;
    let mut sound = [7.0; 5];
    let error = rollouts.par_run(&starts[..4], &mut starts.clone(), &mut sound, |start| {
        Rollout::new(parcel(Native::<f64>::from(1.0)), start)
    });
    assert_eq!(error, Err(RolloutError::Given(Error::BatchLength { results: 5, states: 4 })));
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(Rollouts::new(step, 1).err(), Some(Error::StepNotPositive));
    }
}
