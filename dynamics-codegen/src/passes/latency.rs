//! How long a program takes at least: by its longest chain of operations, and by their number.
//!
//! Cycles of a core whose additions, products and fused products take four, as those of Intel since 2015; AMD's take
//! three or four. Agner Fog, *Instruction tables*; the sine with its cosine as the run time's kernel is written.

use super::{Operation, Program, Source};

/// An addition, a product, or a fused product.
const PRODUCT: u32 = 4;
/// A quotient.
const QUOTIENT: u32 = 14;
/// A square root.
const ROOT: u32 = 18;
/// A sine with its cosine: eleven operations of the kernel one after another.
const SINE_AND_COSINE: u32 = 45;
/// Doubles in a register of 256 bits.
const NUMBERS_IN_A_REGISTER: usize = 4;
/// The operations of that kernel for one angle, most of them fused; four in lanes take little more.
const INSTRUCTIONS_OF_SINE_AND_COSINE: u32 = 20;

impl Program {
    /// The length of the longest chain of operations, in cycles, from arguments to results: what one call takes on a
    /// core of any width.
    pub fn latency(&self) -> u32 {
        let mut ready: Vec<u32> = Vec::with_capacity(self.steps.len());
        let program = self.one_by_one();
        for step in &program.steps {
            let own = match step.operation {
                Operation::Add(..) | Operation::Mul(..) | Operation::MulAdd(..) => PRODUCT,
                Operation::Div(..) => QUOTIENT,
                Operation::Sqrt(..) => ROOT,
                Operation::SinCos(..) => SINE_AND_COSINE,
                Operation::Each(..) | Operation::Lane(..) | Operation::Turn(..) => 0,
            };
            let start = step.operation.operands().map(|operand| known_at(&ready, operand.source)).max();
            ready.push(start.unwrap_or(0) + own);
        }
        program.results.iter().map(|operand| known_at(&ready, operand.source)).max().unwrap_or(0)
    }

    /// The number of floating-point instructions, a fused multiply-add being one, and as many numbers side by side as a
    /// register holds: on a core that begins `k` of them in each cycle, a `k`-th is the least number of cycles a call, however
    /// many overlap.
    pub fn instructions(&self) -> u32 {
        self.instructions_by(|operation| match operation {
            Operation::SinCos(..) => INSTRUCTIONS_OF_SINE_AND_COSINE,
            Operation::Each(..) | Operation::Lane(..) | Operation::Turn(..) => 0,
            _ => 1,
        })
    }

    /// Those of its instructions that add and do not multiply: AMD's cores since 2017 begin two of them beside two others.
    pub fn sums(&self) -> u32 {
        self.instructions_by(|operation| u32::from(matches!(operation, Operation::Add(..))))
    }

    fn instructions_by(&self, instructions: impl Fn(Operation) -> u32) -> u32 {
        let registers =
            |lanes: usize| u32::try_from(lanes.div_ceil(NUMBERS_IN_A_REGISTER)).unwrap_or(u32::MAX);
        self.steps.iter().map(|step| instructions(step.operation) * registers(step.lanes)).sum()
    }
}

/// The cycle in which a value is known.
fn known_at(ready: &[u32], source: Source) -> u32 {
    match source {
        Source::Constant(_) | Source::Input(_) | Source::Field(_) => 0,
        Source::Step(k) | Source::Sin(k) | Source::Cos(k) => ready[k],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::passes::{Operand, Step};

    fn program(operations: &[Operation], results: &[Source]) -> Program {
        let steps = operations.iter().map(|&operation| Step { operation, uses: 1, lanes: 1 }).collect();
        Program { steps, results: results.iter().map(|&source| plain(source)).collect(), rows: vec![] }
    }

    fn plain(source: Source) -> Operand {
        Operand { source, negative: false }
    }

    #[test]
    fn chains_add_up_and_what_is_beside_them_does_not() {
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| plain(Source::Field(k)));
        let step = |k| plain(Source::Step(k));
        let serial = [Operation::Add(a, b), Operation::Add(step(0), c), Operation::Add(step(1), d)];
        let balanced = [Operation::Add(a, b), Operation::Add(c, d), Operation::Add(step(0), step(1))];
        let of = |operations| program(operations, &[Source::Step(2)]);
        assert_eq!((of(&serial).latency(), of(&serial).instructions()), (3 * PRODUCT, 3));
        assert_eq!((of(&balanced).latency(), of(&balanced).instructions()), (2 * PRODUCT, 3));
        let fused = [Operation::Mul(a, b), Operation::MulAdd(c, d, step(0)), Operation::Add(step(1), a)];
        assert_eq!((of(&fused).instructions(), of(&fused).sums()), (3, 1));
    }

    #[test]
    fn the_longest_way_to_a_result_counts() {
        let field = plain(Source::Field(0));
        let operations = [
            Operation::SinCos(field),
            Operation::Sqrt(plain(Source::Cos(0))),
            Operation::Div(field, plain(Source::Sin(0))),
            Operation::MulAdd(plain(Source::Step(1)), plain(Source::Step(2)), field),
        ];
        let whole = program(&operations, &[Source::Step(3), Source::Sin(0)]);
        assert_eq!(whole.latency(), SINE_AND_COSINE + ROOT + PRODUCT);
        assert_eq!(whole.instructions(), INSTRUCTIONS_OF_SINE_AND_COSINE + 3);
        assert_eq!(program(&operations, &[Source::Field(0)]).latency(), 0);
    }
}
