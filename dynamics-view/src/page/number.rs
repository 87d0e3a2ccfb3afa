//! Numbers as a book prints them.

use crate::text::power_of_ten;

/// A number to so many digits: `−0.0125`, `3`, `1.2·10⁻⁷`. Zeros at the end are left out.
#[must_use]
pub fn number(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return if value.is_nan() {
            "not a number"
        } else if value > 0.0 {
            "∞"
        } else {
            "−∞"
        }
        .to_owned();
    }
    let digits = digits.clamp(1, 17);
    let scientific = format!("{value:.*e}", digits - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let text = if (-4..6).contains(&exponent) {
        let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
        // The mantissa has been rounded already: its digits are those of the number.
        shortened(&format!("{:.decimals$}", scientific.parse::<f64>().unwrap_or(value)))
    } else {
        format!("{}·{}", shortened(mantissa), power_of_ten(exponent))
    };
    text.replacen('-', "−", 1)
}

/// Without zeros behind the last digit of a decimal fraction.
fn shortened(text: &str) -> String {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_have_so_many_digits() {
        let cases = [
            (0.0, "0"),
            (-0.0125, "−0.0125"),
            (3.0, "3"),
            (2.99999, "3"),
            (123_456.0, "123500"),
            (1.2e-7, "1.2·10⁻⁷"),
            (-9.8768e9, "−9.877·10⁹"),
            (f64::INFINITY, "∞"),
            (0.000_123_456, "0.0001235"),
        ];
        for (value, expected) in cases {
            assert_eq!(number(value, 4), expected);
        }
        assert_eq!(number(0.1 + 0.2, 17), "0.30000000000000004");
    }
}
