//! Values in a finite field: where two expressions agree at a random point of it, they are equal, but for a chance of
//! their degree in 10¹⁸.
//!
//! A sine and a cosine are a random point of the circle `s² + c² = 1`, in its rational parametrisation, for each symbol;
//! those of sums and multiples follow by the addition formulas. π is a random element, a quaternion a random point of its
//! sphere, a root one of the two, those of whole numbers such that they multiply. What is a float to the compiler has no value here.

use dynamics_codegen::closed::{Form, Notation};
use dynamics_codegen::mechanics::equations::{Input, Inputs};
use dynamics_codegen::passes::{Operand, Operation, Program, Source};
use dynamics_codegen::symbolic::{Expr, Graph, NodeId, Number, Op, SymbolId};

/// A prime that is −1 modulo 840: the small primes have roots, and a root is a power.
const P: u64 = (1 << 61) - 3153;

/// All angles are multiples of a symbol by this fraction.
const PARTS: i64 = 840;

pub(crate) fn add(a: u64, b: u64) -> u64 {
    (a + b) % P
}

pub(crate) fn negative(a: u64) -> u64 {
    (P - a) % P
}

pub(crate) fn times(a: u64, b: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(P)) as u64
}

fn power(a: u64, n: u64) -> u64 {
    let (mut power, mut square, mut n) = (1, a, n);
    while n > 0 {
        if n & 1 == 1 {
            power = times(power, square);
        }
        square = times(square, square);
        n >>= 1;
    }
    power
}

fn inverse(a: u64) -> Option<u64> {
    (a != 0).then(|| power(a, P - 2))
}

/// The smaller one of the two roots.
fn root(a: u64) -> Option<u64> {
    let root = power(a, P.div_ceil(4));
    let root = root.min(negative(root));
    (times(root, root) == a).then_some(root)
}

/// The product of the roots of the prime factors.
fn root_of_whole(mut n: u64) -> Option<u64> {
    let (mut product, mut factor) = (1, 2);
    while n > 1 {
        while n.is_multiple_of(factor) {
            (product, n) = (times(product, root(factor)?), n / factor);
        }
        factor += 1;
    }
    Some(product)
}

/// A value, and of what is a sum of multiples of symbols also these.
#[derive(Clone, Debug)]
pub(crate) struct Value {
    pub(crate) residue: u64,
    linear: Option<Vec<(SymbolId, Number)>>,
    number: Option<Number>,
}

/// A random point.
pub(crate) struct Point {
    residues: Vec<u64>,
    /// For each symbol the sine and cosine of a part of it.
    circle: Vec<[u64; 2]>,
    pi: u64,
}

/// Splitmix64.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        x ^ (x >> 31)
    }

    fn residue(&mut self) -> u64 {
        self.next() % (P - 2) + 1
    }
}

impl Point {
    pub(crate) fn new(notation: &Notation, seed: u64) -> Self {
        let mut random = Random(seed);
        let mut residues: Vec<u64> = (0..notation.len()).map(|_| random.residue()).collect();
        // Of a point t of the line (2t, 1 − t²)/(1 + t²) is one of the circle, and so on the sphere.
        let mut circle = Vec::new();
        for _ in 0..notation.len() {
            let t = random.residue();
            let below = inverse(add(1, times(t, t))).unwrap();
            circle.push([times(add(t, t), below), times(add(1, negative(times(t, t))), below)]);
        }
        for quaternion in notation.quaternions() {
            let t = [0; 3].map(|_| random.residue());
            let square = t.iter().fold(0, |sum, &t| add(sum, times(t, t)));
            let below = inverse(add(1, square)).unwrap();
            for (symbol, t) in quaternion.iter().zip(t) {
                residues[symbol.0 as usize] = times(add(t, t), below);
            }
            residues[quaternion[3].0 as usize] = times(add(1, negative(square)), below);
        }
        Self { residues, circle, pi: random.residue() }
    }

    /// Makes a name stand for the value of its definition.
    pub(crate) fn define(&mut self, symbol: SymbolId, form: &Form) -> Option<()> {
        self.residues[symbol.0 as usize] = self.form(form)?.residue;
        Some(())
    }

    fn number(&self, value: Number) -> Option<Value> {
        let Number::Exact(exact) = value else { return None };
        let residue = |value: i128| value.rem_euclid(i128::from(P)) as u64;
        let ratio = times(residue(exact.numerator()), inverse(residue(exact.denominator()))?);
        let pi = power(self.pi, exact.pi_power().unsigned_abs().into());
        let pi = if exact.pi_power() < 0 { inverse(pi)? } else { pi };
        let linear = exact.numerator().eq(&0).then(Vec::new);
        let residue = times(times(ratio, pi), root_of_whole(exact.radicand().into())?);
        Some(Value { residue, linear, number: Some(value) })
    }

    fn symbol(&self, symbol: SymbolId) -> Value {
        let residue = self.residues[symbol.0 as usize];
        Value { residue, linear: Some(vec![(symbol, Number::ONE)]), number: None }
    }

    /// `a + k·b` for a sign k.
    fn sum(&self, a: &Value, b: &Value, minus: bool) -> Value {
        let b = if minus { self.product(&self.number(-Number::ONE).unwrap(), b) } else { b.clone() };
        let linear = a.linear.clone().zip(b.linear.clone()).map(|(mut sum, b)| {
            for (symbol, k) in b {
                match sum.iter_mut().find(|(known, _)| *known == symbol) {
                    Some((_, total)) => *total = *total + k,
                    None => sum.push((symbol, k)),
                }
            }
            sum
        });
        let number = a.number.zip(b.number).map(|(a, b)| a + b);
        Value { residue: add(a.residue, b.residue), linear, number }
    }

    fn product(&self, a: &Value, b: &Value) -> Value {
        let scaled = |k: Option<Number>, x: &Value| {
            let linear = x.linear.clone()?;
            let k = k?;
            Some(linear.into_iter().map(|(symbol, n)| (symbol, k * n)).collect())
        };
        let linear = scaled(a.number, b).or_else(|| scaled(b.number, a));
        let number = a.number.zip(b.number).map(|(a, b)| a * b);
        Value { residue: times(a.residue, b.residue), linear, number }
    }

    fn quotient(&self, a: &Value, b: &Value) -> Option<Value> {
        let number = b.number.and_then(|b| Number::ONE.checked_div(b));
        let inverse = Value { residue: inverse(b.residue)?, linear: None, number };
        Some(self.product(a, &inverse))
    }

    fn root(&self, a: &Value) -> Option<Value> {
        Some(Value { residue: root(a.residue)?, linear: None, number: None })
    }

    /// The sine and the cosine of a sum of multiples of symbols.
    fn sine_and_cosine(&self, a: &Value) -> Option<[Value; 2]> {
        let turned = |[s, c]: [u64; 2], [t, d]: [u64; 2]| {
            [add(times(s, d), times(c, t)), add(times(c, d), negative(times(s, t)))]
        };
        let mut point = [0, 1];
        for (symbol, k) in a.linear.as_ref()? {
            let Number::Exact(exact) = *k * Number::integer(PARTS) else { return None };
            (exact.denominator() == 1 && exact.pi_power() == 0).then_some(())?;
            let [mut s, c] = self.circle[symbol.0 as usize];
            if exact.numerator() < 0 {
                s = negative(s);
            }
            for _ in 0..exact.numerator().abs() {
                point = turned(point, [s, c]);
            }
        }
        Some(point.map(|residue| Value { residue, linear: None, number: None }))
    }

    /// The values of expressions; of none whose numbers are not exact.
    pub(crate) fn exprs(&self, graph: &Graph, exprs: &[Expr<'_>]) -> Option<Vec<u64>> {
        let mut values: Vec<Option<Value>> = vec![None; graph.len()];
        exprs.iter().map(|&expr| self.expr(graph, expr, &mut values).map(|value| value.residue)).collect()
    }

    fn expr(&self, graph: &Graph, expr: Expr<'_>, values: &mut [Option<Value>]) -> Option<Value> {
        let (root, negative) = match expr {
            Expr::Constant(value) => return self.number(value),
            Expr::Node { id, negative, .. } => (id, negative),
        };
        let mut stack = vec![root];
        while let Some(&id) = stack.last() {
            let missing: Vec<NodeId> =
                graph.op(id).operands().filter(|operand| values[operand.index()].is_none()).collect();
            if missing.is_empty() {
                stack.pop();
                let value = self.operation(graph, graph.op(id), values)?;
                values[id.index()] = Some(value);
            }
            stack.extend(missing);
        }
        let value = values[root.index()].clone()?;
        Some(if negative { self.sum(&self.number(Number::ZERO)?, &value, true) } else { value })
    }

    fn operation(&self, graph: &Graph, op: Op, values: &[Option<Value>]) -> Option<Value> {
        let of = |id: NodeId| values[id.index()].as_ref().expect("operands come first");
        Some(match op {
            Op::Constant(k) => self.number(graph.number(k))?,
            Op::Symbol(symbol) => self.symbol(symbol),
            Op::Add(a, b) => self.sum(of(a), of(b), false),
            Op::Sub(a, b) => self.sum(of(a), of(b), true),
            Op::Mul(a, b) => self.product(of(a), of(b)),
            Op::Scale(k, a) => self.product(&self.number(graph.number(k))?, of(a)),
            Op::Div(a, b) => self.quotient(of(a), of(b))?,
            Op::Sqrt(a) => self.root(of(a))?,
            Op::Sin(a) => self.sine_and_cosine(of(a))?[0].clone(),
            Op::Cos(a) => self.sine_and_cosine(of(a))?[1].clone(),
            Op::Opaque(a) => of(a).clone(),
        })
    }

    /// The value of a form.
    pub(crate) fn form(&self, form: &Form) -> Option<Value> {
        let all = |forms: &[Form]| forms.iter().map(|form| self.form(form)).collect::<Option<Vec<_>>>();
        Some(match form {
            Form::Number(value) => self.number(*value)?,
            Form::Symbol(symbol) => self.symbol(*symbol),
            Form::Negative(inner) => self.sum(&self.number(Number::ZERO)?, &self.form(inner)?, true),
            Form::Sum(terms) => all(terms)?.into_iter().reduce(|a, b| self.sum(&a, &b, false))?,
            Form::Product(factors) => all(factors)?.into_iter().reduce(|a, b| self.product(&a, &b))?,
            Form::Quotient(above, below) => self.quotient(&self.form(above)?, &self.form(below)?)?,
            Form::Power(base, n) => {
                let base = self.form(base)?;
                (1..*n).fold(base.clone(), |power, _| self.product(&power, &base))
            }
            Form::Sin(angle) => self.sine_and_cosine(&self.form(angle)?)?[0].clone(),
            Form::Cos(angle) => self.sine_and_cosine(&self.form(angle)?)?[1].clone(),
            Form::Root(inner) => self.root(&self.form(inner)?)?,
        })
    }

    /// The results of a program; its constants, which are rounded, are read as the simplest fractions that round to them.
    pub(crate) fn program(&self, program: &Program, inputs: Inputs, fields: &[Value]) -> Option<Vec<Value>> {
        let program = &*program.one_by_one();
        let symbol = |input: Input| match input {
            Input::Parameter(k) => SymbolId(u32::try_from(k).unwrap()),
            Input::Argument(argument, k) => inputs.symbol(argument, k),
        };
        let mut values: Vec<[Value; 2]> = Vec::new();
        let read = |values: &[[Value; 2]], operand: Operand| -> Option<Value> {
            let value = match operand.source {
                Source::Constant(value) => self.number(simplest(value)?)?,
                Source::Input(input) => self.symbol(symbol(input)),
                Source::Field(k) => fields[k].clone(),
                Source::Step(k) | Source::Sin(k) => values[k][0].clone(),
                Source::Cos(k) => values[k][1].clone(),
            };
            Some(if operand.negative { self.sum(&self.number(Number::ZERO)?, &value, true) } else { value })
        };
        for step in &program.steps {
            let of = |operand| read(&values, operand);
            let value = match step.operation {
                Operation::Add(a, b) => self.sum(&of(a)?, &of(b)?, false),
                Operation::Mul(a, b) => self.product(&of(a)?, &of(b)?),
                Operation::MulAdd(a, b, c) => self.sum(&self.product(&of(a)?, &of(b)?), &of(c)?, false),
                Operation::Div(a, b) => self.quotient(&of(a)?, &of(b)?)?,
                Operation::Sqrt(a) => self.root(&of(a)?)?,
                Operation::SinCos(a) => {
                    values.push(self.sine_and_cosine(&of(a)?)?);
                    continue;
                }
                Operation::Each(..) | Operation::Lane(..) | Operation::Turn(..) => unreachable!("one by one"),
            };
            values.push([value.clone(), value]);
        }
        program.results.iter().map(|&operand| read(&values, operand)).collect()
    }
}

/// The fraction of smallest denominator whose nearest double this is.
fn simplest(value: f64) -> Option<Number> {
    (1..1_000_000).find_map(|den| {
        let num = (value * f64::from(den)).round();
        let fraction = Number::ratio(num as i64, i64::from(den));
        (num.abs() < 1e15 && fraction.to_f64() == value).then_some(fraction)
    })
}
