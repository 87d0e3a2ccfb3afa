//! Every operation on lanes gives, in each, the bits that it gives on one float.
#![cfg(feature = "simd")]

use dynamics_core::lanes::{Lanes, f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};
use dynamics_core::scalar::Scalar;
use dynamics_core::trigonometry::{sin_cos_f32, sin_cos_f64};

/// Arguments of every size and sign, and what is no number.
fn arguments() -> impl Iterator<Item = f64> {
    let sizes = (-330..310).step_by(7).map(|k| 1.234_567 * power_of_ten(k));
    let special = [0.0, 1e4, 1_048_576.0, 562_949_953_421_312.0, f64::INFINITY, f64::NAN];
    let turns = (0..2000).map(|k| f64::from(k) * core::f64::consts::FRAC_PI_4);
    sizes.chain(special).chain(turns).flat_map(|x| [x, -x])
}

fn power_of_ten(k: i32) -> f64 {
    (0..k.abs()).fold(1.0, |x, _| if k > 0 { x * 10.0 } else { x / 10.0 })
}

macro_rules! agrees_with_one_float {
    ($test:ident, $lanes:ident, $float:ident) => {
        #[test]
        fn $test() {
            let all: Vec<$float> = arguments().map(|x| x as $float).collect();
            for window in all.windows(<$lanes as Lanes>::COUNT + 2) {
                let [x, y, z] = [0, 1, 2].map(|k| *window[k..].first_chunk().expect("a window holds it"));
                let [a, b, c] = [x, y, z].map($lanes::from);
                let check = |what: &str, found: $lanes, expected: fn($float, $float, $float) -> $float| {
                    for (k, found) in found.to_array().into_iter().enumerate() {
                        let expected = expected(x[k], y[k], z[k]);
                        let same = found.to_bits() == expected.to_bits();
                        let both_nan = found.is_nan() && expected.is_nan();
                        assert!(same || both_nan, "{what} of {}: {found:?}, {expected:?}", x[k]);
                    }
                };
                check("sum", a + b, |x, y, _| x + y);
                check("difference", a - b, |x, y, _| x - y);
                check("product", a * b, |x, y, _| x * y);
                check("quotient", a / b, |x, y, _| x / y);
                check("negative", -a, |x, _, _| -x);
                check("fused", Scalar::mul_add(a, b, c), |x, y, z| Scalar::mul_add(x, y, z));
                check("root", Scalar::sqrt(a), |x, _, _| Scalar::sqrt(x));
                check("sine", Scalar::sin_cos(a).0, |x, _, _| Scalar::sin_cos(x).0);
                check("cosine", Scalar::sin_cos(a).1, |x, _, _| Scalar::sin_cos(x).1);
                let finite = x.iter().all(|x| x.is_finite());
                assert_eq!(Scalar::is_finite(a), finite);
                assert_eq!(a == a, !x.iter().any(|x| x.is_nan()));
            }
        }
    };
}

agrees_with_one_float!(f64x2_agrees_with_f64, f64x2, f64);
agrees_with_one_float!(f64x4_agrees_with_f64, f64x4, f64);
agrees_with_one_float!(f64x8_agrees_with_f64, f64x8, f64);
agrees_with_one_float!(f32x4_agrees_with_f32, f32x4, f32);
agrees_with_one_float!(f32x8_agrees_with_f32, f32x8, f32);
agrees_with_one_float!(f32x16_agrees_with_f32, f32x16, f32);

/// Angles by the number: alone, side by side, and more than are computed at a time.
macro_rules! each_is_what_it_is_alone {
    ($float:ident, $kernel:ident, $($n:literal)*) => {$(
        let all: Vec<$float> = arguments().map(|x| x as $float).collect();
        for angles in all.windows($n) {
            let angles: [$float; $n] = *angles.first_chunk().expect("a window holds it");
            let [sines, cosines] = Scalar::sin_cos_each(angles);
            for ((x, s), c) in angles.into_iter().zip(sines).zip(cosines) {
                for (sin, cos) in [$kernel(x), Scalar::sin_cos(x)] {
                    let same = (s.to_bits(), c.to_bits()) == (sin.to_bits(), cos.to_bits());
                    assert!(same || (s.is_nan() && sin.is_nan() && c.is_nan() && cos.is_nan()), "{x:e} among {}", $n);
                }
            }
        }
    )*};
}

#[test]
fn sines_side_by_side_have_the_bits_of_the_kernel() {
    each_is_what_it_is_alone!(f64, sin_cos_f64, 1 2 3 4 5 6 7 8 9);
    each_is_what_it_is_alone!(f32, sin_cos_f32, 1 2 3 4 5 6 7 8 9);
}

/// For every number of states up to more than there are lanes.
macro_rules! rows_become_lanes_and_rows_again {
    ($lanes:ident, $float:ident, $($n:literal)*) => {$(
        for count in 0..2 * <$lanes as Lanes>::COUNT {
            let entry = |k: usize, i: usize| (100 * k + i) as $float;
            let rows: Vec<[$float; $n]> =
                (0..count).map(|k| std::array::from_fn(|i| entry(k, i))).collect();
            let lanes: [$lanes; $n] = Lanes::gather(&rows, |row| row);
            for (i, lanes) in lanes.iter().enumerate() {
                let expected = |k: usize| rows.get(k).or(rows.last()).map_or(0.0, |row| row[i]);
                assert_eq!(lanes.to_array(), std::array::from_fn(expected), "{count} rows of {}", $n);
            }
            let mut back = vec![[7.0; $n]; count];
            Lanes::scatter(&lanes, &mut back, |row| row);
            let written = count.min(<$lanes as Lanes>::COUNT);
            assert_eq!(back[..written], rows[..written]);
            assert!(back[written..].iter().flatten().all(|x| *x == 7.0));
        }
    )*};
}

#[test]
fn rows_of_every_length_become_lanes_and_rows_again() {
    rows_become_lanes_and_rows_again!(f64x2, f64, 0 1 2 3 4 5 7 8 9);
    rows_become_lanes_and_rows_again!(f64x4, f64, 0 1 2 3 4 5 7 8 9);
    rows_become_lanes_and_rows_again!(f64x8, f64, 0 1 2 3 4 5 7 8 9);
    rows_become_lanes_and_rows_again!(f32x4, f32, 0 1 2 3 4 5 7 8 9);
    rows_become_lanes_and_rows_again!(f32x8, f32, 0 1 2 3 4 5 7 8 9);
    rows_become_lanes_and_rows_again!(f32x16, f32, 0 1 2 3 4 5 7 8 9);
}
