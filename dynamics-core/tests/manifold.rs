//! Ball and free joints: exponentials and logarithms against nalgebra's, matrix series and dual numbers.
#![cfg(feature = "std")]

use std::f64::consts::PI;

use crate::common::dual::{Dual, moving, resting, tangent};
use crate::common::{random_numbers, random_vector};
use dynamics_core::__private::{
    ball_rate, ball_rate_transposed, ball_tangent_rate, columns, difference_ball, difference_free, free_rate,
    free_rate_transposed, free_tangent_rate, integrate_ball, integrate_free, put_on_diagonal, vector,
};
use dynamics_core::nalgebra::{Matrix3, Matrix4, Matrix6, Quaternion, UnitQuaternion, Vector3, Vector4};
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

// Rates.

/// `δ̇` by dual numbers: `q ⊕ δ` moves with `v`, and what δ leads there is asked of the logarithm.
fn rate_of_duals<const N: usize, const Q: usize>(
    q: [Dual; Q],
    [delta, v]: [[f64; N]; 2],
    integrate: impl Fn([Dual; Q], [Dual; N]) -> [Dual; Q],
    difference: impl Fn([Dual; Q], [Dual; Q]) -> [Dual; N],
) -> [f64; N] {
    let [reached] = resting(&SVector::from(delta)).data.0;
    let [moving_on] = moving(&SVector::zeros(), &SVector::from(v)).data.0;
    difference(q, integrate(integrate(q, reached), moving_on)).map(|x| x.tangent)
}

#[test]
fn a_rate_is_the_derivative_of_the_logarithm() {
    let mut random = random_numbers(11);
    // Up to half a turn, where the logarithm takes the other way round.
    for angle in [0.0, 1e-200, 1e-9, 1e-8, 1e-7, 1e-4, 0.1, 1.0, 2.0, 3.0] {
        for _ in 0..20 {
            let [i, j, k, w] = unit_quaternion(&mut random).map(Dual::of);
            let [l, m, n] = rotation_vector(&mut random, angle);
            let [a, b, c, x, y, z] = std::array::from_fn(|_| random());
            let (v, twist) = ([x, y, z], std::array::from_fn(|_| random()));
            let expected = rate_of_duals([i, j, k, w], [[l, m, n], v], integrate_ball, difference_ball);
            // The logarithm of a dual number is worth nine digits where its angle is near zero or half a turn.
            close(ball_rate([l, m, n], v), expected, 1e-9);
            let free = [Dual::of(a), Dual::of(b), Dual::of(c), i, j, k, w];
            let delta = [x, y, z, l, m, n];
            let expected = rate_of_duals(free, [delta, twist], integrate_free, difference_free);
            close(free_rate(delta, twist), expected, 1e-7);
        }
    }
}

/// `ad(V)` of a twist, 6×6.
fn ad([a, b, c, l, m, n]: [f64; 6]) -> Matrix6<f64> {
    let [linear, angular] = [Vector3::new(a, b, c), Vector3::new(l, m, n)].map(|x| x.cross_matrix());
    let mut ad = Matrix6::zeros();
    for (row, column, block) in [(0, 0, angular), (0, 3, linear), (3, 3, angular)] {
        ad.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
    }
    ad
}

/// `Σ Bₖ/k!·(−ad δ)ᵏ`, the series of Bernoulli's numbers, up to angles where its forty terms are enough.
#[test]
fn a_rate_is_the_series_of_bernoulli() {
    const BERNOULLI: [f64; 9] = [
        1.0 / 6.0,
        -1.0 / 30.0,
        1.0 / 42.0,
        -1.0 / 30.0,
        5.0 / 66.0,
        -691.0 / 2730.0,
        7.0 / 6.0,
        -3617.0 / 510.0,
        43867.0 / 798.0,
    ];
    let mut random = random_numbers(12);
    for angle in [0.0, 1e-160, 1e-9, 1e-8, 3e-8, 1e-6, 1e-3, 0.1, 0.5] {
        for _ in 0..20 {
            let [l, m, n] = rotation_vector(&mut random, angle);
            let [a, b, c] = std::array::from_fn(|_| random());
            let (delta, twist) = ([a, b, c, l, m, n], std::array::from_fn(|_| random()));
            let (ad, mut power, mut factorial) = (ad(delta), Matrix6::identity(), 1.0);
            let mut map = Matrix6::identity() + ad * 0.5;
            for (k, bernoulli) in BERNOULLI.iter().enumerate() {
                let order = 2.0 * k as f64 + 2.0;
                (power, factorial) = (power * ad * ad, factorial * order * (order - 1.0));
                map += power * (bernoulli / factorial);
            }
            let [expected] = (map * SVector::from(twist)).data.0;
            close(free_rate(delta, twist), expected, 2.0 * ROUNDING);
            let [transposed] = (map.transpose() * SVector::from(twist)).data.0;
            close(free_rate_transposed(delta, twist), transposed, 2.0 * ROUNDING);
        }
    }
}

/// `D(δ)·exp'(δ) = 1`: what δ does to the motion, and what the motion does to δ, up to where the chart ends.
#[test]
fn a_rate_undoes_the_derivative_of_the_exponential() {
    let mut random = random_numbers(13);
    for angle in [1e-9, 1e-8, 1e-7, 1e-3, 1.0, 2.0, 3.0, PI, 4.0, 4.7] {
        for _ in 0..20 {
            let [l, m, n] = rotation_vector(&mut random, angle);
            let [a, b, c] = std::array::from_fn(|_| random());
            let (delta, grows) = (SVector::from([a, b, c, l, m, n]), random_vector::<6>(&mut random, 1.0));
            // The velocity at which q ⊕ δ moves as δ grows: the difference from the place that stands.
            let ([at], [growing]) = (resting(&delta).data.0, moving(&delta, &grows).data.0);
            let origin = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0].map(Dual::of);
            let (stands, moves) = (integrate_free(origin, at), integrate_free(origin, growing));
            let velocity = difference_free(stands, moves).map(|x| x.tangent);
            let [delta] = delta.data.0;
            let [grows] = grows.data.0;
            // As above: the logarithm is at zero.
            close(free_rate(delta, velocity), grows, 1e-8);
        }
    }
}

#[test]
fn a_rate_and_its_transposed_do_the_same_work() {
    let mut random = random_numbers(14);
    for angle in ANGLES.into_iter().filter(|angle| *angle < 5.0) {
        let [l, m, n] = rotation_vector(&mut random, angle);
        let [a, b, c] = std::array::from_fn(|_| random());
        let (v, p) = (random_vector::<6>(&mut random, 1.0), random_vector::<6>(&mut random, 1.0));
        let ([twist], [wrench]) = (v.data.0, p.data.0);
        let delta = [a, b, c, l, m, n];
        let by_rate = SVector::from(free_rate(delta, twist)).dot(&p);
        let by_force = SVector::from(free_rate_transposed(delta, wrench)).dot(&v);
        assert!((by_rate - by_force).abs() < 10.0 * ROUNDING, "{by_rate} and {by_force} at {angle}");
        let ([.., x, y, z], [.., i, j, k]) = (twist, wrench);
        let by_rate = SVector::from(ball_rate([l, m, n], [x, y, z])).dot(&SVector::from([i, j, k]));
        let by_force =
            SVector::from(ball_rate_transposed([l, m, n], [i, j, k])).dot(&SVector::from([x, y, z]));
        assert!((by_rate - by_force).abs() < 10.0 * ROUNDING, "{by_rate} and {by_force} at {angle}");
    }
}
