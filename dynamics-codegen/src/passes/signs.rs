//! Minus signs, moved to where they cost nothing and read best.
//!
//! A step may store its value or the negative of it. Forwards, a leading minus goes on to the readers; back
//! again, a difference whose readers all want its negative is turned round.

use super::program::{Operand, Operation, Program, Source};

/// Chooses the sign of every step.
pub(super) fn settle(program: &mut Program) {
    let flips = leading_minus(program);
    apply(program, &flips);
    let flips = wanted_negative(program);
    apply(program, &flips);
}

/// Whether each step, its operands' flips taken into account, has a minus in front.
fn leading_minus(program: &Program) -> Vec<bool> {
    let mut flips = vec![false; program.steps.len()];
    for k in 0..program.steps.len() {
        let minus = |operand: Operand| operand.negative != flipped(&flips, operand.source);
        flips[k] = match program.steps[k].operation {
            Operation::Add(a, b) => minus(a) && minus(b),
            Operation::Mul(a, b) | Operation::Div(a, b) => minus(a) != minus(b),
            Operation::MulAdd(a, b, c) => (minus(a) != minus(b)) && minus(c),
            Operation::Sqrt(_) | Operation::SinCos(_) => false,
        };
    }
    flips
}

/// Steps that can be turned round for nothing, and whose every reader negates them.
fn wanted_negative(program: &Program) -> Vec<bool> {
    let mut wishes = vec![(0_usize, 0_usize); program.steps.len()];
    let operands = program.steps.iter().flat_map(|step| step.operation.operands());
    for operand in operands.chain(program.results.iter().copied()) {
        if let Source::Step(k) = operand.source {
            let (plus, minus) = &mut wishes[k];
            *(if operand.negative { minus } else { plus }) += 1;
        }
    }
    let turns_freely = |operation: Operation| match operation {
        Operation::Add(a, b) => a.negative != b.negative,
        Operation::MulAdd(a, b, c) => (a.negative != b.negative) != c.negative,
        _ => false,
    };
    let steps = program.steps.iter().zip(wishes);
    steps.map(|(step, (plus, minus))| plus == 0 && minus > 0 && turns_freely(step.operation)).collect()
}

fn flipped(flips: &[bool], source: Source) -> bool {
    matches!(source, Source::Step(k) if flips[k])
}

/// Negates the steps marked, and every reading of them.
fn apply(program: &mut Program, flips: &[bool]) {
    let settled = |operand: Operand| Operand {
        negative: operand.negative != flipped(flips, operand.source),
        ..operand
    };
    let turned = |operand: Operand, turn: bool| Operand { negative: operand.negative != turn, ..operand };
    for (step, &turn) in program.steps.iter_mut().zip(flips) {
        step.operation = match step.operation {
            Operation::Add(a, b) => Operation::Add(turned(settled(a), turn), turned(settled(b), turn)),
            Operation::Mul(a, b) => {
                let (a, b) = product(settled(a), settled(b), turn);
                Operation::Mul(a, b)
            }
            Operation::Div(a, b) => {
                let (a, b) = product(settled(a), settled(b), turn);
                Operation::Div(a, b)
            }
            Operation::MulAdd(a, b, c) => {
                let (a, b) = product(settled(a), settled(b), turn);
                Operation::MulAdd(a, b, turned(settled(c), turn))
            }
            Operation::Sqrt(a) => Operation::Sqrt(settled(a)),
            Operation::SinCos(a) => Operation::SinCos(settled(a)),
        };
    }
    for result in &mut program.results {
        *result = settled(*result);
    }
}

/// A product with at most one minus, in front.
fn product(a: Operand, b: Operand, turn: bool) -> (Operand, Operand) {
    let negative = (a.negative != b.negative) != turn;
    (Operand { negative, ..a }, Operand { negative: false, ..b })
}
