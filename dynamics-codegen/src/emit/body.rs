//! A program as statements, in any language: named where a reader wants a name.
//!
//! Values that are read once and short are written where they are read.

use super::branches::{SideBySide, Within};
use super::names::{Names, angle_suffix, entry};
use super::text::{Binding, Sums, Text, atom, join, negated, product, sum};
use crate::mechanics::equations::{Argument, Block, Input, Shape};
use crate::passes::{Branches, Operand, Operation, Program, Source, Stage};

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

/// Names for a value.
pub(super) enum Named {
    /// One name.
    Value(String),
    /// The names of the sine and the cosine of the value; none for what is not read.
    SinCos(Option<String>, Option<String>),
    /// A name for each of several rows of numbers, one of each branch.
    Rows(Vec<String>),
    /// No name: it hands a result over.
    Nothing,
}

/// A line that gives a value its name.
pub(super) struct Statement {
    /// The name, or names.
    pub(super) named: Named,
    /// The value.
    pub(super) value: String,
    /// The statements whose names occur in it.
    reads: Vec<usize>,
}

impl Statement {
    /// The names, where there are any.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        let (names, rows) = match &self.named {
            Named::Value(name) => ([Some(name), None], [].as_slice()),
            Named::SinCos(sin, cos) => ([sin.as_ref(), cos.as_ref()], [].as_slice()),
            Named::Rows(names) => ([None; 2], names.as_slice()),
            Named::Nothing => ([None; 2], [].as_slice()),
        };
        names.into_iter().flatten().chain(rows).map(String::as_str)
    }

    /// Whether it reads the statement of that number or a later one.
    pub(super) fn reads_from(&self, first: usize) -> bool {
        self.reads.iter().any(|&read| read >= first)
    }
}

/// Writes a program; `wanted` are the names that its results shall have.
pub(super) fn write(program: &Program, wanted: &[String], language: &dyn Language, indent: usize) -> Body {
    let mut writer = Writer::new(program, wanted, language);
    let stages = program.stages();
    writer.count_uses(&stages);
    for stage in &stages {
        match stage {
            Stage::Trunk(steps) => steps.iter().for_each(|&step| writer.step(step)),
            Stage::Branches(branches) => writer.branches(branches),
        }
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

pub(super) struct Writer<'a> {
    pub(super) program: &'a Program,
    pub(super) language: &'a dyn Language,
    pub(super) names: Names,
    /// The name that a step shall have because it is a result.
    result_names: Vec<Option<String>>,
    /// For each step whether its sine and its cosine are read.
    sines_read: Vec<(bool, bool)>,
    /// How often each step is read: by what is in the same stage, by other stages and by the results.
    uses: Vec<usize>,
    /// Each step's value, or its sine and its cosine.
    pub(super) values: Vec<Option<(Text, Option<Text>)>>,
    pub(super) statements: Vec<Statement>,
    inputs: Vec<(Input, String)>,
    fields: Vec<usize>,
    numbered: usize,
    /// The branches' code that is being written.
    pub(super) within: Option<Within>,
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
            uses: vec![0; program.steps.len()],
            values: vec![None; program.steps.len()],
            statements: Vec::new(),
            inputs: Vec::new(),
            fields: Vec::new(),
            numbered: 0,
            within: None,
        }
    }

    fn count_uses(&mut self, stages: &[Stage]) {
        let mut read = |source: Source, times: usize| {
            if let Some(step) = source.step() {
                self.uses[step] += times;
            }
        };
        for stage in stages {
            match stage {
                Stage::Trunk(steps) => {
                    let sources = steps.iter().flat_map(|&step| self.program.read_by(step));
                    sources.for_each(|source| read(source, 1));
                }
                Stage::Branches(Branches { own, shared, within, .. }) => {
                    within.iter().for_each(|&(source, times)| read(source, times));
                    own.iter().chain(shared).for_each(|&(source, _)| read(source, 1));
                }
            }
        }
        self.program.results.iter().for_each(|result| read(result.source, 1));
    }

    pub(super) fn step(&mut self, step: usize) {
        let operation = self.program.steps[step].operation;
        if let Operation::SinCos(angle) = operation {
            return self.sin_cos(step, angle);
        }
        let text = self.operation(operation);
        let wanted = self.result_names[step].take();
        let is_row = matches!(operation, Operation::Each(_) | Operation::Turn(..));
        let short = is_row || text.text.len() <= INLINE_WIDTH && text.depth < INLINE_DEPTH;
        let read_once = self.uses[step] == 1;
        let is_given_only = self.within.is_some() && self.uses[step] == 0;
        let name = match wanted {
            Some(name) if !name.is_empty() => self.names.fresh(&name),
            Some(_) if read_once => {
                self.values[step] = Some((text, None));
                return;
            }
            None if read_once && short || is_given_only => {
                self.values[step] = Some((text, None));
                return;
            }
            _ => self.numbered_name(if is_row || self.within.is_some() { 'l' } else { 'e' }),
        };
        let statement = self.declare(Named::Value(name.clone()), text);
        self.values[step] = Some((atom(name, vec![statement]), None));
    }

    fn sin_cos(&mut self, step: usize, angle: Operand) {
        let inputs = self.inputs_of(angle);
        let language = self.language;
        let suffix =
            angle_suffix(&inputs, |k| language.parameter_name(k)).unwrap_or_else(|| format!("_{step}"));
        let (reads_sin, reads_cos) = self.sines_read[step];
        let sin = reads_sin.then(|| self.names.fresh(&format!("s{suffix}")));
        let cos = reads_cos.then(|| self.names.fresh(&format!("c{suffix}")));
        let angle = self.whole(angle);
        let statement = self.declare(Named::SinCos(sin.clone(), cos.clone()), angle);
        let read = |name: Option<String>| atom(name.unwrap_or_default(), vec![statement]);
        self.values[step] = Some((read(sin), Some(read(cos))));
    }

    /// The inputs that an operand is directly made of; of branches those of the first.
    fn inputs_of(&self, operand: Operand) -> Vec<Input> {
        match operand.source {
            Source::Input(input) => vec![input],
            Source::Step(k) => match self.program.steps[k].operation {
                Operation::Each(row) => self.inputs_of(self.program.rows[row][0]),
                operation => operation.operands().flat_map(|operand| self.inputs_of(operand)).collect(),
            },
            _ => Vec::new(),
        }
    }

    pub(super) fn declare(&mut self, named: Named, text: Text) -> usize {
        self.statements.push(Statement { named, value: text.text, reads: text.reads });
        self.statements.len() - 1
    }

    pub(super) fn numbered_name(&mut self, letter: char) -> String {
        let name = self.names.fresh(&format!("{letter}{}", self.numbered));
        self.numbered += 1;
        name
    }

    fn operation(&mut self, operation: Operation) -> Text {
        match operation {
            Operation::Add(a, b) => {
                let (a, b) = (self.term(a), self.term(b));
                sum(a, b, Binding::Sum, self.language.sums())
            }
            Operation::Mul(a, b) => {
                let (a, b) = (self.whole(a), self.whole(b));
                product(a, '*', b)
            }
            Operation::Div(a, b) => {
                let (a, b) = (self.whole(a), self.whole(b));
                product(a, '/', b)
            }
            Operation::MulAdd(a, b, c) => self.multiply_add(a, b, c),
            Operation::Sqrt(a) => {
                let a = self.whole(a);
                join(&[&a], self.language.square_root(&a.text), Binding::Atom)
            }
            Operation::SinCos(_) => unreachable!("written by `sin_cos`"),
            Operation::Each(row) => self.row(row),
            Operation::Lane(a, lane) => self.one_of(a, lane),
            Operation::Turn(a, first) => self.turned(a, first),
        }
    }

    fn multiply_add(&mut self, a: Operand, b: Operand, c: Operand) -> Text {
        let texts = [a, b, c].map(|operand| self.whole(operand));
        let [first, second, third] = &texts;
        if let Some(call) = self.language.multiply_add(&first.text, &second.text, &third.text) {
            return join(&[first, second, third], call, Binding::Atom);
        }
        let is_negative = a.negative != b.negative;
        let positive = |operand| Operand { negative: false, ..operand };
        let (a, b) = (self.whole(positive(a)), self.whole(positive(b)));
        let text =
            sum((is_negative, product(a, '*', b)), self.term(c), Binding::Product, self.language.sums());
        Text { binding: Binding::MultiplyAdd, ..text }
    }

    /// A term of a sum, and whether it is taken off.
    fn term(&mut self, operand: Operand) -> (bool, Text) {
        (operand.negative, self.whole(Operand { negative: false, ..operand }))
    }

    /// An operand.
    pub(super) fn whole(&mut self, operand: Operand) -> Text {
        if let Some(given) = self.given(operand.source) {
            return if operand.negative { negated(given) } else { given };
        }
        let value = match operand.source {
            Source::Constant(value) => return self.literal(if operand.negative { -value } else { value }),
            Source::Input(input) => atom(self.input(input), Vec::new()),
            Source::Field(field) => {
                if !self.fields.contains(&field) {
                    self.fields.push(field);
                }
                atom(self.language.field(field), Vec::new())
            }
            Source::Step(k) | Source::Sin(k) => self.made(k).0.clone(),
            Source::Cos(k) => self.made(k).1.clone().expect("a step of sines has two values"),
        };
        if operand.negative { negated(value) } else { value }
    }

    /// What a step before made.
    fn made(&self, step: usize) -> &(Text, Option<Text>) {
        self.values[step].as_ref().expect("steps are written after those that they read")
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
        let value = value + 0.0; // zero has no sign
        let (text, binding) = match &self.within {
            Some(_) => (self.side_by_side().constant(value), Binding::Atom),
            None => self.language.constant(value),
        };
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
