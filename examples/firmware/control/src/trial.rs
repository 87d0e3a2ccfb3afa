//! The control loop: each robot, under each law, for a fifth of a second of simulated time.

use dynamics_core::prelude::*;
use dynamics_core::simulate::Explicit;

use crate::gains::{self, Gain};
use crate::laws::{Hold, Reference, computed_torque, gravity_compensation, state_feedback};
use crate::report::Number;
use crate::robots::{CartPole, Iiwa14, Puma560, RoboJudge};

/// The steps that each law is tried for.
pub const STEPS: u32 = 200;
/// The length of a step, in s.
pub const STEP: f64 = 1e-3;

/// What a robot is tried with.
#[derive(Clone, Copy, Debug)]
pub struct Setup<const N: usize, const NU: usize> {
    /// The robot's name.
    pub name: &'static str,
    /// The pose that the state feedback holds, and about which the reference swings.
    pub pose: [f32; N],
    /// How far the reference swings, and how far from the pose the other laws begin.
    pub swing: [f32; N],
    /// `d` of gravity compensation, in N·m·s or N·s/m.
    pub damping: [f32; N],
    /// `K` of the state feedback.
    pub gain: Gain<N, NU>,
}

/// Of [`RoboJudge`]: the arm level.
pub const ROBO_JUDGE: Setup<2, 2> = Setup {
    name: "robojudge",
    pose: [0.0, 0.3],
    swing: [0.5, -0.4],
    damping: [0.2, 0.5],
    gain: gains::ROBO_JUDGE,
};

/// Of [`CartPole`]: the pole upright.
pub const CART_POLE: Setup<2, 1> = Setup {
    name: "cart-pole",
    pose: [0.0, 0.0],
    swing: [0.1, 0.2],
    damping: [1.0, 0.05],
    gain: gains::CART_POLE,
};

/// Of [`Puma560`]: the elbow bent.
pub const PUMA560: Setup<6, 6> = Setup {
    name: "puma560",
    pose: [0.0, -0.8, 0.5, 0.0, 0.6, 0.0],
    swing: [0.3, -0.2, 0.2, 0.4, -0.3, 0.5],
    damping: [5.0, 5.0, 2.0, 0.1, 0.1, 0.01],
    gain: gains::PUMA560,
};

/// Of [`Iiwa14`]: the elbow bent.
pub const IIWA14: Setup<7, 7> = Setup {
    name: "iiwa14",
    pose: [0.1, 0.6, -0.2, -1.4, 0.3, 0.9, -0.5],
    swing: [0.3, -0.2, 0.2, 0.3, -0.3, 0.2, 0.5],
    damping: [5.0, 5.0, 2.0, 2.0, 0.5, 0.5, 0.05],
    gain: gains::IIWA14,
};

/// Who is told of each step.
pub trait Listener<T> {
    /// A law begins with a robot.
    fn begin(&mut self, robot: &'static str, law: &'static str);

    /// Its next step was made under the joint forces `tau`.
    fn step(&mut self, tau: &[T]);

    /// It is through.
    fn end(&mut self);
}

/// All trials, over the scalar `T`.
pub fn all<T: Number>(listener: &mut impl Listener<T>) {
    trial::<T, _, 2, 4, 2>(&RoboJudge::example(), &ROBO_JUDGE, listener);
    trial::<T, _, 2, 4, 1>(&CartPole, &CART_POLE, listener);
    trial::<T, _, 6, 12, 6>(&Puma560, &PUMA560, listener);
    trial::<T, _, 7, 14, 7>(&Iiwa14, &IIWA14, listener);
}

/// One robot under the three laws.
fn trial<T, R, const N: usize, const NX: usize, const NU: usize>(
    robot: &R,
    setup: &Setup<N, NU>,
    listener: &mut impl Listener<T>,
) where
    T: Number,
    R: StateSpaceModel<T, N, N, NX, NU>,
{
    let pose = SVector::from(setup.pose.map(T::of_single));
    let aside = State::rest(moved(&pose, &setup.swing, T::one()));

    listener.begin(setup.name, "computed torque");
    run(robot, aside, listener, |time, state| {
        let (sin, cos) = (T::of(10.0) * time).sin_cos();
        let swing = |factor| moved(&SVector::zeros(), &setup.swing, factor);
        let reference = Reference {
            q: moved(&pose, &setup.swing, T::one() - cos),
            v: swing(T::of(10.0) * sin),
            a: swing(T::of(100.0) * cos),
        };
        computed_torque(robot, state, &reference)
    });

    listener.begin(setup.name, "gravity compensation");
    let mut pushed = aside;
    pushed.v = moved(&SVector::zeros(), &setup.swing, T::of(-5.0));
    run(robot, pushed, listener, |_, state| gravity_compensation(robot, state, &setup.damping));

    listener.begin(setup.name, "LQR");
    let hold = Hold { q: pose, tau: robot.gravity_forces(&pose), input_map: robot.input_map() };
    let near = State::rest(moved(&pose, &setup.swing, T::of(0.25)));
    run(robot, near, listener, |_, state| state_feedback(&setup.gain, &hold, state));
}

/// `q + factor·swing`
fn moved<T: Number, const N: usize>(q: &SVector<T, N>, swing: &[f32; N], factor: T) -> SVector<T, N> {
    let mut moved = *q;
    for (moved, swing) in moved.iter_mut().zip(swing) {
        *moved = T::of_single(*swing).mul_add(factor, *moved);
    }
    moved
}

/// The loop: forces from the law, the next state from the forces.
fn run<T, R, const N: usize>(
    robot: &R,
    start: State<T, N, N>,
    listener: &mut impl Listener<T>,
    law: impl Fn(T, &State<T, N, N>) -> SVector<T, N>,
) where
    T: Number,
    R: Dynamics<T, N, N> + Configuration<T, N, N>,
{
    let step = T::of(STEP);
    let (mut time, mut state) = (T::zero(), start);
    for _ in 0..STEPS {
        let tau = law(time, &state);
        listener.step(tau.as_slice());
        state = SemiImplicitEuler.next(robot, time, &state, step, |_, _| tau);
        time += step;
    }
    listener.end();
}
