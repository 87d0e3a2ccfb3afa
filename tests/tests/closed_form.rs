//! Robots by their textbook formulas.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_core::prelude::*;
use dynamics_tests::close::ROUNDING;
use dynamics_tests::zoo::driven::cart_with_motor;
use dynamics_tests::zoo::joints::{free_box, gripper, spherical_pendulum};
use dynamics_tests::zoo::textbook::{
    acrobot, cart_pole, double_pendulum, pendulum, planar_3r, planar_scara, spherical_arm, stanford_arm,
};
use dynamics_tests::{Matrix, Random, State, Vector, assert_close};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

const STATES: usize = 64;
const EARTH: f64 = 9.81;

/// What a textbook says of a robot at a state; the Coriolis forces as `C·v`, for books choose their C.
struct Textbook<const N: usize> {
    M: [[f64; N]; N],
    Cv: [f64; N],
    G: [f64; N],
    V: f64,
}

fn agrees<R, const N: usize>(name: &str, robot: &R, book: impl Fn([f64; N], [f64; N]) -> Textbook<N>)
where
    R: DynamicsDerivatives<f64, N, N>,
{
    let mut random = Random::of(name);
    for _ in 0..STATES {
        let mut vector = |size| SVector::<f64, N>::from_fn(|_, _| size * random.number());
        let (q, v, a) = (vector(3.2), vector(2.0), vector(4.0));
        let Textbook { M, Cv, G, V } = book(q.data.0[0], v.data.0[0]);
        let M = SMatrix::<f64, N, N>::from(M); // by columns, and symmetric
        let (Cv, G) = (SVector::from(Cv), SVector::from(G));
        let floor = M.amax();
        let close = |what: &str, found: &[f64], expected: &[f64]| {
            assert_close!(found, expected, ROUNDING, floor = floor, "{name}: {what}");
        };
        close("M", robot.mass_matrix(&q).as_slice(), M.as_slice());
        close("C·v", (robot.coriolis_matrix(&q, &v) * v).as_slice(), Cv.as_slice());
        close("G", robot.gravity_forces(&q).as_slice(), G.as_slice());
        close("h", robot.bias_forces(&q, &v).as_slice(), (Cv + G).as_slice());
        let tau = M * a + Cv + G;
        close("τ", robot.inverse_dynamics(&q, &v, &a).as_slice(), tau.as_slice());
        let T = v.dot(&(M * v)) / 2.0;
        close("T", &[robot.kinetic_energy(&q, &v)], &[T]);
        close("V", &[robot.potential_energy(&q)], &[V]);
        close("L", &[robot.lagrangian(&q, &v)], &[T - V]);
        // Solving multiplies the rounding by the condition of M.
        let values = Matrix::from_column_slice(N, N, M.as_slice()).symmetric_eigenvalues();
        let tolerance = ROUNDING.max(8.0 * f64::EPSILON * values.max() / values.min());
        let found = robot.forward_dynamics(&q, &v, &tau);
        assert_close!(found.as_slice(), a.as_slice(), tolerance, "{name}: a");
    }
}

#[test]
fn pendulum_agrees() {
    let robot = pendulum::robot::<f64>();
    let pendulum::Pendulum { m, l, g } = robot;
    agrees("pendulum", &robot, |[q], _| Textbook {
        M: [[m * l * l]],
        Cv: [0.0],
        G: [m * g * l * q.sin()],
        V: -m * g * l * q.cos(),
    });
}

#[test]
fn derivatives_of_the_pendulum_agree() {
    let robot = pendulum::robot::<f64>();
    let pendulum::Pendulum { m, l, g } = robot;
    for q in [-3.0, -0.4, 0.0, 1.2, 2.9_f64] {
        let (at, one) = (SVector::from([q]), SVector::from([1.0]));
        let InverseDynamicsDerivatives { dtau_dq, dtau_dv, dtau_da } =
            robot.inverse_dynamics_derivatives(&at, &one, &one);
        let found = [dtau_dq[0], dtau_dv[0], dtau_da[0]];
        assert_close!(found, [m * g * l * q.cos(), 0.0, m * l * l], ROUNDING, "∂τ of the pendulum");
        let ForwardDynamicsDerivatives { da_dq, da_dv, da_dtau } =
            robot.forward_dynamics_derivatives(&at, &one, &one);
        let found = [da_dq[0], da_dv[0], da_dtau[0]];
        assert_close!(found, [-g / l * q.cos(), 0.0, 1.0 / (m * l * l)], ROUNDING, "∂a of the pendulum");
    }
}

#[test]
fn double_pendulum_agrees() {
    let robot = double_pendulum::robot::<f64>();
    let double_pendulum::DoublePendulum { m1, m2, l1, l2, g } = robot;
    agrees("double pendulum", &robot, |[q1, q2], [v1, v2]| {
        let off = m2 * (l2 * l2 + l1 * l2 * q2.cos());
        let h = m2 * l1 * l2 * q2.sin();
        let distal = m2 * g * l2 * (q1 + q2).sin();
        Textbook {
            M: [
                [m1 * l1 * l1 + m2 * (l1 * l1 + l2 * l2 + 2.0 * l1 * l2 * q2.cos()), off],
                [off, m2 * l2 * l2],
            ],
            Cv: [-h * (2.0 * v1 * v2 + v2 * v2), h * v1 * v1],
            G: [(m1 + m2) * g * l1 * q1.sin() + distal, distal],
            V: -(m1 + m2) * g * l1 * q1.cos() - m2 * g * l2 * (q1 + q2).cos(),
        }
    });
}

#[test]
fn cart_pole_agrees() {
    let robot = cart_pole::robot::<f64>();
    let cart_pole::CartPole { mc, mp, l, j, g } = robot;
    agrees("cart-pole", &robot, |[_, q], [_, v]| {
        let off = mp * l * q.cos();
        Textbook {
            M: [[mc + mp, off], [off, j + mp * l * l]],
            Cv: [-mp * l * q.sin() * v * v, 0.0],
            G: [0.0, -mp * g * l * q.sin()],
            V: mp * g * l * q.cos(),
        }
    });
}

/// R. Tedrake, *Underactuated Robotics*, ch. 3.1.1; its τ_g is −G.
#[test]
fn acrobot_agrees() {
    let robot = acrobot::robot();
    let acrobot::Acrobot { m1, m2, l1, lc1, lc2, i1, i2 } = robot;
    let (I1, I2) = (i1 + m1 * lc1 * lc1, i2 + m2 * lc2 * lc2);
    agrees("acrobot", &robot, |[q1, q2], [v1, v2]| {
        let (c, s) = (m2 * l1 * lc2 * q2.cos(), m2 * l1 * lc2 * q2.sin());
        let distal = m2 * EARTH * lc2 * (q1 + q2).sin();
        Textbook {
            M: [[I1 + I2 + m2 * l1 * l1 + 2.0 * c, I2 + c], [I2 + c, I2]],
            Cv: [-2.0 * s * v2 * v1 - s * v2 * v2, s * v1 * v1],
            G: [m1 * EARTH * lc1 * q1.sin() + m2 * EARTH * l1 * q1.sin() + distal, distal],
            V: -m1 * EARTH * lc1 * q1.cos() - m2 * EARTH * (l1 * q1.cos() + lc2 * (q1 + q2).cos()),
        }
    });
}

/// In the absolute angles φ the links do not know of each other's joints: `M_ij = a_ij·cos(φ_i − φ_j)`,
/// `h_i = Σ a_ij·sin(φ_i − φ_j)·φ̇_j²`, `V = g·Σ b_i·sin φ_i`; and φ are the partial sums of q.
#[test]
fn planar_3r_agrees() {
    let robot = planar_3r::robot::<f64>();
    let planar_3r::Planar3R { m1, m2, m3, l1, l2, l3 } = robot;
    let a12 = (m2 / 2.0 + m3) * l2 * l1;
    let (a13, a23) = (m3 * l3 / 2.0 * l1, m3 * l3 / 2.0 * l2);
    let (a11, a22) = ((m1 / 3.0 + m2 + m3) * l1 * l1, (m2 / 3.0 + m3) * l2 * l2);
    let a = [[a11, a12, a13], [a12, a22, a23], [a13, a23, m3 / 3.0 * l3 * l3]];
    let b = [(m1 / 2.0 + m2 + m3) * l1, (m2 / 2.0 + m3) * l2, m3 / 2.0 * l3];
    let partial_sums = |x: [f64; 3]| [x[0], x[0] + x[1], x[0] + x[1] + x[2]];
    // A force on φ_i acts on each joint up to i.
    let on_joints = |x: [f64; 3]| [x[0] + x[1] + x[2], x[1] + x[2], x[2]];
    agrees("planar 3R", &robot, |q, v| {
        let (phi, rate) = (partial_sums(q), partial_sums(v));
        let row = |i: usize| on_joints([0, 1, 2].map(|j: usize| a[i][j] * (phi[i] - phi[j]).cos()));
        let rows = [row(0), row(1), row(2)];
        let column = |j: usize| on_joints([0, 1, 2].map(|i: usize| rows[i][j]));
        let coriolis = |i: usize| (0..3).map(|j| a[i][j] * (phi[i] - phi[j]).sin() * rate[j] * rate[j]).sum();
        Textbook {
            M: [column(0), column(1), column(2)],
            Cv: on_joints([coriolis(0), coriolis(1), coriolis(2)]),
            G: on_joints([0, 1, 2].map(|i: usize| EARTH * b[i] * phi[i].cos())),
            V: (0..3).map(|i| EARTH * b[i] * phi[i].sin()).sum(),
        }
    });
}

/// R. Murray, Z. Li, S. Sastry 1994, example 4.4.
#[test]
fn scara_agrees() {
    let robot = planar_scara::robot();
    let planar_scara::PlanarScara { m1, m2, m3, m4, l1, l2, r1, r2, i1, i2, i3, i4 } = robot;
    let alpha = i1 + r1 * r1 * m1 + l1 * l1 * (m2 + m3 + m4);
    let beta = i2 + i3 + i4 + l2 * l2 * (m3 + m4) + m2 * r2 * r2;
    let gamma = l1 * l2 * (m3 + m4) + l1 * m2 * r2;
    let delta = i3 + i4;
    agrees("SCARA", &robot, |[_, q2, _, q4], [v1, v2, _, _]| {
        let (c, s) = (gamma * q2.cos(), gamma * q2.sin());
        Textbook {
            M: [
                [alpha + beta + 2.0 * c, beta + c, delta, 0.0],
                [beta + c, beta, delta, 0.0],
                [delta, delta, delta, 0.0],
                [0.0, 0.0, 0.0, m4],
            ],
            Cv: [-s * v2 * v1 - s * (v1 + v2) * v2, s * v1 * v1, 0.0, 0.0],
            G: [0.0, 0.0, 0.0, m4 * EARTH],
            V: m4 * EARTH * q4,
        }
    });
}

/// A mass in spherical coordinates: azimuth, polar angle, distance.
#[test]
fn spherical_arm_agrees() {
    let robot = spherical_arm::robot::<f64>();
    let spherical_arm::SphericalArm { m, i1, ix, iy, iz, h } = robot;
    agrees("spherical arm", &robot, |[_, q2, r], [v1, v2, v3]| {
        let (s, c) = q2.sin_cos();
        let by_polar = 2.0 * s * c * (ix + m * r * r - iz);
        let by_reach = 2.0 * m * r * s * s;
        Textbook {
            M: [
                [i1 + (ix + m * r * r) * s * s + iz * c * c, 0.0, 0.0],
                [0.0, iy + m * r * r, 0.0],
                [0.0, 0.0, m],
            ],
            Cv: [
                v1 * (by_polar * v2 + by_reach * v3),
                2.0 * m * r * v2 * v3 - by_polar * v1 * v1 / 2.0,
                -by_reach * v1 * v1 / 2.0 - m * r * v2 * v2,
            ],
            G: [0.0, -m * EARTH * r * s, m * EARTH * c],
            V: m * EARTH * (h + r * c),
        }
    });
}

/// M. Spong, S. Hutchinson, M. Vidyasagar, *Robot Modeling and Control*, example 3.5: the hand of the Stanford arm.
#[test]
fn hand_of_the_stanford_arm_is_where_the_book_says() {
    let robot = stanford_arm::robot::<f64>();
    let stanford_arm::StanfordArm { d2, d6 } = robot;
    let mut random = Random::of("Stanford arm");
    for _ in 0..STATES {
        let q = SVector::<f64, 6>::from_fn(|_, _| 3.2 * random.number());
        let [q1, q2, d3, q4, q5, q6] = q.data.0[0];
        let ((s1, c1), (s2, c2), (s4, c4), (s5, c5)) =
            (q1.sin_cos(), q2.sin_cos(), q4.sin_cos(), q5.sin_cos());
        let (s6, c6) = q6.sin_cos();
        let hand = [
            c1 * s2 * d3 - s1 * d2 + d6 * (c1 * c2 * c4 * s5 + c1 * c5 * s2 - s1 * s4 * s5),
            s1 * s2 * d3 + c1 * d2 + d6 * (c1 * s4 * s5 + c2 * c4 * s1 * s5 + c5 * s1 * s2),
            0.412 + c2 * d3 + d6 * (c2 * c5 - c4 * s2 * s5),
        ];
        let pose = robot.pose::<stanford_arm::Link6>(&q);
        assert_close!(pose.translation.as_slice(), hand, ROUNDING, floor = 1.0, "hand of the Stanford arm");
        let approach = [
            c1 * c2 * c4 * s5 - s1 * s4 * s5 + c1 * s2 * c5,
            s1 * c2 * c4 * s5 + c1 * s4 * s5 + s1 * s2 * c5,
            -s2 * c4 * s5 + c2 * c5,
        ];
        assert_close!(pose.rotation.column(2).as_slice(), approach, ROUNDING, "approach of the Stanford arm");
        let below =
            [-s2 * (c4 * c5 * c6 - s4 * s6) - c2 * s5 * c6, s2 * (c4 * c5 * s6 + s4 * c6) + c2 * s5 * s6];
        let found = [pose.rotation[(2, 0)], pose.rotation[(2, 1)]];
        assert_close!(found, below, ROUNDING, floor = 1.0, "last row of the rotation of the Stanford arm");
    }
}

/// Newton and Euler, in the body: `m(l̇ + ω×l) = f`, `Iω̇ + ω×Iω = n`, and the weight turned into it.
#[test]
fn free_box_agrees() {
    let robot = free_box::robot::<f64>();
    let free_box::FreeBox { m, l, w, h, g } = robot;
    let I = Matrix3::from_diagonal(&Vector3::new(w * w + h * h, l * l + h * h, l * l + w * w)) * (m / 12.0);
    let space = free_box::entry().space;
    for State { q, v, a, .. } in State::many("free box", space, STATES) {
        let R = UnitQuaternion::new_unchecked(Quaternion::new(q[6], q[3], q[4], q[5]));
        let weight = R.inverse() * Vector3::new(0.0, 0.0, m * g);
        let halves = |x: &Vector| (x.fixed_rows::<3>(0).into_owned(), x.fixed_rows::<3>(3).into_owned());
        let ((linear, angular), (dl, dw)) = (halves(&v), halves(&a));
        let force = (dl + angular.cross(&linear)) * m + weight;
        let moment = I * dw + angular.cross(&(I * angular));
        let [v, a] = [&v, &a].map(|x| SVector::from_column_slice(x.as_slice()));
        let q = SVector::from_column_slice(q.as_slice());
        let tau = robot.inverse_dynamics(&q, &v, &a);
        let expected = [force.as_slice(), moment.as_slice()].concat();
        assert_close!(tau.as_slice(), expected, ROUNDING, floor = m, "free box: τ");
    }
}

/// Euler's equations about the socket, with the weight's moment: `I_o·ω̇ + ω×I_o·ω − c×(Rᵀ·m·g) = n`.
#[test]
fn spherical_pendulum_agrees() {
    let robot = spherical_pendulum::robot::<f64>();
    let spherical_pendulum::SphericalPendulum { m, l, ixy } = robot;
    let c = Vector3::new(0.04, -0.03, -l);
    let about_center = Matrix3::new(0.03, ixy, -0.003, ixy, 0.05, 0.006, -0.003, 0.006, 0.02);
    let I = about_center + (Matrix3::identity() * c.norm_squared() - c * c.transpose()) * m;
    let socket = UnitQuaternion::from_euler_angles(0.3, -0.5, 0.2);
    let space = spherical_pendulum::entry().space;
    for State { q, v, a, .. } in State::many("spherical pendulum", space, STATES) {
        let R = socket * UnitQuaternion::new_unchecked(Quaternion::new(q[3], q[0], q[1], q[2]));
        let [v, a] = [&v, &a].map(|x| SVector::<f64, 3>::from_column_slice(x.as_slice()));
        let q = SVector::from_column_slice(q.as_slice());
        let weight = R.inverse() * Vector3::new(0.0, 0.0, -m * EARTH);
        let expected = I * a + v.cross(&(I * v)) - c.cross(&weight);
        let tau = robot.inverse_dynamics(&q, &v, &a);
        assert_close!(tau.as_slice(), expected.as_slice(), ROUNDING, floor = m, "spherical pendulum: τ");
        assert_close!(robot.mass_matrix(&q).as_slice(), I.as_slice(), ROUNDING, "spherical pendulum: M");
        let height = 0.9 + (R * c).z;
        let energy = [robot.potential_energy(&q)];
        assert_close!(energy, [m * EARTH * height], ROUNDING, floor = m, "spherical pendulum: V");
    }
}

/// One motor at two: `B = [0; M⁻¹]` has its first column only, and the pole's hinge feels its damper.
#[test]
fn cart_with_motor_agrees() {
    let robot = cart_with_motor::robot::<f64>();
    let cart_with_motor::CartWithMotor { m_cart, m, l } = robot;
    let upright = SVector::from([0.0, 0.0]);
    let Linearization { a, b, drift } = robot.linearize(&upright, &upright, &SVector::from([0.0]));
    // M = [m_cart + m, m l/2; m l/2, m l²/3] upright, and the slope of gravity is −m g l/2.
    let det = (m_cart + m) * m * l * l / 3.0 - m * m * l * l / 4.0;
    let (to_cart, to_pole) = (m * l * l / 3.0 / det, -m * l / 2.0 / det);
    assert_close!(b.as_slice(), [0.0, 0.0, to_cart, to_pole], ROUNDING, "cart with motor: B");
    let slope = m * EARTH * l / 2.0;
    let of_hinge = [to_pole, (m_cart + m) / det];
    assert_close!(
        a.column(1).as_slice(),
        [0.0, 0.0, of_hinge[0] * slope, of_hinge[1] * slope],
        ROUNDING,
        "∂/∂hinge"
    );
    let damped = [0.0, 1.0, -0.001 * of_hinge[0], -0.001 * of_hinge[1]];
    assert_close!(a.column(3).as_slice(), damped, ROUNDING, "∂/∂(speed of the hinge)");
    assert!(drift.amax() < ROUNDING, "it balances");
}

/// A follower is a constraint: `Wᵀ·M·W` of the gripper whose fingers move by themselves, with `q = W·q_own + offsets`.
#[test]
fn a_gripper_is_one_with_free_fingers_that_are_held_together() {
    /// The gripper of the zoo without followers.
    #[derive(Dynamics)]
    #[dynamics(outputs(mass_matrix, bias_forces, inverse_dynamics))]
    #[joint(roll: revolute(x), world -> palm, at = [0, 0, 0.4], rpy = [0.3, 0.2, 0.1])]
    #[body(palm, mass = 0.8, com = [0.04, 0.01, 0], inertia = diag(0.0006, 0.0009, 0.001))]
    #[joint(knuckle: revolute(z), palm -> left, at = [l, 0.03, 0], armature = 1e-4, damping = 0.02)]
    #[body(left, mass = m, com = [l / 2, 0, 0.005], inertia = diag(0.00001, 0.00008, 0.00008))]
    #[joint(left_bend: revolute(z), left -> left_tip, at = [l, 0, 0])]
    #[body(left_tip, solid = cuboid(m / 2, [l, 1cm, 2cm]), com = [l / 2, 0, 0])]
    #[joint(right_knuckle: revolute(z), palm -> right, at = [l, -0.03, 0])]
    #[body(right, mass = m, com = [l / 2, 0, -0.005], inertia = diag(0.00001, 0.00008, 0.00008))]
    #[joint(right_bend: revolute([0, 0.1, 1]), right -> right_tip, at = [l, 0, 0], stiffness = k, rest = 0.3,
        friction = 0.01, friction_speed = 0.5)]
    #[body(right_tip, solid = cuboid(m / 2, [l, 1cm, 2cm]), com = [l / 2, 0, 0])]
    #[joint(push: prismatic(x), palm -> rack, at = [-2cm, 0, 0.01], damping = 3)]
    #[body(rack, mass = 0.2, com = [0.03, 0, 0], inertia = diag(0.00001, 0.00005, 0.00005))]
    #[joint(wag: revolute(y), rack -> tail, at = [-3cm, 0, 0])]
    #[body(tail, solid = rod(30g, 10cm), com = [0, 0, -5cm])]
    struct FreeFingers {
        m: f64,
        l: f64,
        k: f64,
    }

    let robot = gripper::robot::<f64>();
    let gripper::Gripper { m, l, pinion, k } = robot;
    let fingers = FreeFingers { m, l, k };
    // left_bend = −right_bend = −(2·knuckle + 5°); right_knuckle = 0.2 − knuckle; push = pinion·knuckle + 1 cm.
    let five_degrees = 5_f64.to_radians();
    let offsets = SVector::from([0.0, 0.0, -five_degrees, 0.2, five_degrees, 0.01, 0.0]);
    let mut W = SMatrix::<f64, 7, 3>::zeros();
    (W[(0, 0)], W[(6, 2)]) = (1.0, 1.0);
    W.set_column(1, &SVector::from([0.0, 1.0, -2.0, -1.0, 2.0, pinion, 0.0]));
    for State { q, v, a, .. } in gripper::entry().states(STATES) {
        let [q, v, a] = [&q, &v, &a].map(|x| SVector::<f64, 3>::from_column_slice(x.as_slice()));
        let (all_q, all_v, all_a) = (W * q + offsets, W * v, W * a);
        let close = |what: &str, found: &[f64], expected: &[f64]| {
            assert_close!(found, expected, ROUNDING, "gripper: {what}");
        };
        let expected = W.transpose() * fingers.mass_matrix(&all_q) * W;
        close("M", robot.mass_matrix(&q).as_slice(), expected.as_slice());
        let expected = W.transpose() * fingers.bias_forces(&all_q, &all_v);
        close("h", robot.bias_forces(&q, &v).as_slice(), expected.as_slice());
        let expected = W.transpose() * fingers.inverse_dynamics(&all_q, &all_v, &all_a);
        close("τ", robot.inverse_dynamics(&q, &v, &a).as_slice(), expected.as_slice());
    }
}
