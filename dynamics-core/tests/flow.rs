//! Methods along a flow whose size Rust does not know take the steps that a robot's simulation takes.
#![cfg(feature = "std")]

use crate::common::free_box::FreeBox;
use crate::common::{DoublePendulum, Spinner};
use dynamics_core::prelude::*;
use dynamics_core::simulate::{Explicit, Flow, March};

/// A robot that has forgotten its sizes.
struct Sizeless<'r, R, const NQ: usize, const NV: usize>(&'r R);

fn sized<const N: usize>(x: &[f64]) -> SVector<f64, N> {
    SVector::from_column_slice(x)
}

impl<R, const NQ: usize, const NV: usize> Flow for Sizeless<'_, R, NQ, NV>
where
    R: Dynamics<f64, NQ, NV> + Configuration<f64, NQ, NV>,
{
    type Scalar = f64;
    type Position = Vec<f64>;
    type Velocity = Vec<f64>;

    fn integrate(&self, q: &Vec<f64>, delta: &Vec<f64>) -> Vec<f64> {
        self.0.integrate(&sized(q), &sized(delta)).as_slice().to_vec()
    }
    fn rate(&self, delta: &Vec<f64>, v: &Vec<f64>) -> Vec<f64> {
        self.0.rate(&sized(delta), &sized(v)).as_slice().to_vec()
    }
    fn acceleration(&mut self, time: f64, q: &Vec<f64>, v: &Vec<f64>) -> Vec<f64> {
        let state = State::new(sized(q), sized(v));
        let tau = push(time, &state);
        self.0.forward_dynamics(&state.q, &state.v, &tau).as_slice().to_vec()
    }
}

/// What drives all of them.
fn push<const NQ: usize, const NV: usize>(time: f64, state: &State<f64, NQ, NV>) -> SVector<f64, NV> {
    SVector::from_fn(|k, _| (time + k as f64).sin() - 0.1 * state.v[k])
}

/// Position and velocity without sizes.
type Place = (Vec<f64>, Vec<f64>);

/// The states of a robot, and those of the same without sizes, to the last bit.
fn agree<R, const NQ: usize, const NV: usize>(robot: &R, start: State<f64, NQ, NV>)
where
    R: Dynamics<f64, NQ, NV> + Configuration<f64, NQ, NV>,
{
    const STEP: f64 = 1.0 / 64.0; // whose sums are exact
    let place = || (start.q.as_slice().to_vec(), start.v.as_slice().to_vec());
    let mut flow = Sizeless::<R, NQ, NV>(robot);
    let by = |method: &dyn Fn(&mut Sizeless<'_, R, NQ, NV>, f64, &Place) -> Place| {
        let mut flow = Sizeless(robot);
        (0..100).fold(place(), |place, k| method(&mut flow, STEP * f64::from(k), &place))
    };
    let same = |state: &State<f64, NQ, NV>, (q, v): &Place| {
        assert_eq!((state.q.as_slice(), state.v.as_slice()), (&q[..], &v[..]));
    };
    let mut simulation = Simulation::new(robot, start, STEP).expect("valid").with_input(push);
    let last = simulation.steps(100).last().expect("there are steps").expect("finite");
    same(&last.state, &by(&|flow, time, (q, v)| Rk4.follow(flow, time, (q, v), STEP)));
    let simulation = Simulation::new(robot, start, STEP).expect("valid").with_input(push);
    let mut simulation = simulation.with_integrator(SemiImplicitEuler);
    let last = simulation.steps(100).last().expect("there are steps").expect("finite");
    same(&last.state, &by(&|flow, time, (q, v)| SemiImplicitEuler.follow(flow, time, (q, v), STEP)));

    let tolerances = Tolerances::of(1e-9);
    let mut adaptive = Adaptive::new(robot, start, tolerances).expect("valid").with_input(push);
    let mut march = March::new(place(), tolerances).expect("valid");
    for sample in adaptive.every(0.1, 2.0) {
        let sample = sample.expect("finite");
        same(&sample.state, &march.reach(&mut flow, sample.time, 2.0).expect("finite"));
    }
}

#[test]
fn a_flow_without_sizes_has_the_bits_of_a_robot() {
    agree(&DoublePendulum, State::new(SVector::from([1.2, -0.7]), SVector::from([0.3, 1.0])));
    let spin = SVector::from([0.5, 4.0, 0.7]);
    agree(&Spinner, State::new(SVector::from([0.0, 0.0, 0.0, 1.0]), spin));
    let twist = SVector::from([0.1, -0.2, 1.0, 0.5, 4.0, 0.7]);
    let parcel = FreeBox::tossed();
    agree(&parcel, State::new(parcel.neutral(), twist));
}

#[test]
fn a_step_without_an_error_is_the_step() {
    let state = State::new(SVector::from([1.2, -0.7]), SVector::from([0.3, 1.0]));
    let sure = Rk4.next(&DoublePendulum, 0.5, &state, 0.01, push);
    assert_eq!(Rk4.step(&DoublePendulum, 0.5, &state, 0.01, push), Ok(sure));
}

#[test]
fn a_march_says_what_is_wrong_with_it() {
    let place = || (vec![1.0, 0.5], vec![0.0, 0.0]);
    let new = |place, tolerance| March::new(place, Tolerances::of(tolerance)).map(|_| ());
    assert_eq!(new(place(), -1.0), Err(Error::ToleranceNotPositive));
    let lost = (vec![1.0, f64::NAN], vec![0.0, 0.0]);
    assert_eq!(new(lost, 1e-6), Err(Error::NotFinite { vector: "q", index: 1 }));
    let mut march = March::new(place(), Tolerances::of(1e-6)).expect("valid");
    let mut flow = Sizeless::<_, 2, 2>(&DoublePendulum);
    march.reach(&mut flow, 1.0, 2.0).expect("it swings");
    let before = march.reach(&mut flow, 0.0, 2.0);
    assert_eq!(before, Err(Error::TimeNotAhead));
    for time in [f64::NAN, f64::INFINITY] {
        assert_eq!(march.reach(&mut flow, time, 2.0), Err(Error::TimeNotAhead));
    }
    let few = March::new(place(), Tolerances::of(1e-12)).expect("valid").with_most_steps(3);
    assert!(matches!(few.clone().reach(&mut flow, 9.0, 9.0), Err(Error::TooManySteps { .. })));
}
