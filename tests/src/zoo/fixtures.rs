//! Robots that no one builds: skewed frames, oblique axes, branches, welds, and every form of a specification.
#![allow(missing_docs, reason = "the fields have no meaning beyond their robot")]

use super::{Entry, robot};

/// All of them.
pub fn all() -> Vec<Entry> {
    vec![
        lift::entry(),
        single_precision::entry(),
        named_badly::entry(),
        two_on_one_world::entry(),
        welded::entry(),
        screws::entry(),
        distal::entry(),
        proximal::entry(),
        skewed::entry(),
        unsnapped::entry(),
        torso::entry(),
        tree_of_nine::entry(),
        snake::entry(),
    ]
}

robot! {
    lift = Lift<f64> { payload: 12.5 }, [1], [Cabin];
    /// One joint that slides along an oblique axis.
    #[joint(rail: prismatic([3, 0, 4]), world -> cabin, limits = [-10cm, 3m], velocity = 1.5, effort = 2000N)]
    #[body(cabin, mass = payload + 800kg, com = [0.1, 20mm, 0.7], inertia = diag(300, 310, 120))]
    pub struct Lift { pub payload: f64 }
}

robot! {
    single_precision = SinglePrecision<f32> { m: 0.75, l: 0.25, r: 0.125 }, [3], [Upper, Lower, Finger];
    /// Fields of `f32`, as on a microcontroller. The values are exact in single precision.
    #[joint(yaw: revolute(z), world -> upper)]
    #[body(upper, mass = m, com = [0, 0, l / 2], inertia = diag(m * l * l / 12, m * l * l / 12, m * r * r / 2))]
    #[joint(pitch: revolute([0, 1, 0.25]), upper -> lower, at = [r, 0, l], rpy = [0.25, 0, 0.5])]
    #[body(lower, solid = cylinder(m, r, l, x), com = [l / 2, 0, r])]
    #[joint(grip: prismatic(-x), lower -> finger, at = [l, 0, 0])]
    #[body(finger, solid = sphere(m / 4, r))]
    pub struct SinglePrecision { pub m: f32, pub l: f32, pub r: f32 }
}

robot! {
    named_badly = NamedBadly<T> {
        m00: 1.0, s0: 0.3, q0: 0.4, k0: 0.31, k1: 0.3, tau: 0.25, c0: 0.1, e0: 0.2, v0: 0.15, m: 0.7, r: 0.05, robot: 0.12,
        a: 0.04, q: 0.05, v: 0.06, g: 9.0
    },
    [2], [PoseFrame, StateFrame];
    /// Fields, joints and bodies with the names that generated code would like to use itself.
    #[dynamics(gravity = [0, -g, 0])]
    #[joint(q: revolute(x), world -> pose)]
    #[body(pose, mass = m00, com = [0, s0, -q0], inertia = diag(k0, k1, tau))]
    #[joint(v: prismatic(y), pose -> state, at = [c0, e0, v0])]
    #[body(state, mass = m, com = [r, robot, 0.1], inertia = diag(a, q, v))]
    pub struct NamedBadly<T> {
        pub m00: T, pub s0: T, pub q0: T, pub k0: T, pub k1: T, pub tau: T, pub c0: T, pub e0: T, pub v0: T, pub m: T,
        pub r: T, pub robot: T, pub a: T, pub q: T, pub v: T, pub g: T,
    }
}

robot! {
    two_on_one_world = TwoOnOneWorld, [3], [Left, Right, RightHand];
    /// Two arms that have nothing in common but the world: M falls into blocks.
    #[dynamics(gravity = [1.5, -2, -9.6])]
    #[joint(left_joint: revolute(y), world -> left, at = [0, 0.4, 0], rpy = [0.3, -0.2, 1.1])]
    #[body(left, mass = 2, com = [0.1, 0.2, -0.3], inertia = tensor(0.05, 0.01, -0.004, 0.06, 0.008, 0.07))]
    #[joint(right_joint: revolute([1, 1, 1]), world -> right, at = [0, -0.4, 0])]
    #[body(right, mass = 1, com = [0, 0.1, 0.2], inertia = [[0.03, 0.002, 0], [0.002, 0.03, -0.001], [0, -0.001, 0.02]])]
    #[joint(slide: prismatic(x), right -> right_hand, at = [0.2, 0, 0.1], rpy = [0, 0.7, 0])]
    #[body(right_hand, mass = 0.5, inertia = diag(0.001, 0.002, 0.0015), inertia_rpy = [0.4, 0.5, -0.6])]
    pub struct TwoOnOneWorld;
}

robot! {
    welded = Welded<T> { tool: 0.6, reach: 0.15 }, [3],
    [Foot, Turret, Motor, Beam, Bare, Wrist, Gripper, Camera];
    /// Welds with masses on the world and on links, welds on welds, and massless bodies that turn in between.
    #[joint(bolted: fixed, world -> foot, at = [0.2, 0.1, 0.3], rpy = [0.1, 0.2, 0.3])]
    #[body(foot, mass = 20, com = [0.05, 0, 0.1], inertia = diag(0.5, 0.6, 0.4))]
    #[joint(pan: revolute(-z), foot -> turret, at = [0, 0, 0.4])]
    #[body(turret, mass = 4, com = [0.01, 0.02, 0.1], inertia = tensor(0.02, 0.001, 0.002, 0.03, -0.001, 0.025))]
    #[joint(screwed: fixed, turret -> motor, at = [0.1, 0.05, 0.2], rpy = [0.5, -0.4, 0.3])]
    #[body(motor, mass = 1.2, com = [0, 0.01, 0.05], inertia = diag(0.002, 0.0021, 0.001), inertia_rpy = [0.2, 0, 0.9])]
    #[joint(glued: fixed, motor -> beam, rpy = [0, 90deg, 0])]
    #[body(beam, solid = rod(0.8, 0.6), com = [0, 0, 0.3])]
    #[joint(tilt: revolute([0, 1, 0.2]), beam -> bare, at = [0, 0, 0.6], rpy = [-0.3, 0, 0.2])]
    #[body(bare)]
    #[joint(twist: revolute([1, 0, 0.5]), bare -> wrist, at = [0.05, 0, 0], rpy = [0, 0.4, 0])]
    #[body(wrist)]
    #[joint(held: fixed, wrist -> gripper, at = [reach, 0, 0.02], rpy = [0.7, 0.1, -0.2])]
    #[body(gripper, mass = tool, com = [0.03, 0.01, -0.02], inertia = diag(0.001, 0.0012, 0.0009))]
    #[joint(mounted: fixed, gripper -> camera, at = [0, 0.05, 0.03])]
    #[body(camera, solid = cuboid(150g, [3cm, 50mm, 0.04]), inertia_rpy = [0, 30deg, 0])]
    pub struct Welded<T> { pub tool: T, pub reach: T }
}

robot! {
    screws = Screws, [4], [Base, Slide, Arm, Hand];
    /// Joints as lines in space, one of them prismatic in the middle.
    #[joint(turn: revolute, world -> base, screw([0.2, -0.1, 1], [0.1, 0.05, 0]))]
    #[body(base, mass = 3, com = [0.1, 0, 0.2], inertia = tensor(0.06, 0.003, 0.01, 0.05, -0.004, 0.04))]
    #[joint(push: prismatic, base -> slide, screw([1, 2, -0.5], through = [0, 0, 0]), at = [0.1, 0, 0.3],
        rpy = [0.2, 0.1, -0.4])]
    #[body(slide, solid = sphere(1.5, 80mm), com = [0.02, 0.03, 0])]
    #[joint(swing: revolute, slide -> arm, screw(-y, [0, 0, 0.25]), at = [0.3, 0, 0])]
    #[body(arm, mass = 1.1, com = [0.15, -0.02, 0.01], inertia = diag(0.004, 0.02, 0.021), inertia_rpy = [0.1, 0.7, 0.2])]
    #[joint(spin: continuous, arm -> hand, screw(x, [0, 0.04, 0.02]), at = [0.3, 0.04, 0.02])]
    #[body(hand, solid = cylinder(0.4, 3cm, 12cm, y), com = [0.06, 0, 0.01])]
    pub struct Screws;
}

robot! {
    distal = Distal<f64> { a1: 0.35, d2: 0.12, m: 2.4, g: 9.81, lean: 0.3, alpha2: -1.2 }, [4],
    [First, Second, Third, Fourth, Plate];
    /// Denavit and Hartenberg's distal frames, with fields for lengths and angles; the third joint slides.
    #[dynamics(gravity = [0, g * sin(lean), -g * cos(lean)])]
    #[joint(j1: revolute, world -> first, dh(a1, 0.4, 0.2, 0.3))]
    #[body(first, mass = m, com = [-a1 / 2, 0.01, 0.02], inertia = tensor(0.02, 0.002, 0.001, 0.05, -0.003, 0.05))]
    #[joint(j2: revolute, first -> second, dh(0.1, alpha2, d2, -0.7))]
    #[body(second, mass = m * 0.6, com = [0, d2, -0.05], inertia = diag(0.01, 0.02, 0.015), inertia_rpy = [0.3, 0.2, 0.1])]
    #[joint(j3: prismatic, second -> third, dh(0.05, 45deg, 0.3, 0.2))]
    #[body(third, mass = 1.3, com = [0.01, 0.02, -0.1], inertia = diag(0.01, 0.011, 0.004))]
    #[joint(j4: revolute, third -> fourth, dh(0, -90deg, d2 / 2, 0))]
    #[body(fourth, mass = 0.7, com = [0.03, 0, 0.04], inertia = diag(0.002, 0.003, 0.0025))]
    #[joint(flange: fixed, fourth -> plate, dh(0.02, 0.1, 0.07, 0.5))]
    pub struct Distal { pub a1: f64, pub d2: f64, pub m: f64, pub g: f64, pub lean: f64, pub alpha2: f64 }
}

robot! {
    proximal = Proximal<T> { a: 0.25, d: 0.1, offset: 0.35, alpha: 0.8, m: 1.9 }, [4], [L1, L2, L3, L4];
    /// Modified Denavit–Hartenberg parameters, with fields for lengths, angles and an offset.
    #[joint(j1: revolute, world -> l1, mdh(0, 0, d * 4, 0))]
    #[body(l1, mass = m, com = [0.02, d, 0.03], inertia = diag(0.02, 0.03, 0.025))]
    #[joint(j2: revolute, l1 -> l2, mdh(a, alpha, 0.05, offset))]
    #[body(l2, mass = m / 2, com = [a / 2, 0, -d / 3], inertia = tensor(0.01, 0.001, 0.0005, 0.02, -0.0007, 0.018))]
    #[joint(j3: prismatic, l2 -> l3, mdh(a - d, -alpha + 10deg, 0.2, 0.1))]
    #[body(l3, mass = 0.8, com = [0.01, -0.02, 0.05], inertia = diag(0.004, 0.005, 0.003), inertia_rpy = [0, alpha, 0])]
    #[joint(j4: continuous, l3 -> l4, mdh(0, 90deg, -(d + 2cm), -offset / 2))]
    #[body(l4, mass = sqrt(m * m + 0.5kg * 0.5kg) / 4, com = [0.04, 0.01, 0.02], inertia = diag(0.001, 0.0012, 0.0011))]
    pub struct Proximal<T> { pub a: T, pub d: T, pub offset: T, pub alpha: T, pub m: T }
}

robot! {
    skewed = Skewed, [5], [A, B, C, D, E, Tip];
    /// A chain in which nothing is aligned with anything, prismatic in the middle.
    #[joint(ja: revolute([1, 2, -0.5]), world -> a, at = [0.1, -0.2, 0.3], rpy = [0.4, -0.3, 0.9])]
    #[body(a, mass = 2.2, com = [0.05, -0.1, 0.15], inertia = tensor(0.05, 0.008, -0.006, 0.06, 0.004, 0.04))]
    #[joint(jb: revolute([0, 1, 0]), a -> b, at = [0.2, 0.1, 0.05], rpy = [1.2, 0.5, -2.1])]
    #[body(b, mass = 1.6, com = [0.1, 0.02, -0.03],
        inertia = [[0.03, 0.002, -0.001], [0.002, 0.025, 0.003], [-0.001, 0.003, 0.035]], inertia_rpy = [0.6, -0.8, 0.3])]
    #[joint(jc: prismatic([-1, 0.3, 0.2]), b -> c, at = [0, 0.15, 0.1], rpy = [-0.7, 1.1, 0.2])]
    #[body(c, mass = 1.1, com = [-0.02, 0.06, 0.01], inertia = diag(0.012, 0.015, 0.009), inertia_rpy = [1, 2, 3])]
    #[joint(jd: continuous([0.5, -0.5, 0.7]), c -> d, at = [-0.1, 0.05, 0.2], rpy = [2.5, -0.2, 1.7])]
    #[body(d, mass = 0.9, com = [0.03, 0.07, 0.02], inertia = tensor(0.01, -0.001, 0.0005, 0.008, 0.0007, 0.009))]
    #[joint(je: revolute(-x), d -> e, at = [0.12, 0, -0.08], rpy = [0, 0, 0.25])]
    #[body(e, mass = 0.5, com = [0.06, -0.01, 0.03], inertia = diag(0.002, 0.0025, 0.003), inertia_rpy = [-0.4, 0, 0.8])]
    #[joint(at_end: fixed, e -> tip, at = [0.1, 0.02, 0.01], rpy = [0.1, 0.2, 0.3])]
    pub struct Skewed;
}

robot! {
    unsnapped = Unsnapped, [3], [Link1, Link2, Link3];
    /// Right angles written in eleven digits, and taken at their word.
    #[dynamics(snap = off)]
    #[joint(joint1: revolute(z), world -> link1, at = [0, 0, 0.3], rpy = [1.57079632679, 0, 0])]
    #[body(link1, mass = 2, com = [0.01, 0.1, 0.02], inertia = diag(0.02, 0.01, 0.02))]
    #[joint(joint2: revolute(z), link1 -> link2, at = [0, 0.25, 0], rpy = [0, 1.5708, 0])]
    #[body(link2, mass = 1.4, com = [0.12, 0, 0.01], inertia = diag(0.004, 0.015, 0.016))]
    #[joint(joint3: revolute(y), link2 -> link3, at = [0.24, 0, 0], rpy = [0, 0, -3.14159265359])]
    #[body(link3, mass = 0.6, com = [0, 0.05, 0.06], inertia = tensor(0.003, 0.0002, 0, 0.002, 0.0001, 0.0025))]
    pub struct Unsnapped;
}

robot! {
    torso = Torso<T> { hip: 0.5, upper: 0.3, lower: 0.25, m: 1.2 }, [8],
    [Trunk, Head, LeftUpper, LeftLower, LeftHand, RightUpper, RightLower, RightHand];
    /// A turning trunk with a head and two arms of unequal build, their lengths and masses fields.
    #[joint(waist: revolute(z), world -> trunk)]
    #[body(trunk, solid = cuboid(20 * m, [0.2, 0.3, hip]), com = [0, 0, hip / 2])]
    #[joint(neck: revolute(y), trunk -> head, at = [0, 0, hip], rpy = [0, 0.2, 0])]
    #[body(head, solid = sphere(3.5, 11cm), com = [0.02, 0, 0.12])]
    #[joint(left_shoulder: revolute([0, 1, 0.3]), trunk -> left_upper, at = [0, 0.2, hip - 5cm], rpy = [0.2, 0, 0])]
    #[body(left_upper, solid = rod(m, upper), com = [0, 0, -upper / 2])]
    #[joint(left_elbow: revolute(y), left_upper -> left_lower, at = [0, 0, -upper])]
    #[body(left_lower, mass = m * 0.8, com = [0.01, 0, -lower / 2],
        inertia = diag(m * lower * lower / 12, m * lower * lower / 12, 0.001))]
    #[joint(left_grip: prismatic(z), left_lower -> left_hand, at = [0, 0, -lower], rpy = [0.3, 0.2, 0])]
    #[body(left_hand, solid = point(m / 4), com = [0.01, 0, -0.04])]
    #[joint(right_shoulder: revolute([0, -1, 0.3]), trunk -> right_upper, at = [0, -0.2, hip - 5cm], rpy = [-0.2, 0, 0])]
    #[body(right_upper, solid = cylinder(m, 4cm, upper), com = [0, 0, -upper / 2])]
    #[joint(right_elbow: revolute(-y), right_upper -> right_lower, at = [0, 0, -upper])]
    #[body(right_lower, mass = m, com = [0, 0.02, -lower / 3], inertia = tensor(0.01, 0.001, 0, 0.011, 0.0005, 0.002))]
    #[joint(right_wrist: continuous(z), right_lower -> right_hand, at = [0, 0, -lower])]
    #[body(right_hand, mass = m / 3, com = [0.03, 0.02, -0.05], inertia = diag(0.0006, 0.0007, 0.0004))]
    pub struct Torso<T> { pub hip: T, pub upper: T, pub lower: T, pub m: T }
}

robot! {
    tree_of_nine = TreeOfNine, [9], [Trunk, A1, A2, A3, B1, B2, C1, C2, C3];
    /// A prismatic trunk and three arms of different lengths, one of them on another.
    #[joint(trunk_up: prismatic(z), world -> trunk, rpy = [0.05, -0.1, 0])]
    #[body(trunk, mass = 8, com = [0.02, 0.01, 0.3], inertia = tensor(0.4, 0.01, 0.02, 0.5, -0.01, 0.3))]
    #[joint(a_1: revolute(x), trunk -> a1, at = [0.1, 0.2, 0.5], rpy = [0, 0.4, 0.1])]
    #[body(a1, mass = 1.5, com = [0, 0.02, -0.15], inertia = diag(0.02, 0.02, 0.004), inertia_rpy = [0.1, 0, 0])]
    #[joint(a_2: revolute([0, 2, 1]), a1 -> a2, at = [0, 0, -0.3], rpy = [0.2, 0, -0.3])]
    #[body(a2, mass = 1.1, com = [0.02, 0, -0.12], inertia = diag(0.012, 0.013, 0.003))]
    #[joint(a_3: prismatic(-z), a2 -> a3, at = [0, 0.01, -0.25])]
    #[body(a3, mass = 0.4, com = [0.01, 0.01, -0.03], inertia = diag(0.001, 0.0011, 0.0004))]
    #[joint(b_1: revolute(y), trunk -> b1, at = [0.1, -0.2, 0.5], rpy = [-0.3, 0, 0.6])]
    #[body(b1, mass = 1.4, com = [0.01, -0.03, -0.14], inertia = tensor(0.02, 0.0005, 0.001, 0.021, 0.002, 0.005))]
    #[joint(b_2: continuous(z), b1 -> b2, at = [0.02, 0, -0.28])]
    #[body(b2, mass = 0.9, com = [0.05, 0, -0.1], inertia = diag(0.008, 0.009, 0.002))]
    #[joint(c_1: revolute([1, 0, 1]), a1 -> c1, at = [0.05, 0, -0.1], rpy = [1, 0.3, 0])]
    #[body(c1, mass = 0.7, com = [0, 0.08, 0.01], inertia = diag(0.004, 0.001, 0.004))]
    #[joint(c_2: revolute(x), c1 -> c2, at = [0, 0.16, 0])]
    #[body(c2, mass = 0.5, com = [0.01, 0.06, 0], inertia = diag(0.002, 0.0005, 0.002), inertia_rpy = [0, 0, 0.5])]
    #[joint(c_3: revolute(z), c2 -> c3, at = [0, 0.12, 0.01], rpy = [0.1, 0.1, 0.1])]
    #[body(c3, mass = 0.3, com = [0.02, 0.03, 0.01], inertia = diag(0.0006, 0.0003, 0.0006))]
    pub struct TreeOfNine;
}

robot! {
    snake = Snake<T> { l: 0.2, m: 0.9, tail: 0.3 }, [11], [S1, S2, S3, S4, S5, S6, S7, S8, S9, S10, S11];
    /// One long chain, where other methods become the cheapest: a slide, a massless link, and fields on the way.
    #[joint(j1: revolute(z), world -> s1)]
    #[body(s1, mass = m, com = [l / 2, 0.01, 0], inertia = diag(0.001, 0.003, 0.0035))]
    #[joint(j2: revolute(y), s1 -> s2, at = [l, 0, 0])]
    #[body(s2, mass = m, com = [l / 2, 0, 0.02], inertia = tensor(0.001, 0.0002, 0, 0.003, 0.0001, 0.003))]
    #[joint(j3: revolute([1, 0, 0.5]), s2 -> s3, at = [l, 0, 0], rpy = [0, 0.3, 0])]
    #[body(s3, mass = 0.8, com = [0.1, 0, 0], inertia = diag(0.001, 0.002, 0.002), inertia_rpy = [0.1, 0.4, 0])]
    #[joint(j4: revolute(z), s3 -> s4, at = [l, 0.01, 0])]
    #[body(s4)]
    #[joint(j5: revolute(x), s4 -> s5)]
    #[body(s5, solid = cylinder(0.7, 4cm, l, x), com = [l / 2, 0, 0.01])]
    #[joint(j6: prismatic(x), s5 -> s6, at = [l, 0, 0], rpy = [0.2, 0, 0])]
    #[body(s6, mass = 0.6, com = [0.05, 0.02, 0], inertia = diag(0.0008, 0.001, 0.0012))]
    #[joint(j7: revolute(-z), s6 -> s7, at = [0.1, 0, 0])]
    #[body(s7, solid = cuboid(0.6, [l, 5cm, 3cm]), com = [l / 2, 0, 0])]
    #[joint(j8: revolute(y), s7 -> s8, at = [l, 0, 0], rpy = [90deg, 0, 0])]
    #[body(s8, mass = 0.5, com = [0.08, 0.01, 0.01], inertia = diag(0.0007, 0.001, 0.0011))]
    #[joint(j9: continuous(x), s8 -> s9, at = [0.15, 0, 0])]
    #[body(s9, mass = 0.5, com = [0.05, 0.03, 0], inertia = tensor(0.001, 0.0001, 0, 0.001, 0, 0.0011))]
    #[joint(j10: revolute(z), s9 -> s10, at = [0.12, 0, 0], rpy = [0, -0.4, 0.1])]
    #[body(s10, mass = 0.4, com = [0.06, 0, 0.01], inertia = diag(0.0004, 0.0008, 0.0008))]
    #[joint(j11: revolute([0, 1, 1]), s10 -> s11, at = [0.12, 0, 0.01])]
    #[body(s11, mass = tail, com = [0.08, -0.01, 0.02], inertia = diag(tail * l * l / 12, 0.001, 0.0011))]
    pub struct Snake<T> { pub l: T, pub m: T, pub tail: T }
}
