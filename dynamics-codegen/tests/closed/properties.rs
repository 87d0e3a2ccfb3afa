//! What holds for every expression: the normal form has its value, is its own normal form, and is read back.

use std::cell::Cell;

use dynamics_codegen::closed::{Form, Limits, Name, Notation, Role, close, evaluate, expression, math};
use dynamics_codegen::symbolic::{Evaluator, Expr, Graph, Number, SymbolId};

use super::field::{Point, Random};

const EXPRESSIONS: u64 = 300;

/// Of what is read back, brackets are multiplied out once more: that may take more.
const SMALL: Limits = Limits { work: 6_000, ..Limits::READABLE };
const GENEROUS: Limits = Limits { work: 10 * SMALL.work, ..Limits::READABLE };

/// Expressions of a dozen operations on numbers of the size of one, rounded by 1e-16 each, and what cancels.
const ROUNDING: f64 = 1e-9;

fn notation() -> Notation {
    let mut notation = Notation::new();
    for (rank, text) in ["m1", "m2", "l", "g"].iter().enumerate() {
        let symbol = notation.add(Name::read(text), Role::Parameter);
        notation.set_rank(symbol, rank as u8);
    }
    let angles = ["theta1", "theta2"].map(Name::read);
    for angle in &angles {
        notation.add(angle.clone(), Role::Coordinate);
    }
    notation.add(Name::read("x"), Role::Coordinate);
    for angle in &angles {
        notation.add(angle.dotted(), Role::Speed);
    }
    notation
}

/// Random numbers for choices.
impl Random {
    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }
}

/// A random expression: sums, products and quotients of symbols, fractions, and sines of multiples of angles.
fn expr<'g>(graph: &'g Graph, notation: &Notation, random: &mut Random) -> Expr<'g> {
    let symbol = |k: usize| {
        let id = SymbolId(u32::try_from(k).unwrap());
        match notation.letter(id).role {
            Role::Parameter => graph.symbol(id),
            _ => graph.variable(id),
        }
    };
    let number = |random: &mut Random| {
        let (num, den) = (random.below(13) as i64 - 6, 1 + random.below(4) as i64);
        Expr::Constant(Number::ratio(num, den))
    };
    let mut pool: Vec<Expr<'g>> = (0..notation.len()).map(symbol).collect();
    for _ in 0..4 {
        let multiple = |random: &mut Random| {
            let times = [0, 1, 1, -1, 2][random.below(5)];
            Expr::from(times)
                * if random.below(4) == 0 { Expr::Constant(Number::ratio(1, 2)) } else { Expr::ONE }
        };
        let angle = multiple(random) * symbol(4) + multiple(random) * symbol(5);
        pool.push(if random.below(2) == 0 { angle.sin() } else { angle.cos() });
    }
    for _ in 0..10 {
        let (a, b) = (pool[random.below(pool.len())], pool[random.below(pool.len())]);
        let next = match random.below(8) {
            0..3 => a + b,
            3 => a - b,
            4 => number(random) * a,
            5 => a / symbol(random.below(4)),
            _ => a * b,
        };
        pool.push(next);
    }
    pool[pool.len() - 1] + pool[pool.len() - 2] * pool[pool.len() - 3]
}

/// Each random expression with its form.
fn for_each(check: impl Fn(&Graph, &Notation, Expr<'_>, &Form)) {
    let mut tried = 0;
    for seed in 0..EXPRESSIONS {
        let (graph, mut notation, mut random) = (Graph::new(), notation(), Random(seed));
        let expr = expr(&graph, &notation, &mut random);
        let Ok(closed) = close(&graph, &mut notation, &[expr], SMALL) else { continue };
        if closed.definitions.is_empty() {
            tried += 1;
            check(&graph, &notation, expr, &closed.forms[0]);
        }
    }
    assert!(tried > EXPRESSIONS / 2, "most are short enough: {tried}");
}

#[test]
fn a_form_has_the_value_of_its_expression() {
    for_each(|graph, notation, expr, form| {
        let point = Point::new(notation, 0xF1E1D);
        let values = point.exprs(graph, &[expr]).unwrap();
        assert_eq!(point.form(form).unwrap().residue, values[0], "{}", form.unicode(notation));

        let value = |symbol: SymbolId| 0.4 + 0.13 * f64::from(symbol.0);
        let (found, expected) = (evaluate(form, &value), Evaluator::new(graph, value).value(expr));
        let close = (found - expected).abs() <= ROUNDING * (1.0 + expected.abs());
        assert!(close, "{} is {found}, not {expected}", form.unicode(notation));
    });
}

#[test]
fn a_normal_form_is_its_own() {
    let compared = Cell::new(0);
    for_each(|_, notation, _, form| {
        let other = Graph::new();
        let symbol = |id: SymbolId| other.variable(id);
        let again = expression(form, &symbol).unwrap();
        let mut notation = notation.clone();
        let closed = close(&other, &mut notation, &[again], GENEROUS).unwrap();
        if !closed.definitions.is_empty() {
            return; // its brackets are too much to be multiplied out
        }
        compared.set(compared.get() + 1);
        let texts = [&closed.forms[0], form].map(|form| form.unicode(&notation));
        assert_eq!(texts[0], texts[1]);
    });
    assert!(compared.get() > EXPRESSIONS / 2, "most can be compared: {}", compared.get());
}

#[test]
fn what_is_printed_is_read_back() {
    for_each(|_, notation, _, form| {
        let (unicode, latex) = (form.unicode(notation), form.latex(notation));
        assert_eq!(Form::parse_unicode(&unicode, notation).as_ref(), Ok(form), "{unicode}");
        assert_eq!(Form::parse_latex(&latex, notation).as_ref(), Ok(form), "{latex}");
        let xml = math(&form.mathml(notation));
        assert!(roxmltree::Document::parse(&xml).is_ok(), "{xml}");
    });
}

/// What is equal is written alike, whichever way it was computed.
#[test]
fn equal_expressions_have_one_form() {
    let graph = Graph::new();
    let mut notation = notation();
    let [m, l, a, b] = [0, 2, 4, 5].map(|k| graph.variable(SymbolId(k)));
    let (two, three) = (Expr::from(2), Expr::from(3));
    let pairs = [
        ((a + b).cos(), a.cos() * b.cos() - a.sin() * b.sin()),
        (m * a.sin() * a.sin() + m * a.cos() * a.cos(), m),
        ((two * a).sin() * m, two * m * a.sin() * a.cos()),
        ((three * a).cos(), a.cos() * (two * (two * a).cos() - Expr::ONE)),
        ((m + l) * (m - l), m * m - l * l),
        (m * l / (two * m), l / two),
        (m / (m + l) + l / (m + l) * a, (m + l * a) / (m + l)),
        ((a - b).sin() + (b - a).sin(), Expr::ZERO),
    ];
    for (left, right) in pairs {
        let forms = close(&graph, &mut notation, &[left, right], Limits::READABLE).unwrap().forms;
        let texts = [&forms[0], &forms[1]].map(|form| form.unicode(&notation));
        assert_eq!(texts[0], texts[1]);
    }
}

/// Work is bounded, whatever is asked for.
#[test]
fn what_swells_has_names_or_is_refused() {
    let graph = Graph::new();
    let mut notation = notation();
    let mut expr =
        graph.variable(SymbolId(0)) + graph.variable(SymbolId(2)) * graph.variable(SymbolId(4)).sin();
    for k in 0..60 {
        expr = expr * expr + graph.variable(SymbolId(k % 4));
    }
    let closed = close(&graph, &mut notation, &[expr], Limits::READABLE).unwrap();
    assert!(!closed.definitions.is_empty() && closed.definitions.len() <= Limits::READABLE.names);
    let few = Limits { names: 3, ..Limits::READABLE };
    assert!(close(&graph, &mut notation, &[expr], few).is_err());
}
