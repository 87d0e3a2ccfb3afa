//! What is written, and that it is read back.

use super::{Form, Matrix, Name, Notation, Role, math};
use crate::symbolic::{Number, SymbolId};

/// The symbols of the tests, by their names.
fn notation() -> Notation {
    let mut notation = Notation::new();
    for text in ["m1", "m2", "l", "r1", "g", "load", "s", "c"] {
        notation.add(Name::read(text), Role::Parameter);
    }
    for index in ["y2", "z1"] {
        notation.add(Name::indexed("I", index), Role::Parameter);
    }
    let angles = ["theta1", "theta2"].map(Name::read);
    for angle in &angles {
        notation.add(angle.clone(), Role::Coordinate);
    }
    for angle in &angles {
        notation.add(angle.dotted(), Role::Speed);
    }
    notation
}

fn symbol(k: u32) -> Form {
    Form::Symbol(SymbolId(k))
}

#[test]
fn names_are_written_in_three_ways() {
    let texts = |name: Name| (name.unicode(), name.latex());
    let pair = |a: &str, b: &str| (a.to_owned(), b.to_owned());
    assert_eq!(texts(Name::read("theta12")), pair("θ₁₂", "\\theta_{12}"));
    assert_eq!(texts(Name::read("m_1")), pair("m₁", "m_1"));
    assert_eq!(texts(Name::read("m_cart")), pair("m_cart", "m_{\\mathrm{cart}}"));
    assert_eq!(texts(Name::read("load")), pair("load", "\\mathrm{load}"));
    assert_eq!(texts(Name::read("link2")), pair("link₂", "\\mathrm{link}_2"));
    assert_eq!(texts(Name::read("ω")), pair("ω", "\\omega"));
    assert_eq!(texts(Name::read("pi")), pair("pi", "\\mathrm{pi}"));
    assert_eq!(texts(Name::read("a_b_c")), pair("a_b_c", "\\mathrm{a\\_b\\_c}"));
    assert_eq!(texts(Name::indexed("I", "y2")), pair("I_y₂", "I_{y_2}"));
    assert_eq!(texts(Name::indexed("I", "xy")), pair("I_xy", "I_{xy}"));
    let angle = Name::read("theta1");
    assert_eq!(texts(angle.dotted()), pair("θ\u{307}₁", "\\dot{\\theta}_1"));
    assert_eq!(texts(angle.dotted().dotted()), pair("θ\u{308}₁", "\\ddot{\\theta}_1"));
    let mathml = "<msub><mover accent=\"true\"><mi>θ</mi><mo>\u{2d9}</mo></mover><mn>1</mn></msub>";
    assert_eq!(angle.dotted().mathml(), mathml);
}

#[test]
fn no_two_symbols_have_one_name() {
    let mut notation = Notation::new();
    for text in ["m1", "m_1", "sin", "m1"] {
        notation.add(Name::read(text), Role::Parameter);
    }
    let names: Vec<_> = (0..4).map(|k| symbol(k).unicode(&notation)).collect();
    assert_eq!(names, ["m₁", "m₁′", "sin_", "m₁′′"]);
}

#[test]
fn numbers_are_written_as_people_write_them() {
    let notation = Notation::new();
    let ratio = |num, den| Form::number(Number::ratio(num, den));
    let pi = |num, den| Form::number(Number::PI * Number::ratio(num, den));
    let root = |of: i64, num, den| {
        Form::number(Number::integer(of).sqrt().unwrap_or(Number::NAN) * Number::ratio(num, den))
    };
    let cases = [
        (ratio(1, 2), "½", "\\frac{1}{2}"),
        (ratio(-3, 2), "−3/2", "-\\frac{3}{2}"),
        (ratio(7, 12), "7/12", "\\frac{7}{12}"),
        (ratio(981, 100), "9.81", "9.81"),
        (ratio(7, 20), "0.35", "0.35"),
        (ratio(1, 50), "0.02", "0.02"),
        (ratio(12, 1_000_000), "1.2·10⁻⁵", "1.2 \\cdot 10^{-5}"),
        (ratio(1, 1_000_000), "10⁻⁶", "10^{-6}"),
        (ratio(3_000_000_000, 1), "3·10⁹", "3 \\cdot 10^{9}"),
        (ratio(1200, 1), "1200", "1200"),
        (pi(1, 1), "π", "\\pi"),
        (pi(3, 4), "3π/4", "\\frac{3\\pi}{4}"),
        (Form::ONE.over(pi(2, 1)), "1/(2π)", "\\frac{1}{2\\pi}"),
        (Form::number(Number::PI * Number::PI), "π²", "\\pi^{2}"),
        (root(2, 1, 1), "√2", "\\sqrt{2}"),
        (root(3, -1, 2), "−√3/2", "-\\frac{\\sqrt{3}}{2}"),
        (root(12, 1, 1), "2√3", "2\\sqrt{3}"),
        (root(3, 1, 3), "√3/3", "\\frac{\\sqrt{3}}{3}"),
        (root(3, 1, 1).over(pi(2, 1)), "√3/(2π)", "\\frac{\\sqrt{3}}{2\\pi}"),
        (Form::product([root(3, 2, 9), pi(1, 1)]), "2π√3/9", "\\frac{2\\pi\\sqrt{3}}{9}"),
        // Nobody reads a root beside so many digits.
        (root(3, 317, 200), "2.7453", "2.7453"),
        (root(101, 1, 1), "10.0499", "10.0499"),
    ];
    for (form, unicode, latex) in cases {
        assert_eq!((form.unicode(&notation), form.latex(&notation)), (unicode.to_owned(), latex.to_owned()));
        assert_eq!(Form::parse_unicode(unicode, &notation), Ok(form.clone()));
        assert_eq!(Form::parse_latex(latex, &notation), Ok(form));
    }
}

#[test]
fn forms_are_written_as_people_write_them() {
    let notation = notation();
    let [m1, m2, l, r1, g, load] = [0, 1, 2, 3, 4, 5].map(symbol);
    let (iy2, a, b, rate) = (symbol(8), symbol(10), symbol(11), symbol(12));
    let sum = Form::sum([a.clone(), b.clone()]);
    let cases = [
        (
            Form::sum([
                Form::product([iy2, b.clone().sin().power(2)]),
                Form::product([m2.clone(), r1.clone().power(2), b.clone().cos().power(2)]),
            ]),
            "I_y₂ sin²θ₂ + m₂ r₁² cos²θ₂",
            "I_{y_2} \\sin^{2} \\theta_2 + m_2 r_1^{2} \\cos^{2} \\theta_2",
        ),
        (
            Form::product([m1.clone(), l.clone().power(2)]).over(Form::integer(3)),
            "m₁ l²/3",
            "\\frac{m_1 l^{2}}{3}",
        ),
        (
            Form::product([
                m1.clone().over(Form::integer(24)),
                Form::sum([l.clone(), r1.clone().negative()]),
            ]),
            "m₁/24 (l − r₁)",
            "\\frac{m_1}{24} \\left(l - r_1\\right)",
        ),
        (
            Form::product([Form::number(Number::ratio(1, 2)), m1.clone(), rate.clone().power(2)]),
            "½ m₁ θ\u{307}₁²",
            "\\frac{1}{2} \\, m_1 \\dot{\\theta}_1^{2}",
        ),
        // What is divided ends before the sine, or is in parentheses; a number before a bracket needs none.
        (
            Form::product([g.clone().over(l.clone()), a.clone().sin()]),
            "(g/l) sin θ₁",
            "\\frac{g}{l} \\sin \\theta_1",
        ),
        (
            Form::product([g.clone().over(l.clone()), sum.clone()]),
            "(g/l) (θ₁ + θ₂)",
            "\\frac{g}{l} \\left(\\theta_1 + \\theta_2\\right)",
        ),
        (
            Form::product([Form::integer(2), a.clone().cos().power(2)]).over(l.clone()),
            "(2 cos²θ₁)/l",
            "\\frac{2 \\, \\cos^{2} \\theta_1}{l}",
        ),
        (
            Form::product([m1.clone(), rate.clone().power(2)]).over(l.clone().power(2)),
            "m₁ θ\u{307}₁²/l²",
            "\\frac{m_1 \\dot{\\theta}_1^{2}}{l^{2}}",
        ),
        (
            Form::product([l.clone(), b.clone()]).over(Form::number(Number::integer(2) * Number::PI)),
            "l θ₂/(2π)",
            "\\frac{l \\theta_2}{2\\pi}",
        ),
        (
            Form::product([Form::number(Number::ratio(1, 16)), m1.clone(), rate.clone()]),
            "1/16 m₁ θ\u{307}₁",
            "\\frac{1}{16} \\, m_1 \\dot{\\theta}_1",
        ),
        (
            Form::product([g.clone().negative(), sum.clone().cos(), load]),
            "−g cos(θ₁ + θ₂) load",
            "-g \\cos\\left(\\theta_1 + \\theta_2\\right) \\mathrm{load}",
        ),
        (Form::product([Form::integer(2), b.clone()]).cos().power(2), "cos² 2θ₂", "\\cos^{2} 2\\theta_2"),
        (g.clone().over(Form::product([l.clone(), m1.clone()])).negative(), "−g/(l m₁)", "-\\frac{g}{l m_1}"),
        (
            Form::sum([m1.clone(), Form::sum([l.clone(), g.clone()]).negative()]),
            "m₁ − (l + g)",
            "m_1 - \\left(l + g\\right)",
        ),
        (
            Form::sum([l.clone().power(2), g.power(2)]).root().over(a.sin()),
            "√(l² + g²)/(sin θ₁)",
            "\\frac{\\sqrt{l^{2} + g^{2}}}{\\sin \\theta_1}",
        ),
    ];
    for (form, unicode, latex) in cases {
        assert_eq!(form.unicode(&notation), unicode);
        assert_eq!(form.latex(&notation), latex);
        assert_eq!(Form::parse_unicode(unicode, &notation), Ok(form.clone()));
        assert_eq!(Form::parse_latex(latex, &notation), Ok(form));
    }
}

#[test]
fn what_is_no_form_is_refused() {
    let notation = notation();
    for text in ["", "m₁ +", "m₁ + )", "(m₁", "m₁₁", "sin", "x", "m₁/", "θ₁\u{307}", "m₁⁹⁹⁹⁹"]
    {
        assert!(Form::parse_unicode(text, &notation).is_err(), "{text}");
    }
    for text in ["", "\\frac{m_1}", "\\left(m_1", "m_1^{}", "\\sin", "\\thetax"] {
        assert!(Form::parse_latex(text, &notation).is_err(), "{text}");
    }
    let deep = "(".repeat(100_000);
    assert!(Form::parse_unicode(&deep, &notation).is_err());
}

#[test]
fn matrices_are_aligned() {
    let notation = notation();
    let [m1, m2, rate] = [0, 1, 12].map(symbol);
    let matrix = Matrix::symmetric(vec![
        vec![Form::product([m1.clone(), rate]), Form::ZERO],
        vec![Form::sum([m1, m2.clone()])],
    ]);
    assert_eq!(matrix.unicode(&notation), ["⎡m₁ θ\u{307}₁     0   ⎤", "⎣  0    m₁ + m₂⎦"]);
    assert_eq!(matrix.unicode_entries("M", &notation), ["M₁₁ = m₁ θ\u{307}₁", "M₂₂ = m₁ + m₂"]);
    assert_eq!(
        matrix.latex(&notation),
        "\\begin{bmatrix} m_1 \\dot{\\theta}_1 & 0 \\\\ 0 & m_1 + m_2 \\end{bmatrix}"
    );
    let column = Matrix::vector(vec![m2]);
    assert_eq!(column.unicode(&notation), ["[m₂]"]);
    let xml = math(&matrix.mathml(&notation));
    let document = roxmltree::Document::parse(&xml).expect("MathML is XML");
    let cells = document.descendants().filter(|node| node.has_tag_name("mtd"));
    assert_eq!(
        document.descendants().filter(|node| node.tag_name().name() == "mtd").count(),
        4,
        "{}",
        cells.count()
    );
}
