//! Textbook robots by their textbook formulas.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_core::prelude::*;
use dynamics_tests::close::ROUNDING;
use dynamics_tests::zoo::textbook::{
    acrobot, cart_pole, double_pendulum, pendulum, planar_3r, planar_scara, spherical_arm, stanford_arm,
};
use dynamics_tests::{Matrix, Random, assert_close};

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
