//! A program as statements, in any language: named where a reader wants a name.
//!
//! Values that are read once and short are written where they are read.

use super::names::{Names, angle_suffix, entry};
use crate::mechanics::equations::{Argument, Block, Input, Shape};
use crate::passes::{Operand, Operation, Program, Source};

/// The longest expression that is written into another one.
const INLINE_WIDTH: usize = 44;
/// The deepest expression that is written into another one.
const INLINE_DEPTH: usize = 4;

/// What a language says in words of its own.
pub(super) trait Language {
    /// The names that no local variable may have.
    fn taken(&self) -> Vec<&str>;

    /// A parameter, where the body reads it.
    fn parameter(&self, k: usize) -> String;

    /// The name of a parameter.
    fn parameter_name(&self, k: usize) -> String {
        self.parameter(k)
    }

    /// A field of the companion, where the body reads it.
    fn field(&self, k: usize) -> String;

    /// A component of an argument, where the body reads it; a new name if it needs one.
    fn component(&self, argument: Argument, k: usize, names: &mut Names) -> String;

    /// A constant.
    fn constant(&self, value: f64) -> (String, Binding);

    /// `a·b + c` in a call, or `None` where it is written as a product and a sum.
    fn multiply_add(&self, a: &str, b: &str, c: &str) -> Option<String>;

    /// `√a`
    fn square_root(&self, a: &str) -> String;

    /// The words for numbers side by side; none of a language whose programs have none.
    fn side_by_side(&self) -> Option<&dyn SideBySide> {
        None
    }

    /// How a sum is written.
    fn sums(&self) -> Sums;

    /// The statements, a line each, indented by `indent` levels; `needed` are those that the results read.
    fn layout(&self, statements: &[Statement], needed: &[usize], indent: usize) -> String;
}

/// What a language says of numbers side by side in words of its own.
pub(super) trait SideBySide {
    /// The same number for each.
    fn each(&self, number: &str) -> String;

    /// The same constant for each.
    fn constant(&self, value: f64) -> String;

    /// A number for each.
    fn row(&self, numbers: &[String]) -> String;

    /// A constant for each.
    fn constants(&self, values: &[f64]) -> String;

    /// One of them, by its place.
    fn one(&self, numbers: &str, place: usize) -> String;

    /// The same in a circle, from that at a place on.
    fn turned(&self, numbers: &str, place: usize) -> String;
}

/// The text of a method's body, apart from its frame.
pub(super) struct Body {
    /// The inputs that are read.
    pub(super) inputs: Vec<(Input, String)>,
    /// The companion's fields that are read.
    pub(super) fields: Vec<usize>,
    /// The statements, a line each, indented by `indent` levels.
    pub(super) statements: String,
    /// The text of each result.
    pub(super) results: Vec<String>,
}

/// An expression on its way into a line.
#[derive(Clone, Debug)]
struct Text {
    text: String,
    binding: Binding,
    depth: usize,
    /// The statements whose names occur in it.
    reads: Vec<usize>,
}

/// How tightly the outermost operator binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    /// A sum that stays together: it is one operation.
    MultiplyAdd,
    Sum,
    Product,
    Negation,
    Atom,
}

/// How sums are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sums {
    /// `a + (b + c)` without parentheses, and so another sum to the last bit.
    Regrouped,
    /// In parentheses wherever the order of operations does not go by sums alone: `(a * b) + c`, `a + (b + c)`.
    Explicit,
}

/// Names for a value.
pub(super) enum Named {
    /// One name.
    Value(String),
    /// The names of the sine and the cosine of the value; none for what is not read.
    SinCos(Option<String>, Option<String>),
}

/// A line that gives a value its name.
pub(super) struct Statement {
    /// The name, or names.
    pub(super) named: Named,
    /// The value.
    pub(super) value: String,
    /// How many numbers it is.
    pub(super) lanes: usize,
    /// The statements whose names occur in it.
    reads: Vec<usize>,
}

impl Statement {
    /// The names, where there are any.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        let names = match &self.named {
            Named::Value(name) => [Some(name), None],
            Named::SinCos(sin, cos) => [sin.as_ref(), cos.as_ref()],
        };
        names.into_iter().flatten().map(String::as_str)
    }

    /// Whether it reads the statement of that number or a later one.
    pub(super) fn reads_from(&self, first: usize) -> bool {
        self.reads.iter().any(|&read| read >= first)
    }
}

/// Writes a program; `wanted` are the names that its results shall have.
pub(super) fn write(program: &Program, wanted: &[String], language: &dyn Language, indent: usize) -> Body {
    let mut writer = Writer::new(program, wanted, language);
    for step in 0..program.steps.len() {
        writer.step(step);
    }
    let results: Vec<Text> = program.results.iter().map(|&result| writer.whole(result)).collect();
    let needed: Vec<usize> = results.iter().flat_map(|text| text.reads.iter().copied()).collect();
    Body {
        statements: language.layout(&writer.statements, &needed, indent),
        results: results.into_iter().map(|text| text.text).collect(),
        inputs: writer.inputs,
        fields: writer.fields,
    }
}

struct Writer<'a> {
    program: &'a Program,
    language: &'a dyn Language,
    names: Names,
    /// The name that a step shall have because it is a result.
    result_names: Vec<Option<String>>,
    /// For each step whether its sine and its cosine are read.
    sines_read: Vec<(bool, bool)>,
    values: Vec<(Text, Option<Text>)>,
    statements: Vec<Statement>,
    inputs: Vec<(Input, String)>,
    fields: Vec<usize>,
    numbered: usize,
}

impl<'a> Writer<'a> {
    fn new(program: &'a Program, wanted: &[String], language: &'a dyn Language) -> Self {
        let names = Names::with_taken(language.taken().into_iter());
        let mut result_names = vec![None; program.steps.len()];
        for (result, name) in program.results.iter().zip(wanted) {
            if let Source::Step(step) = result.source {
                result_names[step].get_or_insert_with(|| name.clone());
            }
        }
        Self {
            program,
            language,
            names,
            result_names,
            sines_read: sines_read(program),
            values: Vec::with_capacity(program.steps.len()),
            statements: Vec::new(),
            inputs: Vec::new(),
            fields: Vec::new(),
            numbered: 0,
        }
    }

    fn step(&mut self, step: usize) {
        let operation = self.program.steps[step].operation;
        if let Operation::SinCos(angle) = operation {
            return self.sin_cos(angle);
        }
        let lanes = self.program.steps[step].lanes;
        let text = self.operation(operation, lanes);
        let wanted = self.result_names[step].take();
        let short = text.text.len() <= INLINE_WIDTH && text.depth < INLINE_DEPTH;
        let read_once = self.program.steps[step].uses == 1;
        let name = match wanted {
            Some(name) if !name.is_empty() => self.names.fresh(&name),
            Some(_) if read_once => {
                self.values.push((text, None));
                return;
            }
            None if read_once && short => {
                self.values.push((text, None));
                return;
            }
            _ if lanes > 1 => self.numbered_name('l'),
            _ => self.numbered_name('e'),
        };
        let statement = self.declare(Named::Value(name.clone()), text, lanes);
        self.values.push((atom(name, vec![statement]), None));
    }

    fn sin_cos(&mut self, angle: Operand) {
        let step = self.values.len();
        let inputs = self.inputs_of(angle);
        let language = self.language;
        let suffix =
            angle_suffix(&inputs, |k| language.parameter_name(k)).unwrap_or_else(|| format!("_{step}"));
        let (reads_sin, reads_cos) = self.sines_read[step];
        let sin = reads_sin.then(|| self.names.fresh(&format!("s{suffix}")));
        let cos = reads_cos.then(|| self.names.fresh(&format!("c{suffix}")));
        let lanes = self.program.steps[step].lanes;
        let angle = self.operand(angle, lanes);
        let statement = self.declare(Named::SinCos(sin.clone(), cos.clone()), angle, lanes);
        let read = |name: Option<String>| atom(name.unwrap_or_default(), vec![statement]);
        self.values.push((read(sin), Some(read(cos))));
    }

    /// The inputs that an operand is directly made of.
    fn inputs_of(&self, operand: Operand) -> Vec<Input> {
        match operand.source {
            Source::Input(input) => vec![input],
            Source::Step(k) => self.program.steps[k]
                .operation
                .operands()
                .flat_map(|operand| self.inputs_of(operand))
                .collect(),
            _ => Vec::new(),
        }
    }

    fn declare(&mut self, named: Named, text: Text, lanes: usize) -> usize {
        self.statements.push(Statement { named, lanes, value: text.text, reads: text.reads });
        self.statements.len() - 1
    }

    fn numbered_name(&mut self, letter: char) -> String {
        let name = self.names.fresh(&format!("{letter}{}", self.numbered));
        self.numbered += 1;
        name
    }

    fn operation(&mut self, operation: Operation, lanes: usize) -> Text {
        match operation {
            Operation::Add(a, b) => {
                let (a, b) = (self.term(a, lanes), self.term(b, lanes));
                sum(a, b, Binding::Sum, self.language.sums())
            }
            Operation::Mul(a, b) => {
                let (a, b) = (self.operand(a, lanes), self.operand(b, lanes));
                product(a, '*', b)
            }
            Operation::Div(a, b) => {
                let (a, b) = (self.operand(a, lanes), self.operand(b, lanes));
                product(a, '/', b)
            }
            Operation::MulAdd(a, b, c) => self.multiply_add(a, b, c, lanes),
            Operation::Sqrt(a) => {
                let a = self.operand(a, lanes);
                join(&[&a], self.language.square_root(&a.text), Binding::Atom)
            }
            Operation::SinCos(_) => unreachable!("written by `sin_cos`"),
            Operation::Each(row) => self.row(row),
            Operation::Lane(a, lane) => self.of_row(a, |words, row| words.one(row, lane)),
            Operation::Turn(a, lane) => self.of_row(a, |words, row| words.turned(row, lane)),
        }
    }

    fn multiply_add(&mut self, a: Operand, b: Operand, c: Operand, lanes: usize) -> Text {
        let texts = [a, b, c].map(|operand| self.operand(operand, lanes));
        let [first, second, third] = &texts;
        if let Some(call) = self.language.multiply_add(&first.text, &second.text, &third.text) {
            return join(&[first, second, third], call, Binding::Atom);
        }
        let is_negative = a.negative != b.negative;
        let positive = |operand| Operand { negative: false, ..operand };
        let (a, b) = (self.operand(positive(a), lanes), self.operand(positive(b), lanes));
        let text = sum(
            (is_negative, product(a, '*', b)),
            self.term(c, lanes),
            Binding::Product,
            self.language.sums(),
        );
        Text { binding: Binding::MultiplyAdd, ..text }
    }

    /// A term of a sum, and whether it is taken off.
    fn term(&mut self, operand: Operand, lanes: usize) -> (bool, Text) {
        (operand.negative, self.operand(Operand { negative: false, ..operand }, lanes))
    }

    /// An operand of a step that computes so many numbers.
    fn operand(&mut self, operand: Operand, lanes: usize) -> Text {
        let own = match operand.source {
            Source::Step(k) | Source::Sin(k) | Source::Cos(k) => self.program.steps[k].lanes,
            _ => 1,
        };
        if lanes == own {
            return self.whole(operand);
        }
        if let Source::Constant(value) = operand.source {
            let value = if operand.negative { -value } else { value };
            return atom(self.side_by_side().constant(value), Vec::new());
        }
        let positive = self.whole(Operand { negative: false, ..operand });
        let text = join(&[&positive], self.side_by_side().each(&positive.text), Binding::Atom);
        if operand.negative { negated(text) } else { text }
    }

    /// Numbers side by side.
    fn row(&mut self, row: usize) -> Text {
        let row = &self.program.rows[row];
        let constant = |operand: &Operand| match operand.source {
            Source::Constant(value) => Some(if operand.negative { -value } else { value } + 0.0),
            _ => None,
        };
        if let Some(values) = row.iter().map(constant).collect::<Option<Vec<f64>>>() {
            return atom(self.side_by_side().constants(&values), Vec::new());
        }
        let texts: Vec<Text> = row.iter().map(|&operand| self.whole(operand)).collect();
        let numbers: Vec<String> = texts.iter().map(|text| text.text.clone()).collect();
        join(&texts.iter().collect::<Vec<_>>(), self.side_by_side().row(&numbers), Binding::Atom)
    }

    /// What is said of numbers side by side; minus that of their negatives.
    fn of_row(&mut self, numbers: Operand, said: impl Fn(&dyn SideBySide, &str) -> String) -> Text {
        let row = wrap(self.whole(Operand { negative: false, ..numbers }), Binding::Atom);
        let text = join(&[&row], said(self.side_by_side(), &row.text), Binding::Atom);
        if numbers.negative { negated(text) } else { text }
    }

    fn side_by_side(&self) -> &'a dyn SideBySide {
        self.language.side_by_side().expect("a program with lanes is for a language with words for them")
    }

    /// An operand as it is, of however many numbers.
    fn whole(&mut self, operand: Operand) -> Text {
        let value = match operand.source {
            Source::Constant(value) => return self.literal(if operand.negative { -value } else { value }),
            Source::Input(input) => atom(self.input(input), Vec::new()),
            Source::Field(field) => {
                if !self.fields.contains(&field) {
                    self.fields.push(field);
                }
                atom(self.language.field(field), Vec::new())
            }
            Source::Step(k) | Source::Sin(k) => self.values[k].0.clone(),
            Source::Cos(k) => self.values[k].1.clone().expect("a step of sines has two values"),
        };
        if operand.negative { negated(value) } else { value }
    }

    fn input(&mut self, input: Input) -> String {
        if let Some((_, name)) = self.inputs.iter().find(|(known, _)| *known == input) {
            return name.clone();
        }
        let name = match input {
            Input::Parameter(k) => self.language.parameter(k),
            Input::Argument(argument, k) => self.language.component(argument, k, &mut self.names),
        };
        self.inputs.push((input, name.clone()));
        name
    }

    fn literal(&self, value: f64) -> Text {
        let (text, binding) = self.language.constant(value + 0.0); // zero has no sign
        Text { binding, ..atom(text, Vec::new()) }
    }
}

fn sines_read(program: &Program) -> Vec<(bool, bool)> {
    let mut read = vec![(false, false); program.steps.len()];
    let operands = program.steps.iter().flat_map(|step| step.operation.operands());
    for operand in operands.chain(program.results.iter().copied()) {
        match operand.source {
            Source::Sin(step) => read[step].0 = true,
            Source::Cos(step) => read[step].1 = true,
            _ => {}
        }
    }
    read
}

/// The names of all entries of a method's result: `m00`, `tau3`; none for a number that is returned as it is.
pub(super) fn entry_names(blocks: &[Block<'_>], dof: usize) -> Vec<String> {
    let name = |block: &Block<'_>, k: usize| {
        let letter = letter(block.name);
        match block.shape {
            Shape::Scalar => String::new(),
            Shape::Vector(_) => entry(letter, k, None, dof),
            Shape::Matrix(_, columns) => entry(letter, k / columns, Some(k % columns), dof),
        }
    };
    blocks.iter().flat_map(|block| (0..block.entries.len()).map(move |k| name(block, k))).collect()
}

fn letter(block: &str) -> &str {
    match block {
        "mass_matrix" => "m",
        "coriolis_matrix" => "c",
        "gravity_forces" => "g",
        "rotation" => "r",
        "translation" => "p",
        "dtau_dq" | "da_dq" => "dq",
        "dtau_dv" | "da_dv" => "dv",
        "dtau_da" => "m",
        "da_dtau" => "w",
        other => other,
    }
}

fn atom(text: String, reads: Vec<usize>) -> Text {
    Text { text, binding: Binding::Atom, depth: 0, reads }
}

fn join(parts: &[&Text], text: String, binding: Binding) -> Text {
    let depth = parts.iter().map(|part| part.depth).max().unwrap_or(0) + 1;
    let reads = parts.iter().flat_map(|part| part.reads.iter().copied()).collect();
    Text { text, binding, depth, reads }
}

/// `a + b`, each with whether it is taken off; what is added binds at least as `added`, unless sums are explicit.
fn sum(a: (bool, Text), b: (bool, Text), added: Binding, sums: Sums) -> Text {
    let ((is_negative, left), (minus, right)) = if a.0 && !b.0 { (b, a) } else { (a, b) };
    let left = if is_negative { negated(left) } else { left };
    let (left, least) = match sums {
        Sums::Regrouped => (left, if minus { Binding::Product } else { added }),
        Sums::Explicit if left.binding == Binding::Product => (wrap(left, Binding::Atom), Binding::Negation),
        Sums::Explicit => (left, Binding::Negation),
    };
    let right = wrap(right, least);
    let sign = if minus { '-' } else { '+' };
    join(&[&left, &right], format!("{} {sign} {}", left.text, right.text), Binding::Sum)
}

/// `a * b` or `a / b`.
fn product(a: Text, operator: char, b: Text) -> Text {
    let (a, b) = (wrap(a, Binding::Product), wrap(b, Binding::Negation));
    join(&[&a, &b], format!("{} {operator} {}", a.text, b.text), Binding::Product)
}

/// `-a * b` is `-(a * b)`, and the negative of `-a * b` is `a * b`.
fn negated(value: Text) -> Text {
    let value = wrap(value, Binding::Product);
    match value.text.strip_prefix('-') {
        Some(positive) => Text { text: positive.to_owned(), binding: Binding::Product, ..value },
        None => {
            let binding = value.binding.min(Binding::Negation);
            Text { text: format!("-{}", value.text), binding, ..value }
        }
    }
}

/// The text in parentheses, unless it binds at least as tightly as `least`.
fn wrap(text: Text, least: Binding) -> Text {
    if text.binding >= least {
        text
    } else {
        Text { text: format!("({})", text.text), binding: Binding::Atom, ..text }
    }
}

/// For each statement the last one that reads it; results are read after all of them.
pub(super) fn last_readers(statements: &[Statement], needed: &[usize]) -> Vec<usize> {
    let mut last = vec![0; statements.len()];
    for (reader, statement) in statements.iter().enumerate() {
        for &read in &statement.reads {
            last[read] = reader;
        }
    }
    for &read in needed {
        last[read] = usize::MAX;
    }
    last
}
