//! Rows of numbers in few letters: whole multiples of a quantum, as second differences, which are small.

use serde_json::{Value, json};

/// The row; a single number where all are equal.
///
/// `[x₀, x₁ − x₀, x₂ − 2x₁ + x₀, …]` in quanta: sums of integers give the rounded numbers back without drift.
pub(crate) fn row(values: impl IntoIterator<Item = f64>, quantum: f64) -> Value {
    let quanta: Vec<i64> = values.into_iter().map(|value| (value / quantum).round() as i64).collect();
    match quanta.first() {
        None => json!([]),
        Some(first) if quanta.iter().all(|x| x == first) => json!(first),
        Some(_) => {
            let back = |k: usize| k.checked_sub(1).map_or(0, |k| quanta[k]);
            let step = |k: usize| if k == 0 { 0 } else { back(k) - if k > 1 { quanta[k - 2] } else { 0 } };
            let second = |k: usize| match k {
                0 => quanta[0],
                1 => quanta[1] - quanta[0],
                k => quanta[k] - quanta[k - 1] - step(k),
            };
            json!((0..quanta.len()).map(second).collect::<Vec<i64>>())
        }
    }
}

/// A quantum for numbers up to `size`: so that they have about twenty thousand different values.
pub(crate) fn quantum(size: f64) -> f64 {
    if size > 1e-90 { 10_f64.powf((size / 2e4).log10().floor()) * 2.0 } else { 1.0 }
}

/// A row of numbers with a quantum of its own.
pub(crate) fn numbers(values: &[f64]) -> Value {
    let size = values.iter().fold(0.0, |size: f64, value| size.max(value.abs()));
    let quantum = quantum(size) / if values.len() > 2000 { 10.0 } else { 1.0 };
    json!({ "unit": quantum, "row": row(values.iter().copied(), quantum) })
}

/// A row of numbers from their smallest on: what is a constant but for rounding needs no more digits than others.
pub(crate) fn varying(values: &[f64]) -> [(&'static str, Value); 3] {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let size = (high - low).max(1e-6 * high.abs().max(low.abs()));
    let quantum = quantum(size);
    let row = row(values.iter().map(|value| value - low), quantum);
    [("from", json!(low)), ("unit", json!(quantum)), ("row", row)]
}

/// A number with four digits.
pub(crate) fn short(value: f64) -> Value {
    let text = format!("{value:.3e}");
    json!(text.parse::<f64>().map_or(0.0, |value| value + 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the page does.
    fn read(row: &Value, count: usize) -> Vec<i64> {
        let Some(list) = row.as_array() else { return vec![row.as_i64().expect("an integer"); count] };
        let (mut value, mut step) = (0, 0);
        let next = |(k, second): (usize, &Value)| {
            let second = second.as_i64().expect("an integer");
            match k {
                0 => value = second,
                1 => (step, value) = (second, value + second),
                _ => {
                    step += second;
                    value += step;
                }
            }
            value
        };
        list.iter().enumerate().map(next).collect()
    }

    #[test]
    fn rows_come_back() {
        for values in
            [vec![], vec![3.0], vec![1.0, 2.5], (0..50).map(|k| f64::from(k * k % 17) - 8.0).collect()]
        {
            let expected: Vec<i64> = values.iter().map(|x: &f64| (x / 0.5).round() as i64).collect();
            assert_eq!(read(&row(values.clone(), 0.5), values.len()), expected);
        }
        assert_eq!(row([0.25; 9], 0.25), json!(1));
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(short(0.123_456).to_string(), "0.1235");
        assert_eq!(short(-0.0).to_string(), "0.0");
    }
}
