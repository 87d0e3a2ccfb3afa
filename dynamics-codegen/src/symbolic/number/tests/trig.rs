//! Sine, cosine and arc tangent.

use super::{Number, Random, assert_relatively_close, distance, exact, n, pi_times};

#[test]
fn fractions_of_pi_have_rational_sines_where_there_are_any() {
    let half = Number::ratio(1, 2);
    for turn in [-4, -2, 0, 2, 6] {
        let at = |num, den| pi_times(num + turn * den, den);
        assert_eq!((at(0, 1).sin(), at(0, 1).cos()), (Number::ZERO, Number::ONE));
        assert_eq!((at(1, 2).sin(), at(1, 2).cos()), (Number::ONE, Number::ZERO));
        assert_eq!((at(1, 1).sin(), at(1, 1).cos()), (Number::ZERO, -Number::ONE));
        assert_eq!(
            (at(1, 6).sin(), at(5, 6).sin(), at(7, 6).sin(), at(11, 6).sin()),
            (half, half, -half, -half)
        );
        assert_eq!(
            (at(1, 3).cos(), at(2, 3).cos(), at(4, 3).cos(), at(5, 3).cos()),
            (half, -half, -half, half)
        );
        assert_eq!((at(1, 4).sin(), at(1, 4).cos(), at(3, 4).cos()), (root(2), root(2), -root(2)));
        assert_eq!((at(1, 3).sin(), at(1, 6).cos(), at(4, 3).sin()), (root(3), root(3), -root(3)));
        assert_eq!(at(1, 7).sin(), -at(-1, 7).sin());
    }
    fn root(of: i64) -> Number {
        Number::ratio(of, 4).sqrt().unwrap()
    }
}

#[test]
fn sines_and_angles_agree_with_forty_digits() {
    for (angle, sin, cos) in ANGLES {
        assert_relatively_close(n(angle).sin(), n(sin));
        assert_relatively_close(n(angle).cos(), n(cos));
    }
    for (num, den, sin, cos) in FRACTIONS {
        assert_relatively_close(pi_times(*num, *den).sin(), n(sin));
        assert_relatively_close(pi_times(*num, *den).cos(), n(cos));
    }
    for (y, x, angle) in POINTS {
        assert_relatively_close(Number::atan2(n(y), n(x)), n(angle));
    }
    assert!(!n("1e16").sin().is_finite() && !n("1e200").cos().is_finite());
    assert_eq!((Number::PI * n("1e16")).cos(), Number::ONE);
}

#[test]
fn sine_cosine_and_angle_belong_together() {
    let mut random = Random(6);
    for _ in 0..400 {
        let angle = Number::Exact(exact(random.signed(42), 1 << 40));
        let (sin, cos) = (angle.sin(), angle.cos());
        assert!(distance(sin * sin + cos * cos, Number::ONE) < 1e-31);
        if angle.abs().cmp_value(Number::PI).is_lt() {
            assert!(distance(Number::atan2(sin, cos), angle) < 2e-31, "{angle:?}");
        }
        // A float takes the other way of reduction.
        let float = angle + Number::PI;
        assert!(distance(float.sin(), -sin) < 2e-31 && distance(float.cos(), -cos) < 2e-31);
    }
}

#[test]
fn angles_on_axes_and_diagonals_are_exact() {
    let (one, zero) = (Number::ONE, Number::ZERO);
    for (y, x, num, den) in [
        (zero, zero, 0, 1),
        (zero, one, 0, 1),
        (one, one, 1, 4),
        (one, zero, 1, 2),
        (one, -one, 3, 4),
        (zero, -one, 1, 1),
        (-one, -one, -3, 4),
        (-one, zero, -1, 2),
        (-one, one, -1, 4),
    ] {
        assert_eq!(Number::atan2(y, x), pi_times(num, den));
        let scale = n("2").sqrt().unwrap();
        assert_eq!(Number::atan2(y * scale, x * scale), pi_times(num, den));
    }
    assert_eq!(Number::atan2(n("1"), n("2")), Number::atan2(n("0.3"), n("0.6")));
}

/// Angle in radians, its sine, its cosine.
const ANGLES: &[(&str, &str, &str)] = &[
    ("0.1", "0.09983341664682815230681419841062202698992", "0.9950041652780257660955619878038702948386"),
    ("0.3", "0.2955202066613395751053207456850273736778", "0.9553364891256060196423102275680498982442"),
    (
        "-0.7853981",
        "-0.7071067363577804937333408073871030282551",
        "0.7071068260153117130389973949802742073961",
    ),
    (
        "1.5707963267948966",
        "0.9999999999999999999999999999999998150781",
        "1.923132169163975144209858469968755172506e-17",
    ),
    (
        "1.0471975511965976",
        "0.8660254037844385736866159402063431198307",
        "0.5000000000000001265732625934656471860535",
    ),
    (
        "-3.141592653589793",
        "-2.384626433832795028841971693993728458138e-16",
        "-0.9999999999999999999999999999999715677839",
    ),
    ("2.5", "0.5984721441039564940518547021861622717036", "-0.8011436155469337148335027904673516644286"),
    ("100.25", "-0.2772828564548513033536720570194358868443", "0.9607883312760612034423445613620499861238"),
    (
        "-12345.678",
        "0.7040813137532989166408860188398848967129",
        "0.7101193587161447395014489233342456842695",
    ),
    ("1e-9", "9.999999999999999998333333333333333333417e-10", "0.9999999999999999995000000000000000000417"),
    ("1e12", "-0.6112387023768894981920204153246305664962", "0.7914463018528902700537662141143323039868"),
    (
        "123456789012345.125",
        "-0.4941212522301362863821939310826639171454",
        "0.8693929997961347951903660579803400795473",
    ),
    ("3e-200", "3.000000000000000000000000000000000000000e-200", "1.000000000000000000000000000000000000000"),
];

/// Numerator and denominator of a multiple of π, its sine, its cosine.
const FRACTIONS: &[(i64, i64, &str, &str)] = &[
    (1, 5, "0.5877852522924731291687059546390727685977", "0.8090169943749474241022934171828190588602"),
    (1, 8, "0.3826834323650897717284599840303988667613", "0.9238795325112867561281831893967882868224"),
    (3, 7, "0.9749279121818236070181316829939312172328", "0.2225209339563144042889025644967947594664"),
    (-5, 9, "-0.9848077530122080593667430245895230136706", "-0.1736481776669303488517166267693147960004"),
    (22, 7, "-0.4338837391175581204757683328483587546100", "-0.9009688679024191262361023195074450511659"),
    (1000001, 10, "0.3090169943749474241022934171828190588602", "0.9510565162951535721164393333793821434057"),
    (1, 12, "0.2588190451025207623488988376240483283491", "0.9659258262890682867497431997288973676339"),
    (-355, 113, "0.4303019735084223761236143890116165490013", "-0.9026850013126156776128262037012151777488"),
];

/// y, x and the angle of the point.
const POINTS: &[(&str, &str, &str)] = &[
    ("1", "2", "0.4636476090008061162142562314612144020285"),
    ("0.3", "-0.7", "2.736700867304709815150570454270060267645"),
    ("-5", "1e-3", "-1.570596326797563285833988360134989480448"),
    ("-2", "-2.000001", "-2.356194740192282428857399204126293048565"),
    ("1e-30", "1", "1.000000000000000000000000000000000000000e-30"),
    ("1e-30", "-1", "3.141592653589793238462643383278502884197"),
    ("0.414", "1", "0.3925167810483466558453910295487169729054"),
    ("7", "16.9", "0.3926885155652965947136595801778192158579"),
    ("1e300", "1e-9", "1.570796326794896619231321691639751442099"),
    ("123.456", "100", "0.8899843676212140721617323692929587787997"),
];
