//! Recorded motions, what is between their states, and the accounts of their energy.
#![cfg(feature = "std")]

use crate::common::free_box::FreeBox;
use crate::common::{DoublePendulum, Pendulum};
use dynamics_core::nalgebra::Vector6;
use dynamics_core::prelude::*;
use dynamics_core::simulate::{EnergyMonitor, Segment, Trajectory};

fn tossed() -> State<f64, 7, 6> {
    State::new(
        SVector::from([0.2, -0.3, 1.0, 0.1, -0.5, 0.7, 0.5]),
        SVector::from([1.0, -2.0, 4.0, 2.0, 5.0, -3.0]),
    )
}

fn forced(time: f64, state: &State<f64, 7, 6>) -> Vector6<f64> {
    state.v * -0.1 + Vector6::from_fn(|i, _| (time * (1.0 + i as f64)).sin())
}

/// Between states of which nothing else is known, `q` is of the fourth order and `v` of the third.
#[test]
fn two_states_say_what_is_between_them() {
    let robot = FreeBox::tossed();
    let motion = Adaptive::new(&robot, tossed(), Tolerances::of(1e-14)).expect("valid");
    let motion = motion.with_input(forced).record(1.0).expect("finite");
    let error = |h: f64| {
        let times = [0.4, 0.4 + h];
        let [from, to] = times.map(|time| motion.at(time).expect("within"));
        let between = Segment::between(&robot, times, [&from, &to]);
        assert_eq!((between.start(), between.end(), between.at(&robot, times[1]).v), (0.4, 0.4 + h, to.v));
        let off = |part: f64| {
            let (found, exact) =
                (between.at(&robot, 0.4 + part * h), motion.at(0.4 + part * h).expect("within"));
            [robot.difference(&exact.q, &found.q).norm(), (exact.v - found.v).norm()]
        };
        [0.2, 0.35, 0.5, 0.8].map(off).into_iter().fold([0.0_f64; 2], |a, b| [a[0].max(b[0]), a[1].max(b[1])])
    };
    let ([q, v], [half_q, half_v]) = (error(0.1), error(0.05));
    let orders = [(q / half_q).log2(), (v / half_v).log2()];
    assert!((orders[0] - 4.0).abs() < 0.5 && (orders[1] - 3.0).abs() < 0.5, "observed orders {orders:?}");
}

#[test]
fn a_record_has_its_states_and_those_between() {
    let start = State::rest(SVector::from([1.2, -0.7]));
    let pull = |time: f64, _: &State<f64, 2, 2>| SVector::from([time.sin(), 0.0]);
    let fixed = Simulation::new(&DoublePendulum, start, 1e-2).expect("valid").with_input(pull).record(200);
    let adaptive =
        Adaptive::new(&DoublePendulum, start, Tolerances::of(1e-11)).expect("valid").with_input(pull);
    let (fixed, adaptive) = (fixed.expect("finite"), { adaptive }.record(2.0).expect("finite"));
    for motion in [&fixed, &adaptive] {
        assert_eq!((motion.start(), motion.times()[0], motion.states()[0]), (0.0, 0.0, start));
        assert!((motion.end() - 2.0).abs() < 1e-12);
        for (k, (time, state)) in motion.times().iter().zip(motion.states()).enumerate() {
            assert_eq!(motion.at(*time), Some(*state));
            assert_eq!(motion.inputs()[k], pull(*time, state));
            assert_eq!(motion.nearest(*time), k);
        }
        assert_eq!(motion.samples().count(), motion.times().len());
        assert!(motion.at(-1e-9).is_none() && motion.at(2.1).is_none() && motion.at(f64::NAN).is_none());
        assert_eq!((motion.nearest(-5.0), motion.nearest(5.0)), (0, motion.times().len() - 1));
    }
    assert_eq!(fixed.times().len(), 201);
    for k in 0..=199 {
        let time = 0.01 * f64::from(k) + 0.003;
        let [a, b] = [&fixed, &adaptive].map(|motion| motion.at(time).expect("within"));
        // Runge's and Kutta's error at this step, and Hermite's.
        assert!((a.q - b.q).amax() < 1e-6 && (a.v - b.v).amax() < 1e-3, "{time}");
    }
    assert_eq!(fixed.nearest(0.0149), 1);
    assert_eq!(fixed.nearest(0.0151), 2);
    let times: Vec<f64> = adaptive.every(0.5).map(|sample| sample.time).collect();
    assert_eq!(times, [0.0, 0.5, 1.0, 1.5, 2.0]);
    assert_eq!(adaptive.every(0.0).count(), 1);
    assert_eq!(adaptive.every(f64::NAN).count(), 1);
}

#[test]
fn a_record_from_the_middle_of_a_step_begins_there() {
    let start = State::rest(SVector::from([1.2, -0.7]));
    let mut simulation = Adaptive::new(&DoublePendulum, start, Tolerances::of(1e-9)).expect("valid");
    assert_eq!(simulation.every(0.1, 2.0).take(3).filter_map(Result::ok).count(), 3);
    let (now, state) = (simulation.time(), *simulation.state());
    let motion = simulation.record(2.0).expect("finite");
    assert_eq!((motion.start(), motion.states()[0]), (now, state));
    assert!(motion.at(now - 1e-6).is_none());
    let near = motion.at(now + 1e-9).expect("within");
    assert!((near.q - state.q).amax() < 1e-7);
}

#[test]
fn a_record_by_hand_goes_forwards_only() {
    let mut simulation =
        Simulation::new(&DoublePendulum, State::rest(SVector::from([1.2, -0.7])), 1e-2).expect("valid");
    let o = SVector::zeros();
    let mut motion = Trajectory::new(simulation.sample(), o);
    let sample = simulation.step().expect("finite");
    assert_eq!(motion.push(sample, o), Ok(()));
    assert_eq!(motion.push(sample, o), Err(Error::TimeNotAhead));
    assert_eq!(motion.times(), [0.0, 0.01]);
    assert!(motion.at(0.005).is_some_and(|state| state.check().is_ok()));
}

#[test]
fn an_account_of_energy_finds_work_and_losses() {
    let robot = FreeBox::tossed();
    let mut simulation = Simulation::new(&robot, tossed(), 1e-3).expect("valid").with_input(forced);
    let mut monitor = EnergyMonitor::new(&simulation.sample());
    let start = simulation.sample().energy().total();
    for sample in simulation.steps(1_000) {
        monitor.observe(&sample.expect("finite"), forced);
    }
    let gained = simulation.sample().energy().total() - start;
    // Of Runge and Kutta, of Simpson and of Hermite, at a thousandth.
    assert!((gained - monitor.work()).abs() < 1e-8 && gained.abs() > 0.1, "{gained} J, {monitor:?}");
    assert_eq!(monitor.dissipated(), 0.0);
    assert!(monitor.drift() < 1e-8 && monitor.drift() >= monitor.imbalance().abs());
}

/// A pendulum whose damper the robot itself has.
struct Damped(Pendulum<f64>);

impl Dynamics<f64, 1, 1> for Damped {
    fn mass_matrix(&self, q: &SVector<f64, 1>) -> SMatrix<f64, 1, 1> {
        self.0.mass_matrix(q)
    }
    fn coriolis_matrix(&self, q: &SVector<f64, 1>, v: &SVector<f64, 1>) -> SMatrix<f64, 1, 1> {
        self.0.coriolis_matrix(q, v)
    }
    fn gravity_forces(&self, q: &SVector<f64, 1>) -> SVector<f64, 1> {
        self.0.gravity_forces(q)
    }
    fn passive_forces(&self, q: &SVector<f64, 1>, v: &SVector<f64, 1>) -> SVector<f64, 1> {
        v * self.0.damping + q * 2.0
    }
    fn elastic_energy(&self, q: &SVector<f64, 1>) -> f64 {
        q[0] * q[0]
    }
    fn bias_forces(&self, q: &SVector<f64, 1>, v: &SVector<f64, 1>) -> SVector<f64, 1> {
        self.gravity_forces(q) + self.passive_forces(q, v)
    }
    fn inverse_dynamics(
        &self,
        q: &SVector<f64, 1>,
        v: &SVector<f64, 1>,
        a: &SVector<f64, 1>,
    ) -> SVector<f64, 1> {
        self.mass_matrix(q) * a + self.bias_forces(q, v)
    }
    fn forward_dynamics(
        &self,
        q: &SVector<f64, 1>,
        v: &SVector<f64, 1>,
        tau: &SVector<f64, 1>,
    ) -> SVector<f64, 1> {
        (tau - self.bias_forces(q, v)) / self.mass_matrix(q)[(0, 0)]
    }
    fn kinetic_energy(&self, q: &SVector<f64, 1>, v: &SVector<f64, 1>) -> f64 {
        self.0.kinetic_energy(q, v)
    }
    fn potential_energy(&self, q: &SVector<f64, 1>) -> f64 {
        self.0.potential_energy(q)
    }
    fn lagrangian(&self, q: &SVector<f64, 1>, v: &SVector<f64, 1>) -> f64 {
        self.kinetic_energy(q, v) - self.potential_energy(q)
    }
}

impl Configuration<f64, 1, 1> for Damped {
    fn integrate(&self, q: &SVector<f64, 1>, delta: &SVector<f64, 1>) -> SVector<f64, 1> {
        q + delta
    }
}

#[test]
fn what_dampers_take_is_on_the_account_and_springs_give_back() {
    let robot = Damped(Pendulum { m: 1.0, l: 1.0, damping: 0.4 });
    let start = State::new(SVector::from([1.0]), SVector::from([-2.0]));
    let account = |step: f64, count: usize| {
        let mut simulation = Simulation::new(&robot, start, step).expect("valid");
        let (first, tau) = (simulation.sample(), SVector::from([3.0]));
        assert_eq!((first.power(&tau), first.dissipation()), (-6.0, 0.4 * 4.0));
        let mut monitor = EnergyMonitor::new(&first);
        for sample in simulation.steps(count) {
            monitor.observe(&sample.expect("finite"), |_, _| SVector::zeros());
        }
        assert_eq!(monitor.work(), 0.0);
        assert!(monitor.dissipated() > 0.5, "{monitor:?}");
        monitor.drift()
    };
    let (coarse, fine) = (account(1e-2, 200), account(5e-3, 400));
    let order = (coarse / fine).log2();
    assert!(fine < 1e-8 && order > 3.7, "{fine:e} J, of order {order}");
}
