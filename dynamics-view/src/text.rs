//! Text in a picture: how wide it is, and how numbers are written.

/// The size of all text but titles, in pixels.
pub(crate) const SIZE: f64 = 12.0;

/// About how wide a text is, in pixels. Which font shows it is not known here: this is the widest of the usual ones.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    let em = |c: char| match c {
        'i' | 'j' | 'l' | '|' | '\'' | '.' | ',' | ':' | ';' | '!' => 0.33,
        'f' | 't' | 'r' | 'I' | ' ' | '(' | ')' | '[' | ']' | '/' | '-' | '_' | '"' => 0.43,
        'm' | 'w' | 'M' | 'W' | '%' | '@' => 0.98,
        '⁰' | '¹' | '²' | '³' | '⁴'..='⁹' | '⁻' => 0.42,
        '\u{2e80}'.. => 1.05,
        c if c.is_uppercase() => 0.74,
        _ => 0.64,
    };
    text.chars().map(em).sum::<f64>() * size
}

/// The text, cut where it would be wider than `most` pixels.
pub(crate) fn shortened(text: &str, size: f64, most: f64) -> String {
    if width(text, size) <= most {
        return text.to_owned();
    }
    let mut short = String::new();
    for c in text.chars() {
        if width(&short, size) + 1.7 * size > most {
            break;
        }
        short.push(c);
    }
    short + "…"
}

/// A number with so many decimals, and a proper minus sign; never "−0".
pub(crate) fn number(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|b| matches!(b, b'0' | b'.')) => digits.to_owned(),
        Some(digits) => format!("−{digits}"),
        None => text,
    }
}

/// `10⁻⁹`
pub(crate) fn power_of_ten(exponent: i32) -> String {
    let digit = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        c => char::from_u32(c as u32 - '0' as u32 + '⁰' as u32).unwrap_or(c),
    };
    format!("10{}", exponent.to_string().chars().map(digit).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_in_print() {
        assert_eq!(number(-1.25, 1), "−1.2");
        assert_eq!(number(-0.001, 2), "0.00");
        assert_eq!(number(3.0, 0), "3");
        assert_eq!(power_of_ten(-12), "10⁻¹²");
        assert_eq!(power_of_ten(3), "10³");
    }

    #[test]
    fn a_long_name_is_cut_to_fit() {
        let name = "the_last_link_of_a_very_long_arm";
        let short = shortened(name, SIZE, 90.0);
        assert!(short.ends_with('…') && width(&short, SIZE) <= 90.0, "{short}");
        assert_eq!(shortened("elbow", SIZE, 90.0), "elbow");
    }
}
