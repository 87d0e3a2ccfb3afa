//! The robots, each as on its page among the examples, and a leg.
#![allow(missing_docs, reason = "fields are the symbols of the lecture; joints and bodies have their names")]
#![allow(clippy::duplicated_attributes, reason = "two joints may have the same motor")]

use dynamics_core::prelude::*;

/// A column that turns, and an arm that pitches on top of it.
#[derive(Dynamics)]
#[dynamics(gravity = [0, 0, -g])]
#[joint(theta1: revolute(z), world -> column)]
#[body(column, mass = m1, com = [0, 0, r0], inertia = diag(ix1, iy1, iz1))]
#[joint(theta2: revolute(-x), column -> arm, at = [0, 0, l1])]
#[body(arm, mass = m2, com = [0, r1, 0], inertia = diag(ix2, iy2, iz2))]
#[rustfmt::skip]
pub struct RoboJudge<T> {
    pub m1: T, pub m2: T, pub l1: T, pub r0: T, pub r1: T, pub g: T,
    pub ix1: T, pub iy1: T, pub iz1: T, pub ix2: T, pub iy2: T, pub iz2: T,
}

/// A cart on rails, and on it a rod that stands upright at zero. Its one motor moves the cart.
#[derive(Dynamics)]
#[joint(slider: prismatic(x), world -> cart)]
#[body(cart, solid = cuboid(1, [300mm, 200mm, 100mm]))]
#[joint(hinge: revolute(y), cart -> pole, actuated = off)]
#[body(pole, com = [0, 0, 0.5], solid = cylinder(0.1, 5mm, 1))]
pub struct CartPole;

/// The PUMA 560 of Armstrong, Khatib and Burdick.
#[derive(Dynamics)]
#[joint(joint1: revolute, world -> link1, mdh(0, 0, 0, 0))]
#[body(link1, mass = 0, inertia = diag(0, 0, 0.35), allow(nonphysical_inertia))]
#[joint(joint2: revolute, link1 -> link2, mdh(0, -90deg, 0.2435, 0))]
#[body(link2, mass = 17.4, com = [0.068, 0.006, -0.016], inertia = diag(0.13, 0.524, 0.539))]
#[joint(joint3: revolute, link2 -> link3, mdh(0.4318, 0, -0.0934, 0))]
#[body(
    link3, mass = 4.8, com = [0, -0.07, 0.014], inertia = diag(0.066, 0.0125, 0.086), allow(nonphysical_inertia)
)]
#[joint(joint4: revolute, link3 -> link4, mdh(-0.0203, 90deg, 0.4331, 0))]
#[body(link4, mass = 0.82, com = [0, 0, -0.019], inertia = diag(1.8e-3, 1.8e-3, 1.3e-3))]
#[joint(joint5: revolute, link4 -> link5, mdh(0, -90deg, 0, 0))]
#[body(link5, mass = 0.34, inertia = diag(0.3e-3, 0.3e-3, 0.4e-3))]
#[joint(joint6: revolute, link5 -> link6, mdh(0, 90deg, 0, 0))]
#[body(link6, mass = 0.09, com = [0, 0, 0.032], inertia = diag(0.15e-3, 0.15e-3, 0.04e-3))]
pub struct Puma560;

/// The KUKA LBR iiwa 14, from the numbers of its URDF.
#[derive(Dynamics)]
#[joint(joint1: revolute(z), world -> link1, at = [0, 0, 0.1575])]
#[body(link1, mass = 5.76, com = [0, -0.03, 0.12], inertia = diag(0.033, 0.0333, 0.0123))]
#[joint(joint2: revolute(z), link1 -> link2, at = [0, 0, 0.2025], rpy = [90deg, 0, 180deg])]
#[body(link2, mass = 6.35, com = [0.0003, 0.059, 0.042], inertia = diag(0.0305, 0.0304, 0.011))]
#[joint(joint3: revolute(z), link2 -> link3, at = [0, 0.2045, 0], rpy = [90deg, 0, 180deg])]
#[body(link3, mass = 3.5, com = [0, 0.03, 0.13], inertia = diag(0.025, 0.0238, 0.0076))]
#[joint(joint4: revolute(z), link3 -> link4, at = [0, 0, 0.2155], rpy = [90deg, 0, 0])]
#[body(link4, mass = 3.5, com = [0, 0.067, 0.034], inertia = diag(0.017, 0.0164, 0.006))]
#[joint(joint5: revolute(z), link4 -> link5, at = [0, 0.1845, 0], rpy = [-90deg, 180deg, 0])]
#[body(link5, mass = 3.5, com = [0.0001, 0.021, 0.076], inertia = diag(0.01, 0.0087, 0.00449))]
#[joint(joint6: revolute(z), link5 -> link6, at = [0, 0, 0.2155], rpy = [90deg, 0, 0])]
#[body(link6, mass = 1.8, com = [0, 0.0006, 0.0004], inertia = diag(0.0049, 0.0047, 0.0036))]
#[joint(joint7: revolute(z), link6 -> link7, at = [0, 0.081, 0], rpy = [-90deg, 180deg, 0])]
#[body(link7, mass = 1.2, com = [0, 0, 0.02], inertia = diag(0.001, 0.001, 0.001))]
pub struct Iiwa14;

/// A leg of a URDF, with what that does not say: the motors, and a spring beside the knee's.
#[derive(Dynamics)]
#[dynamics(urdf = "leg.urdf")]
#[joint(roll, rotor = 2e-5, gear = 9)]
#[joint(pitch, rotor = 2e-5, gear = 9)]
#[joint(knee, rotor = 2e-5, gear = 9, stiffness = 4, rest = 60deg)]
pub struct Leg;

impl<T: Scalar> RoboJudge<T> {
    /// With the numbers of the example.
    #[rustfmt::skip]
    pub fn example() -> Self {
        Self {
            m1: T::of(4.0), m2: T::of(1.5), l1: T::of(0.9), r0: T::of(0.4), r1: T::of(0.3), g: T::of(9.81),
            ix1: T::of(0.3), iy1: T::of(0.3), iz1: T::of(0.05), ix2: T::of(0.06), iy2: T::of(0.01), iz2: T::of(0.055),
        }
    }
}
