//! A program as statements: named where a reader wants a name, nested in blocks where there are many.
//!
//! Values that are read once and short are written where they are read. A function never has more than
//! [`BLOCK`] statements in one block: rustc overflows its stack on flat runs of some 2,600 in debug builds.

use std::fmt::Write as _;

use super::names::{CALLED, Names, angle_suffix, component, entry};
use crate::mechanics::equations::{Block, Input, Shape};
use crate::passes::{Operand, Operation, Program, Sizes, Source};

/// The most statements in one block.
const BLOCK: usize = 250;
/// The longest expression that is written into another one.
const INLINE_WIDTH: usize = 44;
/// The deepest expression that is written into another one.
const INLINE_DEPTH: usize = 4;

/// How constants are written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Literals {
    /// `0.42`
    Plain,
    /// `T::of(0.42)`
    Of(String),
}

/// What a body is made from.
pub(super) struct Context<'a> {
    /// The name of the companion.
    pub(super) companion: &'a str,
    /// The names of the companion's fields.
    pub(super) fields: &'a [String],
    /// The names of the parameters.
    pub(super) parameters: &'a [String],
    /// How constants are written.
    pub(super) literals: Literals,
    /// The sizes of the arguments.
    pub(super) sizes: Sizes,
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
enum Binding {
    Sum,
    Product,
    Negation,
    Atom,
}

struct Statement {
    names: Vec<String>,
    text: String,
    reads: Vec<usize>,
}

/// Writes a program; `wanted` are the names that its results shall have.
pub(super) fn write(program: &Program, wanted: &[String], context: &Context<'_>, indent: usize) -> Body {
    let mut writer = Writer::new(program, wanted, context);
    for step in 0..program.steps.len() {
        writer.step(step);
    }
    let results: Vec<Text> = program.results.iter().map(|&result| writer.operand(result)).collect();
    let needed: Vec<usize> = results.iter().flat_map(|text| text.reads.iter().copied()).collect();
    Body {
        statements: layout(&writer.statements, &needed, indent),
        results: results.into_iter().map(|text| text.text).collect(),
        inputs: writer.inputs,
        fields: writer.fields,
    }
}

struct Writer<'a> {
    program: &'a Program,
    context: &'a Context<'a>,
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
    fn new(program: &'a Program, wanted: &[String], context: &'a Context<'a>) -> Self {
        let taken = if context.fields.is_empty() { context.parameters } else { context.fields };
        let mut names = Names::with_taken(taken.iter().map(String::as_str));
        for reserved in ["q", "v", "a", "tau", "self", "robot"].iter().chain(CALLED) {
            names.fresh(reserved);
        }
        let mut result_names = vec![None; program.steps.len()];
        for (result, name) in program.results.iter().zip(wanted) {
            if let Source::Step(step) = result.source {
                result_names[step].get_or_insert_with(|| name.clone());
            }
        }
        Self {
            program,
            context,
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
        let text = self.operation(operation);
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
            _ => self.numbered_name(),
        };
        let statement = self.declare(vec![name.clone()], text);
        self.values.push((atom(name, vec![statement]), None));
    }

    fn sin_cos(&mut self, angle: Operand) {
        let step = self.values.len();
        let inputs = self.inputs_of(angle);
        let parameters = self.context.parameters;
        let suffix = angle_suffix(&inputs, |k| parameters[k].clone()).unwrap_or_else(|| format!("_{step}"));
        let (reads_sin, reads_cos) = self.sines_read[step];
        let sin = if reads_sin { self.names.fresh(&format!("s{suffix}")) } else { "_".to_owned() };
        let cos = if reads_cos { self.names.fresh(&format!("c{suffix}")) } else { "_".to_owned() };
        let mut call = self.operand(angle);
        call.text = format!("sin_cos({})", call.text);
        let statement = self.declare(vec![sin.clone(), cos.clone()], call);
        self.values.push((atom(sin, vec![statement]), Some(atom(cos, vec![statement]))));
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

    fn declare(&mut self, names: Vec<String>, text: Text) -> usize {
        self.statements.push(Statement { names, text: text.text, reads: text.reads });
        self.statements.len() - 1
    }

    fn numbered_name(&mut self) -> String {
        let name = self.names.fresh(&format!("e{}", self.numbered));
        self.numbered += 1;
        name
    }

    fn operation(&mut self, operation: Operation) -> Text {
        match operation {
            Operation::Add(a, b) => {
                let (a, b) = if a.negative && !b.negative { (b, a) } else { (a, b) };
                let minus = b.negative;
                let left = self.operand(a);
                let right = self.operand(Operand { negative: false, ..b });
                let right = if minus { wrap(right, Binding::Product) } else { wrap(right, Binding::Sum) };
                join(
                    &[&left, &right],
                    format!("{} {} {}", left.text, if minus { '-' } else { '+' }, right.text),
                    Binding::Sum,
                )
            }
            Operation::Mul(a, b) => {
                let (a, b) = (self.operand(a), self.operand(b));
                let (a, b) = (wrap(a, Binding::Product), wrap(b, Binding::Negation));
                join(&[&a, &b], format!("{} * {}", a.text, b.text), Binding::Product)
            }
            Operation::Div(a, b) => {
                let (a, b) = (self.operand(a), self.operand(b));
                let (a, b) = (wrap(a, Binding::Product), wrap(b, Binding::Negation));
                join(&[&a, &b], format!("{} / {}", a.text, b.text), Binding::Product)
            }
            Operation::MulAdd(a, b, c) => {
                let (a, b, c) = (self.operand(a), self.operand(b), self.operand(c));
                join(&[&a, &b, &c], format!("madd({}, {}, {})", a.text, b.text, c.text), Binding::Atom)
            }
            Operation::Sqrt(a) => {
                let a = self.operand(a);
                join(&[&a], format!("sqrt({})", a.text), Binding::Atom)
            }
            Operation::SinCos(_) => unreachable!("written by `sin_cos`"),
        }
    }

    fn operand(&mut self, operand: Operand) -> Text {
        let value = match operand.source {
            Source::Constant(value) => return self.literal(if operand.negative { -value } else { value }),
            Source::Input(input) => atom(self.input(input), Vec::new()),
            Source::Field(field) => {
                if !self.fields.contains(&field) {
                    self.fields.push(field);
                }
                atom(self.context.fields[field].clone(), Vec::new())
            }
            Source::Step(k) | Source::Sin(k) => self.values[k].0.clone(),
            Source::Cos(k) => self.values[k].1.clone().expect("a step of sines has two values"),
        };
        if !operand.negative {
            return value;
        }
        // `-a * b` is `-(a * b)`, and the negative of `-a * b` is `a * b`.
        let value = wrap(value, Binding::Product);
        match value.text.strip_prefix('-') {
            Some(positive) => Text { text: positive.to_owned(), binding: Binding::Product, ..value },
            None => {
                let binding = value.binding.min(Binding::Negation);
                Text { text: format!("-{}", value.text), binding, ..value }
            }
        }
    }

    fn input(&mut self, input: Input) -> String {
        if let Some((_, name)) = self.inputs.iter().find(|(known, _)| *known == input) {
            return name.clone();
        }
        let name = match input {
            Input::Parameter(k) => self.context.parameters[k].clone(),
            Input::Argument(argument, k) => self.names.fresh(&component(argument, k)),
        };
        self.inputs.push((input, name.clone()));
        name
    }

    fn literal(&self, value: f64) -> Text {
        // Zero has no sign.
        let value = value + 0.0;
        let number = format!("{value:?}");
        match &self.context.literals {
            Literals::Of(scalar) => atom(format!("{scalar}::of({number})"), Vec::new()),
            Literals::Plain if value < 0.0 => Text { binding: Binding::Negation, ..atom(number, Vec::new()) },
            Literals::Plain => atom(number, Vec::new()),
        }
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

/// The text in parentheses, unless it binds at least as tightly as `least`.
fn wrap(text: Text, least: Binding) -> Text {
    if text.binding >= least {
        text
    } else {
        Text { text: format!("({})", text.text), binding: Binding::Atom, ..text }
    }
}

/// The statements, in nested blocks if there are many.
fn layout(statements: &[Statement], needed: &[usize], indent: usize) -> String {
    let mut lines = String::new();
    let pad = |levels: usize| "    ".repeat(levels);
    if statements.len() <= BLOCK {
        for statement in statements {
            let _ = writeln!(lines, "{}let {} = {};", pad(indent), tuple(&statement.names), statement.text);
        }
        return lines;
    }
    let last_reader = last_readers(statements, needed);
    for (block, chunk) in statements.chunks(BLOCK).enumerate() {
        let end = (block + 1) * BLOCK;
        let leaving: Vec<&str> = (block * BLOCK..)
            .zip(chunk)
            .filter(|(k, _)| last_reader[*k] >= end)
            .flat_map(|(_, statement)| statement.names.iter().map(String::as_str).filter(|name| *name != "_"))
            .collect();
        let leaving = tuple(&leaving);
        let _ = writeln!(lines, "{}let {leaving} = {{", pad(indent));
        for statement in chunk {
            let _ =
                writeln!(lines, "{}let {} = {};", pad(indent + 1), tuple(&statement.names), statement.text);
        }
        let _ = writeln!(lines, "{}{leaving}", pad(indent + 1));
        let _ = writeln!(lines, "{}}};", pad(indent));
    }
    lines
}

/// For each statement the last one that reads it; results are read after all of them.
fn last_readers(statements: &[Statement], needed: &[usize]) -> Vec<usize> {
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

fn tuple(names: &[impl AsRef<str>]) -> String {
    match names {
        [name] => name.as_ref().to_owned(),
        _ => format!("({})", names.iter().map(AsRef::as_ref).collect::<Vec<_>>().join(", ")),
    }
}
