//! The control loop: each robot, under each law, for a fifth of a second of simulated time.

use dynamics_core::control::{ComputedTorque, GravityCompensation, StateFeedback};
use dynamics_core::prelude::*;
use dynamics_core::simulate::Explicit;

use crate::gains;
use crate::report::Number;
use crate::robots::{CartPole, Iiwa14, Leg, Puma560, RoboJudge};

/// The steps that each law is tried for.
pub const STEPS: u32 = 200;
/// The length of a step, in s.
pub const STEP: f64 = 1e-3;

/// What a robot is tried with.
#[derive(Clone, Copy, Debug)]
pub struct Setup<const N: usize, const NX: usize, const NU: usize> {
    /// The robot's name.
    pub name: &'static str,
    /// The pose that the state feedback holds, and about which the reference swings.
    pub pose: [f32; N],
    /// How far the reference swings, and how far from the pose the other laws begin.
    pub swing: [f32; N],
    /// `K_d` of gravity compensation, in N·m·s/rad or N·s/m.
    pub damping: [f32; N],
    /// `K` of the state feedback, by rows.
    pub gain: [[f32; NX]; NU],
}

impl<const N: usize, const NX: usize, const NU: usize> Setup<N, NX, NU> {
    /// The pose as a state at rest.
    #[must_use]
    pub fn rest<T: Number>(&self) -> State<T, N, N> {
        State::rest(SVector::from(self.pose.map(T::of_single)))
    }

    /// The state feedback about the pose, whose input `u₀` is the one that holds the robot there.
    #[must_use]
    pub fn feedback<T, R>(&self, robot: &R) -> StateFeedback<T, N, N, NX, NU>
    where
        T: Number,
        R: StateSpaceModel<T, N, N, NX, NU>,
    {
        let state = self.rest();
        let u = robot.input_map().tr_mul(&robot.bias_forces(&state.q, &state.v));
        let mut gain = SMatrix::<T, NU, NX>::zeros();
        for (mut row, values) in gain.row_iter_mut().zip(&self.gain) {
            for (entry, value) in row.iter_mut().zip(values) {
                *entry = T::of_single(*value);
            }
        }
        StateFeedback::new(state, u, gain)
    }
}

/// Of [`RoboJudge`]: the arm level.
pub const ROBO_JUDGE: Setup<2, 4, 2> = Setup {
    name: "robojudge",
    pose: [0.0, 0.3],
    swing: [0.5, -0.4],
    damping: [0.2, 0.5],
    gain: gains::ROBO_JUDGE,
};

/// Of [`CartPole`]: the pole upright.
pub const CART_POLE: Setup<2, 4, 1> = Setup {
    name: "cart-pole",
    pose: [0.0, 0.0],
    swing: [0.1, 0.2],
    damping: [1.0, 0.05],
    gain: gains::CART_POLE,
};

/// Of [`Puma560`]: the elbow bent.
pub const PUMA560: Setup<6, 12, 6> = Setup {
    name: "puma560",
    pose: [0.0, -0.8, 0.5, 0.0, 0.6, 0.0],
    swing: [0.3, -0.2, 0.2, 0.4, -0.3, 0.5],
    damping: [5.0, 5.0, 2.0, 0.1, 0.1, 0.01],
    gain: gains::PUMA560,
};

/// Of [`Iiwa14`]: the elbow bent.
pub const IIWA14: Setup<7, 14, 7> = Setup {
    name: "iiwa14",
    pose: [0.1, 0.6, -0.2, -1.4, 0.3, 0.9, -0.5],
    swing: [0.3, -0.2, 0.2, 0.3, -0.3, 0.2, 0.5],
    damping: [5.0, 5.0, 2.0, 2.0, 0.5, 0.5, 0.05],
    gain: gains::IIWA14,
};

/// Of [`Leg`]: the knee bent.
pub const LEG: Setup<3, 6, 3> = Setup {
    name: "leg",
    pose: [0.1, -0.5, 1.2],
    swing: [0.2, 0.3, -0.4],
    damping: [0.2, 0.2, 0.1],
    gain: gains::LEG,
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
    trial::<T, _, 3, 6, 3>(&Leg, &LEG, listener);
}

/// One robot under the three laws.
fn trial<T, R, const N: usize, const NX: usize, const NU: usize>(
    robot: &R,
    setup: &Setup<N, NX, NU>,
    listener: &mut impl Listener<T>,
) where
    T: Number,
    R: StateSpaceModel<T, N, N, NX, NU>,
{
    let rest = setup.rest();
    let aside = State::rest(moved(&rest.q, &setup.swing, T::one()));

    listener.begin(setup.name, "computed torque");
    let law = ComputedTorque::critically_damped(SVector::repeat(T::of(20.0)));
    run(robot, aside, listener, |time, state| {
        let (sin, cos) = (T::of(10.0) * time).sin_cos();
        let swing = |factor| moved(&SVector::zeros(), &setup.swing, factor);
        let reference = Reference {
            q: moved(&rest.q, &setup.swing, T::one() - cos),
            v: swing(T::of(10.0) * sin),
            a: swing(T::of(100.0) * cos),
        };
        law.torque(robot, state, &reference)
    });

    // Without stiffness the robot floats, and comes to rest where it is left.
    listener.begin(setup.name, "gravity compensation");
    let derivative = SVector::from(setup.damping.map(T::of_single));
    let law = GravityCompensation { proportional: SVector::zeros(), derivative };
    let pushed = State { v: moved(&SVector::zeros(), &setup.swing, T::of(-5.0)), ..aside };
    run(robot, pushed, listener, |_, state| law.torque(robot, state, &Reference::rest(rest.q)));

    listener.begin(setup.name, "LQR");
    let law = setup.feedback(robot);
    let near = State::rest(moved(&rest.q, &setup.swing, T::of(0.25)));
    run(robot, near, listener, |_, state| law.torque(robot, state));
}

/// The state a step later, under joint forces that do not change on the way.
pub fn advanced<T, R, const N: usize>(
    robot: &R,
    time: T,
    state: &State<T, N, N>,
    step: T,
    tau: &SVector<T, N>,
) -> State<T, N, N>
where
    T: Scalar,
    R: Dynamics<T, N, N> + Configuration<T, N, N>,
{
    SemiImplicitEuler.next(robot, time, state, step, |_, _| *tau)
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
        state = advanced(robot, time, &state, step, &tau);
        time += step;
    }
    listener.end();
}
