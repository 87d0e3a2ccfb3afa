//! The robots that are written: those of textbooks and of the lecture, and some whose equations are no textbook's.

/// Their names, and their structs as users write them.
pub(crate) const ROBOTS: &[(&str, &str)] = &[
    (
        "pendulum",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(swing: revolute(x), world -> bob)]
#[body(bob, solid = point(m), com = [0, 0, -l])]
pub struct Pendulum<T> { pub m: T, pub l: T, pub g: T }"#,
    ),
    (
        "cart_pole",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(slider: prismatic(x), world -> cart)]
#[body(cart, solid = point(mc))]
#[joint(hinge: continuous(y), cart -> pole)]
#[body(pole, mass = mp, com = [0, 0, l], inertia = diag(j, j, j))]
pub struct CartPole<T> { pub mc: T, pub mp: T, pub l: T, pub j: T, pub g: T }"#,
    ),
    (
        "acrobot",
        r#"#[joint(shoulder: continuous(-y), world -> upper)]
#[body(upper, mass = m1, com = [0, 0, -lc1], inertia = diag(i1, i1, i1))]
#[joint(elbow: continuous(-y), upper -> lower, at = [0, 0, -l1])]
#[body(lower, mass = m2, com = [0, 0, -lc2], inertia = diag(i2, i2, i2))]
pub struct Acrobot {
    pub m1: f64, pub m2: f64, pub l1: f64, pub lc1: f64, pub lc2: f64, pub i1: f64, pub i2: f64,
}"#,
    ),
    (
        "double_pendulum",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(upper: revolute(x), world -> first)]
#[body(first, solid = point(m1), com = [0, 0, -l1])]
#[joint(lower: revolute(x), first -> second, at = [0, 0, -l1])]
#[body(second, solid = point(m2), com = [0, 0, -l2])]
pub struct DoublePendulum<T> { pub m1: T, pub m2: T, pub l1: T, pub l2: T, pub g: T }"#,
    ),
    (
        "planar_3r",
        r#"#[dynamics(gravity = [0, -9.81, 0])]
#[joint(joint1: revolute(z), world -> link1)]
#[body(link1, solid = rod(m1, l1, x), com = [l1 / 2, 0, 0])]
#[joint(joint2: revolute(z), link1 -> link2, at = [l1, 0, 0])]
#[body(link2, solid = rod(m2, l2, x), com = [l2 / 2, 0, 0])]
#[joint(joint3: revolute(z), link2 -> link3, at = [l2, 0, 0])]
#[body(link3, solid = rod(m3, l3, x), com = [l3 / 2, 0, 0])]
#[joint(end: fixed, link3 -> tip, at = [l3, 0, 0])]
pub struct Planar3R<T> { pub m1: T, pub m2: T, pub m3: T, pub l1: T, pub l2: T, pub l3: T }"#,
    ),
    (
        "planar_scara",
        r#"#[joint(theta1: revolute(z), world -> link1)]
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
}"#,
    ),
    (
        "spherical_arm",
        r#"#[joint(azimuth: revolute(z), world -> column)]
#[body(column, solid = cylinder(2 * i1 / (h * h), h, h))]
#[joint(polar: revolute(y), column -> yoke, at = [0, 0, h])]
#[body(yoke)]
#[joint(reach: prismatic(z), yoke -> boom)]
#[body(boom, mass = m, inertia = diag(ix, iy, iz))]
pub struct SphericalArm<T> { pub m: T, pub i1: T, pub ix: T, pub iy: T, pub iz: T, pub h: T }"#,
    ),
    (
        "stanford_arm",
        r#"#[joint(joint1: revolute, world -> link1, dh(0, -90deg, 0.412, 0))]
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
pub struct StanfordArm<T> { pub d2: T, pub d6: T }"#,
    ),
    (
        "robo_judge",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(theta1: revolute(z), world -> column)]
#[body(column, mass = m1, com = [0, 0, r0], inertia = diag(ix1, iy1, iz1))]
#[joint(theta2: revolute(-x), column -> arm, at = [0, 0, l1])]
#[body(arm, mass = m2, com = [0, r1, 0], inertia = diag(ix2, iy2, iz2))]
pub struct RoboJudge<T> {
    pub m1: T, pub m2: T, pub l1: T, pub r0: T, pub r1: T, pub g: T,
    pub ix1: T, pub iy1: T, pub iz1: T, pub ix2: T, pub iy2: T, pub iz2: T,
}"#,
    ),
    (
        "point_mass",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(x: prismatic(x), world -> at_x)]
#[body(at_x)]
#[joint(y: prismatic(y), at_x -> at_xy)]
#[body(at_xy)]
#[joint(z: prismatic(z), at_xy -> point)]
#[body(point, solid = point(m))]
pub struct PointMass<T> { pub m: T, pub g: T }"#,
    ),
    (
        "planar_body",
        r#"#[joint(x: prismatic(x), world -> at_x)]
#[body(at_x)]
#[joint(y: prismatic(y), at_x -> at_xy)]
#[body(at_xy)]
#[joint(theta: continuous(z), at_xy -> plate)]
#[body(plate, mass = m, inertia = diag(i, i, i))]
pub struct PlanarBody<T> { pub m: T, pub i: T }"#,
    ),
    (
        "tossed_box",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(r: prismatic(z), world -> hand)]
#[body(hand)]
#[joint(spin: continuous([1, 2, -0.5]), hand -> parcel)]
#[body(parcel, solid = cuboid(m, [l, w, h]))]
pub struct TossedBox<T> { pub m: T, pub l: T, pub w: T, pub h: T, pub g: T }"#,
    ),
    (
        "any_toss",
        r#"#[dynamics(gravity = [0, 0, -g])]
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
pub struct AnyToss<T> { pub m: T, pub l: T, pub w: T, pub h: T, pub g: T }"#,
    ),
    (
        "free_box",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(flight: free, world -> parcel)]
#[body(parcel, solid = cuboid(m, [l, w, h]))]
pub struct FreeBox<T> { pub m: T, pub l: T, pub w: T, pub h: T, pub g: T }"#,
    ),
    (
        "spherical_pendulum",
        r#"#[joint(socket: ball, world -> bob, at = [0.1, -0.2, 0.9], rpy = [0.3, -0.5, 0.2])]
#[body(bob, mass = m, com = [0.04, -0.03, -l], inertia = tensor(0.03, ixy, -0.003, 0.05, 0.006, 0.02))]
pub struct SphericalPendulum<T> { pub m: T, pub l: T, pub ixy: T }"#,
    ),
    (
        "ball_in_chain",
        r#"#[joint(shoulder: revolute([1, 2, -0.5]), world -> upper, at = [0.1, 0, 0.3], rpy = [0.4, -0.3, 0.9])]
#[body(upper, mass = 1.8, com = [0.1, 0.02, -0.03], inertia = tensor(0.02, 0.003, -0.002, 0.03, 0.001, 0.025))]
#[joint(elbow: revolute([0, 1, 1]), upper -> lower, at = [0.3, 0.02, 0.01], rpy = [1.2, 0.5, -2.1])]
#[body(lower, mass = 1.2, com = [0.05, 0.08, 0.02], inertia = diag(0.012, 0.007, 0.013), inertia_rpy = [0.6, -0.8, 0.3])]
#[joint(wrist: ball, lower -> hand, at = [0, 0.25, 0.05], rpy = [-0.7, 1.1, 0.2])]
#[body(hand, mass = 0.7, com = [0.02, -0.01, 0.06], inertia = tensor(0.003, 0.0004, 0.0002, 0.004, -0.0003, 0.002))]
#[joint(reach: prismatic([1, 0, 2]), hand -> finger, at = [0.01, 0.03, 0.1], rpy = [0.2, 0, 0.4])]
#[body(finger, mass = 0.2, com = [0, 0.02, 0.05], inertia = diag(0.0004, 0.0005, 0.0002))]
pub struct BallInChain;"#,
    ),
    (
        "two_free_bodies",
        r#"#[joint(flight: free, world -> bird, actuated = on)]
#[body(bird, mass = m, com = [0.05, 0.01, -0.02], inertia = tensor(0.05, 0.002, -0.004, 0.04, 0.001, 0.06))]
#[joint(flap: revolute([1, 0.2, 0]), bird -> wing, at = [0, 0.1, 0.03], rpy = [0, 0.1, 0])]
#[body(wing, solid = cuboid(400g, [0.1, 0.3, 1cm]), com = [0, 0.15, 0])]
#[joint(fall: free, world -> egg, at = [0.5, 0, -0.2], rpy = [0.3, 0.4, -0.1])]
#[body(egg, mass = 0.06, com = [0, 0, 4mm], inertia = diag(0.00003, 0.00003, 0.00002))]
pub struct TwoFreeBodies<T> { pub m: T }"#,
    ),
    (
        "sleeve",
        r#"#[joint(pan: revolute(z), world -> mast, rpy = [0.1, 0.2, 0])]
#[body(mast, mass = 4, com = [0.01, 0.02, 0.3], inertia = tensor(0.2, 0.002, 0.001, 0.21, -0.003, 0.03))]
#[joint(sleeve: cylindrical([0, 1, 2]), mast -> collar, at = [0.05, 0, 0.4], rpy = [0.2, 0, 0.5])]
#[body(collar, mass = 1.1, com = [0.03, -0.01, 0.02], inertia = diag(0.004, 0.005, 0.006))]
#[joint(tilt: revolute(x), collar -> boom, at = [0.1, 0.02, 0])]
#[body(boom, solid = rod(0.9, 0.5, y), com = [0.02, 0.25, 0])]
pub struct Sleeve;"#,
    ),
    (
        "cardan",
        r#"#[joint(drive: continuous(x), world -> shaft, at = [0, 0, 0.5])]
#[body(shaft, solid = cylinder(2kg, 3cm, l, x), com = [l / 2, 0, 0])]
#[joint(cross: universal([0, 1, 0.3], z), shaft -> fork, at = [l, 0, 0], rpy = [0.2, 0, 0])]
#[body(fork, mass = m, com = [l / 3, 0.02, 0.01], inertia = tensor(0.002, 0.0003, 0, 0.01, 0.0002, 0.011))]
#[joint(stroke: prismatic(x), fork -> tool, at = [l, 0, 0], rpy = [0, 0.3, 0])]
#[body(tool, mass = m / 2, com = [0.05, 0, 0.01], inertia = diag(0.0005, 0.0008, 0.0009))]
pub struct Cardan<T> { pub l: T, pub m: T }"#,
    ),
    (
        "puck",
        r#"#[dynamics(gravity = [0, g * sin(lean), -g * cos(lean)])]
#[joint(tip: revolute(y), world -> table, rpy = [0.1, 0, 0.3])]
#[body(table, mass = 12, com = [0.1, 0, -0.05], inertia = diag(0.8, 0.9, 1.5))]
#[joint(glide: planar([0.2, -0.1, 1]), table -> disc, at = [0.2, 0.1, 0.03], rpy = [0, 0, 0.7])]
#[body(disc, mass = m, com = [0.02, 0.01, 0.03], inertia = tensor(0.004, 0.0005, 0, 0.005, 0.0003, 0.008))]
#[joint(hinge: revolute(-x), disc -> rod, at = [0, 0, 0.06])]
#[body(rod, solid = rod(m / 3, 0.3), com = [0, 0, 0.15])]
pub struct Puck<T> { pub m: T, pub lean: T, pub g: T }"#,
    ),
    (
        "gantry",
        r#"#[joint(drive: translation, world -> trolley, at = [0, 0, 3], rpy = [0, 0.1, 0.4])]
#[body(trolley, mass = 8, com = [0.02, 0.01, 0.05], inertia = diag(0.1, 0.12, 0.2))]
#[joint(swing: ball, trolley -> load, at = [0, 0.05, -0.1])]
#[body(load, mass = 2.5, com = [0.02, 0, -0.7], inertia = tensor(0.03, 0.001, 0, 0.04, 0.002, 0.02))]
pub struct Gantry;"#,
    ),
    (
        "jack",
        r#"#[joint(pan: revolute([0.1, 0, 1]), world -> post)]
#[body(post, mass = 5, com = [0, 0.02, 0.4], inertia = diag(0.3, 0.31, 0.02))]
#[joint(screw: helical([0, 0.1, 1], lead / (2 * pi)), post -> nut, at = [0.02, 0, 0.2], rpy = [0.2, -0.1, 0])]
#[body(nut, mass = m, com = [0.05, 0.02, 0.01], inertia = tensor(0.006, 0.0004, 0.0002, 0.007, 0.0005, 0.009))]
#[joint(swing: revolute(y), nut -> arm, at = [0.1, 0, 0.05])]
#[body(arm, mass = 0.6, com = [0.15, 0.01, -0.02], inertia = diag(0.001, 0.006, 0.006))]
pub struct Jack<T> { pub lead: T, pub m: T }"#,
    ),
    (
        "gripper",
        r#"#[joint(roll: revolute(x), world -> palm, at = [0, 0, 0.4], rpy = [0.3, 0.2, 0.1])]
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
pub struct Gripper<T> { pub m: T, pub l: T, pub pinion: T, pub k: T }"#,
    ),
    (
        "locked",
        r#"#[joint(hip: revolute([0, 1, 0.1]), world -> hip, rpy = [0.1, 0, 0.2])]
#[body(hip, mass = 2, com = [0.02, 0.03, 0.01], inertia = tensor(0.01, 0.001, 0, 0.012, 0.0005, 0.009))]
#[joint(slide: prismatic(z), hip -> thigh, at = [0, 0, -0.1], locked = 12cm)]
#[body(thigh, solid = rod(m, 0.4), com = [0, 0, -0.2])]
#[joint(knee: revolute(y), thigh -> shin, at = [0, 0, -0.4], locked = bend, damping = 2)]
#[body(shin, mass = m, com = [0.01, 0, -0.15], inertia = diag(0.01, 0.011, 0.002))]
#[joint(cover: revolute(x), thigh -> lid, at = [0, 0.05, -0.4], mimic = knee, ratio = 0.5, offset = 0.1)]
#[body(lid, mass = 0.2, com = [0, 0.02, 0.01], inertia = diag(0.0002, 0.0001, 0.0002))]
#[joint(ankle: revolute(-y), shin -> toe, at = [0, 0, -0.35])]
#[body(toe, mass = 0.5, com = [0.06, 0, -0.02], inertia = diag(0.0004, 0.001, 0.001))]
pub struct Locked<T> { pub bend: T, pub m: T }"#,
    ),
    (
        "driven_arm",
        r#"#[joint(shoulder: revolute(y), world -> upper, rotor = 2e-5, gear = 120, damping = 0.4, friction = 0.3)]
#[body(upper, mass = 2.1, com = [0.15, 0.01, 0.02], inertia = tensor(0.005, 0.001, 0, 0.03, 0.002, 0.031))]
#[joint(elbow: revolute([0, 1, 0.5]), upper -> lower, at = [0.3, 0, 0], rpy = [0.2, 0, 0.1], rotor = 1e-5, gear = -80,
    friction = 0.2, friction_speed = 0.3)]
#[body(lower, mass = 1.3, com = [0.12, 0, 0.01], inertia = diag(0.002, 0.01, 0.011))]
#[joint(stroke: prismatic(x), lower -> rod, at = [0.25, 0, 0.02], armature = 300g, damping = 12)]
#[body(rod, mass = 0.5, com = [0.05, 0, 0], inertia = diag(0.0002, 0.001, 0.001))]
pub struct DrivenArm;"#,
    ),
    (
        "sprung",
        r#"#[joint(hip: revolute([1, 0.3, 0]), world -> leg, stiffness = k, rest = slack, damping = c, rotor = j / (n * n), gear = n)]
#[body(leg, mass = 1.9, com = [0.01, 0.02, -0.2], inertia = tensor(0.03, 0.001, 0.002, 0.031, 0.003, 0.004))]
#[joint(knee: prismatic(z), leg -> foot, at = [0, 0, -0.4], stiffness = stiff, rest = 10mm, friction = f / 1m, friction_speed = s * 1m,
    armature = j / (5cm * 5cm))]
#[body(foot, mass = 0.7, com = [0.03, 0, -0.1], inertia = diag(0.002, 0.002, 0.001))]
#[joint(ankle: revolute(y), foot -> sole, at = [0, 0, -0.2], friction = f, friction_speed = s, stiffness = k / 4)]
#[body(sole, mass = 0.3, com = [0.05, 0, -0.01], inertia = diag(0.0002, 0.0008, 0.0009))]
pub struct Sprung<T> { pub k: T, pub slack: T, pub c: T, pub f: T, pub s: T, pub j: T, pub n: T, pub stiff: T }"#,
    ),
    (
        "cart_with_motor",
        r#"#[joint(slider: prismatic(x), world -> cart)]
#[body(cart, solid = point(m_cart))]
#[joint(hinge: revolute(y), cart -> pole, actuated = off, damping = 0.001)]
#[body(pole, com = [0, 0, l / 2], solid = rod(m, l))]
pub struct CartWithMotor<T> { pub m_cart: T, pub m: T, pub l: T }"#,
    ),
    (
        "on_a_vehicle",
        r#"#[dynamics(gravity = [gx, gy, gz])]
#[joint(slew: revolute(z), world -> boom, at = [0.3, 0, 1], rpy = [0, 0.05, 0])]
#[body(boom, mass = 30, com = [0.2, 0.01, 0.1], inertia = diag(0.4, 1.2, 1.3))]
#[joint(lift: revolute([0, 1, 0.1]), boom -> stick, at = [reach, 0, 0.2])]
#[body(stick, mass = 11, com = [reach / 2, 0.02, 0], inertia = tensor(0.05, 0.01, 0, 0.4, 0.005, 0.41))]
pub struct OnAVehicle<T> { pub gx: T, pub gy: T, pub gz: T, pub reach: T }"#,
    ),
    (
        "two_link_arm",
        r#"#[joint(theta1: revolute(z), world -> upper)]
#[body(upper, mass = m1, com = [r1, 0, 0], inertia = diag(ix1, iy1, iz1))]
#[joint(theta2: revolute(z), upper -> fore, at = [l1, 0, 0])]
#[body(fore, mass = m2, com = [r2, 0, 0], inertia = diag(ix2, iy2, iz2))]
pub struct TwoLinkArm<T> {
    pub m1: T, pub m2: T, pub l1: T, pub r1: T, pub r2: T, pub ix1: T, pub iy1: T, pub iz1: T, pub ix2: T, pub iy2: T,
    pub iz2: T,
}"#,
    ),
    (
        "ball_toss",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(r: prismatic(z), world -> hand)]
#[body(hand)]
#[joint(spin: ball, hand -> parcel)]
#[body(parcel, solid = cuboid(m, [l, w, h]))]
pub struct BallToss<T> { pub m: T, pub l: T, pub w: T, pub h: T, pub g: T }"#,
    ),
    (
        "pendulum_on_cart",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(slider: prismatic(x), world -> cart)]
#[body(cart, solid = point(m0))]
#[joint(first: revolute(y), cart -> upper)]
#[body(upper, solid = point(m1), com = [0, 0, l1])]
#[joint(second: revolute(y), upper -> lower, at = [0, 0, l1])]
#[body(lower, solid = point(m2), com = [0, 0, l2])]
pub struct PendulumOnCart<T> { pub m0: T, pub m1: T, pub m2: T, pub l1: T, pub l2: T, pub g: T }"#,
    ),
    (
        "pulley",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(theta: revolute(y), world -> wheel, armature = j)]
#[body(wheel, solid = cylinder(m, r, b, y))]
#[joint(rope: prismatic(z), world -> load, mimic = theta, ratio = r)]
#[body(load, solid = point(load))]
pub struct Pulley<T> { pub m: T, pub load: T, pub r: T, pub b: T, pub j: T, pub g: T }"#,
    ),
    (
        "inclined_pendulum",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(theta: revolute(z), world -> rod, rpy = [60deg, 0, 0])]
#[body(rod, mass = m, com = [l, 0, 0], inertia = diag(ix, iy, iz))]
pub struct InclinedPendulum<T> { pub m: T, pub l: T, pub g: T, pub ix: T, pub iy: T, pub iz: T }"#,
    ),
    (
        "diagonal_axes",
        r#"#[dynamics(gravity = [0, 0, -g])]
#[joint(alpha: revolute([1, 1, 1]), world -> frame)]
#[body(frame, mass = m1, com = [a, 0, 0], inertia = diag(0.02, 0.02, 0.02))]
#[joint(beta: revolute(x), frame -> wheel, at = [0, a * sqrt(2) / 2, 0])]
#[body(wheel, solid = point(m2), com = [0, r, 0])]
pub struct DiagonalAxes<T> { pub m1: T, pub m2: T, pub a: T, pub r: T, pub g: T }"#,
    ),
];
