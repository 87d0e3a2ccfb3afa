//! Robots with something in their joints or around them: rotors, dampers, friction, springs, no motor, any gravity.
#![allow(missing_docs, reason = "the fields have no meaning beyond their robot")]

use super::{Entry, robot};

/// All of them.
pub fn all() -> Vec<Entry> {
    vec![driven_arm::entry(), sprung::entry(), cart_with_motor::entry(), on_a_vehicle::entry()]
}

robot! {
    driven_arm = DrivenArm, [3], [Upper, Lower, Rod];
    /// Motors with gears, dampers and friction, all in numbers.
    #[joint(shoulder: revolute(y), world -> upper, rotor = 2e-5, gear = 120, damping = 0.4, friction = 0.3)]
    #[body(upper, mass = 2.1, com = [0.15, 0.01, 0.02], inertia = tensor(0.005, 0.001, 0, 0.03, 0.002, 0.031))]
    #[joint(elbow: revolute([0, 1, 0.5]), upper -> lower, at = [0.3, 0, 0], rpy = [0.2, 0, 0.1], rotor = 1e-5, gear = -80,
        friction = 0.2, friction_speed = 0.3)]
    #[body(lower, mass = 1.3, com = [0.12, 0, 0.01], inertia = diag(0.002, 0.01, 0.011))]
    #[joint(stroke: prismatic(x), lower -> rod, at = [0.25, 0, 0.02], armature = 300g, damping = 12)]
    #[body(rod, mass = 0.5, com = [0.05, 0, 0], inertia = diag(0.0002, 0.001, 0.001))]
    pub struct DrivenArm;
}

robot! {
    sprung = Sprung<T> { k: 40.0, slack: 0.3, c: 0.6, f: 0.25, s: 0.2, j: 0.02, n: 6.0, stiff: 900.0 }, [3], [Leg, Foot, Sole];
    /// Springs, dampers, friction and rotors that are fields, one of them at the second angle of a composed ankle.
    #[joint(hip: revolute([1, 0.3, 0]), world -> leg, stiffness = k, rest = slack, damping = c, rotor = j / (n * n), gear = n)]
    #[body(leg, mass = 1.9, com = [0.01, 0.02, -0.2], inertia = tensor(0.03, 0.001, 0.002, 0.031, 0.003, 0.004))]
    #[joint(knee: prismatic(z), leg -> foot, at = [0, 0, -0.4], stiffness = stiff, rest = 10mm, friction = f / 1m, friction_speed = s * 1m,
        armature = j / (5cm * 5cm))]
    #[body(foot, mass = 0.7, com = [0.03, 0, -0.1], inertia = diag(0.002, 0.002, 0.001))]
    #[joint(ankle: revolute(y), foot -> sole, at = [0, 0, -0.2], friction = f, friction_speed = s, stiffness = k / 4)]
    #[body(sole, mass = 0.3, com = [0.05, 0, -0.01], inertia = diag(0.0002, 0.0008, 0.0009))]
    pub struct Sprung<T> { pub k: T, pub slack: T, pub c: T, pub f: T, pub s: T, pub j: T, pub n: T, pub stiff: T }
}

robot! {
    cart_with_motor = CartWithMotor<T> { m_cart: 1.2, m: 0.15, l: 0.7 }, [2], [Cart, Pole];
    /// A pole on a cart, and a motor at the cart alone.
    #[joint(slider: prismatic(x), world -> cart)]
    #[body(cart, solid = point(m_cart))]
    #[joint(hinge: revolute(y), cart -> pole, actuated = off, damping = 0.001)]
    #[body(pole, com = [0, 0, l / 2], solid = rod(m, l))]
    pub struct CartWithMotor<T> { pub m_cart: T, pub m: T, pub l: T }
}

robot! {
    on_a_vehicle = OnAVehicle<T> { gx: 1.7, gy: -0.6, gz: -9.3, reach: 0.4 }, [2], [Boom, Stick];
    /// An arm whose base accelerates: gravity is other in each call.
    #[dynamics(gravity = [gx, gy, gz])]
    #[joint(slew: revolute(z), world -> boom, at = [0.3, 0, 1], rpy = [0, 0.05, 0])]
    #[body(boom, mass = 30, com = [0.2, 0.01, 0.1], inertia = diag(0.4, 1.2, 1.3))]
    #[joint(lift: revolute([0, 1, 0.1]), boom -> stick, at = [reach, 0, 0.2])]
    #[body(stick, mass = 11, com = [reach / 2, 0.02, 0], inertia = tensor(0.05, 0.01, 0, 0.4, 0.005, 0.41))]
    pub struct OnAVehicle<T> { pub gx: T, pub gy: T, pub gz: T, pub reach: T }
}
