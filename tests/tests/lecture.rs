//! Every problem of the lecture (EECS 106A, discussion 9), by the lecture's own formulas.
#![allow(non_snake_case, reason = "equations keep the field's symbols")]

use dynamics_core::prelude::*;
use dynamics_tests::close::ROUNDING;
use dynamics_tests::zoo::textbook::{any_toss, planar_body, point_mass, robo_judge, tossed_box};
use dynamics_tests::{Random, assert_close};

const STATES: usize = 64;

fn for_each_state<const N: usize>(name: &str, check: impl Fn(SVector<f64, N>, SVector<f64, N>)) {
    let mut random = Random::of(name);
    for _ in 0..STATES {
        let mut vector = |size| SVector::from_fn(|_, _| size * random.number());
        check(vector(3.2), vector(2.0));
    }
}

/// Problem 1: of a point mass there is no rotational energy, `T = ½ m vᵀv`.
#[test]
fn a_point_mass_has_the_energy_of_its_speed() {
    let robot = point_mass::robot::<f64>();
    let point_mass::PointMass { m, g } = robot;
    for_each_state("problem 1", |q: SVector<f64, 3>, v: SVector<f64, 3>| {
        let T = m * v.norm_squared() / 2.0;
        assert_close!([robot.kinetic_energy(&q, &v)], [T], ROUNDING, "T of a point mass");
        assert_close!(
            [robot.lagrangian(&q, &v)],
            [T - m * g * q[2]],
            ROUNDING,
            floor = T,
            "L of a point mass"
        );
        let M = SMatrix::<f64, 3, 3>::identity() * m;
        assert_close!(robot.mass_matrix(&q).as_slice(), M.as_slice(), ROUNDING, "M of a point mass");
        assert_eq!(robot.coriolis_matrix(&q, &v), SMatrix::<f64, 3, 3>::zeros());
        assert_close!(robot.gravity_forces(&q).as_slice(), [0.0, 0.0, m * g], ROUNDING, "G of a point mass");
    });
}

/// Problem 2: in a plane one speed of turning is left, `T = ½ I θ̇² + ½ m vᵀv`.
#[test]
fn a_body_in_the_plane_has_one_moment_of_inertia() {
    let robot = planar_body::robot::<f64>();
    let planar_body::PlanarBody { m, i } = robot;
    for_each_state("problem 2", |q: SVector<f64, 3>, v| {
        let T = i * v[2] * v[2] / 2.0 + m * (v[0] * v[0] + v[1] * v[1]) / 2.0;
        assert_close!([robot.kinetic_energy(&q, &v)], [T], ROUNDING, "T in the plane");
        assert_eq!(
            robot.gravity_forces(&q),
            SVector::<f64, 3>::zeros(),
            "gravity is at right angles to the plane"
        );
    });
}

/// The moments of the lecture's box, equation (6).
fn moments(m: f64, l: f64, w: f64, h: f64) -> [f64; 3] {
    [m / 12.0 * (w * w + h * h), m / 12.0 * (l * l + h * h), m / 12.0 * (l * l + w * w)]
}

/// Problem 3: with l > w > h the turn about z has the highest inertia, that about x the lowest.
#[test]
fn a_box_is_hardest_to_turn_about_its_shortest_edge() {
    let robot = any_toss::robot::<f64>();
    let any_toss::AnyToss { m, l, w, h, .. } = robot;
    assert!(l > w && w > h);
    let M = robot.mass_matrix(&SVector::zeros());
    let [yaw, pitch, roll] = [M[(3, 3)], M[(4, 4)], M[(5, 5)]];
    assert_close!([roll, pitch, yaw], moments(m, l, w, h), ROUNDING, "the tensor of the box");
    assert!(roll < pitch && pitch < yaw);
}

/// Problem 4: `L = m/24·(ω_x²(w² + h²) + ω_y²(l² + h²) + ω_z²(l² + w²)) + ½ m v_z² − m g r`, for a spin about one axis.
#[test]
fn the_tossed_box_has_the_lagrangian_of_the_lecture() {
    let robot = tossed_box::robot::<f64>();
    let tossed_box::TossedBox { m, l, w, h, g } = robot;
    let axis = SVector::from([1.0, 2.0, -0.5]).normalize();
    for_each_state("problem 4", |q, v| {
        let [wx, wy, wz] = (axis * v[1]).data.0[0];
        let spin = wx * wx * (w * w + h * h) + wy * wy * (l * l + h * h) + wz * wz * (l * l + w * w);
        let T = m / 24.0 * spin + m * v[0] * v[0] / 2.0;
        let V = m * g * q[0];
        let size = T + V.abs();
        assert_close!([robot.lagrangian(&q, &v)], [T - V], ROUNDING, floor = size, "L of the tossed box");
    });
}

/// Problem 4 for any spin: the angular velocity in the box is that of yaw, pitch and roll.
#[test]
fn a_box_tossed_anyhow_has_the_lagrangian_of_the_lecture() {
    let robot = any_toss::robot::<f64>();
    let any_toss::AnyToss { m, l, w, h, g } = robot;
    let [ix, iy, iz] = moments(m, l, w, h);
    for_each_state("problem 4, any spin", |q: SVector<f64, 6>, v| {
        let ((s_pitch, c_pitch), (s_roll, c_roll)) = (q[4].sin_cos(), q[5].sin_cos());
        let (yaw, pitch, roll) = (v[3], v[4], v[5]);
        let wx = roll - yaw * s_pitch;
        let wy = pitch * c_roll + yaw * s_roll * c_pitch;
        let wz = yaw * c_roll * c_pitch - pitch * s_roll;
        let linear = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        let T = (ix * wx * wx + iy * wy * wy + iz * wz * wz) / 2.0 + m * linear / 2.0;
        let V = m * g * q[2];
        let size = T + V.abs();
        assert_close!([robot.lagrangian(&q, &v)], [T - V], ROUNDING, floor = size, "L of any toss");
        let J = robot.jacobian::<any_toss::Parcel>(&q);
        let found = J * v;
        assert_close!(found.as_slice()[3..], [wx, wy, wz], ROUNDING, floor = v.amax(), "ω of any toss");
    });
}

/// Problem 5, the Jacobians: of the frame at the centre of mass of link 2, from ours at its joint.
#[test]
fn the_robojudge_has_the_jacobians_of_the_lecture() {
    let robot = robo_judge::robot::<f64>();
    let r1 = robot.r1;
    for_each_state("problem 5, Jacobians", |q, _| {
        let (s, c) = q[1].sin_cos();
        let J1 = robot.jacobian::<robo_judge::Column>(&q);
        assert_close!(J1.as_slice(), [0., 0., 0., 0., 0., 1., 0., 0., 0., 0., 0., 0.], ROUNDING, "J1");
        let J2 = robot.jacobian::<robo_judge::Arm>(&q);
        let at_centre = |column: usize| {
            let [x, y, z, wx, wy, wz] = J2.data.0[column];
            [x - wz * r1, y, z + wx * r1, wx, wy, wz] // v + ω × (0, r1, 0)
        };
        let found = [at_centre(0), at_centre(1)].concat();
        let expected = [[-r1 * c, 0.0, 0.0, 0.0, -s, c], [0.0, 0.0, -r1, -1.0, 0.0, 0.0]].concat();
        assert_close!(found, expected, ROUNDING, "J2");
    });
}

/// Problem 5: M, V and L. The lecture prints `m₂ r₁ cos²θ₂` in M₁₁; the units, and its own Jacobian, demand `r₁²`.
#[test]
fn the_robojudge_has_the_equations_of_the_lecture() {
    let robot = robo_judge::robot::<f64>();
    let robo_judge::RoboJudge { m1, m2, l1, r0, r1, g, iz1, ix2, iy2, iz2, .. } = robot;
    for_each_state("problem 5", |q, v| {
        let (s, c) = q[1].sin_cos();
        let M11 = iz1 + iy2 * s * s + iz2 * c * c + m2 * r1 * r1 * c * c;
        let M22 = ix2 + m2 * r1 * r1;
        let V = g * (m1 * r0 + m2 * (l1 - r1 * s));
        let T = (M11 * v[0] * v[0] + M22 * v[1] * v[1]) / 2.0;
        let M = robot.mass_matrix(&q);
        assert_close!(M.as_slice(), [M11, 0.0, 0.0, M22], ROUNDING, "M of the robojudge");
        assert_close!([robot.potential_energy(&q)], [V], ROUNDING, "V of the robojudge");
        assert_close!([robot.kinetic_energy(&q, &v)], [T], ROUNDING, "T of the robojudge");
        assert_close!(
            [robot.lagrangian(&q, &v)],
            [T - V],
            ROUNDING,
            floor = T + V.abs(),
            "L of the robojudge"
        );

        let slope = 2.0 * s * c * (iy2 - iz2 - m2 * r1 * r1); // ∂M₁₁/∂θ₂
        let a = SVector::from([0.7, -1.9]);
        let tau =
            [M11 * a[0] + slope * v[0] * v[1], M22 * a[1] - slope * v[0] * v[0] / 2.0 - g * m2 * r1 * c];
        assert_close!(robot.inverse_dynamics(&q, &v, &a).as_slice(), tau, ROUNDING, "Υ of the robojudge");
    });
}

/// Problem 6: the tossed box has the state `[z ż θ θ̇]`, and its dynamics are linear already.
#[test]
fn the_tossed_box_is_a_linear_system() {
    let robot = tossed_box::robot::<f64>();
    let tossed_box::TossedBox { m, l, w, h, g } = robot;
    let axis = SVector::from([1.0, 2.0, -0.5]).normalize();
    let about_axis: f64 = moments(m, l, w, h).iter().zip(axis.iter()).map(|(i, n)| i * n * n).sum();
    for_each_state("problem 6", |q: SVector<f64, 2>, v| {
        let Linearization { a, b, drift } = robot.linearize(&q, &v, &SVector::zeros());
        // Ours is (z, θ, ż, θ̇).
        let order = [0, 2, 1, 3];
        let A = SMatrix::<f64, 4, 4>::from_fn(|i, j| a[(order[i], order[j])]);
        let expected = SMatrix::<f64, 4, 4>::from([
            [0.0, 0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
        ]);
        assert_close!(A.as_slice(), expected.as_slice(), ROUNDING, "A of the tossed box");
        let B = SMatrix::<f64, 4, 2>::from_fn(|i, j| b[(order[i], j)]);
        let expected = [0.0, 1.0 / m, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0 / about_axis];
        assert_close!(B.as_slice(), expected, ROUNDING, "B of the tossed box");
        let rate = order.map(|i| drift[i]);
        assert_close!(rate, [v[0], -g, v[1], 0.0], ROUNDING, "ẋ of the tossed box");
    });
}

/// Problem 6: any toss has twelve states; from rest it falls, and does not turn.
#[test]
fn a_box_tossed_anyhow_has_twelve_states() {
    let robot = any_toss::robot::<f64>();
    let q = SVector::from([0.1, -0.2, 1.5, 0.4, -0.3, 0.9]);
    let v = SVector::from([0.5, 0.6, 2.0, 0.0, 0.0, 0.0]);
    let Linearization { drift, .. } = robot.linearize(&q, &v, &SVector::zeros());
    let expected = [v.as_slice(), &[0.0, 0.0, -robot.g, 0.0, 0.0, 0.0]].concat();
    assert_close!(drift.as_slice(), expected, ROUNDING, "ẋ of any toss");
}
