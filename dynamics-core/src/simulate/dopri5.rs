//! One step of the method of Dormand and Prince, in the chart of the state that it begins at.

use num_traits::Zero;

use super::flow::{Flow, Vector};
use super::segment::{Piece, Quartic};
use super::tolerances::{Part, Tolerances};
use crate::error::Error;
use crate::scalar::Scalar;

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
pub(super) struct Attempt<F: Flow> {
    /// Where it ends.
    pub(super) q: F::Position,
    pub(super) v: F::Velocity,
    /// The acceleration there, with which the next step begins.
    pub(super) acceleration: F::Velocity,
    /// The states on the way.
    pub(super) piece: Piece<F::Scalar, F::Position, F::Velocity>,
    /// Its error in units of the tolerances.
    pub(super) error: F::Scalar,
}

impl<F: Flow> Attempt<F> {
    /// `Ok` if it came to something finite.
    pub(super) fn check(&self) -> Result<(), Error> {
        Error::unless_all_finite("a", self.acceleration.entries())?;
        Error::unless_all_finite("q", self.q.entries())?;
        Error::unless_all_finite("v", self.v.entries())
    }
}

/// Where a step begins, and how it goes on from there.
pub(super) struct Start<'a, F: Flow> {
    pub(super) q: &'a F::Position,
    pub(super) v: &'a F::Velocity,
    pub(super) acceleration: &'a F::Velocity,
    /// The times of its start and end, in s.
    pub(super) times: [F::Scalar; 2],
    pub(super) step: F::Scalar,
}

/// Goes one step.
///
/// `q₀ ⊕ δ` is the configuration, so that `(δ, v)` is a vector, and the method the one of the textbook, with its
/// continuous extension of order 4.
///
/// # Source
///
/// E. Hairer, S. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, Springer 1993, §II.5 and II.6.
pub(super) fn attempt<F>(flow: &mut F, start: &Start<'_, F>, tolerances: &Tolerances<F::Scalar>) -> Attempt<F>
where
    F: Flow<Scalar: PartialOrd>,
{
    let Start { q, v, acceleration, times: [now, end], step } = *start;
    let mut rates: [F::Velocity; 7] = core::array::from_fn(|_| v.clone());
    let mut accelerations: [F::Velocity; 7] = core::array::from_fn(|_| acceleration.clone());
    let zero = v.times(F::Scalar::zero());
    let (mut way, mut last) = (zero.clone(), (q.clone(), v.clone()));
    for (k, (weights, time)) in STAGES.iter().zip(TIMES).enumerate().skip(1) {
        way = weighted(weights, &rates).times(step);
        last = (flow.integrate(q, &way), v.clone().plus(step, &weighted(weights, &accelerations)));
        if let (Some(rate), Some(acceleration)) = (rates.get_mut(k), accelerations.get_mut(k)) {
            *rate = flow.rate(&way, &last.1);
            let time = step.mul_add(F::Scalar::of(time), now);
            *acceleration = flow.acceleration(time, &last.0, &last.1);
        }
    }
    let [of_way, of_speed] = [&rates, &accelerations].map(|slopes| weighted(&ERROR, slopes).times(step));
    let error = tolerances.norm([
        Part { x: of_way.entries(), sizes: [zero.entries(), way.entries()] },
        Part { x: of_speed.entries(), sizes: [v.entries(), last.1.entries()] },
    ]);
    let piece = Piece {
        start: now,
        end,
        q: q.clone(),
        delta: extension([zero, way], &rates, step),
        v: extension([v.clone(), last.1.clone()], &accelerations, step),
    };
    let [.., acceleration] = accelerations;
    Attempt { q: last.0, v: last.1, acceleration, piece, error }
}

/// The continuous extension between two values.
fn extension<T: Scalar, V: Vector<T>>(ends: [V; 2], slopes: &[V; 7], step: T) -> Quartic<V> {
    let ([from, to], [first, .., last]) = (&ends, slopes);
    let way = to.clone().plus(-T::one(), from);
    let bow = first.times(step).plus(-T::one(), &way);
    let second = way.plus(-step, last).plus(-T::one(), &bow);
    Quartic { bows: [bow, second, weighted(&DENSE, slopes).times(step)], ends }
}

/// The sum of vectors, each times its weight.
fn weighted<T: Scalar, V: Vector<T>>(weights: &[f64], vectors: &[V; 7]) -> V {
    let mut terms = weights.iter().zip(vectors);
    let [first, ..] = vectors;
    let sum = terms.next().map_or_else(|| first.clone(), |(weight, first)| first.times(T::of(*weight)));
    terms
        .filter(|(weight, _)| **weight != 0.0)
        .fold(sum, |sum, (weight, vector)| sum.plus(T::of(*weight), vector))
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
