//! Reading, writing and rounding to doubles.

use super::super::wide::power_of_two;
use super::{Number, Random, exact, n, pi_times};

#[test]
fn text_is_read_as_documented() {
    for (text, value) in [
        ("1_000.5", Number::ratio(2001, 2)),
        ("-2", Number::integer(-2)),
        ("+.5", Number::ratio(1, 2)),
        ("5.", Number::integer(5)),
        ("1e-3", Number::ratio(1, 1000)),
        ("1E+0_3", Number::integer(1000)),
        ("-0.0", Number::ZERO),
        ("0e-400", Number::ZERO),
        ("0e99999999999999999999", Number::ZERO),
        ("100000000000000000000e-20", Number::ONE),
        ("8.67361737988403547205962240695953369140625e-19", Number::from_f64(power_of_two(-60)).unwrap()),
    ] {
        assert_eq!(Number::parse_decimal(text), Some(value), "{text}");
    }
    for text in [
        "",
        ".",
        "-",
        "e5",
        "1e",
        "1e+",
        "_1",
        "1._5",
        "1.2.3",
        "--1",
        "0x10",
        " 1",
        "1 ",
        "1f64",
        "inf",
        "-infinity",
        "nan",
        "1e400",
        "1e309",
        "-1e400",
        "1e-400",
        "2e-324",
        "1e99999999999999999999",
        "1e-99999999999999999999",
        "١",
    ] {
        assert_eq!(Number::parse_decimal(text), None, "{text}");
    }
    assert!(matches!(n("1e30"), Number::Exact(_)) && matches!(n("1e39"), Number::Float(_)));
}

#[test]
fn doubles_are_those_of_the_standard_parser() {
    let mut random = Random(3);
    for round in 0..8000 {
        let (whole, fraction) = (random.below(22), random.below(if round % 50 == 0 { 900 } else { 24 }));
        let mut text = format!("-{}.{}", random.digits(whole + 1), random.digits(fraction));
        if round % 2 == 0 {
            let limit = if round % 8 == 0 { 330 } else { 30 };
            text += &format!("e{}", random.below(2 * limit) as i64 - limit as i64);
        }
        let double = text.parse::<f64>().unwrap();
        match Number::parse_decimal(&text) {
            Some(number) => assert_eq!(number.to_f64(), double, "{text}"),
            None => assert!(double == 0.0 || double.is_infinite(), "{text}"),
        }
    }
    // Ties, and what lies just beside them, in all sizes.
    for text in
        ["9007199254740993", "9007199254740993.00000000000000000001", "9007199254740992.99999999999999999999"]
    {
        for end in ["", "e-5", "e-30", "e10", "e100", "e-300"] {
            let text = format!("{text}{end}");
            assert_eq!(n(&text).to_f64(), text.parse::<f64>().unwrap(), "{text}");
        }
    }
    let near_tie = format!("9007199254740994.99999999{}e25", "9".repeat(60));
    assert_eq!(n(&near_tie).to_f64(), near_tie.parse::<f64>().unwrap());
}

#[test]
fn doubles_of_fractions_are_nearest() {
    let mut random = Random(4);
    for _ in 0..3000 {
        // A double, a bit of 2^-10 to 2^-60 of its last place more or less: it must come back.
        let mantissa = i128::from(random.next() >> 11 | 1 << 52);
        let extra = 1 + random.below(60);
        let near_half = (1 << (extra - 1)) - 1;
        for off in [0, near_half, -near_half] {
            let value = exact((mantissa << extra) + off, 1 << extra).checked_mul(exact(1, 1 << 7)).unwrap();
            assert_eq!(value.ratio_to_f64(), mantissa as f64 / 128.0);
            assert_eq!(value.neg().ratio_to_f64(), -mantissa as f64 / 128.0);
        }
    }
    assert_eq!(exact(i128::MAX, 1).ratio_to_f64(), power_of_two(127));
    assert_eq!(exact(1, i128::MAX).ratio_to_f64(), power_of_two(-127));
    assert_eq!(Number::ratio(i64::MAX, 3).to_f64(), 3.0744573456182584e18);
    assert_eq!(Number::PI.to_f64(), std::f64::consts::PI);
}

#[test]
fn doubles_survive() {
    let mut random = Random(5);
    for _ in 0..5000 {
        let double = f64::from_bits(random.next());
        match Number::from_f64(double) {
            Some(number) => assert_eq!(number.to_f64(), double),
            None => assert!(!double.is_finite()),
        }
    }
    assert_eq!(Number::from_f64(-0.0), Some(Number::ZERO));
    assert_eq!(Number::from_f64(0.5), Some(Number::ratio(1, 2)));
    assert_eq!(Number::from_f64(5e-324).unwrap().to_f64(), 5e-324);
}

#[test]
fn text_is_written_as_documented() {
    let text = |number: Number| (number.to_string(), number.exact_text());
    let pair = |a: &str, b: &str| (a.to_owned(), b.to_owned());
    assert_eq!(text(n("0.42")), pair("0.42", "21/50"));
    assert_eq!(text(Number::integer(-2)), pair("-2.0", "-2"));
    assert_eq!(text(pi_times(-1, 2)), pair("-1.5707963267948966", "-π/2"));
    assert_eq!(text(Number::PI * pi_times(3, 4)), pair("7.402203300817019", "3π²/4"));
    assert_eq!(text(Number::PI.recip()), pair("0.3183098861837907", "1/π"));
    assert_eq!(text((Number::PI * n("-1.5")).recip()), pair("-0.2122065907891938", "-2/(3π)"));
    assert_eq!(text(n("2").sqrt().unwrap()), pair("1.4142135623730951", "√2"));
    assert_eq!(text(n("-0.75").abs().sqrt().unwrap() / Number::PI).1, "√3/(2π)");
    assert_eq!(text(n("6.62607015e-34")).0, "6.62607015e-34");
}
