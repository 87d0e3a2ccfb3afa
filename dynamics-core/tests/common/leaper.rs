//! A robot with everything: a free base, a ball joint, a spring with friction, a follower.
#![allow(unreachable_pub, missing_docs, reason = "it is a part of tests")]

use dynamics_core::prelude::*;

/// A trunk that nothing holds, and a leg.
#[derive(Clone, Copy, Debug, Dynamics)]
#[joint(flight: free, world -> trunk)]
#[body(trunk, mass = m, com = [0.05, 0.01, -0.02], inertia = tensor(0.05, 0.002, -0.004, 0.04, 0.001, 0.06))]
#[joint(hip: ball, trunk -> thigh, at = [0, 0.1, 0.03], rpy = [0, 0.1, 0.4])]
#[body(thigh, mass = 1.2, com = [0.05, c, 0.02], inertia = tensor(0.012, 0.001, 0, 0.007, 0.002, 0.013))]
#[joint(knee: revolute([0, 1, 1]), thigh -> shank, at = [0, 0.25, 0.05], rpy = [-0.7, 1.1, 0.2],
    stiffness = k, rest = 0.2, damping = 0.3, friction = 0.2, friction_speed = 0.5, armature = 0.01)]
#[body(shank, mass = 0.7, com = [0.02, -0.01, 0.06], inertia = diag(j, 0.004, 0.002))]
#[joint(toe: prismatic([1, 0, 2]), shank -> foot, at = [0.01, 0.03, 0.1], rpy = [0.2, 0, 0.4], mimic = knee, ratio = 0.2)]
#[body(foot, mass = 0.2, com = [0, 0.02, 0.05], inertia = diag(0.0004, 0.0005, 0.0002))]
pub struct Leaper<T> {
    pub m: T,
    pub c: T,
    pub j: T,
    pub k: T,
}

pub const NQ: usize = 12;
pub const NV: usize = 10;
pub const NX: usize = 20;
pub const NU: usize = 4;

/// The robot with its usual values.
pub fn leaper<T: Scalar>() -> Leaper<T> {
    Leaper { m: T::of(3.2), c: T::of(0.08), j: T::of(0.003), k: T::of(4.0) }
}
