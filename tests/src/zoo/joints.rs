//! Robots of one kind of joint each: balls, free bodies, screws, followers, locks.
#![allow(missing_docs, reason = "the fields have no meaning beyond their robot")]

use super::{Entry, robot};

/// All of them.
pub fn all() -> Vec<Entry> {
    vec![
        free_box::entry(),
        spherical_pendulum::entry(),
        ball_in_chain::entry(),
        two_free_bodies::entry(),
        sleeve::entry(),
        cardan::entry(),
        puck::entry(),
        gantry::entry(),
        jack::entry(),
        gripper::entry(),
        locked::entry(),
    ]
}

robot! {
    free_box = FreeBox<T> { m: 1.5, l: 0.4, w: 0.3, h: 0.2, g: 9.81 }, [free], [Parcel];
    /// A box that nothing holds.
    #[dynamics(gravity = [0, 0, -g])]
    #[joint(flight: free, world -> parcel)]
    #[body(parcel, solid = cuboid(m, [l, w, h]))]
    pub struct FreeBox<T> { pub m: T, pub l: T, pub w: T, pub h: T, pub g: T }
}

robot! {
    spherical_pendulum = SphericalPendulum<T> { m: 2.3, l: 0.6, ixy: 0.004 }, [ball], [Bob];
    /// A skewed body that hangs in a socket beside its centre of mass.
    #[joint(socket: ball, world -> bob, at = [0.1, -0.2, 0.9], rpy = [0.3, -0.5, 0.2])]
    #[body(bob, mass = m, com = [0.04, -0.03, -l], inertia = tensor(0.03, ixy, -0.003, 0.05, 0.006, 0.02))]
    pub struct SphericalPendulum<T> { pub m: T, pub l: T, pub ixy: T }
}

robot! {
    ball_in_chain = BallInChain, [2, ball, 1], [Upper, Lower, Hand, Finger];
    /// A ball behind two oblique turns, with a slide on it.
    #[joint(shoulder: revolute([1, 2, -0.5]), world -> upper, at = [0.1, 0, 0.3], rpy = [0.4, -0.3, 0.9])]
    #[body(upper, mass = 1.8, com = [0.1, 0.02, -0.03], inertia = tensor(0.02, 0.003, -0.002, 0.03, 0.001, 0.025))]
    #[joint(elbow: revolute([0, 1, 1]), upper -> lower, at = [0.3, 0.02, 0.01], rpy = [1.2, 0.5, -2.1])]
    #[body(lower, mass = 1.2, com = [0.05, 0.08, 0.02], inertia = diag(0.012, 0.007, 0.013), inertia_rpy = [0.6, -0.8, 0.3])]
    #[joint(wrist: ball, lower -> hand, at = [0, 0.25, 0.05], rpy = [-0.7, 1.1, 0.2])]
    #[body(hand, mass = 0.7, com = [0.02, -0.01, 0.06], inertia = tensor(0.003, 0.0004, 0.0002, 0.004, -0.0003, 0.002))]
    #[joint(reach: prismatic([1, 0, 2]), hand -> finger, at = [0.01, 0.03, 0.1], rpy = [0.2, 0, 0.4])]
    #[body(finger, mass = 0.2, com = [0, 0.02, 0.05], inertia = diag(0.0004, 0.0005, 0.0002))]
    pub struct BallInChain;
}

robot! {
    two_free_bodies = TwoFreeBodies<T> { m: 3.2 }, [free, 1, free], [Bird, Wing, Egg];
    /// Two bodies that nothing holds, one of them driven and with a flap between their coordinates.
    #[joint(flight: free, world -> bird, actuated = on)]
    #[body(bird, mass = m, com = [0.05, 0.01, -0.02], inertia = tensor(0.05, 0.002, -0.004, 0.04, 0.001, 0.06))]
    #[joint(flap: revolute([1, 0.2, 0]), bird -> wing, at = [0, 0.1, 0.03], rpy = [0, 0.1, 0])]
    #[body(wing, solid = cuboid(400g, [0.1, 0.3, 1cm]), com = [0, 0.15, 0])]
    #[joint(fall: free, world -> egg, at = [0.5, 0, -0.2], rpy = [0.3, 0.4, -0.1])]
    #[body(egg, mass = 0.06, com = [0, 0, 4mm], inertia = diag(0.00003, 0.00003, 0.00002))]
    pub struct TwoFreeBodies<T> { pub m: T }
}

robot! {
    sleeve = Sleeve, [4], [Mast, Collar, Boom];
    /// A collar that turns and slides on an oblique axis, between two hinges.
    #[joint(pan: revolute(z), world -> mast, rpy = [0.1, 0.2, 0])]
    #[body(mast, mass = 4, com = [0.01, 0.02, 0.3], inertia = tensor(0.2, 0.002, 0.001, 0.21, -0.003, 0.03))]
    #[joint(sleeve: cylindrical([0, 1, 2]), mast -> collar, at = [0.05, 0, 0.4], rpy = [0.2, 0, 0.5])]
    #[body(collar, mass = 1.1, com = [0.03, -0.01, 0.02], inertia = diag(0.004, 0.005, 0.006))]
    #[joint(tilt: revolute(x), collar -> boom, at = [0.1, 0.02, 0])]
    #[body(boom, solid = rod(0.9, 0.5, y), com = [0.02, 0.25, 0])]
    pub struct Sleeve;
}

robot! {
    cardan = Cardan<T> { l: 0.35, m: 0.9 }, [4], [Shaft, Fork, Tool];
    /// A cardan joint of oblique axes, between a turning shaft and a slide.
    #[joint(drive: continuous(x), world -> shaft, at = [0, 0, 0.5])]
    #[body(shaft, solid = cylinder(2kg, 3cm, l, x), com = [l / 2, 0, 0])]
    #[joint(cross: universal([0, 1, 0.3], z), shaft -> fork, at = [l, 0, 0], rpy = [0.2, 0, 0])]
    #[body(fork, mass = m, com = [l / 3, 0.02, 0.01], inertia = tensor(0.002, 0.0003, 0, 0.01, 0.0002, 0.011))]
    #[joint(stroke: prismatic(x), fork -> tool, at = [l, 0, 0], rpy = [0, 0.3, 0])]
    #[body(tool, mass = m / 2, com = [0.05, 0, 0.01], inertia = diag(0.0005, 0.0008, 0.0009))]
    pub struct Cardan<T> { pub l: T, pub m: T }
}

robot! {
    puck = Puck<T> { m: 1.4, lean: 0.3, g: 9.81 }, [5], [Table, Disc, Rod];
    /// A puck on a table that tips, with a rod on it.
    #[dynamics(gravity = [0, g * sin(lean), -g * cos(lean)])]
    #[joint(tip: revolute(y), world -> table, rpy = [0.1, 0, 0.3])]
    #[body(table, mass = 12, com = [0.1, 0, -0.05], inertia = diag(0.8, 0.9, 1.5))]
    #[joint(glide: planar([0.2, -0.1, 1]), table -> disc, at = [0.2, 0.1, 0.03], rpy = [0, 0, 0.7])]
    #[body(disc, mass = m, com = [0.02, 0.01, 0.03], inertia = tensor(0.004, 0.0005, 0, 0.005, 0.0003, 0.008))]
    #[joint(hinge: revolute(-x), disc -> rod, at = [0, 0, 0.06])]
    #[body(rod, solid = rod(m / 3, 0.3), com = [0, 0, 0.15])]
    pub struct Puck<T> { pub m: T, pub lean: T, pub g: T }
}

robot! {
    gantry = Gantry, [3, ball], [Trolley, Load];
    /// A load that swings freely below a trolley with three slides.
    #[joint(drive: translation, world -> trolley, at = [0, 0, 3], rpy = [0, 0.1, 0.4])]
    #[body(trolley, mass = 8, com = [0.02, 0.01, 0.05], inertia = diag(0.1, 0.12, 0.2))]
    #[joint(swing: ball, trolley -> load, at = [0, 0.05, -0.1])]
    #[body(load, mass = 2.5, com = [0.02, 0, -0.7], inertia = tensor(0.03, 0.001, 0, 0.04, 0.002, 0.02))]
    pub struct Gantry;
}

robot! {
    jack = Jack<T> { lead: 0.06, m: 1.7 }, [3], [Post, Nut, Arm];
    /// A nut that climbs as it turns, between two hinges.
    #[joint(pan: revolute([0.1, 0, 1]), world -> post)]
    #[body(post, mass = 5, com = [0, 0.02, 0.4], inertia = diag(0.3, 0.31, 0.02))]
    #[joint(screw: helical([0, 0.1, 1], lead / (2 * pi)), post -> nut, at = [0.02, 0, 0.2], rpy = [0.2, -0.1, 0])]
    #[body(nut, mass = m, com = [0.05, 0.02, 0.01], inertia = tensor(0.006, 0.0004, 0.0002, 0.007, 0.0005, 0.009))]
    #[joint(swing: revolute(y), nut -> arm, at = [0.1, 0, 0.05])]
    #[body(arm, mass = 0.6, com = [0.15, 0.01, -0.02], inertia = diag(0.001, 0.006, 0.006))]
    pub struct Jack<T> { pub lead: T, pub m: T }
}

robot! {
    gripper = Gripper<T> { m: 0.15, l: 0.08, pinion: 0.02, k: 0.4 }, [3], [Palm, Left, LeftTip, Right, RightTip, Rack, Tail];
    /// Two fingers of two links, and a rack, that all follow one knuckle: backwards, twice as fast, through an offset.
    #[joint(roll: revolute(x), world -> palm, at = [0, 0, 0.4], rpy = [0.3, 0.2, 0.1])]
    #[body(palm, mass = 0.8, com = [0.04, 0.01, 0], inertia = diag(0.0006, 0.0009, 0.001))]
    #[joint(knuckle: revolute(z), palm -> left, at = [l, 0.03, 0], armature = 1e-4, damping = 0.02)]
    #[body(left, mass = m, com = [l / 2, 0, 0.005], inertia = diag(0.00001, 0.00008, 0.00008))]
    #[joint(left_bend: revolute(z), left -> left_tip, at = [l, 0, 0], mimic = right_bend, ratio = -1)]
    #[body(left_tip, solid = cuboid(m / 2, [l, 1cm, 2cm]), com = [l / 2, 0, 0])]
    #[joint(right_knuckle: revolute(z), palm -> right, at = [l, -0.03, 0], mimic = knuckle, ratio = -1, offset = 0.2)]
    #[body(right, mass = m, com = [l / 2, 0, -0.005], inertia = diag(0.00001, 0.00008, 0.00008))]
    #[joint(right_bend: revolute([0, 0.1, 1]), right -> right_tip, at = [l, 0, 0], mimic = knuckle, ratio = 2, offset = 5deg,
        stiffness = k, rest = 0.3, friction = 0.01, friction_speed = 0.5)]
    #[body(right_tip, solid = cuboid(m / 2, [l, 1cm, 2cm]), com = [l / 2, 0, 0])]
    #[joint(push: prismatic(x), palm -> rack, at = [-2cm, 0, 0.01], mimic = knuckle, ratio = pinion, offset = 1cm, damping = 3)]
    #[body(rack, mass = 0.2, com = [0.03, 0, 0], inertia = diag(0.00001, 0.00005, 0.00005))]
    #[joint(wag: revolute(y), rack -> tail, at = [-3cm, 0, 0])]
    #[body(tail, solid = rod(30g, 10cm), com = [0, 0, -5cm])]
    pub struct Gripper<T> { pub m: T, pub l: T, pub pinion: T, pub k: T }
}

robot! {
    locked = Locked<T> { bend: 0.4, m: 1.3 }, [2], [Hip, Thigh, Shin, Lid, Toe];
    /// A knee that is locked, a lid that would follow it, and joints that still move before and behind.
    #[joint(hip: revolute([0, 1, 0.1]), world -> hip, rpy = [0.1, 0, 0.2])]
    #[body(hip, mass = 2, com = [0.02, 0.03, 0.01], inertia = tensor(0.01, 0.001, 0, 0.012, 0.0005, 0.009))]
    #[joint(slide: prismatic(z), hip -> thigh, at = [0, 0, -0.1], locked = 12cm)]
    #[body(thigh, solid = rod(m, 0.4), com = [0, 0, -0.2])]
    #[joint(knee: revolute(y), thigh -> shin, at = [0, 0, -0.4], locked = bend, damping = 2)]
    #[body(shin, mass = m, com = [0.01, 0, -0.15], inertia = diag(0.01, 0.011, 0.002))]
    #[joint(cover: revolute(x), thigh -> lid, at = [0, 0.05, -0.4], mimic = knee, ratio = 0.5, offset = 0.1)]
    #[body(lid, mass = 0.2, com = [0, 0.02, 0.01], inertia = diag(0.0002, 0.0001, 0.0002))]
    #[joint(ankle: revolute(-y), shin -> toe, at = [0, 0, -0.35])]
    #[body(toe, mass = 0.5, com = [0.06, 0, -0.02], inertia = diag(0.0004, 0.001, 0.001))]
    pub struct Locked<T> { pub bend: T, pub m: T }
}
