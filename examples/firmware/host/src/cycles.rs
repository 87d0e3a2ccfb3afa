//! The most cycles that instructions take on a Cortex-M4F.
//!
//! *Cortex-M4 Technical Reference Manual*, DDI 0439: tables 3-1 and 7-1 have the cycles of each instruction without wait
//! states, 3.3.2 and 7.2.3 what is added where one waits for the other. Where the manual gives a range this is its upper
//! end, and what it says of pairs that go faster is left out; what is not in it has no bound.

use crate::thumb::{Flow, decode};

/// The most cycles of a pipeline refill, P: "from 1 to 3".
const REFILL: u32 = 3;

/// What can be said of one instruction on its way through the pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Timing {
    /// Its own cycles at the most, a refill behind it and a literal's contention with the fetch unit among them.
    cycles: u32,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// It may write a register that addresses are made of.
    Core,
    /// It makes an address, and may write such a register.
    Memory,
    /// Floating-point arithmetic: one cycle more if the next instruction takes its result.
    Arithmetic { result: u32, operands: [u32; 3] },
    /// It moves a floating-point register: to memory, if it makes an address.
    Move { source: Option<u32>, makes_address: bool },
}

/// The cycles that `timing` takes behind `before`, with those that `before` takes longer for it.
pub(crate) fn cycles(timing: Timing, before: Option<Timing>) -> u32 {
    let before = before.map(|before| before.kind);
    // The register bank is updated before an address is made of it.
    let makes_address = matches!(timing.kind, Kind::Memory | Kind::Move { makes_address: true, .. });
    let waits_for_address = makes_address && matches!(before, Some(Kind::Core | Kind::Memory));
    let waits_for_result = match (before, timing.kind) {
        (Some(Kind::Arithmetic { result, .. }), Kind::Arithmetic { operands, .. }) => {
            operands.contains(&result)
        }
        (Some(Kind::Arithmetic { result, .. }), Kind::Move { source, .. }) => {
            source.is_none_or(|s| s == result)
        }
        _ => false,
    };
    timing.cycles + u32::from(waits_for_address) + u32::from(waits_for_result)
}

/// The instruction at the front of `code`, if the manual has it.
pub(crate) fn timing(code: &[u8]) -> Option<Timing> {
    let half = |k: usize| Some(u32::from(u16::from_le_bytes([*code.get(k)?, *code.get(k + 1)?])));
    let (flow, size) = decode(code)?;
    let timing = match size {
        2 => of_short(half(0)?),
        _ => of_long(half(0)?, half(2)?)?,
    };
    match flow {
        Flow::Anywhere => None,
        Flow::Next => Some(timing),
        Flow::Jump(_) | Flow::Branch | Flow::Call(_) | Flow::Return => {
            Some(Timing { cycles: timing.cycles + REFILL, ..timing })
        }
    }
}

fn core(cycles: u32) -> Timing {
    Timing { cycles, kind: Kind::Core }
}

fn memory(cycles: u32) -> Timing {
    Timing { cycles, kind: Kind::Memory }
}

/// Of several registers: 1 + N. Of loads 3.3.2 has an example that takes one more.
fn several(is_load: bool, registers: u32) -> u32 {
    1 + registers + u32::from(is_load)
}

fn of_short(code: u32) -> Timing {
    let is_load = code & 0x0800 != 0;
    match code >> 12 {
        0b0100 if is_load => memory(2 + 1), // LDR from the constants behind the code
        0b0101..=0b1001 => memory(2),       // LDR, STR
        0b1011 if code & 0x0600 == 0x0400 => memory(several(is_load, (code & 0x1FF).count_ones())), // PUSH, POP
        0b1100 => memory(several(is_load, (code & 0xFF).count_ones())),
        _ => core(1),
    }
}

fn of_long(first: u32, second: u32) -> Option<Timing> {
    let is_load = first & 0x10 != 0;
    let from_constants = u32::from(first & 0xF == 15);
    Some(match first >> 8 {
        0xE8..=0xE9 if first & 0x40 == 0 => memory(several(is_load, second.count_ones())), // LDM, STM
        0xE8..=0xE9 if first & 0x120 != 0 => memory(several(is_load, 2) + from_constants), // LDRD, STRD
        0xE8..=0xE9 => return None, // exclusive accesses, and branches by tables
        0xEA..=0xEB => core(1),
        0xEC..=0xEE => return of_floats(first, second),
        0xF0..=0xF7 if second & 0x8000 == 0 || second & 0x5000 != 0 => core(1), // the refill of branches is added
        0xF0..=0xF7 if first >> 7 & 7 != 7 => core(1),                          // a branch that decides
        0xF8..=0xF9 => memory(2 + from_constants),
        0xFA => core(1),
        0xFB if first & 0xFFD0 == 0xFB90 => core(12), // a division: 2 to 12
        0xFB => core(2),                              // a product is 1, with a sum up to 2
        _ => return None,
    })
}

fn of_floats(first: u32, second: u32) -> Option<Timing> {
    let is_single = second >> 8 & 0xF == 0xA;
    if second >> 8 & 0xE != 0xA {
        return None;
    }
    let register = |low: u32, bit: u32| low << 1 | bit;
    let d = register(second >> 12 & 0xF, first >> 6 & 1);
    let n = register(first & 0xF, second >> 7 & 1);
    let m = register(second & 0xF, second >> 5 & 1);
    let moves = |cycles, source, makes_address| Timing { cycles, kind: Kind::Move { source, makes_address } };
    if first >> 8 == 0xEE && second & 0x10 == 0 {
        let cycles = match first & 0xB0 {
            _ if !is_single => return None, // there is no arithmetic of doubles
            0x00 | 0x10 | 0x90 | 0xA0 => 3, // VMLA, VNMLA, VFNMA, VFMA and those that subtract
            0x20 | 0x30 => 1,               // VMUL, VADD, VSUB
            0x80 => 14,                     // VDIV
            _ if first & 0xF == 1 && second & 0xC0 == 0xC0 => 14, // VSQRT
            _ => 1,                         // VABS, VNEG, VMOV, VCMP, VCVT
        };
        return Some(Timing { cycles, kind: Kind::Arithmetic { result: d, operands: [d, n, m] } });
    }
    Some(match first & 0xFFF0 {
        0xEEF0 | 0xEEE0 => moves(1, None, false), // VMRS, VMSR
        _ if first >> 8 == 0xEE => moves(2, Some(n), false),
        0xEC40 | 0xEC50 => moves(2, None, false),
        _ if first & 0x120 == 0x100 => {
            let literal = u32::from(first & 0xF == 15);
            let (is_load, words) = (first & 0x10 != 0, if is_single { 1 } else { 2 });
            let source = if is_load { Some(u32::MAX) } else { Some(d).filter(|_| is_single) };
            moves(1 + words + literal, source, true)
        }
        _ => {
            let is_load = first & 0x10 != 0;
            moves(several(is_load, second & 0xFF), if is_load { Some(u32::MAX) } else { None }, true)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Encodings as GNU's assembler writes them.
    #[test]
    fn instructions_take_what_the_manual_says() {
        for (code, cycles) in [
            (&[0x08, 0x46][..], Some(1)),                 // mov r0, r1
            (&[0x70, 0x47], Some(1 + 3)),                 // bx lr
            (&[0xF0, 0xB5], Some(1 + 5)),                 // push {r4-r7, lr}
            (&[0xF0, 0xBD], Some(2 + 5 + 3)),             // pop {r4-r7, pc}
            (&[0x08, 0x68], Some(2)),                     // ldr r0, [r1]
            (&[0x01, 0x48], Some(3)),                     // ldr r0, [pc, #4]
            (&[0x02, 0xE0], Some(1 + 3)),                 // b.n
            (&[0xFF, 0xF7, 0xFE, 0xFF], Some(1 + 3)),     // bl
            (&[0xBD, 0xE8, 0xF0, 0x8F], Some(2 + 9 + 3)), // ldmia.w sp!, {r4-r11, pc}
            (&[0xD1, 0xE9, 0x00, 0x23], Some(4)),         // ldrd r2, r3, [r1]
            (&[0x91, 0xFB, 0xF2, 0xF0], Some(12)),        // sdiv r0, r1, r2
            (&[0x4F, 0xF0, 0x7E, 0x50], Some(1)),         // mov.w r0, #0x3f800000
            (&[0x30, 0xEE, 0x20, 0x0A], Some(1)),         // vadd.f32 s0, s0, s1
            (&[0x20, 0xEE, 0x20, 0x0A], Some(1)),         // vmul.f32 s0, s0, s1
            (&[0x00, 0xEE, 0x20, 0x0A], Some(3)),         // vmla.f32 s0, s0, s1
            (&[0xA0, 0xEE, 0x20, 0x0A], Some(3)),         // vfma.f32 s0, s0, s1
            (&[0x80, 0xEE, 0x20, 0x0A], Some(14)),        // vdiv.f32 s0, s0, s1
            (&[0xB1, 0xEE, 0xC0, 0x0A], Some(14)),        // vsqrt.f32 s0, s0
            (&[0xB1, 0xEE, 0x40, 0x0A], Some(1)),         // vneg.f32 s0, s0
            (&[0x90, 0xED, 0x01, 0x0A], Some(2)),         // vldr s0, [r0, #4]
            (&[0x9F, 0xED, 0x01, 0x0A], Some(3)),         // vldr s0, [pc, #4]
            (&[0x80, 0xED, 0x01, 0x0A], Some(2)),         // vstr s0, [r0, #4]
            (&[0x2D, 0xED, 0x04, 0x8B], Some(1 + 4)),     // vpush {d8-d9}
            (&[0xBD, 0xEC, 0x04, 0x8B], Some(2 + 4)),     // vpop {d8-d9}
            (&[0x10, 0xEE, 0x10, 0x0A], Some(2)),         // vmov r0, s0
            (&[0xF1, 0xEE, 0x10, 0xFA], Some(1)),         // vmrs APSR_nzcv, fpscr
            (&[0x30, 0xEE, 0x20, 0x0B], None),            // vadd.f64 d0, d0, d16
            (&[0xD0, 0xE8, 0x01, 0xF0], None),            // tbb [r0, r1]
            (&[0x18, 0x47], None),                        // bx r3
        ] {
            assert_eq!(timing(code).map(cycles_alone), cycles, "{code:02x?}");
        }
    }

    fn cycles_alone(timing: Timing) -> u32 {
        cycles(timing, None)
    }

    #[test]
    fn one_waits_for_the_other() {
        let pair = |before: &[u8], code: &[u8]| {
            let [before, timing] = [before, code].map(|code| timing(code).expect("it is in the manual"));
            cycles(timing, Some(before)) - cycles(timing, None)
        };
        let add = &[0x30, 0xEE, 0x20, 0x0A]; // vadd.f32 s0, s0, s1
        let [uses, other] = [&[0x61, 0xEE, 0x80, 0x0A], &[0x61, 0xEE, 0x81, 0x0A]]; // vmul.f32 s1, s3, s0; s1, s3, s2
        let (store, load) = (&[0x80, 0xED, 0x01, 0x0A], &[0x90, 0xED, 0x01, 0x0A]); // vstr, vldr s0, [r0, #4]
        let (moved, pushed) = (&[0x08, 0x46], &[0x2D, 0xED, 0x04, 0x8B]); // mov r0, r1; vpush {d8-d9}
        assert_eq!(pair(add, uses), 1);
        assert_eq!(pair(add, other), 0);
        assert_eq!(pair(add, store), 1);
        assert_eq!(pair(add, load), 0);
        assert_eq!(pair(add, pushed), 1, "it may be among those");
        assert_eq!(pair(moved, load), 1);
        assert_eq!(pair(moved, uses), 0);
        assert_eq!(pair(uses, load), 0);
    }
}
