//! Cycles of the Cortex-M0+: its Technical Reference Manual (r0p1), table 3-1, with zero wait states and the
//! single-cycle multiplier. Loads and stores take 2 cycles: the single-cycle I/O port is not modelled.

use crate::Cost;

/// The cost of the instruction whose first half word is `code`.
pub(crate) fn cost(code: u16) -> Cost {
    let list = u64::from((code & 0xff).count_ones());
    let to_pc = code & 0x87 == 0x87;
    let cycles = match code >> 8 {
        0x44 | 0x46 if to_pc => 2,                          // add pc, rm; mov pc, rm
        0x47 => 2,                                          // bx, blx
        0x48..=0x4f => 2,                                   // ldr rt, [pc, #imm]
        0x50..=0x9f => 2,                                   // every other load and store of one register
        0xb4 => 1 + list,                                   // push {list}
        0xb5 => 1 + list + 1,                               // push {list, lr}
        0xbc => 1 + list,                                   // pop {list}
        0xbd => 3 + list + 1,                               // pop {list, pc}
        0xbf if matches!(code, 0xbf20 | 0xbf30) => 2,       // wfe, wfi
        0xc0..=0xcf => 1 + list,                            // stm, ldm
        0xd0..=0xdd => return Cost { cycles: 1, taken: 1 }, // b<cond>
        0xe0..=0xe7 => 2,                                   // b
        0xf0..=0xf7 => 3,                                   // the 32-bit ones: bl, mrs, msr, dmb, dsb, isb
        _ => 1,
    };
    Cost { cycles, taken: 0 }
}

#[cfg(test)]
mod tests {
    use super::cost;

    #[test]
    fn hand_counts() {
        for (code, cycles) in [
            (0x4348, 1), // muls r0, r1, r0
            (0x6808, 2), // ldr r0, [r1]
            (0xb5f0, 6), // push {r4-r7, lr}
            (0xbdf0, 8), // pop {r4-r7, pc}
            (0xc90f, 5), // ldm r1!, {r0-r3}
            (0x4770, 2), // bx lr
            (0x4687, 2), // mov pc, r0
            (0x4680, 1), // mov r8, r0
            (0xf7ff, 3), // bl
            (0xe7fe, 2), // b .
            (0xd1fd, 1), // bne
            (0xdf00, 1), // svc
        ] {
            assert_eq!(cost(code).cycles, cycles, "{code:04x}");
        }
        assert_eq!(cost(0xd1fd).taken, 1);
    }
}
