//! A program, laid out so that it is quickly run again and again, in lanes.
//!
//! What an operation is and where its operands are is read once for as many states as there are lanes. Values stand in
//! registers that are used again as soon as nobody reads them, so that they stay in the first cache.

use dynamics_codegen::mechanics::equations::Input;
use dynamics_codegen::passes::{Operand, Operation, Program, Source};
use dynamics_core::lanes::Lanes;

/// An operation on registers.
#[derive(Clone, Copy)]
enum Instruction {
    /// `a + b`
    Add([u32; 2], u32),
    /// `a − b`
    Sub([u32; 2], u32),
    /// `a·b`
    Mul([u32; 2], u32),
    /// `a·b + c`, rounded once where the target can
    MulAdd([u32; 3], u32),
    /// `a·b − c`, likewise
    MulSub([u32; 3], u32),
    /// `c − a·b`, likewise
    NegMulAdd([u32; 3], u32),
    /// `a / b`
    Div([u32; 2], u32),
    /// `−a`
    Neg(u32, u32),
    /// `√a`
    Sqrt(u32, u32),
    /// `sin a`, `cos a`
    SinCos(u32, [u32; 2]),
}

/// Operations on registers, of which the first are the inputs, and the next the constants.
pub(super) struct Tape {
    inputs: usize,
    constants: Vec<f64>,
    instructions: Vec<Instruction>,
    registers: usize,
    results: Vec<u32>,
}

impl Tape {
    /// The tape of a program, with its input `symbol` in the register `input(symbol)`, and its fields in those from
    /// `fields` on; there are `inputs` of them together.
    pub(super) fn of(
        program: &Program,
        inputs: usize,
        input: &dyn Fn(Input) -> usize,
        fields: usize,
    ) -> Self {
        // Lanes are those of rollouts here.
        let program = &*program.one_by_one();
        let mut writer = Writer {
            inputs,
            input,
            fields,
            constants: constants(program),
            instructions: vec![],
            registers: 0,
            free: vec![],
            steps: vec![],
        };
        writer.registers = inputs + writer.constants.len();
        for step in &program.steps {
            writer.write(step.operation, step.uses);
        }
        let results = program.results.iter().map(|&result| writer.positive(result)).collect();
        let Writer { constants, instructions, registers, .. } = writer;
        Self { inputs, constants, instructions, registers, results }
    }
}

/// All constants, each once.
fn constants(program: &Program) -> Vec<f64> {
    let operands = program.steps.iter().flat_map(|step| step.operation.operands());
    let constant = |operand: Operand| match operand.source {
        Source::Constant(value) => Some(value),
        _ => None,
    };
    let mut found: Vec<f64> =
        operands.chain(program.results.iter().copied()).filter_map(constant).chain([0.0]).collect();
    found.sort_by(f64::total_cmp);
    found.dedup();
    found
}

/// Where the values of a step are, and how often they will be read yet.
struct Live {
    registers: [u32; 2],
    uses: usize,
    is_pair: bool,
}

/// What is known while a tape is written.
struct Writer<'i> {
    inputs: usize,
    input: &'i dyn Fn(Input) -> usize,
    fields: usize,
    constants: Vec<f64>,
    instructions: Vec<Instruction>,
    registers: usize,
    free: Vec<u32>,
    steps: Vec<Live>,
}

impl Writer<'_> {
    fn write(&mut self, operation: Operation, uses: usize) {
        let operands: Vec<Operand> = operation.operands().collect();
        let at: Vec<u32> = operands.iter().map(|&operand| self.register(operand.source)).collect();
        let negative = |k: usize| operands[k].negative;
        let mut scratch = vec![];
        let mut positive = |writer: &mut Self, k: usize| {
            if !negative(k) {
                return at[k];
            }
            let to = writer.fresh();
            writer.instructions.push(Instruction::Neg(at[k], to));
            scratch.push(to);
            to
        };
        // A sign costs nothing where another operation has it.
        let (instruction, is_negated): (Box<dyn Fn(u32) -> Instruction>, bool) = match operation {
            Operation::Add(..) => match (negative(0), negative(1)) {
                (false, true) => (Box::new(move |to| Instruction::Sub([at[0], at[1]], to)), false),
                (true, false) => (Box::new(move |to| Instruction::Sub([at[1], at[0]], to)), false),
                (both, _) => (Box::new(move |to| Instruction::Add([at[0], at[1]], to)), both),
            },
            Operation::Mul(..) => {
                (Box::new(move |to| Instruction::Mul([at[0], at[1]], to)), negative(0) != negative(1))
            }
            Operation::MulAdd(..) => match (negative(0) != negative(1), negative(2)) {
                (false, true) => (Box::new(move |to| Instruction::MulSub([at[0], at[1], at[2]], to)), false),
                (true, false) => {
                    (Box::new(move |to| Instruction::NegMulAdd([at[0], at[1], at[2]], to)), false)
                }
                (both, _) => (Box::new(move |to| Instruction::MulAdd([at[0], at[1], at[2]], to)), both),
            },
            Operation::Div(..) => {
                (Box::new(move |to| Instruction::Div([at[0], at[1]], to)), negative(0) != negative(1))
            }
            Operation::Sqrt(..) => {
                let from = positive(self, 0);
                (Box::new(move |to| Instruction::Sqrt(from, to)), false)
            }
            Operation::SinCos(..) => {
                let from = positive(self, 0);
                self.release(&operands, &scratch);
                let registers = [self.fresh(), self.fresh()];
                self.instructions.push(Instruction::SinCos(from, registers));
                self.steps.push(Live { registers, uses, is_pair: true });
                return;
            }
            Operation::Each(..) | Operation::Lane(..) | Operation::Turn(..) => unreachable!("one by one"),
        };
        self.release(&operands, &scratch);
        let to = self.fresh();
        self.instructions.push(instruction(to));
        if is_negated {
            self.instructions.push(Instruction::Neg(to, to));
        }
        self.steps.push(Live { registers: [to; 2], uses, is_pair: false });
    }

    /// The register of a result, which nobody writes again.
    fn positive(&mut self, operand: Operand) -> u32 {
        let from = self.register(operand.source);
        if !operand.negative {
            return from;
        }
        let to = self.fresh();
        self.instructions.push(Instruction::Neg(from, to));
        to
    }

    fn register(&self, source: Source) -> u32 {
        let at = match source {
            Source::Constant(value) => {
                let found = self.constants.binary_search_by(|known| known.total_cmp(&value));
                self.inputs + found.unwrap_or_default()
            }
            Source::Input(symbol) => (self.input)(symbol),
            Source::Field(k) => self.fields + k,
            Source::Step(k) | Source::Sin(k) => return self.steps[k].registers[0],
            Source::Cos(k) => return self.steps[k].registers[1],
        };
        register_number(at)
    }

    /// Has the operands read, and frees what is not read again.
    fn release(&mut self, operands: &[Operand], scratch: &[u32]) {
        self.free.extend(scratch);
        for operand in operands {
            let (Source::Step(k) | Source::Sin(k) | Source::Cos(k)) = operand.source else { continue };
            let live = &mut self.steps[k];
            live.uses = live.uses.saturating_sub(1);
            if live.uses == 0 {
                let count = if live.is_pair { 2 } else { 1 };
                self.free.extend(&live.registers[..count]);
            }
        }
    }

    /// A register that nobody reads.
    fn fresh(&mut self) -> u32 {
        self.free.pop().unwrap_or_else(|| {
            self.registers += 1;
            register_number(self.registers - 1)
        })
    }
}

/// Programs are far shorter than this can count.
fn register_number(at: usize) -> u32 {
    u32::try_from(at).unwrap_or(u32::MAX)
}

/// A tape with its registers.
pub(super) struct Machine<'t, L> {
    tape: &'t Tape,
    registers: Vec<L>,
}

impl<'t, L: Lanes<Element = f64>> Machine<'t, L> {
    pub(super) fn new(tape: &'t Tape) -> Self {
        let mut registers = vec![L::zero(); tape.registers];
        for (register, constant) in registers[tape.inputs..].iter_mut().zip(&tape.constants) {
            *register = L::from(*constant);
        }
        Self { tape, registers }
    }

    /// The registers of the inputs from `from` on.
    pub(super) fn inputs(&mut self, from: usize) -> &mut [L] {
        &mut self.registers[from..self.tape.inputs]
    }

    /// Runs the tape on its inputs.
    pub(super) fn run(&mut self) {
        let r = &mut self.registers[..];
        for instruction in &self.tape.instructions {
            match *instruction {
                Instruction::Add([a, b], to) => r[to as usize] = r[a as usize] + r[b as usize],
                Instruction::Sub([a, b], to) => r[to as usize] = r[a as usize] - r[b as usize],
                Instruction::Mul([a, b], to) => r[to as usize] = r[a as usize] * r[b as usize],
                Instruction::MulAdd([a, b, c], to) => {
                    r[to as usize] = r[a as usize].mul_add(r[b as usize], r[c as usize]);
                }
                Instruction::MulSub([a, b, c], to) => {
                    r[to as usize] = r[a as usize].mul_add(r[b as usize], -r[c as usize]);
                }
                Instruction::NegMulAdd([a, b, c], to) => {
                    r[to as usize] = (-r[a as usize]).mul_add(r[b as usize], r[c as usize]);
                }
                Instruction::Div([a, b], to) => r[to as usize] = r[a as usize] / r[b as usize],
                Instruction::Neg(a, to) => r[to as usize] = -r[a as usize],
                Instruction::Sqrt(a, to) => r[to as usize] = r[a as usize].sqrt(),
                Instruction::SinCos(a, [sin, cos]) => {
                    let (s, c) = r[a as usize].sin_cos();
                    r[sin as usize] = s;
                    r[cos as usize] = c;
                }
            }
        }
    }

    /// The results, in order.
    pub(super) fn results(&self) -> impl Iterator<Item = L> {
        self.tape.results.iter().map(|&at| self.registers[at as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::{Machine, Tape};
    use dynamics_codegen::mechanics::equations::{Argument, Input};
    use dynamics_codegen::passes::{Operand, Operation, Program, Source, Step};
    use dynamics_core::lanes::f64x8;

    /// A program of every operation with every sign, whose steps are read in both of the two next steps.
    fn program() -> Program {
        let x = |k| Source::Input(Input::Argument(Argument::Q, k));
        let mut steps = vec![];
        for signs in 0..8 {
            let operand = |source, bit: u32| Operand { source, negative: (signs >> bit) & 1 == 1 };
            let last = |back: usize, or: Source, steps: &Vec<Step>| {
                steps.len().checked_sub(back).map_or(or, Source::Step)
            };
            let square = Operand { source: Source::Constant(2.25), negative: false };
            for kind in 0..6 {
                let (a, b) = (last(1, x(0), &steps), last(2, x(1), &steps));
                let (a, b) = match steps.last() {
                    Some(Step { operation: Operation::SinCos(_), .. }) => {
                        (Source::Cos(steps.len() - 1), Source::Sin(steps.len() - 1))
                    }
                    _ => (a, b),
                };
                let (a, b, c) = (operand(a, 0), operand(b, 1), operand(x(0), 2));
                let operation = match kind {
                    0 => Operation::Add(a, b),
                    1 => Operation::Mul(a, b),
                    2 => Operation::MulAdd(a, c, b),
                    3 => Operation::SinCos(a),
                    4 => Operation::Div(a, c),
                    _ => Operation::Sqrt(square),
                };
                steps.push(Step { operation, uses: 0, lanes: 1 });
            }
        }
        let results = (0..steps.len()).map(|k| Operand { source: Source::Step(k), negative: k % 3 == 0 });
        let results = results.filter(|result| match result.source {
            Source::Step(k) => k % 7 == 0 && !matches!(steps[k].operation, Operation::SinCos(_)),
            _ => false,
        });
        let results: Vec<Operand> = results.collect();
        let mut uses = vec![0; steps.len()];
        let read = steps.iter().flat_map(|step| step.operation.operands()).chain(results.iter().copied());
        for operand in read.collect::<Vec<_>>() {
            if let Source::Step(k) | Source::Sin(k) | Source::Cos(k) = operand.source {
                uses[k] += 1;
            }
        }
        steps.iter_mut().zip(uses).for_each(|(step, uses)| step.uses = uses);
        Program { steps, results, rows: vec![] }
    }

    /// Rounding of a few dozen operations on numbers of the size of one.
    const TOLERANCE: f64 = 1e-11;

    #[test]
    fn a_tape_computes_what_its_program_does() {
        let program = program();
        let input = |symbol| match symbol {
            Input::Argument(Argument::Q, k) => k,
            _ => unreachable!("the program has no other input"),
        };
        let tape = Tape::of(&program, 2, &input, 2);
        assert!(tape.registers < program.steps.len(), "registers are used again");
        let mut machine = Machine::<f64x8>::new(&tape);
        for run in 0..2 {
            let x: [[f64; 8]; 2] =
                std::array::from_fn(|i| std::array::from_fn(|k| 0.3 + 0.1 * (i + 2 * k + run) as f64));
            machine.inputs(0).copy_from_slice(&x.map(f64x8::from));
            machine.run();
            let found: Vec<[f64; 8]> = machine.results().map(f64x8::to_array).collect();
            for k in 0..8 {
                let expected = program.evaluate(|symbol| x[input(symbol)][k], &[]);
                assert_eq!(expected.len(), found.len());
                for (found, expected) in found.iter().zip(expected) {
                    let error = (found[k] - expected).abs() / expected.abs().max(1.0);
                    assert!(error < TOLERANCE, "{} is not {expected}", found[k]);
                }
            }
        }
    }
}
