//! Sines and cosines of a robot's angles, in lanes.
//!
//! By name, since compilers find no lanes within a long function. One by one these are a third of an arm's inverse
//! dynamics, and nine tenths of its gravity forces.

use super::{f32x4, f64x2, f64x4};
use crate::scalar::Scalar;
use crate::trigonometry::{COSINE, SINE, of_halves, reduced_double};

/// So many angles are computed at a time: with more, the first of them would wait for the last.
const TOGETHER: usize = 4;

macro_rules! sines_and_cosines {
    ($float:ident, $write:ident) => {
        /// The sines, then the cosines, each with the bits of the scalar.
        #[inline(always)]
        pub(crate) fn $float<const N: usize>(angles: [$float; N]) -> [[$float; N]; 2] {
            let [mut sines, mut cosines] = [angles; 2];
            if N <= TOGETHER {
                $write(&angles, &mut sines, &mut cosines);
            } else {
                let results = sines.chunks_mut(TOGETHER).zip(cosines.chunks_mut(TOGETHER));
                for (angles, (sines, cosines)) in angles.chunks(TOGETHER).zip(results) {
                    $write(angles, sines, cosines);
                }
            }
            [sines, cosines]
        }
    };
}

sines_and_cosines!(f64, write_f64);
sines_and_cosines!(f32, write_f32);

/// Writes both for as many angles as there are lanes, or fewer.
macro_rules! write_lanes {
    ($lanes:ident, $count:literal, $angles:expr, $sines:expr, $cosines:expr) => {{
        let mut lanes = [0.0; $count];
        for (lane, angle) in lanes.iter_mut().zip($angles) {
            *lane = *angle;
        }
        let (sines, cosines) = $lanes::from(lanes).sin_cos();
        for (sine, value) in $sines.iter_mut().zip(sines.to_array()) {
            *sine = value;
        }
        for (cosine, value) in $cosines.iter_mut().zip(cosines.to_array()) {
            *cosine = value;
        }
    }};
}

#[inline(always)]
fn write_f64(angles: &[f64], sines: &mut [f64], cosines: &mut [f64]) {
    match angles.len() {
        0..=2 => write_lanes!(f64x2, 2, angles, sines, cosines),
        _ => write_lanes!(f64x4, 4, angles, sines, cosines),
    }
}

#[inline(always)]
fn write_f32(angles: &[f32], sines: &mut [f32], cosines: &mut [f32]) {
    write_lanes!(f32x4, 4, angles, sines, cosines);
}

/// `(sin x, cos x)`: the two polynomials side by side, with the bits of [`sin_cos_f64`](crate::trigonometry::sin_cos_f64).
#[inline(always)]
pub(crate) fn pair(x: f64) -> (f64, f64) {
    let (turns, r) = reduced_double(x);
    let z = r * r;
    let both = |k: usize| match (SINE.get(k), COSINE.get(k)) {
        (Some(sine), Some(cosine)) => f64x2::from([*sine, *cosine]),
        _ => f64x2::from(0.0),
    };
    let [z_twice, z2_twice] = [z, z * z].map(f64x2::from);
    let linear = |k: usize| z_twice.mul_add(both(2 * k + 1), both(2 * k));
    let sum = z2_twice.mul_add(z2_twice.mul_add(linear(2), linear(1)), linear(0));
    f64x2::from([r * z, z * z]).mul_add(sum, f64x2::from([r, of_halves(z)])).turned_apart(turns)
}
