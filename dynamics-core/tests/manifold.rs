//! Ball and free joints: exponentials and logarithms against nalgebra's, matrix series and dual numbers.
#![cfg(feature = "std")]

mod common;

use std::f64::consts::PI;

use common::dual::{Dual, moving, resting, tangent};
use common::{random_numbers, random_vector};
use dynamics_core::__private::{
    ball_tangent_rate, columns, difference_ball, difference_free, free_tangent_rate, integrate_ball,
    integrate_free, put_on_diagonal, vector,
};
use dynamics_core::nalgebra::{Matrix3, Matrix4, Quaternion, UnitQuaternion, Vector3, Vector4};
use dynamics_core::prelude::*;

/// Some roundings of numbers of the size 1.
const ROUNDING: f64 = 2e-15;

// Cases.

/// Rotations of every size: from those whose squares underflow to many turns.
const ANGLES: [f64; 19] = [
    0.0,
    5e-324,
    1e-200,
    1e-154,
    1e-20,
    1e-10,
    1e-9,
    3e-9,
    1e-8,
    3e-8,
    1e-7,
    1e-5,
    1e-3,
    0.1,
    1.0,
    PI,
    4.0,
    2.0 * PI,
    9.0,
];

fn unit_quaternion(random: &mut impl FnMut() -> f64) -> [f64; 4] {
    let [q] = random_vector::<4>(random, 1.0).normalize().data.0;
    q
}

fn rotation_vector(random: &mut impl FnMut() -> f64, angle: f64) -> [f64; 3] {
    let [delta] = (random_vector::<3>(random, 1.0).normalize() * angle).data.0;
    delta
}

fn rotation(q: [f64; 4]) -> Matrix3<f64> {
    *UnitQuaternion::new_unchecked(Quaternion::from(Vector4::from(q))).to_rotation_matrix().matrix()
}

/// A free joint's configuration as a matrix, 4×4.
fn transform([x, y, z, i, j, k, w]: [f64; 7]) -> Matrix4<f64> {
    let mut matrix = rotation([i, j, k, w]).to_homogeneous();
    matrix.fixed_view_mut::<3, 1>(0, 3).copy_from(&Vector3::new(x, y, z));
    matrix
}

/// The same of a screw δ: the matrix whose exponential is the motion.
fn hat([a, b, c, l, m, n]: [f64; 6]) -> Matrix4<f64> {
    let mut matrix = Matrix4::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&Vector3::new(l, m, n).cross_matrix());
    matrix.fixed_view_mut::<3, 1>(0, 3).copy_from(&Vector3::new(a, b, c));
    matrix
}

/// `eˣ` by Taylor's series at x/2⁶, squared six times.
fn exponential(x: Matrix4<f64>) -> Matrix4<f64> {
    let x = x / 64.0;
    let series =
        (1..=20).rev().fold(Matrix4::identity(), |sum, k| Matrix4::identity() + x * sum / f64::from(k));
    (0..6).fold(series, |root, _| root * root)
}

/// Some configurations of a free joint, and screws of every angle.
fn for_each_screw(mut check: impl FnMut([f64; 7], [f64; 6])) {
    let mut random = random_numbers(7);
    for angle in ANGLES {
        for _ in 0..20 {
            let [i, j, k, w] = unit_quaternion(&mut random);
            let [l, m, n] = rotation_vector(&mut random, angle);
            let [a, b, c, x, y, z] = std::array::from_fn(|_| random());
            check([x, y, z, i, j, k, w], [a, b, c, l, m, n]);
        }
    }
}

#[track_caller]
fn close<const N: usize>(found: [f64; N], expected: [f64; N], tolerance: f64) {
    let error = (SVector::from(found) - SVector::from(expected)).amax();
    assert!(error <= tolerance, "{error:e}: {found:?} is not {expected:?}");
}

// Exponentials.

#[test]
fn a_ball_joint_turns_as_a_quaternion_of_nalgebra() {
    for_each_screw(|[.., i, j, k, w], [.., l, m, n]| {
        let q = UnitQuaternion::new_unchecked(Quaternion::from(Vector4::from([i, j, k, w])));
        let expected = q * UnitQuaternion::from_scaled_axis(Vector3::new(l, m, n));
        let [expected] = expected.into_inner().coords.data.0;
        close(integrate_ball([i, j, k, w], [l, m, n]), expected, ROUNDING);
    });
}

#[test]
fn a_small_rotation_keeps_its_relative_precision() {
    for angle in [1e-300_f64, 1e-200, 1e-160, 1e-30, 1e-9, 1e-8, 1e-6] {
        let [i, j, k, w] = integrate_ball([0.0, 0.0, 0.0, 1.0], [0.0, angle, 0.0]);
        let (sine, cosine) = (0.5 * angle).sin_cos();
        assert!((j - sine).abs() <= 4.0 * f64::EPSILON * sine, "{angle}: {j:e}");
        close([i, k, w], [0.0, 0.0, cosine], f64::EPSILON);
    }
}

#[test]
fn a_free_joint_moves_as_the_exponential_of_a_matrix() {
    for_each_screw(|q, delta| {
        let expected = transform(q) * exponential(hat(delta));
        let error = (transform(integrate_free(q, delta)) - expected).amax();
        assert!(error < 20.0 * ROUNDING, "{error:e} at {delta:?}"); // the six squarings of the series are most of it
    });
}

#[test]
fn a_constant_velocity_makes_one_motion() {
    for_each_screw(|q, delta| {
        let part = |share: f64| delta.map(|x| share * x);
        let in_two_steps = integrate_free(integrate_free(q, part(0.3)), part(0.7));
        close(in_two_steps, integrate_free(q, delta), 5.0 * ROUNDING);
    });
}

#[test]
fn a_quaternion_stays_of_unit_length() {
    let mut q = [0.5, -0.5, 0.5, 0.5];
    for _ in 0..1_000_000 {
        q = integrate_ball(q, [0.01, -0.02, 0.005]);
    }
    let excess: f64 = Vector4::from(q).norm_squared() - 1.0;
    assert!(excess.abs() <= 4.0 * f64::EPSILON, "{excess:e}");
}

#[test]
fn a_quaternion_that_is_a_little_off_is_mended() {
    let q = integrate_ball([0.0, 0.6 * (1.0 + 1e-6), 0.0, 0.8], [0.0; 3]);
    let excess: f64 = Vector4::from(q).norm_squared() - 1.0;
    assert!(excess.abs() <= 1e-12, "{excess:e}"); // ¾ of the square of 0.72e-6
}

#[test]
fn what_is_not_finite_comes_out_so() {
    for odd in [f64::NAN, f64::INFINITY, 1e200] {
        assert!(integrate_ball([0.0, 0.0, 0.0, 1.0], [odd, 0.0, 0.0]).iter().all(|x| x.is_nan()));
        assert!(difference_ball([0.0, 0.0, 0.0, 1.0], [0.0, odd, 0.0, 1.0]).iter().any(|x| x.is_nan()));
    }
    assert!(difference_ball([0.0_f64; 4], [0.0; 4]).iter().all(|x| x.is_nan()), "no orientation");
}

// Logarithms.

#[test]
fn a_difference_leads_where_it_says() {
    for_each_screw(|q0, delta| {
        let q1 = integrate_free(q0, delta);
        let way = difference_free(q0, q1);
        let error = (transform(integrate_free(q0, way)) - transform(q1)).amax();
        assert!(error <= 3.0 * ROUNDING, "{error:e} at {delta:?}");
        let [.., l, m, n] = way;
        assert!(Vector3::new(l, m, n).norm() <= PI + ROUNDING);
        let [_, _, _, orientation_0 @ ..] = q0;
        let [_, _, _, orientation_1 @ ..] = q1;
        assert_eq!(difference_ball(orientation_0, orientation_1), [l, m, n]);
    });
}

#[test]
fn a_difference_is_the_displacement_up_to_half_a_turn() {
    for_each_screw(|q, delta| {
        let [.., l, m, n] = delta;
        if Vector3::new(l, m, n).norm() < 3.0 {
            close(difference_free(q, integrate_free(q, delta)), delta, 20.0 * ROUNDING);
        }
    });
}

#[test]
fn a_small_difference_keeps_its_relative_precision() {
    for angle in [1e-300_f64, 1e-200, 1e-160, 1e-30, 1e-9, 1e-8, 1e-6, 1e-3] {
        let [x, y, z] =
            difference_ball([0.0, 0.0, 0.0, 1.0], [0.0, 0.0, (0.5 * angle).sin(), (0.5 * angle).cos()]);
        assert!((z - angle).abs() <= 8.0 * f64::EPSILON * angle, "{angle}: {z:e}");
        assert_eq!([x, y], [0.0; 2]);
    }
}

#[test]
fn every_angle_has_its_logarithm() {
    for k in 0..=10_000 {
        let angle = PI * f64::from(k) / 10_000.0;
        let (sine, cosine) = (0.5 * angle).sin_cos();
        let [x, _, _] = difference_ball([0.0, 0.0, 0.0, 1.0], [sine, 0.0, 0.0, cosine]);
        assert!((x - angle).abs() <= 8.0 * f64::EPSILON, "{angle}: {x}");
        let [x, _, _] = difference_ball([sine, 0.0, 0.0, cosine], [0.0, 0.0, 0.0, -1.0]);
        assert!((x + angle).abs() <= 8.0 * f64::EPSILON, "{angle}: {x}");
    }
}

#[test]
fn a_quaternion_and_its_negative_are_one_orientation() {
    for_each_screw(|[.., i, j, k, w], [.., l, m, n]| {
        let q0 = [i, j, k, w];
        let q1 = integrate_ball(q0, [l, m, n]);
        let negative = q1.map(|x| -x);
        // At half a turn both ways are as short, and rounding chooses.
        if (Vector3::new(l, m, n).norm() - PI).abs() > 1e-9 {
            close(difference_ball(q0, negative), difference_ball(q0, q1), ROUNDING);
        }
    });
    assert_eq!(difference_ball([0.6, 0.0, 0.0, 0.8], [-0.6, 0.0, 0.0, -0.8]), [0.0; 3]);
}

#[test]
fn half_a_turn_has_a_direction() {
    for (q, expected) in [
        ([1.0, 0.0, 0.0, 0.0], [PI, 0.0, 0.0]),
        ([0.0, -1.0, 0.0, -0.0], [0.0, -PI, 0.0]),
        ([0.0, 0.6, 0.8, 6e-17], [0.0, 0.6 * PI, 0.8 * PI]),
        ([0.0, 0.6, 0.8, -6e-17], [0.0, -0.6 * PI, -0.8 * PI]),
    ] {
        close(difference_ball([0.0, 0.0, 0.0, 1.0], q), expected, ROUNDING);
    }
}

// Derivatives.

/// The columns of `∂δ̇/∂δ` by central differences; between the two steps δ̇ is a linear function of δ but for its
/// even part, which cancels.
fn rate_by_differences<const N: usize, const NQ: usize>(
    velocity: SVector<f64, N>,
    integrate: impl Fn([Dual; N]) -> [Dual; NQ],
    and_on: impl Fn([Dual; NQ], [Dual; N]) -> [Dual; NQ],
    back: impl Fn([Dual; NQ]) -> [Dual; N],
) -> SMatrix<f64, N, N> {
    let h = 1e-2;
    let rate = |delta: SVector<f64, N>| {
        let [delta] = resting(&delta).data.0;
        let [step] = moving(&SVector::zeros(), &velocity).data.0;
        tangent(&vector(back(and_on(integrate(delta), step))))
    };
    let column = |k| {
        let delta = SMatrix::<f64, N, N>::identity().column(k) * h;
        (rate(delta) - rate(-delta)) / (2.0 * h)
    };
    SMatrix::from_columns(&std::array::from_fn::<_, N, _>(column))
}

#[test]
fn tangent_rates_are_the_derivatives_of_the_rate() {
    let mut random = random_numbers(3);
    for _ in 0..10 {
        let q: [Dual; 4] = unit_quaternion(&mut random).map(Dual::of);
        let [i, j, k, w] = q;
        let [x, y, z] = std::array::from_fn(|_| Dual::of(random()));
        let free = [x, y, z, i, j, k, w];
        let (angular, twist) = (random_vector::<3>(&mut random, 2.0), random_vector::<6>(&mut random, 2.0));

        let ([by_rule], [rule]) = (angular.data.0, twist.data.0);
        let differences =
            rate_by_differences(angular, |d| integrate_ball(q, d), integrate_ball, |p| difference_ball(q, p));
        assert!((columns(ball_tangent_rate(by_rule)) - differences).amax() < 1e-11);
        let differences = rate_by_differences(
            twist,
            |d| integrate_free(free, d),
            integrate_free,
            |p| difference_free(free, p),
        );
        assert!((columns(free_tangent_rate(rule)) - differences).amax() < 1e-11);
    }
}

/// `d/ds (q ⊕ s·δ) = q ⊕ s·δ` moving with the velocity δ, at every s.
#[test]
fn dual_numbers_see_the_velocity_at_every_angle() {
    for_each_screw(|q, delta| {
        let (q, delta) = (q.map(Dual::of), SVector::from(delta));
        let [growing] = moving(&delta, &delta).data.0;
        let [reached] = resting(&delta).data.0;
        let [moving_on] = moving(&SVector::zeros(), &delta).data.0;
        let by_size = integrate_free(q, growing).map(|x| x.tangent);
        let by_velocity = integrate_free(integrate_free(q, reached), moving_on).map(|x| x.tangent);
        close(by_size, by_velocity, 2e-14);
    });
}

#[test]
fn dual_numbers_survive_half_a_turn() {
    let (o, i) = (Dual::of(0.0), Dual::of(1.0));
    let onwards = Dual { value: 0.0, tangent: -0.5 };
    let [x, y, z] = difference_ball([o, o, o, i], [i, o, o, onwards]);
    close([x.value, y.value, z.value], [PI, 0.0, 0.0], ROUNDING);
    close([x.tangent, y.tangent, z.tangent], [1.0, 0.0, 0.0], ROUNDING);
}

// Other scalars, and pieces.

#[test]
fn single_precision_is_as_good_as_its_digits() {
    /// Some roundings of `f32`.
    const SINGLE: f64 = 2e-6;
    for_each_screw(|q, delta| {
        let (q, delta) = (q.map(|x| x as f32), delta.map(|x| x as f32));
        let (exact_q, exact_delta) = (q.map(f64::from), delta.map(f64::from));
        let reached = integrate_free(q, delta);
        close(reached.map(f64::from), integrate_free(exact_q, exact_delta), SINGLE);
        let back = difference_free(q, reached);
        let error = (transform(integrate_free(exact_q, back.map(f64::from)))
            - transform(reached.map(f64::from)))
        .amax();
        assert!(error < SINGLE, "{error:e}");
    });
}

#[test]
fn blocks_stand_on_the_diagonal() {
    let mut rate = SMatrix::<f64, 4, 4>::zeros();
    put_on_diagonal(&mut rate, 1, ball_tangent_rate([2.0, 4.0, 6.0]));
    let expected = SMatrix::<f64, 4, 4>::from([
        [0.0; 4],
        [0.0, 0.0, -3.0, 2.0],
        [0.0, 3.0, 0.0, -1.0],
        [0.0, -2.0, 1.0, 0.0],
    ]);
    assert_eq!(rate, expected);
}
