//! Robots whose equations stand in textbooks, and those of the lecture.
#![allow(missing_docs, reason = "the fields are the symbols of the formulas they are tested against")]

use super::{Entry, robot};

/// All of them.
pub fn all() -> Vec<Entry> {
    vec![
        pendulum::entry(),
        cart_pole::entry(),
        acrobot::entry(),
        double_pendulum::entry(),
        planar_3r::entry(),
        planar_scara::entry(),
        spherical_arm::entry(),
        stanford_arm::entry(),
        robo_judge::entry(),
        point_mass::entry(),
        planar_body::entry(),
        tossed_box::entry(),
        any_toss::entry(),
    ]
}

robot! {
    pendulum = Pendulum<T> { m: 1.3, l: 0.7, g: 9.81 }, [1], [Bob];
    /// A point mass on a rod about x, hanging at zero.
    #[dynamics(gravity = [0, 0, -g])]
    #[joint(swing: revolute(x), world -> bob)]
    #[body(bob, solid = point(m), com = [0, 0, -l])]
    pub struct Pendulum<T> { pub m: T, pub l: T, pub g: T }
}

robot! {
    cart_pole = CartPole<T> { mc: 1.5, mp: 0.2, l: 0.6, j: 0.024, g: 9.81 }, [2], [Cart, Pole];
    /// A cart on x, and on it a pole that stands upright at zero; `l` leads to its centre, `j` is about it.
    #[dynamics(gravity = [0, 0, -g])]
    #[joint(slider: prismatic(x), world -> cart)]
    #[body(cart, solid = point(mc))]
    #[joint(hinge: continuous(y), cart -> pole)]
    #[body(pole, mass = mp, com = [0, 0, l], inertia = diag(j, j, j))]
    pub struct CartPole<T> { pub mc: T, pub mp: T, pub l: T, pub j: T, pub g: T }
}

robot! {
    acrobot = Acrobot<f64> { m1: 1.0, m2: 0.8, l1: 1.1, lc1: 0.5, lc2: 0.45, i1: 0.083, i2: 0.33 },
    [2], [Upper, Lower];
    /// Two links that hang in the xz plane at zero, as in R. Tedrake's *Underactuated Robotics*; `i1` and `i2` are
    /// about the joints there, and about the centres here.
    #[joint(shoulder: continuous(-y), world -> upper)]
    #[body(upper, mass = m1, com = [0, 0, -lc1], inertia = diag(i1, i1, i1))]
    #[joint(elbow: continuous(-y), upper -> lower, at = [0, 0, -l1])]
    #[body(lower, mass = m2, com = [0, 0, -lc2], inertia = diag(i2, i2, i2))]
    pub struct Acrobot {
        pub m1: f64, pub m2: f64, pub l1: f64, pub lc1: f64, pub lc2: f64, pub i1: f64, pub i2: f64,
    }
}

robot! {
    double_pendulum = DoublePendulum<T> { m1: 1.4, m2: 0.6, l1: 0.9, l2: 0.5, g: 9.81 }, [2], [First, Second];
    /// Two point masses on two rods; the second angle is relative to the first.
    #[dynamics(gravity = [0, 0, -g])]
    #[joint(upper: revolute(x), world -> first)]
    #[body(first, solid = point(m1), com = [0, 0, -l1])]
    #[joint(lower: revolute(x), first -> second, at = [0, 0, -l1])]
    #[body(second, solid = point(m2), com = [0, 0, -l2])]
    pub struct DoublePendulum<T> { pub m1: T, pub m2: T, pub l1: T, pub l2: T, pub g: T }
}

robot! {
    planar_3r = Planar3R<T> { m1: 3.0, m2: 2.0, m3: 1.0, l1: 0.5, l2: 0.4, l3: 0.3 }, [3],
    [Link1, Link2, Link3, Tip];
    /// Three homogeneous rods in the vertical xy plane, stretched along x at zero.
    #[dynamics(gravity = [0, -9.81, 0])]
    #[joint(joint1: revolute(z), world -> link1)]
    #[body(link1, solid = rod(m1, l1, x), com = [l1 / 2, 0, 0])]
    #[joint(joint2: revolute(z), link1 -> link2, at = [l1, 0, 0])]
    #[body(link2, solid = rod(m2, l2, x), com = [l2 / 2, 0, 0])]
    #[joint(joint3: revolute(z), link2 -> link3, at = [l2, 0, 0])]
    #[body(link3, solid = rod(m3, l3, x), com = [l3 / 2, 0, 0])]
    #[joint(end: fixed, link3 -> tip, at = [l3, 0, 0])]
    pub struct Planar3R<T> { pub m1: T, pub m2: T, pub m3: T, pub l1: T, pub l2: T, pub l3: T }
}

robot! {
    planar_scara = PlanarScara<f64> {
        m1: 4.0, m2: 3.0, m3: 1.5, m4: 0.5, l1: 0.4, l2: 0.3, r1: 0.2, r2: 0.15, i1: 0.06, i2: 0.04, i3: 0.01, i4: 0.002
    },
    [4], [Link1, Link2, Link3, Link4];
    /// The SCARA of Murray, Li and Sastry, example 4.4 (its `I_zi`, links at distances `r`): three turning joints, and
    /// one that slides along z.
    #[joint(theta1: revolute(z), world -> link1)]
    #[body(link1, mass = m1, com = [0, r1, 0], inertia = diag(i1, i1, i1))]
    #[joint(theta2: revolute(z), link1 -> link2, at = [0, l1, 0])]
    #[body(link2, mass = m2, com = [0, r2, 0], inertia = diag(i2, i2, i2))]
    #[joint(theta3: revolute(z), link2 -> link3, at = [0, l2, 0])]
    #[body(link3, mass = m3, inertia = diag(i3, i3, i3))]
    #[joint(theta4: prismatic(z), link3 -> link4)]
    #[body(link4, mass = m4, inertia = diag(i4, i4, i4))]
    pub struct PlanarScara {
        pub m1: f64, pub m2: f64, pub m3: f64, pub m4: f64, pub l1: f64, pub l2: f64, pub r1: f64, pub r2: f64,
        pub i1: f64, pub i2: f64, pub i3: f64, pub i4: f64,
    }
}

robot! {
    spherical_arm = SphericalArm<T> { m: 2.0, i1: 0.4, ix: 0.05, iy: 0.06, iz: 0.02, h: 0.4 }, [3],
    [Column, Yoke, Boom];
    /// The first three joints of a Stanford arm in spherical coordinates: azimuth, polar angle, distance.
    #[joint(azimuth: revolute(z), world -> column)]
    #[body(column, solid = cylinder(2 * i1 / (h * h), h, h))]
    #[joint(polar: revolute(y), column -> yoke, at = [0, 0, h])]
    #[body(yoke)]
    #[joint(reach: prismatic(z), yoke -> boom)]
    #[body(boom, mass = m, inertia = diag(ix, iy, iz))]
    pub struct SphericalArm<T> { pub m: T, pub i1: T, pub ix: T, pub iy: T, pub iz: T, pub h: T }
}

robot! {
    stanford_arm = StanfordArm<T> { d2: 0.154, d6: 0.263 }, [6],
    [Link1, Link2, Link3, Link4, Link5, Link6];
    /// The Stanford arm by Denavit and Hartenberg (R. Paul 1981), with masses of the real one's order.
    #[joint(joint1: revolute, world -> link1, dh(0, -90deg, 0.412, 0))]
    #[body(link1, mass = 9.29, com = [0, 17.5mm, -0.1105], inertia = diag(0.276, 0.255, 0.071))]
    #[joint(joint2: revolute, link1 -> link2, dh(0, 90deg, d2, 0))]
    #[body(link2, mass = 5.01, com = [0, -0.1054, 0], inertia = diag(0.108, 0.018, 0.1))]
    #[joint(joint3: prismatic, link2 -> link3, dh(0, 0, 0, 0))]
    #[body(link3, mass = 4.25, com = [0, 0, -0.6447], inertia = diag(2.51, 2.51, 0.006))]
    #[joint(joint4: revolute, link3 -> link4, dh(0, -90deg, 0, 0))]
    #[body(link4, mass = 1.08, com = [0, 9.2mm, -5.4mm], inertia = diag(0.002, 0.001, 0.001))]
    #[joint(joint5: revolute, link4 -> link5, dh(0, 90deg, 0, 0))]
    #[body(link5, mass = 0.63, com = [0, 0, 0.0566], inertia = diag(0.003, 0.003, 0.0004))]
    #[joint(joint6: revolute, link5 -> link6, dh(0, 0, d6, 0))]
    #[body(link6, mass = 0.51, com = [0, 0, 0.1554], inertia = tensor(0.013, 0.001, 0.0005, 0.013, -0.0002, 0.003))]
    pub struct StanfordArm<T> { pub d2: T, pub d6: T }
}

robot! {
    robo_judge = RoboJudge<T> {
        m1: 1.1, m2: 0.8, l1: 0.6, r0: 0.25, r1: 0.35, g: 9.81,
        ix1: 0.031, iy1: 0.032, iz1: 0.013, ix2: 0.021, iy2: 0.004, iz2: 0.022
    },
    [2], [Column, Arm];
    /// The two-link arm of the lecture: a turning column, and an arm that pitches on top of it.
    #[dynamics(gravity = [0, 0, -g])]
    #[joint(theta1: revolute(z), world -> column)]
    #[body(column, mass = m1, com = [0, 0, r0], inertia = diag(ix1, iy1, iz1))]
    #[joint(theta2: revolute(-x), column -> arm, at = [0, 0, l1])]
    #[body(arm, mass = m2, com = [0, r1, 0], inertia = diag(ix2, iy2, iz2))]
    pub struct RoboJudge<T> {
        pub m1: T, pub m2: T, pub l1: T, pub r0: T, pub r1: T, pub g: T,
        pub ix1: T, pub iy1: T, pub iz1: T, pub ix2: T, pub iy2: T, pub iz2: T,
    }
}

robot! {
    point_mass = PointMass<T> { m: 1.7, g: 9.81 }, [3], [AtX, AtXy, Point];
    /// A point mass that moves along x, y and z: problem 1 of the lecture.
    #[dynamics(gravity = [0, 0, -g])]
    #[joint(x: prismatic(x), world -> at_x)]
    #[body(at_x)]
    #[joint(y: prismatic(y), at_x -> at_xy)]
    #[body(at_xy)]
    #[joint(z: prismatic(z), at_xy -> point)]
    #[body(point, solid = point(m))]
    pub struct PointMass<T> { pub m: T, pub g: T }
}

robot! {
    planar_body = PlanarBody<T> { m: 2.1, i: 0.3 }, [3], [AtX, AtXy, Plate];
    /// A rigid body in the horizontal plane: problem 2 of the lecture.
    #[joint(x: prismatic(x), world -> at_x)]
    #[body(at_x)]
    #[joint(y: prismatic(y), at_x -> at_xy)]
    #[body(at_xy)]
    #[joint(theta: continuous(z), at_xy -> plate)]
    #[body(plate, mass = m, inertia = diag(i, i, i))]
    pub struct PlanarBody<T> { pub m: T, pub i: T }
}

robot! {
    tossed_box = TossedBox<T> { m: 1.5, l: 0.4, w: 0.3, h: 0.2, g: 9.81 }, [2], [Hand, Parcel];
    /// A box tossed straight up with a spin about one axis: problems 3, 4 and 6 of the lecture.
    #[dynamics(gravity = [0, 0, -g])]
    #[joint(r: prismatic(z), world -> hand)]
    #[body(hand)]
    #[joint(spin: continuous([1, 2, -0.5]), hand -> parcel)]
    #[body(parcel, solid = cuboid(m, [l, w, h]))]
    pub struct TossedBox<T> { pub m: T, pub l: T, pub w: T, pub h: T, pub g: T }
}

robot! {
    any_toss = AnyToss<T> { m: 1.5, l: 0.4, w: 0.3, h: 0.2, g: 9.81 }, [6],
    [AtX, AtXy, AtXyz, Yawed, Pitched, Parcel];
    /// A box tossed in any direction with any spin, problem 6 of the lecture: its position, and yaw, pitch, roll.
    #[dynamics(gravity = [0, 0, -g])]
    #[joint(x: prismatic(x), world -> at_x)]
    #[body(at_x)]
    #[joint(y: prismatic(y), at_x -> at_xy)]
    #[body(at_xy)]
    #[joint(z: prismatic(z), at_xy -> at_xyz)]
    #[body(at_xyz)]
    #[joint(yaw: continuous(z), at_xyz -> yawed)]
    #[body(yawed)]
    #[joint(pitch: continuous(y), yawed -> pitched)]
    #[body(pitched)]
    #[joint(roll: continuous(x), pitched -> parcel)]
    #[body(parcel, solid = cuboid(m, [l, w, h]))]
    pub struct AnyToss<T> { pub m: T, pub l: T, pub w: T, pub h: T, pub g: T }
}
