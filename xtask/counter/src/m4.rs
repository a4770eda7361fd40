//! Cycles of the Cortex-M4: its Technical Reference Manual (r0p1), table 3-1, with zero wait states. Where the table has a range,
//! the most is taken: 3 for refilling the pipeline, 12 for a division, 2 for each load and store, though neighbours may overlap.

use crate::Cost;

/// Refilling the pipeline after a branch.
const REFILL: u64 = 3;

/// The cost of the instruction of these half words, of which the second one counts for long instructions alone.
pub(crate) fn cost(first: u16, second: u16) -> Cost {
    let cycles = match first >> 11 {
        0b11101..=0b11111 => return long(first, second),
        _ => short(first),
    };
    let may_branch = matches!(first >> 8, 0xd0..=0xdd | 0xb1 | 0xb3 | 0xb9 | 0xbb); // b<cond>, cbz, cbnz
    Cost { cycles, taken: if may_branch { REFILL } else { 0 } }
}

/// Instructions of 16 bits.
fn short(code: u16) -> u64 {
    let list = u64::from((code & 0xff).count_ones());
    let to_pc = code & 0x87 == 0x87;
    match code >> 8 {
        0x44 | 0x46 if to_pc => 1 + REFILL,           // add pc, rm; mov pc, rm
        0x47 => 1 + REFILL,                           // bx, blx
        0x48..=0x9f => 2,                             // every load and store of one register
        0xb4 | 0xbc | 0xc0..=0xcf => 1 + list,        // push, pop, stm, ldm {list}
        0xb5 => 1 + list + 1,                         // push {list, lr}
        0xbd => 1 + list + 1 + REFILL,                // pop {list, pc}
        0xbf if matches!(code, 0xbf20 | 0xbf30) => 2, // wfe, wfi
        0xe0..=0xe7 => 1 + REFILL,                    // b
        _ => 1,
    }
}

/// Instructions of 32 bits.
fn long(first: u16, second: u16) -> Cost {
    let list = u64::from(second.count_ones());
    let (load, to_pc) = (first & 0x10 != 0, second >> 12 == 15);
    let cycles = match first >> 8 {
        0xe8 | 0xe9 if first & 0x40 == 0 => 1 + list + if load && second >> 15 == 1 { REFILL } else { 0 }, // ldm, stm
        0xe8 if first & 0xfff0 == 0xe8d0 && second & 0xffe0 == 0xf000 => 2 + REFILL,                       // tbb, tbh
        0xe8 | 0xe9 => 3,                                                                                  // ldrd, strd
        0xec | 0xed => 1 + u64::from(second & 0xff).max(1),                                                // vldr, vldm, …
        0xee if first & 0xffb0 == 0xee80 || first & 0xffbf == 0xeeb1 => 14,                                // vdiv, vsqrt
        0xee | 0xfe => 3,                                                                                  // of the others, most
        0xf0..=0xf7 if second & 0xd000 == 0x8000 && first & 0x380 != 0x380 => return Cost { cycles: 1, taken: REFILL }, // b<cond>
        0xf0..=0xf7 if second & 0x9000 == 0x9000 => 1 + REFILL,                                            // b, bl
        0xf3 if second & 0x8000 != 0 => 4,                                                                 // mrs, dsb, …
        0xf8 | 0xf9 => 2 + if load && to_pc { REFILL } else { 0 },                                         // ldr, str
        0xfb if matches!(first & 0xf0, 0x90 | 0xb0) => 12,                                                 // sdiv, udiv
        _ => 1,
    };
    Cost { cycles, taken: 0 }
}

#[cfg(test)]
mod tests {
    use super::cost;

    #[test]
    fn hand_counts() {
        for (first, second, cycles, taken) in [
            (0x4348, 0, 1, 0),       // muls r0, r1, r0
            (0x6808, 0, 2, 0),       // ldr r0, [r1]
            (0xb5f0, 0, 6, 0),       // push {r4-r7, lr}
            (0xbdf0, 0, 9, 0),       // pop {r4-r7, pc}
            (0x4770, 0, 4, 0),       // bx lr
            (0xb108, 0, 1, 3),       // cbz r0, .
            (0xbf08, 0, 1, 0),       // it eq
            (0xd1fd, 0, 1, 3),       // bne
            (0xe7fe, 0, 4, 0),       // b .
            (0xf7ff, 0xfffe, 4, 0),  // bl .
            (0xf7ff, 0xbffe, 4, 0),  // b.w .
            (0xf47f, 0xaffe, 1, 3),  // bne.w .
            (0xf04f, 0x0001, 1, 0),  // mov.w r0, #1
            (0xf850, 0x1b04, 2, 0),  // ldr r1, [r0], #4
            (0xf8d0, 0xf000, 5, 0),  // ldr.w pc, [r0]
            (0xe92d, 0x4ff0, 10, 0), // push.w {r4-r11, lr}
            (0xe8bd, 0x8ff0, 13, 0), // pop.w {r4-r11, pc}
            (0xe9d0, 0x1200, 3, 0),  // ldrd r1, r2, [r0]
            (0xe8df, 0xf001, 5, 0),  // tbb [pc, r1]
            (0xfba0, 0x0101, 1, 0),  // umull r0, r1, r0, r1
            (0xfbb0, 0xf0f1, 12, 0), // udiv r0, r0, r1
            (0xfb90, 0xf0f1, 12, 0), // sdiv r0, r0, r1
            (0xfab0, 0xf080, 1, 0),  // clz r0, r0
            (0xee80, 0x0a00, 14, 0), // vdiv.f32 s0, s0, s0
        ] {
            let counted = cost(first, second);
            assert_eq!((counted.cycles, counted.taken), (cycles, taken), "{first:04x} {second:04x}");
        }
    }
}
