//! Where Thumb-2 code goes: whether a function is one straight line, and how many instructions that is.
//!
//! Source: *ARMv7-M Architecture Reference Manual*, DDI 0403E, A5 and A7.

/// Where an instruction leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Flow {
    /// To the next one.
    Next,
    /// Always so many bytes further than itself.
    Jump(i32),
    /// Somewhere else, or not.
    Branch,
    /// To a function so many bytes further than itself, and back.
    Call(i32),
    /// To an address that was computed, or to the debugger.
    Anywhere,
    /// To the caller.
    Return,
}

/// The instruction at the front of `code`: where it leads, and its length in bytes.
pub(crate) fn decode(code: &[u8]) -> Option<(Flow, usize)> {
    let half = |k: usize| Some(u32::from(u16::from_le_bytes([*code.get(k)?, *code.get(k + 1)?])));
    let first = half(0)?;
    if first >> 11 < 0b11101 {
        return Some((decode_short(first), 2));
    }
    Some((decode_long(first, half(2)?), 4))
}

fn decode_short(code: u32) -> Flow {
    match code >> 8 {
        0b1101_1110 | 0b1101_1111 | 0b1011_1110 => Flow::Anywhere, // UDF, SVC, BKPT
        0b1101_0000..=0b1101_1101 => Flow::Branch,
        0b1110_0000..=0b1110_0111 => Flow::Jump(4 + (sign_extend(code & 0x7FF, 11) << 1)),
        0b1011_0001 | 0b1011_0011 | 0b1011_1001 | 0b1011_1011 => Flow::Branch, // CBZ, CBNZ
        0b1011_1101 => Flow::Return,                                           // POP with PC
        0b0100_0111 if code == 0x4770 => Flow::Return,                         // BX LR
        0b0100_0111 => Flow::Anywhere,
        0b0100_0100 | 0b0100_0110 if code & 0x87 == 0x87 => Flow::Anywhere, // ADD, MOV to PC
        _ => Flow::Next,
    }
}

fn decode_long(first: u32, second: u32) -> Flow {
    let loads_pc = second & 0x8000 != 0;
    match (first, second) {
        _ if first >> 11 == 0b11110 && second >> 15 == 1 => match second >> 12 & 0b101 {
            0b101 => Flow::Call(4 + jump_offset(first, second)), // BL
            0b001 => Flow::Jump(4 + jump_offset(first, second)),
            _ if first >> 7 & 7 != 7 => Flow::Branch,
            _ => Flow::Next, // barriers, hints, MSR
        },
        _ if first & 0xFFF0 == 0xE8D0 && second & 0xFFE0 == 0xF000 => Flow::Branch, // TBB, TBH
        (0xE8BD, _) if loads_pc => Flow::Return,                                    // POP.W
        (0xF85D, 0xFB04) => Flow::Return,                                           // LDR PC, [SP], #4
        _ if matches!(first & 0xFFD0, 0xE890 | 0xE910) && loads_pc => Flow::Anywhere,
        _ if first & 0xFF70 == 0xF850 && second >> 12 == 15 => Flow::Anywhere,
        _ => Flow::Next,
    }
}

/// Of B.W, encoding T4, and BL.
fn jump_offset(first: u32, second: u32) -> i32 {
    let s = first >> 10 & 1;
    let [i1, i2] = [13, 11].map(|bit| !((second >> bit & 1) ^ s) & 1);
    let offset = s << 24 | i1 << 23 | i2 << 22 | (first & 0x3FF) << 12 | (second & 0x7FF) << 1;
    sign_extend(offset, 25)
}

fn sign_extend(value: u32, bits: u32) -> i32 {
    (value << (32 - bits)) as i32 >> (32 - bits)
}

/// Calls within calls that are followed. What calls itself comes to no end, and is no straight line.
const DEPTH: usize = 8;

/// The instructions from the first to the return, if nothing in between decides. Jumps are taken as long as they lead
/// ahead, around a pool of constants, or to another function, in place of a call. What is called must be of the same
/// kind: `function_at` has its code.
pub(crate) fn straight_line<'p>(
    address: u32,
    code: &[u8],
    function_at: &impl Fn(u32) -> Option<&'p [u8]>,
) -> Option<usize> {
    length(address, code, function_at, DEPTH)
}

fn length<'p>(
    address: u32,
    code: &[u8],
    function_at: &impl Fn(u32) -> Option<&'p [u8]>,
    depth: usize,
) -> Option<usize> {
    let (mut at, mut count) = (0, 0);
    loop {
        let (flow, size) = decode(code.get(at..)?)?;
        count += 1;
        let callee = |offset| {
            let callee = address.wrapping_add(u32::try_from(at).ok()?).wrapping_add_signed(offset);
            length(callee, function_at(callee)?, function_at, depth.checked_sub(1)?)
        };
        at += match flow {
            Flow::Next => size,
            Flow::Jump(offset) => match usize::try_from(offset) {
                Ok(ahead) if ahead >= size && at + ahead < code.len() => ahead,
                _ => return Some(count + callee(offset)?),
            },
            Flow::Call(offset) => {
                count += callee(offset)?;
                size
            }
            Flow::Return => return Some(count),
            Flow::Branch | Flow::Anywhere => return None,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Encodings as GNU's assembler writes them.
    #[test]
    fn branches_are_known() {
        for (code, flow) in [
            (&[0x70, 0x47][..], Flow::Return),           // bx lr
            (&[0xF0, 0xBD], Flow::Return),               // pop {r4-r7, pc}
            (&[0xBD, 0xE8, 0xF0, 0x8F], Flow::Return),   // ldmia.w sp!, {r4-r11, pc}
            (&[0x5D, 0xF8, 0x04, 0xFB], Flow::Return),   // ldr.w pc, [sp], #4
            (&[0x01, 0xD1], Flow::Branch),               // bne.n +6
            (&[0x08, 0xB1], Flow::Branch),               // cbz r0
            (&[0x00, 0xF0, 0x80, 0x80], Flow::Branch),   // beq.w
            (&[0xD0, 0xE8, 0x01, 0xF0], Flow::Branch),   // tbb [r0, r1]
            (&[0x00, 0xF0, 0x02, 0xF8], Flow::Call(8)),  // bl +8
            (&[0x18, 0x47], Flow::Anywhere),             // bx r3
            (&[0x97, 0x46], Flow::Anywhere),             // mov pc, r2
            (&[0x02, 0xE0], Flow::Jump(8)),              // b.n +8
            (&[0xFD, 0xE7], Flow::Jump(-2)),             // b.n -2
            (&[0x00, 0xF0, 0x02, 0xB8], Flow::Jump(8)),  // b.w +8
            (&[0xFF, 0xF7, 0xFA, 0xBF], Flow::Jump(-8)), // b.w -8
            (&[0x30, 0xEE, 0x20, 0x0A], Flow::Next),     // vadd.f32 s0, s0, s1
            (&[0xBF, 0xF3, 0x5F, 0x8F], Flow::Next),     // dmb sy
            (&[0x18, 0xBF], Flow::Next),                 // it ne
            (&[0x08, 0x46], Flow::Next),                 // mov r0, r1
        ] {
            assert_eq!(decode(code), Some((flow, code.len())), "{code:02x?}");
        }
    }

    #[test]
    fn constants_are_jumped_over() {
        let line = |code: &[u8]| straight_line(0, code, &|_| None);
        let code = [0x01, 0xE0, 1, 2, 3, 4, 0x08, 0x46, 0x70, 0x47]; // b.n +6, a word, mov r0, r1, bx lr
        assert_eq!(line(&code), Some(3));
        assert_eq!(line(&[0xFE, 0xE7]), None, "a loop is no straight line");
        assert_eq!(line(&[0x08, 0x46]), None, "it must return");
    }

    #[test]
    fn calls_are_followed() {
        let code = [0x00, 0xF0, 0x02, 0xF8, 0x70, 0x47]; // bl +8, bx lr
        let callee: &[u8] = &[0x08, 0x46, 0x70, 0x47]; // mov r0, r1, bx lr
        let function_at = |address| (address == 0x108).then_some(callee);
        assert_eq!(straight_line(0x100, &code, &function_at), Some(4));
        assert_eq!(straight_line(0x200, &code, &function_at), None, "nothing is there");
        let last = [0x08, 0x46, 0x00, 0xF0, 0x01, 0xB8]; // mov r0, r1, b.w +6
        assert_eq!(straight_line(0x100, &last, &function_at), Some(4));
        let itself: &[u8] = &[0xFF, 0xF7, 0xFE, 0xFF]; // bl +0
        assert_eq!(straight_line(0, itself, &|_| Some(itself)), None, "it never ends");
    }
}
