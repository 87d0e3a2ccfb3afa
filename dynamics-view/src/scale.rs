//! From numbers to pixels, and the ticks between.

use crate::text;

/// An interval of numbers, laid over an interval of pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    /// The numbers at both ends.
    pub(crate) numbers: [f64; 2],
    /// Where these are.
    pub(crate) pixels: [f64; 2],
}

impl Scale {
    /// The place of a number.
    pub(crate) fn at(&self, number: f64) -> f64 {
        let ([low, high], [from, to]) = (self.numbers, self.pixels);
        from + (number - low) / (high - low) * (to - from)
    }
}

/// A smallest interval about some numbers, which is one.
///
/// Numbers that differ by rounding alone are taken for one: the picture of a constant is a line, and no noise.
pub(crate) fn range(numbers: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    let low = numbers.clone().fold(f64::INFINITY, f64::min);
    let high = numbers.fold(f64::NEG_INFINITY, f64::max);
    let size = low.abs().max(high.abs());
    if high - low > 1e-9 * size && high - low > 1e-90 {
        return [low, high];
    }
    let middle = low / 2.0 + high / 2.0;
    let half = if size > 1e-90 { 0.1 * size } else { 1.0 };
    [middle - half, middle + half]
}

/// An interval with so much of its length beyond both ends.
pub(crate) fn padded([low, high]: [f64; 2], part: f64) -> [f64; 2] {
    let more = part * (high - low);
    [low - more, high + more]
}

/// Round numbers on an axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ticks {
    /// The numbers, increasing.
    pub(crate) values: Vec<f64>,
    /// What is written at them, in units of the power.
    pub(crate) labels: Vec<String>,
    /// The power of ten in the unit; 0 where numbers are written as they are.
    pub(crate) power: i32,
}

impl Ticks {
    /// About `wanted` ticks within an interval, at multiples of 1, 2 or 5 times a power of ten.
    pub(crate) fn within([low, high]: [f64; 2], wanted: f64) -> Self {
        let rough = (high - low) / wanted.max(1.0);
        let decade = 10_f64.powi(rough.log10().floor() as i32);
        let steps = [10.0, 5.0, 2.0, 1.0, 0.5].map(|factor| factor * decade);
        // Multiples are counted: adding the step would add its rounding.
        let ends = |step: f64| ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
        // One tick is no scale: then the next finer step.
        let chosen = steps.iter().rposition(|step| *step >= 0.75 * rough).unwrap_or(0);
        let has_two = |step: f64| ends(step).0 < ends(step).1;
        let step =
            if has_two(steps[chosen]) { steps[chosen] } else { steps[(chosen + 1).min(steps.len() - 1)] };
        let (first, last) = ends(step);
        let count = (last - first).clamp(0.0, 1000.0) as u32;
        let values: Vec<f64> = (0..=count).map(|k| (first + f64::from(k)) * step).collect();

        let size = low.abs().max(high.abs());
        let is_plain = (1e-3..1e5).contains(&size) && step >= 0.9e-4;
        let power = if is_plain { 0 } else { 3 * (size.log10() / 3.0).floor() as i32 };
        let unit = 10_f64.powi(power);
        let decimals = (0.01 - (step / unit).log10().floor()).clamp(0.0, 15.0) as usize;
        let labels = values.iter().map(|value| text::number(value / unit, decimals)).collect();
        Self { values, labels, power }
    }

    /// A unit with the power of ten before it.
    pub(crate) fn unit(&self, unit: &str) -> String {
        match (self.power, unit) {
            (0, unit) => unit.to_owned(),
            (power, "") => format!("in {}", text::power_of_ten(power)),
            (power, unit) => format!("{} {unit}", text::power_of_ten(power)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within() {
        let ticks = Ticks::within([-0.93, 1.04], 5.0);
        assert_eq!(ticks.labels, ["−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(Ticks::within([0.0, 10.0], 5.0).labels, ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(Ticks::within([-4.4, 4.2], 3.0).labels, ["−4", "−2", "0", "2", "4"], "not zero alone");
        assert_eq!(Ticks::within([0.0, 0.3], 3.0).labels, ["0.0", "0.1", "0.2", "0.3"]);
    }

    #[test]
    fn large_and_small_numbers_have_a_power_in_their_unit() {
        let small = Ticks::within([-2e-12, 3e-12], 3.0);
        assert_eq!((small.power, small.unit("J")), (-12, "10⁻¹² J".to_owned()));
        assert_eq!(small.labels, ["−2", "0", "2"]);
        let large = Ticks::within([0.0, 2.5e7], 3.0);
        assert_eq!(large.unit("N"), "10⁶ N");
        assert_eq!(large.labels, ["0", "10", "20"]);
    }

    /// From the smallest numbers to the largest ones there is something to read.
    #[test]
    fn no_interval_is_without_ticks() {
        for exponent in -90..=100 {
            let size = 10_f64.powi(exponent);
            let intervals =
                [[-size, size], [0.0, 0.37 * size], [0.91 * size, 1.03 * size], [-0.41 * size, 0.37 * size]];
            for (interval, wanted) in
                intervals.into_iter().flat_map(|interval| [(interval, 5.0), (interval, 3.0)])
            {
                let ticks = Ticks::within(range(interval.into_iter()), wanted);
                assert!((2..=12).contains(&ticks.values.len()), "{interval:?}: {ticks:?}");
                let mut labels = ticks.labels.clone();
                labels.dedup();
                assert_eq!(labels, ticks.labels, "{interval:?}");
            }
        }
    }

    #[test]
    fn a_constant_is_in_the_middle() {
        assert_eq!(range([0.0; 3].into_iter()), [-1.0, 1.0]);
        assert_eq!(range([-5.0].into_iter()), [-5.5, -4.5]);
        let [low, high] = range([7.0, 7.0 + 1e-13].into_iter());
        assert!(low < 6.5 && high > 7.5);
    }
}
