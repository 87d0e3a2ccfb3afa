//! Control laws: joint forces from a state.

use dynamics_core::prelude::*;

use crate::gains::Gain;
use crate::report::Number;

/// Where a robot shall be: position, velocity and acceleration.
#[derive(Clone, Copy, Debug)]
pub struct Reference<T, const N: usize> {
    /// In rad or m.
    pub q: SVector<T, N>,
    /// In rad/s or m/s.
    pub v: SVector<T, N>,
    /// In rad/s² or m/s².
    pub a: SVector<T, N>,
}

/// `τ = ID(q, v, a_r + 2ω·(v_r − v) + ω²·(q_r − q))`, with ω = 20 rad/s: each joint's error falls like that of a
/// critically damped spring, whatever the robot.
pub fn computed_torque<R, T, const N: usize>(
    robot: &R,
    state: &State<T, N, N>,
    reference: &Reference<T, N>,
) -> SVector<T, N>
where
    R: Dynamics<T, N, N>,
    T: Scalar,
{
    let [stiffness, damping] = [T::of(400.0), T::of(40.0)];
    let mut a = reference.a;
    for (a, (target, now)) in a.iter_mut().zip(reference.v.iter().zip(&state.v)) {
        *a = damping.mul_add(*target - *now, *a);
    }
    for (a, (target, now)) in a.iter_mut().zip(reference.q.iter().zip(&state.q)) {
        *a = stiffness.mul_add(*target - *now, *a);
    }
    robot.inverse_dynamics(&state.q, &state.v, &a)
}

/// `τ = G(q) − d·v`: the robot floats, and comes to rest where it is left.
pub fn gravity_compensation<R, T, const N: usize>(
    robot: &R,
    state: &State<T, N, N>,
    damping: &[f32; N],
) -> SVector<T, N>
where
    R: Dynamics<T, N, N>,
    T: Number,
{
    let mut tau = robot.gravity_forces(&state.q);
    for (tau, (d, v)) in tau.iter_mut().zip(damping.iter().zip(&state.v)) {
        *tau = (-T::of_single(*d)).mul_add(*v, *tau);
    }
    tau
}

/// `u = −K·(x − x₀)` about the pose `x₀ = (hold, 0)`, and the joint forces `τ = τ₀ + B_u·u` of it.
pub fn state_feedback<T, const N: usize, const NU: usize>(
    gain: &Gain<N, NU>,
    hold: &Hold<T, N, NU>,
    state: &State<T, N, N>,
) -> SVector<T, N>
where
    T: Number,
{
    let mut tau = hold.tau;
    let inputs = gain.position.iter().zip(&gain.velocity).zip(hold.input_map.column_iter());
    for ((position, velocity), column) in inputs {
        let mut u = T::zero();
        for (k, (q, hold)) in position.iter().zip(state.q.iter().zip(&hold.q)) {
            u = T::of_single(*k).mul_add(*hold - *q, u);
        }
        for (k, v) in velocity.iter().zip(&state.v) {
            u = (-T::of_single(*k)).mul_add(*v, u);
        }
        for (tau, share) in tau.iter_mut().zip(&column) {
            *tau = share.mul_add(u, *tau);
        }
    }
    tau
}

/// The pose that a state feedback holds.
#[derive(Clone, Copy, Debug)]
pub struct Hold<T, const N: usize, const NU: usize> {
    /// The pose.
    pub q: SVector<T, N>,
    /// The joint forces that hold it, `G(q)`.
    pub tau: SVector<T, N>,
    /// `B_u`, N×NU: the joint forces of the inputs.
    pub input_map: SMatrix<T, N, NU>,
}
