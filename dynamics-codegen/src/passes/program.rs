//! A program: the straight line of operations that one method runs.
//!
//! Steps are in static single assignment and read only what stands before them. The same program is
//! interpreted, counted, and written as text.

use crate::mechanics::equations::Input;
use crate::symbolic::Number;

/// Where a value comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// A constant, without its sign, rounded; infinite or not a number if no double can hold it.
    Constant(f64),
    /// A parameter, or a component of an argument.
    Input(Input),
    /// A field of the prepared companion.
    Field(usize),
    /// The result of a step.
    Step(usize),
    /// The sine that a step [`Operation::SinCos`] computes.
    Sin(usize),
    /// The cosine that a step [`Operation::SinCos`] computes.
    Cos(usize),
}

impl Source {
    /// The step whose result it is.
    pub fn step(self) -> Option<usize> {
        match self {
            Source::Step(k) | Source::Sin(k) | Source::Cos(k) => Some(k),
            Source::Constant(_) | Source::Input(_) | Source::Field(_) => None,
        }
    }
}

/// A value or its negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Operand {
    /// The value.
    pub source: Source,
    /// Whether it is negated.
    pub negative: bool,
}

impl Operand {
    /// A constant, rounded.
    pub(super) fn constant(value: Number) -> Self {
        Self { source: Source::Constant(value.abs().to_f64()), negative: value.is_negative() }
    }
}

/// What a step does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operation {
    /// `a + b`
    Add(Operand, Operand),
    /// `a·b`
    Mul(Operand, Operand),
    /// `a·b + c`, rounded once where the target can.
    MulAdd(Operand, Operand, Operand),
    /// `a / b`
    Div(Operand, Operand),
    /// `√a`
    Sqrt(Operand),
    /// `sin a` and `cos a`
    SinCos(Operand),
    /// The numbers of a row of the program, side by side.
    Each(usize),
    /// One of several numbers side by side, by its place.
    Lane(Operand, usize),
    /// The same numbers side by side, in a circle, from that at the place on.
    Turn(Operand, usize),
}

impl Operation {
    /// The same operation on other operands.
    pub(super) fn mapped(self, f: impl Fn(Operand) -> Operand) -> Self {
        match self {
            Operation::Add(a, b) => Operation::Add(f(a), f(b)),
            Operation::Mul(a, b) => Operation::Mul(f(a), f(b)),
            Operation::MulAdd(a, b, c) => Operation::MulAdd(f(a), f(b), f(c)),
            Operation::Div(a, b) => Operation::Div(f(a), f(b)),
            Operation::Sqrt(a) => Operation::Sqrt(f(a)),
            Operation::SinCos(a) => Operation::SinCos(f(a)),
            Operation::Lane(a, lane) => Operation::Lane(f(a), lane),
            Operation::Turn(a, lane) => Operation::Turn(f(a), lane),
            Operation::Each(_) => self,
        }
    }

    /// The operands, in order.
    pub fn operands(&self) -> impl Iterator<Item = Operand> {
        Operands(match *self {
            Operation::Add(a, b) | Operation::Mul(a, b) | Operation::Div(a, b) => [Some(a), Some(b), None],
            Operation::MulAdd(a, b, c) => [Some(a), Some(b), Some(c)],
            Operation::Sqrt(a) | Operation::SinCos(a) | Operation::Lane(a, _) | Operation::Turn(a, _) => {
                [Some(a), None, None]
            }
            Operation::Each(_) => [None; 3],
        })
    }
}

/// Operands one after another. Iterators of arrays are slow where nothing is optimised.
struct Operands([Option<Operand>; 3]);

impl Iterator for Operands {
    type Item = Operand;

    fn next(&mut self) -> Option<Operand> {
        let [next, second, third] = self.0;
        self.0 = [second, third, None];
        next
    }
}

/// One operation of a program.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// What it does.
    pub operation: Operation,
    /// How often later steps and the results read it.
    pub uses: usize,
    /// How many numbers it computes side by side; a single operand is that of each.
    pub lanes: usize,
}

/// How many operations a program has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Multiplications; a fused multiply-add is one and an addition.
    pub multiplications: u32,
    /// Additions and subtractions.
    pub additions: u32,
    /// Divisions.
    pub divisions: u32,
    /// Square roots.
    pub square_roots: u32,
    /// Pairs of sine and cosine.
    pub sines_and_cosines: u32,
}

impl std::ops::Add for Cost {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        Self {
            multiplications: self.multiplications + rhs.multiplications,
            additions: self.additions + rhs.additions,
            divisions: self.divisions + rhs.divisions,
            square_roots: self.square_roots + rhs.square_roots,
            sines_and_cosines: self.sines_and_cosines + rhs.sines_and_cosines,
        }
    }
}

/// A straight line of steps and its results.
#[derive(Clone, Debug)]
pub struct Program {
    /// The operations.
    pub steps: Vec<Step>,
    /// The results.
    pub results: Vec<Operand>,
    /// The numbers that [`Operation::Each`] lays side by side.
    pub rows: Vec<Vec<Operand>>,
}

impl Program {
    /// The number of operations; a product with two is an addition.
    pub fn cost(&self) -> Cost {
        let mut cost = Cost::default();
        for step in &self.one_by_one().steps {
            match step.operation {
                Operation::Add(..) => cost.additions += 1,
                Operation::Mul(..) => cost.multiplications += 1,
                Operation::MulAdd(a, ..) if a.source == Source::Constant(2.0) => cost.additions += 2,
                Operation::MulAdd(..) => {
                    cost.multiplications += 1;
                    cost.additions += 1;
                }
                Operation::Div(..) => cost.divisions += 1,
                Operation::Sqrt(..) => cost.square_roots += 1,
                Operation::SinCos(..) => cost.sines_and_cosines += 1,
                Operation::Each(..) | Operation::Lane(..) | Operation::Turn(..) => {}
            }
        }
        cost
    }

    /// Whether anything is computed side by side.
    pub fn has_lanes(&self) -> bool {
        self.steps.iter().any(|step| step.lanes > 1)
    }

    /// The same program with what is computed side by side one after another.
    pub fn one_by_one(&self) -> std::borrow::Cow<'_, Self> {
        if !self.has_lanes() {
            return std::borrow::Cow::Borrowed(self);
        }
        // For each step what it became: a value for each lane.
        let mut became: Vec<Vec<Operand>> = Vec::with_capacity(self.steps.len());
        let mut steps: Vec<Step> = Vec::new();
        let of = |became: &[Vec<Operand>], operand: Operand, lane: usize| {
            let Some(step) = operand.source.step() else { return operand };
            let values = &became[step];
            let value = values[lane.min(values.len() - 1)];
            let source = match (operand.source, value.source) {
                (Source::Sin(_), Source::Step(k)) => Source::Sin(k),
                (Source::Cos(_), Source::Step(k)) => Source::Cos(k),
                (_, source) => source,
            };
            Operand { source, negative: operand.negative != value.negative }
        };
        for step in &self.steps {
            let values = match step.operation {
                Operation::Each(row) => {
                    self.rows[row].iter().map(|&operand| of(&became, operand, 0)).collect()
                }
                Operation::Lane(operand, lane) => vec![of(&became, operand, lane)],
                Operation::Turn(operand, first) => {
                    (0..step.lanes).map(|k| of(&became, operand, (first + k) % step.lanes)).collect()
                }
                operation => (0..step.lanes)
                    .map(|lane| {
                        let operation = operation.mapped(|operand| of(&became, operand, lane));
                        steps.push(Step { operation, uses: 0, lanes: 1 });
                        Operand { source: Source::Step(steps.len() - 1), negative: false }
                    })
                    .collect(),
            };
            became.push(values);
        }
        let results = self.results.iter().map(|&result| of(&became, result, 0)).collect();
        let mut program = Self { steps, results, rows: Vec::new() };
        program.count_uses();
        std::borrow::Cow::Owned(program)
    }

    /// The results for given inputs and fields.
    pub fn evaluate(&self, input: impl Fn(Input) -> f64, fields: &[f64]) -> Vec<f64> {
        let program = self.one_by_one();
        let mut values: Vec<(f64, f64)> = Vec::with_capacity(program.steps.len());
        let read = |values: &[(f64, f64)], operand: Operand| {
            let value = match operand.source {
                Source::Constant(value) => value,
                Source::Input(symbol) => input(symbol),
                Source::Field(k) => fields[k],
                Source::Step(k) | Source::Sin(k) => values[k].0,
                Source::Cos(k) => values[k].1,
            };
            if operand.negative { -value } else { value }
        };
        for step in &program.steps {
            let of = |operand| read(&values, operand);
            let value = match step.operation {
                Operation::Add(a, b) => (of(a) + of(b), 0.0),
                Operation::Mul(a, b) => (of(a) * of(b), 0.0),
                Operation::MulAdd(a, b, c) => (of(a) * of(b) + of(c), 0.0),
                Operation::Div(a, b) => (of(a) / of(b), 0.0),
                Operation::Sqrt(a) => (of(a).sqrt(), 0.0),
                Operation::SinCos(a) => of(a).sin_cos(),
                Operation::Each(_) | Operation::Lane(..) | Operation::Turn(..) => unreachable!("one by one"),
            };
            values.push(value);
        }
        program.results.iter().map(|&operand| read(&values, operand)).collect()
    }

    /// The constants, without their signs.
    pub fn constants(&self) -> impl Iterator<Item = f64> {
        let operands = self.steps.iter().flat_map(|step| step.operation.operands());
        let rows = self.rows.iter().flatten().copied();
        operands.chain(rows).chain(self.results.iter().copied()).filter_map(|operand| match operand.source {
            Source::Constant(value) => Some(value),
            _ => None,
        })
    }

    /// Whether there is a constant that no double can hold.
    pub fn has_constant_out_of_range(&self) -> bool {
        self.constants().any(|value| !value.is_finite())
    }

    pub(super) fn count_uses(&mut self) {
        let mut uses = vec![0; self.steps.len()];
        let mut read = |operand: Operand| {
            if let Some(k) = operand.source.step() {
                uses[k] += 1;
            }
        };
        for step in &self.steps {
            for operand in step.operation.operands() {
                read(operand);
            }
        }
        for result in self.results.iter().chain(self.rows.iter().flatten()) {
            read(*result);
        }
        for (step, uses) in self.steps.iter_mut().zip(uses) {
            step.uses = uses;
        }
    }
}
