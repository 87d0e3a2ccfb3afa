//! Minus signs, moved to where they cost nothing and read best.
//!
//! A step may store its value or the negative of it. Forwards, a leading minus goes on to the readers; back
//! again, a step that every reader negates is turned round where its operands allow that for nothing.

use super::program::{Operand, Operation, Program, Source};

/// Chooses the sign of every step.
pub(super) fn settle(program: &mut Program) {
    let flips = leading_minus(program);
    apply(program, &flips);
    turn_unwanted(program);
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
            Operation::Lane(a, _) | Operation::Turn(a, _) => minus(a),
            Operation::Sqrt(_) | Operation::SinCos(_) | Operation::Each(_) => false,
        };
    }
    flips
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
    for (step, &turn) in program.steps.iter_mut().zip(flips) {
        step.operation = turned(step.operation.mapped(settled), turn);
    }
    for result in program.results.iter_mut().chain(program.rows.iter_mut().flatten()) {
        *result = settled(*result);
    }
}

/// From the last step to the first: a result has the sign it is returned with, and a step that is only read
/// negated is turned round, if it can be.
fn turn_unwanted(program: &mut Program) {
    let returned_negative = returned_negative(program);
    let mut readings = vec![(0_usize, 0_usize); program.steps.len()];
    let note = |readings: &mut Vec<(usize, usize)>, operand: Operand| {
        if let Source::Step(k) = operand.source {
            let (plus, minus) = &mut readings[k];
            *(if operand.negative { minus } else { plus }) += 1;
        }
    };
    for &result in &program.results {
        note(&mut readings, result);
    }
    let mut flips = vec![false; program.steps.len()];
    for k in (0..program.steps.len()).rev() {
        let operation = program.steps[k].operation;
        let free = match (returned_negative[k], readings[k]) {
            (Some(true), _) | (None, (0, 1..)) => turned_round(program, operation, &readings),
            _ => None,
        };
        let forced = (returned_negative[k] == Some(true)).then(|| turned(operation, true));
        if let Some(other) = free.or(forced).filter(|other| *other != operation) {
            flips[k] = true;
            program.steps[k].operation = other;
        }
        for operand in program.steps[k].operation.operands() {
            note(&mut readings, operand);
        }
    }
    let settled = |operand: Operand| Operand {
        negative: operand.negative != flipped(&flips, operand.source),
        ..operand
    };
    for step in &mut program.steps {
        step.operation = turned(step.operation.mapped(settled), false);
    }
    for result in program.results.iter_mut().chain(program.rows.iter_mut().flatten()) {
        *result = settled(*result);
    }
}

/// For each step that is a result, whether it is returned negated where it is returned first.
fn returned_negative(program: &Program) -> Vec<Option<bool>> {
    let mut signs = vec![None; program.steps.len()];
    for result in &program.results {
        if let Source::Step(k) = result.source {
            signs[k].get_or_insert(result.negative);
        }
    }
    signs
}

/// The negative of an operation, if that takes no further minus.
fn turned_round(program: &Program, operation: Operation, readings: &[(usize, usize)]) -> Option<Operation> {
    match operation {
        Operation::Add(a, b) if a.negative != b.negative => Some(turned(operation, true)),
        Operation::MulAdd(a, b, c) if (a.negative != b.negative) != c.negative => {
            Some(turned(operation, true))
        }
        Operation::Mul(a, b) | Operation::Div(a, b) => {
            let can_turn = |operand: Operand| can_turn(program, operand, readings);
            match operation {
                _ if a.negative != b.negative => Some(turned(operation, true)),
                Operation::Mul(a, b) if can_turn(b) && !can_turn(a) => Some(Operation::Mul(negated(b), a)),
                _ if can_turn(a) => Some(turned(operation, true)),
                _ => None,
            }
        }
        _ => None,
    }
}

/// Whether an operand that nobody has read yet can be turned round in its own step.
fn can_turn(program: &Program, operand: Operand, readings: &[(usize, usize)]) -> bool {
    let Source::Step(k) = operand.source else { return false };
    let step = program.steps[k];
    let read_elsewhere = readings[k] != (0, 0) || step.uses > 1;
    !read_elsewhere
        && match step.operation {
            Operation::Add(a, b) => a.negative != b.negative,
            Operation::MulAdd(a, b, c) => (a.negative != b.negative) != c.negative,
            Operation::Mul(a, b) => can_turn(program, a, readings) || can_turn(program, b, readings),
            _ => false,
        }
}

fn negated(operand: Operand) -> Operand {
    Operand { negative: !operand.negative, ..operand }
}

/// The operation, negated if `turn`; a product has at most one minus, in front.
fn turned(operation: Operation, turn: bool) -> Operation {
    let sign = |operand: Operand| Operand { negative: operand.negative != turn, ..operand };
    let product = |a: Operand, b: Operand| {
        let negative = (a.negative != b.negative) != turn;
        (Operand { negative, ..a }, Operand { negative: false, ..b })
    };
    match operation {
        Operation::Add(a, b) => Operation::Add(sign(a), sign(b)),
        Operation::Mul(a, b) => {
            let (a, b) = product(a, b);
            Operation::Mul(a, b)
        }
        Operation::Div(a, b) => {
            let (a, b) = product(a, b);
            Operation::Div(a, b)
        }
        Operation::MulAdd(a, b, c) => {
            let (a, b) = product(a, b);
            Operation::MulAdd(a, b, sign(c))
        }
        Operation::Lane(a, lane) => Operation::Lane(sign(a), lane),
        Operation::Turn(a, lane) => Operation::Turn(sign(a), lane),
        Operation::Sqrt(_) | Operation::SinCos(_) | Operation::Each(_) => operation,
    }
}
