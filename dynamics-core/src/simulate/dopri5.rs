//! One step of the method of Dormand and Prince, in the chart of the state that it begins at.

use nalgebra::SVector;

use super::segment::{Quartic, Segment};
use super::tolerances::{Part, Tolerances};
use crate::dynamics::Dynamics;
use crate::scalar::Scalar;
use crate::state::{Configuration, State};

/// The times of the stages, in steps.
const TIMES: [f64; 7] = [0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];

/// What each stage takes of those before it; the last row is the result.
const STAGES: [[f64; 6]; 7] = [
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];

/// The result of order 5 less that of order 4.
const ERROR: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];

/// The last coefficient of the continuous extension.
const DENSE: [f64; 7] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    0.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];

/// What a step came to.
pub(super) struct Attempt<T, const NQ: usize, const NV: usize> {
    /// The state at its end.
    pub(super) state: State<T, NQ, NV>,
    /// The acceleration there, with which the next step begins.
    pub(super) acceleration: SVector<T, NV>,
    /// The states on the way.
    pub(super) segment: Segment<T, NQ, NV>,
    /// Its error in units of the tolerances.
    pub(super) error: T,
}

/// Where a step begins, and how it goes on from there.
pub(super) struct Start<'a, T, const NQ: usize, const NV: usize> {
    pub(super) state: &'a State<T, NQ, NV>,
    pub(super) acceleration: SVector<T, NV>,
    /// The times of its start and end, in s.
    pub(super) times: [T; 2],
    pub(super) step: T,
}

/// Goes one step.
///
/// `q₀ ⊕ δ` is the configuration, so that `(δ, v)` is a vector, and the method the one of the textbook, with its
/// continuous extension of order 4.
///
/// # Source
///
/// E. Hairer, S. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, Springer 1993, §II.5 and II.6.
pub(super) fn attempt<R, T, const NQ: usize, const NV: usize>(
    robot: &R,
    start: &Start<'_, T, NQ, NV>,
    tolerances: &Tolerances<T>,
    mut input: impl FnMut(T, &State<T, NQ, NV>) -> SVector<T, NV>,
) -> Attempt<T, NQ, NV>
where
    R: Dynamics<T, NQ, NV> + Configuration<T, NQ, NV>,
    T: Scalar + PartialOrd,
{
    let Start { state: State { q, v }, acceleration, times: [now, end], step } = *start;
    let mut rates = [*v; 7];
    let mut accelerations = [acceleration; 7];
    let (mut way, mut last) = (SVector::zeros(), *start.state);
    for (k, (weights, time)) in STAGES.iter().zip(TIMES).enumerate().skip(1) {
        way = weighted(weights, &rates) * step;
        last = State { q: robot.integrate(q, &way), v: v + weighted(weights, &accelerations) * step };
        let tau = input(step.mul_add(T::of(time), now), &last);
        if let (Some(rate), Some(acceleration)) = (rates.get_mut(k), accelerations.get_mut(k)) {
            *rate = robot.rate(&way, &last.v);
            *acceleration = robot.forward_dynamics(&last.q, &last.v, &tau);
        }
    }
    let errors = [&rates, &accelerations].map(|slopes| weighted(&ERROR, slopes) * step);
    let [of_way, of_speed] = &errors;
    let zero = SVector::zeros();
    let error = tolerances
        .norm([Part { x: of_way, sizes: [&zero, &way] }, Part { x: of_speed, sizes: [v, &last.v] }]);
    let segment = Segment {
        start: now,
        end,
        q: *q,
        delta: extension([zero, way], &rates, step),
        v: extension([*v, last.v], &accelerations, step),
    };
    Attempt { state: last, acceleration: accelerations[6], segment, error }
}

/// The continuous extension between two values.
fn extension<T: Scalar, const N: usize>(
    ends: [SVector<T, N>; 2],
    slopes: &[SVector<T, N>; 7],
    step: T,
) -> Quartic<T, N> {
    let way = ends[1] - ends[0];
    let bow = slopes[0] * step - way;
    Quartic { ends, bows: [bow, way - slopes[6] * step - bow, weighted(&DENSE, slopes) * step] }
}

/// The sum of vectors, each times its weight.
fn weighted<T: Scalar, const N: usize>(weights: &[f64], vectors: &[SVector<T, N>; 7]) -> SVector<T, N> {
    let mut sum = SVector::zeros();
    for (weight, vector) in weights.iter().zip(vectors) {
        if *weight != 0.0 {
            sum += vector * T::of(*weight);
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The conditions of order 5 that sums of one product show, and the consistency of each stage.
    #[test]
    fn the_coefficients_are_consistent() {
        const ROUNDING: f64 = 1e-15;
        for (stage, time) in STAGES.iter().zip(TIMES) {
            assert!((stage.iter().sum::<f64>() - time).abs() < ROUNDING, "{time}");
        }
        let moment = |weights: &[f64], power: i32| -> f64 {
            weights.iter().zip(TIMES).map(|(weight, time)| weight * time.powi(power)).sum()
        };
        for power in 0..5 {
            assert!((moment(&STAGES[6], power) - 1.0 / f64::from(power + 1)).abs() < ROUNDING, "{power}");
        }
        for power in 0..4 {
            assert!(moment(&ERROR, power).abs() < ROUNDING, "{power}");
            assert!(power == 3 || moment(&DENSE, power).abs() < 20.0 * ROUNDING, "{power}");
        }
    }
}
